#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "bench_machine.h"
#include "engine.h"

typedef struct Bench {
    const BenchOptions *options;
    Scene scene;
    Plan plan;
    State *state;
    int64_t sorts_before; ///< the clock started
} Bench;

// ---- scenes -------------------------------------------------------------------------------------

/// An open tank of water at rest.
static void make_still(Scene *scene)
{
    scene->domain.min = vec3(-0.8, -0.65, -1);
    scene->domain.max = vec3(0.8, 0.65, 0.1);
}

/// The falling column of cases/dam_break.json without its obstacle: the tank of Kleefsman et al.
/// (2005), doi:10.1016/j.jcp.2004.12.007.
static void make_dam(Scene *scene)
{
    scene->domain.min = vec3(0, -0.5, 0);
    scene->domain.max = vec3(3.22, 0.5, 1);
    scene->fluid.alpha = 0.02;
    scene->fluid.block_count = 1;
    scene->fluid.blocks[0].min = vec3(1.992, -0.5, 0);
    scene->fluid.blocks[0].max = vec3(3.22, 0.5, 0.55);
}

static bool make_scene(const BenchOptions *options, double spacing, Scene *scene, Error *error)
{
    if (!strcmp(options->scene, "ship")) {
        char dp[48], ratio[48];
        snprintf(dp, sizeof dp, "fluid.spacing_m=%.17g", spacing);
        snprintf(ratio, sizeof ratio, "fluid.smoothing_ratio=%.17g", options->smoothing_ratio);
        const char *overrides[] = {dp, ratio};
        return scene_load(options->ship_case, overrides, 2, scene, error);
    }
    *scene = scene_default();
    snprintf(scene->name, sizeof scene->name, "%s", options->scene);
    if (!strcmp(options->scene, "dam"))
        make_dam(scene);
    else
        make_still(scene);
    scene->fluid.spacing = spacing;
    scene->fluid.smoothing_ratio = options->smoothing_ratio;
    return true;
}

// ---- spacing ------------------------------------------------------------------------------------

static int particles_of(const Plan *plan)
{
    return plan->fluid_count + plan->wall_count + plan->body_particle_count;
}

static bool plan_at(Bench *bench, double spacing, Error *error)
{
    EngineOptions engine = {.threads = bench->options->threads, .backend = "cpu"};
    plan_destroy(&bench->plan);
    TRY(make_scene(bench->options, spacing, &bench->scene, error));
    return plan_build(&bench->scene, &engine, &bench->plan, error);
}

/// The spacing whose plan comes nearest to the wanted number of particles. Their number jumps with
/// the spacing, a layer at a time, so the search is between a spacing that is too fine and one that
/// is too coarse.
static bool find_spacing(Bench *bench, Error *error)
{
    const double wanted = bench->options->particles, near_enough = 0.004;
    TRY(make_scene(bench->options, 0.1, &bench->scene, error));
    Vec3 size = vec3_sub(bench->scene.domain.max, bench->scene.domain.min);
    double spacing = cbrt(size.x * size.y * size.z / wanted);
    double fine = 0, coarse = INFINITY, best = NAN, smallest_error = INFINITY;
    for (int i = 0; i < 20 && smallest_error > near_enough; i++) {
        TRY(plan_at(bench, spacing, error));
        double count = particles_of(&bench->plan);
        if (fabs(count / wanted - 1) < smallest_error) {
            smallest_error = fabs(count / wanted - 1);
            best = spacing;
        }
        if (count > wanted)
            fine = spacing;
        else
            coarse = spacing;
        spacing *= cbrt(count / wanted);
        if (spacing <= fine || spacing >= coarse) spacing = sqrt(fine * coarse);
    }
    return best == bench->scene.fluid.spacing || plan_at(bench, best, error);
}

// ---- steps --------------------------------------------------------------------------------------

static struct rusage resources(void)
{
    struct rusage usage;
    memset(&usage, 0, sizeof usage);
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

static bool take_steps(Bench *bench, int steps, Error *error)
{
    for (int i = 0; i < steps; i++)
        TRY(step_advance(&bench->scene, &bench->plan, bench->state, error));
    return true;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/// Sorts its values.
static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, ascending);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

static const char *const PASS_NAMES[CLOCK_COUNT] = {
    [CLOCK_SORT] = "sort",
    [CLOCK_EXTRAPOLATE] = "extrapolate",
    [CLOCK_EXTRAPOLATE_MOVING] = "extrapolate_moving",
    [CLOCK_GRADIENT] = "gradient",
    [CLOCK_NO_SLIP] = "no_slip",
    [CLOCK_TURBULENCE] = "turbulence",
    [CLOCK_SHIFTING] = "shifting",
    [CLOCK_MOMENTUM] = "momentum",
    [CLOCK_DENSITY] = "density",
    [CLOCK_LOADS] = "loads",
    [CLOCK_DUMMIES] = "dummies",
    [CLOCK_RING] = "ring",
    [CLOCK_PISTON] = "piston",
    [CLOCK_INTEGRATE] = "integrate",
    [CLOCK_ZONE] = "zone",
    [CLOCK_WORKS] = "works",
};

/// Seconds of every pass so far: the backend's, then what bodies and lines take on the host.
static void read_passes(const State *state, double seconds[CLOCK_COUNT + 1])
{
    memcpy(seconds, state->backend->clocks(state->particles), CLOCK_COUNT * sizeof(double));
    seconds[CLOCK_COUNT] = state->host_seconds[EFFECT_BODY_MOTION] +
                           state->host_seconds[EFFECT_CONTACTS] + state->host_seconds[EFFECT_LINES];
}

static void note_passes(BenchReport *report, const double before[CLOCK_COUNT + 1],
                        const double after[CLOCK_COUNT + 1], double wall)
{
    report->pass_count = CLOCK_COUNT + 1;
    for (int p = 0; p <= CLOCK_COUNT; p++) {
        const char *name = p < CLOCK_COUNT ? PASS_NAMES[p] : "bodies_and_lines";
        report->passes[p].name = name ? name : "unnamed";
        report->passes[p].share = (after[p] - before[p]) / wall;
    }
}

/// Time of a group, and the clock of the cores after it.
static bool time_groups(Bench *bench, BenchReport *report, double *wall, Error *error)
{
    double clock[BENCH_GROUPS_MAX], *step = report->step;
    int groups = bench->options->steps / 10, steps = bench->options->steps;
    groups = groups < BENCH_GROUPS_LEAST ? BENCH_GROUPS_LEAST : groups;
    groups = groups > BENCH_GROUPS_MAX ? BENCH_GROUPS_MAX : groups;
    *wall = 0;
    for (int g = 0; g < groups; g++) {
        int count = steps * (g + 1) / groups - steps * g / groups;
        double start = bench_wall_clock();
        TRY(take_steps(bench, count, error));
        double seconds = bench_wall_clock() - start;
        *wall += seconds;
        step[g] = seconds / count;
        clock[g] = bench_core_clock(report->threads);
    }
    report->group_count = groups;
    report->step_mean = *wall / steps;
    report->step_median = median(step, groups);
    report->step_fastest = step[0];
    report->step_slowest = step[groups - 1];
    report->clock_median = median(clock, groups);
    report->clock_lowest = clock[0];
    report->clock_highest = clock[groups - 1];
    return true;
}

static bool time_steps(Bench *bench, BenchReport *report, Error *error)
{
    double before[CLOCK_COUNT + 1], after[CLOCK_COUNT + 1], wall;
    State *state = bench->state;
    TRY(take_steps(bench, bench->options->warm_up, error));
    BackendStatistics statistics;
    state->backend->statistics(state->particles, &statistics);
    bench->sorts_before = statistics.sorts;
    int roll_backs = state->health.recoveries;
    report->start_time = state->time;
    long preemptions = resources().ru_nivcsw;
    read_passes(state, before);
    TRY(time_groups(bench, report, &wall, error));
    read_passes(state, after);
    report->preemptions = resources().ru_nivcsw - preemptions;
    note_passes(report, before, after, wall);
    report->roll_backs = state->health.recoveries - roll_backs;
    report->time_step = state->time_step;
    report->courant = bench->plan.sound_speed * state->time_step / bench->plan.smoothing_length;
    return true;
}

// ---- counts -------------------------------------------------------------------------------------

BenchFlops bench_flops(void)
{
    // Operations of physics/pair.h and the two loops around it (backend/cpu_sweep.c), each
    // addition, multiplication, comparison, division and root counted as one, conversions and signs
    // as none.
    enum {
        DISTANCE = 8,  // three differences, three squares, two sums
        CLOSENESS = 4, // root, over 2h, 1 - that, max
        SLOPE = 2,     // closeness^3: bench's scenes have Wendland's kernel
        APPROACH = 8,  // v_ik . x_ik: three differences, three products, two sums
        VISCOUS = 5,   // min, product, r^2 + eta^2, division, sum with the pressures
        PUSH = 5,      // P_i + P_k, times the slope, times x_ik
        SPREAD = 1,    // D_k - D_i
        WEIGHED = 2,   // less (or plus) the approach, times the slope
    };
    BenchFlops flops;
    // three sums of i, three of k
    flops.fluid_momentum = DISTANCE + CLOSENESS + SLOPE + APPROACH + VISCOUS + PUSH + 3 + 3;
    flops.fluid_density = DISTANCE + CLOSENESS + SLOPE + APPROACH + SPREAD + 2 * WEIGHED + 1 + 1;
    // walls are not viscous, do not diffuse and feel nothing in these sums
    flops.dummy_momentum = DISTANCE + CLOSENESS + SLOPE + PUSH + 3;
    flops.dummy_density = DISTANCE + CLOSENESS + SLOPE + APPROACH + WEIGHED + 1;
    return flops;
}

/// Bytes of a particle that a step must read or write if every pass over the particles finds
/// nothing in the cache and every sweep reads a neighbour once: four bytes a value.
enum {
    // momentum: x v P read, a read and written (13 values); kick: a v read, v written (9); drift: x
    // v s read, x D written (11); density: x v D rate read, rate written (9); finish: x v s rate
    // read, x s P written (13); box sides and ids of clusters are below a value
    FLUID_TRAFFIC = 4 * (13 + 9 + 11 + 9 + 13),
    // extrapolation: x read, P written (4); momentum: x P (4); density: x v (6)
    DUMMY_TRAFFIC = 4 * (4 + 4 + 6),
};

static void count_work(const Bench *bench, BenchReport *report)
{
    BackendStatistics s;
    bench->state->backend->statistics(bench->state->particles, &s);
    BenchFlops flops = bench_flops();
    report->fluid_count = s.fluid_count;
    report->dummy_count = s.dummy_count;
    report->particle_count = particles_of(&bench->plan);
    report->neighbours_fluid = s.neighbours_fluid;
    report->neighbours_dummy = s.neighbours_dummy;
    report->neighbours_sample = s.sample;
    report->sorts = s.sorts - bench->sorts_before;
    report->list_bytes = s.list_bytes;
    report->pairs = s.fluid_count * (s.neighbours_fluid + s.neighbours_dummy);
    report->flops =
        s.fluid_count * (0.5 * s.neighbours_fluid * (flops.fluid_momentum + flops.fluid_density) +
                         s.neighbours_dummy * (flops.dummy_momentum + flops.dummy_density));
    // both sweeps read their lists
    report->traffic = (double)FLUID_TRAFFIC * s.fluid_count +
                      (double)DUMMY_TRAFFIC * s.dummy_count + 2.0 * (double)s.list_bytes;
}

static bool measure(Bench *bench, BenchReport *report, Error *error)
{
    if (!find_spacing(bench, error)) {
        Error why = *error;
        return error_set(error, why.code, "%d particles: %s", bench->options->particles,
                         why.message);
    }
    TRY(state_create(&bench->scene, &bench->plan, &bench->state, error));
    const State *state = bench->state;
    report->threads = bench->plan.options.threads;
    report->dimensions = bench->scene.domain.dimensions;
    report->spacing = bench->scene.fluid.spacing;
    report->smoothing_length = bench->plan.smoothing_length;
    snprintf(report->backend, sizeof report->backend, "%s", bench->plan.backend);
    snprintf(report->level, sizeof report->level, "%s", state->backend->variant());
    TRY(time_steps(bench, report, error));
    count_work(bench, report);
    report->state_bytes = state->arena.bytes;
    report->plan_bytes = bench->plan.arena.bytes;
    // before the bandwidth takes its own arrays; Linux counts in kilobytes
    report->peak_resident = (size_t)resources().ru_maxrss * 1024;
    return bench_machine_measure(report->threads, report->level, &report->machine, error);
}

bool bench_run(const BenchOptions *options, BenchReport *report, Error *error)
{
    _Static_assert((int)CLOCK_COUNT < (int)BENCH_PASSES_MAX, "every pass has its room");
    memset(report, 0, sizeof *report);
    Bench *bench = calloc(1, sizeof *bench);
    if (!bench) return error_set(error, ERROR_SYSTEM, "no memory left for the bench");
    bench->options = options;
    bool good = measure(bench, report, error);
    state_destroy(bench->state);
    plan_destroy(&bench->plan);
    free(bench);
    return good;
}
