/// What the files mooring*.c share: a line's own arrays and the steps over them. Not for others.
#ifndef FAIRLEAD_MOORING_INTERNAL_H
#define FAIRLEAD_MOORING_INTERNAL_H

#include "mooring_chain.h"
#include "mooring_makeup.h"

/// Positions and velocities of all nodes, one array per component [node_count].
typedef struct LineNodes {
    double *x, *y, *z;
    double *u, *v, *w;
} LineNodes;

/// Length of the section at the fairlead while its winch turns.
typedef struct Winch {
    double from, rate, to;  ///< [m], [m/s], [m]
    double begin, duration; ///< [s]
    bool turning;
} Winch;

/// A line's workspace. Arrays of segments have a ghost at either end (segment s is at [s + 1]) that
/// has no length, tension or water, so that end nodes need no special case.
typedef struct LineWork {
    LineMakeup makeup;
    Winch winch;
    int point[2]; ///< of its net, at anchor and fairlead; -1: the end is held
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
    bool water_moves;     ///< false: still water, `water_now` need not change
    Vec3 end_force[2];    ///< time integral over the call: anchor, fairlead [N s]
    double end_work[2];   ///< of that force along the ends' paths [J]
    Vec3 end_velocity[2]; ///< at its begin [m/s]
    Vec3 end_load[2];     ///< what acts on the half segments at the ends now, bed apart [N]
    Vec3 load_before[2];  ///< the same at the call's begin [N]
    Vec3 end_inertia[2];  ///< what the half segments took up in the last call [N]
    double *history;      ///< of the implicit stepper, saved with the state
    size_t history_size;  ///< [double]
    void *implicit;       ///< arrays of the implicit stepper
} LineWork;

/// Contact of a node with the bed in an implicit step.
typedef struct Contact {
    const LineConstants *c; ///< of the node
    double z, rate;         ///< of the node at the iterate
    double force, slope;    ///< of the bed after the move [N], [N/m]
} Contact;

/// One call of line_advance.
typedef struct LineSpan {
    double time, duration;            ///< [s]
    const EndPath *anchor, *fairlead; ///< not looked at where a free point holds the end
} LineSpan;

/// Position and velocity on an end's path at `fraction` 0..1 of its duration.
Vec3 end_path_position(const EndPath *path, double duration, double fraction);
Vec3 end_path_velocity(const EndPath *path, double duration, double fraction);

/// Set `water_now` to `fraction` between the two samples of this call.
void line_water_at(LineWork *work, double fraction);

/// Put end nodes on their paths, but those at free points.
void line_hold_ends(const LineWork *work, LineNodes *nodes, const LineSpan *span, double fraction);

/// Segment tensions, then forces and accelerations of all nodes at the given state (mooring_rk2.c).
void line_segments(LineWork *work, const LineNodes *nodes);
void line_node_forces(LineWork *work, const LineNodes *nodes);

/// Lines that move together because free points join them; mostly one line and no point.
typedef struct LineNet {
    int line_count;
    Line **lines;
    MooringPoint **points; ///< the free ones [block.count]
    PointBlock block;
    Chain **chains;     ///< the lines' own, of the implicit step [line_count]
    Vec3 (*impulse)[2]; ///< of a step on the lines' ends [line_count][N s]
} LineNet;

/// Where and when a step found no solution or an explicit one left all bounds.
typedef struct LineSickness {
    const Line *line;
    int node;
    double time; ///< [s]
} LineSickness;

/// A free point's own share, without its lines' halves.
typedef struct PointWork {
    LineConstants constants;    ///< a node without direction
    int joint_count;            ///< line ends that meet here
    Line **lines;               ///< [joint_count]
    int *sides;                 ///< 0 = anchor, 1 = fairlead [joint_count]
    Vec3 force, residual, move; ///< of the implicit step
    Sym3 linear;
    Contact contact;
} PointWork;

/// Explicit midpoint over the spans, one per line. @return false when a node is sick
bool net_step_rk2(LineNet *net, const LineSpan *spans, LineSickness *sick);

/// Arrays and history of the implicit stepper (mooring_bdf2.c).
bool line_bdf2_create(Line *line, Arena *arena, const char *what, Error *error);

Chain *line_bdf2_chain(const Line *line);

/// Implicit step over the spans, split when it must be. @return false: no step is small enough
bool net_step_bdf2(LineNet *net, const LineSpan *spans, LineSickness *sick);

/// The state was changed by others: the next implicit step starts afresh.
void line_bdf2_forget(Line *line);

/// Part the segment that is most beyond its breaking tension, if any (mooring_live.c).
void net_part(LineNet *net, double time);

/// Unstretched length of a line whose winch runs, at `time` (mooring_live.c).
void line_wind(Line *line, double time);

/// A node between unequal segments, next to a parted one or at an end; x: all nodes.
SpecialNode line_special_node(const LineWork *work, const Vec3 *x, int node);

/// All that acts on the half segment at an end, bed apart [N]; arrays: of all nodes, segments.
Vec3 line_end_load(const LineWork *work, const Vec3 *x, const Vec3 *v, const double *tension,
                   int side);

/// One line of several to be brought to rest together, and a free point between them.
typedef struct RelaxLine {
    const LineMakeup *makeup;
    int point[2];         ///< at anchor and fairlead, -1 = held
    Vec3 *nodes;          ///< [segments + 1]; moved, held ends excepted
    LineStatics *statics; ///< filled from the lumped line; may be NULL
} RelaxLine;

typedef struct RelaxPoint {
    LineConstants constants;
    Vec3 position; ///< in: a guess, that of the nodes; out: at rest
} RelaxPoint;

/// Move nodes to the equilibrium of lumped lines: the minimum of their (convex) energy, found by a
/// damped Newton iteration (mooring_relax.c).
/// @return false with ERROR_INPUT naming `where` when it does not converge; ERROR_SYSTEM for memory
bool lines_relax(RelaxLine *lines, int line_count, RelaxPoint *points, int point_count,
                 double level, const char *where, Error *error);

/// A first shape for lines_relax, whatever the ends: the catenary of a uniform line like it, or a
/// straight line when it cannot reach (mooring_statics.c).
void line_guess(const LineMakeup *makeup, Vec3 anchor, Vec3 fairlead, const WaterField *water,
                Vec3 *nodes);

/// Arrays of a line, without its start. @param point  see LineWork
bool line_take(const LineScene *scene, const WaterField *water, const int point[2],
               const char *where, Arena *arena, Line *line, Error *error);

/// Tension, forces and touchdown of a line at rest.
void line_settle(Line *line, const WaterField *water);

/// line_advance for a net; spans: [line_count].
bool net_advance(LineNet *net, const WaterField *water, const LineSpan *spans, Error *error);

#endif
