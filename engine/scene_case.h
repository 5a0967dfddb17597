/// Within the reader of case files: what a file says while it is being read, the tables of its keys
/// and the checks between values. Outside of scene_*.c (and its tests) nobody includes this.
#ifndef FAIRLEAD_SCENE_CASE_H
#define FAIRLEAD_SCENE_CASE_H

#include "scene.h"
#include "scene_table.h"

typedef enum MoordynAxes {
    MOORDYN_WORLD, ///< where they are when the body is at its reference pose
    MOORDYN_BODY,  ///< the body's geometry axes
} MoordynAxes;

/// The scene with what only the file knows.
typedef struct CaseFile {
    Scene scene;
    char schema[256];                       ///< "$schema", for editors
    char quality_names[3][SCENE_NAME_SIZE]; ///< gauges of probes.wave_quality
    double basin_depth;                     ///< [m]; NAN = min_m and max_m are given instead
    double basin_length;                    ///< [m]
    double basin_breadth;                   ///< [m]
    double basin_freeboard; ///< [m]; NAN = BASIN_FREEBOARD_RATIO of the largest wave height
    char moordyn_path[SCENE_PATH_SIZE]; ///< as the case says it; "" = none
    int moordyn_body;                   ///< what its coupled points ride on; -1 = earth
    MoordynAxes moordyn_axes;           ///< of those points' coordinates
} CaseFile;

/// A file that says nothing.
CaseFile case_file_default(void);

/// Keys of the whole file, of a body, a line and a point where lines meet.
extern const JsonTable CASE_TABLE, BODY_TABLE, LINE_TABLE, POINT_TABLE;

/// `body` by name → index into scene.bodies (bodies are read before lines and probes).
bool case_read_body(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                    const char *where, void *target);

/// Rules between the values of one body or one line, and what follows from them (2-D breadth, path
/// of the mesh, moments of inertia given as three).
bool case_finish_body(const JsonReader *reader, const JsonValue *object, const char *where,
                      void *target);
bool case_finish_line(const JsonReader *reader, const JsonValue *object, const char *where,
                      void *target);

/// What goes with waves of a record, and where its table is (scene_load.c).
bool case_finish_waves(const JsonReader *reader, const JsonValue *object, const char *where,
                       void *target);

/// A relative path starts at the case's folder, wherever the program is called.
/// @param where, key  place in the case, for messages   @param path  as the case says it, changed
bool case_resolve_path(const JsonReader *reader, const JsonValue *object, const char *where,
                       const char *key, char path[SCENE_PATH_SIZE]);

/// Add the lines and points of the case's MoorDyn file, and its water where the case does not say
/// (scene_moordyn.c). @param root  the case's tree
bool case_join_moordyn(const JsonReader *reader, const JsonValue *root, CaseFile *draft);

/// Lengths of lines that are given by their tension (scene_pretension.c); after all checks.
bool case_resolve_pretension(const JsonReader *reader, Scene *scene);

/// Gauges by the names that waves.gain and probes.wave_quality give.
bool case_find_gauges(const JsonReader *reader, CaseFile *draft);

/// Values that follow from others: the basin's corners, limits of live changes, ramp.
bool case_resolve(const JsonReader *reader, CaseFile *draft);

/// Rules between values of different objects; each names the JSON path it refuses.
bool case_check(const JsonReader *reader, const Scene *scene);
bool case_check_bodies(const JsonReader *reader, const Scene *scene);
bool case_check_lines(const JsonReader *reader, const Scene *scene);
bool case_check_probes(const JsonReader *reader, const Scene *scene);

/// Particles of this scene, walls included; an estimate from volumes (the plan counts).
double case_particle_estimate(const Scene *scene, double spacing);
/// Refuse a scene whose particles would not fit into `memory` [byte], naming the smallest spacing
/// that does.
bool case_check_memory(const JsonReader *reader, const Scene *scene, double memory);
/// What a simulation may use of this machine: three quarters of it [byte].
double case_memory_available(void);

/// Apply "path.to.key=value" to the tree before it is read.
bool case_override(JsonValue *root, const char *assignment, Error *error);

/// Largest wave height that does not break [m]: 0.142 L tanh(k d).
/// Source: Miche (1944), Annales des Ponts et Chaussées 114.
double case_breaking_height(const Scene *scene, double period);

#endif
