/// A current: its way, waves on it, and a basin that it flows through.
#include "scenes.h"

#include "backend/backend.h"
#include "energy.h"
#include "sea.h"
#include "waves.h"

static const double GRAVITY = 9.81;

TEST(the_way_of_a_current_is_the_integral_of_its_velocity)
{
    Current current = {0.7, 0.4, 3};
    for (double t = 0.05; t < 5; t += 0.31) {
        double h = 1e-4;
        Vec3 gone = vec3_sub(current_travel(&current, t + h), current_travel(&current, t - h));
        Vec3 more = vec3_sub(current_velocity(&current, t + h), current_velocity(&current, t - h));
        CHECK_NEAR(gone.x / (2 * h), current_velocity(&current, t).x, 1e-7);
        CHECK_NEAR(gone.y / (2 * h), current_velocity(&current, t).y, 1e-7);
        CHECK_NEAR(more.x / (2 * h), current_acceleration(&current, t).x, 1e-6);
    }
    CHECK(vec3_norm(current_travel(&current, 0)) == 0);
    CHECK_NEAR(vec3_norm(current_travel(&current, 10)), 0.7 * 8.5, 1e-12);
    current.ramp = 0;
    CHECK_NEAR(vec3_norm(current_velocity(&current, 0)), 0.7, 1e-12);
    CHECK_NEAR(vec3_norm(current_travel(&current, 10)), 7, 1e-12);
}

TEST(waves_on_a_current_have_the_doppler_shifted_dispersion_or_do_not_run)
{
    for (double u = -0.35; u < 1; u += 0.05) {
        double omega = 2 * PI / 1.2, k = current_wave_number(omega, u, 0.6, GRAVITY);
        double sigma = omega - k * u;
        CHECK_NEAR(GRAVITY * k * tanh(0.6 * k), sigma * sigma, 1e-9);
        // the energy of the longest wave runs upstream
        double kd = 0.6 * k, group = 0.5 * sigma / k * (1 + 2 * kd / sinh(2 * kd));
        CHECK(group + u > 0);
    }
    // in deep water g/(4 omega) stops it
    double omega = 2 * PI / 0.5, stops = GRAVITY / (4 * omega);
    CHECK(!isnan(current_wave_number(omega, -0.99 * stops, 5, GRAVITY)));
    CHECK(isnan(current_wave_number(omega, -1.02 * stops, 5, GRAVITY)));
}

/// A basin 2.6 m long and 0.4 m deep without waves.
static Scene stream_2d(double spacing, double speed)
{
    Scene scene = basin_2d(spacing);
    scene.domain.min = vec3(-1.3, -0.5, -0.4);
    scene.domain.max = vec3(1.3, 0.5, 0.1);
    scene.waves.kind = WAVES_NONE;
    scene.waves.zone_width = 0.5;
    scene.waves.current.speed = fabs(speed);
    scene.waves.current.heading = speed < 0 ? PI : 0;
    return scene;
}

/// With waves, hot.
static Scene waves_2d(double spacing, double speed)
{
    Scene scene = stream_2d(spacing, speed);
    scene.waves.kind = WAVES_REGULAR;
    scene.waves.initial = (WaveTarget){0.05, 1.1, 0};
    return scene;
}

TEST(a_gauge_sees_the_period_asked_for_and_the_water_the_doppler_shifted_one)
{
    for (int sea = 0; sea < 2; sea++) {
        Scene scene = waves_2d(0.02, 0.3);
        Arena arena = arena_create(0);
        scene.waves.current.ramp = 2;
        scene.waves.spectrum.components = 8;
        if (sea) scene.waves.kind = WAVES_IRREGULAR;
        WaveState waves = waves_create(&scene);
        CHECK(waves_take_sea(&waves, &scene, &arena, &error));
        const WaveTerms *w = &waves.layers[0].train.terms;
        for (double x = -1; x < 1; x += 0.37) {
            // going with the water there is still water's wave of the shorter frequency
            double t = 7.3, dt = 1e-4, u = current_velocity(&scene.waves.current, t).x;
            Vec3 mean = vec3(x, 0, -0.1), on = vec3(x + u * dt, 0, -0.1);
            Vec3 step = vec3_sub(waves_displacement(&waves, on, t + dt),
                                 waves_displacement(&waves, mean, t));
            Vec3 v = waves_orbit_velocity(&waves, vec3(x + 0.5 * u * dt, 0, -0.1), t + 0.5 * dt);
            CHECK_NEAR(step.x / dt, v.x, 1e-5);
            CHECK_NEAR(step.z / dt, v.z, 1e-5);
            if (sea) continue;
            CHECK_NEAR(waves_elevation(&waves, x, 0, t + 1.1), waves_elevation(&waves, x, 0, t),
                       1e-9);
            CHECK_NEAR(w->angular_frequency, 2 * PI / 1.1 - 0.3 * w->wave_number, 1e-9);
        }
        arena_destroy(&arena);
    }
}

TEST(batches_agree_with_single_places_on_a_current)
{
    Scene scene = waves_2d(0.02, 0.3);
    scene.waves.kind = WAVES_FOCUSED;
    scene.waves.focus = (Focus){0.3, 0, 6};
    Arena arena = arena_create(0);
    WaveState waves = waves_create(&scene);
    CHECK(waves_take_sea(&waves, &scene, &arena, &error));
    Vec3 mean[7], place[7];
    float x[7], z[7], u[7], w[7];
    for (int i = 0; i < 7; i++) {
        mean[i] = vec3(-1 + 0.3 * i, 0, -0.05 * i);
        x[i] = (float)mean[i].x;
        z[i] = (float)mean[i].z;
    }
    waves_ring_places(&waves, 4.1, 7, mean, place);
    waves_zone_batch(&waves, 4.1, 7, x, NULL, z, u, NULL, w);
    for (int i = 0; i < 7; i++) {
        Vec3 d = vec3_sub(place[i], mean[i]), want = waves_displacement(&waves, mean[i], 4.1);
        Vec3 v = waves_zone_velocity(&waves, mean[i], 4.1);
        CHECK_NEAR(d.x, want.x, 1e-6);
        CHECK_NEAR(d.z, want.z, 1e-6);
        CHECK_NEAR((double)u[i], v.x, 2e-5);
        CHECK_NEAR((double)w[i], v.z, 2e-5);
    }
    // all crests meet at the focus
    double top = waves_elevation(&waves, 0.3, 0, 6);
    for (double t = 5.5; t < 6.5; t += 0.04)
        CHECK(waves_elevation(&waves, 0.3, 0, t) <= top + 1e-6);
    arena_destroy(&arena);
}

TEST(a_sea_goes_without_the_components_that_cannot_run_against_the_current)
{
    Scene scene = waves_2d(0.02, -0.2);
    scene.waves.kind = WAVES_IRREGULAR;
    Arena arena = arena_create(0);
    WaveState waves = waves_create(&scene);
    CHECK(waves_take_sea(&waves, &scene, &arena, &error));
    const SeaLayer *layer = &waves.sea->layers[0];
    int left_out = 0;
    for (int i = 0; i < waves.sea->count; i++) {
        double omega = 2 * PI * waves.sea->shape[i].frequency / 1.1;
        bool stopped = isnan(current_wave_number(omega, -0.2, 0.4, GRAVITY));
        left_out += stopped;
        CHECK((layer->amplitude[i] == 0) == stopped);
    }
    CHECK(left_out > 0 && left_out < waves.sea->count / 2);
    arena_destroy(&arena);
}

/// Mean and rms of what velocities differ from (u, v, 0).
static void check_uniform(const Run *run, double u, double v, double mean_most, double rms_most)
{
    int count = run->plan.fluid_count;
    float(*velocity)[3] = calloc((size_t)count, sizeof *velocity);
    run->state->backend->download(run->state->particles, NULL, velocity, NULL);
    double mean[2] = {0, 0}, square = 0;
    for (int i = 0; i < count; i++) {
        double du = velocity[i][0] - u, dv = velocity[i][1] - v, w = velocity[i][2];
        mean[0] += du / count;
        mean[1] += dv / count;
        square += (du * du + dv * dv + w * w) / count;
    }
    printf("  velocity off by %.4f, %.4f m/s, rms %.4f m/s\n", mean[0], mean[1], sqrt(square));
    CHECK(hypot(mean[0], mean[1]) < mean_most);
    CHECK(sqrt(square) < rms_most);
    free(velocity);
}

TEST(water_that_flows_through_a_basin_stays_as_it_is)
{
    for (int way = -1; way <= 1; way += 2) {
        double u = 0.5 * way, level = 0, pressure = 0, square = 0;
        Scene scene = stream_2d(0.025, u);
        Run *run = start(&scene, 2);
        advance_to(run, 8); // the water has gone by one and a half times
        int count = 0;
        for (double until = run->state->time + 4; run->state->time < until; count++) {
            CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
            double p = run->state->backend->pressure(run->state->particles, vec3(0.1, 0, -0.2),
                                                     vec3(0, 0, 0));
            level += run->state->backend->elevation(run->state->particles, 0, 0);
            pressure += p;
            square += p * p;
        }
        level /= count;
        pressure /= count;
        printf("  level %.2f mm, pressure %.0f Pa, its rms %.0f Pa\n", 1e3 * level, pressure,
               sqrt(square / count - pressure * pressure));
        CHECK(fabs(level) < 0.1 * scene.fluid.spacing);
        CHECK_NEAR(pressure / (1000 * GRAVITY * 0.2), 1, 0.02);
        CHECK(sqrt(square / count - pressure * pressure) < 0.03 * pressure);
        CHECK(run->state->health.lost == 0);
        check_uniform(run, u, 0, 0.005, 0.03);
        finish(run);
    }
}

TEST(water_flows_aslant_through_a_basin_in_space)
{
    Scene scene = stream_2d(0.05, 0.6);
    scene.domain.dimensions = 3;
    scene.domain.min = vec3(-0.7, -0.7, -0.25);
    scene.domain.max = vec3(0.7, 0.7, 0.1);
    scene.waves.zone_width = 0.3;
    scene.waves.current.heading = 60 * PI / 180;
    Run *run = start(&scene, 2);
    advance_to(run, 4);
    double level = run->state->backend->elevation(run->state->particles, 0, 0);
    printf("  level %.2f mm\n", 1e3 * level);
    CHECK(fabs(level) < 0.15 * scene.fluid.spacing);
    CHECK(run->state->health.lost == 0);
    // (chosen) five layers are few: 1.8 % slower than asked
    check_uniform(run, 0.3, 0.6 * sin(PI / 3), 0.015, 0.05);
    finish(run);
}

TEST(a_box_that_floats_free_goes_with_the_current)
{
    Scene scene = stream_2d(0.025, 0.3);
    scene.waves.current.ramp = 0.5;
    scene.body_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    box->size = vec3(0.2, 1, 0.15);
    box->position = vec3(-0.6, 0, NAN);
    box->draft = 0.075;
    for (int f = 0; f < 6; f++)
        box->freedoms[f].kind = f == 0 || f == 2 || f == 4 ? FREEDOM_FREE : FREEDOM_FIXED;
    Run *run = start(&scene, 2);
    advance_to(run, 1.5);
    double from = run->state->bodies[0].position.x, begun = run->state->time;
    advance_to(run, 4);
    double speed = (run->state->bodies[0].position.x - from) / (run->state->time - begun);
    printf("  %.3f m/s\n", speed);
    CHECK_NEAR(speed, 0.3, 0.015);
    finish(run);
}

TEST(a_current_that_grows_does_not_tilt_the_surface)
{
    Scene scene = stream_2d(0.025, 0.5);
    scene.waves.current.ramp = 2;
    Run *run = start(&scene, 1);
    double most = 0;
    while (run->state->time < 2.2) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        double west = run->state->backend->elevation(run->state->particles, -0.8, 0);
        double east = run->state->backend->elevation(run->state->particles, 0.8, 0);
        most = maxd(most, fabs(east - west));
    }
    // pushed by the ring alone it would lean by 0.47/9.81 of 1.6 m: 76 mm
    CHECK(most < 0.004);
    check_uniform(run, 0.5, 0, 0.005, 0.02);
    finish(run);
}

TEST(energy_that_flows_in_and_out_is_accounted_for)
{
    Scene scene = stream_2d(0.04, 0.5);
    scene.waves.current.ramp = 1;
    scene.energy = ENERGY_BUDGET;
    Run *run = start(&scene, 2);
    double worst = 0, most = 0;
    while (run->state->time < 7) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        EnergyColumn column[ENERGY_COLUMNS_MAX];
        int count = energy_columns(&run->scene, run->state, column);
        for (int i = 0; i < count; i++) {
            if (!strcmp(column[i].name, "residual_j")) worst = maxd(worst, fabs(column[i].value));
            if (!strcmp(column[i].name, "work_current_j")) most = maxd(most, column[i].value);
        }
    }
    printf("  unaccounted for %.2f J of %.0f J\n", worst, most);
    CHECK(most > 120); // half the mass times the speed squared is 130 J
    CHECK(worst < 0.01 * most);
    finish(run);
}

/// Positions of the water, to be freed.
static float (*places(const Run *run))[3]
{
    float(*position)[3] = calloc((size_t)run->plan.fluid_count, sizeof *position);
    run->state->backend->download(run->state->particles, position, NULL, NULL);
    return position;
}

TEST(a_current_gives_the_same_bits_for_any_thread_count)
{
    Scene scene = waves_2d(0.05, 0.4);
    scene.waves.current.ramp = 1;
    Run *one = start(&scene, 1), *two = start(&scene, 2);
    advance_to(one, 1.7);
    advance_to(two, 1.7);
    float(*a)[3] = places(one), (*b)[3] = places(two);
    CHECK(!memcmp(a, b, (size_t)one->plan.fluid_count * sizeof *a));
    free(a);
    free(b);
    finish(one);
    finish(two);
}

TEST(a_rewind_brings_back_the_ring_and_what_it_let_in)
{
    Scene scene = waves_2d(0.05, 0.4);
    scene.waves.current.ramp = 1;
    Run *run = start(&scene, 1);
    advance_to(run, 0.9);
    State *state = run->state;
    char *kept = malloc(state->backend->state_size(state->particles));
    WaveState waves = *state->waves;
    double time = state->time;
    int64_t step = state->step;
    state->backend->save(state->particles, kept);
    advance_to(run, 1.2); // two layers come in
    float(*a)[3] = places(run);
    state->backend->restore(state->particles, kept);
    *state->waves = waves;
    state->time = time;
    state->step = step;
    advance_to(run, 1.2);
    float(*b)[3] = places(run);
    double far = 0; // sums have another order now: what was rounded grows
    for (int i = 0; i < run->plan.fluid_count; i++)
        far = maxd(far, fabs((double)a[i][0] - (double)b[i][0]));
    printf("  %.2g m apart at most\n", far);
    CHECK(far < 1e-3 * scene.fluid.spacing);
    free(kept);
    free(a);
    free(b);
    finish(run);
}

TEST(a_wave_against_a_current_too_fast_for_it_is_refused_live)
{
    Scene scene = waves_2d(0.02, -0.35);
    scene.waves.period_limits = (Range){0.5, 1.3};
    Command command = {.wave_height = 0.03, .wave_period = 0.6, .wave_heading = 0};
    WaveTarget target;
    scene.waves.height_limits = (Range){0, 0.1};
    CHECK(!command_check(&scene, &command, &scene.waves.initial, &target, &error));
    CHECK_CONTAINS(error.message, "wave.period_s = 0.6: must be longer: against the current");
    command.wave_period = 1.2;
    CHECK(command_check(&scene, &command, &scene.waves.initial, &target, &error));
}
