#include "pace.h"

#include "base/portable.h"

static const double FASTEST_RATE = 30.0; ///< pictures a second at most
static const double SLOWEST_RATE = 1.0;  ///< and at least
static const double ADVANCE = 1.0;       ///< how far a new view may draw ahead of its pay [s]
static const double DEBT_LIMIT = 2.0;    ///< one dear picture is not paid for longer [s]

void pace_drawn(Pace *pace, double begin, double cost, int cores, bool running)
{
    double interval = running ? cost / (PACE_SHARE * cores) : 0.0;
    pace->paid_at = mind(maxd(pace->paid_at, begin) + interval, begin + DEBT_LIMIT);
    pace->begun_at = begin;
}

double pace_next(const Pace *pace, bool running, bool new_view)
{
    double earliest = pace->begun_at + 1.0 / FASTEST_RATE;
    if (!running) return earliest;
    double paid_at = new_view ? pace->paid_at - ADVANCE : pace->paid_at;
    return mind(maxd(paid_at, earliest), pace->begun_at + 1.0 / SLOWEST_RATE);
}
