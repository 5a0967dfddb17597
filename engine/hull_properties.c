/// Volume integrals of closed meshes, whole and cut by the water plane.
#include <math.h>

#include "hull_internal.h"

/// Sums over the tetrahedra that the triangles span with the centre of the bounding box (near the
/// mesh, so that nothing cancels): volume = d/6, first moment = d/24 s, second moments
/// = d/120 (s s^T + a a^T + b b^T + c c^T) with d = a . (b x c), s = a + b + c.
/// Source: Tonon (2005), doi:10.3844/jmssp.2005.8.11
MeshProperties mesh_properties(const TriangleMesh *mesh)
{
    MeshProperties p = {.min = {INFINITY, INFINITY, INFINITY},
                        .max = {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < mesh->vertex_count; i++) {
        Vec3 v = mesh->vertices[i];
        p.min = vec3(mind(p.min.x, v.x), mind(p.min.y, v.y), mind(p.min.z, v.z));
        p.max = vec3(maxd(p.max.x, v.x), maxd(p.max.y, v.y), maxd(p.max.z, v.z));
    }
    Vec3 centre = vec3_scale(vec3_add(p.min, p.max), 0.5), first = vec3(0, 0, 0);
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        Vec3 a = vec3_sub(mesh->vertices[mesh->triangles[i][0]], centre);
        Vec3 b = vec3_sub(mesh->vertices[mesh->triangles[i][1]], centre);
        Vec3 c = vec3_sub(mesh->vertices[mesh->triangles[i][2]], centre);
        Vec3 s = vec3_add(a, vec3_add(b, c));
        double d = vec3_dot(a, vec3_cross(b, c)), w = d / 120;
        p.area += 0.5 * vec3_norm(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
        p.volume += d / 6;
        first = vec3_mad(first, s, d / 24);
        xx += w * (s.x * s.x + a.x * a.x + b.x * b.x + c.x * c.x);
        yy += w * (s.y * s.y + a.y * a.y + b.y * b.y + c.y * c.y);
        zz += w * (s.z * s.z + a.z * a.z + b.z * b.z + c.z * c.z);
        xy += w * (s.x * s.y + a.x * a.y + b.x * b.y + c.x * c.y);
        xz += w * (s.x * s.z + a.x * a.z + b.x * b.z + c.x * c.z);
        yz += w * (s.y * s.z + a.y * a.z + b.y * b.z + c.y * c.z);
    }
    double v = p.volume;
    if (v == 0) return p;
    Vec3 g = vec3_scale(first, 1 / v);
    p.centroid = vec3_add(centre, g);
    xx -= v * g.x * g.x;
    yy -= v * g.y * g.y;
    zz -= v * g.z * g.z;
    p.inertia[0] = yy + zz;
    p.inertia[1] = xx + zz;
    p.inertia[2] = xx + yy;
    p.inertia[3] = -(xy - v * g.x * g.y);
    p.inertia[4] = -(xz - v * g.x * g.z);
    p.inertia[5] = -(yz - v * g.y * g.z);
    return p;
}

/// Add a triangle that lies below z = 0. Every integrand f is at most quadratic, so that the mean
/// of its values at the mid-sides is exact; the measure is the projected area n_z dS.
///   volume = sum z n_z dS,  moments = sum (x z, y z, z^2/2) n_z dS,
///   waterplane: integral of f(x, y) = - sum f n_z dS
static void submerged_add(Submerged *sum, Vec3 a, Vec3 b, Vec3 c)
{
    double projected = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    Vec3 middle[3] = {vec3_scale(vec3_add(a, b), 0.5), vec3_scale(vec3_add(b, c), 0.5),
                      vec3_scale(vec3_add(c, a), 0.5)};
    for (int k = 0; k < 3; k++) {
        Vec3 m = middle[k];
        double w = projected / 3;
        sum->volume += w * m.z;
        sum->moment.x += w * m.x * m.z;
        sum->moment.y += w * m.y * m.z;
        sum->moment.z += w * 0.5 * m.z * m.z;
        sum->waterplane_area -= w;
        sum->waterplane_x -= w * m.x;
        sum->waterplane_y -= w * m.y;
        sum->waterplane_xx -= w * m.x * m.x;
        sum->waterplane_yy -= w * m.y * m.y;
        sum->waterplane_xy -= w * m.x * m.y;
    }
}

/// Cut a triangle by z = 0 and add what lies below (a triangle or a quadrilateral).
static void submerged_clip(Submerged *sum, const Vec3 corner[3])
{
    Vec3 kept[4];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        Vec3 a = corner[k], b = corner[(k + 1) % 3];
        if (a.z <= 0) kept[count++] = a;
        if ((a.z <= 0) != (b.z <= 0)) {
            Vec3 cut = vec3_mad(a, vec3_sub(b, a), a.z / (a.z - b.z));
            cut.z = 0;
            kept[count++] = cut;
        }
    }
    for (int k = 2; k < count; k++)
        submerged_add(sum, kept[0], kept[k - 1], kept[k]);
}

Submerged mesh_submerged(const TriangleMesh *mesh, Vec3 origin, Quat attitude, double level)
{
    Submerged sum = {.lowest = INFINITY, .highest = -INFINITY};
    double lift = origin.z - level;
    for (int i = 0; i < mesh->triangle_count; i++) {
        Vec3 corner[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = quat_rotate(attitude, mesh->vertices[mesh->triangles[i][k]]);
            corner[k].z += lift;
            sum.lowest = mind(sum.lowest, corner[k].z);
            sum.highest = maxd(sum.highest, corner[k].z);
        }
        submerged_clip(&sum, corner);
    }
    return sum;
}

/// 2 pi sqrt(inertia / stiffness), NAN where there is nothing that restores.
static double natural_period(double inertia, double stiffness)
{
    return stiffness > 0 && inertia > 0 ? 2 * PI * sqrt(inertia / stiffness) : NAN;
}

static double inertia_about(const double inertia[3][3], Vec3 axis)
{
    double n[3] = {axis.x, axis.y, axis.z}, sum = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum += n[i] * inertia[i][j] * n[j];
    return sum;
}

/// Second moments of the waterplane about its centroid: over the distance along and across a
/// horizontal direction; zero when the mesh does not pierce the surface.
static void waterplane_moments(const Submerged *s, Vec3 ahead, double *along, double *across)
{
    *along = *across = 0;
    if (!(s->waterplane_area > 0 && s->highest > 0)) return;
    double x = s->waterplane_x / s->waterplane_area, y = s->waterplane_y / s->waterplane_area;
    double xx = s->waterplane_xx - s->waterplane_area * x * x;
    double yy = s->waterplane_yy - s->waterplane_area * y * y;
    double xy = s->waterplane_xy - s->waterplane_area * x * y;
    *along = ahead.x * ahead.x * xx + 2 * ahead.x * ahead.y * xy + ahead.y * ahead.y * yy;
    *across = ahead.y * ahead.y * xx - 2 * ahead.x * ahead.y * xy + ahead.x * ahead.x * yy;
}

/// Horizontal direction the body heads to; +x when it stands on its end.
static Vec3 heading_of(Quat attitude)
{
    Vec3 forward = quat_rotate(attitude, vec3(1, 0, 0));
    double horizontal = hypot(forward.x, forward.y);
    return horizontal > 1e-9 ? vec3(forward.x / horizontal, forward.y / horizontal, 0)
                             : vec3(1, 0, 0);
}

/// Metacentric heights GM = (B - G)_z + I/V, I the waterplane's second moments about its centroid,
/// along and across the body's heading. Source: Newman (1977), Marine Hydrodynamics, ch. 6.16.
Hydrostatics mesh_hydrostatics(const TriangleMesh *mesh, Vec3 origin, Quat attitude,
                               Vec3 centre_of_gravity, double mass, const double inertia[3][3],
                               double level, double density, double gravity)
{
    Submerged s = mesh_submerged(mesh, origin, attitude, level);
    Hydrostatics h = {.draft = -s.lowest,
                      .mass = mass,
                      .gm_transverse = NAN,
                      .gm_longitudinal = NAN,
                      .heave_period = NAN,
                      .roll_period = NAN,
                      .pitch_period = NAN,
                      .centre_of_buoyancy = {NAN, NAN, NAN}};
    if (!(s.volume > 0)) return h;
    h.displacement = s.volume;
    h.waterplane_area = s.highest > 0 ? s.waterplane_area : 0;

    double lift = origin.z - level; // all vectors start at the point of the level above the origin
    Vec3 buoyancy = vec3_scale(s.moment, 1 / s.volume);
    Vec3 balance = quat_rotate(attitude, centre_of_gravity);
    balance.z += lift;
    Quat back = quat_conjugate(attitude);
    h.centre_of_buoyancy = quat_rotate(back, vec3(buoyancy.x, buoyancy.y, buoyancy.z - lift));

    Vec3 ahead = heading_of(attitude), port = vec3(-ahead.y, ahead.x, 0);
    Vec3 arm = vec3_sub(buoyancy, balance);
    double force = density * gravity * s.volume, along, across;
    h.heel_moment = vec3_dot(arm, port) * force;
    h.trim_moment = -vec3_dot(arm, ahead) * force;
    waterplane_moments(&s, ahead, &along, &across);
    h.gm_transverse = arm.z + across / s.volume;
    h.gm_longitudinal = arm.z + along / s.volume;
    h.heave_period = natural_period(mass, density * gravity * h.waterplane_area);
    h.roll_period =
        natural_period(inertia_about(inertia, quat_rotate(back, ahead)), force * h.gm_transverse);
    h.pitch_period =
        natural_period(inertia_about(inertia, quat_rotate(back, port)), force * h.gm_longitudinal);
    return h;
}
