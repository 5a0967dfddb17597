#include "coupling.h"

/// The body that holds an end, -1 = none, and where on it.
static int holder(const Scene *scene, const LineEnd *end, Vec3 *position)
{
    const PointScene *point = end->point >= 0 ? &scene->points[end->point] : NULL;
    *position = point ? point->position : end->position;
    if (point && point->kind == POINT_FREE) return -1;
    return point ? point->body : end->body;
}

void coupling_end(const Scene *scene, const Body *bodies, const LineEnd *end, Vec3 *position,
                  Vec3 *velocity)
{
    Vec3 place;
    int body = holder(scene, end, &place);
    *position = body < 0 ? place : body_point(&bodies[body], place);
    *velocity = body < 0 ? vec3(0, 0, 0) : body_point_velocity(&bodies[body], place);
}

void coupling_note_ends(const Scene *scene, const Body *bodies, int instant, LinePaths *paths)
{
    for (int l = 0; l < scene->line_count; l++) {
        const LineEnd *ends[2] = {&scene->lines[l].anchor, &scene->lines[l].fairlead};
        for (int side = 0; side < 2; side++) {
            EndPath *path = &paths->end[l][side];
            coupling_end(scene, bodies, ends[side], &path->position[instant],
                         &path->velocity[instant]);
        }
    }
}

void coupling_collect_loads(const Scene *scene, const Line *lines, Body *bodies)
{
    for (int b = 0; b < scene->body_count; b++)
        bodies[b].line_force = bodies[b].line_moment = vec3(0, 0, 0);
    for (int l = 0; l < scene->line_count; l++) {
        const LineEnd *ends[2] = {&scene->lines[l].anchor, &scene->lines[l].fairlead};
        for (int side = 0; side < 2; side++) {
            Vec3 place;
            int b = holder(scene, ends[side], &place);
            if (b < 0) continue;
            Body *body = &bodies[b];
            Vec3 arm = vec3_sub(body_point(body, place), body->position);
            body->line_force = vec3_add(body->line_force, lines[l].pull[side]);
            body->line_moment = vec3_add(body->line_moment, vec3_cross(arm, lines[l].pull[side]));
        }
    }
}
