/// Equilibrium of the lumped line at rest, so that runs start without a transient. Tension-only
/// springs, weight, bed and buoyancy have a convex energy: Newton's method with a step length
/// chosen on the work along the step converges from the catenary, slack and heaped lines included.
#include "mooring_internal.h"

#include "mooring_block.h"

enum { RELAX_ITERATIONS = 400, LINE_SEARCH_STEPS = 40 };
/// Out-of-balance force that is small enough, in weights of a segment.
static const double RELAX_GOAL = 1e-9;
/// …and the largest that is acceptable when the iteration stalls on slack pieces.
static const double RELAX_ACCEPT = 0.02;

typedef struct Relaxation {
    LineMakeup makeup;
    double level;
    int last;        ///< index of the fairlead node
    Vec3 *trial;     ///< nodes tried along a step [last + 1]
    Vec3 *force;     ///< out of balance [last + 1][N]
    Vec3 *move;      ///< Newton step [last + 1][m]
    Sym3 *diagonal;  ///< [last + 1]
    Coupling *links; ///< [last]
} Relaxation;

/// Forces on the nodes at rest; the ends get theirs without the bed. With `stiff`, also the blocks.
static void relax_forces(Relaxation *r, const Vec3 *nodes, bool stiff)
{
    for (int i = 0; i <= r->last; i++) {
        const LineConstants *c = r->makeup.node[i];
        bool end = i == 0 || i == r->last;
        double bed = end ? 0 : line_bed_force(c, 1, nodes[i].z, 0);
        r->force[i] = vec3(0, 0, bed - c->weight);
        if (!stiff) continue;
        Sym3 zero = {0, 0, 0, 0, 0, 0};
        r->diagonal[i] = zero;
        r->diagonal[i].zz = bed > 0 ? c->bed_stiffness : 0;
    }
    for (int i = 0; i < r->last; i++) {
        const LineConstants *c = r->makeup.segment[i];
        Vec3 d = vec3_sub(nodes[i + 1], nodes[i]);
        double s = vec3_norm(d);
        Vec3 q = s > 0 ? vec3_scale(d, 1 / s) : vec3(0, 0, 0);
        double tension = line_tension(c, s, 0);
        double wet = line_wet_fraction(r->level - nodes[i].z, r->level - nodes[i + 1].z, c->radius);
        r->force[i] = vec3_mad(r->force[i], q, tension);
        r->force[i + 1] = vec3_mad(r->force[i + 1], q, -tension);
        r->force[i].z += 0.5 * wet * c->buoyancy;
        r->force[i + 1].z += 0.5 * wet * c->buoyancy;
        if (!stiff) continue;
        r->links[i].along = tension > 0 ? c->stiffness : 0;
        r->links[i].across = tension > 0 ? tension / s : 0;
        r->links[i].q = q;
        double piercing = wet > 0 && wet < 1 ? c->buoyancy / (fabs(d.z) + 2 * c->radius) : 0;
        for (int k = i; k <= i + 1; k++) {
            sym3_add(&r->diagonal[k], r->links[i].across, r->links[i].along - r->links[i].across,
                     q);
            r->diagonal[k].zz += 0.5 * piercing;
        }
    }
}

static double relax_residual(const Relaxation *r)
{
    double worst = 0;
    for (int i = 1; i < r->last; i++) {
        double f = vec3_norm(r->force[i]);
        worst = f > worst || !(f == f) ? f : worst;
    }
    return worst;
}

/// Work of the out-of-balance forces along the step when it is taken to `alpha` [J per unit alpha].
static double relax_work(Relaxation *r, const Vec3 *nodes, double alpha)
{
    double work = 0;
    for (int i = 0; i <= r->last; i++)
        r->trial[i] = vec3_mad(nodes[i], r->move[i], i == 0 || i == r->last ? 0 : alpha);
    relax_forces(r, r->trial, false);
    for (int i = 1; i < r->last; i++)
        work += vec3_dot(r->force[i], r->move[i]);
    return work;
}

/// Newton step from `nodes` (blocks and forces are of `nodes`), capped at `longest`.
/// @return work along it at its start
static double relax_direction(Relaxation *r, double softening, double longest)
{
    double work = 0, largest = 0;
    for (int i = 1; i < r->last; i++) {
        sym3_add(&r->diagonal[i], softening, 0, vec3(0, 0, 0));
        r->move[i] = r->force[i];
    }
    block_solve(1, r->last, r->diagonal, r->links, r->move);
    for (int i = 1; i < r->last; i++)
        largest = maxd(largest, vec3_norm(r->move[i]));
    double scale = largest > longest ? longest / largest : 1;
    for (int i = 1; i < r->last; i++) {
        r->move[i] = vec3_scale(r->move[i], scale);
        work += vec3_dot(r->force[i], r->move[i]);
    }
    return work;
}

/// Step length at which the work along the step has fallen well below its start (it only falls).
static double relax_length(Relaxation *r, const Vec3 *nodes, double start)
{
    double low = 0, high = 1, low_work = start, high_work = relax_work(r, nodes, 1);
    if (high_work >= -0.5 * start) return 1;
    for (int k = 0; k < LINE_SEARCH_STEPS; k++) {
        double alpha = low + (high - low) * mind(maxd(low_work / (low_work - high_work), 0.1), 0.9);
        double work = relax_work(r, nodes, alpha);
        if (fabs(work) <= 0.5 * start) return alpha;
        if (work > 0)
            low = alpha, low_work = work;
        else
            high = alpha, high_work = work;
    }
    return low > 0 ? low : high;
}

static bool relax_take(Relaxation *r, int count, Arena *arena, const char *where, Error *error)
{
    size_t n = (size_t)count;
    r->trial = arena_take(arena, n, sizeof(Vec3), where, error);
    r->force = arena_take(arena, n, sizeof(Vec3), where, error);
    r->move = arena_take(arena, n, sizeof(Vec3), where, error);
    r->diagonal = arena_take(arena, n, sizeof(Sym3), where, error);
    r->links = arena_take(arena, n, sizeof(Coupling), where, error);
    return r->trial && r->force && r->move && r->diagonal && r->links;
}

/// What the lumped line says where no closed form holds (it pierces the surface).
static void relax_statics(const Relaxation *r, const Vec3 *nodes, LineStatics *statics)
{
    Vec3 anchor = r->force[0], fairlead = r->force[r->last];
    statics->anchor_tension = vec3_norm(anchor);
    statics->fairlead_tension = vec3_norm(fairlead);
    statics->horizontal_force = hypot(fairlead.x, fairlead.y);
    statics->touchdown = statics->stretched_length = 0;
    for (int i = 0; i < r->last; i++) {
        const LineConstants *c = r->makeup.segment[i];
        double s = vec3_norm(vec3_sub(nodes[i + 1], nodes[i]));
        statics->stretched_length += maxd(s, c->length);
        if (nodes[i].z <= c->bed && nodes[i + 1].z <= c->bed) statics->touchdown += c->length;
    }
}

/// The iteration; `force` is that of `nodes` at return. @return largest force out of balance [N]
static double relax_iterate(Relaxation *r, Vec3 *nodes)
{
    double scale = 0, stiffest = 0, length = 0, extent = 0, residual = INFINITY;
    for (int i = 0; i < r->makeup.run_count; i++) {
        const LineConstants *c = &r->makeup.runs[i].constants;
        scale = maxd(scale, maxd(c->weight, c->buoyancy) + 1e-12 * c->stiffness * c->length);
        stiffest = maxd(stiffest, c->stiffness);
        length = maxd(length, c->length);
    }
    for (int i = 0; i <= r->last; i++)
        extent = maxd(extent, vec3_norm(nodes[i]));
    double goal = RELAX_GOAL * scale + 8e-16 * stiffest * extent; // rounding of positions
    for (int k = 0; k < RELAX_ITERATIONS; k++) {
        relax_forces(r, nodes, true);
        residual = relax_residual(r);
        if (!(residual > goal)) break;
        // slack pieces have no stiffness: a softening that fades with the residual holds them
        double softening = scale / length * mind(1e-2, 1e-2 * residual / scale);
        double work = relax_direction(r, softening + 1e-9 * scale / length, 0.5 * length * r->last);
        double alpha = relax_length(r, nodes, work);
        for (int i = 1; i < r->last; i++)
            nodes[i] = vec3_mad(nodes[i], r->move[i], alpha);
    }
    return residual / scale;
}

bool line_relax(const LineScene *scene, const WaterField *water, const char *where, Vec3 *nodes,
                LineStatics *statics, Error *error)
{
    Relaxation r;
    r.level = water->level;
    r.last = scene->segments;
    Arena arena = arena_create(0);
    if (!relax_take(&r, scene->segments + 1, &arena, where, error) ||
        !makeup_create(scene, water, where, &arena, &r.makeup, error)) {
        arena_destroy(&arena);
        return false;
    }
    r.move[0] = r.move[r.last] = vec3(0, 0, 0);
    double residual = relax_iterate(&r, nodes);
    if (statics) relax_statics(&r, nodes, statics);
    arena_destroy(&arena);
    if (residual <= RELAX_ACCEPT) return true;
    return error_set(error, ERROR_INPUT,
                     "%s: the lumped line finds no equilibrium: %.3g segment weights are out of "
                     "balance; accepted: at most %g",
                     where, residual, RELAX_ACCEPT);
}
