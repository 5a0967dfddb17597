/// Lines of several types.
#include "mooring_cases.h"

typedef struct Rig {
    LineScene scene;
    WaterField water;
    Arena arena;
    Line line;
    LineStatics statics;
    Error error;
    bool good;
} Rig;

static void rig_start(Rig *rig, const LineScene *scene, WaterField water, Vec3 anchor,
                      Vec3 fairlead, LineStepper stepper)
{
    memset(rig, 0, sizeof *rig);
    rig->scene = *scene;
    rig->water = water;
    rig->arena = arena_create(0);
    rig->good = line_create(&rig->scene, anchor, fairlead, &rig->water, "lines.rig", &rig->arena,
                            &rig->line, &rig->statics, &rig->error);
    rig->line.stepper = stepper;
    if (!rig->good) printf("  %s\n", rig->error.message);
}

/// The same line in `pieces` sections of equal type.
static LineScene cut(const LineScene *whole, int pieces)
{
    LineScene scene = *whole;
    scene.section_count = pieces;
    for (int k = 0; k < pieces; k++) {
        scene.sections[k] = line_section_default();
        scene.sections[k].length = whole->length / pieces;
    }
    line_scene_complete(&scene);
    return scene;
}

TEST(sections_inherit_and_sum_up)
{
    LineScene scene = driven_scene(driven_case("a3"), 20);
    scene.section_count = 2;
    scene.sections[0] = scene.sections[1] = line_section_default();
    scene.sections[0].length = 3;
    scene.sections[1].length = 9;
    scene.sections[1].mass_per_length = 7;
    line_scene_complete(&scene);
    CHECK_NEAR(scene.length, 12, 0);
    CHECK(scene.sections[0].segments == 5 && scene.sections[1].segments == 15);
    CHECK(scene.segments == 20);
    CHECK_NEAR(scene.sections[0].mass_per_length, scene.mass_per_length, 0);
    CHECK_NEAR(scene.sections[1].mass_per_length, 7, 0);
    CHECK_NEAR(scene.sections[1].drag_normal, 1.2, 0);
}

/// Snap, bed and surface: what is cut into sections and not changed moves as before.
TEST(sections_of_one_type_are_a_line_of_one_type)
{
    const char *names[] = {"b5", "b1", "b7"};
    for (int n = 0; n < 6; n++) {
        const DrivenCase *c = driven_case(names[n / 2]);
        LineStepper stepper = n % 2 ? LINE_STEPPER_BDF2 : LINE_STEPPER_RK2;
        LineScene whole = driven_scene(c, 20), pieces = cut(&whole, 4);
        WaterField water = driven_water(c);
        if (n / 2 == 2) water.level = -6.3; // the fairlead and a few nodes are out of the water
        Rig a, b;
        rig_start(&a, &whole, water, c->anchor, c->fairlead, stepper);
        rig_start(&b, &pieces, water, c->anchor, c->fairlead, stepper);
        CHECK(a.good && b.good);
        if (!a.good || !b.good) return;
        EndPath anchor = still_path(c->anchor);
        double worst = 0;
        for (int k = 0; k < 200; k++) {
            EndPath path = driven_path(c, k * 0.01, 0.01);
            CHECK(line_advance(&a.line, &a.water, k * .01, .01, &anchor, &path, &a.error));
            CHECK(line_advance(&b.line, &b.water, k * .01, .01, &anchor, &path, &b.error));
            for (int i = 0; i < 20; i++)
                worst = maxd(worst,
                             fabs(a.line.tension[i] - b.line.tension[i]) / (1 + a.line.tension[i]));
        }
        CHECK(worst < 1e-6);
        CHECK(a.line.largest_tension > 50);
        arena_destroy(&a.arena);
        arena_destroy(&b.arena);
    }
}

/// A piece of catenary from where the line pulls with (h, p): moves the point along it.
static void hang(double weight, double stiffness, double length, double h, double *p, Vec3 *at)
{
    double q = *p + weight * length;
    at->x += h / weight * (asinh(q / h) - asinh(*p / h)) + h * length / stiffness;
    at->z += (hypot(h, q) - hypot(h, *p)) / weight + (q * q - *p * *p) / (2 * weight * stiffness);
    *p = q;
}

/// Chain, rope and chain hung up so that their exact forces are known.
TEST(chain_and_rope_hang_as_their_catenaries_say)
{
    const int segments[] = {20, 80};
    const double bounds[] = {0.002, 0.0005};
    for (int n = 0; n < 2; n++) {
        LineScene scene = driven_scene(driven_case("a1"), segments[n]);
        scene.section_count = 3;
        for (int k = 0; k < 3; k++)
            scene.sections[k] = line_section_default();
        scene.sections[0].length = 6;
        scene.sections[1].length = 10;
        scene.sections[2].length = 4;
        scene.sections[1].segments = segments[n] / 5; // nearly straight: the chain needs them
        scene.sections[0].segments = scene.sections[2].segments = 2 * segments[n] / 5;
        scene.sections[1].axial_stiffness = 50000;
        scene.sections[1].mass_per_length = 0.43353978619539146;
        scene.sections[1].diameter = 0.02;
        line_scene_complete(&scene);
        WaterField water = {NULL, NULL, 0, 1025, 9.80665, -100};
        Vec3 anchor = vec3(0, 0, -40), at = anchor;
        double h = 150, p = -30;
        for (int k = 0; k < 3; k++) {
            const LineSection *s = &scene.sections[k];
            double displaced = 1025 * PI / 4 * s->diameter * s->diameter;
            hang((s->mass_per_length - displaced) * 9.80665, s->axial_stiffness, s->length, h, &p,
                 &at);
        }
        Rig rig;
        rig_start(&rig, &scene, water, anchor, at, LINE_STEPPER_BDF2);
        CHECK(rig.good);
        CHECK_NEAR(rig.statics.fairlead_tension / hypot(h, p), 1, bounds[n]);
        CHECK_NEAR(rig.statics.horizontal_force / h, 1, bounds[n]);
        CHECK_NEAR(rig.statics.anchor_tension / hypot(h, 30), 1, bounds[n]);
        arena_destroy(&rig.arena);
    }
}

/// Both steppers on chain with a rope pendant that goes in and out of the water and snaps.
TEST(steppers_agree_on_chain_with_a_rope_pendant)
{
    DrivenCase c = *driven_case("d1");
    LineScene scene = driven_scene(&c, 20);
    scene.section_count = 2;
    scene.sections[0] = scene.sections[1] = line_section_default();
    scene.sections[0].length = 4.8;
    scene.sections[1].length = 1.2;
    scene.sections[1].axial_stiffness = 50000;
    scene.sections[1].mass_per_length = 0.43353978619539146;
    scene.sections[1].diameter = 0.02;
    line_scene_complete(&scene);
    double mean[2] = {0, 0}, square[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        rig_start(&rig, &scene, driven_water(&c), c.anchor, c.fairlead,
                  k ? LINE_STEPPER_BDF2 : LINE_STEPPER_RK2);
        CHECK(rig.good);
        EndPath anchor = still_path(c.anchor);
        for (int i = 0; i < 4000 && rig.good; i++) {
            EndPath path = driven_path(&c, i * 1e-3, 1e-3);
            rig.good =
                line_advance(&rig.line, &rig.water, i * 1e-3, 1e-3, &anchor, &path, &rig.error);
            mean[k] += rig.line.tension[19] / 4000;
            square[k] += rig.line.tension[19] * rig.line.tension[19] / 4000;
        }
        CHECK(rig.good);
        arena_destroy(&rig.arena);
    }
    CHECK(mean[0] > 20);
    CHECK_NEAR(mean[1] / mean[0], 1, 0.01);
    CHECK_NEAR(sqrt(square[1] / square[0]), 1, 0.02);
}
