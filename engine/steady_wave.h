/// Regular waves of permanent form over a level bed: Airy, Stokes 2, Stokes 5, stream function.
/// Solved once when a wave is asked for; nothing here runs in a time step.
#ifndef FAIRLEAD_STEADY_WAVE_H
#define FAIRLEAD_STEADY_WAVE_H

#include <stdbool.h>

#include "scene.h"

enum { STEADY_HARMONICS_MAX = 32 };

/// What is asked: the wave by its period or, for comparisons with tables, by its length.
typedef struct SteadyWaveAsk {
    WaveTheory theory; ///< WAVE_THEORY_AUTO = stream function
    double height;     ///< crest to trough H [m], > 0
    double period;     ///< T [s]; 0 = `length` is given
    double length;     ///< L [m], when period is 0
    double depth;      ///< d [m]
    double gravity;    ///< [m/s^2]
    double current;    ///< what flows along the wave [m/s]: see `eulerian`
    bool eulerian;     ///< `current` is the mean velocity below the troughs, not the mean transport
    int harmonics;     ///< N of the stream function; 0 = by steepness and depth
} SteadyWaveAsk;

/// One wave, theta = k x - omega t, z above still water, K = k (z + d):
/// eta = sum_j elevation[j] cos j theta
/// u = mean_velocity + sum_j flow[j] (cosh jK / cosh jkd) cos j theta,
/// w = sum_j flow[j] (sinh jK / cosh jkd) sin j theta.
typedef struct SteadyWave {
    WaveTheory theory;        ///< that was used
    int harmonics;            ///< N
    double wave_number;       ///< k [1/m]
    double angular_frequency; ///< omega [rad/s]
    double speed;             ///< c = omega/k [m/s]
    double mean_velocity;     ///< c_E, Eulerian, below the troughs [m/s]
    double transport;         ///< c_S, volume carried per depth and breadth [m/s]
    double bernoulli;         ///< of the flow that moves with the wave, R - g d [m^2/s^2]
    double depth;             ///< [m]
    double elevation[STEADY_HARMONICS_MAX + 1]; ///< [j], j >= 1 [m]
    double flow[STEADY_HARMONICS_MAX + 1];      ///< [j], j >= 1 [m/s]
} SteadyWave;

/// Solve for a wave.
/// @return false when there is none: it breaks, or Newton's method did not find it
bool steady_wave_solve(const SteadyWaveAsk *ask, SteadyWave *wave);

double steady_wave_elevation(const SteadyWave *wave, double theta);
/// Velocity along the wave and up at `z` above still water (clamped nowhere).
void steady_wave_velocity(const SteadyWave *wave, double theta, double z, double *along,
                          double *up);

/// Coefficients of the fifth-order Stokes wave, functions of kd only.
/// Source: Fenton (1985), J. Waterw. Port Coastal Ocean Eng. 111(2), 216, table 1.
typedef struct StokesCoefficients {
    double A11, A22, A31, A33, A42, A44, A51, A53, A55; ///< velocity potential
    double B22, B31, B42, B44, B53, B55;                ///< elevation
    double C0, C2, C4;                                  ///< mean speed in the wave's frame
    double D2, D4;                                      ///< its flux
    double E2, E4;                                      ///< Bernoulli's constant
} StokesCoefficients;
StokesCoefficients stokes_coefficients(double kd);

#endif
