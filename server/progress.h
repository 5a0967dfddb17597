/// How far a run is: a bar with the time left on a terminal, a line every few seconds elsewhere.
#ifndef FAIRLEAD_PROGRESS_H
#define FAIRLEAD_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

typedef struct Progress {
    FILE *out; ///< NULL = quiet
    bool terminal;
    double until;             ///< simulated time at the end [s]
    double began_at, told_at; ///< [s]
} Progress;

Progress progress_begin(FILE *out, bool quiet, double until);
/// Call after every step: it prints now and then only.
void progress_update(Progress *progress, double time, long long step);
void progress_end(Progress *progress, double time, long long step);

/// "1 h 02 min", "3 min 20 s", "12 s" for a duration [s].
void progress_format_duration(double seconds, char *text, int size);

#endif
