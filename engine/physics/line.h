/// Formulas of one segment and one node of a lumped-mass mooring line, in double precision; every
/// stepper and the statics use these and no others.
///
/// A segment joins node i to node i+1; half of its mass, weight and water loads goes to either
/// node. Source: Hall & Goupee (2015), Ocean Eng. 104, 590, doi:10.1016/j.oceaneng.2015.05.035,
/// with three changes: segments never push, the bed never pulls, and loads
/// of the water fade smoothly where a segment pierces the surface.
#ifndef FAIRLEAD_PHYSICS_LINE_H
#define FAIRLEAD_PHYSICS_LINE_H

#include "base/portable.h"

/// What does not change along a piece of line or in time; "per segment" means of one unstretched
/// length.
typedef struct LineConstants {
    double length;           ///< unstretched segment l [m]
    double stiffness;        ///< EA / l [N/m]
    double damping;          ///< BA / l = zeta sqrt(EA w) [N s/m]
    double mass;             ///< per segment w l [kg]
    double weight;           ///< in air, per segment [N]
    double buoyancy;         ///< rho A l g [N]
    double water_mass;       ///< displaced, rho A l [kg]
    double added_normal;     ///< rho A l Can [kg]
    double added_tangential; ///< rho A l Cat [kg]
    double drag_normal;      ///< rho d l Cdn / 2 [kg/m]
    double drag_tangential;  ///< rho pi d l Cdt / 2 [kg/m]
    double radius;           ///< d / 2 [m]
    double bed;              ///< z of the bed [m]
    double bed_stiffness;    ///< kb d l [N/m]
    double bed_damping;      ///< cb d l [N s/m]
    double bed_ramp;         ///< penetration over which bed damping grows to its full value [m]
    double bed_friction;     ///< Coulomb coefficient [-]
    double friction_speed;   ///< slip at which friction is 1/sqrt(2) of its full value [m/s]
    double friction_cap;     ///< largest ratio of friction to slip speed [N s/m]
    double bending;          ///< EI [N m^2]
    double bending_time;     ///< ratio of bending's damping to its stiffness [s]
    double breaking;         ///< tension at which a segment parts [N], INFINITY = never
} LineConstants;

/// sum += half a segment of which the share `wet` is under water: the node between two segments,
/// or at an end, carries the sum of its halves (then with share and wet of 1).
FN void line_add_half(LineConstants *sum, const LineConstants *c, double wet)
{
    sum->length += 0.5 * c->length;
    sum->mass += 0.5 * c->mass;
    sum->weight += 0.5 * c->weight;
    sum->buoyancy += 0.5 * wet * c->buoyancy;
    sum->water_mass += 0.5 * wet * c->water_mass;
    sum->added_normal += 0.5 * wet * c->added_normal;
    sum->added_tangential += 0.5 * wet * c->added_tangential;
    sum->drag_normal += 0.5 * wet * c->drag_normal;
    sum->drag_tangential += 0.5 * wet * c->drag_tangential;
    sum->bed = c->bed;
    sum->bed_stiffness += 0.5 * c->bed_stiffness;
    sum->bed_damping += 0.5 * c->bed_damping;
    sum->bed_ramp = c->bed_ramp > sum->bed_ramp ? c->bed_ramp : sum->bed_ramp;
    sum->bed_friction = c->bed_friction;
    sum->friction_speed = c->friction_speed;
    sum->friction_cap += 0.5 * c->friction_cap;
}

/// Tension of a segment [N] of stretched length `s` that grows at `rate`.
/// T = max(0, EA max(s/l - 1, 0) + BA s'/l): it never pushes. Damping acts on a slack segment that
/// lengthens too, so that tension is continuous where it goes taut; without that, slack chain snaps
/// undamped and its spikes grow as the step falls (docs/mooring.md).
FN double line_tension(const LineConstants *c, double s, double rate)
{
    double stretch = s - c->length;
    double elastic = stretch > 0 ? c->stiffness * stretch : 0;
    double sum = elastic + c->damping * rate;
    return sum > 0 ? sum : 0;
}

/// d line_tension / ds when the rate changes with s by `rate_slope` [1/s] (implicit steps) [N/m].
FN double line_tension_slope(const LineConstants *c, double s, double rate, double rate_slope)
{
    double stretch = s - c->length;
    double elastic = stretch > 0 ? c->stiffness * stretch : 0;
    double slope = (stretch > 0 ? c->stiffness : 0) + c->damping * rate_slope;
    return elastic + c->damping * rate > 0 ? slope : 0;
}

/// Integral over depth of the wetted share of a horizontal cylinder, taken linear over its
/// diameter.
FN double line_wetness_integral(double depth, double radius)
{
    double partly = (depth + radius) * (depth + radius) / (4 * radius);
    double wet = depth > radius ? depth : partly;
    return depth < -radius ? 0 : wet;
}

/// Submerged fraction F of a segment whose ends are `depth0` and `depth1` below the surface [-].
FN double line_wet_fraction(double depth0, double depth1, double radius)
{
    double difference = depth1 - depth0;
    double middle = (0.5 * (depth0 + depth1) + radius) / (2 * radius);
    middle = middle > 1 ? 1 : middle;
    middle = middle < 0 ? 0 : middle;
    double size = difference < 0 ? -difference : difference;
    double flat = 1e-3 * radius;
    double divisor = size < flat ? 1 : difference;
    double mean =
        (line_wetness_integral(depth1, radius) - line_wetness_integral(depth0, radius)) / divisor;
    return size < flat ? middle : mean;
}

/// Share (0..1) of the bed's damping that acts at a penetration [m]: smooth, so that touching down
/// does not switch a force on.
FN double line_bed_ramp(const LineConstants *c, double penetration)
{
    double t = penetration / c->bed_ramp;
    t = t > 1 ? 1 : t;
    t = t < 0 ? 0 : t;
    return t * t * (3 - 2 * t);
}

/// Upward force of the bed on a node [N], never negative. `share` is the node's length in segments
/// (1, or 1/2 at an end), `z` and `rate` its height and vertical speed.
/// B = d l (kb p - cb ramp(p) z'), p = bed - z.
FN double line_bed_force(const LineConstants *c, double share, double z, double rate)
{
    double penetration = c->bed - z;
    double force = share * (c->bed_stiffness * penetration -
                            c->bed_damping * line_bed_ramp(c, penetration) * rate);
    return (penetration > 0 && force > 0) ? force : 0;
}

/// -d line_bed_force / dz when the vertical speed changes with z by `rate_slope` [1/s] [N/m]; the
/// softening part (a rising node) is left out, so that it is never negative.
FN double line_bed_slope(const LineConstants *c, double share, double z, double rate,
                         double rate_slope)
{
    double penetration = c->bed - z, t = penetration / c->bed_ramp;
    double growth = (t > 0 && t < 1 && rate < 0) ? 6 * t * (1 - t) / c->bed_ramp : 0;
    double slope =
        share * (c->bed_stiffness +
                 c->bed_damping * (line_bed_ramp(c, penetration) * rate_slope - growth * rate));
    return line_bed_force(c, share, z, rate) > 0 ? slope : 0;
}

/// Friction against slip speed `slip` [m/s] under the bed force `normal`, as force over speed [N
/// s/m]: mu B / sqrt(slip^2 + slip0^2), capped so that an explicit step cannot reverse the slip.
FN double line_bed_friction(const LineConstants *c, double normal, double slip)
{
    double ratio =
        c->bed_friction * normal / sqrt(slip * slip + c->friction_speed * c->friction_speed);
    return ratio > c->friction_cap ? c->friction_cap : ratio;
}

/// Morison drag [N] on a node with tangent q and wet length `wet` (in segments) from the water's
/// velocity relative to it: rho d l F (Cdn |u_n| u_n + pi Cdt |u_t| u_t) / 2.
FN Vec3 line_drag(const LineConstants *c, double wet, Vec3 q, Vec3 relative)
{
    double along = vec3_dot(relative, q);
    Vec3 normal = vec3_mad(relative, q, -along);
    double normal_speed = sqrt(vec3_dot(normal, normal));
    double along_speed = along < 0 ? -along : along;
    return vec3_scale(vec3_add(vec3_scale(normal, c->drag_normal * normal_speed),
                               vec3_scale(q, c->drag_tangential * along_speed * along)),
                      wet);
}

/// Froude-Krylov and added-mass force of the water's acceleration [N]:
/// rho A l F [(1 + Can) a_n + (1 + Cat) a_t].
FN Vec3 line_water_inertia(const LineConstants *c, double wet, Vec3 q, Vec3 acceleration)
{
    double along = vec3_dot(acceleration, q);
    return vec3_scale(vec3_add(vec3_scale(acceleration, c->water_mass + c->added_normal),
                               vec3_scale(q, (c->added_tangential - c->added_normal) * along)),
                      wet);
}

/// Mass of a node across and along its tangent [kg], added mass included.
FN double line_mass_normal(const LineConstants *c, double share, double wet)
{
    return c->mass * share + c->added_normal * wet;
}
FN double line_mass_tangential(const LineConstants *c, double share, double wet)
{
    return c->mass * share + c->added_tangential * wet;
}

/// Acceleration of a node under `force`: M^-1 f with M = m_n (I - q q^T) + m_t q q^T.
FN Vec3 line_acceleration(double mass_normal, double mass_tangential, Vec3 q, Vec3 force)
{
    double along = vec3_dot(force, q);
    double inverse_normal = 1 / mass_normal, inverse_tangential = 1 / mass_tangential;
    return vec3_add(vec3_scale(force, inverse_normal),
                    vec3_scale(q, (inverse_tangential - inverse_normal) * along));
}

/// M a, the inverse of line_acceleration [N].
FN Vec3 line_inertia(double mass_normal, double mass_tangential, Vec3 q, Vec3 acceleration)
{
    double along = vec3_dot(acceleration, q);
    return vec3_add(vec3_scale(acceleration, mass_normal),
                    vec3_scale(q, (mass_tangential - mass_normal) * along));
}

/// Largest x = omega dt for which explicit midpoint keeps an oscillator of damping ratio zeta from
/// growing: |1 + z + z^2/2| <= 1 with z the eigenvalue times dt, that is
/// -2 zeta + 2 zeta^2 x - zeta x^2 + x^3/4 <= 0 for zeta <= 1 and x = 2/(zeta + sqrt(zeta^2 - 1))
/// above. (An undamped one always grows, at x^4/8 per step; 0.005 stands in for less damping than
/// that.)
FN double line_midpoint_limit(double zeta)
{
    if (zeta > 1) return 2 / (zeta + sqrt(zeta * zeta - 1));
    zeta = zeta < 0.005 ? 0.005 : zeta;
    double low = 0, high = 2;
    for (int i = 0; i < 50; i++) {
        double x = 0.5 * (low + high);
        double growth = -2 * zeta + 2 * zeta * zeta * x - zeta * x * x + 0.25 * x * x * x;
        low = growth <= 0 ? x : low;
        high = growth <= 0 ? high : x;
    }
    return low;
}

#endif
