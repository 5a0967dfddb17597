/// Whole scenes, small enough for every build: plans, commands, determinism, roll-back.
#include "energy.h"
#include "scenes.h"

TEST(still_water_plans_nothing_of_waves_bodies_or_lines)
{
    Scene scene = tank_2d(0.05);
    Run *run = start(&scene, 1);
    advance_to(run, 0.2);
    for (int e = 0; e < EFFECT_COUNT; e++) {
        bool needed = e == EFFECT_VISCOSITY || e == EFFECT_DIFFUSION || e == EFFECT_WALLS;
        CHECK(run->plan.effects[e].active == needed);
        CHECK(run->plan.effects[e].because[0] != 0);
        if (!needed) CHECK(run->plan.effects[e].bytes == 0 && run->state->effect_seconds[e] == 0);
    }
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
    WaveState untouched = *run->state->waves;
    CHECK(state_command(&run->scene, run->state, &command, &error));
    CHECK(run->state->waves->asked.height == 0.06);
    advance_to(run, run->state->time + 2 * run->plan.time_step);
    before = waves_displacement(&untouched, mean, run->state->time);
    after = waves_displacement(run->state->waves, mean, run->state->time);
    CHECK(vec3_norm(vec3_sub(before, after)) > 0);
    command.wave_height = 0.3;
    CHECK(!state_command(&run->scene, run->state, &command, &error));
    CHECK_CONTAINS(error.message, "0.2");
    CHECK(run->state->waves->asked.height == 0.06);
    finish(run);
}

/// Whether a plan warns of the lattice's brake.
static bool warns_of_drift(const Scene *scene)
{
    EngineOptions options = {.threads = 1, .backend = "cpu"};
    Plan plan;
    CHECK(plan_build(scene, &options, &plan, &error));
    bool told = strstr(plan.warnings, "body hull may drift") != NULL;
    CHECK(!strstr(plan.warnings, "; ")); // which parts warnings, on the page too
    plan_destroy(&plan);
    return told;
}

TEST(a_plan_warns_of_the_lattice_where_a_body_may_drift)
{
    Scene scene = tank_2d(0.05);
    scene.body_count = 1;
    scene.bodies[0] = body_scene_default();
    scene.bodies[0].size = vec3(0.4, 1, 0.3);
    scene.bodies[0].draft = 0.15;
    scene.bodies[0].position = vec3(0, 0, NAN);
    snprintf(scene.bodies[0].name, sizeof scene.bodies[0].name, "hull");
    CHECK(warns_of_drift(&scene));
    scene.fluid.gradient = GRADIENT_CORRECTED;
    CHECK(!warns_of_drift(&scene));
    scene.fluid.gradient = GRADIENT_PLAIN;
    scene.fluid.kernel = KERNEL_YIELDING;
    CHECK(!warns_of_drift(&scene));
    scene.fluid.kernel = KERNEL_WENDLAND;
    scene.bodies[0].freedoms[0].kind = FREEDOM_FIXED; // sway is fixed in a plane
    CHECK(!warns_of_drift(&scene));
}

TEST(a_plan_tells_its_kernel_and_water_at_rest_stays_under_either)
{
    for (int k = 0; k < 2; k++) {
        Scene scene = tank_2d(0.05);
        scene.fluid.kernel = (Kernel)k;
        scene.energy = ENERGY_LEVELS;
        Run *run = start(&scene, 1);
        CHECK_CONTAINS(run->plan.variant, k ? "yielding kernel" : "Wendland kernel");
        advance_to(run, 3);
        double speed = sqrt(2 * energy_levels(&run->scene, run->state).kinetic /
                            (run->plan.fluid_count * run->plan.particle_mass));
        printf("  %.2f mm/s rms after 3 s\n", 1000 * speed);
        CHECK(speed < 0.01);
        finish(run);
    }
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
    int id = -1;
    double x = NAN;
    CHECK(sscanf(run->state->health.message, "particle %d at (%lf", &id, &x) == 2);
    CHECK(id >= 0 && id < run->plan.fluid_count);
    CHECK(x >= scene.domain.min.x - 0.1 && x <= scene.domain.max.x + 0.1);
    CHECK(run->state->density_error < HEALTH_EXCESS_LIMIT);
    finish(run);
}

TEST(a_box_that_capsizes_turns_over_and_stays_good)
{
    Scene scene = tank_2d(0.04);
    scene.domain.min.z = -0.6;
    scene.domain.max.z = 0.4;
    scene.body_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    box->size = vec3(0.32, 1, 0.32);
    box->position = vec3(0, 0, -0.04);
    box->mass = 0.32 * 0.2 * 1000;
    box->centre_of_gravity = vec3(0, 0, 0.1); // GM -0.12 m
    box->initial_offset[4] = 5 * PI / 180;
    for (int f = 0; f < 6; f++)
        box->freedoms[f].kind = f == 0 || f == 2 || f == 4 ? FREEDOM_FREE : FREEDOM_FIXED;
    Run *run = start(&scene, 2);
    double most = 0;
    while (run->state->time < 2.5) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        most = maxd(most, fabs(body_motion(&run->state->bodies[0]).value[4]));
    }
    CHECK(most > 150 * PI / 180);
    CHECK(run->state->health.recoveries == 0);
    finish(run);
}
