/// Small scenes in memory and how to run them; for tests of whole scenes.
#ifndef FAIRLEAD_TEST_SCENES_H
#define FAIRLEAD_TEST_SCENES_H

/// Whole scenes, small enough for every build: hydrostatics, waves, floating, determinism,
/// roll-back.
#include "test.h"

#include <stdlib.h>

#include "engine.h"
#include "health.h"
#include "probes.h"

static Error error;

/// A scene in memory: 2-D tank 2 m long, 0.5 m deep.
static inline Scene tank_2d(double spacing)
{
    Scene scene = scene_default();
    scene.domain.kind = DOMAIN_TANK;
    scene.domain.dimensions = 2;
    scene.domain.min = vec3(-1, -0.5, -0.5);
    scene.domain.max = vec3(1, 0.5, 0.2);
    scene.fluid.spacing = spacing;
    return scene;
}

typedef struct Run {
    Scene scene;
    Plan plan;
    State *state;
} Run;

static inline Run *start(const Scene *scene, int threads)
{
    Run *run = calloc(1, sizeof *run);
    run->scene = *scene;
    EngineOptions options = {.threads = threads, .backend = "cpu"};
    bool good = plan_build(&run->scene, &options, &run->plan, &error) &&
                state_create(&run->scene, &run->plan, &run->state, &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    return run;
}

static inline void advance_to(Run *run, double time)
{
    while (run->state->time < time)
        if (!step_advance(&run->scene, &run->plan, run->state, &error)) {
            printf("  %s\n", error.message);
            CHECK(false);
            return;
        }
}

static inline void finish(Run *run)
{
    state_destroy(run->state);
    plan_destroy(&run->plan);
    free(run);
}

static inline Scene basin_2d(double spacing)
{
    Scene scene = tank_2d(spacing);
    scene.domain.kind = DOMAIN_BASIN;
    scene.domain.min = vec3(-2.2, -0.5, -0.6);
    scene.domain.max = vec3(2.2, 0.5, 0.25);
    scene.waves.kind = WAVES_REGULAR;
    scene.waves.initial = (WaveTarget){0.12, 1.0, 0};
    scene.waves.start = WAVE_START_HOT;
    scene.waves.height_limits = (Range){0, 0.2};
    scene.waves.period_limits = (Range){0.8, 1.1};
    scene.waves.heading_limits = (Range){0, 2 * PI};
    scene.gauge_count = 1;
    return scene;
}

#endif
