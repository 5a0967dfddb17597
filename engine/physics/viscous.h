/// Molecular viscosity and the stresses of turbulence too small to be resolved. With
/// grad_i W = F x_ik of Wendland's kernel in the first sum, whatever pressure is summed with
/// (kernel.h: where the lattice yields, fewer neighbours count, and nu u'' on a lattice is off by 8
/// % instead of 4), n dimensions, a pair adds to i's acceleration
///
///     sum_k m_k (2 (n + 2) nu/rho0) (v_ik . x_ik/r^2) F x_ik
///     + sum_k m_k (tau_i/rho_i^2 + tau_k/rho_k^2) . grad_i W,
///     tau/rho = nu_t (2 S - 2/3 tr S I) - 2/3 C_I Delta^2 |S|^2 I,   nu_t = (C_s Delta)^2 |S|,
///
/// S the rate of strain (strain_moment), |S| = sqrt(2 S:S), C_s = 0.12, C_I = 0.0066, Delta = dp.
/// rho0 stands for the densities, as in artificial viscosity (pair.h): they differ by a hundredth.
/// F stays finite, so r^2 needs no 0.01 h^2 beside it.
///
/// The pairs of Morris, Fox & Zhu (1997) and Lo & Shao (2002), 2 nu F v_ik, are nearer to nu
/// nabla^2 v between walls, but keep no angular momentum and have the wrong stress at a free
/// surface: (measured) waves decayed half as fast as they should (docs/physics.md).
/// Sources: first sum, Monaghan & Gingold (1983), doi:10.1016/0021-9991(83)90036-0; at a free
/// surface, Colagrossi et al. (2011), doi:10.1103/PhysRevE.84.026705; stresses, Gotoh, Shibahara &
/// Sakai (2001) and Dalrymple & Rogers (2006), doi:10.1016/j.coastaleng.2005.10.004.
#ifndef FAIRLEAD_PHYSICS_VISCOUS_H
#define FAIRLEAD_PHYSICS_VISCOUS_H

#include "gradient.h"

#define SMAGORINSKY 0.12        ///< C_s [-]
#define ISOTROPIC_STRESS 0.0066 ///< C_I [-]

typedef struct ViscousConstants {
    float laminar;  ///< 2 (n + 2) nu/(u rho0) with Wendland's K over the kernel's
    float strain;   ///< 2 h K V: of sums with lengths over 2h, [m/s] → [1/s]
    float eddy;     ///< (C_s Delta)^2/rho0: nu_t/rho0 over |S|
    float pressing; ///< 2/3 C_I Delta^2/rho0: over |S|^2
} ViscousConstants;

/// Constants of a scene. @param nu  kinematic viscosity [m^2/s]; u position unit [m]; volume of a
/// particle [m^3], in 2-D [m^2]
FN ViscousConstants viscous_constants(Kernel kernel, double h, int dimensions, double u,
                                      double volume, double spacing, double rho0, double nu)
{
    ViscousConstants c;
    double ratio = kernel_slope_constant(KERNEL_WENDLAND, h, dimensions) /
                   kernel_slope_constant(kernel, h, dimensions);
    c.laminar = (float)(2 * (dimensions + 2) * nu / (u * rho0) * ratio);
    c.strain = (float)(2 * h * kernel_slope_constant(kernel, h, dimensions) * volume);
    c.eddy = (float)(SMAGORINSKY * SMAGORINSKY * spacing * spacing / rho0);
    c.pressing = (float)(2.0 / 3.0 * ISOTROPIC_STRESS * spacing * spacing / rho0);
    return c;
}

/// What viscosity adds to the factor of x_ik that pair_force gives. @param closeness  of the pair
/// @param r2  squared distance [unit^2]   @param vx  v_ik . x_ik
FN LANE viscous_push(LANE closeness, LANE r2, LANE vx, const ViscousConstants c)
{
    // a unit is some nanometres; 0/0 in a particle itself
    return -c.laminar * wendland_slope(closeness) * vx / (r2 + 1.0f);
}

/// Share of one neighbour in S, without its factor; the neighbour has the same share of it.
/// @param slope  kernel_slope of the pair   @param u, v, w  v_ik   @param x, y, z  x_ik
FN Symmetric strain_moment(LANE slope, LANE u, LANE v, LANE w, LANE x, LANE y, LANE z)
{
    Symmetric s;
    LANE half = 0.5f * slope;
    s.xx = slope * u * x;
    s.yy = slope * v * y;
    s.zz = slope * w * z;
    s.xy = half * (u * y + v * x);
    s.xz = half * (u * z + w * x);
    s.yz = half * (v * z + w * y);
    return s;
}

/// tau/rho^2 [Pa m^6/kg^2] of the rate of strain [1/s].
FN Symmetric eddy_stress(Symmetric s, const ViscousConstants c)
{
    LANE sides = s.xy * s.xy + s.xz * s.xz + s.yz * s.yz;
    LANE square = 2.0f * (s.xx * s.xx + s.yy * s.yy + s.zz * s.zz) + 4.0f * sides;
    LANE twice = 2.0f * c.eddy * lane_sqrt(square);
    LANE even = (s.xx + s.yy + s.zz) * (1.0f / 3.0f);
    Symmetric t;
    t.xx = twice * (s.xx - even) - c.pressing * square;
    t.yy = twice * (s.yy - even) - c.pressing * square;
    t.zz = twice * (s.zz - even) - c.pressing * square;
    t.xy = twice * s.xy;
    t.xz = twice * s.xz;
    t.yz = twice * s.yz;
    return t;
}

#endif
