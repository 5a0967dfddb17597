/// The most additions and multiplications a core can do at one instruction level. Compiled once per
/// level with BENCH_PEAK set to the exported function's name.
#include "bench_machine.h"

#if defined(__AVX512F__)
enum { WIDTH = 16 };
#elif defined(__AVX__)
enum { WIDTH = 8 };
#else
enum { WIDTH = 4 };
#endif

/// Chains that do not wait for each other: two units of four or five cycles' latency need ten, and
/// with two constants these twelve fit into sixteen registers.
enum { CHAINS = 12 };

typedef float Lanes __attribute__((vector_size(WIDTH * sizeof(float))));

double BENCH_PEAK(int rounds, float *sink)
{
    Lanes factor, term, sum[CHAINS], total = {0};
    for (int l = 0; l < WIDTH; l++) {
        factor[l] = 0.999f + *sink;
        term[l] = 0.001f + *sink;
    }
    for (int c = 0; c < CHAINS; c++)
        sum[c] = term * (float)c;
    for (int n = 0; n < rounds; n++)
        for (int c = 0; c < CHAINS; c++)
            sum[c] = sum[c] * factor + term;
    for (int c = 0; c < CHAINS; c++)
        total += sum[c];
    for (int l = 0; l < WIDTH; l++)
        *sink += total[l];
    return 2.0 * WIDTH * CHAINS * rounds;
}
