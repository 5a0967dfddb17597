/// The CPU backend's own data; private to backend/cpu*.c.
#ifndef FAIRLEAD_BACKEND_CPU_H
#define FAIRLEAD_BACKEND_CPU_H

#include "backend/backend.h"
#include "backend/sweep.h"
#include "physics/fluid.h"

/// Velocities that occur in a row: of water, moving dummies and, as zero, fixed dummies [m/s].
typedef struct VelocitySpan {
    float min[3], max[3]; ///< min > max: nobody there
} VelocitySpan;

/// Bounds on the relative motion of neighbours, by row [row_count].
typedef struct Rows {
    VelocitySpan *span;
    float *speed;   ///< at which particles of the row and of those around it part [m/s]
    float *stretch; ///< how far they have parted since the visit bits were written [m]
    float *margin;  ///< how far they may [m]
    float *total;   ///< since the sort [m]
    float spacing, least_margin; ///< [m]
} Rows;

bool rows_create(Rows *rows, const Grid *grid, Arena *arena, Error *error);
/// Lists are new, bits have to be written.
void rows_sorted(Rows *rows, const Grid *grid);
/// Begin a row's span: zero where fixed dummies are, else empty.
void rows_note_rest(Rows *rows, const ParticleSet *fixed, int row);
/// Widen a row's span by the velocities of a set.
void rows_note_velocity(Rows *rows, const ParticleSet *set, int row);
void rows_measure(Rows *rows, const Grid *grid, int threads);
/// Everybody moves for dt [s].
void rows_move(Rows *rows, const Grid *grid, double dt);
/// Whether the lists serve another step.
bool rows_lists_hold(const Rows *rows, const Grid *grid, double dt, double skin);
bool rows_due(const Rows *rows, int row); ///< bits of the row have to be written
/// How bits are to be written.
typedef struct RowPruning {
    float margin; ///< [m]
    bool exact;   ///< by particles, not by boxes
} RowPruning;

/// Bits of the row are about to be written.
RowPruning rows_pruned(Rows *rows, int row, double dt, double skin);

/// Power of moving dummies on the water by owner [W].
typedef struct MovingPower {
    double ring, piston, bodies;
} MovingPower;

/// What measuring works keeps; see cpu_works.c. Arrays are [slot_capacity of the fluid].
typedef struct Works {
    FluidWorks sums;
    float *rate[3][3];  ///< of water on water, with walls, with the pair effects; three axes
    float *velocity[3]; ///< before the kick, then after relaxation [m/s]
    float *excess;      ///< before the density step [-]
    int32_t *height;    ///< after the first half drift [unit]
    MovingPower power;  ///< with the velocities before the step
    int16_t *anybody;   ///< [moving] owners as if all were one body's
    ParticleSet *none;  ///< a set without particles
} Works;

/// What keeps water out of a body; saved with the state.
typedef struct HullHold {
    Vec3 min, max;      ///< of the hull, geometry axes [m]
    BodyPose pose;      ///< at the end of the last step
    int64_t impulse[6]; ///< of held water on the body and about the pose's origin, in quanta
} HullHold;

/// Where the ring's lattice ends upstream, along x and along y; private to cpu_conveyor.c.
typedef struct Conveyor {
    Vec3 *site[2]; ///< mean places of the last layer at t = 0 [site_count]
    int site_count[2];
} Conveyor;

struct Backend {
    BackendSetup setup;
    Grid grid;
    double skin;           ///< [m]
    float excess_floor;    ///< density excess at which water tears [-]
    SurfaceExcess surface; ///< what water at rest holds near its surface beyond hydrostatics
    float excess_alone;    ///< least that a particle can have [-]
    ParticleSet fluid, fixed, moving;
    ClusterList fluid_fluid, fluid_fixed, fluid_moving, fixed_fluid, moving_fluid;
    SortScratch scratch;
    Rows rows;
    char *meet;             ///< [slabs + 1][blocks + 2] what sweeps of slabs and blocks share
    Vec3 *moving_reference; ///< by id; the ring's go with the current
    int16_t *moving_owner;  ///< by id
    const SweepTable *table;
    Sweep sweep;
    int32_t inside_min[3], inside_max[3]; ///< a spacing beyond the walls [unit]
    int32_t barrier_min[3], barrier_max[3], barrier_top, barrier_depth; ///< [unit]
    bool sorted;                                                        ///< lists hold
    bool boxes_fresh; ///< of fluid and moving dummies
    double last_step; ///< [s]
    bool first_step;  ///< dummies have no velocity yet
    int64_t sorts;
    double clock[CLOCK_COUNT];
    HullHold *hulls; ///< [body_count]
    double strayed;  ///< farthest that water has gone since the sort [m]
    Works works;
    Conveyor conveyor;
};

double cpu_clock(void);

/// Speed at which water that has come behind a skin or the ring's face swims back [m/s]: to be
/// there within four calls, but no faster when steps are shortened, nor than a tenth of sound: one
/// particle that was swallowed five spacings deep was once hurled out at 0.6 of it, and the faster
/// the shorter the step. @param behind  [m]   @param every  between calls [s]
FN double speed_back(const Backend *b, double behind, double every)
{
    double c0 = b->setup.sound_speed, step = b->setup.smoothing_length / c0;
    return mind(behind / (4 * maxd(every, step)), 0.1 * c0);
}
/// Sort fluid and moving dummies and rebuild all lists when the skin is used up; write the visit
/// bits of rows whose margin is.
bool cpu_neighbours(Backend *backend, Error *error);
void cpu_prune(Backend *backend);
void cpu_refresh_boxes(Backend *backend); ///< when particles have moved since
/// A sweep over all clusters of the fluid, block by block of each slab.
void cpu_sweep_fluid(Backend *backend, SweepFunction function);
/// The momentum sweep of these PAIR_… bits.
SweepFunction cpu_acceleration(const Backend *backend, unsigned mask);
/// The sum of pushes on moving dummies, of these PAIR_… bits.
SweepFunction cpu_loads(const Backend *backend, unsigned mask);
/// Arrays of the pair effects.
bool pairs_create(Backend *backend, Arena *arena, Error *error);
/// Corrections of kernel gradients at the present places.
void pairs_correct_gradients(Backend *backend);
/// Velocities that viscosity meets in all dummies.
void pairs_mirror_velocities(Backend *backend);
/// Stresses of what is not resolved, at the present places and velocities.
void pairs_find_stresses(Backend *backend);
/// Velocities of particle shifting, at the present places and velocities.
void pairs_shift(Backend *backend);
/// Share of a pair effect's bit in its sweep; see backend.h.
double pairs_cost(Backend *backend, unsigned bit);
int cpu_worst(const Backend *backend, WorstBy by, Vec3 *place);
void cpu_download(Backend *backend, float (*position)[3], float (*velocity)[3], float *pressure);
double cpu_elevation(Backend *backend, double x, double y);
double cpu_pressure(Backend *backend, Vec3 point, Vec3 normal);
void cpu_velocity(Backend *backend, Vec3 point, Vec3 *velocity, double *share);
void cpu_wetness(Backend *backend, Vec3 from, Vec3 to, int count, double *share);
void cpu_columns(const Backend *backend, const BodyPose *pose, Vec3 min, Vec3 max,
                 const int count[2], double *volume);
/// After moving dummies are known.
bool hulls_create(Backend *backend, Arena *arena, Error *error);
/// Let water that came behind a skin in this step swim back. `fastest`: largest speed [m/s]
void hulls_hold(Backend *backend, const Advance *advance, double fastest);
/// What held water gave the bodies since it was last asked, as loads over the last step.
void hulls_give(Backend *backend, const Vec3 *about, BodyLoad *loads);
bool conveyor_create(Backend *backend, Arena *arena, Error *error);
/// Let a layer of water in and out, at the end of the step in which it has come.
void cpu_convey(Backend *backend, const Advance *advance);
bool works_create(Backend *backend, Arena *arena, Error *error);
void works_before_momentum(Backend *backend);
void works_after_forces(Backend *backend);
void works_before_kick(Backend *backend);
void works_after_kick(Backend *backend, const Advance *advance);
void works_after_density(Backend *backend);
void works_after_step(Backend *backend, double dt);
FluidEnergy cpu_energy(const Backend *backend);
void cpu_statistics(const Backend *backend, BackendStatistics *statistics);

#endif
