/// The copy of the simulation's state that other threads may read. Render and server see only this.
#ifndef FAIRLEAD_SNAPSHOT_H
#define FAIRLEAD_SNAPSHOT_H

#include <stdint.h>

#include "hull.h"
#include "scene.h"

enum { EFFECTS_MAX = 32, SNAPSHOT_LINE_NODES_MAX = 257 };

typedef struct BodySnapshot {
    Vec3 origin;              ///< of the geometry axes, world [m]
    Quat attitude;            ///< geometry to world
    const TriangleMesh *mesh; ///< constant while the engine lives, borrowed
    double colour[3];
} BodySnapshot;

typedef struct LineSnapshot {
    int node_count;
    float (*position)[3]; ///< [node_count][m], anchor first
    float *tension;       ///< [node_count - 1][N]; -1 where the line has parted
    double diameter;      ///< [m]
    const char *name;     ///< constant while the scene lives, borrowed; NULL = not told
    double slack;         ///< below this a segment is slack [N]
    double rest;          ///< tension of the last segment at rest [N]
    double largest;       ///< tension so far [N]
    double touchdown;     ///< length on the bed [m]
    double snap_time;     ///< of the last snap [s], -INFINITY before the first
    bool ashore[2];       ///< an end, first and last node, that no body holds: a post marks it
    int lift_off;         ///< last node on the bed next to one above it, -1 without
} LineSnapshot;

typedef struct EffectShare {
    const char *name;
    double share; ///< of the step's wall time, 0..1
} EffectShare;

typedef enum HealthStatus { HEALTH_GOOD, HEALTH_RECOVERED, HEALTH_FAILED } HealthStatus;

typedef struct Snapshot {
    double time; ///< simulated [s]
    int64_t step;
    double time_step; ///< last [s]
    double wall_time; ///< spent stepping [s]
    int64_t particle_steps;
    int fluid_count, boundary_count;
    float (*position)[3]; ///< [fluid_count][m], world
    float (*velocity)[3]; ///< [fluid_count][m/s]
    float *pressure;      ///< [fluid_count][Pa]
    double spacing;       ///< dp [m]
    double density_error; ///< largest |rho/rho0 - 1| now [-]
    double largest_speed; ///< [m/s]

    int body_count;
    BodySnapshot bodies[SCENE_BODIES_MAX];
    int line_count;
    LineSnapshot lines[SCENE_LINES_MAX];

    bool has_waves;
    WaveTarget wave_asked, wave_now;
    bool wave_changing;

    int effect_count;
    EffectShare effects[EFFECTS_MAX];

    HealthStatus health;
    char health_message[256];

    Domain domain; ///< copied from the scene, for pictures
    double level;
    double zone_width;   ///< of the relaxation zone [m], 0 without
    void *storage;       ///< owned memory of the arrays above
    size_t storage_size; ///< [byte]
} Snapshot;

#endif
