/// A case's MoorDyn file: its lines and points join the case's own, its water counts where the case
/// says nothing.
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "moordyn_read.h"
#include "scene_case.h"

/// MoorDyn's own water, for a domain of lines where neither case nor file says another.
static const double MOORDYN_DENSITY = 1025, MOORDYN_GRAVITY = 9.80665;
/// Depths that differ by less are the same [-].
static const double DEPTH_SLACK = 1e-6;

static void add_note(Scene *scene, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add_note(Scene *scene, const char *format, ...)
{
    size_t used = strlen(scene->notes), room = sizeof scene->notes;
    if (used) used += (size_t)snprintf(scene->notes + used, room - used, "; ");
    if (used >= room) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(scene->notes + used, room - used, format, arguments);
    va_end(arguments);
}

/// The file's path against the case's folder.
static bool find_file(const JsonReader *reader, const char *given, char path[SCENE_PATH_SIZE])
{
    const char *slash = strrchr(reader->file, '/');
    int folder = given[0] == '/' || !slash ? 0 : (int)(slash - reader->file + 1);
    int length = snprintf(path, SCENE_PATH_SIZE, "%.*s%s", folder, reader->file, given);
    return length < SCENE_PATH_SIZE ||
           table_refuse(reader, "moordyn_file", NULL,
                        "with the case's folder must have < %d characters", SCENE_PATH_SIZE);
}

static bool says(const JsonValue *root, const char *part, const char *key)
{
    const JsonValue *object = tree_member(root, part);
    return object && tree_type(object) == JSON_OBJECT && tree_member(object, key);
}

/// Gravity, density and depth where the case leaves them open; a note where both speak and differ.
static void join_water(const JsonValue *root, const MoordynFile *file, CaseFile *draft)
{
    Scene *scene = &draft->scene;
    Fluid *fluid = &scene->fluid;
    bool lines = scene->domain.kind == DOMAIN_LINES;
    struct {
        const char *key;
        double *value, given, usual;
    } items[2] = {{"gravity_ms2", &fluid->gravity, file->gravity, MOORDYN_GRAVITY},
                  {"density_kgm3", &fluid->density, file->density, MOORDYN_DENSITY}};
    for (int i = 0; i < 2; i++) {
        bool free = lines && !says(root, "fluid", items[i].key);
        double asked = isnan(items[i].given) ? items[i].usual : items[i].given;
        if (free) *items[i].value = asked;
        if (!free && !isnan(items[i].given) && items[i].given != *items[i].value)
            add_note(scene, "the case's fluid.%s %.6g counts, not the file's %.6g", items[i].key,
                     *items[i].value, items[i].given);
    }
    if (isnan(file->depth)) return;
    bool depth_said = says(root, "domain", "depth_m") || says(root, "domain", "min_m");
    if (lines && !depth_said) draft->basin_depth = file->depth;
    double depth =
        says(root, "domain", "min_m") ? fluid->level - scene->domain.min.z : draft->basin_depth;
    if (fabs(depth - file->depth) > DEPTH_SLACK * file->depth)
        add_note(scene, "the case's depth %.6g m counts, not the file's WtrDpth %.6g m", depth,
                 file->depth);
}

/// Where a coupled point is in the axes of the body that it rides on.
static bool to_body(const JsonReader *reader, const CaseFile *draft, Vec3 *position)
{
    if (draft->moordyn_axes == MOORDYN_BODY) return true;
    const BodyScene *body = &draft->scene.bodies[draft->moordyn_body];
    char at[JSON_PATH_SIZE];
    snprintf(at, sizeof at, "bodies[%d].position_m", draft->moordyn_body);
    if (isnan(body->position.z))
        return table_refuse(reader, at, NULL,
                            "must have z where points of a MoorDyn file ride on the body (or "
                            "moordyn_axes must be \"body\")");
    Quat attitude = quat_from_euler(body->attitude.x, body->attitude.y, body->attitude.z);
    Vec3 world = vec3(position->x, position->y, position->z + draft->scene.fluid.level);
    *position = quat_rotate(quat_conjugate(attitude), vec3_sub(world, body->position));
    return true;
}

static bool join_free_point(const JsonReader *reader, const MoordynPoint *from, CaseFile *draft,
                            int *index)
{
    Scene *scene = &draft->scene;
    if (scene->point_count == SCENE_POINTS_MAX)
        return table_refuse(reader, "moordyn_file", NULL, "more than %d free points",
                            SCENE_POINTS_MAX);
    PointScene *point = &scene->points[ *index = scene->point_count++];
    *point = point_scene_default();
    snprintf(point->name, sizeof point->name, "point_%d", from->id);
    point->kind = POINT_FREE;
    point->position =
        vec3(from->position.x, from->position.y, from->position.z + scene->fluid.level);
    point->mass = from->mass;
    point->volume = from->volume;
    point->drag_area = from->drag_area;
    point->added_mass = from->added_mass;
    return true;
}

/// What holds the end of a line at a point of the file; free points join the scene once.
static bool join_end(const JsonReader *reader, const MoordynPoint *from, CaseFile *draft,
                     int *free_index, LineEnd *end)
{
    end->point = end->body = -1;
    end->position = from->position;
    if (from->hold == MOORDYN_FREE) {
        if (*free_index < 0) TRY(join_free_point(reader, from, draft, free_index));
        end->point = *free_index;
    }
    if (from->hold == MOORDYN_COUPLED && draft->moordyn_body >= 0) {
        end->body = draft->moordyn_body;
        return to_body(reader, draft, &end->position);
    }
    end->position.z += draft->scene.fluid.level;
    return true;
}

static bool join_line(const JsonReader *reader, const MoordynFile *file, const MoordynLine *from,
                      CaseFile *draft, int *free_points)
{
    Scene *scene = &draft->scene;
    const MoordynType *type = &file->types[from->type];
    if (scene->line_count == SCENE_LINES_MAX)
        return table_refuse(reader, "moordyn_file", NULL,
                            "with the case's own there are more than %d lines", SCENE_LINES_MAX);
    LineScene *line = &scene->lines[scene->line_count++];
    *line = line_scene_default();
    snprintf(line->name, sizeof line->name, "line_%d", from->id);
    line->length = from->length;
    line->segments = from->segments;
    line->axial_stiffness = type->stiffness;
    line->mass_per_length = type->mass;
    line->diameter = type->diameter;
    line->drag_normal = type->drag_normal;
    line->drag_tangential = type->drag_axial;
    line->added_normal = type->added_normal;
    line->added_tangential = type->added_axial;
    line->bending_stiffness = type->bending;
    line->bed_stiffness = file->bed_stiffness;
    line->bed_damping = file->bed_damping;
    line->bed_friction = file->bed_friction;
    // BA of a segment = zeta l sqrt(EA w), as MoorDyn has it
    double critical = from->length / from->segments * sqrt(type->stiffness * type->mass);
    line->damping_ratio = type->damping < 0 ? -type->damping : type->damping / critical;
    const MoordynPoint *a = &file->points[from->ends[0]], *b = &file->points[from->ends[1]];
    TRY(join_end(reader, a, draft, &free_points[from->ends[0]], &line->anchor));
    return join_end(reader, b, draft, &free_points[from->ends[1]], &line->fairlead);
}

static bool join_file(const JsonReader *reader, const JsonValue *root, const MoordynFile *file,
                      CaseFile *draft)
{
    int free_points[MOORDYN_POINTS_MAX];
    bool coupled = false;
    for (int i = 0; i < file->point_count; i++) {
        free_points[i] = -1;
        coupled = coupled || file->points[i].hold == MOORDYN_COUPLED;
    }
    join_water(root, file, draft);
    for (int i = 0; i < file->line_count; i++)
        TRY(join_line(reader, file, &file->lines[i], draft, free_points));
    if (coupled && draft->moordyn_body < 0)
        add_note(&draft->scene, "without moordyn_body the coupled points are held on earth");
    if (file->notes[0]) add_note(&draft->scene, "%s", file->notes);
    draft->scene.hash ^= file->hash;
    return true;
}

bool case_join_moordyn(const JsonReader *reader, const JsonValue *root, CaseFile *draft)
{
    if (!draft->moordyn_path[0]) {
        const char *alone = draft->moordyn_body >= 0 ? "moordyn_body"
                            : draft->moordyn_axes    ? "moordyn_axes"
                                                     : NULL;
        return !alone || table_refuse(reader, alone, NULL, "must stand beside moordyn_file only");
    }
    if (draft->moordyn_axes == MOORDYN_BODY && draft->moordyn_body < 0)
        return table_refuse(reader, "moordyn_axes", NULL, "must stand beside moordyn_body only");
    char path[SCENE_PATH_SIZE];
    TRY(find_file(reader, draft->moordyn_path, path));
    MoordynFile *file = malloc(sizeof *file);
    if (!file) return error_set(reader->error, ERROR_SYSTEM, "no memory left for %.200s", path);
    bool good = moordyn_read(path, file, reader->error) && join_file(reader, root, file, draft);
    free(file);
    return good;
}
