#include "sea.h"

#include <math.h>

/// Frequencies that components have, of the peak's: outside lie 1.5 % of Pierson & Moskowitz'
/// energy, less of JONSWAP's; the height asked for is kept.
static const double LOWEST = 0.6, HIGHEST = 3.0;

double sea_density(double x, double peak_enhancement)
{
    double s = x <= 1 ? 0.07 : 0.09, b = exp(-(x - 1) * (x - 1) / (2 * s * s));
    return pow(x, -5) * exp(-1.25 * pow(x, -4)) * pow(peak_enhancement, b);
}

uint64_t sea_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// In [0, 1), 53 bits.
static double random_unit(uint64_t *state) { return (double)(sea_random(state) >> 11) * 0x1p-53; }

enum { FINE = 4800 }; ///< steps of integrals over the spectrum

/// Irregular seas: components of equal energy, each at the centroid of its share of the spectrum.
/// Their frequencies have no common measure, so that the sea does not repeat itself.
static void shape_irregular(const Sea *sea, double gamma)
{
    double step = (HIGHEST - LOWEST) / FINE, total = 0, sum = 0, moment = 0, begun = 0;
    for (int i = 0; i < FINE; i++)
        total += sea_density(LOWEST + (i + 0.5) * step, gamma);
    for (int i = 0, n = 0; i < FINE; i++) {
        double x = LOWEST + (i + 0.5) * step, density = sea_density(x, gamma);
        sum += density;
        moment += x * density;
        if (n >= sea->count || sum < total * (n + 1) / sea->count * (1 - 1e-12)) continue;
        sea->shape[n].frequency = moment / (sum - begun);
        // Hs = 4 sqrt(m0), m0 = sum a^2/2
        sea->shape[n].share = 0.25 * sqrt(2.0 / sea->count);
        begun = sum;
        moment = 0;
        n++;
    }
}

/// Focused groups: NewWave, the mean shape around a high crest: amplitudes as S df. Equal steps of
/// frequency keep the sea quiet until the group comes again, after 1/df.
/// Source: Tromans, Anaturk & Hagemeijer (1991), ISOPE.
static void shape_focused(const Sea *sea, double gamma)
{
    double step = (HIGHEST - LOWEST) / sea->count, total = 0;
    for (int n = 0; n < sea->count; n++)
        total += sea_density(LOWEST + (n + 0.5) * step, gamma);
    for (int n = 0; n < sea->count; n++) {
        sea->shape[n].frequency = LOWEST + (n + 0.5) * step;
        // half: the height of a group counts twice its crest
        sea->shape[n].share = 0.5 * sea_density(sea->shape[n].frequency, gamma) / total;
    }
}

/// Angle below which lies `share` of D ~ cos^2s(theta/2), by the trapezoidal rule.
static double spread_angle(double s, double share)
{
    double total = 0, sum = 0, step = 2 * PI / FINE;
    for (int i = 0; i < FINE; i++)
        total += pow(fabs(cos(0.5 * (-PI + (i + 0.5) * step))), 2 * s);
    for (int i = 0; i < FINE; i++) {
        double density = pow(fabs(cos(0.5 * (-PI + (i + 0.5) * step))), 2 * s);
        if (sum + density >= share * total)
            return -PI + (i + (share * total - sum) / density) * step;
        sum += density;
    }
    return PI;
}

/// One direction and phase each. Directions are the middles of equal shares of the spreading, dealt
/// out at random (Fisher & Yates), so that few components suffice for the right spread.
static void shape_random(const Sea *sea, double s, uint64_t seed)
{
    uint64_t state = seed;
    for (int n = 0; n < sea->count; n++)
        sea->shape[n].turn = s > 0 ? spread_angle(s, (n + 0.5) / sea->count) : 0;
    for (int n = sea->count - 1; n > 0; n--) {
        int other = (int)(random_unit(&state) * (n + 1));
        double turn = sea->shape[n].turn;
        sea->shape[n].turn = sea->shape[other].turn;
        sea->shape[other].turn = turn;
    }
    for (int n = 0; n < sea->count; n++)
        sea->shape[n].phase = 2 * PI * random_unit(&state);
}

static bool layer_take(SeaLayer *layer, int count, Arena *arena, Error *error)
{
    double **arrays[] = {&layer->amplitude,   &layer->wave_number, &layer->angular_frequency,
                         &layer->turns_x,     &layer->turns_y,     &layer->turns,
                         &layer->depth_ratio, &layer->cosine,      &layer->sine};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        TRY(*arrays[i] = arena_take(arena, (size_t)count, sizeof(double), "sea", error));
    return true;
}

bool sea_create(const Scene *scene, Arena *arena, Sea **result, Error *error)
{
    const Spectrum *spectrum = &scene->waves.spectrum;
    const Domain *domain = &scene->domain;
    Sea *sea = arena_take(arena, 1, sizeof *sea, "sea", error);
    TRY(sea);
    sea->count = spectrum->components;
    TRY(sea->shape = arena_take(arena, (size_t)sea->count, sizeof *sea->shape, "sea", error));
    for (int i = 0; i < WAVE_LAYERS_MAX; i++)
        TRY(layer_take(&sea->layers[i], sea->count, arena, error));
    sea->second = domain->kind == DOMAIN_FLUME && scene->waves.piston_order > 1;
    for (int i = 0; i < WAVE_LAYERS_MAX && sea->second; i++)
        TRY(piston_pairs_take(&sea->layers[i].pairs, sea->count, arena, error));
    sea->depth = scene->fluid.level - domain->min.z;
    sea->level = scene->fluid.level;
    sea->gravity = scene->fluid.gravity;
    sea->piston_x = domain->min.x;
    sea->slowest = PI * sqrt(sea->gravity * sea->depth) / (domain->max.x - domain->min.x);
    sea->plane = domain->dimensions == 2;
    sea->centre_x = (domain->min.x + domain->max.x) / 2;
    sea->centre_y = sea->plane ? 0 : (domain->min.y + domain->max.y) / 2;
    sea->focused = scene->waves.kind == WAVES_FOCUSED;
    sea->focus_x = scene->waves.focus.x;
    sea->focus_y = sea->plane ? 0 : scene->waves.focus.y;
    sea->focus_time = scene->waves.focus.time;
    double gamma = spectrum->kind == SPECTRUM_JONSWAP ? spectrum->peak_enhancement : 1;
    (sea->focused ? shape_focused : shape_irregular)(sea, gamma);
    shape_random(sea, spectrum->spreading, (uint64_t)spectrum->seed);
    *result = sea;
    return true;
}

/// What the piston does beside the strokes. It begins at its mean place: a group's differences hold
/// it elsewhere between groups, and getting there would be a long wave of its own. A group has no
/// slower difference than its step of frequency; of an irregular sea those below the flume's lowest
/// seiche are no waves there, and the travel would grow without bound as they get slower.
static void make_second(const Sea *sea, SeaLayer *layer)
{
    double amplitude[SCENE_COMPONENTS_MAX], cosine[SCENE_COMPONENTS_MAX];
    double sine[SCENE_COMPONENTS_MAX];
    for (int i = 0; i < sea->count; i++) {
        double angle = -2 * PI * (layer->turns_x[i] * sea->piston_x + layer->turns[i]);
        amplitude[i] = layer->amplitude[i] * (1 - layer->depth_ratio[i]);
        cosine[i] = cos(angle);
        sine[i] = sin(angle);
    }
    piston_pairs_make(&layer->pairs, amplitude, layer->angular_frequency, sea->depth, sea->gravity,
                      sea->focused ? 0 : sea->slowest);
    layer->pairs_start = piston_pairs_sum(&layer->pairs, cosine, sine);
}

/// A component's wave number on the current; `omega` comes as what a gauge sees and goes as what
/// the water feels. @return NAN where the current lets no such wave run
static double number_on_current(const Sea *sea, const Current *current, double heading,
                                double *omega)
{
    double along = current->speed > 0 ? current_along(current, heading) : 0;
    double k = current_wave_number(*omega, along, sea->depth, sea->gravity);
    *omega -= k * along;
    return k;
}

static void layer_make(const Sea *sea, SeaLayer *layer, const WaveTarget *target,
                       double time_origin, const Current *current)
{
    Vec3 way =
        vec3_sub(current_travel(current, sea->focus_time), current_travel(current, time_origin));
    layer->target = *target;
    layer->time_origin = time_origin;
    layer->made = true;
    for (int i = 0; i < sea->count; i++) {
        const SeaShape *shape = &sea->shape[i];
        double omega = 2 * PI * shape->frequency / target->period;
        double heading = target->heading + shape->turn, share = shape->share;
        double k = number_on_current(sea, current, heading, &omega);
        if (isnan(k)) { // blocked: the sea goes without it
            share = 0;
            omega = 2 * PI * shape->frequency / target->period;
            k = wave_theory_number(omega, sea->depth, sea->gravity);
        }
        double c = cos(heading), s = sea->plane ? 0 : sin(heading);
        layer->angular_frequency[i] = omega;
        layer->wave_number[i] = k;
        layer->depth_ratio[i] = exp(-2 * k * sea->depth);
        layer->amplitude[i] = target->height * share / (1 - layer->depth_ratio[i]);
        layer->cosine[i] = c;
        layer->sine[i] = s;
        layer->turns_x[i] = k * c / (2 * PI);
        layer->turns_y[i] = k * s / (2 * PI);
        double x = sea->focused ? sea->focus_x : sea->centre_x;
        double y = sea->focused ? sea->focus_y : sea->centre_y;
        double phase = shape->phase;
        if (sea->focused)
            phase = omega * (sea->focus_time - time_origin) + k * (way.x * c + way.y * s);
        layer->turns[i] =
            remainder(phase / (2 * PI) - layer->turns_x[i] * x - layer->turns_y[i] * y, 1);
    }
    if (sea->second && target->height > 0) make_second(sea, layer);
}

void sea_refresh(Sea *sea, const WaveState *waves)
{
    for (int i = 0; i < waves->layer_count; i++) {
        WaveTarget gained = waves->layers[i].target;
        gained.height *= waves->layers[i].gain;
        const WaveTarget *target = &gained;
        double origin = waves->layers[i].train.time_origin;
        SeaLayer *layer = &sea->layers[i];
        const WaveTarget *made = &layer->target;
        bool same = layer->made && layer->time_origin == origin && made->height == target->height &&
                    made->period == target->period && made->heading == target->heading;
        if (!same) layer_make(sea, layer, target, origin, &waves->current);
    }
}
