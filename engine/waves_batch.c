/// The incident wave at many particles at once. Compiled with -fno-trapping-math
/// (engine/CMakeLists.txt): without it gcc keeps the branches of the clamps and does not vectorise,
/// at three times the cost. Harmonics are the outer loop, so that the inner ones are plain.
#include "waves.h"

#include "sea.h"

#include <string.h>

/// Particles are worked on in blocks that stay in the first-level cache.
enum { BLOCK = 64 };

typedef struct PlaceBlock {
    double x[BLOCK], y[BLOCK], z[BLOCK];    ///< mean places
    double along[BLOCK], up[BLOCK];         ///< of one train
    double dx[BLOCK], dy[BLOCK], dz[BLOCK]; ///< of all
    double e[BLOCK], sine[BLOCK], cosine[BLOCK];
    double s[BLOCK], c[BLOCK]; ///< sine and cosine of j theta
} PlaceBlock;

static void place_block_phases(PlaceBlock *RESTRICT b, const WaveTerms *w)
{
    double turns_x = w->turns_x, turns_y = w->turns_y, turns = w->turns;
    // The exponential is a call; the rest is vectorised.
    for (int i = 0; i < BLOCK; i++)
        b->e[i] = exp(w->wave_number * mind(b->z[i] - w->level, 0.0));
    for (int i = 0; i < BLOCK; i++)
        b->up[i] = wave_depth_sum(w->up[0], 0, b->e[i], w->depth_ratio / b->e[i], -1);
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        double at = turns_x * b->x[i] + turns_y * b->y[i] + turns;
        wave_sine_cosine_double(wave_fraction_double(at), &b->sine[i], &b->cosine[i]);
        b->along[i] = 0;
        b->s[i] = 0;
        b->c[i] = 1;
    }
}

/// Adds harmonic j of the orbits.
static void place_block_harmonic(PlaceBlock *RESTRICT b, const WaveTerms *w, int j)
{
    const double a0 = w->along[j][0], a1 = w->along[j][1], a2 = w->along[j][2];
    const double u0 = w->up[j][0], u1 = w->up[j][1], u2 = w->up[j][2], E = w->depth_ratio;
    bool odd = j % 2;
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        double s = b->s[i] * b->cosine[i] + b->c[i] * b->sine[i];
        double c = b->c[i] * b->cosine[i] - b->s[i] * b->sine[i];
        double e = b->e[i], f = E / e, e2 = e * e, f2 = f * f;
        double p1 = odd ? e2 * e : e2, q1 = odd ? f2 * f : f2, p2 = p1 * e2, q2 = q1 * f2;
        double plus = odd ? e + f : 1.0, minus = odd ? e - f : 0.0;
        b->along[i] -= (a0 * plus + a1 * (p1 + q1) + a2 * (p2 + q2)) * s;
        b->up[i] += (u0 * minus + u1 * (p1 - q1) + u2 * (p2 - q2)) * c;
        b->s[i] = s;
        b->c[i] = c;
    }
}

static void place_block_move(PlaceBlock *RESTRICT b, const WaveTerms *w)
{
    place_block_phases(b, w);
    for (int j = 1; j <= w->harmonics; j++)
        place_block_harmonic(b, w, j);
    double x = w->weight * w->cos_heading, y = w->weight * w->sin_heading, z = w->weight;
    for (int i = 0; i < BLOCK; i++) {
        b->dx[i] += x * b->along[i];
        b->dy[i] += y * b->along[i];
        b->dz[i] += z * b->up[i];
    }
}

void waves_ring_places(const WaveState *waves, double time, int count, const Vec3 *mean,
                       Vec3 *place)
{
    if (waves->sea) {
        sea_ring_places(waves, time, count, mean, place);
        return;
    }
    WaveTerms terms[WAVE_LAYERS_MAX];
    int term_count = waves_terms(waves, time, terms);
    for (int begin = 0; begin < count; begin += BLOCK) {
        PlaceBlock b;
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        memset(&b, 0, sizeof b);
        for (int i = 0; i < n; i++) {
            b.x[i] = mean[begin + i].x;
            b.y[i] = mean[begin + i].y;
            b.z[i] = mean[begin + i].z;
        }
        for (int k = 0; k < term_count; k++)
            place_block_move(&b, &terms[k]);
        for (int i = 0; i < n; i++)
            place[begin + i] = vec3(b.x[i] + b.dx[i], b.y[i] + b.dy[i], b.z[i] + b.dz[i]);
    }
}

typedef struct ZoneBlock {
    float x[BLOCK], y[BLOCK], z[BLOCK];
    float elevation[BLOCK];
    float share[BLOCK], grow_x[BLOCK], grow_y[BLOCK]; ///< of the drift that is taken out
    float u[BLOCK], v[BLOCK], w[BLOCK];
    float sine[WAVE_LAYERS_MAX][BLOCK], cosine[WAVE_LAYERS_MAX][BLOCK];
} ZoneBlock;

/// Of one train, while its harmonics are summed.
typedef struct TrainBlock {
    float s[BLOCK], c[BLOCK]; ///< sine and cosine of j theta
    float e[BLOCK], f[BLOCK], pe[BLOCK], pf[BLOCK], height[BLOCK];
    float along[BLOCK], up[BLOCK], lift[BLOCK];
} TrainBlock;

static void zone_block_shares(ZoneBlock *RESTRICT b, const WaveInterior *in)
{
    float x0 = (float)in->min[0], x1 = (float)in->max[0], y0 = (float)in->min[1];
    float y1 = (float)in->max[1], inverse = in->width > 0 ? (float)(1 / in->width) : 0.0f;
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        float left = b->x[i] - x0, right = x1 - b->x[i], near = b->y[i] - y0, far = y1 - b->y[i];
        float dx = left < right ? left : right, dy = near < far ? near : far;
        float q = 1.0f - (dx < dy ? dx : dy) * inverse;
        q = q < 0.0f ? 0.0f : q;
        q = q > 1.0f ? 1.0f : q;
        float slope = 6.0f * q * (1.0f - q) * inverse;
        b->share[i] = q * q * (3.0f - 2.0f * q);
        b->grow_x[i] = dx > dy ? 0.0f : (left < right ? -slope : slope);
        b->grow_y[i] = dx > dy ? (near < far ? -slope : slope) : 0.0f;
    }
}

static void zone_block_surface(ZoneBlock *RESTRICT b, const WaveTerms *w, int layer)
{
    float *RESTRICT sine = b->sine[layer], *RESTRICT cosine = b->cosine[layer];
    float turns_x = (float)w->turns_x, turns_y = (float)w->turns_y, turns = (float)w->turns;
    float s[BLOCK], c[BLOCK];
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        // The place is folded before the time is added: its rounding is then the same at every
        // time and makes no noise in the velocity.
        float place = wave_fraction(turns_x * b->x[i] + turns_y * b->y[i]);
        wave_sine_cosine(wave_fraction(place + turns), &sine[i], &cosine[i]);
        s[i] = 0.0f;
        c[i] = 1.0f;
    }
    for (int j = 1; j <= w->harmonics; j++) {
        float crest = (float)(w->weight * w->crest[j]);
#pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            float next = s[i] * cosine[i] + c[i] * sine[i];
            c[i] = c[i] * cosine[i] - s[i] * sine[i];
            s[i] = next;
            b->elevation[i] += crest * c[i];
        }
    }
}

static void train_block_start(TrainBlock *RESTRICT t, const ZoneBlock *b, const WaveTerms *w)
{
    float number = (float)w->wave_number, level = (float)w->level, E = (float)w->depth_ratio;
    float mean = (float)w->mean_velocity;
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        float surface = b->elevation[i], z = b->z[i] - level;
        float power = number * (z < surface ? z : surface) * 1.44269504f;
        t->height[i] = power;
        t->e[i] = wave_exp2(power < -20.0f ? -20.0f : power); // its sixth power stays normal
        t->f[i] = E / t->e[i];
        t->pe[i] = t->pf[i] = t->c[i] = 1.0f;
        t->s[i] = t->up[i] = t->lift[i] = 0.0f;
        t->along[i] = mean;
    }
}

static void train_block_harmonic(TrainBlock *RESTRICT t, const float *RESTRICT sine,
                                 const float *RESTRICT cosine, float flow, float lift)
{
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        float s = t->s[i] * cosine[i] + t->c[i] * sine[i];
        float c = t->c[i] * cosine[i] - t->s[i] * sine[i];
        float pe = t->pe[i] * t->e[i], pf = t->pf[i] * t->f[i];
        t->along[i] += flow * (pe + pf) * c;
        t->up[i] += flow * (pe - pf) * s;
        t->lift[i] += lift * (pe - pf) * c;
        t->s[i] = s;
        t->c[i] = c;
        t->pe[i] = pe;
        t->pf[i] = pf;
    }
}

/// waves.c, driftless().
static void train_block_add(ZoneBlock *RESTRICT b, const TrainBlock *RESTRICT t, const WaveTerms *w)
{
    float d0 = (float)w->drift[0], d1 = (float)w->drift[1], d2 = (float)w->drift[2];
    float number = (float)w->wave_number, half = 0.5f / number, depth = (float)w->depth;
    float E2 = (float)(w->depth_ratio * w->depth_ratio), carried = (float)w->transport;
    float slowness = (float)(1 / (w->frame_speed + w->mean_velocity - w->transport));
    float cx = (float)w->cos_heading, cy = (float)w->sin_heading, weight = (float)w->weight;
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        float power = t->height[i] - t->lift[i] * 1.44269504f; // k label / ln 2
        power = power > 0.0f ? 0.0f : power;
        float e2 = wave_exp2(power < -20.0f ? -40.0f : 2.0f * power), f2 = E2 / e2;
        float e4 = e2 * e2, f4 = f2 * f2;
        float drift = b->share[i] * (d0 + d1 * (e2 + f2) + d2 * (e4 + f4));
        float label = power * 0.693147181f / number;
        float below = label + depth < 0.0f ? 0.0f : label + depth;
        float turned = d0 * below + half * (d1 * (e2 - f2) + 0.5f * d2 * (e4 - f4));
        float slower = 1.0f / (1.0f - drift * slowness);
        float along = carried + (t->along[i] - carried - drift) * slower;
        float growth = b->grow_x[i] * cx + b->grow_y[i] * cy;
        b->u[i] += weight * along * cx;
        b->v[i] += weight * along * cy;
        b->w[i] += weight * (t->up[i] * slower + growth * turned);
    }
}

static void zone_block_velocity(ZoneBlock *b, const WaveTerms *w, int layer)
{
    TrainBlock t;
    train_block_start(&t, b, w);
    for (int j = 1; j <= w->harmonics; j++)
        train_block_harmonic(&t, b->sine[layer], b->cosine[layer], (float)w->flow[j],
                             (float)(w->flow[j] / (j * w->frame_speed)));
    train_block_add(b, &t, w);
}

void waves_zone_batch(const WaveState *waves, double time, int count, const float *x,
                      const float *y, const float *z, float *u, float *v, float *w)
{
    if (waves->sea) {
        sea_zone_batch(waves, time, count, x, y, z, u, v, w);
        return;
    }
    WaveTerms terms[WAVE_LAYERS_MAX];
    int term_count = waves_terms(waves, time, terms);
    for (int begin = 0; begin < count; begin += BLOCK) {
        ZoneBlock b;
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        size_t bytes = (size_t)n * sizeof(float);
        memset(&b, 0, offsetof(ZoneBlock, sine));
        memcpy(b.x, x + begin, bytes);
        if (y) memcpy(b.y, y + begin, bytes);
        memcpy(b.z, z + begin, bytes);
        zone_block_shares(&b, &waves->interior);
        for (int k = 0; k < term_count; k++)
            zone_block_surface(&b, &terms[k], k);
        for (int k = 0; k < term_count; k++)
            zone_block_velocity(&b, &terms[k], k);
        memcpy(u + begin, b.u, bytes);
        if (v) memcpy(v + begin, b.v, bytes);
        memcpy(w + begin, b.w, bytes);
    }
}
