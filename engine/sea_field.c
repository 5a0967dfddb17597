/// The field of a sea at one place, in double precision, and at many. Compiled with
/// -fno-trapping-math like waves_batch.c.
#include "sea.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 64 };

/// How far the current has carried the water since a layer's origin [m].
static Vec3 way_since(const WaveState *waves, const SeaLayer *layer, double time)
{
    const Current *current = &waves->current;
    if (!(current->speed > 0)) return vec3(0, 0, 0);
    return vec3_sub(current_travel(current, time), current_travel(current, layer->time_origin));
}

typedef struct SeaSum {
    Vec3 displacement, velocity, acceleration;
} SeaSum;

/// All sums over layers and components for a particle with mean place (x, y, z).
static SeaSum sea_sum(const WaveState *waves, Vec3 mean, double time)
{
    WaveStep weights[WAVE_LAYERS_MAX];
    const Sea *sea = waves->sea;
    SeaSum sum;
    memset(&sum, 0, sizeof sum);
    waves_layer_weights(waves, time, weights);
    double z = mind(mean.z - sea->level, 0);
    for (int l = 0; l < waves->layer_count; l++) {
        const SeaLayer *layer = &sea->layers[l];
        double w0 = weights[l].value, w1 = weights[l].rate, w2 = weights[l].curve;
        Vec3 way = way_since(waves, layer, time);
        for (int i = 0; i < sea->count && layer->target.height > 0; i++) {
            double omega = layer->angular_frequency[i], k = layer->wave_number[i];
            double theta = 2 * PI *
                               (layer->turns_x[i] * (mean.x - way.x) +
                                layer->turns_y[i] * (mean.y - way.y) + layer->turns[i]) -
                           omega * (time - layer->time_origin);
            double s = sin(theta), c = cos(theta), e = exp(k * z), f = layer->depth_ratio[i] / e;
            double a = layer->amplitude[i], wide = a * (e + f), high = a * (e - f);
            double rise = 0.5 * k * a * a * (e * e - f * f);
            Vec3 to = vec3(layer->cosine[i], layer->sine[i], 0);
            double x0 = -wide * s, x1 = omega * wide * c, x2 = omega * omega * wide * s;
            double z0 = high * c + rise, z1 = omega * high * s, z2 = -omega * omega * high * c;
            Vec3 d = vec3(x0 * to.x, x0 * to.y, z0), v = vec3(x1 * to.x, x1 * to.y, z1);
            Vec3 b = vec3(x2 * to.x, x2 * to.y, z2);
            sum.displacement = vec3_mad(sum.displacement, d, w0);
            sum.velocity = vec3_mad(vec3_mad(sum.velocity, v, w0), d, w1);
            sum.acceleration =
                vec3_mad(vec3_mad(vec3_mad(sum.acceleration, b, w0), v, 2 * w1), d, w2);
        }
    }
    return sum;
}

Vec3 sea_displacement(const WaveState *waves, Vec3 mean, double time)
{
    return sea_sum(waves, mean, time).displacement;
}

Vec3 sea_orbit_velocity(const WaveState *waves, Vec3 mean, double time)
{
    return sea_sum(waves, mean, time).velocity;
}

/// Mean place of the particle that is at `point` now, by substitution; above the surface that of
/// the surface.
static Vec3 mean_place(const WaveState *waves, Vec3 point, double time, int rounds)
{
    Vec3 mean = point;
    for (int i = 0; i < rounds; i++) {
        mean.z = mind(mean.z, waves->sea->level);
        mean = vec3_sub(point, sea_displacement(waves, mean, time));
    }
    mean.z = mind(mean.z, waves->sea->level);
    return mean;
}

Vec3 sea_velocity(const WaveState *waves, Vec3 point, double time)
{
    return sea_sum(waves, mean_place(waves, point, time, 1), time).velocity;
}

Vec3 sea_acceleration(const WaveState *waves, Vec3 point, double time)
{
    return sea_sum(waves, mean_place(waves, point, time, 1), time).acceleration;
}

double sea_elevation(const WaveState *waves, double x, double y, double time)
{
    Vec3 mean = vec3(x, y, waves->sea->level);
    for (int i = 0; i < 4; i++) {
        Vec3 d = sea_displacement(waves, mean, time);
        mean = vec3(x - d.x, y - d.y, waves->sea->level);
    }
    return sea_displacement(waves, mean, time).z;
}

// ----------------------------------------------------------------------------------- many places

typedef struct SeaBlock {
    float x[BLOCK], y[BLOCK], z[BLOCK];    ///< mean places; z below still water
    float dx[BLOCK], dy[BLOCK], dz[BLOCK]; ///< displacement
    float u[BLOCK], v[BLOCK], w[BLOCK];    ///< velocity
} SeaBlock;

/// One component at one instant, weight and all, in single precision.
typedef struct SeaTerm {
    float turns_x, turns_y, turns, number, depth_ratio, amplitude, rate, rise, cosine, sine;
} SeaTerm;

static SeaTerm term_of(const SeaLayer *layer, int i, WaveStep weight, double time, Vec3 way)
{
    SeaTerm t;
    double omega = layer->angular_frequency[i], k = layer->wave_number[i];
    double turns = layer->turns[i] - omega * (time - layer->time_origin) / (2 * PI);
    turns -= layer->turns_x[i] * way.x + layer->turns_y[i] * way.y;
    t.turns_x = (float)layer->turns_x[i];
    t.turns_y = (float)layer->turns_y[i];
    t.turns = (float)(turns - floor(turns + 0.5));
    t.number = (float)(k * 1.4426950408889634);
    t.depth_ratio = (float)layer->depth_ratio[i];
    t.amplitude = (float)(weight.value * layer->amplitude[i]);
    t.rate = (float)omega;
    t.rise = (float)(0.5 * k * layer->amplitude[i]);
    t.cosine = (float)layer->cosine[i];
    t.sine = (float)layer->sine[i];
    return t;
}

static void block_displace(SeaBlock *RESTRICT b, const SeaTerm t)
{
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        float place = wave_fraction(t.turns_x * b->x[i] + t.turns_y * b->y[i]), s, c;
        wave_sine_cosine(wave_fraction(place + t.turns), &s, &c);
        float power = t.number * b->z[i];
        float e = wave_exp2(power < -40.0f ? -40.0f : power), f = t.depth_ratio / e;
        float along = -t.amplitude * (e + f) * s, up = t.amplitude * (e - f);
        b->dx[i] += along * t.cosine;
        b->dy[i] += along * t.sine;
        b->dz[i] += up * c + t.rise * up * (e + f);
    }
}

/// @param change  weight rate/weight of the layer [1/s]
static void block_drive(SeaBlock *RESTRICT b, const SeaTerm t, float change)
{
#pragma omp simd
    for (int i = 0; i < BLOCK; i++) {
        float place = wave_fraction(t.turns_x * b->x[i] + t.turns_y * b->y[i]), s, c;
        wave_sine_cosine(wave_fraction(place + t.turns), &s, &c);
        float power = t.number * b->z[i];
        float e = wave_exp2(power < -40.0f ? -40.0f : power), f = t.depth_ratio / e;
        float wide = t.amplitude * (e + f), high = t.amplitude * (e - f);
        float along = wide * (t.rate * c - change * s);
        b->u[i] += along * t.cosine;
        b->v[i] += along * t.sine;
        b->w[i] += high * (t.rate * s + change * (c + t.rise * (e + f)));
    }
}

/// Adds displacements, or velocities, of all layers.
static void block_sum(SeaBlock *b, const WaveState *waves, double time, bool velocity)
{
    WaveStep weights[WAVE_LAYERS_MAX];
    waves_layer_weights(waves, time, weights);
    for (int l = 0; l < waves->layer_count; l++) {
        const SeaLayer *layer = &waves->sea->layers[l];
        if (!(layer->target.height > 0) || !(weights[l].value > 0)) continue;
        float change = (float)(weights[l].rate / weights[l].value);
        Vec3 way = way_since(waves, layer, time);
        for (int i = 0; i < waves->sea->count; i++) {
            SeaTerm t = term_of(layer, i, weights[l], time, way);
            if (velocity)
                block_drive(b, t, change);
            else
                block_displace(b, t);
        }
    }
}

void sea_ring_places(const WaveState *waves, double time, int count, const Vec3 *mean, Vec3 *place)
{
    double level = waves->sea->level;
    for (int begin = 0; begin < count; begin += BLOCK) {
        SeaBlock b;
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        memset(&b, 0, sizeof b);
        for (int i = 0; i < n; i++) {
            b.x[i] = (float)mean[begin + i].x;
            b.y[i] = (float)mean[begin + i].y;
            b.z[i] = (float)mind(mean[begin + i].z - level, 0);
        }
        block_sum(&b, waves, time, false);
        for (int i = 0; i < n; i++)
            place[begin + i] =
                vec3_add(mean[begin + i], vec3((double)b.dx[i], (double)b.dy[i], (double)b.dz[i]));
    }
}

void sea_zone_batch(const WaveState *waves, double time, int count, const float *x, const float *y,
                    const float *z, float *u, float *v, float *w)
{
    float level = (float)waves->sea->level;
    for (int begin = 0; begin < count; begin += BLOCK) {
        SeaBlock b;
        int n = count - begin < BLOCK ? count - begin : BLOCK;
        size_t bytes = (size_t)n * sizeof(float);
        memset(&b, 0, sizeof b);
        for (int i = 0; i < n; i++) {
            b.x[i] = x[begin + i];
            b.y[i] = y ? y[begin + i] : 0.0f;
            b.z[i] = z[begin + i] < level ? z[begin + i] - level : 0.0f;
        }
        block_sum(&b, waves, time, false);
        for (int i = 0; i < n; i++) { // the mean place of what is there
            float mean = z[begin + i] - level - b.dz[i];
            b.x[i] -= b.dx[i];
            b.y[i] -= b.dy[i];
            b.z[i] = mean < 0 ? mean : 0.0f;
        }
        block_sum(&b, waves, time, true);
        memcpy(u + begin, b.u, bytes);
        if (v) memcpy(v + begin, b.v, bytes);
        memcpy(w + begin, b.w, bytes);
    }
}
