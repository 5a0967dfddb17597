#include "effects.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "contact.h"
#include "line_water.h"
#include "slamming.h"
#include "wave_quality.h"
#include "waves.h"

/// Bytes that one more particle of each set takes: its slots, the checkpoint, its share of the
/// lists of neighbours; and what every run takes. Measured: test_memory compares.
enum { FLUID_BYTES = 140, FIXED_BYTES = 135, MOVING_BYTES = 270, RUN_BYTES = 2000000 };
/// And per fluid particle where works are measured, padding of clusters included.
enum { WORKS_BYTES = 70 };

/// And where gradients are corrected.
enum { GRADIENT_BYTES = 25 };

/// Per fluid particle where turbulence keeps a stress; per dummy where walls hold the water.
enum { STRESS_BYTES = 25, MIRROR_BYTES = 13 };

/// Per fluid particle where particles are shifted.
enum { SHIFT_BYTES = 17 };

void effects_name(EffectPlan effects[EFFECT_COUNT])
{
    static const EffectPlan table[EFFECT_COUNT] = {
#define EFFECT(id, name_, kind_, called_by_, arrays_, step_, source_)                              \
    {.name = name_,                                                                                \
     .kind = kind_,                                                                                \
     .called_by = called_by_,                                                                      \
     .arrays = arrays_,                                                                            \
     .step = step_,                                                                                \
     .source = source_,                                                                            \
     .step_limit = INFINITY},
#include "effects.def"
#undef EFFECT
    };
    memcpy(effects, table, sizeof table);
    effects[EFFECT_VISCOSITY].cost = effects[EFFECT_DIFFUSION].cost = COST_SAMPLED;
    effects[EFFECT_GRADIENT].cost = effects[EFFECT_LAMINAR].cost = COST_SAMPLED;
    effects[EFFECT_TURBULENCE].cost = effects[EFFECT_NO_SLIP].cost = COST_SAMPLED;
    effects[EFFECT_SURFACE].cost = COST_ELSEWHERE;
}

/// Switch an effect on or off, and say why.
__attribute__((format(printf, 5, 6))) static void set(Plan *plan, EffectId id, bool active,
                                                      size_t bytes, const char *format, ...)
{
    EffectPlan *effect = &plan->effects[id];
    va_list values;
    effect->active = active;
    effect->bytes = active ? bytes : 0;
    va_start(values, format);
    vsnprintf(effect->because, sizeof effect->because, format, values);
    va_end(values);
}

/// A probe that keeps nothing: on when the case has some.
static void set_probe(Plan *plan, EffectId id, int count, size_t bytes, const char *key)
{
    set(plan, id, count > 0, bytes, count ? "probes.%s: %d" : "no probes.%s", key, count);
}

static void choose_pairs(const Scene *scene, Plan *plan, const Fill *fill)
{
    const Fluid *fluid = &scene->fluid;
    bool water = scene->domain.kind != DOMAIN_LINES;
    int moving = fill->ring_count + fill->piston_count + fill->body_count;
    set(plan, EFFECT_VISCOSITY, water && fluid->alpha > 0, 0,
        water ? "fluid.alpha = %g" : "no water particles", fluid->alpha);
    set(plan, EFFECT_DIFFUSION, water && fluid->delta > 0, 4 * (size_t)fill->fluid_count,
        water ? "fluid.delta = %g" : "no water particles", fluid->delta);
    bool corrected = fluid->gradient == GRADIENT_CORRECTED;
    set(plan, EFFECT_GRADIENT, water && corrected, GRADIENT_BYTES * (size_t)fill->fluid_count,
        water ? "fluid.gradient = %s" : "no water particles", corrected ? "corrected" : "plain");
    bool sps = fluid->turbulence == TURBULENCE_SPS, holds = fluid->walls == WALLS_NO_SLIP;
    int dummies = fill->wall_count + moving;
    set(plan, EFFECT_LAMINAR, water && fluid->viscosity > 0, 0,
        water ? "fluid.viscosity_m2s = %g" : "no water particles", fluid->viscosity);
    set(plan, EFFECT_TURBULENCE, water && sps, STRESS_BYTES * (size_t)fill->fluid_count,
        water ? "fluid.turbulence = %s" : "no water particles", sps ? "sps" : "none");
    set(plan, EFFECT_NO_SLIP, water && holds, MIRROR_BYTES * (size_t)dummies,
        water ? "fluid.walls = %s" : "no water particles", holds ? "no_slip" : "slip");
    set(plan, EFFECT_SHIFTING, water && fluid->shifting > 0,
        SHIFT_BYTES * (size_t)fill->fluid_count,
        water ? "fluid.shifting = %g" : "no water particles", fluid->shifting);
    set(plan, EFFECT_MOVING_BOUNDARIES, moving > 0, 0,
        moving ? "%d dummies of ring, piston or bodies move" : "nothing but water moves", moving);
    set(plan, EFFECT_WALLS, fill->wall_count > 0, (size_t)FIXED_BYTES * (size_t)fill->wall_count,
        fill->wall_count ? "domain.kind: %d dummy particles in %d layers" : "no fixed walls",
        fill->wall_count, plan->wall_layers);
}

static void choose_waves(const Scene *scene, Plan *plan, const Fill *fill)
{
    bool waves = scene->waves.kind != WAVES_NONE;
    bool basin = scene_has_ring(scene);
    const char *why = waves ? "waves" : "a current";
    bool flume = waves && scene->domain.kind == DOMAIN_FLUME;
    const char *off = !waves && !basin ? "waves.kind is none"
                      : basin          ? "waves of a basin come from its ring"
                                       : "waves of a flume come from its piston";
    set(plan, EFFECT_RING, basin, (size_t)MOVING_BYTES * (size_t)fill->ring_count,
        basin ? "%s in a basin: %d moving dummies" : off, why, fill->ring_count);
    set(plan, EFFECT_ZONE, basin, 0, basin ? "%s in a basin: %.3g m wide" : off, why,
        plan->zone_width);
    set(plan, EFFECT_PISTON, flume, (size_t)MOVING_BYTES * (size_t)fill->piston_count,
        flume ? "waves in a flume: %d moving dummies, order %d, travel within %.3g m" : off,
        fill->piston_count, scene->waves.piston_order, plan->wall_reach);
    if (plan->piston) {
        const MotionTable *record = plan->piston;
        set(plan, EFFECT_PISTON, flume, (size_t)MOVING_BYTES * (size_t)fill->piston_count,
            "waves.piston_motion: %d dummies follow %d rows from %.4g to %.4g s, within %.3g m",
            fill->piston_count, record->count, record->time[0], record->time[record->count - 1],
            record->reach);
    }
    set(plan, EFFECT_BEACH, flume, 0, flume ? "waves in a flume: %.3g m long" : off,
        plan->zone_width);
}

static void choose_current(const Scene *scene, Plan *plan, const Fill *fill)
{
    double speed = scene->waves.current.speed;
    size_t carried = sizeof(Vec3) * (size_t)(fill->ring_count + fill->body_count);
    bool ring = scene_has_ring(scene);
    set(plan, EFFECT_CURRENT, speed > 0, ring ? carried : 0,
        speed > 0 ? "waves.current: %.3g m/s" : "no waves.current", speed);
    if (!ring) plan->effects[EFFECT_CURRENT].cost = COST_ELSEWHERE;
}

/// "free: surge heave; prescribed: pitch; fixed: sway roll yaw", over all bodies. A freedom that
/// differs between bodies stands under each word. @return whether any is not fixed
static bool list_freedoms(const Scene *scene, char *text, size_t size)
{
    static const char *const kinds[] = {"free", "fixed", "prescribed", "sprung"};
    static const char *const names[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    static const int order[] = {FREEDOM_FREE, FREEDOM_SPRING, FREEDOM_PRESCRIBED, FREEDOM_FIXED};
    size_t used = 0;
    bool moves = false;
    text[0] = 0;
    for (int k = 0; k < 4; k++) {
        bool any = false;
        for (int f = 0; f < 6; f++) {
            bool has = false;
            for (int b = 0; b < scene->body_count; b++)
                has = has || (int)scene->bodies[b].freedoms[f].kind == order[k];
            if (!has || used >= size) continue;
            if (!any)
                used += (size_t)snprintf(text + used, size - used, "%s%s:", used ? "; " : "",
                                         kinds[order[k]]);
            if (used < size) used += (size_t)snprintf(text + used, size - used, " %s", names[f]);
            any = true;
            moves = moves || order[k] != FREEDOM_FIXED;
        }
    }
    return moves;
}

static void choose_bodies_and_lines(const Scene *scene, Plan *plan, const Fill *fill)
{
    int bodies = scene->body_count, lines = scene->line_count;
    char freedoms[128];
    bool moves = list_freedoms(scene, freedoms, sizeof freedoms),
         touch = bodies && contact_possible(scene);
    set(plan, EFFECT_BODIES, bodies > 0, (size_t)MOVING_BYTES * (size_t)fill->body_count,
        bodies ? "bodies: %d, %d dummy particles" : "no bodies", bodies, fill->body_count);
    set(plan, EFFECT_BODY_MOTION, moves, 0, "%s", bodies ? freedoms : "no bodies");
    set(plan, EFFECT_CONTACTS, touch, 0, "%s",
        touch    ? "bodies that may move into bed, walls or each other"
        : bodies ? "no body moves freely, or contacts.kind is none"
                 : "no bodies");
    size_t nodes = 0;
    for (int l = 0; l < lines; l++)
        nodes += (size_t)scene->lines[l].segments + 1;
    set(plan, EFFECT_LINES, lines > 0, nodes * 40 * sizeof(double),
        lines ? "lines: %d, %zu nodes" : "no lines", lines, nodes);
    bool simulated = lines && line_water_is_simulated(scene);
    set(plan, EFFECT_LINE_WATER, simulated, 0, "%s",
        simulated ? "a line asks for the simulated water"
        : lines   ? "lines feel the incident water"
                  : "no lines");
}

static void choose_probes(const Scene *scene, Plan *plan, const Fill *fill)
{
    static const char *const energies[] = {"is none", "is levels", "is budget: sweeps run thrice"};
    size_t works = (size_t)WORKS_BYTES * (size_t)fill->fluid_count;
    set_probe(plan, EFFECT_GAUGES, scene->gauge_count, 0, "gauges");
    bool quality = wave_quality_asked(scene);
    set(plan, EFFECT_WAVE_QUALITY, quality, 0, "%s",
        !quality                       ? "no waves, probes.wave_quality or waves.gain"
        : scene->waves.gain.gauge >= 0 ? "waves.gain"
                                       : "probes.wave_quality");
    set_probe(plan, EFFECT_PRESSURE_PROBES, scene->pressure_probe_count, 0, "pressure");
    set_probe(plan, EFFECT_RUN_UP, scene->run_up_count, 0, "run_up");
    set_probe(plan, EFFECT_SLAMMING, scene->slamming_count,
              2 * (size_t)scene->slamming_count * sizeof(Slamming), "slamming");
    set_probe(plan, EFFECT_GREEN_WATER, scene->green_water_count, 0, "green_water");
    set(plan, EFFECT_ENERGY, scene->energy != ENERGY_NONE,
        scene->energy == ENERGY_BUDGET ? works : 0, "probes.energy %s", energies[scene->energy]);
    set(plan, EFFECT_SURFACE, plan->options.pictures, 0, "%s",
        plan->options.pictures ? "pictures are drawn, beside the steps" : "no pictures are drawn");
}

void effects_choose(const Scene *scene, Plan *plan, const Fill *fill)
{
    choose_pairs(scene, plan, fill);
    choose_waves(scene, plan, fill);
    choose_current(scene, plan, fill);
    choose_bodies_and_lines(scene, plan, fill);
    choose_probes(scene, plan, fill);
    plan->bytes = RUN_BYTES + (size_t)FLUID_BYTES * (size_t)fill->fluid_count;
    for (int e = 0; e < EFFECT_COUNT; e++)
        plan->bytes += plan->effects[e].bytes;
}
