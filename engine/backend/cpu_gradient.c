/// Momentum with corrected kernel gradients (physics/gradient.h), in sweeps of its own: the plain
/// ones know nothing of it. First the moments of every particle's neighbours, then their inverses,
/// then the forces. Compiled once per instruction level (sweep.h).
#include "backend/terms.h"
#include "backend/visits.h"

/// Moments: one particle and the eight of cluster c, which have the same share in each other's.
FN void visit_moment(const Self *self, const Arrays *other, size_t c, float per_support,
                     const Terms *react, Symmetric *sum)
{
    Offset d = offset_to(self, &other->octet[c]);
    // lengths over the support: their fifth power in units would not be a float
    Lanes scale = lanes_all(per_support);
    Lanes slope = kernel_slope(pair_closeness(lane_sqrt(offset_square(d)), per_support));
    Symmetric m = gradient_moment(slope, scale * d.x, scale * d.y, scale * d.z);
    *sum = terms_sum(*sum, m);
    const size_t base = c * CLUSTER;
    if (react) terms_store(react, base, terms_sum(terms_load(react, base), m));
}

FN void moment_of_particle(const Sweep *sweep, const Arrays *fluid, const Terms *terms, int i,
                           int l)
{
    const float per_support = sweep->constants.per_support;
    const Self self = self_of(fluid, i * CLUSTER + l);
    Symmetric sum = no_terms();
    Visits visits = visits_of(sweep->fluid_fluid, i, l);
    for (size_t c; visits_next(&visits, &c);)
        visit_moment(&self, fluid, c, per_support, terms, &sum);
    visit_moment(&self, fluid, (size_t)i, per_support, NULL, &sum);
    for (int set = 0; set < 2; set++) {
        if (!has_walls(sweep, set, i)) continue;
        const Arrays walls = arrays_of(sweep->walls[set]);
        visits = visits_of(sweep->fluid_wall[set], i, l);
        for (size_t c; visits_next(&visits, &c);)
            visit_moment(&self, &walls, c, per_support, NULL, &sum);
    }
    terms_add_total(terms, i * CLUSTER + l, sum);
}

void AT_KERNEL(gradient_moments)(const Sweep *sweep, int begin, int end)
{
    const Arrays fluid = arrays_of(sweep->fluid);
    const Terms terms = terms_of(sweep->fluid->correction);
    for (int i = begin; i < end; i++)
        for (int l = 0; l < CLUSTER; l++)
            if (sweep->fluid->id[i * CLUSTER + l] >= 0)
                moment_of_particle(sweep, &fluid, &terms, i, l);
}

void AT_KERNEL(gradient_invert)(const Sweep *sweep, int begin, int end)
{
    const Terms terms = terms_of(sweep->fluid->correction);
    const GradientLimits limits = gradient_limits(sweep->dimensions);
    const Lanes factor = lanes_all(sweep->moment_factor);
    for (size_t base = (size_t)begin * CLUSTER; base < (size_t)end * CLUSTER; base += CLUSTER) {
        Symmetric m = terms_load(&terms, base);
        m = gradient_weigh(factor, m, lanes_all(0), m);
        if (sweep->dimensions == 2) m.yy = lanes_all(1);
        terms_store(&terms, base, gradient_correction(m, limits));
    }
}

/// Momentum: one particle and the eight of cluster c. @param weights  P_i B_i + P_k B_k
FN void visit_force(const Self *self, const Arrays *other, size_t c, const SweepConstants k,
                    Symmetric weights, bool viscous, bool reacts, Lanes sum[3])
{
    Offset d = offset_to(self, &other->octet[c]);
    Lanes r2 = offset_square(d);
    Lanes slope = kernel_slope(pair_closeness(lane_sqrt(r2), k.per_support)), drag = lanes_all(0);
    if (viscous)
        drag = -slope * k.viscosity * pair_approach(r2, approach_of(self, &other->octet[c], d), k);
    Lanes x = slope * (weights.xx * d.x + weights.xy * d.y + weights.xz * d.z) + drag * d.x;
    Lanes y = slope * (weights.xy * d.x + weights.yy * d.y + weights.yz * d.z) + drag * d.y;
    Lanes z = slope * (weights.xz * d.x + weights.yz * d.y + weights.zz * d.z) + drag * d.z;
    sum[0] += x;
    sum[1] += y;
    sum[2] += z;
    const Offset force = {x, y, z};
    if (reacts) react(other, c, lanes_all(1), force);
}

FN Symmetric fluid_weights(const Self *self, Symmetric own, const Arrays *fluid, const Terms *terms,
                           size_t c)
{
    return gradient_weigh(self->pressure, own, lanes_load(fluid->octet[c].pressure),
                          terms_load(terms, c * CLUSTER));
}

/// A dummy has the correction of the particle it meets.
FN Symmetric wall_weights(const Self *self, Symmetric own, const Arrays *walls, size_t c)
{
    return gradient_weigh(self->pressure, own, lanes_load(walls->octet[c].pressure), own);
}

FN void force_of_particle(const Sweep *sweep, const Arrays *fluid, const Terms *terms, int i, int l,
                          bool viscous)
{
    const SweepConstants k = sweep->constants;
    const Self self = self_of(fluid, i * CLUSTER + l);
    const Symmetric own = terms_own(terms, i * CLUSTER + l);
    Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
    Visits visits = visits_of(sweep->fluid_fluid, i, l);
    for (size_t c; visits_next(&visits, &c);)
        visit_force(&self, fluid, c, k, fluid_weights(&self, own, fluid, terms, c), viscous, true,
                    sum);
    const size_t same = (size_t)i;
    visit_force(&self, fluid, same, k, fluid_weights(&self, own, fluid, terms, same), viscous,
                false, sum);
    for (int set = 0; set < 2; set++) {
        if (!has_walls(sweep, set, i)) continue;
        const Arrays walls = arrays_of(sweep->walls[set]);
        visits = visits_of(sweep->fluid_wall[set], i, l);
        for (size_t c; visits_next(&visits, &c);)
            visit_force(&self, &walls, c, k, wall_weights(&self, own, &walls, c), false, false,
                        sum);
    }
    for (int a = 0; a < 3; a++)
        fluid->rate[a][i * CLUSTER + l] += lanes_total(sum[a]);
}

FN void forces_of_clusters(const Sweep *sweep, int begin, int end, bool viscous)
{
    const Arrays fluid = arrays_of(sweep->fluid);
    const Terms terms = terms_of(sweep->fluid->correction);
    for (int i = begin; i < end; i++)
        for (int l = 0; l < CLUSTER; l++)
            if (sweep->fluid->id[i * CLUSTER + l] >= 0)
                force_of_particle(sweep, &fluid, &terms, i, l, viscous);
}

void AT_KERNEL(gradient_plain)(const Sweep *sweep, int begin, int end)
{
    forces_of_clusters(sweep, begin, end, false);
}
void AT_KERNEL(gradient_viscous)(const Sweep *sweep, int begin, int end)
{
    forces_of_clusters(sweep, begin, end, true);
}

/// What water pushes a dummy with is what the dummy pushes it with.
void AT_KERNEL(gradient_loads)(const Sweep *sweep, int begin, int end)
{
    ParticleSet *wall = sweep->walls[1];
    const SweepConstants k = sweep->constants;
    const Arrays walls = arrays_of(wall), fluid = arrays_of(sweep->fluid);
    const Terms terms = terms_of(sweep->fluid->correction);
    for (int slot = begin * CLUSTER; slot < end * CLUSTER; slot++) {
        int i = slot / CLUSTER, id = wall->id[slot];
        Lanes sum[3] = {lanes_all(0), lanes_all(0), lanes_all(0)};
        if (id >= 0 && sweep->moving_owner[id] >= 0 && sweep->wall_fluid[1]->count[i]) {
            const Self self = self_of(&walls, slot);
            Visits visits = visits_of(sweep->wall_fluid[1], i, slot % CLUSTER);
            for (size_t c; visits_next(&visits, &c);)
                visit_force(&self, &fluid, c, k,
                            wall_weights(&self, terms_load(&terms, c * CLUSTER), &fluid, c), false,
                            false, sum);
        }
        for (int a = 0; a < 3; a++)
            wall->rate[a][slot] = lanes_total(sum[a]);
    }
}
