/// Only what a scene calls for: calls, bytes and clocks of what it does not.
#define _GNU_SOURCE // dladdr
#include "scenes.h"

#include <dlfcn.h>
#include <stdatomic.h>

#include "backend/cpu.h"

/// Calls into the files that tests/effects/CMakeLists.txt names, static functions included.
static atomic_int entered;
static const void *last_entered;

void __cyg_profile_func_enter(void *function, void *from);
void __cyg_profile_func_exit(void *function, void *from);
void __cyg_profile_func_enter(void *function, void *from)
{
    entered++;
    last_entered = function;
}
void __cyg_profile_func_exit(void *function, void *from) {}

static const char *last_name(void)
{
    Dl_info about;
    return last_entered && dladdr(last_entered, &about) && about.dli_sname ? about.dli_sname : "?";
}

/// What the arenas gave, and sets and lists of particles created.
static size_t bytes_of_effects;
static int sets, lists;

static bool belongs_to_an_effect(const char *what)
{
    static const char *const names[] = {"bodies",
                                        "loads",
                                        "poses",
                                        "centres",
                                        "lines",
                                        "slamming",
                                        "owners",
                                        "works",
                                        "references",
                                        "sites",
                                        "waves",
                                        "particles.correction",
                                        "particles.stress",
                                        "particles.shift",
                                        "particles.mirror"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(what, names[i])) return true;
    return false;
}

void *__real_arena_take(Arena *arena, size_t count, size_t size, const char *what, Error *e);
void *__wrap_arena_take(Arena *arena, size_t count, size_t size, const char *what, Error *e);
void *__wrap_arena_take(Arena *arena, size_t count, size_t size, const char *what, Error *e)
{
    if (belongs_to_an_effect(what)) bytes_of_effects += count * size;
    return __real_arena_take(arena, count, size, what, e);
}

bool __real_set_create(ParticleSet *set, const Grid *grid, int count, int kept, Arena *arena,
                       Error *e);
bool __wrap_set_create(ParticleSet *set, const Grid *grid, int count, int kept, Arena *arena,
                       Error *e);
bool __wrap_set_create(ParticleSet *set, const Grid *grid, int count, int kept, Arena *arena,
                       Error *e)
{
    sets++;
    return __real_set_create(set, grid, count, kept, arena, e);
}

bool __real_list_create(ClusterList *list, const ParticleSet *a, Arena *arena, Error *e);
bool __wrap_list_create(ClusterList *list, const ParticleSet *a, Arena *arena, Error *e);
bool __wrap_list_create(ClusterList *list, const ParticleSet *a, Arena *arena, Error *e)
{
    lists++;
    return __real_list_create(list, a, arena, e);
}

/// Plan, create, step, sample and draw a scene; @return the run, still alive
static Run *live(const Scene *scene)
{
    static double row[SERIES_COLUMNS_MAX];
    static SeriesTable table;
    Snapshot snapshot;
    entered = sets = lists = 0;
    bytes_of_effects = 0;
    Run *run = start(scene, 2);
    series_table(&run->scene, &table);
    for (int i = 0; i < 100; i++) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        series_sample(&run->scene, &run->plan, run->state, row);
    }
    CHECK(snapshot_create(&run->scene, &run->plan, &snapshot, &error));
    return run;
}

TEST(still_water_calls_nothing_of_waves_bodies_lines_or_probes)
{
    Scene scene = tank_2d(0.05);
    Run *run = live(&scene);
    if (entered) printf("  %d calls, the last of %s\n", entered, last_name());
    CHECK(entered == 0);
    finish(run);
}

TEST(still_water_keeps_no_byte_for_waves_bodies_lines_or_probes)
{
    Scene scene = tank_2d(0.05);
    Run *run = live(&scene);
    CHECK(bytes_of_effects == 0);
    CHECK(sets == 2);  // water and fixed walls
    CHECK(lists == 3); // of water with water, with walls and back
    for (int e = 0; e < EFFECT_COUNT; e++)
        if (!run->plan.effects[e].active) CHECK(run->plan.effects[e].bytes == 0);
    finish(run);
}

TEST(still_water_clocks_no_time_for_what_it_leaves_out)
{
    Scene scene = tank_2d(0.05);
    Run *run = live(&scene);
    // shares as if measured: small ones can be lost in what a busy machine does to the clock
    run->state->pair_cost[0] = run->state->pair_cost[1] = 0.1;
    CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
    const double *clock = run->state->backend->clocks(run->state->particles);
    static const BackendClock others[] = {CLOCK_EXTRAPOLATE_MOVING,
                                          CLOCK_GRADIENT,
                                          CLOCK_NO_SLIP,
                                          CLOCK_TURBULENCE,
                                          CLOCK_SHIFTING,
                                          CLOCK_LOADS,
                                          CLOCK_DUMMIES,
                                          CLOCK_RING,
                                          CLOCK_PISTON,
                                          CLOCK_ZONE,
                                          CLOCK_CONVEYOR,
                                          CLOCK_WORKS};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        CHECK(clock[others[i]] == 0);
    CHECK(clock[CLOCK_MOMENTUM] > 0);
    for (int e = 0; e < EFFECT_COUNT; e++) {
        bool active = run->plan.effects[e].active;
        CHECK(active == (e == EFFECT_VISCOSITY || e == EFFECT_DIFFUSION || e == EFFECT_WALLS));
        CHECK(active ? run->state->effect_seconds[e] > 0 : run->state->effect_seconds[e] == 0);
    }
    finish(run);
}

TEST(viscosity_and_diffusion_have_shares_of_their_sweeps)
{
    double largest[2] = {0, 0}; // of five starts: other work may hide one
    for (int k = 0; k < 5; k++) {
        Scene scene = tank_2d(0.05);
        Run *run = start(&scene, 2);
        for (int i = 0; i < 2; i++) {
            CHECK(run->state->pair_cost[i] >= 0 && run->state->pair_cost[i] < 1);
            largest[i] = maxd(largest[i], run->state->pair_cost[i]);
        }
        finish(run);
    }
    CHECK(largest[0] > 0.01 && largest[1] > 0.01);
}

TEST(what_is_called_for_is_called_kept_and_clocked)
{
    // the counters above count
    Scene scene = basin_2d(0.05);
    scene.waves.current.speed = 0.3;
    scene.body_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    box->size = vec3(0.4, 1, 0.3);
    box->position = vec3(0, 0, NAN);
    box->draft = 0.15;
    Run *run = live(&scene);
    CHECK(entered > 1000);
    CHECK(bytes_of_effects > 0 && sets == 3 && lists == 5);
    static const EffectId on[] = {EFFECT_RING,   EFFECT_ZONE,   EFFECT_MOVING_BOUNDARIES,
                                  EFFECT_BODIES, EFFECT_GAUGES, EFFECT_BODY_MOTION,
                                  EFFECT_CURRENT};
    for (size_t i = 0; i < sizeof on / sizeof *on; i++)
        CHECK(run->state->effect_seconds[on[i]] > 0);
    CHECK(run->state->effect_seconds[EFFECT_PISTON] == 0);
    CHECK(run->state->effect_seconds[EFFECT_BEACH] == 0);
    CHECK(run->state->effect_seconds[EFFECT_LINES] == 0);
    finish(run);
}
