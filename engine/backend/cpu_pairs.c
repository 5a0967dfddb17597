/// The pair effects of the CPU backend: their arrays, which compiled sweep a mask takes, and what
/// has to be known before it runs.
#include <stdlib.h>
#include <string.h>

#include "backend/cpu.h"

enum { CHUNK = 64 }; ///< clusters handled together

static bool take_floats(float **array, const ParticleSet *set, const char *what, Arena *arena,
                        Error *error)
{
    *array = arena_take(arena, (size_t)set->slot_capacity, sizeof(float), what, error);
    return *array != NULL;
}

bool pairs_create(Backend *b, Arena *arena, Error *error)
{
    const unsigned mask = b->setup.pair_mask;
    ParticleSet *fluid = &b->fluid, *walls[2] = {&b->fixed, &b->moving};
    if (mask & PAIR_DIFFUSION)
        TRY(take_floats(&fluid->dynamic, fluid, "particles.dynamic", arena, error));
    for (int t = 0; t < 6 && (mask & PAIR_GRADIENT); t++)
        TRY(take_floats(&fluid->correction[t], fluid, "particles.correction", arena, error));
    for (int t = 0; t < 6 && (mask & PAIR_TURBULENCE); t++)
        TRY(take_floats(&fluid->stress[t], fluid, "particles.stress", arena, error));
    for (int k = 0; k < SHIFT_SUMS && (mask & PAIR_SHIFTING); k++)
        TRY(take_floats(&fluid->shift[k], fluid, "particles.shift", arena, error));
    for (int set = 0; set < 2 && (mask & PAIR_NO_SLIP); set++)
        for (int a = 0; a < 3 && walls[set]->count; a++)
            TRY(take_floats(&walls[set]->mirror[a], walls[set], "particles.mirror", arena, error));
    return true;
}

SweepFunction cpu_acceleration(const Backend *b, unsigned mask)
{
    int viscous = (mask & PAIR_VISCOSITY) != 0, corrected = (mask & PAIR_GRADIENT) != 0;
    int turbulent = (mask & PAIR_TURBULENCE) != 0, holding = (mask & PAIR_NO_SLIP) != 0;
    if (mask & PAIR_LAMINAR) return b->table->viscous[viscous + 2 * turbulent + 4 * holding];
    return b->table->acceleration[viscous + 2 * corrected];
}

SweepFunction cpu_loads(const Backend *b, unsigned mask)
{
    return b->table->loads[mask & PAIR_NO_SLIP ? 2 : (mask & PAIR_GRADIENT) != 0];
}

/// Corrections of kernel gradients at the present places.
void pairs_correct_gradients(Backend *b)
{
    int clusters = b->fluid.cluster_count;
    for (int t = 0; t < 6; t++)
        memset(b->fluid.correction[t], 0, (size_t)clusters * CLUSTER * sizeof(float));
    cpu_sweep_fluid(b, b->table->moments);
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int begin = 0; begin < clusters; begin += CHUNK)
        b->table->invert(&b->sweep, begin, begin + CHUNK < clusters ? begin + CHUNK : clusters);
}

void pairs_shift(Backend *b)
{
    int clusters = b->fluid.cluster_count;
    for (int k = 0; k < SHIFT_SUMS; k++)
        memset(b->fluid.shift[k], 0, (size_t)clusters * CLUSTER * sizeof(float));
    cpu_sweep_fluid(b, b->table->shift_sums);
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int begin = 0; begin < clusters; begin += CHUNK)
        b->table->shift_velocities(&b->sweep, begin,
                                   begin + CHUNK < clusters ? begin + CHUNK : clusters);
}

void pairs_mirror_velocities(Backend *b)
{
    for (int set = 0; set < 2; set++) {
        int clusters = b->sweep.walls[set]->count ? b->sweep.walls[set]->cluster_count : 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(b->setup.threads)
        for (int begin = 0; begin < clusters; begin += CHUNK)
            b->table->mirror(&b->sweep, set, begin,
                             begin + CHUNK < clusters ? begin + CHUNK : clusters);
    }
}

void pairs_find_stresses(Backend *b)
{
    int clusters = b->fluid.cluster_count;
    for (int t = 0; t < 6; t++)
        memset(b->fluid.stress[t], 0, (size_t)clusters * CLUSTER * sizeof(float));
    cpu_sweep_fluid(b, b->table->strain);
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int begin = 0; begin < clusters; begin += CHUNK)
        b->table->stress(&b->sweep, begin, begin + CHUNK < clusters ? begin + CHUNK : clusters);
}

/// Masks between whose sweeps a bit's cost lies: its own, and of viscosity what cannot be without
/// it.
static void masks_around(unsigned mask, unsigned bit, unsigned *on, unsigned *off)
{
    *on = mask | bit;
    if (bit == PAIR_LAMINAR) *on &= ~(unsigned)(PAIR_TURBULENCE | PAIR_NO_SLIP);
    *off = *on & ~bit;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/// A sample from the middle will do: the share is the sweep's and the machine's, not the case's.
/// Its sweeps follow each other within what slows the machine, so each round has a share of its
/// own; the middle one stands. (The ratio of least times of three said that diffusion costs
/// nothing in 1 of 100 starts of a small tank.)
double pairs_cost(Backend *b, unsigned bit)
{
    enum { SAMPLE = 2048, ROUNDS_LEAST = 5, ROUNDS_MOST = 101 };
    const double enough = 2e-3; // [s]
    int row = b->grid.slab_count / 2 * SLAB_ROWS * b->grid.across_rows;
    int begin = b->fluid.row_begin[row], rest = b->fluid.cluster_count - begin;
    int end = begin + (rest < SAMPLE ? rest : SAMPLE);
    unsigned on, off, all = b->setup.pair_mask;
    masks_around(all, bit, &on, &off);
    SweepFunction sweeps[3] = {cpu_acceleration(b, off), cpu_acceleration(b, on),
                               cpu_acceleration(b, all | bit)};
    if (bit == PAIR_DIFFUSION) memcpy(sweeps, b->table->density, sizeof b->table->density);
    int count = bit == PAIR_LAMINAR && on != all ? 3 : 2, rounds = 0;
    double shares[ROUNDS_MOST], begun = cpu_clock();
    while (rounds < ROUNDS_LEAST || (rounds < ROUNDS_MOST && cpu_clock() - begun < enough)) {
        double lap[4] = {cpu_clock()};
        for (int i = 0; i < count; i++) {
            sweeps[i](&b->sweep, begin, end);
            lap[i + 1] = cpu_clock();
        }
        double whole = lap[count] - lap[count - 1];
        shares[rounds++] = whole > 0 ? (lap[2] - 2 * lap[1] + lap[0]) / whole : 0;
    }
    qsort(shares, (size_t)rounds, sizeof *shares, by_size);
    return maxd(0, shares[rounds / 2]);
}
