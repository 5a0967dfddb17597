/// Irregular seas and focused groups: energy, peak, spreading, focus, agreement of their batches.
#include "sea.h"

#include <stdlib.h>
#include <time.h>

#include "piston.h"
#include "test.h"

static Error error;
static Arena arena;

/// A basin 8 x 6 m, still water at z = 0, hot start.
static Scene *scene_of(WaveKind kind, double height, double period)
{
    static Scene scene;
    scene = scene_default();
    scene.domain.kind = DOMAIN_BASIN;
    scene.domain.min = vec3(-3, -2, -1);
    scene.domain.max = vec3(5, 4, 1);
    scene.fluid.spacing = height / 6;
    scene.waves.kind = kind;
    scene.waves.start = WAVE_START_HOT;
    scene.waves.initial = (WaveTarget){height, period, 0.3};
    scene.waves.focus = (Focus){1.5, 0.5, 9};
    return &scene;
}

static WaveState sea_of(const Scene *scene)
{
    WaveState waves = waves_create(scene);
    CHECK(waves_take_sea(&waves, scene, &arena, &error));
    return waves;
}

static double random_between(double low, double high)
{
    static uint64_t state = 99;
    return low + (high - low) * (double)(sea_random(&state) >> 11) * 0x1p-53;
}

static double distance(Vec3 a, Vec3 b) { return vec3_norm(vec3_sub(a, b)); }

TEST(the_generator_gives_its_published_numbers)
{
    uint64_t state = 1234567;
    CHECK(sea_random(&state) == 6457827717110365317u);
    CHECK(sea_random(&state) == 3203168211198807973u);
}

TEST(the_elevation_of_a_sea_has_the_significant_height_asked_for)
{
    const double shapes[] = {1, 3.3, 7};
    for (int i = 0; i < 3; i++) {
        Scene *scene = scene_of(WAVES_IRREGULAR, 0.02, 1.4);
        scene->waves.spectrum.peak_enhancement = shapes[i];
        WaveState waves = sea_of(scene);
        double sum = 0, mean = 0;
        int count = 40000;
        for (int n = 0; n < count; n++) { // half an hour at the model's scale
            double eta = waves_elevation(&waves, 0.4, 0.7, 0.045 * n);
            sum += eta * eta;
            mean += eta;
        }
        mean /= count;
        CHECK_NEAR(4 * sqrt(sum / count - mean * mean) / 0.02, 1, 0.01);
        CHECK_NEAR(mean / 0.02, 0, 0.005);
    }
}

/// Energy of components between two relative frequencies over all of it.
static double band(const Sea *sea, double low, double high)
{
    double sum = 0, all = 0;
    for (int i = 0; i < sea->count; i++) {
        double a = sea->shape[i].share, x = sea->shape[i].frequency;
        all += a * a;
        sum += x >= low && x < high ? a * a : 0;
    }
    return sum / all;
}

TEST(the_spectrum_has_its_peak_at_the_period_asked_for_and_jonswaps_form)
{
    Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
    scene->waves.spectrum.components = 512;
    const Sea *sea = sea_of(scene).sea;
    double best = 0, at = 0;
    for (double x = 0.65; x < 2; x += 0.01) {
        double energy = band(sea, x - 0.02, x + 0.02);
        if (energy > best) best = energy, at = x;
    }
    CHECK_NEAR(at, 1, 0.02);
    double total = 0, part = 0; // against the density, integrated here
    for (double x = 0.6005; x < 3; x += 0.001) {
        total += sea_density(x, 3.3);
        part += x > 0.9 && x < 1.2 ? sea_density(x, 3.3) : 0;
    }
    CHECK_NEAR(band(sea, 0.9, 1.2), part / total, 0.01);
    // m0 = alpha g^2 (2 pi)^-4 fp^-4 / 5 for Pierson & Moskowitz: the integral of our form
    double whole = 0;
    for (double x = 0.3005; x < 40; x += 0.001)
        whole += 0.001 * sea_density(x, 1);
    CHECK_NEAR(whole, 0.2, 1e-4);
}

TEST(directions_spread_about_the_heading_as_cos2s)
{
    const double powers[] = {2, 10, 50};
    for (int p = 0; p < 3; p++) {
        Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
        scene->waves.spectrum.spreading = powers[p];
        const Sea *sea = sea_of(scene).sea;
        double c = 0, s = 0, mixed = 0;
        for (int i = 0; i < sea->count; i++) {
            c += cos(sea->shape[i].turn) / sea->count;
            s += sin(sea->shape[i].turn) / sea->count;
            mixed += sea->shape[i].turn * (i - sea->count / 2.0) / sea->count / sea->count;
        }
        CHECK_NEAR(c, powers[p] / (powers[p] + 1), 0.01); // first moment of cos^2s(theta/2)
        CHECK_NEAR(s, 0, 1e-3);
        CHECK_NEAR(mixed, 0, 0.2); // and not by frequency
    }
}

TEST(the_same_seed_gives_the_same_sea_and_another_another)
{
    Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
    scene->waves.spectrum.spreading = 8;
    WaveState a = sea_of(scene), b = sea_of(scene);
    scene->waves.spectrum.seed = 2;
    WaveState c = sea_of(scene);
    CHECK(waves_elevation(&a, 0.3, 0.4, 7) == waves_elevation(&b, 0.3, 0.4, 7));
    CHECK(waves_elevation(&a, 0.3, 0.4, 7) != waves_elevation(&c, 0.3, 0.4, 7));
}

TEST(crests_of_a_group_meet_where_and_when_they_are_asked_to)
{
    Scene *scene = scene_of(WAVES_FOCUSED, 0.1, 1.4);
    WaveState waves = sea_of(scene);
    double peak = waves_elevation(&waves, 1.5, 0.5, 9), highest = 0, quiet = 0;
    // half the height; orbits lift crests to second order
    CHECK(peak > 0.05 && peak < 0.056);
    for (double t = 0; t < 18; t += 0.02)
        for (double x = -3; x < 5; x += 0.5) {
            double eta = waves_elevation(&waves, x, 0.5, t);
            if (fabs(t - 9) > 0.1 || fabs(x - 1.5) > 0.1) highest = maxd(highest, eta);
            if (fabs(t - 9) > 7 && x == 1.5) quiet = maxd(quiet, fabs(eta));
        }
    CHECK(highest < peak);
    CHECK(quiet < 0.1 * peak);
}

TEST(a_sea_is_changed_live_without_a_jump_and_meets_its_phases)
{
    Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
    WaveState waves = sea_of(scene), before = sea_of(scene);
    WaveTarget ask = {0.05, 1.6, 0.3};
    Vec3 mean = vec3(1, 1, 0);
    waves_command(&waves, scene, &ask, 20);
    CHECK_NEAR(
        distance(waves_displacement(&waves, mean, 20), waves_displacement(&before, mean, 20)), 0,
        1e-15);
    double middle = 20 + 0.75 * 1.6; // at the centre every component meets its elder there
    Vec3 d = waves_displacement(&waves, mean, middle),
         e = waves_displacement(&before, mean, middle);
    CHECK_NEAR(d.z, 0.75 * e.z, 0.01 * 0.1); // but for the mean lift, which goes with a^2
    waves_update(&waves, scene, 23);
    CHECK(!waves.active);
    CHECK_NEAR(waves_now(&waves, 23).height, 0.05, 1e-12);
    // a checkpoint is a copy of the layers: components follow
    WaveState copy = waves;
    Vec3 then = waves_displacement(&waves, mean, 24);
    ask.height = 0.1;
    waves_command(&waves, scene, &ask, 24);
    waves_update(&waves, scene, 30);
    waves = copy;
    waves_refresh(&waves);
    CHECK(distance(waves_displacement(&waves, mean, 24), then) == 0);
}

TEST(ring_and_zone_of_a_sea_agree_and_velocity_is_the_orbits_rate)
{
    Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
    scene->waves.spectrum.spreading = 8;
    WaveState waves = sea_of(scene);
    WaveTarget ask = {0.08, 1.5, 0.4};
    waves_command(&waves, scene, &ask, 3); // two layers at once
    double worst = 0, rate = 0, h = 1e-4;
    for (int i = 0; i < 200; i++) {
        Vec3 mean = vec3(random_between(-3, 5), random_between(-2, 4), random_between(-1, 0));
        double t = random_between(3, 5);
        Vec3 place = vec3_add(mean, waves_displacement(&waves, mean, t));
        Vec3 v = waves_orbit_velocity(&waves, mean, t);
        worst = maxd(worst, distance(v, waves_zone_velocity(&waves, place, t)));
        Vec3 step = vec3_sub(waves_displacement(&waves, mean, t + h),
                             waves_displacement(&waves, mean, t - h));
        rate = maxd(rate, distance(v, vec3_scale(step, 0.5 / h)));
    }
    CHECK(rate < 1e-6);
    CHECK(worst < 0.1 * 0.1 * PI / 1.4);
}

TEST(batches_of_a_sea_agree_with_the_scalar_functions)
{
    enum { COUNT = 500 };
    static float x[COUNT], y[COUNT], z[COUNT], u[COUNT], v[COUNT], w[COUNT];
    static Vec3 mean[COUNT], place[COUNT];
    Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
    scene->waves.spectrum.spreading = 8;
    WaveState waves = sea_of(scene);
    WaveTarget ask = {0.08, 1.5, 0.4};
    waves_command(&waves, scene, &ask, 1000);
    for (int i = 0; i < COUNT; i++) {
        x[i] = (float)random_between(-3, 5);
        y[i] = (float)random_between(-2, 4);
        z[i] = (float)random_between(-1, 0.1);
        mean[i] = vec3((double)x[i], (double)y[i], (double)z[i]);
    }
    waves_ring_places(&waves, 1001, COUNT, mean, place);
    waves_zone_batch(&waves, 1001, COUNT, x, y, z, u, v, w);
    double ring = 0, zone = 0;
    for (int i = 0; i < COUNT; i++) {
        Vec3 d = waves_displacement(&waves, mean[i], 1001);
        Vec3 velocity = waves_zone_velocity(&waves, mean[i], 1001);
        ring = maxd(ring, distance(vec3_sub(place[i], mean[i]), d));
        zone = maxd(zone, distance(velocity, vec3((double)u[i], (double)v[i], (double)w[i])));
    }
    CHECK(ring < 3e-7);
    CHECK(zone < 1e-5);
}

TEST(the_paddle_of_a_sea_makes_its_components)
{
    Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
    scene->domain.kind = DOMAIN_FLUME;
    scene->waves.initial.heading = 0;
    WaveState waves = sea_of(scene);
    double sum = 0;
    int count = 40000;
    for (int n = 0; n < count; n++) {
        double s = piston_displacement(&waves, 0.045 * n);
        sum += s * s;
    }
    double expected = 0; // each component its own stroke
    for (int i = 0; i < waves.sea->count; i++) {
        double a = 0.1 * waves.sea->shape[i].share;
        double ratio = piston_stroke_ratio(waves.sea->layers[0].wave_number[i] * 1);
        expected += 0.5 * a * a * ratio * ratio;
    }
    CHECK_NEAR(sum / count / expected, 1, 0.02);
}

/// Processor time per particle of the ring's and the zone's batch with this many components [ns]:
/// the least of five rounds.
static void cost_of(int components, double *ring, double *zone)
{
    enum { COUNT = 4096 };
    static Vec3 mean[COUNT], place[COUNT];
    static float x[COUNT], y[COUNT], z[COUNT], u[COUNT], v[COUNT], w[COUNT];
    Scene *scene = scene_of(WAVES_IRREGULAR, 0.1, 1.4);
    scene->waves.spectrum.components = components;
    WaveState waves = sea_of(scene);
    for (int i = 0; i < COUNT; i++) {
        mean[i] = vec3(random_between(-3, 5), random_between(-2, 4), random_between(-1, 0));
        x[i] = (float)mean[i].x, y[i] = (float)mean[i].y, z[i] = (float)mean[i].z;
    }
    *ring = *zone = INFINITY;
    for (int n = 0; n < 5; n++) {
        clock_t begin = clock();
        waves_ring_places(&waves, n, COUNT, mean, place);
        clock_t middle = clock();
        waves_zone_batch(&waves, n, COUNT, x, y, z, u, v, w);
        *ring = mind(*ring, (double)(middle - begin) / CLOCKS_PER_SEC / COUNT * 1e9);
        *zone = mind(*zone, (double)(clock() - middle) / CLOCKS_PER_SEC / COUNT * 1e9);
    }
}

/// A ratio of two costs in one run: it holds on any machine and under sanitizers alike.
TEST(a_sea_costs_no_more_than_its_number_of_components)
{
    double ring[2], zone[2];
    cost_of(32, &ring[0], &zone[0]);
    cost_of(256, &ring[1], &zone[1]);
    printf("  32 components: ring %.0f ns, zone %.0f ns a particle; 256: %.0f, %.0f ns\n", ring[0],
           zone[0], ring[1], zone[1]);
    CHECK(ring[1] < 8 * 1.5 * ring[0]);
    CHECK(zone[1] < 8 * 1.5 * zone[0]);
}
