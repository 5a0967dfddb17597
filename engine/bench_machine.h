/// What the machine can do without us; within bench*.c.
#ifndef FAIRLEAD_BENCH_MACHINE_H
#define FAIRLEAD_BENCH_MACHINE_H

#include "bench.h"

/// Wall time since some fixed moment [s].
double bench_wall_clock(void);

/// Clock of the cores now, mean over the threads, from a chain of dependent additions, one a cycle
/// [Hz]. Takes a few milliseconds.
double bench_core_clock(int threads);

/// Peak and bandwidth, a fraction of a second each.
/// @param level  instruction level of the sweeps; the peak is that of the same level
bool bench_machine_measure(int threads, const char *level, BenchMachine *machine, Error *error);

/// Independent multiply-adds of the widest registers, on the calling thread (bench_peak.c, compiled
/// once per instruction level).
/// @param sink  takes the result, so that the work is not left out
/// @return operations done, an addition and a multiplication each counted [flop]
double bench_peak_v2(int rounds, float *sink);
double bench_peak_v3(int rounds, float *sink);
double bench_peak_v4(int rounds, float *sink);
double bench_peak_native(int rounds, float *sink);

#endif
