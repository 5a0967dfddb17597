/// Particle shifting against all pairs in double, and what it does to waves and budgets.
#include "scenes.h"
#include "water_block.h"

#include "backend/cpu.h"
#include "energy.h"

enum { NX = 13, NY = 12, NZ = 11, N = NX * NY * NZ };
static const double COEFFICIENT = 2;
static Vec3 place[N], velocity[N];
static float excess[N];

/// A block of water in disorder on its own, some of it fast. @return how many particles
static int disorder(int dimensions, double speed)
{
    unsigned seed = 7;
    int count = dimensions == 2 ? NX * NZ : N;
    for (int i = 0; i < count; i++) {
        int at[3] = {i % NX, dimensions == 2 ? 0 : i / (NX * NZ), i / NX % NZ};
        double x[3], v[3];
        for (int a = 0; a < 3; a++) {
            x[a] = DP * (at[a] + 0.5 + 0.3 * (random_unit(&seed) - 0.5));
            v[a] = speed * (random_unit(&seed) - 0.5);
        }
        place[i] = vec3(x[0], dimensions == 2 ? 0 : x[1], x[2]);
        velocity[i] = vec3(v[0], dimensions == 2 ? 0 : v[1], v[2]);
        excess[i] = (float)(0.02 * random_unit(&seed));
    }
    return count;
}

static Backend *create(const BackendSetup *setup, int count, Arena *arena)
{
    ParticleStart begin = {.fluid_count = count,
                           .fluid_position = place,
                           .fluid_velocity = velocity,
                           .fluid_excess = excess};
    Backend *b = NULL;
    CHECK(backend_cpu()->create(setup, &begin, arena, &b, &error));
    return b;
}

static BackendSetup shifting_setup(int dimensions)
{
    BackendSetup s = water_setup(dimensions);
    s.pair_mask = PAIR_SHIFTING;
    s.shifting = COEFFICIENT;
    return s;
}

/// h grad C and tr(M)/d of particle i among `count`.
static Vec3 crowding(const BackendSetup *s, const Vec3 *x, int count, int i, double *fullness)
{
    double h = s->smoothing_length, v = s->particle_mass / s->rest_density, trace = 0;
    Vec3 sum = vec3(0, 0, 0);
    for (int k = 0; k < count; k++) {
        Vec3 d = vec3_sub(x[i], x[k]);
        double slope = kernel_slope_at(s->kernel, s->dimensions, h, vec3_norm(d));
        sum = vec3_sub(sum, vec3_scale(d, slope * v * h));
        trace += v * slope * vec3_dot(d, d);
    }
    *fullness = trace / s->dimensions;
    return sum;
}

/// u as the header says it.
static Vec3 reference(const BackendSetup *s, int count, int i)
{
    double fullness;
    Vec3 c = vec3_scale(crowding(s, place, count, i, &fullness), COEFFICIENT);
    double share = (fullness - 0.985) / 0.015, size = vec3_norm(c);
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    if (size > 0.1) c = vec3_scale(c, 0.1 / size);
    return vec3_scale(c, -share * vec3_norm(velocity[i]));
}

static void compare_with_all_pairs(Kernel kernel, int dimensions)
{
    int count = disorder(dimensions, 1), shifted = 0;
    BackendSetup s = shifting_setup(dimensions);
    s.kernel = kernel;
    Arena arena = arena_create(0);
    Backend *b = create(&s, count, &arena);
    CHECK(backend_cpu()->forces(b, NULL, NULL, &error));
    double off = 0, all = 0;
    for (int slot = 0; slot < b->fluid.cluster_count * CLUSTER; slot++) {
        if (b->fluid.id[slot] < 0) continue;
        Vec3 u = reference(&s, count, b->fluid.id[slot]);
        Vec3 found = vec3((double)b->fluid.shift[0][slot], (double)b->fluid.shift[1][slot],
                          (double)b->fluid.shift[2][slot]);
        Vec3 miss = vec3_sub(found, u);
        off += vec3_dot(miss, miss);
        all += vec3_dot(u, u);
        shifted += vec3_norm(u) > 0;
    }
    printf("  %d of %d shifted, rms error %.1e\n", shifted, count, sqrt(off / all));
    CHECK(shifted > count / 20 && shifted < count);
    CHECK(sqrt(off / all) < 5e-5);
    backend_cpu()->destroy(b);
    arena_destroy(&arena);
}

TEST(shifts_of_a_plane_are_those_over_all_pairs)
{
    compare_with_all_pairs(KERNEL_WENDLAND, 2);
    compare_with_all_pairs(KERNEL_YIELDING, 2);
}

TEST(shifts_in_space_are_those_over_all_pairs)
{
    compare_with_all_pairs(KERNEL_WENDLAND, 3);
    compare_with_all_pairs(KERNEL_YIELDING, 3);
}

TEST(water_at_rest_is_not_shifted)
{
    int count = disorder(2, 0);
    BackendSetup s = shifting_setup(2);
    Arena arena = arena_create(0);
    Backend *b = create(&s, count, &arena);
    CHECK(backend_cpu()->forces(b, NULL, NULL, &error));
    for (int slot = 0; slot < b->fluid.cluster_count * CLUSTER; slot++)
        for (int a = 0; a < 3; a++)
            CHECK(b->fluid.shift[a][slot] == 0);
    backend_cpu()->destroy(b);
    arena_destroy(&arena);
}

TEST(a_step_goes_by_velocity_and_shift)
{
    int count = disorder(2, 1);
    BackendSetup s = shifting_setup(2);
    Arena arena = arena_create(0);
    Backend *b = create(&s, count, &arena);
    Advance advance = {.dt = 1e-4};
    ParticleSums sums;
    double off = 0, all = 0;
    CHECK(backend_cpu()->forces(b, NULL, NULL, &error));
    backend_cpu()->advance(b, &advance, &sums);
    for (int slot = 0; slot < b->fluid.cluster_count * CLUSTER; slot++) {
        if (b->fluid.id[slot] < 0) continue;
        double x = to_metres(&b->grid, 0, *position_of(&b->fluid, 0, slot));
        double path = x - place[b->fluid.id[slot]].x;
        double u = (double)b->fluid.shift[0][slot];
        double miss = path / advance.dt - (double)*velocity_of(&b->fluid, 0, slot) - u;
        off += miss * miss;
        all += u * u;
    }
    CHECK(all > 0 && sqrt(off / all) < 5e-3); // positions are multiples of 2e-9 m
    backend_cpu()->destroy(b);
    arena_destroy(&arena);
}

TEST(lists_last_by_how_shifted_particles_part)
{
    int count = disorder(2, 1), beyond = 0;
    BackendSetup s = shifting_setup(2);
    Arena arena = arena_create(0);
    Backend *b = create(&s, count, &arena);
    Advance advance = {.dt = 1e-4};
    ParticleSums sums;
    CHECK(backend_cpu()->forces(b, NULL, NULL, &error));
    backend_cpu()->advance(b, &advance, &sums);
    for (int row = 0; row < b->grid.row_count; row++) {
        const VelocitySpan *span = &b->rows.span[row];
        for (int i = b->fluid.row_begin[row] * CLUSTER; i < b->fluid.row_begin[row + 1] * CLUSTER;
             i++)
            for (int a = 0; a < 3 && b->fluid.id[i] >= 0; a++) {
                float v = *velocity_of(&b->fluid, a, i), path = v + b->fluid.shift[a][i];
                CHECK(span->min[a] <= path && path <= span->max[a]);
                beyond += path == span->min[a] || path == span->max[a];
            }
    }
    CHECK(beyond > 0); // some are the outermost
    backend_cpu()->destroy(b);
    arena_destroy(&arena);
}

TEST(shifts_have_the_same_bits_for_any_number_of_threads)
{
    static float shift[2][2 * N];
    int count = disorder(3, 1), used = 0;
    for (int threads = 1; threads <= 2; threads++) {
        BackendSetup s = shifting_setup(3);
        s.threads = threads;
        Arena arena = arena_create(0);
        Backend *b = create(&s, count, &arena);
        CHECK(backend_cpu()->forces(b, NULL, NULL, &error));
        used = b->fluid.cluster_count * CLUSTER;
        CHECK(used <= 2 * N);
        memcpy(shift[threads - 1], b->fluid.shift[2], (size_t)used * sizeof(float));
        backend_cpu()->destroy(b);
        arena_destroy(&arena);
    }
    CHECK(!memcmp(shift[0], shift[1], (size_t)used * sizeof(float)));
}

/// What six periods leave of a standing wave.
typedef struct Outcome {
    double height; ///< of the last crest over the first [-]
    double rise;   ///< of the mean potential energy, as level, in spacings
} Outcome;

/// Mean h abs(grad C) of the water that no wall and no surface is near [-].
static double crowding_inside(Run *run)
{
    int count = run->plan.fluid_count, inner = 0;
    float(*x)[3] = malloc((size_t)count * sizeof *x);
    Vec3 *at = malloc((size_t)count * sizeof *at);
    double sum = 0;
    BackendSetup s = {.dimensions = 2,
                      .smoothing_length = run->plan.smoothing_length,
                      .particle_mass = run->plan.particle_mass,
                      .rest_density = RHO0};
    backend_cpu()->download(run->state->particles, x, NULL, NULL);
    for (int i = 0; i < count; i++)
        at[i] = vec3((double)x[i][0], (double)x[i][1], (double)x[i][2]);
    for (int i = 0; i < count; i++) {
        double fullness, size = vec3_norm(crowding(&s, at, count, i, &fullness));
        if (fullness < 0.985) continue;
        sum += size;
        inner++;
    }
    free(x);
    free(at);
    return sum / inner;
}

static double dam_break_crowding(double shifting)
{
    Scene scene = tank_2d(0.02);
    scene.domain.max = vec3(0.6, 0.5, 0.7);
    scene.fluid.alpha = 0.02;
    scene.fluid.shifting = shifting;
    scene.fluid.block_count = 1;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-1, -0.5, -0.5), vec3(-0.6, 0.5, 0.1)};
    Run *run = start(&scene, 2);
    double sum = 0;
    for (int k = 1; k <= 10; k++) {
        advance_to(run, 0.1 * k);
        sum += crowding_inside(run) / 10;
    }
    finish(run);
    return sum;
}
TEST(shifting_evens_what_a_dam_break_crowds)
{
    double plain = dam_break_crowding(0), shifted = dam_break_crowding(COEFFICIENT);
    printf("  crowding %.4f, shifted %.4f\n", plain, shifted);
    CHECK(shifted < 0.6 * plain);
}

/// Two standing waves of 2 m and 0.08 m.
static Scene wave_tank(double shifting)
{
    Scene scene = tank_2d(0.04);
    scene.fluid.shifting = shifting;
    scene.fluid.standing_height = 0.08;
    scene.fluid.standing_mode = 2;
    return scene;
}

static Outcome standing_wave(double shifting)
{
    Scene scene = wave_tank(shifting);
    scene.energy = ENERGY_LEVELS;
    Run *run = start(&scene, 2);
    double omega = sqrt(9.81 * PI * tanh(PI * 0.5)), period = 2 * PI / omega;
    double lift = 0, weight = run->plan.particle_mass * run->plan.fluid_count * 9.81, high = 0;
    for (int k = 1; k <= 40; k++) {
        advance_to(run, 5 * period + k * period / 40);
        lift += (energy_levels(&run->scene, run->state).potential -
                 run->state->energy_start.potential) /
                40;
        double z = backend_cpu()->elevation(run->state->particles, -0.96, 0);
        high = maxd(high, z);
    }
    Outcome o = {high / 0.04, 2 * lift / weight / 0.04};
    finish(run);
    return o;
}

TEST(shifting_leaves_a_standing_wave_its_level_and_takes_nothing_from_it)
{
    Outcome plain = standing_wave(0), shifted = standing_wave(COEFFICIENT);
    printf("  height left %.4f, shifted %.4f; level %.3f, %.3f spacings\n", plain.height,
           shifted.height, plain.rise, shifted.rise);
    CHECK(shifted.height > plain.height - 0.005);
    CHECK(fabs(shifted.rise) < 0.1);
}

TEST(the_budget_of_a_shifted_wave_closes_and_tells_what_shifting_lifted)
{
    Scene scene = wave_tank(COEFFICIENT);
    scene.energy = ENERGY_BUDGET;
    Run *run = start(&scene, 2);
    EnergyColumn column[ENERGY_COLUMNS_MAX];
    double largest = 0, lifted = 0;
    while (run->state->time < 4) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        int count = energy_columns(&run->scene, run->state, column);
        for (int i = 0; i < count; i++)
            if (!strcmp(column[i].name, "shifting_j")) lifted = column[i].value;
        largest = maxd(largest, fabs(column[count - 1].value));
    }
    printf("  shifting lifted by %.3f J, %.3f J unaccounted for at most\n", lifted, largest);
    CHECK(largest < 0.2 * fabs(lifted));
    finish(run);
}
