/// Bodies keep the water out: no jet a particle thin goes through a hull's dummies.
#include "scenes.h"

#include "hull.h"
#include "water_block.h"

/// How deep the deepest water lies behind the skin of the first body [spacings].
static double deepest_behind(const Run *run)
{
    static float place[20000][3];
    const BodyPose *pose = &run->state->poses[0];
    double deepest = 0;
    CHECK(run->plan.fluid_count <= 20000);
    run->state->backend->download(run->state->particles, place, NULL, NULL);
    for (int i = 0; i < run->plan.fluid_count; i++) {
        Vec3 arm = vec3_sub(vec3((double)place[i][0], (double)place[i][1], (double)place[i][2]),
                            pose->origin);
        Vec3 at = quat_rotate(quat_conjugate(pose->attitude), arm);
        if (run->scene.domain.dimensions == 2) at.y = 0;
        deepest = maxd(deepest, -distance_grid_sample(&run->plan.bodies[0].distance, at));
    }
    return deepest / run->scene.fluid.spacing;
}

/// Water that a body stirs by heaving through its surface.
static double deepest_while_stirred(const char *file, double until)
{
    static Scene scene;
    CHECK(scene_load(file, NULL, 0, &scene, &error));
    Run *run = start(&scene, 2);
    double deepest = 0;
    while (run->state->time < until) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        deepest = maxd(deepest, deepest_behind(run));
    }
    printf("  deepest %.2f spacings\n", deepest);
    finish(run);
    return deepest;
}

// Without the hold 2.0 and 1.2 spacings: among the dummies.
TEST(water_stays_out_of_a_stirring_cylinder)
{
    CHECK(deepest_while_stirred(SOURCE_DIR "/tests/good_cases/stirring_cylinder.json", 2.4) < 0.6);
}

TEST(water_stays_out_of_a_stirring_ball)
{
    CHECK(deepest_while_stirred(SOURCE_DIR "/tests/good_cases/stirring_ball.json", 1.6) < 0.6);
}

static const double MASS = 0.125, DT = 1e-3, RADIUS = 0.2;

static double ball_skin(const void *context, int body, Vec3 at)
{
    (void)context;
    (void)body;
    return vec3_norm(at) - RADIUS;
}

/// One particle of water, without weight or pressure, in a ball that drifts and turns.
typedef struct Stray {
    Arena arena;
    Backend *backend;
    BodyPose pose;
    Vec3 dummies[8], place, velocity;
    float excess;
} Stray;

static void stray_create(Stray *s, Vec3 place, Vec3 velocity)
{
    static const int16_t owners[8] = {0};
    memset(s, 0, sizeof *s);
    s->arena = arena_create(0);
    s->place = place;
    s->velocity = velocity;
    s->pose = (BodyPose){{0.5, 0.5, 0.5}, {1, 0, 0, 0}};
    for (int k = 0; k < 8; k++)
        s->dummies[k] = vec3(k & 1 ? 0.17 : -0.17, k & 2 ? 0.17 : -0.17, k & 4 ? 0.17 : -0.17);
    BackendSetup setup = water_setup(3);
    setup.body_count = 1;
    ParticleStart particles = {1, &s->place, &s->velocity, &s->excess, 8, s->dummies, owners};
    CHECK(backend_cpu()->create(&setup, &particles, &s->arena, &s->backend, &error));
    Advance advance = {.poses = &s->pose, .skin = ball_skin};
    backend_cpu()->place(s->backend, &advance);
}

static void stray_step(Stray *s, BodyPose pose, Vec3 about, BodyLoad *load)
{
    ParticleSums sums;
    s->pose = pose;
    Advance advance = {.dt = DT, .poses = &s->pose, .skin = ball_skin};
    CHECK(backend_cpu()->forces(s->backend, &about, load, &error));
    backend_cpu()->advance(s->backend, &advance, &sums);
}

static Vec3 stray_velocity(const Stray *s)
{
    float v[1][3];
    backend_cpu()->download(s->backend, NULL, v, NULL);
    return vec3((double)v[0][0], (double)v[0][1], (double)v[0][2]);
}

static void swim_back(double height, bool deep)
{
    Stray s;
    Vec3 place = vec3(0.5, 0.5, height), about = vec3(0.45, 0.5, 0.5);
    BodyLoad load;
    stray_create(&s, place, vec3(0, 0, 0));
    // the ball goes along x and down by a millimetre a step: 1 m/s
    BodyPose pose = {{0.501, 0.5, 0.499}, {1, 0, 0, 0}};
    stray_step(&s, pose, about, &load);
    Vec3 v = stray_velocity(&s), arm = vec3_sub(place, pose.origin);
    double behind = RADIUS - vec3_norm(arm);
    Vec3 out = vec3_scale(arm, 1 / vec3_norm(arm)), relative = vec3_sub(v, vec3(1, 0, -1));
    // four steps as long as sound takes for h, whatever a step is, and a tenth of sound at most
    double back = behind / (4 * 0.1 / C0);
    CHECK(deep == (back > 0.1 * C0));
    CHECK_NEAR(vec3_dot(relative, out), mind(back, 0.1 * C0), 1e-3);
    // only the part along the skin's normal was changed
    Vec3 along = vec3_mad(v, out, -vec3_dot(v, out));
    CHECK_NEAR(vec3_norm(along), 0, 1e-3 * vec3_norm(v));

    CHECK(backend_cpu()->forces(s.backend, &about, &load, &error));
    Vec3 given = vec3_scale(v, -MASS / DT);
    Vec3 moment = vec3_cross(vec3_sub(place, about), given);
    CHECK_NEAR(load.force.x, given.x, 1e-3 * vec3_norm(given));
    CHECK_NEAR(load.force.z, given.z, 1e-3 * vec3_norm(given));
    CHECK_NEAR(load.moment.y, moment.y, 1e-3 * fabs(moment.y));
    CHECK(backend_cpu()->forces(s.backend, &about, &load, &error));
    CHECK_NEAR(vec3_norm(load.force), 0, 1e-9); // given once
    backend_cpu()->destroy(s.backend);
    arena_destroy(&s.arena);
}

TEST(water_behind_a_skin_swims_back_with_the_body_which_feels_it)
{
    swim_back(0.67, false);
    swim_back(0.64, true);
}

TEST(water_that_leaves_fast_enough_or_is_near_the_skin_is_let_be)
{
    Stray s;
    BodyLoad load;
    const BodyPose rest = {{0.5, 0.5, 0.5}, {1, 0, 0, 0}};
    const Vec3 places[2] = {{0.5, 0.5, 0.64}, {0.5, 0.5, 0.692}};
    const Vec3 velocities[2] = {{0, 0, 20}, {0, 0, -0.1}};
    for (int k = 0; k < 2; k++) {
        stray_create(&s, places[k], velocities[k]);
        stray_step(&s, rest, rest.origin, &load);
        CHECK_NEAR(vec3_norm(vec3_sub(stray_velocity(&s), velocities[k])), 0, 1e-6);
        backend_cpu()->destroy(s.backend);
        arena_destroy(&s.arena);
    }
}

TEST(what_held_water_owes_a_body_is_rolled_back_with_it)
{
    Stray s;
    BodyLoad first, again;
    char saved[1 << 16];
    const BodyPose rest = {{0.5, 0.5, 0.5}, {1, 0, 0, 0}};
    stray_create(&s, vec3(0.5, 0.5, 0.64), vec3(0, 0, -1));
    stray_step(&s, rest, rest.origin, &first);
    CHECK(backend_cpu()->state_size(s.backend) <= sizeof saved);
    backend_cpu()->save(s.backend, saved);
    CHECK(backend_cpu()->forces(s.backend, &rest.origin, &first, &error));
    backend_cpu()->restore(s.backend, saved);
    CHECK(backend_cpu()->forces(s.backend, &rest.origin, &again, &error));
    CHECK(vec3_norm(first.force) > 1);
    CHECK(memcmp(&first, &again, sizeof first) == 0);
    backend_cpu()->destroy(s.backend);
    arena_destroy(&s.arena);
}

/// A ring whose face has gone inwards by as much as the context says.
static void ring_inwards(const void *context, double time, int count, const Vec3 *mean, Vec3 *place)
{
    (void)time;
    for (int k = 0; k < count; k++)
        place[k] = vec3_add(mean[k], vec3(*(const double *)context, 0, 0));
}

/// Speed along x that a step gives to water 0.01 outside of x = 0, where the ring stands on
/// average.
static double speed_before_ring(double inwards)
{
    Vec3 place = vec3(-0.01, 0.5, 0.5), still = vec3(0, 0, 0), dummy = vec3(-0.3, 0.5, 0.5);
    float excess = 0, v[1][3];
    int16_t owner = OWNER_RING;
    Arena arena = arena_create(0);
    Backend *backend;
    BackendSetup setup = water_setup(3);
    ParticleStart particles = {1, &place, &still, &excess, 1, &dummy, &owner};
    ParticleSums sums;
    CHECK(backend_cpu()->create(&setup, &particles, &arena, &backend, &error));
    Advance advance = {.dt = DT,
                       .waves = &inwards,
                       .ring = ring_inwards,
                       .zone = {0.2, 1e9, {0, -1e30}, {1e30, 1e30}, NULL, 1}};
    CHECK(backend_cpu()->forces(backend, NULL, NULL, &error));
    backend_cpu()->advance(backend, &advance, &sums);
    backend_cpu()->download(backend, NULL, v, NULL);
    backend_cpu()->destroy(backend);
    arena_destroy(&arena);
    return (double)v[0][0];
}

// A steep wave at h/dp 2 was stopped as sick: of one particle five spacings behind, at 0.6 of
// sound.
TEST(water_swallowed_by_the_ring_swims_back_at_a_tenth_of_sound_at_most)
{
    CHECK_NEAR(speed_before_ring(0.02), 0.03 / (4 * 0.1 / C0), 1e-4);
    CHECK_NEAR(speed_before_ring(0.3), 0.1 * C0, 1e-4);
}
