/// What the files mooring*.c share: a line's own arrays and the steps over them. Not for others.
#ifndef FAIRLEAD_MOORING_INTERNAL_H
#define FAIRLEAD_MOORING_INTERNAL_H

#include "mooring_makeup.h"

/// Positions and velocities of all nodes, one array per component [node_count].
typedef struct LineNodes {
    double *x, *y, *z;
    double *u, *v, *w;
} LineNodes;

/// A line's workspace. Arrays of segments have a ghost at either end (segment s is at [s + 1]) that
/// has no length, tension or water, so that end nodes need no special case.
typedef struct LineWork {
    LineMakeup makeup;
    int node_count;
    LineNodes now;        ///< the state while stepping
    LineNodes middle;     ///< the stage in the middle of a step
    double *dx, *dy, *dz; ///< segment vectors [segments + 2][m]
    double *px, *py, *pz; ///< tension as a force along the segment [segments + 2][N]
    double *wet;          ///< submerged fraction [segments + 2]
    double *tension;      ///< [segments + 2][N]
    double *peak;         ///< largest tension since the call began [segments + 2][N]
    double *share;        ///< length of a node in segments: 1, at the ends 1/2 [node_count]
    double *bed_share;    ///< the same, 0 at the ends: whoever holds an end carries it
    double *fx, *fy, *fz; ///< force on a node [node_count][N]
    double *ax, *ay, *az; ///< acceleration of a node [node_count][m/s^2]
    double *water[2][7];  ///< at begin and end of the call: velocity, acceleration, elevation
    double *water_now[7]; ///< between them, at the stage in hand
    Vec3 *sample_velocity, *sample_acceleration; ///< what the callback fills [node_count]
    double *sample_elevation;
    bool water_moves;    ///< false: still water, `water_now` need not change
    Vec3 end_force[2];   ///< time integral over the call: anchor, fairlead [N s]
    double *history;     ///< of the implicit stepper, saved with the state
    size_t history_size; ///< [double]
    void *implicit;      ///< arrays of the implicit stepper
} LineWork;

/// One call of line_advance.
typedef struct LineSpan {
    double time, duration; ///< [s]
    const EndPath *anchor, *fairlead;
} LineSpan;

/// Position and velocity on an end's path at `fraction` 0..1 of its duration.
Vec3 end_path_position(const EndPath *path, double duration, double fraction);
Vec3 end_path_velocity(const EndPath *path, double duration, double fraction);

/// Set `water_now` to `fraction` between the two samples of this call.
void line_water_at(LineWork *work, double fraction);

/// Put both end nodes on their paths.
void line_hold_ends(LineNodes *nodes, int last, const LineSpan *span, double fraction);

/// Segment tensions, then forces and accelerations of all nodes at the given state (mooring_rk2.c).
void line_segments(LineWork *work, const LineNodes *nodes);
void line_node_forces(LineWork *work, const LineNodes *nodes);

/// Explicit midpoint over the span. @return index of the first sick node, -1 when all are well;
/// `sick_time` is then set [s]
int line_step_rk2(Line *line, const LineSpan *span, double *sick_time);

/// Arrays and history of the implicit stepper (mooring_bdf2.c).
bool line_bdf2_create(Line *line, Arena *arena, const char *what, Error *error);

/// Implicit step over the span, split when it must be. @return as line_step_rk2
int line_step_bdf2(Line *line, const LineSpan *span, double *sick_time);

/// The state was changed by others: the next implicit step starts afresh.
void line_bdf2_forget(Line *line);

/// Direction from an end node to its inner neighbour and the wet share of its half segment.
Vec3 line_end_direction(const LineWork *work, const Vec3 *x, int node, int inner, double *wet);

/// Move free nodes to the equilibrium of the lumped line: the minimum of its (convex) energy, found
/// by a damped Newton iteration from `nodes` (mooring_relax.c).
/// @param nodes    [segments + 1], ends fixed; moved
/// @param statics  filled from the lumped line; may be NULL
/// @return false with ERROR_INPUT naming `where` when it does not converge; ERROR_SYSTEM for memory
bool line_relax(const LineScene *scene, const WaterField *water, const char *where, Vec3 *nodes,
                LineStatics *statics, Error *error);

#endif
