/// Sick physics: found after every step, rolled back to the last good checkpoint, tried again with
/// a smaller step, reported with particle, time and limit.
#ifndef FAIRLEAD_HEALTH_H
#define FAIRLEAD_HEALTH_H

#include "state.h"

/// Limits that a healthy run never touches.
static const double HEALTH_EXCESS_LIMIT = 0.25;    ///< |rho/rho0 - 1| [-]
static const double HEALTH_SPEED_LIMIT = 0.6;      ///< fluid speed over sound speed [-]
static const double HEALTH_CHECKPOINT_EVERY = 0.1; ///< simulated time between checkpoints [s]
static const double HEALTH_LOST_LIMIT = 0.01;      ///< particles beyond the walls, of all [-]
enum {
    HEALTH_TRIES = 4,    ///< halvings of the step
    HEALTH_PATIENCE = 5, ///< healthy checkpoints per roll-back before the step grows again
};

/// Take a checkpoint when the last is old enough.
void health_checkpoint(const Scene *scene, State *state);

/// Judge the step just made (`sums` NULL: it failed with `error`); update the state's health
/// figures; roll back when it is sick.
/// @return false with ERROR_PHYSICS when HEALTH_TRIES roll-backs did not cure it
bool health_judge(const Scene *scene, const Plan *plan, State *state, const ParticleSums *sums,
                  Error *error);

#endif
