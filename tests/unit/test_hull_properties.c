// Shapes, volume integrals and hydrostatics against exact values.
#include "hull.h"
#include "test.h"

#include <stdlib.h>

static const double DENSITY = 1000, GRAVITY = 9.81;

static Arena arena;

static TriangleMesh make(const BodyScene *body, int dimensions)
{
    TriangleMesh mesh = {0};
    Error error = {0};
    bool good = mesh_create(body, dimensions, "bodies[0]", &arena, &mesh, &error) &&
                mesh_check(&mesh, "bodies[0]", &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return mesh;
}

static TriangleMesh make_box(double x, double y, double z)
{
    BodyScene body = {.shape = BODY_BOX, .size = {x, y, z}};
    return make(&body, 3);
}

static Hydrostatics hydrostatics(const TriangleMesh *mesh, Vec3 origin, Quat attitude, Vec3 gravity)
{
    const double inertia[3][3] = {{2, 0, 0}, {0, 5, 0}, {0, 0, 6}};
    return mesh_hydrostatics(mesh, origin, attitude, gravity, 50, inertia, 0, DENSITY, GRAVITY);
}

TEST(box_volume_centroid_and_inertia_are_exact)
{
    TriangleMesh box = make_box(1, 2, 3);
    MeshProperties p = mesh_properties(&box);
    CHECK_NEAR(p.volume, 6, 1e-12);
    CHECK_NEAR(p.area, 22, 1e-12);
    CHECK_NEAR(vec3_norm(p.centroid), 0, 1e-12);
    CHECK_NEAR(p.inertia[0], 6 * (4 + 9) / 12.0, 1e-12);
    CHECK_NEAR(p.inertia[1], 6 * (1 + 9) / 12.0, 1e-12);
    CHECK_NEAR(p.inertia[2], 6 * (1 + 4) / 12.0, 1e-12);
    CHECK_NEAR(fabs(p.inertia[3]) + fabs(p.inertia[4]) + fabs(p.inertia[5]), 0, 1e-12);
    arena_destroy(&arena);
}

TEST(products_of_inertia_of_a_turned_box_follow_the_tensor_rule)
{
    TriangleMesh box = make_box(1, 2, 3);
    Quat q = quat_from_euler(0.3, -0.7, 1.1);
    for (int i = 0; i < box.vertex_count; i++)
        box.vertices[i] = vec3_add(quat_rotate(q, box.vertices[i]), vec3(5, -3, 2));
    MeshProperties p = mesh_properties(&box);
    double full[3][3] = {{p.inertia[0], p.inertia[3], p.inertia[4]},
                         {p.inertia[3], p.inertia[1], p.inertia[5]},
                         {p.inertia[4], p.inertia[5], p.inertia[2]}};
    double moments[3] = {6.5, 5, 2.5};
    Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 3; k++) { // I e = lambda e for every turned axis
        Vec3 e = quat_rotate(q, axes[k]);
        CHECK_NEAR(full[0][0] * e.x + full[0][1] * e.y + full[0][2] * e.z, moments[k] * e.x, 1e-10);
        CHECK_NEAR(full[1][0] * e.x + full[1][1] * e.y + full[1][2] * e.z, moments[k] * e.y, 1e-10);
        CHECK_NEAR(full[2][0] * e.x + full[2][1] * e.y + full[2][2] * e.z, moments[k] * e.z, 1e-10);
    }
    CHECK_NEAR(p.centroid.x, 5, 1e-12);
    arena_destroy(&arena);
}

TEST(sphere_and_cylinders_come_within_three_thousandths)
{
    BodyScene sphere = {.shape = BODY_SPHERE, .radius = 0.5};
    TriangleMesh mesh = make(&sphere, 3);
    MeshProperties p = mesh_properties(&mesh);
    double exact = 4 * PI / 3 * 0.125;
    CHECK_NEAR(p.volume, exact, 0.003 * exact);
    CHECK_NEAR(p.inertia[0], 0.4 * exact * 0.25, 0.006 * 0.4 * exact * 0.25);
    for (int i = 0; i < mesh.vertex_count; i++)
        if (fabs(vec3_norm(mesh.vertices[i]) - 0.5) > 1e-12) CHECK(!"vertex off the sphere");
    for (int axis = 0; axis < 3; axis++) {
        BodyScene cylinder = {.shape = BODY_CYLINDER, .radius = 0.3, .length = 2, .axis = axis};
        mesh = make(&cylinder, 3);
        p = mesh_properties(&mesh);
        CHECK_NEAR(p.volume, PI * 0.09 * 2, 0.003 * PI * 0.18);
        double length[3] = {p.max.x - p.min.x, p.max.y - p.min.y, p.max.z - p.min.z};
        CHECK_NEAR(length[axis], 2, 1e-12);
        CHECK_NEAR(length[(axis + 1) % 3], 0.6, 1e-12);
    }
    arena_destroy(&arena);
}

TEST(wigley_hull_has_the_volume_and_waterplane_of_its_formula)
{
    double length = 3, beam = 0.3, draft = 0.1875, depth = 0.25;
    BodyScene body = {.shape = BODY_WIGLEY, .size = {length, beam, depth}, .draft_design = draft};
    TriangleMesh mesh = make(&body, 3);
    Hydrostatics h = hydrostatics(&mesh, vec3(0, 0, -draft), quat(1, 0, 0, 0), vec3(0, 0, draft));
    double volume = 4.0 / 9 * length * beam * draft, area = 2.0 / 3 * length * beam;
    CHECK_NEAR(h.draft, draft, 1e-12);
    CHECK_NEAR(h.displacement, volume, 0.002 * volume);
    CHECK_NEAR(h.waterplane_area, area, 0.001 * area);
    CHECK_NEAR(h.centre_of_buoyancy.x, 0, 1e-9);
    CHECK_NEAR(h.centre_of_buoyancy.y, 0, 1e-9);
    CHECK_NEAR(h.centre_of_buoyancy.z, draft * (1 - 3.0 / 8), 0.002 * draft);
    // I_T = 2/3 (B/2)^3 L int_0^1 (1 - s^2)^3 ds, int = 16/35
    double second = 2.0 / 3 * pow(beam / 2, 3) * length * 16 / 35;
    CHECK_NEAR(h.gm_transverse, second / volume - 3.0 / 8 * draft, 0.004 * second / volume);
    double whole = volume + area * (depth - draft);
    CHECK_NEAR(mesh_properties(&mesh).volume, whole, 0.002 * whole);
    arena_destroy(&arena);
}

TEST(wigley_without_freeboard_is_closed_too)
{
    BodyScene body = {.shape = BODY_WIGLEY, .size = {3, 0.3, 0.2}, .draft_design = 0.2};
    TriangleMesh mesh = make(&body, 3);
    CHECK_NEAR(mesh_properties(&mesh).volume, 4.0 / 9 * 3 * 0.3 * 0.2, 2e-4);
    arena_destroy(&arena);
}

TEST(polygons_of_any_winding_and_dents_enclose_their_area)
{
    // an L-shaped section, collinear and repeated corners included; area 3
    static const double corners[9][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 1},
                                         {1, 1}, {1, 2}, {0, 2}, {0, 0}};
    for (int winding = 0; winding < 2; winding++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            BodyScene body = {.shape = BODY_POLYGON, .breadth = 0.5, .polygon_count = 9};
            for (int k = 0; k < 9; k++)
                memcpy(body.polygon[winding ? 8 - k : k], corners[k], sizeof corners[k]);
            TriangleMesh mesh = make(&body, dimensions);
            MeshProperties p = mesh_properties(&mesh);
            CHECK_NEAR(p.volume, dimensions == 2 ? 3 : 1.5, 1e-12);
            CHECK_NEAR(p.centroid.x, 2.5 / 3, 1e-12);
            CHECK_NEAR(p.centroid.z, 2.5 / 3, 1e-12);
            CHECK_NEAR(p.centroid.y, 0, 1e-12);
        }
    arena_destroy(&arena);
}

TEST(senseless_shapes_are_refused_by_key)
{
    BodyScene bow_tie = {.shape = BODY_POLYGON,
                         .breadth = 1,
                         .polygon_count = 4,
                         .polygon = {{0, 0}, {1, 1}, {1, 0}, {0, 1}}};
    BodyScene line = {.shape = BODY_POLYGON,
                      .breadth = 1,
                      .polygon_count = 3,
                      .polygon = {{0, 0}, {1, 1}, {2, 2}}};
    BodyScene box = {.shape = BODY_BOX, .size = {1, 0, 1}};
    BodyScene sphere = {.shape = BODY_SPHERE, .radius = NAN};
    BodyScene cylinder = {.shape = BODY_CYLINDER, .radius = 1, .length = 1, .axis = 3};
    BodyScene wigley = {.shape = BODY_WIGLEY, .size = {3, 0.3, 0.1}, .draft_design = 0.2};
    BodyScene ball = {.shape = BODY_SPHERE, .radius = 1};
    const struct {
        const BodyScene *body;
        int dimensions;
        const char *key;
    } cases[] = {{&bow_tie, 3, "bodies[7].points_m"}, {&line, 3, "bodies[7].points_m"},
                 {&box, 3, "bodies[7].size_m[1]"},    {&sphere, 3, "bodies[7].radius_m"},
                 {&cylinder, 3, "bodies[7].axis"},    {&wigley, 3, "bodies[7].draft_design_m"},
                 {&ball, 2, "bodies[7].shape"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        TriangleMesh mesh;
        Error error = {0};
        CHECK(!mesh_create(cases[i].body, cases[i].dimensions, "bodies[7]", &arena, &mesh, &error));
        CHECK(error.code == ERROR_INPUT);
        CHECK_CONTAINS(error.message, cases[i].key);
    }
    arena_destroy(&arena);
}

TEST(floating_box_has_textbook_hydrostatics)
{
    TriangleMesh box = make_box(2, 1, 0.5);
    double draft = 0.3, density_mass = DENSITY * 2 * 1 * draft;
    const double inertia[3][3] = {{80, 0, 0}, {0, 250, 0}, {0, 0, 300}};
    // 0.7 rad of yaw changes nothing; the centre of gravity lies 0.05 m above the keel's middle
    Hydrostatics h =
        mesh_hydrostatics(&box, vec3(3, -1, 5 - draft + 0.25), quat_from_euler(0, 0, 0.7),
                          vec3(0, 0, -0.2), density_mass, inertia, 5, DENSITY, GRAVITY);
    double bm_transverse = 1.0 / 12 / draft, bm_longitudinal = 4.0 / 12 / draft, arm = 0.15 - 0.05;
    CHECK_NEAR(h.draft, draft, 1e-12);
    CHECK_NEAR(h.displacement, 2 * draft, 1e-12);
    CHECK_NEAR(h.waterplane_area, 2, 1e-12);
    CHECK_NEAR(h.centre_of_buoyancy.z, -0.25 + draft / 2, 1e-12);
    CHECK_NEAR(h.gm_transverse, arm + bm_transverse, 1e-12);
    CHECK_NEAR(h.gm_longitudinal, arm + bm_longitudinal, 1e-12);
    CHECK_NEAR(h.heave_period, 2 * PI * sqrt(draft / GRAVITY), 1e-12);
    CHECK_NEAR(h.roll_period, 2 * PI * sqrt(80 / (density_mass * GRAVITY * h.gm_transverse)),
               1e-10);
    CHECK_NEAR(h.pitch_period, 2 * PI * sqrt(250 / (density_mass * GRAVITY * h.gm_longitudinal)),
               1e-10);
    CHECK_NEAR(h.trim_moment, 0, 1e-9);
    CHECK_NEAR(h.heel_moment, 0, 1e-9);
    arena_destroy(&arena);
}

TEST(half_sunk_sphere_and_cylinder_have_their_metacentre_at_their_centre)
{
    BodyScene sphere = {.shape = BODY_SPHERE, .radius = 0.5};
    TriangleMesh mesh = make(&sphere, 3);
    Hydrostatics h = hydrostatics(&mesh, vec3(0, 0, 0), quat(1, 0, 0, 0), vec3(0, 0, -0.1));
    CHECK_NEAR(h.displacement, 2 * PI / 3 * 0.125, 0.003 * 0.26);
    CHECK_NEAR(h.centre_of_buoyancy.z, -0.5 * 3 / 8, 1e-3);
    CHECK_NEAR(h.gm_transverse, 0.1, 1e-3);
    CHECK_NEAR(h.gm_longitudinal, 0.1, 1e-3);
    BodyScene cylinder = {.shape = BODY_CYLINDER, .radius = 0.2, .length = 1, .axis = 0};
    mesh = make(&cylinder, 3);
    h = hydrostatics(&mesh, vec3(0, 0, 0.05), quat(1, 0, 0, 0), vec3(0, 0, 0));
    CHECK_NEAR(h.gm_transverse, 0, 1e-3);
    arena_destroy(&arena);
}

TEST(dry_and_sunk_bodies_have_no_waterplane)
{
    TriangleMesh box = make_box(1, 1, 1);
    Hydrostatics dry = hydrostatics(&box, vec3(0, 0, 3), quat(1, 0, 0, 0), vec3(0, 0, 0));
    CHECK_NEAR(dry.draft, -2.5, 1e-12);
    CHECK(dry.displacement == 0 && isnan(dry.heave_period) && isnan(dry.roll_period));
    Hydrostatics sunk =
        hydrostatics(&box, vec3(0, 0, -3), quat_from_euler(0.4, 0.2, 0), vec3(0, 0, -0.1));
    CHECK_NEAR(sunk.displacement, 1, 1e-12);
    CHECK_NEAR(sunk.waterplane_area, 0, 1e-12);
    CHECK(isnan(sunk.heave_period) && sunk.roll_period > 0);
    arena_destroy(&arena);
}

static double random_number(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (1 << 24) * 2 - 1;
}

/// Potential energy of water and body: rho g (moment of the displaced water about the level, upside
/// down); its gradient is minus force and moment.
static double energy(const TriangleMesh *mesh, Vec3 centre, Quat attitude, Vec3 gravity_centre)
{
    Vec3 origin = vec3_sub(centre, quat_rotate(attitude, gravity_centre));
    Hydrostatics h = hydrostatics(mesh, origin, attitude, gravity_centre);
    Vec3 buoyancy = vec3_add(origin, quat_rotate(attitude, h.centre_of_buoyancy));
    return -DENSITY * GRAVITY * h.displacement * buoyancy.z;
}

TEST(buoyancy_is_the_gradient_of_its_energy_in_random_poses)
{
    BodyScene wigley = {.shape = BODY_WIGLEY, .size = {1.5, 0.5, 0.4}, .draft_design = 0.25};
    TriangleMesh mesh = make(&wigley, 3);
    Vec3 g = vec3(0.05, 0.02, 0.2);
    unsigned seed = 7;
    for (int k = 0; k < 20; k++) {
        Quat q = quat_from_euler(random_number(&seed), 0.5 * random_number(&seed),
                                 3 * random_number(&seed));
        Vec3 centre = vec3(random_number(&seed), random_number(&seed), 0.1 * random_number(&seed));
        Hydrostatics h = hydrostatics(&mesh, vec3_sub(centre, quat_rotate(q, g)), q, g);
        double e = 1e-5, weight = DENSITY * GRAVITY * h.displacement;
        Vec3 up = vec3(centre.x, centre.y, centre.z + e),
             down = vec3(centre.x, centre.y, centre.z - e);
        double force = -(energy(&mesh, up, q, g) - energy(&mesh, down, q, g)) / (2 * e);
        CHECK_NEAR(force, weight, 1e-4 * weight);
        Vec3 forward = quat_rotate(q, vec3(1, 0, 0));
        double yaw = atan2(forward.y, forward.x);
        Vec3 axis[2] = {{cos(yaw), sin(yaw), 0}, {-sin(yaw), cos(yaw), 0}};
        double expected[2] = {h.heel_moment, h.trim_moment};
        for (int a = 0; a < 2; a++) {
            Quat plus = quat(cos(e / 2), axis[a].x * sin(e / 2), axis[a].y * sin(e / 2), 0);
            double rise = energy(&mesh, centre, quat_mul(plus, q), g) -
                          energy(&mesh, centre, quat_mul(quat_conjugate(plus), q), g);
            CHECK_NEAR(-rise / (2 * e), expected[a], 1e-4 * weight);
        }
    }
    arena_destroy(&arena);
}

TEST(righting_moment_at_a_small_angle_is_weight_times_gm)
{
    TriangleMesh box = make_box(2, 1, 0.5);
    Vec3 g = vec3(0, 0, -0.05);
    Hydrostatics even = hydrostatics(&box, vec3(0, 0, -0.05), quat(1, 0, 0, 0), g);
    double angle = 1e-4, weight = DENSITY * GRAVITY * even.displacement;
    Hydrostatics heeled = hydrostatics(&box, vec3(0, 0, -0.05), quat_from_euler(angle, 0, 0), g);
    Hydrostatics trimmed = hydrostatics(&box, vec3(0, 0, -0.05), quat_from_euler(0, angle, 0), g);
    CHECK_NEAR(heeled.heel_moment / (-weight * angle), even.gm_transverse, 1e-3);
    CHECK_NEAR(trimmed.trim_moment / (-weight * angle), even.gm_longitudinal, 1e-3);
    arena_destroy(&arena);
}
