/// Bodies, lines and probes against the domain and against each other.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_case.h"

/// "bodies[2].name" may not repeat an earlier one: names head the columns of the series.
static bool check_name(const JsonReader *reader, const char *list, const char *first,
                       size_t item_size, int index)
{
    const char *name = first + (size_t)index * item_size;
    for (int i = 0; i < index; i++)
        if (strcmp(name, first + (size_t)i * item_size) == 0) {
            char at[JSON_PATH_SIZE];
            snprintf(at, sizeof at, "%s[%d].name", list, index);
            return table_refuse(reader, at, NULL,
                                "\"%s\" is the name of %s[%d] too: must differ from all others",
                                name, list, i);
        }
    return true;
}

/// A coordinate within the domain.
static bool check_inside(const JsonReader *reader, const char *where, const char *axis,
                         double value, double min, double max)
{
    double slack = 1e-9 * (1 + fabs(min) + fabs(max));
    if (value >= min - slack && value <= max + slack) return true;
    return table_refuse_number(reader, where, value,
                               "its %s must be >= %.9g and <= %.9g m (the domain)", axis, min, max);
}

bool case_check_bodies(const JsonReader *reader, const Scene *scene)
{
    const Domain *domain = &scene->domain;
    double depth = scene->fluid.level - domain->min.z;
    char at[JSON_PATH_SIZE];
    for (int i = 0; i < scene->body_count; i++) {
        const BodyScene *body = &scene->bodies[i];
        TRY(check_name(reader, "bodies", scene->bodies[0].name, sizeof *scene->bodies, i));
        snprintf(at, sizeof at, "bodies[%d].position_m", i);
        TRY(check_inside(reader, at, "x", body->position.x, domain->min.x, domain->max.x));
        if (domain->dimensions == 3)
            TRY(check_inside(reader, at, "y", body->position.y, domain->min.y, domain->max.y));
        if (body->position.z < domain->min.z)
            return table_refuse_number(reader, at, body->position.z,
                                       "its z must be >= %.9g m (the bed)", domain->min.z);
        snprintf(at, sizeof at, "bodies[%d].draft_m", i);
        if (isnan(body->position.z) && body->draft > depth)
            return table_refuse_number(reader, at, body->draft,
                                       "must be > 0 and <= %.9g m (the water's depth)", depth);
    }
    return true;
}

/// Points where lines meet: not in the bed; a free one must hold a line.
static bool check_points(const JsonReader *reader, const Scene *scene)
{
    char at[JSON_PATH_SIZE];
    for (int i = 0; i < scene->point_count; i++) {
        const PointScene *point = &scene->points[i];
        TRY(check_name(reader, "points", scene->points[0].name, sizeof *scene->points, i));
        snprintf(at, sizeof at, "points[%d].position_m", i);
        if (point->body < 0 && point->position.z < scene->domain.min.z - 1e-9)
            return table_refuse_number(reader, at, point->position.z,
                                       "its z must be >= %.9g m (the bed)", scene->domain.min.z);
        int held = 0;
        for (int l = 0; l < scene->line_count; l++)
            held += (scene->lines[l].anchor.point == i) + (scene->lines[l].fairlead.point == i);
        snprintf(at, sizeof at, "points[%d]", i);
        if (!held && point->kind == POINT_FREE)
            return table_refuse(reader, at, NULL, "no line ends at it: a free point must hold one");
    }
    return true;
}

bool case_check_lines(const JsonReader *reader, const Scene *scene)
{
    TRY(check_points(reader, scene));
    double bed = scene->domain.min.z;
    char at[JSON_PATH_SIZE];
    for (int i = 0; i < scene->line_count; i++) {
        const LineScene *line = &scene->lines[i];
        TRY(check_name(reader, "lines", scene->lines[0].name, sizeof *scene->lines, i));
        // an end on earth may lie beyond the domain (lines need no particles), but not in the bed
        for (int end = 0; end < 2; end++) {
            const LineEnd *e = end ? &line->fairlead : &line->anchor;
            snprintf(at, sizeof at, "lines[%d].%s.position_m", i, end ? "fairlead" : "anchor");
            if (e->point < 0 && e->body < 0 && e->position.z < bed - 1e-9 * (1 + fabs(bed)))
                return table_refuse_number(reader, at, e->position.z,
                                           "its z must be >= %.9g m (the bed)", bed);
        }
    }
    return true;
}

/// A direction must point somewhere, and a disc needs one.
static bool check_patch(const JsonReader *reader, const PressureProbeScene *probe, int i)
{
    char at[JSON_PATH_SIZE];
    snprintf(at, sizeof at, "probes.pressure[%d].normal", i);
    if (probe->patch > 0 && isnan(probe->normal.x))
        return table_refuse(reader, at, NULL,
                            "is missing: patch_diameter_m must come with a direction [x, y, z]");
    if (!isnan(probe->normal.x) && vec3_norm(probe->normal) < 1e-3)
        return table_refuse_number(reader, at, vec3_norm(probe->normal),
                                   "its length must be >= 0.001");
    return true;
}

static bool check_run_ups(const JsonReader *reader, const Scene *scene)
{
    char at[JSON_PATH_SIZE];
    for (int i = 0; i < scene->run_up_count; i++) {
        const RunUpScene *line = &scene->run_ups[i];
        TRY(check_name(reader, "probes.run_up", scene->run_ups[0].name, sizeof *line, i));
        double length = vec3_norm(vec3_sub(line->to, line->from));
        snprintf(at, sizeof at, "probes.run_up[%d].to_m", i);
        if (length < scene->fluid.spacing)
            return table_refuse_number(reader, at, length,
                                       "its distance from from_m must be >= %.9g m (one spacing)",
                                       scene->fluid.spacing);
    }
    return true;
}

static bool check_green_waters(const JsonReader *reader, const Scene *scene)
{
    char at[JSON_PATH_SIZE];
    for (int i = 0; i < scene->green_water_count; i++) {
        const GreenWaterScene *box = &scene->green_waters[i];
        TRY(check_name(reader, "probes.green_water", scene->green_waters[0].name, sizeof *box, i));
        bool plane = scene->domain.dimensions == 2;
        double size = mind(box->max.x - box->min.x, box->max.z - box->min.z);
        if (!plane) size = mind(size, box->max.y - box->min.y);
        snprintf(at, sizeof at, "probes.green_water[%d].max_m", i);
        if (size <= 0)
            return table_refuse_number(reader, at, size,
                                       "less min_m it must be > 0 m along each axis");
    }
    return true;
}

bool case_check_probes(const JsonReader *reader, const Scene *scene)
{
    const Domain *domain = &scene->domain;
    char at[JSON_PATH_SIZE];
    TRY(check_run_ups(reader, scene));
    TRY(check_green_waters(reader, scene));
    for (int i = 0; i < scene->slamming_count; i++)
        TRY(check_name(reader, "probes.slamming", scene->slammings[0].name,
                       sizeof *scene->slammings, i));
    for (int i = 0; i < scene->gauge_count; i++) {
        const GaugeScene *gauge = &scene->gauges[i];
        TRY(check_name(reader, "probes.gauges", scene->gauges[0].name, sizeof *gauge, i));
        snprintf(at, sizeof at, "probes.gauges[%d].x_m", i);
        TRY(check_inside(reader, at, "x", gauge->x, domain->min.x, domain->max.x));
        snprintf(at, sizeof at, "probes.gauges[%d].y_m", i);
        TRY(check_inside(reader, at, "y", gauge->y, domain->min.y, domain->max.y));
    }
    for (int i = 0; i < scene->pressure_probe_count; i++) {
        const PressureProbeScene *probe = &scene->pressure_probes[i];
        TRY(check_name(reader, "probes.pressure", scene->pressure_probes[0].name, sizeof *probe,
                       i));
        TRY(check_patch(reader, probe, i));
        if (probe->body >= 0) continue;
        snprintf(at, sizeof at, "probes.pressure[%d].position_m", i);
        TRY(check_inside(reader, at, "x", probe->position.x, domain->min.x, domain->max.x));
        if (domain->dimensions == 3)
            TRY(check_inside(reader, at, "y", probe->position.y, domain->min.y, domain->max.y));
        TRY(check_inside(reader, at, "z", probe->position.z, domain->min.z, domain->max.z));
    }
    return true;
}

/// Index of a gauge by its name.
static bool find_gauge(const JsonReader *reader, const Scene *scene, const char *where,
                       const char *name, int *index)
{
    for (*index = 0; *index < scene->gauge_count; ++*index)
        if (strcmp(scene->gauges[*index].name, name) == 0) return true;
    return table_refuse(reader, where, NULL, "\"%s\" must be the name of one of probes.gauges",
                        name);
}

bool case_find_gauges(const JsonReader *reader, CaseFile *draft)
{
    static const char *const words[] = {"first", "second", "third"};
    Scene *scene = &draft->scene;
    WaveGain *gain = &scene->waves.gain;
    if (gain->gauge_name[0])
        TRY(find_gauge(reader, scene, "waves.gain.gauge", gain->gauge_name, &gain->gauge));
    if (gain->start > gain->largest || gain->start * gain->largest < 1)
        return table_refuse(reader, "waves.gain.start", NULL,
                            "%g must be from 1/%g to %g, waves.gain.largest", gain->start,
                            gain->largest, gain->largest);
    for (int i = 0; i < 3 && draft->quality_names[0][0]; i++) {
        char at[JSON_PATH_SIZE];
        snprintf(at, sizeof at, "probes.wave_quality.%s", words[i]);
        TRY(find_gauge(reader, scene, at, draft->quality_names[i], &scene->quality_gauges[i]));
        scene->quality_gauge_count = i + 1;
    }
    return true;
}
