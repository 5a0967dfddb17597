/// The free surface as a height field: accuracy, bodies, dry beds, stray particles.
#include "test.h"

#include "render_fixture.h"
#include "surface.h"

static double largest_error(const Fixture *fixture, const HeightField *field, double margin)
{
    const Domain *domain = &fixture->snapshot.domain;
    double largest = 0;
    for (double x = domain->min.x + margin; x <= domain->max.x - margin; x += 0.043)
        for (double y = domain->min.y + margin; y <= domain->max.y - margin; y += 0.047) {
            double wave = fixture_elevation(fixture, x, y, fixture->snapshot.time);
            largest = maxd(largest, fabs(height_field_sample(field, x, y) - wave));
        }
    return largest;
}

static void build(HeightField *field, const Fixture *fixture)
{
    Error error = {0};
    CHECK(height_field_resize(field, &fixture->snapshot, 20000, &error));
    height_field_build(field, &fixture->snapshot, NULL);
}

TEST(height_field_follows_an_ordered_wave_within_a_fifth_of_dp)
{
    Fixture fixture = fixture_basin(0.05, 0.18);
    fixture.jitter = 0;
    fixture_water(&fixture);
    HeightField field = {0};
    build(&field, &fixture);
    CHECK_NEAR(largest_error(&fixture, &field, 0.1) / 0.05, 0, 0.2);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(height_field_of_disordered_water_has_no_bias)
{
    Fixture fixture = fixture_basin(0.06, 0.15);
    fixture.jitter = 0.4;
    fixture_water(&fixture);
    HeightField field = {0};
    build(&field, &fixture);
    double sum = 0, square = 0;
    int count = 0;
    for (double x = -3.4; x < 3.4; x += 0.05)
        for (double y = -1.8; y < 1.8; y += 0.05, count++) {
            double error = height_field_sample(&field, x, y) -
                           fixture_elevation(&fixture, x, y, fixture.snapshot.time);
            sum += error;
            square += error * error;
        }
    CHECK_NEAR(sum / count / 0.06, 0, 0.1);
    CHECK_NEAR(sqrt(square / count) / 0.06, 0, 0.15);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(water_continues_through_a_floating_ship)
{
    Fixture fixture = fixture_basin(0.06, 0.0);
    fixture_ship(&fixture);
    fixture_water(&fixture);
    HeightField field = {0};
    build(&field, &fixture);
    int filled = 0;
    for (int n = 0; n < field.count[0] * field.count[1]; n++)
        filled += field.kind[n] == NODE_FILLED;
    CHECK(filled > 100);
    CHECK_NEAR(largest_error(&fixture, &field, 0.1) / 0.06, 0, 0.3);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(a_ship_above_the_water_does_not_touch_the_surface)
{
    Fixture fixture = fixture_basin(0.06, 0.1);
    fixture_water(&fixture);
    fixture_ship(&fixture);
    fixture.snapshot.bodies[0].origin.z = 0.6;
    HeightField field = {0};
    build(&field, &fixture);
    int filled = 0;
    for (int n = 0; n < field.count[0] * field.count[1]; n++)
        filled += field.kind[n] == NODE_FILLED;
    CHECK(filled == 0);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(a_bed_without_water_is_dry_and_at_the_bed)
{
    Fixture fixture = fixture_basin(0.06, 0.0);
    fixture_water(&fixture);
    int kept = 0;
    for (int i = 0; i < fixture.snapshot.fluid_count; i++)
        if (fixture.snapshot.position[i][0] < 0)
            memcpy(fixture.snapshot.position[kept++], fixture.snapshot.position[i], 12);
    fixture.snapshot.fluid_count = kept;
    HeightField field = {0};
    build(&field, &fixture);
    CHECK_NEAR(height_field_sample(&field, -2, 0), 0, 0.02);
    CHECK_NEAR(height_field_sample(&field, 2, 0), -1.2, 1e-6);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(a_sheet_one_particle_thick_covers_the_bed)
{
    Fixture fixture = fixture_basin(0.1, 0.0);
    fixture_water(&fixture);
    int count = 0;
    for (double x = -3.55; x < 3.6; x += 0.17)
        for (double y = -1.95; y < 2.0; y += 0.17, count++) {
            fixture.snapshot.position[count][0] = (float)x;
            fixture.snapshot.position[count][1] = (float)y;
            fixture.snapshot.position[count][2] = -1.15f;
        }
    fixture.snapshot.fluid_count = count;
    HeightField field = {0};
    build(&field, &fixture);
    int dry = 0;
    for (int n = 0; n < field.count[0] * field.count[1]; n++)
        dry += field.kind[n] == NODE_DRY;
    CHECK(dry == 0);
    CHECK_NEAR(height_field_sample(&field, 0, 0), -1.1, 0.01);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(one_drop_of_spray_does_not_lift_the_surface)
{
    Fixture fixture = fixture_basin(0.06, 0.0);
    fixture_water(&fixture);
    fixture.snapshot.position[fixture.snapshot.fluid_count / 2][2] = 0.35f;
    HeightField field = {0};
    build(&field, &fixture);
    CHECK_NEAR(largest_error(&fixture, &field, 0.0) / 0.06, 0, 0.25);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(particles_that_are_not_numbers_are_passed_over)
{
    Fixture fixture = fixture_basin(0.08, 0.0);
    fixture_water(&fixture);
    float(*position)[3] = fixture.snapshot.position;
    position[10][0] = NAN;
    position[20][1] = INFINITY;
    position[30][2] = NAN;
    position[40][2] = INFINITY;
    position[50][0] = 1e30f;
    position[60][1] = 40000.0f;
    position[70][0] = -5.0f;
    HeightField field = {0};
    build(&field, &fixture);
    CHECK_NEAR(largest_error(&fixture, &field, 0.0) / 0.08, 0, 0.25);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(a_slice_has_one_row_and_follows_its_wave)
{
    Fixture fixture = fixture_basin(0.04, 0.15);
    fixture.snapshot.domain.dimensions = 2;
    fixture.jitter = 0;
    fixture_water(&fixture);
    HeightField field = {0};
    build(&field, &fixture);
    CHECK(field.count[1] == 1);
    double largest = 0;
    for (double x = -3.5; x < 3.5; x += 0.02)
        largest = maxd(largest, fabs(height_field_sample(&field, x, 0) -
                                     fixture_elevation(&fixture, x, 0, fixture.snapshot.time)));
    CHECK_NEAR(largest / 0.04, 0, 0.25);
    height_field_destroy(&field);
    fixture_free(&fixture);
}

TEST(the_shell_keeps_what_is_seen_and_leaves_out_the_inside)
{
    Fixture fixture = fixture_basin(0.06, 0.1);
    fixture_water(&fixture);
    HeightField field = {0};
    build(&field, &fixture);
    int *shell = calloc((size_t)fixture.snapshot.fluid_count, sizeof *shell);
    int count = height_field_shell(&field, &fixture.snapshot, shell);
    CHECK(count > 1000 && count < fixture.snapshot.fluid_count / 2);
    for (int i = 0; i < count; i++) {
        const float *p = fixture.snapshot.position[shell[i]];
        bool inside = fabs(p[0]) < 3.3 && fabs(p[1]) < 1.7 && p[2] < -0.4;
        if (inside) {
            CHECK(!inside);
            break;
        }
    }
    free(shell);
    height_field_destroy(&field);
    fixture_free(&fixture);
}
