/// How many pictures the solver can afford. Solver and pictures share the cores, so what a picture
/// costs is counted in processor time, and pictures are spaced so that they take a stated share of
/// all cores:
///
///     paid_at = max(paid_at, begin) + cost / (share * cores)
///
/// is when a picture is paid for, and the next one waits for that. On either side of the rule:
/// whoever looks gets a picture a second at least, and nobody more than 30. A new view (a dragged
/// camera) is answered at once while pictures are owing less than a second; what is drawn ahead is
/// waited for afterwards, so the share holds over every few seconds. While the solver rests,
/// pictures cost it nothing.
#ifndef FAIRLEAD_PACE_H
#define FAIRLEAD_PACE_H

#include <stdbool.h>

/// What the pictures may take of all cores' time [-]. It leaves two cores 0.90 of their bare speed,
/// a client on the same cores included (docs/performance.md).
#define PACE_SHARE 0.075

/// One watcher's or many watchers': pictures are drawn once for all.
typedef struct Pace {
    double begun_at; ///< begin of the last picture [s of wall time]
    double paid_at;  ///< when the pictures so far are paid for [s of wall time]
} Pace;

/// A picture was drawn.
/// @param begin    when it began [s]
/// @param cost     processor time of all threads that drew it [s]
/// @param cores    cores that solver and pictures share
/// @param running  the solver runs
void pace_drawn(Pace *pace, double begin, double cost, int cores, bool running);

/// @param new_view  the view has changed since the last picture
/// @return earliest begin of the next picture [s of wall time]
double pace_next(const Pace *pace, bool running, bool new_view);

#endif
