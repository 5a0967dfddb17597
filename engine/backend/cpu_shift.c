/// Particle shifting (physics/shift.h): sums over all neighbours, then the velocities they make.
/// Compiled once per instruction level (sweep.h).
#include "backend/visits.h"
#include "physics/shift.h"

typedef struct ShiftSums {
    Lanes sum[SHIFT_SUMS];
} ShiftSums;

/// One particle and the eight of cluster c. @param react  where their share goes, NULL: nowhere
FN void visit_shift(const Self *self, const Arrays *other, size_t c, float per_support,
                    float *const *react, ShiftSums *own)
{
    Offset d = offset_to(self, &other->octet[c]);
    Lanes r2 = offset_square(d), scale = lanes_all(per_support);
    Lanes slope = kernel_slope(pair_closeness(lane_sqrt(r2), per_support));
    const Lanes part[SHIFT_SUMS] = {slope * scale * d.x, slope * scale * d.y, slope * scale * d.z,
                                    slope * scale * scale * r2};
    for (int k = 0; k < SHIFT_SUMS; k++)
        own->sum[k] += part[k];
    if (!react) return;
    const size_t base = c * CLUSTER;
    for (int k = 0; k < 3; k++)
        lanes_store(react[k] + base, lanes_load(react[k] + base) - part[k]);
    lanes_store(react[3] + base, lanes_load(react[3] + base) + part[3]);
}

FN void sums_of_particle(const Sweep *sweep, const Arrays *fluid, float *const shift[SHIFT_SUMS],
                         int i, int l)
{
    const float per_support = sweep->constants.per_support;
    const Self self = self_of(fluid, i * CLUSTER + l);
    ShiftSums own = {{lanes_all(0), lanes_all(0), lanes_all(0), lanes_all(0)}};
    Visits visits = visits_of(sweep->fluid_fluid, i, l);
    for (size_t c; visits_next(&visits, &c);)
        visit_shift(&self, fluid, c, per_support, shift, &own);
    visit_shift(&self, fluid, (size_t)i, per_support, NULL, &own);
    for (int set = 0; set < 2; set++) {
        if (!has_walls(sweep, set, i)) continue;
        const Arrays walls = arrays_of(sweep->walls[set]);
        visits = visits_of(sweep->fluid_wall[set], i, l);
        for (size_t c; visits_next(&visits, &c);)
            visit_shift(&self, &walls, c, per_support, NULL, &own);
    }
    for (int k = 0; k < SHIFT_SUMS; k++)
        shift[k][i * CLUSTER + l] += lanes_total(own.sum[k]);
}

void AT_KERNEL(shift_sums)(const Sweep *sweep, int begin, int end)
{
    const Arrays fluid = arrays_of(sweep->fluid);
    float *shift[SHIFT_SUMS];
    memcpy(shift, sweep->fluid->shift, sizeof shift);
    for (int i = begin; i < end; i++)
        for (int l = 0; l < CLUSTER; l++)
            if (sweep->fluid->id[i * CLUSTER + l] >= 0)
                sums_of_particle(sweep, &fluid, shift, i, l);
}

void AT_KERNEL(shift_velocities)(const Sweep *sweep, int begin, int end)
{
    const Arrays fluid = arrays_of(sweep->fluid);
    float *shift[SHIFT_SUMS];
    memcpy(shift, sweep->fluid->shift, sizeof shift);
    for (size_t base = (size_t)begin * CLUSTER; base < (size_t)end * CLUSTER; base += CLUSTER) {
        Lanes x = lanes_load(shift[0] + base), y = lanes_load(shift[1] + base),
              z = lanes_load(shift[2] + base);
        const Octet *own = &fluid.octet[base / CLUSTER];
        Lanes u = lanes_load(own->velocity[0]), v = lanes_load(own->velocity[1]),
              w = lanes_load(own->velocity[2]);
        Lanes factor = shift_factor(x * x + y * y + z * z, lanes_load(shift[3] + base),
                                    u * u + v * v + w * w, sweep->shift);
        lanes_store(shift[0] + base, factor * x);
        lanes_store(shift[1] + base, factor * y);
        lanes_store(shift[2] + base, factor * z);
    }
}
