/// Rigid bodies: free motion, constraints, springs, prescribed paths, holding.
#include "body.h"
#include "physics/rigid.h"
#include "test.h"

static const double DEGREE = PI / 180;
static const double GRAVITY = 9.81;

static BodyScene scene_of_kind(FreedomKind kind)
{
    BodyScene scene;
    memset(&scene, 0, sizeof scene);
    for (int i = 0; i < 6; i++)
        scene.freedoms[i].kind = kind;
    return scene;
}

static void prescribe(Freedom *freedom, double amplitude, double period, double phase)
{
    freedom->kind = FREEDOM_PRESCRIBED;
    freedom->amplitude = amplitude;
    freedom->period = period;
    freedom->phase = phase;
}

static void spring(Freedom *freedom, double stiffness, double rest, double damping)
{
    freedom->kind = FREEDOM_SPRING;
    freedom->stiffness = stiffness;
    freedom->rest = rest;
    freedom->damping = damping;
}

/// Mass 2 kg, inertia of an asymmetric body with a product of inertia, heading 30 deg.
static BodyGeometry geometry_asymmetric(void)
{
    BodyGeometry geometry;
    memset(&geometry, 0, sizeof geometry);
    geometry.mass = 2;
    geometry.origin = vec3(1, 2, 0.5);
    geometry.attitude = quat_from_euler(0, 0, 30 * DEGREE);
    geometry.centre_of_gravity = vec3(0.1, 0, -0.2);
    const double inertia[3][3] = {{0.5, 0.02, 0.05}, {0.02, 1.1, 0}, {0.05, 0, 1.4}};
    memcpy(geometry.inertia, inertia, sizeof inertia);
    return geometry;
}

static Vec3 world_momentum(const Body *body)
{
    Vec3 w = quat_rotate(quat_conjugate(body->attitude), body->angular_velocity);
    const double(*I)[3] = body->inertia;
    Vec3 l = vec3(I[0][0] * w.x + I[0][1] * w.y + I[0][2] * w.z,
                  I[1][0] * w.x + I[1][1] * w.y + I[1][2] * w.z,
                  I[2][0] * w.x + I[2][1] * w.y + I[2][2] * w.z);
    return quat_rotate(body->attitude, l);
}

static double rotation_energy(const Body *body)
{
    return 0.5 * vec3_dot(body->angular_velocity, world_momentum(body));
}

TEST(axes_of_roll_pitch_yaw_are_derivatives_of_the_attitude_and_duals_pick_them_out)
{
    const double angle[3] = {0.7, -0.5, 2.1}, h = 1e-6;
    Vec3 axes[3], duals[3];
    rigid_axes(vec3(angle[0], angle[1], angle[2]), axes);
    rigid_duals(vec3(angle[0], angle[1], angle[2]), duals);
    for (int i = 0; i < 3; i++) {
        double more[3] = {angle[0], angle[1], angle[2]}, less[3] = {angle[0], angle[1], angle[2]};
        more[i] += h;
        less[i] -= h;
        Quat turn = quat_mul(quat_from_euler(more[0], more[1], more[2]),
                             quat_conjugate(quat_from_euler(less[0], less[1], less[2])));
        Vec3 axis = vec3_scale(vec3(turn.x, turn.y, turn.z), 1 / h);
        CHECK_NEAR(vec3_norm(vec3_sub(axis, axes[i])), 0, 1e-9);
        for (int j = 0; j < 3; j++)
            CHECK_NEAR(vec3_dot(duals[i], axes[j]), i == j, 1e-12);
    }
    rigid_duals(vec3(0, PI / 2, 0), duals); // singular: bounded
    CHECK(vec3_norm(duals[0]) < 11 && vec3_norm(duals[2]) < 11);
}

TEST(a_free_spinning_body_keeps_momentum_and_energy_over_1e5_steps)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    // close to the unstable axis: the body tumbles
    scene.initial_velocity[4] = 3;
    scene.initial_velocity[5] = 0.05;
    Body body = body_create(&scene, &geometry);
    Vec3 before = world_momentum(&body);
    double energy = rotation_energy(&body), worst = 0;
    bool turned_over = false;
    for (int i = 0; i < 100000; i++) {
        body_advance(&body, &scene, 0, i * 0.01, 0.01);
        worst = maxd(worst, fabs(rotation_energy(&body) / energy - 1));
        turned_over |= body.attitude.x * body.attitude.x + body.attitude.z * body.attitude.z > 0.9;
    }
    CHECK(turned_over);
    CHECK(worst < 2e-3);
    CHECK_NEAR(vec3_norm(vec3_sub(world_momentum(&body), before)), 0, 1e-10);
    CHECK_NEAR(vec3_norm(vec3_sub(body.position, body.reference_position)), 0, 1e-12);
}

TEST(a_symmetric_top_precesses_at_its_exact_rate)
{
    // Ixx = Iyy = 1, Izz = 2: precession about L at |L|/Ixx.
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    const double inertia[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    memcpy(geometry.inertia, inertia, sizeof inertia);
    geometry.attitude = quat(1, 0, 0, 0);
    Body body = body_create(&scene, &geometry);
    body.angular_velocity = vec3(0.5, 0, 2);
    Vec3 momentum = world_momentum(&body), axis = quat_rotate(body.attitude, vec3(0, 0, 1));
    int steps = 4000;
    double period = 2 * PI / vec3_norm(momentum), dt = period / steps;
    for (int i = 0; i < steps; i++)
        body_advance(&body, &scene, 0, i * dt, dt);
    Vec3 after = quat_rotate(body.attitude, vec3(0, 0, 1));
    CHECK_NEAR(vec3_norm(vec3_sub(after, axis)), 0, 1e-5);
}

TEST(a_body_without_water_falls_freely)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    Body body = body_create(&scene, &geometry);
    double dt = 1e-3;
    for (int i = 0; i < 1000; i++)
        body_advance(&body, &scene, GRAVITY, i * dt, dt);
    CHECK_NEAR(body.velocity.z, -GRAVITY, 1e-9);
    CHECK_NEAR(body_motion(&body).value[2], -GRAVITY / 2, GRAVITY * dt);
    CHECK_NEAR(body.acceleration.z, -GRAVITY, 1e-9);
}

TEST(a_torque_turns_a_free_body_by_eulers_equations)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    Body body = body_create(&scene, &geometry);
    body.fluid_moment = vec3(0.1, 0.2, -0.3);
    body.line_moment = vec3(0.1, 0, 0);
    for (int i = 0; i < 2000; i++)
        body_advance(&body, &scene, 0, i * 1e-3, 1e-3);
    Vec3 expected = vec3(0.4, 0.4, -0.6); // 2 s times the moment
    CHECK_NEAR(vec3_norm(vec3_sub(world_momentum(&body), expected)), 0, 1e-10);
}

TEST(springs_oscillate_at_their_period_along_and_about_the_initial_heading)
{
    BodyScene scene = scene_of_kind(FREEDOM_FIXED);
    BodyGeometry geometry = geometry_asymmetric();
    spring(&scene.freedoms[0], 50, 0.1, 0);
    spring(&scene.freedoms[4], 20, 0, 0);
    scene.initial_offset[0] = 0.3;
    scene.initial_offset[4] = 0.05;
    Body body = body_create(&scene, &geometry);
    double surge_period = 2 * PI * sqrt(2.0 / 50), pitch_period = 2 * PI * sqrt(1.1 / 20);
    double dt = 1e-3, surge_cross = 0, pitch_cross = 0, before[2] = {1, 1};
    for (int i = 0; i < 40000; i++) {
        body_advance(&body, &scene, GRAVITY, i * dt, dt);
        BodyMotion m = body_motion(&body);
        if (before[0] < 0.1 && m.value[0] >= 0.1) surge_cross = (i + 1) * dt;
        if (before[1] < 0 && m.value[4] >= 0) pitch_cross = (i + 1) * dt;
        before[0] = m.value[0];
        before[1] = m.value[4];
    }
    double surge_turns = (surge_cross / surge_period) - 0.75;
    double pitch_turns = (pitch_cross / pitch_period) - 0.75;
    CHECK_NEAR(surge_turns, round(surge_turns), 2e-3);
    CHECK_NEAR(pitch_turns, round(pitch_turns), 2e-3);
}

TEST(spring_energy_neither_grows_nor_decays_without_damping_and_decays_with_it)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    geometry.attitude = quat(1, 0, 0, 0);
    for (int i = 3; i < 6; i++)
        spring(&scene.freedoms[i], 10, 0, 0);
    scene.initial_offset[3] = 0.2;
    scene.initial_offset[5] = -0.3;
    Body body = body_create(&scene, &geometry);
    double first = 0, last = 0;
    for (int i = 0; i < 60000; i++) {
        body_advance(&body, &scene, 0, i * 0.005, 0.005);
        BodyMotion m = body_motion(&body);
        double energy = rotation_energy(&body);
        for (int k = 3; k < 6; k++)
            energy += 0.5 * 10 * m.value[k] * m.value[k];
        if (i < 2000) first = maxd(first, energy);
        if (i >= 58000) last = maxd(last, energy);
    }
    CHECK_NEAR(last / first, 1, 0.01);
    for (int i = 3; i < 6; i++)
        scene.freedoms[i].damping = 500; // far beyond the explicit limit
    for (int i = 0; i < 60000; i++)
        body_advance(&body, &scene, 0, i * 0.005, 0.005);
    CHECK(rotation_energy(&body) < 1e-6);
}

TEST(damped_spring_decays_by_its_damping_ratio)
{
    BodyScene scene = scene_of_kind(FREEDOM_FIXED);
    BodyGeometry geometry = geometry_asymmetric();
    double omega = sqrt(50 / 2.0), ratio = 0.05;
    spring(&scene.freedoms[1], 50, 0, 2 * ratio * omega * 2);
    scene.initial_offset[1] = 1;
    Body body = body_create(&scene, &geometry);
    double dt = 1e-4, damped = omega * sqrt(1 - ratio * ratio);
    int steps = (int)round(2 * PI / damped / dt);
    for (int i = 0; i < steps; i++)
        body_advance(&body, &scene, 0, i * dt, dt);
    CHECK_NEAR(body_motion(&body).value[1], exp(-ratio * omega * 2 * PI / damped), 1e-3);
}

TEST(prescribed_paths_are_met_exactly_and_ignore_loads)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    prescribe(&scene.freedoms[2], 0.1, 1.3, 0.7);
    prescribe(&scene.freedoms[4], 0.2, 0.9, -0.3);
    Body body = body_create(&scene, &geometry);
    CHECK_NEAR(body_motion(&body).value[2], 0.1 * sin(0.7), 1e-15);
    CHECK_NEAR(body_motion(&body).rate[4], 0.2 * 2 * PI / 0.9 * cos(-0.3), 1e-12);
    double time = 0, dt = 2.3e-3;
    for (int i = 0; i < 5000; i++) {
        body.fluid_force = vec3(3, -2, 50);
        body.fluid_moment = vec3(0.2 * sin(time), 7, 0.1 * cos(time));
        body_advance(&body, &scene, GRAVITY, time, dt);
        time += dt;
    }
    BodyMotion m = body_motion(&body);
    CHECK_NEAR(m.value[2], 0.1 * sin(2 * PI / 1.3 * time + 0.7), 1e-12);
    CHECK_NEAR(m.value[4], 0.2 * sin(2 * PI / 0.9 * time - 0.3), 1e-12);
    CHECK_NEAR(m.rate[2], 0.1 * 2 * PI / 1.3 * cos(2 * PI / 1.3 * time + 0.7), 1e-10);
    CHECK_NEAR(m.rate[4], 0.2 * 2 * PI / 0.9 * cos(2 * PI / 0.9 * time - 0.3), 1e-10);
}

TEST(fixed_freedoms_do_not_drift_by_a_single_bit)
{
    BodyScene scene = scene_of_kind(FREEDOM_FIXED);
    BodyGeometry geometry = geometry_asymmetric();
    geometry.attitude = quat(1, 0, 0, 0);
    scene.freedoms[2].kind = FREEDOM_FREE;
    scene.freedoms[4].kind = FREEDOM_FREE;
    scene.initial_offset[1] = 0.07;
    Body body = body_create(&scene, &geometry), begin = body;
    for (int i = 0; i < 20000; i++) {
        body.fluid_force = vec3(5, 7, body.mass * GRAVITY + sin(i * 0.01));
        body.fluid_moment = vec3(3, sin(i * 0.01), 2);
        body_advance(&body, &scene, GRAVITY, i * 1e-3, 1e-3);
    }
    CHECK(body.position.x == begin.position.x);
    CHECK(body.position.y == begin.position.y);
    CHECK(body.position.z != begin.position.z);
    CHECK(body.velocity.x == 0 && body.velocity.y == 0);
    CHECK(body.attitude.x == 0 && body.attitude.z == 0);
    CHECK(body.attitude.y != 0);
    CHECK(body.angular_velocity.x == 0 && body.angular_velocity.z == 0);
}

TEST(a_wholly_fixed_body_never_moves)
{
    BodyScene scene = scene_of_kind(FREEDOM_FIXED);
    BodyGeometry geometry = geometry_asymmetric();
    Body body = body_create(&scene, &geometry), begin = body;
    CHECK(!body.moving);
    body.fluid_force = vec3(1e6, 1e6, 1e6);
    for (int i = 0; i < 100; i++)
        body_advance(&body, &scene, GRAVITY, i * 0.1, 0.1);
    CHECK(memcmp(&body.position, &begin.position, sizeof body.position) == 0);
    CHECK(memcmp(&body.attitude, &begin.attitude, sizeof body.attitude) == 0);
}

TEST(fixed_roll_with_free_pitch_and_yaw_keeps_energy_and_roll)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    scene.freedoms[3].kind = FREEDOM_FIXED;
    scene.initial_velocity[4] = 0.4;
    scene.initial_velocity[5] = 2;
    Body body = body_create(&scene, &geometry);
    double energy = rotation_energy(&body), worst = 0, vertical = world_momentum(&body).z;
    for (int i = 0; i < 100000; i++) {
        body_advance(&body, &scene, 0, i * 2e-3, 2e-3);
        worst = maxd(worst, fabs(rotation_energy(&body) / energy - 1));
    }
    CHECK(worst < 1e-4);
    // Roll's axis stays level with the pitched bow, yaw is vertical: vertical momentum is kept.
    CHECK_NEAR(world_momentum(&body).z, vertical, 1e-3 * vertical);
    CHECK_NEAR(body_motion(&body).value[3], 0, 1e-12);
    CHECK_NEAR(body_motion(&body).rate[3], 0, 1e-12);
}

TEST(a_constraint_torque_does_no_work_on_free_axes)
{
    // Roll fixed: pitch turns about a level axis, yaw about the vertical; a moment square to both
    // (level, along the heading) moves nothing, though the body is pitched and asymmetric.
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    scene.freedoms[3].kind = FREEDOM_FIXED;
    scene.initial_offset[4] = 20 * DEGREE;
    Body body = body_create(&scene, &geometry), begin = body;
    body.fluid_moment = vec3(5 * cos(30 * DEGREE), 5 * sin(30 * DEGREE), 0);
    for (int i = 0; i < 1000; i++)
        body_advance(&body, &scene, 0, i * 1e-3, 1e-3);
    CHECK_NEAR(vec3_norm(body.angular_velocity), 0, 1e-10);
    CHECK_NEAR(body.attitude.y, begin.attitude.y, 1e-10);
}

TEST(a_body_in_a_plane_turns_over_and_reads_as_it_turns)
{
    BodyScene scene = scene_of_kind(FREEDOM_FIXED);
    BodyGeometry geometry = geometry_asymmetric();
    scene.freedoms[4].kind = FREEDOM_FREE;
    scene.initial_velocity[4] = 3;
    Body body = body_create(&scene, &geometry);
    double begin = rotation_energy(&body), time = 0;
    for (int i = 0; i < 4000; i++, time += 1e-3) { // nearly two turns
        body_advance(&body, &scene, GRAVITY, time, 1e-3);
        BodyMotion motion = body_motion(&body);
        CHECK(motion.value[3] == 0 && motion.value[5] == 0);
        CHECK_NEAR(motion.value[4], 3 * (time + 1e-3), 1e-9);
        CHECK_NEAR(motion.rate[4], 3, 1e-9);
    }
    CHECK_NEAR(rotation_energy(&body) / begin, 1, 1e-9);
    // driven, too
    prescribe(&scene.freedoms[4], 170 * DEGREE, 2, 0);
    body = body_create(&scene, &geometry);
    for (int i = 0; i < 1000; i++) {
        body_advance(&body, &scene, GRAVITY, i * 1e-3, 1e-3);
        double end = (i + 1) * 1e-3 * PI;
        CHECK_NEAR(body_motion(&body).value[4], 170 * DEGREE * sin(end), 1e-12);
        CHECK_NEAR(vec3_norm(body.angular_velocity), 170 * DEGREE * PI * fabs(cos(end)), 1e-9);
    }
}

TEST(constraints_hold_in_the_axes_of_the_initial_heading)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    scene.freedoms[1].kind = FREEDOM_FIXED;
    Body body = body_create(&scene, &geometry);
    body.fluid_force = vec3(0, 4, body.mass * GRAVITY);
    for (int i = 0; i < 1000; i++)
        body_advance(&body, &scene, GRAVITY, i * 1e-3, 1e-3);
    // along the heading of 30 deg only the share sin 30 of the force pushes: a = 4 sin 30 / 2
    BodyMotion m = body_motion(&body);
    CHECK_NEAR(m.rate[0], 1.0, 1e-9);
    CHECK_NEAR(m.value[1], 0, 1e-14);
    CHECK_NEAR(body.velocity.y / body.velocity.x, tan(30 * DEGREE), 1e-12);
}

TEST(heel_of_the_pose_counts_as_roll_and_offsets_add_to_it)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    geometry.attitude = quat_from_euler(5 * DEGREE, -2 * DEGREE, 100 * DEGREE);
    scene.initial_offset[3] = 10 * DEGREE;
    scene.initial_offset[0] = 0.4;
    Body body = body_create(&scene, &geometry);
    BodyMotion m = body_motion(&body);
    CHECK_NEAR(m.value[0], 0.4, 1e-12);
    CHECK_NEAR(m.value[3], 15 * DEGREE, 1e-12);
    CHECK_NEAR(m.value[4], -2 * DEGREE, 1e-12);
    CHECK_NEAR(m.value[5], 0, 1e-12);
}

TEST(a_held_body_waits_and_starts_with_its_initial_velocity)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    scene.hold_time = 1;
    scene.initial_velocity[2] = -0.5;
    scene.initial_offset[2] = 0.2;
    Body body = body_create(&scene, &geometry), begin = body;
    double time = 0, dt = 0.1;
    while (time < 0.95) {
        CHECK(vec3_norm(body.velocity) == 0);
        body_advance(&body, &scene, GRAVITY, time, dt);
        time += dt;
    }
    CHECK_NEAR(time, 1, 1e-12);
    CHECK_NEAR(vec3_norm(vec3_sub(body.position, begin.position)), 0, 1e-14);
    CHECK_NEAR(body.velocity.z, -0.5, 1e-14);
    body_advance(&body, &scene, GRAVITY, time, dt);
    CHECK_NEAR(body.velocity.z, -0.5 - GRAVITY * dt, 1e-12);
}

TEST(points_of_a_body_move_as_its_pose_does)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    for (int i = 0; i < 6; i++)
        scene.initial_velocity[i] = 0.3 + 0.2 * i;
    Body body = body_create(&scene, &geometry);
    Vec3 point = vec3(0.7, -0.4, 0.3), start = body_point(&body, vec3(0, 0, 0));
    CHECK_NEAR(vec3_norm(vec3_sub(start, geometry.origin)), 0, 1e-14);
    double dt = 1e-4;
    body.fluid_force = vec3(1, 2, 3);
    body.fluid_moment = vec3(0.3, -0.4, 0.5);
    Body before = body, now, after;
    body_advance(&body, &scene, GRAVITY, 0, dt);
    now = body;
    body_advance(&body, &scene, GRAVITY, 0, dt);
    after = body;
    Vec3 p0 = body_point(&before, point), p1 = body_point(&now, point),
         p2 = body_point(&after, point);
    Vec3 v = vec3_scale(vec3_sub(p2, p0), 1 / (2 * dt));
    Vec3 a = vec3_scale(vec3_add(vec3_sub(p2, p1), vec3_sub(p0, p1)), 1 / (dt * dt));
    CHECK_NEAR(vec3_norm(vec3_sub(v, body_point_velocity(&now, point))), 0, 20 * dt);
    CHECK_NEAR(vec3_norm(vec3_sub(a, body_point_acceleration(&now, point))), 0, 100 * dt);
}

TEST(the_stiffest_spring_limits_the_step)
{
    BodyScene scene = scene_of_kind(FREEDOM_FREE);
    BodyGeometry geometry = geometry_asymmetric();
    Body body = body_create(&scene, &geometry);
    CHECK(isinf(body_step_limit(&body, &scene)));
    spring(&scene.freedoms[2], 800, 0, 0);
    double limit = body_step_limit(&body, &scene);
    CHECK_NEAR(limit, 2 * sqrt(2.0 / 800), 1e-12);
    double largest[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        scene.initial_offset[2] = 0.01;
        body = body_create(&scene, &geometry);
        double dt = limit * (k ? 1.02 : 0.98);
        for (int i = 0; i < 500; i++) {
            body_advance(&body, &scene, 0, i * dt, dt);
            largest[k] = maxd(largest[k], fabs(body_motion(&body).value[2]));
        }
    }
    CHECK(largest[0] < 0.1);
    CHECK(largest[1] > 1);
}
