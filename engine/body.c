/// Time stepping. Both halves are symmetric in time, so energy does not drift:
///
/// Translation, per axis of the initial heading: v <- v + dt F/m, x <- x + dt v.
/// Rotation: world angular momentum L <- I omega + dt M; then over the step, at the mid pose,
/// omega_m with E^T (I_m omega_m - L) = 0 and at the end E^T (I_1 omega_1 - I_m omega_m) = 0, E the
/// free axes at the mid pose. With all axes free this is I omega = L: momentum is kept to rounding
/// and the pose follows Lie's midpoint rule (Hairer, Lubich & Wanner 2006, IV.8, VII.5).
/// Springs act at the beginning of the step, their damping at its end (implicit).
#include "body.h"

#include <string.h>

#include "physics/rigid.h"

static bool is_imposed(FreedomKind kind)
{
    return kind == FREEDOM_FIXED || kind == FREEDOM_PRESCRIBED;
}

/// Axes of the initial heading: what surge, sway and heave are counted along.
static Quat heading_frame(const Body *body)
{
    return quat_from_euler(0, 0, quat_to_euler(body->reference_attitude).z);
}

static Vec3 frame_vector(Quat frame, Vec3 world)
{
    return quat_rotate(quat_conjugate(frame), world);
}

static Vec3 vec3_from(const double *value) { return vec3(value[0], value[1], value[2]); }
static void vec3_to(Vec3 v, double *value)
{
    value[0] = v.x;
    value[1] = v.y;
    value[2] = v.z;
}

/// Motion at the reference pose: no displacement; heel and trim as the case places the body.
static void reference_motion(const Body *body, double *value)
{
    Vec3 angle = quat_to_euler(body->reference_attitude);
    memset(value, 0, 6 * sizeof *value);
    value[3] = angle.x;
    value[4] = angle.y;
}

/// Roll, pitch, yaw off the initial heading. From the attitude alone a pitch beyond 90 deg would
/// read as less, with roll and yaw of 180: where rotations are imposed, in 2-D above all, they are
/// followed instead, as long as they mean the same attitude.
static Vec3 angles_of(const Body *body, Quat attitude)
{
    if (!body->constrained) return quat_to_euler(attitude);
    Quat q = quat_from_euler(body->angle.x, body->angle.y, body->angle.z);
    double same = q.w * attitude.w + q.x * attitude.x + q.y * attitude.y + q.z * attitude.z;
    return fabs(same) > 1 - 1e-10 ? body->angle : quat_to_euler(attitude);
}

BodyMotion body_motion(const Body *body)
{
    BodyMotion motion;
    Vec3 duals[3];
    Quat frame = heading_frame(body);
    Vec3 angle = angles_of(body, quat_mul(quat_conjugate(frame), body->attitude));
    Vec3 omega = frame_vector(frame, body->angular_velocity);
    vec3_to(frame_vector(frame, vec3_sub(body->position, body->reference_position)), motion.value);
    vec3_to(frame_vector(frame, body->velocity), motion.rate);
    vec3_to(angle, motion.value + 3);
    rigid_duals(angle, duals);
    for (int i = 0; i < 3; i++)
        motion.rate[3 + i] = vec3_dot(duals[i], omega);
    return motion;
}

/// Put the body where `motion` says.
static void body_place(Body *body, const BodyMotion *motion)
{
    Vec3 axes[3], omega = vec3(0, 0, 0);
    Quat frame = heading_frame(body);
    const double *value = motion->value;
    body->angle = vec3_from(value + 3);
    rigid_axes(body->angle, axes);
    for (int i = 0; i < 3; i++)
        omega = vec3_mad(omega, axes[i], motion->rate[3 + i]);
    body->position = vec3_add(body->reference_position, quat_rotate(frame, vec3_from(value)));
    body->velocity = quat_rotate(frame, vec3_from(motion->rate));
    body->attitude = quat_normalise(quat_mul(frame, quat_from_euler(value[3], value[4], value[5])));
    body->angular_velocity = quat_rotate(frame, omega);
}

/// Path of a prescribed freedom about its mean.
static void prescribed(const Freedom *freedom, double mean, double time, double *value,
                       double *rate)
{
    double omega = 2 * PI / freedom->period, angle = omega * time + freedom->phase;
    double ramp = 1, ramp_rate = 0;
    if (time < freedom->ramp) {
        double grown = PI * time / freedom->ramp;
        ramp = 0.5 * (1 - cos(grown));
        ramp_rate = 0.5 * PI / freedom->ramp * sin(grown);
    }
    *value = mean + ramp * freedom->amplitude * sin(angle);
    *rate = freedom->amplitude * (ramp * omega * cos(angle) + ramp_rate * sin(angle));
}

Body body_create(const BodyScene *scene, const BodyGeometry *geometry)
{
    Body body;
    BodyMotion motion;
    memset(&body, 0, sizeof body);
    memset(&motion, 0, sizeof motion);
    body.centre_of_gravity = geometry->centre_of_gravity;
    body.mass = geometry->mass;
    memcpy(body.inertia, geometry->inertia, sizeof body.inertia);
    body.reference_attitude = quat_normalise(geometry->attitude);
    body.reference_position =
        vec3_add(geometry->origin, quat_rotate(body.reference_attitude, body.centre_of_gravity));
    reference_motion(&body, motion.value);
    for (int i = 0; i < 6; i++) {
        const Freedom *freedom = &scene->freedoms[i];
        motion.value[i] += scene->initial_offset[i];
        if (freedom->kind != FREEDOM_FIXED) body.moving = true;
        if (i >= 3 && is_imposed(freedom->kind)) body.constrained = true;
        if (freedom->kind == FREEDOM_PRESCRIBED)
            prescribed(freedom, motion.value[i], 0, &motion.value[i], &motion.rate[i]);
        else if (freedom->kind != FREEDOM_FIXED && !(scene->hold_time > 0))
            motion.rate[i] = scene->initial_velocity[i];
    }
    body.motion = geometry->motion;
    if (body.motion) motion_add(body.motion, 0, motion.value, motion.rate);
    body_place(&body, &motion);
    return body;
}

static Vec3 arm_of(const Body *body, Vec3 point)
{
    return quat_rotate(body->attitude, vec3_sub(point, body->centre_of_gravity));
}

Vec3 body_point(const Body *body, Vec3 point)
{
    return vec3_add(body->position, arm_of(body, point));
}

Vec3 body_point_velocity(const Body *body, Vec3 point)
{
    return vec3_add(body->velocity, vec3_cross(body->angular_velocity, arm_of(body, point)));
}

Vec3 body_point_acceleration(const Body *body, Vec3 point)
{
    Vec3 arm = arm_of(body, point), omega = body->angular_velocity;
    Vec3 tangential = vec3_cross(body->angular_acceleration, arm);
    Vec3 centripetal = vec3_cross(omega, vec3_cross(omega, arm));
    return vec3_add(body->acceleration, vec3_add(tangential, centripetal));
}

// ---------------------------------------------------------------------------- one step

/// What each freedom does in this step: `kind` is FREE, FIXED, PRESCRIBED or SPRING after holding;
/// `value` and `rate` at the end of the step where it is imposed.
typedef struct Imposed {
    FreedomKind kind[6];
    double value[6], rate[6];
} Imposed;

static Imposed imposed_at(const Body *body, const BodyScene *scene, bool held, double end)
{
    Imposed imposed;
    reference_motion(body, imposed.value);
    for (int i = 0; i < 6; i++) {
        const Freedom *freedom = &scene->freedoms[i];
        imposed.kind[i] = freedom->kind;
        imposed.value[i] += scene->initial_offset[i];
        imposed.rate[i] = 0;
        if (freedom->kind == FREEDOM_PRESCRIBED)
            prescribed(freedom, imposed.value[i], end, &imposed.value[i], &imposed.rate[i]);
        else if (held)
            imposed.kind[i] = FREEDOM_FIXED;
    }
    if (body->motion) motion_add(body->motion, end, imposed.value, imposed.rate);
    return imposed;
}

/// Surge, sway, heave along the axes of the initial heading.
static void advance_translation(const Body *body, const BodyScene *scene, const Imposed *imposed,
                                Vec3 force, double dt, BodyMotion *motion)
{
    double along[3];
    vec3_to(force, along);
    for (int i = 0; i < 3; i++) {
        const Freedom *freedom = &scene->freedoms[i];
        if (is_imposed(imposed->kind[i])) {
            motion->value[i] = imposed->value[i];
            motion->rate[i] = imposed->rate[i];
            continue;
        }
        double damping = 0;
        if (imposed->kind[i] == FREEDOM_SPRING) {
            along[i] -= freedom->stiffness * (motion->value[i] - freedom->rest);
            damping = freedom->damping;
        }
        motion->rate[i] =
            (motion->rate[i] + dt * along[i] / body->mass) / (1 + dt * damping / body->mass);
        motion->value[i] += dt * motion->rate[i];
    }
}

/// Rotation in the axes of the initial heading.
typedef struct Rotation {
    Quat attitude;
    Vec3 omega;
    Vec3 angle;
} Rotation;

/// Largest change of the mid pose [rad] at which its iteration stops, and most rounds of it.
static const double MIDPOINT_TOLERANCE = 1e-15;
enum { MIDPOINT_ROUNDS = 20 };

/// Momentum after the moment of the step with its springs, and the springs' implicit damping.
static void apply_moment(const BodyScene *scene, const Imposed *imposed, const Rotation *rotation,
                         double dt, Vec3 *momentum, Mat3 *damping)
{
    Vec3 duals[3];
    double angle[3];
    memset(damping, 0, sizeof *damping);
    rigid_duals(rotation->angle, duals);
    vec3_to(rotation->angle, angle);
    for (int i = 0; i < 3; i++) {
        const Freedom *freedom = &scene->freedoms[3 + i];
        if (imposed->kind[3 + i] != FREEDOM_SPRING) continue;
        double moment = -freedom->stiffness * (angle[i] - freedom->rest);
        *momentum = vec3_mad(*momentum, duals[i], dt * moment);
        *damping = mat3_add_square(*damping, duals[i], dt * freedom->damping);
    }
}

static Mat3 mat3_sum(Mat3 a, const Mat3 *b)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            a.at[i][j] += b->at[i][j];
    return a;
}

/// All three axes free: quaternions throughout, no angle is singular.
static void rotate_free(Mat3 inertia, Vec3 momentum, const Mat3 *damping, double dt,
                        Rotation *rotation)
{
    static const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double rates[3];
    Quat begin = rotation->attitude;
    Vec3 omega = rotation->omega, none = vec3(0, 0, 0);
    for (int round = 0; round < MIDPOINT_ROUNDS; round++) {
        Quat middle = quat_mul(quat_from_turn(vec3_scale(omega, dt / 2)), begin);
        Mat3 m = mat3_sum(rigid_inertia(middle, inertia), damping);
        Vec3 next = rigid_project(m, momentum, none, 3, axes, axes, rates);
        double change = dt * vec3_norm(vec3_sub(next, omega));
        omega = next;
        if (change < MIDPOINT_TOLERANCE) break;
    }
    momentum = vec3_sub(momentum, mat3_apply(*damping, omega));
    rotation->attitude = quat_normalise(quat_mul(quat_from_turn(vec3_scale(omega, dt)), begin));
    rotation->omega = rigid_project(rigid_inertia(rotation->attitude, inertia), momentum, none, 3,
                                    axes, axes, rates);
    rotation->angle = quat_to_euler(rotation->attitude);
}

/// Split the axes at `angle` into those free to move and the velocity the others impose.
static int split_axes(const FreedomKind *kind, const double *rate, Vec3 angle, Vec3 *free_axes,
                      Vec3 *given)
{
    Vec3 axes[3];
    int count = 0;
    *given = vec3(0, 0, 0);
    rigid_axes(angle, axes);
    for (int i = 0; i < 3; i++) {
        if (is_imposed(kind[i]))
            *given = vec3_mad(*given, axes[i], rate[i]);
        else
            free_axes[count++] = axes[i];
    }
    return count;
}

/// Some axes imposed: roll, pitch and yaw are the coordinates, so imposed ones are met exactly.
static void rotate_constrained(const Imposed *imposed, Mat3 inertia, Vec3 momentum,
                               const Mat3 *damping, double dt, Rotation *rotation)
{
    const FreedomKind *kind = imposed->kind + 3;
    double begin[3], middle[3], end[3], mean_rate[3], rates[3] = {0, 0, 0};
    Vec3 free_axes[3], end_axes[3], given, omega = rotation->omega;
    Mat3 m;
    vec3_to(rotation->angle, begin);
    for (int i = 0; i < 3; i++) {
        end[i] = is_imposed(kind[i]) ? imposed->value[3 + i] : begin[i];
        mean_rate[i] = is_imposed(kind[i]) ? (end[i] - begin[i]) / dt : 0;
        middle[i] = (begin[i] + end[i]) / 2;
    }
    int count = 0;
    for (int round = 0; round < MIDPOINT_ROUNDS; round++) {
        Vec3 angle = vec3_from(middle);
        double change = 0;
        count = split_axes(kind, mean_rate, angle, free_axes, &given);
        m = rigid_inertia(quat_from_euler(angle.x, angle.y, angle.z), inertia);
        omega = rigid_project(mat3_sum(m, damping), momentum, given, count, free_axes, free_axes,
                              rates);
        for (int i = 0, k = 0; i < 3; i++) {
            if (is_imposed(kind[i])) continue;
            double next = begin[i] + dt / 2 * rates[k++];
            change = maxd(change, fabs(next - middle[i]));
            middle[i] = next;
            end[i] = 2 * next - begin[i];
        }
        if (change < MIDPOINT_TOLERANCE) break;
    }
    rotation->angle = vec3_from(end);
    rotation->attitude = quat_normalise(quat_from_euler(end[0], end[1], end[2]));
    split_axes(kind, imposed->rate + 3, rotation->angle, end_axes, &given);
    rotation->omega = rigid_project(rigid_inertia(rotation->attitude, inertia),
                                    mat3_apply(m, omega), given, count, end_axes, free_axes, rates);
}

static void advance_rotation(const Body *body, const BodyScene *scene, const Imposed *imposed,
                             Vec3 moment, double dt, Rotation *rotation)
{
    Mat3 inertia, damping;
    memcpy(inertia.at, body->inertia, sizeof inertia.at);
    Mat3 now = rigid_inertia(rotation->attitude, inertia);
    Vec3 momentum = vec3_mad(mat3_apply(now, rotation->omega), moment, dt);
    apply_moment(scene, imposed, rotation, dt, &momentum, &damping);
    bool constrained = false;
    for (int i = 3; i < 6; i++)
        constrained |= is_imposed(imposed->kind[i]);
    if (constrained)
        rotate_constrained(imposed, inertia, momentum, &damping, dt, rotation);
    else
        rotate_free(inertia, momentum, &damping, dt, rotation);
}

/// A held body is let go with its initial velocity.
static void release(Body *body, const BodyScene *scene)
{
    BodyMotion motion = body_motion(body);
    for (int i = 0; i < 6; i++)
        if (!is_imposed(scene->freedoms[i].kind)) motion.rate[i] = scene->initial_velocity[i];
    body_place(body, &motion);
}

void body_advance(Body *body, const BodyScene *scene, double gravity, double time, double dt)
{
    if (!body->moving || !(dt > 0)) return;
    // The margin keeps the release from being missed when the caller's clock rounds differently.
    bool held = time < scene->hold_time - 1e-6 * dt;
    Imposed imposed = imposed_at(body, scene, held, time + dt);
    Quat frame = heading_frame(body);
    Vec3 velocity = body->velocity, angular_velocity = body->angular_velocity;
    Vec3 force = vec3_add(vec3_add(body->fluid_force, body->line_force), body->contact_force);
    Vec3 moment = vec3_add(vec3_add(body->fluid_moment, body->line_moment), body->contact_moment);
    moment = frame_vector(frame, moment);
    force.z -= body->mass * gravity;

    BodyMotion motion = body_motion(body);
    advance_translation(body, scene, &imposed, frame_vector(frame, force), dt, &motion);
    Rotation rotation;
    rotation.attitude = quat_mul(quat_conjugate(frame), body->attitude);
    rotation.omega = frame_vector(frame, angular_velocity);
    rotation.angle = vec3_from(motion.value + 3);
    advance_rotation(body, scene, &imposed, moment, dt, &rotation);

    body->position =
        vec3_add(body->reference_position, quat_rotate(frame, vec3_from(motion.value)));
    body->velocity = quat_rotate(frame, vec3_from(motion.rate));
    body->attitude = quat_normalise(quat_mul(frame, rotation.attitude));
    body->angle = rotation.angle;
    body->angular_velocity = quat_rotate(frame, rotation.omega);
    body->acceleration = vec3_scale(vec3_sub(body->velocity, velocity), 1 / dt);
    body->angular_acceleration =
        vec3_scale(vec3_sub(body->angular_velocity, angular_velocity), 1 / dt);
    if (held && time + dt >= scene->hold_time - 1e-6 * dt) release(body, scene);
}

double body_step_limit(const Body *body, const BodyScene *scene)
{
    double limit = INFINITY;
    for (int i = 0; i < 6; i++) {
        const Freedom *freedom = &scene->freedoms[i];
        if (freedom->kind != FREEDOM_SPRING || !(freedom->stiffness > 0)) continue;
        // The smallest inertia about any axis in the plane of a diagonal pair bounds the frequency.
        double inertia = i < 3 ? body->mass : body->inertia[i - 3][i - 3];
        for (int j = 0; i >= 3 && j < 3; j++)
            inertia = mind(inertia, body->inertia[j][j]);
        limit = mind(limit, 2 * sqrt(inertia / freedom->stiffness));
    }
    return limit;
}
