/// The keys of bodies in a case file, and the values that need more than a range.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_case.h"

// clang-format off
#define IN_BODY(member) .offset = offsetof(BodyScene, member)
#define IN_FREEDOM(member) .offset = offsetof(Freedom, member)
#define COUNT(fields) (int)(sizeof(fields) / sizeof *(fields))
#define COORDINATE .min = -10000, .max = 10000, .unit = "m"
#define LENGTH_UP_TO(max_) .max = max_, .above_min = true, .unit = "m"
#define SYMMETRIC(max_, unit_) .min = -(max_), .max = max_, .unit = unit_
#define DEGREES(max_) .min = -(max_), .max = max_, .unit = "deg", .to_si = PI / 180
#define PER_DEGREES(max_) .min = -(max_), .max = max_, .unit = "deg/s", .to_si = PI / 180

// One degree of freedom as an object: {"prescribed": { ... }} or {"spring": { ... }}.

static const JsonField PRESCRIBED_TRANSLATION_FIELDS[] = {
    {"amplitude_m", FIELD_NUMBER, true, IN_FREEDOM(amplitude), .max = 100, .unit = "m"},
    {"period_s", FIELD_NUMBER, true, IN_FREEDOM(period), .min = 0.05, .max = 1000, .unit = "s"},
    {"phase_deg", FIELD_NUMBER, IN_FREEDOM(phase), DEGREES(360)},
    {"ramp_s", FIELD_NUMBER, IN_FREEDOM(ramp), .max = 10000, .unit = "s"},
};
static const JsonField PRESCRIBED_ROTATION_FIELDS[] = {
    {"amplitude_deg", FIELD_NUMBER, true, IN_FREEDOM(amplitude), .max = 180, .unit = "deg", .to_si = PI / 180},
    {"period_s", FIELD_NUMBER, true, IN_FREEDOM(period), .min = 0.05, .max = 1000, .unit = "s"},
    {"phase_deg", FIELD_NUMBER, IN_FREEDOM(phase), DEGREES(360)},
    {"ramp_s", FIELD_NUMBER, IN_FREEDOM(ramp), .max = 10000, .unit = "s"},
};
static const JsonField SPRING_TRANSLATION_FIELDS[] = {
    {"stiffness_n_per_m", FIELD_NUMBER, true, IN_FREEDOM(stiffness), .max = 1e12, .unit = "N/m"},
    {"damping_n_s_per_m", FIELD_NUMBER, IN_FREEDOM(damping), .max = 1e12, .unit = "N s/m"},
    {"rest_m", FIELD_NUMBER, IN_FREEDOM(rest), SYMMETRIC(100, "m")},
};
static const JsonField SPRING_ROTATION_FIELDS[] = {
    {"stiffness_n_m_per_rad", FIELD_NUMBER, true, IN_FREEDOM(stiffness), .max = 1e12, .unit = "N m/rad"},
    {"damping_n_m_s_per_rad", FIELD_NUMBER, IN_FREEDOM(damping), .max = 1e12, .unit = "N m s/rad"},
    {"rest_deg", FIELD_NUMBER, IN_FREEDOM(rest), DEGREES(180)},
};
static const JsonTable PRESCRIBED_TRANSLATION = {PRESCRIBED_TRANSLATION_FIELDS, COUNT(PRESCRIBED_TRANSLATION_FIELDS), NULL};
static const JsonTable PRESCRIBED_ROTATION = {PRESCRIBED_ROTATION_FIELDS, COUNT(PRESCRIBED_ROTATION_FIELDS), NULL};
static const JsonTable SPRING_TRANSLATION = {SPRING_TRANSLATION_FIELDS, COUNT(SPRING_TRANSLATION_FIELDS), NULL};
static const JsonTable SPRING_ROTATION = {SPRING_ROTATION_FIELDS, COUNT(SPRING_ROTATION_FIELDS), NULL};

static bool finish_freedom(const JsonReader *reader, const JsonValue *object, const char *where, void *target);

static const JsonField TRANSLATION_FIELDS[] = {
    {"prescribed", FIELD_OBJECT, .table = &PRESCRIBED_TRANSLATION},
    {"spring", FIELD_OBJECT, .table = &SPRING_TRANSLATION},
};
static const JsonField ROTATION_FIELDS[] = {
    {"prescribed", FIELD_OBJECT, .table = &PRESCRIBED_ROTATION},
    {"spring", FIELD_OBJECT, .table = &SPRING_ROTATION},
};
static const JsonTable TRANSLATION_TABLE = {TRANSLATION_FIELDS, COUNT(TRANSLATION_FIELDS), finish_freedom};
static const JsonTable ROTATION_TABLE = {ROTATION_FIELDS, COUNT(ROTATION_FIELDS), finish_freedom};

static bool read_freedom(const JsonReader *reader, const JsonField *field, const JsonValue *value, const char *where, void *target);
static bool read_freedoms(const JsonReader *reader, const JsonField *field, const JsonValue *value, const char *where, void *target);
static bool read_colour(const JsonReader *reader, const JsonField *field, const JsonValue *value, const char *where, void *target);
static bool read_section(const JsonReader *reader, const JsonField *field, const JsonValue *value, const char *where, void *target);

#define FREEDOM(key_, index_, table_) \
    {key_, FIELD_CUSTOM, .offset = (index_) * sizeof(Freedom), .table = &table_, .read = read_freedom}
static const JsonField FREEDOMS_FIELDS[] = {
    {"others", FIELD_CUSTOM, .read = read_freedom}, // first: sets all six
    FREEDOM("surge", 0, TRANSLATION_TABLE), FREEDOM("sway", 1, TRANSLATION_TABLE),
    FREEDOM("heave", 2, TRANSLATION_TABLE), FREEDOM("roll", 3, ROTATION_TABLE),
    FREEDOM("pitch", 4, ROTATION_TABLE),    FREEDOM("yaw", 5, ROTATION_TABLE),
};
static const JsonTable FREEDOMS_TABLE = {FREEDOMS_FIELDS, COUNT(FREEDOMS_FIELDS), NULL};

#define IN_SIX(index_) .offset = (index_) * sizeof(double)
static const JsonField OFFSET_FIELDS[] = {
    {"surge_m", FIELD_NUMBER, IN_SIX(0), SYMMETRIC(1000, "m")},
    {"sway_m", FIELD_NUMBER, IN_SIX(1), SYMMETRIC(1000, "m")},
    {"heave_m", FIELD_NUMBER, IN_SIX(2), SYMMETRIC(1000, "m")},
    {"roll_deg", FIELD_NUMBER, IN_SIX(3), DEGREES(180)},
    {"pitch_deg", FIELD_NUMBER, IN_SIX(4), DEGREES(90)},
    {"yaw_deg", FIELD_NUMBER, IN_SIX(5), DEGREES(360)},
};
static const JsonTable OFFSET_TABLE = {OFFSET_FIELDS, COUNT(OFFSET_FIELDS), NULL};

static const JsonField VELOCITY_FIELDS[] = {
    {"surge_ms", FIELD_NUMBER, IN_SIX(0), SYMMETRIC(100, "m/s")},
    {"sway_ms", FIELD_NUMBER, IN_SIX(1), SYMMETRIC(100, "m/s")},
    {"heave_ms", FIELD_NUMBER, IN_SIX(2), SYMMETRIC(100, "m/s")},
    {"roll_deg_per_s", FIELD_NUMBER, IN_SIX(3), PER_DEGREES(3600)},
    {"pitch_deg_per_s", FIELD_NUMBER, IN_SIX(4), PER_DEGREES(3600)},
    {"yaw_deg_per_s", FIELD_NUMBER, IN_SIX(5), PER_DEGREES(3600)},
};
static const JsonTable VELOCITY_TABLE = {VELOCITY_FIELDS, COUNT(VELOCITY_FIELDS), NULL};

static const JsonField BODY_FIELDS[] = {
    {"name", FIELD_NAME, true, IN_BODY(name), .count_max = SCENE_NAME_SIZE},
    {"shape", FIELD_CHOICE, true, IN_BODY(shape),
     .choices = {"box", "sphere", "cylinder", "wigley", "polygon", "mesh"}},
    {"size_m", FIELD_POINT, IN_BODY(size), LENGTH_UP_TO(1000)},
    {"radius_m", FIELD_NUMBER, IN_BODY(radius), LENGTH_UP_TO(1000)},
    {"length_m", FIELD_NUMBER, IN_BODY(length), LENGTH_UP_TO(1000)},
    {"axis", FIELD_CHOICE, IN_BODY(axis), .choices = {"x", "y", "z"}},
    {"draft_design_m", FIELD_NUMBER, IN_BODY(draft_design), LENGTH_UP_TO(1000)},
    {"breadth_m", FIELD_NUMBER, IN_BODY(breadth), LENGTH_UP_TO(1000)},
    {"points_m", FIELD_CUSTOM, IN_BODY(polygon), COORDINATE, .read = read_section},
    {"mesh", FIELD_TEXT, IN_BODY(mesh_path), .count_max = SCENE_PATH_SIZE},
    {"scale", FIELD_NUMBER, IN_BODY(scale), .max = 10000, .above_min = true},
    {"position_m", FIELD_POSITION, true, IN_BODY(position), COORDINATE},
    {"attitude_deg", FIELD_NUMBERS, IN_BODY(attitude), DEGREES(360), .count_min = 3, .count_max = 3},
    {"mass_kg", FIELD_NUMBER, IN_BODY(mass), .max = 1e9, .above_min = true, .unit = "kg"},
    {"draft_m", FIELD_NUMBER, IN_BODY(draft), LENGTH_UP_TO(1000)},
    {"centre_of_gravity_m", FIELD_POINT, IN_BODY(centre_of_gravity), SYMMETRIC(1000, "m")},
    {"radii_of_gyration_m", FIELD_NUMBERS, IN_BODY(radii_of_gyration), LENGTH_UP_TO(1000), .count_min = 3, .count_max = 3},
    {"inertia_kgm2", FIELD_NUMBERS, IN_BODY(inertia), SYMMETRIC(1e15, "kg m2"), .count_min = 3, .count_max = 6},
    {"freedoms", FIELD_CUSTOM, IN_BODY(freedoms), .table = &FREEDOMS_TABLE, .read = read_freedoms},
    {"motion", FIELD_TEXT, IN_BODY(motion_path), .count_max = SCENE_PATH_SIZE},
    {"initial_offset", FIELD_OBJECT, IN_BODY(initial_offset), .table = &OFFSET_TABLE},
    {"initial_velocity", FIELD_OBJECT, IN_BODY(initial_velocity), .table = &VELOCITY_TABLE},
    {"hold_s", FIELD_NUMBER, IN_BODY(hold_time), .max = 10000, .unit = "s"},
    {"colour", FIELD_CUSTOM, IN_BODY(colour), .read = read_colour},
};
const JsonTable BODY_TABLE = {BODY_FIELDS, COUNT(BODY_FIELDS), case_finish_body};

// clang-format on

bool case_read_body(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                    const char *where, void *target)
{
    const Scene *scene = &reader->draft->scene;
    if (tree_type(value) != JSON_TEXT)
        return table_refuse(reader, where, value, "must be the name of a body in quotes");
    for (int i = 0; i < scene->body_count; i++)
        if (strcmp(scene->bodies[i].name, tree_text(value)) == 0) {
            *(int *)target = i;
            return true;
        }
    return table_refuse(
        reader, where, value, "no such body: must be the name of one in bodies%s%s%s",
        scene->body_count ? ", as \"" : " (there is none)",
        scene->body_count ? scene->bodies[0].name : "", scene->body_count ? "\"" : "");
}

static bool finish_freedom(const JsonReader *reader, const JsonValue *object, const char *where,
                           void *target)
{
    bool prescribed = tree_member(object, "prescribed"), spring = tree_member(object, "spring");
    if (prescribed == spring)
        return table_refuse(reader, where, object, "must have either \"prescribed\" or \"spring\"");
    ((Freedom *)target)->kind = prescribed ? FREEDOM_PRESCRIBED : FREEDOM_SPRING;
    return true;
}

static bool read_freedom_word(const JsonValue *value, FreedomKind *kind)
{
    if (tree_type(value) != JSON_TEXT) return false;
    const char *word = tree_text(value);
    *kind = strcmp(word, "free") == 0 ? FREEDOM_FREE : FREEDOM_FIXED;
    return strcmp(word, "free") == 0 || strcmp(word, "fixed") == 0;
}

static bool read_freedom(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                         const char *where, void *target)
{
    Freedom *freedoms = target;
    bool others = !field->table;
    FreedomKind kind = FREEDOM_FREE;
    bool word = read_freedom_word(value, &kind);
    for (int i = 0; word && i < (others ? 6 : 1); i++)
        freedoms[i].kind = kind;
    if (!word && (others || tree_type(value) != JSON_OBJECT))
        return table_refuse(reader, where, value, "must be \"free\"%s",
                            others ? " or \"fixed\""
                                   : ", \"fixed\", {\"prescribed\": ...} or {\"spring\": ...}");
    size_t index = field->offset / sizeof(Freedom);
    bool out_of_plane = index == 1 || index == 3 || index == 5;
    if (reader->draft->scene.domain.dimensions == 2 && out_of_plane && kind != FREEDOM_FIXED)
        return table_refuse(reader, where, value, "must be \"fixed\" in 2-D");
    return word || table_read(reader, field->table, value, where, target);
}

static bool read_freedoms(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                          const char *where, void *target)
{
    Freedom *freedoms = target;
    FreedomKind kind;
    if (read_freedom_word(value, &kind)) {
        for (int i = 0; i < 6; i++)
            freedoms[i].kind = kind;
        return true;
    }
    if (tree_type(value) != JSON_OBJECT)
        return table_refuse(reader, where, value,
                            "must be \"free\", \"fixed\" or an object of freedoms");
    return table_read(reader, field->table, value, where, target);
}

static bool read_colour(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                        const char *where, void *target)
{
    double *colour = target;
    unsigned rgb = 0;
    char rest = 0;
    const char *text = tree_type(value) == JSON_TEXT ? tree_text(value) : "";
    if (strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6 ||
        sscanf(text, "#%6x%c", &rgb, &rest) != 1)
        return table_refuse(reader, where, value, "must be a colour \"#rrggbb\"");
    for (int i = 0; i < 3; i++)
        colour[i] = ((rgb >> (16 - 8 * i)) & 255) / 255.0;
    return true;
}

/// Points only; whether they make a section is the hull's business (mesh_create).
static bool read_section(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                         const char *where, void *target)
{
    double(*points)[2] = target;
    BodyScene *body = (BodyScene *)((char *)target - field->offset);
    int count = tree_type(value) == JSON_LIST ? tree_count(value) : 0;
    if (count < 3 || count > SCENE_POLYGON_MAX)
        return table_refuse(reader, where, value, "must be a list of 3 to %d points [x, z]",
                            SCENE_POLYGON_MAX);
    JsonField pair = *field;
    pair.kind = FIELD_NUMBERS;
    pair.count_min = pair.count_max = 2;
    pair.offset = 0;
    const JsonValue *item = tree_first(value);
    for (int i = 0; i < count; i++, item = tree_next(item)) {
        char at[JSON_PATH_SIZE];
        snprintf(at, sizeof at, "%.120s[%d]", where, i);
        TRY(table_read_field(reader, &pair, item, at, points[i]));
    }
    body->polygon_count = count;
    return true;
}
