/// What the engine asks of a machine that moves particles: one table of functions per backend. The
/// backend owns the particles; the engine owns time, waves, bodies and lines.
///
/// A step is: forces → (bodies and lines advance on the host) → advance.
/// Time stepping (leapfrog of velocity and density, each pair sum evaluated once a step):
///     v^{n+1/2} = v^{n-1/2} + dt a(x^n, rho^n)
///     x^{n+1/2} = x^n + dt/2 v^{n+1/2};  rho^{n+1} = rho^n + dt (drho/dt)(x^{n+1/2}, v^{n+1/2})
///     x^{n+1}   = x^{n+1/2} + dt/2 v^{n+1/2}
/// A prototype was stable to c0 dt/h of about 1.2; what is used and was tried: docs/performance.md.
#ifndef FAIRLEAD_BACKEND_H
#define FAIRLEAD_BACKEND_H

#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/error.h"
#include "base/portable.h"
#include "physics/kernel_kind.h"

/// Who moves a dummy particle; bodies are 0, 1, …
enum { OWNER_FIXED = -3, OWNER_PISTON = -2, OWNER_RING = -1 };

/// Bits of the pair effects in a sweep's mask.
enum {
    PAIR_VISCOSITY = 1 << 0, ///< artificial
    PAIR_DIFFUSION = 1 << 1,
    PAIR_GRADIENT = 1 << 2,   ///< not with the three below
    PAIR_LAMINAR = 1 << 3,    ///< molecular viscosity
    PAIR_TURBULENCE = 1 << 4, ///< with PAIR_LAMINAR: stresses of what is not resolved
    PAIR_NO_SLIP = 1 << 5,    ///< with PAIR_LAMINAR: dummies hold the water
    PAIR_SHIFTING = 1 << 6,
};

/// Where particles are at t = 0. All arrays are borrowed during create.
typedef struct ParticleStart {
    int fluid_count;
    const Vec3 *fluid_position; ///< [m]
    const Vec3 *fluid_velocity; ///< [m/s]
    const float *fluid_excess;  ///< rho/rho0 - 1 [-]
    int dummy_count;
    const Vec3
        *dummy_reference; ///< fixed: place; ring, piston: mean place; bodies: geometry axes [m]
    const int16_t *dummy_owner; ///< OWNER_… or a body's index
} ParticleStart;

typedef struct BackendSetup {
    int dimensions, threads, body_count;
    double flow[2];  ///< x, y: signs of the current that carries ring and water, 0 without
    double pitch[2]; ///< x, y: of the ring's lattice then [m]
    double room_min[3], room_max[3];       ///< all that coordinates must reach [m]
    double inside_min[3], inside_max[3];   ///< between the walls, above the bed [m]
    double barrier_min[3], barrier_max[3]; ///< planes of fixed walls and bed [m]; infinite = none
    double barrier_top;                    ///< z of the walls' upper edge [m]
    double spacing, smoothing_length, particle_mass; ///< [m], [m], [kg]
    Kernel kernel;                                   ///< of pressure, density and shifting
    double rest_density, sound_speed, alpha, delta;
    double viscosity;      ///< kinematic [m^2/s]
    double shifting;       ///< A of physics/shift.h [-]
    double gravity, level; ///< [m/s^2], still-water z [m]
    double largest_travel; ///< expected per step, for the skin [m]
    unsigned pair_mask;    ///< PAIR_… bits
    bool works;            ///< measure FluidWorks: every sweep thrice
} BackendSetup;

/// Force and moment of the fluid on a body; moment about `about` of the same call.
typedef struct BodyLoad {
    Vec3 force, moment; ///< [N], [N m], per metre in 2-D
} BodyLoad;

/// Pose of a body's geometry axes in the world.
typedef struct BodyPose {
    Vec3 origin;
    Quat attitude;
} BodyPose;

/// Targets of moving dummies: places at `time` of points whose mean places are given.
typedef void (*MovePoints)(const void *context, double time, int count, const Vec3 *mean,
                           Vec3 *place);
/// Velocities the relaxation zone aims at, float arrays [count], metres and m/s.
typedef void (*ZoneVelocity)(const void *context, double time, int count, const float *x,
                             const float *y, const float *z, float *u, float *v, float *w);

/// Distance of a point in a body's geometry axes from its skin [m], negative inside.
typedef double (*SkinDistance)(const void *context, int body, Vec3 point);

/// A band along lateral sides in which velocities are drawn towards a target.
typedef struct RelaxationZone {
    double width;      ///< [m]; 0 = none
    double time_scale; ///< tau [s]
    double side_min[2],
        side_max[2];     ///< x, y of the sides from which distance counts [m]; +-1e30 = none
    ZoneVelocity target; ///< NULL = water at rest (a beach)
    int every;           ///< a row of particles is drawn at each so manieth step, for as long
} RelaxationZone;

typedef struct Advance {
    double time, dt;         ///< at the beginning of the step [s]
    int64_t step;            ///< its number
    const BodyPose *poses;   ///< at the end of the step [body_count]
    const void *hulls;       ///< context of `skin`
    SkinDistance skin;       ///< NULL without bodies
    const void *waves;       ///< context of the calls below
    MovePoints ring, piston; ///< NULL when not in the plan
    RelaxationZone zone;
    double drive[2];   ///< x, y: what the current gains, felt by all water [m/s^2]
    double carried[2]; ///< x, y: whole pitches by which it has carried the ring before [m]
    double passes[2];  ///< x, y: the one that becomes full in this step [m], or 0
} Advance;

/// What health asks after a step.
typedef struct ParticleSums {
    double largest_speed;                   ///< [m/s]
    double smallest_excess, largest_excess; ///< rho/rho0 - 1 [-]
    int sick;                               ///< id of a particle with a not-a-number, -1 = none
    int lost_count;                         ///< particles over a spacing beyond walls or bed
} ParticleSums;

/// Energies of the water, J, per metre in 2-D.
typedef struct FluidEnergy {
    double kinetic;
    double potential;    ///< above the coordinate z = 0
    double compressible; ///< of Tait's law, above that of water at rest density
} FluidEnergy;

/// Energy given to the water since creation, by what gave it [J]; what takes it counts negative.
typedef struct FluidWorks {
    double viscosity; ///< of every kind, friction on dummies included
    double diffusion;
    double ring, piston, bodies; ///< pressures of moving dummies times their velocities
    double walls;     ///< all else between water and dummies: slip through the extrapolation
    double zone;      ///< relaxation
    double shifting;  ///< lifting by particle shifting
    double current;   ///< of water that came in less that of what went out, and of the drive
    double limits;    ///< tension floor and barrier
    double pressure;  ///< of water on water: the error of stepping in time
    double last_kick; ///< kinetic energy that the last step gave [J]
} FluidWorks;

/// Wall time of the last forces + advance [s], by what it was spent on.
typedef enum BackendClock {
    CLOCK_SORT,
    CLOCK_EXTRAPOLATE,        ///< to fixed dummies
    CLOCK_EXTRAPOLATE_MOVING, ///< to moving ones
    CLOCK_GRADIENT,
    CLOCK_NO_SLIP,    ///< velocities that viscosity meets in dummies
    CLOCK_TURBULENCE, ///< strain and stress
    CLOCK_SHIFTING,
    CLOCK_MOMENTUM,
    CLOCK_DENSITY,
    CLOCK_LOADS,
    CLOCK_DUMMIES, ///< moving them, beside:
    CLOCK_RING,    ///< where the ring is to be
    CLOCK_PISTON,  ///< where the piston is to be
    CLOCK_INTEGRATE,
    CLOCK_ZONE,
    CLOCK_CONVEYOR, ///< water in and out
    CLOCK_WORKS,
    CLOCK_COUNT
} BackendClock;

/// What a bench asks; counting takes some tenths of a second.
typedef struct BackendStatistics {
    int fluid_count, dummy_count;
    double
        neighbours_fluid; ///< mean number of water neighbours of a water particle, itself not [-]
    double neighbours_dummy; ///< mean number of its dummy neighbours [-]
    int sample;              ///< water particles these means are taken over
    int64_t sorts;           ///< since creation, each with new neighbour lists
    size_t list_bytes;       ///< set aside for the lists, beside the arena [byte]
} BackendStatistics;

/// What makes a particle the worst of all.
typedef enum WorstBy { WORST_BY_SPEED, WORST_BY_EXCESS } WorstBy;

typedef struct Backend Backend; ///< opaque: the backend's own data

typedef struct BackendTable {
    const char *name;
    bool (*create)(const BackendSetup *setup, const ParticleStart *start, Arena *arena,
                   Backend **backend, Error *error);
    void (*destroy)(Backend *backend);
    /// The compiled sweep that this machine runs: "x86-64-v4" …
    const char *(*variant)(void);
    /// Put moving dummies where they are at advance->time (+ dt 0); call once before the first
    /// step.
    void (*place)(Backend *backend, const Advance *advance);
    /// Sums of accelerations at the present places; fluid loads on bodies about `about`.
    bool (*forces)(Backend *backend, const Vec3 *about, BodyLoad *loads, Error *error);
    void (*advance)(Backend *backend, const Advance *advance, ParticleSums *sums);
    /// The fastest particle, or the one that pushes farthest off rest density: its place [m].
    /// @return its id, -1 without particles
    int (*worst)(const Backend *backend, WorstBy by, Vec3 *place);
    /// Fluid in the order of creation, world positions; any pointer may be NULL.
    void (*download)(Backend *backend, float (*position)[3], float (*velocity)[3], float *pressure);
    /// Highest z at which the water's colour function crosses one half above (x, y); NAN if dry
    /// [m].
    double (*elevation)(Backend *backend, double x, double y);
    /// Shepard-interpolated pressure at a point [Pa]; 0 where dry. A `normal` other than zero looks
    /// only at the water on its side.
    double (*pressure)(Backend *backend, Vec3 point, Vec3 normal);
    /// Shepard-interpolated velocity of the water at a point [m/s], and its share of the room there
    /// [-], about one half at the surface.
    void (*velocity)(Backend *backend, Vec3 point, Vec3 *velocity, double *share);
    /// Water at `count` points evenly from `from` to `to`: its share of the room that dummies leave
    /// [-], about one half at the surface.
    void (*wetness)(Backend *backend, Vec3 from, Vec3 to, int count, double *share);
    /// Volume of water [m^3] in count[0] x count[1] columns of a box min … max that moves with
    /// `pose`; x fastest.
    void (*columns)(const Backend *backend, const BodyPose *pose, Vec3 min, Vec3 max,
                    const int count[2], double *volume);
    FluidEnergy (*energy)(const Backend *backend);
    FluidWorks (*works)(const Backend *backend); ///< zero unless asked for at creation
    /// Everything that changes, for roll-back.
    size_t (*state_size)(const Backend *backend);
    void (*save)(const Backend *backend, void *to);
    void (*restore)(Backend *backend, const void *from);
    const double *(*clocks)(const Backend *backend); ///< [CLOCK_COUNT] sums since creation [s]
    void (*statistics)(const Backend *backend, BackendStatistics *statistics);
    /// Relative extra time of a pair effect's bit in its sweep, measured on the present state [-].
    double (*pair_cost)(Backend *backend, unsigned bit);
    /// Acceleration [m/s^2] and (drho/dt)/rho0 [1/s] of each particle, in order of creation; for
    /// tests.
    bool (*probe_rates)(Backend *backend, float (*acceleration)[3], float *density_rate,
                        Error *error);
} BackendTable;

/// The table for "auto", "cpu" or "cuda". @return NULL with ERROR_INPUT when it is not there
const BackendTable *backend_choose(const char *name, Error *error);
const BackendTable *backend_cpu(void);
const BackendTable *backend_none(void); ///< for a domain without particles
const BackendTable *backend_cuda(void); ///< NULL where CUDA was not built

#endif
