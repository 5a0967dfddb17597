/// Static lines against the elastic catenary and against lumped equilibria of another code.
#include "mooring_cases.h"

static bool statics_of(const DrivenCase *c, int segments, Vec3 *nodes, LineStatics *statics,
                       Error *error)
{
    LineScene scene = driven_scene(c, segments);
    WaterField water = driven_water(c);
    return line_statics(&scene, c->anchor, c->fairlead, &water, "lines.test", nodes, statics,
                        error);
}

static double segment_tension(const DrivenCase *c, int segments, const Vec3 *nodes, int s)
{
    double length = c->length / segments;
    double stretched = vec3_norm(vec3_sub(nodes[s + 1], nodes[s]));
    return maxd(c->stiffness * (stretched / length - 1), 0);
}

/// Analytic end forces and tension in the middle of the last segment at N = 20 and 80.
static const struct {
    const char *name;
    double horizontal, fairlead, last20, last80;
} analytic[] = {
    {"a1", 74.08994010516417, 151.06231611953237, 147.38255156597464, 150.1396079995441},
    {"a2", 37.24834799458855, 71.16284837247568, 69.0083585236038, 70.62179916966073},
    {"a3", 1024.0948736936982, 1666.1008656915853, 1664.7640089687616, 1665.7665903540758},
    {"a4", 5.9741495201670505, 51.22165870917068, 48.69631869784296, 50.59015214877204},
};

TEST(catenary_forces_match_the_analytic_solution)
{
    for (int i = 0; i < 4; i++) {
        LineStatics statics;
        Error error = {0};
        CHECK(statics_of(driven_case(analytic[i].name), 20, NULL, &statics, &error));
        CHECK_NEAR(statics.horizontal_force / analytic[i].horizontal, 1, 1e-8);
        CHECK_NEAR(statics.fairlead_tension / analytic[i].fairlead, 1, 1e-8);
    }
}

TEST(lumped_tension_is_within_0_2_percent_at_20_and_0_05_at_80_segments)
{
    for (int i = 0; i < 4; i++) {
        const DrivenCase *c = driven_case(analytic[i].name);
        LineStatics statics;
        Error error = {0};
        Vec3 nodes[81];
        CHECK(statics_of(c, 20, nodes, &statics, &error));
        // a2 errs by 0.2 % on account of the springy bed, in the reference code just so
        CHECK_NEAR(segment_tension(c, 20, nodes, 19) / analytic[i].last20, 1, 0.00205);
        CHECK(statics_of(c, 80, nodes, &statics, &error));
        CHECK_NEAR(segment_tension(c, 80, nodes, 79) / analytic[i].last80, 1, 0.0005);
    }
}

/// What a body feels: the tension at the very end, half a segment's weight included.
TEST(force_at_the_fairlead_is_within_0_2_percent_of_the_catenary_at_20_segments)
{
    for (int i = 0; i < 4; i++) {
        const DrivenCase *c = driven_case(analytic[i].name);
        LineScene scene = driven_scene(c, 20);
        WaterField water = driven_water(c);
        Arena arena = arena_create(0);
        Line line;
        Error error = {0};
        CHECK(line_create(&scene, c->anchor, c->fairlead, &water, c->name, &arena, &line, NULL,
                          &error));
        double off = vec3_norm(line.fairlead_force) / analytic[i].fairlead - 1;
        printf("  %s %+.3f %%\n", c->name, 100 * off);
        CHECK(fabs(off) < 0.002);
        arena_destroy(&arena);
    }
}

TEST(lumped_shapes_match_the_reference_within_a_micrometre)
{
    const char *names[] = {"a1", "a2", "a3", "a4"};
    for (int i = 0; i < 4; i++) {
        char file[32];
        double rows[21 * 3];
        Vec3 nodes[21];
        LineStatics statics;
        Error error = {0};
        snprintf(file, sizeof file, "%s_shape.csv", names[i]);
        CHECK(read_reference(file, 3, 21, rows) == 21);
        CHECK(statics_of(driven_case(names[i]), 20, nodes, &statics, &error));
        double worst = 0;
        for (int k = 0; k <= 20; k++)
            worst = maxd(worst, hypot(nodes[k].x - rows[3 * k], nodes[k].z - rows[3 * k + 1]));
        CHECK(worst < 1e-6);
    }
}

/// Published checks: a line of weight w per length in water is one of mass w/g in a vacuum.
TEST(catenary_matches_published_checks_with_and_without_bed)
{
    double rows[16 * 13];
    int count = read_reference("catenary_checks.csv", 13, 16, rows), used = 0;
    for (int i = 0; i < count; i++) {
        const double *r = rows + 13 * i;
        double w = r[4], height = r[5] < 0 ? -r[5] : 0;
        if (r[5] > 0 || w < 0) continue; // friction is no part of our statics; buoyant: below
        LineScene scene = driven_scene(driven_case("a3"), 20);
        scene.length = r[2];
        scene.axial_stiffness = r[3];
        scene.mass_per_length = w / 10;
        WaterField water = {NULL, NULL, 1e6, 0, 10, -height};
        bool on_bed = r[5] == 0 && r[12] > 0;
        if (r[5] == 0 && !on_bed) water.bed = -1e5; // suspended rows
        LineStatics statics;
        Error error = {0};
        CHECK(line_statics(&scene, vec3(0, 0, 0), vec3(r[0], 0, r[1]), &water, "x", NULL, &statics,
                           &error));
        CHECK_NEAR(statics.horizontal_force / fabs(r[10]), 1, 1e-4);
        CHECK_NEAR(statics.fairlead_tension / hypot(r[10], r[11]), 1, 1e-4);
        CHECK_NEAR(statics.anchor_tension / hypot(r[8], r[9]), 1, 1e-4);
        CHECK_NEAR(statics.touchdown, r[12], 0.01);
        used++;
    }
    CHECK(used >= 5);
}

TEST(buoyant_line_is_the_mirror_image_of_a_heavy_one)
{
    LineScene heavy = driven_scene(driven_case("a3"), 20), light = heavy;
    double displaced = 1000 * PI / 4 * heavy.diameter * heavy.diameter;
    heavy.mass_per_length = displaced + 0.2;
    light.mass_per_length = displaced - 0.2;
    WaterField water = {NULL, NULL, 0, 1000, 9.81, -200};
    LineStatics a, b;
    Error error = {0};
    CHECK(line_statics(&heavy, vec3(0, 0, -100), vec3(30, 0, -60), &water, "x", NULL, &a, &error));
    CHECK(line_statics(&light, vec3(0, 0, -100), vec3(30, 0, -140), &water, "x", NULL, &b, &error));
    // the buoyant one may reach the surface, so it is a lumped line: 0.15 % at 20 segments
    CHECK_NEAR(b.fairlead_tension / a.fairlead_tension, 1, 3e-3);
    CHECK_NEAR(b.horizontal_force / a.horizontal_force, 1, 3e-3);
}

/// Ends in every relation to each other and to the bed; the total weight must be found again.
TEST(every_configuration_has_a_start_in_balance)
{
    const DrivenCase *c = driven_case("c1");
    const struct {
        Vec3 anchor, fairlead;
    } ends[] = {
        {{0, 0, -.5}, {.1, 0, -.08}},   // heap on the bed
        {{0, 0, -.5}, {0, 0, -.08}},    // heap under the fairlead
        {{0, 0, -.5}, {.2, .1, -.5}},   // both ends on the bed
        {{0, 0, -.65}, {0, 0, -.0499}}, // vertical and just taut, with no bed to touch
        {{0, 0, -.4}, {0, 0, -.2}},     // folded
        {{0, 0, -.4}, {0, 0, -.4}},     // both ends in one place
        {{0, 0, -.1}, {.3, 0, -.3}},    // anchor above fairlead
        {{0, 0, -.1}, {.3, 0, -.5}},    // anchor above a fairlead on the bed
        {{0, 0, -.3}, {.3, 0, -.3}},    // hung up at both ends, lying between
        {{0, 0, -.4}, {.2, 0, .1}},     // fairlead out of the water
        {{0, 0, -.5}, {.43, 0, -.08}},  // taut
    };
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        LineScene scene = driven_scene(c, 20);
        WaterField water = driven_water(c);
        if (i == 3) water.bed = -2;
        Arena arena = arena_create(0);
        Line line;
        LineStatics statics;
        Error error = {0};
        CHECK(line_create(&scene, ends[i].anchor, ends[i].fairlead, &water, "lines.test", &arena,
                          &line, &statics, &error));
        EndPath a = still_path(ends[i].anchor), f = still_path(ends[i].fairlead);
        double before = line.fairlead_force.z + line.anchor_force.z, fastest = 0;
        line.stepper = LINE_STEPPER_RK2;
        CHECK(line_advance(&line, &water, 0, 2e-3, &a, &f, &error));
        for (int k = 0; k <= 20; k++)
            fastest = maxd(fastest, vec3_norm(line.velocity[k]));
        CHECK(fastest < 2e-5); // free fall would have reached 2e-2 m/s
        CHECK(before < 0 && before > -0.18);
        arena_destroy(&arena);
    }
}

TEST(line_that_cannot_reach_is_refused_with_span_and_reach)
{
    const DrivenCase *c = driven_case("c1");
    LineScene scene = driven_scene(c, 20);
    WaterField water = driven_water(c);
    LineStatics statics;
    Error error = {0};
    CHECK(!line_statics(&scene, c->anchor, vec3(.6, 0, -.08), &water, "lines.bow", NULL, &statics,
                        &error));
    CHECK(error.code == ERROR_INPUT);
    CHECK_CONTAINS(error.message, "lines.bow");
    CHECK_CONTAINS(error.message, "0.73239");
    CHECK_CONTAINS(error.message, "0.6 m long");
    CHECK_CONTAINS(error.message, "accepted");
}

TEST(touchdown_is_what_hangs_less_than_the_length)
{
    const DrivenCase *c = driven_case("a2");
    LineStatics statics;
    Error error = {0};
    CHECK(statics_of(c, 20, NULL, &statics, &error));
    double wet = (c->mass - c->density * PI / 4 * c->diameter * c->diameter) * 9.80665;
    CHECK_NEAR(statics.touchdown, 6 - 60.63589333190363 / wet, 1e-6);
}
