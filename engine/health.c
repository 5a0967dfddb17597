#include "health.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "step.h"

/// Lines and bodies that disagree on what they exchanged are not sick, but never silent.
static void note_exchange(const Scene *scene, State *state)
{
    if (!state->ledger || state->step < LEDGER_STEPS_LEAST) return;
    for (int b = 0; b < scene->body_count; b++) {
        if (!state->ledger->body[b].holds || state->health.status != HEALTH_GOOD) continue;
        LedgerBalance balance =
            line_ledger_balance(state->ledger, scene, state->bodies, state->lines, b);
        if (balance.good) continue;
        snprintf(state->health.message, sizeof state->health.message,
                 "body %s: it and its lines differ on what they exchanged until t = %.3f s: "
                 "impulse by %.2g (limit %g), its moment by %.2g (%g), work by %.2g (%g) of all",
                 scene->bodies[b].name, state->time, balance.impulse_error, LEDGER_IMPULSE_BOUND,
                 balance.angular_error, LEDGER_IMPULSE_BOUND, balance.work_error,
                 LEDGER_WORK_BOUND);
    }
}

void health_checkpoint(const Scene *scene, State *state)
{
    Checkpoint *c = &state->checkpoint;
    if (state->time < c->time + HEALTH_CHECKPOINT_EVERY) return;
    // the step grows again when all went well for a while, longer after each relapse
    HealthRecord *health = &state->health;
    if (health->tries > 0 && ++health->good_intervals >= HEALTH_PATIENCE * health->recoveries) {
        health->good_intervals = 0;
        health->tries--;
        state->time_step *= 2;
    }
    note_exchange(scene, state);
    c->time = state->time;
    c->step = state->step;
    if (c->waves) *c->waves = *state->waves;
    if (c->quality) *c->quality = *state->quality;
    c->line_work = state->line_work;
    memcpy(c->bodies, state->bodies, (size_t)scene->body_count * sizeof(Body));
    memcpy(c->slammings, state->slammings, (size_t)scene->slamming_count * sizeof(Slamming));
    for (int l = 0; l < scene->line_count; l++)
        line_state_save(&state->lines[l], c->lines[l]);
    memcpy(c->watches, state->watches, (size_t)scene->line_count * sizeof(LineWatch));
    memcpy(c->orders, state->orders, (size_t)scene->line_count * sizeof(LineOrder));
    if (c->ledger) *c->ledger = *state->ledger;
    state->backend->save(state->particles, c->particles);
}

static void roll_back(const Scene *scene, State *state)
{
    const Checkpoint *c = &state->checkpoint;
    state->time = c->time;
    state->step = c->step;
    state->line_work = c->line_work;
    memcpy(state->bodies, c->bodies, (size_t)scene->body_count * sizeof(Body));
    memcpy(state->slammings, c->slammings, (size_t)scene->slamming_count * sizeof(Slamming));
    for (int l = 0; l < scene->line_count; l++)
        line_state_restore(&state->lines[l], c->lines[l]);
    memcpy(state->watches, c->watches, (size_t)scene->line_count * sizeof(LineWatch));
    if (c->ledger) *state->ledger = *c->ledger;
    state->backend->restore(state->particles, c->particles);
    // commands given since the checkpoint stay in force
    for (int l = 0; l < scene->line_count; l++) {
        const LineOrder *order = &state->orders[l], *before = &c->orders[l];
        bool wound = !isnan(order->length) && order->length != before->length;
        if (wound || order->cut != before->cut) step_order_line(scene, state, l);
    }
    if (c->quality) *state->quality = *c->quality;
    if (!state->waves) return;
    const WaveTarget asked = state->waves->asked, *then = &c->waves->asked;
    *state->waves = *c->waves;
    waves_refresh(state->waves);
    if (asked.height != then->height || asked.period != then->period ||
        asked.heading != then->heading)
        waves_command(state->waves, scene, &asked, state->time);
}

/// First violated limit as text; false when all is well.
/// "particle 18 at (-3.731, 0, -0.079) m: "
static int name_worst(const State *state, WorstBy by, char *text, int size)
{
    Vec3 place = vec3(0, 0, 0);
    int id = state->backend->worst(state->particles, by, &place);
    return snprintf(text, (size_t)size, "particle %d at (%.4g, %.4g, %.4g) m: ", id, place.x,
                    place.y, place.z);
}

static bool find_sickness(const Scene *scene, const Plan *plan, const State *state,
                          const ParticleSums *sums, char *text, int size)
{
    if (sums->sick >= 0)
        return snprintf(text, (size_t)size, "particle %d: not a number at t = %.4f s", sums->sick,
                        state->time);
    if (sums->lost_count > HEALTH_LOST_LIMIT * plan->fluid_count)
        return snprintf(text, (size_t)size,
                        "fluid: %d particles beyond the walls at t = %.4f s; limit %g of all",
                        sums->lost_count, state->time, HEALTH_LOST_LIMIT);
    double excess = sums->largest_excess > -sums->smallest_excess ? sums->largest_excess
                                                                  : sums->smallest_excess;
    if (fabs(excess) > HEALTH_EXCESS_LIMIT) {
        int named = name_worst(state, WORST_BY_EXCESS, text, size);
        return snprintf(text + named, (size_t)(size - named),
                        "density error %+.3g at t = %.4f s; limit %.3g", excess, state->time,
                        HEALTH_EXCESS_LIMIT);
    }
    if (sums->largest_speed > HEALTH_SPEED_LIMIT * plan->sound_speed) {
        int named = name_worst(state, WORST_BY_SPEED, text, size);
        return snprintf(text + named, (size_t)(size - named),
                        "speed %.3g m/s at t = %.4f s; limit %.3g m/s", sums->largest_speed,
                        state->time, HEALTH_SPEED_LIMIT * plan->sound_speed);
    }
    for (int b = 0; b < scene->body_count; b++) {
        const Body *body = &state->bodies[b];
        double sum = vec3_dot(body->position, body->position) +
                     vec3_dot(body->velocity, body->velocity) +
                     vec3_dot(body->angular_velocity, body->angular_velocity);
        if (!(sum < 1e12))
            return snprintf(text, (size_t)size, "body %s: not a number at t = %.4f s",
                            scene->bodies[b].name, state->time);
    }
    return false;
}

/// Water over or through a wall is not sick while it is little, but never silent.
static void note_lost(State *state, int lost)
{
    if (lost > state->health.lost && state->health.status == HEALTH_GOOD)
        snprintf(state->health.message, sizeof state->health.message,
                 "particles beyond the walls: %d at t = %.3f s", lost, state->time);
    state->health.lost = lost;
}

bool health_judge(const Scene *scene, const Plan *plan, State *state, const ParticleSums *sums,
                  Error *error)
{
    char text[256];
    bool sick = true;
    if (sums)
        sick = find_sickness(scene, plan, state, sums, text, sizeof text);
    else
        snprintf(text, sizeof text, "%.240s", error->message);
    if (!sick) {
        state->density_error = maxd(sums->largest_excess, -sums->smallest_excess);
        state->largest_density_error = maxd(state->largest_density_error, state->density_error);
        state->largest_speed = sums->largest_speed;
        note_lost(state, sums->lost_count);
        return true;
    }
    snprintf(state->health.message, sizeof state->health.message, "%s", text);
    roll_back(scene, state);
    if (state->health.tries++ >= HEALTH_TRIES) {
        state->health.status = HEALTH_FAILED;
        return error_set(error, ERROR_PHYSICS, "%s; %d roll-backs with smaller steps did not help",
                         text, HEALTH_TRIES);
    }
    state->health.status = HEALTH_RECOVERED;
    state->health.recoveries++;
    state->health.good_intervals = 0;
    state->time_step *= 0.5;
    return true;
}
