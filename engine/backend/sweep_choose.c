/// Which compiled sweep this processor runs.
#include <stdlib.h>
#include <string.h>

#include "backend/sweep.h"

typedef const SweepTable *(*TableFunction)(void);

#if defined(__x86_64__)
const SweepTable *sweep_table_v2_wendland(void);
const SweepTable *sweep_table_v3_wendland(void);
const SweepTable *sweep_table_v4_wendland(void);
const SweepTable *sweep_table_v2_yielding(void);
const SweepTable *sweep_table_v3_yielding(void);
const SweepTable *sweep_table_v4_yielding(void);

static const TableFunction TABLES[][3] = {
    [KERNEL_WENDLAND] = {sweep_table_v2_wendland, sweep_table_v3_wendland, sweep_table_v4_wendland},
    [KERNEL_YIELDING] = {sweep_table_v2_yielding, sweep_table_v3_yielding, sweep_table_v4_yielding},
};

static int best_level(void)
{
    const char *asked = getenv("FAIRLEAD_LEVEL");
    bool v2 = asked && !strcmp(asked, "x86-64-v2"), v3 = asked && !strcmp(asked, "x86-64-v3");
    __builtin_cpu_init();
    bool has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    bool has_v4 = has_v3 && __builtin_cpu_supports("avx512f") &&
                  __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512bw");
    if (has_v4 && !v2 && !v3) return 2;
    return has_v3 && !v2 ? 1 : 0;
}
#else
const SweepTable *sweep_table_native_wendland(void);
const SweepTable *sweep_table_native_yielding(void);

static const TableFunction TABLES[][1] = {
    [KERNEL_WENDLAND] = {sweep_table_native_wendland},
    [KERNEL_YIELDING] = {sweep_table_native_yielding},
};

static int best_level(void) { return 0; }
#endif

const SweepTable *sweep_table_choose(Kernel kernel) { return TABLES[kernel][best_level()](); }
