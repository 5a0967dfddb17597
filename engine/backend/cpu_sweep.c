/// Neighbour sweeps over clusters of eight. One particle (scalars) meets eight neighbours (lanes);
/// no mask is needed, because s = max(0, 1 - q/2) is zero beyond the support and in padding. Which
/// clusters a particle visits, `prune` has written as bits into the list: by its distance to their
/// boxes, with a margin, so that many sweeps can use them.
///
/// Compiled once per instruction level (sweep.h).
#include "backend/sweep.h"

#include <string.h>

#include "physics/fluid.h"

/// The clusters that a particle visits, one after the other. Reading a bit runs beside the
/// arithmetic of the visit before; written out first, the visits cost a tenth more.
typedef struct Visits {
    const uint32_t *entry;
    const uint8_t *bits;
    int at, bytes; ///< byte after those in `word`
    uint64_t word; ///< bits not yet visited
} Visits;

FN Visits visits_of(const ClusterList *list, int i, int l)
{
    int bytes = ((int)list->count[i] + 7) / 8;
    Visits v = {list->entry + list->begin[i], list->near + list->begin[i] + l * bytes, 0, bytes, 0};
    return v;
}

/// @param base  first slot of the next cluster   @return false when there is none
FN bool visits_next(Visits *v, int *base)
{
    while (!v->word) {
        int left = v->bytes - v->at;
        if (left <= 0) return false;
        memcpy(&v->word, v->bits + v->at, sizeof v->word); // the list ends in spare bytes
        if (left < 8) v->word &= (UINT64_C(1) << 8 * left) - 1;
        v->at += 8;
    }
    *base = (int)v->entry[8 * v->at - 64 + __builtin_ctzll(v->word)] * CLUSTER;
    v->word &= v->word - 1;
    return true;
}

/// A particle as scalars.
typedef struct Self {
    int32_t x, y, z;
    float u, v, w, pressure, dynamic;
} Self;

FN Self self_of(const ParticleSet *set, int i)
{
    Self self;
    self.x = set->position[0][i];
    self.y = set->position[1][i];
    self.z = set->position[2][i];
    self.u = set->field[VELOCITY_X][i];
    self.v = set->field[VELOCITY_Y][i];
    self.w = set->field[VELOCITY_Z][i];
    self.pressure = set->pressure[i];
    self.dynamic = set->dynamic[i];
    return self;
}

/// Eight lanes of sums.
typedef struct Lanes {
    float x[CLUSTER], y[CLUSTER], z[CLUSTER];
} Lanes;

FN float lanes_total(const float lane[CLUSTER])
{
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) +
           ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

/// Momentum: one particle and the eight at `base`. `react` lets the eight feel it too.
FN void visit_momentum(const Self *self, const ParticleSet *other, int base, const SweepConstants c,
                       bool viscous, bool react, Lanes *sum)
{
    const int32_t *RESTRICT px = other->position[0] + base,
                            *RESTRICT py = other->position[1] + base;
    const int32_t *RESTRICT pz = other->position[2] + base;
    const float *RESTRICT vu = other->field[VELOCITY_X] + base;
    const float *RESTRICT vv = other->field[VELOCITY_Y] + base;
    const float *RESTRICT vw = other->field[VELOCITY_Z] + base;
    const float *RESTRICT pressure = other->pressure + base;
    float *RESTRICT rx = other->rate[0] + base, *RESTRICT ry = other->rate[1] + base;
    float *RESTRICT rz = other->rate[2] + base;
#pragma omp simd
    for (int l = 0; l < CLUSTER; l++) {
        float dx = (float)(self->x - px[l]), dy = (float)(self->y - py[l]);
        float dz = (float)(self->z - pz[l]);
        float r2 = dx * dx + dy * dy + dz * dz;
        float s = pair_closeness(r2, c.inverse_support);
        float f;
        if (viscous) {
            float vx = (self->u - vu[l]) * dx + (self->v - vv[l]) * dy + (self->w - vw[l]) * dz;
            f = pair_force(s, r2, self->pressure + pressure[l], vx, c);
        } else {
            f = kernel_slope(s) * (self->pressure + pressure[l]);
        }
        float fx = f * dx, fy = f * dy, fz = f * dz;
        sum->x[l] += fx;
        sum->y[l] += fy;
        sum->z[l] += fz;
        if (react) {
            rx[l] -= fx;
            ry[l] -= fy;
            rz[l] -= fz;
        }
    }
}

/// Continuity: one particle and the eight at `base`.
FN void visit_density(const Self *self, const ParticleSet *other, int base, const SweepConstants c,
                      bool diffusive, bool react, float sum[CLUSTER])
{
    const int32_t *RESTRICT px = other->position[0] + base,
                            *RESTRICT py = other->position[1] + base;
    const int32_t *RESTRICT pz = other->position[2] + base;
    const float *RESTRICT vu = other->field[VELOCITY_X] + base;
    const float *RESTRICT vv = other->field[VELOCITY_Y] + base;
    const float *RESTRICT vw = other->field[VELOCITY_Z] + base;
    const float *RESTRICT dynamic = other->dynamic + base;
    float *RESTRICT rate = other->rate[0] + base;
#pragma omp simd
    for (int l = 0; l < CLUSTER; l++) {
        float dx = (float)(self->x - px[l]), dy = (float)(self->y - py[l]);
        float dz = (float)(self->z - pz[l]);
        float s = pair_closeness(dx * dx + dy * dy + dz * dz, c.inverse_support);
        float vx = (self->u - vu[l]) * dx + (self->v - vv[l]) * dy + (self->w - vw[l]) * dz;
        float slope = kernel_slope(s);
        float squeeze = -slope * vx;
        float diffused = diffusive ? slope * (c.diffusion * (dynamic[l] - self->dynamic)) : 0.0f;
        sum[l] += squeeze + diffused;
        if (react) rate[l] += squeeze - diffused;
    }
}

/// Push of wall clusters on one particle.
static void push_of_walls(const Self *self, const ParticleSet *walls, Visits visits,
                          const SweepConstants c, Lanes *total)
{
    const Self own = *self;
    const ParticleSet set = *walls;
    Lanes sum = {{0}, {0}, {0}};
    for (int base; visits_next(&visits, &base);)
        visit_momentum(&own, &set, base, c, false, false, &sum);
    for (int l = 0; l < CLUSTER; l++) {
        total->x[l] += sum.x[l];
        total->y[l] += sum.y[l];
        total->z[l] += sum.z[l];
    }
}

/// Walls' part in the continuity of one particle.
static void squeeze_of_walls(const Self *self, const ParticleSet *walls, Visits visits,
                             const SweepConstants c, float total[CLUSTER])
{
    const Self own = *self;
    const ParticleSet set = *walls;
    float sum[CLUSTER] = {0};
    for (int base; visits_next(&visits, &base);)
        visit_density(&own, &set, base, c, false, false, sum);
    for (int l = 0; l < CLUSTER; l++)
        total[l] += sum[l];
}

FN void acceleration_of_cluster(const Sweep *sweep, int i, bool viscous)
{
    ParticleSet *fluid = sweep->fluid;
    const SweepConstants c = sweep->constants;
    Lanes sums[CLUSTER] = {0};
    for (int l = 0; l < CLUSTER; l++) {
        if (fluid->id[i * CLUSTER + l] < 0) continue;
        const Self self = self_of(fluid, i * CLUSTER + l);
        Visits visits = visits_of(sweep->fluid_fluid, i, l);
        Lanes sum = {0};
        for (int base; visits_next(&visits, &base);)
            visit_momentum(&self, fluid, base, c, viscous, true, &sum);
        visit_momentum(&self, fluid, i * CLUSTER, c, viscous, false, &sum);
        sums[l] = sum;
    }
    for (int set = 0; set < 2; set++) {
        if (!sweep->walls[set]->count || !sweep->fluid_wall[set]->count[i]) continue;
        for (int l = 0; l < CLUSTER; l++) {
            if (fluid->id[i * CLUSTER + l] < 0) continue;
            const Self self = self_of(fluid, i * CLUSTER + l);
            push_of_walls(&self, sweep->walls[set], visits_of(sweep->fluid_wall[set], i, l), c,
                          &sums[l]);
        }
    }
    for (int l = 0; l < CLUSTER; l++) {
        fluid->rate[0][i * CLUSTER + l] += lanes_total(sums[l].x);
        fluid->rate[1][i * CLUSTER + l] += lanes_total(sums[l].y);
        fluid->rate[2][i * CLUSTER + l] += lanes_total(sums[l].z);
    }
}

FN void density_of_cluster(const Sweep *sweep, int i, bool diffusive)
{
    ParticleSet *fluid = sweep->fluid;
    const SweepConstants c = sweep->constants;
    float sums[CLUSTER][CLUSTER] = {{0}};
    for (int l = 0; l < CLUSTER; l++) {
        if (fluid->id[i * CLUSTER + l] < 0) continue;
        const Self self = self_of(fluid, i * CLUSTER + l);
        Visits visits = visits_of(sweep->fluid_fluid, i, l);
        float sum[CLUSTER] = {0};
        for (int base; visits_next(&visits, &base);)
            visit_density(&self, fluid, base, c, diffusive, true, sum);
        visit_density(&self, fluid, i * CLUSTER, c, diffusive, false, sum);
        memcpy(sums[l], sum, sizeof sum);
    }
    for (int set = 0; set < 2; set++) {
        if (!sweep->walls[set]->count || !sweep->fluid_wall[set]->count[i]) continue;
        for (int l = 0; l < CLUSTER; l++) {
            if (fluid->id[i * CLUSTER + l] < 0) continue;
            const Self self = self_of(fluid, i * CLUSTER + l);
            squeeze_of_walls(&self, sweep->walls[set], visits_of(sweep->fluid_wall[set], i, l), c,
                             sums[l]);
        }
    }
    for (int l = 0; l < CLUSTER; l++)
        fluid->rate[0][i * CLUSTER + l] += lanes_total(sums[l]);
}

static void acceleration_plain(const Sweep *sweep, int begin, int end)
{
    for (int i = begin; i < end; i++)
        acceleration_of_cluster(sweep, i, false);
}
static void acceleration_viscous(const Sweep *sweep, int begin, int end)
{
    for (int i = begin; i < end; i++)
        acceleration_of_cluster(sweep, i, true);
}
static void density_plain(const Sweep *sweep, int begin, int end)
{
    for (int i = begin; i < end; i++)
        density_of_cluster(sweep, i, false);
}
static void density_diffusive(const Sweep *sweep, int begin, int end)
{
    for (int i = begin; i < end; i++)
        density_of_cluster(sweep, i, true);
}

/// Sums of the dummy extrapolation.
typedef struct Shepard {
    float weight[CLUSTER], pressure[CLUSTER];
} Shepard;

/// @param pull  g - a_w of the dummy times unit and rho0: (pull . x) (1 + excess) is the pressure
///              that a column between fluid and dummy adds [Pa/unit]; fixed dummies feel only gravity
FN void visit_extrapolation(const Self *self, const ParticleSet *fluid, int base,
                            const Sweep *sweep, const float pull[3], bool moving, Shepard *sum)
{
    const int32_t *RESTRICT px = fluid->position[0] + base,
                            *RESTRICT py = fluid->position[1] + base;
    const int32_t *RESTRICT pz = fluid->position[2] + base;
    const float *RESTRICT excess = fluid->field[EXCESS] + base;
#pragma omp simd
    for (int l = 0; l < CLUSTER; l++) {
        float dx = (float)(self->x - px[l]), dy = (float)(self->y - py[l]);
        float dz = (float)(self->z - pz[l]);
        float s = pair_closeness(dx * dx + dy * dy + dz * dz, sweep->constants.inverse_support);
        float weight = kernel_value(s);
        float column = moving ? pull[0] * dx + pull[1] * dy + pull[2] * dz : pull[2] * dz;
        sum->weight[l] += weight;
        sum->pressure[l] += weight * (tait_pressure(excess[l], sweep->tait_b) +
                                      column * (1.0f + excess[l]));
    }
}

/// Pressure of one dummy particle,
/// p_w = (sum p_f W + (g - a_w) . sum rho_f x_wf W) / sum W, never below zero (no suction at
/// walls). Source: Adami, Hu & Adams (2012), doi:10.1016/j.jcp.2012.05.005, eq. 27.
FN float extrapolated_pressure(const Sweep *sweep, const ClusterList *list, int set, int i, int l)
{
    const ParticleSet *wall = sweep->walls[set];
    const Self self = self_of(wall, i * CLUSTER + l);
    float pull[3], column = sweep->rest_density * sweep->unit;
    for (int a = 0; a < 3; a++) {
        float acceleration = set == 1 ? wall->field[WALL_ACCELERATION_X + a][i * CLUSTER + l] : 0;
        pull[a] = column * (sweep->gravity[a] - acceleration);
    }
    Visits visits = visits_of(list, i, l);
    Shepard sum = {{0}, {0}};
    for (int base; visits_next(&visits, &base);)
        visit_extrapolation(&self, sweep->fluid, base, sweep, pull, set == 1, &sum);
    float weight = lanes_total(sum.weight);
    if (weight < 1e-6f) return 0.0f;
    float p = lanes_total(sum.pressure) / weight;
    return p > 0.0f ? p : 0.0f;
}

FN void extrapolate_set(const Sweep *sweep, int set, int begin, int end)
{
    ParticleSet *wall = sweep->walls[set];
    const ClusterList *list = sweep->wall_fluid[set];
    for (int i = begin; i < end; i++)
        for (int l = 0; l < CLUSTER; l++) {
            float p = 0;
            if (list->count[i] && wall->id[i * CLUSTER + l] >= 0)
                p = extrapolated_pressure(sweep, list, set, i, l);
            float rho = sweep->rest_density * (1.0f + tait_excess(p, sweep->tait_b));
            wall->pressure[i * CLUSTER + l] = p / (rho * rho);
        }
}

static void extrapolate(const Sweep *sweep, int set, int begin, int end)
{
    if (set == 0)
        extrapolate_set(sweep, 0, begin, end);
    else
        extrapolate_set(sweep, 1, begin, end);
}

static void loads(const Sweep *sweep, int begin, int end)
{
    ParticleSet *wall = sweep->walls[1];
    const ClusterList *list = sweep->wall_fluid[1];
    const SweepConstants c = sweep->constants;
    for (int i = begin; i < end; i++) {
        for (int l = 0; l < CLUSTER; l++) {
            int slot = i * CLUSTER + l, id = wall->id[slot];
            Lanes sum = {0};
            if (id >= 0 && sweep->moving_owner[id] >= 0 && list->count[i]) {
                const Self self = self_of(wall, slot);
                Visits visits = visits_of(list, i, l);
                for (int base; visits_next(&visits, &base);)
                    visit_momentum(&self, sweep->fluid, base, c, false, false, &sum);
            }
            wall->rate[0][slot] = lanes_total(sum.x);
            wall->rate[1][slot] = lanes_total(sum.y);
            wall->rate[2][slot] = lanes_total(sum.z);
        }
    }
}

const SweepTable *AT_LEVEL(sweep_table)(void)
{
    static const SweepTable table = {
        SWEEP_LEVEL,
        AT_LEVEL(near_clusters),
        AT_LEVEL(near_prune),
        {acceleration_plain, acceleration_viscous},
        {density_plain, density_diffusive},
        extrapolate,
        loads,
    };
    return &table;
}
