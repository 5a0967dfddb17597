#include "energy.h"

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
    for (int l = 0; l < scene->line_count; l++)
        levels.lines += line_energy(&state->lines[l]);
    return levels;
}

double *energy_sample(const Scene *scene, const State *state, double *row)
{
    EnergyLevels now = energy_levels(scene, state);
    const EnergyLevels *start = &state->energy_start;
    *row++ = now.kinetic;
    *row++ = now.potential - start->potential;
    *row++ = now.compressible - start->compressible;
    if (scene->body_count) *row++ = now.bodies - start->bodies;
    if (scene->line_count) *row++ = now.lines - start->lines;
    return row;
}
