/// The CPU sweeps against a double-precision all-pairs reference, and their invariants.
#include "water_block.h"

#include <stdlib.h>

#include "backend/sweep.h"
#include "physics/fluid.h"
#include "physics/pair.h"

enum { NX = 14, NY = 12, NZ = 10, N = NX * NY * NZ };
static Vec3 place[N], velocity[N];
static float excess[N];

static BackendSetup random_water(int dimensions, double far, unsigned seed)
{
    for (int i = 0; i < N; i++) {
        int ix = i % NX, iy = i / NX % NY, iz = i / (NX * NY);
        place[i] = vec3(far + DP * (ix + 0.5 + 0.5 * (random_unit(&seed) - 0.5)),
                        DP * (iy + 0.5 + 0.5 * (random_unit(&seed) - 0.5)),
                        DP * (iz + 0.5 + 0.5 * (random_unit(&seed) - 0.5)));
        if (dimensions == 2) place[i].y = 0;
        velocity[i] =
            vec3(random_unit(&seed) - 0.5, random_unit(&seed) - 0.5, random_unit(&seed) - 0.5);
        excess[i] = (float)(0.02 * random_unit(&seed));
    }
    BackendSetup s = water_setup(dimensions);
    s.room_max[0] = far + 1.5;
    s.alpha = 0.05;
    s.delta = 0.1;
    s.gravity = 9.81;
    s.level = DP * NZ;
    s.pair_mask = PAIR_VISCOSITY | PAIR_DIFFUSION;
    return s;
}

static ParticleStart all_fluid(int count)
{
    ParticleStart start;
    memset(&start, 0, sizeof start);
    start.fluid_count = count;
    start.fluid_position = place;
    start.fluid_velocity = velocity;
    start.fluid_excess = excess;
    return start;
}

/// What diffuses: the density excess less that of water at rest at this height and under this load.
static double dynamic_excess(const BackendSetup *s, int i)
{
    double scale = 9.81 * s->smoothing_length / (C0 * C0);
    double lost = s->kernel == KERNEL_YIELDING ? 1.25 : 0.6;
    double head = 0.215 - lost * pow(s->smoothing_length / DP, -4);
    double held = maxd((double)excess[i] / scale, head), left = maxd(0, 1.5 - held) / (1.5 - head);
    return excess[i] - hydrostatic_excess(s->level - place[i].z, 9.81, C0) -
           0.95 * head * left * left * scale;
}

/// One particle by the textbook formulas of docs/physics.md, in double.
static void reference(const BackendSetup *s, int i, double a[3], double *d)
{
    double h = s->smoothing_length, b = C0 * C0 * RHO0 / 7;
    double rho_i = RHO0 * (1 + (double)excess[i]), p_i = b * (pow(rho_i / RHO0, 7) - 1);
    double di = dynamic_excess(s, i);
    a[0] = a[1] = 0;
    a[2] = -9.81;
    *d = 0;
    for (int k = 0; k < N; k++) {
        Vec3 x = vec3_sub(place[i], place[k]), v = vec3_sub(velocity[i], velocity[k]);
        double r = vec3_norm(x);
        if (k == i || r >= 2 * h) continue;
        double slope = -kernel_slope_at(s->kernel, s->dimensions, h, r), vx = vec3_dot(v, x);
        double rho_k = RHO0 * (1 + (double)excess[k]), p_k = b * (pow(rho_k / RHO0, 7) - 1);
        double mu = h * vx / (r * r + 0.01 * h * h);
        double viscous = vx < 0 ? -s->alpha * C0 * mu / RHO0 : 0;
        double f =
            -s->particle_mass * (p_i / (rho_i * rho_i) + p_k / (rho_k * rho_k) + viscous) * slope;
        double dk = dynamic_excess(s, k);
        a[0] += f * x.x;
        a[1] += f * x.y;
        a[2] += f * x.z;
        *d += s->particle_mass / RHO0 * vx * slope +
              s->delta * h * C0 * 2 * (dk - di) * -slope * s->particle_mass / RHO0;
    }
}

/// A block of a wave: Airy velocities and pressures over a slightly disturbed lattice.
static BackendSetup wave_water(unsigned seed)
{
    BackendSetup setup = random_water(3, 0, seed);
    const double k = 2 * PI / (NX * DP), height = 0.08, omega = sqrt(9.81 * k);
    for (int i = 0; i < N; i++) {
        int ix = i % NX, iy = i / NX % NY, iz = i / (NX * NY);
        place[i] = vec3(DP * (ix + 0.5 + 0.1 * (random_unit(&seed) - 0.5)),
                        DP * (iy + 0.5 + 0.1 * (random_unit(&seed) - 0.5)),
                        DP * (iz + 0.5 + 0.1 * (random_unit(&seed) - 0.5)));
        double z = place[i].z - setup.level, phase = k * place[i].x;
        double orbit = 0.5 * height * exp(k * z);
        velocity[i] = vec3(omega * orbit * cos(phase), 0, omega * orbit * sin(phase));
        excess[i] = (float)hydrostatic_excess(-z + orbit * cos(phase), 9.81, C0);
    }
    return setup;
}

static void compare_with(Kernel kernel, const BackendSetup *water)
{
    static float a[N][3], d[N];
    BackendSetup setup = *water;
    setup.kernel = kernel;
    ParticleStart start = all_fluid(N);
    water_rates(&setup, &start, a, d);
    double error2 = 0, sum2 = 0, derror2 = 0, dsum2 = 0;
    for (int i = 0; i < N; i += 3) {
        double ra[3], rd;
        reference(&setup, i, ra, &rd);
        for (int c = 0; c < 3; c++) {
            error2 += (a[i][c] - ra[c]) * (a[i][c] - ra[c]);
            sum2 += ra[c] * ra[c];
        }
        derror2 += (d[i] - rd) * (d[i] - rd);
        dsum2 += rd * rd;
    }
    CHECK_NEAR(sqrt(error2 / sum2), 0, 5e-5);
    CHECK_NEAR(sqrt(derror2 / dsum2), 0, 5e-5);
}

static void compare(const BackendSetup *water)
{
    compare_with(KERNEL_WENDLAND, water);
    compare_with(KERNEL_YIELDING, water);
}

TEST(rates_agree_with_all_pairs_in_double_3d)
{
    BackendSetup setup = random_water(3, 0, 1);
    compare(&setup);
}
TEST(rates_agree_with_all_pairs_in_double_2d)
{
    BackendSetup setup = random_water(2, 0, 2);
    compare(&setup);
}
TEST(rates_of_a_wave_agree_with_all_pairs_in_double)
{
    BackendSetup setup = wave_water(9);
    compare(&setup);
}
TEST(rates_keep_their_digits_four_thousand_spacings_from_the_origin)
{
    BackendSetup setup = random_water(3, 4000 * DP, 3);
    compare(&setup);
}

TEST(internal_forces_sum_to_zero)
{
    static float a[N][3], d[N];
    BackendSetup setup = random_water(3, 0, 4);
    ParticleStart start = all_fluid(N);
    water_rates(&setup, &start, a, d);
    check_momentum_is_kept(a, N, 1e-6);
}

TEST(bits_do_not_depend_on_the_thread_count)
{
    static float a[2][N][3], d[2][N];
    for (int t = 0; t < 2; t++) {
        BackendSetup setup = random_water(3, 0, 5);
        setup.threads = t ? 3 : 1;
        ParticleStart start = all_fluid(N);
        water_rates(&setup, &start, a[t], d[t]);
    }
    CHECK(!memcmp(a[0], a[1], sizeof a[0]));
    CHECK(!memcmp(d[0], d[1], sizeof d[0]));
}

static double largest_difference(const float *a, const float *b, int count)
{
    double largest = 0;
    for (int i = 0; i < count; i++)
        largest = fmax(largest, fabs((double)a[i] - b[i]));
    return largest;
}

// One backend keeps its lists and visit bits for several steps, the other makes them anew.
TEST(lists_miss_no_pair_while_the_water_moves)
{
    static float old_a[N][3], old_d[N], new_a[N][3], new_d[N];
    BackendSetup setup = random_water(3, 0, 8);
    setup.largest_travel = 0.04; // a skin of 0.8 spacings
    for (int i = 0; i < N; i++) {
        int ix = i % NX, iy = i / NX % NY, iz = i / (NX * NY);
        place[i] = vec3(DP * (ix + 0.5), DP * (iy + 0.5), DP * (iz + 0.5));
        velocity[i] = vec3(iz < NZ / 2 ? 1 : -1, 0, 0); // two streams
        excess[i] = 0;
    }
    ParticleStart start = all_fluid(N);
    Arena arena = arena_create(0);
    Backend *kept, *fresh;
    Error error = {0};
    const BackendTable *cpu = backend_cpu();
    CHECK(cpu->create(&setup, &start, &arena, &kept, &error));
    CHECK(cpu->create(&setup, &start, &arena, &fresh, &error));
    void *saved = arena_take(&arena, cpu->state_size(kept), 1, "saved", &error);
    Advance advance;
    memset(&advance, 0, sizeof advance);
    advance.dt = 0.002;
    ParticleSums sums;
    BackendStatistics statistics;
    double worst_a = 0, worst_d = 0;
    for (int step = 0; step < 100; step++) {
        CHECK(cpu->forces(kept, NULL, NULL, &error));
        cpu->advance(kept, &advance, &sums);
        CHECK(cpu->probe_rates(kept, old_a, old_d, &error));
        cpu->save(kept, saved);
        cpu->restore(fresh, saved);
        CHECK(cpu->probe_rates(fresh, new_a, new_d, &error));
        worst_a = fmax(worst_a, largest_difference(old_a[0], new_a[0], 3 * N));
        worst_d = fmax(worst_d, largest_difference(old_d, new_d, N));
    }
    CHECK_NEAR(worst_a, 0, 2e-4);
    CHECK_NEAR(worst_d, 0, 1e-4);
    cpu->statistics(kept, &statistics);
    CHECK_NEAR(statistics.sorts, 14, 8);
    cpu->destroy(kept);
    cpu->destroy(fresh);
    arena_destroy(&arena);
}

TEST(a_density_spike_decays)
{
    static float a[N][3], d[N];
    BackendSetup setup = random_water(3, 0, 6);
    setup.gravity = 0;
    for (int i = 0; i < N; i++) {
        velocity[i] = vec3(0, 0, 0);
        excess[i] = 0;
    }
    int spike = 5 * NX * NY + 6 * NX + 7;
    excess[spike] = 0.01f;
    ParticleStart start = all_fluid(N);
    water_rates(&setup, &start, a, d);
    CHECK(d[spike] < 0);
    CHECK(d[spike + 1] > 0);
}

/// Largest rate of density in water at rest that holds `share` of the head that its surface asks
/// for.
static double largest_rate_at_rest(Kernel kernel, double share)
{
    static float a[N][3], d[N];
    unsigned seed = 3;
    BackendSetup setup = random_water(3, 0, seed);
    setup.kernel = kernel;
    double h = setup.smoothing_length;
    for (int i = 0; i < N; i++) {
        place[i] = vec3(DP * (i % NX + 0.5), DP * (i / NX % NY + 0.5), DP * (i / (NX * NY) + 0.5));
        velocity[i] = vec3(0, 0, 0);
        double below = setup.level - place[i].z;
        double head = share * h * surface_head(below / h, surface_head_most(setup.kernel, 2));
        excess[i] = (float)hydrostatic_excess(below + head, 9.81, C0);
    }
    ParticleStart start = all_fluid(N);
    water_rates(&setup, &start, a, d);
    double largest = 0;
    for (int i = 0; i < N; i++)
        largest = maxd(largest, fabs((double)d[i]));
    return largest;
}

TEST(density_does_not_diffuse_from_the_surface_of_water_at_rest)
{
    for (int k = 0; k < 2; k++) {
        double left = largest_rate_at_rest((Kernel)k, 1),
               without = largest_rate_at_rest((Kernel)k, 0);
        printf("  %.2g 1/s, %.2g 1/s where the head is missing\n", left, without);
        CHECK(left < 0.1 * without);
    }
}

TEST(switched_off_effects_leave_no_trace_in_the_sums)
{
    static float a[2][N][3], d[2][N];
    for (int t = 0; t < 2; t++) {
        BackendSetup setup = random_water(3, 0, 7);
        setup.pair_mask = t ? 0 : setup.pair_mask;
        setup.alpha = setup.delta = 0;
        ParticleStart start = all_fluid(N);
        water_rates(&setup, &start, a[t], d[t]);
    }
    double worst = 0;
    for (int i = 0; i < N; i++)
        worst =
            maxd(worst, fabs((double)a[0][i][0] - a[1][i][0]) + fabs((double)d[0][i] - d[1][i]));
    CHECK_NEAR(worst, 0, 1e-3);
}
