/// What nobody needs of the CPU backend while it runs well: which particle is worst, how many
/// neighbours one has, how large the lists are. Neighbours are counted from positions alone, never
/// from the lists, so that a list that loses some would be seen.
#include <string.h>

#include "backend/cpu.h"
#include "physics/fluid.h"

/// Distances that may be looked at: some tenths of a second of one core.
static const double DISTANCES_MAX = 1e9;

/// Particles of `set` nearer than the support to slot `self` of the fluid, itself included.
static int count_near(const ParticleSet *set, const ParticleSet *fluid, int self,
                      float support_squared)
{
    int32_t near = 0, lane[CLUSTER] = {0};
    int32_t x = *position_of(fluid, 0, self), y = *position_of(fluid, 1, self);
    int32_t z = *position_of(fluid, 2, self);
    for (int c = 0; c < set->cluster_count; c++) {
        const Octet *o = &set->octet[c];
        const int32_t *id = set->id + c * CLUSTER;
        for (int l = 0; l < CLUSTER; l++) {
            float dx = (float)(x - o->position[0][l]), dy = (float)(y - o->position[1][l]);
            float dz = (float)(z - o->position[2][l]);
            lane[l] += (dx * dx + dy * dy + dz * dz < support_squared) & (id[l] >= 0);
        }
    }
    for (int l = 0; l < CLUSTER; l++)
        near += lane[l];
    return near;
}

/// Neighbours of fluid particles at even distances along the slots, all of them where few.
static void count_neighbours(const Backend *b, BackendStatistics *statistics)
{
    const ParticleSet *fluid = &b->fluid;
    float support_squared = b->sweep.constants.support_squared;
    int slots = fluid->cluster_count * CLUSTER, sample = 0;
    double all = (double)fluid->count + b->fixed.count + b->moving.count;
    double stride = maxd(1, slots * all / DISTANCES_MAX);
    int tries = (int)(slots / stride);
    int64_t near_fluid = 0, near_dummies = 0;
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)                            \
    reduction(+ : near_fluid, near_dummies, sample)
    for (int n = 0; n < tries; n++) {
        int slot = (int)(n * stride);
        if (fluid->id[slot] < 0) continue;
        sample++;
        near_fluid += count_near(fluid, fluid, slot, support_squared) - 1;
        near_dummies += count_near(&b->fixed, fluid, slot, support_squared) +
                        count_near(&b->moving, fluid, slot, support_squared);
    }
    statistics->sample = sample;
    statistics->neighbours_fluid = (double)near_fluid / (sample ? sample : 1);
    statistics->neighbours_dummy = (double)near_dummies / (sample ? sample : 1);
}

void cpu_statistics(const Backend *b, BackendStatistics *statistics)
{
    memset(statistics, 0, sizeof *statistics);
    statistics->fluid_count = b->fluid.count;
    statistics->dummy_count = b->fixed.count + b->moving.count;
    statistics->sorts = b->sorts;
    statistics->list_bytes = list_bytes(&b->fluid_fluid) + list_bytes(&b->fluid_fixed) +
                             list_bytes(&b->fluid_moving) + list_bytes(&b->fixed_fluid) +
                             list_bytes(&b->moving_fluid);
    count_neighbours(b, statistics);
}

int cpu_worst(const Backend *b, WorstBy by, Vec3 *place)
{
    const ParticleSet *f = &b->fluid;
    int worst = -1;
    float most = -1;
    for (int i = 0; i < f->cluster_count * CLUSTER; i++) {
        if (f->id[i] < 0) continue;
        float u = *velocity_of(f, 0, i), v = *velocity_of(f, 1, i), w = *velocity_of(f, 2, i);
        float off = fabsf(tension_bearing(*excess_of(f, i), b->excess_floor));
        float size = by == WORST_BY_SPEED ? u * u + v * v + w * w : off;
        if (!(size > most)) continue;
        most = size;
        worst = i;
    }
    if (worst < 0) return -1;
    *place = place_of(&b->grid, f, worst);
    return f->id[worst];
}
