/// What a run takes of memory: all of it before the first step, and what the plan said.
#include "scenes.h"

#include <malloc.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <unistd.h>

/// Calls of the allocators so far. The linker sends every call from the program's own code here
/// (--wrap, tests/CMakeLists.txt).
static atomic_int allocation_count;

#define WRAP(result, name, parameters, arguments)                                                  \
    result __real_##name parameters;                                                               \
    result __wrap_##name parameters;                                                               \
    result __wrap_##name parameters                                                                \
    {                                                                                              \
        allocation_count++;                                                                        \
        return __real_##name arguments;                                                            \
    }
WRAP(void *, malloc, (size_t size), (size))
WRAP(void *, calloc, (size_t count, size_t size), (count, size))
WRAP(void *, realloc, (void *old, size_t size), (old, size))
WRAP(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))
WRAP(void *, mmap, (void *at, size_t size, int rights, int kind, int file, off_t offset),
     (at, size, rights, kind, file, offset))

#ifdef __SANITIZE_ADDRESS__
enum { SANITIZED = 1 }; ///< the sanitizer takes memory of its own
#else
enum { SANITIZED = 0 };
#endif

/// Memory of this process that the machine has really given [byte].
static double resident_bytes(void)
{
    long size = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    CHECK(file && fscanf(file, "%ld %ld", &size, &resident) == 2);
    if (file) fclose(file);
    return (double)resident * (double)sysconf(_SC_PAGESIZE);
}

static Scene tank_3d(void)
{
    Scene scene = tank_2d(0.025);
    scene.domain.dimensions = 3;
    return scene;
}

static Scene basin_3d(void)
{
    Scene scene = basin_2d(0.034);
    scene.domain.dimensions = 3;
    scene.domain.min.y = -1;
    scene.domain.max.y = 1;
    scene.waves.zone_width = 0.5;
    return scene;
}

static void compare_with_plan(const Scene *scene)
{
    if (SANITIZED) return;
    mallopt(M_MMAP_THRESHOLD, 1 << 17); // what is freed goes back to the machine at once
    double before = resident_bytes();
    Run *run = start(scene, 2);
    advance_to(run, 2.5 * run->plan.time_step);
    double taken = resident_bytes() - before, planned = (double)run->plan.bytes;
    printf("  %d fluid, %d wall particles: planned %.1f MB, taken %.1f MB\n", run->plan.fluid_count,
           run->plan.wall_count, planned / 1e6, taken / 1e6);
    CHECK_NEAR(planned / taken, 1, 0.1);
    finish(run);
}

TEST(a_plan_tells_the_memory_of_a_tank_within_a_tenth)
{
    Scene scene = tank_3d();
    compare_with_plan(&scene);
}

TEST(a_plan_tells_the_memory_of_eddies_walls_that_hold_and_shifting_within_a_tenth)
{
    Scene scene = tank_3d();
    scene.fluid.viscosity = 1e-6;
    scene.fluid.turbulence = TURBULENCE_SPS;
    scene.fluid.walls = WALLS_NO_SLIP;
    scene.fluid.shifting = 2;
    compare_with_plan(&scene);
}

TEST(a_plan_tells_the_memory_of_a_basin_within_a_tenth)
{
    Scene scene = basin_3d();
    compare_with_plan(&scene);
}

TEST(a_step_allocates_nothing)
{
    Scene scene;
    char path[] = SOURCE_DIR "/cases/moored_ship_draft.json";
    CHECK(scene_load(path, NULL, 0, &scene, &error));
    Run *run = start(&scene, 2);
    CHECK(allocation_count > 0);
    double row[SERIES_COLUMNS_MAX];
    // neighbour lists may grow in the first steps, until they fit
    for (int i = 0; i < 5; i++)
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
    int before = allocation_count;
    for (int i = 0; i < 30; i++) {
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        series_sample(&run->scene, &run->plan, run->state, row);
    }
    CHECK(allocation_count == before);
    finish(run);
}
