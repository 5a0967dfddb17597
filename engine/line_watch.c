#include "line_watch.h"

#include <math.h>

static const double SLACK_SHARE = 0.1;  ///< see the header
static const double SNAP_SHARE = 2;     ///< (chosen) of the tension at rest
static const double RISE_FACTOR = 1;    ///< (chosen) of sqrt(L/g)
static const double FALLEN_SHARE = 0.5; ///< (chosen) of the peak: then the snap is over

LineWatch line_watch_create(const Line *line, const WaterField *water)
{
    const LineScene *scene = line->scene;
    double displaced = water->density * PI / 4 * scene->diameter * scene->diameter;
    double weight = fabs(scene->mass_per_length - displaced) * water->gravity;
    LineWatch watch = {0};
    watch.rest =
        maxd(line->tension[line->node_count - 2], weight * scene->length / scene->segments);
    watch.rise_time = RISE_FACTOR * sqrt(scene->length / water->gravity);
    watch.snap_time = -INFINITY;
    for (int i = 0; i < LINE_WATCH_BINS; i++)
        watch.least[i] = watch.rest;
    return watch;
}

double line_watch_slack(const LineWatch *watch) { return SLACK_SHARE * watch->rest; }

/// The least tension of the last rise time, kept in eighths of it.
static double recent_least(LineWatch *watch, double tension, double time)
{
    if (time >= watch->bin_end) {
        watch->bin = (watch->bin + 1) % LINE_WATCH_BINS;
        watch->bin_end = time + watch->rise_time / LINE_WATCH_BINS;
        watch->least[watch->bin] = tension;
    }
    watch->least[watch->bin] = mind(watch->least[watch->bin], tension);
    double least = tension;
    for (int i = 0; i < LINE_WATCH_BINS; i++)
        least = mind(least, watch->least[i]);
    return least;
}

/// A break is told with the largest tension anywhere in the line just before.
static void tell_break(LineWatch *watch, const Line *line, int index, double time,
                       LineEvents *events)
{
    if (line->parted_count > watch->parted) {
        LineEvent event = {LINE_BROKE, index, time, watch->strongest};
        line_events_add(events, watch, &event);
    }
    watch->parted = line->parted_count;
    watch->strongest = 0;
    for (int i = 0; i + 1 < line->node_count; i++)
        watch->strongest = maxd(watch->strongest, line->tension[i]);
}

void line_watch_step(LineWatch *watch, const Line *line, int index, double time, LineEvents *events)
{
    tell_break(watch, line, index, time, events);
    double tension = line->tension[line->node_count - 2];
    double least = recent_least(watch, tension, time);
    if (!watch->snapping) {
        watch->snapping = tension >= SNAP_SHARE * watch->rest && SLACK_SHARE * tension >= least &&
                          time - watch->snap_time > watch->rise_time;
        watch->peak = 0;
    }
    if (!watch->snapping) return;
    if (tension > watch->peak) {
        watch->peak = tension;
        watch->peak_time = time;
    }
    if (tension >= FALLEN_SHARE * watch->peak && time - watch->peak_time < watch->rise_time) return;
    LineEvent event = {LINE_SNAPPED, index, watch->peak_time, watch->peak};
    line_events_add(events, watch, &event);
    watch->snaps++;
    watch->snap_time = watch->peak_time;
    watch->snapping = false;
    for (int i = 0; i < LINE_WATCH_BINS; i++)
        watch->least[i] = tension;
}

void line_events_add(LineEvents *events, const LineWatch *watch, const LineEvent *event)
{
    int64_t oldest = events->count > LINE_EVENTS_KEPT ? events->count - LINE_EVENTS_KEPT : 0;
    for (int64_t i = oldest; i < events->count; i++) {
        const LineEvent *kept = &events->kept[i % LINE_EVENTS_KEPT];
        if (kept->line == event->line && kept->kind == event->kind &&
            kept->time > event->time - watch->rise_time)
            return;
    }
    events->kept[events->count++ % LINE_EVENTS_KEPT] = *event;
}

const LineEvent *line_events_next(const LineEvents *events, int64_t *seen)
{
    if (*seen < events->count - LINE_EVENTS_KEPT) *seen = events->count - LINE_EVENTS_KEPT;
    if (*seen >= events->count) return NULL;
    return &events->kept[(*seen)++ % LINE_EVENTS_KEPT];
}
