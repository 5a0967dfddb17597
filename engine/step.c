/// One time step, readable from top to bottom in step_once.
#include "step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/built.h"
#include "contact.h"
#include "coupling.h"
#include "engine.h"
#include "health.h"
#include "line_water.h"
#include "piston.h"
#include "probes.h"

static bool called_for(const Plan *plan, EffectId effect)
{
    return EFFECTS_BUILT && plan->effects[effect].active;
}

double step_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct GaugeContext {
    const Scene *scene;
    const State *state;
} GaugeContext;

static double read_gauge(const void *context, int gauge)
{
    const GaugeContext *c = context;
    return probe_elevation(c->scene, c->state, gauge);
}

static void judge_waves(const Scene *scene, State *state)
{
    double begin = step_clock();
    GaugeContext context = {scene, state};
    wave_quality_advance(state->quality, scene, state->waves, state->time, read_gauge, &context);
    state->host_seconds[EFFECT_WAVE_QUALITY] += step_clock() - begin;
}

static void probe_slamming(const Scene *scene, const Plan *plan, State *state, double dt)
{
    for (int i = 0; i < scene->slamming_count; i++) {
        const SlammingScene *probe = &scene->slammings[i];
        slamming_advance(&state->slammings[i], probe, scene, &state->bodies[probe->body],
                         &plan->bodies[probe->body].geometry, dt);
    }
}

static void advance_bodies(const Scene *scene, const Plan *plan, State *state, double dt)
{
    coupling_collect_loads(scene, state->lines, state->bodies);
    for (int b = 0; b < scene->body_count; b++) {
        state->bodies[b].fluid_force = state->loads[b].force;
        state->bodies[b].fluid_moment = state->loads[b].moment;
    }
    if (called_for(plan, EFFECT_SLAMMING)) {
        double lap = step_clock();
        probe_slamming(scene, plan, state, dt);
        state->host_seconds[EFFECT_SLAMMING] += step_clock() - lap;
    }
    if (called_for(plan, EFFECT_CONTACTS)) {
        double lap = step_clock();
        contact_loads(scene, plan, state->bodies);
        state->host_seconds[EFFECT_CONTACTS] += step_clock() - lap;
    }
    if (!called_for(plan, EFFECT_BODY_MOTION)) return;
    double lap = step_clock();
    for (int b = 0; b < scene->body_count; b++) {
        Body *body = &state->bodies[b], before = *body;
        body_advance(body, &scene->bodies[b], scene->fluid.gravity, state->time, dt);
        if (scene->energy != ENERGY_BUDGET) continue;
        Vec3 v = vec3_add(before.velocity, body->velocity);
        Vec3 w = vec3_add(before.angular_velocity, body->angular_velocity);
        state->line_work +=
            0.5 * dt * (vec3_dot(body->line_force, v) + vec3_dot(body->line_moment, w));
    }
    state->host_seconds[EFFECT_BODY_MOTION] += step_clock() - lap;
}

static bool advance_lines(const Scene *scene, State *state, double dt, const LinePaths *paths,
                          Error *error)
{
    NodeWater nodes;
    WaterField water = line_water(scene, state, &nodes);
    TRY(mooring_advance(&state->mooring, &water, state->time, dt, paths->end, error));
    line_ledger_step(state->ledger, scene, state->bodies, state->lines, paths, dt);
    for (int l = 0; l < scene->line_count; l++)
        line_watch_step(&state->watches[l], &state->lines[l], l, state->time + dt, state->events);
    return true;
}

static void move_ring(const void *context, double time, int count, const Vec3 *mean, Vec3 *place)
{
    waves_ring_places(context, time, count, mean, place);
}

/// Mean places go with the current.
static void move_ring_on_current(const void *context, double time, int count, const Vec3 *mean,
                                 Vec3 *place)
{
    enum { BLOCK = 256 };
    const WaveState *waves = context;
    Vec3 at[BLOCK], way = current_travel(&waves->current, time);
    for (int begin = 0; begin < count; begin += BLOCK) {
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        for (int i = 0; i < n; i++)
            at[i] = vec3_add(mean[begin + i], way);
        waves_ring_places(waves, time, n, at, place + begin);
    }
}

static void zone_velocity(const void *context, double time, int count, const float *x,
                          const float *y, const float *z, float *u, float *v, float *w)
{
    waves_zone_batch(context, time, count, x, y, z, u, v, w);
}

static void zone_velocity_on_current(const void *context, double time, int count, const float *x,
                                     const float *y, const float *z, float *u, float *v, float *w)
{
    const WaveState *waves = context;
    Vec3 current = current_velocity(&waves->current, time);
    waves_zone_batch(waves, time, count, x, y, z, u, v, w);
    for (int i = 0; i < count; i++) {
        u[i] += (float)current.x;
        v[i] += (float)current.y;
    }
}

static double hull_skin(const void *context, int body, Vec3 point)
{
    const Plan *plan = context;
    return distance_grid_sample(&plan->bodies[body].distance, point);
}

enum { SEA_EVERY = 8 };

/// Of the waves; without them of the longest that the zone is wide enough for, in deep water [s].
static double zone_period(const Scene *scene, const Plan *plan, const State *state)
{
    if (scene->waves.kind != WAVES_NONE) return state->waves->asked.period;
    return sqrt(2 * PI * plan->zone_width / 0.75 / scene->fluid.gravity);
}

static RelaxationZone zone_of(const Scene *scene, const Plan *plan, const State *state)
{
    const Domain *d = &scene->domain;
    RelaxationZone zone;
    memset(&zone, 0, sizeof zone);
    bool basin = called_for(plan, EFFECT_ZONE), beach = called_for(plan, EFFECT_BEACH);
    if (!basin && !beach) return zone;
    zone.width = plan->zone_width;
    zone.time_scale = 0.1 * zone_period(scene, plan, state);
    zone.side_min[0] = basin ? d->min.x : -1e30;
    zone.side_max[0] = d->max.x;
    zone.side_min[1] = basin && d->dimensions == 3 ? d->min.y : -1e30;
    zone.side_max[1] = basin && d->dimensions == 3 ? d->max.y : 1e30;
    bool current = called_for(plan, EFFECT_CURRENT);
    zone.target = current ? zone_velocity_on_current : basin ? zone_velocity : NULL;
    // a sea's target costs as much as the particle itself: a fifth of tau is short enough
    double steps = zone.time_scale / plan->time_step / 5;
    zone.every = state->waves->sea && steps > 1 ? (int)mind(steps, SEA_EVERY) : 1;
    return zone;
}

static void order_current(const Plan *plan, const State *state, double dt, Advance *advance)
{
    const Current *current = &state->waves->current;
    Vec3 drive = current_acceleration(current, state->time + 0.5 * dt);
    Vec3 now = current_travel(current, state->time);
    Vec3 then = current_travel(current, state->time + dt);
    const double from[2] = {now.x, now.y}, to[2] = {then.x, then.y};
    advance->ring = move_ring_on_current;
    advance->drive[0] = drive.x;
    advance->drive[1] = drive.y;
    for (int a = 0; a < 2; a++) {
        if (plan->flow[a] == 0) continue;
        // a layer is full when it has gone by its pitch, upstream or downstream of x = 0 alike
        double pitch = plan->pitch[a], layers = floor(plan->flow[a] * from[a] / pitch);
        double next = floor(plan->flow[a] * to[a] / pitch);
        advance->carried[a] = plan->flow[a] * pitch * layers;
        advance->passes[a] = plan->flow[a] * pitch * (next - layers);
    }
}

Advance step_orders(const Scene *scene, const Plan *plan, State *state, double dt)
{
    Advance advance;
    memset(&advance, 0, sizeof advance);
    for (int b = 0; b < scene->body_count; b++) {
        state->poses[b].origin = body_point(&state->bodies[b], vec3(0, 0, 0));
        state->poses[b].attitude = state->bodies[b].attitude;
    }
    advance.time = state->time;
    advance.step = state->step;
    advance.dt = dt;
    advance.poses = state->poses;
    advance.hulls = plan;
    advance.skin = called_for(plan, EFFECT_BODIES) ? hull_skin : NULL;
    advance.waves = state->waves;
    advance.ring = called_for(plan, EFFECT_RING) ? move_ring : NULL;
    advance.piston = called_for(plan, EFFECT_PISTON) ? piston_move : NULL;
    advance.zone = zone_of(scene, plan, state);
    if (called_for(plan, EFFECT_RING) && called_for(plan, EFFECT_CURRENT))
        order_current(plan, state, dt, &advance);
    return advance;
}

static EffectId wave_maker(const Plan *plan)
{
    return called_for(plan, EFFECT_PISTON) ? EFFECT_PISTON : EFFECT_RING;
}

static bool step_once(const Scene *scene, const Plan *plan, State *state, double dt,
                      ParticleSums *sums, Error *error)
{
    LinePaths paths;
    for (int b = 0; b < scene->body_count; b++)
        state->centres[b] = state->bodies[b].position;
    TRY(state->backend->forces(state->particles, state->centres, state->loads, error));

    if (called_for(plan, EFFECT_LINES)) coupling_note_ends(scene, state->bodies, 0, &paths);
    if (called_for(plan, EFFECT_BODIES)) advance_bodies(scene, plan, state, dt);
    if (called_for(plan, EFFECT_LINES)) {
        double lap = step_clock();
        coupling_note_ends(scene, state->bodies, 1, &paths);
        TRY(advance_lines(scene, state, dt, &paths, error));
        state->host_seconds[EFFECT_LINES] += step_clock() - lap;
    }

    Advance advance = step_orders(scene, plan, state, dt);
    state->backend->advance(state->particles, &advance, sums);

    state->time += dt;
    state->step++;
    if (EFFECTS_BUILT && scene->waves.kind != WAVES_NONE) {
        double lap = step_clock();
        waves_update(state->waves, scene, state->time);
        state->host_seconds[wave_maker(plan)] += step_clock() - lap;
    }
    if (plan->effects[EFFECT_WAVE_QUALITY].active) judge_waves(scene, state);
    return true;
}

/// Spread the backend's clocks over the effects that asked for the work. What water and walls do
/// to each other in the sweeps counts to the base.
static void share_clocks(const Plan *plan, State *state)
{
    const double *c = state->backend->clocks(state->particles);
    double *e = state->effect_seconds;
    memcpy(e, state->host_seconds, sizeof state->host_seconds);
    e[EFFECT_VISCOSITY] += c[CLOCK_MOMENTUM] * state->pair_cost[0];
    e[EFFECT_DIFFUSION] += c[CLOCK_DENSITY] * state->pair_cost[1];
    e[EFFECT_GRADIENT] += c[CLOCK_GRADIENT] + c[CLOCK_MOMENTUM] * state->pair_cost[2];
    e[EFFECT_LAMINAR] += c[CLOCK_MOMENTUM] * state->pair_cost[3];
    e[EFFECT_TURBULENCE] += c[CLOCK_TURBULENCE] + c[CLOCK_MOMENTUM] * state->pair_cost[4];
    e[EFFECT_NO_SLIP] += c[CLOCK_NO_SLIP] + c[CLOCK_MOMENTUM] * state->pair_cost[5];
    e[EFFECT_SHIFTING] += c[CLOCK_SHIFTING];
    e[EFFECT_WALLS] += c[CLOCK_EXTRAPOLATE];
    e[EFFECT_MOVING_BOUNDARIES] += c[CLOCK_EXTRAPOLATE_MOVING] + c[CLOCK_DUMMIES];
    e[EFFECT_RING] += c[CLOCK_RING];
    e[EFFECT_PISTON] += c[CLOCK_PISTON];
    e[called_for(plan, EFFECT_BEACH) ? EFFECT_BEACH : EFFECT_ZONE] += c[CLOCK_ZONE];
    e[EFFECT_CURRENT] += c[CLOCK_CONVEYOR];
    e[EFFECT_BODIES] += c[CLOCK_LOADS];
    e[EFFECT_ENERGY] += c[CLOCK_WORKS];
    double momentum = state->pair_cost[0]; // all but density diffusion's
    for (int i = 2; i < 6; i++)
        momentum += state->pair_cost[i];
    state->base_seconds = c[CLOCK_SORT] + c[CLOCK_INTEGRATE] + c[CLOCK_MOMENTUM] * (1 - momentum) +
                          c[CLOCK_DENSITY] * (1 - state->pair_cost[1]);
}

bool step_advance(const Scene *scene, const Plan *plan, State *state, Error *error)
{
    double begin = step_clock();
    health_checkpoint(scene, state);
    ParticleSums sums;
    double dt = state->time_step;
    bool good = step_once(scene, plan, state, dt, &sums, error);
    if (!good && error->code == ERROR_SYSTEM) return false;
    good = health_judge(scene, plan, state, good ? &sums : NULL, error);
    state->smallest_step = mind(state->smallest_step, dt);
    state->largest_step = maxd(state->largest_step, dt);
    share_clocks(plan, state);
    state->wall_time += step_clock() - begin;
    return good;
}

void step_order_line(const Scene *scene, State *state, int line)
{
    const LineOrder *order = &state->orders[line];
    int last = state->lines[line].node_count - 2;
    const int segments[] = {[CUT_ANCHOR] = 0, [CUT_MIDDLE] = last / 2, [CUT_FAIRLEAD] = last};
    if (!isnan(order->length))
        mooring_set_length(&state->lines[line], order->length, scene->lines[line].winch.speed,
                           state->time);
    if (order->cut != CUT_NOWHERE) mooring_break(&state->lines[line], segments[order->cut]);
}

static bool command_line(const Scene *scene, State *state, const Command *command, Error *error)
{
    int line;
    TRY(command_check_line(scene, command, state->orders, &line, error));
    LineOrder *order = &state->orders[line];
    if (!isnan(command->line_length)) order->length = command->line_length;
    if (command->line_cut != CUT_NOWHERE) order->cut = command->line_cut;
    step_order_line(scene, state, line);
    return true;
}

bool state_command(const Scene *scene, State *state, const Command *command, Error *error)
{
    WaveTarget target;
    if (command->line[0]) return command_line(scene, state, command, error);
    const WaveTarget *last = state->waves ? &state->waves->asked : NULL;
    TRY(command_check(scene, command, last, &target, error));
    waves_command(state->waves, scene, &target, state->time);
    return true;
}
