/// Equilibrium of lumped lines at rest, so that runs start without a transient. Tension-only
/// springs, weight, bed and buoyancy have a convex energy: Newton's method with a step length
/// chosen on the work along the step converges from the catenary, slack and heaped lines included,
/// and for lines joined at free points from a poor guess. (Bending is not convex, but its part of
/// the matrix is kept so.)
#include "mooring_internal.h"

enum { RELAX_ITERATIONS = 400, SOFT_ITERATIONS = 60, LINE_SEARCH_STEPS = 40 };
/// Out-of-balance force that is small enough, in weights of a segment.
static const double RELAX_GOAL = 1e-9;
/// …and the largest that is acceptable when the iteration stalls on slack pieces.
static const double RELAX_ACCEPT = 0.02;
/// Joined lines begin with this EA, in weights of all of them, and go on to the next stiffness when
/// they are at rest to this share of a segment's weight.
static const double SOFTEST = 3, SOFT_GOAL = 0.01;

/// A line on its way to rest. Nodes first..end-1 may move.
typedef struct Moving {
    RelaxLine line;
    int last, first, end;
    Vec3 *trial; ///< nodes tried along a step [last + 1]
    Vec3 *force; ///< out of balance [last + 1][N]
    Chain chain; ///< its x is the Newton step
} Moving;

typedef struct Relaxation {
    int line_count;
    Moving *lines;
    Chain **chains;
    RelaxPoint *points;
    Vec3 *force; ///< on the points, lines included [block.count][N]
    PointBlock block;
    double level;
    double stiffest; ///< no segment is stiffer now: EA [N]
} Relaxation;

static void bend_rest(Moving *m, const Vec3 *nodes)
{
    for (int i = 1; i < m->last; i++) {
        Vec3 force[3];
        m->chain.bends[i] = makeup_bend(m->line.makeup, i, vec3_sub(nodes[i], nodes[i - 1]),
                                        vec3_sub(nodes[i + 1], nodes[i]));
        bend_forces(&m->chain.bends[i], force);
        for (int k = 0; k < 3; k++)
            m->force[i - 1 + k] = vec3_add(m->force[i - 1 + k], force[k]);
    }
}

/// Forces on a line's nodes at rest; held ends get theirs without the bed. With `stiff`, also the
/// blocks.
static void line_forces(Moving *m, const Vec3 *nodes, double level, double stiffest, bool stiff)
{
    for (int i = 0; i <= m->last; i++) {
        const LineConstants *c = m->line.makeup->node[i];
        bool moves = i >= m->first && i < m->end;
        double bed = moves ? line_bed_force(c, 1, nodes[i].z, 0) : 0;
        m->force[i] = vec3(0, 0, bed - c->weight);
        if (!stiff) continue;
        Sym3 zero = {0, 0, 0, 0, 0, 0};
        m->chain.diagonal[i] = zero;
        m->chain.diagonal[i].zz = bed > 0 ? c->bed_stiffness : 0;
    }
    for (int i = 0; i < m->last; i++) {
        const LineConstants *c = m->line.makeup->segment[i];
        Vec3 d = vec3_sub(nodes[i + 1], nodes[i]);
        double s = vec3_norm(d);
        Vec3 q = s > 0 ? vec3_scale(d, 1 / s) : vec3(0, 0, 0);
        double stiffness = mind(c->stiffness, stiffest / c->length);
        double tension = stiffness * maxd(s - c->length, 0);
        double wet = line_wet_fraction(level - nodes[i].z, level - nodes[i + 1].z, c->radius);
        m->force[i] = vec3_mad(m->force[i], q, tension);
        m->force[i + 1] = vec3_mad(m->force[i + 1], q, -tension);
        m->force[i].z += 0.5 * wet * c->buoyancy;
        m->force[i + 1].z += 0.5 * wet * c->buoyancy;
        if (!stiff) continue;
        Coupling *link = &m->chain.links[i];
        link->along = tension > 0 ? stiffness : 0;
        link->across = tension > 0 ? tension / s : 0;
        link->q = q;
        double piercing = wet > 0 && wet < 1 ? c->buoyancy / (fabs(d.z) + 2 * c->radius) : 0;
        for (int k = i; k <= i + 1; k++) {
            sym3_add(&m->chain.diagonal[k], link->across, link->along - link->across, q);
            m->chain.diagonal[k].zz += 0.5 * piercing;
        }
    }
    if (m->chain.bends) bend_rest(m, nodes);
}

/// The same for a free point at `position`, without its lines. @return vertical stiffness [N/m]
static double point_rest(const LineConstants *c, Vec3 position, double level, Vec3 *force)
{
    double depth = level - position.z, wet = line_wet_fraction(depth, depth, c->radius);
    double bed = line_bed_force(c, 1, position.z, 0);
    *force = vec3(0, 0, c->buoyancy * wet + bed - c->weight);
    return (bed > 0 ? c->bed_stiffness : 0) +
           (wet > 0 && wet < 1 ? c->buoyancy / (2 * c->radius) : 0);
}

static void relax_forces(Relaxation *r, double alpha, bool stiff)
{
    for (int p = 0; p < r->block.count; p++) {
        Vec3 at = vec3_mad(r->points[p].position, r->block.x[p], alpha);
        double slope = point_rest(&r->points[p].constants, at, r->level, &r->force[p]);
        Sym3 block = {0, 0, slope, 0, 0, 0};
        if (stiff) r->block.diagonal[p] = block;
    }
    for (int l = 0; l < r->line_count; l++) {
        Moving *m = &r->lines[l];
        for (int i = 0; i <= m->last; i++)
            m->trial[i] = vec3_mad(m->line.nodes[i], m->chain.x[i], alpha);
        line_forces(m, m->trial, r->level, r->stiffest, stiff);
        for (int side = 0; side < 2; side++)
            if (m->line.point[side] >= 0) {
                Vec3 *sum = &r->force[m->line.point[side]];
                *sum = vec3_add(*sum, m->force[side ? m->last : 0]);
            }
    }
}

static double relax_residual(const Relaxation *r)
{
    double worst = 0;
    for (int l = 0; l < r->line_count; l++)
        for (int i = 1; i < r->lines[l].last; i++) {
            double f = vec3_norm(r->lines[l].force[i]);
            worst = f > worst || !(f == f) ? f : worst;
        }
    for (int p = 0; p < r->block.count; p++) {
        double f = vec3_norm(r->force[p]);
        worst = f > worst || !(f == f) ? f : worst;
    }
    return worst;
}

/// Work of the out-of-balance forces along the step [J per unit of it]; those of `alpha` = 0 when
/// they are fresh.
static double relax_work(const Relaxation *r)
{
    double work = 0;
    for (int l = 0; l < r->line_count; l++)
        for (int i = 1; i < r->lines[l].last; i++)
            work += vec3_dot(r->lines[l].force[i], r->lines[l].chain.x[i]);
    for (int p = 0; p < r->block.count; p++)
        work += vec3_dot(r->force[p], r->block.x[p]);
    return work;
}

static double work_at(Relaxation *r, double alpha)
{
    relax_forces(r, alpha, false);
    return relax_work(r);
}

/// Newton step from where the lines are (blocks and forces are of there), capped at `longest`.
/// @return work along it at its start
static double relax_direction(Relaxation *r, double softening, double longest)
{
    double largest = 0;
    for (int l = 0; l < r->line_count; l++) {
        Moving *m = &r->lines[l];
        for (int i = 1; i < m->last; i++) {
            sym3_add(&m->chain.diagonal[i], softening, 0, vec3(0, 0, 0));
            m->chain.x[i] = m->force[i];
        }
        m->chain.x[0] = m->chain.x[m->last] = vec3(0, 0, 0);
    }
    for (int p = 0; p < r->block.count; p++) {
        sym3_add(&r->block.diagonal[p], softening, 0, vec3(0, 0, 0));
        r->block.x[p] = r->force[p];
    }
    chains_solve(r->chains, r->line_count, &r->block);
    for (int l = 0; l < r->line_count; l++)
        for (int i = 0; i <= r->lines[l].last; i++)
            largest = maxd(largest, vec3_norm(r->lines[l].chain.x[i]));
    double scale = largest > longest ? longest / largest : 1;
    for (int l = 0; l < r->line_count; l++)
        for (int i = 0; i <= r->lines[l].last; i++)
            r->lines[l].chain.x[i] = vec3_scale(r->lines[l].chain.x[i], scale);
    for (int p = 0; p < r->block.count; p++)
        r->block.x[p] = vec3_scale(r->block.x[p], scale);
    return relax_work(r);
}

/// Step length at which the work along the step has fallen well below its start (it only falls).
static double relax_length(Relaxation *r, double start)
{
    double low = 0, high = 1, low_work = start, high_work = work_at(r, 1);
    if (high_work >= -0.5 * start) return 1;
    for (int k = 0; k < LINE_SEARCH_STEPS; k++) {
        double alpha = low + (high - low) * mind(maxd(low_work / (low_work - high_work), 0.1), 0.9);
        double work = work_at(r, alpha);
        if (fabs(work) <= 0.5 * start) return alpha;
        if (work > 0)
            low = alpha, low_work = work;
        else
            high = alpha, high_work = work;
    }
    return low > 0 ? low : high;
}

static bool relax_take(Relaxation *r, const RelaxLine *lines, int count, int point_count,
                       Arena *arena, const char *where, Error *error)
{
    TRY(r->lines = arena_take(arena, (size_t)count, sizeof(Moving), where, error));
    TRY(r->chains = arena_take(arena, (size_t)count, sizeof(Chain *), where, error));
    TRY(r->force = arena_take(arena, (size_t)point_count + 1, sizeof(Vec3), where, error));
    TRY(point_block_create(&r->block, point_count, arena, where, error));
    r->line_count = count;
    for (int l = 0; l < count; l++) {
        Moving *m = &r->lines[l];
        size_t n = (size_t)lines[l].makeup->segments + 1;
        m->line = lines[l];
        m->last = lines[l].makeup->segments;
        m->first = lines[l].point[0] >= 0 ? 0 : 1;
        m->end = m->last + (lines[l].point[1] >= 0 ? 1 : 0);
        TRY(m->trial = arena_take(arena, n, sizeof(Vec3), where, error));
        TRY(m->force = arena_take(arena, n, sizeof(Vec3), where, error));
        // bending or not, the banded solver: block pivots fail where only springs hold a node
        TRY(chain_create(&m->chain, m->last, lines[l].point, true, arena, where, error));
        r->chains[l] = &m->chain;
    }
    return true;
}

/// What the lumped line says where no closed form holds.
static void relax_statics(const Moving *m, LineStatics *statics)
{
    Vec3 anchor = m->force[0], fairlead = m->force[m->last];
    statics->anchor_tension = vec3_norm(anchor);
    statics->fairlead_tension = vec3_norm(fairlead);
    statics->horizontal_force = hypot(fairlead.x, fairlead.y);
    statics->touchdown = statics->stretched_length = 0;
    for (int i = 0; i < m->last; i++) {
        const LineConstants *c = m->line.makeup->segment[i];
        double s = vec3_norm(vec3_sub(m->line.nodes[i + 1], m->line.nodes[i]));
        statics->stretched_length += maxd(s, c->length);
        if (m->line.nodes[i].z <= c->bed && m->line.nodes[i + 1].z <= c->bed)
            statics->touchdown += c->length;
    }
}

static void relax_move(Relaxation *r, double alpha)
{
    for (int l = 0; l < r->line_count; l++)
        for (int i = 0; i <= r->lines[l].last; i++) {
            Vec3 *node = &r->lines[l].line.nodes[i];
            *node = vec3_mad(*node, r->lines[l].chain.x[i], alpha);
        }
    for (int p = 0; p < r->block.count; p++)
        r->points[p].position = vec3_mad(r->points[p].position, r->block.x[p], alpha);
}

/// Weight of a segment, stiffness, length and extent of the lines: what to measure against.
typedef struct RelaxScale {
    double weight, load, stiffness, length, whole, extent;
} RelaxScale;

static RelaxScale relax_scale(const Relaxation *r)
{
    RelaxScale scale = {0, 0, 0, 0, 0, 0};
    for (int l = 0; l < r->line_count; l++) {
        const Moving *m = &r->lines[l];
        for (int i = 0; i < m->last; i++) {
            const LineConstants *c = m->line.makeup->segment[i];
            scale.weight =
                maxd(scale.weight, maxd(c->weight, c->buoyancy) + 1e-12 * c->stiffness * c->length);
            scale.load += fabs(c->weight - c->buoyancy) + c->bending / (c->length * c->length);
            scale.stiffness = maxd(scale.stiffness, c->stiffness);
            scale.length = maxd(scale.length, c->length);
        }
        for (int i = 0; i <= m->last; i++)
            scale.extent = maxd(scale.extent, vec3_norm(m->line.nodes[i]));
        scale.whole = maxd(scale.whole, makeup_arc(m->line.makeup, m->last));
    }
    for (int p = 0; p < r->block.count; p++)
        scale.load += maxd(r->points[p].constants.weight, r->points[p].constants.buoyancy);
    return scale;
}

/// The iteration down to a residual of `goal` [N]; forces are those of the nodes at return.
/// @return largest force out of balance [N]
static double relax_iterate(Relaxation *r, const RelaxScale *scale, double goal, int most)
{
    double residual = INFINITY;
    for (int k = 0; k < most; k++) {
        relax_forces(r, 0, true);
        residual = relax_residual(r);
        if (!(residual > goal)) break;
        // slack pieces have no stiffness: a softening that fades with the residual holds them
        double softening = 1e-2 * mind(1, residual / scale->weight) + 1e-9;
        double work =
            relax_direction(r, softening * scale->weight / scale->length, 0.5 * scale->whole);
        relax_move(r, relax_length(r, work));
    }
    return residual;
}

/// Lines that are joined or bend may start far from rest, where stiff ones keep Newton's steps
/// short: they start as soft as rubber and are stiffened tenfold at a time.
static double relax_all(Relaxation *r)
{
    RelaxScale scale = relax_scale(r);
    double goal = RELAX_GOAL * scale.weight + 8e-16 * scale.stiffness * scale.extent; // rounding
    double axial = scale.stiffness * scale.length;
    bool bends = false;
    for (int l = 0; l < r->line_count; l++)
        bends = bends || r->lines[l].line.makeup->bends;
    if (r->block.count > 0 || bends)
        for (r->stiffest = SOFTEST * scale.load; r->stiffest < axial; r->stiffest *= 10)
            relax_iterate(r, &scale, SOFT_GOAL * scale.weight, SOFT_ITERATIONS);
    r->stiffest = INFINITY;
    return relax_iterate(r, &scale, goal, RELAX_ITERATIONS) / scale.weight;
}

bool lines_relax(RelaxLine *lines, int line_count, RelaxPoint *points, int point_count,
                 double level, const char *where, Error *error)
{
    Relaxation r;
    Arena arena = arena_create(0);
    r.level = level;
    r.points = points;
    if (!relax_take(&r, lines, line_count, point_count, &arena, where, error)) {
        arena_destroy(&arena);
        return false;
    }
    double residual = relax_all(&r);
    for (int l = 0; l < line_count; l++)
        if (lines[l].statics) relax_statics(&r.lines[l], lines[l].statics);
    arena_destroy(&arena);
    if (residual <= RELAX_ACCEPT) return true;
    return error_set(error, ERROR_INPUT,
                     "%s: the lumped line finds no equilibrium: %.3g segment weights are out of "
                     "balance; accepted: at most %g",
                     where, residual, RELAX_ACCEPT);
}
