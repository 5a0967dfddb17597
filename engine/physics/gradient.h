/// Corrected kernel gradients. Near the surface and among particles in disorder the plain sum
/// sum V_k (f_k - f_i) grad_i W is not the gradient of f, and waves pay for it with their height.
/// With the moment matrix of each particle's neighbours, dummies included,
///
///     M_i = sum_k V_k (x_k - x_i) (x) grad_i W_ik,   B_i = M_i^-1,
///
/// B_i grad_i W is exact for linear f. In momentum both sides of a pair bring their own,
///
///     dv_i/dt = - sum m_k (P_i B_i + P_k B_k) grad_i W_ik + …,
///
/// which keeps momentum. B fades to the unit matrix between 0.975 and 0.84 of M's mean eigenvalue,
/// det(M)^(1/d): disorder inside is corrected, the surface (a flat one has 0.5) is left alone.
/// There the plain sum is right where pressure vanishes, and correcting it fed standing waves.
/// Sources: Bonet & Lok (1999), doi:10.1016/S0045-7825(99)00051-1; in water waves, Zago et al.
/// (2021), Coastal Engineering 170. (measured) The limits: docs/physics.md.
#ifndef FAIRLEAD_PHYSICS_GRADIENT_H
#define FAIRLEAD_PHYSICS_GRADIENT_H

#include "pair.h"

enum { GRADIENT_TERMS = 6 };

/// A symmetric matrix.
typedef struct Symmetric {
    LANE xx, yy, zz, xy, xz, yz;
} Symmetric;

/// det(M) below which B is the unit matrix, and one over the width in which it fades in.
typedef struct GradientLimits {
    float floor, per_width;
} GradientLimits;

FN GradientLimits gradient_limits(int dimensions)
{
    double low = pow(0.84, dimensions), high = pow(0.975, dimensions);
    GradientLimits limits;
    limits.floor = (float)low;
    limits.per_width = (float)(1 / (high - low));
    return limits;
}

/// Share of one neighbour in M, without its factor. @param slope  kernel_slope of the pair
FN Symmetric gradient_moment(LANE slope, LANE x, LANE y, LANE z)
{
    Symmetric m;
    m.xx = slope * x * x;
    m.yy = slope * y * y;
    m.zz = slope * z * z;
    m.xy = slope * x * y;
    m.xz = slope * x * z;
    m.yz = slope * y * z;
    return m;
}

/// B of M; in 2-D the caller has put 1 in yy.
FN Symmetric gradient_correction(Symmetric m, GradientLimits limits)
{
    Symmetric b;
    b.xx = m.yy * m.zz - m.yz * m.yz;
    b.yy = m.xx * m.zz - m.xz * m.xz;
    b.zz = m.xx * m.yy - m.xy * m.xy;
    b.xy = m.xz * m.yz - m.xy * m.zz;
    b.xz = m.xy * m.yz - m.xz * m.yy;
    b.yz = m.xy * m.xz - m.xx * m.yz;
    LANE det = m.xx * b.xx + m.xy * b.xy + m.xz * b.xz;
    LANE above = lane_above_zero(det - limits.floor), share = above * limits.per_width;
    share = 1.0f - lane_above_zero(1.0f - share);
    LANE scale = share / (above + limits.floor), rest = 1.0f - share;
    b.xx = scale * b.xx + rest;
    b.yy = scale * b.yy + rest;
    b.zz = scale * b.zz + rest;
    b.xy = scale * b.xy;
    b.xz = scale * b.xz;
    b.yz = scale * b.yz;
    return b;
}

/// p A + q B
FN Symmetric gradient_weigh(LANE p, Symmetric a, LANE q, Symmetric b)
{
    Symmetric c;
    c.xx = p * a.xx + q * b.xx;
    c.yy = p * a.yy + q * b.yy;
    c.zz = p * a.zz + q * b.zz;
    c.xy = p * a.xy + q * b.xy;
    c.xz = p * a.xz + q * b.xz;
    c.yz = p * a.yz + q * b.yz;
    return c;
}

#endif
