/// What of the waves is known before anything runs: sizes, what to warn of, what to tell.
#include <stdio.h>
#include <string.h>

#include "piston.h"
#include "waves.h"

/// Width of the relaxation zone and length of the beach in longest wave lengths (docs/physics.md).
static const double ZONE_LENGTHS = 0.75, BEACH_LENGTHS = 1.0;
/// And the least that a zone without waves has.
static const double ZONE_SPACINGS = 10;
/// Expected largest of 1000 waves over the significant height, Rayleigh: sqrt(ln(1000)/2).
/// Source: Longuet-Higgins (1952), J. Mar. Res. 11, 245.
static const double LARGEST_OF_SEA = 1.86;

static double basin_depth(const Scene *scene) { return scene->fluid.level - scene->domain.min.z; }

/// Of the wave that rides on the scene's current, at its heading to begin with.
static double wave_length(const Scene *scene, double period)
{
    double along = current_along(&scene->waves.current, scene->waves.initial.heading);
    double k =
        current_wave_number(2 * PI / period, along, basin_depth(scene), scene->fluid.gravity);
    if (isnan(k)) k = wave_number_airy(2 * PI / period, basin_depth(scene), scene->fluid.gravity);
    return 2 * PI / k;
}

bool waves_may_run(const Scene *scene, const WaveTarget *target)
{
    double along = current_along(&scene->waves.current, target->heading);
    return !isnan(current_wave_number(2 * PI / target->period, along, basin_depth(scene),
                                      scene->fluid.gravity));
}

double waves_zone_width(const Scene *scene)
{
    const Current *current = &scene->waves.current;
    bool waves = scene->waves.kind != WAVES_NONE;
    if (scene->domain.kind == DOMAIN_TANK || !(waves || scene_has_ring(scene))) return 0;
    if (scene->waves.zone_width > 0) return scene->waves.zone_width;
    // the waves that stand still on a current are the longest that a body in it makes
    double standing = 2 * PI * current->speed * current->speed / scene->fluid.gravity;
    if (!waves) return maxd(ZONE_LENGTHS * standing, ZONE_SPACINGS * scene->fluid.spacing);
    double longest = scene->waves.initial.period;
    if (scene->waves.period_limits.max > longest) longest = scene->waves.period_limits.max;
    double lengths = scene->domain.kind == DOMAIN_FLUME ? BEACH_LENGTHS : ZONE_LENGTHS;
    return lengths * wave_length(scene, longest);
}

double waves_wall_reach(const Scene *scene)
{
    const Waves *w = &scene->waves;
    if (w->kind == WAVES_NONE) return 0;
    double height = maxd(w->initial.height, w->height_limits.max);
    double k = 2 * PI / wave_length(scene, maxd(w->initial.period, w->period_limits.max));
    double kd = k * basin_depth(scene);
    // first order at the surface, a quarter more for the second; of a sea the largest of 1000 waves
    double ratio = scene->domain.kind == DOMAIN_FLUME ? piston_stroke_ratio(kd) : 1 / tanh(kd);
    return 1.25 * 0.5 * height * (w->kind == WAVES_IRREGULAR ? LARGEST_OF_SEA : 1) * ratio;
}

/// Appends one warning; counts it even where the text has no room left.
static void warn(char *text, int size, int *count, const char *warning)
{
    int used = size > 0 ? (int)strlen(text) : 0;
    if (size > 0) snprintf(text + used, (size_t)(size - used), "%s%s", *count ? "; " : "", warning);
    (*count)++;
}

/// Of regular waves; auto where there are none.
static WaveTheory theory_used(const Scene *scene)
{
    if (scene->waves.kind != WAVES_REGULAR || !(scene->waves.initial.height > 0))
        return WAVE_THEORY_AUTO;
    WaveState waves = waves_create(scene);
    return waves.layers[waves.layer_count - 1].train.theory;
}

int waves_warnings(const Scene *scene, char *text, int size)
{
    int count = 0;
    char line[200];
    if (size > 0) text[0] = '\0';
    if (scene->waves.kind == WAVES_NONE) return 0;
    const WaveTarget *sea = &scene->waves.initial;
    double depth = basin_depth(scene), length = wave_length(scene, sea->period);
    double breaking = wave_breaking_height(2 * PI / length, depth);
    double largest = sea->height * (scene->waves.kind == WAVES_IRREGULAR ? LARGEST_OF_SEA : 1);
    const char *which =
        scene->waves.kind == WAVES_IRREGULAR ? "largest of 1000 waves, 1.86 Hs =" : "wave height";
    if (largest > 0.8 * breaking) {
        snprintf(line, sizeof line,
                 "%s %.3g m %s: %.0f %% of the breaking height 0.142 L tanh(kd) = %.3g m (Miche)",
                 which, largest, largest > breaking ? "breaks" : "is near breaking",
                 100 * largest / breaking, breaking);
        warn(text, size, &count, line);
    }
    double resolution = sea->height / scene->fluid.spacing;
    if (sea->height > 0 && resolution < 5) {
        snprintf(line, sizeof line,
                 "H/dp = %.2g: under 5 spacings to a wave height waves lose height", resolution);
        warn(text, size, &count, line);
    }
    WaveTheory theory = theory_used(scene), asked = scene->waves.theory;
    if (theory == WAVE_THEORY_STOKES2 && asked != theory)
        warn(text, size, &count,
             "no wave by the asked theory is so high (or its crest is too sharp to be followed): "
             "Stokes' to second order instead");
    double ursell = sea->height * length * length / (depth * depth * depth);
    bool stokes = theory == WAVE_THEORY_STOKES2 || theory == WAVE_THEORY_STOKES5;
    if (ursell > URSELL_OF_SECOND_ORDER && stokes) {
        snprintf(line, sizeof line,
                 "water is too shallow for Stokes' waves (Ursell number H L^2/d^3 = %.3g > %d)",
                 ursell, URSELL_OF_SECOND_ORDER);
        warn(text, size, &count, line);
    }
    bool still = false;
    for (int l = 0; l < scene->line_count; l++)
        still = still || scene->lines[l].water == LINE_WATER_INCIDENT;
    if (scene->waves.kind == WAVES_RECORD && still)
        warn(text, size, &count,
             "lines whose water is \"incident\" feel none: what a record makes is only known from "
             "the simulated water (\"sph\")");
    if (scene->domain.kind != DOMAIN_BASIN) return count;
    const Domain *domain = &scene->domain;
    double inside = domain->max.x - domain->min.x;
    if (domain->dimensions == 3) inside = mind(inside, domain->max.y - domain->min.y);
    inside -= 2 * waves_zone_width(scene);
    if (inside < length) {
        snprintf(line, sizeof line,
                 "undriven interior is %.3g m wide, under one wave length (%.3g m)", inside,
                 length);
        warn(text, size, &count, line);
    }
    return count;
}

void waves_tell(const Scene *scene, char *text, int size)
{
    static const char *const kinds[] = {"none", "regular, height", "irregular, significant height",
                                        "focused, twice the crest",
                                        "piston follows a record; largest wave expected"};
    static const char *const theories[] = {"", "Airy", "Stokes 2", "Stokes 5", "stream function"};
    const WaveTarget *sea = &scene->waves.initial;
    int used =
        snprintf(text, (size_t)size, "%s %.4g m, period %.4g s, heading %.4g deg",
                 kinds[scene->waves.kind], sea->height, sea->period, sea->heading * 180 / PI);
    if (used < 0 || used >= size) return;
    if (scene->waves.kind == WAVES_RECORD) {
        const char *slash = strrchr(scene->waves.piston_path, '/');
        snprintf(text + used, (size_t)(size - used), ", length %.4g m; %.80s",
                 wave_length(scene, sea->period), slash ? slash + 1 : scene->waves.piston_path);
        return;
    }
    if (scene->waves.kind == WAVES_REGULAR && !(sea->height > 0)) {
        snprintf(text + used, (size_t)(size - used), "; still");
        return;
    }
    if (scene->waves.kind != WAVES_REGULAR) {
        snprintf(text + used, (size_t)(size - used), "; %d components, peak's length %.4g m",
                 scene->waves.spectrum.components, wave_length(scene, sea->period));
        return;
    }
    WaveState waves = waves_create(scene);
    const WaveTerms *w = &waves.layers[waves.layer_count - 1].train.terms;
    snprintf(text + used, (size_t)(size - used),
             "; length %.4g m, speed %.4g m/s%s, return current %.3g m/s (%s, %d harmonics)",
             2 * PI / w->wave_number, w->angular_frequency / w->wave_number,
             scene->waves.current.speed > 0 ? " in the water" : "", -w->mean_velocity,
             theories[waves.layers[waves.layer_count - 1].train.theory], w->harmonics);
}
