/// Slamming: the water's force on a body less its hydrostatic force at the present pose in still
/// water, less the slow part of that difference. The slow part is what a Butterworth low-pass
/// filter of the given order and cut-off lets through.
#ifndef FAIRLEAD_SLAMMING_H
#define FAIRLEAD_SLAMMING_H

#include "body.h"
#include "hull.h"
#include "scene.h"

enum { SLAMMING_SECTIONS = 2 };

/// One section of the filter along one axis: y'' = w^2 (u - y) - (w/Q) y', or y' = w (u - y).
typedef struct FilterSection {
    double value, rate; ///< y, y'
} FilterSection;

/// What a slamming probe remembers; plain data, a checkpoint copies it.
typedef struct Slamming {
    FilterSection section[3][SLAMMING_SECTIONS]; ///< by axis
    double input[3];                             ///< of the last step [N]
    Vec3 force;                                  ///< of the last step [N]
    bool begun;
} Slamming;

/// Low-pass filter `input` by one step of `dt` (trapezoidal rule: stable for any step).
/// @param section  [SLAMMING_SECTIONS], advanced   @param before  input of the step before
/// Source: Butterworth (1930), Wireless Engineer 7, 536: poles of order n on a circle of radius w.
double slamming_low_pass(FilterSection *section, int order, double cutoff, double before,
                         double input, double dt);

/// One step of a probe: `body` carries the fluid's force of this step.
void slamming_advance(Slamming *slamming, const SlammingScene *probe, const Scene *scene,
                      const Body *body, const BodyGeometry *geometry, double dt);

#endif
