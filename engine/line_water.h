/// The water that lines feel: the incident wave's, or for lines that ask for it the simulated.
#ifndef FAIRLEAD_LINE_WATER_H
#define FAIRLEAD_LINE_WATER_H

#include "mooring.h"
#include "scene.h"

struct State;

/// Whom the nodes of lines ask; part of the state.
typedef struct NodeWater {
    const Scene *scene;
    struct State *state;
} NodeWater;

/// The water of a scene, as `context` of which `nodes` must outlive it.
WaterField line_water(const Scene *scene, struct State *state, NodeWater *nodes);

/// Does any line ask for the simulated water?
bool line_water_is_simulated(const Scene *scene);

#endif
