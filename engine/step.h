/// Pieces of a step that creation needs as well; the step itself is in engine.h.
#ifndef FAIRLEAD_STEP_H
#define FAIRLEAD_STEP_H

#include "state.h"

/// The water as mooring lines see it: the incident wave, or still water.
WaterField step_water(const Scene *scene, const State *state);

/// Place of a line's end now, and its velocity.
void step_line_end(const State *state, const LineEnd *end, Vec3 *position, Vec3 *velocity);

#endif
