/// Height ratios, reflection and the slow gain, on gauges that are computed.
#include "wave_quality.h"

#include "test.h"

/// A basin with three gauges a quarter of a wave apart, in deep water, L = 2 m.
static Scene *scene_of(WaveKind kind)
{
    static Scene scene;
    scene = scene_default();
    scene.domain.kind = DOMAIN_BASIN;
    scene.domain.dimensions = 2;
    scene.domain.min = vec3(-4, -0.5, -2);
    scene.domain.max = vec3(4, 0.5, 0.3);
    scene.fluid.spacing = 0.01;
    scene.waves.kind = kind;
    scene.waves.start = WAVE_START_HOT;
    scene.waves.theory = WAVE_THEORY_AIRY;
    scene.waves.initial = (WaveTarget){0.06, 1.132, 0};
    scene.gauge_count = scene.quality_gauge_count = 3;
    for (int i = 0; i < 3; i++) {
        scene.gauges[i].x = -0.5 + 0.45 * i;
        scene.quality_gauges[i] = i;
    }
    return &scene;
}

/// A basin that makes waves of `height` times what its trains say, reflects a share of them and
/// loses some on the way.
typedef struct Water {
    const Scene *scene;
    const WaveState *waves;
    double time, height, reflection;
} Water;

static double read(const void *context, int gauge)
{
    const Water *w = context;
    const WaveTrain *train = &w->waves->layers[w->waves->layer_count - 1].train;
    double k = train->terms.wave_number, omega = train->terms.angular_frequency;
    double x = w->scene->gauges[gauge].x, a = train->amplitude * w->height;
    return a * cos(k * x - omega * w->time) +
           w->reflection * a * cos(-k * x - omega * w->time + 0.7);
}

static void run(Water *w, WaveQuality *quality, WaveState *waves, double until)
{
    for (; w->time < until; w->time += 0.004) {
        waves_update(waves, w->scene, w->time);
        wave_quality_advance(quality, w->scene, waves, w->time, read, w);
    }
}

TEST(reflection_of_two_known_waves_is_found_wherever_the_gauges_are)
{
    for (double shift = 0; shift < 2; shift += 0.3) {
        double along[3] = {shift, shift + 0.4, shift + 0.75}, re[3], im[3], k = PI;
        for (int i = 0; i < 3; i++) {
            re[i] = cos(k * along[i]) + 0.13 * cos(-k * along[i] + 1);
            im[i] = sin(k * along[i]) + 0.13 * sin(-k * along[i] + 1);
        }
        CHECK_NEAR(wave_reflection(k, 3, along, re, im), 0.13, 1e-12);
    }
    double blind[3] = {0, 1, 2}, one[3] = {1, -1, 1}, none[3] = {0, 0, 0}; // half a wave apart
    CHECK(isnan(wave_reflection(PI, 3, blind, one, none)));
}

TEST(heights_and_reflection_are_told_once_the_waves_have_settled)
{
    Scene *scene = scene_of(WAVES_REGULAR);
    WaveState waves = waves_create(scene);
    WaveQuality quality = wave_quality_create();
    Water water = {scene, &waves, 0, 0.9, 0.05};
    CHECK(wave_quality_asked(scene));
    run(&water, &quality, &waves, 1);
    CHECK(isnan(quality.gauge[0].height));
    run(&water, &quality, &waves, 11);
    CHECK_NEAR(quality.reflection, 0.05, 0.001);
    for (int i = 0; i < 3; i++) // the standing part adds and takes 5 %
        CHECK_NEAR(quality.gauge[i].height / 0.06, 0.9, 0.05 * 0.9 + 0.003);
    WaveTarget ask = {0.03, 1.132, 0};
    waves_command(&waves, scene, &ask, 11);
    run(&water, &quality, &waves, 12);
    CHECK(quality.periods == 0); // nothing is told of waves that change
    run(&water, &quality, &waves, 25);
    CHECK_NEAR(quality.gauge[1].height / 0.03, 0.9, 0.05);
}

TEST(the_gain_brings_the_wave_at_its_gauge_to_the_height_asked_for_slowly_and_within_bounds)
{
    Scene *scene = scene_of(WAVES_REGULAR);
    scene->waves.gain = (WaveGain){1, 1, 1.25, "b"};
    WaveState waves = waves_create(scene);
    WaveQuality quality = wave_quality_create();
    Water water = {scene, &waves, 0, 0.9, 0};
    run(&water, &quality, &waves, 3 * 1.132);
    CHECK(waves.gain == 1);
    run(&water, &quality, &waves, 40);
    CHECK_NEAR(waves.gain, 1 / 0.9, 0.004);
    CHECK_NEAR(quality.gauge[QUALITY_GAUGES].height / 0.06, 1, 0.004);
    water.height = 0.5;
    run(&water, &quality, &waves, 80);
    CHECK_NEAR(waves.gain, 1.25, 1e-12);
}

TEST(a_gain_known_beforehand_makes_the_first_wave)
{
    Scene *scene = scene_of(WAVES_REGULAR);
    scene->waves.gain = (WaveGain){1, 1 / 0.9, 1.25, "b"};
    WaveState waves = waves_create(scene);
    CHECK(waves.gain == 1 / 0.9);
    WaveQuality quality = wave_quality_create();
    Water water = {scene, &waves, 0, 0.9, 0};
    run(&water, &quality, &waves, 40);
    CHECK_NEAR(quality.gauge[QUALITY_GAUGES].height / 0.06, 1, 0.004);
    CHECK_NEAR(waves.gain, 1 / 0.9, 0.004);
    scene->waves.gain.gauge = -1;
    CHECK(waves_create(scene).gain == 1);
}

TEST(a_case_that_does_not_ask_is_not_judged)
{
    Scene *scene = scene_of(WAVES_REGULAR);
    scene->quality_gauge_count = 0;
    CHECK(!wave_quality_asked(scene));
    scene->waves.gain.gauge = 0;
    CHECK(wave_quality_asked(scene));
    scene->waves.kind = WAVES_NONE;
    CHECK(!wave_quality_asked(scene));
}
