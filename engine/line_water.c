#include "line_water.h"

#include "current.h"
#include "state.h"
#include "step.h"

/// Below this share of water around a node, the incident wave's velocity counts: beyond the basin,
/// above the surface. One half is the surface, or a flat bed.
static const double WET_SHARE = 0.25;

/// In a basin the incident wave carries no drift; in a domain of lines it has its own.
static void incident_velocity(const Scene *scene, const WaveState *waves, double time, int count,
                              const Vec3 *position, Vec3 *velocity)
{
    bool open = scene->domain.kind == DOMAIN_LINES;
    for (int i = 0; i < count; i++)
        velocity[i] = open ? waves_velocity(waves, position[i], time)
                           : waves_zone_velocity(waves, position[i], time);
}

/// Velocities of the particles around the nodes as they are now; acceleration and surface stay the
/// incident wave's.
static void simulated_velocity(State *state, int count, const Vec3 *position, Vec3 *velocity)
{
    double lap = step_clock(), share;
    Vec3 simulated;
    for (int i = 0; i < count; i++) {
        state->backend->velocity(state->particles, position[i], &simulated, &share);
        if (share > WET_SHARE) velocity[i] = simulated;
    }
    lap = step_clock() - lap;
    state->host_seconds[EFFECT_LINE_WATER] += lap;
    state->host_seconds[EFFECT_LINES] -= lap; // its clock runs around this one
}

static void water_at_nodes(const void *context, LineWater kind, double time, int count,
                           const Vec3 *position, Vec3 *velocity, Vec3 *acceleration,
                           double *elevation)
{
    const NodeWater *nodes = context;
    const Scene *scene = nodes->scene;
    const WaveState *waves = nodes->state->waves;
    double level = scene->fluid.level;
    bool still = scene->waves.kind == WAVES_NONE;
    Vec3 current = current_velocity(&scene->waves.current, time);
    if (!still) incident_velocity(scene, waves, time, count, position, velocity);
    for (int i = 0; i < count; i++) {
        velocity[i] = still ? current : vec3_add(velocity[i], current);
        acceleration[i] = still ? vec3(0, 0, 0) : waves_acceleration(waves, position[i], time);
        elevation[i] =
            level + (still ? 0 : waves_elevation(waves, position[i].x, position[i].y, time));
    }
    if (kind == LINE_WATER_SPH) simulated_velocity(nodes->state, count, position, velocity);
}

bool line_water_is_simulated(const Scene *scene)
{
    bool any = false;
    for (int l = 0; l < scene->line_count; l++)
        any = any || scene->lines[l].water == LINE_WATER_SPH;
    return any;
}

WaterField line_water(const Scene *scene, State *state, NodeWater *nodes)
{
    nodes->scene = scene;
    nodes->state = state;
    bool moves = scene->waves.kind != WAVES_NONE || scene->waves.current.speed > 0 ||
                 line_water_is_simulated(scene);
    WaterField water = {moves ? water_at_nodes : NULL,
                        nodes,
                        scene->fluid.level,
                        scene->fluid.density,
                        scene->fluid.gravity,
                        scene->domain.min.z};
    return water;
}
