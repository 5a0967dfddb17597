/// The speed of sound that a scene calls for, and what bodies that strike water ask of it.
#include "scenes.h"

static const double GRAVITY = 9.81;

/// A tank with a wedge of 30 deg deadrise, 0.8 m wide, its keel at `height` above still water.
static Scene wedge_over_water(double spacing, double height)
{
    Scene scene = tank_2d(spacing);
    scene.domain.min = vec3(-1.6, -0.5, -1);
    scene.domain.max = vec3(1.6, 0.5, 0.8);
    scene.body_count = 1;
    BodyScene *wedge = &scene.bodies[0];
    *wedge = body_scene_default();
    snprintf(wedge->name, sizeof wedge->name, "wedge");
    wedge->shape = BODY_POLYGON;
    wedge->breadth = 1;
    wedge->polygon_count = 3;
    wedge->polygon[1][0] = 0.4;
    wedge->polygon[2][0] = -0.4;
    wedge->polygon[1][1] = wedge->polygon[2][1] = 0.4 * tan(PI / 6);
    wedge->position = vec3(0, 0, height);
    wedge->mass = 50;
    for (int f = 0; f < 6; f++)
        wedge->freedoms[f].kind = f == 2 ? FREEDOM_FREE : FREEDOM_FIXED;
    return scene;
}

static double speed_of(const Scene *scene)
{
    Plan plan;
    EngineOptions options = {.threads = 1, .backend = "cpu"};
    CHECK(plan_build(scene, &options, &plan, &error));
    double speed = plan.sound_speed;
    plan_destroy(&plan);
    return speed / scene->fluid.sound_speed_ratio;
}

TEST(sound_outruns_the_water_that_a_falling_body_strikes)
{
    Scene scene = wedge_over_water(0.05, -0.1);
    double rest = sqrt(GRAVITY * 1);
    CHECK_NEAR(speed_of(&scene), rest, 1e-9); // it floats
    scene.bodies[0].position.z = 0.7;
    CHECK_NEAR(speed_of(&scene), 2 * sqrt(2 * GRAVITY * 0.7), 1e-9);
    scene.bodies[0].initial_velocity[2] = -3;
    CHECK_NEAR(speed_of(&scene), 2 * sqrt(9 + 2 * GRAVITY * 0.7), 1e-9);
    scene.bodies[0].freedoms[2].kind = FREEDOM_FIXED; // hung up
    scene.bodies[0].initial_velocity[2] = 0;
    CHECK_NEAR(speed_of(&scene), rest, 1e-9);
}

TEST(a_driven_body_asks_for_its_own_speed_in_the_water_and_for_twice_of_it_from_above)
{
    Scene scene = wedge_over_water(0.05, -0.1);
    Freedom *heave = &scene.bodies[0].freedoms[2];
    *heave = (Freedom){.kind = FREEDOM_PRESCRIBED, .amplitude = 3, .period = 3};
    double own = 2 * PI * 3 / 3;
    CHECK_NEAR(speed_of(&scene), own, 1e-9);
    scene.bodies[0].position.z = 0.02;
    CHECK_NEAR(speed_of(&scene), 2 * own, 1e-9);
    // it stands over a column of water beside it
    scene.fluid.block_count = 1;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-1.6, -0.5, -1), vec3(-1, 0.5, 0.3)};
    CHECK_NEAR(speed_of(&scene), own, 1e-9);
}

TEST(a_wedge_that_strikes_water_throws_jets_and_is_not_sick)
{
    Scene scene = wedge_over_water(0.02, 0.02);
    double speed = 6, mean = 0;
    int count = 0;
    // all but constant for 0.03 s
    scene.bodies[0].freedoms[2] =
        (Freedom){.kind = FREEDOM_PRESCRIBED, .amplitude = 3, .period = PI, .phase = PI};
    Run *run = start(&scene, 2);
    while (run->state->time < 0.03) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        double deep = speed * run->state->time - 0.02;
        if (deep < 0.06) continue;
        // force over rho V^3 t of the similarity solution: 14.14 (Zhao & Faltinsen 1993)
        mean += run->state->loads[0].force.z / (1000 * speed * speed * deep);
        count++;
    }
    mean /= count;
    printf("  force %.1f rho V^3 t, largest density error %.3f\n", mean,
           run->state->largest_density_error);
    CHECK(run->state->health.recoveries == 0);
    CHECK_NEAR(mean / 14.14, 1, 0.2);
    finish(run);
}
