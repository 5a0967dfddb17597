/// Where particles are at t = 0: water on a lattice, carved around bodies; dummies behind walls, in
/// the ring, in the piston and in bodies.
#ifndef FAIRLEAD_FILL_H
#define FAIRLEAD_FILL_H

#include "backend/backend.h"
#include "plan.h"
#include "scene.h"

/// Counts, and when there are arrays for them, the particles themselves.
typedef struct Fill {
    int fluid_count, wall_count, ring_count, piston_count, body_count;
    double particle_mass; ///< [kg]
    Vec3 *fluid_position, *fluid_velocity;
    float *fluid_excess;
    Vec3 *dummy_reference;
    int16_t *dummy_owner;
} Fill;

/// Count only: fill->fluid_position is NULL; otherwise write as well. The plan needs its smoothing
/// length, layers, sound speed and bodies by then.
bool fill_particles(const Scene *scene, const Plan *plan, Fill *fill, Error *error);

/// Room for the particles that the plan counted, then the particles.
/// Pitches along x and y of the lattice that water and ring are laid on [m]; 0 along y in 2-D.
void fill_pitches(const Scene *scene, double pitch[2]);

bool fill_create(const Scene *scene, const Plan *plan, Arena *arena, Fill *fill, Error *error);

#endif
