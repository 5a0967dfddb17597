#include "wave_quality.h"

#include <math.h>
#include <string.h>

static const double SAMPLES = 40; ///< of a period
/// Means run over so many periods; a sea's height over so many peak periods.
static const int PERIODS = 4, SEA_PERIODS = 30;
/// Periods after the last change that are left to settle, beside the wave's way to the gauge.
static const double SETTLE_PERIODS = 2;

WaveQuality wave_quality_create(void)
{
    WaveQuality quality;
    memset(&quality, 0, sizeof quality);
    quality.begun = quality.reflection = quality.settled = NAN;
    for (int i = 0; i < QUALITY_SLOTS; i++)
        quality.gauge[i].height = NAN;
    return quality;
}

bool wave_quality_asked(const Scene *scene)
{
    return scene->waves.kind != WAVES_NONE &&
           (scene->quality_gauge_count > 0 || scene->waves.gain.gauge >= 0);
}

/// Index of the gauge in a slot, -1 for none.
static int slot_gauge(const Scene *scene, int slot)
{
    if (slot == QUALITY_GAUGES) return scene->waves.gain.gauge;
    return slot < scene->quality_gauge_count ? scene->quality_gauges[slot] : -1;
}

double wave_reflection(double wave_number, int count, const double *along, const double *real,
                       const double *imaginary)
{
    // normal equations of the two unknowns; U = sum exp(-2ikx) couples them
    double Ur = 0, Ui = 0, Fr = 0, Fi = 0, Br = 0, Bi = 0;
    for (int p = 0; p < count; p++) {
        double c = cos(wave_number * along[p]), s = sin(wave_number * along[p]);
        Ur += c * c - s * s;
        Ui -= 2 * c * s;
        Fr += c * real[p] + s * imaginary[p]; // exp(-ikx) A
        Fi += c * imaginary[p] - s * real[p];
        Br += c * real[p] - s * imaginary[p]; // exp(ikx) A
        Bi += c * imaginary[p] + s * real[p];
    }
    double n = count, determinant = n * n - Ur * Ur - Ui * Ui;
    if (determinant < 0.05 * n * n) return NAN;
    // a = (n F - U B)/det, b = (n B - conj(U) F)/det
    double ar = n * Fr - (Ur * Br - Ui * Bi), ai = n * Fi - (Ur * Bi + Ui * Br);
    double br = n * Br - (Ur * Fr + Ui * Fi), bi = n * Bi - (Ur * Fi - Ui * Fr);
    return hypot(ar, ai) > 0 ? hypot(br, bi) / hypot(ar, ai) : NAN;
}

static void find_reflection(WaveQuality *quality, const Scene *scene, const WaveState *waves)
{
    const WaveTerms *w = &waves->layers[waves->layer_count - 1].train.terms;
    double along[QUALITY_GAUGES], real[QUALITY_GAUGES], imaginary[QUALITY_GAUGES];
    for (int i = 0; i < QUALITY_GAUGES; i++) {
        const GaugeScene *g = &scene->gauges[scene->quality_gauges[i]];
        along[i] = g->x * w->cos_heading + g->y * w->sin_heading;
        real[i] = quality->gauge[i].real[0];
        imaginary[i] = quality->gauge[i].imaginary[0];
    }
    quality->reflection = wave_reflection(w->wave_number, QUALITY_GAUGES, along, real, imaginary);
}

static void begin_period(WaveQuality *quality, double time)
{
    quality->begun = time;
    for (int i = 0; i < QUALITY_SLOTS; i++) {
        GaugeWave *g = &quality->gauge[i];
        memset(g->cosine, 0, sizeof g->cosine);
        memset(g->sine, 0, sizeof g->sine);
        g->square = 0;
    }
}

/// Crest to trough of the mean wave: single crests carry the noise of particles, which would count
/// as height.
static double mean_wave_height(const GaugeWave *g)
{
    double low = INFINITY, high = -INFINITY;
    for (int n = 0; n < 96; n++) {
        double eta = 0;
        for (int j = 0; j < QUALITY_HARMONICS; j++) {
            double angle = 2 * PI * (j + 1) * n / 96;
            eta += g->real[j] * cos(angle) + g->imaginary[j] * sin(angle);
        }
        low = mind(low, eta);
        high = maxd(high, eta);
    }
    return high - low;
}

/// Means over the last periods, closed at `time`.
static void end_period(WaveQuality *quality, const Scene *scene, const WaveState *waves,
                       double time)
{
    double length = time - quality->begun;
    int most = waves->sea ? SEA_PERIODS : PERIODS;
    double share = 1.0 / (quality->periods < most ? ++quality->periods : most);
    for (int i = 0; i < QUALITY_SLOTS; i++) {
        GaugeWave *g = &quality->gauge[i];
        if (slot_gauge(scene, i) < 0) continue;
        for (int j = 0; j < QUALITY_HARMONICS; j++) {
            g->real[j] += share * (g->cosine[j] / length - g->real[j]);
            g->imaginary[j] += share * (g->sine[j] / length - g->imaginary[j]);
        }
        // a sea's height is 4 standard deviations: its square is what is averaged
        double square = 16 * g->square / length;
        double before = quality->periods == 1 ? square : g->height * g->height;
        g->height = waves->sea ? sqrt(before + share * (square - before)) : mean_wave_height(g);
    }
    if (!waves->sea && scene->quality_gauge_count == QUALITY_GAUGES)
        find_reflection(quality, scene, waves);
}

/// Asked over measured height, at most `largest` and at least one over it; taken when the measured
/// one has settled and been averaged.
static void move_gain(WaveQuality *quality, const Scene *scene, WaveState *waves, double time)
{
    const WaveGain *gain = &scene->waves.gain;
    double height = quality->gauge[QUALITY_GAUGES].height, asked = waves->asked.height;
    int enough = waves->sea ? SEA_PERIODS : PERIODS;
    if (gain->gauge < 0 || quality->periods < enough || !(height > 0) || !(asked > 0)) return;
    double wanted = waves->gain * asked / height;
    wanted = mind(maxd(wanted, 1 / gain->largest), gain->largest);
    quality->periods = 0;
    if (fabs(wanted / waves->gain - 1) < 0.002) return; // below what the gauge can tell
    waves_set_gain(waves, scene, wanted, time);
}

/// Until when gauges still see the waves of before: the farthest of them is reached at the group's
/// speed (half the wave's, deep water's, at least).
static double settling(const Scene *scene, const WaveState *waves)
{
    const WaveTerms *w = &waves->layers[waves->layer_count - 1].train.terms;
    const Domain *d = &scene->domain;
    double way = d->max.x - d->min.x;
    if (d->kind == DOMAIN_BASIN) way = 0.5 * way;
    // against a current that all but stops them waves take long
    double group = 0.5 * w->frame_speed + current_along(&waves->current, waves->asked.heading);
    return SETTLE_PERIODS * waves->asked.period + way / maxd(group, 0.05 * w->frame_speed);
}

/// Adds what one gauge did between two samples, by the trapezoidal rule.
static void add_sample(GaugeWave *g, double omega, double from, double to, double eta0, double eta1)
{
    double half = 0.5 * (to - from);
    for (int j = 0; j < QUALITY_HARMONICS; j++) {
        double w = (j + 1) * omega;
        g->cosine[j] += 2 * half * (eta0 * cos(w * from) + eta1 * cos(w * to));
        g->sine[j] += 2 * half * (eta0 * sin(w * from) + eta1 * sin(w * to));
    }
    g->square += half * (eta0 * eta0 + eta1 * eta1);
}

/// A sample of every gauge; a period that ends on the way is closed there, by a straight line.
static void sample(WaveQuality *quality, const Scene *scene, const WaveState *waves, double time,
                   GaugeReader read, const void *context)
{
    double period = waves->asked.period, omega = 2 * PI / period, last = quality->sampled;
    double end = quality->begun + period, share = (end - last) / (time - last);
    bool closes = time >= end;
    double next[QUALITY_SLOTS] = {0}, between[QUALITY_SLOTS] = {0};
    for (int i = 0; i < QUALITY_SLOTS; i++) {
        GaugeWave *g = &quality->gauge[i];
        if (slot_gauge(scene, i) < 0) continue;
        next[i] = read(context, slot_gauge(scene, i));
        between[i] = closes ? g->eta + share * (next[i] - g->eta) : next[i];
        add_sample(g, omega, last, closes ? end : time, g->eta, between[i]);
    }
    if (closes) {
        end_period(quality, scene, waves, end);
        begin_period(quality, end);
    }
    for (int i = 0; i < QUALITY_SLOTS; i++) {
        if (closes) add_sample(&quality->gauge[i], omega, end, time, between[i], next[i]);
        quality->gauge[i].eta = next[i];
    }
    quality->sampled = time;
}

void wave_quality_advance(WaveQuality *quality, const Scene *scene, WaveState *waves, double time,
                          GaugeReader read, const void *context)
{
    if (waves->active || isnan(quality->settled)) quality->settled = time + settling(scene, waves);
    if (time < quality->settled || !(waves->asked.height > 0)) {
        quality->begun = NAN;
        quality->periods = 0;
        return;
    }
    if (isnan(quality->begun)) {
        begin_period(quality, time);
        quality->sampled = time;
        for (int i = 0; i < QUALITY_SLOTS; i++)
            if (slot_gauge(scene, i) >= 0)
                quality->gauge[i].eta = read(context, slot_gauge(scene, i));
        return;
    }
    if (time < quality->sampled + waves->asked.period / SAMPLES) return;
    sample(quality, scene, waves, time, read, context);
    move_gain(quality, scene, waves, time);
}
