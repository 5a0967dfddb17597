/// What the bench counts, against counting by hand.
#include "test.h"

#include <stdlib.h>

#include "engine.h"
#include "fill.h"

static Error error;

static int near_ones(const Vec3 *points, int count, Vec3 place, double reach)
{
    int near = 0;
    for (int i = 0; i < count; i++) {
        Vec3 way = vec3_sub(points[i], place);
        near += vec3_dot(way, way) < reach * reach;
    }
    return near;
}

/// Against all pairs of the particles as they were made.
static void check_neighbours(const Scene *scene, const Plan *plan, const BackendStatistics *counted)
{
    Arena arena = arena_create(0);
    Fill fill;
    CHECK(fill_create(scene, plan, &arena, &fill, &error));
    double fluid = 0, dummies = 0, reach = 2 * plan->smoothing_length;
    for (int i = 0; i < fill.fluid_count; i++) {
        Vec3 place = fill.fluid_position[i];
        fluid += near_ones(fill.fluid_position, fill.fluid_count, place, reach) - 1;
        dummies += near_ones(fill.dummy_reference, fill.wall_count, place, reach);
    }
    CHECK(counted->fluid_count == fill.fluid_count && counted->dummy_count == fill.wall_count);
    CHECK(counted->sample == fill.fluid_count);
    CHECK_NEAR(counted->neighbours_fluid, fluid / fill.fluid_count, 1e-9);
    CHECK_NEAR(counted->neighbours_dummy, dummies / fill.fluid_count, 1e-9);
    arena_destroy(&arena);
}

TEST(neighbours_are_those_that_lie_within_the_support)
{
    Scene *scene = calloc(1, sizeof *scene);
    Plan *plan = calloc(1, sizeof *plan);
    State *state = NULL;
    EngineOptions options = {.threads = 2, .backend = "cpu"};
    *scene = scene_default();
    scene->domain.min = vec3(-0.4, -0.3, -0.35);
    scene->domain.max = vec3(0.4, 0.3, 0.1);
    scene->fluid.spacing = 0.04;
    scene->fluid.smoothing_ratio = 2.08;
    CHECK(plan_build(scene, &options, plan, &error));
    CHECK(state_create(scene, plan, &state, &error));
    if (state) {
        BackendStatistics counted;
        state->backend->statistics(state->particles, &counted);
        check_neighbours(scene, plan, &counted);
        CHECK(counted.sorts == 1 && counted.list_bytes > 0);
    }
    state_destroy(state);
    plan_destroy(plan);
    free(plan);
    free(scene);
}

TEST(a_bench_has_the_number_of_particles_that_was_asked_for)
{
    BenchOptions options = {.scene = "still",
                            .particles = 6000,
                            .smoothing_ratio = 1.5,
                            .warm_up = 10,
                            .steps = 7,
                            .threads = 2};
    BenchReport *report = calloc(1, sizeof *report);
    CHECK(bench_run(&options, report, &error));
    CHECK_NEAR(report->particle_count, 6000, 180);
    CHECK(report->fluid_count + report->dummy_count == report->particle_count);
    CHECK_NEAR(report->smoothing_length / report->spacing, 1.5, 1e-9);
    CHECK(report->group_count == BENCH_GROUPS_LEAST && report->threads == 2);
    CHECK_NEAR(report->start_time, 10 * report->time_step, 1e-9);
    free(report);
}
