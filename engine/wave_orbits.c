/// In the frame that moves with the wave particles run along streamlines. On one of them, counted
/// by its mean height c, with 1/|u| sampled over theta:
///     theta_L(theta) = int |u|^-1 / <|u|^-1> dtheta,   drift U(c) = speed - 1/<|u|^-1>,
/// and xi = (theta - theta_L)/k, zeta = z - c are the orbit as a function of the phase theta_L of
/// the mean place. The map from mean places to places, at one instant, is the same whether the mean
/// places drift or not; as particles with drift keep their volume, so do those without.
#include "wave_orbits.h"

#include <math.h>
#include <string.h>

enum { STREAMLINES = 24, POINTS = 64 }; ///< POINTS over half a wave

typedef struct Streamline {
    double mean;  ///< c, above still water [m]
    double drift; ///< U [m/s]
    double along[WAVE_HARMONICS + 1], up[WAVE_HARMONICS + 1];
} Streamline;

/// psi less -U_frame z, its z derivative being the velocity: sum F_j/(jk) S_j cos j theta.
static double stream_rest(const SteadyWave *wave, double theta, double z)
{
    double sum = 0;
    for (int j = 1; j <= wave->harmonics; j++) {
        double jk = j * wave->wave_number;
        double shape =
            (exp(jk * z) - exp(-jk * (z + 2 * wave->depth))) / (1 + exp(-2 * jk * wave->depth));
        sum += wave->flow[j] / jk * shape * cos(j * theta);
    }
    return sum;
}

/// Height of the streamline psi = `value` at theta.
static double streamline_height(const SteadyWave *wave, double theta, double value, double guess)
{
    double frame = wave->speed - wave->mean_velocity, z = guess;
    for (int i = 0; i < 30; i++) {
        double u, w, miss = stream_rest(wave, theta, z) - frame * z - value;
        steady_wave_velocity(wave, theta, z, &u, &w);
        double step = miss / (u - wave->speed);
        z -= step;
        if (fabs(step) < 1e-14 * wave->depth) break;
    }
    return z;
}

/// @param value  psi of the streamline, `lift` what its surface neighbour is above its mean [-]
static Streamline streamline_of(const SteadyWave *wave, double value, double mean_guess)
{
    Streamline line;
    double z[POINTS + 1], slow[POINTS + 1], weight[POINTS + 1], mean_slow = 0;
    memset(&line, 0, sizeof line);
    for (int i = 0; i <= POINTS; i++) {
        double theta = PI * i / POINTS, u, w, d = wave->depth;
        double guess = mean_guess + steady_wave_elevation(wave, theta) * (mean_guess + d) / d;
        z[i] = streamline_height(wave, theta, value, guess);
        steady_wave_velocity(wave, theta, z[i], &u, &w);
        slow[i] = 1 / (wave->speed - u);
        weight[i] = (i == 0 || i == POINTS ? 0.5 : 1.0) / POINTS;
        mean_slow += weight[i] * slow[i];
        line.mean += weight[i] * z[i];
    }
    line.drift = wave->speed - 1 / mean_slow;
    double tau[POINTS] = {0}; // theta_L = theta + sum tau_j/j sin j theta
    for (int j = 1; j < POINTS; j++)
        for (int i = 0; i <= POINTS; i++)
            tau[j] += 2 * weight[i] * slow[i] / mean_slow * cos(j * PI * i / POINTS);
    for (int i = 0; i <= POINTS; i++) {
        double theta = PI * i / POINTS, ahead = 0, share = weight[i] * slow[i] / mean_slow;
        for (int j = 1; j < POINTS; j++)
            ahead += tau[j] / j * sin(j * theta);
        line.up[0] += share * (z[i] - line.mean);
        for (int j = 1; j <= WAVE_HARMONICS; j++) {
            line.along[j] += 2 * share * (ahead / wave->wave_number) * sin(j * (theta + ahead));
            line.up[j] += 2 * share * (z[i] - line.mean) * cos(j * (theta + ahead));
        }
    }
    return line;
}

/// Basis of the powers of harmonic j at mean height c.
static void basis_of(const SteadyWave *wave, int j, double c, double sign, double *basis)
{
    double e = exp(wave->wave_number * c), f = exp(-wave->wave_number * (c + 2 * wave->depth));
    for (int m = 0; m < WAVE_POWERS; m++) {
        double unit[WAVE_POWERS] = {0};
        unit[m] = 1;
        basis[m] = wave_depth_sum(unit, j, e, f, sign);
    }
}

/// Least squares of `value` over the streamlines on the basis; the constant is left out where it
/// is zero.
static void fit(const SteadyWave *wave, const Streamline *lines, const double *value, int j,
                double sign, double *coefficient)
{
    double A[WAVE_POWERS][WAVE_POWERS + 1];
    memset(A, 0, sizeof A);
    int first = sign < 0 && j % 2 == 0 ? 1 : 0;
    for (int i = 0; i < STREAMLINES; i++) {
        double basis[WAVE_POWERS];
        basis_of(wave, j, lines[i].mean, sign, basis);
        for (int r = first; r < WAVE_POWERS; r++) {
            for (int c = first; c < WAVE_POWERS; c++)
                A[r][c] += basis[r] * basis[c];
            A[r][WAVE_POWERS] += basis[r] * value[i];
        }
    }
    for (int p = first; p < WAVE_POWERS; p++) // positive definite: no pivots needed
        for (int r = p + 1; r < WAVE_POWERS; r++) {
            double factor = A[r][p] / A[p][p];
            for (int c = p; c <= WAVE_POWERS; c++)
                A[r][c] -= factor * A[p][c];
        }
    for (int p = 0; p < WAVE_POWERS; p++)
        coefficient[p] = 0;
    for (int p = WAVE_POWERS - 1; p >= first; p--) {
        double sum = A[p][WAVE_POWERS];
        for (int c = p + 1; c < WAVE_POWERS; c++)
            sum -= A[p][c] * coefficient[c];
        coefficient[p] = sum / A[p][p];
    }
}

/// Largest distance between the streamlines' orbits and the fitted ones [m].
static double largest_misfit(const SteadyWave *wave, const Streamline *lines, const WaveTerms *w)
{
    double worst = 0;
    for (int i = 0; i < STREAMLINES; i++)
        for (int n = 0; n < 32; n++) {
            WaveTerms at = *w;
            at.turns = n / 32.0;
            WaveMotion fitted = wave_orbit(&at, wave_place(&at, 0, 0, lines[i].mean + w->level));
            double along = 0, up = lines[i].up[0];
            for (int j = 1; j <= WAVE_HARMONICS; j++) {
                along -= lines[i].along[j] * sin(2 * PI * j * at.turns);
                up += lines[i].up[j] * cos(2 * PI * j * at.turns);
            }
            worst = maxd(worst, hypot(fitted.along - along, fitted.up - up));
        }
    (void)wave;
    return worst;
}

static WaveTerms second_order(const SteadyWave *wave, double level)
{
    double frame = wave->speed - wave->mean_velocity, k = wave->wave_number;
    WaveTerms w = wave_terms(wave->elevation[1], k, frame * k, wave->depth, level);
    if (wave->theory == WAVE_THEORY_AIRY) w.crest[2] = w.flow[2] = 0;
    w.angular_frequency = wave->angular_frequency;
    w.mean_velocity = wave->mean_velocity;
    w.transport = wave->transport;
    return w;
}

/// Streamlines from the surface to the bed, or to where the wave is no longer felt; close together
/// at the surface.
static void streamlines_of(const SteadyWave *wave, Streamline *lines)
{
    double frame = wave->speed - wave->mean_velocity;
    double deepest = mind(wave->depth, 1.2 * 2 * PI / wave->wave_number);
    double top = steady_wave_elevation(wave, 0);
    double surface = stream_rest(wave, 0, top) - frame * top;
    for (int i = 0; i < STREAMLINES; i++) {
        double share = (double)i / (STREAMLINES - 1), depth = deepest * share * share;
        lines[i] = streamline_of(
            wave, surface + frame * depth * (1 - surface / (frame * wave->depth)), -depth);
    }
}

WaveTerms wave_orbits_terms(const SteadyWave *wave, double level, double *misfit)
{
    if (misfit) *misfit = 0;
    if (wave->theory < WAVE_THEORY_STOKES5) return second_order(wave, level);
    Streamline lines[STREAMLINES];
    streamlines_of(wave, lines);
    WaveTerms w = wave_terms_zero(wave->wave_number, wave->angular_frequency, wave->depth, level);
    w.harmonics = WAVE_HARMONICS < wave->harmonics ? WAVE_HARMONICS : wave->harmonics;
    w.mean_velocity = wave->mean_velocity;
    w.transport = wave->transport;
    w.frame_speed = wave->speed - wave->mean_velocity;
    double value[STREAMLINES];
    for (int j = 0; j <= w.harmonics; j++) {
        for (int i = 0; i < STREAMLINES; i++)
            value[i] = lines[i].up[j];
        fit(wave, lines, value, j, -1, w.up[j]);
        if (j == 0) continue;
        for (int i = 0; i < STREAMLINES; i++)
            value[i] = lines[i].along[j];
        fit(wave, lines, value, j, 1, w.along[j]);
        w.crest[j] = wave->elevation[j];
        w.flow[j] = wave->flow[j] / (1 + pow(w.depth_ratio, j));
    }
    for (int i = 0; i < STREAMLINES; i++)
        value[i] = lines[i].drift - wave->transport;
    fit(wave, lines, value, 2, 1, w.drift);
    if (misfit) *misfit = largest_misfit(wave, lines, &w);
    // harmonics that nobody would see cost time in every step
    while (w.harmonics > 2 && fabs(w.crest[w.harmonics]) < 2e-4 * w.crest[1])
        w.harmonics--;
    return w;
}
