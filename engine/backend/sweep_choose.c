/// Which compiled sweep this processor runs.
#include <stdlib.h>
#include <string.h>

#include "backend/sweep.h"

const SweepTable *sweep_table_choose(void)
{
#if defined(__x86_64__)
    const char *asked = getenv("FAIRLEAD_LEVEL");
    bool v2 = asked && !strcmp(asked, "x86-64-v2"), v3 = asked && !strcmp(asked, "x86-64-v3");
    __builtin_cpu_init();
    bool has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    bool has_v4 = has_v3 && __builtin_cpu_supports("avx512f") &&
                  __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512bw");
    if (has_v4 && !v2 && !v3) return sweep_table_v4();
    if (has_v3 && !v2) return sweep_table_v3();
    return sweep_table_v2();
#else
    return sweep_table_native();
#endif
}
