/// Lines steered while they run: winch, cut, roll-back.
#include "scenes.h"

static Run *start_lines(void)
{
    static Scene scene;
    bool good =
        scene_load(SOURCE_DIR "/tests/good_cases/steered_lines.json", NULL, 0, &scene, &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return start(&scene, 1);
}

static bool order(Run *run, const char *line, double length, int cut)
{
    Command command = command_default();
    snprintf(command.line, sizeof command.line, "%s", line);
    command.line_length = length;
    command.line_cut = cut;
    error.message[0] = 0;
    return state_command(&run->scene, run->state, &command, &error);
}

TEST(a_winch_hauls_in_to_the_length_asked_for_no_faster_than_its_speed)
{
    Run *run = start_lines();
    CHECK(order(run, "fore", 4.6, CUT_NOWHERE));
    const Line *line = &run->state->lines[0];
    double before = line->length, began = run->state->time, rest = line->tension[19];
    CHECK(before == 4.8);
    while (run->state->time < began + 4) {
        double length = line->length, time = run->state->time;
        advance_to(run, time + 0.01);
        CHECK((length - line->length) / (run->state->time - time) <= 0.2 * (1 + 1e-6));
    }
    CHECK_NEAR(line->length, 4.6, 1e-9);
    CHECK(line->tension[19] > 1.2 * rest);
    CHECK(run->state->lines[1].length == 4.8);
    finish(run);
}

TEST(orders_beyond_a_winch_or_without_one_or_for_no_line_are_refused)
{
    Run *run = start_lines();
    CHECK(!order(run, "fore", 6, CUT_NOWHERE));
    CHECK_CONTAINS(error.message, "line.length_m = 6: must be >= 4.5 and <= 5.5 m");
    CHECK(!order(run, "aft", 4.7, CUT_NOWHERE));
    CHECK_CONTAINS(error.message, "line.length_m = 4.7: line aft has no winch");
    CHECK(!order(run, "bow", 4.7, CUT_NOWHERE));
    CHECK_CONTAINS(error.message, "line.name = \"bow\": must be one of this case's lines, as fore");
    CHECK(!order(run, "fore", NAN, CUT_NOWHERE));
    CHECK(isnan(run->state->orders[0].length) && isnan(run->state->orders[1].length));
    finish(run);
}

TEST(a_line_that_is_cut_lets_go_is_told_once_and_takes_no_more_orders)
{
    Run *run = start_lines();
    advance_to(run, 0.5);
    double pulled = vec3_norm(run->state->lines[1].fairlead_force);
    CHECK(order(run, "aft", NAN, CUT_FAIRLEAD));
    advance_to(run, 2);
    const Line *line = &run->state->lines[1];
    CHECK(line->parted_count == 1 && line->tension[19] == 0);
    CHECK(vec3_norm(line->fairlead_force) < 0.2 * pulled);
    for (int i = 0; i < line->node_count; i++)
        CHECK(isfinite(line->position[i].z) && line->position[i].z > -2.1);
    CHECK(run->state->events->count == 1 && run->state->events->kept[0].kind == LINE_BROKE);
    CHECK(run->state->events->kept[0].line == 1 && run->state->events->kept[0].tension > 1);
    CHECK(!order(run, "aft", NAN, CUT_MIDDLE));
    CHECK_CONTAINS(error.message, "has been cut");
    finish(run);
}

TEST(orders_given_since_the_checkpoint_survive_a_roll_back)
{
    Run *run = start_lines();
    advance_to(run, 1.03);
    CHECK(order(run, "fore", 4.7, CUT_NOWHERE));
    CHECK(order(run, "aft", NAN, CUT_MIDDLE));
    advance_to(run, run->state->time + 2 * run->plan.time_step);
    run->state->lines[0].position[5].x = NAN;
    run->state->lines[0].velocity[5].x = NAN;
    CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
    CHECK(run->state->health.recoveries == 1);
    CHECK(run->state->lines[1].parted_count == 1);
    advance_to(run, 4);
    CHECK_NEAR(run->state->lines[0].length, 4.7, 1e-9);
    CHECK(run->state->lines[1].parted_count == 1 && run->state->events->count == 1);
    finish(run);
}

/// What was booked since the checkpoint did not happen; afterwards the sums still agree.
TEST(a_roll_back_takes_the_ledger_with_it_and_health_tells_when_it_is_false)
{
    Run *run = start_lines();
    int b = 0;
    while (b < run->scene.body_count && !run->state->ledger->body[b].holds)
        b++;
    CHECK(b < run->scene.body_count);
    advance_to(run, 1.03);
    run->state->lines[0].position[5].x = NAN;
    run->state->lines[0].velocity[5].x = NAN;
    Vec3 then = run->state->checkpoint.ledger->body[b].given.impulse;
    CHECK(vec3_norm(then) > 0);
    CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
    Vec3 now = run->state->ledger->body[b].given.impulse;
    CHECK(run->state->health.recoveries == 1);
    CHECK(vec3_norm(vec3_sub(now, then)) == 0);
    run->state->health.status = HEALTH_GOOD;
    run->state->health.message[0] = 0;
    advance_to(run, run->state->time + 1);
    CHECK(run->state->step > LEDGER_STEPS_LEAST && !run->state->health.message[0]);
    Vec3 *taken = &run->state->ledger->body[b].taken.impulse;
    *taken = vec3_scale(*taken, 2);
    advance_to(run, run->state->time + 0.2);
    CHECK_CONTAINS(run->state->health.message, "differ on what they exchanged");
    finish(run);
}
