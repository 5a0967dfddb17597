/// The flume's wave maker: a piston on the left whose stroke makes the asked wave.
#ifndef FAIRLEAD_PISTON_H
#define FAIRLEAD_PISTON_H

#include "base/portable.h"
#include "motion.h"
#include "waves.h"

/// The record that the piston follows, read and judged.
/// @param table  NULL where the scene has none
/// @return false with ERROR_INPUT naming the file, and its line where one is bad
bool piston_load(const Scene *scene, Arena *arena, const MotionTable **table, Error *error);

/// Most that ring or piston may move sideways in waves that may be set [m]: waves_wall_reach, and
/// of a sea's piston to second order what its path says, where that is more.
bool piston_reach(const Scene *scene, double *reach, Error *error);

/// Where the paddle is, from its mean place [m].
double piston_displacement(const WaveState *waves, double time);

/// Places of the piston's dummies (a MovePoints call; context: the WaveState).
void piston_move(const void *context, double time, int count, const Vec3 *mean, Vec3 *place);

/// Stroke over wave height, S/H = (sinh 2kd + 2kd)/(2 (cosh 2kd - 1)) [-].
/// Source: Biesel & Suquet 1951; Dean & Dalrymple 1991, eq. 6.25.
double piston_stroke_ratio(double kd);

#endif
