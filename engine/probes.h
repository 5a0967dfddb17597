/// Reading the water at points: wave gauges and pressure probes.
#ifndef FAIRLEAD_PROBES_H
#define FAIRLEAD_PROBES_H

#include "state.h"

/// Free-surface elevation above still water at a gauge now [m]; NAN where dry.
double probe_elevation(const Scene *scene, const State *state, int gauge);

/// Pressure at a probe now [Pa]; 0 where dry.
double probe_pressure(const Scene *scene, const State *state, int probe);

#endif
