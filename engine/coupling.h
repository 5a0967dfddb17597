/// Lines and the bodies that hold their ends, step by step: bodies move under the lines' pulls of
/// the last step, then lines follow the ends' smooth paths over this one.
#ifndef FAIRLEAD_COUPLING_H
#define FAIRLEAD_COUPLING_H

#include "body.h"
#include "mooring.h"

/// Anchor and fairlead of every line over a step.
typedef struct LinePaths {
    EndPath end[SCENE_LINES_MAX][2];
} LinePaths;

/// Place and velocity of a held end as the bodies are now; of an end at a free point, the point's
/// first guess.
void coupling_end(const Scene *scene, const Body *bodies, const LineEnd *end, Vec3 *position,
                  Vec3 *velocity);

/// Note all ends at begin (`instant` 0) or end (1) of a step.
void coupling_note_ends(const Scene *scene, const Body *bodies, int instant, LinePaths *paths);

/// The body that holds an end of a line (`side` 0 = anchor, 1 = fairlead), -1 = none.
int coupling_holder(const Scene *scene, int line, int side);

/// Whether the end is at a free point: nobody holds it.
bool coupling_free(const Scene *scene, int line, int side);

/// Sum of the lines' pulls on body `b` now [N] and their moment about its centre of gravity [N m].
void coupling_load(const Scene *scene, const Line *lines, const Body *bodies, int b, Vec3 *force,
                   Vec3 *moment);

/// Give the lines' pulls to the bodies as forces and moments.
void coupling_collect_loads(const Scene *scene, const Line *lines, Body *bodies);

#endif
