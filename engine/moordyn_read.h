/// MoorDyn v2 input files as plain data. What a file says and Fairlead does not do is refused by
/// name, with file and line; what makes no difference to the physics is left out with a note.
/// Source: the format's description in MoorDyn's documentation, "The V2 Input File".
#ifndef FAIRLEAD_MOORDYN_READ_H
#define FAIRLEAD_MOORDYN_READ_H

#include <stdint.h>

#include "scene.h"

enum {
    MOORDYN_TYPES_MAX = 64,
    MOORDYN_POINTS_MAX = 2 * SCENE_LINES_MAX + SCENE_POINTS_MAX,
    MOORDYN_BODIES_MAX = 8,
    MOORDYN_NOTES_SIZE = 640,
};

typedef struct MoordynType {
    char name[SCENE_NAME_SIZE];
    double diameter;                  ///< [m]
    double mass;                      ///< per length [kg/m]
    double stiffness;                 ///< EA [N]
    double damping;                   ///< BA [N s]; negative: minus the damping ratio
    double bending;                   ///< EI [N m^2]
    double drag_normal, added_normal; ///< Cd, Ca [-]
    double drag_axial, added_axial;   ///< CdAx, CaAx [-]
} MoordynType;

typedef enum MoordynHold {
    MOORDYN_FIXED,   ///< on earth
    MOORDYN_COUPLED, ///< moved from outside: Coupled, Vessel, or a body that is
    MOORDYN_FREE,
} MoordynHold;

typedef struct MoordynPoint {
    int id;
    MoordynHold hold;
    Vec3 position;                              ///< world axes; z = 0 is still water [m]
    double mass, volume, drag_area, added_mass; ///< [kg], [m^3], [m^2], [-]
    int row;                                    ///< line of the file
} MoordynPoint;

typedef struct MoordynLine {
    int id;
    int type;      ///< index into types
    int ends[2];   ///< A and B, index into points
    double length; ///< unstretched [m]
    int segments;
    int row; ///< line of the file
} MoordynLine;

typedef struct MoordynFile {
    int type_count, point_count, line_count;
    MoordynType types[MOORDYN_TYPES_MAX];
    MoordynPoint points[MOORDYN_POINTS_MAX];
    MoordynLine lines[SCENE_LINES_MAX];
    double gravity, density, depth;    ///< NAN = not given [m/s^2], [kg/m^3], [m]
    double bed_stiffness, bed_damping; ///< [Pa/m], [Pa s/m]; MoorDyn's defaults where not given
    double bed_friction;               ///< [-]
    uint64_t hash;                     ///< FNV-1a 64 of its text
    char notes[MOORDYN_NOTES_SIZE];    ///< lines joined by "; "
} MoordynFile;

/// @return false with ERROR_INPUT: "file line 12: what, and what is accepted"
bool moordyn_read(const char *path, MoordynFile *file, Error *error);

#endif
