/// Keeping water away from bodies at t = 0: from their skins and from the dummies inside, which on
/// curved hulls form a staircase that may stand out of the skin by up to 0.4 dp (docs/hulls.md).
#ifndef FAIRLEAD_CARVE_H
#define FAIRLEAD_CARVE_H

#include "plan.h"

/// Clearances of water at its displaced place, in spacings (carving at mean places under a
/// hot-started wave blew up). They leave about the water that the hull displaces: 0.25 and 0.7 took
/// 8 mm off the level of a small tank and set it sloshing at twice the speed.
static const double CARVE_SKIN = 0.0, CARVE_DUMMY = 0.5;

/// Distance to the nearest of `count` points as a grid; exact to about a tenth of a spacing within
/// one spacing of them, clamped beyond. Sampled by distance_grid_sample.
bool carve_grid_create(const Vec3 *points, int count, double spacing, Arena *arena,
                       DistanceGrid *grid, Error *error);

/// Whether water at `point` (world, t = 0) would stand in a body of the plan.
bool carve_hits(const Scene *scene, const Plan *plan, Vec3 point);

#endif
