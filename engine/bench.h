/// How fast this machine moves particles: a scene made in memory, timed steps, and beside them what
/// the machine itself can do, so that a figure can be judged.
#ifndef FAIRLEAD_BENCH_H
#define FAIRLEAD_BENCH_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

enum { BENCH_GROUPS_LEAST = 5, BENCH_GROUPS_MAX = 25, BENCH_PASSES_MAX = 20 };

typedef struct BenchOptions {
    const char *scene;      ///< "still", "dam" or "ship"
    const char *ship_case;  ///< case file behind "ship", borrowed
    int particles;          ///< wanted number of all particles, water and dummies
    double smoothing_ratio; ///< h/dp, 1.2 to 3
    int warm_up;            ///< steps before the clock starts, >= 1
    int steps;              ///< timed steps, >= BENCH_GROUPS_LEAST
    int threads;            ///< 0 = all cores
} BenchOptions;

/// What the machine can do, measured on as many threads as the steps ran on.
typedef struct BenchMachine {
    char cpu[96];           ///< name of the processor
    double peak;            ///< single-precision multiply-adds [flop/s], all threads
    double peak_clock;      ///< clock right after the peak was measured [Hz]
    double bandwidth;       ///< of a triad, without write-allocation [byte/s], all threads
    double bandwidth_bytes; ///< size of the triad's arrays together [byte]
} BenchMachine;

typedef struct BenchPass {
    const char *name;
    double share; ///< of the timed steps' wall time [-]
} BenchPass;

/// Everything that was measured. Times are wall times; "median" is over the groups.
typedef struct BenchReport {
    char level[32]; ///< compiled instruction level of the sweeps: "x86-64-v4" …
    char backend[16];
    int threads, dimensions;
    int fluid_count, dummy_count, particle_count; ///< water, dummies, both
    double spacing, smoothing_length;             ///< dp, h [m]
    double time_step, courant;                    ///< [s]; c0 dt/h [-]
    double start_time;                            ///< simulated time at which the clock started [s]

    int group_count;
    double step[BENCH_GROUPS_MAX];                             ///< of each group, ascending [s]
    double step_median, step_mean, step_fastest, step_slowest; ///< of the groups [s per step]
    double clock_median, clock_lowest, clock_highest;          ///< of the cores between groups [Hz]
    int64_t sorts;                                             ///< within the timed steps
    long preemptions; ///< times another process took a core within the timed steps
    int roll_backs;   ///< within the timed steps
    int pass_count;
    BenchPass passes[BENCH_PASSES_MAX];

    double neighbours_fluid, neighbours_dummy; ///< of a water particle, each neighbour counted [-]
    int neighbours_sample;                     ///< water particles looked at
    double pairs;                              ///< directed: water particles times neighbours
    double flops;                              ///< useful ones in a step, see bench.c
    double traffic; ///< least bytes between cores and memory in a step, see bench.c

    size_t state_bytes, list_bytes, plan_bytes; ///< [byte]
    size_t peak_resident;                       ///< most memory the process has held [byte]
    BenchMachine machine;
} BenchReport;

/// Useful operations of a pair, as counted in bench.c.
typedef struct BenchFlops {
    int fluid_momentum, fluid_density; ///< of two water particles, once for both
    int dummy_momentum, dummy_density; ///< of a water particle and a dummy
} BenchFlops;
BenchFlops bench_flops(void);

/// Make the scene, warm up, time the steps, measure the machine.
/// @return false with ERROR_INPUT (a size the scene cannot have), ERROR_SYSTEM or ERROR_PHYSICS
bool bench_run(const BenchOptions *options, BenchReport *report, Error *error);

#endif
