/// A steady uniform current. Water and ring of a basin go with it, so waves are evaluated in the
/// frame that travels with the water; how water comes in and leaves: backend/cpu_conveyor.c.
#ifndef FAIRLEAD_CURRENT_H
#define FAIRLEAD_CURRENT_H

#include "scene.h"

/// Velocity, what it gains, and the way of the water since t = 0. It grows from rest by a quintic
/// smoothstep over `ramp`.
Vec3 current_velocity(const Current *current, double time);     ///< [m/s]
Vec3 current_acceleration(const Current *current, double time); ///< [m/s^2]
Vec3 current_travel(const Current *current, double time);       ///< [m]

/// Component of the full current along a heading [m/s].
double current_along(const Current *current, double heading);

/// k of (omega - k u)^2 = g k tanh(k d), the longest such wave [1/m]; NAN where a current against
/// the waves lets none of this frequency run.
/// @param u  the current's component along the wave [m/s]
double current_wave_number(double angular_frequency, double u, double depth, double gravity);

#endif
