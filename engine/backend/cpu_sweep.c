/// Neighbour sweeps over clusters of eight. One particle meets eight neighbours, a lane each; no
/// mask is needed, because closeness = max(0, 1 - r/2h) is zero beyond the support and in padding.
/// Which clusters a particle visits, near_prune has written as bits into the list: by its distance
/// to their boxes, with a margin, so that many sweeps can use them.
///
/// Compiled once per instruction level (sweep.h).
#include "backend/visits.h"
#include "physics/fluid.h"

/// Momentum between one particle and eight, begun: all that has to be looked up.
typedef struct Meeting {
    size_t c;
    Offset d;
    Lanes root, pressures, approach;
} Meeting;

FN Meeting meet(const Self *self, const Arrays *other, size_t c, const SweepConstants k,
                bool viscous)
{
    const Octet *eight = &other->octet[c];
    Meeting m;
    m.c = c;
    m.d = offset_to(self, eight);
    Lanes r2 = offset_square(m.d);
    m.root = lane_sqrt(r2);
    m.pressures = pressures_of(self, eight);
    m.approach = lanes_all(0);
    if (viscous) m.approach = pair_approach(r2, approach_of(self, eight, m.d), k);
    return m;
}

/// Its end. @param reacts  whether the eight feel it, too
FN void part(const Meeting *m, const Arrays *other, const SweepConstants k, bool reacts,
             Lanes sum[3])
{
    Lanes pressures = m->pressures - k.viscosity * m->approach;
    Lanes force = pair_force(pair_closeness(m->root, k.per_support), pressures);
    sum[0] += force * m->d.x;
    sum[1] += force * m->d.y;
    sum[2] += force * m->d.z;
    if (reacts) react(other, m->c, force, m->d);
}

/// Momentum from all clusters that a particle visits.
FN void meet_all(Visits visits, const Self *self, const Arrays *other, const SweepConstants k,
                 bool viscous, bool reacts, Lanes sum[3])
{
#define BEGIN(c) meet(self, other, c, k, viscous)
#define END(meeting) part(meeting, other, k, reacts, sum)
    VISIT_ALL(visits, Meeting, BEGIN, END)
#undef BEGIN
#undef END
}

/// Continuity between one particle and eight, begun.
typedef struct Stretch {
    size_t c;
    Lanes root, stretch, spread;
} Stretch;

FN Stretch stretch_to(const Self *self, const Arrays *other, size_t c, const float *dynamic,
                      Lanes own_dynamic)
{
    const Octet *eight = &other->octet[c];
    Stretch s;
    s.c = c;
    Offset d = offset_to(self, eight);
    s.root = lane_sqrt(offset_square(d));
    s.stretch = approach_of(self, eight, d);
    s.spread = lanes_all(0);
    if (dynamic) s.spread = lanes_load(dynamic + c * CLUSTER) - own_dynamic;
    return s;
}

FN void stretch_end(const Stretch *s, const Arrays *other, const SweepConstants k, bool reacts,
                    Lanes *sum)
{
    Lanes slope = kernel_slope(pair_closeness(s->root, k.per_support));
    *sum += slope * (s->spread - s->stretch);
    float *rate = other->rate[0] + s->c * CLUSTER;
    if (reacts) lanes_store(rate, lanes_load(rate) - slope * (s->spread + s->stretch));
}

/// Continuity from all clusters that a particle visits.
FN void stretch_all(Visits visits, const Self *self, const Arrays *other, const SweepConstants k,
                    const float *dynamic, Lanes own_dynamic, bool reacts, Lanes *sum){
#define BEGIN(c) stretch_to(self, other, c, dynamic, own_dynamic)
#define END(stretch) stretch_end(stretch, other, k, reacts, sum)
    VISIT_ALL(visits, Stretch, BEGIN, END)
#undef BEGIN
#undef END
}

FN void acceleration_of_cluster(const Sweep *sweep, int i, bool viscous)
{
    const SweepConstants k = sweep->constants;
    const Arrays fluid = arrays_of(sweep->fluid);
    const int32_t *id = sweep->fluid->id + i * CLUSTER;
    for (int l = 0; l < CLUSTER; l++) {
        if (id[l] < 0) continue;
        const Self self = self_of(&fluid, i * CLUSTER + l);
        Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
        meet_all(visits_of(sweep->fluid_fluid, i, l), &self, &fluid, k, viscous, true, sum);
        Meeting own = meet(&self, &fluid, (size_t)i, k, viscous);
        part(&own, &fluid, k, false, sum);
        for (int set = 0; set < WALL_SETS; set++) {
            if (!has_walls(sweep, set, i)) continue;
            const Arrays walls = arrays_of(sweep->walls[set]);
            meet_all(visits_of(sweep->fluid_wall[set], i, l), &self, &walls, k, false, false, sum);
        }
        for (int a = 0; a < 3; a++)
            fluid.rate[a][i * CLUSTER + l] += lanes_total(sum[a]);
    }
}

FN void density_of_cluster(const Sweep *sweep, int i, bool diffusive)
{
    const SweepConstants k = sweep->constants;
    const Arrays fluid = arrays_of(sweep->fluid);
    const float *dynamic = diffusive ? sweep->fluid->dynamic : NULL;
    const int32_t *id = sweep->fluid->id + i * CLUSTER;
    for (int l = 0; l < CLUSTER; l++) {
        if (id[l] < 0) continue;
        const Self self = self_of(&fluid, i * CLUSTER + l);
        Lanes sum = lanes_all(0), own_dynamic = sum;
        if (diffusive) own_dynamic = lanes_all(dynamic[i * CLUSTER + l]);
        stretch_all(visits_of(sweep->fluid_fluid, i, l), &self, &fluid, k, dynamic, own_dynamic,
                    true, &sum);
        Stretch own = stretch_to(&self, &fluid, (size_t)i, dynamic, own_dynamic);
        stretch_end(&own, &fluid, k, false, &sum);
        for (int set = 0; set < WALL_SETS; set++) {
            if (!has_walls(sweep, set, i)) continue;
            const Arrays walls = arrays_of(sweep->walls[set]);
            stretch_all(visits_of(sweep->fluid_wall[set], i, l), &self, &walls, k, NULL,
                        lanes_all(0), false, &sum);
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

/// What eight particles tell a dummy of the pressure, begun.
typedef struct Hint {
    Lanes root, density, pressure;
} Hint;

/// @param pull  per offset, rho0 (g - a_w) [Pa/unit]; only its vertical part where not `moving`
FN Hint hint_of(const Self *self, const Octet *eight, const Sweep *sweep, const float pull[3],
                bool moving)
{
    Offset d = offset_to(self, eight);
    Lanes depth = pull[2] * d.z;
    if (moving) depth += pull[0] * d.x + pull[1] * d.y;
    Hint hint;
    hint.root = lane_sqrt(offset_square(d));
    hint.density = 1.0f + lanes_load(eight->excess);
    // p = P rho^2
    const float rho0_squared = sweep->rest_density * sweep->rest_density;
    hint.pressure = lanes_load(eight->pressure) * (rho0_squared * hint.density) + depth;
    return hint;
}

/// @param sums  of weights, of weighed pressures
FN void hint_end(const Hint *hint, float per_support, Lanes sums[2])
{
    Lanes weight = kernel_value(pair_closeness(hint->root, per_support));
    sums[0] += weight;
    sums[1] += weight * hint->density * hint->pressure;
}

FN void take_hints(Visits visits, const Self *self, const Octet *fluid, const Sweep *sweep,
                   const float pull[3], bool moving, Lanes sums[2]){
#define BEGIN(c) hint_of(self, &fluid[c], sweep, pull, moving)
#define END(hint) hint_end(hint, sweep->constants.per_support, sums)
    VISIT_ALL(visits, Hint, BEGIN, END)
#undef BEGIN
#undef END
}

/// Pressure of one dummy particle,
/// p_w = (sum p_f W + (g - a_w) . sum rho_f x_wf W) / sum W, never below zero (no suction at
/// walls). Fixed dummies feel only gravity.
/// Source: Adami, Hu & Adams (2012), doi:10.1016/j.jcp.2012.05.005, eq. 27.
FN float extrapolated_pressure(const Sweep *sweep, int set, int i, int l)
{
    const ParticleSet *wall = sweep->walls[set];
    const Arrays walls = arrays_of(wall);
    const Self self = self_of(&walls, i * CLUSTER + l);
    float pull[3], column = sweep->rest_density * sweep->unit; // of water, per unit of length
    for (int a = 0; a < 3; a++) {
        float acceleration = set == 1 ? wall->acceleration[a][i * CLUSTER + l] : 0;
        pull[a] = column * (sweep->gravity[a] - acceleration);
    }
    Lanes sums[2] = {lanes_all(0), lanes_all(0)};
    take_hints(visits_of(sweep->wall_fluid[set], i, l), &self, sweep->fluid->octet, sweep, pull,
               set == 1, sums);
    float weight = lanes_total(sums[0]), sum = lanes_total(sums[1]);
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
            *pressure_of(wall, i * CLUSTER + l) = p / (rho * rho);
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
    const SweepConstants k = sweep->constants;
    const Arrays walls = arrays_of(wall), fluid = arrays_of(sweep->fluid);
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        int i = slot / CLUSTER, id = wall->id[slot];
        Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
        if (id >= 0 && sweep->moving_owner[id] >= 0 && list->count[i]) {
            const Self self = self_of(&walls, slot);
            meet_all(visits_of(list, i, slot % CLUSTER), &self, &fluid, k, false, false, sum);
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
