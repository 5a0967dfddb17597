/// One implicit step as a problem to be solved: what mooring_bdf2.c poses and mooring_newton.c
/// solves. Not for others.
#ifndef FAIRLEAD_MOORING_IMPLICIT_H
#define FAIRLEAD_MOORING_IMPLICIT_H

#include "mooring_chain.h"
#include "mooring_internal.h"

typedef struct Segment {
    const LineConstants *c;
    Vec3 q;                ///< direction at the iterate
    double s, rate;        ///< length and its rate at the iterate [m], [m/s]
    double across;         ///< geometric stiffness: tension solved for over length [N/m]
    double u, du;          ///< lengthening by the move and by the Newton step [m]
    double tension, slope; ///< at s + u [N], [N/m]
    double reached;        ///< tension after the whole Newton step [N]
    double wet;            ///< submerged fraction
} Segment;

/// A line's share of the problem. Nodes first..end-1 move: the inner ones and ends at free points.
typedef struct Implicit {
    double h, rate_slope; ///< step [s]; alpha/h, change of velocity with place [1/s]
    int first, end;
    Vec3 *x, *v;              ///< iterate [node_count]
    Vec3 *velocity_known;     ///< v = rate_slope x + velocity_known
    Vec3 *acceleration_known; ///< a = rate_slope v + acceleration_known
    Vec3 *force;              ///< everything but tension and bed, inertia taken off [N]
    Vec3 *residual;           ///< out of balance at the move so far [N]
    Vec3 *move;               ///< so far in this linearisation [m]; the Newton step is chain.x
    Sym3 *linear;             ///< -d force / d x [N/m]
    Segment *segments;
    Contact *contacts;
    double *tension; ///< solved for, of the last iteration [segments][N]
    Vec3 *guess;     ///< where the predictor put the nodes [node_count]
    Chain chain;
} Implicit;

/// Solve the step posed in the lines' iterates. @return false when it does not settle
bool implicit_solve(LineNet *net);

#endif
