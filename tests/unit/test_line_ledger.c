/// What lines and bodies exchange, by both accounts.
#include "coupling_rig.h"

static LedgerBalance balance(void)
{
    return line_ledger_balance(&rig.ledger, &rig.scene, &rig.body, rig.mooring.lines, 0);
}

static void tell(const char *what, const LedgerBalance *b)
{
    printf(
        "  %s: impulse %.4g N s, off by %.1e; its moment off by %.1e; work %.4g J, off by %.1e\n",
        what, vec3_norm(b->given.impulse), b->impulse_error, b->angular_error, b->given.work,
        b->work_error);
}

/// Ten periods and a quarter of the mass on its undamped spring, at `steps` a period.
static LedgerBalance swing(int steps)
{
    double period = rig_start(0.015, 0, LINE_STEPPER_BDF2);
    for (int k = 0; k < steps * 41 / 4 && rig.good; k++)
        rig_step(period / steps);
    CHECK(rig.good);
    LedgerBalance b = balance();
    tell("swinging", &b);
    arena_destroy(&rig.arena);
    return b;
}

TEST(both_accounts_of_a_mass_on_a_spring_line_agree_to_second_order)
{
    LedgerBalance coarse = swing(40), fine = swing(80);
    CHECK(coarse.good && fine.good);
    CHECK(coarse.impulse_error < 1e-7 && coarse.work_error < 3e-4);
    CHECK(fine.work_error < 0.3 * coarse.work_error);
}

/// A quarter of a period after its lowest point the body is at rest height, and fastest.
TEST(work_that_a_body_takes_is_its_gain_of_energy)
{
    double before = 50 * 9.81 * (rig_start(0.015, 0, LINE_STEPPER_BDF2), rig.body.position.z);
    double period = 2 * PI * sqrt(50.07 / 20000), dt = period / 400;
    for (int k = 0; k < 4100 && rig.good; k++)
        rig_step(dt);
    // its velocity is half a step old
    Vec3 pull = vec3_scale(rig.mooring.lines[0].pull[1], 1 / 50.0);
    double speed = rig.body.velocity.z + 0.5 * dt * (pull.z - 9.81);
    double gained = 0.5 * 50 * speed * speed + 50 * 9.81 * rig.body.position.z - before;
    LedgerBalance b = balance();
    CHECK(rig.good);
    CHECK_NEAR(gained / b.taken.work, 1, 1e-3);
    CHECK_NEAR(gained / b.given.work, 1, 1e-3);
    arena_destroy(&rig.arena);
}

TEST(both_accounts_agree_over_snaps)
{
    for (int stepper = 0; stepper < 2; stepper++) {
        rig_start(-0.3, 0.5, stepper ? LINE_STEPPER_BDF2 : LINE_STEPPER_RK2); // falls into the line
        bool good = true;
        for (int k = 0; k < 1500 && rig.good; k++) {
            rig_step(1e-3);
            bool slack = rig.ledger.body[0].impulse_size < 1e-3; // and always was
            good = good && (slack || balance().good);            // amid a snap, too
        }
        LedgerBalance b = balance();
        CHECK(good);
        CHECK(rig.good && b.good);
        CHECK(b.impulse_error < (stepper ? 1e-6 : 4e-6) && b.work_error < 1e-5);
        tell(stepper ? "implicit" : "explicit", &b);
        arena_destroy(&rig.arena);
    }
}

static void weaken(Body *body) { body->line_force = vec3_scale(body->line_force, 0.995); }
/// As if the line were made fast 2 mm farther forward.
static void shift(Body *body)
{
    Vec3 moment = vec3_cross(vec3(0.002, 0, 0), body->line_force);
    body->line_moment = vec3_add(body->line_moment, moment);
}

/// A body that swings and turns, held beside and above its centre of gravity.
static LedgerBalance turn(double dt, void (*falsify)(Body *))
{
    rig_start(0.015, 0.5, LINE_STEPPER_BDF2);
    Vec3 place = vec3(0.1, -0.05, 0.2);
    rig.scene.lines[0].fairlead.position = place;
    rig.body.position = rig.body.reference_position = vec3_sub(rig.body.position, place);
    rig.ledger = line_ledger_create(&rig.scene, &rig.body, &rig.mooring);
    for (double t = 0; t < 3 && rig.good; t += dt)
        rig_step_with(dt, falsify);
    CHECK(rig.good);
    LedgerBalance b = balance();
    tell("turning", &b);
    arena_destroy(&rig.arena);
    return b;
}

TEST(moments_are_booked_alike_to_second_order)
{
    LedgerBalance coarse = turn(2e-3, NULL), fine = turn(1e-3, NULL);
    CHECK(coarse.good && fine.good);
    CHECK(coarse.angular_error < 1e-5 && fine.angular_error < 0.3 * coarse.angular_error);
    CHECK(coarse.work_error < 1e-4 && fine.work_error < 0.3 * coarse.work_error);
}

TEST(half_a_percent_of_a_pull_that_gets_lost_is_found)
{
    LedgerBalance b = turn(2e-3, weaken);
    CHECK(!b.good);
    CHECK_NEAR(b.impulse_error, 0.005, 1e-4);
}

TEST(a_moment_about_the_wrong_point_is_found)
{
    LedgerBalance b = turn(2e-3, shift);
    CHECK(!b.good);
    CHECK(b.impulse_error < 1e-6 && b.angular_error > 0.001);
}

/// Work on both ends becomes energy of the line where nothing takes it, and less where damping
/// does.
TEST(work_on_a_line_without_damping_is_its_gain_of_energy)
{
    double spent[2];
    for (int damped = 0; damped < 2; damped++) {
        rig_start(0.015, damped ? 1 : 0, LINE_STEPPER_BDF2);
        double largest = 0;
        for (int k = 0; k < 4000 && rig.good; k++) {
            rig_step(5e-4);
            largest = maxd(largest, fabs(rig.ledger.holders_work));
        }
        double gained = mooring_energy(&rig.mooring) - rig.ledger.energy_start;
        CHECK(rig.good);
        spent[damped] = (rig.ledger.holders_work - gained) / largest;
        printf("  up to %.4g J of work on the line, %.1e of it spent\n", largest, spent[damped]);
        arena_destroy(&rig.arena);
    }
    CHECK(fabs(spent[0]) < 1e-3);
    CHECK(spent[1] > 0.01);
}
