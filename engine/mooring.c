/// A line's arrays, its static start, the call that advances it, and its loads on both ends.
#include "mooring.h"

#include <string.h>

#include "mooring_internal.h"

static bool take_doubles(Arena *arena, double **array, int count, const char *what, Error *error)
{
    *array = arena_take(arena, (size_t)count, sizeof **array, what, error);
    return *array != NULL;
}

static bool take_nodes(Arena *arena, LineNodes *nodes, int count, const char *what, Error *error)
{
    double **arrays[6] = {&nodes->x, &nodes->y, &nodes->z, &nodes->u, &nodes->v, &nodes->w};
    for (int i = 0; i < 6; i++)
        TRY(take_doubles(arena, arrays[i], count, what, error));
    return true;
}

static bool take_workspace(Arena *arena, LineWork *work, int n, const char *what, Error *error)
{
    TRY(take_nodes(arena, &work->now, n, what, error));
    TRY(take_nodes(arena, &work->middle, n, what, error));
    double **arrays[] = {&work->dx,    &work->dy,        &work->dz,
                         &work->px,    &work->py,        &work->pz,
                         &work->wet,   &work->tension,   &work->peak,
                         &work->share, &work->bed_share, &work->fx,
                         &work->fy,    &work->fz,        &work->ax,
                         &work->ay,    &work->az,        &work->sample_elevation};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        TRY(take_doubles(arena, arrays[i], n + 1, what, error));
    for (int i = 0; i < 7; i++) {
        TRY(take_doubles(arena, &work->water[0][i], n, what, error));
        TRY(take_doubles(arena, &work->water[1][i], n, what, error));
        TRY(take_doubles(arena, &work->water_now[i], n, what, error));
    }
    work->sample_velocity = arena_take(arena, (size_t)n, sizeof(Vec3), what, error);
    work->sample_acceleration = arena_take(arena, (size_t)n, sizeof(Vec3), what, error);
    return work->sample_velocity && work->sample_acceleration;
}

/// Length on the bed [m]: the part of each segment whose centre line is at or below it.
static double touchdown_length(const Line *line)
{
    const LineMakeup *makeup = &((LineWork *)line->workspace)->makeup;
    double length = 0;
    for (int i = 0; i + 1 < line->node_count; i++) {
        double a = line->position[i].z - makeup->bed, b = line->position[i + 1].z - makeup->bed;
        double low = mind(a, b), high = maxd(a, b);
        if (low > 0) continue;
        double share = high <= 0 ? 1 : -low / (high - low);
        length += share * makeup->segment[i]->length;
    }
    return length;
}

/// Tension, touchdown and water of the state as it stands; used after the start.
void line_settle(Line *line, const WaterField *water)
{
    LineWork *work = line->workspace;
    int last = line->node_count - 1;
    work->water_moves = false;
    for (int i = 0; i <= last; i++)
        work->water_now[6][i] = water->level;
    for (int i = 0; i <= last; i++) {
        work->now.x[i] = line->position[i].x;
        work->now.y[i] = line->position[i].y;
        work->now.z[i] = line->position[i].z;
        work->now.u[i] = work->now.v[i] = work->now.w[i] = 0;
    }
    line_segments(work, &work->now);
    line_node_forces(work, &work->now);
    for (int i = 0; i < last; i++) {
        line->tension[i] = work->tension[i + 1];
        line->largest_tension = maxd(line->largest_tension, line->tension[i]);
    }
    line->anchor_force = vec3(work->fx[0], work->fy[0], work->fz[0]);
    line->fairlead_force = vec3(work->fx[last], work->fy[last], work->fz[last]);
    line->touchdown = touchdown_length(line);
    for (int side = 0; side < 2; side++)
        line->pull[side] = work->end_load[side] =
            line_end_load(work, line->position, line->velocity, line->tension, side);
}

bool line_take(const LineScene *scene, const WaterField *water, const int point[2],
               const char *where, Arena *arena, Line *line, Error *error)
{
    int n = scene->segments + 1;
    memset(line, 0, sizeof *line);
    line->scene = scene;
    line->node_count = n;
    line->stepper = LINE_STEPPER_BDF2;
    line->parted_last = -1;
    LineWork *work = arena_take(arena, 1, sizeof *work, where, error);
    TRY(line->position = arena_take(arena, (size_t)n, sizeof(Vec3), where, error));
    TRY(line->velocity = arena_take(arena, (size_t)n, sizeof(Vec3), where, error));
    TRY(take_doubles(arena, &line->tension, n, where, error));
    if (!work) return false;
    TRY(take_workspace(arena, work, n, where, error));
    TRY(makeup_create(scene, water, where, arena, &work->makeup, error));
    line->workspace = work;
    work->point[0] = point[0];
    work->point[1] = point[1];
    work->node_count = n;
    line->parted = work->makeup.parted;
    line->length = makeup_arc(&work->makeup, n - 1);
    line->step_limit = work->makeup.step_limit;
    line->sound_speed = work->makeup.sound_speed;
    for (int i = 0; i < n; i++)
        work->share[i] = work->bed_share[i] = 1;
    for (int side = 0; side < 2; side++) {
        int end = side ? n - 1 : 0;
        work->share[end] = 0.5;
        work->bed_share[end] = point[side] < 0 ? 0 : 0.5; // whoever holds an end carries it
    }
    return line_bdf2_create(line, arena, where, error);
}

bool line_create(const LineScene *scene, Vec3 anchor, Vec3 fairlead, const WaterField *water,
                 const char *where, Arena *arena, Line *line, LineStatics *statics, Error *error)
{
    const int held[2] = {-1, -1};
    LineStatics unused;
    TRY(line_take(scene, water, held, where, arena, line, error));
    TRY(line_statics(scene, anchor, fairlead, water, where, line->position,
                     statics ? statics : &unused, error));
    line_settle(line, water);
    return true;
}

Vec3 end_path_position(const EndPath *path, double duration, double fraction)
{
    double s = fraction, s2 = s * s, s3 = s2 * s;
    Vec3 p = vec3_scale(path->position[0], 2 * s3 - 3 * s2 + 1);
    p = vec3_mad(p, path->position[1], 3 * s2 - 2 * s3);
    p = vec3_mad(p, path->velocity[0], duration * (s3 - 2 * s2 + s));
    return vec3_mad(p, path->velocity[1], duration * (s3 - s2));
}

Vec3 end_path_velocity(const EndPath *path, double duration, double fraction)
{
    double s = fraction, s2 = s * s;
    Vec3 moved = vec3_sub(path->position[1], path->position[0]);
    Vec3 v = vec3_scale(moved, 6 * (s - s2) / duration);
    v = vec3_mad(v, path->velocity[0], 3 * s2 - 4 * s + 1);
    return vec3_mad(v, path->velocity[1], 3 * s2 - 2 * s);
}

void line_hold_ends(const LineWork *work, LineNodes *nodes, const LineSpan *span, double fraction)
{
    const EndPath *paths[2] = {span->anchor, span->fairlead};
    int ends[2] = {0, work->node_count - 1};
    for (int k = 0; k < 2; k++) {
        if (work->point[k] >= 0) continue;
        Vec3 p = end_path_position(paths[k], span->duration, fraction);
        Vec3 v = end_path_velocity(paths[k], span->duration, fraction);
        nodes->x[ends[k]] = p.x;
        nodes->y[ends[k]] = p.y;
        nodes->z[ends[k]] = p.z;
        nodes->u[ends[k]] = v.x;
        nodes->v[ends[k]] = v.y;
        nodes->w[ends[k]] = v.z;
    }
}

void line_water_at(LineWork *work, double fraction)
{
    if (!work->water_moves) return;
    int count = work->node_count;
    for (int k = 0; k < 7; k++) {
        const double *restrict a = work->water[0][k], *restrict b = work->water[1][k];
        double *restrict now = work->water_now[k];
        for (int i = 0; i < count; i++)
            now[i] = a[i] + fraction * (b[i] - a[i]);
    }
}

/// Ask for the water at the nodes' present places at begin and end of the call; in between it is
/// taken linear in time (two questions per fluid step, however many sub-steps follow).
static void sample_water(Line *line, const WaterField *water, double time, double duration)
{
    LineWork *work = line->workspace;
    int count = line->node_count;
    work->water_moves = water->at_nodes != NULL;
    if (!work->water_moves) {
        for (int k = 0; k < 7; k++)
            for (int i = 0; i < count; i++)
                work->water_now[k][i] = k == 6 ? water->level : 0;
        return;
    }
    for (int side = 0; side < 2; side++) {
        water->at_nodes(water->context, line->scene->water, time + side * duration, count,
                        line->position, work->sample_velocity, work->sample_acceleration,
                        work->sample_elevation);
        double **to = work->water[side];
        for (int i = 0; i < count; i++) {
            to[0][i] = work->sample_velocity[i].x;
            to[1][i] = work->sample_velocity[i].y;
            to[2][i] = work->sample_velocity[i].z;
            to[3][i] = work->sample_acceleration[i].x;
            to[4][i] = work->sample_acceleration[i].y;
            to[5][i] = work->sample_acceleration[i].z;
            to[6][i] = work->sample_elevation[i];
        }
    }
}

SpecialNode line_special_node(const LineWork *work, const Vec3 *x, int node)
{
    Vec3 place[3];
    double elevation[3];
    for (int k = 0; k < 3; k++) {
        int at = node - 1 + k < 0 || node - 1 + k >= work->node_count ? node : node - 1 + k;
        place[k] = x[at];
        elevation[k] = work->water_now[6][at];
    }
    return makeup_special_node(&work->makeup, node, place, elevation);
}

/// An end of a line: half a segment, with its direction and how wet it is.
typedef struct HalfSegment {
    const LineConstants *c;
    Vec3 q; ///< from the anchor to the fairlead; 0 when the segment has parted
    double wet;
} HalfSegment;

static HalfSegment half_segment(const LineWork *work, const Vec3 *x, int side)
{
    int node = side ? work->node_count - 1 : 0, inner = side ? node - 1 : 1;
    bool parted = work->makeup.parted[side ? inner : node];
    const double *elevation = work->water_now[6];
    double radius = work->makeup.segment[side ? inner : node]->radius;
    double depth = elevation[node] - x[node].z;
    double beyond = parted ? depth : elevation[inner] - x[inner].z;
    HalfSegment half = {work->makeup.node[node], {0, 0, 0}, 1};
    if (depth < radius || beyond < radius) half.wet = line_wet_fraction(depth, beyond, radius);
    if (parted) return half;
    Vec3 d = side ? vec3_sub(x[node], x[inner]) : vec3_sub(x[inner], x[node]);
    double size = vec3_norm(d);
    half.q = vec3_scale(d, size > 1e-12 * half.c->length ? 1 / size : 0);
    return half;
}

/// Shear of a line that bends, at its end [N].
static Vec3 end_shear(const LineWork *work, const Vec3 *x, int side)
{
    int i = side ? work->node_count - 2 : 1;
    if (work->node_count < 3) return vec3(0, 0, 0);
    Vec3 force[3];
    Bend bend = makeup_bend(&work->makeup, i, vec3_sub(x[i], x[i - 1]), vec3_sub(x[i + 1], x[i]));
    bend_forces(&bend, force);
    return force[side ? 2 : 0];
}

Vec3 line_end_load(const LineWork *work, const Vec3 *x, const Vec3 *v, const double *tension,
                   int side)
{
    int node = side ? work->node_count - 1 : 0;
    double *const *water = work->water_now;
    HalfSegment end = half_segment(work, x, side);
    Vec3 relative = vec3_sub(vec3(water[0][node], water[1][node], water[2][node]), v[node]);
    Vec3 force = vec3_scale(end.q, side ? -tension[node - 1] : tension[0]);
    force = vec3_add(force, line_drag(end.c, end.wet, end.q, relative));
    if (work->water_moves)
        force = vec3_add(force,
                         line_water_inertia(end.c, end.wet, end.q,
                                            vec3(water[3][node], water[4][node], water[5][node])));
    force.z += end.c->buoyancy * end.wet - end.c->weight;
    return work->makeup.bends ? vec3_add(force, end_shear(work, x, side)) : force;
}

/// What the mass and added mass of an end's half segment take up of the mean force on it [N].
static Vec3 end_inertia(const Line *line, int side, Vec3 gained, double duration)
{
    const LineWork *work = line->workspace;
    if (gained.x == 0 && gained.y == 0 && gained.z == 0) return gained; // most anchors
    HalfSegment end = half_segment(work, line->position, side);
    return line_inertia(line_mass_normal(end.c, 1, end.wet),
                        line_mass_tangential(end.c, 1, end.wet), end.q,
                        vec3_scale(gained, 1 / duration));
}

static void line_load(Line *line)
{
    LineNodes *now = &((LineWork *)line->workspace)->now;
    for (int i = 0; i < line->node_count; i++) {
        now->x[i] = line->position[i].x;
        now->y[i] = line->position[i].y;
        now->z[i] = line->position[i].z;
        now->u[i] = line->velocity[i].x;
        now->v[i] = line->velocity[i].y;
        now->w[i] = line->velocity[i].z;
    }
}

static void line_store(Line *line)
{
    LineWork *work = line->workspace;
    const LineNodes *now = &work->now;
    for (int i = 0; i < line->node_count; i++) {
        line->position[i] = vec3(now->x[i], now->y[i], now->z[i]);
        line->velocity[i] = vec3(now->u[i], now->v[i], now->w[i]);
    }
    line_water_at(work, 1);
    line_segments(work, now);
    memcpy(line->tension, work->tension + 1, (size_t)(line->node_count - 1) * sizeof(double));
    for (int i = 1; i < line->node_count; i++)
        line->largest_tension = maxd(line->largest_tension, work->peak[i]);
}

/// The explicit step works on one array per component and leaves no history.
static bool advance_rk2(LineNet *net, const LineSpan *spans, LineSickness *sick)
{
    for (int l = 0; l < net->line_count; l++) {
        LineWork *work = net->lines[l]->workspace;
        line_load(net->lines[l]);
        line_hold_ends(work, &work->now, &spans[l], 0);
        memset(work->peak, 0, (size_t)(work->node_count + 1) * sizeof(double));
    }
    bool good = net_step_rk2(net, spans, sick);
    for (int l = 0; l < net->line_count; l++) {
        line_store(net->lines[l]);
        line_bdf2_forget(net->lines[l]);
    }
    return good;
}

static bool report_sickness(const LineSickness *sick, Error *error)
{
    const Line *line = sick->line;
    Vec3 x = line->position[sick->node], v = line->velocity[sick->node];
    bool explicit_step = line->stepper == LINE_STEPPER_RK2;
    return error_set(error, ERROR_PHYSICS,
                     "line %s: node %d at t = %.6g s: position (%.4g, %.4g, %.4g) m, velocity "
                     "(%.4g, %.4g, %.4g) m/s; accepted: %s, %.4g m/s (sub-step limit %.3g s)",
                     line->scene->name, sick->node, sick->time, x.x, x.y, x.z, v.x, v.y, v.z,
                     explicit_step ? "finite and slower than sound in the line"
                                   : "an implicit step that has a solution; sound in the line",
                     line->sound_speed, line->step_limit);
}

/// Pulls and touchdown after a call. The pull on an end's holder is the mean force on its half
/// segment less what that half segment's own inertia takes up; carried on, half the change of the
/// load over the call is added, and the inertia, which belongs to the velocities' times half a step
/// earlier, changes as it did last. Both sums telescope: over many steps no momentum is lost.
static void finish_ends(Line *line, double duration)
{
    LineWork *work = line->workspace;
    line->touchdown = touchdown_length(line);
    for (int side = 0; side < 2; side++) {
        int end = side ? line->node_count - 1 : 0;
        if (line->stepper == LINE_STEPPER_RK2)
            work->end_load[side] =
                line_end_load(work, line->position, line->velocity, line->tension, side);
        Vec3 gained = vec3_sub(line->velocity[end], work->end_velocity[side]);
        Vec3 inertia = end_inertia(line, side, gained, duration);
        Vec3 mean = vec3_scale(work->end_force[side], 1 / duration);
        Vec3 load = vec3_sub(work->end_load[side], work->load_before[side]);
        Vec3 change = vec3_sub(vec3_scale(load, 0.5), vec3_sub(inertia, work->end_inertia[side]));
        Vec3 pull = vec3_sub(mean, inertia);
        *(side ? &line->fairlead_force : &line->anchor_force) = pull;
        line->pull[side] = vec3_add(pull, change);
        Vec3 path = vec3_add(line->velocity[end], work->end_velocity[side]);
        line->work[side] = work->end_work[side] - 0.5 * duration * vec3_dot(inertia, path);
        work->end_inertia[side] = inertia;
    }
}

bool net_advance(LineNet *net, const WaterField *water, const LineSpan *spans, Error *error)
{
    double time = spans[0].time, duration = spans[0].duration;
    ASSERT(duration > 0);
    for (int l = 0; l < net->line_count; l++) {
        Line *line = net->lines[l];
        LineWork *work = line->workspace;
        sample_water(line, water, time, duration);
        for (int side = 0; side < 2; side++) {
            const EndPath *path = side ? spans[l].fairlead : spans[l].anchor;
            bool free = work->point[side] >= 0;
            work->end_velocity[side] =
                free ? line->velocity[side ? line->node_count - 1 : 0] : path->velocity[0];
            work->end_force[side] = vec3(0, 0, 0);
            work->end_work[side] = 0;
            work->load_before[side] = work->end_load[side];
        }
    }
    LineSickness sick;
    bool good = net->lines[0]->stepper == LINE_STEPPER_RK2 ? advance_rk2(net, spans, &sick)
                                                           : net_step_bdf2(net, spans, &sick);
    if (!good) return report_sickness(&sick, error);
    for (int l = 0; l < net->line_count; l++)
        finish_ends(net->lines[l], duration);
    return true;
}

bool line_advance(Line *line, const WaterField *water, double time, double duration,
                  const EndPath *anchor, const EndPath *fairlead, Error *error)
{
    LineSpan span = {time, duration, anchor, fairlead};
    Chain *chain = line_bdf2_chain(line);
    Vec3 impulse[1][2];
    LineNet net;
    memset(&net, 0, sizeof net);
    net.line_count = 1;
    net.lines = &line;
    net.chains = &chain;
    net.impulse = impulse;
    return net_advance(&net, water, &span, error);
}

double line_energy(const Line *line)
{
    const LineMakeup *makeup = &((LineWork *)line->workspace)->makeup;
    double energy = 0;
    for (int n = 0; n < line->node_count; n++) {
        const LineConstants *c = makeup->node[n];
        energy += 0.5 * c->mass * vec3_dot(line->velocity[n], line->velocity[n]) +
                  (c->weight - c->buoyancy) * line->position[n].z;
        if (!n) continue;
        c = makeup->segment[n - 1];
        double stretch = vec3_norm(vec3_sub(line->position[n], line->position[n - 1])) - c->length;
        if (stretch > 0) energy += 0.5 * c->stiffness * stretch * stretch;
        if (!makeup->bends || n < 2) continue;
        Bend bend =
            makeup_bend(makeup, n - 1, vec3_sub(line->position[n - 1], line->position[n - 2]),
                        vec3_sub(line->position[n], line->position[n - 1]));
        energy += bend.stiffness * (1 - vec3_dot(bend.before, bend.after));
    }
    return energy;
}

/// What a saved line holds besides its arrays.
typedef struct LineRest {
    Vec3 fairlead_force, anchor_force, pull[2], end_load[2], end_inertia[2];
    double largest_tension, touchdown, substeps;
    double parted_count, parted_last, parted_time;
    double fairlead_length;
    double winch[5], turning;
} LineRest;

/// A saved line: positions, velocities, tensions, what parted, rest, history of the implicit
/// stepper.
size_t line_state_size(const Line *line)
{
    const LineWork *work = line->workspace;
    return (size_t)line->node_count * 8 + sizeof(LineRest) / sizeof(double) + work->history_size;
}

void line_state_save(const Line *line, double *to)
{
    const LineWork *work = line->workspace;
    const Winch *winch = &work->winch;
    size_t n = (size_t)line->node_count;
    LineRest rest = {line->fairlead_force,
                     line->anchor_force,
                     {line->pull[0], line->pull[1]},
                     {work->end_load[0], work->end_load[1]},
                     {work->end_inertia[0], work->end_inertia[1]},
                     line->largest_tension,
                     line->touchdown,
                     (double)line->substeps,
                     line->parted_count,
                     line->parted_last,
                     line->parted_time,
                     work->makeup.fairlead_length,
                     {winch->from, winch->rate, winch->to, winch->begin, winch->duration},
                     winch->turning};
    memcpy(to, line->position, n * sizeof(Vec3));
    memcpy(to + 3 * n, line->velocity, n * sizeof(Vec3));
    memcpy(to + 6 * n, line->tension, n * sizeof(double));
    for (size_t i = 0; i < n; i++)
        to[7 * n + i] = work->makeup.parted[i];
    memcpy(to + 8 * n, &rest, sizeof rest);
    memcpy(to + 8 * n + sizeof rest / sizeof(double), work->history,
           work->history_size * sizeof(double));
}

void line_state_restore(Line *line, const double *from)
{
    LineWork *work = line->workspace;
    size_t n = (size_t)line->node_count;
    LineRest rest;
    memcpy(line->position, from, n * sizeof(Vec3));
    memcpy(line->velocity, from + 3 * n, n * sizeof(Vec3));
    memcpy(line->tension, from + 6 * n, n * sizeof(double));
    for (size_t i = 0; i < n; i++)
        work->makeup.parted[i] = from[7 * n + i] != 0;
    memcpy(&rest, from + 8 * n, sizeof rest);
    memcpy(work->history, from + 8 * n + sizeof rest / sizeof(double),
           work->history_size * sizeof(double));
    line->fairlead_force = rest.fairlead_force;
    line->anchor_force = rest.anchor_force;
    memcpy(line->pull, rest.pull, sizeof rest.pull);
    memcpy(work->end_load, rest.end_load, sizeof rest.end_load);
    memcpy(work->end_inertia, rest.end_inertia, sizeof rest.end_inertia);
    line->largest_tension = rest.largest_tension;
    line->touchdown = rest.touchdown;
    line->substeps = (long)rest.substeps;
    line->parted_count = (int)rest.parted_count;
    line->parted_last = (int)rest.parted_last;
    line->parted_time = rest.parted_time;
    Winch winch = {rest.winch[0], rest.winch[1], rest.winch[2],
                   rest.winch[3], rest.winch[4], rest.turning != 0};
    work->winch = winch;
    work->makeup.fairlead_length = rest.fairlead_length;
    makeup_update(&work->makeup);
    line->step_limit = work->makeup.step_limit;
    line->length = makeup_arc(&work->makeup, work->makeup.segments);
}
