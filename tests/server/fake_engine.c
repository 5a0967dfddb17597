// engine.h without physics: a sine wave travels through a small basin and a box bobs on it. What it
// does is exact and cheap, so that tests of threads, sockets and files know what to expect.
// A case may say "fail_at_s", "recover_at_s", "step_ms" (wall time of a step) and "time_step_s".
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "engine.h"

enum { GRID = 40 };

/// What the case told the fake; the real engine has no such thing.
static struct {
    double fail_at, recover_at, step_wall, time_step;
} fake = {INFINITY, INFINITY, 0, 0.004};

static const float cube_corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                        {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
static const int cube_face[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                     {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                     {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

Scene scene_default(void)
{
    Scene scene = {.name = "fake", .title = "fake"};
    scene.domain = (Domain){DOMAIN_BASIN, 3, {-4, -4, -2}, {4, 4, 1}};
    scene.fluid.spacing = 0.1;
    scene.fluid.density = 1000;
    scene.fluid.gravity = 9.81;
    scene.waves.kind = WAVES_REGULAR;
    scene.waves.initial = (WaveTarget){0.3, 1.58, 0};
    scene.waves.height_limits = (Range){0, 0.5};
    scene.waves.period_limits = (Range){1.0, 3.0};
    scene.waves.heading_limits = (Range){-PI, PI};
    scene.body_count = 1;
    snprintf(scene.bodies[0].name, SCENE_NAME_SIZE, "ship");
    scene.line_count = 1;
    snprintf(scene.lines[0].name, SCENE_NAME_SIZE, "bow_line");
    scene.gauge_count = 1;
    snprintf(scene.gauges[0].name, SCENE_NAME_SIZE, "g1");
    scene.outputs.series_interval = 0.02;
    scene.camera = (CameraScene){{0, 0, 0}, 12, 0.8, 0.4};
    return scene;
}

static bool apply_override(Scene *scene, const char *text, Error *error)
{
    double value;
    if (sscanf(text, "waves.height_m=%lf", &value) == 1)
        scene->waves.initial.height = value;
    else if (sscanf(text, "fail_at_s=%lf", &value) == 1)
        fake.fail_at = value;
    else if (sscanf(text, "recover_at_s=%lf", &value) == 1)
        fake.recover_at = value;
    else if (sscanf(text, "step_ms=%lf", &value) == 1)
        fake.step_wall = value * 1e-3;
    else
        return error_set(error, ERROR_INPUT, "--set %s: unknown key", text);
    return true;
}

static double number(const cJSON *root, const char *key, double otherwise)
{
    const cJSON *item = cJSON_GetObjectItem(root, key);
    return cJSON_IsNumber(item) ? item->valuedouble : otherwise;
}

bool scene_load(const char *path, const char *const *overrides, int override_count, Scene *scene,
                Error *error)
{
    char text[4096];
    FILE *file = fopen(path, "r");
    if (!file) return error_set(error, ERROR_INPUT, "%s: cannot read", path);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    cJSON *root = cJSON_Parse(text);
    if (!root) return error_set(error, ERROR_INPUT, "%s: not JSON", path);
    *scene = scene_default();
    const char *slash = strrchr(path, '/');
    snprintf(scene->name, sizeof scene->name, "%s", slash ? slash + 1 : path);
    if (strchr(scene->name, '.')) *strchr(scene->name, '.') = 0;
    snprintf(scene->path, sizeof scene->path, "%s", path);
    const cJSON *title = cJSON_GetObjectItem(root, "title");
    if (cJSON_IsString(title))
        snprintf(scene->title, sizeof scene->title, "%s", title->valuestring);
    scene->hash = 0xfeedULL;
    fake.fail_at = number(root, "fail_at_s", INFINITY);
    fake.recover_at = number(root, "recover_at_s", INFINITY);
    fake.step_wall = number(root, "step_ms", 0) * 1e-3;
    fake.time_step = number(root, "time_step_s", 0.004);
    cJSON_Delete(root);
    for (int i = 0; i < override_count; i++)
        TRY(apply_override(scene, overrides[i], error));
    return true;
}

static const EffectPlan effect_table[EFFECT_COUNT] = {
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

bool plan_build(const Scene *scene, const EngineOptions *options, Plan *plan, Error *error)
{
    memset(plan, 0, sizeof *plan);
    if (options->backend && !strcmp(options->backend, "cuda"))
        return error_set(error, ERROR_SYSTEM, "--backend cuda: this build has none");
    plan->options = *options;
    if (!plan->options.threads) plan->options.threads = 2;
    plan->backend = "cpu";
    snprintf(plan->variant, sizeof plan->variant, "fake");
    memcpy(plan->effects, effect_table, sizeof effect_table);
    for (int i = 0; i < EFFECT_COUNT; i++) {
        plan->effects[i].active = i % 2 == 0;
        plan->effects[i].bytes = plan->effects[i].active ? 1000 : 0;
        snprintf(plan->effects[i].because, sizeof plan->effects[i].because, "fake");
    }
    plan->fluid_count = GRID * GRID;
    plan->wall_count = 100;
    plan->body_particle_count = 10;
    plan->time_step = fake.time_step;
    snprintf(plan->time_step_limit, sizeof plan->time_step_limit, "sound");
    plan->sound_speed = 40;
    snprintf(plan->sound_speed_because, sizeof plan->sound_speed_because, "10 x largest speed");
    plan->smoothing_length = 0.2;
    plan->particle_mass = 1;
    plan->bytes = 123456;
    plan->predicted_slowness = NAN;
    snprintf(plan->warnings, sizeof plan->warnings, "not physics; a stand-in");
    plan->arena = arena_create(0);
    plan->bodies = arena_take(&plan->arena, 1, sizeof *plan->bodies, "bodies", error);
    plan->lines = arena_take(&plan->arena, 1, sizeof *plan->lines, "lines", error);
    TriangleMesh *mesh = &plan->bodies[0].geometry.mesh;
    mesh->vertices = arena_take(&plan->arena, 8, sizeof *mesh->vertices, "vertices", error);
    mesh->triangles = arena_take(&plan->arena, 12, sizeof *mesh->triangles, "triangles", error);
    mesh->vertex_count = 8;
    mesh->triangle_count = 12;
    for (int i = 0; i < 8; i++)
        mesh->vertices[i] =
            vec3(1.5 * cube_corner[i][0], 0.4 * cube_corner[i][1], 0.25 * cube_corner[i][2]);
    memcpy(mesh->triangles, cube_face, sizeof cube_face);
    plan->bodies[0].geometry.floats = true;
    return true;
}

void plan_destroy(Plan *plan) { arena_destroy(&plan->arena); }

bool plan_predict(const Scene *scene, Plan *plan, Error *error)
{
    plan->predicted_slowness = 7.5;
    return true;
}

BenchFlops bench_flops(void) { return (BenchFlops){1, 1, 1, 1}; }

bool bench_run(const BenchOptions *options, BenchReport *report, Error *error)
{
    return error_set(error, ERROR_INPUT, "the stand-in has nothing to time");
}

bool state_create(const Scene *scene, const Plan *plan, State **state, Error *error)
{
    *state = calloc(1, sizeof **state);
    if (!*state) return error_set(error, ERROR_SYSTEM, "no memory");
    static LineWatch watch;
    static Line line;
    static LineOrder order;
    order.length = NAN;
    (*state)->orders = &order;
    (*state)->watches = &watch;
    (*state)->lines = &line;
    (*state)->time_step = plan->time_step;
    (*state)->smallest_step = (*state)->largest_step = plan->time_step;
    static WaveState waves;
    (*state)->waves = &waves;
    waves.asked = scene->waves.initial;
    return true;
}

void state_destroy(State *state) { free(state); }

// no state of the stand-in has a ledger of its lines
LedgerBalance line_ledger_balance(const LineLedger *ledger, const Scene *scene, const Body *bodies,
                                  const Line *lines, int b)
{
    LedgerBalance none;
    memset(&none, 0, sizeof none);
    return none;
}

double mooring_energy(const Mooring *mooring) { return 0; }

bool step_advance(const Scene *scene, const Plan *plan, State *state, Error *error)
{
    if (fake.step_wall > 0) {
        struct timespec pause = {.tv_nsec = (long)(fake.step_wall * 1e9)};
        nanosleep(&pause, NULL);
    }
    state->step++;
    state->time = (double)state->step * plan->time_step;
    state->wall_time += fake.step_wall;
    state->base_seconds += 0.75 * plan->time_step;
    state->effect_seconds[0] += 0.25 * plan->time_step;
    state->density_error = state->largest_density_error = 0.002;
    if (state->time >= fake.recover_at && !state->health.recoveries) {
        state->health.recoveries = 1;
        state->health.status = HEALTH_RECOVERED;
        snprintf(state->health.message, sizeof state->health.message,
                 "fake: density of particle 7");
    }
    if (state->time >= fake.fail_at)
        return error_set(error, ERROR_PHYSICS, "fake: particle 7 is not a number at t = %.6g s",
                         state->time);
    return true;
}

Command command_default(void) { return (Command){NAN, NAN, NAN, "", NAN, CUT_NOWHERE}; }

bool command_check(const Scene *scene, const Command *command, const WaveTarget *last,
                   WaveTarget *target, Error *error)
{
    const Range *height = &scene->waves.height_limits;
    *target = *last;
    if (isfinite(command->wave_height)) target->height = command->wave_height;
    if (isfinite(command->wave_period)) target->period = command->wave_period;
    if (isfinite(command->wave_heading)) target->heading = command->wave_heading;
    if (target->height < height->min || target->height > height->max)
        return error_set(error, ERROR_INPUT, "wave.height_m: %g is not accepted: %g to %g",
                         target->height, height->min, height->max);
    return true;
}

bool state_command(const Scene *scene, State *state, const Command *command, Error *error)
{
    WaveTarget target;
    if (command->line[0]) {
        if (strcmp(command->line, scene->lines[0].name) != 0)
            return error_set(error, ERROR_INPUT, "line.name = \"%s\": no such line", command->line);
        state->orders[0].length = command->line_length;
        return true;
    }
    TRY(command_check(scene, command, &state->waves->asked, &target, error));
    state->waves->asked = target;
    return true;
}

void waves_tell(const Scene *scene, char *text, int size)
{
    snprintf(text, (size_t)size, "%g m", scene->waves.initial.height);
}

bool wave_quality_asked(const Scene *scene) { return scene->quality_gauge_count > 0; }

WaveTarget waves_now(const WaveState *waves, double time) { return waves->asked; }

/// z = H/2 cos(k (x cos + y sin) - omega t)
static double elevation(const WaveTarget *wave, double x, double y, double time)
{
    double omega = 2 * PI / wave->period, k = omega * omega / 9.81;
    double along = x * cos(wave->heading) + y * sin(wave->heading);
    return 0.5 * wave->height * cos(k * along - omega * time);
}

bool snapshot_create(const Scene *scene, const Plan *plan, Snapshot *snapshot, Error *error)
{
    size_t count = (size_t)plan->fluid_count;
    memset(snapshot, 0, sizeof *snapshot);
    snapshot->storage_size = count * 28;
    float *floats = calloc(count, 28);
    if (!floats) return error_set(error, ERROR_SYSTEM, "no memory");
    snapshot->storage = floats;
    snapshot->position = (float(*)[3])floats;
    snapshot->velocity = (float(*)[3])(floats + 3 * count);
    snapshot->pressure = floats + 6 * count;
    return true;
}

void snapshot_take(const Scene *scene, const Plan *plan, const State *state, Snapshot *snapshot)
{
    const WaveTarget *wave = &state->waves->asked;
    snapshot->time = state->time;
    snapshot->step = state->step;
    snapshot->time_step = state->time_step;
    snapshot->fluid_count = plan->fluid_count;
    snapshot->spacing = 0.2;
    snapshot->domain = scene->domain;
    snapshot->has_waves = true;
    snapshot->wave_asked = snapshot->wave_now = *wave;
    for (int i = 0; i < plan->fluid_count; i++) {
        float *p = snapshot->position[i];
        p[0] = (float)(0.2 * (i % GRID) - 4);
        p[1] = (float)(0.2 * (i / GRID) - 4);
        p[2] = (float)elevation(wave, p[0], p[1], state->time);
    }
    snapshot->body_count = 1;
    snapshot->bodies[0].mesh = &plan->bodies[0].geometry.mesh;
    snapshot->bodies[0].origin = vec3(0, 0, elevation(wave, 0, 0, state->time));
    snapshot->bodies[0].attitude = quat(1, 0, 0, 0);
}

void snapshot_destroy(Snapshot *snapshot)
{
    free(snapshot->storage);
    memset(snapshot, 0, sizeof *snapshot);
}

void series_table(const Scene *scene, SeriesTable *table)
{
    static const char *const names[] = {"t_s", "ship.heave_m", "bow_line.fairlead_tension_n",
                                        "g1.elevation_m"};
    table->count = 4;
    for (int i = 0; i < 4; i++)
        snprintf(table->names[i], SERIES_COLUMN_SIZE, "%s", names[i]);
}

void series_sample(const Scene *scene, const Plan *plan, State *state, double *row)
{
    row[0] = state->time;
    row[1] = elevation(&state->waves->asked, 0, 0, state->time);
    row[2] = 100 + 10 * row[1];
    row[3] = elevation(&state->waves->asked, 2, 0, state->time);
}

void journal_format_start(const Scene *scene, const Plan *plan, char *text, int size)
{
    snprintf(text, (size_t)size, "{\"event\":\"start\",\"time_s\":0,\"case\":\"%s\"}", scene->name);
}

void journal_format_command(double time, const Command *command, const WaveTarget *asked,
                            char *text, int size)
{
    snprintf(
        text, (size_t)size,
        "{\"event\":\"command\",\"time_s\":%.9g,\"wave\":{\"height_m\":%.17g,\"period_s\":%.17g,"
        "\"heading_deg\":%.17g}}",
        time, asked->height, asked->period, asked->heading * 180 / PI);
}

/// The pretended lines never snap.
const LineEvent *line_events_next(const LineEvents *events, int64_t *seen) { return NULL; }
void journal_format_line(const Scene *scene, const LineEvent *event, char *text, int size)
{
    *text = 0;
}
void line_event_describe(const Scene *scene, const LineEvent *event, char *text, int size)
{
    *text = 0;
}

void journal_format_health(double time, const char *message, char *text, int size)
{
    snprintf(text, (size_t)size, "{\"event\":\"health\",\"time_s\":%.9g,\"message\":\"%s\"}", time,
             message);
}
