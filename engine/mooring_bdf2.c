/// The implicit step: variable-step BDF2 (backward Euler for the first), O(nodes) by
/// block-tridiagonal solves, for any axial stiffness.
///
/// One step solves M a(x) = F(x, v(x)) with v = (alpha x + ...)/h, a = (alpha v + ...)/h. Each
/// outer iteration fixes the directions of the segments; what is left is a monotone problem,
/// piecewise linear in the tensions (slack, damping clamped, free) and gently curved in the bed,
/// which Newton with a line search solves however many segments change sides. The full move is then
/// taken, and one such iteration is mostly enough: geometry errs by EA |d_perp|^2/(2 l^2),
/// quadratic in what the predictor missed. Geometric stiffness uses the tension *solved for*, not
/// the one of the iterate's lengths, which would be wild for steel. Sources: Gear (1971) for BDF;
/// docs/mooring.md for the choice among eight schemes.
#include <string.h>

#include "mooring_implicit.h"

/// A call is split at most this fine before the line counts as sick.
static const double SPLIT_FINEST = 1.0 / 4096;
/// Share of what the predictor missed that is the step's own error: 2/9 of 2/9 + 5/12.
static const double PREDICTOR_SHARE = 8.0 / 23;
/// Local error of a node's place that is allowed, in lengths of the line…
static const double ERROR_GOAL = 1e-5;
/// …down to this share of the call; below, only what has no solution at all is split.
static const double ERROR_FINEST = 1.0 / 256;
/// A step that errs by less than this share of the goal may be followed by a longer one.
static const double GROWTH_ERROR = 0.1;
/// Largest growth from one step to the next; BDF2 stays stable up to 2.41.
static const double GROWTH_MAX = 2;

/// History of the line, kept with its state: place and velocity one step back, that step's length
/// (0: none yet).
typedef struct History {
    Vec3 *position, *velocity;
    double *step;
} History;

static History history_of(const Line *line)
{
    const LineWork *work = line->workspace;
    History history;
    history.position = (Vec3 *)work->history;
    history.velocity = history.position + line->node_count;
    history.step = (double *)(history.velocity + line->node_count);
    return history;
}

bool line_bdf2_create(Line *line, Arena *arena, const char *what, Error *error)
{
    LineWork *work = line->workspace;
    size_t n = (size_t)line->node_count;
    Implicit *im = arena_take(arena, 1, sizeof *im, what, error);
    work->history_size = 6 * n + 1;
    work->history = arena_take(arena, work->history_size, sizeof(double), what, error);
    if (!im || !work->history) return false;
    Vec3 **vectors[] = {&im->x,        &im->v,     &im->velocity_known, &im->acceleration_known,
                        &im->residual, &im->force, &im->move,           &im->guess};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        TRY(*vectors[i] = arena_take(arena, n, sizeof(Vec3), what, error));
    im->linear = arena_take(arena, n, sizeof(Sym3), what, error);
    im->segments = arena_take(arena, n, sizeof(Segment), what, error);
    im->contacts = arena_take(arena, n, sizeof(Contact), what, error);
    im->tension = arena_take(arena, n, sizeof(double), what, error);
    work->implicit = im;
    im->first = work->point[0] >= 0 ? 0 : 1;
    im->end = line->node_count - (work->point[1] >= 0 ? 0 : 1);
    if (!im->linear || !im->segments || !im->contacts || !im->tension) return false;
    return chain_create(&im->chain, line->node_count - 1, work->point, work->makeup.bends, arena,
                        what, error);
}

/// Formula of the step and a quadratic guess of where it ends.
static void predict(Line *line, Implicit *im, double h)
{
    History past = history_of(line);
    double before = *past.step, ratio = before > 0 ? h / before : 0;
    double alpha = (1 + 2 * ratio) / (1 + ratio);
    double now = before > 0 ? -(1 + ratio) : -1, old = ratio * ratio / (1 + ratio);
    double inverse = 1 / h, curve = before > 0 ? 0.5 * h * h / before : 0;
    im->h = h;
    im->rate_slope = alpha * inverse;
    for (int i = 0; i < line->node_count; i++) {
        Vec3 x = line->position[i], v = line->velocity[i];
        Vec3 x1 = past.position[i], v1 = past.velocity[i];
        im->velocity_known[i] =
            vec3_scale(vec3_add(vec3_scale(x, now), vec3_scale(x1, old)), inverse);
        im->acceleration_known[i] =
            vec3_scale(vec3_add(vec3_scale(v, now), vec3_scale(v1, old)), inverse);
        im->x[i] = vec3_mad(vec3_mad(x, v, h), vec3_sub(v, v1), curve);
        im->guess[i] = im->x[i];
        im->v[i] = vec3_mad(im->velocity_known[i], im->x[i], im->rate_slope);
    }
    memcpy(im->tension, line->tension, (size_t)(line->node_count - 1) * sizeof(double));
}

static const EndPath *path_of(const LineSpan *span, int side)
{
    return side ? span->fairlead : span->anchor;
}

/// Where a line would be after a step of h, ends on their paths, in the water of that instant.
static void pose_step(Line *line, const LineSpan *span, double done, double h)
{
    LineWork *work = line->workspace;
    Implicit *im = work->implicit;
    double fraction = (done + h) / span->duration;
    line_wind(line, span->time + done + h);
    predict(line, im, h);
    for (int side = 0; side < 2; side++) {
        int end = side ? line->node_count - 1 : 0;
        if (work->point[side] >= 0) continue;
        im->x[end] = end_path_position(path_of(span, side), span->duration, fraction);
        im->v[end] = end_path_velocity(path_of(span, side), span->duration, fraction);
        im->move[end] = vec3(0, 0, 0);
    }
    line_water_at(work, fraction);
}

/// The iterate becomes the state, the state history.
static void accept(Line *line, double h)
{
    LineWork *work = line->workspace;
    Implicit *im = work->implicit;
    History past = history_of(line);
    size_t n = (size_t)line->node_count;
    memcpy(past.position, line->position, n * sizeof(Vec3));
    memcpy(past.velocity, line->velocity, n * sizeof(Vec3));
    *past.step = h;
    memcpy(line->position, im->x, n * sizeof(Vec3));
    memcpy(line->velocity, im->v, n * sizeof(Vec3));
    memcpy(line->tension, im->tension, (n - 1) * sizeof(double));
    for (size_t i = 0; i + 1 < n; i++)
        line->largest_tension = maxd(line->largest_tension, line->tension[i]);
    line->substeps++;
}

/// The node to blame when no step is small enough: the first that is not finite, else the one that
/// the last iteration still moved most.
static LineSickness blame(const LineNet *net, double time)
{
    LineSickness sick = {net->lines[0], 0, time};
    double farthest = -1;
    for (int l = 0; l < net->line_count; l++) {
        const Implicit *im = ((LineWork *)net->lines[l]->workspace)->implicit;
        for (int i = 0; i < net->lines[l]->node_count; i++) {
            double moved = vec3_norm(im->move[i]);
            bool finite = isfinite(vec3_norm(im->x[i])) && isfinite(moved);
            if (finite && moved <= farthest) continue;
            farthest = moved;
            sick.line = net->lines[l];
            sick.node = i;
            if (!finite) return sick;
        }
    }
    return sick;
}

Chain *line_bdf2_chain(const Line *line)
{
    return &((Implicit *)((LineWork *)line->workspace)->implicit)->chain;
}

void line_bdf2_forget(Line *line) { *history_of(line).step = 0; }

/// The line's state has gone on by h: so have impulse and work on its ends, by the trapezoidal
/// rule.
static void add_end_loads(Line *line, double h)
{
    LineWork *work = line->workspace;
    History past = history_of(line);
    for (int side = 0; side < 2; side++) {
        int end = side ? line->node_count - 1 : 0;
        Vec3 moved = vec3_sub(line->position[end], past.position[end]);
        Vec3 load = line_end_load(work, line->position, line->velocity, line->tension, side);
        Vec3 sum = vec3_add(work->end_load[side], load);
        work->end_force[side] = vec3_mad(work->end_force[side], sum, 0.5 * h);
        work->end_work[side] += 0.5 * vec3_dot(sum, moved);
        work->end_load[side] = load;
    }
}

/// Local error of a step that is solved, as a share of what is allowed: for equal steps BDF2 errs
/// by 2/9 h^3 x''', the predictor by 5/12 more (Taylor series). 0 when there is no history to go
/// by.
static double step_error(const LineNet *net)
{
    double worst = 0;
    if (*history_of(net->lines[0]).step == 0) return 0;
    for (int l = 0; l < net->line_count; l++) {
        const LineWork *work = net->lines[l]->workspace;
        const Implicit *im = work->implicit;
        double farthest = 0;
        for (int i = im->first; i < im->end; i++) {
            Vec3 missed = vec3_sub(im->x[i], im->guess[i]);
            farthest = maxd(farthest, vec3_dot(missed, missed));
        }
        worst = maxd(worst, farthest / (net->lines[l]->length * net->lines[l]->length));
    }
    return PREDICTOR_SHARE * sqrt(worst) / ERROR_GOAL;
}

/// One step of h, accepted by all lines when it has a solution that is exact enough, or that is at
/// all when h is at most `finest`.
/// @return local error as a share of what is allowed; INFINITY without a solution
static double net_step(LineNet *net, const LineSpan *spans, double done, double h, double finest)
{
    for (int l = 0; l < net->line_count; l++)
        pose_step(net->lines[l], &spans[l], done, h);
    if (!implicit_solve(net)) return INFINITY;
    double error = step_error(net);
    if (error > 1 && h > finest) return error;
    for (int l = 0; l < net->line_count; l++) {
        accept(net->lines[l], h);
        add_end_loads(net->lines[l], h);
    }
    return error;
}

bool net_step_bdf2(LineNet *net, const LineSpan *spans, LineSickness *sick)
{
    double duration = spans[0].duration, done = 0, longest = duration;
    while (done < duration) {
        double left = duration - done, before = *history_of(net->lines[0]).step;
        double h = before > 0 ? mind(longest, GROWTH_MAX * before) : longest;
        h = left / ceil(left / h - 1e-9);
        double finest = ERROR_FINEST * duration, error = net_step(net, spans, done, h, finest);
        if (error > 1 && (isinf(error) || h > finest)) {
            longest = 0.5 * h;
            if (longest > SPLIT_FINEST * duration) continue;
            *sick = blame(net, spans[0].time + done);
            return false;
        }
        done = left - h < 1e-12 * duration ? duration : done + h;
        longest = mind(duration, error < GROWTH_ERROR ? GROWTH_MAX * h : h);
        net_part(net, spans[0].time + done);
    }
    return true;
}
