/// Reading the water at points, lines and decks. What has a memory is in slamming.h.
#ifndef FAIRLEAD_PROBES_H
#define FAIRLEAD_PROBES_H

#include "state.h"

/// Free-surface elevation above still water at a gauge now [m]; NAN where dry.
double probe_elevation(const Scene *scene, const State *state, int gauge);

/// Pressure at a probe now [Pa], the mean over its patch; 0 where dry.
double probe_pressure(const Scene *scene, const State *state, int probe);

/// How far water reaches along a line now [m]: from its beginning to the end of the water that
/// begins there, gaps below two spacings passed over; 0 where its beginning is dry.
double probe_run_up(const Scene *scene, const State *state, int line);

typedef struct GreenWater {
    double volume; ///< [m^3], per metre in 2-D [m^2]
    double height; ///< largest over columns two spacings wide, volume over area [m]
} GreenWater;

GreenWater probe_green_water(const Scene *scene, const State *state, int deck);

#endif
