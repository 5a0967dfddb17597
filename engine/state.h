/// Everything that changes while a simulation runs; one arena.
#ifndef FAIRLEAD_STATE_H
#define FAIRLEAD_STATE_H

#include <stdint.h>

#include "base/arena.h"
#include "base/error.h"
#include "body.h"
#include "plan.h"
#include "waves.h"

/// What went wrong, where, when, against which limit; see health.h.
typedef struct HealthRecord {
    HealthStatus status;
    char message[256]; ///< effect, particle or node, time, value and violated limit
    int recoveries;    ///< roll-backs so far
} HealthRecord;

typedef struct State {
    double time; ///< simulated [s]
    int64_t step;
    double time_step; ///< in use now [s]
    WaveState waves;
    Body *bodies; ///< [scene->body_count]
    Line *lines;  ///< [scene->line_count]
    HealthRecord health;
    double wall_time;                            ///< spent in step_advance [s]
    double smallest_step, largest_step;          ///< used so far [s]
    double density_error, largest_density_error; ///< |rho/rho0 - 1| now and so far [-]
    double largest_speed;                        ///< of the fluid now [m/s]
    double effect_seconds[EFFECT_COUNT];         ///< wall time spent in each effect so far [s]
    double base_seconds;                         ///< pressure forces, integration, sorting [s]
    Arena arena;
} State;

/// Fill tank, carve bodies, start lines and waves; everything a step needs is allocated here.
bool state_create(const Scene *scene, const Plan *plan, State **state, Error *error);
void state_destroy(State *state);

#endif
