/// What a scene makes the engine do: passes, the compiled sweep variant, arrays, time step. It is
/// printable data: `fairlead explain` prints it.
#ifndef FAIRLEAD_PLAN_H
#define FAIRLEAD_PLAN_H

#include "base/arena.h"
#include "base/error.h"
#include "hull.h"
#include "mooring.h"
#include "scene.h"
#include "snapshot.h"

typedef enum EffectKind { EFFECT_PAIR, EFFECT_PASS } EffectKind;

typedef enum EffectId {
#define EFFECT(id, name, kind, called_by, arrays, step, source) EFFECT_##id,
#include "effects.def"
#undef EFFECT
    EFFECT_COUNT
} EffectId;

/// How the time that an effect takes is known.
typedef enum EffectCost {
    COST_CLOCKED,  ///< by clocks around what it does
    COST_SAMPLED,  ///< share of its sweep, measured once at the start, times the sweep's clock
    COST_ELSEWHERE ///< not a part of a step
} EffectCost;

typedef struct EffectPlan {
    const char *name;
    EffectKind kind;
    const char *called_by; ///< what in a case switches it on
    const char *arrays;    ///< what it keeps
    const char *step;      ///< its own stable time step as a formula, "" without
    const char *source;    ///< citation
    EffectCost cost;
    bool active;
    char because[160]; ///< what in this case calls for it, or why it is not needed
    size_t bytes;      ///< of the arrays it brings
    double step_limit; ///< its own stable time step [s], INFINITY without
} EffectPlan;

typedef struct BodyPlan {
    BodyGeometry geometry;
    int particle_count;
    Vec3 *particles;       ///< geometry axes [particle_count][m]
    DistanceGrid distance; ///< to the skin, for carving the water
    DistanceGrid dummies;  ///< to the nearest dummy particle
    Vec3 start_origin;     ///< of the geometry axes at t = 0, initial offset included [m]
    Quat start_attitude;
} BodyPlan;

typedef struct LinePlan {
    LineEnds ends; ///< at t = 0, world
    LineStatics statics;
} LinePlan;

typedef struct EngineOptions {
    int threads;         ///< 0 = all cores
    const char *backend; ///< "auto", "cpu" or "cuda"
    size_t memory_limit; ///< [byte]; 0 = three quarters of the machine's
    bool pictures;       ///< somebody may look
} EngineOptions;

typedef struct Plan {
    EngineOptions options;
    const char *backend; ///< chosen: "cpu" …
    char variant[64];    ///< compiled sweep and instruction level
    unsigned pair_mask;  ///< bits of the active PAIR effects
    EffectPlan effects[EFFECT_COUNT];
    double smoothing_length; ///< h [m]
    int wall_layers;         ///< of dummy particles behind walls and skins
    double particle_mass;    ///< [kg], 2-D per metre
    double sound_speed;      ///< c0 [m/s]
    char sound_speed_because[160];
    double largest_speed;      ///< expected, chose the sound speed [m/s]
    double time_step;          ///< [s]
    char time_step_limit[64];  ///< which limit binds
    double zone_width;         ///< [m], 0 without
    double wall_reach;         ///< most that ring or piston may move sideways [m], 0 without
    double flow[2];            ///< x, y: signs of the current that carries the ring, 0 without
    double pitch[2];           ///< x, y: of the ring's lattice then [m]
    const MotionTable *piston; ///< record that the piston follows; NULL without
    int fluid_count, wall_count, body_particle_count;
    BodyPlan *bodies;          ///< [scene->body_count]
    LinePlan *lines;           ///< [scene->line_count]
    size_t bytes;              ///< of State, all arrays
    double predicted_slowness; ///< seconds of this machine per simulated second; NAN until measured
    char warnings[1024];       ///< lines joined by "; "
    Arena arena;               ///< owns everything above
} Plan;

/// Mesh the bodies, start the lines, count particles, choose the step.
/// @return false with ERROR_INPUT (mesh, reach, memory …); the plan is then empty
bool plan_build(const Scene *scene, const EngineOptions *options, Plan *plan, Error *error);
void plan_destroy(Plan *plan);

/// Time a few steps of this plan to fill predicted_slowness (takes about a second).
bool plan_predict(const Scene *scene, Plan *plan, Error *error);

#endif
