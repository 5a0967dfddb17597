/// Effects as JSON: the same for `explain`, the page and summary.json.
#ifndef FAIRLEAD_SERVER_EFFECTS_H
#define FAIRLEAD_SERVER_EFFECTS_H

#include "engine.h"
#include "json.h"

/// "effects": a list of every effect, on and off, as docs/protocol.md says.
void effects_write(Json *json, const Plan *plan);

/// "effects": those that took part in a run, with what they took.
void effects_write_costs(Json *json, const Plan *plan, const State *state);

#endif
