/// Newton's method on one implicit step: directions of the segments are fixed in turn, and what is
/// left is monotone. See mooring_bdf2.c.
#include "base/clones.h"
#include "mooring_implicit.h"

enum { OUTER_MAX = 12, INNER_MAX = 25, SEARCH_MAX = 12 };
/// Error of the tension allowed for geometry, as a share of tension + segment weight.
static const double GEOMETRY_GOAL = 1e-4;
/// The same for a change of tension within an iteration, which turns with the segment.
static const double TURNING_GOAL = 1e-4;
/// Piecewise-linear tensions are met to this share, bed forces to the next.
static const double TENSION_GOAL = 1e-6, BED_GOAL = 1e-3;

static Implicit *implicit_of(const Line *line) { return ((LineWork *)line->workspace)->implicit; }

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

/// What a node feels at the iterate: a line's node, or a point.
typedef struct Iterate {
    Vec3 x, v, acceleration_known, q;
    double wet, slope; ///< submerged share; change of velocity with place [1/s]
    Vec3 stream, water_acceleration;
    bool water_moves; ///< false: no acceleration
} Iterate;

/// Everything about a node but tension and bed: force less inertia, and how it falls with place.
FN Vec3 linearise(const LineConstants *c, const Iterate *at, Contact *contact, Sym3 *linear)
{
    Vec3 v = at->v, q = at->q;
    double wet = at->wet, slope = at->slope;
    Vec3 relative = vec3_sub(at->stream, v);
    double normal = line_mass_normal(c, 1, wet), tangential = line_mass_tangential(c, 1, wet);
    Vec3 a = vec3_mad(at->acceleration_known, v, slope);
    Vec3 force = vec3_sub(line_drag(c, wet, q, relative), line_inertia(normal, tangential, q, a));
    if (at->water_moves)
        force = vec3_add(force, line_water_inertia(c, wet, q, at->water_acceleration));
    force.z += c->buoyancy * wet - c->weight;

    contact->z = at->x.z;
    contact->rate = v.z;
    contact->force = contact->slope = 0;
    double rub = 0;
    if (contact->z < c->bed) {
        contact->force = line_bed_force(contact->c, 1, contact->z, contact->rate);
        contact->slope = line_bed_slope(contact->c, 1, contact->z, contact->rate, slope);
        rub = line_bed_friction(contact->c, contact->force, sqrt(v.x * v.x + v.y * v.y));
        force.x -= rub * v.x;
        force.y -= rub * v.y;
    }

    // M alpha^2/h^2 plus the drag's slopes: |u_n| across, |u_n| + u_n^2/|u_n| along u_n, 2 |u_t|
    // along q
    double along = vec3_dot(relative, q);
    Vec3 u_n = vec3_mad(relative, q, -along);
    double speed = vec3_norm(u_n);
    double across_drag = slope * wet * c->drag_normal * speed;
    double along_drag = slope * wet * 2 * c->drag_tangential * fabs(along);
    double across = normal * slope * slope + across_drag;
    double along_q = tangential * slope * slope + along_drag;
    Sym3 sum = {slope * rub, slope * rub, 0, 0, 0, 0};
    sym3_add(&sum, across, along_q - across, q);
    if (speed > 0) sym3_add(&sum, 0, across_drag / (speed * speed), u_n);
    *linear = sum;
    return force;
}

/// A node between unequal segments, next to a parted one or at a free end.
static void linearise_special(const LineWork *work, Implicit *im, int i, Iterate *at)
{
    SpecialNode special = line_special_node(work, im->x, i);
    at->q = special.q;
    at->wet = 1;
    im->force[i] = linearise(&special.sum, at, &im->contacts[i], &im->linear[i]);
}

static void linearise_nodes(const LineWork *work, Implicit *im)
{
    const LineMakeup *makeup = &work->makeup;
    double *const *water = work->water_now;
    Iterate at;
    at.slope = im->rate_slope;
    at.water_moves = work->water_moves;
    at.water_acceleration = vec3(0, 0, 0);
    for (int i = im->first; i < im->end; i++) {
        const LineConstants *c = makeup->node[i];
        at.x = im->x[i];
        at.v = im->v[i];
        at.acceleration_known = im->acceleration_known[i];
        at.stream = vec3(water[0][i], water[1][i], water[2][i]);
        if (work->water_moves) at.water_acceleration = vec3(water[3][i], water[4][i], water[5][i]);
        im->contacts[i].c = c;
        im->move[i] = vec3(0, 0, 0);
        if (c == &makeup->blends[i]) {
            linearise_special(work, im, i, &at);
            continue;
        }
        Vec3 q = vec3_sub(im->x[i + 1], im->x[i - 1]);
        double size = vec3_norm(q);
        at.q = vec3_scale(q, size > 1e-12 * c->length ? 1 / size : 0);
        at.wet = 0.5 * (im->segments[i - 1].wet + im->segments[i].wet);
        im->force[i] = linearise(c, &at, &im->contacts[i], &im->linear[i]);
    }
    if (!im->chain.bends) return;
    for (int i = 1; i + 1 < work->node_count; i++) {
        Bend *bend = &im->chain.bends[i];
        *bend = makeup_bend(makeup, i, vec3_sub(im->x[i], im->x[i - 1]),
                            vec3_sub(im->x[i + 1], im->x[i]));
        bend->growth = 1 + bend->time * im->rate_slope;
    }
}

/// A free point: the place is that of its lines' ends.
static void linearise_point(MooringPoint *point)
{
    PointWork *own = point->workspace;
    const LineWork *work = own->lines[0]->workspace;
    const Implicit *im = work->implicit;
    const LineConstants *c = &own->constants;
    int i = own->sides[0] ? work->node_count - 1 : 0;
    double *const *water = work->water_now;
    double depth = water[6][i] - im->x[i].z;
    Iterate at = {im->x[i],
                  im->v[i],
                  im->acceleration_known[i],
                  {0, 0, 0},
                  line_wet_fraction(depth, depth, c->radius),
                  im->rate_slope,
                  {water[0][i], water[1][i], water[2][i]},
                  {water[3][i], water[4][i], water[5][i]},
                  work->water_moves};
    own->contact.c = c;
    own->force = linearise(c, &at, &own->contact, &own->linear);
    if (fabs(depth) < c->radius) own->linear.zz += c->buoyancy / (2 * c->radius);
    own->move = vec3(0, 0, 0);
}

/// Pull of a segment on its lower node after the moves so far; its link in the system.
FN Vec3 assemble_segment(Implicit *im, int i, bool moved)
{
    const Segment *segment = &im->segments[i];
    Coupling *link = &im->chain.links[i];
    Vec3 pull = vec3_scale(segment->q, segment->tension);
    link->along = segment->slope;
    link->across = segment->across;
    link->q = segment->q;
    if (!moved) return pull;
    Vec3 turned = vec3_sub(im->move[i + 1], im->move[i]);
    turned = vec3_mad(turned, segment->q, -segment->u);
    return vec3_mad(pull, turned, segment->across);
}

/// A node's own part of the system, with the pulls `f` of its segments and their blocks.
FN void assemble_node(Implicit *im, int i, bool moved, Vec3 f, const Segment *below,
                      const Segment *above)
{
    Sym3 block = im->linear[i];
    f = vec3_add(im->force[i], f);
    if (moved) f = vec3_sub(f, sym3_apply(&block, im->move[i]));
    f.z += im->contacts[i].force;
    im->residual[i] = f;
    im->chain.x[i] = f;
    block.zz += im->contacts[i].slope;
    if (above) sym3_add(&block, above->across, above->slope - above->across, above->q);
    if (below) sym3_add(&block, below->across, below->slope - below->across, below->q);
    im->chain.diagonal[i] = block;
}

/// Out-of-balance forces and blocks of the linearised problem at the move so far.
FN void assemble(Implicit *im, bool moved)
{
    int last = im->chain.last;
    const Segment *segments = im->segments;
    im->chain.x[0] = im->chain.x[last] = vec3(0, 0, 0);
    Vec3 below = assemble_segment(im, 0, moved); // pull on the lower node, taken from the upper one
    if (im->first == 0) assemble_node(im, 0, moved, below, NULL, &segments[0]);
    for (int i = 1; i < last; i++) {
        Vec3 pull = assemble_segment(im, i, moved);
        assemble_node(im, i, moved, vec3_sub(pull, below), &segments[i - 1], &segments[i]);
        below = pull;
    }
    if (im->end > last)
        assemble_node(im, last, moved, vec3_scale(below, -1), &segments[last - 1], NULL);
}

/// Shear of a line that bends, on top of the rest.
static void assemble_bending(Implicit *im)
{
    Chain *chain = &im->chain;
    for (int i = 1; i < chain->last; i++) {
        Vec3 force[3], change[3], damping[3];
        if (chain->bends[i].stiffness == 0) continue;
        bend_forces(&chain->bends[i], force);
        bend_change(&chain->bends[i], &im->move[i - 1], change);
        Bend damper = chain->bends[i];
        damper.growth = damper.time;
        bend_change(&damper, &im->v[i - 1], damping);
        for (int k = 0; k < 3; k++) {
            int node = i - 1 + k;
            if (node < im->first || node >= im->end) continue;
            Vec3 f = vec3_add(vec3_add(force[k], change[k]), damping[k]);
            im->residual[node] = vec3_add(im->residual[node], f);
            chain->x[node] = im->residual[node];
        }
    }
}

static void assemble_point(MooringPoint *point, Sym3 *diagonal, Vec3 *x)
{
    PointWork *own = point->workspace;
    Vec3 f = vec3_sub(own->force, sym3_apply(&own->linear, own->move));
    f.z += own->contact.force;
    *x = own->residual = f;
    *diagonal = own->linear;
    diagonal->zz += own->contact.slope;
}

/// Tension of a segment and force of the bed under a node after a share `t` of the Newton step.
static double tension_at(const Segment *s, double rate_slope, double t)
{
    double longer = s->u + t * s->du;
    return line_tension(s->c, s->s + longer, s->rate + rate_slope * longer);
}

static double bed_at(const Contact *contact, double rate_slope, double rise)
{
    return line_bed_force(contact->c, 1, contact->z + rise, contact->rate + rate_slope * rise);
}

static bool bed_holds(const Contact *contact, double rate_slope, double moved, double step)
{
    if (contact->z + moved + mind(step, 0) > contact->c->bed) return true;
    double exact = bed_at(contact, rate_slope, moved + step);
    double linear = contact->force - contact->slope * step;
    return fabs(exact - linear) <= BED_GOAL * (exact + contact->c->weight);
}

/// Whether the straight-line formulas held over the whole Newton step, that is: it is solved. Sets
/// du and what the segments carry then. @return 1 yes, 0 no, -1 not a number
static int step_holds(Implicit *im)
{
    const Vec3 *step = im->chain.x;
    bool holds = true;
    double sum = 0;
    for (int i = 0; i < im->chain.last; i++) {
        Segment *s = &im->segments[i];
        s->du = vec3_dot(s->q, vec3_sub(step[i + 1], step[i]));
        s->reached = tension_at(s, im->rate_slope, 1);
        double linear = s->tension + s->slope * s->du;
        holds = holds && fabs(s->reached - linear) <= TENSION_GOAL * (s->reached + s->c->weight);
        sum += s->du;
    }
    for (int i = im->first; i < im->end; i++)
        holds = holds && bed_holds(&im->contacts[i], im->rate_slope, im->move[i].z, step[i].z);
    return !isfinite(sum) ? -1 : holds;
}

/// Work along a Newton step: `start` at its begin, falling by `stiff` over it where it is linear.
typedef struct StepWork {
    double start, stiff;
} StepWork;

static StepWork step_work(const LineNet *net)
{
    double start = 0, bends = 0; // step . residual, and the part of it that is not linear
    for (int l = 0; l < net->line_count; l++) {
        const Implicit *im = implicit_of(net->lines[l]);
        const Vec3 *step = im->chain.x;
        for (int i = im->first; i < im->end; i++)
            start += vec3_dot(im->residual[i], step[i]);
        for (int i = 0; i < im->chain.last; i++)
            bends += im->segments[i].slope * im->segments[i].du * im->segments[i].du;
        for (int i = im->first; i < im->end; i++)
            bends += im->contacts[i].slope * step[i].z * step[i].z;
    }
    for (int p = 0; p < net->block.count; p++) {
        const PointWork *own = net->points[p]->workspace;
        start += vec3_dot(own->residual, net->block.x[p]);
        bends += own->contact.slope * net->block.x[p].z * net->block.x[p].z;
    }
    StepWork work = {start, start - bends};
    return work;
}

/// Work of what is not linear after a share `t` of the step, beyond that at its begin.
static double curved_work(const LineNet *net, double t)
{
    double work = 0;
    for (int l = 0; l < net->line_count; l++) {
        const Implicit *im = implicit_of(net->lines[l]);
        const Vec3 *step = im->chain.x;
        for (int i = 0; i < im->chain.last; i++) {
            const Segment *s = &im->segments[i];
            if (s->du != 0) work -= (tension_at(s, im->rate_slope, t) - s->tension) * s->du;
        }
        for (int i = im->first; i < im->end; i++) {
            const Contact *contact = &im->contacts[i];
            if (contact->force > 0 || step[i].z < 0)
                work += (bed_at(contact, im->rate_slope, im->move[i].z + t * step[i].z) -
                         contact->force) *
                        step[i].z;
        }
    }
    for (int p = 0; p < net->block.count; p++) {
        const PointWork *own = net->points[p]->workspace;
        double slope = implicit_of(own->lines[0])->rate_slope, step = net->block.x[p].z;
        work += (bed_at(&own->contact, slope, own->move.z + t * step) - own->contact.force) * step;
    }
    return work;
}

/// Share of the Newton step at which the work along it vanishes: it falls along the step, by
/// pieces.
static double search_length(const LineNet *net)
{
    StepWork work = step_work(net);
    double low = 0, at_low = work.start, high = 1, at_high = 0, t = 1;
    int side = 0;
    for (int k = 0; k < SEARCH_MAX; k++) {
        double done = work.start - t * work.stiff + curved_work(net, t);
        if (fabs(done) <= 0.1 * work.start) return t;
        if (done > 0) { // false position, where a side that stays counts half (Illinois)
            if (side > 0) at_high *= 0.5;
            side = 1;
            low = t;
            at_low = done;
        } else {
            if (side < 0) at_low *= 0.5;
            side = -1;
            high = t;
            at_high = done;
        }
        if (low == 1) return 1;
        t = low + (high - low) * at_low / (at_low - at_high);
    }
    return t;
}

static void bed_moves(Contact *contact, double rate_slope, double moved)
{
    double z = contact->z + moved, rate = contact->rate + rate_slope * moved;
    contact->force = line_bed_force(contact->c, 1, z, rate);
    contact->slope = line_bed_slope(contact->c, 1, z, rate, rate_slope);
}

/// Go a share `t` of the Newton step and see what segments and bed do there.
static void go_along(Implicit *im, double t)
{
    for (int i = 0; i < im->chain.last; i++) {
        Segment *s = &im->segments[i];
        s->tension = t == 1 ? s->reached : tension_at(s, im->rate_slope, t);
        s->u += t * s->du;
        s->slope =
            line_tension_slope(s->c, s->s + s->u, s->rate + im->rate_slope * s->u, im->rate_slope);
    }
    for (int i = im->first; i < im->end; i++) {
        im->move[i] = vec3_mad(im->move[i], im->chain.x[i], t);
        bed_moves(&im->contacts[i], im->rate_slope, im->move[i].z);
    }
}

static void point_goes_along(MooringPoint *point, Vec3 step, double t)
{
    PointWork *own = point->workspace;
    own->move = vec3_mad(own->move, step, t);
    bed_moves(&own->contact, implicit_of(own->lines[0])->rate_slope, own->move.z);
}

/// The whole Newton step was right: take it.
static void finish(Implicit *im)
{
    for (int i = 0; i < im->chain.last; i++) {
        im->segments[i].tension = im->segments[i].reached;
        im->segments[i].u += im->segments[i].du;
    }
    for (int i = im->first; i < im->end; i++)
        im->move[i] = vec3_add(im->move[i], im->chain.x[i]);
}

static void newton_step(LineNet *net, bool moved)
{
    for (int l = 0; l < net->line_count; l++) {
        Implicit *im = implicit_of(net->lines[l]);
        if (moved)
            assemble(im, true);
        else
            assemble(im, false);
        if (im->chain.bends) assemble_bending(im);
    }
    for (int p = 0; p < net->block.count; p++)
        assemble_point(net->points[p], &net->block.diagonal[p], &net->block.x[p]);
    chains_solve(net->chains, net->line_count, &net->block);
}

/// Solve the problem of fixed directions. @return false when Newton does not settle
static bool solve_directions(LineNet *net)
{
    for (int k = 0; k < INNER_MAX; k++) {
        newton_step(net, k > 0);
        int holds = 1;
        for (int l = 0; l < net->line_count; l++) {
            int one = step_holds(implicit_of(net->lines[l]));
            if (one < 0) return false;
            holds = holds && one;
        }
        for (int p = 0; p < net->block.count; p++) {
            const PointWork *own = net->points[p]->workspace;
            double slope = implicit_of(own->lines[0])->rate_slope;
            holds = holds && bed_holds(&own->contact, slope, own->move.z, net->block.x[p].z);
        }
        if (holds) {
            for (int l = 0; l < net->line_count; l++)
                finish(implicit_of(net->lines[l]));
            return true;
        }
        double t = search_length(net);
        for (int l = 0; l < net->line_count; l++)
            go_along(implicit_of(net->lines[l]), t);
        for (int p = 0; p < net->block.count; p++)
            point_goes_along(net->points[p], net->block.x[p], t);
    }
    return false;
}

/// Take the move. @return 1 when the directions were right enough, 0 when not, -1: not a number
static int take_move(Implicit *im)
{
    bool right = true;
    double sum = 0;
    for (int i = 0; i < im->chain.last; i++) {
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
    for (int i = im->first; i < im->end; i++) {
        im->x[i] = vec3_add(im->x[i], im->move[i]);
        im->v[i] = vec3_mad(im->velocity_known[i], im->x[i], im->rate_slope);
    }
    return !isfinite(sum) ? -1 : right;
}

/// With all that it calls in this file compiled for fused multiply-add, too.
CLONES("arch=x86-64-v3", "default")
__attribute__((flatten)) bool implicit_solve(LineNet *net)
{
    for (int k = 0; k < OUTER_MAX; k++) {
        for (int l = 0; l < net->line_count; l++) {
            const LineWork *work = net->lines[l]->workspace;
            linearise_segments(work, work->implicit);
            linearise_nodes(work, work->implicit);
        }
        for (int p = 0; p < net->block.count; p++)
            linearise_point(net->points[p]);
        if (!solve_directions(net)) return false;
        int right = 1;
        for (int l = 0; l < net->line_count; l++) {
            int one = take_move(implicit_of(net->lines[l]));
            if (one < 0) return false;
            right = right && one;
        }
        if (right) return true;
    }
    return false;
}
