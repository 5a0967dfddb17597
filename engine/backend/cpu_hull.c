/// Water that comes behind a body's skin swims back. Dummies carry the water's pressure, so what
/// squeezes between them alone meets no resistance: a sphere of eight spacings in the radius that
/// heaved took in 28 particles, and sank by half a spacing.
#include <math.h>
#include <string.h>

#include "backend/cpu.h"

/// Depth behind the skin that water may have: notches of a hull's lattice are as deep [spacings].
static const double DEEPEST = 0.25;

bool hulls_create(Backend *b, Arena *arena, Error *error)
{
    size_t count = (size_t)b->setup.body_count;
    TRY(b->hulls = arena_take(arena, count, sizeof(HullHold), "hulls", error));
    for (int k = 0; k < b->setup.body_count; k++) {
        b->hulls[k].min = vec3(INFINITY, INFINITY, INFINITY);
        b->hulls[k].max = vec3(-INFINITY, -INFINITY, -INFINITY);
        b->hulls[k].pose.attitude = quat(1, 0, 0, 0);
    }
    for (int i = 0; i < b->moving.count; i++) {
        if (b->moving_owner[i] < 0) continue;
        HullHold *hull = &b->hulls[b->moving_owner[i]];
        Vec3 p = b->moving_reference[i];
        double half = 0.5 * b->setup.spacing; // from the outermost dummies to the skin
        hull->min = vec3(mind(hull->min.x, p.x - half), mind(hull->min.y, p.y - half),
                         mind(hull->min.z, p.z - half));
        hull->max = vec3(maxd(hull->max.x, p.x + half), maxd(hull->max.y, p.y + half),
                         maxd(hull->max.z, p.z + half));
    }
    return true;
}

static double skin(const Backend *b, const Advance *advance, int body, Vec3 at)
{
    if (b->setup.dimensions == 2) at.y = 0;
    return advance->skin(advance->hulls, body, at);
}

/// Out of the hull, in its axes: gradient of the distance over a spacing.
static Vec3 outwards(const Backend *b, const Advance *advance, int body, Vec3 at)
{
    double half = 0.5 * b->setup.spacing, d[3] = {0, 0, 0};
    for (int a = 0; a < 3; a++) {
        if (a == 1 && b->setup.dimensions == 2) continue;
        Vec3 side = vec3(a == 0 ? half : 0, a == 1 ? half : 0, a == 2 ? half : 0);
        d[a] =
            skin(b, advance, body, vec3_add(at, side)) - skin(b, advance, body, vec3_sub(at, side));
    }
    Vec3 n = vec3(d[0], d[1], d[2]);
    double size = vec3_norm(n);
    return vec3_scale(n, size > 0 ? 1 / size : 0);
}

/// Whole quanta, so that sums do not depend on the order in which threads add.
static void add_quanta(int64_t *sum, double value, double quantum)
{
    int64_t whole = llround(value / quantum);
#pragma omp atomic
    *sum += whole;
}

static double impulse_quantum(const Backend *b)
{
    return b->setup.particle_mass * b->setup.sound_speed * 0x1p-36;
}

static void hold_particle(Backend *b, const Advance *advance, int body, int slot)
{
    const BodyPose *now = &advance->poses[body];
    HullHold *hull = &b->hulls[body];
    ParticleSet *f = &b->fluid;
    Vec3 place = place_of(&b->grid, f, slot);
    Vec3 arm = vec3_sub(place, now->origin);
    Vec3 at = quat_rotate(quat_conjugate(now->attitude), arm);
    if (at.x < hull->min.x || at.x > hull->max.x || at.y < hull->min.y || at.y > hull->max.y ||
        at.z < hull->min.z || at.z > hull->max.z)
        return;
    double behind = -skin(b, advance, body, at);
    if (behind < DEEPEST * b->setup.spacing) return;
    Vec3 out = quat_rotate(now->attitude, outwards(b, advance, body, at));
    Vec3 before = vec3_add(hull->pose.origin, quat_rotate(hull->pose.attitude, at));
    Vec3 v = vec3((double)*velocity_of(f, 0, slot), (double)*velocity_of(f, 1, slot),
                  (double)*velocity_of(f, 2, slot));
    Vec3 relative = vec3_mad(v, vec3_sub(place, before), -1 / advance->dt);
    double gain = speed_back(b, behind, advance->dt) - vec3_dot(relative, out);
    if (gain <= 0) return;
    v = vec3_mad(v, out, gain);
    *velocity_of(f, 0, slot) = (float)v.x;
    *velocity_of(f, 1, slot) = (float)v.y;
    *velocity_of(f, 2, slot) = (float)v.z;
    Vec3 given = vec3_scale(out, -gain * b->setup.particle_mass), moment = vec3_cross(arm, given);
    double quantum = impulse_quantum(b), turn = quantum * b->setup.spacing;
    add_quanta(&hull->impulse[0], given.x, quantum);
    add_quanta(&hull->impulse[1], given.y, quantum);
    add_quanta(&hull->impulse[2], given.z, quantum);
    add_quanta(&hull->impulse[3], moment.x, turn);
    add_quanta(&hull->impulse[4], moment.y, turn);
    add_quanta(&hull->impulse[5], moment.z, turn);
}

/// Box around a hull in the world, with coordinates low … high [unit].
static void hull_box(const Backend *b, const BodyPose *pose, const HullHold *hull, int32_t low[3],
                     int32_t high[3])
{
    Vec3 min = vec3(INFINITY, INFINITY, INFINITY), max = vec3_scale(min, -1);
    for (int k = 0; k < 8; k++) {
        Vec3 corner = vec3(k & 1 ? hull->max.x : hull->min.x, k & 2 ? hull->max.y : hull->min.y,
                           k & 4 ? hull->max.z : hull->min.z);
        Vec3 p = vec3_add(pose->origin, quat_rotate(pose->attitude, corner));
        min = vec3(mind(min.x, p.x), mind(min.y, p.y), mind(min.z, p.z));
        max = vec3(maxd(max.x, p.x), maxd(max.y, p.y), maxd(max.z, p.z));
    }
    double lows[3] = {min.x, min.y, min.z}, highs[3] = {max.x, max.y, max.z};
    for (int a = 0; a < 3; a++) {
        low[a] = to_coordinate(&b->grid, a, lows[a]);
        high[a] = to_coordinate(&b->grid, a, highs[a]);
    }
}

static int row_of(int32_t coordinate, int32_t row, int count)
{
    int at = coordinate < 0 ? 0 : coordinate / row;
    return at < count ? at : count - 1;
}

static void hold_row(Backend *b, const Advance *advance, int body, int row, const int32_t low[3],
                     const int32_t high[3])
{
    const ParticleSet *f = &b->fluid;
    for (int i = f->row_begin[row] * CLUSTER; i < f->row_begin[row + 1] * CLUSTER; i++) {
        bool near = f->id[i] >= 0;
        for (int a = 0; a < 3; a++) {
            int32_t at = *position_of(f, a, i);
            near = near && at >= low[a] && at <= high[a];
        }
        if (near) hold_particle(b, advance, body, i);
    }
}

void hulls_hold(Backend *b, const Advance *advance, double fastest)
{
    const Grid *grid = &b->grid;
    b->strayed += fastest * advance->dt;
    int32_t strayed = (int32_t)mind(b->strayed / grid->unit, 0.5 * COORDINATE_END);
    for (int body = 0; body < b->setup.body_count; body++) {
        int32_t low[3], high[3];
        hull_box(b, &advance->poses[body], &b->hulls[body], low, high);
        int across = row_of(low[grid->across] - strayed, grid->row, grid->across_rows);
        int across_end = row_of(high[grid->across] + strayed, grid->row, grid->across_rows) + 1;
        int slab = row_of(low[grid->slab] - strayed, grid->row, grid->slab_rows);
        int slab_end = row_of(high[grid->slab] + strayed, grid->row, grid->slab_rows) + 1;
#pragma omp parallel for collapse(2) schedule(dynamic, 4) num_threads(b->setup.threads)
        for (int s = slab; s < slab_end; s++)
            for (int c = across; c < across_end; c++)
                hold_row(b, advance, body, s * grid->across_rows + c, low, high);
        b->hulls[body].pose = advance->poses[body];
    }
}

void hulls_give(Backend *b, const Vec3 *about, BodyLoad *loads)
{
    double force = impulse_quantum(b) / b->last_step, moment = force * b->setup.spacing;
    for (int body = 0; body < b->setup.body_count && b->last_step > 0; body++) {
        HullHold *hull = &b->hulls[body];
        const int64_t *sum = hull->impulse;
        Vec3 f = vec3(force * (double)sum[0], force * (double)sum[1], force * (double)sum[2]);
        Vec3 m = vec3(moment * (double)sum[3], moment * (double)sum[4], moment * (double)sum[5]);
        Vec3 arm = vec3_sub(hull->pose.origin, about[body]);
        loads[body].force = vec3_add(loads[body].force, f);
        loads[body].moment = vec3_add(loads[body].moment, vec3_add(m, vec3_cross(arm, f)));
        memset(hull->impulse, 0, sizeof hull->impulse);
    }
}
