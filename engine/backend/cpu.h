/// The CPU backend's own data; private to backend/cpu*.c.
#ifndef FAIRLEAD_BACKEND_CPU_H
#define FAIRLEAD_BACKEND_CPU_H

#include "backend/backend.h"
#include "backend/sweep.h"

struct Backend {
    BackendSetup setup;
    Grid grid;
    double skin;
    float excess_floor; ///< least density excess [-]
    ParticleSet fluid, fixed, moving;
    ClusterList fluid_fluid, fluid_fixed, fluid_moving, fixed_fluid, moving_fluid;
    Vec3 *moving_reference; ///< by id
    int16_t *moving_owner;  ///< by id
    int32_t *histogram;
    const SweepTable *table;
    Sweep sweep;
    int32_t inside_min[3], inside_max[3]; ///< a spacing beyond the walls [unit]
    int32_t barrier_min[3], barrier_max[3], barrier_top, barrier_depth; ///< [unit]
    bool sorted;                                                        ///< lists hold
    double travel_fluid, travel_moving;                                 ///< since the last sort [m]
    double step_travel; ///< of the last step, both together [m]
    bool first_step;    ///< dummies have no velocity yet
    int64_t sorts;
    double clock[CLOCK_COUNT];
};

double cpu_clock(void);
/// Sort fluid and moving dummies and rebuild all lists when the skin is used up.
bool cpu_neighbours(Backend *backend, Error *error);
/// Slab by slab, even ones first, then odd ones: each slab writes to itself and the next.
void cpu_sweep_fluid(Backend *backend, void (*function)(const Sweep *, int, int));
void cpu_place(Backend *backend, const Advance *advance);
void cpu_advance(Backend *backend, const Advance *advance, ParticleSums *sums);
void cpu_update_pressure(Backend *backend);
void cpu_download(Backend *backend, float (*position)[3], float (*velocity)[3], float *pressure);
double cpu_elevation(Backend *backend, double x, double y);
double cpu_pressure(Backend *backend, Vec3 point);
void cpu_statistics(const Backend *backend, BackendStatistics *statistics);
/// D = excess less the hydrostatic one at the present height; zero for padding.
void cpu_update_dynamic(Backend *backend);

#endif
