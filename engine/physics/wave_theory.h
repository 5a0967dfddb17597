/// Second-order regular waves: dispersion, orbits, Eulerian field. Pure functions on values.
///
/// Symbols: a amplitude, k wave number, d depth, omega angular frequency, z' height above still
/// water, K = k (z' + d), S = sinh kd, theta = k x - omega t + phase. Hyperbolic functions are
/// written with e = exp(k z'), f = exp(-k z' - 2 k d) and E = exp(-2 k d), which neither overflow
/// in deep water nor cancel:
///     cosh K / S = (e + f) / (1 - E)              sinh K / S = (e - f) / (1 - E)
///     cosh 2K / S^4 = 8 E (e^2 + f^2) / (1 - E)^4   cosh 2K / (2 S^2) = (e^2 + f^2) / (1 - E)^2
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

/// One train frozen at one instant, with every product that does not depend on the place.
typedef struct WaveTerms {
    double turns_x, turns_y; ///< wave number vector / 2 pi [1/m]
    double turns;            ///< theta / 2 pi at x = y = 0, within +-1/2
    double cos_heading, sin_heading;
    double wave_number;       ///< k [1/m]
    double angular_frequency; ///< omega [rad/s]
    double level;             ///< still water [m]
    double depth_ratio;       ///< E
    double first;             ///< a / (1 - E) [m]
    double second;            ///< 3 E a^2 k / (1 - E)^4 [m]
    double bound;             ///< E a^2 k / (1 - E)^2 [m], from -1/(4 S^2)
    double rise;              ///< a^2 k / (2 (1 - E)^2) [m], mean lift of the orbits
    double drift;             ///< a^2 omega k / (1 - E)^2 [m/s], Stokes
    double crest, crest2;     ///< elevation: a and a^2 k (3 - t^2) / (4 t^3), t = tanh kd [m]
    double weight, weight_rate, weight_curve; ///< of a train in a blend and its time derivatives
} WaveTerms;

/// The same in single precision for tens of thousands of particles.
typedef struct WaveTermsF {
    float turns_x, turns_y, turns;
    float cos_heading, sin_heading;
    float wave_number, angular_frequency, level, depth_ratio;
    float first, second, bound, rise, drift, crest, crest2;
    float weight, weight_rate, weight_curve;
} WaveTermsF;

/// Motion in the vertical plane of a train: along its heading and up.
typedef struct WaveMotion {
    double along, up;
} WaveMotion;
typedef struct WaveMotionF {
    float along, up;
} WaveMotionF;

/// sin, cos of theta and the depth functions e, f at one place.
typedef struct WavePlace {
    double sine, cosine, e, f;
} WavePlace;
typedef struct WavePlaceF {
    float sine, cosine, e, f;
} WavePlaceF;

/// Products of a train of amplitude a; phase terms and weights are left at 0 and 1.
FN WaveTerms wave_terms(double amplitude, double wave_number, double angular_frequency,
                        double depth, double level)
{
    WaveTerms w;
    double E = exp(-2 * wave_number * depth), r = 1 / (1 - E), t = (1 - E) / (1 + E);
    double a2k = amplitude * amplitude * wave_number;
    w.turns_x = w.turns_y = w.turns = 0;
    w.cos_heading = 1;
    w.sin_heading = 0;
    w.wave_number = wave_number;
    w.angular_frequency = angular_frequency;
    w.level = level;
    w.depth_ratio = E;
    w.first = amplitude * r;
    w.second = 3 * E * a2k * r * r * r * r;
    w.bound = E * a2k * r * r;
    w.rise = 0.5 * a2k * r * r;
    w.drift = a2k * angular_frequency * r * r;
    w.crest = amplitude;
    w.crest2 = a2k * (3 - t * t) / (4 * t * t * t);
    w.weight = 1;
    w.weight_rate = w.weight_curve = 0;
    return w;
}

FN WaveTermsF wave_terms_single(WaveTerms w)
{
    WaveTermsF s;
    s.turns_x = (float)w.turns_x;
    s.turns_y = (float)w.turns_y;
    s.turns = (float)w.turns;
    s.cos_heading = (float)w.cos_heading;
    s.sin_heading = (float)w.sin_heading;
    s.wave_number = (float)w.wave_number;
    s.angular_frequency = (float)w.angular_frequency;
    s.level = (float)w.level;
    s.depth_ratio = (float)w.depth_ratio;
    s.first = (float)w.first;
    s.second = (float)w.second;
    s.bound = (float)w.bound;
    s.rise = (float)w.rise;
    s.drift = (float)w.drift;
    s.crest = (float)w.crest;
    s.crest2 = (float)w.crest2;
    s.weight = (float)w.weight;
    s.weight_rate = (float)w.weight_rate;
    s.weight_curve = (float)w.weight_curve;
    return s;
}

/// @param z  height [m]; the caller clamps it (ring: at most still water; zone: at most the
/// surface)
FN WavePlace wave_place(WaveTerms w, double x, double y, double z)
{
    WavePlace p;
    double theta = 2 * PI * (w.turns_x * x + w.turns_y * y + w.turns);
    p.sine = sin(theta);
    p.cosine = cos(theta);
    p.e = exp(w.wave_number * (z - w.level));
    p.f = w.depth_ratio / p.e;
    return p;
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

FN WavePlaceF wave_place_phase_single(WaveTermsF w, float x, float y)
{
    WavePlaceF p;
    // The place is folded before the time is added: its rounding is then the same at every time and
    // makes no noise in the velocity.
    float place = wave_fraction(w.turns_x * x + w.turns_y * y);
    wave_sine_cosine(wave_fraction(place + w.turns), &p.sine, &p.cosine);
    p.e = 1.0f;
    p.f = w.depth_ratio;
    return p;
}

FN WavePlaceF wave_place_depth_single(WaveTermsF w, WavePlaceF p, float z)
{
    float power = w.wave_number * (z - w.level) * 1.44269504f;
    p.e = wave_exp2(power < -60.0f ? -60.0f : power); // e^2 stays a normal number
    p.f = w.depth_ratio / p.e;
    return p;
}

/// Closed orbit about the mean place, Stokes drift left out:
/// xi = -a (cosh K/S) sin theta - a^2 k [3/8 cosh 2K/S^4 - 1/(4 S^2)] sin 2 theta,
/// zeta = a (sinh K/S) cos theta + 3/8 a^2 k (sinh 2K/S^4) cos 2 theta + a^2 k sinh 2K/(4 S^2).
FN WaveMotion wave_orbit(WaveTerms w, WavePlace p)
{
    double e2 = p.e * p.e, f2 = p.f * p.f;
    double sine2 = 2 * p.sine * p.cosine, cosine2 = 1 - 2 * p.sine * p.sine;
    WaveMotion m;
    m.along = -w.first * (p.e + p.f) * p.sine - (w.second * (e2 + f2) - w.bound) * sine2;
    m.up = w.first * (p.e - p.f) * p.cosine + (w.second * cosine2 + w.rise) * (e2 - f2);
    return m;
}
FN WaveMotionF wave_orbit_single(WaveTermsF w, WavePlaceF p)
{
    float e2 = p.e * p.e, f2 = p.f * p.f;
    float sine2 = 2.0f * p.sine * p.cosine, cosine2 = 1.0f - 2.0f * p.sine * p.sine;
    WaveMotionF m;
    m.along = -w.first * (p.e + p.f) * p.sine - (w.second * (e2 + f2) - w.bound) * sine2;
    m.up = w.first * (p.e - p.f) * p.cosine + (w.second * cosine2 + w.rise) * (e2 - f2);
    return m;
}

/// Time derivative of the closed orbit at constant weight.
FN WaveMotion wave_orbit_rate(WaveTerms w, WavePlace p)
{
    double e2 = p.e * p.e, f2 = p.f * p.f;
    double sine2 = 2 * p.sine * p.cosine, cosine2 = 1 - 2 * p.sine * p.sine;
    WaveMotion m;
    m.along = w.angular_frequency *
              (w.first * (p.e + p.f) * p.cosine + 2 * (w.second * (e2 + f2) - w.bound) * cosine2);
    m.up =
        w.angular_frequency * (w.first * (p.e - p.f) * p.sine + 2 * w.second * (e2 - f2) * sine2);
    return m;
}
FN WaveMotionF wave_orbit_rate_single(WaveTermsF w, WavePlaceF p)
{
    float e2 = p.e * p.e, f2 = p.f * p.f;
    float sine2 = 2.0f * p.sine * p.cosine, cosine2 = 1.0f - 2.0f * p.sine * p.sine;
    WaveMotionF m;
    m.along = w.angular_frequency * (w.first * (p.e + p.f) * p.cosine +
                                     2.0f * (w.second * (e2 + f2) - w.bound) * cosine2);
    m.up = w.angular_frequency *
           (w.first * (p.e - p.f) * p.sine + 2.0f * w.second * (e2 - f2) * sine2);
    return m;
}

/// Second time derivative of the closed orbit at constant weight.
FN WaveMotion wave_orbit_curve(WaveTerms w, WavePlace p)
{
    double e2 = p.e * p.e, f2 = p.f * p.f, omega2 = w.angular_frequency * w.angular_frequency;
    double sine2 = 2 * p.sine * p.cosine, cosine2 = 1 - 2 * p.sine * p.sine;
    WaveMotion m;
    m.along =
        omega2 * (w.first * (p.e + p.f) * p.sine + 4 * (w.second * (e2 + f2) - w.bound) * sine2);
    m.up = -omega2 * (w.first * (p.e - p.f) * p.cosine + 4 * w.second * (e2 - f2) * cosine2);
    return m;
}
FN WaveMotionF wave_orbit_curve_single(WaveTermsF w, WavePlaceF p)
{
    float e2 = p.e * p.e, f2 = p.f * p.f, omega2 = w.angular_frequency * w.angular_frequency;
    float sine2 = 2.0f * p.sine * p.cosine, cosine2 = 1.0f - 2.0f * p.sine * p.sine;
    WaveMotionF m;
    m.along =
        omega2 * (w.first * (p.e + p.f) * p.sine + 4.0f * (w.second * (e2 + f2) - w.bound) * sine2);
    m.up = -omega2 * (w.first * (p.e - p.f) * p.cosine + 4.0f * w.second * (e2 - f2) * cosine2);
    return m;
}

/// eta = a cos theta + a^2 k/4 cosh kd (2 + cosh 2kd)/sinh^3 kd cos 2 theta, above still water.
FN double wave_elevation(WaveTerms w, WavePlace p)
{
    return w.crest * p.cosine + w.crest2 * (1 - 2 * p.sine * p.sine);
}
FN float wave_elevation_single(WaveTermsF w, WavePlaceF p)
{
    return w.crest * p.cosine + w.crest2 * (1.0f - 2.0f * p.sine * p.sine);
}

/// Eulerian velocity: u = a omega (cosh K/S) cos theta + 3/4 a^2 omega k (cosh 2K/S^4) cos 2 theta,
/// w = a omega (sinh K/S) sin theta + 3/4 a^2 omega k (sinh 2K/S^4) sin 2 theta.
FN WaveMotion wave_velocity(WaveTerms w, WavePlace p)
{
    double e2 = p.e * p.e, f2 = p.f * p.f;
    double sine2 = 2 * p.sine * p.cosine, cosine2 = 1 - 2 * p.sine * p.sine;
    WaveMotion m;
    m.along = w.angular_frequency *
              (w.first * (p.e + p.f) * p.cosine + 2 * w.second * (e2 + f2) * cosine2);
    m.up =
        w.angular_frequency * (w.first * (p.e - p.f) * p.sine + 2 * w.second * (e2 - f2) * sine2);
    return m;
}

/// Its local time derivative.
FN WaveMotion wave_acceleration(WaveTerms w, WavePlace p)
{
    double e2 = p.e * p.e, f2 = p.f * p.f, omega2 = w.angular_frequency * w.angular_frequency;
    double sine2 = 2 * p.sine * p.cosine, cosine2 = 1 - 2 * p.sine * p.sine;
    WaveMotion m;
    m.along = omega2 * (w.first * (p.e + p.f) * p.sine + 4 * w.second * (e2 + f2) * sine2);
    m.up = -omega2 * (w.first * (p.e - p.f) * p.cosine + 4 * w.second * (e2 - f2) * cosine2);
    return m;
}

/// u_Stokes = a^2 omega k cosh 2K / (2 S^2) [m/s].
FN double wave_drift(WaveTerms w, WavePlace p) { return w.drift * (p.e * p.e + p.f * p.f); }

/// Eulerian velocity less the Stokes drift: what keeps the mean place of every particle.
FN WaveMotionF wave_driftless_velocity_single(WaveTermsF w, WavePlaceF p)
{
    float e2 = p.e * p.e, f2 = p.f * p.f;
    float sine2 = 2.0f * p.sine * p.cosine, cosine2 = 1.0f - 2.0f * p.sine * p.sine;
    WaveMotionF m;
    m.along = w.angular_frequency *
                  (w.first * (p.e + p.f) * p.cosine + 2.0f * w.second * (e2 + f2) * cosine2) -
              w.drift * (e2 + f2);
    m.up = w.angular_frequency *
           (w.first * (p.e - p.f) * p.sine + 2.0f * w.second * (e2 - f2) * sine2);
    return m;
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
