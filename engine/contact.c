#include "contact.h"

#include <math.h>

#include "waves.h"

/// zeta: a ball rebounds with a third of its speed, exp(-pi zeta/sqrt(1 - zeta^2)).
static const double DAMPING_RATIO = 0.33;

enum { TOUCHES_MAX = 512, TOUCHES_SHARED = 4 };

/// One point where two things overlap.
typedef struct Touch {
    Vec3 place;   ///< world [m]
    Vec3 normal;  ///< out of the second thing
    double depth; ///< [m], > 0
} Touch;

/// All of them between a body and another, or something that does not move.
typedef struct Touches {
    int count;
    Touch touch[TOUCHES_MAX];
} Touches;

bool contact_possible(const Scene *scene)
{
    for (int b = 0; b < scene->body_count && scene->contacts.kind != CONTACTS_NONE; b++)
        for (int i = 0; i < 6; i++)
            if (scene->bodies[b].freedoms[i].kind == FREEDOM_FREE ||
                scene->bodies[b].freedoms[i].kind == FREEDOM_SPRING)
                return true;
    return false;
}

/// A sphere around a body.
static double around(const Body *body, const BodyGeometry *geometry, Vec3 *centre)
{
    const MeshProperties *p = &geometry->properties;
    *centre = body_point(body, vec3_scale(vec3_add(p->min, p->max), 0.5));
    return 0.5 * vec3_norm(vec3_sub(p->max, p->min));
}

static void add_touch(Touches *touches, Vec3 place, Vec3 normal, double depth)
{
    if (depth <= 0 || touches->count == TOUCHES_MAX) return;
    Touch touch = {place, normal, depth};
    touches->touch[touches->count++] = touch;
}

/// Vertices behind the plane (p - point).normal = 0, up to `top` high.
static void touch_plane(const Body *body, const BodyGeometry *geometry, Vec3 point, Vec3 normal,
                        double top, Touches *touches)
{
    Vec3 centre;
    double radius = around(body, geometry, &centre);
    if (vec3_dot(vec3_sub(centre, point), normal) > radius) return;
    for (int v = 0; v < geometry->mesh.vertex_count; v++) {
        Vec3 place = body_point(body, geometry->mesh.vertices[v]);
        if (place.z <= top)
            add_touch(touches, place, normal, -vec3_dot(vec3_sub(place, point), normal));
    }
}

/// Bed, and walls where the domain has them.
static void touch_domain(const Scene *scene, const Body *body, const BodyGeometry *geometry,
                         Touches *touches)
{
    const Domain *d = &scene->domain;
    bool waves = scene->waves.kind != WAVES_NONE;
    bool ring = scene_has_ring(scene), piston = d->kind == DOMAIN_FLUME && waves;
    touch_plane(body, geometry, d->min, vec3(0, 0, 1), INFINITY, touches);
    if (ring) return;
    if (!piston) touch_plane(body, geometry, d->min, vec3(1, 0, 0), d->max.z, touches);
    touch_plane(body, geometry, d->max, vec3(-1, 0, 0), d->max.z, touches);
    if (d->dimensions == 2) return;
    touch_plane(body, geometry, d->min, vec3(0, 1, 0), d->max.z, touches);
    touch_plane(body, geometry, d->max, vec3(0, -1, 0), d->max.z, touches);
}

/// Into geometry axes.
static Vec3 local_of(const Body *body, Vec3 place)
{
    Vec3 arm = vec3_sub(place, body->position);
    return vec3_add(body->centre_of_gravity, quat_rotate(quat_conjugate(body->attitude), arm));
}

static Vec3 outward(const DistanceGrid *grid, Vec3 at)
{
    double h = grid->cell;
    Vec3 slope = vec3(distance_grid_sample(grid, vec3_add(at, vec3(h, 0, 0))) -
                          distance_grid_sample(grid, vec3_add(at, vec3(-h, 0, 0))),
                      distance_grid_sample(grid, vec3_add(at, vec3(0, h, 0))) -
                          distance_grid_sample(grid, vec3_add(at, vec3(0, -h, 0))),
                      distance_grid_sample(grid, vec3_add(at, vec3(0, 0, h))) -
                          distance_grid_sample(grid, vec3_add(at, vec3(0, 0, -h))));
    double length = vec3_norm(slope);
    return length > 0 ? vec3_scale(slope, 1 / length) : vec3(0, 0, 0);
}

/// Dummy particles of `a` whose own distance to a's skin reaches into b.
/// @param sign  1: normals out of b; -1: into it
static void touch_body(const Body *a, const BodyPlan *a_plan, const Body *b, const BodyPlan *b_plan,
                       double sign, Touches *touches)
{
    Vec3 centre;
    double radius = around(b, &b_plan->geometry, &centre);
    for (int p = 0; p < a_plan->particle_count; p++) {
        Vec3 place = body_point(a, a_plan->particles[p]), from = vec3_sub(place, centre);
        if (vec3_dot(from, from) > radius * radius) continue;
        Vec3 local = local_of(b, place);
        double gap = distance_grid_sample(&b_plan->distance, local) +
                     distance_grid_sample(&a_plan->distance, a_plan->particles[p]);
        if (gap >= 0) continue;
        Vec3 normal = quat_rotate(b->attitude, outward(&b_plan->distance, local));
        add_touch(touches, place, vec3_scale(normal, sign), -gap);
    }
}

static void push(Body *body, Vec3 place, Vec3 force)
{
    Vec3 moment = vec3_cross(vec3_sub(place, body->position), force);
    body->contact_force = vec3_add(body->contact_force, force);
    body->contact_moment = vec3_add(body->contact_moment, moment);
}

static Vec3 velocity_at(const Body *body, Vec3 place)
{
    Vec3 arm = vec3_sub(place, body->position);
    return vec3_add(body->velocity, vec3_cross(body->angular_velocity, arm));
}

/// @param b  NULL: bed or wall
static void push_apart(Body *a, Body *b, const Touches *touches, double friction, double dt)
{
    bool loose = b && b->moving;
    double mass = a->mass;
    if (loose) mass = a->moving ? a->mass * b->mass / (a->mass + b->mass) : b->mass;
    double rate = 0.5 / dt, stiffness = mass * rate * rate;
    double share = 1.0 / (touches->count > TOUCHES_SHARED ? touches->count : TOUCHES_SHARED);
    for (int t = 0; t < touches->count; t++) {
        const Touch *touch = &touches->touch[t];
        Vec3 slip = velocity_at(a, touch->place);
        if (b) slip = vec3_sub(slip, velocity_at(b, touch->place));
        double parting = vec3_dot(slip, touch->normal);
        double press =
            share * (stiffness * touch->depth - 2 * DAMPING_RATIO * mass * rate * parting);
        if (press <= 0) continue;
        slip = vec3_sub(slip, vec3_scale(touch->normal, parting));
        // where it sticks, friction takes away a part of the slip in each step
        double drag = mind(friction * press / maxd(vec3_norm(slip), 1e-12), share * mass * rate);
        Vec3 force = vec3_sub(vec3_scale(touch->normal, press), vec3_scale(slip, drag));
        push(a, touch->place, force);
        if (b) push(b, touch->place, vec3_scale(force, -1));
    }
}

void contact_loads(const Scene *scene, const Plan *plan, Body *bodies)
{
    double friction = scene->contacts.friction, dt = plan->time_step;
    Touches touches;
    for (int b = 0; b < scene->body_count; b++)
        bodies[b].contact_force = bodies[b].contact_moment = vec3(0, 0, 0);
    for (int a = 0; a < scene->body_count; a++) {
        touches.count = 0;
        if (bodies[a].moving) touch_domain(scene, &bodies[a], &plan->bodies[a].geometry, &touches);
        push_apart(&bodies[a], NULL, &touches, friction, dt);
        for (int b = 0; b < a; b++) {
            if (!bodies[a].moving && !bodies[b].moving) continue;
            Vec3 centre[2];
            double reach = around(&bodies[a], &plan->bodies[a].geometry, &centre[0]) +
                           around(&bodies[b], &plan->bodies[b].geometry, &centre[1]);
            if (vec3_norm(vec3_sub(centre[0], centre[1])) > reach) continue;
            touches.count = 0;
            touch_body(&bodies[a], &plan->bodies[a], &bodies[b], &plan->bodies[b], 1, &touches);
            touch_body(&bodies[b], &plan->bodies[b], &bodies[a], &plan->bodies[a], -1, &touches);
            push_apart(&bodies[a], &bodies[b], &touches, friction, dt);
        }
    }
}
