/// Bodies that touch each other, the bed or a wall: a stiff one-sided spring with a dashpot and
/// Coulomb friction where they overlap.
///
///     F = max(0, k d - c v) / max(4, n),  k = m (1/2dt)^2,  c = 2 zeta sqrt(k m)
///
/// at each of n points that overlap by d and part at v; m is the mass of both together,
/// m1 m2/(m1 + m2), so that the contact is stable whatever the bodies weigh, and a body that falls
/// onto the bed at 1 m/s sinks in by 2 dt.
/// Source: Cundall & Strack (1979), doi:10.1680/geot.1979.29.1.47; (chosen) the stiffness.
#ifndef FAIRLEAD_CONTACT_H
#define FAIRLEAD_CONTACT_H

#include "body.h"
#include "plan.h"

/// Whether the scene has a body that may move into something.
bool contact_possible(const Scene *scene);

/// Contact force and moment of every body at its present place, into body->contact_force and
/// contact_moment. Planes meet the vertices of a mesh; two bodies meet at their dummy particles,
/// right to a third of a spacing.
/// @param bodies  [scene->body_count]
void contact_loads(const Scene *scene, const Plan *plan, Body *bodies);

#endif
