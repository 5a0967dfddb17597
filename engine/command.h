/// Live changes: every one is a Command, checked against the case's limits, stamped with its
/// simulation time in the journal, so that a live session can be replayed headless.
#ifndef FAIRLEAD_COMMAND_H
#define FAIRLEAD_COMMAND_H

#include <stdbool.h>

#include "base/error.h"
#include "scene.h"

/// A wanted sea; NAN leaves a value as it was asked last.
typedef struct Command {
    double wave_height;  ///< [m]
    double wave_period;  ///< [s]
    double wave_heading; ///< [rad]
} Command;

Command command_default(void);

/// Refuse values outside the case's limits, naming wave.height_m, value and range; fills `target`
/// with the complete sea asked for (the gaps from `last`).
bool command_check(const Scene *scene, const Command *command, const WaveTarget *last,
                   WaveTarget *target, Error *error);

#endif
