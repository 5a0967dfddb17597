#include "current.h"

#include <math.h>

#include "physics/wave_theory.h"

static Vec3 along_current(const Current *current, double length)
{
    return vec3(length * cos(current->heading), length * sin(current->heading), 0);
}

Vec3 current_velocity(const Current *current, double time)
{
    return along_current(current, current->speed * wave_step(time, 0, current->ramp).value);
}

Vec3 current_acceleration(const Current *current, double time)
{
    return along_current(current, current->speed * wave_step(time, 0, current->ramp).rate);
}

/// The integral of 6 s^5 - 15 s^4 + 10 s^3 is s^6 - 3 s^5 + 5/2 s^4, one half at s = 1.
Vec3 current_travel(const Current *current, double time)
{
    double ramp = current->ramp, s = ramp > 0 ? time / ramp : 1;
    if (s >= 1) return along_current(current, current->speed * (time - 0.5 * ramp));
    return along_current(current, current->speed * ramp * s * s * s * s * (2.5 + s * (s - 3)));
}

double current_along(const Current *current, double heading)
{
    return current->speed * cos(heading - current->heading);
}

/// Excess of the asked frequency over that of a wave number: positive for waves that are too long.
static double too_long(double k, double omega, double u, double depth, double gravity)
{
    return omega - k * u - sqrt(gravity * k * tanh(k * depth));
}

double current_wave_number(double angular_frequency, double u, double depth, double gravity)
{
    double omega = angular_frequency, airy = wave_theory_number(omega, depth, gravity);
    if (u == 0) return airy;
    double low = u > 0 ? 0 : airy, high = airy;
    // against the waves the root is the longest one; in deep water it is lost at k = 4 airy
    for (double k = airy; u < 0 && too_long(high, omega, u, depth, gravity) > 0; k *= 1.01) {
        if (k > 100 * airy || -k * u > 2 * omega) return NAN;
        low = high;
        high = k;
    }
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        *(too_long(middle, omega, u, depth, gravity) > 0 ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}
