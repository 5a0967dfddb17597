/// Probes against what they must read by hand.
#include "scenes.h"

#include "slamming.h"

/// A 2-D tank with a box, its centre at (x, z), that stays where it is put.
static Scene tank_with_box(double spacing, double x, double z)
{
    Scene scene = tank_2d(spacing);
    scene.body_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    box->size = vec3(0.4, 1, 0.2);
    box->position = vec3(x, 0, z);
    box->mass = 40;
    for (int f = 0; f < 6; f++)
        box->freedoms[f].kind = FREEDOM_FIXED;
    return scene;
}

static void add_pressure(Scene *scene, int body, Vec3 position, Vec3 normal, double patch)
{
    PressureProbeScene probe = {"p", body, position, normal, patch};
    scene->pressure_probes[scene->pressure_probe_count++] = probe;
}

static const Vec3 NO_NORMAL = {NAN, NAN, NAN};

TEST(a_pressure_point_moves_and_turns_with_its_body)
{
    Scene scene = tank_with_box(0.025, -0.5, 0);
    add_pressure(&scene, 0, vec3(0.5, 0, -0.2), NO_NORMAL, 0);
    Run *run = start(&scene, 1);
    Body *body = &run->state->bodies[0];
    const double weight = 1000 * 9.81;
    CHECK_NEAR(probe_pressure(&run->scene, run->state, 0), weight * 0.2, weight * 0.002);
    body->position.z -= 0.15;
    CHECK_NEAR(probe_pressure(&run->scene, run->state, 0), weight * 0.35, weight * 0.002);
    // bow down by 20 deg about the centre of gravity, which lies at the box's centre
    body->position.z += 0.15;
    body->attitude = quat_from_euler(0, 20 * PI / 180, 0);
    double depth = 0.5 * sin(20 * PI / 180) + 0.2 * cos(20 * PI / 180);
    CHECK_NEAR(probe_pressure(&run->scene, run->state, 0), weight * depth, weight * 0.002);
    finish(run);
}

/// Two spacings of water high above a layer, as spray has it.
TEST(a_gauge_reads_how_far_it_is_wet)
{
    Scene scene = tank_2d(0.025);
    scene.domain.max.z = 1.5;
    scene.fluid.block_count = 2;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-1, -0.5, -0.5), vec3(1, 0.5, -0.3)};
    scene.fluid.blocks[1] = (FluidBlock){vec3(0, -0.5, 1.2), vec3(1, 0.5, 1.25)};
    scene.gauge_count = 2;
    scene.gauges[0].x = -0.5; // under nothing
    scene.gauges[1].x = 0.5;  // under the drop, far below it
    Run *run = start(&scene, 1);
    CHECK_NEAR(probe_elevation(&run->scene, run->state, 0), -0.3, 0.05 * 0.025);
    CHECK_NEAR(probe_elevation(&run->scene, run->state, 1), -0.25, 0.2 * 0.025);
    finish(run);
    // a film on the bed, thinner than what counts as solid
    scene.fluid.blocks[0].max.z = -0.45;
    run = start(&scene, 1);
    CHECK_NEAR(probe_elevation(&run->scene, run->state, 0), -0.45, 0.2 * 0.025);
    CHECK_NEAR(probe_elevation(&run->scene, run->state, 1), -0.4, 0.3 * 0.025);
    finish(run);
}

TEST(a_normal_chooses_the_side_whose_water_counts)
{
    Scene scene = tank_2d(0.025);
    scene.domain.max.z = 0.5;
    scene.fluid.block_count = 2;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-1, -0.5, -0.5), vec3(0, 0.5, 0.3)};
    scene.fluid.blocks[1] = (FluidBlock){vec3(0, -0.5, -0.5), vec3(1, 0.5, -0.1)};
    add_pressure(&scene, -1, vec3(0, 0, -0.3), vec3(-1, 0, 0), 0);
    add_pressure(&scene, -1, vec3(0, 0, -0.3), vec3(2, 0, 0), 0);
    Run *run = start(&scene, 1);
    const double weight = 1000 * 9.81;
    CHECK_NEAR(probe_pressure(&run->scene, run->state, 0), weight * 0.6, weight * 0.005);
    CHECK_NEAR(probe_pressure(&run->scene, run->state, 1), weight * 0.2, weight * 0.005);
    finish(run);
}

TEST(a_patch_averages_over_its_disc_and_its_segment)
{
    // half of the patch is above the water, where there is no pressure
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        Scene scene = tank_2d(0.02);
        scene.domain.dimensions = dimensions;
        scene.domain.min = vec3(-0.4, -0.4, -0.5);
        scene.domain.max = vec3(0.4, 0.4, 0.5);
        add_pressure(&scene, -1, vec3(-0.4, 0, -0.25), vec3(1, 0, 0), 0.2);
        add_pressure(&scene, -1, vec3(0.2, 0, 0.3), vec3(0, 0, 1), 0.2);
        add_pressure(&scene, -1, vec3(0.1, 0, 0), vec3(1, 0, 0), 0.8);
        Run *run = start(&scene, 1);
        const double weight = 1000 * 9.81;
        CHECK_NEAR(probe_pressure(&run->scene, run->state, 0), weight * 0.25, weight * 0.002);
        CHECK(probe_pressure(&run->scene, run->state, 1) == 0);
        // disc of radius R: integral of depth over the lower half / pi R^2 = 2 R/(3 pi); segment:
        // R/4
        double mean = dimensions == 3 ? 2 * 0.4 / (3 * PI) : 0.4 / 4;
        CHECK_NEAR(probe_pressure(&run->scene, run->state, 2), weight * mean, weight * 0.006);
        finish(run);
    }
}

static double run_up(Run *run, Vec3 from, Vec3 to, int body)
{
    run->scene.run_ups[0] = (RunUpScene){"r", body, from, to};
    return probe_run_up(&run->scene, run->state, 0);
}

TEST(run_up_ends_where_the_water_ends_at_walls_and_in_the_open)
{
    const double dp = 0.02;
    Scene scene = tank_2d(dp);
    scene.domain.max.z = 0.7;
    scene.fluid.block_count = 2;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-1, -0.5, -0.5), vec3(-0.2, 0.5, 0.1)};
    scene.fluid.blocks[1] = (FluidBlock){vec3(0.1, -0.5, -0.5), vec3(0.4, 0.5, 0.1)};
    Run *run = start(&scene, 1);
    // along the bed, half a spacing above it, amid water, and up the wall
    CHECK_NEAR(run_up(run, vec3(-1, 0, -0.5), vec3(1, 0, -0.5), -1), 0.8, 0.3 * dp);
    CHECK_NEAR(run_up(run, vec3(-0.9, 0, -0.49), vec3(1, 0, -0.49), -1), 0.7, 0.3 * dp);
    CHECK_NEAR(run_up(run, vec3(-0.9, 0, -0.2), vec3(1, 0, -0.2), -1), 0.7, 0.3 * dp);
    CHECK_NEAR(run_up(run, vec3(-1, 0, -0.5), vec3(-1, 0, 0.7), -1), 0.6, 0.3 * dp);
    // from where it is dry, through a gap too wide, to the line's own end
    CHECK(run_up(run, vec3(0, 0, -0.3), vec3(0.4, 0, -0.3), -1) == 0);
    CHECK_NEAR(run_up(run, vec3(0.3, 0, -0.3), vec3(-1, 0, -0.3), -1), 0.2, 0.3 * dp);
    CHECK_NEAR(run_up(run, vec3(-0.9, 0, -0.2), vec3(-0.5, 0, -0.2), -1), 0.4, 1e-9);
    finish(run);
}

TEST(run_up_on_a_hull_follows_the_hull)
{
    Scene scene = tank_with_box(0.025, -0.5, 0);
    Run *run = start(&scene, 1);
    run->state->bodies[0].attitude = quat_from_euler(0, -30 * PI / 180, 0);
    // 0.5 ahead along axes that point 30 deg up; then along the body's own z until the surface
    Vec3 from = vec3(0.5, 0, -0.6), to = vec3(0.5, 0, 0.3);
    double begin = 0.5 * sin(30 * PI / 180) - 0.6 * cos(30 * PI / 180);
    CHECK_NEAR(run_up(run, from, to, 0), -begin / cos(30 * PI / 180), 0.3 * 0.025);
    finish(run);
}

TEST(green_water_is_counted_on_the_deck_and_in_its_columns)
{
    Scene scene = tank_with_box(0.02, 0, -0.2);
    scene.domain.max.z = 0.5;
    scene.fluid.block_count = 2;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-0.16, -0.5, -0.1), vec3(0.04, 0.5, 0.02)};
    scene.fluid.blocks[1] = (FluidBlock){vec3(-1, -0.5, -0.5), vec3(-0.6, 0.5, 0.3)};
    scene.green_water_count = 1;
    scene.green_waters[0] = (GreenWaterScene){"deck", 0, vec3(-0.2, 0, 0.1), vec3(0.2, 0, 0.6)};
    Run *run = start(&scene, 1);
    GreenWater water = probe_green_water(&run->scene, run->state, 0);
    CHECK_NEAR(water.volume, 0.2 * 0.12, 0.02 * 0.024);
    CHECK_NEAR(water.height, 0.12, 0.01 * 0.12);
    // half of the water lies ahead of a box that has moved aft with its deck
    run->state->bodies[0].position.x -= 0.26;
    water = probe_green_water(&run->scene, run->state, 0);
    CHECK_NEAR(water.volume, 0.1 * 0.12, 0.1 * 0.024);
    finish(run);
}

TEST(the_low_pass_is_butterworths_of_its_order)
{
    const double cutoff = 2, dt = 1e-4;
    for (int order = 1; order <= 4; order++)
        for (int octave = 0; octave <= 2; octave++) {
            FilterSection section[SLAMMING_SECTIONS] = {{0, 0}};
            double frequency = cutoff * (1 << octave), before = 0, largest = 0;
            for (double t = dt; t < 6; t += dt) {
                double input = sin(2 * PI * frequency * t);
                double low = slamming_low_pass(section, order, cutoff, before, input, dt);
                before = input;
                if (t > 5) largest = maxd(largest, fabs(low));
            }
            CHECK_NEAR(largest * sqrt(1 + pow(1 << octave, 2 * order)), 1, 0.005);
        }
}

TEST(slamming_is_what_is_neither_hydrostatic_nor_slow)
{
    Scene scene = tank_with_box(0.05, 0, -0.05);
    SlammingScene probe = {"slam", 0, 2, 2};
    Slamming slamming = {.begun = false};
    Run *run = start(&scene, 1);
    Body body = run->state->bodies[0];
    const BodyGeometry *geometry = &run->plan.bodies[0].geometry;
    // draft 0.15 m, then 0.10 m: the hydrostatic force goes with the pose
    for (int i = 0; i < 100; i++) {
        body.fluid_force = vec3(0, 0, 1000 * 9.81 * 0.4 * 0.15);
        slamming_advance(&slamming, &probe, &run->scene, &body, geometry, 0.001);
    }
    CHECK_NEAR(vec3_norm(slamming.force), 0, 1e-6);
    body.position.z += 0.05;
    body.fluid_force.z = 1000 * 9.81 * 0.4 * 0.10;
    slamming_advance(&slamming, &probe, &run->scene, &body, geometry, 0.001);
    CHECK_NEAR(vec3_norm(slamming.force), 0, 1e-6);
    // a blow is felt at once and forgotten when it lasts
    body.fluid_force = vec3_add(body.fluid_force, vec3(50, 0, 100));
    slamming_advance(&slamming, &probe, &run->scene, &body, geometry, 0.001);
    CHECK_NEAR(slamming.force.z, 100, 0.1);
    CHECK_NEAR(slamming.force.x, 50, 0.05);
    for (int i = 0; i < 2000; i++)
        slamming_advance(&slamming, &probe, &run->scene, &body, geometry, 0.001);
    CHECK_NEAR(slamming.force.z, 0, 0.1);
    finish(run);
}
