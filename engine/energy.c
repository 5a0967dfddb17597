#include "energy.h"

#include "waves.h"

/// Motion about and of the centre of gravity, and weight.
static double body_energy(const Body *body, double gravity)
{
    Vec3 w = quat_rotate(quat_conjugate(body->attitude), body->angular_velocity);
    const double spin[3] = {w.x, w.y, w.z};
    double twice = body->mass * vec3_dot(body->velocity, body->velocity);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            twice += spin[i] * body->inertia[i][k] * spin[k];
    return 0.5 * twice + body->mass * gravity * body->position.z;
}

EnergyLevels energy_levels(const Scene *scene, const State *state)
{
    FluidEnergy fluid = state->backend->energy(state->particles);
    EnergyLevels levels = {fluid.kinetic, fluid.potential, fluid.compressible, 0, 0};
    for (int b = 0; b < scene->body_count; b++)
        levels.bodies += body_energy(&state->bodies[b], scene->fluid.gravity);
    levels.lines = mooring_energy(&state->mooring);
    return levels;
}

int energy_columns(const Scene *scene, const State *state, EnergyColumn *column)
{
    if (scene->energy == ENERGY_NONE) return 0;
    EnergyLevels now = {0}, start = {0};
    FluidWorks w = {0};
    double line_work = 0;
    if (state) {
        now = energy_levels(scene, state);
        start = state->energy_start;
        w = state->backend->works(state->particles);
        line_work = state->line_work;
    }
    bool waves = scene->waves.kind != WAVES_NONE, budget = scene->energy == ENERGY_BUDGET;
    bool basin = scene_has_ring(scene);
    bool flume = waves && scene->domain.kind == DOMAIN_FLUME;
    // velocities are half a step old; the last step says how they go on
    double gained = 0.5 * w.last_kick + now.kinetic - start.kinetic + now.potential -
                    start.potential + now.compressible - start.compressible;
    double given = w.viscosity + w.diffusion + w.ring + w.piston + w.bodies + w.walls + w.zone +
                   w.shifting + w.limits + w.current;
    const struct {
        bool present;
        EnergyColumn column;
    } all[ENERGY_COLUMNS_MAX] = {
        {true, {"kinetic_j", now.kinetic}},
        {true, {"potential_j", now.potential - start.potential}},
        {true, {"compressible_j", now.compressible - start.compressible}},
        {scene->body_count, {"bodies_j", now.bodies - start.bodies}},
        {scene->line_count, {"lines_j", now.lines - start.lines}},
        {budget && flume, {"work_paddle_j", w.piston}},
        {budget && basin, {"work_ring_j", w.ring}},
        {budget && (flume || basin), {"work_zone_j", w.zone}},
        {budget && basin && scene->waves.current.speed > 0, {"work_current_j", w.current}},
        {budget && scene->body_count, {"work_bodies_j", w.bodies}},
        {budget && scene->line_count, {"work_lines_j", line_work}},
        {budget, {"work_walls_j", w.walls}},
        {budget && (scene->fluid.alpha > 0 || scene->fluid.viscosity > 0),
         {"viscosity_j", w.viscosity}},
        {budget && scene->fluid.delta > 0, {"diffusion_j", w.diffusion}},
        {budget && scene->fluid.shifting > 0, {"shifting_j", w.shifting}},
        {budget, {"limits_j", w.limits}},
        {budget, {"residual_j", gained - given}},
    };
    int count = 0;
    for (int i = 0; i < ENERGY_COLUMNS_MAX; i++)
        if (all[i].present) column[count++] = all[i].column;
    return count;
}
