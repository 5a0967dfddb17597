#include "bench_machine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/portable.h"

double bench_wall_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// ---- clock --------------------------------------------------------------------------------------

enum { ADD_ROUNDS = 100000, ADDS_PER_ROUND = 16, TRIES = 4 };

/// Additions of one core per second, best of a few tries: another process may take the core away
/// meanwhile, nothing can make it faster.
static double additions_per_second(void)
{
    double best = INFINITY;
    uint64_t sum = 1, term = 3;
    for (int try = 0; try < TRIES; try++) {
        double start = bench_wall_clock();
        for (int n = 0; n < ADD_ROUNDS; n++) {
            for (int k = 0; k < ADDS_PER_ROUND; k++) {
                sum += term;
                // hides the sum from the compiler; a register as term, because some processors fold
                // additions of constants while they rename registers
                __asm__ volatile("" : "+r"(sum), "+r"(term));
            }
        }
        best = mind(best, bench_wall_clock() - start);
    }
    return (double)ADD_ROUNDS * ADDS_PER_ROUND / best;
}

double bench_core_clock(int threads)
{
    double sum = 0;
#pragma omp parallel num_threads(threads) reduction(+ : sum)
    sum += additions_per_second();
    return sum / threads;
}

// ---- peak ---------------------------------------------------------------------------------------

typedef double (*Peak)(int rounds, float *sink);

static Peak choose_peak(const char *level)
{
#if defined(__x86_64__)
    if (!strcmp(level, "x86-64-v4")) return bench_peak_v4;
    if (!strcmp(level, "x86-64-v3")) return bench_peak_v3;
    return bench_peak_v2;
#else
    return bench_peak_native;
#endif
}

enum { PEAK_ROUNDS = 1000000, PEAK_TRIES = 10 };

/// All threads at once, best of a few tries of some ten milliseconds [flop/s].
static double measure_peak(int threads, Peak peak)
{
    double best = 0;
    for (int try = 0; try < PEAK_TRIES; try++) {
        double flops = 0, start = bench_wall_clock();
#pragma omp parallel num_threads(threads) reduction(+ : flops)
        {
            float sink = 0;
            flops += peak(PEAK_ROUNDS, &sink);
            if (!(sink > 0)) flops = NAN; // keeps the work alive; the sum is positive
        }
        best = maxd(best, flops / (bench_wall_clock() - start));
    }
    return best;
}

// ---- bandwidth ----------------------------------------------------------------------------------

enum { TRIAD_ARRAYS = 3, TRIAD_TRIES = 8 };

/// Length of each array [floats]: together more than the last caches that so many cores may have.
static size_t triad_length(int threads)
{
    double bytes = maxd(384e6, 32e6 * threads);
    return (size_t)(bytes / (TRIAD_ARRAYS * sizeof(float)));
}

/// a = b + s c over three arrays, best of a few tries [byte/s]: 12 bytes an element are counted,
/// as STREAM counts them (McCalpin 1995); that the line of `a` is read first is not.
static double triad(int threads, size_t count, float *a, float *b, float *c)
{
    double best = 0;
    long n = (long)count;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (long i = 0; i < n; i++) { // first touch by the thread that will use it
        a[i] = 0;
        b[i] = (float)(i & 7);
        c[i] = 1;
    }
    for (int try = 0; try < TRIAD_TRIES; try++) {
        float scale = 0.5f + (float)try;
        double start = bench_wall_clock();
#pragma omp parallel for simd schedule(static) num_threads(threads)
        for (long i = 0; i < n; i++)
            a[i] = b[i] + scale * c[i];
        best = maxd(best, TRIAD_ARRAYS * sizeof(float) * (double)n / (bench_wall_clock() - start));
    }
    return a[n / 2] > 0 ? best : NAN;
}

static bool measure_bandwidth(int threads, BenchMachine *machine, Error *error)
{
    size_t count = triad_length(threads);
    float *room = malloc(TRIAD_ARRAYS * count * sizeof *room);
    if (!room) return error_set(error, ERROR_SYSTEM, "no memory left to measure the bandwidth");
    machine->bandwidth = triad(threads, count, room, room + count, room + 2 * count);
    machine->bandwidth_bytes = (double)(TRIAD_ARRAYS * count * sizeof *room);
    free(room);
    return true;
}

// ---- the machine --------------------------------------------------------------------------------

/// "model name" of the first core, where the system tells.
static void name_cpu(char *name, size_t size)
{
    snprintf(name, size, "unknown processor");
    FILE *file = fopen("/proc/cpuinfo", "r");
    if (!file) return;
    char line[256];
    while (fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon) continue;
        line[strcspn(line, "\n")] = 0;
        snprintf(name, size, "%s", colon + 1 + strspn(colon + 1, " \t"));
        break;
    }
    fclose(file);
}

bool bench_machine_measure(int threads, const char *level, BenchMachine *machine, Error *error)
{
    memset(machine, 0, sizeof *machine);
    name_cpu(machine->cpu, sizeof machine->cpu);
    machine->peak = measure_peak(threads, choose_peak(level));
    machine->peak_clock = bench_core_clock(threads);
    return measure_bandwidth(threads, machine, error);
}
