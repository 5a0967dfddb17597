/// Forces on the nodes of a line and the explicit midpoint step. Plain loops over one array per
/// component: this file is compiled so that they vectorise (see CMakeLists.txt).
#include "base/clones.h"
#include "mooring_internal.h"

/// The same loops compiled for wider registers; without contraction all give the same bits.
#define WIDE CLONES("arch=x86-64-v4", "arch=x86-64-v3", "default")

/// Nodes are examined for sickness every so many sub-steps.
enum { SICKNESS_INTERVAL = 16 };

WIDE static void run_segments(LineWork *work, const LineNodes *nodes, const LineRun *run)
{
    const LineConstants c = run->constants;
    const double *restrict x = nodes->x, *restrict y = nodes->y, *restrict z = nodes->z;
    const double *restrict u = nodes->u, *restrict v = nodes->v, *restrict w = nodes->w;
    const double *restrict elevation = work->water_now[6];
    double *restrict dx = work->dx + 1, *restrict dy = work->dy + 1, *restrict dz = work->dz + 1;
    double *restrict px = work->px + 1, *restrict py = work->py + 1, *restrict pz = work->pz + 1;
    double *restrict wet = work->wet + 1, *restrict tension = work->tension + 1;
    double *restrict peak = work->peak + 1;
    int begin = run->begin, end = run->end;
    double tiny = 1e-24 * c.length * c.length; // a segment of no length has no direction
#pragma GCC ivdep
    for (int i = begin; i < end; i++) {
        double ex = x[i + 1] - x[i], ey = y[i + 1] - y[i], ez = z[i + 1] - z[i];
        double s = sqrt(ex * ex + ey * ey + ez * ez + tiny);
        double inverse = 1 / s;
        double rate =
            (ex * (u[i + 1] - u[i]) + ey * (v[i + 1] - v[i]) + ez * (w[i + 1] - w[i])) * inverse;
        double t = line_tension(&c, s, rate);
        double pull = t * inverse;
        dx[i] = ex;
        dy[i] = ey;
        dz[i] = ez;
        px[i] = ex * pull;
        py[i] = ey * pull;
        pz[i] = ez * pull;
        wet[i] = line_wet_fraction(elevation[i] - z[i], elevation[i + 1] - z[i + 1], c.radius);
        tension[i] = t;
        peak[i] = t > peak[i] ? t : peak[i];
    }
}

/// Nodes of a run, those at its ends as if the line went on alike.
WIDE static void run_node_forces(LineWork *work, const LineNodes *nodes, const LineRun *run)
{
    const LineConstants c = run->constants;
    const double *restrict z = nodes->z;
    const double *restrict u = nodes->u, *restrict v = nodes->v, *restrict w = nodes->w;
    const double *restrict dx = work->dx, *restrict dy = work->dy, *restrict dz = work->dz;
    const double *restrict px = work->px, *restrict py = work->py, *restrict pz = work->pz;
    const double *restrict wetness = work->wet;
    const double *restrict share = work->share, *restrict bed_share = work->bed_share;
    const double *restrict wu = work->water_now[0], *restrict wv = work->water_now[1];
    const double *restrict ww = work->water_now[2], *restrict wax = work->water_now[3];
    const double *restrict way = work->water_now[4], *restrict waz = work->water_now[5];
    double *restrict fx = work->fx, *restrict fy = work->fy, *restrict fz = work->fz;
    double *restrict ax = work->ax, *restrict ay = work->ay, *restrict az = work->az;
    double tiny = 1e-24 * c.length * c.length;
    int begin = run->begin, end = run->end;
#pragma GCC ivdep
    for (int i = begin; i <= end; i++) {
        Vec3 q = vec3(dx[i] + dx[i + 1], dy[i] + dy[i + 1], dz[i] + dz[i + 1]);
        q = vec3_scale(q, 1 / sqrt(vec3_dot(q, q) + tiny));
        double wet = 0.5 * (wetness[i] + wetness[i + 1]);
        Vec3 drag = line_drag(&c, wet, q, vec3(wu[i] - u[i], wv[i] - v[i], ww[i] - w[i]));
        Vec3 inertia = line_water_inertia(&c, wet, q, vec3(wax[i], way[i], waz[i]));
        double bed = line_bed_force(&c, bed_share[i], z[i], w[i]);
        double rub = line_bed_friction(&c, bed, sqrt(u[i] * u[i] + v[i] * v[i]));
        Vec3 f;
        f.x = px[i + 1] - px[i] + drag.x + inertia.x - rub * u[i];
        f.y = py[i + 1] - py[i] + drag.y + inertia.y - rub * v[i];
        f.z = pz[i + 1] - pz[i] + drag.z + inertia.z + bed + c.buoyancy * wet - c.weight * share[i];
        Vec3 a = line_acceleration(line_mass_normal(&c, share[i], wet),
                                   line_mass_tangential(&c, share[i], wet), q, f);
        fx[i] = f.x;
        fy[i] = f.y;
        fz[i] = f.z;
        ax[i] = a.x;
        ay[i] = a.y;
        az[i] = a.z;
    }
}

static SpecialNode soa_special_node(const LineWork *work, const LineNodes *nodes, int i)
{
    Vec3 place[3];
    double elevation[3];
    for (int k = 0; k < 3; k++) {
        int at = i - 1 + k < 0 || i - 1 + k >= work->node_count ? i : i - 1 + k;
        place[k] = vec3(nodes->x[at], nodes->y[at], nodes->z[at]);
        elevation[k] = work->water_now[6][at];
    }
    return makeup_special_node(&work->makeup, i, place, elevation);
}

/// One special node (see mooring_makeup.h).
static void special_node_forces(LineWork *work, const LineNodes *nodes, int i)
{
    SpecialNode node = soa_special_node(work, nodes, i);
    const LineConstants *c = &node.sum;
    double *const *water = work->water_now;
    double u = nodes->u[i], v = nodes->v[i], w = nodes->w[i];
    Vec3 f = line_drag(c, 1, node.q, vec3(water[0][i] - u, water[1][i] - v, water[2][i] - w));
    f = vec3_add(f, line_water_inertia(c, 1, node.q, vec3(water[3][i], water[4][i], water[5][i])));
    f = vec3_add(f, vec3(work->px[i + 1] - work->px[i], work->py[i + 1] - work->py[i],
                         work->pz[i + 1] - work->pz[i]));
    double bed = work->bed_share[i] > 0 ? line_bed_force(c, 1, nodes->z[i], w) : 0;
    double rub = line_bed_friction(c, bed, sqrt(u * u + v * v));
    f = vec3_add(f, vec3(-rub * u, -rub * v, bed + c->buoyancy - c->weight));
    Vec3 a = line_acceleration(line_mass_normal(c, 1, 1), line_mass_tangential(c, 1, 1), node.q, f);
    work->fx[i] = f.x;
    work->fy[i] = f.y;
    work->fz[i] = f.z;
    work->ax[i] = a.x;
    work->ay[i] = a.y;
    work->az[i] = a.z;
}

/// Bending makes a segment pull across itself too: forces f on the nodes before and after a bent
/// node are shears f and -f of its segments.
static void add_shear(LineWork *work, const LineNodes *nodes)
{
    const double *dx = work->dx + 1, *dy = work->dy + 1, *dz = work->dz + 1;
    double *px = work->px + 1, *py = work->py + 1, *pz = work->pz + 1;
    for (int i = 1; i + 1 < work->node_count; i++) {
        Bend bend = makeup_bend(&work->makeup, i, vec3(dx[i - 1], dy[i - 1], dz[i - 1]),
                                vec3(dx[i], dy[i], dz[i]));
        Vec3 force[3], damping[3], v[3];
        for (int k = 0; k < 3; k++)
            v[k] = vec3(nodes->u[i - 1 + k], nodes->v[i - 1 + k], nodes->w[i - 1 + k]);
        bend_forces(&bend, force);
        bend.growth = bend.time;
        bend_change(&bend, v, damping);
        for (int k = 0; k < 3; k += 2)
            force[k] = vec3_add(force[k], damping[k]);
        px[i - 1] += force[0].x;
        py[i - 1] += force[0].y;
        pz[i - 1] += force[0].z;
        px[i] -= force[2].x;
        py[i] -= force[2].y;
        pz[i] -= force[2].z;
    }
}

void line_segments(LineWork *work, const LineNodes *nodes)
{
    for (int r = 0; r < work->makeup.run_count; r++)
        run_segments(work, nodes, &work->makeup.runs[r]);
    if (work->makeup.bends) add_shear(work, nodes);
}

void line_node_forces(LineWork *work, const LineNodes *nodes)
{
    for (int r = 0; r < work->makeup.run_count; r++)
        run_node_forces(work, nodes, &work->makeup.runs[r]);
    for (int k = 0; k < work->makeup.special_count; k++)
        special_node_forces(work, nodes, work->makeup.special[k]);
}

/// to = from + rate * h for positions and velocities of all nodes; `to` may be `from`, not `rate`.
WIDE static void nodes_move(const LineWork *work, LineNodes *to, const LineNodes *from,
                            const LineNodes *rate, double h)
{
    const double *restrict u = rate->u, *restrict v = rate->v, *restrict w = rate->w;
    const double *restrict ax = work->ax, *restrict ay = work->ay, *restrict az = work->az;
    int count = work->node_count;
#pragma GCC ivdep
    for (int i = 0; i < count; i++) {
        to->x[i] = from->x[i] + h * u[i];
        to->y[i] = from->y[i] + h * v[i];
        to->z[i] = from->z[i] + h * w[i];
        to->u[i] = from->u[i] + h * ax[i];
        to->v[i] = from->v[i] + h * ay[i];
        to->w[i] = from->w[i] + h * az[i];
    }
}

/// A line's node to accelerations and masses of the free point that holds it: gives its half
/// segment's force and mass to the sums.
static void gather_joint(const Line *line, int side, const LineNodes *nodes, Vec3 *force,
                         Sym3 *mass)
{
    const LineWork *work = line->workspace;
    int node = side ? work->node_count - 1 : 0;
    SpecialNode end = soa_special_node(work, nodes, node);
    double normal = line_mass_normal(&end.sum, 1, 1);
    *force = vec3_add(*force, vec3(work->fx[node], work->fy[node], work->fz[node]));
    sym3_add(mass, normal, line_mass_tangential(&end.sum, 1, 1) - normal, end.q);
}

/// Let the ends that meet at a free point move as one.
static void move_point(const MooringPoint *point, bool middle)
{
    const PointWork *own = point->workspace;
    const LineConstants *c = &own->constants;
    const LineWork *first = own->lines[0]->workspace;
    const LineNodes *nodes = middle ? &first->middle : &first->now;
    int node = own->sides[0] ? first->node_count - 1 : 0;
    double *const *water = first->water_now;
    Vec3 v = vec3(nodes->u[node], nodes->v[node], nodes->w[node]), none = vec3(0, 0, 0);
    double depth = water[6][node] - nodes->z[node];
    double wet = line_wet_fraction(depth, depth, c->radius);
    Vec3 stream = vec3(water[0][node], water[1][node], water[2][node]);
    Vec3 force = line_drag(c, wet, none, vec3_sub(stream, v));
    Vec3 swell = vec3(water[3][node], water[4][node], water[5][node]);
    force = vec3_add(force, line_water_inertia(c, wet, none, swell));
    double bed = line_bed_force(c, 1, nodes->z[node], v.z);
    double rub = line_bed_friction(c, bed, hypot(v.x, v.y));
    force = vec3_add(force, vec3(-rub * v.x, -rub * v.y, bed + c->buoyancy * wet - c->weight));
    Sym3 mass = {0, 0, 0, 0, 0, 0};
    sym3_add(&mass, line_mass_normal(c, 1, wet), 0, none);
    for (int k = 0; k < own->joint_count; k++) {
        const LineWork *work = own->lines[k]->workspace;
        gather_joint(own->lines[k], own->sides[k], middle ? &work->middle : &work->now, &force,
                     &mass);
    }
    Sym3 inverse = sym3_inverse(&mass);
    Vec3 a = sym3_apply(&inverse, force);
    for (int k = 0; k < own->joint_count; k++) {
        const LineWork *work = own->lines[k]->workspace;
        int end = own->sides[k] ? work->node_count - 1 : 0;
        work->ax[end] = a.x;
        work->ay[end] = a.y;
        work->az[end] = a.z;
    }
}

/// First node that is not finite or faster than sound in the line, -1 when there is none.
static int nodes_sick(const LineNodes *nodes, int count, double speed_squared)
{
    for (int i = 0; i < count; i++) {
        double speed2 =
            nodes->u[i] * nodes->u[i] + nodes->v[i] * nodes->v[i] + nodes->w[i] * nodes->w[i];
        double place = nodes->x[i] + nodes->y[i] + nodes->z[i];
        if (!(speed2 < speed_squared) || !isfinite(place)) return i;
    }
    return -1;
}

/// Forces and accelerations of all lines of a net in the water of an instant.
static void net_forces(LineNet *net, bool middle, double fraction)
{
    for (int l = 0; l < net->line_count; l++) {
        LineWork *work = net->lines[l]->workspace;
        const LineNodes *nodes = middle ? &work->middle : &work->now;
        line_water_at(work, fraction);
        line_segments(work, nodes);
        line_node_forces(work, nodes);
    }
    for (int p = 0; p < net->block.count; p++)
        move_point(net->points[p], middle);
}

static Vec3 end_place(const LineWork *work, int side)
{
    int end = side ? work->node_count - 1 : 0;
    return vec3(work->now.x[end], work->now.y[end], work->now.z[end]);
}

static void net_substep(LineNet *net, const LineSpan *spans, long k, long count, double h)
{
    double begin = (double)k / (double)count, half = ((double)k + 0.5) / (double)count;
    for (int l = 0; l < net->line_count; l++)
        line_wind(net->lines[l], spans[l].time + half * spans[l].duration);
    net_forces(net, false, begin);
    for (int l = 0; l < net->line_count; l++) {
        LineWork *work = net->lines[l]->workspace;
        nodes_move(work, &work->middle, &work->now, &work->now, 0.5 * h);
        line_hold_ends(work, &work->middle, &spans[l], half);
    }
    net_forces(net, true, half);
    for (int l = 0; l < net->line_count; l++) {
        LineWork *work = net->lines[l]->workspace;
        Vec3 from[2] = {end_place(work, 0), end_place(work, 1)};
        nodes_move(work, &work->now, &work->now, &work->middle, h);
        line_hold_ends(work, &work->now, &spans[l], (double)(k + 1) / (double)count);
        for (int side = 0; side < 2; side++) {
            int end = side ? work->node_count - 1 : 0;
            Vec3 force = vec3(work->fx[end], work->fy[end], work->fz[end]);
            work->end_force[side] = vec3_mad(work->end_force[side], force, h);
            work->end_work[side] += vec3_dot(force, vec3_sub(end_place(work, side), from[side]));
        }
    }
}

/// Sub-steps that keep all lines of a net below their limits.
static long substep_count(const LineNet *net, double duration)
{
    double limit = INFINITY;
    for (int l = 0; l < net->line_count; l++)
        limit = mind(limit, net->lines[l]->step_limit);
    long count = (long)ceil(duration / limit - 1e-9);
    return count < 1 ? 1 : count;
}

bool net_step_rk2(LineNet *net, const LineSpan *spans, LineSickness *sick)
{
    long count = substep_count(net, spans[0].duration);
    double h = spans[0].duration / (double)count;
    for (long k = 0; k < count; k++) {
        net_substep(net, spans, k, count, h);
        net_part(net, spans[0].time + h * (double)(k + 1));
        if (k % SICKNESS_INTERVAL != 0 && k != count - 1) continue;
        for (int l = 0; l < net->line_count; l++) {
            const Line *line = net->lines[l];
            const LineWork *work = line->workspace;
            int node =
                nodes_sick(&work->now, work->node_count, line->sound_speed * line->sound_speed);
            if (node < 0) continue;
            sick->line = line;
            sick->node = node;
            sick->time = spans[0].time + h * (double)(k + 1);
            return false;
        }
    }
    for (int l = 0; l < net->line_count; l++)
        net->lines[l]->substeps += count;
    return true;
}
