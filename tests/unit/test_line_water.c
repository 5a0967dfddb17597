/// Lines in the simulated water: they feel its motion, others the incident wave's.
#include "scenes.h"

#include "line_water.h"

/// A column of water that falls in a closed tank, and a taut line across the floor where the front
/// arrives; 2-D.
static Scene dam(LineWater water)
{
    Scene scene = tank_2d(0.04);
    scene.fluid.block_count = 1;
    scene.fluid.blocks[0].min = vec3(-1, -0.5, -0.5);
    scene.fluid.blocks[0].max = vec3(-0.4, 0.5, 0.1);
    scene.domain.max.z = 0.6;
    scene.line_count = 1;
    LineScene *line = &scene.lines[0];
    *line = line_scene_default();
    snprintf(line->name, sizeof line->name, "rope");
    line->anchor.position = vec3(0.2, 0, -0.48);
    line->fairlead.position = vec3(0.2, 0, -0.2);
    line->length = 0.28;
    line->axial_stiffness = 1000;
    line->mass_per_length = 0.1;
    line->diameter = 0.01;
    line->segments = 8;
    line->water = water;
    return scene;
}

static double furthest_bend(LineWater water, bool *clocked)
{
    Scene scene = dam(water);
    Run *run = start(&scene, 1);
    double bend = 0;
    while (run->state->time < 0.6) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        for (int i = 0; i < run->state->lines[0].node_count; i++)
            bend = maxd(bend, run->state->lines[0].position[i].x - 0.2);
    }
    CHECK(run->plan.effects[EFFECT_LINE_WATER].active == (water == LINE_WATER_SPH));
    *clocked = run->state->host_seconds[EFFECT_LINE_WATER] > 0;
    finish(run);
    return bend;
}

TEST(a_line_in_simulated_water_is_carried_along_and_one_in_the_incident_water_is_not)
{
    bool clocked;
    double carried = furthest_bend(LINE_WATER_SPH, &clocked);
    CHECK(clocked);
    double still = furthest_bend(LINE_WATER_INCIDENT, &clocked);
    CHECK(!clocked);
    printf("  bend %.4f m in the simulated, %.2g m in the incident water\n", carried, still);
    CHECK(carried > 0.003 && still < 1e-6);
}

TEST(the_velocity_at_a_point_is_that_of_the_water_around_it)
{
    Scene scene = basin_2d(0.05);
    Run *run = start(&scene, 1);
    advance_to(run, 0.5);
    double share, worst = 0;
    for (int i = 0; i < 9; i++) {
        Vec3 at = vec3(-0.8 + 0.2 * i, 0, -0.25), velocity;
        run->state->backend->velocity(run->state->particles, at, &velocity, &share);
        Vec3 wave = waves_zone_velocity(run->state->waves, at, run->state->time);
        worst = maxd(worst, vec3_norm(vec3_sub(velocity, wave)) / vec3_norm(wave));
        CHECK(share > 0.9 && share < 1.1);
    }
    printf("  %.1f %% off the wave's own velocity at worst\n", 100 * worst);
    CHECK(worst < 0.25);
    Vec3 velocity;
    run->state->backend->velocity(run->state->particles, vec3(0, 0, 1), &velocity, &share);
    CHECK(share == 0 && vec3_norm(velocity) == 0);
    finish(run);
}
