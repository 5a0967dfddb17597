/// Waves that are changed while they run: smooth, bounded, prompt, and over in time.
#include "test.h"
#include "waves.h"

static const double DEGREE = PI / 180;

static Scene *scene_of(WaveStart start)
{
    static Scene scene;
    memset(&scene, 0, sizeof scene);
    scene.domain.kind = DOMAIN_BASIN;
    scene.domain.dimensions = 3;
    scene.domain.min = vec3(-4, -4, -2);
    scene.domain.max = vec3(4, 4, 1);
    scene.fluid.gravity = 9.81;
    scene.fluid.spacing = 0.05;
    scene.waves.kind = WAVES_REGULAR;
    scene.waves.start = start;
    scene.waves.ramp_time = 3;
    scene.waves.blend_periods = 1.5;
    scene.waves.initial.height = 0.3;
    scene.waves.initial.period = 1.5;
    return &scene;
}

static WaveTarget sea(double height, double period, double heading_deg)
{
    WaveTarget target = {height, period, heading_deg * DEGREE};
    return target;
}

static double random_between(double low, double high)
{
    static unsigned state = 777;
    state = state * 1664525u + 1013904223u;
    return low + (high - low) * (state >> 8) / 16777216.0;
}

static double distance(Vec3 a, Vec3 b) { return vec3_norm(vec3_sub(a, b)); }

TEST(random_commands_every_tenth_of_a_second_keep_the_water_smooth_and_bounded)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene);
    const double dt = 0.001, largest = 0.3;
    const Vec3 mean = vec3(1.3, -0.7, 0);
    // Orbit at the surface: a coth kd and a second-order part; omega of the shortest period.
    double radius = 0.5 * largest * 1.25, omega = 2 * PI / 1.0;
    double worst_place = 0, worst_speed = 0, worst_jump = 0, worst_gap = 0, worst_turn = 0;
    int most_layers = 0;
    Vec3 d = waves_displacement(&waves, mean, 0), v = waves_orbit_velocity(&waves, mean, 0);
    Vec3 zone = waves_zone_velocity(&waves, vec3(1, 1, -0.3), 0);
    for (int i = 1; i <= 60000; i++) {
        double time = i * dt;
        waves_update(&waves, scene, time);
        if (i % 100 == 0) {
            WaveTarget ask =
                sea(random_between(0, largest), random_between(1, 2.5), random_between(-180, 180));
            if (i % 300) { // mostly near, so that layers pile up
                ask = waves.asked;
                ask.heading += random_between(-0.5, 0.5);
                ask.height = random_between(0.2, largest);
            }
            waves_command(&waves, scene, &ask, time);
        }
        CHECK(waves.layer_count >= 1 && waves.layer_count <= WAVE_LAYERS_MAX);
        most_layers = waves.layer_count > most_layers ? waves.layer_count : most_layers;
        Vec3 d1 = waves_displacement(&waves, mean, time);
        Vec3 v1 = waves_orbit_velocity(&waves, mean, time);
        Vec3 zone1 = waves_zone_velocity(&waves, vec3(1, 1, -0.3), time);
        worst_place = maxd(worst_place, vec3_norm(d1));
        worst_speed = maxd(worst_speed, vec3_norm(v1));
        worst_gap = maxd(worst_gap, distance(vec3_sub(d1, d), vec3_scale(vec3_add(v, v1), dt / 2)));
        worst_jump = maxd(worst_jump, distance(v1, v));
        worst_turn = maxd(worst_turn, distance(zone1, zone));
        d = d1;
        v = v1;
        zone = zone1;
    }
    CHECK(most_layers >= 4);
    CHECK(worst_place < radius);
    // blending adds (2 d_max)(15/8)/D to the speed
    CHECK(worst_speed < omega * radius + 2 * radius * 1.875 / 1.0);
    CHECK(worst_gap < 1e-6); // velocity is the displacement's derivative
    CHECK(worst_jump < 3 * omega * omega * radius * dt); // and has no steps
    CHECK(worst_turn < 3 * omega * omega * radius * dt);
}

TEST(a_command_changes_nothing_at_its_instant_and_something_soon_after)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene), before = waves;
    WaveTarget ask = sea(0.3, 1.5, 40);
    Vec3 mean = vec3(2, 1, -0.2);
    waves_command(&waves, scene, &ask, 5);
    CHECK(waves.active && !waves.has_queued);
    CHECK(distance(waves_displacement(&waves, mean, 5), waves_displacement(&before, mean, 5)) == 0);
    CHECK(distance(waves_orbit_velocity(&waves, mean, 5), waves_orbit_velocity(&before, mean, 5)) ==
          0);
    CHECK(distance(waves_displacement(&waves, mean, 5.5), waves_displacement(&before, mean, 5.5)) >
          1e-3);
}

TEST(a_modest_change_is_over_after_the_blend_and_then_is_the_new_wave)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene);
    WaveTarget ask = sea(0.2, 1.8, -30);
    waves_command(&waves, scene, &ask, 2);
    double from, to, end = 2 + 1.5 * 1.8;
    waves_weights(&waves, 2 + 1.5 * 0.9, &from, &to);
    CHECK_NEAR(from, 0.5, 1e-12);
    CHECK_NEAR(to, 0.5, 1e-12);
    CHECK_NEAR(waves_now(&waves, 2 + 1.5 * 0.9).height, 0.25, 1e-12);
    waves_update(&waves, scene, end - 0.01);
    CHECK(waves.active);
    waves_update(&waves, scene, end);
    CHECK(!waves.active && waves.layer_count == 1);
    WaveTarget now = waves_now(&waves, end);
    CHECK_NEAR(now.height, 0.2, 1e-15);
    CHECK_NEAR(now.period, 1.8, 1e-15);
    CHECK_NEAR(now.heading, -30 * DEGREE, 1e-12);
    CHECK_NEAR(waves.layers[0].train.terms.cos_heading, cos(30 * DEGREE), 1e-15);
}

TEST(a_reversal_takes_the_old_sea_down_before_the_new_comes_up)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene);
    WaveTarget ask = sea(0.3, 1.6, 180);
    double highest = 0, quiet = 1, over = 0;
    for (double t = 1; t < 8; t += 0.01) {
        if (t == 1) waves_command(&waves, scene, &ask, t);
        waves_update(&waves, scene, t);
        for (double x = -3; x < 3; x += 0.37)
            highest = maxd(highest, waves_elevation(&waves, x, 0, t));
        quiet = mind(quiet, waves_now(&waves, t).height);
        if (over == 0 && !waves.active) over = t;
    }
    CHECK(highest < 0.5 * 0.3 * 1.25); // one wave's crest, second order included
    CHECK(quiet < 0.001);
    CHECK_NEAR(over, 1 + 1.5 + 1.5 * 1.6, 0.03); // T old, then 1.5 T new
    CHECK_NEAR(waves.layers[0].train.terms.cos_heading, -1, 1e-12);
}

TEST(far_is_more_than_sixty_degrees_or_thirty_percent_and_360_is_no_turn)
{
    const struct {
        double period, heading;
        bool far;
    } cases[] = {{1.5, 59, false},  {1.5, 61, true},  {1.5, -61, true}, {1.5, 359, false},
                 {1.5, 720, false}, {1.9, 0, false},  {2.0, 0, true},   {1.2, 0, false},
                 {1.1, 0, true},    {1.5, 300, false}};
    Scene *scene = scene_of(WAVE_START_HOT);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        WaveState waves = waves_create(scene);
        WaveTarget ask = sea(0.3, cases[i].period, cases[i].heading);
        waves_command(&waves, scene, &ask, 1);
        CHECK(waves.has_queued == cases[i].far);
        CHECK(waves.layer_count == 2); // either way something begins at once
    }
}

TEST(the_phase_at_the_centre_is_carried_over)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    scene->waves.theory = WAVE_THEORY_STOKES2; // whose crest depends on the period by little
    WaveState waves = waves_create(scene), before = waves;
    WaveTarget ask = sea(0.3, 1.5, 45);
    waves_command(&waves, scene, &ask, 3.3);
    for (double t = 3.3; t < 9; t += 0.1) { // same period: the centre never notices
        waves_update(&waves, scene, t);
        CHECK_NEAR(waves_elevation(&waves, 0, 0, t), waves_elevation(&before, 0, 0, t), 1e-10);
    }
    ask.period = 1.65; // now the phases part by at most pi (1/T - 1/T') D / 2 about the middle
    waves_command(&waves, scene, &ask, 9);
    double middle = 9 + 0.75 * 1.65;
    CHECK_NEAR(waves_elevation(&waves, 0, 0, middle), waves_elevation(&before, 0, 0, middle), 1e-3);
}

/// Not half of the old one: without mean transport the length depends on the height by 2 %.
TEST(a_height_alone_makes_the_wave_that_it_would_have_been)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene);
    WaveTarget ask = sea(0.15, 1.5, 0);
    waves_command(&waves, scene, &ask, 1);
    waves_update(&waves, scene, 7);
    scene->waves.initial = ask;
    WaveState lower = waves_create(scene);
    for (double x = -3; x < 3; x += 0.5)
        CHECK_NEAR(waves_displacement(&waves, vec3(x, 0, -1), 7).x,
                   waves_displacement(&lower, vec3(x, 0, -1), 7).x, 1e-4);
}

TEST(a_dragged_dial_is_followed_while_it_moves_and_ends_where_it_stops)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene);
    double time = 0;
    for (int i = 1; i <= 100; i++) { // 50 degrees in four seconds, 25 commands a second
        time = i * 0.04;
        WaveTarget ask = sea(0.3, 1.5, 0.5 * i);
        waves_update(&waves, scene, time);
        waves_command(&waves, scene, &ask, time);
        CHECK(waves.layer_count < WAVE_LAYERS_MAX);
    }
    CHECK(waves_now(&waves, time).heading > 20 * DEGREE); // it did not wait for the end
    double stop = time;
    while (waves.active && time < 20)
        waves_update(&waves, scene, time += 0.01);
    CHECK(time - stop < 2.0 * 1.5 * 1.5);
    CHECK_NEAR(waves_now(&waves, time).heading, 50 * DEGREE, 1e-12);
}

TEST(the_latest_of_several_far_commands_wins)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene);
    for (int i = 0; i < 10; i++) {
        WaveTarget ask = sea(0.1 + 0.02 * i, 1.5, 90 + 9 * i);
        waves_command(&waves, scene, &ask, 1 + 0.1 * i);
    }
    double time = 1.9;
    while (waves.active && time < 20)
        waves_update(&waves, scene, time += 0.01);
    CHECK_NEAR(time, 1 + 1.5 + 2.25, 0.03);
    CHECK_NEAR(waves_now(&waves, time).heading, 171 * DEGREE, 1e-12);
    CHECK_NEAR(waves_now(&waves, time).height, 0.28, 1e-12);
}

TEST(a_ramp_starts_from_rest_and_a_hot_start_at_full_height)
{
    Scene *scene = scene_of(WAVE_START_RAMP);
    WaveState waves = waves_create(scene);
    Vec3 mean = vec3(1, 0, -0.1);
    CHECK(waves.active);
    CHECK(vec3_norm(waves_displacement(&waves, mean, 0)) == 0);
    CHECK(vec3_norm(waves_orbit_velocity(&waves, mean, 0)) == 0);
    CHECK(waves_now(&waves, 0).height == 0);
    CHECK_NEAR(waves_now(&waves, 0).period, 1.5, 1e-15);
    CHECK_NEAR(waves_now(&waves, 1.5).height, 0.15, 1e-12);
    waves_update(&waves, scene, 3);
    CHECK(!waves.active);
    WaveState hot = waves_create(scene_of(WAVE_START_HOT));
    CHECK_NEAR(waves_elevation(&hot, 1, 0, 3), waves_elevation(&waves, 1, 0, 3), 1e-12);
    CHECK_NEAR(waves_now(&hot, 0).height, 0.3, 1e-15);
}

TEST(height_zero_brings_rest_and_a_new_sea_rises_from_it)
{
    Scene *scene = scene_of(WAVE_START_HOT);
    WaveState waves = waves_create(scene);
    WaveTarget ask = sea(0, 1.5, 0);
    waves_command(&waves, scene, &ask, 1);
    waves_update(&waves, scene, 4);
    CHECK(!waves.active);
    CHECK(vec3_norm(waves_velocity(&waves, vec3(0, 0, 0), 4)) == 0);
    ask = sea(0.2, 1.5, 170);
    waves_command(&waves, scene, &ask, 5);
    CHECK(!waves.has_queued); // nothing has to go down first
    waves_update(&waves, scene, 9);
    CHECK_NEAR(waves_now(&waves, 9).height, 0.2, 1e-15);
}

TEST(the_same_commands_give_the_same_bits)
{
    Scene *scene = scene_of(WAVE_START_RAMP);
    WaveState a = waves_create(scene), b = waves_create(scene);
    for (int i = 0; i < 2000; i++) {
        double time = i * 0.01;
        WaveTarget ask = sea(0.3, 1.5 + 0.001 * (i % 700), 0.3 * i);
        waves_update(&a, scene, time);
        waves_update(&b, scene, time);
        if (i % 37 == 0) {
            waves_command(&a, scene, &ask, time);
            waves_command(&b, scene, &ask, time);
        }
    }
    Vec3 da = waves_displacement(&a, vec3(1, 2, -0.3), 20);
    Vec3 db = waves_displacement(&b, vec3(1, 2, -0.3), 20);
    CHECK(memcmp(&da, &db, sizeof da) == 0);
    WaveState copy = a; // a checkpoint is a copy
    WaveTarget ask = sea(0.1, 1.5, 10);
    waves_command(&copy, scene, &ask, 20);
    waves_command(&a, scene, &ask, 20);
    CHECK(distance(waves_displacement(&copy, vec3(1, 2, -0.3), 21),
                   waves_displacement(&a, vec3(1, 2, -0.3), 21)) == 0);
}
