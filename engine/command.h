/// Live changes: every one is a Command, checked against the case's limits, stamped with its
/// simulation time in the journal, so that a live session can be replayed headless.
#ifndef FAIRLEAD_COMMAND_H
#define FAIRLEAD_COMMAND_H

#include <stdbool.h>

#include "base/error.h"
#include "scene.h"

/// Where a line is cut.
typedef enum LineCut { CUT_NOWHERE = -1, CUT_ANCHOR, CUT_MIDDLE, CUT_FAIRLEAD } LineCut;

/// A wanted sea, or what is to happen to a line; NAN leaves a value as it was asked last.
typedef struct Command {
    double wave_height;         ///< [m]
    double wave_period;         ///< [s]
    double wave_heading;        ///< [rad]
    char line[SCENE_NAME_SIZE]; ///< name of a line; "" = the command is about the sea
    double line_length;         ///< unstretched, of the whole line [m]
    int line_cut;               ///< LineCut
} Command;

/// What was asked of a line since the start; outlives a roll-back.
typedef struct LineOrder {
    double length; ///< [m]; NAN = none
    int cut;       ///< LineCut
} LineOrder;

Command command_default(void);

/// Refuse values outside the case's limits, naming wave.height_m, value and range; fills `target`
/// with the complete sea asked for (the gaps from `last`).
bool command_check(const Scene *scene, const Command *command, const WaveTarget *last,
                   WaveTarget *target, Error *error);

/// The same for a command about a line: refuses names, lengths beyond the line's winch, and cutting
/// twice. @param orders  [line_count]  @param line  filled: index into scene.lines
bool command_check_line(const Scene *scene, const Command *command, const LineOrder *orders,
                        int *line, Error *error);

#endif
