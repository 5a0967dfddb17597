/// Particle shifting: particles that move drift from where they crowd to where they are sparse, by
/// Fick's law, so that streams stay evenly strewn,
///
///     dx_i/dt = v_i + u_i,   u_i = -A abs(v_i) h grad C_i,   grad C_i = sum_k V_k grad_i W_ik,
///
/// dummies included. Water at rest is left alone, for u goes with the speed. Only the path is
/// shifted, not what a particle carries. A shift towards the surface blows the water up
/// (measured, docs/physics.md): u fades between 1 and 0.985 of the fullness
/// tr(M_i)/d, M as in gradient.h; within 2h of a flat surface it falls from 1 to 0.5.
/// Sources: Lind et al. (2012), doi:10.1016/j.jcp.2011.10.027; with the particle's own speed,
/// Skillen et al. (2013), doi:10.1016/j.cma.2013.05.017.
#ifndef FAIRLEAD_PHYSICS_SHIFT_H
#define FAIRLEAD_PHYSICS_SHIFT_H

#include "lane.h"

#define SHIFT_MOST 0.1f ///< largest u over the speed [-]

enum { SHIFT_SUMS = 4 }; ///< three of the concentration's gradient, one of the fullness

typedef struct ShiftConstants {
    float gradient; ///< A h times the factor of sum s^3 x/2h in grad C [-]
    float fullness; ///< factor of sum s^3 (r/2h)^2 in tr(M)/d [-]
} ShiftConstants;

/// @param coefficient    A [-]
/// @param moment_factor  of M, summed with lengths over 2h: 4 h^2 K V [-]
FN ShiftConstants shift_constants(double coefficient, double moment_factor, int dimensions)
{
    ShiftConstants c;
    c.gradient = (float)(0.5 * coefficient * moment_factor);
    c.fullness = (float)(moment_factor / dimensions);
    return c;
}

/// u of one particle over its sums of s^3 x_ik/2h [m/s]. u is at most SHIFT_MOST of the speed.
/// @param length2   square of those sums [-]    @param fullness  sum of s^3 (r/2h)^2 [-]
/// @param speed2    [m^2/s^2]
FN LANE shift_factor(LANE length2, LANE fullness, LANE speed2, ShiftConstants c)
{
    const float low = 0.985f;
    LANE share = lane_above_zero(c.fullness * fullness - low) * (1.0f / (1.0f - low));
    share = 1.0f - lane_above_zero(1.0f - share);
    LANE over = lane_above_zero(c.gradient * lane_sqrt(length2) * (1.0f / SHIFT_MOST) - 1.0f);
    return share * c.gradient * lane_sqrt(speed2) / (1.0f + over);
}

#endif
