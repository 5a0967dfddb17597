/// Everything that changes while a simulation runs; one arena.
#ifndef FAIRLEAD_STATE_H
#define FAIRLEAD_STATE_H

#include <stdint.h>

#include "backend/backend.h"
#include "base/arena.h"
#include "base/error.h"
#include "body.h"
#include "command.h"
#include "line_ledger.h"
#include "line_watch.h"
#include "plan.h"
#include "slamming.h"
#include "wave_quality.h"
#include "waves.h"

/// What went wrong, where, when, against which limit; see health.h.
typedef struct HealthRecord {
    HealthStatus status;
    char message[256];  ///< effect, particle or node, time, value and violated limit
    int recoveries;     ///< roll-backs so far
    int lost;           ///< particles beyond the walls now
    int tries;          ///< halvings of the step now in force
    int good_intervals; ///< checkpoints since the last roll-back
} HealthRecord;

/// A copy of everything that changes, taken while all was well.
typedef struct Checkpoint {
    double time; ///< NAN before the first one
    int64_t step;
    WaveState *waves;
    WaveQuality *quality;
    double line_work;
    Body *bodies;
    double **lines; ///< line_state_save of each
    Slamming *slammings;
    LineWatch *watches;
    LineOrder *orders;
    LineLedger *ledger;
    void *particles; ///< Backend.save
} Checkpoint;

/// Energies [J], per metre in 2-D; see energy.h.
typedef struct EnergyLevels {
    double kinetic, potential, compressible; ///< of the water
    double bodies, lines;
} EnergyLevels;

typedef struct State {
    double time; ///< simulated [s]
    int64_t step;
    double time_step;     ///< in use now [s]
    WaveState *waves;     ///< NULL without waves
    WaveQuality *quality; ///< NULL where nobody asks
    Body *bodies;         ///< [scene->body_count]
    Mooring mooring;      ///< lines and the points that join them
    Line *lines;          ///< mooring.lines
    Slamming *slammings;  ///< [scene->slamming_count]
    LineWatch *watches;   ///< [scene->line_count]
    LineOrder *orders;    ///< [scene->line_count]
    LineEvents *events;   ///< of all lines; NULL without lines
    LineLedger *ledger;   ///< what they exchange with bodies; NULL without lines
    HealthRecord health;
    double wall_time;                            ///< spent in step_advance [s]
    double smallest_step, largest_step;          ///< used so far [s]
    double density_error, largest_density_error; ///< |rho/rho0 - 1| now and so far [-]
    double largest_speed;                        ///< of the fluid now [m/s]
    double effect_seconds[EFFECT_COUNT];         ///< wall time spent in each effect so far [s]
    double base_seconds;                         ///< pressure forces, integration, sorting [s]
    const BackendTable *backend;                 ///< functions of the particles' machine
    Backend *particles;                          ///< owned by the backend
    BodyLoad *loads;                             ///< of the last forces call [body_count]
    BodyPose *poses;                             ///< at the end of the step [body_count]
    Vec3 *centres;                               ///< of gravity [body_count]
    double line_work;                            ///< done on bodies by lines [J], for a budget
    EnergyLevels energy_start;                   ///< at t = 0, where the case asks for it
    Checkpoint checkpoint;                       ///< the last good state, for roll-back
    double host_seconds[EFFECT_COUNT];           ///< of them, in passes on the host [s]
    double pair_cost[6]; ///< shares in their sweeps of artificial viscosity, diffusion, corrected
                         ///< gradients, laminar viscosity, turbulence, no slip [-]
    Arena arena;
} State;

/// Fill tank, carve bodies, start lines and waves; everything a step needs is allocated here.
bool state_create(const Scene *scene, const Plan *plan, State **state, Error *error);
void state_destroy(State *state);

#endif
