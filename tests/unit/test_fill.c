/// Where particles are at t = 0.
#include "scenes.h"

#include "fill.h"

typedef struct Filled {
    Plan plan;
    Arena arena;
    Fill fill;
} Filled;

static Filled fill_case(const Scene *scene, int threads)
{
    Filled filled = {.arena = arena_create(0)};
    EngineOptions options = {.threads = threads, .backend = "cpu"};
    CHECK(plan_build(scene, &options, &filled.plan, &error));
    CHECK(fill_create(scene, &filled.plan, &filled.arena, &filled.fill, &error));
    return filled;
}

static void give_back(Filled *filled)
{
    arena_destroy(&filled->arena);
    plan_destroy(&filled->plan);
}

TEST(a_basin_is_filled_the_same_by_any_number_of_threads)
{
    Scene scene;
    char path[] = SOURCE_DIR "/cases/moored_ship_draft.json";
    CHECK(scene_load(path, NULL, 0, &scene, &error));
    Filled one = fill_case(&scene, 1);
    size_t fluid = (size_t)one.fill.fluid_count;
    for (int threads = 2; threads < 5; threads++) {
        Filled more = fill_case(&scene, threads);
        CHECK(more.fill.fluid_count == one.fill.fluid_count);
        CHECK(!memcmp(more.fill.fluid_position, one.fill.fluid_position, fluid * sizeof(Vec3)));
        CHECK(!memcmp(more.fill.fluid_velocity, one.fill.fluid_velocity, fluid * sizeof(Vec3)));
        CHECK(!memcmp(more.fill.fluid_excess, one.fill.fluid_excess, fluid * sizeof(float)));
        give_back(&more);
    }
    give_back(&one);
}

TEST(a_fill_has_as_many_particles_as_its_plan)
{
    Scene scene;
    char path[] = SOURCE_DIR "/cases/moored_ship_draft.json";
    CHECK(scene_load(path, NULL, 0, &scene, &error));
    Filled filled = fill_case(&scene, 2);
    const Fill *fill = &filled.fill;
    CHECK(fill->fluid_count == filled.plan.fluid_count);
    CHECK(fill->wall_count + fill->ring_count + fill->piston_count == filled.plan.wall_count);
    CHECK(fill->body_count == filled.plan.body_particle_count);
    give_back(&filled);
}
