/// Reading the CPU backend: snapshots, wave gauges, pressure probes, energies.
#include <math.h>

#include "backend/cpu.h"
#include "physics/fluid.h"

static float pressure_at(const Backend *b, int slot)
{
    return tait_pressure(tension_bearing(*excess_of(&b->fluid, slot), b->excess_floor),
                         b->sweep.tait_b);
}

void cpu_download(Backend *b, float (*position)[3], float (*velocity)[3], float *pressure)
{
    const ParticleSet *f = &b->fluid;
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int i = 0; i < f->cluster_count * CLUSTER; i++) {
        int id = f->id[i];
        if (id < 0) continue;
        for (int a = 0; a < 3; a++) {
            if (position) position[id][a] = (float)to_metres(&b->grid, a, *position_of(f, a, i));
            if (velocity) velocity[id][a] = *velocity_of(f, a, i);
        }
        if (pressure) pressure[id] = pressure_at(b, i);
    }
}

enum { COLUMN_SAMPLES = 64 };

/// Sum of m/rho W at `count` heights z0 + k dz above (x, y).
static void column_colour(const Backend *b, double x, double y, double z0, double dz, int count,
                          double *colour)
{
    const ParticleSet *f = &b->fluid;
    double h = b->setup.smoothing_length, volume = b->setup.particle_mass / b->setup.rest_density;
    double scale = volume * kernel_constant(KERNEL_WENDLAND, h, b->setup.dimensions),
           reach = 2 * h / b->grid.unit;
    int32_t cx = to_coordinate(&b->grid, 0, x), cy = to_coordinate(&b->grid, 1, y);
    for (int k = 0; k < count; k++)
        colour[k] = 0;
    for (int c = 0; c < f->cluster_count; c++) {
        if (f->boxes.min[0][c] > cx + reach || f->boxes.max[0][c] < cx - reach ||
            f->boxes.min[1][c] > cy + reach || f->boxes.max[1][c] < cy - reach)
            continue;
        for (int i = c * CLUSTER; i < (c + 1) * CLUSTER; i++) {
            if (f->id[i] < 0) continue;
            double dx = b->grid.unit * (*position_of(f, 0, i) - cx);
            double dy = b->grid.unit * (*position_of(f, 1, i) - cy);
            if (dx * dx + dy * dy >= 4 * h * h) continue;
            double z = to_metres(&b->grid, 2, *position_of(f, 2, i));
            for (int k = 0; k < count; k++) {
                double d = z0 + k * dz - z, r = sqrt(dx * dx + dy * dy + d * d);
                float s = (float)(1 - r / (2 * h));
                if (s > 0) colour[k] += scale * wendland_value(s);
            }
        }
    }
}

/// Highest particle within one spacing of the column; NAN when there is none.
static double highest_near(const Backend *b, double x, double y)
{
    const ParticleSet *f = &b->fluid;
    double reach = b->setup.spacing / b->grid.unit;
    int32_t cx = to_coordinate(&b->grid, 0, x), cy = to_coordinate(&b->grid, 1, y), top = -1;
    for (int c = 0; c < f->cluster_count; c++) {
        if (f->boxes.min[0][c] > cx + reach || f->boxes.max[0][c] < cx - reach ||
            f->boxes.min[1][c] > cy + reach || f->boxes.max[1][c] < cy - reach)
            continue;
        for (int i = c * CLUSTER; i < (c + 1) * CLUSTER; i++)
            if (f->id[i] >= 0 && fabs((double)*position_of(f, 0, i) - cx) <= reach &&
                fabs((double)*position_of(f, 1, i) - cy) <= reach && *position_of(f, 2, i) > top)
                top = *position_of(f, 2, i);
    }
    return top < 0 ? NAN : to_metres(&b->grid, 2, top);
}

/// A column looked at from above: how much of it was wet so far.
typedef struct Wet {
    double upper;  ///< top of the stretch that is being looked at; NAN in the air [m]
    double clumps; ///< length of all stretches above it [m]
} Wet;

/// Go down through the samples of a window. @return whether solid water was met
static bool look_down(Wet *wet, const double *colour, double z0, double dz, double solid)
{
    if (colour[COLUMN_SAMPLES - 1] >= 0.5 && !isfinite(wet->upper))
        wet->upper = z0 + dz * (COLUMN_SAMPLES - 1); // beside a steeper face than the search allows
    for (int k = COLUMN_SAMPLES - 1; k > 0; k--) {
        double above = colour[k], below = colour[k - 1];
        double z = z0 + dz * (k - 1 + (above == below ? 0 : (below - 0.5) / (below - above)));
        if (above < 0.5 && below >= 0.5) wet->upper = z;
        if (above >= 0.5 && below < 0.5 && isfinite(wet->upper)) {
            wet->clumps += wet->upper - z;
            wet->upper = NAN;
        }
        if (isfinite(wet->upper) && wet->upper - (z0 + dz * (k - 1)) >= solid) return true;
    }
    return false;
}

/// What a wave wire reads: how far it is wet. The colour function sum m/rho W is 1 in the water, 0
/// above, one half at the surface of a lattice whose outermost particles lie dp/2 below it. Four
/// spacings of water, or what stands on the bed, is where the wire is wet from there down; drops,
/// sheets and tongues above add their own length, not the air under them.
double cpu_elevation(Backend *b, double x, double y)
{
    cpu_refresh_boxes(b);
    double colour[COLUMN_SAMPLES], top = highest_near(b, x, y);
    if (!isfinite(top)) return NAN;
    double dp = b->setup.spacing, length = 6 * dp, dz = length / (COLUMN_SAMPLES - 1);
    double bed = isfinite(b->setup.barrier_min[2]) ? b->setup.barrier_min[2] : b->setup.room_min[2];
    Wet wet = {NAN, 0};
    for (double high = top + 2 * dp; high > bed; high -= length) {
        column_colour(b, x, y, high - length, dz, COLUMN_SAMPLES, colour);
        if (look_down(&wet, colour, high - length, dz, 4 * dp)) return wet.upper + wet.clumps;
    }
    if (isfinite(wet.upper)) return wet.upper + wet.clumps;
    return wet.clumps > 0 ? bed + wet.clumps : NAN;
}

/// The water particles around a point, one after another.
typedef struct Near {
    const Backend *backend;
    int32_t at[3]; ///< the point
    int slot;
    Vec3 from;    ///< the point to the particle [m]
    float weight; ///< kernel without its constant [-]
} Near;

static Near near_point(const Backend *b, Vec3 point)
{
    return (Near){.backend = b,
                  .at = {to_coordinate(&b->grid, 0, point.x), to_coordinate(&b->grid, 1, point.y),
                         to_coordinate(&b->grid, 2, point.z)},
                  .slot = -1};
}

static bool cluster_in_reach(const Near *near, int c)
{
    const Boxes *boxes = &near->backend->fluid.boxes;
    double reach = 2 * near->backend->setup.smoothing_length / near->backend->grid.unit;
    for (int a = 0; a < 3; a++)
        if (boxes->min[a][c] > near->at[a] + reach || boxes->max[a][c] < near->at[a] - reach)
            return false;
    return true;
}

/// @return whether there is another one
static bool next_near(Near *near)
{
    const Backend *b = near->backend;
    const ParticleSet *f = &b->fluid;
    while (++near->slot < f->cluster_count * CLUSTER) {
        int i = near->slot;
        if (i % CLUSTER == 0 && !cluster_in_reach(near, i / CLUSTER)) near->slot += CLUSTER - 1;
        if (near->slot != i || f->id[i] < 0) continue;
        near->from = vec3(b->grid.unit * (*position_of(f, 0, i) - near->at[0]),
                          b->grid.unit * (*position_of(f, 1, i) - near->at[1]),
                          b->grid.unit * (*position_of(f, 2, i) - near->at[2]));
        float s = (float)(1 - vec3_norm(near->from) / (2 * b->setup.smoothing_length));
        if (s <= 0) continue;
        near->weight = wendland_value(s);
        return true;
    }
    return false;
}

double cpu_pressure(Backend *b, Vec3 point, Vec3 normal)
{
    cpu_refresh_boxes(b);
    double weight = 0, sum = 0, fall = b->setup.gravity * b->setup.rest_density;
    for (Near near = near_point(b, point); next_near(&near);) {
        if (vec3_dot(near.from, normal) < 0) continue;
        weight += near.weight;
        sum += near.weight * (pressure_at(b, near.slot) + fall * near.from.z);
    }
    return weight > 0 && sum > 0 ? sum / weight : 0;
}

void cpu_velocity(Backend *b, Vec3 point, Vec3 *velocity, double *share)
{
    cpu_refresh_boxes(b);
    double weight = 0, sum[3] = {0, 0, 0};
    for (Near near = near_point(b, point); next_near(&near);) {
        weight += near.weight;
        for (int a = 0; a < 3; a++)
            sum[a] += near.weight * *velocity_of(&b->fluid, a, near.slot);
    }
    double volume = b->setup.particle_mass / b->setup.rest_density;
    *share = weight * volume *
             kernel_constant(KERNEL_WENDLAND, b->setup.smoothing_length, b->setup.dimensions);
    *velocity =
        weight > 0 ? vec3(sum[0] / weight, sum[1] / weight, sum[2] / weight) : vec3(0, 0, 0);
}

/// Add the volume-weighted kernel of each particle of a set to the points from + k step.
static void add_colour(const Backend *b, const ParticleSet *set, Vec3 from, Vec3 step, int count,
                       double *colour)
{
    double h = b->setup.smoothing_length, reach = 2 * h, length = vec3_norm(step);
    double volume = b->setup.particle_mass / b->setup.rest_density;
    double scale = volume * kernel_constant(KERNEL_WENDLAND, h, b->setup.dimensions);
    Vec3 along = vec3_scale(step, 1 / length);
    for (int i = 0; i < set->cluster_count * CLUSTER; i++) {
        if (set->id[i] < 0) continue;
        Vec3 d = vec3_sub(place_of(&b->grid, set, i), from);
        double x = vec3_dot(d, along), across2 = vec3_dot(d, d) - x * x;
        if (across2 >= reach * reach) continue;
        double half = sqrt(reach * reach - maxd(across2, 0));
        int begin = (int)ceil(maxd((x - half) / length, 0));
        int end = (int)floor(mind((x + half) / length, count - 1));
        for (int k = begin; k <= end; k++) {
            double r = sqrt(maxd(across2, 0) + (k * length - x) * (k * length - x));
            float s = (float)(1 - r / reach);
            if (s > 0) colour[k] += scale * wendland_value(s);
        }
    }
}

/// The colour function sum m/rho W is cut off by walls; there it is compared with what they leave.
void cpu_wetness(Backend *b, Vec3 from, Vec3 to, int count, double *share)
{
    enum { PART = 256 };
    double taken[PART];
    Vec3 step = vec3_scale(vec3_sub(to, from), 1.0 / (count > 1 ? count - 1 : 1));
    for (int begin = 0; begin < count; begin += PART) {
        int part = count - begin < PART ? count - begin : PART;
        Vec3 start = vec3_mad(from, step, begin);
        for (int k = 0; k < part; k++)
            taken[k] = share[begin + k] = 0;
        add_colour(b, &b->fluid, start, step, part, share + begin);
        add_colour(b, &b->fixed, start, step, part, taken);
        add_colour(b, &b->moving, start, step, part, taken);
        for (int k = 0; k < part; k++)
            share[begin + k] /= maxd(1 - taken[k], 0.1);
    }
}

void cpu_columns(const Backend *b, const BodyPose *pose, Vec3 min, Vec3 max, const int count[2],
                 double *volume)
{
    const ParticleSet *f = &b->fluid;
    double each = b->setup.particle_mass / b->setup.rest_density;
    for (int k = 0; k < count[0] * count[1]; k++)
        volume[k] = 0;
    for (int i = 0; i < f->cluster_count * CLUSTER; i++) {
        if (f->id[i] < 0) continue;
        Vec3 d = vec3_sub(place_of(&b->grid, f, i), pose->origin);
        Vec3 at = quat_rotate(quat_conjugate(pose->attitude), d);
        bool outside = at.x < min.x || at.x >= max.x || at.z < min.z || at.z >= max.z;
        if (outside || at.y < min.y || at.y >= max.y) continue;
        int x = (int)((at.x - min.x) / (max.x - min.x) * count[0]);
        int y = (int)((at.y - min.y) / (max.y - min.y) * count[1]);
        volume[(y < count[1] ? y : count[1] - 1) * count[0] + (x < count[0] ? x : count[0] - 1)] +=
            each;
    }
}

FluidEnergy cpu_energy(const Backend *b)
{
    const ParticleSet *f = &b->fluid;
    double square = 0, height = 0, elastic = 0;
    for (int i = 0; i < f->cluster_count * CLUSTER; i++) {
        if (f->id[i] < 0) continue;
        for (int a = 0; a < 3; a++)
            square += (double)*velocity_of(f, a, i) * *velocity_of(f, a, i);
        height += to_metres(&b->grid, 2, *position_of(f, 2, i));
        elastic += tait_energy_torn(*excess_of(f, i), b->excess_floor, b->sweep.tait_b,
                                    b->setup.rest_density);
    }
    double mass = b->setup.particle_mass;
    FluidEnergy energy = {0.5 * mass * square, mass * b->setup.gravity * height, mass * elastic};
    return energy;
}
