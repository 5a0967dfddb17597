#include "probes.h"

#include <math.h>

double probe_elevation(const Scene *scene, const State *state, int gauge)
{
    const GaugeScene *g = &scene->gauges[gauge];
    if (scene->domain.kind == DOMAIN_LINES)
        return scene->waves.kind == WAVES_NONE
                   ? 0
                   : waves_elevation(state->waves, g->x, g->y, state->time);
    return state->backend->elevation(state->particles, g->x, g->y) - scene->fluid.level;
}

/// World place of a point on a body or on earth (body < 0).
static Vec3 world_point(const State *state, int body, Vec3 point)
{
    return body < 0 ? point : body_point(&state->bodies[body], point);
}

static Vec3 direction_of(Vec3 v) { return vec3_scale(v, 1 / vec3_norm(v)); }

enum { PATCH_POINTS = 19 };

/// Centres of equal areas of the unit disc: one in the middle, rings of 6 and 12 at the radius that
/// halves each ring's moment; in 2-D the middles of equal parts of -1 … 1.
static int patch_points(int dimensions, double (*point)[2])
{
    int count = 0;
    if (dimensions == 2) {
        for (int i = 0; i < 5; i++, count++)
            point[count][0] = -0.8 + 0.4 * i, point[count][1] = 0;
        return count;
    }
    point[count][0] = point[count][1] = 0;
    count++;
    for (int ring = 1; ring <= 2; ring++)
        for (int i = 0; i < 6 * ring; i++, count++) {
            double radius = sqrt((ring == 1 ? 4 : 13) / 19.0), angle = 2 * PI * i / (6 * ring);
            point[count][0] = radius * cos(angle);
            point[count][1] = radius * sin(angle);
        }
    return count;
}

double probe_pressure(const Scene *scene, const State *state, int probe)
{
    const PressureProbeScene *p = &scene->pressure_probes[probe];
    Vec3 at = world_point(state, p->body, p->position), normal = vec3(0, 0, 0);
    if (!isnan(p->normal.x)) {
        normal = direction_of(p->normal);
        if (p->body >= 0) normal = quat_rotate(state->bodies[p->body].attitude, normal);
    }
    if (p->patch <= 0) return state->backend->pressure(state->particles, at, normal);
    // two directions across the normal; in 2-D the first lies in the plane
    Vec3 aside = fabs(normal.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0);
    Vec3 u = direction_of(vec3_cross(normal, aside)), v = vec3_cross(normal, u);
    double point[PATCH_POINTS][2], sum = 0;
    int count = patch_points(scene->domain.dimensions, point);
    for (int i = 0; i < count; i++) {
        Vec3 place = vec3_mad(vec3_mad(at, u, 0.5 * p->patch * point[i][0]), v,
                              0.5 * p->patch * point[i][1]);
        sum += state->backend->pressure(state->particles, place, normal);
    }
    return sum / count;
}

double probe_run_up(const Scene *scene, const State *state, int line)
{
    enum { POINTS = 257, PER_SPACING = 4 };
    double share[POINTS], last = 0;
    const RunUpScene *r = &scene->run_ups[line];
    Vec3 from = world_point(state, r->body, r->from), to = world_point(state, r->body, r->to);
    double length = vec3_norm(vec3_sub(to, from)), gap = 2 * scene->fluid.spacing;
    Vec3 along = vec3_scale(vec3_sub(to, from), 1 / length);
    double part = (POINTS - 1) * scene->fluid.spacing / PER_SPACING;
    for (double begin = 0; begin < length && begin - last < gap; begin += part) {
        double end = mind(begin + part, length);
        int count = 1 + (int)ceil((end - begin) / scene->fluid.spacing * PER_SPACING);
        double step = (end - begin) / (count - 1);
        state->backend->wetness(state->particles, vec3_mad(from, along, begin),
                                vec3_mad(from, along, end), count, share);
        if (begin == 0 && share[0] < 0.5) return 0;
        for (int k = 1; k < count; k++) {
            double x = begin + k * step;
            if (x - last > gap) return last;
            if (share[k] >= 0.5)
                last = x;
            else if (share[k - 1] >= 0.5)
                last = x - step * (0.5 - share[k]) / (share[k - 1] - share[k]);
        }
    }
    return last;
}

GreenWater probe_green_water(const Scene *scene, const State *state, int deck)
{
    enum { COLUMNS_MAX = 4096 };
    double volume[COLUMNS_MAX];
    const GreenWaterScene *g = &scene->green_waters[deck];
    const Body *body = &state->bodies[g->body];
    bool plane = scene->domain.dimensions == 2;
    BodyPose pose = {body_point(body, vec3(0, 0, 0)), body->attitude};
    Vec3 min = g->min, max = g->max;
    if (plane) min.y = -0.5, max.y = 0.5;
    double width = 2 * scene->fluid.spacing;
    while (ceil((max.x - min.x) / width) * ceil((max.y - min.y) / width) > COLUMNS_MAX)
        width *= 2;
    int count[2] = {(int)maxd(1, floor((max.x - min.x) / width)),
                    plane ? 1 : (int)maxd(1, floor((max.y - min.y) / width))};
    double area = (max.x - min.x) / count[0] * (max.y - min.y) / count[1];
    state->backend->columns(state->particles, &pose, min, max, count, volume);
    GreenWater water = {0, 0};
    for (int k = 0; k < count[0] * count[1]; k++) {
        water.volume += volume[k];
        water.height = maxd(water.height, volume[k] / area);
    }
    return water;
}
