/// Error against cost of both steppers on the steel wire, as rows for plot.gp:
///     case stepper step_s microseconds_per_simulated_second rms_error_percent
/// The error is of the fairlead's tension, sampled every 10 ms, against the explicit step at a
/// quarter of its limit, as a share of its first harmonic. Times are this process's own on one
/// core, minima of several runs.
#include <stdio.h>
#include <time.h>

#define MOORING_CASES_ALONE
#include "unit/mooring_cases.h"

enum { SAMPLES_MAX = 400, RUNS = 3 };
static const double SAMPLE = 0.01; // s

typedef struct Study {
    const char *label;
    DrivenCase c;
    double from, until; ///< of the samples [s]
    bool bed;
} Study;

typedef struct Series {
    double tension[SAMPLES_MAX];
    int count;
    double time; ///< spent per simulated second [s]
} Series;

static double clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Calls of `step`; the explicit stepper's sub-steps at `share` of its limit.
static Series run(const Study *study, LineStepper stepper, double step, double share)
{
    const DrivenCase *c = &study->c;
    Series series = {{0}, 0, 0};
    LineScene scene = driven_scene(c, 20);
    if (!study->bed) scene.bed_stiffness = scene.bed_damping = 0;
    WaterField water = driven_water(c);
    Arena arena = arena_create(0);
    Line line;
    Error error = {0};
    bool good =
        line_create(&scene, c->anchor, c->fairlead, &water, "x", &arena, &line, NULL, &error);
    line.stepper = stepper;
    line.step_limit *= share;
    EndPath anchor = still_path(c->anchor);
    long per_sample = lround(SAMPLE / step), calls = lround(study->until / step);
    double begin = clock_now();
    for (long k = 0; good && k < calls; k++) {
        EndPath path = driven_path(c, (double)k * step, step);
        good = line_advance(&line, &water, (double)k * step, step, &anchor, &path, &error);
        if ((k + 1) % per_sample || (double)(k + 1) * step < study->from + 1e-9) continue;
        series.tension[series.count++] = line.tension[19];
    }
    series.time = (clock_now() - begin) / study->until;
    if (!good) fprintf(stderr, "%s\n", error.message);
    arena_destroy(&arena);
    return series;
}

static double harmonic(const Study *study, const Series *s)
{
    double cosine = 0, sine = 0;
    for (int i = 0; i < s->count; i++) {
        double angle = 2 * PI * i * SAMPLE / study->c.period;
        cosine += s->tension[i] * cos(angle);
        sine += s->tension[i] * sin(angle);
    }
    return 2 * hypot(cosine, sine) / s->count;
}

static void measure(const Study *study, const Series *truth, LineStepper stepper, double step,
                    double share)
{
    Series s = run(study, stepper, step, share);
    for (int k = 1; k < RUNS; k++)
        s.time = mind(s.time, run(study, stepper, step, share).time);
    double squares = 0;
    for (int i = 0; i < s.count; i++)
        squares += (s.tension[i] - truth->tension[i]) * (s.tension[i] - truth->tension[i]);
    printf("%s %s %.4g %.5g %.4g\n", study->label,
           stepper == LINE_STEPPER_RK2 ? "explicit" : "implicit",
           stepper == LINE_STEPPER_RK2 ? share : step, 1e6 * s.time,
           100 * sqrt(squares / s.count) / harmonic(study, truth));
    fflush(stdout);
}

int main(void)
{
    Study studies[] = {{"shaken", *driven_case("c1"), 1, 2, false},
                       {"snapping", *driven_case("c3"), 1, 2, true}};
    studies[0].c.bed = -5;
    const double steps[] = {0.01, 0.005, 0.0025, 0.001, 0.0005, 0.00025, 0.0001};
    const double shares[] = {1, 0.5};
    for (int k = 0; k < 2; k++) {
        Series truth = run(&studies[k], LINE_STEPPER_RK2, 0.001, 0.25);
        for (int i = 0; i < 7; i++)
            measure(&studies[k], &truth, LINE_STEPPER_BDF2, steps[i], 1);
        for (int i = 0; i < 2; i++)
            measure(&studies[k], &truth, LINE_STEPPER_RK2, 0.001, shares[i]);
    }
    return 0;
}
