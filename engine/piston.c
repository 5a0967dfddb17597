#include "piston.h"

#include <math.h>

#include "sea.h"

/// (chosen) Water at rest begins half a spacing before the mean place: what the piston may stand
/// off it, in spacings.
static const double START = 0.1;
/// (chosen) Travel, in lengths of the flume; beyond it a record has a slip of units.
static const double TRAVEL = 0.5;

bool piston_load(const Scene *scene, Arena *arena, const MotionTable **table, Error *error)
{
    const Waves *waves = &scene->waves;
    *table = NULL;
    if (waves->kind != WAVES_RECORD) return true;
    MotionTable *record;
    TRY(motion_load(waves->piston_path, MOTION_OF_PISTON, arena, &record, error));
    double most = TRAVEL * (scene->domain.max.x - scene->domain.min.x);
    if (record->reach > most)
        return error_set(error, ERROR_INPUT,
                         "%.300s: x_m reaches %.4g m from the mean place: must stay within %.4g m "
                         "(half of the flume)",
                         waves->piston_path, record->reach, most);
    double start[6] = {0}, rate[6] = {0};
    motion_add(record, 0, start, rate);
    if (fabs(start[0]) > START * scene->fluid.spacing)
        return error_set(error, ERROR_INPUT,
                         "%.300s: x_m = %.4g at t_s = 0: must be within %.4g m of 0, the mean "
                         "place where water at rest begins (a tenth of fluid.spacing_m)",
                         waves->piston_path, start[0], START * scene->fluid.spacing);
    *table = record;
    return true;
}

/// Peak periods of an irregular sea that its travel is taken from, and samples in one; a tenth more
/// for what comes later.
enum { TRAVEL_PERIODS = 300, TRAVEL_SAMPLES = 12 };
static const double TRAVEL_MARGIN = 1.1;

bool piston_reach(const Scene *scene, double *reach, Error *error)
{
    const Waves *w = &scene->waves;
    *reach = waves_wall_reach(scene);
    bool sea = w->kind == WAVES_IRREGULAR || w->kind == WAVES_FOCUSED;
    if (!sea || scene->domain.kind != DOMAIN_FLUME || w->piston_order < 2) return true;
    WaveState waves = waves_create(scene);
    Arena arena = arena_create(0);
    WaveLayer *layer = &waves.layers[0];
    layer->target.height = maxd(w->initial.height, w->height_limits.max);
    layer->target.period = maxd(w->initial.period, w->period_limits.max);
    waves.layer_count = 1; // no ramp: full height at once
    bool good = waves_take_sea(&waves, scene, &arena, error);
    int focused = w->kind == WAVES_FOCUSED ? w->spectrum.components / 2 : 0; // once and again
    int count = (focused ? focused : TRAVEL_PERIODS) * TRAVEL_SAMPLES;
    double begin = focused ? w->focus.time - focused * layer->target.period / 2 : 0;
    for (int i = 0; good && i < count; i++) {
        double x = piston_displacement(&waves, begin + i * layer->target.period / TRAVEL_SAMPLES);
        *reach = maxd(*reach, TRAVEL_MARGIN * fabs(x));
    }
    arena_destroy(&arena);
    return good;
}

double piston_stroke_ratio(double kd)
{
    // for large kd the ratio of the exponentials
    if (kd > 300) return 0.5;
    return (sinh(2 * kd) + 2 * kd) / (2 * (cosh(2 * kd) - 1));
}

/// A piston that moves with the mean velocity over the depth of the wave where it stands,
/// c eta/(d + eta) where nothing is carried: for long waves, under which all of the depth moves
/// alike. With eta = sum a_j cos j phi that is, in the wave's phase at the piston,
///
///     x = sum a_j sin(j phi)/(j k d),   phi + k x = angle
///
/// Source: Goring (1978), Tsunamis - the propagation of long waves onto a shelf, Caltech KH-R-38;
/// the integral is ours.
static double long_stroke(const WaveTerms *w, double angle)
{
    double phi = angle, x = 0;
    for (int i = 0; i < 50; i++) {
        double eta = 0, kx = 0;
        for (int j = 1; j <= w->harmonics; j++) {
            eta += w->crest[j] * cos(j * phi);
            kx += w->crest[j] * sin(j * phi) / (j * w->depth);
        }
        x = kx / w->wave_number;
        double step = (phi + kx - angle) / (1 + eta / w->depth);
        phi -= step;
        if (fabs(step) < 1e-12) break;
    }
    return x;
}

/// The far field is eta = a cos(kx - omega t + phase), so the paddle's velocity is in phase with
/// the elevation it makes and its displacement a quarter period behind.
static double regular_stroke(const WaveState *waves, const WaveTrain *t, double time)
{
    const WaveTerms *w = &t->terms;
    double kd = w->wave_number * w->depth;
    double angle = w->angular_frequency * (time - t->time_origin) - t->phase -
                   w->wave_number * (waves->interior.min[0] - t->centre_x);
    if (t->is_long) return long_stroke(w, angle);
    double first = w->crest[1], stroke = first * piston_stroke_ratio(kd) * sin(angle);
    return stroke + first * first * (t->second[0] * cos(2 * angle) - t->second[1] * sin(2 * angle));
}

/// Strokes of all components, and to second order what their products ask for: with a layer's
/// weight, as the wave has it, its square.
static double sea_stroke(const Sea *sea, const SeaLayer *layer, double x, double time,
                         double weight)
{
    double sum = 0, cosine[SCENE_COMPONENTS_MAX], sine[SCENE_COMPONENTS_MAX];
    if (!(layer->target.height > 0)) return 0;
    for (int i = 0; i < sea->count; i++) {
        double angle = layer->angular_frequency[i] * (time - layer->time_origin) -
                       2 * PI * (layer->turns_x[i] * x + layer->turns[i]);
        double amplitude = layer->amplitude[i] * (1 - layer->depth_ratio[i]);
        sine[i] = sin(angle);
        cosine[i] = sea->second ? cos(angle) : 0;
        sum += amplitude * piston_stroke_ratio(layer->wave_number[i] * sea->depth) * sine[i];
    }
    double second = 0;
    if (sea->second) second = piston_pairs_sum(&layer->pairs, cosine, sine) - layer->pairs_start;
    return weight * (sum + weight * second);
}

double piston_displacement(const WaveState *waves, double time)
{
    if (waves->record) {
        double value[6] = {0}, rate[6] = {0};
        motion_add(waves->record, time, value, rate);
        return value[0];
    }
    double displacement = 0;
    WaveStep weights[WAVE_LAYERS_MAX];
    waves_layer_weights(waves, time, weights);
    for (int i = 0; i < waves->layer_count; i++)
        displacement +=
            waves->sea ? sea_stroke(waves->sea, &waves->sea->layers[i], waves->interior.min[0],
                                    time, weights[i].value)
                       : weights[i].value * regular_stroke(waves, &waves->layers[i].train, time);
    return displacement;
}

void piston_move(const void *context, double time, int count, const Vec3 *mean, Vec3 *place)
{
    double shift = piston_displacement(context, time);
    for (int i = 0; i < count; i++)
        place[i] = vec3(mean[i].x + shift, mean[i].y, mean[i].z);
}
