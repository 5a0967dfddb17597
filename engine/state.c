#include "state.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backend/backend.h"
#include "energy.h"
#include "engine.h"
#include "fill.h"
#include "line_water.h"
#include "step.h"

static BackendSetup backend_setup(const Scene *scene, const Plan *plan)
{
    const Domain *d = &scene->domain;
    BackendSetup s;
    memset(&s, 0, sizeof s);
    s.dimensions = d->dimensions;
    s.threads = plan->options.threads;
    s.body_count = scene->body_count;
    s.spacing = scene->fluid.spacing;
    s.smoothing_length = plan->smoothing_length;
    s.particle_mass = plan->particle_mass;
    s.kernel = scene->fluid.kernel;
    s.rest_density = scene->fluid.density;
    s.sound_speed = plan->sound_speed;
    s.alpha = scene->fluid.alpha;
    s.viscosity = scene->fluid.viscosity;
    s.shifting = scene->fluid.shifting;
    s.delta = scene->fluid.delta;
    s.gravity = scene->fluid.gravity;
    s.level = scene->fluid.level;
    memcpy(s.flow, plan->flow, sizeof s.flow);
    memcpy(s.pitch, plan->pitch, sizeof s.pitch);
    s.largest_travel = 0.25 * plan->largest_speed * plan->time_step;
    s.pair_mask = plan->pair_mask;
    s.works = scene->energy == ENERGY_BUDGET;
    const double low[3] = {d->min.x, d->min.y, d->min.z};
    // spray may fly; waves of a basin must stay inside
    const double high[3] = {d->max.x, d->max.y, INFINITY};
    bool waves = scene->waves.kind != WAVES_NONE;
    bool ring = scene_has_ring(scene), piston = waves && d->kind == DOMAIN_FLUME;
    // on a current water goes on by a pitch before a layer of it leaves
    const double wall_reach =
        plan->wall_reach + (ring && scene->waves.current.speed > 0 ? s.spacing : 0);
    for (int a = 0; a < 3; a++) {
        bool any = a == 1 && d->dimensions == 2;
        double reach = a < 2 ? wall_reach : 0; // water rides with ring and piston
        s.inside_min[a] = any ? -INFINITY : low[a] - reach;
        s.inside_max[a] = any ? INFINITY : high[a] + reach;
    }
    for (int a = 0; a < 3; a++) {
        bool open = (a < 2 && ring) || (a == 1 && d->dimensions == 2);
        s.barrier_min[a] = open || (a == 0 && piston) ? -INFINITY : low[a];
        s.barrier_max[a] = open || a == 2 ? INFINITY : high[a];
    }
    s.barrier_top = d->max.z;
    // dummies behind the walls, waves of the ring, bodies that stick out, spray above
    double side = (plan->wall_layers + 2) * s.spacing;
    if (waves || ring) side += maxd(scene->waves.height_limits.max, wall_reach);
    double top = d->max.z + 0.5 * (d->max.z - d->min.z);
    for (int b = 0; b < scene->body_count; b++) {
        const MeshProperties *p = &plan->bodies[b].geometry.properties;
        top = maxd(top, d->max.z + vec3_norm(vec3_sub(p->max, p->min)));
    }
    s.room_min[0] = d->min.x - side;
    s.room_max[0] = d->max.x + side;
    s.room_min[1] = d->dimensions == 2 ? -s.spacing : d->min.y - side;
    s.room_max[1] = d->dimensions == 2 ? s.spacing : d->max.y + side;
    s.room_min[2] = d->min.z - side;
    s.room_max[2] = top;
    return s;
}

static bool create_particles(const Scene *scene, const Plan *plan, State *state, Error *error)
{
    if (scene->domain.kind == DOMAIN_LINES) {
        BackendSetup setup = {.body_count = scene->body_count};
        ParticleStart nothing = {0};
        state->backend = backend_none();
        return state->backend->create(&setup, &nothing, &state->arena, &state->particles, error);
    }
    Arena scratch = arena_create(0);
    Fill fill;
    bool good = fill_create(scene, plan, &scratch, &fill, error);
    if (good) {
        ParticleStart start = {
            .fluid_count = fill.fluid_count,
            .fluid_position = fill.fluid_position,
            .fluid_velocity = fill.fluid_velocity,
            .fluid_excess = fill.fluid_excess,
            .dummy_count = fill.wall_count + fill.ring_count + fill.piston_count + fill.body_count,
            .dummy_reference = fill.dummy_reference,
            .dummy_owner = fill.dummy_owner,
        };
        BackendSetup setup = backend_setup(scene, plan);
        state->backend = backend_choose(plan->options.backend, error);
        good = state->backend &&
               state->backend->create(&setup, &start, &state->arena, &state->particles, error);
    }
    arena_destroy(&scratch);
    return good;
}

static bool create_waves(const Scene *scene, const Plan *plan, State *state, Error *error)
{
    if (scene->waves.kind == WAVES_NONE && !scene_has_ring(scene)) return true;
    TRY(state->waves = arena_take(&state->arena, 1, sizeof(WaveState), "waves", error));
    TRY(state->checkpoint.waves = arena_take(&state->arena, 1, sizeof(WaveState), "waves", error));
    *state->waves = waves_create(scene);
    state->waves->record = plan->piston;
    if (wave_quality_asked(scene)) {
        size_t size = sizeof(WaveQuality);
        TRY(state->quality = arena_take(&state->arena, 1, size, "wave quality", error));
        TRY(state->checkpoint.quality = arena_take(&state->arena, 1, size, "wave quality", error));
        *state->quality = wave_quality_create();
    }
    return waves_take_sea(state->waves, scene, &state->arena, error);
}

static bool create_bodies_and_lines(const Scene *scene, const Plan *plan, State *state,
                                    Error *error)
{
    size_t bodies = (size_t)scene->body_count, lines = (size_t)scene->line_count;
    TRY(state->bodies = arena_take(&state->arena, bodies, sizeof(Body), "bodies", error));
    TRY(state->loads = arena_take(&state->arena, bodies, sizeof(BodyLoad), "loads", error));
    TRY(state->poses = arena_take(&state->arena, bodies, sizeof(BodyPose), "poses", error));
    TRY(state->centres = arena_take(&state->arena, bodies, sizeof(Vec3), "centres", error));
    TRY(state->watches = arena_take(&state->arena, lines, sizeof(LineWatch), "lines", error));
    TRY(state->orders = arena_take(&state->arena, lines, sizeof(LineOrder), "lines", error));
    for (int l = 0; l < scene->line_count; l++) {
        state->orders[l].length = NAN;
        state->orders[l].cut = CUT_NOWHERE;
    }
    TRY(state->slammings = arena_take(&state->arena, (size_t)scene->slamming_count,
                                      sizeof(Slamming), "slamming", error));
    for (int b = 0; b < scene->body_count; b++)
        state->bodies[b] = body_create(&scene->bodies[b], &plan->bodies[b].geometry);
    if (!lines) return true;
    TRY(state->events = arena_take(&state->arena, 1, sizeof(LineEvents), "lines", error));
    NodeWater nodes;
    WaterField water = line_water(scene, state, &nodes);
    LineEnds ends[SCENE_LINES_MAX];
    for (int l = 0; l < scene->line_count; l++)
        ends[l] = plan->lines[l].ends;
    TRY(mooring_create(scene, ends, &water, &state->arena, &state->mooring, NULL, error));
    state->lines = state->mooring.lines;
    for (int l = 0; l < scene->line_count; l++)
        state->watches[l] = line_watch_create(&state->lines[l], &water);
    TRY(state->ledger = arena_take(&state->arena, 1, sizeof(LineLedger), "lines", error));
    *state->ledger = line_ledger_create(scene, state->bodies, &state->mooring);
    return true;
}

static bool create_checkpoint(const Scene *scene, State *state, Error *error)
{
    Checkpoint *c = &state->checkpoint;
    size_t bodies = (size_t)scene->body_count, lines = (size_t)scene->line_count;
    c->time = NAN;
    TRY(c->bodies = arena_take(&state->arena, bodies, sizeof(Body), "checkpoint", error));
    TRY(c->slammings = arena_take(&state->arena, (size_t)scene->slamming_count, sizeof(Slamming),
                                  "checkpoint", error));
    TRY(c->lines = arena_take(&state->arena, lines, sizeof(double *), "checkpoint", error));
    TRY(c->watches = arena_take(&state->arena, lines, sizeof(LineWatch), "checkpoint", error));
    TRY(c->orders = arena_take(&state->arena, lines, sizeof(LineOrder), "checkpoint", error));
    if (state->ledger)
        TRY(c->ledger = arena_take(&state->arena, 1, sizeof(LineLedger), "checkpoint", error));
    for (int l = 0; l < scene->line_count; l++)
        TRY(c->lines[l] = arena_take(&state->arena, line_state_size(&state->lines[l]),
                                     sizeof(double), "checkpoint", error));
    TRY(c->particles = arena_take(&state->arena, state->backend->state_size(state->particles), 1,
                                  "checkpoint", error));
    return true;
}

/// Put moving dummies in their places and measure once what the pair effects cost in their sweeps:
/// a bit cannot be timed while it runs.
static bool place_and_measure(const Scene *scene, const Plan *plan, State *state, Error *error)
{
    if (plan->effects[EFFECT_MOVING_BOUNDARIES].active) {
        Advance now = step_orders(scene, plan, state, 0);
        state->backend->place(state->particles, &now);
    }
    for (int b = 0; b < scene->body_count; b++)
        state->centres[b] = state->bodies[b].position;
    TRY(state->backend->forces(state->particles, state->centres, state->loads, error));
    for (int b = 0; b < scene->body_count; b++) {
        state->bodies[b].fluid_force = state->loads[b].force;
        state->bodies[b].fluid_moment = state->loads[b].moment;
    }
    if (scene->energy != ENERGY_NONE) state->energy_start = energy_levels(scene, state);
    const unsigned bits[] = {PAIR_VISCOSITY, PAIR_DIFFUSION,  PAIR_GRADIENT,
                             PAIR_LAMINAR,   PAIR_TURBULENCE, PAIR_NO_SLIP};
    for (int i = 0; i < 6; i++)
        if (plan->pair_mask & bits[i])
            state->pair_cost[i] = state->backend->pair_cost(state->particles, bits[i]);
    return true;
}

bool state_create(const Scene *scene, const Plan *plan, State **result, Error *error)
{
    Arena arena = arena_create(0);
    State *state = arena_take(&arena, 1, sizeof *state, "state", error);
    if (!state) return false;
    state->arena = arena;
    state->time_step = state->smallest_step = state->largest_step = plan->time_step;
    if (create_waves(scene, plan, state, error) && create_particles(scene, plan, state, error) &&
        create_bodies_and_lines(scene, plan, state, error) &&
        create_checkpoint(scene, state, error) && place_and_measure(scene, plan, state, error)) {
        *result = state;
        return true;
    }
    state_destroy(state);
    return false;
}

void state_destroy(State *state)
{
    if (!state) return;
    if (state->particles) state->backend->destroy(state->particles);
    // the state lies in its own arena
    Arena arena = state->arena;
    arena_destroy(&arena);
}

bool plan_predict(const Scene *scene, Plan *plan, Error *error)
{
    State *state;
    TRY(state_create(scene, plan, &state, error));
    bool good = true;
    double wall = 0;
    for (int i = 0; i < 12 && good && wall < 2; i++) {
        if (i == 2) state->wall_time = 0;
        good = step_advance(scene, plan, state, error);
        wall += state->wall_time / (i + 1);
    }
    if (good && state->step > 2)
        plan->predicted_slowness = state->wall_time / ((double)(state->step - 2) * plan->time_step);
    state_destroy(state);
    return good;
}
