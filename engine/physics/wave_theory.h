/// Regular waves: dispersion, orbits, Eulerian field. Pure functions.
///
/// Symbols: a amplitude, k wave number, d depth, omega angular frequency, z' height above still
/// water, K = k (z' + d), S = sinh kd, theta = k x - omega t + phase. Hyperbolic functions are
/// written with e = exp(k z'), f = exp(-k z' - 2 k d) and E = exp(-2 k d), which neither overflow
/// in deep water nor cancel:
///     cosh K / S = (e + f) / (1 - E)              sinh K / S = (e - f) / (1 - E)
///     cosh 2K / S^4 = 8E (e^2 + f^2) / (1 - E)^4    cosh 2K / (2 S^2) = (e^2 + f^2) / (1 - E)^2
/// A wave is a table of coefficients of such terms. To second order they stand below; those of the
/// higher theories come from engine/wave_orbits.c.
/// Source: Dean & Dalrymple (1991), Water Wave Mechanics, ch. 3, 4 and 11; the closed orbits follow
/// from integrating the Eulerian field along the particle to second order (docs/physics.md).
#ifndef FAIRLEAD_PHYSICS_WAVE_THEORY_H
#define FAIRLEAD_PHYSICS_WAVE_THEORY_H

#include "base/portable.h"

/// k of omega^2 = g k tanh(k d) [1/m], relative error below 1e-12.
/// Newton on x tanh x = c, x = kd, c = omega^2 d / g, from Eckart's (1952) explicit estimate.
FN double wave_theory_number(double angular_frequency, double depth, double gravity)
{
    double c = angular_frequency * angular_frequency * depth / gravity;
    double x = c > 0 ? c / sqrt(tanh(c)) : 0.0;
    for (int i = 0; i < 12 && c > 0; i++) {
        double t = tanh(x);
        x = x - (x * t - c) / (t + x * (1 - t * t));
    }
    return x / depth;
}

enum {
    WAVE_HARMONICS = 6, ///< of theta that are followed in the time step
    WAVE_POWERS = 3, ///< of e and f in a depth function: 1, 3, 5 in odd harmonics, 0, 2, 4 in even
};

/// One train frozen at one instant, with every product that does not depend on the place. With
/// C_m = e^m + f^m (C_0 = 1), S_m = e^m - f^m and m the powers of harmonic j:
/// eta = sum crest_j cos j theta,
/// u = mean_velocity + sum flow_j C_j cos j theta, w = sum flow_j S_j sin j theta,
/// closed orbits xi = -sum_jm along_jm C_m sin j theta, zeta = sum_jm up_jm S_m cos j theta, in
/// which e and f are those of the mean place, and
/// drift of that place less the transport: D = drift_0 + drift_1 C_2 + drift_2 C_4.
typedef struct WaveTerms {
    double turns_x, turns_y; ///< wave number vector / 2 pi [1/m]
    double turns;            ///< theta / 2 pi at x = y = 0, within +-1/2
    double cos_heading, sin_heading;
    double wave_number;                       ///< k [1/m]
    double angular_frequency;                 ///< omega [rad/s]
    double level;                             ///< still water [m]
    double depth;                             ///< d [m]
    double depth_ratio;                       ///< E
    double mean_velocity;                     ///< Eulerian, below the troughs [m/s]
    double transport;                         ///< mean over the depth of what particles drift [m/s]
    double frame_speed;                       ///< of the flow past the wave's form [m/s]
    double weight, weight_rate, weight_curve; ///< of a train in a blend and its time derivatives
    int harmonics;
    double crest[WAVE_HARMONICS + 1];              ///< [m]
    double flow[WAVE_HARMONICS + 1];               ///< [m/s]
    double along[WAVE_HARMONICS + 1][WAVE_POWERS]; ///< [m]
    double up[WAVE_HARMONICS + 1][WAVE_POWERS];    ///< [m]
    double drift[WAVE_POWERS];                     ///< [m/s]
} WaveTerms;

/// Motion in the vertical plane of a train: along its heading and up.
typedef struct WaveMotion {
    double along, up;
} WaveMotion;

/// sin, cos of theta and the depth functions e, f at one place.
typedef struct WavePlace {
    double sine, cosine, e, f;
} WavePlace;

/// A wave of second order with amplitude a and Airy's dispersion, in water that carries nothing;
/// phase terms and weights are left at 0 and 1.
FN WaveTerms wave_terms_zero(double wave_number, double angular_frequency, double depth,
                             double level)
{
    WaveTerms w;
    w.turns_x = w.turns_y = w.turns = 0;
    w.cos_heading = 1;
    w.sin_heading = 0;
    w.wave_number = wave_number;
    w.angular_frequency = angular_frequency;
    w.level = level;
    w.depth = depth;
    w.depth_ratio = exp(-2 * wave_number * depth);
    w.mean_velocity = w.transport = 0;
    w.frame_speed = angular_frequency / wave_number;
    w.weight = 1;
    w.weight_rate = w.weight_curve = 0;
    w.harmonics = 0;
    for (int j = 0; j <= WAVE_HARMONICS; j++) {
        w.crest[j] = w.flow[j] = 0;
        for (int m = 0; m < WAVE_POWERS; m++)
            w.along[j][m] = w.up[j][m] = 0;
    }
    for (int m = 0; m < WAVE_POWERS; m++)
        w.drift[m] = 0;
    return w;
}

/// eta = a cos theta + (a^2 k/4) [cosh kd (2 + cosh 2kd)/S^3] cos 2 theta
/// u = a omega (cosh K/S) cos theta + 3/4 a^2 omega k (cosh 2K/S^4) cos 2 theta - return current
/// xi = -a (cosh K/S) sin theta - a^2 k [3/8 cosh 2K/S^4 - 1/(4 S^2)] sin 2 theta,
/// zeta = a (sinh K/S) cos theta + 3/8 a^2 k (sinh 2K/S^4) cos 2 theta + a^2 k sinh 2K/(4 S^2),
/// drift u_S = a^2 omega k cosh 2K/(2 S^2), less its mean over the depth, which flows back.
FN WaveTerms wave_terms(double amplitude, double wave_number, double angular_frequency,
                        double depth, double level)
{
    WaveTerms w = wave_terms_zero(wave_number, angular_frequency, depth, level);
    double E = w.depth_ratio, r = 1 / (1 - E), t = (1 - E) / (1 + E);
    double a2k = amplitude * amplitude * wave_number;
    w.harmonics = 2;
    w.crest[1] = amplitude;
    w.crest[2] = a2k * (3 - t * t) / (4 * t * t * t);
    w.along[1][0] = w.up[1][0] = amplitude * r;
    w.along[2][0] = -E * a2k * r * r;
    w.along[2][1] = w.up[2][1] = 3 * E * a2k * r * r * r * r;
    w.up[0][1] = 0.5 * a2k * r * r;
    w.flow[1] = angular_frequency * w.along[1][0];
    w.flow[2] = 2 * angular_frequency * w.along[2][1];
    w.drift[1] = a2k * angular_frequency * r * r;
    w.mean_velocity = w.drift[0] = -w.drift[1] * (1 - E * E) / (2 * wave_number * depth);
    return w;
}

/// @param z  height [m]; the caller clamps it (ring: at most still water; zone: at most the
/// surface)
FN WavePlace wave_place(const WaveTerms *w, double x, double y, double z)
{
    WavePlace p;
    double theta = 2 * PI * (w->turns_x * x + w->turns_y * y + w->turns);
    p.sine = sin(theta);
    p.cosine = cos(theta);
    p.e = exp(w->wave_number * (z - w->level));
    p.f = w->depth_ratio / p.e;
    return p;
}

/// Depth functions of the powers of harmonic j: C_m or S_m times their coefficients.
FN double wave_depth_sum(const double *c, int j, double e, double f, double sign)
{
    double e2 = e * e, f2 = f * f;
    if (j % 2)
        return c[0] * (e + sign * f) + c[1] * (e2 * e + sign * f2 * f) +
               c[2] * (e2 * e2 * e + sign * f2 * f2 * f);
    return (sign > 0 ? c[0] : 0) + c[1] * (e2 + sign * f2) + c[2] * (e2 * e2 + sign * f2 * f2);
}

/// Closed orbit about the mean place, drift left out.
FN WaveMotion wave_orbit(const WaveTerms *w, WavePlace p)
{
    WaveMotion m;
    double s = 0, c = 1; // sine and cosine of j theta
    m.along = 0;
    m.up = wave_depth_sum(w->up[0], 0, p.e, p.f, -1);
    for (int j = 1; j <= w->harmonics; j++) {
        double next = s * p.cosine + c * p.sine;
        c = c * p.cosine - s * p.sine;
        s = next;
        m.along -= wave_depth_sum(w->along[j], j, p.e, p.f, 1) * s;
        m.up += wave_depth_sum(w->up[j], j, p.e, p.f, -1) * c;
    }
    return m;
}

/// Time derivative of the closed orbit at constant weight.
FN WaveMotion wave_orbit_rate(const WaveTerms *w, WavePlace p)
{
    WaveMotion m;
    double s = 0, c = 1;
    m.along = m.up = 0;
    for (int j = 1; j <= w->harmonics; j++) {
        double next = s * p.cosine + c * p.sine, rate = j * w->angular_frequency;
        c = c * p.cosine - s * p.sine;
        s = next;
        m.along += rate * wave_depth_sum(w->along[j], j, p.e, p.f, 1) * c;
        m.up += rate * wave_depth_sum(w->up[j], j, p.e, p.f, -1) * s;
    }
    return m;
}

/// eta above still water [m].
FN double wave_elevation(const WaveTerms *w, WavePlace p)
{
    double sum = 0, s = 0, c = 1;
    for (int j = 1; j <= w->harmonics; j++) {
        double next = s * p.cosine + c * p.sine;
        c = c * p.cosine - s * p.sine;
        s = next;
        sum += w->crest[j] * c;
    }
    return sum;
}

/// Eulerian velocity [m/s].
FN WaveMotion wave_velocity(const WaveTerms *w, WavePlace p)
{
    WaveMotion m;
    double s = 0, c = 1, e = 1, f = 1;
    m.along = w->mean_velocity;
    m.up = 0;
    for (int j = 1; j <= w->harmonics; j++) {
        double next = s * p.cosine + c * p.sine;
        c = c * p.cosine - s * p.sine;
        s = next;
        e *= p.e;
        f *= p.f;
        m.along += w->flow[j] * (e + f) * c;
        m.up += w->flow[j] * (e - f) * s;
    }
    return m;
}

/// Its local time derivative [m/s^2].
FN WaveMotion wave_acceleration(const WaveTerms *w, WavePlace p)
{
    WaveMotion m;
    double s = 0, c = 1, e = 1, f = 1;
    m.along = m.up = 0;
    for (int j = 1; j <= w->harmonics; j++) {
        double next = s * p.cosine + c * p.sine, rate = j * w->angular_frequency;
        c = c * p.cosine - s * p.sine;
        s = next;
        e *= p.e;
        f *= p.f;
        m.along += rate * w->flow[j] * (e + f) * s;
        m.up -= rate * w->flow[j] * (e - f) * c;
    }
    return m;
}

/// Mean height of the streamline through a place, above still water and at most there [m]: the
/// place's height less what the stream function lifts it, to second order.
FN double wave_label(const WaveTerms *w, WavePlace p)
{
    double s = 0, c = 1, e = 1, f = 1, sum = 0;
    for (int j = 1; j <= w->harmonics; j++) {
        double next = s * p.cosine + c * p.sine;
        c = c * p.cosine - s * p.sine;
        s = next;
        e *= p.e;
        f *= p.f;
        sum += w->flow[j] / j * (e - f) * c;
    }
    double label = (log(p.e) - sum / w->frame_speed) / w->wave_number;
    return label < 0 ? label : 0;
}

/// Drift of particles whose mean height is `label`, less the transport, and its integral from the
/// bed: a return flow along a wave that fades over a distance rises by that integral.
FN double wave_drift(const WaveTerms *w, double label)
{
    double e2 = exp(2 * w->wave_number * label), f2 = w->depth_ratio * w->depth_ratio / e2;
    return w->drift[0] + w->drift[1] * (e2 + f2) + w->drift[2] * (e2 * e2 + f2 * f2);
}
FN double wave_drift_integral(const WaveTerms *w, double label)
{
    double e2 = exp(2 * w->wave_number * label), f2 = w->depth_ratio * w->depth_ratio / e2;
    return w->drift[0] * (label + w->depth) +
           (w->drift[1] * (e2 - f2) + 0.5 * w->drift[2] * (e2 * e2 - f2 * f2)) /
               (2 * w->wave_number);
}

/// x less the nearest whole number, |x| < 1e9. Through int: a trick with a large float constant
/// would be undone by -fassociative-math.
FN float wave_fraction(float x)
{
    int whole = (int)(x + (x < 0.0f ? -0.5f : 0.5f));
    return x - (float)whole;
}

/// 2^x for |x| < 126, relative error below 3e-7: Taylor's series on +-1/2, exponent by its bits.
FN float wave_exp2(float x)
{
    int whole = (int)(x + (x < 0.0f ? -0.5f : 0.5f));
    float r = (x - (float)whole) * 0.693147181f;
    float p = 1.0f / 5040.0f;
    union {
        int bits;
        float value;
    } power;
    p = p * r + 1.0f / 720.0f;
    p = p * r + 1.0f / 120.0f;
    p = p * r + 1.0f / 24.0f;
    p = p * r + 1.0f / 6.0f;
    p = p * r + 0.5f;
    p = p * r + 1.0f;
    p = p * r + 1.0f;
    power.bits = (whole + 127) << 23;
    return p * power.value;
}

/// Sine and cosine of `turns` whole circles, |turns| <= 1/2, absolute error below 7e-7: Taylor's
/// series of the half angle, then doubled, so that no quadrant has to be chosen.
FN void wave_sine_cosine(float turns, float *sine, float *cosine)
{
    float x = turns * 3.14159265f, y = x * x;
    float s = -1.0f / 39916800.0f, c = 1.0f / 479001600.0f;
    s = s * y + 1.0f / 362880.0f;
    s = s * y - 1.0f / 5040.0f;
    s = s * y + 1.0f / 120.0f;
    s = s * y - 1.0f / 6.0f;
    s = (s * y + 1.0f) * x;
    c = c * y - 1.0f / 3628800.0f;
    c = c * y + 1.0f / 40320.0f;
    c = c * y - 1.0f / 720.0f;
    c = c * y + 1.0f / 24.0f;
    c = c * y - 0.5f;
    c = c * y + 1.0f;
    *sine = 2.0f * s * c;
    *cosine = 1.0f - 2.0f * s * s;
}

/// The same in double precision, absolute error below 2e-15: for paths whose second differences are
/// taken (the acceleration of a wall).
FN void wave_sine_cosine_double(double turns, double *sine, double *cosine)
{
    double x = turns * PI, y = x * x;
    double s = 1.0 / 51090942171709440000.0, c = 1.0 / 1124000727777607680000.0;
    s = s * y - 1.0 / 121645100408832000.0;
    s = s * y + 1.0 / 355687428096000.0;
    s = s * y - 1.0 / 1307674368000.0;
    s = s * y + 1.0 / 6227020800.0;
    s = s * y - 1.0 / 39916800.0;
    s = s * y + 1.0 / 362880.0;
    s = s * y - 1.0 / 5040.0;
    s = s * y + 1.0 / 120.0;
    s = s * y - 1.0 / 6.0;
    s = (s * y + 1.0) * x;
    c = 1.0 / 2432902008176640000.0 - c * y;
    c = c * y - 1.0 / 6402373705728000.0;
    c = c * y + 1.0 / 20922789888000.0;
    c = c * y - 1.0 / 87178291200.0;
    c = c * y + 1.0 / 479001600.0;
    c = c * y - 1.0 / 3628800.0;
    c = c * y + 1.0 / 40320.0;
    c = c * y - 1.0 / 720.0;
    c = c * y + 1.0 / 24.0;
    c = c * y - 0.5;
    c = c * y + 1.0;
    *sine = 2.0 * s * c;
    *cosine = 1.0 - 2.0 * s * s;
}

/// x less the nearest whole number, |x| < 1e9.
FN double wave_fraction_double(double x)
{
    int whole = (int)(x + (x < 0.0 ? -0.5 : 0.5));
    return x - (double)whole;
}

/// Quintic smoothstep 6 s^5 - 15 s^4 + 10 s^3 of (time - begin)/duration, clamped, with its first
/// and second time derivatives; the second is continuous too.
typedef struct WaveStep {
    double value, rate, curve;
} WaveStep;
FN WaveStep wave_step(double time, double begin, double duration)
{
    WaveStep b;
    double s = duration > 0 ? (time - begin) / duration : (time >= begin ? 1.0 : 0.0);
    s = s < 0 ? 0 : (s > 1 ? 1 : s);
    double n = duration > 0 ? 1 / duration : 0.0;
    b.value = s * s * s * (10 + s * (6 * s - 15));
    b.rate = 30 * s * s * (1 - s) * (1 - s) * n;
    b.curve = 60 * s * (1 - s) * (1 - 2 * s) * n * n;
    return b;
}

/// Largest height before breaking, H = 0.142 L tanh kd [m].   Source: Miche (1944).
FN double wave_breaking_height(double wave_number, double depth)
{
    return 0.142 * 2 * PI / wave_number * tanh(wave_number * depth);
}

#endif
