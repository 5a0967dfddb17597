/// Bodies that touch: bed, walls and each other, without water.
#include "contact.h"

#include <stdlib.h>

#include "engine.h"
#include "test.h"

static Error error;

/// Boxes of 1 x 1 x 0.4 m in a tank of 6 x 4 m, bed at -1, spacing 0.1 m.
static Scene boxes(int count)
{
    Scene scene = scene_default();
    scene.domain.kind = DOMAIN_TANK;
    scene.domain.min = vec3(-3, -2, -1);
    scene.domain.max = vec3(3, 2, 1);
    scene.fluid.spacing = 0.1;
    scene.body_count = count;
    for (int b = 0; b < count; b++) {
        scene.bodies[b] = body_scene_default();
        snprintf(scene.bodies[b].name, sizeof scene.bodies[b].name, "box%d", b);
        scene.bodies[b].shape = BODY_BOX;
        scene.bodies[b].size = vec3(1, 1, 0.4);
        scene.bodies[b].mass = 200 + 100 * b;
        scene.bodies[b].position = vec3(1.5 * b, 0, 0);
    }
    return scene;
}

typedef struct Dry {
    Scene scene;
    Plan plan;
    Body bodies[3];
    double time;
} Dry;

static Dry *dry(Scene scene)
{
    Dry *run = calloc(1, sizeof *run);
    run->scene = scene;
    EngineOptions options = {.threads = 1, .backend = "cpu"};
    CHECK(plan_build(&run->scene, &options, &run->plan, &error));
    for (int b = 0; b < scene.body_count; b++)
        run->bodies[b] = body_create(&run->scene.bodies[b], &run->plan.bodies[b].geometry);
    return run;
}

static void dry_advance(Dry *run, double gravity, double until)
{
    double dt = run->plan.time_step;
    for (; run->time < until; run->time += dt) {
        contact_loads(&run->scene, &run->plan, run->bodies);
        for (int b = 0; b < run->scene.body_count; b++)
            body_advance(&run->bodies[b], &run->scene.bodies[b], gravity, run->time, dt);
    }
}

static void dry_end(Dry *run)
{
    plan_destroy(&run->plan);
    free(run);
}

static double lowest_corner(const Dry *run, int b)
{
    const TriangleMesh *mesh = &run->plan.bodies[b].geometry.mesh;
    double low = 1e9;
    for (int v = 0; v < mesh->vertex_count; v++)
        low = mind(low, body_point(&run->bodies[b], mesh->vertices[v]).z);
    return low;
}

TEST(a_tilted_box_that_falls_comes_to_lie_flat_on_the_bed)
{
    Scene scene = boxes(1);
    scene.bodies[0].initial_offset[3] = 0.2;
    scene.bodies[0].initial_offset[4] = 0.3;
    Dry *run = dry(scene);
    dry_advance(run, 9.81, 8);
    CHECK_NEAR(lowest_corner(run, 0), -1, 0.003);
    CHECK_NEAR(run->bodies[0].position.z, -0.8, 0.003);
    CHECK(vec3_norm(run->bodies[0].velocity) < 1e-3);
    CHECK(vec3_norm(run->bodies[0].angular_velocity) < 1e-3);
    dry_end(run);
}

TEST(a_body_that_runs_into_a_wall_turns_back_at_it)
{
    Scene scene = boxes(1);
    scene.bodies[0].initial_velocity[0] = 2;
    Dry *run = dry(scene);
    double farthest = 0;
    while (run->time < 3) {
        dry_advance(run, 0, run->time + run->plan.time_step);
        farthest = maxd(farthest, run->bodies[0].position.x);
    }
    CHECK_NEAR(farthest, 2.5, 0.25 * 0.1);
    CHECK_NEAR(run->bodies[0].velocity.x, -2.0 / 3, 0.1);
    dry_end(run);
}

TEST(boxes_that_meet_keep_their_momentum_and_do_not_pass_each_other)
{
    Scene scene = boxes(2);
    scene.bodies[1].initial_velocity[0] = -1;
    scene.bodies[1].initial_offset[1] = 0.3; // not head on: they turn
    Dry *run = dry(scene);
    double before = run->bodies[1].mass * -1, nearest = 1e9;
    while (run->time < 1.5) {
        dry_advance(run, 0, run->time + run->plan.time_step);
        nearest = mind(nearest, run->bodies[1].position.x - run->bodies[0].position.x);
        Vec3 sum = vec3_add(run->bodies[0].contact_force, run->bodies[1].contact_force);
        CHECK(vec3_norm(sum) < 1e-6);
    }
    double after = run->bodies[0].mass * run->bodies[0].velocity.x +
                   run->bodies[1].mass * run->bodies[1].velocity.x;
    CHECK_NEAR(after, before, 1e-6 * fabs(before));
    CHECK(nearest > 1 - 0.35 * 0.1);
    CHECK(run->bodies[0].velocity.x < -0.1);
    CHECK(run->bodies[1].velocity.x > run->bodies[0].velocity.x);
    CHECK(vec3_norm(run->bodies[0].angular_velocity) > 0.01);
    dry_end(run);
}

TEST(friction_stops_a_box_that_slides_on_the_bed)
{
    Scene scene = boxes(1);
    scene.bodies[0].position.z = -0.8;
    scene.bodies[0].initial_velocity[0] = 1;
    Dry *run = dry(scene);
    dry_advance(run, 9.81, 2);
    // v^2 / (2 mu g)
    CHECK_NEAR(run->bodies[0].position.x, 1 / (2 * 0.3 * 9.81), 0.02);
    CHECK(fabs(run->bodies[0].velocity.x) < 1e-3);
    dry_end(run);
}

TEST(contacts_that_nobody_can_make_are_left_out)
{
    Scene scene = boxes(1);
    CHECK(contact_possible(&scene));
    scene.contacts.kind = CONTACTS_NONE;
    CHECK(!contact_possible(&scene));
    scene.contacts.kind = CONTACTS_AUTO;
    for (int i = 0; i < 6; i++)
        scene.bodies[0].freedoms[i].kind = FREEDOM_FIXED;
    CHECK(!contact_possible(&scene));
}
