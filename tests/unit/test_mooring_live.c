/// What happens to lines while they run: parting, winches; and lines that bend.
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

/// Finite, never pushing, and no segment that is whole stretched by more than `strain`.
static bool rig_is_sane(const Rig *rig, double strain)
{
    const Line *line = &rig->line;
    double l = line->length / rig->scene.segments;
    for (int i = 0; i < line->node_count; i++)
        if (!isfinite(vec3_norm(line->position[i])) || !isfinite(vec3_norm(line->velocity[i])))
            return false;
    for (int i = 0; i + 1 < line->node_count; i++) {
        double s = vec3_norm(vec3_sub(line->position[i + 1], line->position[i]));
        if (!(line->tension[i] >= 0) || (!line->parted[i] && s > l * (1 + strain))) return false;
    }
    return true;
}

/// A fact of either stepper, which the body knows as `stepper`.
#define TEST_BOTH(fact)                                                                            \
    static void fact##_check(LineStepper stepper);                                                 \
    TEST(rk2_##fact) { fact##_check(LINE_STEPPER_RK2); }                                           \
    TEST(bdf2_##fact) { fact##_check(LINE_STEPPER_BDF2); }                                         \
    static void fact##_check(LineStepper stepper)

/// Cut by hand in the middle: both halves come to hang from their ends or lie on the bed, and each
/// end carries its half.
TEST_BOTH(severed_line_hangs_from_either_end)
{
    const DrivenCase *c = driven_case("b7");
    LineScene scene = driven_scene(c, 20);
    Rig rig;
    rig_start(&rig, &scene, driven_water(c), c->anchor, c->fairlead, stepper);
    EndPath anchor = still_path(c->anchor), fairlead = still_path(c->fairlead);
    mooring_break(&rig.line, 12);
    mooring_break(&rig.line, 12);
    CHECK(rig.line.parted_count == 1 && rig.line.parted[12] && rig.line.parted_last == 12);
    for (int k = 0; k < 4000 && rig.good; k++) {
        rig.good =
            line_advance(&rig.line, &rig.water, k * 5e-3, 5e-3, &anchor, &fairlead, &rig.error);
        if (!rig_is_sane(&rig, 1e-3)) break;
    }
    CHECK(rig.good && rig_is_sane(&rig, 1e-3));
    double wet = (c->mass - c->density * PI / 4 * c->diameter * c->diameter) * 9.80665 * 0.5;
    CHECK_NEAR(rig.line.anchor_force.z / (-12.5 * wet), 1, 0.002);
    CHECK_NEAR(rig.line.fairlead_force.z / (-7.5 * wet), 1, 0.002);
    CHECK_NEAR(rig.line.position[12].z, c->anchor.z - 6, 0.02);
    CHECK_NEAR(rig.line.position[13].z, c->fairlead.z - 3.5, 0.02);
    CHECK(rig.line.tension[12] == 0);
    arena_destroy(&rig.arena);
}

/// Steel wire that snaps to 935 N when it is whole parts at 400 N, in the midst of the snap.
TEST(wire_parts_in_the_midst_of_a_snap)
{
    const DrivenCase *c = driven_case("c3");
    const double steps[] = {1e-3, 2.5e-4};
    for (int k = 0; k < 2; k++) {
        LineScene scene = driven_scene(c, 20);
        scene.breaking_tension = 400;
        Rig rig;
        rig_start(&rig, &scene, driven_water(c), c->anchor, c->fairlead, LINE_STEPPER_BDF2);
        EndPath anchor = still_path(c->anchor);
        double after = 0;
        for (int i = 0; i * steps[k] < 3.9 && rig.good; i++) {
            EndPath path = driven_path(c, i * steps[k], steps[k]);
            rig.good = line_advance(&rig.line, &rig.water, i * steps[k], steps[k], &anchor, &path,
                                    &rig.error);
            rig.good = rig.good && rig_is_sane(&rig, 2e-3);
            if (rig.line.parted_count && i * steps[k] > rig.line.parted_time + 0.1)
                for (int s = 0; s < 20; s++)
                    after = maxd(after, rig.line.tension[s]);
        }
        CHECK(rig.good);
        CHECK(rig.line.parted_count >= 1);
        CHECK(rig.line.parted_time > 0.9 && rig.line.parted_time < 1.4);
        CHECK(rig.line.largest_tension > 400 && rig.line.largest_tension < 480);
        CHECK(after < 20); // what is left hangs, and is shaken
        arena_destroy(&rig.arena);
    }
}

TEST_BOTH(parted_line_is_restored_whole_or_parted)
{
    const DrivenCase *c = driven_case("b7");
    LineScene scene = driven_scene(c, 20);
    Rig rig;
    rig_start(&rig, &scene, driven_water(c), c->anchor, c->fairlead, stepper);
    EndPath anchor = still_path(c->anchor), fairlead = still_path(c->fairlead);
    static double whole[1024], parted[1024], again[1024];
    CHECK(line_state_size(&rig.line) <= 1024);
    line_state_save(&rig.line, whole);
    mooring_break(&rig.line, 5);
    mooring_set_length(&rig.line, 9, 0.5, 0);
    for (int k = 0; k < 10; k++)
        CHECK(line_advance(&rig.line, &rig.water, k * .01, .01, &anchor, &fairlead, &rig.error));
    line_state_save(&rig.line, parted);
    for (int k = 10; k < 20; k++)
        CHECK(line_advance(&rig.line, &rig.water, k * .01, .01, &anchor, &fairlead, &rig.error));
    line_state_save(&rig.line, again);
    line_state_restore(&rig.line, whole);
    CHECK(rig.line.parted_count == 0 && !rig.line.parted[5]);
    CHECK_NEAR(rig.line.length, 10, 0);
    line_state_restore(&rig.line, parted);
    CHECK(rig.line.parted_count == 1 && rig.line.parted[5] && rig.line.length < 10);
    for (int k = 10; k < 20; k++)
        CHECK(line_advance(&rig.line, &rig.water, k * .01, .01, &anchor, &fairlead, &rig.error));
    line_state_save(&rig.line, parted);
    CHECK(!memcmp(parted, again, line_state_size(&rig.line) * sizeof(double)));
    arena_destroy(&rig.arena);
}

/// Wound from one length to another, the line comes to the tension of the static line of that
/// length; its length never jumps.
TEST_BOTH(winch_brings_the_line_to_its_new_length)
{
    const DrivenCase *c = driven_case("b7");
    LineScene scene = driven_scene(c, 20), wound = scene;
    wound.length = 9.2;
    Rig rig, other;
    rig_start(&rig, &scene, driven_water(c), c->anchor, c->fairlead, stepper);
    rig_start(&other, &wound, driven_water(c), c->anchor, c->fairlead, stepper);
    EndPath anchor = still_path(c->anchor), fairlead = still_path(c->fairlead);
    double before = rig.line.length, fastest = 0, jolt = 0, rate = 0;
    mooring_set_length(&rig.line, 8, 0.4, 0);
    for (int k = 0; k < 4000 && rig.good; k++) {
        if (k == 200) mooring_set_length(&rig.line, 9.2, 0.4, 1); // thinks better of it
        rig.good =
            line_advance(&rig.line, &rig.water, k * 5e-3, 5e-3, &anchor, &fairlead, &rig.error);
        double now = (rig.line.length - before) / 5e-3;
        jolt = maxd(jolt, fabs(now - rate));
        rate = now;
        fastest = maxd(fastest, fabs(rate));
        before = rig.line.length;
    }
    CHECK(rig.good && rig_is_sane(&rig, 1e-3));
    CHECK_NEAR(rig.line.length, 9.2, 1e-12);
    CHECK(fastest > 0.1 && fastest < 0.5);
    CHECK(jolt < 0.02 * fastest);
    CHECK_NEAR(rig.line.tension[19] / other.line.tension[19], 1, 1e-3);
    arena_destroy(&rig.arena);
    arena_destroy(&other.arena);
}

/// Ends are hinges: a beam on two sags under its weight by 5 w L^4 / (384 EI).
TEST(beam_on_two_hinges_sags_as_it_should)
{
    LineScene scene = driven_scene(driven_case("a3"), 20);
    scene.length = 1;
    scene.bending_stiffness = 400;
    WaterField water = {NULL, NULL, 0, 0, 9.80665, -100};
    double weight = scene.mass_per_length * 9.80665, sag = 5 * weight / (384 * 400);
    Rig rig; // the ends are as far apart as the line is long: so small a sag hardly stretches it
    rig_start(&rig, &scene, water, vec3(0, 0, -1), vec3(1, 0, -1), LINE_STEPPER_BDF2);
    CHECK(rig.good);
    CHECK_NEAR((-1 - rig.line.position[10].z) / sag, 1, 0.01);
    for (int stepper = 0; stepper < 2; stepper++) { // and stays there
        rig.line.stepper = stepper;
        EndPath ends[2] = {still_path(vec3(0, 0, -1)), still_path(vec3(1, 0, -1))};
        for (int k = 0; k < 50; k++)
            CHECK(line_advance(&rig.line, &rig.water, k * 1e-3, 1e-3, &ends[0], &ends[1],
                               &rig.error));
        CHECK_NEAR((-1 - rig.line.position[10].z) / sag, 1, 0.01);
    }
    arena_destroy(&rig.arena);
}

/// First bending mode of a beam on two hinges, (pi/L)^2 sqrt(EI/w), in a vacuum.
TEST(beam_on_two_hinges_swings_with_its_first_period)
{
    for (int stepper = 0; stepper < 2; stepper++) {
        LineScene scene = driven_scene(driven_case("a3"), 20);
        scene.length = 1;
        scene.bending_stiffness = 400;
        WaterField water = {NULL, NULL, 0, 0, 9.80665, -100};
        double omega = PI * PI * sqrt(400 / scene.mass_per_length);
        Rig rig;
        rig_start(&rig, &scene, water, vec3(0, 0, -1), vec3(1, 0, -1), stepper);
        CHECK(rig.good);
        double amplitude = 1e-5, step = 2 * PI / omega / 400;
        for (int i = 1; i < 20; i++)
            rig.line.velocity[i].y = amplitude * omega * sin(PI * i / 20);
        EndPath ends[2] = {still_path(vec3(0, 0, -1)), still_path(vec3(1, 0, -1))};
        double last = 0, first_crossing = NAN, crossing = NAN;
        int crossings = 0;
        for (int k = 0; k < 4000 && rig.good; k++) {
            rig.good =
                line_advance(&rig.line, &rig.water, k * step, step, &ends[0], &ends[1], &rig.error);
            double y = rig.line.position[10].y;
            if (last < 0 && y >= 0) {
                crossing = (k + y / (last - y)) * step;
                if (crossings++ == 0) first_crossing = crossing;
            }
            last = y;
        }
        CHECK(rig.good && crossings > 5);
        double period = (crossing - first_crossing) / (crossings - 1);
        CHECK_NEAR(period * omega / (2 * PI), 1, 0.01);
        arena_destroy(&rig.arena);
    }
}

/// A bent wire at the fluid's step against the explicit step.
TEST(bent_wire_moves_alike_with_both_steppers)
{
    DrivenCase c = *driven_case("c1");
    c.bed = -5;
    c.fairlead = vec3(0.55, 0, -0.3);
    c.heave = 0.02;
    double mean[2] = {0, 0}, place[2] = {0, 0};
    for (int stepper = 0; stepper < 2; stepper++) {
        LineScene scene = driven_scene(&c, 10);
        scene.bending_stiffness = 5e-3;
        Rig rig;
        rig_start(&rig, &scene, driven_water(&c), c.anchor, c.fairlead, stepper);
        EndPath anchor = still_path(c.anchor);
        for (int k = 0; k < 500 && rig.good; k++) {
            EndPath path = driven_path(&c, k * 1e-3, 1e-3);
            rig.good =
                line_advance(&rig.line, &rig.water, k * 1e-3, 1e-3, &anchor, &path, &rig.error);
            mean[stepper] += rig.line.tension[9] / 500;
            place[stepper] += rig.line.position[5].z / 500;
        }
        CHECK(rig.good);
        arena_destroy(&rig.arena);
    }
    printf("  mean tension %.5g and %.5g N, place %.6g and %.6g m\n", mean[0], mean[1], place[0],
           place[1]);
    CHECK_NEAR(mean[1] / mean[0], 1, 0.03);
    CHECK_NEAR(place[1], place[0], 1e-4);
}
