/// What happens to a line while it runs: segments part, a winch turns.
#include "mooring_internal.h"

/// A winch that is told something new while it turns stops within this time at the latest, once it
/// has made the length good [s].
static const double STOPPING_TIME = 1;
/// Shortest length a section may be wound up to, as a share of its first.
static const double SHORTEST_SHARE = 0.1;

static void part(Line *line, int segment, double time)
{
    LineWork *work = line->workspace;
    work->makeup.parted[segment] = true;
    makeup_update(&work->makeup);
    line->parted_count++;
    line->parted_last = segment;
    line->parted_time = time;
    line->tension[segment] = 0;
}

void mooring_break(Line *line, int segment)
{
    LineWork *work = line->workspace;
    if (segment < 0 || segment >= work->makeup.segments || work->makeup.parted[segment]) return;
    part(line, segment, NAN);
    line_bdf2_forget(line);
}

void net_part(LineNet *net, double time)
{
    bool parted = false;
    for (int l = 0; l < net->line_count; l++) {
        Line *line = net->lines[l];
        const LineWork *work = line->workspace;
        if (!work->makeup.can_part) continue;
        const double *tension =
            line->stepper == LINE_STEPPER_RK2 ? work->tension + 1 : line->tension;
        double worst = 1;
        int weakest = -1;
        for (int s = 0; s < work->makeup.segments; s++) {
            double load = tension[s] / work->makeup.segment[s]->breaking;
            if (load <= worst || work->makeup.parted[s]) continue;
            worst = load;
            weakest = s;
        }
        if (weakest < 0) continue;
        part(line, weakest, time);
        parted = true;
    }
    for (int l = 0; parted && l < net->line_count; l++)
        line_bdf2_forget(net->lines[l]);
}

/// Length and rate of a winch's section at `time`: the polynomial of fifth order that leaves
/// (from, rate) and arrives at rest, without a jump of acceleration.
static double winch_length(const Winch *winch, double time, double *rate)
{
    double s = winch->duration > 0 ? (time - winch->begin) / winch->duration : 1;
    s = mind(maxd(s, 0), 1);
    double s2 = s * s, s3 = s2 * s, s4 = s3 * s;
    double going = winch->rate * winch->duration, way = winch->to - winch->from;
    *rate =
        winch->duration > 0
            ? (going * (1 - 18 * s2 + 32 * s3 - 15 * s4) + way * (30 * s2 - 60 * s3 + 30 * s4)) /
                  winch->duration
            : 0;
    return winch->from + going * (s - 6 * s3 + 8 * s4 - 3 * s4 * s) +
           way * (10 * s3 - 15 * s4 + 6 * s4 * s);
}

void mooring_set_length(Line *line, double length, double speed, double time)
{
    LineWork *work = line->workspace;
    LineMakeup *makeup = &work->makeup;
    Winch *winch = &work->winch;
    LineSection section = line_section(line->scene, line_section_count(line->scene) - 1);
    double others = line->length - makeup->fairlead_length, rate;
    double now = winch_length(winch, time, &rate);
    winch->from = winch->turning ? now : makeup->fairlead_length;
    winch->rate = winch->turning ? rate : 0;
    winch->to = maxd(length - others, SHORTEST_SHARE * section.length);
    winch->begin = time;
    winch->duration = 1.875 * fabs(winch->to - winch->from) / speed; // its fastest is at 1/2
    if (winch->rate != 0) winch->duration += STOPPING_TIME;
    winch->turning = winch->duration > 0;
}

void line_wind(Line *line, double time)
{
    LineWork *work = line->workspace;
    Winch *winch = &work->winch;
    if (!winch->turning) return;
    double rate;
    work->makeup.fairlead_length = winch_length(winch, time, &rate);
    winch->turning = time < winch->begin + winch->duration;
    makeup_update(&work->makeup);
    line->step_limit = work->makeup.step_limit;
    line->length = makeup_arc(&work->makeup, work->makeup.segments);
}
