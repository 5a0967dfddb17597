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

static const LineEnd *end_of(const Scene *scene, int line, int side)
{
    return side ? &scene->lines[line].fairlead : &scene->lines[line].anchor;
}

int coupling_holder(const Scene *scene, int line, int side)
{
    Vec3 place;
    return holder(scene, end_of(scene, line, side), &place);
}

bool coupling_free(const Scene *scene, int line, int side)
{
    int point = end_of(scene, line, side)->point;
    return point >= 0 && scene->points[point].kind == POINT_FREE;
}

/// An end's pull and its moment about the centre of gravity of the body that holds it.
static void add_pull(const Line *line, int side, const Body *body, Vec3 place, Vec3 *force,
                     Vec3 *moment)
{
    Vec3 arm = vec3_sub(body_point(body, place), body->position);
    *force = vec3_add(*force, line->pull[side]);
    *moment = vec3_add(*moment, vec3_cross(arm, line->pull[side]));
}

void coupling_load(const Scene *scene, const Line *lines, const Body *bodies, int b, Vec3 *force,
                   Vec3 *moment)
{
    Vec3 place;
    *force = *moment = vec3(0, 0, 0);
    for (int l = 0; l < scene->line_count; l++)
        for (int side = 0; side < 2; side++)
            if (holder(scene, end_of(scene, l, side), &place) == b)
                add_pull(&lines[l], side, &bodies[b], place, force, moment);
}

void coupling_collect_loads(const Scene *scene, const Line *lines, Body *bodies)
{
    Vec3 place;
    for (int b = 0; b < scene->body_count; b++)
        bodies[b].line_force = bodies[b].line_moment = vec3(0, 0, 0);
    for (int l = 0; l < scene->line_count; l++)
        for (int side = 0; side < 2; side++) {
            int b = holder(scene, end_of(scene, l, side), &place);
            if (b < 0) continue;
            Body *body = &bodies[b];
            add_pull(&lines[l], side, body, place, &body->line_force, &body->line_moment);
        }
}
