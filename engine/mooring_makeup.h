/// What a line is made of: runs of equal segments, and the nodes between unequal ones. Not for
/// others than mooring*.c.
#ifndef FAIRLEAD_MOORING_MAKEUP_H
#define FAIRLEAD_MOORING_MAKEUP_H

#include "mooring.h"
#include "mooring_chain.h"
#include "physics/line.h"

/// Equal segments begin..end-1, one after the other.
typedef struct LineRun {
    LineConstants constants;
    int begin, end;
} LineRun;

/// Loops over all nodes go by runs, as if the nodes between two runs belonged to either; those few
/// nodes, the `special` ones, are then done again one by one.
typedef struct LineMakeup {
    const LineScene *scene;
    double density, gravity, bed; ///< of the water and below it
    double fairlead_length;       ///< unstretched, of the section at the fairlead [m]
    int segments;
    bool *parted; ///< [segments]: carries nothing any more, either half hangs on its node
    int run_count;
    LineRun *runs;                 ///< [segments], run_count in use
    const LineConstants **segment; ///< [segments]
    const LineConstants **node;    ///< of a whole node, wet [segments + 1]; ends: half a segment
    LineConstants *blends;         ///< those of ends and special nodes [segments + 1]
    int special_count;
    int *special;       ///< inner nodes between runs and all next to a parted segment, ascending
    double step_limit;  ///< explicit limit of the sub-step [s]
    double sound_speed; ///< largest along the line, sqrt(EA/w) [m/s]
    bool can_part;      ///< any segment has a breaking tension
    bool bends;         ///< any segment has a bending stiffness
} LineMakeup;

/// A special node as it stands: sum of its halves, each as wet as it is.
typedef struct SpecialNode {
    LineConstants sum;
    Vec3 q; ///< direction of the line, 0 when it hangs on nothing
} SpecialNode;

/// Sections of a line; one without any is one section itself.
int line_section_count(const LineScene *scene);
LineSection line_section(const LineScene *scene, int k);

bool makeup_create(const LineScene *scene, const WaterField *water, const char *what, Arena *arena,
                   LineMakeup *makeup, Error *error);

/// Work everything out anew after a change of `parted` or `fairlead_length`.
void makeup_update(LineMakeup *makeup);

/// Node `i` with the places of it and its neighbours and the surface above them; those beyond an
/// end are not looked at.
SpecialNode makeup_special_node(const LineMakeup *makeup, int i, const Vec3 place[3],
                                const double elevation[3]);

/// Bending at inner node `i` between segment vectors `before` and `after`.
Bend makeup_bend(const LineMakeup *makeup, int i, Vec3 before, Vec3 after);

/// Unstretched length from the anchor to node `i` [m].
double makeup_arc(const LineMakeup *makeup, int i);

#endif
