#include "steady_wave.h"

#include <math.h>
#include <string.h>

#include "physics/wave_theory.h"
#include "stream_wave.h"

StokesCoefficients stokes_coefficients(double kd)
{
    StokesCoefficients k;
    double s = 1 / cosh(2 * kd), sh = sinh(kd), ct = 1 / tanh(kd), m = 1 - s;
    double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s, s6 = s5 * s, s7 = s6 * s, s8 = s7 * s;
    double m2 = m * m, m3 = m2 * m, m4 = m3 * m, m5 = m4 * m, m6 = m5 * m;
    double p = 3 + 2 * s, q = 4 + s;
    k.A11 = 1 / sh;
    k.A22 = 3 * s2 / (2 * m2);
    k.A31 = (-4 - 20 * s + 10 * s2 - 13 * s3) / (8 * sh * m3);
    k.A33 = (-2 * s2 + 11 * s3) / (8 * sh * m3);
    k.A42 = (12 * s - 14 * s2 - 264 * s3 - 45 * s4 - 13 * s5) / (24 * m5);
    k.A44 = (10 * s3 - 174 * s4 + 291 * s5 + 278 * s6) / (48 * p * m5);
    k.A51 = (-1184 + 32 * s + 13232 * s2 + 21712 * s3 + 20940 * s4 + 12554 * s5 - 500 * s6 -
             3341 * s7 - 670 * s8) /
            (64 * sh * p * q * m6);
    k.A53 = (4 * s + 105 * s2 + 198 * s3 - 1376 * s4 - 1302 * s5 - 117 * s6 + 58 * s7) /
            (32 * sh * p * m6);
    k.A55 =
        (-6 * s3 + 272 * s4 - 1552 * s5 + 852 * s6 + 2029 * s7 + 430 * s8) / (64 * sh * p * q * m6);
    k.B22 = ct * (1 + 2 * s) / (2 * m);
    k.B31 = -3 * (1 + 3 * s + 3 * s2 + 2 * s3) / (8 * m3);
    k.B42 = ct * (6 - 26 * s - 182 * s2 - 204 * s3 - 25 * s4 + 26 * s5) / (6 * p * m4);
    k.B44 = ct * (24 + 92 * s + 122 * s2 + 66 * s3 + 67 * s4 + 34 * s5) / (24 * p * m4);
    k.B53 = 9 *
            (132 + 17 * s - 2216 * s2 - 5897 * s3 - 6292 * s4 - 2687 * s5 + 194 * s6 + 467 * s7 +
             82 * s8) /
            (128 * p * q * m6);
    k.B55 = 5 *
            (300 + 1579 * s + 3176 * s2 + 2949 * s3 + 1188 * s4 + 675 * s5 + 1326 * s6 + 827 * s7 +
             130 * s8) /
            (384 * p * q * m6);
    k.C0 = sqrt(tanh(kd));
    k.C2 = k.C0 * (2 + 7 * s2) / (4 * m2);
    k.C4 = k.C0 * (4 + 32 * s - 116 * s2 - 400 * s3 - 71 * s4 + 146 * s5) / (32 * m5);
    k.D2 = -sqrt(ct) / 2;
    k.D4 = sqrt(ct) * (2 + 4 * s + s2 + 2 * s3) / (8 * m3);
    k.E2 = tanh(kd) * (2 + 2 * s + 5 * s2) / (4 * m2);
    k.E4 = tanh(kd) * (8 + 12 * s - 152 * s2 - 308 * s3 - 42 * s4 + 77 * s5) / (32 * m5);
    return k;
}

/// Beyond this kd the coefficients are those of deep water to rounding, and hyperbolic functions
/// may not overflow.
static const double DEEP = 30;

/// Speed of the flow in the wave's frame and what its flux exceeds speed times depth by [m/s],
/// [m^2/s], to the order of the theory.
typedef struct FrameFlow {
    double speed, excess;
} FrameFlow;

static FrameFlow frame_flow(const SteadyWaveAsk *ask, double k)
{
    FrameFlow flow;
    double kd = mind(k * ask->depth, DEEP), e = k * ask->height / 2;
    StokesCoefficients s = stokes_coefficients(kd);
    bool fifth = ask->theory == WAVE_THEORY_STOKES5;
    double e2 = e * e, e4 = fifth ? e2 * e2 : 0;
    // second-order waves have Airy's dispersion; their flux is of second order
    flow.speed = sqrt(ask->gravity / k) * (s.C0 + (fifth ? e2 * s.C2 : 0) + e4 * s.C4);
    flow.excess = sqrt(ask->gravity / (k * k * k)) * (e2 * s.D2 + e4 * s.D4);
    return flow;
}

/// c T - L of a wave number: what the period leaves over [m].
static double mismatch(const SteadyWaveAsk *ask, double k)
{
    FrameFlow flow = frame_flow(ask, k);
    double carried = ask->eulerian ? 0 : flow.excess / ask->depth;
    return (flow.speed + carried + ask->current) * ask->period - 2 * PI / k;
}

/// k by bisection around Airy's: monotonous, and quick enough for once.
static double explicit_number(const SteadyWaveAsk *ask)
{
    if (!(ask->period > 0)) return 2 * PI / ask->length;
    double omega = 2 * PI / ask->period;
    double airy = wave_theory_number(omega, ask->depth, ask->gravity);
    double low = 0.2 * airy, high = 8 * airy;
    // with an opposing current the speed falls below zero for short waves: the root is the longest
    for (double k = low; k < high; k *= 1.02)
        if (mismatch(ask, k) > 0) {
            low = k / 1.02, high = k;
            break;
        }
    for (int i = 0; i < 100; i++) {
        double middle = 0.5 * (low + high);
        *(mismatch(ask, middle) > 0 ? &high : &low) = middle;
    }
    return 0.5 * (low + high);
}

/// cosh(j x)/... of Stokes' potential as flow[j] = C0 sqrt(g/k) j cosh(jkd) sum_i e^i A_ij.
static void stokes5(const SteadyWaveAsk *ask, double k, SteadyWave *wave)
{
    double kd = mind(k * ask->depth, DEEP), e = k * ask->height / 2;
    StokesCoefficients s = stokes_coefficients(kd);
    double e2 = e * e, e3 = e2 * e, e4 = e3 * e, e5 = e4 * e, unit = s.C0 * sqrt(ask->gravity / k);
    double potential[6] = {0,
                           e * s.A11 + e3 * s.A31 + e5 * s.A51,
                           e2 * s.A22 + e4 * s.A42,
                           e3 * s.A33 + e5 * s.A53,
                           e4 * s.A44,
                           e5 * s.A55};
    double surface[6] = {0,
                         e + e3 * s.B31 - e5 * (s.B53 + s.B55),
                         e2 * s.B22 + e4 * s.B42,
                         -e3 * s.B31 + e5 * s.B53,
                         e4 * s.B44,
                         e5 * s.B55};
    wave->harmonics = 5;
    for (int j = 1; j <= 5; j++) {
        wave->flow[j] = unit * j * cosh(j * kd) * potential[j];
        wave->elevation[j] = surface[j] / k;
    }
    wave->bernoulli = 0.5 * ask->gravity / k * (s.C0 * s.C0 + 2 * (e2 * s.E2 + e4 * s.E4));
}

static void stokes2(const SteadyWaveAsk *ask, double k, double omega, SteadyWave *wave)
{
    double a = ask->height / 2, t = tanh(k * ask->depth), kd = mind(k * ask->depth, DEEP);
    double s = sinh(kd);
    wave->harmonics = ask->theory == WAVE_THEORY_AIRY ? 1 : 2;
    wave->elevation[1] = a;
    wave->flow[1] = a * omega / t;
    wave->bernoulli = 0.5 * omega * omega / (k * k);
    if (wave->harmonics == 1) return;
    wave->elevation[2] = a * a * k * (3 - t * t) / (4 * t * t * t);
    wave->flow[2] = 0.75 * a * a * omega * k * cosh(2 * kd) / (s * s * s * s);
}

static bool explicit_wave(const SteadyWaveAsk *ask, SteadyWave *wave)
{
    double k = explicit_number(ask);
    FrameFlow flow = frame_flow(ask, k);
    memset(wave, 0, sizeof *wave);
    wave->theory = ask->theory;
    wave->depth = ask->depth;
    wave->wave_number = k;
    double carried = flow.excess / ask->depth; // c_S - c_E, negative of Stokes' mean drift
    wave->mean_velocity = ask->eulerian ? ask->current : ask->current + carried;
    wave->transport = wave->mean_velocity - carried;
    wave->speed = flow.speed + wave->mean_velocity;
    wave->angular_frequency = wave->speed * k;
    if (ask->theory == WAVE_THEORY_STOKES5)
        stokes5(ask, k, wave);
    else
        stokes2(ask, k, flow.speed * k, wave);
    return isfinite(wave->speed) && wave->speed > 0;
}

bool steady_wave_solve(const SteadyWaveAsk *ask, SteadyWave *wave)
{
    if (!(ask->height > 0) || !(ask->depth > 0)) return false;
    SteadyWaveAsk asked = *ask;
    if (asked.theory == WAVE_THEORY_AUTO) asked.theory = WAVE_THEORY_STREAM;
    return asked.theory == WAVE_THEORY_STREAM ? stream_wave_solve(&asked, wave)
                                              : explicit_wave(&asked, wave);
}

double steady_wave_elevation(const SteadyWave *wave, double theta)
{
    double sum = 0;
    for (int j = 1; j <= wave->harmonics; j++)
        sum += wave->elevation[j] * cos(j * theta);
    return sum;
}

void steady_wave_velocity(const SteadyWave *wave, double theta, double z, double *along, double *up)
{
    *along = wave->mean_velocity;
    *up = 0;
    for (int j = 1; j <= wave->harmonics; j++) {
        double jk = j * wave->wave_number, e = exp(jk * z), f = exp(-jk * (z + 2 * wave->depth));
        double scale = wave->flow[j] / (1 + exp(-2 * jk * wave->depth));
        *along += scale * (e + f) * cos(j * theta);
        *up += scale * (e - f) * sin(j * theta);
    }
}
