/// Blocks of water for tests of the CPU backend: random numbers, a setup, rates of particles.
#ifndef FAIRLEAD_TEST_WATER_BLOCK_H
#define FAIRLEAD_TEST_WATER_BLOCK_H

#include "test.h"

#include "backend/backend.h"

static const double DP = 0.05, RHO0 = 1000, C0 = 20;

/// Random numbers that are the same everywhere.
static inline double random_unit(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

/// A room of 2 m without walls, h/dp 2, no gravity, no effects.
static inline BackendSetup water_setup(int dimensions)
{
    BackendSetup s;
    memset(&s, 0, sizeof s);
    s.dimensions = dimensions;
    s.threads = 2;
    for (int a = 0; a < 3; a++) {
        s.room_min[a] = -0.5;
        s.room_max[a] = 1.5;
        s.barrier_min[a] = -INFINITY;
        s.barrier_max[a] = INFINITY;
    }
    s.spacing = DP;
    s.smoothing_length = 2 * DP;
    s.particle_mass = RHO0 * DP * DP * (dimensions == 2 ? 1 : DP);
    s.rest_density = RHO0;
    s.sound_speed = C0;
    s.largest_travel = 0.002;
    return s;
}

/// -(dW/dr)/r of a kernel, up to the factor that makes its integral 1. @param x  r/2h
static inline double kernel_shape(Kernel kernel, double x)
{
    if (x >= 1) return 0;
    return kernel == KERNEL_YIELDING ? pow(1 - x, 7) * (1 + 7 * x + 20 * x * x) : pow(1 - x, 3);
}

/// -(dW/dr)/r in double; its second moment over all directions is the number of dimensions, as
/// integration by parts of the integral of W (1) has it. @return [1/m^5], [1/m^4] in 2-D
static inline double kernel_slope_at(Kernel kernel, int dimensions, double h, double r)
{
    static double factors[2][4];
    double *factor = &factors[kernel][dimensions];
    if (*factor == 0) {
        double sum = 0, sphere = dimensions == 2 ? 2 * PI : 4 * PI;
        enum { PARTS = 10000 };
        for (int i = 0; i < PARTS; i++) {
            double x = (i + 0.5) / PARTS;
            sum += sphere * pow(x, dimensions + 1) * kernel_shape(kernel, x) / PARTS;
        }
        *factor = dimensions / sum;
    }
    return *factor * pow(2 * h, -dimensions - 2) * kernel_shape(kernel, r / (2 * h));
}

/// Accelerations and rates of density.
static inline void water_rates(const BackendSetup *setup, const ParticleStart *start, float (*a)[3],
                               float *d)
{
    Arena arena = arena_create(0);
    Backend *backend;
    Error fault = {0};
    const BackendTable *cpu = backend_cpu();
    CHECK(cpu->create(setup, start, &arena, &backend, &fault));
    CHECK(cpu->probe_rates(backend, a, d, &fault));
    cpu->destroy(backend);
    arena_destroy(&arena);
}

/// Internal forces of `count` particles under gravity cancel to `share` of their sizes.
static inline void check_momentum_is_kept(float (*a)[3], int count, double share)
{
    double sum[3] = {0}, size = 0;
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            sum[c] += a[i][c] + (c == 2 ? 9.81 : 0);
            size += fabs(a[i][c]);
        }
    for (int c = 0; c < 3; c++)
        CHECK_NEAR(sum[c] / size, 0, share);
}

#endif
