#include "piston_second.h"

#include <complex.h>
#include <math.h>

#include "base/portable.h"
#include "physics/wave_theory.h"
#include "piston.h"

/// One side of a product: a difference takes the conjugate of the slower component, whose
/// frequency and wave number then count negative.
typedef struct Side {
    const PistonModes *modes;
    double sign;      ///< 1, or -1 for the conjugate
    double frequency; ///< signed [rad/s]
    double number;    ///< of the wave that leaves, signed [1/m]
    double curvature; ///< (g^2 k^2 - omega^4)/omega of that wave, signed
} Side;

PistonModes piston_modes(double angular_frequency, double depth, double gravity)
{
    PistonModes m;
    double alpha = angular_frequency * angular_frequency * depth / gravity;
    m.angular_frequency = angular_frequency;
    m.wave_number = wave_theory_number(angular_frequency, depth, gravity);
    m.elevation = 1 / piston_stroke_ratio(m.wave_number * depth);
    m.wall = 0;
    for (int j = 0; j < PISTON_MODES; j++) {
        // omega^2 = -g q tan qd with qd = (j + 1) pi - turn, the turn by substitution
        double turn = 0, top = (j + 1) * PI;
        for (int i = 0; i < 40; i++)
            turn = atan(alpha / (top - turn));
        double qd = top - turn, s = sin(turn);
        m.decay[j] = qd / depth;
        m.share[j] = 4 * s * s / ((2 * qd - sin(2 * turn)) * m.elevation);
        m.wall += m.share[j];
    }
    return m;
}

static Side side_of(const PistonModes *modes, double sign, double gravity)
{
    Side s = {modes, sign, sign * modes->angular_frequency, sign * modes->wave_number, 0};
    double k = gravity * modes->wave_number, w = modes->angular_frequency;
    s.curvature = sign * (k * k - w * w * w * w) / w;
    return s;
}

/// The same of an evanescent mode, k^2 = -q^2.
static double curvature_of(const Side *s, double decay, double gravity)
{
    double w = s->frequency, q = gravity * decay;
    return -(q * q + w * w * w * w) / w;
}

/// -X phi_xx on the moving wall, carried to its mean place: sum over the modes of `s` of
/// k^2 phi (omega^2 - Omega^2)/(k^2 - K^2).
static double complex wall_sum(const Side *s, double total, double number, double depth,
                               double gravity)
{
    double w = s->frequency, k = s->number, top = w * w - total * total;
    double bottom = k * k - number * number;
    double ratio = top / bottom;
    if (fabs(bottom) < 1e-7 * number * number) { // the limit, d(omega^2)/d(k^2)
        double twice = 2 * number * depth;
        ratio =
            total * total / (2 * number * number) * (1 + (twice < 600 ? twice / sinh(twice) : 0));
    }
    double complex sum = I * gravity / w * k * k * ratio;
    for (int j = 0; j < PISTON_MODES; j++) {
        double q = s->modes->decay[j];
        sum += s->sign * gravity * s->modes->share[j] / w * q * q * top / (q * q + number * number);
    }
    return sum;
}

/// Forcing of the second-order surface by two modes, over i times their amplitudes.
static double complex forcing(const Side *a, const Side *b, double complex numbers,
                              double curvatures, double gravity)
{
    double both = a->frequency * b->frequency;
    return (a->frequency + b->frequency) * (both - gravity * gravity * numbers / both) -
           0.5 * curvatures;
}

/// Modes of `b` against the wave of `a` that leaves.
static double complex mixed_sum(const Side *a, const Side *b, double number, double gravity)
{
    double complex sum = 0;
    for (int j = 0; j < PISTON_MODES; j++) {
        double q = b->modes->decay[j];
        double complex together = a->number - I * q;
        double complex f = forcing(a, b, -I * (a->number * q),
                                   curvature_of(b, q, gravity) + a->curvature, gravity);
        sum -= I * b->sign * b->modes->share[j] * f * together /
               (together * together - number * number);
    }
    return sum;
}

/// Modes against modes; over i.
static double still_sum(const Side *a, const Side *b, double number, double gravity)
{
    double sum = 0, both = a->frequency * b->frequency, g2 = gravity * gravity;
    double total = a->frequency + b->frequency;
    for (int i = 0; i < PISTON_MODES; i++) {
        double p = a->modes->decay[i], row = 0, bend = curvature_of(a, p, gravity);
        for (int j = 0; j < PISTON_MODES; j++) {
            double q = b->modes->decay[j], together = p + q;
            double f =
                total * (both + g2 * p * q / both) - 0.5 * (curvature_of(b, q, gravity) + bend);
            row += b->modes->share[j] * f * together / (together * together + number * number);
        }
        sum -= a->modes->share[i] * b->sign * row;
    }
    return sum;
}

/// Modes beyond those that are summed, of one side: q -> j pi/d, b -> 2 omega^4 H.../(g^2 q^3 d).
static double complex tail_of(const Side *near, const Side *far, double depth)
{
    double w = far->modes->angular_frequency;
    double complex wall = 1 - I * (near->sign * near->modes->wall);
    return wall * w * w * w / far->modes->elevation * depth / (PI * PI * (PISTON_MODES + 0.5));
}

PistonTransfer piston_transfer(const PistonModes *fast, const PistonModes *slow,
                               PistonProduct product, double depth, double gravity)
{
    PistonTransfer none = {0, 0};
    Side a = side_of(fast, 1, gravity);
    Side b = side_of(slow, product == PISTON_SUM ? 1 : -1, gravity);
    double total = a.frequency + b.frequency;
    if (!(total > 0)) return none;
    double number = wave_theory_number(total, depth, gravity), together = a.number + b.number;
    double complex f = forcing(&a, &b, a.number * b.number, a.curvature + b.curvature, gravity);
    double complex surface =
        f * together / (together * together - number * number) +
        mixed_sum(&a, &b, number, gravity) + mixed_sum(&b, &a, number, gravity) +
        I * still_sum(&a, &b, number, gravity) + tail_of(&a, &b, depth) + tail_of(&b, &a, depth);
    double complex wall =
        0.5 * (-I / fast->elevation * wall_sum(&b, total, number, depth, gravity) -
               I * b.sign / slow->elevation * wall_sum(&a, total, number, depth, gravity));
    double complex x = (surface - wall) * number * number / (I * total * total * total);
    if (product == PISTON_SUM && fast->angular_frequency == slow->angular_frequency) x *= 0.5;
    PistonTransfer transfer = {creal(x), cimag(x)};
    return transfer;
}

bool piston_pairs_take(PistonPairs *pairs, int count, Arena *arena, Error *error)
{
    size_t n = (size_t)count * ((size_t)count + 1) / 2;
    double **arrays[] = {&pairs->along_cosine, &pairs->along_sine, &pairs->across_cosine,
                         &pairs->across_sine};
    pairs->count = count;
    TRY(pairs->modes =
            arena_take(arena, (size_t)count, sizeof *pairs->modes, "second-order piston", error));
    for (int i = 0; i < 4; i++)
        TRY(*arrays[i] = arena_take(arena, n, sizeof(double), "second-order piston", error));
    return true;
}

void piston_pairs_make(PistonPairs *pairs, const double *amplitude, const double *angular_frequency,
                       double depth, double gravity, double slowest)
{
    PistonModes *modes = pairs->modes;
    for (int n = 0, at = 0; n < pairs->count; n++) {
        modes[n] = piston_modes(angular_frequency[n], depth, gravity);
        for (int m = 0; m <= n; m++, at++) {
            PistonTransfer s = piston_transfer(&modes[n], &modes[m], PISTON_SUM, depth, gravity);
            PistonTransfer d =
                piston_transfer(&modes[n], &modes[m], PISTON_DIFFERENCE, depth, gravity);
            double both = amplitude[n] * amplitude[m], kept = both;
            double gap = angular_frequency[n] - angular_frequency[m];
            if (slowest > 0) kept *= -expm1(-(gap / slowest) * (gap / slowest));
            pairs->along_cosine[at] = both * s.real + kept * d.real;
            pairs->along_sine[at] = -both * s.imaginary + kept * d.imaginary;
            pairs->across_cosine[at] = both * s.imaginary + kept * d.imaginary;
            pairs->across_sine[at] = both * s.real - kept * d.real;
        }
    }
}

double piston_pairs_sum(const PistonPairs *pairs, const double *cosine, const double *sine)
{
    double sum = 0;
    for (int n = 0, at = 0; n < pairs->count; at += ++n) {
        const double *p = pairs->along_cosine + at, *q = pairs->along_sine + at;
        const double *r = pairs->across_sine + at, *t = pairs->across_cosine + at;
        double along = 0, across = 0;
#pragma omp simd reduction(+ : along, across)
        for (int m = 0; m <= n; m++) {
            along += p[m] * cosine[m] + q[m] * sine[m];
            across += r[m] * sine[m] + t[m] * cosine[m];
        }
        sum += cosine[n] * along - sine[n] * across;
    }
    return sum;
}
