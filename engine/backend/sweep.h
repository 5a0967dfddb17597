/// The neighbour sweeps: loops of physics/pair.h over lists of clusters. cpu_gradient.c,
/// cpu_near.c, cpu_shift.c, cpu_step.c, cpu_sweep.c and cpu_viscous.c are compiled once per
/// instruction level and kernel; each build exports one SweepTable, and the case's kernel at the
/// best level is chosen at start.
#ifndef FAIRLEAD_BACKEND_SWEEP_H
#define FAIRLEAD_BACKEND_SWEEP_H

#include "backend/particles.h"
#include "physics/shift.h"
#include "physics/viscous.h"

typedef struct Sweep {
    ParticleSet *fluid;
    ParticleSet *walls[2];            ///< fixed, moving dummies; count 0 when absent
    const ClusterList *fluid_fluid;   ///< half list
    const ClusterList *fluid_wall[2]; ///< full
    const ClusterList *wall_fluid[2]; ///< full
    const int16_t *moving_owner;      ///< by id: body index, or -1 for the ring or piston
    SweepConstants constants;
    float gravity[3];   ///< [m/s^2]
    float tait_b;       ///< c0^2 rho0/7 [Pa]
    float rest_density; ///< [kg/m^3]
    float unit;         ///< [m]
    int dimensions;
    float moment_factor; ///< of M, summed with lengths over 2h: 4 h^2 K V [-]
    ViscousConstants viscous;
    ShiftConstants shift;
} Sweep;

/// Of clusters begin..end.
typedef void (*SweepFunction)(const Sweep *, int begin, int end);

/// Variants of momentum with molecular viscosity: 1 artificial viscosity too, 2 turbulence, 4 walls
/// that hold the water.
enum { VISCOUS_VARIANTS = 8 };

struct Backend;
struct Advance;
struct ParticleSums;

typedef struct SweepTable {
    const char *level;                                       ///< "x86-64-v3" …
    void (*place)(struct Backend *, const struct Advance *); ///< as in backend.h
    void (*advance)(struct Backend *, const struct Advance *, struct ParticleSums *);
    void (*update_pressure)(struct Backend *); ///< P from the density excess
    /// D = diffusion (excess less the hydrostatic one at the present height); zero for padding.
    void (*update_dynamic)(struct Backend *);
    /// Clusters begin..end of `b` whose boxes lie within the reach [unit^2] of box i of `a`: their
    /// numbers into `entry` [room], or only their count when NULL. @return how many, at most room
    int (*near_clusters)(const Boxes *a, int i, const Boxes *b, int begin, int end,
                         float reach_squared, uint32_t *entry, int room);
    /// Visit bits of clusters begin..end of `a`: clusters of `b` whose boxes, or with `exact` one
    /// of whose particles, are within the reach [unit^2].
    void (*prune)(ClusterList *list, const ParticleSet *a, const ParticleSet *b, int begin, int end,
                  float reach_squared, bool exact);
    /// Acceleration sums of the fluid into fluid->rate, by mask (cpu_acceleration); adds to the
    /// rates of clusters in the own and the next slab.
    SweepFunction acceleration[4];
    const SweepFunction *viscous; ///< the same with molecular viscosity [VISCOUS_VARIANTS]
    /// Density sums into fluid->rate[0].
    SweepFunction density[2];
    /// Pressure of dummy clusters begin..end of walls[set] from the fluid around them.
    void (*extrapolate)(const Sweep *, int set, int begin, int end);
    /// Sums of the fluid's push on the body dummies of walls[1] into their rate: with plain
    /// gradients, with corrected ones, and with those of viscosity.
    SweepFunction loads[3];
    /// Moments of the fluid's neighbours into fluid->correction, which was zero, like the
    /// accelerations; and their inverses, cluster by cluster.
    SweepFunction moments, invert;
    /// Velocities that viscosity meets in clusters begin..end of walls[set].
    void (*mirror)(const Sweep *, int set, int begin, int end);
    /// Rates of strain into fluid->stress, which was zero, like the accelerations; and the stresses
    /// they make, cluster by cluster.
    SweepFunction strain, stress;
    /// Sums of concentration and fullness into fluid->shift, which was zero, like the
    /// accelerations; and the velocities they make, cluster by cluster.
    SweepFunction shift_sums, shift_velocities;
} SweepTable;

// Files compiled once per level name what they export after it, and those compiled once per level
// and kernel after both: step_place_v3, sweep_table_v3_wendland …
#if defined(SWEEP_SUFFIX)
#define AT_LEVEL_JOIN(name, suffix) name##_##suffix
#define AT_LEVEL_EXPAND(name, suffix) AT_LEVEL_JOIN(name, suffix)
#define AT_LEVEL(name) AT_LEVEL_EXPAND(name, SWEEP_SUFFIX)
void AT_LEVEL(step_place)(struct Backend *, const struct Advance *);
void AT_LEVEL(step_advance)(struct Backend *, const struct Advance *, struct ParticleSums *);
void AT_LEVEL(step_update_pressure)(struct Backend *);
void AT_LEVEL(step_update_dynamic)(struct Backend *);
int AT_LEVEL(near_clusters)(const Boxes *a, int i, const Boxes *b, int begin, int end,
                            float reach_squared, uint32_t *entry, int room);
void AT_LEVEL(near_prune)(ClusterList *list, const ParticleSet *a, const ParticleSet *b, int begin,
                          int end, float reach_squared, bool exact);
#if defined(SWEEP_KERNEL_NAME)
#define AT_KERNEL(name) AT_LEVEL_EXPAND(AT_LEVEL(name), SWEEP_KERNEL_NAME)
void AT_KERNEL(gradient_moments)(const Sweep *, int begin, int end);
void AT_KERNEL(gradient_invert)(const Sweep *, int begin, int end);
void AT_KERNEL(gradient_plain)(const Sweep *, int begin, int end);
void AT_KERNEL(gradient_viscous)(const Sweep *, int begin, int end);
void AT_KERNEL(gradient_loads)(const Sweep *, int begin, int end);
extern const SweepFunction AT_KERNEL(viscous_forces)[VISCOUS_VARIANTS];
void AT_KERNEL(viscous_loads)(const Sweep *, int begin, int end);
void AT_KERNEL(viscous_mirror)(const Sweep *, int set, int begin, int end);
void AT_KERNEL(viscous_strain)(const Sweep *, int begin, int end);
void AT_KERNEL(viscous_stress)(const Sweep *, int begin, int end);
void AT_KERNEL(shift_sums)(const Sweep *, int begin, int end);
void AT_KERNEL(shift_velocities)(const Sweep *, int begin, int end);
#endif
#endif

/// The best table this processor runs. FAIRLEAD_LEVEL=x86-64-v2|v3|v4 asks for a lower one.
const SweepTable *sweep_table_choose(Kernel kernel);

/// Which list to build: clusters of `b` within reach of each cluster of `a`.
typedef struct ListOrder {
    ClusterList *list;
    const ParticleSet *a, *b;
    const Grid *grid;
    bool half; ///< a == b, each pair once, own cluster left out
    int (*near_clusters)(const Boxes *a, int i, const Boxes *b, int begin, int end,
                         float reach_squared, uint32_t *entry, int room);
} ListOrder;

/// Grows the list when needed. @return false when memory is exhausted
bool list_build(const ListOrder *order, int threads);

#endif
