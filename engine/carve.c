#include "carve.h"

#include <math.h>
#include <string.h>

/// Nodes within `reach` cells of one point learn their distance to it.
static void stamp(DistanceGrid *grid, Vec3 point, int reach)
{
    int c[3] = {(int)((point.x - grid->min.x) / grid->cell),
                (int)((point.y - grid->min.y) / grid->cell),
                (int)((point.z - grid->min.z) / grid->cell)};
    for (int k = c[2] - reach; k <= c[2] + reach + 1; k++)
        for (int j = c[1] - reach; j <= c[1] + reach + 1; j++)
            for (int i = c[0] - reach; i <= c[0] + reach + 1; i++) {
                if (i < 0 || j < 0 || k < 0 || i >= grid->count[0] || j >= grid->count[1] ||
                    k >= grid->count[2])
                    continue;
                Vec3 node = vec3(grid->min.x + i * grid->cell, grid->min.y + j * grid->cell,
                                 grid->min.z + k * grid->cell);
                float d = (float)vec3_norm(vec3_sub(node, point));
                float *value =
                    grid->values +
                    ((size_t)k * (size_t)grid->count[1] + (size_t)j) * (size_t)grid->count[0] + i;
                *value = d < *value ? d : *value;
            }
}

bool carve_grid_create(const Vec3 *points, int count, double spacing, Arena *arena,
                       DistanceGrid *grid, Error *error)
{
    memset(grid, 0, sizeof *grid);
    Vec3 low = count ? points[0] : vec3(0, 0, 0), high = low;
    for (int p = 0; p < count; p++) {
        low = vec3(mind(low.x, points[p].x), mind(low.y, points[p].y), mind(low.z, points[p].z));
        high =
            vec3(maxd(high.x, points[p].x), maxd(high.y, points[p].y), maxd(high.z, points[p].z));
    }
    grid->cell = 0.25 * spacing;
    int reach = 5;
    double margin = (reach + 2) * grid->cell;
    grid->min = vec3(low.x - margin, low.y - margin, low.z - margin);
    grid->count[0] = (int)((high.x - low.x + 2 * margin) / grid->cell) + 2;
    grid->count[1] = (int)((high.y - low.y + 2 * margin) / grid->cell) + 2;
    grid->count[2] = (int)((high.z - low.z + 2 * margin) / grid->cell) + 2;
    size_t nodes = (size_t)grid->count[0] * (size_t)grid->count[1] * (size_t)grid->count[2];
    TRY(grid->values = arena_take(arena, nodes, sizeof(float), "carving grid", error));
    for (size_t n = 0; n < nodes; n++)
        grid->values[n] = (float)(1.2 * spacing);
    for (int p = 0; p < count; p++)
        stamp(grid, points[p], reach);
    return true;
}

bool carve_hits(const Scene *scene, const Plan *plan, Vec3 point)
{
    double dp = scene->fluid.spacing;
    for (int b = 0; b < scene->body_count; b++) {
        const BodyPlan *body = &plan->bodies[b];
        Vec3 from = vec3_sub(point, body->start_origin);
        Vec3 local = quat_rotate(quat_conjugate(body->start_attitude), from);
        if (scene->domain.dimensions == 2) local.y = 0;
        if (distance_grid_sample(&body->distance, local) < CARVE_SKIN * dp) return true;
        if (distance_grid_sample(&body->dummies, local) < CARVE_DUMMY * dp) return true;
    }
    return false;
}
