/// In the frame that moves with the wave the flow is steady and the surface a streamline:
///     psi(x, z) = -U z + sum_j F_j/(jk) S_j(z) cos jkx,   psi(x, eta) = -q
///     1/2 (u^2 + w^2) + g eta = R on it,
/// with S_j, C_j = sinh, cosh jk(z + d)/cosh jkd, u = -U + sum F_j C_j cos jkx and
/// w = sum F_j S_j sin jkx. Unknown are k, U, q, R, the elevations at N + 1 points of half a wave
/// and F_1 … F_N; as many equations are the two conditions at the points, the mean level, the
/// height, and the period (c = U + c_E, or U + q/d where the mean transport is given) or the
/// length. Lengths are counted in 1/k0 of Airy's wave and g = 1. The wave is raised in steps, each
/// started from the two before. Large steps may end in another flow that fulfils the equations, so
/// two numbers of steps have to agree.
#include "stream_wave.h"

#include <math.h>
#include <string.h>

#include "physics/wave_theory.h"

enum { UNKNOWNS_MAX = 2 * STEADY_HARMONICS_MAX + 5 };

typedef struct System {
    int n;          ///< harmonics
    double height;  ///< of this step
    double period;  ///< 0 = the wave number is given
    double number;  ///< k when it is given
    double depth;   ///< all in units of 1/k0 and g = 1
    double current; ///< c_E or c_S
    bool eulerian;
    double value[UNKNOWNS_MAX]; ///< k, U, q, R, eta_0 … eta_N, F_1 … F_N
    double residual[UNKNOWNS_MAX];
    double jacobian[UNKNOWNS_MAX][UNKNOWNS_MAX];
} System;

enum { AT_K, AT_U, AT_Q, AT_R, AT_ETA };
static int at_flow(const System *s, int j) { return AT_ETA + s->n + j; } // F_j, j >= 1
static int unknowns(const System *s) { return 2 * s->n + 5; }

/// Kinematic and dynamic condition at one point, with their derivatives.
static void surface_rows(System *s, int point)
{
    const double *v = s->value;
    double k = v[AT_K], eta = v[AT_ETA + point], d = s->depth, *psi = s->jacobian[2 * point];
    double *energy = s->jacobian[2 * point + 1], u = -v[AT_U], w = 0, sum = 0, sum_k = 0;
    double u_z = 0, w_z = 0, u_k = 0, w_k = 0;
    for (int j = 1; j <= s->n; j++) {
        double jk = j * k, e = exp(jk * eta), f = exp(-jk * (eta + 2 * d)), g = exp(-2 * jk * d);
        double C = (e + f) / (1 + g), S = (e - f) / (1 + g), T = (1 - g) / (1 + g), F;
        double c = cos(j * point * PI / s->n), n = sin(j * point * PI / s->n);
        F = v[at_flow(s, j)];
        // d/dk at constant eta: S_k = j ((eta + d) C - d S T), C_k = j ((eta + d) S - d C T)
        double S_k = j * ((eta + d) * C - d * S * T), C_k = j * ((eta + d) * S - d * C * T);
        sum += F * S * c / jk;
        sum_k += F * c * (S_k / jk - S / (jk * k));
        u += F * C * c;
        w += F * S * n;
        u_z += F * jk * S * c;
        w_z += F * jk * C * n;
        u_k += F * C_k * c;
        w_k += F * S_k * n;
        psi[at_flow(s, j)] = S * c / jk;
    }
    s->residual[2 * point] = sum - v[AT_U] * eta + v[AT_Q];
    psi[AT_K] = sum_k;
    psi[AT_U] = -eta;
    psi[AT_Q] = 1;
    psi[AT_ETA + point] = u;
    s->residual[2 * point + 1] = 0.5 * (u * u + w * w) + eta - v[AT_R];
    energy[AT_K] = u * u_k + w * w_k;
    energy[AT_U] = -u;
    energy[AT_R] = -1;
    energy[AT_ETA + point] = 1 + u * u_z + w * w_z;
    for (int j = 1; j <= s->n; j++) {
        double jk = j * k, e = exp(jk * eta), f = exp(-jk * (eta + 2 * d)), g = exp(-2 * jk * d);
        double c = cos(j * point * PI / s->n), n = sin(j * point * PI / s->n);
        energy[at_flow(s, j)] = (u * (e + f) * c + w * (e - f) * n) / (1 + g);
    }
}

static void fill_system(System *s)
{
    const double *v = s->value;
    int row = 2 * (s->n + 1);
    memset(s->jacobian, 0, sizeof s->jacobian);
    for (int m = 0; m <= s->n; m++)
        surface_rows(s, m);
    s->residual[row] = 0;
    for (int m = 0; m <= s->n; m++) { // mean level, trapezoidal
        double weight = m == 0 || m == s->n ? 0.5 : 1;
        s->residual[row] += weight * v[AT_ETA + m];
        s->jacobian[row][AT_ETA + m] = weight;
    }
    row++;
    s->residual[row] = v[AT_ETA] - v[AT_ETA + s->n] - s->height;
    s->jacobian[row][AT_ETA] = 1;
    s->jacobian[row][AT_ETA + s->n] = -1;
    row++;
    if (s->period > 0) {
        double c = v[AT_U] + s->current + (s->eulerian ? 0 : v[AT_Q] / s->depth);
        s->residual[row] = v[AT_K] * c - 2 * PI / s->period;
        s->jacobian[row][AT_K] = c;
        s->jacobian[row][AT_U] = v[AT_K];
        s->jacobian[row][AT_Q] = s->eulerian ? 0 : v[AT_K] / s->depth;
    } else {
        s->residual[row] = v[AT_K] - s->number;
        s->jacobian[row][AT_K] = 1;
    }
}

/// Gauss elimination with row pivots, in place. @return false when singular
static bool eliminate(System *s)
{
    int n = unknowns(s);
    for (int column = 0; column < n; column++) {
        int pivot = column;
        for (int r = column + 1; r < n; r++)
            if (fabs(s->jacobian[r][column]) > fabs(s->jacobian[pivot][column])) pivot = r;
        if (!(fabs(s->jacobian[pivot][column]) > 1e-14)) return false;
        for (int c = column; c < n && pivot != column; c++) {
            double swap = s->jacobian[column][c];
            s->jacobian[column][c] = s->jacobian[pivot][c];
            s->jacobian[pivot][c] = swap;
        }
        double swap = s->residual[column];
        s->residual[column] = s->residual[pivot];
        s->residual[pivot] = swap;
        for (int r = column + 1; r < n; r++) {
            double factor = s->jacobian[r][column] / s->jacobian[column][column];
            if (factor == 0) continue;
            for (int c = column; c < n; c++)
                s->jacobian[r][c] -= factor * s->jacobian[column][c];
            s->residual[r] -= factor * s->residual[column];
        }
    }
    for (int r = n - 1; r >= 0; r--) {
        for (int c = r + 1; c < n; c++)
            s->residual[r] -= s->jacobian[r][c] * s->residual[c];
        s->residual[r] /= s->jacobian[r][r];
    }
    return true;
}

static bool newton(System *s)
{
    for (int i = 0; i < 40; i++) {
        fill_system(s);
        if (!eliminate(s)) return false;
        double largest = 0;
        for (int u = 0; u < unknowns(s); u++) {
            largest = maxd(largest, fabs(s->residual[u]));
            s->value[u] -= s->residual[u];
        }
        if (!isfinite(largest) || largest > 100) return false;
        if (largest < 1e-12) return true;
    }
    return false;
}

/// Airy's wave of the first step.
static void start(System *s, double airy)
{
    double k = s->period > 0 ? airy : s->number, t = tanh(k * s->depth), a = s->height / 2;
    memset(s->value, 0, sizeof s->value);
    double U = sqrt(t / k);
    s->value[AT_K] = k;
    s->value[AT_U] = U;
    s->value[AT_R] = 0.5 * U * U;
    for (int m = 0; m <= s->n; m++)
        s->value[AT_ETA + m] = a * cos(m * PI / s->n);
    s->value[at_flow(s, 1)] = a * k * U / t;
}

/// Newton's method also finds flows whose crest is a dent between two peaks. A wave falls from its
/// crest to its trough.
static bool falls(const System *s)
{
    const double *eta = s->value + AT_ETA;
    for (int m = 0; m < s->n; m++)
        if (eta[m + 1] > eta[m] + 1e-4 * s->height) return false;
    return s->value[AT_U] > 0 && s->value[AT_K] > 0;
}

/// The wave in steps of its height, the next guessed from the last two.
static bool raise(System *s, double height, double airy, int steps)
{
    double before[UNKNOWNS_MAX] = {0};
    for (int i = 1; i <= steps; i++) {
        s->height = height * i / steps;
        if (i == 1) {
            start(s, airy);
        } else {
            double guess[UNKNOWNS_MAX];
            for (int u = 0; u < unknowns(s); u++)
                guess[u] = i > 2 ? 2 * s->value[u] - before[u] : s->value[u];
            memcpy(before, s->value, sizeof before);
            memcpy(s->value, guess, sizeof guess);
        }
        if (i == 1) memcpy(before, s->value, sizeof before);
        if (!newton(s) || !falls(s)) return false;
    }
    return true;
}

/// Harmonics that resolve the crest: long waves in shallow water and steep ones need more.
static int choose_harmonics(const SteadyWaveAsk *ask, double k)
{
    double breaking = wave_breaking_height(k, ask->depth);
    double n = 8 + 12 * ask->height / breaking + 4 / tanh(k * ask->depth);
    return n > STEADY_HARMONICS_MAX ? STEADY_HARMONICS_MAX : (int)n;
}

static void unpack(const System *s, double k0, double gravity, SteadyWave *wave)
{
    double speed = sqrt(gravity / k0);
    const double *v = s->value;
    wave->theory = WAVE_THEORY_STREAM;
    wave->harmonics = s->n;
    wave->depth = s->depth / k0;
    wave->wave_number = v[AT_K] * k0;
    double carried = v[AT_Q] / s->depth;
    wave->mean_velocity = speed * (s->eulerian ? s->current : s->current + carried);
    wave->transport = wave->mean_velocity - speed * carried;
    wave->speed = speed * v[AT_U] + wave->mean_velocity;
    wave->angular_frequency = wave->speed * wave->wave_number;
    wave->bernoulli = v[AT_R] * gravity / k0;
    for (int j = 1; j <= s->n; j++) {
        double sum = 0;
        for (int m = 0; m <= s->n; m++)
            sum += (m == 0 || m == s->n ? 0.5 : 1) * v[AT_ETA + m] * cos(j * m * PI / s->n);
        wave->elevation[j] = (j == s->n ? 1 : 2) * sum / (s->n * k0);
        wave->flow[j] = speed * v[at_flow(s, j)];
    }
}

bool stream_wave_solve(const SteadyWaveAsk *ask, SteadyWave *wave)
{
    static const int STEPS[] = {1, 4, 12, 40, 120};
    System s;
    double k0 = ask->period > 0 ? wave_theory_number(2 * PI / ask->period, ask->depth, ask->gravity)
                                : 2 * PI / ask->length;
    s.n = ask->harmonics > 0 ? ask->harmonics : choose_harmonics(ask, k0);
    if (s.n > STEADY_HARMONICS_MAX) s.n = STEADY_HARMONICS_MAX;
    s.period = ask->period * sqrt(ask->gravity * k0);
    s.number = 1;
    s.depth = ask->depth * k0;
    s.current = ask->current / sqrt(ask->gravity / k0);
    s.eulerian = ask->eulerian;
    memset(wave, 0, sizeof *wave);
    double number = 0, speed = 0; // as the last number of steps had them
    for (size_t i = 0; i < sizeof STEPS / sizeof *STEPS; i++) {
        if (!raise(&s, ask->height * k0, 1, STEPS[i])) continue;
        bool same = fabs(s.value[AT_K] - number) < 1e-8 && fabs(s.value[AT_U] - speed) < 1e-8;
        number = s.value[AT_K];
        speed = s.value[AT_U];
        if (!same) continue;
        unpack(&s, k0, ask->gravity, wave);
        return true;
    }
    return false;
}
