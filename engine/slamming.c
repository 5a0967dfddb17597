#include "slamming.h"

#include <math.h>

/// y' = w (u - y) over one step.
static double first_order(FilterSection *s, double w, double before, double input, double dt)
{
    double a = 0.5 * dt * w;
    s->value = ((1 - a) * s->value + a * (before + input)) / (1 + a);
    return s->value;
}

/// y'' = w^2 (u - y) - d w y' over one step.
static double second_order(FilterSection *s, double w, double d, double before, double input,
                           double dt)
{
    double y = s->value, v = s->rate, half = 0.5 * dt;
    double pull = w * w * (before - y) - d * w * v;
    s->rate = (v + half * (pull + w * w * (input - y - half * v))) /
              (1 + half * d * w + half * half * w * w);
    s->value = y + half * (v + s->rate);
    return s->value;
}

double slamming_low_pass(FilterSection *section, int order, double cutoff, double before,
                         double input, double dt)
{
    double w = 2 * PI * cutoff;
    for (int k = 0; k < (order + 1) / 2; k++) {
        FilterSection *s = &section[k];
        double next = s->value; // what the next section saw at the step before
        if (2 * k + 1 == order)
            input = first_order(s, w, before, input, dt);
        else
            input = second_order(s, w, 2 * sin((2 * k + 1) * PI / (2 * order)), before, input, dt);
        before = next;
    }
    return input;
}

void slamming_advance(Slamming *slamming, const SlammingScene *probe, const Scene *scene,
                      const Body *body, const BodyGeometry *geometry, double dt)
{
    const Fluid *fluid = &scene->fluid;
    Hydrostatics h = mesh_hydrostatics(&geometry->mesh, body_point(body, vec3(0, 0, 0)),
                                       body->attitude, body->centre_of_gravity, body->mass,
                                       body->inertia, fluid->level, fluid->density, fluid->gravity);
    double dynamic[3] = {body->fluid_force.x, body->fluid_force.y,
                         body->fluid_force.z - fluid->density * fluid->gravity * h.displacement};
    double slow[3];
    for (int a = 0; a < 3; a++) {
        // begin settled: nothing but what comes is fast
        for (int k = 0; k < SLAMMING_SECTIONS && !slamming->begun; k++)
            slamming->section[a][k].value = slamming->input[a] = dynamic[a];
        slow[a] = slamming_low_pass(slamming->section[a], probe->order, probe->cutoff,
                                    slamming->input[a], dynamic[a], dt);
        slamming->input[a] = dynamic[a];
    }
    slamming->begun = true;
    slamming->force = vec3(dynamic[0] - slow[0], dynamic[1] - slow[1], dynamic[2] - slow[2]);
}
