/// Lumped-mass mooring lines: statics, stepping, loads. All in double precision.
/// The formulas of one segment and node live in physics/line.h, shared by every stepper.
#ifndef FAIRLEAD_MOORING_H
#define FAIRLEAD_MOORING_H

#include "base/arena.h"
#include "base/error.h"
#include "base/portable.h"
#include "scene.h"

/// Water around a line: what a node asks for, of the kind its line chose. One call fills `count`
/// nodes.
/// velocity [m/s], acceleration [m/s^2], surface elevation z [m] above each node.
typedef void (*WaterAtNodes)(const void *context, LineWater kind, double time, int count,
                             const Vec3 *position, Vec3 *velocity, Vec3 *acceleration,
                             double *elevation);

typedef struct WaterField {
    WaterAtNodes at_nodes; ///< NULL = still water at `level`
    const void *context;
    double level;   ///< still-water level [m]
    double density; ///< [kg/m^3]
    double gravity; ///< [m/s^2]
    double bed;     ///< z of the bed [m]
} WaterField;

/// How a line is stepped.
typedef enum LineStepper {
    LINE_STEPPER_RK2,  ///< explicit midpoint, sub-stepped below step_limit
    LINE_STEPPER_BDF2, ///< implicit, variable step: any stiffness at the fluid's own step
} LineStepper;

/// One line with its nodes; node 0 is the anchor end, node `segments` the fairlead end.
typedef struct Line {
    const LineScene *scene;
    int node_count;  ///< segments + 1
    Vec3 *position;  ///< [node_count][m]
    Vec3 *velocity;  ///< [node_count][m/s]
    double *tension; ///< [segments][N], axial plus internal damping, never negative
    Vec3
        fairlead_force; ///< the line's pull on what holds its fairlead [N], mean over the last step
    Vec3 anchor_force;  ///< the same at the anchor [N]
    Vec3 pull[2];   ///< the same at anchor and fairlead, carried on from the middle of the step to
                    ///< its end: what their holders feel over the next [N]
    double work[2]; ///< on what holds anchor and fairlead over the last step, along their paths [J]
    double largest_tension; ///< so far [N]
    double touchdown;       ///< length lying on the bed [m]
    double step_limit;      ///< explicit limit of the sub-step [s]
    double sound_speed;     ///< in its stiffest piece, sqrt(EA/w) [m/s]
    long substeps;          ///< taken so far
    LineStepper stepper;    ///< set by line_create; may be changed between steps
    const bool *parted;     ///< [segments]
    int parted_count;       ///< segments that carry nothing any more
    int parted_last;        ///< the last to part, -1 = none
    double parted_time;     ///< when it did [s]
    double length;          ///< unstretched, of the whole line now [m]
    void *workspace;        ///< the stepper's own arrays
} Line;

/// What the statics say about a line, for `explain`.
typedef struct LineStatics {
    double fairlead_tension, anchor_tension; ///< [N]
    double horizontal_force;                 ///< [N]
    double touchdown;                        ///< length on the bed [m]
    double stretched_length;                 ///< [m]
    double span, reach;                      ///< end-to-end distance; unstretched length [m]
} LineStatics;

/// Elastic catenary between two points over a flat bed (Jonkman 2007; Irvine 1981), robust for
/// slack, taut, vertical and heaped lines.
/// @param nodes   filled with `segments`+1 positions, anchor first; may be NULL
/// @return false with ERROR_INPUT (naming `where`) when the line cannot reach or does not converge
bool line_statics(const LineScene *line, Vec3 anchor, Vec3 fairlead, const WaterField *water,
                  const char *where, Vec3 *nodes, LineStatics *statics, Error *error);

/// Arrays and static start of one line.
bool line_create(const LineScene *scene, Vec3 anchor, Vec3 fairlead, const WaterField *water,
                 const char *where, Arena *arena, Line *line, LineStatics *statics, Error *error);

/// Motion of an end over a fluid step: cubic Hermite between two instants, so that the line sees a
/// smooth path (piecewise-linear paths make spikes of sqrt(EA w) dv).
typedef struct EndPath {
    Vec3 position[2]; ///< at begin and end of the step [m]
    Vec3 velocity[2]; ///< [m/s]
} EndPath;

/// Advance from `time` over `duration`, sub-stepping below the stable limit; leaves the
/// step-averaged end forces in the line.
/// @return false with ERROR_PHYSICS naming line, node and value when something is not finite
bool line_advance(Line *line, const WaterField *water, double time, double duration,
                  const EndPath *anchor, const EndPath *fairlead, Error *error);

/// A place where lines meet. A fixed one is only a place; a free one moves with its lines.
typedef struct MooringPoint {
    const PointScene *scene;
    Vec3 position, velocity; ///< of a free point [m], [m/s]
    void *workspace;         ///< NULL when fixed
} MooringPoint;

/// All lines of a scene with the points that join them.
typedef struct Mooring {
    int line_count, point_count, net_count;
    Line *lines;          ///< [line_count]
    MooringPoint *points; ///< [point_count]
    void *nets;           ///< lines that move together, by free points [net_count]
} Mooring;

/// Ends of a line at t = 0: anchor, fairlead [m]; not looked at where a free point holds the line.
typedef struct LineEnds {
    Vec3 place[2];
} LineEnds;

/// Arrays and static start of all lines and free points of a scene.
/// @param ends     [scene->line_count]
/// @param statics  [scene->line_count], may be NULL
/// @return false with ERROR_INPUT naming the line ("lines[2]") or point
bool mooring_create(const Scene *scene, const LineEnds *ends, const WaterField *water, Arena *arena,
                    Mooring *mooring, LineStatics *statics, Error *error);

/// line_advance for all lines; `paths` is [line_count][2], anchor and fairlead.
bool mooring_advance(Mooring *mooring, const WaterField *water, double time, double duration,
                     const EndPath (*paths)[2], Error *error);

/// Let a segment part now; both halves go on. Does nothing to one that has parted.
void mooring_break(Line *line, int segment);

/// Let the winch at the fairlead bring the section there to such a length that the whole line is
/// `length` long unstretched, smoothly at up to `speed` [m/s], from `time` on. The section's
/// segments grow or shrink alike, down to a tenth of their first length.
void mooring_set_length(Line *line, double length, double speed, double time);

/// Kinetic, elastic and potential energy of a line, as if all of it were under water [J].
double line_energy(const Line *line);

/// The same of all lines and free points [J].
double mooring_energy(const Mooring *mooring);

/// Doubles needed to save or restore a line's state, and both directions.
size_t line_state_size(const Line *line);
void line_state_save(const Line *line, double *to);
void line_state_restore(Line *line, const double *from);

#endif
