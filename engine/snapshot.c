#include "snapshot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"

static size_t arrays_size(const Scene *scene, const Plan *plan)
{
    size_t size = (size_t)plan->fluid_count * 7 * sizeof(float);
    for (int l = 0; l < scene->line_count; l++)
        size += (size_t)(4 * (scene->lines[l].segments + 1)) * sizeof(float);
    return size;
}

bool snapshot_create(const Scene *scene, const Plan *plan, Snapshot *snapshot, Error *error)
{
    memset(snapshot, 0, sizeof *snapshot);
    snapshot->storage_size = arrays_size(scene, plan);
    float *next = snapshot->storage = malloc(snapshot->storage_size);
    if (!next)
        return error_set(error, ERROR_SYSTEM, "memory: a snapshot needs %zu bytes",
                         snapshot->storage_size);
    int n = snapshot->fluid_count = plan->fluid_count;
    snapshot->boundary_count = plan->wall_count + plan->body_particle_count;
    snapshot->position = (float(*)[3])next;
    snapshot->velocity = (float(*)[3])(next += 3 * (size_t)n);
    snapshot->pressure = next += 3 * (size_t)n;
    next += n;
    snapshot->line_count = scene->line_count;
    for (int l = 0; l < scene->line_count; l++) {
        LineSnapshot *line = &snapshot->lines[l];
        line->node_count = scene->lines[l].segments + 1;
        line->diameter = scene->lines[l].diameter;
        line->name = scene->lines[l].name;
        line->ashore[0] = scene->lines[l].anchor.body < 0;
        line->ashore[1] = scene->lines[l].fairlead.body < 0;
        line->position = (float(*)[3])next;
        line->tension = next += 3 * line->node_count;
        next += line->node_count;
    }
    snapshot->body_count = scene->body_count;
    for (int b = 0; b < scene->body_count; b++) {
        snapshot->bodies[b].mesh = &plan->bodies[b].geometry.mesh;
        memcpy(snapshot->bodies[b].colour, scene->bodies[b].colour,
               sizeof snapshot->bodies[b].colour);
    }
    for (int e = 0; e < EFFECT_COUNT; e++)
        if (plan->effects[e].active)
            snapshot->effects[snapshot->effect_count++].name = plan->effects[e].name;
    snapshot->spacing = scene->fluid.spacing;
    snapshot->domain = scene->domain;
    snapshot->level = scene->fluid.level;
    snapshot->zone_width = plan->effects[EFFECT_ZONE].active ? plan->zone_width : 0;
    snapshot->has_waves = scene->waves.kind != WAVES_NONE;
    return true;
}

/// Where the line leaves the bed: the last node at most a diameter above it that has one above it
/// behind. -1 without.
static int find_lift_off(const Line *line, double bed)
{
    double top = bed + line->scene->diameter;
    for (int n = line->node_count - 2; n >= 0; n--)
        if (line->position[n].z <= top && line->position[n + 1].z > top) return n;
    return -1;
}

static void take_lines(const State *state, Snapshot *snapshot)
{
    for (int l = 0; l < snapshot->line_count; l++) {
        const Line *line = &state->lines[l];
        LineSnapshot *out = &snapshot->lines[l];
        for (int n = 0; n < line->node_count; n++) {
            out->position[n][0] = (float)line->position[n].x;
            out->position[n][1] = (float)line->position[n].y;
            out->position[n][2] = (float)line->position[n].z;
            if (n) out->tension[n - 1] = line->parted[n - 1] ? -1 : (float)line->tension[n - 1];
        }
        out->slack = line_watch_slack(&state->watches[l]);
        out->rest = state->watches[l].rest;
        out->largest = line->largest_tension;
        out->touchdown = line->touchdown;
        out->snap_time = state->watches[l].snap_time;
        out->lift_off = find_lift_off(line, snapshot->domain.min.z);
    }
}

static void take_shares(const Plan *plan, const State *state, Snapshot *snapshot)
{
    double total = state->base_seconds;
    for (int e = 0; e < EFFECT_COUNT; e++)
        total += state->effect_seconds[e];
    for (int e = 0, n = 0; e < EFFECT_COUNT; e++)
        if (plan->effects[e].active)
            snapshot->effects[n++].share = total > 0 ? state->effect_seconds[e] / total : 0;
}

void snapshot_take(const Scene *scene, const Plan *plan, const State *state, Snapshot *snapshot)
{
    snapshot->time = state->time;
    snapshot->step = state->step;
    snapshot->time_step = state->time_step;
    snapshot->wall_time = state->wall_time;
    snapshot->particle_steps =
        state->step * ((int64_t)snapshot->fluid_count + snapshot->boundary_count);
    state->backend->download(state->particles, snapshot->position, snapshot->velocity,
                             snapshot->pressure);
    snapshot->density_error = state->density_error;
    snapshot->largest_speed = state->largest_speed;
    for (int b = 0; b < scene->body_count; b++) {
        snapshot->bodies[b].origin = body_point(&state->bodies[b], vec3(0, 0, 0));
        snapshot->bodies[b].attitude = state->bodies[b].attitude;
    }
    take_lines(state, snapshot);
    take_shares(plan, state, snapshot);
    if (snapshot->has_waves) {
        snapshot->wave_asked = state->waves->asked;
        snapshot->wave_now = waves_now(state->waves, state->time);
        snapshot->wave_changing = state->waves->active;
    }
    snapshot->health = state->health.status;
    memcpy(snapshot->health_message, state->health.message, sizeof snapshot->health_message);
}

void snapshot_destroy(Snapshot *snapshot)
{
    free(snapshot->storage);
    memset(snapshot, 0, sizeof *snapshot);
}
