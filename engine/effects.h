/// Which effects a scene calls for, why, and what each brings along.
#ifndef FAIRLEAD_EFFECTS_H
#define FAIRLEAD_EFFECTS_H

#include "fill.h"
#include "plan.h"

/// The table of effects.def, all off.
void effects_name(EffectPlan effects[EFFECT_COUNT]);

/// Switch on what the scene calls for, with reasons and bytes; sum these into plan->bytes.
void effects_choose(const Scene *scene, Plan *plan, const Fill *fill);

#endif
