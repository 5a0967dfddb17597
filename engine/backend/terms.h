/// Symmetric matrices of particles, an array a term, as the sweeps read and write them. For files
/// that are compiled once per instruction level.
#ifndef FAIRLEAD_BACKEND_TERMS_H
#define FAIRLEAD_BACKEND_TERMS_H

#include "backend/lanes.h"
#include "physics/gradient.h"

typedef struct Terms {
    float *term[GRADIENT_TERMS];
} Terms;

FN Terms terms_of(float *const arrays[GRADIENT_TERMS])
{
    Terms t;
    memcpy(t.term, arrays, sizeof t.term);
    return t;
}

FN Symmetric terms_load(const Terms *t, size_t base)
{
    Symmetric m = {lanes_load(t->term[0] + base), lanes_load(t->term[1] + base),
                   lanes_load(t->term[2] + base), lanes_load(t->term[3] + base),
                   lanes_load(t->term[4] + base), lanes_load(t->term[5] + base)};
    return m;
}

FN void terms_store(const Terms *t, size_t base, Symmetric m)
{
    lanes_store(t->term[0] + base, m.xx);
    lanes_store(t->term[1] + base, m.yy);
    lanes_store(t->term[2] + base, m.zz);
    lanes_store(t->term[3] + base, m.xy);
    lanes_store(t->term[4] + base, m.xz);
    lanes_store(t->term[5] + base, m.yz);
}

/// One particle's matrix in all lanes.
FN Symmetric terms_own(const Terms *t, int i)
{
    Symmetric m = {lanes_all(t->term[0][i]), lanes_all(t->term[1][i]), lanes_all(t->term[2][i]),
                   lanes_all(t->term[3][i]), lanes_all(t->term[4][i]), lanes_all(t->term[5][i])};
    return m;
}

FN Symmetric no_terms(void)
{
    Symmetric m = {lanes_all(0), lanes_all(0), lanes_all(0),
                   lanes_all(0), lanes_all(0), lanes_all(0)};
    return m;
}

FN Symmetric terms_sum(Symmetric a, Symmetric b)
{
    return gradient_weigh(lanes_all(1), a, lanes_all(1), b);
}

/// Add the lanes of a sum to particle i's matrix.
FN void terms_add_total(const Terms *t, int i, Symmetric sum)
{
    const Lanes total[GRADIENT_TERMS] = {sum.xx, sum.yy, sum.zz, sum.xy, sum.xz, sum.yz};
    for (int k = 0; k < GRADIENT_TERMS; k++)
        t->term[k][i] += lanes_total(total[k]);
}

#endif
