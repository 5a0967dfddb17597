#include "series.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "energy.h"
#include "probes.h"
#include "step.h"

static const char *const BODY_COLUMNS[] = {
    "surge_m",    "sway_m",     "heave_m",    "roll_deg",    "pitch_deg",   "yaw_deg",
    "fluid_fx_n", "fluid_fy_n", "fluid_fz_n", "fluid_mx_nm", "fluid_my_nm", "fluid_mz_nm"};
static const char *const LINE_COLUMNS[] = {"fairlead_tension_n", "anchor_tension_n",
                                           "largest_tension_n", "touchdown_m"};
static const char *const GAUGE_COLUMNS[] = {"elevation_m"};
static const char *const PROBE_COLUMNS[] = {"pressure_pa"};
static const char *const RUN_UP_COLUMNS[] = {"run_up_m"};
static const char *const SLAMMING_COLUMNS[] = {"slam_fx_n", "slam_fy_n", "slam_fz_n"};
static const char *const GREEN_COLUMNS[] = {"green_volume_m3", "green_height_m"};

static const char *const HEIGHT_COLUMNS[] = {"height_ratio"};

#define COUNT_OF(array) (int)(sizeof(array) / sizeof *(array))

static_assert(1 + SCENE_BODIES_MAX * COUNT_OF(BODY_COLUMNS) +
                      SCENE_LINES_MAX * COUNT_OF(LINE_COLUMNS) + SCENE_GAUGES_MAX +
                      SCENE_PRESSURE_PROBES_MAX + SCENE_RUN_UPS_MAX + 3 * SCENE_SLAMMINGS_MAX +
                      2 * SCENE_GREEN_WATERS_MAX + QUALITY_GAUGES + 2 + ENERGY_COLUMNS_MAX <=
                  SERIES_COLUMNS_MAX,
              "every scene fits into a table");
static_assert(SCENE_NAME_SIZE + 24 <= SERIES_COLUMN_SIZE, "every name fits into a column's");

static void add_columns(SeriesTable *table, const char *owner, const char *const *columns,
                        int count)
{
    for (int i = 0; i < count; i++)
        snprintf(table->names[table->count++], SERIES_COLUMN_SIZE, "%s.%s", owner, columns[i]);
}

static void add_quality(const Scene *scene, SeriesTable *table)
{
    static const char *const reflection[] = {"reflection"}, *const gain[] = {"gain"};
    if (!wave_quality_asked(scene)) return;
    for (int i = 0; i < scene->quality_gauge_count; i++)
        add_columns(table, scene->gauges[scene->quality_gauges[i]].name, HEIGHT_COLUMNS, 1);
    if (scene->quality_gauge_count) add_columns(table, "wave_quality", reflection, 1);
    if (scene->waves.gain.gauge >= 0) add_columns(table, "wave_quality", gain, 1);
}

void series_table(const Scene *scene, SeriesTable *table)
{
    table->count = 0;
    snprintf(table->names[table->count++], SERIES_COLUMN_SIZE, "t_s");
    for (int i = 0; i < scene->body_count; i++)
        add_columns(table, scene->bodies[i].name, BODY_COLUMNS, COUNT_OF(BODY_COLUMNS));
    for (int i = 0; i < scene->line_count; i++)
        add_columns(table, scene->lines[i].name, LINE_COLUMNS, COUNT_OF(LINE_COLUMNS));
    for (int i = 0; i < scene->gauge_count; i++)
        add_columns(table, scene->gauges[i].name, GAUGE_COLUMNS, COUNT_OF(GAUGE_COLUMNS));
    for (int i = 0; i < scene->pressure_probe_count; i++)
        add_columns(table, scene->pressure_probes[i].name, PROBE_COLUMNS, COUNT_OF(PROBE_COLUMNS));
    for (int i = 0; i < scene->run_up_count; i++)
        add_columns(table, scene->run_ups[i].name, RUN_UP_COLUMNS, COUNT_OF(RUN_UP_COLUMNS));
    for (int i = 0; i < scene->slamming_count; i++)
        add_columns(table, scene->slammings[i].name, SLAMMING_COLUMNS, COUNT_OF(SLAMMING_COLUMNS));
    for (int i = 0; i < scene->green_water_count; i++)
        add_columns(table, scene->green_waters[i].name, GREEN_COLUMNS, COUNT_OF(GREEN_COLUMNS));
    add_quality(scene, table);
    if (scene->energy == ENERGY_NONE) return;
    EnergyColumn energy[ENERGY_COLUMNS_MAX];
    int energies = energy_columns(scene, NULL, energy);
    for (int i = 0; i < energies; i++)
        add_columns(table, "energy", &energy[i].name, 1);
}

static double *add_vector(double *row, Vec3 v)
{
    row[0] = v.x;
    row[1] = v.y;
    row[2] = v.z;
    return row + 3;
}

static double *sample_body(const Body *body, double *row)
{
    BodyMotion motion = body_motion(body);
    for (int i = 0; i < 6; i++)
        *row++ = i < 3 ? motion.value[i] : motion.value[i] * 180 / PI;
    row = add_vector(row, body->fluid_force);
    return add_vector(row, body->fluid_moment);
}

static double *sample_line(const Line *line, double *row)
{
    *row++ = line->tension[line->node_count - 2];
    *row++ = line->tension[0];
    *row++ = line->largest_tension;
    *row++ = line->touchdown;
    return row;
}

/// Add the time since `begin` to an effect's; the time now.
static double lap(State *state, EffectId effect, double begin)
{
    double now = step_clock();
    state->host_seconds[effect] += now - begin;
    return now;
}

static double *sample_quality(const Scene *scene, const State *state, double *row)
{
    if (!wave_quality_asked(scene)) return row;
    for (int i = 0; i < scene->quality_gauge_count; i++)
        *row++ = state->quality->gauge[i].height / state->waves->asked.height;
    if (scene->quality_gauge_count) *row++ = state->quality->reflection;
    if (scene->waves.gain.gauge >= 0) *row++ = state->waves->gain;
    return row;
}

static void sample_probes(const Scene *scene, State *state, double *row)
{
    double begin = step_clock();
    for (int i = 0; i < scene->gauge_count; i++)
        *row++ = probe_elevation(scene, state, i);
    if (scene->gauge_count) begin = lap(state, EFFECT_GAUGES, begin);
    for (int i = 0; i < scene->pressure_probe_count; i++)
        *row++ = probe_pressure(scene, state, i);
    if (scene->pressure_probe_count) begin = lap(state, EFFECT_PRESSURE_PROBES, begin);
    for (int i = 0; i < scene->run_up_count; i++)
        *row++ = probe_run_up(scene, state, i);
    if (scene->run_up_count) begin = lap(state, EFFECT_RUN_UP, begin);
    for (int i = 0; i < scene->slamming_count; i++)
        row = add_vector(row, state->slammings[i].force);
    for (int i = 0; i < scene->green_water_count; i++) {
        GreenWater water = probe_green_water(scene, state, i);
        *row++ = water.volume;
        *row++ = water.height;
    }
    if (scene->green_water_count) begin = lap(state, EFFECT_GREEN_WATER, begin);
    row = sample_quality(scene, state, row);
    if (scene->energy == ENERGY_NONE) return;
    EnergyColumn energy[ENERGY_COLUMNS_MAX];
    int energies = energy_columns(scene, state, energy);
    for (int i = 0; i < energies; i++)
        *row++ = energy[i].value;
    lap(state, EFFECT_ENERGY, begin);
}

void series_sample(const Scene *scene, const Plan *plan, State *state, double *row)
{
    *row++ = state->time;
    for (int i = 0; i < scene->body_count; i++)
        row = sample_body(&state->bodies[i], row);
    for (int i = 0; i < scene->line_count; i++)
        row = sample_line(&state->lines[i], row);
    sample_probes(scene, state, row);
}
