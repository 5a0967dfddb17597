/// Momentum with molecular viscosity, unresolved turbulence and walls that hold the water
/// (physics/viscous.h), in sweeps of their own: the plain ones know nothing of them. First the
/// velocities that water meets in dummies, and the stresses; then the forces. Compiled once per
/// instruction level (sweep.h).
#include "backend/backend.h"
#include "backend/terms.h"
#include "backend/visits.h"
#include "physics/viscous.h"

/// Velocities of eight particles.
FN Offset velocities_of(const Octet *eight)
{
    Offset v = {lanes_load(eight->velocity[0]), lanes_load(eight->velocity[1]),
                lanes_load(eight->velocity[2])};
    return v;
}

/// Velocities that viscosity meets in eight dummies.
FN Offset mirrored_of(const ParticleSet *wall, size_t c)
{
    const size_t base = c * CLUSTER;
    Offset v = {lanes_load(wall->mirror[0] + base), lanes_load(wall->mirror[1] + base),
                lanes_load(wall->mirror[2] + base)};
    return v;
}

/// Force of one particle and the eight of an octet.
/// @param v  their velocities, as viscosity meets them
/// @param mask  PAIR_VISCOSITY and PAIR_TURBULENCE: what acts beside pressure and viscosity
/// @param stress  tau/rho^2 of both, of PAIR_TURBULENCE
FN Offset force_between(const Self *self, const Octet *other, Offset v, const Sweep *sweep,
                        unsigned mask, Symmetric stress)
{
    const SweepConstants k = sweep->constants;
    Offset d = offset_to(self, other), f;
    Lanes r2 = offset_square(d), closeness = pair_closeness(lane_sqrt(r2), k.per_support);
    Lanes slope = kernel_slope(closeness), pressures = pressures_of(self, other);
    Lanes vx = (self->u - v.x) * d.x + (self->v - v.y) * d.y + (self->w - v.z) * d.z;
    if (mask & PAIR_VISCOSITY) pressures -= k.viscosity * pair_approach(r2, vx, k);
    Lanes along = pair_force(closeness, pressures);
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

/// tau/rho^2 of a particle and of the eight of cluster c.
FN Symmetric stress_between(const Terms *terms, Symmetric own, size_t c, unsigned mask)
{
    return mask & PAIR_TURBULENCE ? terms_sum(own, terms_load(terms, c * CLUSTER)) : own;
}

/// Push of dummies: their pressure and, where they hold the water, viscosity.
FN void force_of_walls(const Sweep *sweep, const Self *self, int i, int l, unsigned mask,
                       Lanes sum[3])
{
    const SweepConstants k = sweep->constants;
    const bool holds = (mask & PAIR_NO_SLIP) != 0;
    for (int set = 0; set < 2; set++) {
        if (!has_walls(sweep, set, i)) continue;
        const ParticleSet *wall = sweep->walls[set];
        Visits visits = visits_of(sweep->fluid_wall[set], i, l);
        for (size_t c; visits_next(&visits, &c);) {
            const Octet *eight = &wall->octet[c];
            if (holds) {
                add_force(sum,
                          force_between(self, eight, mirrored_of(wall, c), sweep, 0, no_terms()));
                continue;
            }
            Offset d = offset_to(self, eight);
            Lanes closeness = pair_closeness(lane_sqrt(offset_square(d)), k.per_support);
            Lanes push = pair_force(closeness, pressures_of(self, eight));
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
    for (size_t c; visits_next(&visits, &c);) {
        const Octet *eight = &fluid->octet[c];
        Symmetric stress = stress_between(terms, own, c, mask);
        Offset f = force_between(&self, eight, velocities_of(eight), sweep, mask, stress);
        add_force(sum, f);
        react(fluid, c, lanes_all(1), f);
    }
    const Octet *same = &fluid->octet[i];
    Symmetric stress = stress_between(terms, own, (size_t)i, mask);
    add_force(sum, force_between(&self, same, velocities_of(same), sweep, mask, stress));
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
    const Arrays walls = arrays_of(wall), fluid = arrays_of(sweep->fluid);
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        int i = slot / CLUSTER, id = wall->id[slot];
        Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
        if (id >= 0 && sweep->moving_owner[id] >= 0 && sweep->wall_fluid[1]->count[i]) {
            Self self = self_of(&walls, slot);
            self.u = lanes_all(wall->mirror[0][slot]);
            self.v = lanes_all(wall->mirror[1][slot]);
            self.w = lanes_all(wall->mirror[2][slot]);
            Visits visits = visits_of(sweep->wall_fluid[1], i, slot % CLUSTER);
            for (size_t c; visits_next(&visits, &c);) {
                const Octet *eight = &fluid.octet[c];
                add_force(sum,
                          force_between(&self, eight, velocities_of(eight), sweep, 0, no_terms()));
            }
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
    for (size_t c; visits_next(&visits, &c);) {
        const Octet *eight = &fluid.octet[c];
        Lanes root = lane_sqrt(offset_square(offset_to(&self, eight)));
        Lanes weight = wendland_value(pair_closeness(root, sweep->constants.per_support));
        weights += weight;
        sum[0] += weight * lanes_load(eight->velocity[0]);
        sum[1] += weight * lanes_load(eight->velocity[1]);
        sum[2] += weight * lanes_load(eight->velocity[2]);
    }
    float weight = lanes_total(weights);
    for (int a = 0; a < 3; a++) {
        float own = *velocity_of(wall, a, slot);
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

/// Rate of strain: one particle and eight, which have the same share in each other's.
FN Symmetric strain_between(const Self *self, const Octet *eight, float per_support)
{
    // lengths over the support, as in cpu_gradient.c
    Lanes scale = lanes_all(per_support);
    Offset d = offset_to(self, eight), v = velocities_of(eight);
    Lanes slope = kernel_slope(pair_closeness(lane_sqrt(offset_square(d)), per_support));
    return strain_moment(slope, self->u - v.x, self->v - v.y, self->w - v.z, scale * d.x,
                         scale * d.y, scale * d.z);
}

void AT_KERNEL(viscous_strain)(const Sweep *sweep, int begin, int end)
{
    const float per_support = sweep->constants.per_support;
    const Arrays fluid = arrays_of(sweep->fluid);
    const Terms terms = terms_of(sweep->fluid->stress);
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        if (sweep->fluid->id[slot] < 0) continue;
        const Self self = self_of(&fluid, slot);
        Symmetric sum = strain_between(&self, &fluid.octet[slot / CLUSTER], per_support);
        Visits visits = visits_of(sweep->fluid_fluid, slot / CLUSTER, slot % CLUSTER);
        for (size_t c; visits_next(&visits, &c);) {
            const size_t base = c * CLUSTER;
            Symmetric s = strain_between(&self, &fluid.octet[c], per_support);
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
