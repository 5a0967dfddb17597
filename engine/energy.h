/// Energies of water, bodies and lines.
#ifndef FAIRLEAD_ENERGY_H
#define FAIRLEAD_ENERGY_H

#include "scene.h"
#include "state.h"

/// Energies now. Heights count from z = 0; a line's weight is its submerged one, and the water that
/// it and bodies drag along counts to the water.
EnergyLevels energy_levels(const Scene *scene, const State *state);

enum { ENERGY_COLUMNS_MAX = 17 };

/// A column `energy.…` of the series, as docs/case_file.md says.
typedef struct EnergyColumn {
    const char *name;
    double value; ///< [J]
} EnergyColumn;

/// The columns that belong to this scene and their values now.
/// @param state   NULL: names only
/// @param column  [ENERGY_COLUMNS_MAX]   @return how many
int energy_columns(const Scene *scene, const State *state, EnergyColumn *column);

#endif
