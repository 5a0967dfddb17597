#include "probes.h"

double probe_elevation(const Scene *scene, const State *state, int gauge)
{
    const GaugeScene *g = &scene->gauges[gauge];
    return state->backend->elevation(state->particles, g->x, g->y) - scene->fluid.level;
}

double probe_pressure(const Scene *scene, const State *state, int probe)
{
    const PressureProbeScene *p = &scene->pressure_probes[probe];
    Vec3 at = p->body < 0 ? p->position : body_point(&state->bodies[p->body], p->position);
    return state->backend->pressure(state->particles, at);
}
