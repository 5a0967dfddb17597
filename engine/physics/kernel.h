/// The Wendland C2 kernel, written in s = 1 - q/2, q = r/h, 0 <= q <= 2, because everything the
/// fluid needs is then a polynomial and the cut-off is max(0, s):
///
///     W        = alpha_D (1 - q/2)^4 (2q + 1)      = alpha_D s^4 (5 - 4 s)
///     grad_i W = W'(r) x_ik / r                    = -(5 alpha_D / h^2) s^3 x_ik
///
/// alpha_D = 21/(16 pi h^3) in three dimensions, 7/(4 pi h^2) in two.
/// Source: Wendland (1995), doi:10.1007/BF02123482; constants as in Dominguez et al. (2022),
/// doi:10.1007/s40571-021-00404-2.
#ifndef FAIRLEAD_PHYSICS_KERNEL_H
#define FAIRLEAD_PHYSICS_KERNEL_H

#include "lane.h"

/// alpha_D [1/m^3] in 3-D, [1/m^2] in 2-D. @param h  smoothing length [m]
FN double kernel_constant(double h, int dimensions)
{
    return dimensions == 2 ? 7.0 / (4.0 * PI * h * h) : 21.0 / (16.0 * PI * h * h * h);
}

/// W / alpha_D at s = max(0, 1 - q/2) [-].
FN LANE kernel_value(LANE s) { return s * s * s * s * (5.0f - 4.0f * s); }

/// -(h^2 / 5 alpha_D) grad_i W / x_ik [-]: what multiplies x_ik.
FN LANE kernel_slope(LANE s) { return s * s * s; }

#endif
