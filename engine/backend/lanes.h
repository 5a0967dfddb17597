/// Eight floats side by side: the type in which the sweeps compute physics/pair.h. The vectors of
/// gcc and clang compile everywhere: to one AVX register, two of SSE or NEON. Loops with `omp simd`
/// did the same sums in a fifth more instructions (docs/performance.md).
#ifndef FAIRLEAD_BACKEND_LANES_H
#define FAIRLEAD_BACKEND_LANES_H

#include <stdint.h>
#include <string.h>

#include "base/portable.h"

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "visit bits are read by the word: little-endian machines only"
#endif

typedef float Lanes __attribute__((vector_size(32)));
typedef int32_t IntLanes __attribute__((vector_size(32)));

// What physics/ computes with in this file (physics/lane.h).
#define LANE Lanes

FN Lanes lanes_load(const float *from)
{
    Lanes v;
    memcpy(&v, __builtin_assume_aligned(from, sizeof v), sizeof v);
    return v;
}
FN IntLanes lanes_load_int(const int32_t *from)
{
    IntLanes v;
    memcpy(&v, __builtin_assume_aligned(from, sizeof v), sizeof v);
    return v;
}
FN void lanes_store(float *to, Lanes v)
{
    memcpy(__builtin_assume_aligned(to, sizeof v), &v, sizeof v);
}
FN Lanes lanes_all(float x)
{
    Lanes v = {x, x, x, x, x, x, x, x};
    return v;
}
FN IntLanes lanes_all_int(int32_t x)
{
    IntLanes v = {x, x, x, x, x, x, x, x};
    return v;
}
FN IntLanes lanes_max_int(IntLanes a, IntLanes b)
{
    for (int l = 0; l < 8; l++)
        a[l] = a[l] > b[l] ? a[l] : b[l];
    return a;
}
FN Lanes lanes_from_int(IntLanes v) { return __builtin_convertvector(v, Lanes); }

FN Lanes lane_sqrt(Lanes x)
{
    Lanes root;
    for (int l = 0; l < 8; l++)
        root[l] = sqrtf(x[l]);
    return root;
}
FN Lanes lane_above_zero(Lanes x)
{
    for (int l = 0; l < 8; l++)
        x[l] = x[l] > 0.0f ? x[l] : 0.0f;
    return x;
}
FN Lanes lane_below_zero(Lanes x)
{
    for (int l = 0; l < 8; l++)
        x[l] = x[l] < 0.0f ? x[l] : 0.0f;
    return x;
}

/// Sum of the eight, always in the same order.
FN float lanes_total(Lanes v)
{
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

#endif
