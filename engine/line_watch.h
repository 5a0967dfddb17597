/// What happens to mooring lines and is told in words: snaps and breaks. A snap is a line that was
/// as good as slack and is suddenly taut:
///
///     the tension of the last segment exceeds twice what it is at rest, and ten times the least it
///     was within the last sqrt(L/g); the event is the peak that follows, one in a sqrt(L/g).
///
/// Source of the tenth: DNV-RP-H103 (2011), 4.4, asks for a margin of a tenth of the load against
/// slack slings. (chosen) Twice, and the time, which scales as the waves do.
#ifndef FAIRLEAD_LINE_WATCH_H
#define FAIRLEAD_LINE_WATCH_H

#include <stdint.h>

#include "mooring.h"

enum { LINE_EVENTS_KEPT = 64, LINE_WATCH_BINS = 8 };

typedef enum LineEventKind { LINE_SNAPPED, LINE_BROKE } LineEventKind;

typedef struct LineEvent {
    LineEventKind kind;
    int line;       ///< index into scene.lines
    double time;    ///< of the peak or the break [s]
    double tension; ///< peak of the last segment, or that which broke the line [N]
} LineEvent;

/// One line's history, as far as it decides what happens next. Part of a checkpoint.
typedef struct LineWatch {
    double rest;      ///< tension of the last segment at rest [N], at least a segment's weight
    double rise_time; ///< sqrt(L/g) [s]
    double least[LINE_WATCH_BINS]; ///< tension in each eighth of the rise time before now [N]
    double bin_end;                ///< of the present eighth [s]
    int bin;                       ///< the present one's index
    bool snapping;                 ///< the peak is not yet over
    double peak, peak_time;        ///< of the snap going on [N], [s]
    double snap_time;              ///< of the last one [s], -INFINITY before the first
    int parted;                    ///< segments, at the last look
    double strongest;              ///< tension of any segment at the last look [N]
    int snaps;                     ///< so far
} LineWatch;

/// The last events of all lines; grows for ever, keeps LINE_EVENTS_KEPT.
typedef struct LineEvents {
    int64_t count;
    LineEvent kept[LINE_EVENTS_KEPT]; ///< event i at i % LINE_EVENTS_KEPT
} LineEvents;

/// @param line  at rest, as line_create leaves it
LineWatch line_watch_create(const Line *line, const WaterField *water);

/// Below this a segment of the line counts as slack [N].
double line_watch_slack(const LineWatch *watch);

/// Look at a line after a step that ended at `time`.
void line_watch_step(LineWatch *watch, const Line *line, int index, double time,
                     LineEvents *events);

/// Keep an event, unless it is a snap that was kept before the state was rolled back.
void line_events_add(LineEvents *events, const LineWatch *watch, const LineEvent *event);

/// The next event after *seen, which moves on. @return NULL when there is none
const LineEvent *line_events_next(const LineEvents *events, int64_t *seen);

#endif
