#include "summary.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "effects.h"

static void write_health(Json *json, const SummaryInfo *info)
{
    static const char *const words[] = {"good", "recovered", "failed"};
    const HealthRecord *health = &info->state->health;
    bool failed = info->how == EXIT_BY_PHYSICS;
    json_object(json, "health");
    json_string(json, "status", failed ? "failed" : words[health->status]);
    json_string(json, "message", failed ? info->message : health->message);
    json_integer(json, "recoveries", health->recoveries);
    json_integer(json, "lost_particles", health->lost);
    json_object_end(json);
}

static void write_lines(Json *json, const SummaryInfo *info)
{
    const Scene *scene = info->scene;
    json_array(json, "lines");
    for (int i = 0; i < scene->line_count; i++) {
        const LineWatch *watch = &info->state->watches[i];
        json_object(json, NULL);
        json_string(json, "name", scene->lines[i].name);
        json_number(json, "tension_at_rest_n", watch->rest);
        json_number(json, "largest_tension_n", info->state->lines[i].largest_tension);
        json_integer(json, "snaps", watch->snaps);
        json_object_end(json);
    }
    json_array_end(json);
}

static void write_exchange(Json *json, const char *key, const Exchange *sums)
{
    json_object(json, key);
    json_vector(json, "impulse_n_s", sums->impulse);
    json_vector(json, "angular_impulse_n_m_s", sums->angular_impulse);
    json_number(json, "work_j", sums->work);
    json_object_end(json);
}

/// What bodies and lines gave each other, by both accounts, and where the lines' energy went.
static void write_ledger(Json *json, const SummaryInfo *info)
{
    const Scene *scene = info->scene;
    const State *state = info->state;
    const LineLedger *ledger = state->ledger;
    if (!ledger) return;
    json_object(json, "lines_exchange");
    json_array(json, "bodies");
    for (int b = 0; b < scene->body_count; b++) {
        if (!ledger->body[b].holds) continue;
        LedgerBalance balance = line_ledger_balance(ledger, scene, state->bodies, state->lines, b);
        json_object(json, NULL);
        json_string(json, "name", scene->bodies[b].name);
        write_exchange(json, "taken_by_body", &balance.taken);
        write_exchange(json, "given_by_lines", &balance.given);
        json_number(json, "impulse_error", balance.impulse_error);
        json_number(json, "angular_impulse_error", balance.angular_error);
        json_number(json, "work_error", balance.work_error);
        json_bool(json, "within_bounds", balance.good);
        json_object_end(json);
    }
    json_array_end(json);
    double gained = mooring_energy(&state->mooring) - ledger->energy_start;
    json_number(json, "work_on_lines_j", ledger->holders_work);
    json_number(json, "energy_gained_j", gained);
    json_number(json, "energy_spent_j", ledger->holders_work - gained);
    json_object_end(json);
}

static void write_quality(Json *json, const SummaryInfo *info)
{
    const Scene *scene = info->scene;
    const State *state = info->state;
    if (!wave_quality_asked(scene)) return;
    json_object(json, "wave_quality");
    json_array(json, "height_ratios");
    for (int i = 0; i < scene->quality_gauge_count; i++)
        json_number(json, NULL, state->quality->gauge[i].height / state->waves->asked.height);
    json_array_end(json);
    json_number(json, "reflection", state->quality->reflection);
    json_number(json, "gain", state->waves->gain);
    json_object_end(json);
}

void summary_format(Text *text, const SummaryInfo *info)
{
    static const char *const reasons[] = {"until reached", "interrupted", "physics", "error"};
    const Plan *plan = info->plan;
    const State *state = info->state;
    int64_t particles = (int64_t)plan->fluid_count + plan->wall_count + plan->body_particle_count;
    char hash[20];
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)info->scene->hash);
    Json json = json_begin(text);
    json_object(&json, NULL);
    json_string(&json, "version", FAIRLEAD_VERSION);
    json_string(&json, "case", info->scene->name);
    json_string(&json, "case_hash", hash);
    json_string(&json, "backend", plan->backend);
    json_string(&json, "variant", plan->variant);
    json_integer(&json, "threads", plan->options.threads);
    json_integer(&json, "particles", particles);
    json_integer(&json, "fluid_particles", plan->fluid_count);
    json_number(&json, "spacing_m", info->scene->fluid.spacing);
    json_integer(&json, "steps", state->step);
    json_number(&json, "simulated_s", state->time);
    json_number(&json, "wall_s", info->wall);
    json_number(&json, "stepping_wall_s", state->wall_time);
    json_number(&json, "particle_steps_per_s",
                info->wall > 0 ? (double)particles * (double)state->step / info->wall : NAN);
    json_object(&json, "time_step_s");
    json_number(&json, "smallest", state->smallest_step);
    json_number(&json, "mean", state->step > 0 ? state->time / (double)state->step : NAN);
    json_number(&json, "largest", state->largest_step);
    json_object_end(&json);
    json_number(&json, "largest_density_error", state->largest_density_error);
    write_health(&json, info);
    effects_write_costs(&json, info->plan, info->state);
    write_lines(&json, info);
    write_ledger(&json, info);
    write_quality(&json, info);
    json_integer(&json, "frames", info->frame_count);
    json_string(&json, "exit", reasons[info->how]);
    json_string(&json, "exit_message", info->message);
    json_object_end(&json);
    text_append(text, "\n", 1);
}

bool summary_write(const char *folder, const SummaryInfo *info, Error *error)
{
    Text text = {0};
    char path[SCENE_PATH_SIZE + 32];
    snprintf(path, sizeof path, "%s/summary.json", folder);
    summary_format(&text, info);
    FILE *file = fopen(path, "w");
    bool good = file && !text.failed && fwrite(text.data, 1, text.length, file) == text.length;
    if (file && fclose(file)) good = false;
    text_destroy(&text);
    return good || error_set(error, ERROR_SYSTEM, "%s: cannot write: %s", path, strerror(errno));
}
