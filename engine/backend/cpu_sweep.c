/// Neighbour sweeps over clusters of eight. One particle meets eight neighbours, a lane each; no
/// mask is needed, because closeness = max(0, 1 - r/2h) is zero beyond the support and in padding.
/// Which clusters a particle visits, near_prune has written as bits into the list: by its distance
/// to their boxes, with a margin, so that many sweeps can use them.
///
/// Compiled once per instruction level (sweep.h).
#include "backend/visits.h"
#include "physics/fluid.h"

/// Momentum: one particle and the eight at `base`. `react` lets the eight feel it too.
FN void visit_momentum(const Self *self, const Arrays *other, size_t base, const SweepConstants c,
                       bool viscous, bool react, Lanes sum[3])
{
    Offset d = offset_to(self, other, base);
    Lanes r2 = offset_square(d), closeness = pair_closeness(r2, c.per_support);
    Lanes force, pressures = self->pressure + lanes_load(other->pressure + base);
    if (viscous)
        force = pair_force(closeness, r2, pressures, approach_of(self, other, base, d), c);
    else
        force = kernel_slope(closeness) * pressures;
    sum[0] += force * d.x;
    sum[1] += force * d.y;
    sum[2] += force * d.z;
    if (!react) return;
    lanes_store(other->rate[0] + base, lanes_load(other->rate[0] + base) - force * d.x);
    lanes_store(other->rate[1] + base, lanes_load(other->rate[1] + base) - force * d.y);
    lanes_store(other->rate[2] + base, lanes_load(other->rate[2] + base) - force * d.z);
}

/// Continuity: one particle and the eight at `base`.
FN void visit_density(const Self *self, const Arrays *other, size_t base, const SweepConstants c,
                      bool diffusive, bool react, Lanes *sum)
{
    Offset d = offset_to(self, other, base);
    Lanes slope = kernel_slope(pair_closeness(offset_square(d), c.per_support));
    Lanes stretch = approach_of(self, other, base, d), spread = lanes_all(0);
    if (diffusive) spread = lanes_load(other->dynamic + base) - self->dynamic;
    *sum += slope * (spread - stretch);
    if (react)
        lanes_store(other->rate[0] + base,
                    lanes_load(other->rate[0] + base) - slope * (spread + stretch));
}

/// Push of the fluid's pairs and of its own cluster on particle l of cluster i.
FN void push_of_fluid(const Sweep *sweep, const Arrays *fluid, int i, int l, bool viscous,
                      Lanes sum[3])
{
    const SweepConstants c = sweep->constants;
    const Self self = self_of(fluid, i * CLUSTER + l);
    Lanes total[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
    Visits visits = visits_of(sweep->fluid_fluid, i, l);
    for (size_t base; visits_next(&visits, &base);)
        visit_momentum(&self, fluid, base, c, viscous, true, total);
    visit_momentum(&self, fluid, (size_t)i * CLUSTER, c, viscous, false, total);
    memcpy(sum, total, sizeof total);
}

/// Push of wall clusters on one particle: no viscosity.
FN void push_of_walls(const Sweep *sweep, const Arrays *fluid, int set, int i, int l, Lanes sum[3])
{
    const SweepConstants c = sweep->constants;
    const Arrays walls = arrays_of(sweep->walls[set]);
    const Self self = self_of(fluid, i * CLUSTER + l);
    Visits visits = visits_of(sweep->fluid_wall[set], i, l);
    for (size_t base; visits_next(&visits, &base);)
        visit_momentum(&self, &walls, base, c, false, false, sum);
}

FN void acceleration_of_cluster(const Sweep *sweep, int i, bool viscous)
{
    const Arrays fluid = arrays_of(sweep->fluid);
    const int32_t *id = sweep->fluid->id + i * CLUSTER;
    for (int l = 0; l < CLUSTER; l++) {
        if (id[l] < 0) continue;
        Lanes sum[3];
        push_of_fluid(sweep, &fluid, i, l, viscous, sum);
        for (int set = 0; set < WALL_SETS; set++)
            if (has_walls(sweep, set, i)) push_of_walls(sweep, &fluid, set, i, l, sum);
        for (int a = 0; a < 3; a++)
            fluid.rate[a][i * CLUSTER + l] += lanes_total(sum[a]);
    }
}

FN void density_of_cluster(const Sweep *sweep, int i, bool diffusive)
{
    const SweepConstants c = sweep->constants;
    const Arrays fluid = arrays_of(sweep->fluid);
    const int32_t *id = sweep->fluid->id + i * CLUSTER;
    for (int l = 0; l < CLUSTER; l++) {
        if (id[l] < 0) continue;
        const Self self = self_of(&fluid, i * CLUSTER + l);
        Lanes sum = lanes_all(0);
        Visits visits = visits_of(sweep->fluid_fluid, i, l);
        for (size_t base; visits_next(&visits, &base);)
            visit_density(&self, &fluid, base, c, diffusive, true, &sum);
        visit_density(&self, &fluid, (size_t)i * CLUSTER, c, diffusive, false, &sum);
        for (int set = 0; set < WALL_SETS; set++) {
            if (!has_walls(sweep, set, i)) continue;
            const Arrays walls = arrays_of(sweep->walls[set]);
            visits = visits_of(sweep->fluid_wall[set], i, l);
            for (size_t base; visits_next(&visits, &base);)
                visit_density(&self, &walls, base, c, false, false, &sum);
        }
        fluid.rate[0][i * CLUSTER + l] += lanes_total(sum);
    }
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

/// Pressure of one dummy particle,
/// p_w = (sum p_f W + (g - a_w) . sum rho_f x_wf W) / sum W, never below zero (no suction at
/// walls). Fixed dummies feel only gravity.
/// Source: Adami, Hu & Adams (2012), doi:10.1016/j.jcp.2012.05.005, eq. 27.
FN float extrapolated_pressure(const Sweep *sweep, int set, int i, int l)
{
    const ParticleSet *wall = sweep->walls[set];
    const Arrays walls = arrays_of(wall), fluid = arrays_of(sweep->fluid);
    const Self self = self_of(&walls, i * CLUSTER + l);
    float pull[3], column = sweep->rest_density * sweep->unit; // of water, per unit of length
    for (int a = 0; a < 3; a++) {
        float acceleration = set == 1 ? wall->field[WALL_ACCELERATION_X + a][i * CLUSTER + l] : 0;
        pull[a] = column * (sweep->gravity[a] - acceleration);
    }
    const float rho0_squared = sweep->rest_density * sweep->rest_density;
    Lanes weights = lanes_all(0), pressures = lanes_all(0);
    Visits visits = visits_of(sweep->wall_fluid[set], i, l);
    for (size_t base; visits_next(&visits, &base);) {
        Offset d = offset_to(&self, &fluid, base);
        Lanes closeness = pair_closeness(offset_square(d), sweep->constants.per_support);
        Lanes weight = kernel_value(closeness);
        Lanes density = 1.0f + lanes_load(fluid.excess + base), depth = pull[2] * d.z;
        if (set == 1) depth += pull[0] * d.x + pull[1] * d.y;
        weights += weight;
        // p = P rho^2
        Lanes p = lanes_load(fluid.pressure + base) * (rho0_squared * density);
        pressures += weight * density * (p + depth);
    }
    float weight = lanes_total(weights), sum = lanes_total(pressures);
    return weight < 1e-6f || sum < 0.0f ? 0.0f : sum / weight;
}

FN void extrapolate_set(const Sweep *sweep, int set, int begin, int end)
{
    ParticleSet *wall = sweep->walls[set];
    const ClusterList *list = sweep->wall_fluid[set];
    for (int i = begin; i < end; i++)
        for (int l = 0; l < CLUSTER; l++) {
            float p = 0;
            if (list->count[i] && wall->id[i * CLUSTER + l] >= 0)
                p = extrapolated_pressure(sweep, set, i, l);
            float rho = sweep->rest_density * (1.0f + tait_excess(p, sweep->tait_b));
            wall->pressure[i * CLUSTER + l] = p / (rho * rho);
        }
}

static void extrapolate(const Sweep *sweep, int set, int begin, int end)
{
    if (set == 0)
        extrapolate_set(sweep, 0, begin, end);
    else if (EFFECTS_BUILT)
        extrapolate_set(sweep, 1, begin, end);
}

static void loads(const Sweep *sweep, int begin, int end)
{
    ParticleSet *wall = sweep->walls[1];
    const ClusterList *list = sweep->wall_fluid[1];
    const SweepConstants c = sweep->constants;
    const Arrays walls = arrays_of(wall), fluid = arrays_of(sweep->fluid);
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        int i = slot / CLUSTER, id = wall->id[slot];
        Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
        if (id >= 0 && sweep->moving_owner[id] >= 0 && list->count[i]) {
            const Self self = self_of(&walls, slot);
            Visits visits = visits_of(list, i, slot % CLUSTER);
            for (size_t base; visits_next(&visits, &base);)
                visit_momentum(&self, &fluid, base, c, false, false, sum);
        }
        for (int a = 0; a < 3; a++)
            wall->rate[a][slot] = lanes_total(sum[a]);
    }
}

const SweepTable *AT_KERNEL(sweep_table)(void)
{
    static const SweepTable table = {
        SWEEP_LEVEL,
        AT_LEVEL(step_place),
        AT_LEVEL(step_advance),
        AT_LEVEL(step_update_pressure),
        AT_LEVEL(step_update_dynamic),
        AT_LEVEL(near_clusters),
        AT_LEVEL(near_prune),
        {acceleration_plain, EFFECTS_BUILT ? acceleration_viscous : NULL,
         EFFECTS_BUILT ? AT_KERNEL(gradient_plain) : NULL,
         EFFECTS_BUILT ? AT_KERNEL(gradient_viscous) : NULL},
        EFFECTS_BUILT ? AT_KERNEL(viscous_forces) : NULL,
        {density_plain, EFFECTS_BUILT ? density_diffusive : NULL},
        extrapolate,
        {loads, AT_KERNEL(gradient_loads), AT_KERNEL(viscous_loads)},
        AT_KERNEL(gradient_moments),
        AT_KERNEL(gradient_invert),
        AT_KERNEL(viscous_mirror),
        AT_KERNEL(viscous_strain),
        AT_KERNEL(viscous_stress),
        AT_KERNEL(shift_sums),
        AT_KERNEL(shift_velocities),
    };
    return &table;
}
