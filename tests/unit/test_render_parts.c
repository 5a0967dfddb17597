/// Parts of a picture that can be told without looking: fields on the cut faces, creased normals.
#include "test.h"

#include "cut.h"
#include "parts.h"
#include "render_fixture.h"

/// Value at a point of a side, nearest node.
static double cut_at(const CutFaces *cut, int side, double share, double z)
{
    int column = cut->first[side] + (int)round(share * (cut->columns[side] - 1));
    int row = (int)round((z - cut->bed) / cut->step);
    return cut->value[(size_t)row * cut->width + column];
}

static void cut_pressure_is_hydrostatic(int dimensions)
{
    Fixture fixture = fixture_basin(0.05, 0.0);
    fixture.snapshot.domain.dimensions = dimensions;
    fixture_water(&fixture);
    CutFaces cut = {0};
    Error error = {0};
    const Domain *domain = &fixture.snapshot.domain;
    CHECK(cut_faces_build(&cut, &fixture.snapshot, fixture.snapshot.pressure, domain->min,
                          vec3(domain->max.x, domain->max.y, 0), &error));
    for (int side = 0; side < 4; side++)
        for (double z = -1.1; z < -0.1; z += 0.2)
            CHECK_NEAR(cut_at(&cut, side, 0.4, z), -9810 * z, 9810 * 0.04);
    CHECK_NEAR(cut_at(&cut, 0, 0.5, 0.35), cut_at(&cut, 0, 0.5, 0.0), 9810 * 0.05);
    cut_faces_destroy(&cut);
    fixture_free(&fixture);
}

TEST(pressure_on_the_sides_of_a_still_tank_is_hydrostatic) { cut_pressure_is_hydrostatic(3); }

TEST(pressure_on_a_still_slice_is_hydrostatic) { cut_pressure_is_hydrostatic(2); }

TEST(sides_follow_one_another_in_the_texture)
{
    CutFaces cut = {.columns = {11, 5, 11, 5}, .first = {0, 11, 16, 27}, .width = 32};
    double last = 0;
    for (int side = 0; side < 4; side++)
        for (int end = 0; end < 2; end++) {
            double u = cut_faces_u(&cut, side, end);
            CHECK(u > last && u < 1);
            last = u;
        }
}

/// Two unit squares that meet at an edge along y at an angle; 0 is flat.
static void two_squares(double angle, float *out)
{
    Vec3 vertices[6] = {{-1, 0, 0},
                        {0, 0, 0},
                        {0, 1, 0},
                        {-1, 1, 0},
                        {cos(angle), 0, -sin(angle)},
                        {cos(angle), 1, -sin(angle)}};
    int triangles[4][3] = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
    TriangleMesh mesh = {6, vertices, 4, triangles};
    Error error = {0};
    CHECK(crease_normals(&mesh, 0.6, out, &error));
}

TEST(normals_are_shared_across_a_gentle_edge_and_split_at_a_sharp_one)
{
    float corners[12][6];
    two_squares(0.3, &corners[0][0]);
    CHECK_NEAR(corners[1][3], 0.5 * sin(0.3) / cos(0.15), 0.05); // between the faces
    CHECK_NEAR(corners[0][5], 1, 1e-6);                          // away from the edge
    two_squares(1.2, &corners[0][0]);
    CHECK_NEAR(corners[1][5], 1, 1e-6);
    CHECK_NEAR(corners[6][3], sin(1.2), 1e-6);
    for (int c = 0; c < 12; c++) {
        const float *n = corners[c] + 3;
        CHECK_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-5);
    }
}
