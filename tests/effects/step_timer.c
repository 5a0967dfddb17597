/// Times steps of still water without viscosity and diffusion, in an ordinary build and in one that
/// knows no effects. Told a number on a line it takes so many steps and tells the processor time of
/// the fastest [s].
#include "scenes.h"

#include <time.h>

/// Processor time of this program [s]: what else the machine does hardly enters.
static double processor_time(void)
{
    struct timespec used;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

TEST(steps_are_timed_as_told)
{
    Scene scene = tank_2d(0.03);
    scene.domain.dimensions = 3;
    scene.domain.min.y = -0.15;
    scene.domain.max.y = 0.15;
    scene.fluid.alpha = scene.fluid.delta = 0;
    Run *run = start(&scene, 1);
    for (int e = 0; e < EFFECT_COUNT; e++)
        if (e != EFFECT_WALLS) CHECK(!run->plan.effects[e].active);
    int steps;
    while (scanf("%d", &steps) == 1) {
        double fastest = INFINITY;
        for (int i = 0; i < steps; i++) {
            double begin = processor_time();
            CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
            fastest = mind(fastest, processor_time() - begin);
        }
        printf("%.9g\n", fastest);
        fflush(stdout);
    }
    finish(run);
}
