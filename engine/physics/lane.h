/// What the formulas of a pair compute with: one float, unless the including file has defined LANE
/// (backend/lanes.h: eight of them side by side) and these functions for it.
#ifndef FAIRLEAD_PHYSICS_LANE_H
#define FAIRLEAD_PHYSICS_LANE_H

#include "base/portable.h"

#ifndef LANE
#define LANE float
FN float lane_sqrt(float x) { return sqrtf(x); }
FN float lane_above_zero(float x) { return x > 0.0f ? x : 0.0f; }
FN float lane_below_zero(float x) { return x < 0.0f ? x : 0.0f; }
#endif

#endif
