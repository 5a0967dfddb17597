/// The flume's wave maker: a piston on the left whose stroke makes the asked wave.
#ifndef FAIRLEAD_PISTON_H
#define FAIRLEAD_PISTON_H

#include "base/portable.h"

/// Places of the piston's dummies (a MovePoints call; context: the WaveState).
void piston_move(const void *context, double time, int count, const Vec3 *mean, Vec3 *place);

/// Stroke over wave height, S/H = (sinh 2kd + 2kd)/(2 (cosh 2kd - 1)) [-].
/// Source: Biesel & Suquet 1951; Dean & Dalrymple 1991, eq. 6.25.
double piston_stroke_ratio(double kd);

#endif
