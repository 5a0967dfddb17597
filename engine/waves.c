#include "waves.h"

#include <string.h>

#include "physics/wave_theory.h"
#include "piston_second.h"
#include "sea.h"
#include "wave_orbits.h"

/// Turning further, or changing the period by more than this share, takes the old sea down first.
static const double FAR_HEADING = 60 * PI / 180;
static const double FAR_PERIOD = 0.30;
/// A layer runs this share of its rise before the next may begin.
static const double LAYER_SPACING = 1.0 / 3;
/// Orbits may miss those of the theory by this share of the height. Waves nearly as high as water
/// is deep (0.7 of it) come to 7 %, and are far better than second order, which is no wave there.
static const double MISFIT = 0.08;
/// kd up to which the piston's modes are followed.
static const double DEEPEST = 8;

double wave_number_airy(double angular_frequency, double depth, double gravity)
{
    return wave_theory_number(angular_frequency, depth, gravity);
}

static double basin_depth(const Scene *scene) { return scene->fluid.level - scene->domain.min.z; }

/// Whether the scene's waves are a sum of components.
static bool waves_are_a_sea(const Scene *scene)
{
    return scene->waves.kind == WAVES_IRREGULAR || scene->waves.kind == WAVES_FOCUSED;
}

static double angle_between(double a, double b) { return fabs(remainder(a - b, 2 * PI)); }

/// theta at the basin's centre; the water has gone on since the train's origin.
static double centre_phase(const WaveState *waves, const WaveTrain *train, double time)
{
    const WaveTerms *w = &train->terms;
    double phase = train->phase - w->angular_frequency * (time - train->time_origin);
    if (!(waves->current.speed > 0)) return phase;
    Vec3 to = current_travel(&waves->current, time);
    Vec3 way = vec3_sub(to, current_travel(&waves->current, train->time_origin));
    return phase - w->wave_number * (way.x * w->cos_heading + way.y * w->sin_heading);
}

/// What a wave is for who goes with the water.
static void leave_current(WaveTerms *terms, double along)
{
    terms->angular_frequency -= terms->wave_number * along;
    terms->mean_velocity -= along;
    terms->transport -= along;
}

/// Coefficients of the asked wave: by its theory, and to second order where that has no such wave
/// (beyond breaking) or where its orbits are too sharp at the crest to be followed.
static WaveTerms terms_create(const Scene *scene, const WaveTarget *target, WaveTheory *theory)
{
    double level = scene->fluid.level, depth = basin_depth(scene), misfit = 0;
    SteadyWaveAsk ask = {.theory = scene->waves.theory,
                         .height = target->height,
                         .period = target->period,
                         .depth = depth,
                         .gravity = scene->fluid.gravity};
    SteadyWave wave;
    ask.eulerian = scene->domain.kind == DOMAIN_LINES; // an open sea: nothing flows back
    ask.current = current_along(&scene->waves.current, target->heading);
    if (target->height > 0 && steady_wave_solve(&ask, &wave)) {
        WaveTerms terms = wave_orbits_terms(&wave, level, &misfit);
        *theory = wave.theory;
        leave_current(&terms, ask.current);
        if (ask.eulerian) terms.mean_velocity = 0;
        if (misfit < MISFIT * target->height) return terms;
    }
    *theory = WAVE_THEORY_STOKES2;
    double omega = 2 * PI / target->period;
    double number = current_wave_number(omega, ask.current, depth, scene->fluid.gravity);
    if (isnan(number)) number = wave_number_airy(omega, depth, scene->fluid.gravity); // refused
    WaveTerms terms =
        wave_terms(target->height / 2, number, omega - number * ask.current, depth, level);
    if (ask.eulerian) terms.mean_velocity = 0;
    return terms;
}

/// What keeps the piston from making a free wave of twice the frequency. Where the wave no longer
/// feels the bed its modes are too many (piston_second.h): the piston then counts as that deep.
static void second_harmonic(const WaveTerms *terms, double gravity, double second[2])
{
    double depth = mind(terms->depth, DEEPEST / terms->wave_number);
    PistonModes modes = piston_modes(terms->angular_frequency, depth, gravity);
    PistonTransfer sum = piston_transfer(&modes, &modes, PISTON_SUM, depth, gravity);
    second[0] = sum.real;
    second[1] = sum.imaginary;
}

static WaveTrain train_create(const Scene *scene, const WaveTarget *asked, double gain)
{
    WaveTarget made = *asked;
    const WaveTarget *target = &made;
    made.height *= gain;
    const Domain *domain = &scene->domain;
    WaveTrain train = {0};
    train.amplitude = target->height / 2;
    train.terms = terms_create(scene, target, &train.theory);
    train.terms.cos_heading = cos(target->heading);
    train.terms.sin_heading = domain->dimensions == 2 ? 0 : sin(target->heading);
    train.centre_x = (domain->min.x + domain->max.x) / 2;
    train.centre_y = domain->dimensions == 2 ? 0 : (domain->min.y + domain->max.y) / 2;
    if (domain->kind == DOMAIN_FLUME && scene->waves.piston_order > 1) {
        second_harmonic(&train.terms, scene->fluid.gravity, train.second);
        double length = 2 * PI / train.terms.wave_number, depth = train.terms.depth;
        double ursell = target->height * length * length / (depth * depth * depth);
        train.is_long = train.theory == WAVE_THEORY_STREAM && ursell > URSELL_OF_SECOND_ORDER;
    }
    return train;
}

/// The same train at height zero.
static WaveTrain train_at_rest(const WaveTrain *train)
{
    WaveTrain rest = *train;
    const WaveTerms *w = &train->terms;
    rest.amplitude = 0;
    rest.terms = wave_terms_zero(w->wave_number, w->angular_frequency, w->depth, w->level);
    rest.terms.cos_heading = w->cos_heading;
    rest.terms.sin_heading = w->sin_heading;
    return rest;
}

static WaveInterior interior_create(const Scene *scene)
{
    const Domain *d = &scene->domain;
    bool plane = d->dimensions == 2;
    WaveInterior in = {
        {d->min.x, plane ? -1e30 : d->min.y}, {d->max.x, plane ? 1e30 : d->max.y}, 0};
    if (d->kind == DOMAIN_BASIN) in.width = waves_zone_width(scene);
    return in;
}

WaveState waves_create(const Scene *scene)
{
    WaveState waves;
    memset(&waves, 0, sizeof waves);
    waves.current = scene->waves.current;
    if (scene->waves.kind == WAVES_NONE) return waves;
    waves.asked = scene->waves.initial;
    waves.interior = interior_create(scene);
    const WaveGain *gain = &scene->waves.gain;
    waves.gain =
        gain->gauge >= 0 && gain->start > 0 ? gain->start : 1; // a scene of zeros has no gain
    WaveLayer *base = &waves.layers[0];
    base->target = waves.asked;
    base->gain = waves.gain;
    base->train = train_create(scene, &waves.asked, waves.gain);
    waves.layer_count = 1;
    // what a record makes is not known here; period and length still are
    if (scene->waves.kind == WAVES_RECORD) base->train = train_at_rest(&base->train);
    if (scene->waves.start == WAVE_START_RAMP && scene->waves.ramp_time > 0) {
        waves.layers[1] = *base;
        waves.layers[1].duration = scene->waves.ramp_time;
        waves.layer_count = 2;
        base->train = train_at_rest(&base->train);
        base->target.height = 0;
        waves.active = true;
    }
    return waves;
}

bool waves_take_sea(WaveState *waves, const Scene *scene, Arena *arena, Error *error)
{
    if (!waves_are_a_sea(scene)) return true;
    TRY(sea_create(scene, arena, &waves->sea, error));
    waves_refresh(waves);
    return true;
}

void waves_refresh(const WaveState *waves)
{
    if (waves->sea) sea_refresh(waves->sea, waves);
}

/// Whether the target differs so much from a train still in the water that the two should not
/// superpose.
static bool far_from_present(const WaveState *waves, const WaveTarget *target)
{
    for (int i = 0; i < waves->layer_count; i++) {
        const WaveTarget *present = &waves->layers[i].target;
        if (!(present->height > 0) || !(target->height > 0)) continue;
        double longer = maxd(present->period, target->period);
        double shorter = mind(present->period, target->period);
        if (angle_between(present->heading, target->heading) > FAR_HEADING + 1e-9) return true;
        if (longer > (1 + FAR_PERIOD) * shorter * (1 + 1e-9)) return true;
    }
    return false;
}

/// Lay a train over the others; its phase meets the newest one's at the centre half-way up.
static void layer_push(WaveState *waves, const WaveTrain *train, const WaveTarget *target,
                       double time, double duration)
{
    ASSERT(waves->layer_count < WAVE_LAYERS_MAX);
    const WaveLayer *top = &waves->layers[waves->layer_count - 1];
    WaveLayer *layer = &waves->layers[waves->layer_count];
    layer->train = *train;
    layer->target = *target;
    layer->gain = waves->gain;
    layer->begin = time;
    layer->duration = duration;
    layer->train.time_origin = time + duration / 2;
    layer->train.phase =
        remainder(centre_phase(waves, &top->train, layer->train.time_origin), 2 * PI);
    // a sea counts its time in peak periods, so that the phases of all components meet; a group
    // keeps its focus
    if (waves->sea && !waves->sea->focused)
        layer->train.time_origin -= (layer->train.time_origin - top->train.time_origin) *
                                    target->period / top->target.period;
    else if (waves->sea)
        layer->train.time_origin = top->train.time_origin;
    waves->layer_count++;
}

/// Let the queued target in if its turn has come.
static void admit(WaveState *waves, const Scene *scene, double time)
{
    const WaveTarget *target = &waves->queued;
    const WaveLayer *top = &waves->layers[waves->layer_count - 1];
    if (far_from_present(waves, target)) {
        if (!(top->target.height > 0)) return; // already going down to rest
        WaveTrain rest = train_at_rest(&top->train);
        WaveTarget none = top->target;
        none.height = 0;
        layer_push(waves, &rest, &none, time, none.period);
        return;
    }
    bool crowded = waves->layer_count >= WAVE_LAYERS_MAX - 1;
    bool early = waves->layer_count > 1 && time < top->begin + LAYER_SPACING * top->duration;
    if (crowded || early) return;
    WaveTrain train = train_create(scene, target, waves->gain);
    layer_push(waves, &train, target, time, scene->waves.blend_periods * target->period);
    waves->has_queued = false;
}

static void drop_covered(WaveState *waves, double time)
{
    for (int top = waves->layer_count - 1; top > 0; top--) {
        const WaveLayer *layer = &waves->layers[top];
        if (time < layer->begin + layer->duration) continue;
        memmove(waves->layers, layer, sizeof *layer * (size_t)(waves->layer_count - top));
        waves->layer_count -= top;
        break;
    }
    waves->active = waves->layer_count > 1 || waves->has_queued;
}

void waves_command(WaveState *waves, const Scene *scene, const WaveTarget *target, double time)
{
    if (waves->layer_count == 0) return;
    waves->asked = waves->queued = *target;
    waves->has_queued = true;
    waves_update(waves, scene, time);
}

void waves_set_gain(WaveState *waves, const Scene *scene, double gain, double time)
{
    waves->gain = gain;
    WaveTarget same = waves->has_queued ? waves->queued : waves->asked;
    waves_command(waves, scene, &same, time);
}

void waves_update(WaveState *waves, const Scene *scene, double time)
{
    if (waves->layer_count == 0) return;
    drop_covered(waves, time);
    if (waves->has_queued) admit(waves, scene, time);
    waves_refresh(waves);
    waves->active = waves->layer_count > 1 || waves->has_queued;
}

void waves_layer_weights(const WaveState *waves, double time, WaveStep *weights)
{
    WaveStep cover = {1, 0, 0};
    for (int i = waves->layer_count - 1; i >= 0; i--) {
        const WaveLayer *layer = &waves->layers[i];
        WaveStep b = {1, 0, 0};
        if (i > 0) b = wave_step(time, layer->begin, layer->duration);
        weights[i].value = b.value * cover.value;
        weights[i].rate = b.rate * cover.value + b.value * cover.rate;
        weights[i].curve = b.curve * cover.value + 2 * b.rate * cover.rate + b.value * cover.curve;
        WaveStep next;
        next.value = (1 - b.value) * cover.value;
        next.rate = (1 - b.value) * cover.rate - b.rate * cover.value;
        next.curve = (1 - b.value) * cover.curve - 2 * b.rate * cover.rate - b.curve * cover.value;
        cover = next;
    }
}

void waves_weights(const WaveState *waves, double time, double *from, double *to)
{
    WaveStep weights[WAVE_LAYERS_MAX];
    waves_layer_weights(waves, time, weights);
    *to = waves->layer_count ? weights[waves->layer_count - 1].value : 0;
    *from = waves->layer_count ? 1 - *to : 0;
}

WaveTarget waves_now(const WaveState *waves, double time)
{
    WaveStep weights[WAVE_LAYERS_MAX];
    WaveTarget now = {0, 0, 0};
    if (waves->layer_count == 0) return now;
    waves_layer_weights(waves, time, weights);
    double period = 0, x = 0, y = 0;
    for (int i = 0; i < waves->layer_count; i++) {
        const WaveTarget *target = &waves->layers[i].target;
        double height = weights[i].value * target->height;
        now.height += height;
        period += height * target->period;
        x += height * cos(target->heading);
        y += height * sin(target->heading);
    }
    const WaveTarget *newest = &waves->layers[waves->layer_count - 1].target;
    bool visible = now.height > 0;
    now.period = visible ? period / now.height : newest->period;
    // The asked heading may be given as 350 or -10 deg: show the turn nearest to it.
    double turned = hypot(x, y) > 1e-12 * now.height && visible
                        ? remainder(atan2(y, x) - newest->heading, 2 * PI)
                        : 0;
    now.heading = newest->heading + turned;
    return now;
}

int waves_terms(const WaveState *waves, double time, WaveTerms *terms)
{
    WaveStep weights[WAVE_LAYERS_MAX];
    int count = 0;
    waves_layer_weights(waves, time, weights);
    for (int i = 0; i < waves->layer_count; i++) {
        const WaveTrain *train = &waves->layers[i].train;
        if (!(train->amplitude > 0)) continue;
        WaveTerms *w = &terms[count++];
        *w = train->terms;
        w->turns_x = w->wave_number * w->cos_heading / (2 * PI);
        w->turns_y = w->wave_number * w->sin_heading / (2 * PI);
        double turns = centre_phase(waves, train, time) / (2 * PI) - w->turns_x * train->centre_x -
                       w->turns_y * train->centre_y;
        w->turns = remainder(turns, 1);
        w->weight = weights[i].value;
        w->weight_rate = weights[i].rate;
        w->weight_curve = weights[i].curve;
    }
    return count;
}

static Vec3 motion_add(Vec3 sum, const WaveTerms *w, WaveMotion m, double weight)
{
    return vec3(sum.x + weight * m.along * w->cos_heading,
                sum.y + weight * m.along * w->sin_heading, sum.z + weight * m.up);
}

Vec3 waves_displacement(const WaveState *waves, Vec3 mean, double time)
{
    if (waves->sea) return sea_displacement(waves, mean, time);
    WaveTerms terms[WAVE_LAYERS_MAX];
    int count = waves_terms(waves, time, terms);
    Vec3 sum = vec3(0, 0, 0);
    for (int i = 0; i < count; i++) {
        const WaveTerms *w = &terms[i];
        WavePlace p = wave_place(w, mean.x, mean.y, mind(mean.z, w->level));
        sum = motion_add(sum, w, wave_orbit(w, p), w->weight);
    }
    return sum;
}

Vec3 waves_orbit_velocity(const WaveState *waves, Vec3 mean, double time)
{
    if (waves->sea) return sea_orbit_velocity(waves, mean, time);
    WaveTerms terms[WAVE_LAYERS_MAX];
    int count = waves_terms(waves, time, terms);
    Vec3 sum = vec3(0, 0, 0);
    for (int i = 0; i < count; i++) {
        const WaveTerms *w = &terms[i];
        WavePlace p = wave_place(w, mean.x, mean.y, mind(mean.z, w->level));
        sum = motion_add(sum, w, wave_orbit_rate(w, p), w->weight);
        sum = motion_add(sum, w, wave_orbit(w, p), w->weight_rate);
    }
    return sum;
}

static double elevation_sum(const WaveTerms *terms, int count, double x, double y)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += terms[i].weight * wave_elevation(&terms[i], wave_place(&terms[i], x, y, 0));
    return sum;
}

double waves_elevation(const WaveState *waves, double x, double y, double time)
{
    if (waves->sea) return sea_elevation(waves, x, y, time);
    WaveTerms terms[WAVE_LAYERS_MAX];
    int count = waves_terms(waves, time, terms);
    return elevation_sum(terms, count, x, y);
}

/// Weighted sum of a field at (x, min(z, eta)).
static Vec3 field_sum(const WaveState *waves, Vec3 point, double time,
                      WaveMotion (*field)(const WaveTerms *w, WavePlace p))
{
    WaveTerms terms[WAVE_LAYERS_MAX];
    int count = waves_terms(waves, time, terms);
    double eta = elevation_sum(terms, count, point.x, point.y);
    Vec3 sum = vec3(0, 0, 0);
    for (int i = 0; i < count; i++) {
        const WaveTerms *w = &terms[i];
        WavePlace p = wave_place(w, point.x, point.y, mind(point.z, w->level + eta));
        sum = motion_add(sum, w, field(w, p), w->weight);
    }
    return sum;
}

Vec3 waves_velocity(const WaveState *waves, Vec3 point, double time)
{
    if (waves->sea) return sea_velocity(waves, point, time);
    return field_sum(waves, point, time, wave_velocity);
}
Vec3 waves_acceleration(const WaveState *waves, Vec3 point, double time)
{
    if (waves->sea) return sea_acceleration(waves, point, time);
    return field_sum(waves, point, time, wave_acceleration);
}

/// How much of the drift is taken out at a place, and how that grows along x and y [1/m].
typedef struct DriftShare {
    double share, along_x, along_y;
} DriftShare;

/// Quadratic smoothstep of q = 1 - distance/width from the nearest side.
static DriftShare drift_share(const WaveInterior *in, double x, double y)
{
    DriftShare d = {1, 0, 0};
    if (!(in->width > 0)) return d;
    double dx = mind(x - in->min[0], in->max[0] - x), dy = mind(y - in->min[1], in->max[1] - y);
    double q = 1 - mind(dx, dy) / in->width;
    q = q < 0 ? 0 : (q > 1 ? 1 : q);
    double slope = 6 * q * (1 - q) / in->width;
    d.share = q * q * (3 - 2 * q);
    if (dx <= dy)
        d.along_x = x - in->min[0] < in->max[0] - x ? -slope : slope;
    else
        d.along_y = y - in->min[1] < in->max[1] - y ? -slope : slope;
    return d;
}

/// (u - s D)/(1 - s D/c) along and w/(1 - s D/c) + (grad s . heading) int D dz up: where s = 1 the
/// velocity of a particle whose orbit is closed, exactly; between, without a divergence in the
/// mean.
static WaveMotion driftless(const WaveTerms *w, WavePlace p, DriftShare d)
{
    WaveMotion m = wave_velocity(w, p);
    double label = wave_label(w, p), drift = d.share * wave_drift(w, label);
    double slower = 1 / (1 - drift / (w->frame_speed + w->mean_velocity - w->transport));
    double growth = d.along_x * w->cos_heading + d.along_y * w->sin_heading;
    m.along = w->transport + (m.along - w->transport - drift) * slower;
    m.up = m.up * slower + growth * wave_drift_integral(w, label);
    return m;
}

Vec3 waves_zone_velocity(const WaveState *waves, Vec3 point, double time)
{
    if (waves->sea) return sea_velocity(waves, point, time);
    WaveTerms terms[WAVE_LAYERS_MAX];
    int count = waves_terms(waves, time, terms);
    double eta = elevation_sum(terms, count, point.x, point.y);
    DriftShare share = drift_share(&waves->interior, point.x, point.y);
    Vec3 sum = vec3(0, 0, 0);
    for (int i = 0; i < count; i++) {
        const WaveTerms *w = &terms[i];
        WavePlace p = wave_place(w, point.x, point.y, mind(point.z, w->level + eta));
        sum = motion_add(sum, w, driftless(w, p, share), w->weight);
    }
    return sum;
}
