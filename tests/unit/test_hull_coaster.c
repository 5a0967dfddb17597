// The ship of the default case: closed, and afloat as assets/make_coaster.c says.
#include "hull.h"
#include "test.h"

#include <time.h>

static const Vec3 CENTRE_OF_GRAVITY = {-0.06, 0, 0.26};

static Arena arena;

static TriangleMesh load(void)
{
    TriangleMesh mesh = {0};
    Error error = {0};
    bool good = mesh_load(SOURCE_DIR "/assets/coaster.stl", 1, &arena, &mesh, &error) &&
                mesh_check(&mesh, "coaster", &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return mesh;
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

TEST(coaster_has_its_main_dimensions)
{
    TriangleMesh mesh = load();
    MeshProperties p = mesh_properties(&mesh);
    CHECK(mesh.triangle_count >= 4000 && mesh.triangle_count <= 8000);
    CHECK_NEAR(p.max.y, 0.375, 1e-4);
    CHECK_NEAR(p.min.y, -p.max.y, 1e-12);
    CHECK_NEAR(p.min.z, 0, 1e-12);
    CHECK_NEAR(p.centroid.y, 0, 1e-9);
    double stem = -1; // where the stem cuts the design waterline: the forward perpendicular
    for (int i = 0; i < mesh.vertex_count; i++)
        if (fabs(mesh.vertices[i].z - 0.30) < 0.02) stem = maxd(stem, mesh.vertices[i].x);
    CHECK_NEAR(stem, 1.50, 0.01);
    arena_destroy(&arena);
}

TEST(coaster_floats_on_an_even_keel_at_its_draft)
{
    Scene *scene = arena_take(&arena, 1, sizeof *scene, "scene", NULL);
    scene->domain.dimensions = 3;
    scene->domain.min = vec3(-4, -4, -2);
    scene->domain.max = vec3(4, 4, 1);
    scene->fluid.density = 1000;
    scene->fluid.gravity = 9.81;
    BodyScene *body = &scene->bodies[0];
    body->shape = BODY_MESH;
    body->scale = 1;
    strcpy(body->mesh_path, SOURCE_DIR "/assets/coaster.stl");
    body->position = vec3(0, 0, NAN);
    body->draft = 0.30;
    body->mass = NAN;
    body->centre_of_gravity = CENTRE_OF_GRAVITY;
    body->radii_of_gyration = vec3(0.35 * 0.75, 0.75, 0.75);
    for (int k = 0; k < 6; k++)
        body->inertia[k] = NAN;
    BodyGeometry g = {0};
    Error error = {0};
    CHECK(body_geometry_create(scene, 0, &arena, &g, &error));
    const Hydrostatics *h = &g.hydrostatics;
    CHECK_NEAR(g.mass, 419.2, 0.5);
    CHECK_NEAR(h->displacement / (3.00 * 0.75 * 0.30), 0.62, 0.005); // block coefficient
    CHECK_NEAR(h->centre_of_buoyancy.x, -0.06, 0.002);
    CHECK_NEAR(h->centre_of_buoyancy.y, 0, 1e-9);
    CHECK(h->gm_transverse > 0.05 && h->gm_transverse < 0.12);
    CHECK_NEAR(h->roll_period, 1.84, 0.03);
    // trim that the remaining moment would cause: less than a tenth of a degree
    double trim = h->trim_moment / (g.mass * 9.81 * h->gm_longitudinal);
    CHECK_NEAR(trim, 0, 0.1 * PI / 180);
    arena_destroy(&arena);
}

TEST(distance_grid_of_the_coaster_is_quick_and_right)
{
    TriangleMesh mesh = load();
    DistanceGrid grid;
    Error error = {0};
    double begin = seconds();
    CHECK(distance_grid_create(&mesh, 0.05, 0.2, &arena, &grid, &error));
    double spent = seconds() - begin;
    printf("  distance grid: %.3f s\n", spent);
    CHECK(spent < 3); // 0.3 s are asked for; sanitizers and neighbours take their share
    CHECK(distance_grid_sample(&grid, vec3(0, 0, 0.25)) < -0.15);
    CHECK(distance_grid_sample(&grid, vec3(0, 0, -0.1)) > 0.05);
    CHECK(distance_grid_sample(&grid, vec3(-1.0, 0, 0.80)) < 0);    // inside the wheelhouse
    CHECK(distance_grid_sample(&grid, vec3(0, 0.32, 0.60)) > 0.02); // above the side deck
    // the sum of the inside cells is the volume
    double inside = 0, cells = 0.05 * 0.05 * 0.05;
    for (int i = 0; i < grid.count[0] * grid.count[1] * grid.count[2]; i++)
        inside += cells * mind(1, maxd(0, 0.5 - grid.values[i] / 0.05));
    CHECK_NEAR(inside / mesh_properties(&mesh).volume, 1, 0.02);
    arena_destroy(&arena);
}

TEST(particles_of_the_coaster_are_symmetric_and_match_its_volume)
{
    for (double spacing = 0.05; spacing < 0.11; spacing += 0.025) {
        TriangleMesh mesh = load();
        Vec3 *points;
        int count, shell;
        Error error = {0};
        CHECK(hull_particles(&mesh, spacing, 10, 3, &arena, &points, &count, &error));
        double volume = mesh_properties(&mesh).volume;
        CHECK_NEAR(count * pow(spacing, 3) / volume, 1, 0.02);
        double moment = 0;
        for (int i = 0; i < count; i++)
            moment += points[i].y;
        CHECK_NEAR(moment, 0, 1e-9);
        CHECK(hull_particles(&mesh, spacing, 2 * spacing, 3, &arena, &points, &shell, &error));
        printf("  dp %.3f m: %d particles fill it, %d in a shell of 2 dp\n", spacing, count, shell);
        CHECK(shell < count);
        arena_destroy(&arena);
    }
}

/// Part of a particle's cell that lies below a level.
static double wet_part(double z, double level, double spacing)
{
    return maxd(0, mind(1, (level - z) / spacing + 0.5));
}

TEST(particles_below_the_water_displace_what_the_coaster_does)
{
    for (double spacing = 0.03; spacing < 0.12; spacing += 0.01) {
        TriangleMesh mesh = load();
        Vec3 *points;
        int count;
        Error error = {0};
        CHECK(hull_particles(&mesh, spacing, 10, 3, &arena, &points, &count, &error));
        for (double draft = 0.25; draft < 0.40; draft += 0.05) {
            const double inertia[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
            Hydrostatics h = mesh_hydrostatics(&mesh, vec3(0, 0, -draft), quat(1, 0, 0, 0),
                                               CENTRE_OF_GRAVITY, 1, inertia, 0, 1000, 9.81);
            double volume = 0, moment = 0;
            for (int i = 0; i < count; i++) {
                double wet = wet_part(points[i].z, draft, spacing) * pow(spacing, 3);
                volume += wet;
                moment += wet * points[i].x;
            }
            CHECK_NEAR(volume / h.displacement, 1, 0.015);
            CHECK_NEAR(moment / volume, h.centre_of_buoyancy.x, 0.15 * spacing);
        }
        arena_destroy(&arena);
    }
}
