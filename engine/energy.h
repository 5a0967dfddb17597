/// Energies of water, bodies and lines.
#ifndef FAIRLEAD_ENERGY_H
#define FAIRLEAD_ENERGY_H

#include "scene.h"
#include "state.h"

/// Energies now. Heights count from z = 0; a line's weight is its submerged one, and the water that
/// it and bodies drag along counts to the water.
EnergyLevels energy_levels(const Scene *scene, const State *state);

/// Values of the columns `energy.…_j` of this scene, as docs/case_file.md says.
/// @param row  where they go   @return behind the last one
double *energy_sample(const Scene *scene, const State *state, double *row);

#endif
