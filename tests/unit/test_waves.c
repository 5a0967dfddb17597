/// Regular waves: theory against its own equations and against stream-function waves.
/// Live changes are in test_waves_live.c.
#include <stdlib.h>

#include "physics/wave_theory.h"
#include "test.h"
#include "waves.h"

static const double GRAVITY = 9.81;

/// A basin 8 x 6 m, still water at z = 0, hot start.
static Scene *scene_of(double height, double period, double heading, double depth)
{
    static Scene scene;
    memset(&scene, 0, sizeof scene);
    scene.domain.kind = DOMAIN_BASIN;
    scene.domain.dimensions = 3;
    scene.domain.min = vec3(-3, -2, -depth);
    scene.domain.max = vec3(5, 4, 1);
    scene.fluid.gravity = GRAVITY;
    scene.fluid.spacing = height / 6;
    scene.waves.kind = WAVES_REGULAR;
    scene.waves.start = WAVE_START_HOT;
    scene.waves.blend_periods = 1.5;
    scene.waves.initial.height = height;
    scene.waves.initial.period = period;
    scene.waves.initial.heading = heading;
    scene.waves.period_limits.min = scene.waves.period_limits.max = period;
    return &scene;
}

static double random_between(double low, double high)
{
    static unsigned state = 12345;
    state = state * 1664525u + 1013904223u;
    return low + (high - low) * (state >> 8) / 16777216.0;
}

static Vec3 random_point(double depth)
{
    return vec3(random_between(-3, 5), random_between(-2, 4), random_between(-depth, 0));
}

static double distance(Vec3 a, Vec3 b) { return vec3_norm(vec3_sub(a, b)); }

TEST(wave_number_satisfies_dispersion_from_shallow_to_deep)
{
    for (double depth = 0.01; depth < 1000; depth *= 1.7)
        for (double period = 0.3; period < 60; period *= 1.3) {
            double omega = 2 * PI / period, k = wave_number_airy(omega, depth, GRAVITY);
            CHECK_NEAR(GRAVITY * k * tanh(k * depth) / (omega * omega), 1, 2e-12);
        }
}

/// Rows of a table of numbers below one header line. @return rows read
static int table_read(const char *name, int columns, double *values, int rows_max)
{
    char path[512];
    snprintf(path, sizeof path, "%s/tests/data/stokes_fenton/%s", SOURCE_DIR, name);
    FILE *file = fopen(path, "r");
    int rows = 0, c = 0;
    if (!file) return 0;
    while ((c = fgetc(file)) != '\n' && c != EOF)
        ;
    for (; rows < rows_max; rows++)
        for (int i = 0; i < columns; i++)
            if (fscanf(file, i ? ",%lf" : "%lf", &values[rows * columns + i]) != 1) {
                fclose(file);
                return rows;
            }
    fclose(file);
    return rows;
}

TEST(wave_lengths_are_airys_and_fall_short_of_stream_function_waves_by_steepness_squared)
{
    double table[32][10];
    int rows = table_read("stream_function_waves.csv", 10, table[0], 32);
    CHECK(rows == 14);
    for (int i = 0; i < rows; i++) {
        double H = table[i][0], d = table[i][1], T = table[i][2];
        double k = wave_number_airy(2 * PI / T, d, GRAVITY);
        CHECK_NEAR(2 * PI / k / table[i][3], 1, 1e-4);
        // Stokes' third order: c^2 grows by (ka)^2 (8 + cosh 4kd) / (8 sinh^4 kd), ignoring
        // currents
        double s = sinh(k * d), ka = k * H / 2;
        double growth = ka * ka * (8 + cosh(4 * k * d)) / (8 * s * s * s * s);
        double longer = table[i][4] / table[i][3] - 1;
        CHECK(longer > 0.2 * growth && longer < 1.3 * growth);
    }
}

TEST(crests_and_troughs_are_those_of_stream_function_waves)
{
    double table[32][10];
    int rows = table_read("stream_function_waves.csv", 10, table[0], 32);
    for (int i = 0; i < rows; i++) {
        double H = table[i][0], d = table[i][1], T = table[i][2];
        double k = wave_number_airy(2 * PI / T, d, GRAVITY);
        WaveTerms w = wave_terms(H / 2, k, 2 * PI / T, d, 0);
        double crest = wave_elevation(&w, wave_place(&w, 0, 0, 0));
        w.turns = 0.5;
        double trough = wave_elevation(&w, wave_place(&w, 0, 0, 0));
        CHECK_NEAR(crest - trough, H, 1e-12);
        CHECK_NEAR(crest, table[i][7], 0.008 * H);
        CHECK_NEAR(trough, table[i][8], 0.008 * H);
        w.turns = 0;
        WaveMotion u = wave_velocity(&w, wave_place(&w, 0, 0, crest));
        CHECK_NEAR((u.along - w.mean_velocity) / table[i][9], 1, 0.12); // without a return current
    }
}

TEST(elevation_along_a_steep_wave_stays_near_the_stream_function)
{
    // H/L 0.1 at kd pi/2, three quarters of breaking; the given wave length, not the period.
    double table[64][2], worst = 0;
    int rows = table_read("steep_wave_elevation.csv", 2, table[0], 64);
    CHECK(rows == 31);
    double k = PI, d = 0.5, omega = sqrt(GRAVITY * k * tanh(k * d));
    WaveTerms w = wave_terms(0.1, k, omega, d, 0);
    w.turns_x = k / (2 * PI);
    for (int i = 0; i < rows; i++) {
        double eta = wave_elevation(&w, wave_place(&w, table[i][0], 0, 0));
        worst = maxd(worst, fabs(eta - (table[i][1] - d)));
    }
    CHECK(worst < 0.08 * 0.2); // third order is missing
}

/// Largest residual of the kinematic and dynamic conditions on the surface, relative to their
/// terms.
static void surface_residuals(double amplitude, double depth, double *kinematic, double *dynamic)
{
    double k = 2.0, omega = sqrt(GRAVITY * k * tanh(k * depth)), h = 1e-4;
    *kinematic = *dynamic = 0;
    for (int i = 0; i < 32; i++) {
        WaveTerms w = wave_terms(amplitude, k, omega, depth, 0);
        w.turns_x = k / (2 * PI);
        w.turns = i / 32.0;
        WaveTerms later = w, earlier = w;
        later.turns -= omega * h / (2 * PI);
        earlier.turns += omega * h / (2 * PI);
        double eta = wave_elevation(&w, wave_place(&w, 0, 0, 0));
        double slope = (wave_elevation(&w, wave_place(&w, h, 0, 0)) -
                        wave_elevation(&w, wave_place(&w, -h, 0, 0))) /
                       (2 * h);
        double rise = (wave_elevation(&later, wave_place(&later, 0, 0, 0)) -
                       wave_elevation(&earlier, wave_place(&earlier, 0, 0, 0))) /
                      (2 * h);
        w.mean_velocity = 0; // of third order in these conditions
        WaveMotion u = wave_velocity(&w, wave_place(&w, 0, 0, eta));
        WaveMotion right = wave_velocity(&w, wave_place(&w, h, 0, eta));
        WaveMotion left = wave_velocity(&w, wave_place(&w, -h, 0, eta));
        WaveMotion above = wave_velocity(&w, wave_place(&w, 0, 0, eta + h));
        WaveMotion below = wave_velocity(&w, wave_place(&w, 0, 0, eta - h));
        WaveMotion local = wave_acceleration(&w, wave_place(&w, 0, 0, eta));
        double along = local.along + u.along * (right.along - left.along) / (2 * h) +
                       u.up * (above.along - below.along) / (2 * h);
        double up = local.up + u.along * (right.up - left.up) / (2 * h) +
                    u.up * (above.up - below.up) / (2 * h);
        *kinematic = maxd(*kinematic, fabs(rise + u.along * slope - u.up) / (amplitude * omega));
        // the pressure is constant along the surface: (a + g z) . tangent = 0
        *dynamic =
            maxd(*dynamic, fabs(along + (up + GRAVITY) * slope) / (amplitude * omega * omega));
    }
}

TEST(surface_conditions_hold_to_second_order_at_every_depth)
{
    for (double depth = 0.4; depth < 40; depth *= 3) {
        double k1, d1, k2, d2;
        surface_residuals(0.02, depth, &k1, &d1);
        surface_residuals(0.01, depth, &k2, &d2);
        // the residual over the leading term falls with a^2: by 4 when a halves
        CHECK_NEAR(k1 / k2, 4, 0.4);
        CHECK_NEAR(d1 / d2, 4, 0.4);
        CHECK(k1 < 0.05 && d1 < 0.05);
    }
}

TEST(the_field_is_solenoidal_and_does_not_cross_the_bed)
{
    double depth = 0.7, h = 1e-5;
    WaveState waves = waves_create(scene_of(0.1, 1.3, 0.4, depth));
    for (int i = 0; i < 50; i++) {
        Vec3 p = random_point(depth);
        p.z = mind(p.z, -0.1);
        double divergence = 0;
        for (int axis = 0; axis < 3; axis++) {
            Vec3 e = vec3(axis == 0 ? h : 0, axis == 1 ? h : 0, axis == 2 ? h : 0);
            Vec3 d = vec3_sub(waves_velocity(&waves, vec3_add(p, e), 0.37),
                              waves_velocity(&waves, vec3_sub(p, e), 0.37));
            divergence += vec3_dot(d, e) / (2 * h * h);
        }
        CHECK_NEAR(divergence, 0, 1e-7);
        p.z = -depth;
        CHECK_NEAR(waves_velocity(&waves, p, 0.37).z, 0, 1e-14);
        CHECK_NEAR(waves_displacement(&waves, p, 0.37).z, 0, 1e-14);
    }
}

/// Largest |ring's velocity - zone velocity at the displaced place| over the orbit speed.
static double ring_against_zone(WaveTheory theory, double height, double depth)
{
    Scene *scene = scene_of(height, 1.4, 0.6, depth);
    scene->waves.theory = theory;
    WaveState waves = waves_create(scene);
    waves.interior.width = 0; // drift is taken out everywhere
    double worst = 0;
    for (int i = 0; i < 400; i++) {
        Vec3 mean = random_point(depth);
        double time = random_between(0, 3);
        Vec3 place = vec3_add(mean, waves_displacement(&waves, mean, time));
        Vec3 ring = waves_orbit_velocity(&waves, mean, time);
        worst = maxd(worst, distance(ring, waves_zone_velocity(&waves, place, time)));
    }
    return worst / (height * PI / 1.4);
}

TEST(ring_and_zone_agree_to_second_order)
{
    for (double depth = 0.3; depth < 10; depth *= 2.5) {
        double coarse = ring_against_zone(WAVE_THEORY_STOKES2, 0.02, depth);
        CHECK(coarse < 0.03);
        CHECK_NEAR(coarse / ring_against_zone(WAVE_THEORY_STOKES2, 0.01, depth), 4, 0.8);
    }
}

TEST(ring_and_zone_agree_in_steep_stream_function_waves)
{
    for (double depth = 0.4; depth < 10; depth *= 2.5) {
        double breaking =
            wave_breaking_height(wave_number_airy(2 * PI / 1.4, depth, GRAVITY), depth);
        double stream = ring_against_zone(WAVE_THEORY_STREAM, 0.6 * breaking, depth);
        CHECK(stream < 0.03);
        CHECK(stream < 0.2 * ring_against_zone(WAVE_THEORY_STOKES2, 0.6 * breaking, depth));
    }
}

TEST(particles_of_the_zone_field_return_and_those_of_the_interior_drift)
{
    double depth = 1.0, period = 1.5, height = 0.06, dt = period / 200;
    WaveState waves = waves_create(scene_of(height, period, 0, depth)), zone = waves;
    double z = -0.25, drift = wave_drift(&waves.layers[0].train.terms, z) * 10 * period;
    zone.interior.width = 0; // drift is taken out everywhere
    Vec3 closed = vec3(0, 0, z), open = vec3(0, 0, z);
    closed = vec3_add(closed, waves_displacement(&waves, closed, 0)), open = closed;
    Vec3 start = closed;
    for (int i = 0; i < 2000; i++) { // ten periods, explicit midpoint
        double t = i * dt;
        Vec3 half = vec3_mad(closed, waves_zone_velocity(&zone, closed, t), dt / 2);
        closed = vec3_mad(closed, waves_zone_velocity(&zone, half, t + dt / 2), dt);
        half = vec3_mad(open, waves_velocity(&waves, open, t), dt / 2);
        open = vec3_mad(open, waves_velocity(&waves, half, t + dt / 2), dt);
    }
    CHECK(drift > 0.012);
    CHECK_NEAR(closed.x, start.x, 0.02 * drift);
    CHECK_NEAR(open.x - start.x, drift, 0.15 * drift);
}

TEST(the_fading_drift_of_the_zone_has_no_divergence_and_carries_nothing)
{
    double depth = 0.8, h = 1e-4;
    Scene *scene = scene_of(0.1, 1.3, 0.4, depth);
    scene->domain.min.x = scene->domain.min.y = -4;
    WaveState waves = waves_create(scene);
    const WaveTerms *w = &waves.layers[0].train.terms;
    CHECK(waves.interior.width > 0.5);
    for (int i = 0; i < 40; i++) {
        Vec3 p =
            vec3(random_between(-3.9, 4.9), random_between(-3.9, 3.9), random_between(-0.7, -0.1));
        double divergence = 0;
        for (int axis = 0; axis < 3; axis++) {
            Vec3 e = vec3(axis == 0 ? h : 0, axis == 1 ? h : 0, axis == 2 ? h : 0),
                 mean = vec3(0, 0, 0);
            for (int n = 0; n < 32; n++) { // mean over a period
                double t = 1.3 * n / 32;
                Vec3 d = vec3_sub(waves_zone_velocity(&waves, vec3_add(p, e), t),
                                  waves_zone_velocity(&waves, vec3_sub(p, e), t));
                mean = vec3_mad(mean, d, 1 / (2 * h * 32));
            }
            divergence += axis == 0 ? mean.x : (axis == 1 ? mean.y : mean.z);
        }
        CHECK_NEAR(divergence, 0, 0.15 * w->drift[1] / waves.interior.width);
    }
    CHECK_NEAR(wave_drift_integral(w, 0), 0, 1e-3 * w->drift[1] * depth);
}

TEST(orbits_close_and_their_rates_are_their_derivatives)
{
    double period = 1.4, h = 1e-4;
    WaveState waves = waves_create(scene_of(0.1, period, 2.2, 0.8));
    for (int i = 0; i < 100; i++) {
        Vec3 mean = random_point(0.8);
        double t = random_between(0, 5);
        Vec3 d = waves_displacement(&waves, mean, t), v = waves_orbit_velocity(&waves, mean, t);
        CHECK_NEAR(distance(d, waves_displacement(&waves, mean, t + period)), 0, 1e-12);
        Vec3 next = waves_displacement(&waves, mean, t + h);
        Vec3 last = waves_displacement(&waves, mean, t - h);
        CHECK_NEAR(distance(v, vec3_scale(vec3_sub(next, last), 1 / (2 * h))), 0, 1e-7);
    }
}

TEST(columns_follow_the_surface_and_the_freeboard_rides_on_top)
{
    double period = 1.4;
    WaveState waves = waves_create(scene_of(0.05, period, 0, 0.8));
    for (double t = 0; t < period; t += 0.1) {
        Vec3 mean = vec3(0.3, 0, 0), d = waves_displacement(&waves, mean, t);
        double eta = waves_elevation(&waves, mean.x + d.x, 0, t);
        CHECK_NEAR(d.z, eta, 2e-4);
        CHECK_NEAR(distance(waves_displacement(&waves, vec3(0.3, 0, 0.2), t), d), 0, 1e-15);
    }
}

TEST(waves_travel_along_their_heading_and_2d_ignores_y)
{
    double heading = 2.0, period = 1.3;
    Scene *scene = scene_of(0.1, period, heading, 2);
    WaveState waves = waves_create(scene);
    double k = waves.layers[0].train.terms.wave_number, step = 0.1 * period;
    double advance = 2 * PI / k * 0.1;
    for (int i = 0; i < 20; i++) {
        double x = random_between(-3, 5), y = random_between(-2, 4);
        CHECK_NEAR(
            waves_elevation(&waves, x + advance * cos(heading), y + advance * sin(heading), step),
            waves_elevation(&waves, x, y, 0), 1e-12);
    }
    for (double x = -3; x < 5; x += 0.1) // a crest at the centre at the start
        CHECK(waves_elevation(&waves, x, 1, 0) <= waves_elevation(&waves, 1, 1, 0));
    scene->domain.dimensions = 2;
    scene->waves.initial.heading = PI;
    waves = waves_create(scene);
    CHECK(waves_elevation(&waves, 0.4, 17, 0.2) == waves_elevation(&waves, 0.4, 0, 0.2));
    CHECK(waves_displacement(&waves, vec3(0.4, 3, -0.1), 0.2).y == 0);
}

TEST(single_precision_sine_cosine_and_power_are_accurate)
{
    double sine_error = 0, power_error = 0;
    for (int i = -1000; i <= 1000; i++) {
        float turns = (float)i / 2000, sine, cosine, x = (float)i * 0.06f;
        wave_sine_cosine(turns, &sine, &cosine);
        sine_error = maxd(sine_error, fabs(sine - sin(2 * PI * (double)turns)));
        sine_error = maxd(sine_error, fabs(cosine - cos(2 * PI * (double)turns)));
        power_error = maxd(power_error, fabs(wave_exp2(x) / exp2((double)x) - 1));
    }
    CHECK(sine_error < 7e-7);
    CHECK(power_error < 3e-7);
    CHECK_NEAR(wave_fraction(-7.75f), 0.25, 1e-6);
    CHECK_NEAR(wave_fraction(12.625f), -0.375, 1e-6);
}

/// Batch functions against the scalar ones, relative to the height and its rates.
static void check_batch(const WaveState *waves, double time, double depth, double height)
{
    enum { COUNT = 1000 };
    static float x[COUNT], y[COUNT], z[COUNT], u[COUNT], v[COUNT], w[COUNT];
    static Vec3 mean[COUNT], place[COUNT];
    for (int i = 0; i < COUNT; i++) {
        Vec3 p = random_point(depth);
        p.z += random_between(0, 0.5);
        x[i] = (float)p.x;
        y[i] = (float)p.y;
        z[i] = (float)p.z;
        mean[i] = vec3((double)x[i], (double)y[i], (double)z[i]);
    }
    waves_zone_batch(waves, time, COUNT, x, y, z, u, v, w);
    waves_ring_places(waves, time, COUNT, mean, place);
    double worst_zone = 0, worst_place = 0;
    for (int i = 0; i < COUNT; i++) {
        Vec3 ring = vec3_add(mean[i], waves_displacement(waves, mean[i], time));
        Vec3 zone = waves_zone_velocity(waves, mean[i], time);
        worst_place = maxd(worst_place, distance(ring, place[i]));
        worst_zone =
            maxd(worst_zone, distance(zone, vec3((double)u[i], (double)v[i], (double)w[i])));
    }
    CHECK(worst_zone < 2e-5 * height);
    CHECK(worst_place < 5e-15);
}

TEST(batches_agree_with_the_scalar_functions)
{
    const double depths[] = {0.3, 2, 60};
    for (int i = 0; i < 3; i++) {
        double height = 0.1;
        Scene *scene = scene_of(height, 1.4, 0.3, depths[i]);
        WaveState waves = waves_create(scene);
        check_batch(&waves, 0, depths[i], height);
        check_batch(&waves, 1e4, depths[i], height);
        for (int k = 0; k < 4; k++) { // several layers at once
            WaveTarget next = {0.08, 1.35 + 0.02 * k, 0.1 * k};
            waves_command(&waves, scene, &next, 10 + 0.8 * k);
        }
        CHECK(waves.layer_count > 2);
        check_batch(&waves, 12.7, depths[i], height);
    }
}

TEST(batches_without_y_serve_two_dimensions)
{
    Scene *scene = scene_of(0.1, 1.4, 0, 1);
    scene->domain.dimensions = 2;
    WaveState waves = waves_create(scene);
    float x[70], z[70], u[70], w[70];
    for (int i = 0; i < 70; i++) {
        x[i] = 0.1f * (float)i;
        z[i] = -0.01f * (float)i;
    }
    waves_zone_batch(&waves, 0.3, 70, x, NULL, z, u, NULL, w);
    Vec3 last = waves_zone_velocity(&waves, vec3(x[69], 0, z[69]), 0.3);
    CHECK_NEAR(u[69], last.x, 1e-6);
    CHECK_NEAR(w[69], last.z, 1e-6);
}

TEST(a_scene_without_waves_has_still_water)
{
    Scene *scene = scene_of(0.1, 1.4, 0, 1);
    scene->waves.kind = WAVES_NONE;
    WaveState waves = waves_create(scene);
    WaveTarget ask = {0.1, 1, 0};
    waves_command(&waves, scene, &ask, 0);
    waves_update(&waves, scene, 1);
    CHECK(waves_elevation(&waves, 1, 1, 2) == 0);
    CHECK(vec3_norm(waves_displacement(&waves, vec3(0, 0, 0), 2)) == 0);
    CHECK(waves_now(&waves, 2).height == 0);
    CHECK(waves_zone_width(scene) == 0);
}

TEST(warnings_name_breaking_resolution_shallow_water_and_a_small_basin)
{
    char text[512];
    Scene *scene = scene_of(0.1, 1.0, 0, 1);
    CHECK(waves_warnings(scene, text, sizeof text) == 0);
    CHECK(text[0] == '\0');
    scene->waves.initial.height = 0.19; // breaking at 0.142 * 1.56 = 0.22
    CHECK(waves_warnings(scene, text, sizeof text) == 1);
    CHECK_CONTAINS(text, "near breaking");
    scene->waves.initial.height = 0.24;
    CHECK(waves_warnings(scene, text, sizeof text) == 2);
    CHECK_CONTAINS(text, "breaks: 108 % of the breaking height 0.142 L tanh(kd) = 0.221 m");
    CHECK_CONTAINS(text, "Stokes' to second order instead");
    scene->waves.initial.height = 0.19;
    scene->fluid.spacing = 0.05;
    scene->domain.max.x = 0.5;
    CHECK(waves_warnings(scene, text, sizeof text) == 3);
    CHECK_CONTAINS(text, "spacings");
    CHECK_CONTAINS(text, "undriven interior");
    CHECK_CONTAINS(text, "; ");
    scene = scene_of(0.05, 4, 0, 0.1);
    scene->waves.theory = WAVE_THEORY_STOKES5;
    CHECK(waves_warnings(scene, text, sizeof text) >= 1);
    CHECK_CONTAINS(text, "Ursell");
    char tiny[8];
    CHECK(waves_warnings(scene, tiny, sizeof tiny) >= 1);
    CHECK(strlen(tiny) < sizeof tiny);
}

TEST(the_zone_is_sized_for_the_longest_wave_that_may_be_asked)
{
    Scene *scene = scene_of(0.1, 1.0, 0, 1);
    scene->waves.period_limits.max = 1.5;
    double length = 2 * PI / wave_number_airy(2 * PI / 1.5, 1, GRAVITY);
    CHECK_NEAR(waves_zone_width(scene), 0.75 * length, 1e-12);
    scene->domain.kind = DOMAIN_FLUME;
    CHECK_NEAR(waves_zone_width(scene), length, 1e-12);
    scene->domain.kind = DOMAIN_TANK;
    CHECK(waves_zone_width(scene) == 0);
    scene->domain.kind = DOMAIN_BASIN;
    scene->waves.zone_width = 1.1;
    CHECK(waves_zone_width(scene) == 1.1);
}

TEST(in_a_domain_of_lines_waves_ride_on_the_current_and_nothing_flows_back)
{
    Scene *scene = scene_of(0.05, 1.4, 0.3, 2);
    scene->domain.kind = DOMAIN_LINES;
    WaveState still = waves_create(scene);
    CHECK(still.layers[0].train.terms.mean_velocity == 0);
    scene->waves.current = (Current){0.4, 0.3 + PI / 3, 0};
    CHECK_NEAR(current_along(&scene->waves.current, 0.3), 0.2, 1e-12);
    CHECK_NEAR(vec3_norm(current_velocity(&scene->waves.current, 3)), 0.4, 1e-12);
    WaveState waves = waves_create(scene);
    const WaveTerms *w = &waves.layers[0].train.terms;
    double sigma = w->angular_frequency; // in the water; Doppler makes it the one asked for
    CHECK_NEAR(sigma + 0.2 * w->wave_number, 2 * PI / 1.4, 1e-9);
    CHECK_NEAR(GRAVITY * w->wave_number * tanh(w->wave_number * 2) / (sigma * sigma), 1, 0.01);
    CHECK(w->wave_number < 0.9 * still.layers[0].train.terms.wave_number);
    CHECK(w->mean_velocity == 0); // who asks adds the current
}

TEST(a_regular_wave_of_no_height_is_told_as_still)
{
    char text[400];
    waves_tell(scene_of(0, 1.4, 0, 1), text, sizeof text);
    CHECK_CONTAINS(text, "still");
    CHECK(!strstr(text, "components"));
}
