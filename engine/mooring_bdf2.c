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

#include "mooring_block.h"
#include "mooring_internal.h"

enum { OUTER_MAX = 12, INNER_MAX = 25, SEARCH_MAX = 12 };
/// Error of the tension allowed for geometry, as a share of tension + segment weight.
static const double GEOMETRY_GOAL = 1e-5;
/// The same for a change of tension within an iteration, which turns with the segment.
static const double TURNING_GOAL = 1e-4;
/// Piecewise-linear tensions are met to this share, bed forces to the next.
static const double TENSION_GOAL = 1e-6, BED_GOAL = 1e-3;
/// A call is split at most this fine before the line counts as sick.
static const double SPLIT_FINEST = 1.0 / 4096;
/// Largest growth from one step to the next; BDF2 stays stable up to 2.41.
static const double GROWTH_MAX = 2;

typedef struct Segment {
    const LineConstants *c;
    Vec3 q;                ///< direction at the iterate
    double s, rate;        ///< length and its rate at the iterate [m], [m/s]
    double across;         ///< geometric stiffness: tension solved for over length [N/m]
    double u, du;          ///< lengthening by the move and by the Newton step [m]
    double tension, slope; ///< at s + u [N], [N/m]
    double reached;        ///< tension after the whole Newton step [N]
    double wet;            ///< submerged fraction
} Segment;

typedef struct Contact {
    const LineConstants *c; ///< of the node
    double z, rate;         ///< of the node at the iterate
    double force, slope;    ///< of the bed after the move [N], [N/m]
} Contact;

typedef struct Implicit {
    double h, rate_slope;     ///< step [s]; alpha/h, change of velocity with place [1/s]
    Vec3 *x, *v;              ///< iterate [node_count]
    Vec3 *velocity_known;     ///< v = rate_slope x + velocity_known
    Vec3 *acceleration_known; ///< a = rate_slope v + acceleration_known
    Vec3 *force;              ///< everything but tension and bed, inertia taken off [N]
    Vec3 *residual;           ///< out of balance at the move so far [N]
    Vec3 *move, *step;        ///< move so far in this linearisation, Newton step [m]
    Sym3 *linear;             ///< -d force / d x [N/m]
    Sym3 *diagonal;           ///< blocks of the system, then inverse pivots
    Coupling *links;
    Segment *segments;
    Contact *contacts;
    double *tension;   ///< solved for, of the last iteration [segments][N]
    long outer, inner; ///< iterations so far
} Implicit;

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
    Vec3 **vectors[] = {&im->x,     &im->v,        &im->velocity_known, &im->acceleration_known,
                        &im->force, &im->residual, &im->move,           &im->step};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        if (!(*vectors[i] = arena_take(arena, n, sizeof(Vec3), what, error))) return false;
    im->linear = arena_take(arena, n, sizeof(Sym3), what, error);
    im->diagonal = arena_take(arena, n, sizeof(Sym3), what, error);
    im->links = arena_take(arena, n, sizeof(Coupling), what, error);
    im->segments = arena_take(arena, n, sizeof(Segment), what, error);
    im->contacts = arena_take(arena, n, sizeof(Contact), what, error);
    im->tension = arena_take(arena, n, sizeof(double), what, error);
    work->implicit = im;
    return im->linear && im->diagonal && im->links && im->segments && im->contacts && im->tension;
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
        im->v[i] = vec3_mad(im->velocity_known[i], im->x[i], im->rate_slope);
    }
    memcpy(im->tension, line->tension, (size_t)(line->node_count - 1) * sizeof(double));
}

static void linearise_segments(const LineWork *work, Implicit *im)
{
    const LineMakeup *makeup = &work->makeup;
    const double *elevation = work->water_now[6];
    for (int i = 0; i + 1 < work->node_count; i++) {
        const LineConstants *c = makeup->segment[i];
        Segment *segment = &im->segments[i];
        Vec3 d = vec3_sub(im->x[i + 1], im->x[i]);
        double s = vec3_norm(d);
        double inverse = s > 1e-12 * c->length && c->stiffness > 0 ? 1 / s : 0;
        double depth0 = elevation[i] - im->x[i].z, depth1 = elevation[i + 1] - im->x[i + 1].z;
        bool deep = depth0 > c->radius && depth1 > c->radius;
        segment->c = c;
        segment->q = vec3_scale(d, inverse);
        segment->s = s;
        segment->rate = vec3_dot(segment->q, vec3_sub(im->v[i + 1], im->v[i]));
        segment->across = im->tension[i] * inverse;
        segment->u = 0;
        segment->tension = line_tension(c, s, segment->rate);
        segment->slope = line_tension_slope(c, s, segment->rate, im->rate_slope);
        segment->wet = deep ? 1 : line_wet_fraction(depth0, depth1, c->radius);
    }
}

/// Everything about a node but tension and bed: force less inertia, and how it falls with place.
static void linearise_node(const LineWork *work, Implicit *im, int i)
{
    const LineConstants *c = work->makeup.node[i];
    const Segment *before = &im->segments[i - 1], *after = &im->segments[i];
    double wet = 0.5 * (before->wet + after->wet), slope = im->rate_slope;
    Vec3 q = vec3_sub(im->x[i + 1], im->x[i - 1]), v = im->v[i];
    double size = vec3_norm(q);
    q = vec3_scale(q, size > 1e-12 * c->length ? 1 / size : 0);
    SpecialNode special;
    if (c == &work->makeup.blends[i]) {
        special = makeup_special_node(&work->makeup, i, &im->x[i - 1], &work->water_now[6][i - 1]);
        c = &special.sum;
        q = special.q;
        wet = 1;
    }
    double *const *water = work->water_now;
    Vec3 relative = vec3(water[0][i] - v.x, water[1][i] - v.y, water[2][i] - v.z);
    double normal = line_mass_normal(c, 1, wet), tangential = line_mass_tangential(c, 1, wet);
    Vec3 a = vec3_mad(im->acceleration_known[i], v, slope);
    Vec3 force = vec3_sub(line_drag(c, wet, q, relative), line_inertia(normal, tangential, q, a));
    if (work->water_moves)
        force = vec3_add(
            force, line_water_inertia(c, wet, q, vec3(water[3][i], water[4][i], water[5][i])));
    force.z += c->buoyancy * wet - c->weight;

    Contact *contact = &im->contacts[i];
    contact->c = work->makeup.node[i];
    contact->z = im->x[i].z;
    contact->rate = v.z;
    contact->force = contact->slope = 0;
    double rub = 0;
    if (contact->z < c->bed) {
        contact->force = line_bed_force(c, 1, contact->z, contact->rate);
        contact->slope = line_bed_slope(c, 1, contact->z, contact->rate, slope);
        rub = line_bed_friction(c, contact->force, sqrt(v.x * v.x + v.y * v.y));
        force.x -= rub * v.x;
        force.y -= rub * v.y;
    }
    im->force[i] = force;

    // M alpha^2/h^2 plus the drag's slopes: |u_n| across, |u_n| + u_n^2/|u_n| along u_n, 2 |u_t|
    // along q
    double along = vec3_dot(relative, q);
    Vec3 u_n = vec3_mad(relative, q, -along);
    double speed = vec3_norm(u_n);
    double across_drag = slope * wet * c->drag_normal * speed;
    double along_drag = slope * wet * 2 * c->drag_tangential * fabs(along);
    double across = normal * slope * slope + across_drag;
    double along_q = tangential * slope * slope + along_drag;
    Sym3 linear = {slope * rub, slope * rub, 0, 0, 0, 0};
    sym3_add(&linear, across, along_q - across, q);
    if (speed > 0) sym3_add(&linear, 0, across_drag / (speed * speed), u_n);
    im->linear[i] = linear;
    im->move[i] = vec3(0, 0, 0);
}

/// Out-of-balance forces and blocks of the linearised problem at the move so far.
static void assemble(const LineWork *work, Implicit *im)
{
    int last = work->node_count - 1;
    Vec3 below = vec3(0, 0, 0); // pull of the segment below on its upper node, taken from it
    for (int i = 0; i < last; i++) {
        const Segment *segment = &im->segments[i];
        Vec3 turned = vec3_sub(im->move[i + 1], im->move[i]);
        turned = vec3_mad(turned, segment->q, -segment->u);
        Vec3 pull = vec3_mad(vec3_scale(segment->q, segment->tension), turned, segment->across);
        im->links[i].along = segment->slope;
        im->links[i].across = segment->across;
        im->links[i].q = segment->q;
        if (i > 0) {
            const Segment *other = segment - 1;
            Sym3 block = im->linear[i];
            Vec3 f = vec3_sub(im->force[i], sym3_apply(&block, im->move[i]));
            f = vec3_add(f, vec3_sub(pull, below));
            f.z += im->contacts[i].force;
            im->residual[i] = f;
            im->step[i] = f;
            block.zz += im->contacts[i].slope;
            sym3_add(&block, segment->across, segment->slope - segment->across, segment->q);
            sym3_add(&block, other->across, other->slope - other->across, other->q);
            im->diagonal[i] = block;
        }
        below = pull;
    }
}

/// Tension of a segment and force of the bed under a node after a share `t` of the Newton step.
static double tension_at(const Implicit *im, const Segment *s, double t)
{
    double longer = s->u + t * s->du;
    return line_tension(s->c, s->s + longer, s->rate + im->rate_slope * longer);
}

static double bed_at(const Implicit *im, int i, double t)
{
    const Contact *contact = &im->contacts[i];
    double rise = im->move[i].z + t * im->step[i].z;
    return line_bed_force(contact->c, 1, contact->z + rise, contact->rate + im->rate_slope * rise);
}

/// Whether the straight-line formulas held over the whole Newton step, that is: it is solved. Sets
/// du and what the segments carry then. @return 1 yes, 0 no, -1 not a number
static int step_holds(const LineWork *work, Implicit *im)
{
    int last = work->node_count - 1;
    bool holds = true;
    double sum = 0;
    for (int i = 0; i < last; i++) {
        Segment *s = &im->segments[i];
        s->du = vec3_dot(s->q, vec3_sub(im->step[i + 1], im->step[i]));
        s->reached = tension_at(im, s, 1);
        double linear = s->tension + s->slope * s->du;
        holds = holds && fabs(s->reached - linear) <= TENSION_GOAL * (s->reached + s->c->weight);
        sum += s->du;
    }
    for (int i = 1; i < last; i++) {
        const Contact *contact = &im->contacts[i];
        if (contact->z + im->move[i].z + mind(im->step[i].z, 0) > contact->c->bed) continue;
        double exact = bed_at(im, i, 1);
        double linear = contact->force - contact->slope * im->step[i].z;
        holds = holds && fabs(exact - linear) <= BED_GOAL * (exact + contact->c->weight);
    }
    return !isfinite(sum) ? -1 : holds;
}

/// Share of the Newton step at which the work along it vanishes: it falls along the step, by
/// pieces.
static double search_length(const LineWork *work, Implicit *im)
{
    int last = work->node_count - 1;
    double start = 0, stiff = 0; // step . residual, and step . (linear part) step
    for (int i = 1; i < last; i++)
        start += vec3_dot(im->residual[i], im->step[i]);
    stiff = start;
    for (int i = 0; i < last; i++)
        stiff -= im->segments[i].slope * im->segments[i].du * im->segments[i].du;
    for (int i = 1; i < last; i++)
        stiff -= im->contacts[i].slope * im->step[i].z * im->step[i].z;
    double low = 0, high = 1, t = 1;
    for (int k = 0; k < SEARCH_MAX; k++) {
        double work_done = start - t * stiff;
        for (int i = 0; i < last; i++) {
            const Segment *s = &im->segments[i];
            if (s->du != 0) work_done -= (tension_at(im, s, t) - s->tension) * s->du;
        }
        for (int i = 1; i < last; i++)
            if (im->contacts[i].force > 0 || im->step[i].z < 0)
                work_done += (bed_at(im, i, t) - im->contacts[i].force) * im->step[i].z;
        if (fabs(work_done) <= 0.1 * start) return t;
        if (work_done > 0)
            low = t;
        else
            high = t;
        if (low == 1) return 1;
        t = 0.5 * (low + high);
    }
    return t;
}

/// Go a share `t` of the Newton step and see what segments and bed do there.
static void go_along(const LineWork *work, Implicit *im, double t)
{
    int last = work->node_count - 1;
    for (int i = 0; i < last; i++) {
        Segment *s = &im->segments[i];
        s->tension = t == 1 ? s->reached : tension_at(im, s, t);
        s->u += t * s->du;
        s->slope =
            line_tension_slope(s->c, s->s + s->u, s->rate + im->rate_slope * s->u, im->rate_slope);
    }
    for (int i = 1; i < last; i++) {
        Contact *contact = &im->contacts[i];
        im->move[i] = vec3_mad(im->move[i], im->step[i], t);
        double z = contact->z + im->move[i].z;
        double rate = contact->rate + im->rate_slope * im->move[i].z;
        contact->force = line_bed_force(contact->c, 1, z, rate);
        contact->slope = line_bed_slope(contact->c, 1, z, rate, im->rate_slope);
    }
}

/// Solve the problem of fixed directions. @return false when Newton does not settle
static bool solve_directions(const LineWork *work, Implicit *im)
{
    int last = work->node_count - 1;
    for (int k = 0; k < INNER_MAX; k++) {
        assemble(work, im);
        block_solve(1, last, im->diagonal, im->links, im->step);
        int holds = step_holds(work, im);
        if (holds < 0) return false;
        if (!holds) {
            go_along(work, im, search_length(work, im));
            continue;
        }
        for (int i = 0; i < last; i++) {
            im->segments[i].tension = im->segments[i].reached;
            im->segments[i].u += im->segments[i].du;
            im->move[i] = vec3_add(im->move[i], im->step[i]);
        }
        return true;
    }
    return false;
}

/// Take the move. @return 1 when the directions were right enough, 0 when not, -1: not a number
static int take_move(const LineWork *work, Implicit *im)
{
    int last = work->node_count - 1;
    bool right = true;
    double sum = 0;
    for (int i = 0; i < last; i++) {
        const Segment *s = &im->segments[i];
        const LineConstants *c = s->c;
        Vec3 turned = vec3_mad(vec3_sub(im->move[i + 1], im->move[i]), s->q, -s->u);
        double turn2 = vec3_dot(turned, turned), scale = s->tension + c->weight;
        // a turn by d lengthens the segment by d^2/(2 s) and swings a changed tension by d/s
        double longer = 0.5 * turn2 / maxd(s->s, 0.1 * c->length);
        bool slack = s->s + s->u + longer < c->length;
        double change = s->tension - im->tension[i], allowed = TURNING_GOAL * scale;
        right = right && (slack || c->stiffness * longer <= GEOMETRY_GOAL * scale) &&
                change * change * turn2 <= allowed * allowed * c->length * c->length;
        im->tension[i] = s->tension;
        sum += turn2 + s->tension;
    }
    for (int i = 1; i < last; i++) {
        im->x[i] = vec3_add(im->x[i], im->move[i]);
        im->v[i] = vec3_mad(im->velocity_known[i], im->x[i], im->rate_slope);
    }
    return !isfinite(sum) ? -1 : right;
}

/// One step of h from the line's state; the iterate is left in `im`. @return false: not solved
static bool implicit_step(Line *line, const LineSpan *span, double done, double h)
{
    LineWork *work = line->workspace;
    Implicit *im = work->implicit;
    int last = line->node_count - 1;
    predict(line, im, h);
    const EndPath *paths[2] = {span->anchor, span->fairlead};
    for (int side = 0; side < 2; side++) {
        int end = side ? last : 0;
        double fraction = (done + h) / span->duration;
        im->x[end] = end_path_position(paths[side], span->duration, fraction);
        im->v[end] = end_path_velocity(paths[side], span->duration, fraction);
        im->move[end] = im->step[end] = vec3(0, 0, 0);
    }
    line_water_at(work, (done + h) / span->duration);
    for (int k = 0; k < OUTER_MAX; k++) {
        linearise_segments(work, im);
        for (int i = 1; i < last; i++)
            linearise_node(work, im, i);
        if (!solve_directions(work, im)) return false;
        int right = take_move(work, im);
        if (right) return right > 0;
    }
    return false;
}

/// All that acts on an end's half segment, bed apart [N].
static Vec3 end_load(const LineWork *work, const Vec3 *x, const Vec3 *v, const double *tension,
                     int node, int inner)
{
    const LineConstants *c = work->makeup.node[node];
    double *const *water = work->water_now;
    double wet;
    Vec3 q = line_end_direction(work, x, node, inner, &wet);
    Vec3 relative = vec3_sub(vec3(water[0][node], water[1][node], water[2][node]), v[node]);
    Vec3 acceleration = vec3(water[3][node], water[4][node], water[5][node]);
    Vec3 force = vec3_scale(q, tension[node < inner ? node : inner]);
    force = vec3_add(force, line_drag(c, wet, q, relative));
    force = vec3_add(force, line_water_inertia(c, wet, q, acceleration));
    force.z += c->buoyancy * wet - c->weight;
    return force;
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
static int restless_node(const Line *line)
{
    const LineWork *work = line->workspace;
    const Implicit *im = work->implicit;
    int worst = 0;
    for (int i = 0; i < line->node_count; i++) {
        if (!isfinite(vec3_norm(im->x[i])) || !isfinite(vec3_norm(im->move[i]))) return i;
        if (vec3_norm(im->move[i]) > vec3_norm(im->move[worst])) worst = i;
    }
    return worst;
}

void line_bdf2_forget(Line *line) { *history_of(line).step = 0; }

int line_step_bdf2(Line *line, const LineSpan *span, double *sick_time)
{
    LineWork *work = line->workspace;
    Implicit *im = work->implicit;
    double done = 0, longest = span->duration;
    int last = line->node_count - 1;
    while (done < span->duration) {
        double left = span->duration - done, before = *history_of(line).step;
        double h = before > 0 ? mind(longest, GROWTH_MAX * before) : longest;
        h = left / ceil(left / h - 1e-9);
        line_water_at(work, done / span->duration);
        Vec3 anchor = end_load(work, line->position, line->velocity, line->tension, 0, 1);
        Vec3 fairlead =
            end_load(work, line->position, line->velocity, line->tension, last, last - 1);
        if (!implicit_step(line, span, done, h)) {
            longest = 0.5 * h;
            if (longest > SPLIT_FINEST * span->duration) continue;
            *sick_time = span->time + done;
            return restless_node(line);
        }
        accept(line, h);
        anchor = vec3_add(anchor, end_load(work, im->x, im->v, im->tension, 0, 1));
        fairlead = vec3_add(fairlead, end_load(work, im->x, im->v, im->tension, last, last - 1));
        work->end_force[0] = vec3_mad(work->end_force[0], anchor, 0.5 * h);
        work->end_force[1] = vec3_mad(work->end_force[1], fairlead, 0.5 * h);
        done = left - h < 1e-12 * span->duration ? span->duration : done + h;
        longest = mind(span->duration, GROWTH_MAX * h);
    }
    return -1;
}
