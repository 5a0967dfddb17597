/// Whole scenes, small enough for every build: hydrostatics, waves, floating, determinism,
/// roll-back.
#include "test.h"

#include <stdlib.h>

#include "engine.h"
#include "health.h"
#include "probes.h"

static Error error;

/// A scene in memory: 2-D tank 2 m long, 0.5 m deep.
static Scene tank_2d(double spacing)
{
    Scene scene = scene_default();
    scene.domain.kind = DOMAIN_TANK;
    scene.domain.dimensions = 2;
    scene.domain.min = vec3(-1, -0.5, -0.5);
    scene.domain.max = vec3(1, 0.5, 0.2);
    scene.fluid.spacing = spacing;
    return scene;
}

typedef struct Run {
    Scene scene;
    Plan plan;
    State *state;
} Run;

static Run *start(const Scene *scene, int threads)
{
    Run *run = calloc(1, sizeof *run);
    run->scene = *scene;
    EngineOptions options = {threads, "cpu", 0};
    bool good = plan_build(&run->scene, &options, &run->plan, &error) &&
                state_create(&run->scene, &run->plan, &run->state, &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return run;
}

static void advance_to(Run *run, double time)
{
    while (run->state->time < time)
        if (!step_advance(&run->scene, &run->plan, run->state, &error)) {
            printf("  %s\n", error.message);
            CHECK(false);
            return;
        }
}

static void finish(Run *run)
{
    state_destroy(run->state);
    plan_destroy(&run->plan);
    free(run);
}

/// rms difference from hydrostatic pressure over rho g d, and the kinetic energy [J].
static double pressure_error(Run *run, double *energy)
{
    Snapshot snapshot;
    CHECK(snapshot_create(&run->scene, &run->plan, &snapshot, &error));
    snapshot_take(&run->scene, &run->plan, run->state, &snapshot);
    double sum = 0, depth = -run->scene.domain.min.z, scale = 1000 * 9.81 * depth;
    *energy = 0;
    for (int i = 0; i < snapshot.fluid_count; i++) {
        double d = snapshot.pressure[i] + 1000 * 9.81 * (double)snapshot.position[i][2];
        sum += d * d;
        for (int a = 0; a < 3; a++)
            *energy +=
                0.5 * run->plan.particle_mass * snapshot.velocity[i][a] * snapshot.velocity[i][a];
    }
    double rms = sqrt(sum / snapshot.fluid_count) / scale;
    snapshot_destroy(&snapshot);
    return rms;
}

TEST(still_water_keeps_its_hydrostatic_pressure_and_comes_to_rest)
{
    Scene scene = tank_2d(0.025);
    scene.gauge_count = 1;
    scene.gauges[0].x = 0.3;
    Run *run = start(&scene, 2);
    double early, late;
    advance_to(run, 0.5);
    pressure_error(run, &early);
    advance_to(run, 5);
    CHECK_NEAR(pressure_error(run, &late), 0, 0.01);
    CHECK(late < 0.5 * early);
    CHECK_NEAR(probe_elevation(&run->scene, run->state, 0), 0, 0.1 * 0.025);
    CHECK(run->state->health.recoveries == 0);
    finish(run);
}

TEST(still_water_plans_nothing_of_waves_bodies_or_lines)
{
    Scene scene = tank_2d(0.05);
    Run *run = start(&scene, 1);
    advance_to(run, 0.2);
    for (int e = 0; e < EFFECT_COUNT; e++) {
        bool needed = e == EFFECT_VISCOSITY || e == EFFECT_DIFFUSION || e == EFFECT_WALLS;
        CHECK(run->plan.effects[e].active == needed);
        CHECK(run->plan.effects[e].because[0] != 0);
        if (!needed) CHECK(run->plan.effects[e].bytes == 0 && run->state->effect_seconds[e] < 1e-4);
    }
    finish(run);
}

TEST(a_floating_section_rests_at_its_hydrostatic_draft)
{
    Scene scene = tank_2d(0.025);
    scene.body_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    snprintf(box->name, sizeof box->name, "box");
    box->shape = BODY_BOX;
    box->size = vec3(0.5, 1, 0.3);
    box->position = vec3(0, 0, NAN);
    box->draft = 0.15;
    box->freedoms[1].kind = box->freedoms[3].kind = box->freedoms[5].kind = FREEDOM_FIXED;
    Run *run = start(&scene, 2);
    advance_to(run, 6);
    double heave = 0;
    int samples = 0;
    // averaged over the last of the ringing
    for (double t = 6; t < 9; t += 0.1, samples++) {
        advance_to(run, t);
        heave += body_motion(&run->state->bodies[0]).value[2];
    }
    CHECK_NEAR(heave / samples, 0, 0.5 * 0.025);
    CHECK_NEAR(body_motion(&run->state->bodies[0]).value[4], 0, 0.02);
    finish(run);
}

static Scene basin_2d(double spacing)
{
    Scene scene = tank_2d(spacing);
    scene.domain.kind = DOMAIN_BASIN;
    scene.domain.min = vec3(-2.2, -0.5, -0.6);
    scene.domain.max = vec3(2.2, 0.5, 0.25);
    scene.waves.kind = WAVES_REGULAR;
    scene.waves.initial = (WaveTarget){0.12, 1.0, 0};
    scene.waves.start = WAVE_START_HOT;
    scene.waves.height_limits = (Range){0, 0.2};
    scene.waves.period_limits = (Range){0.8, 1.1};
    scene.waves.heading_limits = (Range){0, 2 * PI};
    scene.gauge_count = 1;
    return scene;
}

TEST(a_basin_keeps_the_height_it_is_asked_for)
{
    Scene scene = basin_2d(0.025);
    Run *run = start(&scene, 2);
    double low = 1, high = -1;
    advance_to(run, 4);
    while (run->state->time < 6) {
        advance_to(run, run->state->time + 0.02);
        double z = probe_elevation(&run->scene, run->state, 0);
        low = z < low ? z : low;
        high = z > high ? z : high;
    }
    CHECK_NEAR((high - low) / 0.12, 1, 0.05);
    CHECK(run->state->largest_density_error < 0.015);
    CHECK(run->state->health.recoveries == 0);
    finish(run);
}

TEST(a_command_moves_the_ring_within_one_step)
{
    Scene scene = basin_2d(0.05);
    Run *run = start(&scene, 1);
    advance_to(run, 0.5);
    Command command = command_default();
    command.wave_height = 0.06;
    Vec3 mean = vec3(-2.2, 0, -0.1), before, after;
    WaveState untouched = run->state->waves;
    CHECK(state_command(&run->scene, run->state, &command, &error));
    CHECK(run->state->waves.asked.height == 0.06);
    advance_to(run, run->state->time + 2 * run->plan.time_step);
    before = waves_displacement(&untouched, mean, run->state->time);
    after = waves_displacement(&run->state->waves, mean, run->state->time);
    CHECK(vec3_norm(vec3_sub(before, after)) > 0);
    command.wave_height = 0.3;
    CHECK(!state_command(&run->scene, run->state, &command, &error));
    CHECK_CONTAINS(error.message, "0.2");
    CHECK(run->state->waves.asked.height == 0.06);
    finish(run);
}

TEST(thread_counts_give_the_same_bits)
{
    double row[2][64];
    for (int t = 0; t < 2; t++) {
        Scene scene;
        char path[] = SOURCE_DIR "/cases/moored_ship_draft.json";
        CHECK(scene_load(path, NULL, 0, &scene, &error));
        Run *run = start(&scene, t ? 3 : 1);
        advance_to(run, 0.15);
        SeriesTable *table = calloc(1, sizeof *table);
        series_table(&run->scene, table);
        CHECK(table->count < 64);
        series_sample(&run->scene, &run->plan, run->state, row[t]);
        CHECK(!t || !memcmp(row[0], row[1], (size_t)table->count * sizeof(double)));
        free(table);
        finish(run);
    }
}

TEST(a_sick_step_is_rolled_back_and_tried_with_a_smaller_one)
{
    Scene scene = tank_2d(0.05);
    Run *run = start(&scene, 1);
    advance_to(run, 0.3);
    double step = run->state->time_step;
    // four times the stable step: acoustic blow-up until health halves it often enough
    run->state->time_step = 4 * step;
    for (int i = 0; i < 300; i++)
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
    CHECK(run->state->health.status == HEALTH_RECOVERED);
    CHECK(run->state->health.recoveries > 0);
    CHECK_CONTAINS(run->state->health.message, "limit");
    CHECK(run->state->density_error < HEALTH_EXCESS_LIMIT);
    finish(run);
}
