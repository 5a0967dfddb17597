/// The CPU backend's integration: kick, half drift, density, half drift; dummies on their paths.
/// Compiled without -ffinite-math-only: this is where not-a-numbers are caught.
#include <math.h>
#include <string.h>

#include "backend/cpu.h"
#include "physics/fluid.h"

enum { BLOCK = 256 }; ///< slots handled together: fits the first-level cache

static int block_end(const ParticleSet *set, int begin)
{
    int end = set->cluster_count * CLUSTER;
    return begin + BLOCK < end ? begin + BLOCK : end;
}

void cpu_update_pressure(Backend *b)
{
    ParticleSet *f = &b->fluid;
    float tait = b->sweep.tait_b, rho0 = b->sweep.rest_density;
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int i = 0; i < f->cluster_count * CLUSTER; i++) {
        float rho = rho0 * (1.0f + f->field[EXCESS][i]);
        f->pressure[i] = tait_pressure(f->field[EXCESS][i], tait) / (rho * rho);
    }
}

static void block_dynamic(const Backend *b, ParticleSet *f, int begin, int end)
{
    float tait = b->sweep.tait_b, unit = b->sweep.unit;
    float weight = (float)(b->setup.rest_density * b->setup.gravity);
    float surface = (float)(b->setup.level - b->grid.origin[2]);
    for (int i = begin; i < end; i++) {
        float below = surface - unit * (float)f->position[2][i];
        float at_rest = tait_excess(weight * below, tait);
        f->dynamic[i] = f->id[i] >= 0 ? f->field[EXCESS][i] - at_rest : 0.0f;
    }
}

void cpu_update_dynamic(Backend *b)
{
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int begin = 0; begin < b->fluid.cluster_count * CLUSTER; begin += BLOCK)
        block_dynamic(b, &b->fluid, begin, block_end(&b->fluid, begin));
}

static void block_kick(const Backend *b, ParticleSet *f, int begin, int end, float dt)
{
    float factor = dt * b->sweep.constants.acceleration_factor;
    for (int a = 0; a < 3; a++) {
        float *v = f->field[VELOCITY_X + a], *rate = f->rate[a], fall = dt * b->sweep.gravity[a];
        for (int i = begin; i < end; i++)
            v[i] += f->id[i] >= 0 ? factor * rate[i] + fall : 0.0f;
    }
    if (b->setup.dimensions == 2)
        memset(f->field[VELOCITY_Y] + begin, 0, sizeof(float) * (size_t)(end - begin));
}

/// Distance from the nearest side of the zone, less its width: negative inside the zone [m].
static float zone_depth(const RelaxationZone *zone, float x, float y)
{
    float d = minf(x - (float)zone->side_min[0], (float)zone->side_max[0] - x);
    float e = minf(y - (float)zone->side_min[1], (float)zone->side_max[1] - y);
    return minf(d, e) - (float)zone->width;
}

/// Draw velocities in the zone towards their target: weight q^2, q = 1 - distance/width.
static void block_relax(const Backend *b, ParticleSet *f, int begin, int end,
                        const Advance *advance, float dt)
{
    const RelaxationZone *zone = &advance->zone;
    float x[BLOCK], y[BLOCK], z[BLOCK], u[BLOCK], v[BLOCK], w[BLOCK], share[BLOCK];
    int slot[BLOCK], count = 0;
    for (int i = begin; i < end; i++) {
        if (f->id[i] < 0) continue;
        float px = (float)to_metres(&b->grid, 0, f->position[0][i]);
        float py = (float)to_metres(&b->grid, 1, f->position[1][i]);
        float inside = zone_depth(zone, px, py);
        if (inside >= 0) continue;
        float q = -inside / (float)zone->width;
        float p = minf(1.0f, q) * minf(1.0f, q) * dt / (float)zone->time_scale;
        x[count] = px;
        y[count] = py;
        z[count] = (float)to_metres(&b->grid, 2, f->position[2][i]);
        share[count] = 1.0f - expf(-p);
        slot[count++] = i;
    }
    if (!count) return;
    if (zone->target) {
        zone->target(advance->waves, advance->time + 0.5 * advance->dt, count, x, y, z, u, v, w);
    } else {
        memset(u, 0, sizeof u);
        memset(v, 0, sizeof v);
        memset(w, 0, sizeof w);
    }
    for (int k = 0; k < count; k++) {
        f->field[VELOCITY_X][slot[k]] += share[k] * (u[k] - f->field[VELOCITY_X][slot[k]]);
        f->field[VELOCITY_Y][slot[k]] += share[k] * (v[k] - f->field[VELOCITY_Y][slot[k]]);
        f->field[VELOCITY_Z][slot[k]] += share[k] * (w[k] - f->field[VELOCITY_Z][slot[k]]);
    }
}

static void block_drift(const Backend *b, ParticleSet *f, int begin, int end, float dt)
{
    float scale = (float)(dt / b->grid.unit);
    for (int a = 0; a < 3; a++) {
        int32_t *p = f->position[a];
        float *v = f->field[VELOCITY_X + a];
        for (int i = begin; i < end; i++) {
            float step = v[i] * scale;
            // an insane step must not overflow the conversion; health finds the particle
            step = step > 5e8f ? 5e8f : (step < -5e8f ? -5e8f : step);
            int32_t whole = (int32_t)(step + (step < 0 ? -0.5f : 0.5f));
            int32_t moved = p[i] + whole;
            // what flew over a wall comes to rest at the room's end, out of everybody's reach
            if (moved < 0 || moved > COORDINATE_END - 1) {
                moved = moved < 0 ? 0 : COORDINATE_END - 1;
                v[i] = 0;
            }
            p[i] = f->id[i] >= 0 ? moved : PADDING;
        }
    }
}

/// The last barrier at fixed planes: a jet one particle thin carries no pressure that dummies could
/// extrapolate, and would seep through. What is up to two spacings behind a plane goes back onto it
/// and loses its speed into it; what flew over the walls stays out.
static void block_barrier(const Backend *b, ParticleSet *f, int begin, int end)
{
    for (int a = 0; a < 3; a++) {
        int32_t *p = f->position[a];
        const int32_t *z = f->position[2];
        float *v = f->field[VELOCITY_X + a];
        int32_t low = b->barrier_min[a], high = b->barrier_max[a], deep = b->barrier_depth;
        for (int i = begin; i < end; i++) {
            if (f->id[i] < 0 || z[i] > b->barrier_top) continue;
            if (p[i] < low && p[i] > low - deep) {
                p[i] = low;
                v[i] = maxf(v[i], 0);
            } else if (p[i] > high && p[i] < high + deep) {
                p[i] = high;
                v[i] = minf(v[i], 0);
            }
        }
    }
}

/// Where moving dummies are to be at the end of the step, into spare_position (world metres →
/// units).
static void block_targets(Backend *b, const Advance *advance, int begin, int end)
{
    ParticleSet *m = &b->moving;
    Vec3 mean[BLOCK], place[BLOCK];
    double then = advance->time + advance->dt;
    for (int owner = OWNER_PISTON; owner <= OWNER_RING; owner++) {
        MovePoints move = owner == OWNER_RING ? advance->ring : advance->piston;
        int slot[BLOCK], count = 0;
        for (int i = begin; i < end; i++) {
            if (m->id[i] < 0 || b->moving_owner[m->id[i]] != owner) continue;
            mean[count] = b->moving_reference[m->id[i]];
            slot[count++] = i;
        }
        if (!count || !move) continue;
        move(advance->waves, then, count, mean, place);
        for (int k = 0; k < count; k++) {
            m->spare_position[0][slot[k]] = to_coordinate(&b->grid, 0, place[k].x);
            m->spare_position[1][slot[k]] = to_coordinate(&b->grid, 1, place[k].y);
            m->spare_position[2][slot[k]] = to_coordinate(&b->grid, 2, place[k].z);
        }
    }
    for (int i = begin; i < end; i++) {
        if (m->id[i] < 0 || b->moving_owner[m->id[i]] < 0) continue;
        const BodyPose *pose = &advance->poses[b->moving_owner[m->id[i]]];
        Vec3 at =
            vec3_add(pose->origin, quat_rotate(pose->attitude, b->moving_reference[m->id[i]]));
        m->spare_position[0][i] = to_coordinate(&b->grid, 0, at.x);
        m->spare_position[1][i] = to_coordinate(&b->grid, 1, at.y);
        m->spare_position[2][i] = to_coordinate(&b->grid, 2, at.z);
    }
}

/// Velocity from the path's chord, half of the way, and the acceleration for the next
/// extrapolation.
static float block_move_halfway(Backend *b, double dt, int begin, int end)
{
    ParticleSet *m = &b->moving;
    float speed2[BLOCK] = {0}, scale = (float)(b->grid.unit / dt);
    for (int a = 0; a < 3; a++) {
        for (int i = begin; i < end; i++) {
            if (m->id[i] < 0) continue;
            int32_t from = m->position[a][i], to = m->spare_position[a][i];
            float v = (float)(to - from) * scale, old = m->field[VELOCITY_X + a][i];
            m->field[WALL_ACCELERATION_X + a][i] = b->first_step ? 0.0f : (v - old) / (float)dt;
            m->field[VELOCITY_X + a][i] = v;
            m->position[a][i] = from + (to - from) / 2;
            speed2[i - begin] += v * v;
        }
    }
    float largest = 0;
    for (int i = 0; i < end - begin; i++)
        largest = maxf(largest, speed2[i]);
    return largest;
}

static float move_dummies_halfway(Backend *b, const Advance *advance)
{
    float largest = 0;
    int slots = b->moving.cluster_count * CLUSTER;
#pragma omp parallel for schedule(static) num_threads(b->setup.threads) reduction(max : largest)
    for (int begin = 0; begin < slots; begin += BLOCK) {
        int end = block_end(&b->moving, begin);
        block_targets(b, advance, begin, end);
        largest = maxf(largest, block_move_halfway(b, advance->dt, begin, end));
        set_boxes(&b->moving, begin / CLUSTER, end / CLUSTER);
    }
    b->first_step = false;
    return sqrtf(largest);
}

static void finish_dummies(Backend *b)
{
    ParticleSet *m = &b->moving;
    int slots = m->cluster_count * CLUSTER;
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < slots; i++)
            if (m->id[i] >= 0) m->position[a][i] = m->spare_position[a][i];
}

void cpu_place(Backend *b, const Advance *advance)
{
    for (int begin = 0; begin < b->moving.cluster_count * CLUSTER; begin += BLOCK)
        block_targets(b, advance, begin, block_end(&b->moving, begin));
    finish_dummies(b);
    b->sorted = false;
}

/// New density, second half drift, pressure; what health wants to know about the block.
static void block_finish(Backend *b, int begin, int end, float dt, ParticleSums *sums)
{
    ParticleSet *f = &b->fluid;
    float factor = dt * b->sweep.constants.density_factor;
    float tait = b->sweep.tait_b, rho0 = b->sweep.rest_density;
    float *excess = f->field[EXCESS];
    const float floor = b->excess_floor;
    for (int i = begin; i < end; i++) {
        float next = excess[i] + (f->id[i] >= 0 ? factor * f->rate[0][i] : 0.0f);
        excess[i] = next < floor ? floor : next;
    }
    block_drift(b, f, begin, end, 0.5f * dt);
    block_barrier(b, f, begin, end);
    for (int i = begin; i < end; i++) {
        float rho = rho0 * (1.0f + excess[i]);
        f->pressure[i] = tait_pressure(excess[i], tait) / (rho * rho);
    }
    for (int i = begin; i < end; i++) {
        if (f->id[i] < 0) continue;
        float u = f->field[VELOCITY_X][i], v = f->field[VELOCITY_Y][i], w = f->field[VELOCITY_Z][i];
        double speed2 = (double)u * u + (double)v * v + (double)w * w;
        if (!(speed2 < 1e12) || !(fabsf(excess[i]) < 10)) sums->sick = f->id[i];
        sums->largest_speed = maxd(sums->largest_speed, speed2);
        sums->smallest_excess = mind(sums->smallest_excess, excess[i]);
        sums->largest_excess = maxd(sums->largest_excess, excess[i]);
        bool lost = false;
        for (int a = 0; a < 3; a++)
            lost = lost || f->position[a][i] < b->inside_min[a] ||
                   f->position[a][i] > b->inside_max[a];
        sums->lost_count += lost;
    }
}

static ParticleSums no_sums(void)
{
    ParticleSums sums;
    sums.largest_speed = 0;
    sums.smallest_excess = 1e30;
    sums.largest_excess = -1e30;
    sums.sick = -1;
    sums.lost_count = 0;
    return sums;
}

static void merge_sums(ParticleSums *total, const ParticleSums *part)
{
    total->largest_speed = maxd(total->largest_speed, part->largest_speed);
    total->smallest_excess = mind(total->smallest_excess, part->smallest_excess);
    total->largest_excess = maxd(total->largest_excess, part->largest_excess);
    total->sick = part->sick > total->sick ? part->sick : total->sick;
    total->lost_count += part->lost_count;
}

static void finish_fluid(Backend *b, float dt, ParticleSums *sums)
{
    *sums = no_sums();
    int slots = b->fluid.cluster_count * CLUSTER;
#pragma omp parallel num_threads(b->setup.threads)
    {
        ParticleSums own = no_sums();
#pragma omp for schedule(static)
        for (int begin = 0; begin < slots; begin += BLOCK)
            block_finish(b, begin, block_end(&b->fluid, begin), dt, &own);
#pragma omp critical
        merge_sums(sums, &own);
    }
    sums->largest_speed = sqrt(sums->largest_speed);
}

void cpu_advance(Backend *b, const Advance *advance, ParticleSums *sums)
{
    double start = cpu_clock(), now;
#define LAP(which) (now = cpu_clock(), b->clock[which] += now - start, start = now)
    float dt = (float)advance->dt;
    int slots = b->fluid.cluster_count * CLUSTER, threads = b->setup.threads;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int begin = 0; begin < slots; begin += BLOCK)
        block_kick(b, &b->fluid, begin, block_end(&b->fluid, begin), dt);
    LAP(CLOCK_INTEGRATE);
    if (advance->zone.width > 0) {
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads)
        for (int begin = 0; begin < slots; begin += BLOCK)
            block_relax(b, &b->fluid, begin, block_end(&b->fluid, begin), advance, dt);
        LAP(CLOCK_ZONE);
    }
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int begin = 0; begin < slots; begin += BLOCK) {
        int end = block_end(&b->fluid, begin);
        block_drift(b, &b->fluid, begin, end, 0.5f * dt);
        block_dynamic(b, &b->fluid, begin, end);
        memset(b->fluid.rate[0] + begin, 0, (size_t)(end - begin) * sizeof(float));
        set_boxes(&b->fluid, begin / CLUSTER, end / CLUSTER);
    }
    LAP(CLOCK_INTEGRATE);
    float dummy_speed = b->moving.count ? move_dummies_halfway(b, advance) : 0;
    LAP(CLOCK_DUMMIES);
    cpu_sweep_fluid(b, b->table->density[(b->setup.pair_mask & PAIR_DIFFUSION) != 0]);
    LAP(CLOCK_DENSITY);
    finish_fluid(b, dt, sums);
    if (b->moving.count) finish_dummies(b);
    double travel = sums->largest_speed * advance->dt, dummies = dummy_speed * advance->dt;
    b->travel_fluid += travel;
    b->travel_moving += dummies;
    b->step_travel = travel + maxd(travel, dummies);
    LAP(CLOCK_INTEGRATE);
#undef LAP
}
