/// What one pair of particles does to each other: the only place where these formulas stand.
/// Every backend inlines them into its sweep.
///
/// Lengths arrive in the position unit u (see particles.h: positions are fixed-point integers, so a
/// difference is exact and never loses digits far from the origin); the constants absorb u.
/// Sums come out without their common factors, which SweepConstants holds; with the closeness of a
/// pair s = max(0, 1 - r/2h) and S(s) = kernel_slope of the sweep's kernel:
///
///     acceleration_i = acceleration_factor * sum S (P_i + P_k + Pi_ik) x_ik + g,  P = p/rho^2
///     (drho/dt)_i/rho0 = density_factor * sum S (-v_ik . x_ik + D_k - D_i)
///
/// Sources: momentum and artificial viscosity, Monaghan (1992) and (1994); density diffusion with
/// the hydrostatic part removed, Fourtakas et al. (2019), doi:10.1016/j.compfluid.2019.06.009 —
/// with psi_ik . grad_i W = -2 (D_k - D_i) F, where grad_i W = F x_ik, the distance cancels and a
/// spike decays.
#ifndef FAIRLEAD_PHYSICS_PAIR_H
#define FAIRLEAD_PHYSICS_PAIR_H

#include "kernel.h"

typedef struct SweepConstants {
    float per_support;         ///< u / 2h: closeness = 1 - r per_support
    float support_squared;     ///< (2h / u)^2, for box tests
    float acceleration_factor; ///< K m u: [Pa m^6/kg^2] → [m/s^2]
    float density_factor;      ///< K m u / rho0: [m/s] → [1/s]
    float viscosity;           ///< alpha c0 h / (u rho0): multiplies min(0, v.x)/(r^2 + eta^2)
    float eta_squared;         ///< 0.01 h^2 / u^2
    float diffusion;           ///< 2 delta h c0 / u [m/s]: D = diffusion * dynamic density excess
} SweepConstants;

/// Constants of a scene. @param u  position unit [m]; mass per particle [kg], per metre in 2-D
FN SweepConstants sweep_constants(Kernel kernel, double h, int dimensions, double u, double mass,
                                  double rho0, double c0, double alpha, double delta)
{
    SweepConstants c;
    double slope = kernel_slope_constant(kernel, h, dimensions) * mass;
    c.per_support = (float)(u / (2.0 * h));
    c.support_squared = (float)(4.0 * h * h / (u * u));
    c.acceleration_factor = (float)(slope * u);
    c.density_factor = (float)(slope * u / rho0);
    c.viscosity = (float)(alpha * c0 * h / (u * rho0));
    c.eta_squared = (float)(0.01 * h * h / (u * u));
    c.diffusion = (float)(2.0 * delta * h * c0 / u);
    return c;
}

/// max(0, 1 - r/2h) from a distance in units.
FN LANE pair_closeness(LANE r, float per_support)
{
    return lane_above_zero(1.0f - per_support * r);
}

/// Pi_ik over -viscosity: zero for particles that part. @param vx  v_ik . x_ik
FN LANE pair_approach(LANE r2, LANE vx, const SweepConstants c)
{
    return lane_below_zero(vx) / (r2 + c.eta_squared);
}

/// Factor of x_ik in i's acceleration (and of -x_ik in k's).
/// @param pressures  P_i + P_k, and Pi_ik
FN LANE pair_force(LANE closeness, LANE pressures) { return kernel_slope(closeness) * pressures; }

#endif
