/// What the simulation thread tells about itself, copied under a lock.
#ifndef FAIRLEAD_STATUS_H
#define FAIRLEAD_STATUS_H

#include "engine.h"

typedef enum RunState { RUN_RUNNING, RUN_PAUSED, RUN_FAILED } RunState;

/// One line, as the page's controls show it.
typedef struct LineStatus {
    double length;  ///< unstretched now [m]
    double asked;   ///< of its winch [m]; NAN = nothing yet
    double largest; ///< tension so far [N]
    bool parted;
} LineStatus;

typedef struct SessionStatus {
    double time; ///< simulated [s]
    RunState state;
    double speed; ///< simulated seconds per second of wall time [-]
    int64_t step;
    double time_step; ///< [s]
    double particle_steps_per_second;
    double density_error; ///< largest |rho/rho0 - 1| now [-]
    HealthStatus health;
    char health_message[768];
    bool has_waves;
    WaveTarget wave_asked, wave_now;
    bool wave_changing;
    int line_count;
    LineStatus lines[SCENE_LINES_MAX];
    int share_count;
    EffectShare shares[EFFECT_COUNT + 1]; ///< active effects and "base", of a step's wall time
} SessionStatus;

#endif
