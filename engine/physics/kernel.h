/// Smoothing kernels, written in s = 1 - r/2h = 1 - x, because everything the fluid needs is then a
/// polynomial and the cut-off is max(0, s). Of both, with K the slope's constant,
///
///     grad_i W = -K slope(s) x_ik,   W = alpha_D value(s)
///
/// Wendland's C2 (Wendland 1995, doi:10.1007/BF02123482; constants as in Dominguez et al. 2022,
/// doi:10.1007/s40571-021-00404-2):
///
///     slope = s^3,   value = s^4 (5 - 4 s),   K = 5 alpha_D/h^2
///     alpha_D = 21/(16 pi h^3) in three dimensions, 7/(4 pi h^2) in two
///
/// The yielding one is our own, of the family s^p (1 + a x + b x^2) that Wendland's belong to:
///
///     slope = s^7 (1 + 7 x + 20 x^2) = s^7 (28 - 47 s + 20 s^2)
///     value = s^8 (577.5 - 1375 s + 1105.5 s^2 - 300 s^3)/8,   K = 165 alpha_D/(32 h^2)
///     alpha_D = 273/(106 pi h^3), 312/(115 pi h^2)
///
/// Particles under pressure are a solid: they resist shear, and water that flows or waves must
/// break it. What holds molten water is with this kernel a twentieth of what it is with Wendland's;
/// the square and cubic lattices of spacing h/2 in which water starts are hardly unstable, and its
/// Fourier transform is nowhere below -1.2e-5, so that particles do not pair (docs/physics.md,
/// tests/unit/test_kernel.c).
#ifndef FAIRLEAD_PHYSICS_KERNEL_H
#define FAIRLEAD_PHYSICS_KERNEL_H

#include "kernel_kind.h"
#include "lane.h"

FN LANE wendland_value(LANE s) { return s * s * s * s * (5.0f - 4.0f * s); }

FN LANE wendland_slope(LANE s) { return s * s * s; }

FN LANE yielding_value(LANE s)
{
    LANE s2 = s * s, s4 = s2 * s2;
    return s4 * s4 * (72.1875f + s * (-171.875f + s * (138.1875f - 37.5f * s)));
}

FN LANE yielding_slope(LANE s)
{
    LANE s2 = s * s;
    return s2 * s2 * (s2 * s) * (28.0f + s * (20.0f * s - 47.0f));
}

// Files compiled once per kernel define SWEEP_KERNEL.
#ifndef SWEEP_KERNEL
#define SWEEP_KERNEL KERNEL_WENDLAND
#endif

FN LANE kernel_value(LANE s)
{
    return SWEEP_KERNEL == KERNEL_YIELDING ? yielding_value(s) : wendland_value(s);
}

FN LANE kernel_slope(LANE s)
{
    return SWEEP_KERNEL == KERNEL_YIELDING ? yielding_slope(s) : wendland_slope(s);
}

#endif
