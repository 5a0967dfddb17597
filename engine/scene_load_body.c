/// What must hold within one body or one line, once its members are read.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_case.h"

static bool is_plane(const JsonReader *reader)
{
    return reader->draft->scene.domain.dimensions == 2;
}

/// Refuse the member `key` of the object at `where`; when it was not given, without its value.
#define REFUSE(key, ...)                                                                           \
    do {                                                                                           \
        char at_[JSON_PATH_SIZE];                                                                  \
        snprintf(at_, sizeof at_, "%.120s." key, where);                                           \
        return table_refuse(reader, at_, tree_member(object, key), __VA_ARGS__);                   \
    } while (0)

/// What a shape needs and may have.
typedef struct ShapeKey {
    const char *key;
    const char *needed_by,
        *allowed_by; ///< initials of shapes: box sphere cylinder wigley polygon mesh
} ShapeKey;

static const char SHAPE_INITIALS[] = "bscwpm";
static const char *const SHAPE_NAMES[] = {"box", "sphere", "cylinder", "wigley", "polygon", "mesh"};
static const ShapeKey SHAPE_KEYS[] = {
    {"size_m", "bw", "bw"}, {"radius_m", "sc", "sc"},     {"length_m", "c", "c"},
    {"axis", "", "c"},      {"draft_design_m", "w", "w"}, {"breadth_m", "p", "p"},
    {"points_m", "p", "p"}, {"mesh", "m", "m"},           {"scale", "", "m"},
};

static bool check_shape(const JsonReader *reader, const JsonValue *object, const char *where,
                        const BodyScene *body)
{
    char at[JSON_PATH_SIZE];
    bool plane = is_plane(reader);
    char initial = SHAPE_INITIALS[body->shape];
    if (plane && strchr("swm", initial)) {
        snprintf(at, sizeof at, "%.120s.shape", where);
        return table_refuse(reader, at, tree_member(object, "shape"),
                            "must be \"box\", \"cylinder\" or \"polygon\" in 2-D");
    }
    for (size_t i = 0; i < sizeof SHAPE_KEYS / sizeof *SHAPE_KEYS; i++) {
        const ShapeKey *row = &SHAPE_KEYS[i];
        const JsonValue *member = tree_member(object, row->key);
        // in 2-D every section is 1 m long
        bool across = strcmp(row->key, "breadth_m") == 0 || strcmp(row->key, "length_m") == 0;
        bool needed = strchr(row->needed_by, initial) && !(plane && across);
        snprintf(at, sizeof at, "%.120s.%s", where, row->key);
        if (!member && needed)
            return table_refuse(reader, at, NULL, "is missing: must be given for a %s",
                                SHAPE_NAMES[body->shape]);
        if (member && !strchr(row->allowed_by, initial))
            return table_refuse(reader, at, member, "must not be given for a %s",
                                SHAPE_NAMES[body->shape]);
    }
    snprintf(at, sizeof at, "%.120s.axis", where);
    if (plane && body->shape == BODY_CYLINDER && body->axis != 1)
        return table_refuse(reader, at, tree_member(object, "axis"), "must be \"y\" in 2-D");
    return true;
}

/// Where the body is and what it weighs (the table at the head of hull_body.c): enough, not too
/// much.
static bool check_placement(const JsonReader *reader, const JsonValue *object, const char *where,
                            const BodyScene *body)
{
    bool has_z = !isnan(body->position.z), has_draft = !isnan(body->draft);
    bool has_mass = !isnan(body->mass), moved_by_forces = false;
    for (int i = 0; i < 6; i++)
        moved_by_forces = moved_by_forces || body->freedoms[i].kind == FREEDOM_FREE ||
                          body->freedoms[i].kind == FREEDOM_SPRING;
    if (has_z && has_draft && has_mass)
        REFUSE("draft_m", "must not be given together with mass_kg and z in position_m");
    if (!has_z && !has_draft && !has_mass)
        REFUSE("draft_m", "is missing: must be given, or mass_kg, or z in position_m");
    if (!has_mass && !has_draft && moved_by_forces)
        REFUSE("mass_kg", "is missing: must be > 0 and <= 1e+09 kg for a body that is not fixed, "
                          "or draft_m instead of z");
    return true;
}

/// Principal second moments a, b, c of mass obey a + b >= c; `slack` forgives rounding in the file.
static bool triangle_holds(double a, double b, double c)
{
    double slack = 1e-3 * (a + b + c);
    return a + b >= c - slack && b + c >= a - slack && c + a >= b - slack;
}

static bool check_inertia(const JsonReader *reader, const JsonValue *object, const char *where,
                          BodyScene *body)
{
    const Vec3 *k = &body->radii_of_gyration;
    double *i = body->inertia;
    bool has_radii = !isnan(k->x), has_inertia = !isnan(i[0]), plane = is_plane(reader);
    if (has_radii && has_inertia)
        REFUSE("inertia_kgm2", "must not be given together with radii_of_gyration_m");
    if (has_radii && !plane && !triangle_holds(k->x * k->x, k->y * k->y, k->z * k->z))
        REFUSE("radii_of_gyration_m", "no body has these: each squared must be <= the sum of the "
                                      "other two squared");
    if (!has_inertia) return true;
    for (int j = 3; j < 6; j++)
        if (isnan(i[j])) i[j] = 0;
    // positive definite by its leading minors: xx yy zz xy xz yz
    double minor = i[0] * i[1] - i[3] * i[3];
    double determinant = i[0] * (i[1] * i[2] - i[5] * i[5]) - i[3] * (i[3] * i[2] - i[5] * i[4]) +
                         i[4] * (i[3] * i[5] - i[1] * i[4]);
    if (!(i[0] > 0 && i[1] > 0 && i[2] > 0 && minor > 0 && determinant > 0))
        REFUSE("inertia_kgm2", "must be [xx, yy, zz] or [xx, yy, zz, xy, xz, yz] of a positive "
                               "definite tensor");
    if (!plane && !triangle_holds(i[0], i[1], i[2]))
        REFUSE("inertia_kgm2", "no body has these: each of xx, yy, zz must be <= the sum of the "
                               "other two");
    return true;
}

/// Motion at the start must be one that the freedoms allow.
static bool check_motion(const JsonReader *reader, const JsonValue *object, const char *where,
                         BodyScene *body)
{
    static const char *const NAMES[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    bool plane = is_plane(reader);
    for (int i = 0; i < 6; i++) {
        bool across = plane && (i == 1 || i == 3 || i == 5);
        if (across) body->freedoms[i].kind = FREEDOM_FIXED;
        FreedomKind kind = body->freedoms[i].kind;
        if (across && body->initial_offset[i] != 0)
            REFUSE("initial_offset", "%s must be 0 in 2-D", NAMES[i]);
        if (body->initial_velocity[i] != 0 && kind != FREEDOM_FREE && kind != FREEDOM_SPRING)
            REFUSE("initial_velocity", "%s must be 0: this freedom is %s", NAMES[i],
                   kind == FREEDOM_FIXED ? "fixed" : "prescribed");
    }
    if (plane && (body->attitude.x != 0 || body->attitude.z != 0))
        REFUSE("attitude_deg", "roll and yaw must be 0 in 2-D");
    return true;
}

bool case_resolve_path(const JsonReader *reader, const JsonValue *object, const char *where,
                       const char *key, char path[SCENE_PATH_SIZE])
{
    const char *slash = strrchr(reader->file, '/');
    char given[SCENE_PATH_SIZE];
    memcpy(given, path, sizeof given);
    if (!given[0] || given[0] == '/' || !slash) return true;
    int folder = (int)(slash - reader->file + 1);
    int length = snprintf(path, SCENE_PATH_SIZE, "%.*s%s", folder, reader->file, given);
    if (length < SCENE_PATH_SIZE) return true;
    char at[JSON_PATH_SIZE];
    snprintf(at, sizeof at, "%.120s.%s", where, key);
    return table_refuse(reader, at, tree_member(object, key),
                        "with the case's folder must have < %d characters", SCENE_PATH_SIZE);
}

/// A table prescribes every freedom.
static bool take_motion(const JsonReader *reader, const JsonValue *object, const char *where,
                        BodyScene *body)
{
    if (!body->motion_path[0]) return true;
    if (tree_member(object, "freedoms"))
        REFUSE("motion", "must not be given beside freedoms: it prescribes all six");
    for (int i = 0; i < 6; i++) {
        body->freedoms[i].kind = FREEDOM_PRESCRIBED;
        body->freedoms[i].period = INFINITY;
    }
    return case_resolve_path(reader, object, where, "motion", body->motion_path);
}

bool case_finish_body(const JsonReader *reader, const JsonValue *object, const char *where,
                      void *target)
{
    BodyScene *body = target;
    TRY(check_shape(reader, object, where, body));
    if (is_plane(reader)) body->size.y = body->length = body->breadth = 1;
    if (body->shape == BODY_WIGLEY && body->draft_design > body->size.z)
        REFUSE("draft_design_m", "must be > 0 and <= %.9g m (the depth in size_m)", body->size.z);
    TRY(take_motion(reader, object, where, body));
    TRY(check_motion(reader, object, where, body));
    TRY(check_placement(reader, object, where, body));
    TRY(check_inertia(reader, object, where, body));
    return case_resolve_path(reader, object, where, "mesh", body->mesh_path);
}
