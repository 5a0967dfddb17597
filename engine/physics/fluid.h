/// Weakly compressible water: Tait's equation of state in the density excess s = rho/rho0 - 1.
/// Keeping s (not rho) in float preserves pressures of a few pascal under metres of water.
/// Source: Tait as used by Monaghan (1994), doi:10.1006/jcph.1994.1034; gamma = 7.
#ifndef FAIRLEAD_PHYSICS_FLUID_H
#define FAIRLEAD_PHYSICS_FLUID_H

#include "base/portable.h"
#include "kernel.h"

#define TAIT_GAMMA 7

/// p = b ((1 + s)^7 - 1), expanded so that small s keeps its digits.
/// @param s  density excess rho/rho0 - 1 [-]; b = c0^2 rho0 / 7 [Pa]   @return [Pa]
FN float tait_pressure(float s, float b)
{
    float t = 1.0f + s;
    float t2 = t * t;
    // (t^7 - 1)/(t - 1) = 1 + t + … + t^6
    float sum = 1.0f + t + t2 + t2 * t + t2 * t2 + t2 * t2 * t + t2 * t2 * t2;
    return b * s * sum;
}

/// Elastic energy per mass [J/kg] of water at density excess s: the integral of p/rho^2 drho from
/// rho0, (b/rho0) [(r^6 - 1)/6 + 1/r - 1] with r = 1 + s; its s^2 taken out so that small s keeps
/// its digits (c0^2 s^2/2 for s -> 0).
FN double tait_energy(double s, double b, double rest_density)
{
    double series = 21 + s * (35 + s * (35 + s * (21 + s * (7 + s))));
    return b / rest_density * s * s * series / (6 * (1 + s));
}

/// Density excess [-] below which water tears: it bears the tension of a column of h/2,
/// -g h/(2 c0^2). What is torn keeps its excess and pushes as at the limit: a particle that leaves
/// others loses the density that they summed up to, and must gain it again where it lands. Were
/// the excess itself limited, every landing would blow the water up: a dam break gained a tenth.
FN double tension_floor(double gravity, double h, double sound_speed)
{
    return -0.5 * gravity * h / (sound_speed * sound_speed);
}

/// The density excess that pushes. @param floor  of tension_floor
FN float tension_bearing(float s, float floor) { return s > floor ? s : floor; }

/// Excess of a particle without neighbours that began inside water: its own share of the sum, less
/// one [-]. Nothing can lose more. @param mass  [kg], per metre in 2-D
FN double excess_alone(Kernel kernel, double h, int dimensions, double mass, double rho0)
{
    return kernel_constant(kernel, h, dimensions) * mass / rho0 - 1.0;
}

/// tait_energy with the push limited at `floor`.
FN double tait_energy_torn(double s, double floor, double b, double rest_density)
{
    double bearing = s > floor ? s : floor, r = 1.0 + bearing;
    double push = (double)tait_pressure((float)bearing, (float)b) / (rest_density * r * r);
    return tait_energy(bearing, b, rest_density) + push * (s - bearing);
}

/// Inverse: s = (1 + p/b)^(1/7) - 1 [-], by its series; error below 1e-6 for p/b < 0.2.
FN float tait_excess(float p, float b)
{
    float x = p / b;
    return x * (1.0f / 7.0f +
                x * (-3.0f / 49.0f + x * (13.0f / 343.0f + x * (-65.0f / 2401.0f + x * 0.0209f))));
}

/// Density excess of water at rest, `below` metres under its surface (negative: above) [-].
FN double hydrostatic_excess(double below, double gravity, double sound_speed)
{
    double x = TAIT_GAMMA * gravity * below / (sound_speed * sound_speed);
    return x > -0.5 ? pow(1.0 + x, 1.0 / TAIT_GAMMA) - 1.0 : -0.1;
}

/// Head that water at rest holds beyond its depth d under a free surface is A (1 - d/1.5)^2, all in
/// smoothing lengths: the sum of pressures over pairs lacks those above the surface, and the rest
/// must make up for it. @return A = 0.215 - B (h/dp)^-4, not below 0, B = 0.6 with Wendland's
/// kernel: measured, to 0.01 spacings, at h/dp 1.5 to 3 in 2-D and 3-D; B = 1.25 with the yielding
/// one, to 0.03 spacings at h/dp 2 and 2.4, 0.06 at 1.6 (docs/physics.md)
FN double surface_head_most(Kernel kernel, double smoothing_ratio)
{
    double most = 0.215 - (kernel == KERNEL_YIELDING ? 1.25 : 0.6) * pow(smoothing_ratio, -4);
    return most > 0.0 ? most : 0.0;
}

/// That head at `below` smoothing lengths under the surface [-].
FN double surface_head(double below, double most)
{
    double left = 1.0 - below / 1.5;
    return left > 0.0 ? most * left * left : 0.0;
}

/// The same as a density excess, from the excess a particle at rest has itself.
typedef struct SurfaceExcess {
    float least, most; ///< at the surface and 1.5 h under it [-]
    float factor;      ///< of the squared distance to most
} SurfaceExcess;

/// With s = c0^2 excess/(g h) = d + A (1 - d/1.5)^2 what remains is 0.95 A [(1.5 - s)/(1.5 - A)]^2
/// to 0.006. @param scale  g h/c0^2   @param head  A
FN SurfaceExcess surface_excess_of(double scale, double head)
{
    SurfaceExcess e = {(float)(head * scale), (float)(1.5 * scale),
                       scale > 0 ? (float)(0.95 * head / ((1.5 - head) * (1.5 - head) * scale))
                                 : 0.0f};
    return e;
}

FN float surface_excess(float excess, SurfaceExcess e)
{
    float held = excess > e.least ? excess : e.least;
    float left = held < e.most ? e.most - held : 0.0f;
    return e.factor * left * left;
}

#endif
