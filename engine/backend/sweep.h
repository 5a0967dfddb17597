/// The neighbour sweeps: loops of physics/pair.h over lists of clusters. cpu_sweep.c is compiled
/// once per instruction level; each build exports one SweepTable and the best one is chosen at
/// start.
#ifndef FAIRLEAD_BACKEND_SWEEP_H
#define FAIRLEAD_BACKEND_SWEEP_H

#include "backend/particles.h"

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
} Sweep;

typedef struct SweepTable {
    const char *level; ///< "x86-64-v3" …
    /// Visit bits of clusters begin..end of `a`: clusters of `b` within the reach [unit^2].
    void (*prune)(ClusterList *list, const ParticleSet *a, const ParticleSet *b, int begin, int end,
                  float reach_squared);
    /// Acceleration sums of fluid clusters begin..end into fluid->rate, by mask; adds to the rates
    /// of clusters in the own and the next slab.
    void (*acceleration[2])(const Sweep *, int begin, int end);
    /// Density sums into fluid->rate[0].
    void (*density[2])(const Sweep *, int begin, int end);
    /// Pressure of dummy clusters begin..end of walls[set] from the fluid around them.
    void (*extrapolate)(const Sweep *, int set, int begin, int end);
    /// Sums of the fluid's push on the body dummies of walls[1] into their rate.
    void (*loads)(const Sweep *, int begin, int end);
} SweepTable;

#if defined(__x86_64__)
const SweepTable *sweep_table_v2(void);
const SweepTable *sweep_table_v3(void);
const SweepTable *sweep_table_v4(void);
#else
const SweepTable *sweep_table_native(void);
#endif
/// The best table this processor runs. FAIRLEAD_LEVEL=x86-64-v2|v3|v4 asks for a lower one.
const SweepTable *sweep_table_choose(void);

#endif
