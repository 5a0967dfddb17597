#include "line_ledger.h"

#include <string.h>

LineLedger line_ledger_create(const Scene *scene, const Body *bodies, const Mooring *mooring)
{
    LineLedger ledger;
    memset(&ledger, 0, sizeof ledger);
    for (int b = 0; b < scene->body_count; b++) {
        BodyLedger *account = &ledger.body[b];
        account->position = bodies[b].position;
        account->attitude = bodies[b].attitude;
        account->velocity = bodies[b].velocity;
        account->spin = bodies[b].angular_velocity;
    }
    for (int l = 0; l < scene->line_count; l++)
        for (int side = 0; side < 2; side++) {
            int b = coupling_holder(scene, l, side);
            if (b >= 0) ledger.body[b].holds = true;
        }
    ledger.energy_start = mooring_energy(mooring);
    return ledger;
}

/// sum += a force and moment for `duration` on a body that moves and turns so fast.
static void book(Exchange *sum, Vec3 force, Vec3 moment, Vec3 velocity, Vec3 spin, double duration)
{
    sum->impulse = vec3_mad(sum->impulse, force, duration);
    sum->angular_impulse = vec3_mad(sum->angular_impulse, moment, duration);
    sum->work += duration * (vec3_dot(force, velocity) + vec3_dot(moment, spin));
}

/// The kick at a step's begin, and where the body went.
static void book_body(BodyLedger *account, const Body *body, double duration)
{
    Quat turn = quat_mul(body->attitude, quat_conjugate(account->attitude));
    double rate = (turn.w < 0 ? -2 : 2) / duration; // turns of a step are small
    Vec3 spin = vec3_scale(vec3(turn.x, turn.y, turn.z), rate);
    Vec3 velocity = vec3_scale(vec3_sub(body->position, account->position), 1 / duration);
    Vec3 mean_velocity = vec3_scale(vec3_add(velocity, account->velocity), 0.5);
    Vec3 mean_spin = vec3_scale(vec3_add(spin, account->spin), 0.5);
    double share = account->duration > 0 ? 1 : 0.5;
    book(&account->taken, body->line_force, body->line_moment, mean_velocity, mean_spin,
         share * duration);
    account->velocity = velocity;
    account->spin = spin;
    account->duration = duration;
}

/// What an end gave over a step, its arm that of the step's middle.
static void book_end(BodyLedger *account, const Line *line, int side, Vec3 arm, double duration)
{
    Vec3 force = side ? line->fairlead_force : line->anchor_force;
    double impulse = duration * vec3_norm(force);
    Exchange *given = &account->given;
    given->impulse = vec3_mad(given->impulse, force, duration);
    given->angular_impulse = vec3_mad(given->angular_impulse, vec3_cross(arm, force), duration);
    given->work += line->work[side];
    account->impulse_size += impulse;
    account->angular_size += vec3_norm(arm) * impulse;
    account->work_size += fabs(line->work[side]);
}

void line_ledger_step(LineLedger *ledger, const Scene *scene, const Body *bodies, const Line *lines,
                      const LinePaths *paths, double duration)
{
    for (int l = 0; l < scene->line_count; l++)
        for (int side = 0; side < 2; side++) {
            const EndPath *path = &paths->end[l][side];
            int b = coupling_holder(scene, l, side);
            if (!coupling_free(scene, l, side)) ledger->holders_work -= lines[l].work[side];
            if (b < 0) continue;
            BodyLedger *account = &ledger->body[b];
            Vec3 ends = vec3_add(path->position[0], path->position[1]);
            Vec3 centres = vec3_add(account->position, bodies[b].position);
            book_end(account, &lines[l], side, vec3_scale(vec3_sub(ends, centres), 0.5), duration);
        }
    for (int b = 0; b < scene->body_count; b++) {
        BodyLedger *account = &ledger->body[b];
        if (!account->holds) continue;
        book_body(account, &bodies[b], duration);
        account->position = bodies[b].position;
        account->attitude = bodies[b].attitude;
    }
}

static double share_of(double difference, double size) { return size > 0 ? difference / size : 0; }

/// Half of the kick at hand belongs to the step that ends now, but its pull is a guess: in a snap
/// it may be far off, and what it missed comes with the next. So a step's worth of it is let pass.
static bool within_bounds(const LedgerBalance *balance, const BodyLedger *account, Vec3 force,
                          Vec3 moment)
{
    double impulse = account->duration * vec3_norm(force);
    double work = account->duration * (vec3_norm(force) * vec3_norm(account->velocity) +
                                       vec3_norm(moment) * vec3_norm(account->spin));
    double in_hand = share_of(impulse, account->impulse_size);
    return balance->impulse_error <= LEDGER_IMPULSE_BOUND + in_hand &&
           balance->angular_error <= LEDGER_IMPULSE_BOUND + in_hand &&
           balance->work_error <= LEDGER_WORK_BOUND + share_of(work, account->work_size);
}

LedgerBalance line_ledger_balance(const LineLedger *ledger, const Scene *scene, const Body *bodies,
                                  const Line *lines, int b)
{
    const BodyLedger *account = &ledger->body[b];
    LedgerBalance balance = {.taken = account->taken, .given = account->given};
    const Exchange *taken = &balance.taken, *given = &balance.given;
    Vec3 force, moment;
    coupling_load(scene, lines, bodies, b, &force, &moment);
    book(&balance.taken, force, moment, account->velocity, account->spin, 0.5 * account->duration);
    Vec3 impulse = vec3_sub(taken->impulse, given->impulse);
    Vec3 angular = vec3_sub(taken->angular_impulse, given->angular_impulse);
    balance.impulse_error = share_of(vec3_norm(impulse), account->impulse_size);
    balance.angular_error = share_of(vec3_norm(angular), account->angular_size);
    balance.work_error = share_of(fabs(taken->work - given->work), account->work_size);
    balance.good = within_bounds(&balance, account, force, moment);
    return balance;
}
