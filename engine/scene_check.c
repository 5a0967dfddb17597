/// What must hold between the parts of a case. Ranges of single values are in scene_fields*.c.
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "physics/wave_theory.h"
#include "scene_case.h"
#include "waves.h"

/// Of State and scratch per particle; the engine's plan has the exact figure.
static const double BYTES_PER_PARTICLE = 250;
/// Slack of comparisons, relative: a value computed from the file's numbers may miss a limit by
/// rounding.
static const double SLACK = 1e-9;

static double water_depth(const Scene *scene) { return scene->fluid.level - scene->domain.min.z; }

/// The three components of a point, to loop over; in 2-D y is skipped.
static double component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
static bool axis_counts(const Scene *scene, int axis)
{
    return axis != 1 || scene->domain.dimensions == 3;
}

/// Index that the user typed for this axis: [x, z] in 2-D may be indices 0, 1.
static const char *axis_name(int axis) { return axis == 0 ? "x" : axis == 1 ? "y" : "z"; }

static bool check_domain(const JsonReader *reader, const Scene *scene)
{
    const Domain *domain = &scene->domain;
    double spacing = scene->fluid.spacing, level = scene->fluid.level;
    for (int axis = 0; axis < 3; axis++) {
        double min = component(domain->min, axis), max = component(domain->max, axis);
        if (axis_counts(scene, axis) && !(max - min >= spacing * (1 - SLACK)))
            return table_refuse_number(reader, "domain.max_m", max,
                                       "its %s must be >= %.9g m: min_m plus one fluid.spacing_m",
                                       axis_name(axis), min + spacing);
    }
    double lowest = domain->min.z + (scene->fluid.block_count ? 0 : spacing);
    if (level < lowest - SLACK * spacing || level > domain->max.z + SLACK * spacing)
        return table_refuse_number(reader, "fluid.level_m", level,
                                   "must be >= %.9g and <= %.9g m (within the domain, water of one "
                                   "spacing at least)",
                                   lowest, domain->max.z);
    return true;
}

static bool check_blocks(const JsonReader *reader, const Scene *scene)
{
    const Fluid *fluid = &scene->fluid;
    char at[JSON_PATH_SIZE];
    static const char *const kinds[] = {"tank", "flume", "basin", "domain of lines"};
    if (fluid->block_count && scene->domain.kind != DOMAIN_TANK)
        return table_refuse(reader, "fluid.blocks", NULL,
                            "must not be given for a %s: it is filled up to fluid.level_m",
                            kinds[scene->domain.kind]);
    for (int i = 0; i < fluid->block_count; i++)
        for (int axis = 0; axis < 3; axis++) {
            double low = component(scene->domain.min, axis);
            double high = component(scene->domain.max, axis);
            double min = component(fluid->blocks[i].min, axis);
            double max = component(fluid->blocks[i].max, axis);
            double slack = SLACK * (fabs(low) + fabs(high));
            if (!axis_counts(scene, axis)) continue;
            snprintf(at, sizeof at, "fluid.blocks[%d].min_m", i);
            if (min < low - slack || min > high)
                return table_refuse_number(reader, at, min,
                                           "its %s must be >= %.9g and <= %.9g m (the domain)",
                                           axis_name(axis), low, high);
            snprintf(at, sizeof at, "fluid.blocks[%d].max_m", i);
            if (max > high + slack || max - min < fluid->spacing * (1 - SLACK))
                return table_refuse_number(reader, at, max,
                                           "its %s must be >= %.9g m (min_m plus one spacing) and "
                                           "<= %.9g m (the domain)",
                                           axis_name(axis), min + fluid->spacing, high);
        }
    return true;
}

static bool check_standing_wave(const JsonReader *reader, const Scene *scene)
{
    const Fluid *fluid = &scene->fluid;
    if (!(fluid->standing_height > 0)) return true;
    if (scene->domain.kind != DOMAIN_TANK || fluid->block_count)
        return table_refuse(reader, "fluid.standing_wave", NULL,
                            "must only be given for a tank that is filled up to fluid.level_m");
    double depth = water_depth(scene);
    double number = fluid->standing_mode * PI / (scene->domain.max.x - scene->domain.min.x);
    double most =
        mind(wave_breaking_height(number, depth), 2 * (scene->domain.max.z - scene->fluid.level));
    if (fluid->standing_height <= most) return true;
    return table_refuse_number(reader, "fluid.standing_wave.height_m", fluid->standing_height,
                               "must be <= %.4g m here (0.142 L tanh(kd), below the walls' top)",
                               most);
}

/// A speed of sound below that of long waves makes compressible nonsense.
static bool check_sound_speed(const JsonReader *reader, const Scene *scene)
{
    double highest = scene->fluid.block_count ? scene->domain.min.z : scene->fluid.level;
    for (int i = 0; i < scene->fluid.block_count; i++)
        highest = maxd(highest, scene->fluid.blocks[i].max.z);
    double least = 3 * sqrt(scene->fluid.gravity * (highest - scene->domain.min.z));
    if (scene->fluid.sound_speed == 0 || scene->fluid.sound_speed >= least) return true;
    return table_refuse_number(reader, "fluid.sound_speed_ms", scene->fluid.sound_speed,
                               "must be 0 (by the rule) or >= %.3g (3 sqrt(g d)) and <= 5000 m/s",
                               least);
}

/// What needs molecular viscosity, and what it is not built with.
static bool check_viscosity(const JsonReader *reader, const Scene *scene)
{
    const Fluid *fluid = &scene->fluid;
    if (fluid->viscosity == 0 && fluid->turbulence == TURBULENCE_SPS)
        return table_refuse(reader, "fluid.turbulence", NULL,
                            "\"sps\" goes with molecular viscosity: must be \"none\", or "
                            "fluid.viscosity_m2s > 0 (water: 1e-6)");
    if (fluid->viscosity == 0 && fluid->walls == WALLS_NO_SLIP)
        return table_refuse(reader, "fluid.walls", NULL,
                            "without viscosity nothing holds the water: must be \"slip\", or "
                            "fluid.viscosity_m2s > 0 (water: 1e-6)");
    if (fluid->viscosity > 0 && fluid->gradient == GRADIENT_CORRECTED)
        return table_refuse(reader, "fluid.gradient", NULL,
                            "is not built with molecular viscosity: must be \"plain\", or "
                            "fluid.viscosity_m2s 0");
    return true;
}

double case_breaking_height(const Scene *scene, double period)
{
    double depth = water_depth(scene);
    double number = wave_number_airy(2 * PI / period, depth, scene->fluid.gravity);
    return wave_breaking_height(number, depth);
}

static bool check_heading(const JsonReader *reader, const Scene *scene)
{
    const Waves *waves = &scene->waves;
    double degrees = waves->initial.heading * 180 / PI;
    if (scene->domain.kind == DOMAIN_FLUME) {
        if (degrees != 0)
            return table_refuse_number(reader, "waves.heading_deg", degrees,
                                       "must be 0 in a flume (its waves travel to +x)");
        if (waves->heading_limits.min != 0 || waves->heading_limits.max != 0)
            return table_refuse(reader, "waves.limits.heading_deg", NULL,
                                "must be [0, 0] in a flume (its waves travel to +x)");
    } else if (scene->domain.dimensions == 2 && fabs(sin(waves->initial.heading)) > SLACK)
        return table_refuse_number(reader, "waves.heading_deg", degrees, "must be 0 or 180 in 2-D");
    return true;
}

static bool check_limit(const JsonReader *reader, const char *where, Range range, double initial,
                        double scale, const char *unit)
{
    double slack = SLACK * (1 + fabs(initial));
    if (initial >= range.min - slack && initial <= range.max + slack) return true;
    return table_refuse_number(reader, where, initial * scale,
                               "must be >= %.9g and <= %.9g %s (its waves.limits)",
                               range.min * scale, range.max * scale, unit);
}

static bool check_wave_heights(const JsonReader *reader, const Scene *scene)
{
    const Waves *waves = &scene->waves;
    const WaveTarget *sea = &waves->initial;
    double most = 2 * case_breaking_height(scene, sea->period);
    if (sea->height > most)
        return table_refuse_number(reader, "waves.height_m", sea->height,
                                   "must be >= 0 and <= %.4g m, twice the breaking height 0.142 L "
                                   "tanh(kd) at a period of %.9g s in %.9g m of water (Miche)",
                                   most, sea->period, water_depth(scene));
    double highest = waves->height_limits.max;
    most = 2 * case_breaking_height(scene, waves->period_limits.max);
    if (highest > most)
        return table_refuse_number(reader, "waves.limits.height_m", highest,
                                   "its largest must be <= %.4g m, twice the breaking height of "
                                   "the longest wave (Miche)",
                                   most);
    double top = scene->domain.max.z - scene->fluid.level;
    if (top < highest * (1 - SLACK))
        return table_refuse_number(reader, "domain.max_m", scene->domain.max.z,
                                   "its z must be >= %.9g m: the still water plus the largest "
                                   "wave height allowed",
                                   scene->fluid.level + highest);
    return true;
}

static bool check_current(const JsonReader *reader, const Scene *scene)
{
    const Waves *waves = &scene->waves;
    if (!(waves->current.speed > 0)) return true;
    if (scene->domain.kind == DOMAIN_TANK || scene->domain.kind == DOMAIN_FLUME)
        return table_refuse_number(reader, "waves.current.speed_ms", waves->current.speed,
                                   "must be 0 between fixed walls, which let nothing through; "
                                   "domain.kind \"basin\" and \"lines\" take it");
    double heading = waves->current.heading, most = sqrt(scene->fluid.gravity * water_depth(scene));
    if (scene->domain.dimensions == 2 && fabs(sin(heading)) > 1e-6)
        return table_refuse_number(reader, "waves.current.heading_deg", heading * 180 / PI,
                                   "must be 0 or 180 in 2-D");
    if (scene->domain.kind == DOMAIN_BASIN && waves->current.speed > most)
        return table_refuse_number(reader, "waves.current.speed_ms", waves->current.speed,
                                   "must be >= 0 and <= %.4g m/s (sqrt(g d): water that shoots "
                                   "carries no wave upstream)",
                                   most);
    if (waves->kind == WAVES_NONE || waves_may_run(scene, &waves->initial)) return true;
    return table_refuse_number(reader, "waves.current.speed_ms", waves->current.speed,
                               "must be slower: against it no wave of %.9g s can run",
                               waves->initial.period);
}

static bool check_spectrum(const JsonReader *reader, const Scene *scene)
{
    const Waves *waves = &scene->waves;
    const Domain *domain = &scene->domain;
    bool plane = domain->dimensions == 2 || domain->kind == DOMAIN_FLUME;
    if (waves->kind == WAVES_REGULAR || waves->kind == WAVES_RECORD) return true;
    if (plane && waves->spectrum.spreading > 0)
        return table_refuse_number(reader, "waves.spectrum.spreading", waves->spectrum.spreading,
                                   "must be 0 (long-crested) in 2-D and in a flume");
    if (waves->kind != WAVES_FOCUSED) return true;
    if (isnan(waves->focus.time))
        return table_refuse(reader, "waves.focus.time_s", NULL,
                            "is missing: must be >= 0 and <= 100000 s for a focused group");
    if (waves->focus.x < domain->min.x || waves->focus.x > domain->max.x)
        return table_refuse_number(reader, "waves.focus.x_m", waves->focus.x,
                                   "must be >= %.9g and <= %.9g m (the domain)", domain->min.x,
                                   domain->max.x);
    if (!plane && (waves->focus.y < domain->min.y || waves->focus.y > domain->max.y))
        return table_refuse_number(reader, "waves.focus.y_m", waves->focus.y,
                                   "must be >= %.9g and <= %.9g m (the domain)", domain->min.y,
                                   domain->max.y);
    return true;
}

static bool check_zone(const JsonReader *reader, const Scene *scene)
{
    const Waves *waves = &scene->waves;
    const Domain *domain = &scene->domain;
    double narrowest = domain->max.x - domain->min.x;
    if (domain->dimensions == 3) narrowest = mind(narrowest, domain->max.y - domain->min.y);
    if (domain->kind != DOMAIN_BASIN || waves_zone_width(scene) < narrowest / 2) return true;
    if (waves->zone_width == 0)
        return table_refuse(reader, "waves.zone_width_m", NULL,
                            "by the rule it would be %.3g m: must be given, > 0 and < %.9g m (half "
                            "of the basin's narrow side), or the basin larger",
                            waves_zone_width(scene), narrowest / 2);
    return table_refuse_number(reader, "waves.zone_width_m", waves->zone_width,
                               "must be >= 0 and < %.9g m (half of the basin's narrow side)",
                               narrowest / 2);
}

static bool check_waves(const JsonReader *reader, const Scene *scene)
{
    const Waves *waves = &scene->waves;
    const Domain *domain = &scene->domain;
    if (waves->kind == WAVES_NONE) return !scene_has_ring(scene) || check_zone(reader, scene);
    if (domain->kind == DOMAIN_TANK)
        return table_refuse(reader, "waves.kind", NULL,
                            "a tank has walls all round: must be \"none\", or domain.kind must be "
                            "\"basin\" or \"flume\"");
    if (waves->kind == WAVES_RECORD && domain->kind != DOMAIN_FLUME)
        return table_refuse(reader, "waves.kind", NULL,
                            "\"record\" moves a piston: domain.kind must be \"flume\"");
    TRY(check_heading(reader, scene));
    TRY(check_limit(reader, "waves.height_m", waves->height_limits, waves->initial.height, 1, "m"));
    TRY(check_limit(reader, "waves.period_s", waves->period_limits, waves->initial.period, 1, "s"));
    TRY(check_limit(reader, "waves.heading_deg", waves->heading_limits, waves->initial.heading,
                    180 / PI, "deg"));
    TRY(check_wave_heights(reader, scene));
    TRY(check_spectrum(reader, scene));
    return check_zone(reader, scene);
}

double case_particle_estimate(const Scene *scene, double spacing)
{
    const Domain *domain = &scene->domain;
    const Fluid *fluid = &scene->fluid;
    bool plane = domain->dimensions == 2;
    double length = domain->max.x - domain->min.x, height = domain->max.z - domain->min.z;
    double breadth = plane ? spacing : domain->max.y - domain->min.y;
    double water = fluid->block_count ? 0 : length * breadth * water_depth(scene);
    for (int i = 0; i < fluid->block_count; i++) {
        Vec3 size = vec3_sub(fluid->blocks[i].max, fluid->blocks[i].min);
        water += size.x * (plane ? spacing : size.y) * size.z;
    }
    double wall =
        ceil(2 * fluid->smoothing_ratio) * spacing; // dummy layers fill the kernel's reach
    double outer = (length + 2 * wall) * (plane ? spacing : breadth + 2 * wall) * (height + wall);
    return (water + outer - length * breadth * height) / (spacing * spacing * spacing);
}

double case_memory_available(void)
{
    return 0.75 * (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

bool case_check_memory(const JsonReader *reader, const Scene *scene, double memory)
{
    double spacing = scene->fluid.spacing, most = memory / BYTES_PER_PARTICLE;
    if (most > 2e9) most = 2e9; // particles are counted in 32 bits
    double count = case_particle_estimate(scene, spacing);
    if (count <= most) return true;
    double low = spacing, high = spacing;
    while (case_particle_estimate(scene, high) > most)
        high *= 2;
    while (high / low > 1.0001) {
        double middle = sqrt(low * high);
        *(case_particle_estimate(scene, middle) > most ? &low : &high) = middle;
    }
    double digit = pow(10, floor(log10(high)) - 2); // rounded up to three digits
    return table_refuse_number(reader, "fluid.spacing_m", spacing,
                               "makes %.3g particles, too many for memory (%.3g GB for them): "
                               "must be >= %.3g and <= 10 m here",
                               count, memory / 1e9, ceil(high / digit - SLACK) * digit);
}

bool case_check(const JsonReader *reader, const Scene *scene)
{
    TRY(check_domain(reader, scene));
    TRY(check_blocks(reader, scene));
    TRY(check_standing_wave(reader, scene));
    TRY(check_sound_speed(reader, scene));
    TRY(check_viscosity(reader, scene));
    TRY(check_current(reader, scene));
    TRY(check_waves(reader, scene));
    TRY(case_check_bodies(reader, scene));
    TRY(case_check_lines(reader, scene));
    TRY(case_check_probes(reader, scene));
    return scene->domain.kind == DOMAIN_LINES ||
           case_check_memory(reader, scene, case_memory_available());
}
