// Pose, mass and balance of bodies from what a case gives.
#include "hull.h"
#include "test.h"

static Arena arena;
static Scene scene;

/// A free box 1 x 0.5 x 0.4 m in a 6 x 4 m tank, 2 m deep.
static BodyScene *start(void)
{
    memset(&scene, 0, sizeof scene);
    scene.domain.dimensions = 3;
    scene.domain.min = vec3(-3, -2, -2);
    scene.domain.max = vec3(3, 2, 0.5);
    scene.fluid.density = 1000;
    scene.fluid.gravity = 9.81;
    scene.body_count = 1;
    BodyScene *body = &scene.bodies[0];
    body->shape = BODY_BOX;
    body->size = vec3(1, 0.5, 0.4);
    body->scale = 1;
    body->position = vec3(0, 0, NAN);
    body->mass = body->draft = NAN;
    body->centre_of_gravity = body->radii_of_gyration = vec3(NAN, NAN, NAN);
    for (int k = 0; k < 6; k++)
        body->inertia[k] = NAN;
    return body;
}

static BodyGeometry create(void)
{
    BodyGeometry geometry = {0};
    Error error = {0};
    bool good = body_geometry_create(&scene, 0, &arena, &geometry, &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return geometry;
}

static void refuse(const char *part)
{
    BodyGeometry geometry = {0};
    Error error = {0};
    CHECK(!body_geometry_create(&scene, 0, &arena, &geometry, &error));
    CHECK(error.code == ERROR_INPUT);
    CHECK_CONTAINS(error.message, part);
    arena_destroy(&arena);
}

TEST(draft_gives_mass_and_height)
{
    start()->draft = 0.3;
    scene.fluid.level = 0.2;
    BodyGeometry g = create();
    CHECK_NEAR(g.mass, 150, 1e-9);
    CHECK_NEAR(g.origin.z, 0.2 - 0.3 + 0.2, 1e-12);
    CHECK_NEAR(g.hydrostatics.draft, 0.3, 1e-12);
    CHECK_NEAR(g.hydrostatics.displacement * 1000, g.mass, 1e-9);
    CHECK(g.floats);
    arena_destroy(&arena);
}

TEST(mass_gives_height)
{
    start()->mass = 120;
    BodyGeometry g = create();
    CHECK_NEAR(g.hydrostatics.draft, 0.24, 1e-10);
    CHECK_NEAR(g.mass, 120, 0);
    arena_destroy(&arena);
}

TEST(mass_gives_height_for_curved_and_heeled_hulls)
{
    for (int k = 1; k < 20; k++) {
        BodyScene *body = start();
        body->shape = k % 2 ? BODY_SPHERE : BODY_WIGLEY;
        body->radius = 0.5;
        body->size = vec3(2, 0.5, 0.4);
        body->draft_design = 0.25;
        body->attitude = vec3(0.1 * k, 0.05 * k, k);
        TriangleMesh mesh;
        CHECK(mesh_create(body, 3, "b", &arena, &mesh, NULL));
        body->mass = 1000 * mesh_properties(&mesh).volume * k / 20;
        BodyGeometry g = create();
        CHECK_NEAR(g.hydrostatics.displacement * 1000, g.mass, 1e-8 * g.mass);
        arena_destroy(&arena);
    }
}

TEST(height_with_mass_or_draft_is_taken_as_given)
{
    BodyScene *body = start();
    body->mass = 100;
    body->position.z = 0.1;
    BodyGeometry g = create();
    CHECK_NEAR(g.origin.z, 0.1, 0);
    body = start();
    body->draft = 0.2;
    body->position.z = 1; // dropped from above: the draft only says how heavy it is
    g = create();
    CHECK_NEAR(g.mass, 100, 1e-9);
    CHECK_NEAR(g.origin.z, 1, 0);
    CHECK(!g.floats);
    body = start();
    body->draft = 0.2;
    body->mass = 130;
    g = create();
    CHECK_NEAR(g.mass, 130, 0);
    CHECK_NEAR(g.hydrostatics.draft, 0.2, 1e-12);
    arena_destroy(&arena);
}

TEST(fixed_bodies_need_no_mass)
{
    BodyScene *body = start();
    body->position.z = -0.5;
    for (int k = 0; k < 6; k++)
        body->freedoms[k].kind = k == 2 ? FREEDOM_PRESCRIBED : FREEDOM_FIXED;
    BodyGeometry g = create();
    CHECK_NEAR(g.mass, 200, 1e-9);
    body->position.z = NAN;
    refuse("bodies[0].position_m");
    body = start();
    body->position.z = -0.5;
    refuse("bodies[0].mass_kg");
}

TEST(section_in_2d_weighs_per_metre_and_ignores_y)
{
    BodyScene *body = start();
    scene.domain.dimensions = 2;
    scene.domain.min.y = scene.domain.max.y = 0;
    body->draft = 0.3;
    body->position.y = NAN;
    for (int k = 1; k < 6; k += 2)
        body->freedoms[k].kind = FREEDOM_FIXED;
    BodyGeometry g = create();
    CHECK_NEAR(g.mass, 300, 1e-9);
    CHECK_NEAR(g.inertia[1][1], 300 * (1 + 0.16) / 12, 1e-9);
    arena_destroy(&arena);
}

TEST(balance_is_homogeneous_or_by_radii_or_as_given)
{
    BodyScene *body = start();
    body->draft = 0.2;
    BodyGeometry g = create();
    CHECK_NEAR(g.inertia[0][0], 100 * (0.25 + 0.16) / 12, 1e-9);
    CHECK_NEAR(vec3_norm(g.centre_of_gravity), 0, 1e-12);
    body->radii_of_gyration = vec3(0.1, 0.2, 0.3);
    body->centre_of_gravity = vec3(0.1, NAN, -0.05);
    g = create();
    CHECK_NEAR(g.inertia[0][0], 1, 1e-9);
    CHECK_NEAR(g.inertia[2][2], 9, 1e-9);
    CHECK_NEAR(g.centre_of_gravity.x, 0.1, 0);
    CHECK_NEAR(g.centre_of_gravity.y, 0, 1e-12);
    CHECK_NEAR(g.hydrostatics.trim_moment, 100 * 9.81 * 0.1, 1e-6); // heavy forward: bow goes down
    const double given[6] = {1, 2, 3, 0.1, 0.2, 0.3};
    memcpy(body->inertia, given, sizeof given);
    g = create();
    CHECK(g.inertia[0][1] == 0.1 && g.inertia[2][0] == 0.2 && g.inertia[1][2] == 0.3);
    body->inertia[3] = 1.5;
    refuse("bodies[0].inertia_kgm2");
    body->inertia[0] = NAN;
    body->radii_of_gyration.y = 0;
    refuse("bodies[0].radii_of_gyration_m");
}

TEST(impossible_numbers_are_refused_by_key)
{
    start()->mass = 250;
    refuse("bodies[0].mass_kg: 250; it cannot float: the closed hull displaces 200 kg");
    start()->mass = -1;
    refuse("bodies[0].mass_kg");
    start()->draft = 0.5;
    refuse("bodies[0].draft_m: 0.5; the body is 0.4 m high");
    start()->draft = 0;
    refuse("bodies[0].draft_m");
    start()->position.x = INFINITY;
    refuse("bodies[0].position_m");
}

TEST(bodies_outside_the_tank_are_refused_by_axis)
{
    start()->draft = 0.2;
    scene.bodies[0].position.x = 2.6;
    refuse("bodies[0].position_m: the body would reach from x 2.1 to 3.1 m; it must lie within x "
           "-3 to 3 m");
    start()->draft = 0.2;
    scene.bodies[0].position.y = -1.8;
    refuse("from y -2.05");
    start()->mass = 100;
    scene.bodies[0].position.z = -1.9;
    refuse("above the bed at z -2 m");
    start()->draft = 0.2;
    scene.bodies[0].initial_offset[0] = 2.9;
    refuse("bodies[0].initial_offset");
    BodyScene *body = start(); // touching a wall and sticking out of the top is allowed
    body->draft = 0.2;
    body->position = vec3(2.5, 0, 3);
    create();
    arena_destroy(&arena);
}
