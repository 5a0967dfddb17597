/// Lines that meet at points: clump weights, buoys, bridles.
#include "mooring_cases.h"

typedef struct Rig {
    Scene scene;
    LineEnds ends[SCENE_LINES_MAX];
    EndPath paths[SCENE_LINES_MAX][2];
    LineStatics statics[SCENE_LINES_MAX];
    WaterField water;
    Arena arena;
    Mooring mooring;
    Error error;
    bool good;
} Rig;

static Rig rig; // a scene is large

static void rig_begin(const DrivenCase *c)
{
    memset(&rig, 0, sizeof rig);
    rig.scene = scene_default();
    rig.water = driven_water(c);
}

static int add_point(Vec3 guess, double mass, double volume)
{
    PointScene *point = &rig.scene.points[rig.scene.point_count];
    *point = point_scene_default();
    snprintf(point->name, sizeof point->name, "p%d", rig.scene.point_count);
    point->position = guess;
    point->mass = mass;
    point->volume = volume;
    return rig.scene.point_count++;
}

/// A line between two ends: places, or points where their index is not negative.
static void add_line(LineScene line, Vec3 anchor, int anchor_point, Vec3 fairlead,
                     int fairlead_point)
{
    int l = rig.scene.line_count++;
    line.anchor.body = line.fairlead.body = -1;
    line.anchor.point = anchor_point;
    line.fairlead.point = fairlead_point;
    rig.scene.lines[l] = line;
    rig.ends[l].place[0] = anchor;
    rig.ends[l].place[1] = fairlead;
    rig.paths[l][0] = still_path(anchor);
    rig.paths[l][1] = still_path(fairlead);
}

static void rig_start(LineStepper stepper)
{
    rig.arena = arena_create(0);
    rig.good = mooring_create(&rig.scene, rig.ends, &rig.water, &rig.arena, &rig.mooring,
                              rig.statics, &rig.error);
    if (!rig.good) printf("  %s\n", rig.error.message);
    for (int l = 0; l < rig.scene.line_count; l++)
        rig.mooring.lines[l].stepper = stepper;
}

static bool rig_advance(double time, double step)
{
    bool good = mooring_advance(&rig.mooring, &rig.water, time, step, rig.paths, &rig.error);
    if (!good) printf("  %s\n", rig.error.message);
    return good;
}

static LineScene wire(double length, int segments)
{
    LineScene scene = driven_scene(driven_case("c1"), segments);
    scene.length = length;
    return scene;
}

/// A line cut in its middle and joined by a point of no mass is the line it was.
TEST(cut_and_joined_line_moves_as_the_whole)
{
    const char *names[] = {"b5", "b1", "c3"};
    for (int n = 0; n < 6; n++) {
        const DrivenCase *c = driven_case(names[n / 2]);
        LineStepper stepper = n % 2 ? LINE_STEPPER_BDF2 : LINE_STEPPER_RK2;
        double step = n == 5 ? 1e-3 : 0.01, worst = 0;
        if (n == 4) continue; // explicit steel: too slow
        rig_begin(c);
        LineScene whole = driven_scene(c, 20), half = driven_scene(c, 20);
        half.length /= 2;
        half.segments = 10;
        Vec3 guess = vec3_scale(vec3_add(c->anchor, c->fairlead), 0.5);
        int middle = add_point(guess, 0, 0);
        if (n % 2) { // either way round
            add_line(half, c->anchor, -1, guess, middle);
            add_line(half, guess, middle, c->fairlead, -1);
        } else {
            add_line(half, guess, middle, c->anchor, -1);
            add_line(half, c->fairlead, -1, guess, middle);
        }
        rig_start(stepper);
        Arena arena = arena_create(0);
        Line line;
        Error error = {0};
        bool good = line_create(&whole, c->anchor, c->fairlead, &rig.water, "x", &arena, &line,
                                NULL, &error);
        CHECK(good && rig.good);
        if (!good || !rig.good) return;
        line.stepper = stepper;
        EndPath anchor = still_path(c->anchor);
        for (int k = 0; k < 150; k++) {
            EndPath path = driven_path(c, k * step, step);
            rig.paths[1][n % 2] = path;
            CHECK(line_advance(&line, &rig.water, k * step, step, &anchor, &path, &error));
            CHECK(rig_advance(k * step, step));
            for (int i = 0; i < 20; i++) {
                const Line *part = &rig.mooring.lines[i / 10];
                double t = part->tension[n % 2 ? i % 10 : 9 - i % 10];
                worst = maxd(worst, fabs(t - line.tension[i]) / (1 + line.tension[i]));
            }
        }
        CHECK(worst < 1e-4);
        CHECK(line.largest_tension > 0.1);
        arena_destroy(&arena);
        arena_destroy(&rig.arena);
    }
}

/// A clump on two wires: its weight in water is shared as the angles say.
TEST(clump_hangs_where_its_forces_balance)
{
    rig_begin(driven_case("c1"));
    rig.water.bed = -50;
    int clump = add_point(vec3(0.4, 0.1, -1.5), 20, 0.0025);
    add_line(wire(1.0, 10), vec3(0, 0, -1), -1, vec3(0, 0, 0), clump);
    add_line(wire(0.8, 10), vec3(1.2, 0, -1), -1, vec3(0, 0, 0), clump);
    rig_start(LINE_STEPPER_BDF2);
    CHECK(rig.good);
    Vec3 at = rig.mooring.points[0].position;
    // wires of 0.3 N/m hardly sag under 173 N: an intersection of two circles
    double x = (1 * 1 - 0.8 * 0.8 + 1.2 * 1.2) / 2.4, z = -1 - sqrt(1 - x * x);
    CHECK_NEAR(at.x, x, 1e-3);
    CHECK_NEAR(at.y, 0, 1e-6);
    CHECK_NEAR(at.z, z, 1e-3);
    double weight = (20 - 2.5) * 9.80665,
           lines = 1.8 * (0.0305 - 1000 * PI / 4 * 0.002213 * 0.002213) * 9.80665;
    double carried = rig.mooring.lines[0].anchor_force.z + rig.mooring.lines[1].anchor_force.z;
    CHECK_NEAR(carried, -weight - lines, 1e-6 * weight);
    for (int k = 0; k < 100; k++)
        CHECK(rig_advance(k * 1e-3, 1e-3));
    CHECK(vec3_norm(vec3_sub(rig.mooring.points[0].position, at)) < 1e-8);
    arena_destroy(&rig.arena);
}

/// A buoy on a chain floats so deep that it carries what does not lie on the bed.
TEST(buoy_floats_as_deep_as_it_must)
{
    const DrivenCase *c = driven_case("b1");
    rig_begin(c);
    int buoy = add_point(vec3(2, 0, -0.5), 10, 0.1);
    add_line(driven_scene(c, 20), c->anchor, -1, vec3(0, 0, 0), buoy);
    rig_start(LINE_STEPPER_BDF2);
    CHECK(rig.good);
    double wet = (c->mass - c->density * PI / 4 * c->diameter * c->diameter) * 9.80665;
    double chain = wet * (3 + rig.mooring.points[0].position.z);
    double radius = cbrt(0.3 / (4 * PI)), z = rig.mooring.points[0].position.z;
    double share = (radius - z) / (2 * radius);
    CHECK_NEAR(share * 0.1 * c->density * 9.80665, 10 * 9.80665 + chain, 0.01 * chain);
    for (int k = 0; k < 200; k++)
        CHECK(rig_advance(k * 5e-3, 5e-3));
    CHECK_NEAR(rig.mooring.points[0].position.z, z, 1e-4);
    arena_destroy(&rig.arena);
}

/// Steel wires on a clump of 50 g, shaken so that they snap: the implicit step at a fluid's step
/// against the explicit one.
TEST(light_clump_between_steel_wires_moves_alike_with_both_steppers)
{
    const DrivenCase *c = driven_case("c1");
    double sum[2][2] = {{0, 0}, {0, 0}}, largest[2];
    for (int stepper = 0; stepper < 2; stepper++) {
        rig_begin(c);
        rig.water.bed = -5;
        int clump = add_point(vec3(0.2, 0, -0.4), 0.05, 1e-5);
        add_line(wire(0.25, 5), vec3(0, 0, -0.5), -1, vec3(0, 0, 0), clump);
        add_line(wire(0.25, 5), vec3(0, 0, 0), clump, vec3(0.35, 0, -0.2), -1);
        add_line(wire(0.22, 5), vec3(0.2, 0.15, -0.3), -1, vec3(0, 0, 0), clump);
        rig_start(stepper ? LINE_STEPPER_BDF2 : LINE_STEPPER_RK2);
        CHECK(rig.good);
        double step = stepper ? 2.5e-4 : 1e-3;
        DrivenCase moved = *c;
        moved.fairlead = vec3(0.35, 0, -0.2);
        moved.heave = 0.05;
        moved.period = 0.5;
        int count = (int)(0.5 / step + 0.5);
        for (int k = 0; k < count && rig.good; k++) {
            rig.paths[1][1] = driven_path(&moved, k * step, step);
            rig.good = rig_advance(k * step, step);
            double t = rig.mooring.lines[1].tension[4];
            sum[stepper][0] += t / count;
            sum[stepper][1] += rig.mooring.points[0].position.z / count;
            CHECK(t >= 0);
        }
        largest[stepper] = rig.mooring.lines[1].largest_tension;
        CHECK(rig.good);
        arena_destroy(&rig.arena);
    }
    printf("  mean %.5g %.5g N, clump at %.6g %.6g m, largest %.4g %.4g N\n", sum[0][0], sum[1][0],
           sum[0][1], sum[1][1], largest[0], largest[1]);
    CHECK_NEAR(sum[1][0] / sum[0][0], 1, 0.03);
    CHECK_NEAR(sum[1][1], sum[0][1], 1e-4);
}

TEST(free_point_without_lines_and_lines_too_short_are_refused)
{
    rig_begin(driven_case("c1"));
    add_point(vec3(0, 0, -1), 1, 0);
    add_line(wire(1, 10), vec3(0, 0, -1), -1, vec3(0.5, 0, -1), -1);
    rig.arena = arena_create(0);
    rig.good = mooring_create(&rig.scene, rig.ends, &rig.water, &rig.arena, &rig.mooring,
                              rig.statics, &rig.error);
    CHECK(!rig.good && rig.error.code == ERROR_INPUT);
    CHECK_CONTAINS(rig.error.message, "points[0] (p0)");
    arena_destroy(&rig.arena);

    rig_begin(driven_case("c1"));
    int point = add_point(vec3(0.5, 0, -1), 1, 0);
    add_line(wire(0.4, 10), vec3(0, 0, -1), -1, vec3(0, 0, 0), point);
    add_line(wire(0.5, 10), vec3(0, 0, 0), point, vec3(1, 0, -1), -1);
    rig.arena = arena_create(0);
    rig.good = mooring_create(&rig.scene, rig.ends, &rig.water, &rig.arena, &rig.mooring,
                              rig.statics, &rig.error);
    CHECK(!rig.good && rig.error.code == ERROR_INPUT);
    CHECK_CONTAINS(rig.error.message, "cannot reach");
    arena_destroy(&rig.arena);
}
