/// Momentum with molecular viscosity, unresolved turbulence and walls that hold the water
/// (physics/viscous.h), in sweeps of their own: the plain ones know nothing of them. First the
/// velocities that water meets in dummies, and the stresses; then the forces. Compiled once per
/// instruction level (sweep.h).
#include "backend/backend.h"
#include "backend/terms.h"
#include "backend/visits.h"
#include "physics/viscous.h"

/// Arrays of a set of dummies with the velocities that viscosity meets there.
FN Arrays mirrored_of(const ParticleSet *wall)
{
    Arrays a = arrays_of(wall);
    a.u = wall->mirror[0];
    a.v = wall->mirror[1];
    a.w = wall->mirror[2];
    return a;
}

/// Force of one particle and the eight at `base`.
/// @param mask  PAIR_VISCOSITY and PAIR_TURBULENCE: what acts beside pressure and viscosity
/// @param stress  tau/rho^2 of both, of PAIR_TURBULENCE
FN Offset force_between(const Self *self, const Arrays *other, size_t base, const Sweep *sweep,
                        unsigned mask, Symmetric stress)
{
    const SweepConstants c = sweep->constants;
    Offset d = offset_to(self, other, base), f;
    Lanes r2 = offset_square(d), closeness = pair_closeness(r2, c.per_support);
    Lanes along, slope = kernel_slope(closeness), vx = approach_of(self, other, base, d);
    Lanes pressures = self->pressure + lanes_load(other->pressure + base);
    if (mask & PAIR_VISCOSITY)
        along = pair_force(closeness, r2, pressures, vx, c);
    else
        along = slope * pressures;
    along += viscous_push(closeness, r2, vx, sweep->viscous);
    f.x = along * d.x;
    f.y = along * d.y;
    f.z = along * d.z;
    if (mask & PAIR_TURBULENCE) {
        f.x -= slope * (stress.xx * d.x + stress.xy * d.y + stress.xz * d.z);
        f.y -= slope * (stress.xy * d.x + stress.yy * d.y + stress.yz * d.z);
        f.z -= slope * (stress.xz * d.x + stress.yz * d.y + stress.zz * d.z);
    }
    return f;
}

FN void add_force(Lanes sum[3], Offset f)
{
    sum[0] += f.x;
    sum[1] += f.y;
    sum[2] += f.z;
}

FN void react_force(const Arrays *other, size_t base, Offset f)
{
    lanes_store(other->rate[0] + base, lanes_load(other->rate[0] + base) - f.x);
    lanes_store(other->rate[1] + base, lanes_load(other->rate[1] + base) - f.y);
    lanes_store(other->rate[2] + base, lanes_load(other->rate[2] + base) - f.z);
}

/// tau/rho^2 of a particle and of the eight at `base`.
FN Symmetric stress_between(const Terms *terms, Symmetric own, size_t base, unsigned mask)
{
    return mask & PAIR_TURBULENCE ? terms_sum(own, terms_load(terms, base)) : own;
}

/// Push of dummies: their pressure and, where they hold the water, viscosity.
FN void force_of_walls(const Sweep *sweep, const Self *self, int i, int l, unsigned mask,
                       Lanes sum[3])
{
    const SweepConstants c = sweep->constants;
    const bool holds = (mask & PAIR_NO_SLIP) != 0;
    for (int set = 0; set < 2; set++) {
        if (!has_walls(sweep, set, i)) continue;
        const Arrays walls = holds ? mirrored_of(sweep->walls[set]) : arrays_of(sweep->walls[set]);
        Visits visits = visits_of(sweep->fluid_wall[set], i, l);
        for (size_t base; visits_next(&visits, &base);) {
            if (holds) {
                add_force(sum, force_between(self, &walls, base, sweep, 0, no_terms()));
                continue;
            }
            Offset d = offset_to(self, &walls, base);
            Lanes push = kernel_slope(pair_closeness(offset_square(d), c.per_support)) *
                         (self->pressure + lanes_load(walls.pressure + base));
            Offset f = {push * d.x, push * d.y, push * d.z};
            add_force(sum, f);
        }
    }
}

FN void force_of_particle(const Sweep *sweep, const Arrays *fluid, const Terms *terms, int i, int l,
                          unsigned mask)
{
    const Self self = self_of(fluid, i * CLUSTER + l);
    Symmetric own = no_terms();
    if (mask & PAIR_TURBULENCE) own = terms_own(terms, i * CLUSTER + l);
    Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
    Visits visits = visits_of(sweep->fluid_fluid, i, l);
    for (size_t base; visits_next(&visits, &base);) {
        Symmetric stress = stress_between(terms, own, base, mask);
        Offset f = force_between(&self, fluid, base, sweep, mask, stress);
        add_force(sum, f);
        react_force(fluid, base, f);
    }
    size_t same = (size_t)i * CLUSTER;
    Symmetric stress = stress_between(terms, own, same, mask);
    add_force(sum, force_between(&self, fluid, same, sweep, mask, stress));
    force_of_walls(sweep, &self, i, l, mask, sum);
    for (int a = 0; a < 3; a++)
        fluid->rate[a][i * CLUSTER + l] += lanes_total(sum[a]);
}

FN void forces_of_clusters(const Sweep *sweep, int begin, int end, unsigned mask)
{
    const Arrays fluid = arrays_of(sweep->fluid);
    const Terms terms = terms_of(sweep->fluid->stress);
    for (int i = begin; i < end; i++)
        for (int l = 0; l < CLUSTER; l++)
            if (sweep->fluid->id[i * CLUSTER + l] >= 0)
                force_of_particle(sweep, &fluid, &terms, i, l, mask);
}

// In the order of SweepTable.viscous.
#define VARIANT(number, mask)                                                                      \
    static void forces_##number(const Sweep *sweep, int begin, int end)                            \
    {                                                                                              \
        forces_of_clusters(sweep, begin, end, (mask));                                             \
    }
VARIANT(0, 0)
VARIANT(1, PAIR_VISCOSITY)
VARIANT(2, PAIR_TURBULENCE)
VARIANT(3, PAIR_TURBULENCE | PAIR_VISCOSITY)
VARIANT(4, PAIR_NO_SLIP)
VARIANT(5, PAIR_NO_SLIP | PAIR_VISCOSITY)
VARIANT(6, PAIR_NO_SLIP | PAIR_TURBULENCE)
VARIANT(7, PAIR_NO_SLIP | PAIR_TURBULENCE | PAIR_VISCOSITY)
#undef VARIANT

const SweepFunction AT_KERNEL(viscous_forces)[VISCOUS_VARIANTS] = {
    forces_0, forces_1, forces_2, forces_3, forces_4, forces_5, forces_6, forces_7};

/// What a dummy that holds the water answers its push and its drag with.
void AT_KERNEL(viscous_loads)(const Sweep *sweep, int begin, int end)
{
    ParticleSet *wall = sweep->walls[1];
    const Arrays walls = mirrored_of(wall), fluid = arrays_of(sweep->fluid);
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        int i = slot / CLUSTER, id = wall->id[slot];
        Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
        if (id >= 0 && sweep->moving_owner[id] >= 0 && sweep->wall_fluid[1]->count[i]) {
            const Self self = self_of(&walls, slot);
            Visits visits = visits_of(sweep->wall_fluid[1], i, slot % CLUSTER);
            for (size_t base; visits_next(&visits, &base);)
                add_force(sum, force_between(&self, &fluid, base, sweep, 0, no_terms()));
        }
        for (int a = 0; a < 3; a++)
            wall->rate[a][slot] = lanes_total(sum[a]);
    }
}

/// Velocity at which one dummy meets viscosity, 2 v_w - sum v W / sum W over the water around it:
/// on the skin, midway to the water's first layer, it is then the wall's.
/// Source: Adami, Hu & Adams (2012), doi:10.1016/j.jcp.2012.05.005, eq. 22 and 23.
FN void mirror_velocity(const Sweep *sweep, int set, int slot)
{
    const ParticleSet *wall = sweep->walls[set];
    const Arrays walls = arrays_of(wall), fluid = arrays_of(sweep->fluid);
    const Self self = self_of(&walls, slot);
    Lanes weights = lanes_all(0), sum[3] = {weights, weights, weights};
    Visits visits = visits_of(sweep->wall_fluid[set], slot / CLUSTER, slot % CLUSTER);
    for (size_t base; visits_next(&visits, &base);) {
        Lanes r2 = offset_square(offset_to(&self, &fluid, base));
        Lanes closeness = pair_closeness(r2, sweep->constants.per_support);
        Lanes weight = wendland_value(closeness);
        weights += weight;
        sum[0] += weight * lanes_load(fluid.u + base);
        sum[1] += weight * lanes_load(fluid.v + base);
        sum[2] += weight * lanes_load(fluid.w + base);
    }
    float weight = lanes_total(weights);
    for (int a = 0; a < 3; a++) {
        float own = wall->field[VELOCITY_X + a][slot];
        wall->mirror[a][slot] = weight < 1e-6f ? own : 2 * own - lanes_total(sum[a]) / weight;
    }
}

void AT_KERNEL(viscous_mirror)(const Sweep *sweep, int set, int begin, int end)
{
    const ParticleSet *wall = sweep->walls[set];
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        bool wet = sweep->wall_fluid[set]->count[slot / CLUSTER] && wall->id[slot] >= 0;
        if (wet)
            mirror_velocity(sweep, set, slot);
        else
            for (int a = 0; a < 3; a++)
                wall->mirror[a][slot] = 0;
    }
}

/// v_ik of one particle and eight others [m/s].
FN Offset parting_of(const Self *self, const Arrays *other, size_t base)
{
    Offset v;
    v.x = self->u - lanes_load(other->u + base);
    v.y = self->v - lanes_load(other->v + base);
    v.z = self->w - lanes_load(other->w + base);
    return v;
}

/// Rate of strain: one particle and the eight at `base`, which have the same share in each other's.
FN Symmetric strain_between(const Self *self, const Arrays *other, size_t base, float per_support)
{
    // lengths over the support, as in cpu_gradient.c
    Lanes scale = lanes_all(per_support);
    Offset d = offset_to(self, other, base), v = parting_of(self, other, base);
    Lanes slope = kernel_slope(pair_closeness(offset_square(d), per_support));
    return strain_moment(slope, v.x, v.y, v.z, scale * d.x, scale * d.y, scale * d.z);
}

void AT_KERNEL(viscous_strain)(const Sweep *sweep, int begin, int end)
{
    const float per_support = sweep->constants.per_support;
    const Arrays fluid = arrays_of(sweep->fluid);
    const Terms terms = terms_of(sweep->fluid->stress);
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        if (sweep->fluid->id[slot] < 0) continue;
        const Self self = self_of(&fluid, slot);
        size_t same = (size_t)slot / CLUSTER * CLUSTER;
        Symmetric sum = strain_between(&self, &fluid, same, per_support);
        Visits visits = visits_of(sweep->fluid_fluid, slot / CLUSTER, slot % CLUSTER);
        for (size_t base; visits_next(&visits, &base);) {
            Symmetric s = strain_between(&self, &fluid, base, per_support);
            sum = terms_sum(sum, s);
            terms_store(&terms, base, terms_sum(terms_load(&terms, base), s));
        }
        terms_add_total(&terms, slot, sum);
    }
}

void AT_KERNEL(viscous_stress)(const Sweep *sweep, int begin, int end)
{
    const Terms terms = terms_of(sweep->fluid->stress);
    const Lanes factor = lanes_all(sweep->viscous.strain);
    for (size_t base = (size_t)begin * CLUSTER; base < (size_t)end * CLUSTER; base += CLUSTER) {
        Symmetric s = terms_load(&terms, base);
        s = gradient_weigh(factor, s, lanes_all(0), s);
        terms_store(&terms, base, eddy_stress(s, sweep->viscous));
    }
}
