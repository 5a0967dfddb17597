/// The commands of a journal, given again at their simulated times.
#ifndef FAIRLEAD_REPLAY_H
#define FAIRLEAD_REPLAY_H

#include "protocol.h"

typedef struct Replay {
    JournalCommand *commands; ///< owned, ascending in time
    int count, next;
} Replay;

/// @return false with ERROR_INPUT naming file and line
bool replay_load(const char *path, Replay *replay, Error *error);
void replay_destroy(Replay *replay);

/// The next command that is due before the step that begins at `time`; NULL when none is.
const JournalCommand *replay_next(Replay *replay, double time, double time_step);

#endif
