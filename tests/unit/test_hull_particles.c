// Signed distances and the dummy particles that fill a hull's shell.
#include "hull.h"
#include "test.h"

#include <time.h>

static Arena arena;

static TriangleMesh make(const BodyScene *body, int dimensions)
{
    TriangleMesh mesh = {0};
    Error error = {0};
    bool good = mesh_create(body, dimensions, "bodies[0]", &arena, &mesh, &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return mesh;
}

static DistanceGrid make_grid(const TriangleMesh *mesh, double cell, double band)
{
    DistanceGrid grid = {0};
    Error error = {0};
    CHECK(distance_grid_create(mesh, cell, band, &arena, &grid, &error));
    return grid;
}

static Vec3 *fill(const TriangleMesh *mesh, double spacing, double thickness, int dimensions,
                  int *count)
{
    Vec3 *points = NULL;
    Error error = {0};
    *count = 0;
    bool good =
        hull_particles(mesh, spacing, thickness, dimensions, &arena, &points, count, &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return points;
}

static double box_distance(Vec3 p, Vec3 size)
{
    Vec3 q = vec3(fabs(p.x) - size.x / 2, fabs(p.y) - size.y / 2, fabs(p.z) - size.z / 2);
    Vec3 out = vec3(maxd(q.x, 0), maxd(q.y, 0), maxd(q.z, 0));
    return vec3_norm(out) + mind(maxd(q.x, maxd(q.y, q.z)), 0);
}

TEST(distance_to_a_box_is_exact_at_nodes_and_clamped_beyond_the_band)
{
    BodyScene body = {.shape = BODY_BOX, .size = {1, 0.6, 0.5}};
    TriangleMesh box = make(&body, 3);
    double cell = 0.05, band = 0.2;
    DistanceGrid grid = make_grid(&box, cell, band); // many nodes lie exactly on faces and edges
    double worst = 0;
    for (int z = 0, i = 0; z < grid.count[2]; z++)
        for (int y = 0; y < grid.count[1]; y++)
            for (int x = 0; x < grid.count[0]; x++, i++) {
                Vec3 p = vec3(grid.min.x + x * cell, grid.min.y + y * cell, grid.min.z + z * cell);
                double exact = box_distance(p, body.size);
                exact = maxd(-band, mind(band, exact));
                worst = maxd(worst, fabs(exact - grid.values[i]));
            }
    CHECK(worst < 1e-6);
    CHECK_NEAR(distance_grid_sample(&grid, vec3(0.5, 0, 0)), 0, 1e-6);
    CHECK_NEAR(distance_grid_sample(&grid, vec3(0, 0, -0.33)), 0.08, 1e-6);
    CHECK_NEAR(distance_grid_sample(&grid, vec3(9, 9, 9)), band, 1e-6);
    CHECK_NEAR(distance_grid_sample(&grid, vec3(NAN, 0, 0)), band, 1e-6);
    arena_destroy(&arena);
}

TEST(distance_to_a_sphere_has_the_right_sign_everywhere)
{
    BodyScene body = {.shape = BODY_SPHERE, .radius = 0.4};
    TriangleMesh sphere = make(&body, 3);
    DistanceGrid grid = make_grid(&sphere, 0.05, 0.3); // vertices lie on grid planes
    double worst = 0;
    for (int z = 0, i = 0; z < grid.count[2]; z++)
        for (int y = 0; y < grid.count[1]; y++)
            for (int x = 0; x < grid.count[0]; x++, i++) {
                Vec3 p = vec3(grid.min.x + x * 0.05, grid.min.y + y * 0.05, grid.min.z + z * 0.05);
                double exact = maxd(-0.3, mind(0.3, vec3_norm(p) - 0.4));
                worst = maxd(worst, fabs(exact - grid.values[i]));
            }
    CHECK(worst < 0.001); // the facets lie that much inside the sphere
    arena_destroy(&arena);
}

TEST(inside_is_found_when_rays_hit_edges_and_vertices)
{
    // an octahedron on an integer lattice: every row through it meets edges or vertices
    BodyScene body = {.shape = BODY_SPHERE, .radius = 1};
    TriangleMesh mesh = make(&body, 3);
    mesh.vertex_count = 6;
    mesh.triangle_count = 8;
    for (int k = 0; k < 6; k++) {
        double s = k & 1 ? 4 : -4;
        mesh.vertices[k] = vec3(k / 2 == 0 ? s : 0, k / 2 == 1 ? s : 0, k / 2 == 2 ? s : 0);
    }
    for (int k = 0; k < 8; k++) {
        bool right = (((k & 1) + (k >> 1 & 1) + (k >> 2 & 1)) & 1) != 0;
        mesh.triangles[k][0] = k & 1;
        mesh.triangles[k][1] = right ? 2 + (k >> 1 & 1) : 4 + (k >> 2 & 1);
        mesh.triangles[k][2] = right ? 4 + (k >> 2 & 1) : 2 + (k >> 1 & 1);
    }
    Error error = {0};
    CHECK(mesh_check(&mesh, "octahedron", &error));
    DistanceGrid grid = make_grid(&mesh, 1, 4.5);
    int wrong = 0;
    for (int z = 0, i = 0; z < grid.count[2]; z++)
        for (int y = 0; y < grid.count[1]; y++)
            for (int x = 0; x < grid.count[0]; x++, i++) {
                Vec3 p = vec3(grid.min.x + x, grid.min.y + y, grid.min.z + z);
                double sum = fabs(p.x) + fabs(p.y) + fabs(p.z) - 4;
                if (fabs(sum) > 1e-9 && (sum < 0) != (grid.values[i] < 0)) wrong++;
            }
    CHECK(wrong == 0);
    arena_destroy(&arena);
}

TEST(box_particles_lie_on_layers_half_a_spacing_below_every_face)
{
    BodyScene body = {.shape = BODY_BOX, .size = {1, 0.6, 0.5}};
    TriangleMesh box = make(&body, 3);
    int count;
    Vec3 *points = fill(&box, 0.05, 0.1, 3, &count);
    CHECK(count == 20 * 12 * 10 - 16 * 8 * 6); // two layers
    double lowest = 1;
    for (int i = 0; i < count; i++) {
        double depth = -box_distance(points[i], body.size) / 0.05;
        lowest = mind(lowest, points[i].z);
        if (fabs(depth - 0.5) > 1e-9 && fabs(depth - 1.5) > 1e-9) CHECK(!"off its layer");
        Vec3 a = points[i ? i - 1 : 0], b = points[i];
        if (i && !(a.z < b.z || (a.z == b.z && (a.y < b.y || (a.y == b.y && a.x < b.x)))))
            CHECK(!"order");
    }
    CHECK_NEAR(lowest, -0.25 + 0.025, 1e-12);
    arena_destroy(&arena);
}

TEST(box_in_2d_has_particles_on_its_plane_only)
{
    BodyScene body = {.shape = BODY_BOX, .size = {1, 9, 0.5}};
    TriangleMesh box = make(&body, 2);
    int count;
    Vec3 *points = fill(&box, 0.1, 10, 2, &count);
    CHECK(count == 10 * 5);
    for (int i = 0; i < count; i++)
        if (points[i].y != 0) CHECK(!"off the plane");
    arena_destroy(&arena);
}

TEST(size_that_spacing_does_not_divide_is_filled_to_the_faces)
{
    BodyScene body = {.shape = BODY_BOX, .size = {1.03, 0.02, 0.47}};
    TriangleMesh box = make(&body, 3);
    int count;
    Vec3 *points = fill(&box, 0.1, 0.11, 3, &count);
    CHECK(count == 10 * 1 * 5); // thinner than a particle: still one layer
    CHECK_NEAR(points[0].x, -0.515 + 0.0515, 1e-12);
    CHECK_NEAR(points[0].z, -0.235 + 0.047, 1e-12);
    arena_destroy(&arena);
}

TEST(curved_hulls_hold_as_many_particles_as_their_volume)
{
    BodyScene bodies[] = {
        {.shape = BODY_SPHERE, .radius = 0.5},
        {.shape = BODY_CYLINDER, .radius = 0.31, .length = 1.13, .axis = 2},
        {.shape = BODY_WIGLEY, .size = {3, 0.6, 0.5}, .draft_design = 0.3},
    };
    for (size_t k = 0; k < sizeof bodies / sizeof *bodies; k++)
        for (double spacing = 0.04; spacing < 0.08; spacing += 0.023) {
            TriangleMesh mesh = make(&bodies[k], 3);
            int count;
            Vec3 *points = fill(&mesh, spacing, 10, 3, &count);
            double volume = mesh_properties(&mesh).volume;
            double tolerance = k ? 0.08 : 0.01; // flat ends and decks come and go as a whole
            CHECK_NEAR(count * pow(spacing, 3) / volume, 1, tolerance);
            int mirrored = 0;
            for (int i = 0; i < count; i++)
                mirrored += (points[i].y > 1e-9) - (points[i].y < -1e-9);
            CHECK(mirrored == 0);
            arena_destroy(&arena);
        }
}

TEST(first_layer_lies_half_a_spacing_below_the_skin_on_average)
{
    BodyScene body = {.shape = BODY_SPHERE, .radius = 0.5};
    TriangleMesh mesh = make(&body, 3);
    double spacing = 0.04;
    int count;
    Vec3 *points = fill(&mesh, spacing, 2 * spacing, 3, &count);
    double sum = 0, worst = 1;
    int outer = 0;
    for (int i = 0; i < count; i++) {
        double depth = (0.5 - vec3_norm(points[i])) / spacing;
        CHECK(depth <= 2.05);
        worst = mind(worst, depth);
        if (depth < 1) {
            sum += depth;
            outer++;
        }
    }
    CHECK_NEAR(sum / outer, 0.5, 0.05);
    CHECK(worst > -0.4); // the cut-off's range
    arena_destroy(&arena);
}

TEST(flat_bottom_of_a_polygon_hull_is_exact_and_area_matches_in_2d)
{
    BodyScene body = {.shape = BODY_POLYGON,
                      .breadth = 1,
                      .polygon_count = 5,
                      .polygon = {{-1, 0}, {0.8, 0}, {1, 0.3}, {0.9, 0.72}, {-1, 0.72}}};
    TriangleMesh mesh = make(&body, 2);
    int count;
    Vec3 *points = fill(&mesh, 0.05, 10, 2, &count);
    double area = mesh_properties(&mesh).volume;
    CHECK_NEAR(count * 0.0025 / area, 1, 0.03); // 14 of 14.4 layers
    CHECK_NEAR(points[0].z, 0.025, 1e-9);
    points = fill(&mesh, 0.05, 0.2, 2, &count); // four layers along the bottom, none deeper
    double highest_inside = 0;
    for (int i = 0; i < count; i++)
        if (fabs(points[i].x) < 0.5 && points[i].z < 0.36)
            highest_inside = maxd(highest_inside, points[i].z);
    CHECK_NEAR(highest_inside, 0.175, 1e-9);
    arena_destroy(&arena);
}

TEST(thin_sheet_has_one_layer)
{
    BodyScene body = {.shape = BODY_POLYGON,
                      .breadth = 1,
                      .polygon_count = 5,
                      .polygon = {{-1, 0}, {1, 0}, {1.01, 0.01}, {1, 0.02}, {-1, 0.02}}};
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        TriangleMesh mesh = make(&body, dimensions);
        int count;
        fill(&mesh, 0.05, 0.2, dimensions, &count);
        CHECK(count >= (dimensions == 2 ? 38 : 38 * 18));
        CHECK(count <= (dimensions == 2 ? 44 : 44 * 22));
    }
    arena_destroy(&arena);
}

TEST(too_small_spacing_is_refused_before_memory_is_taken)
{
    BodyScene body = {.shape = BODY_SPHERE, .radius = 10};
    TriangleMesh mesh = make(&body, 3);
    Vec3 *points;
    int count;
    Error error = {0};
    CHECK(!hull_particles(&mesh, 1e-4, 1e-3, 3, &arena, &points, &count, &error));
    CHECK(error.code == ERROR_INPUT);
    CHECK_CONTAINS(error.message, "too large for particles of 0.0001 m");
    body = (BodyScene){.shape = BODY_BOX, .size = {20, 20, 20}};
    mesh = make(&body, 3);
    CHECK(!hull_particles(&mesh, 1e-4, 1e-3, 3, &arena, &points, &count, &error));
    CHECK_CONTAINS(error.message, "too large for particles");
    arena_destroy(&arena);
}
