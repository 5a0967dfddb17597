#include "colour_map.h"

#include <stddef.h>

#include "base/portable.h"

enum { STOPS = 6 };

/// Stops in OKLab (lightness, green-red, blue-yellow), evenly spaced.
static const double stops[MAP_COUNT][STOPS][3] = {
    [MAP_SEQUENTIAL] = {{0.22, 0.005, -0.085},
                        {0.37, -0.020, -0.125},
                        {0.52, -0.070, -0.070},
                        {0.67, -0.110, 0.010},
                        {0.81, -0.100, 0.105},
                        {0.95, -0.035, 0.130}},
    [MAP_DIVERGING] = {{0.36, -0.015, -0.130},
                       {0.62, -0.045, -0.110},
                       {0.90, -0.020, -0.035},
                       {0.90, 0.025, 0.020},
                       {0.62, 0.130, 0.085},
                       {0.36, 0.120, 0.065}},
    [MAP_TENSION] = {{0.95, 0.000, 0.040},
                     {0.85, 0.020, 0.120},
                     {0.74, 0.075, 0.140},
                     {0.62, 0.140, 0.110},
                     {0.48, 0.160, 0.060},
                     {0.34, 0.120, 0.010}},
};

const float SLACK_COLOUR[3] = {0.66f, 0.42f, 0.92f};

static double encode(double linear)
{
    linear = mind(maxd(linear, 0.0), 1.0);
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

static double decode(double shown)
{
    return shown <= 0.04045 ? shown / 12.92 : pow((shown + 0.055) / 1.055, 2.4);
}

void colour_map(ColourMap map, double at, double rgb[3])
{
    double s = (at > 0.0 ? mind(at, 1.0) : 0.0) * (STOPS - 1);
    int low = (int)mind(s, STOPS - 2);
    double f = s - low, lab[3];
    for (int k = 0; k < 3; k++)
        lab[k] = stops[map][low][k] * (1.0 - f) + stops[map][low + 1][k] * f;
    double l = lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2];
    double m = lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2];
    double n = lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2];
    l = l * l * l;
    m = m * m * m;
    n = n * n * n;
    rgb[0] = encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * n);
    rgb[1] = encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * n);
    rgb[2] = encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * n);
}

double colour_lightness(const double rgb[3])
{
    double r = decode(rgb[0]), g = decode(rgb[1]), b = decode(rgb[2]);
    double l = cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    double m = cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    double s = cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

double nice_ceiling(double value)
{
    static const double steps[] = {1, 1.5, 2, 3, 4, 5, 6, 8, 10};
    if (!(value > 1e-30 && value < 1e30)) return 1.0;
    double power = pow(10.0, floor(log10(value)));
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (value <= steps[i] * power * (1.0 + 1e-9)) return steps[i] * power;
    return 10.0 * power;
}

double steady_range(double kept, double largest)
{
    if (kept > 0.0 && largest <= kept && largest >= 0.3 * kept) return kept;
    return nice_ceiling(largest);
}
