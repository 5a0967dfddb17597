/// The CPU backend's integration: kick, half drift, density, half drift; dummies on their paths.
/// Compiled once per instruction level (sweep.h), without -ffinite-math-only: this is where
/// not-a-numbers are caught.
#include <math.h>
#include <string.h>

#include "backend/cpu.h"
#include "physics/fluid.h"

enum { BLOCK = 256 }; ///< slots handled together: fits the first-level cache

/// The octet of a cluster's first slot.
static Octet *octet_at(const ParticleSet *set, int slot) { return set->octet + slot / CLUSTER; }

static int block_end(const ParticleSet *set, int begin)
{
    int end = set->cluster_count * CLUSTER;
    return begin + BLOCK < end ? begin + BLOCK : end;
}

static void block_pressure(const Backend *b, ParticleSet *f, int begin, int end)
{
    float tait = b->sweep.tait_b, rho0 = b->sweep.rest_density, floor = b->excess_floor;
    for (Octet *o = octet_at(f, begin); o < octet_at(f, end); o++)
#pragma omp simd
        for (int l = 0; l < CLUSTER; l++) {
            float bearing = tension_bearing(o->excess[l], floor);
            float rho = rho0 * (1.0f + bearing);
            o->pressure[l] = tait_pressure(bearing, tait) / (rho * rho);
        }
}

void AT_LEVEL(step_update_pressure)(Backend *b)
{
    ParticleSet *f = &b->fluid;
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int begin = 0; begin < f->cluster_count * CLUSTER; begin += BLOCK)
        block_pressure(b, f, begin, block_end(f, begin));
}

static void block_dynamic(const Backend *b, ParticleSet *f, int begin, int end)
{
    float tait = b->sweep.tait_b, unit = b->sweep.unit;
    float weight = (float)(b->setup.rest_density * b->setup.gravity);
    float surface = (float)(b->setup.level - b->grid.origin[2]);
    float diffusion = b->sweep.constants.diffusion;
    SurfaceExcess near = b->surface;
    for (int c = begin; c < end; c += CLUSTER) {
        const Octet *o = octet_at(f, c);
        const int32_t *id = f->id + c;
        float *dynamic = f->dynamic + c;
#pragma omp simd
        for (int l = 0; l < CLUSTER; l++) {
            float below = surface - unit * (float)o->position[2][l];
            float at_rest = tait_excess(weight * below, tait);
            float bearing = tension_bearing(o->excess[l], b->excess_floor);
            float d = diffusion * (bearing - at_rest - surface_excess(bearing, near));
            dynamic[l] = id[l] >= 0 ? d : 0.0f;
        }
    }
}

void AT_LEVEL(step_update_dynamic)(Backend *b)
{
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int begin = 0; begin < b->fluid.cluster_count * CLUSTER; begin += BLOCK)
        block_dynamic(b, &b->fluid, begin, block_end(&b->fluid, begin));
}

static void block_kick(const Backend *b, ParticleSet *f, int begin, int end, float dt)
{
    float factor = dt * b->sweep.constants.acceleration_factor;
    for (int c = begin; c < end; c += CLUSTER) {
        Octet *o = octet_at(f, c);
        const int32_t *id = f->id + c;
        for (int a = 0; a < 3; a++) {
            const float *rate = f->rate[a] + c;
            float *v = o->velocity[a], fall = dt * b->sweep.gravity[a];
#pragma omp simd
            for (int l = 0; l < CLUSTER; l++)
                v[l] += id[l] >= 0 ? factor * rate[l] + fall : 0.0f;
        }
        if (b->setup.dimensions == 2) memset(o->velocity[1], 0, sizeof o->velocity[1]);
    }
}

/// Distance from the nearest side of the zone, less its width: negative inside the zone [m].
static float zone_depth(const RelaxationZone *zone, float x, float y)
{
    float d = minf(x - (float)zone->side_min[0], (float)zone->side_max[0] - x);
    float e = minf(y - (float)zone->side_min[1], (float)zone->side_max[1] - y);
    return minf(d, e) - (float)zone->width;
}

/// Water that has come a quarter of a spacing behind the ring's face swims back to it within four
/// calls. Pressures alone do not hold the corner between the moving ring and the bed, where what is
/// squeezed finds half a neighbourhood: a steep wave in shallow water (H/L 0.07, kd 0.97, h/dp 2.5)
/// lost one percent in 15 s there. A velocity, not a jump: lists stay good.
/// @param place  of `count` particles in `slot` [m]
static void hold_before_ring(const Backend *b, ParticleSet *f, const Advance *advance, float dt,
                             int count, const float *const place[3], const int *slot)
{
    Vec3 mean[BLOCK], face[BLOCK];
    int who[BLOCK];
    for (int a = 0; a < (b->setup.dimensions == 2 ? 1 : 2); a++) {
        const float low = (float)advance->zone.side_min[a], high = (float)advance->zone.side_max[a];
        int outside = 0;
        for (int k = 0; k < count; k++) {
            float at = place[a][k], side = at < low ? low : high;
            if (at >= low && at <= high) continue;
            mean[outside] = vec3((double)place[0][k], (double)place[1][k], (double)place[2][k]);
            *(a == 0 ? &mean[outside].x : &mean[outside].y) = (double)side;
            mean[outside].x -= advance->carried[0];
            mean[outside].y -= advance->carried[1];
            who[outside++] = k;
        }
        if (!outside) continue;
        advance->ring(advance->waves, advance->time + 0.5 * advance->dt, outside, mean, face);
        for (int n = 0; n < outside; n++) {
            float at = place[a][who[n]], inwards = at < low ? 1.0f : -1.0f;
            float behind = inwards * ((float)(a == 0 ? face[n].x : face[n].y) - at);
            if (behind < 0.25f * (float)b->setup.spacing) continue;
            float back = (float)speed_back(b, (double)behind, (double)dt);
            float *v = velocity_of(f, a, slot[who[n]]);
            if (inwards * *v < back) *v = inwards * back;
        }
    }
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
        float px = (float)to_metres(&b->grid, 0, *position_of(f, 0, i));
        float py = (float)to_metres(&b->grid, 1, *position_of(f, 1, i));
        float inside = zone_depth(zone, px, py);
        if (inside >= 0) continue;
        float q = -inside / (float)zone->width;
        float p = minf(1.0f, q) * minf(1.0f, q) * dt / (float)zone->time_scale;
        x[count] = px;
        y[count] = py;
        z[count] = (float)to_metres(&b->grid, 2, *position_of(f, 2, i));
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
        *velocity_of(f, 0, slot[k]) += share[k] * (u[k] - *velocity_of(f, 0, slot[k]));
        *velocity_of(f, 1, slot[k]) += share[k] * (v[k] - *velocity_of(f, 1, slot[k]));
        *velocity_of(f, 2, slot[k]) += share[k] * (w[k] - *velocity_of(f, 2, slot[k]));
    }
    const float *const place[3] = {x, y, z};
    if (advance->ring) hold_before_ring(b, f, advance, dt, count, place, slot);
}

static void drift_octet(Octet *o, const int32_t *id, int axis, float scale)
{
    int32_t *p = o->position[axis];
    float *v = o->velocity[axis];
#pragma omp simd
    for (int l = 0; l < CLUSTER; l++) {
        float step = v[l] * scale;
        // an insane step must not overflow the conversion; health finds the particle
        step = step > 5e8f ? 5e8f : (step < -5e8f ? -5e8f : step);
        int32_t whole = (int32_t)(step + (step < 0 ? -0.5f : 0.5f));
        int32_t moved = p[l] + whole;
        // what flew over a wall comes to rest at the room's end, out of everybody's reach
        if (moved < 0 || moved > COORDINATE_END - 1) {
            moved = moved < 0 ? 0 : COORDINATE_END - 1;
            v[l] = 0;
        }
        p[l] = id[l] >= 0 ? moved : PADDING;
    }
}

static void block_drift(const Backend *b, ParticleSet *f, int begin, int end, float dt)
{
    float scale = (float)(dt / b->grid.unit);
    for (int c = begin; c < end; c += CLUSTER)
        for (int a = 0; a < 3; a++)
            drift_octet(octet_at(f, c), f->id + c, a, scale);
}

/// What shifting adds to the path of a step's half; padding has no shift.
static void block_shift(const Backend *b, ParticleSet *f, int begin, int end, float dt)
{
    float scale = (float)(dt / b->grid.unit);
    for (int c = begin; c < end; c += CLUSTER)
        for (int a = 0; a < 3; a++) {
            int32_t *p = octet_at(f, c)->position[a];
            const float *shift = f->shift[a] + c;
#pragma omp simd
            for (int l = 0; l < CLUSTER; l++) {
                float step = shift[l] * scale;
                p[l] += (int32_t)(step + (step < 0 ? -0.5f : 0.5f));
            }
        }
}

/// Whether one of the eight is behind a barrier's plane.
static bool octet_beyond(const Backend *b, const Octet *o, const int32_t *id)
{
    int32_t any = 0;
    for (int a = 0; a < 3; a++) {
        const int32_t *p = o->position[a], low = b->barrier_min[a], high = b->barrier_max[a];
#pragma omp simd reduction(| : any)
        for (int l = 0; l < CLUSTER; l++)
            any |= (id[l] >= 0) & ((p[l] < low) | (p[l] > high));
    }
    return any;
}

/// @return whether the particle was put farther than its step took it
static bool hold_at_barrier(const Backend *b, Octet *o, int l, int axis, float scale)
{
    int32_t *p = &o->position[axis][l], low = b->barrier_min[axis], high = b->barrier_max[axis];
    const int32_t deep = b->barrier_depth;
    float *v = &o->velocity[axis][l];
    bool jumped = false;
    if (o->position[2][l] > b->barrier_top) return false;
    if (*p<low && * p> low - deep) {
        jumped = (float)(low - *p) > 2 - scale * *v;
        *p = low;
        *v = maxf(*v, 0);
    } else if (*p > high && *p < high + deep) {
        jumped = (float)(*p - high) > 2 + scale * *v;
        *p = high;
        *v = minf(*v, 0);
    }
    return jumped;
}

/// The last barrier at fixed planes: a jet one particle thin carries no pressure that dummies could
/// extrapolate, and would seep through. What is up to two spacings behind a plane goes back onto it
/// and loses its speed into it; what flew over the walls stays out.
/// @param dt  since it last looked [s]
/// @return whether a particle was put farther than its step took it: lists may miss its neighbours
static bool block_barrier(const Backend *b, ParticleSet *f, int begin, int end, float dt)
{
    bool jumped = false;
    float scale = (float)(dt / b->grid.unit);
    for (int c = begin; c < end; c += CLUSTER) {
        Octet *o = octet_at(f, c);
        if (!octet_beyond(b, o, f->id + c)) continue;
        for (int l = 0; l < CLUSTER; l++)
            for (int a = 0; a < 3 && f->id[c + l] >= 0; a++)
                jumped = hold_at_barrier(b, o, l, a, scale) || jumped;
    }
    return jumped;
}

/// Where moving dummies are to be at the end of the step, into `target`.
/// @param spent  [2] what the piston and the ring took is added [s]
static void block_targets(Backend *b, const Advance *advance, int begin, int end, double *spent)
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
        double start = cpu_clock();
        move(advance->waves, then, count, mean, place);
        spent[owner - OWNER_PISTON] += cpu_clock() - start;
        for (int k = 0; k < count; k++) {
            m->target[0][slot[k]] = to_coordinate(&b->grid, 0, place[k].x);
            m->target[1][slot[k]] = to_coordinate(&b->grid, 1, place[k].y);
            m->target[2][slot[k]] = to_coordinate(&b->grid, 2, place[k].z);
        }
    }
    for (int i = begin; i < end; i++) {
        if (m->id[i] < 0 || b->moving_owner[m->id[i]] < 0) continue;
        const BodyPose *pose = &advance->poses[b->moving_owner[m->id[i]]];
        Vec3 at =
            vec3_add(pose->origin, quat_rotate(pose->attitude, b->moving_reference[m->id[i]]));
        m->target[0][i] = to_coordinate(&b->grid, 0, at.x);
        m->target[1][i] = to_coordinate(&b->grid, 1, at.y);
        m->target[2][i] = to_coordinate(&b->grid, 2, at.z);
    }
}

/// Velocity from the path's chord, half of the way, and the acceleration for the next
/// extrapolation.
static void block_move_halfway(Backend *b, double dt, int begin, int end)
{
    ParticleSet *m = &b->moving;
    float scale = (float)(b->grid.unit / dt);
    for (int a = 0; a < 3; a++) {
        for (int i = begin; i < end; i++) {
            if (m->id[i] < 0) continue;
            int32_t from = *position_of(m, a, i), to = m->target[a][i];
            float v = (float)(to - from) * scale, old = *velocity_of(m, a, i);
            m->acceleration[a][i] = b->first_step ? 0.0f : (v - old) / (float)dt;
            *velocity_of(m, a, i) = v;
            *position_of(m, a, i) = from + (to - from) / 2;
        }
    }
}

static void move_dummies_halfway(Backend *b, const Advance *advance)
{
    int slots = b->moving.cluster_count * CLUSTER;
    double start = cpu_clock(), piston = 0, ring = 0;
#pragma omp parallel for schedule(static) num_threads(b->setup.threads) reduction(+ : piston, ring)
    for (int begin = 0; begin < slots; begin += BLOCK) {
        int end = block_end(&b->moving, begin);
        double spent[2] = {0, 0};
        block_targets(b, advance, begin, end, spent);
        block_move_halfway(b, advance->dt, begin, end);
        piston += spent[0];
        ring += spent[1];
    }
    b->first_step = false;
    piston /= b->setup.threads;
    ring /= b->setup.threads;
    b->clock[CLOCK_PISTON] += piston;
    b->clock[CLOCK_RING] += ring;
    b->clock[CLOCK_DUMMIES] += cpu_clock() - start - piston - ring;
}

static void finish_dummies(Backend *b)
{
    ParticleSet *m = &b->moving;
    int slots = m->cluster_count * CLUSTER;
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < slots; i++)
            if (m->id[i] >= 0) *position_of(m, a, i) = m->target[a][i];
}

void AT_LEVEL(step_place)(Backend *b, const Advance *advance)
{
    double spent[2] = {0, 0}; // not a part of a step
    for (int begin = 0; begin < b->moving.cluster_count * CLUSTER; begin += BLOCK)
        block_targets(b, advance, begin, block_end(&b->moving, begin), spent);
    for (int k = 0; k < b->setup.body_count; k++)
        b->hulls[k].pose = advance->poses[k];
    finish_dummies(b);
    b->sorted = b->boxes_fresh = false;
}

/// New density, second half drift, pressure. @return whether a barrier made a particle jump
static bool block_finish(Backend *b, int begin, int end, float dt)
{
    ParticleSet *f = &b->fluid;
    float factor = dt * b->sweep.constants.density_factor;
    const float least = b->excess_alone;
    for (int c = begin; c < end; c += CLUSTER) {
        float *excess = octet_at(f, c)->excess;
        const float *rate = f->rate[0] + c;
        const int32_t *id = f->id + c;
#pragma omp simd
        for (int l = 0; l < CLUSTER; l++) {
            float next = excess[l] + (id[l] >= 0 ? factor * rate[l] : 0.0f);
            excess[l] = next < least ? least : next;
        }
    }
    block_drift(b, f, begin, end, 0.5f * dt);
    if (EFFECTS_BUILT && f->shift[0]) block_shift(b, f, begin, end, 0.5f * dt);
    bool jumped = block_barrier(b, f, begin, end, dt);
    block_pressure(b, f, begin, end);
    return jumped;
}

/// Sums of a few slots, a lane each, as the compiler can vectorise them: comparisons, no branches.
typedef struct BlockSums {
    float speed2[CLUSTER], low[CLUSTER], high[CLUSTER];
    int32_t lost[CLUSTER], sick[CLUSTER];
} BlockSums;

static void sum_octet(const Backend *b, const Octet *o, const int32_t *id, BlockSums *s)
{
    const float *u = o->velocity[0], *v = o->velocity[1], *w = o->velocity[2], *excess = o->excess;
    const int32_t *x = o->position[0], *y = o->position[1], *z = o->position[2];
    const int32_t *low = b->inside_min, *high = b->inside_max;
#pragma omp simd
    for (int l = 0; l < CLUSTER; l++) {
        float speed2 = u[l] * u[l] + v[l] * v[l] + w[l] * w[l];
        int32_t real = id[l] >= 0;
        int32_t sane = (speed2 < 1e12f) & (excess[l] < 10) & (excess[l] > -10);
        int32_t inside = (x[l] >= low[0]) & (x[l] <= high[0]) & (y[l] >= low[1]) &
                         (y[l] <= high[1]) & (z[l] >= low[2]) & (z[l] <= high[2]);
        s->lost[l] += real & (1 - inside);
        s->sick[l] += real & (1 - sane);
        s->speed2[l] = s->speed2[l] > speed2 ? s->speed2[l] : speed2;
        float bearing = tension_bearing(excess[l], b->excess_floor);
        float least = real ? bearing : 1e30f, most = real ? bearing : -1e30f;
        s->low[l] = s->low[l] < least ? s->low[l] : least;
        s->high[l] = s->high[l] > most ? s->high[l] : most;
    }
}

static BlockSums block_sums(const Backend *b, int begin, int end)
{
    BlockSums s;
    memset(&s, 0, sizeof s);
    for (int l = 0; l < CLUSTER; l++) {
        s.low[l] = 1e30f;
        s.high[l] = -1e30f;
    }
    for (int c = begin; c < end; c += CLUSTER)
        sum_octet(b, octet_at(&b->fluid, c), b->fluid.id + c, &s);
    return s;
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

static void add_block(ParticleSums *total, const BlockSums *block, const ParticleSet *f, int begin,
                      int end)
{
    int32_t sick = 0;
    for (int l = 0; l < CLUSTER; l++) {
        total->largest_speed = maxd(total->largest_speed, block->speed2[l]);
        total->smallest_excess = mind(total->smallest_excess, block->low[l]);
        total->largest_excess = maxd(total->largest_excess, block->high[l]);
        total->lost_count += block->lost[l];
        sick += block->sick[l];
    }
    for (int i = begin; sick && i < end; i++) {
        float u = *velocity_of(f, 0, i), v = *velocity_of(f, 1, i), w = *velocity_of(f, 2, i);
        bool sane = u * u + v * v + w * w < 1e12f && fabsf(*excess_of(f, i)) < 10;
        if (f->id[i] >= 0 && !sane) total->sick = f->id[i] > total->sick ? f->id[i] : total->sick;
    }
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
    bool jumped = false;
#pragma omp parallel num_threads(b->setup.threads) reduction(|| : jumped)
    {
        ParticleSums own = no_sums();
#pragma omp for schedule(static)
        for (int begin = 0; begin < slots; begin += BLOCK) {
            int end = block_end(&b->fluid, begin);
            jumped = block_finish(b, begin, end, dt) || jumped;
            BlockSums block = block_sums(b, begin, end);
            add_block(&own, &block, &b->fluid, begin, end);
        }
#pragma omp critical
        merge_sums(sums, &own);
    }
    sums->largest_speed = sqrt(sums->largest_speed);
    b->boxes_fresh = false;
    if (jumped) b->sorted = false;
}

/// Kick, relaxation and first half drift of one row. @return what the relaxation took [s]
static double kick_row(Backend *b, int row, const Advance *advance)
{
    ParticleSet *f = &b->fluid;
    float dt = (float)advance->dt;
    double zone = 0;
    const bool diffuse = EFFECTS_BUILT && (b->setup.pair_mask & PAIR_DIFFUSION) != 0;
    const bool shifted = EFFECTS_BUILT && f->shift[0];
    const int every = advance->zone.every;
    bool relaxed = EFFECTS_BUILT && advance->zone.width > 0 && (row + advance->step) % every == 0;
    int row_end = f->row_begin[row + 1] * CLUSTER, end;
    for (int begin = f->row_begin[row] * CLUSTER; begin < row_end; begin = end) {
        end = begin + BLOCK < row_end ? begin + BLOCK : row_end;
        block_kick(b, f, begin, end, dt);
        if (relaxed) {
            double start = cpu_clock();
            block_relax(b, f, begin, end, advance, (float)every * dt);
            zone += cpu_clock() - start;
        }
        block_drift(b, f, begin, end, 0.5f * dt);
        if (shifted) block_shift(b, f, begin, end, 0.5f * dt);
        if (diffuse) block_dynamic(b, f, begin, end);
        memset(f->rate[0] + begin, 0, (size_t)(end - begin) * sizeof(float));
    }
    return zone;
}

static void kick_and_drift(Backend *b, const Advance *advance)
{
    double start = cpu_clock(), zone = 0;
#pragma omp parallel for schedule(dynamic, 8) num_threads(b->setup.threads) reduction(+ : zone)
    for (int row = 0; row < b->grid.row_count; row++) {
        zone += kick_row(b, row, advance);
        rows_note_rest(&b->rows, &b->fixed, row);
        rows_note_velocity(&b->rows, &b->fluid, row);
        rows_note_velocity(&b->rows, &b->moving, row);
    }
    b->boxes_fresh = false;
    zone /= b->setup.threads;
    b->clock[CLOCK_ZONE] += zone;
    b->clock[CLOCK_INTEGRATE] += cpu_clock() - start - zone;
}

void AT_LEVEL(step_advance)(Backend *b, const Advance *advance, ParticleSums *sums)
{
    b->last_step = advance->dt;
    if (EFFECTS_BUILT && b->moving.count) move_dummies_halfway(b, advance);
    double start = cpu_clock(), now;
#define LAP(which) (now = cpu_clock(), b->clock[which] += now - start, start = now)
    if (EFFECTS_BUILT && b->setup.works) {
        works_before_kick(b);
        LAP(CLOCK_WORKS);
    }
    kick_and_drift(b, advance);
    start = cpu_clock();
    if (EFFECTS_BUILT && b->setup.works) {
        works_after_kick(b, advance);
        LAP(CLOCK_WORKS);
    }
    rows_measure(&b->rows, &b->grid, b->setup.threads);
    rows_move(&b->rows, &b->grid, 0.5 * advance->dt);
    cpu_prune(b);
    LAP(CLOCK_SORT);
    cpu_sweep_fluid(b, b->table->density[(b->setup.pair_mask & PAIR_DIFFUSION) != 0]);
    LAP(CLOCK_DENSITY);
    if (EFFECTS_BUILT && b->setup.works) {
        works_after_density(b);
        LAP(CLOCK_WORKS);
    }
    finish_fluid(b, (float)advance->dt, sums);
    if (EFFECTS_BUILT && b->moving.count) finish_dummies(b);
    rows_move(&b->rows, &b->grid, 0.5 * advance->dt);
    LAP(CLOCK_INTEGRATE);
    if (EFFECTS_BUILT && advance->skin) {
        // shifts go with the speed before the kick, which may have been the larger one
        double shift = b->fluid.shift[0] ? 2 * (double)SHIFT_MOST : 0;
        hulls_hold(b, advance, (1 + shift) * sums->largest_speed);
        LAP(CLOCK_LOADS);
    }
    if (EFFECTS_BUILT && b->setup.works) {
        works_after_step(b, advance->dt);
        LAP(CLOCK_WORKS);
    }
#undef LAP
}
