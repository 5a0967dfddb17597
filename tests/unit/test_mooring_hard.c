/// What must never happen to a line, and what its explicit limit means.
#include "mooring_cases.h"
#include "physics/line.h"

typedef struct Rig {
    LineScene scene;
    WaterField water;
    Arena arena;
    Line line;
    Error error;
    bool good;
} Rig;

static void rig_start(Rig *rig, const DrivenCase *c, LineStepper stepper, Vec3 anchor,
                      Vec3 fairlead)
{
    memset(rig, 0, sizeof *rig);
    rig->scene = driven_scene(c, 20);
    rig->water = driven_water(c);
    rig->arena = arena_create(0);
    rig->good = line_create(&rig->scene, anchor, fairlead, &rig->water, "lines.rig", &rig->arena,
                            &rig->line, NULL, &rig->error);
    rig->line.stepper = stepper;
}

/// A fact of either stepper, which the body knows as `stepper`.
#define TEST_BOTH(fact)                                                                            \
    static void fact##_check(LineStepper stepper);                                                 \
    TEST(rk2_##fact) { fact##_check(LINE_STEPPER_RK2); }                                           \
    TEST(bdf2_##fact) { fact##_check(LINE_STEPPER_BDF2); }                                         \
    static void fact##_check(LineStepper stepper)

/// True when every number of the state is finite and no segment pushes.
static bool state_is_sane(const Line *line)
{
    for (int i = 0; i < line->node_count; i++)
        if (!isfinite(vec3_norm(line->position[i])) || !isfinite(vec3_norm(line->velocity[i])))
            return false;
    for (int i = 0; i + 1 < line->node_count; i++)
        if (!(line->tension[i] >= 0)) return false;
    return true;
}

TEST_BOTH(line_at_rest_stays_at_rest)
{
    const DrivenCase *c = driven_case("b1");
    Rig rig;
    rig_start(&rig, c, stepper, c->anchor, c->fairlead);
    CHECK(rig.good);
    EndPath anchor = still_path(c->anchor), fairlead = still_path(c->fairlead);
    double before = rig.line.tension[19], fastest = 0;
    for (int k = 0; k < 50; k++) {
        CHECK(line_advance(&rig.line, &rig.water, k * 0.01, 0.01, &anchor, &fairlead, &rig.error));
        for (int i = 0; i < 21; i++)
            fastest = maxd(fastest, vec3_norm(rig.line.velocity[i]));
    }
    CHECK(fastest < 1e-7);
    CHECK_NEAR(rig.line.tension[19] / before, 1, 1e-6);
    arena_destroy(&rig.arena);
}

/// At rest both pulls and the bed carry the wet weight; the fairlead's is the catenary's end force.
TEST_BOTH(fairlead_force_is_the_end_force_of_the_catenary)
{
    const DrivenCase *c = driven_case("a1");
    Rig rig;
    rig_start(&rig, c, stepper, c->anchor, c->fairlead);
    EndPath anchor = still_path(c->anchor), fairlead = still_path(c->fairlead);
    CHECK(line_advance(&rig.line, &rig.water, 0, 0.01, &anchor, &fairlead, &rig.error));
    double wet = (c->mass - c->density * PI / 4 * c->diameter * c->diameter) * 9.80665 * c->length;
    CHECK_NEAR(rig.line.anchor_force.z + rig.line.fairlead_force.z, -wet, 1e-6 * wet);
    CHECK_NEAR(rig.line.anchor_force.x + rig.line.fairlead_force.x, 0, 1e-6 * wet);
    CHECK_NEAR(vec3_norm(rig.line.fairlead_force) / 151.06231611953237, 1, 0.002);
    arena_destroy(&rig.arena);
}

/// Momentum given to a line in a vacuum without weight is what its ends took up.
TEST_BOTH(end_forces_balance_the_line_s_momentum)
{
    DrivenCase c = *driven_case("a3");
    c.density = 0;
    Rig rig;
    rig_start(&rig, &c, stepper, c.anchor, c.fairlead);
    Vec3 shake = vec3(0.3, 0.2, -0.4), given = vec3(0, 0, 0), momentum = vec3(0, 0, 0);
    EndPath anchor = still_path(c.anchor);
    double step = 0.002;
    for (int k = 0; k < 100; k++) { // the first half of a smooth push: the end is at its fastest
        EndPath path;
        for (int side = 0; side < 2; side++) {
            double s = (k + side) / 200.0;
            path.position[side] = vec3_mad(c.fairlead, shake, s * s * (3 - 2 * s));
            path.velocity[side] = vec3_scale(shake, 6 * (s - s * s) / 0.4);
        }
        CHECK(line_advance(&rig.line, &rig.water, k * step, step, &anchor, &path, &rig.error));
        given = vec3_mad(given, rig.line.anchor_force, -step);
        given = vec3_mad(given, rig.line.fairlead_force, -step);
        given.z -= c.mass * 9.80665 * c.length * step;
    }
    double half = c.mass * c.length / 20;
    for (int i = 0; i < 21; i++)
        momentum = vec3_mad(momentum, rig.line.velocity[i], i == 0 || i == 20 ? half / 2 : half);
    CHECK(vec3_norm(momentum) > 0.5);
    CHECK(vec3_norm(vec3_sub(momentum, given)) < 1e-3 * vec3_norm(momentum));
    arena_destroy(&rig.arena);
}

/// Pluck a taut line without water and internal damping: kinetic and elastic energy must not grow.
TEST_BOTH(energy_of_a_plucked_line_does_not_grow)
{
    DrivenCase c = *driven_case("a3");
    c.density = 0;
    c.damping = -0.02;
    Rig rig;
    rig_start(&rig, &c, stepper, c.anchor, c.fairlead);
    EndPath anchor = still_path(c.anchor), fairlead = still_path(c.fairlead);
    for (int i = 1; i < 20; i++)
        rig.line.velocity[i].y = 2 * sin(PI * i / 20);
    double first = 0, last = 0, highest = 0;
    for (int k = 0; k < 500; k++) {
        double energy = 0, l = c.length / 20;
        for (int i = 0; i < 20; i++) {
            double s = vec3_norm(vec3_sub(rig.line.position[i + 1], rig.line.position[i])) - l;
            energy += 0.5 * c.stiffness / l * s * s +
                      c.mass * l * 9.80665 * rig.line.position[i].z +
                      0.5 * c.mass * l * vec3_dot(rig.line.velocity[i], rig.line.velocity[i]);
        }
        first = k ? first : energy;
        last = energy;
        highest = maxd(highest, energy - first);
        CHECK(line_advance(&rig.line, &rig.water, k * .01, .01, &anchor, &fairlead, &rig.error));
    }
    double pluck = 0.25 * c.mass * c.length * 4; // kinetic energy given
    CHECK(highest < 1e-3 * pluck);
    CHECK(last - first > -0.5 * pluck); // and it is not eaten by the step either
    arena_destroy(&rig.arena);
}

/// Drive a slack chain hard enough to snap every period; RK2 with its sub-step times `factor`.
static bool survives_snapping(double factor, Error *error)
{
    DrivenCase c = *driven_case("b5");
    c.bed = -100;
    c.damping = -1;
    Rig rig;
    rig_start(&rig, &c, LINE_STEPPER_RK2, c.anchor, c.fairlead);
    // the rope never comes near the bed: its own limit is the one of segments
    double travel = c.length / 20 * sqrt(c.mass / c.stiffness);
    rig.line.step_limit = factor * 0.45 * travel;
    EndPath anchor = still_path(c.anchor);
    bool good = true;
    for (int k = 0; good && k < 400; k++) {
        EndPath path = driven_path(&c, k * 0.05, 0.05);
        good = line_advance(&rig.line, &rig.water, k * 0.05, 0.05, &anchor, &path, &rig.error);
        if (good) CHECK(state_is_sane(&rig.line));
    }
    *error = rig.error;
    arena_destroy(&rig.arena);
    return good;
}

TEST(rk2_below_its_limit_survives_and_far_above_it_says_which_node_and_when)
{
    Error error = {0};
    CHECK(survives_snapping(1, &error));
    CHECK(!survives_snapping(6, &error));
    CHECK(error.code == ERROR_PHYSICS);
    CHECK_CONTAINS(error.message, "line b5: node");
    CHECK_CONTAINS(error.message, "at t = ");
}

TEST(step_limit_is_the_smallest_of_taut_slack_and_bed)
{
    struct {
        double zeta, bed_damping, expected;
    } rows[] = {
        {1, 0, 0.5},      // slack binds
        {2, 0, 0.268},    // over-damped: 1/(2 + sqrt 3)
        {0.01, 0, 0.222}, // nearly undamped
        {1, 3e5, -1},     // bed: 2 w/(cb d)
    };
    const DrivenCase *c = driven_case("b5");
    double travel = c->length / 20 * sqrt(c->mass / c->stiffness);
    for (int i = 0; i < 4; i++) {
        DrivenCase changed = *c;
        changed.damping = -rows[i].zeta;
        LineScene scene = driven_scene(&changed, 20);
        scene.bed_stiffness = 1e3;
        scene.bed_damping = rows[i].bed_damping;
        if (rows[i].bed_damping == 0) scene.bed_stiffness = 0;
        WaterField water = driven_water(c);
        Arena arena = arena_create(0);
        Line line;
        Error error = {0};
        CHECK(
            line_create(&scene, c->anchor, c->fairlead, &water, "x", &arena, &line, NULL, &error));
        double expected =
            rows[i].expected > 0 ? rows[i].expected * travel : 2 * c->mass / (3e5 * c->diameter);
        CHECK(line.step_limit > 0.8 * expected && line.step_limit < expected);
        arena_destroy(&arena);
    }
}

/// Slack lines, heaps, ends in one place and an anchor above the fairlead, all thrown about.
TEST_BOTH(no_configuration_gives_a_push_or_a_not_a_number)
{
    DrivenCase c = *driven_case("b5");
    const Vec3 ends[][2] = {
        {{0, 0, -100}, {10, 0, -80}},  // heap
        {{0, 0, -100}, {0, 0, -50}},   // heap under the fairlead
        {{0, 0, -60}, {0, 0, -60}},    // folded, both ends in one place
        {{0, 0, -10}, {30, 5, -50}},   // anchor above fairlead
        {{0, 0, -100}, {40, 9, -100}}, // all on the bed
        {{0, 0, -20}, {20, 0, 2}},     // in and out of the water
    };
    c.surge = 8;
    c.heave = 6;
    c.period = 3;
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        Rig rig;
        c.fairlead = ends[i][1];
        rig_start(&rig, &c, stepper, ends[i][0], ends[i][1]);
        CHECK(rig.good);
        EndPath anchor = still_path(ends[i][0]);
        for (int k = 0; k < 300; k++) {
            EndPath path = driven_path(&c, k * 0.02, 0.02);
            CHECK(line_advance(&rig.line, &rig.water, k * 0.02, 0.02, &anchor, &path, &rig.error));
            if (!state_is_sane(&rig.line)) {
                CHECK(state_is_sane(&rig.line));
                break;
            }
        }
        arena_destroy(&rig.arena);
    }
}

TEST(bed_never_pulls_and_carries_what_rests_on_it)
{
    const DrivenCase *c = driven_case("b1");
    LineScene scene = driven_scene(c, 20);
    WaterField water = driven_water(c);
    Rig rig;
    rig_start(&rig, c, LINE_STEPPER_RK2, c->anchor, c->fairlead);
    LineConstants k;
    memset(&k, 0, sizeof k);
    k.bed = -3;
    k.bed_stiffness = scene.bed_stiffness * c->diameter * 0.3;
    k.bed_damping = scene.bed_damping * c->diameter * 0.3;
    k.bed_ramp = 0.05 * c->diameter;
    for (double depth = -1e-3; depth < 2e-3; depth += 1e-4)
        for (double rate = -1; rate <= 1; rate += 0.1)
            CHECK(line_bed_force(&k, 1, water.bed - depth, rate) >= 0);
    CHECK_NEAR(line_bed_force(&k, 1, -3 - 1e-3, 0), k.bed_stiffness * 1e-3, 1e-9);
    CHECK(line_bed_force(&k, 1, -2.9999, -1) == 0);
    arena_destroy(&rig.arena);
}

TEST_BOTH(friction_stops_a_sliding_chain)
{
    DrivenCase c = *driven_case("b1");
    Rig rig;
    double run[2];
    for (int with = 0; with < 2; with++) {
        rig_start(&rig, &c, stepper, vec3(0, 0, -3), vec3(5.9, 0, -3));
        arena_destroy(&rig.arena);
        rig.scene.bed_friction = with ? 0.5 : 0;
        rig.arena = arena_create(0);
        CHECK(line_create(&rig.scene, vec3(0, 0, -3), vec3(5.9, 0, -3), &rig.water, "x", &rig.arena,
                          &rig.line, NULL, &rig.error));
        rig.line.stepper = stepper;
        EndPath anchor = still_path(vec3(0, 0, -3)), fairlead = still_path(vec3(5.9, 0, -3));
        for (int i = 1; i < 20; i++)
            rig.line.velocity[i].y = 0.3;
        double start = rig.line.position[10].y;
        for (int k = 0; k < 20; k++)
            CHECK(
                line_advance(&rig.line, &rig.water, k * .01, .01, &anchor, &fairlead, &rig.error));
        run[with] = rig.line.position[10].y - start;
        arena_destroy(&rig.arena);
    }
    // v^2/(2 mu g) times the share of the mass that is not borne by the bed's friction (added mass)
    CHECK(run[0] > 0.03);
    CHECK(run[1] > 0.005 && run[1] < 0.015);
}

TEST(buoyancy_and_drag_act_only_where_the_line_is_wet)
{
    CHECK(line_wet_fraction(1, 2, 0.01) == 1);
    CHECK(line_wet_fraction(-1, -2, 0.01) == 0);
    CHECK_NEAR(line_wet_fraction(-1, 3, 0.01), 0.75, 1e-4);
    CHECK_NEAR(line_wet_fraction(3, -1, 0.01), 0.75, 1e-4);
    CHECK_NEAR(line_wet_fraction(0, 0, 0.01), 0.5, 1e-12);
    double before = 0; // rises smoothly as a level or tilted segment sinks
    for (double depth = -0.02; depth < 0.02; depth += 1e-4) {
        double f = line_wet_fraction(depth, depth + 1e-6, 0.01);
        CHECK(f >= before && f - before < 0.01);
        before = f;
    }
}

/// Water that flows and accelerates, above a moving surface.
static void stream(const void *context, LineWater kind, double time, int count,
                   const Vec3 *position, Vec3 *velocity, Vec3 *acceleration, double *elevation)
{
    const Vec3 *speed = context;
    for (int i = 0; i < count; i++) {
        velocity[i] = *speed;
        acceleration[i] = vec3(0, 0, 0);
        elevation[i] = 0;
    }
}

TEST_BOTH(current_drags_a_line_along)
{
    const DrivenCase *c = driven_case("b7");
    Rig rig;
    rig_start(&rig, c, stepper, c->anchor, c->fairlead);
    Vec3 speed = vec3(0, 0.5, 0);
    rig.water.at_nodes = stream;
    rig.water.context = &speed;
    EndPath anchor = still_path(c->anchor), fairlead = still_path(c->fairlead);
    for (int k = 0; k < 400; k++)
        CHECK(line_advance(&rig.line, &rig.water, k * .02, .02, &anchor, &fairlead, &rig.error));
    // the drag on the line, 1/2 rho d L Cdn U^2 and a little less, is handed to its ends
    double full = 0.5 * c->density * c->diameter * c->length * c->drag_normal * 0.25;
    double carried = rig.line.anchor_force.y + rig.line.fairlead_force.y;
    CHECK(carried > 0.8 * full && carried < 1.01 * full);
    arena_destroy(&rig.arena);
}

TEST_BOTH(saved_line_continues_with_the_same_bits)
{
    const DrivenCase *c = driven_case("b2");
    Rig rig, other;
    rig_start(&rig, c, stepper, c->anchor, c->fairlead);
    rig_start(&other, c, stepper, c->anchor, vec3(5.1, 0, -1.1));
    EndPath anchor = still_path(c->anchor);
    double saved[1024];
    CHECK(line_state_size(&rig.line) <= 1024);
    for (int k = 0; k < 40; k++) {
        EndPath path = driven_path(c, k * 0.01, 0.01);
        if (k == 20) {
            line_state_save(&rig.line, saved);
            line_state_restore(&other.line, saved);
        }
        CHECK(line_advance(&rig.line, &rig.water, k * .01, .01, &anchor, &path, &rig.error));
        if (k >= 20)
            CHECK(line_advance(&other.line, &rig.water, k * .01, .01, &anchor, &path, &rig.error));
    }
    double a[1024], b[1024];
    line_state_save(&rig.line, a);
    line_state_save(&other.line, b);
    CHECK(!memcmp(a, b, line_state_size(&rig.line) * sizeof(double)));
    arena_destroy(&rig.arena);
    arena_destroy(&other.arena);
}

TEST_BOTH(step_takes_no_memory)
{
    const DrivenCase *c = driven_case("b2");
    Rig rig;
    rig_start(&rig, c, stepper, c->anchor, c->fairlead);
    size_t before = rig.arena.bytes;
    EndPath anchor = still_path(c->anchor), path = driven_path(c, 0, 0.01);
    CHECK(line_advance(&rig.line, &rig.water, 0, .01, &anchor, &path, &rig.error));
    CHECK(rig.arena.bytes == before);
    arena_destroy(&rig.arena);
}

/// Steel wire hung up between two points: the implicit step at a fluid's step against the explicit
/// one at 3 microseconds.
TEST(bdf2_steel_wire_swings_as_with_the_explicit_step)
{
    DrivenCase c = *driven_case("c1");
    double tension[2][60];
    c.bed = -5;
    for (int stepper = 0; stepper < 2; stepper++) {
        Rig rig;
        rig_start(&rig, &c, stepper ? LINE_STEPPER_BDF2 : LINE_STEPPER_RK2, c.anchor, c.fairlead);
        rig.line.step_limit = 2.5e-6; // the bed, out of reach, does not count
        EndPath anchor = still_path(c.anchor);
        for (int k = 0; k < 300; k++) {
            EndPath path = driven_path(&c, k * 1e-3, 1e-3);
            CHECK(line_advance(&rig.line, &rig.water, k * 1e-3, 1e-3, &anchor, &path, &rig.error));
            if (k % 5 == 4) tension[stepper][k / 5] = rig.line.tension[19];
        }
        arena_destroy(&rig.arena);
    }
    for (int k = 0; k < 60; k++)
        CHECK_NEAR(tension[1][k] / tension[0][k], 1, 0.005);
}

/// Steps of every length one after the other, a heave that snaps, and 200 segments.
TEST(bdf2_takes_steps_of_any_length)
{
    DrivenCase c = *driven_case("c3");
    Rig rig;
    rig_start(&rig, &c, LINE_STEPPER_BDF2, c.anchor, c.fairlead);
    arena_destroy(&rig.arena);
    rig.arena = arena_create(0);
    rig.scene = driven_scene(&c, 200);
    CHECK(line_create(&rig.scene, c.anchor, c.fairlead, &rig.water, "x", &rig.arena, &rig.line,
                      NULL, &rig.error));
    rig.line.stepper = LINE_STEPPER_BDF2;
    EndPath anchor = still_path(c.anchor);
    double time = 0, longest = 0;
    for (int k = 0; time < 2; k++) {
        double step = k % 7 == 0 ? 1e-5 : k % 3 == 0 ? 4e-3 : 7e-4;
        EndPath path = driven_path(&c, time, step);
        CHECK(line_advance(&rig.line, &rig.water, time, step, &anchor, &path, &rig.error));
        time += step;
        if (!state_is_sane(&rig.line)) break;
        for (int i = 0; i < 200; i++)
            longest =
                maxd(longest, vec3_norm(vec3_sub(rig.line.position[i + 1], rig.line.position[i])) /
                                  (c.length / 200));
    }
    CHECK(state_is_sane(&rig.line));
    CHECK(longest < 1.003); // 935 N is a strain of 0.00126
    CHECK_NEAR(rig.line.largest_tension, 935, 20);
    arena_destroy(&rig.arena);
}

TEST(bdf2_end_that_is_not_a_number_is_reported)
{
    const DrivenCase *c = driven_case("b7");
    Rig rig;
    rig_start(&rig, c, LINE_STEPPER_BDF2, c->anchor, c->fairlead);
    EndPath anchor = still_path(c->anchor), path = still_path(vec3(NAN, 0, 0));
    CHECK(!line_advance(&rig.line, &rig.water, 0, 1e-3, &anchor, &path, &rig.error));
    CHECK(rig.error.code == ERROR_PHYSICS);
    CHECK_CONTAINS(rig.error.message, "line b7: node");
    CHECK(state_is_sane(&rig.line)); // the last good state is left in place
    arena_destroy(&rig.arena);
}
