/// The stream-function wave; called through steady_wave.h.
#ifndef FAIRLEAD_STREAM_WAVE_H
#define FAIRLEAD_STREAM_WAVE_H

#include "steady_wave.h"

/// Waves of any height up to near the highest, by Newton's method on Fourier coefficients.
/// Source of the formulation: Rienecker & Fenton (1981), J. Fluid Mech. 104, 119; Fenton (1988),
/// doi:10.1016/0098-3004(88)90066-0.
bool stream_wave_solve(const SteadyWaveAsk *ask, SteadyWave *wave);

#endif
