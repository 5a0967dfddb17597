/// Pieces of a step that creation needs as well; the step itself is in engine.h.
#ifndef FAIRLEAD_STEP_H
#define FAIRLEAD_STEP_H

#include "state.h"

/// What the backend needs to advance by `dt` from the present time, with bodies where they are now.
Advance step_orders(const Scene *scene, const Plan *plan, State *state, double dt);

/// The wall clock by which effects are timed [s].
double step_clock(void);

/// Carry out what is ordered of a line at the present time.
void step_order_line(const Scene *scene, State *state, int line);

#endif
