/// Case file → Scene, in the order in which this file reads from below: the tree, overrides, the
/// tables (scene_fields*.c), values that follow from others, the checks (scene_check.c).
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_case.h"
#include "scene_tree.h"

/// A ring must rise above the largest wave (docs/physics.md: >= H; without it particles leak).
static const double BASIN_FREEBOARD_RATIO = 1.3;
static const double RAMP_PERIODS = 2; ///< (chosen) from rest to the full wave

/// Limits that the file leaves out: lower waves and any heading, no other period (the zone is sized
/// for the longest period that may be asked for).
static void resolve_limits(const Domain *domain, Waves *waves)
{
    if (isnan(waves->height_limits.max)) {
        waves->height_limits.min = 0;
        waves->height_limits.max = waves->initial.height;
    }
    if (isnan(waves->period_limits.max))
        waves->period_limits.min = waves->period_limits.max = waves->initial.period;
    if (isnan(waves->heading_limits.max)) {
        bool negative = waves->initial.heading < 0;
        waves->heading_limits.min = negative ? -PI : 0;
        waves->heading_limits.max = negative ? PI : 2 * PI;
        if (domain->kind == DOMAIN_FLUME) waves->heading_limits.min = waves->heading_limits.max = 0;
    }
    if (waves->kind == WAVES_RECORD) waves->ramp_time = 0; // it begins as it was recorded
    if (isnan(waves->ramp_time)) waves->ramp_time = RAMP_PERIODS * waves->initial.period;
}

bool case_finish_waves(const JsonReader *reader, const JsonValue *object, const char *where,
                       void *target)
{
    static const char *const others[] = {"theory", "start", "ramp_s", "blend_periods", "spectrum",
                                         "focus",  "gain",  "limits", "piston_order"};
    Waves *waves = &((CaseFile *)target)->scene.waves;
    char at[JSON_PATH_SIZE];
    const JsonValue *table = tree_member(object, "piston_motion");
    snprintf(at, sizeof at, "%.120s.piston_motion", where);
    if (waves->kind == WAVES_NONE) return true;
    if (waves->kind != WAVES_RECORD)
        return !table || table_refuse(reader, at, table,
                                      "must only be given where waves.kind is "
                                      "\"record\"");
    if (!table)
        return table_refuse(reader, at, NULL,
                            "is missing: must be a table of t_s and x_m where "
                            "waves.kind is \"record\"");
    TRY(case_resolve_path(reader, object, where, "piston_motion", waves->piston_path));
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        snprintf(at, sizeof at, "%.120s.%s", where, others[i]);
        if (tree_member(object, others[i]))
            return table_refuse(reader, at, tree_member(object, others[i]),
                                "must not be given: the piston follows its record as it is");
    }
    return true;
}

static bool resolve_waves(const JsonReader *reader, CaseFile *draft)
{
    Waves *waves = &draft->scene.waves;
    if (waves->kind == WAVES_NONE) return true;
    if (isnan(waves->initial.height))
        return table_refuse(reader, "waves.height_m", NULL,
                            "is missing: must be >= 0 and <= 50 m for regular waves");
    if (isnan(waves->initial.period))
        return table_refuse(reader, "waves.period_s", NULL,
                            "is missing: must be >= 0.1 and <= 60 s for regular waves");
    resolve_limits(&draft->scene.domain, waves);
    return true;
}

/// A basin by its sizes: centred on the origin, its ring as high as the largest wave needs.
static bool resolve_basin(const JsonReader *reader, CaseFile *draft)
{
    Scene *scene = &draft->scene;
    Domain *domain = &scene->domain;
    bool plane = domain->dimensions == 2;
    if (domain->kind != DOMAIN_BASIN)
        return table_refuse(reader, "domain.length_m", NULL,
                            "length_m, breadth_m, depth_m and freeboard_m are for a basin: a tank "
                            "or flume must be given by min_m and max_m");
    if (!isnan(domain->min.x) || !isnan(domain->max.x))
        return table_refuse(reader, "domain.min_m", NULL,
                            "min_m and max_m must not be given together with length_m, depth_m …");
    if (isnan(draft->basin_length) || isnan(draft->basin_depth) ||
        (isnan(draft->basin_breadth) && !plane))
        return table_refuse(reader, "domain", NULL,
                            "a basin must have length_m, depth_m%s > 0 (or min_m and max_m)",
                            plane ? "" : " and breadth_m");
    const Waves *waves = &scene->waves;
    double highest =
        isnan(waves->height_limits.max) ? waves->initial.height : waves->height_limits.max;
    double freeboard =
        isnan(draft->basin_freeboard) ? BASIN_FREEBOARD_RATIO * highest : draft->basin_freeboard;
    if (!(freeboard > 0))
        return table_refuse(reader, "domain.freeboard_m", NULL,
                            "is missing: must be > 0 and <= 1000 m where no wave height gives it");
    domain->max = vec3(draft->basin_length / 2, plane ? 0 : draft->basin_breadth / 2,
                       scene->fluid.level + freeboard);
    domain->min = vec3(-domain->max.x, -domain->max.y, scene->fluid.level - draft->basin_depth);
    return true;
}

/// Grow a box, given by its middle and half sizes, around a place.
static void reach_over(Domain *box, Vec3 place)
{
    box->min.x = mind(box->min.x, place.x), box->max.x = maxd(box->max.x, place.x);
    box->min.y = mind(box->min.y, place.y), box->max.y = maxd(box->max.y, place.y);
    box->max.z = maxd(box->max.z, place.z);
}

/// A domain of lines by its depth alone: it reaches as far as lines and bodies, and a fifth of the
/// depth more.
static bool resolve_lines(const JsonReader *reader, CaseFile *draft)
{
    Scene *scene = &draft->scene;
    Domain *domain = &scene->domain;
    if (!isnan(domain->min.x) || !isnan(domain->max.x)) return true;
    if (isnan(draft->basin_depth))
        return table_refuse(
            reader, "domain.depth_m", NULL,
            "is missing: must be > 0 and <= 10000 m (or min_m and max_m, or WtrDpth "
            "in a MoorDyn file)");
    double level = scene->fluid.level, depth = draft->basin_depth;
    domain->min = vec3(INFINITY, INFINITY, level - depth);
    domain->max = vec3(-INFINITY, -INFINITY, level);
    for (int i = 0; i < scene->body_count; i++)
        reach_over(domain, scene->bodies[i].position);
    for (int i = 0; i < scene->point_count; i++)
        if (scene->points[i].body < 0) reach_over(domain, scene->points[i].position);
    for (int i = 0; i < scene->line_count; i++)
        for (int e = 0; e < 2; e++) {
            const LineEnd *end = e ? &scene->lines[i].fairlead : &scene->lines[i].anchor;
            if (end->body < 0 && end->point < 0) reach_over(domain, end->position);
        }
    if (!(domain->max.x >= domain->min.x)) reach_over(domain, vec3(0, 0, level));
    double margin = 0.2 * depth;
    double lengths[2] = {draft->basin_length, draft->basin_breadth};
    double *low[2] = {&domain->min.x, &domain->min.y}, *high[2] = {&domain->max.x, &domain->max.y};
    for (int a = 0; a < 2; a++) {
        *low[a] = isnan(lengths[a]) ? *low[a] - margin : -0.5 * lengths[a];
        *high[a] = isnan(lengths[a]) ? *high[a] + margin : 0.5 * lengths[a];
    }
    double highest = isnan(scene->waves.height_limits.max) ? 0 : scene->waves.height_limits.max;
    domain->max.z = maxd(domain->max.z, level + maxd(margin, BASIN_FREEBOARD_RATIO * highest));
    return true;
}

static bool resolve_domain(const JsonReader *reader, CaseFile *draft)
{
    Domain *domain = &draft->scene.domain;
    Fluid *fluid = &draft->scene.fluid;
    if (domain->kind == DOMAIN_LINES) {
        TRY(resolve_lines(reader, draft));
        // nothing is that far apart; pictures and plans ask for some length
        Vec3 size = vec3_sub(domain->max, domain->min);
        fluid->spacing = 0.01 * maxd(size.x, maxd(size.y, size.z));
    } else if (isnan(fluid->spacing)) {
        return table_refuse(reader, "fluid.spacing_m", NULL, "is missing: must be > 0 and <= 10 m");
    } else if (!isnan(draft->scene.lines_step)) {
        return table_refuse(reader, "domain.time_step_s", NULL,
                            "must only be given where domain.kind is \"lines\": particles choose "
                            "their own");
    }
    bool by_size = !isnan(draft->basin_length) || !isnan(draft->basin_breadth) ||
                   !isnan(draft->basin_depth) || !isnan(draft->basin_freeboard);
    if (domain->kind != DOMAIN_LINES && by_size) {
        TRY(resolve_basin(reader, draft));
    } else {
        const char *missing = isnan(domain->min.x)   ? "domain.min_m"
                              : isnan(domain->max.x) ? "domain.max_m"
                                                     : NULL;
        if (missing)
            return table_refuse(reader, missing, NULL,
                                "is missing: must be a list of 3 numbers >= -10000 and <= 10000 m");
    }
    if (domain->dimensions == 2) { // a slice 1 m thick, for pictures and loads per metre
        domain->min.y = -0.5, domain->max.y = 0.5;
        for (int i = 0; i < fluid->block_count; i++)
            fluid->blocks[i].min.y = -0.5, fluid->blocks[i].max.y = 0.5;
    }
    return true;
}

bool case_resolve(const JsonReader *reader, CaseFile *draft)
{
    TRY(resolve_waves(reader, draft));
    TRY(resolve_domain(reader, draft));
    TRY(case_find_gauges(reader, draft));
    Waves *waves = &draft->scene.waves;
    if (waves->kind == WAVES_NONE) { // a case may keep its sea and switch it off
        memset(&waves->initial, 0, sizeof waves->initial);
        waves->ramp_time = 0;
        waves->height_limits = waves->period_limits = waves->heading_limits = (Range){0, 0};
    }
    return true;
}

/// "cases/moored_ship.json" → "moored_ship"; what is neither letter nor digit nor .-_ becomes _.
static void name_from_path(const char *path, char name[SCENE_NAME_SIZE])
{
    const char *slash = strrchr(path, '/');
    snprintf(name, SCENE_NAME_SIZE, "%.*s", SCENE_NAME_SIZE - 1, slash ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot && dot != name) *dot = 0;
    for (char *c = name; *c; c++)
        if (!strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-", *c))
            *c = '_';
}

static bool read_tree(const JsonReader *reader, const JsonValue *root, CaseFile *draft)
{
    Scene *scene = &draft->scene;
    TRY(table_read(reader, &CASE_TABLE, root, "", draft));
    if (!scene->title[0]) snprintf(scene->title, sizeof scene->title, "%s", scene->name);
    scene->hash = tree_hash(root);
    TRY(case_join_moordyn(reader, root, draft));
    TRY(case_resolve(reader, draft));
    return case_check(reader, scene) && case_resolve_pretension(reader, scene);
}

CaseFile case_file_default(void)
{
    CaseFile draft;
    memset(&draft, 0, sizeof draft);
    draft.scene = scene_default();
    draft.moordyn_body = -1;
    draft.basin_depth = draft.basin_length = draft.basin_breadth = draft.basin_freeboard = NAN;
    return draft;
}

bool scene_load(const char *path, const char *const *overrides, int override_count, Scene *scene,
                Error *error)
{
    CaseFile draft = case_file_default();
    if (strlen(path) >= sizeof draft.scene.path)
        return error_set(error, ERROR_INPUT, "%.60s…: the path of a case must have < %d characters",
                         path, SCENE_PATH_SIZE);
    snprintf(draft.scene.path, sizeof draft.scene.path, "%s", path);
    name_from_path(path, draft.scene.name);

    JsonValue *root;
    TRY(tree_read_file(path, &root, error));
    JsonReader reader = {path, &draft, error};
    bool good = true;
    for (int i = 0; i < override_count && good; i++)
        good = case_override(root, overrides[i], error);
    good = good && read_tree(&reader, root, &draft);
    tree_destroy(root);
    if (good) *scene = draft.scene;
    return good;
}
