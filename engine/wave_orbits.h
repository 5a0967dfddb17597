/// From a solved regular wave to what a time step needs: coefficients of its field, of the closed
/// orbits of its particles and of their drift.
#ifndef FAIRLEAD_WAVE_ORBITS_H
#define FAIRLEAD_WAVE_ORBITS_H

#include "physics/wave_theory.h"
#include "steady_wave.h"

/// Orbits are exact for the theory: particles stay on the streamlines of the solved wave, and
/// leaving their drift out keeps every volume. What the few depth functions of WaveTerms cannot
/// follow is told in `misfit`.
/// @param misfit  largest difference of an orbit [m], may be NULL
WaveTerms wave_orbits_terms(const SteadyWave *wave, double level, double *misfit);

#endif
