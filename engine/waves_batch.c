/// The incident wave at many particles at once, in single precision. Compiled with
/// -fno-trapping-math (engine/CMakeLists.txt): without it gcc keeps the branches of the clamps and
/// does not vectorise, at three times the cost.
#include "waves.h"

#include <string.h>

/// Particles are worked on in blocks that stay in the first-level cache.
enum { BLOCK = 64 };

static int present_terms_single(const WaveState *waves, double time, WaveTermsF *single)
{
    WaveTerms terms[WAVE_LAYERS_MAX];
    int count = waves_terms(waves, time, terms);
    for (int i = 0; i < count; i++)
        single[i] = wave_terms_single(terms[i]);
    return count;
}

typedef struct RingBlock {
    float x[BLOCK], y[BLOCK], z[BLOCK];    ///< mean places
    float dx[BLOCK], dy[BLOCK], dz[BLOCK]; ///< displacement
    float vx[BLOCK], vy[BLOCK], vz[BLOCK]; ///< velocity
    float ax[BLOCK], ay[BLOCK], az[BLOCK]; ///< acceleration
} RingBlock;

static void ring_block_load(RingBlock *b, int count, const float (*mean)[3])
{
    memset(b, 0, sizeof *b);
    for (int i = 0; i < count; i++) {
        b->x[i] = mean[i][0];
        b->y[i] = mean[i][1];
        b->z[i] = mean[i][2];
    }
}

static void ring_block_move(RingBlock *RESTRICT b, const WaveTermsF w)
{
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        WavePlaceF p = wave_place_phase_single(w, b->x[i], b->y[i]);
        p = wave_place_depth_single(w, p, b->z[i] < w.level ? b->z[i] : w.level);
        WaveMotionF d = wave_orbit_single(w, p), v = wave_orbit_rate_single(w, p);
        float along = w.weight * v.along + w.weight_rate * d.along;
        b->dx[i] += w.weight * d.along * w.cos_heading;
        b->dy[i] += w.weight * d.along * w.sin_heading;
        b->dz[i] += w.weight * d.up;
        b->vx[i] += along * w.cos_heading;
        b->vy[i] += along * w.sin_heading;
        b->vz[i] += w.weight * v.up + w.weight_rate * d.up;
    }
}

static void ring_block_accelerate(RingBlock *RESTRICT b, const WaveTermsF w)
{
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        WavePlaceF p = wave_place_phase_single(w, b->x[i], b->y[i]);
        p = wave_place_depth_single(w, p, b->z[i] < w.level ? b->z[i] : w.level);
        WaveMotionF d = wave_orbit_single(w, p), v = wave_orbit_rate_single(w, p);
        WaveMotionF a = wave_orbit_curve_single(w, p);
        float along =
            w.weight * a.along + 2.0f * w.weight_rate * v.along + w.weight_curve * d.along;
        b->ax[i] += along * w.cos_heading;
        b->ay[i] += along * w.sin_heading;
        b->az[i] += w.weight * a.up + 2.0f * w.weight_rate * v.up + w.weight_curve * d.up;
    }
}

void waves_ring_batch(const WaveState *waves, double time, int count, const float (*mean)[3],
                      float (*position)[3], float (*velocity)[3])
{
    WaveTermsF terms[WAVE_LAYERS_MAX];
    int term_count = present_terms_single(waves, time, terms);
    for (int begin = 0; begin < count; begin += BLOCK) {
        RingBlock b;
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        ring_block_load(&b, n, mean + begin);
        for (int k = 0; k < term_count; k++)
            ring_block_move(&b, terms[k]);
        for (int i = 0; i < n; i++) {
            position[begin + i][0] = b.x[i] + b.dx[i];
            position[begin + i][1] = b.y[i] + b.dy[i];
            position[begin + i][2] = b.z[i] + b.dz[i];
        }
        for (int i = 0; velocity && i < n; i++) {
            velocity[begin + i][0] = b.vx[i];
            velocity[begin + i][1] = b.vy[i];
            velocity[begin + i][2] = b.vz[i];
        }
    }
}

void waves_ring_acceleration_batch(const WaveState *waves, double time, int count,
                                   const float (*mean)[3], float (*acceleration)[3])
{
    WaveTermsF terms[WAVE_LAYERS_MAX];
    int term_count = present_terms_single(waves, time, terms);
    for (int begin = 0; begin < count; begin += BLOCK) {
        RingBlock b;
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        ring_block_load(&b, n, mean + begin);
        for (int k = 0; k < term_count; k++)
            ring_block_accelerate(&b, terms[k]);
        for (int i = 0; i < n; i++) {
            acceleration[begin + i][0] = b.ax[i];
            acceleration[begin + i][1] = b.ay[i];
            acceleration[begin + i][2] = b.az[i];
        }
    }
}

typedef struct PlaceBlock {
    double x[BLOCK], y[BLOCK], z[BLOCK];
    double dx[BLOCK], dy[BLOCK], dz[BLOCK];
    double e[BLOCK];
} PlaceBlock;

static void place_block_move(PlaceBlock *RESTRICT b, const WaveTerms w)
{
    // The exponential is a call; the rest is vectorised.
    for (int i = 0; i < BLOCK; i++)
        b->e[i] = exp(w.wave_number * mind(b->z[i] - w.level, 0.0));
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        WavePlace p;
        double turns = w.turns_x * b->x[i] + w.turns_y * b->y[i] + w.turns;
        wave_sine_cosine_double(wave_fraction_double(turns), &p.sine, &p.cosine);
        p.e = b->e[i];
        p.f = w.depth_ratio / p.e;
        WaveMotion d = wave_orbit(w, p);
        b->dx[i] += w.weight * d.along * w.cos_heading;
        b->dy[i] += w.weight * d.along * w.sin_heading;
        b->dz[i] += w.weight * d.up;
    }
}

void waves_ring_places(const WaveState *waves, double time, int count, const Vec3 *mean,
                       Vec3 *place)
{
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
            place_block_move(&b, terms[k]);
        for (int i = 0; i < n; i++)
            place[begin + i] = vec3(b.x[i] + b.dx[i], b.y[i] + b.dy[i], b.z[i] + b.dz[i]);
    }
}

typedef struct ZoneBlock {
    float x[BLOCK], y[BLOCK], z[BLOCK];
    float elevation[BLOCK];
    float u[BLOCK], v[BLOCK], w[BLOCK];
    float sine[WAVE_LAYERS_MAX][BLOCK], cosine[WAVE_LAYERS_MAX][BLOCK];
} ZoneBlock;

static void zone_block_surface(ZoneBlock *RESTRICT b, const WaveTermsF w, int layer)
{
    float *RESTRICT sine = b->sine[layer], *RESTRICT cosine = b->cosine[layer];
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        WavePlaceF p = wave_place_phase_single(w, b->x[i], b->y[i]);
        sine[i] = p.sine;
        cosine[i] = p.cosine;
        b->elevation[i] += w.weight * wave_elevation_single(w, p);
    }
}

static void zone_block_velocity(ZoneBlock *RESTRICT b, const WaveTermsF w, int layer)
{
    const float *RESTRICT sine = b->sine[layer], *RESTRICT cosine = b->cosine[layer];
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        float surface = w.level + b->elevation[i];
        WavePlaceF p;
        p.sine = sine[i];
        p.cosine = cosine[i];
        p.e = p.f = 0.0f;
        p = wave_place_depth_single(w, p, b->z[i] < surface ? b->z[i] : surface);
        WaveMotionF m = wave_driftless_velocity_single(w, p);
        b->u[i] += w.weight * m.along * w.cos_heading;
        b->v[i] += w.weight * m.along * w.sin_heading;
        b->w[i] += w.weight * m.up;
    }
}

void waves_zone_batch(const WaveState *waves, double time, int count, const float *x,
                      const float *y, const float *z, float *u, float *v, float *w)
{
    WaveTermsF terms[WAVE_LAYERS_MAX];
    int term_count = present_terms_single(waves, time, terms);
    for (int begin = 0; begin < count; begin += BLOCK) {
        ZoneBlock b;
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        size_t bytes = (size_t)n * sizeof(float);
        memset(&b, 0, offsetof(ZoneBlock, sine));
        memcpy(b.x, x + begin, bytes);
        if (y) memcpy(b.y, y + begin, bytes);
        memcpy(b.z, z + begin, bytes);
        for (int k = 0; k < term_count; k++)
            zone_block_surface(&b, terms[k], k);
        for (int k = 0; k < term_count; k++)
            zone_block_velocity(&b, terms[k], k);
        memcpy(u + begin, b.u, bytes);
        if (v) memcpy(v + begin, b.v, bytes);
        memcpy(w + begin, b.w, bytes);
    }
}
