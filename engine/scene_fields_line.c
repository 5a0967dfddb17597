/// The keys of lines, their sections and the points where they meet, and the rules within each.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_case.h"

static bool read_point_name(const JsonReader *reader, const JsonField *field,
                            const JsonValue *value, const char *where, void *target);
static bool finish_end(const JsonReader *reader, const JsonValue *object, const char *where,
                       void *target);
static bool finish_point(const JsonReader *reader, const JsonValue *object, const char *where,
                         void *target);
static void section_default(void *item) { *(LineSection *)item = line_section_default(); }

// clang-format off
#define IN_LINE(member) .offset = offsetof(LineScene, member)
#define IN_SECTION(member) .offset = offsetof(LineSection, member)
#define IN_POINT(member) .offset = offsetof(PointScene, member)
#define COUNT(fields) (int)(sizeof(fields) / sizeof *(fields))
#define COORDINATE .min = -10000, .max = 10000, .unit = "m"
#define LENGTH_UP_TO(max_) .max = max_, .above_min = true, .unit = "m"

static const JsonField POINT_FIELDS[] = {
    {"name", FIELD_NAME, true, IN_POINT(name), .count_max = SCENE_NAME_SIZE},
    {"kind", FIELD_CHOICE, true, IN_POINT(kind), .choices = {"fixed", "free"}},
    {"body", FIELD_CUSTOM, IN_POINT(body), .read = case_read_body},
    {"position_m", FIELD_POINT, true, IN_POINT(position), COORDINATE},
    {"mass_kg", FIELD_NUMBER, IN_POINT(mass), .max = 1e9, .unit = "kg"},
    {"volume_m3", FIELD_NUMBER, IN_POINT(volume), .max = 1e6, .unit = "m3"},
    {"drag_area_m2", FIELD_NUMBER, IN_POINT(drag_area), .max = 1e6, .unit = "m2"},
    {"added_mass", FIELD_NUMBER, IN_POINT(added_mass), .max = 20},
};
const JsonTable POINT_TABLE = {POINT_FIELDS, COUNT(POINT_FIELDS), finish_point};

static const JsonField END_FIELDS[] = {
    {"body", FIELD_CUSTOM, .offset = offsetof(LineEnd, body), .read = case_read_body},
    {"point", FIELD_CUSTOM, .offset = offsetof(LineEnd, point), .read = read_point_name},
    {"position_m", FIELD_POINT, .offset = offsetof(LineEnd, position), COORDINATE},
};
static const JsonTable END_TABLE = {END_FIELDS, COUNT(END_FIELDS), finish_end};

// What a line and each of its sections may say.
#define MATERIAL(IN_) \
    {"axial_stiffness_n", FIELD_NUMBER, IN_(axial_stiffness), .max = 1e12, .above_min = true, .unit = "N"}, \
    {"mass_kgm", FIELD_NUMBER, IN_(mass_per_length), .max = 10000, .above_min = true, .unit = "kg/m"}, \
    {"diameter_m", FIELD_NUMBER, IN_(diameter), LENGTH_UP_TO(5)}, \
    {"drag_normal", FIELD_NUMBER, IN_(drag_normal), .max = 20}, \
    {"drag_tangential", FIELD_NUMBER, IN_(drag_tangential), .max = 20}, \
    {"added_normal", FIELD_NUMBER, IN_(added_normal), .max = 20}, \
    {"added_tangential", FIELD_NUMBER, IN_(added_tangential), .max = 20}, \
    {"damping_ratio", FIELD_NUMBER, IN_(damping_ratio), .max = 5}, \
    {"bending_stiffness_nm2", FIELD_NUMBER, IN_(bending_stiffness), .max = 1e12, .unit = "N m2"}, \
    {"breaking_tension_n", FIELD_NUMBER, IN_(breaking_tension), .max = 1e12, .unit = "N"}

static const JsonField SECTION_FIELDS[] = {
    {"length_m", FIELD_NUMBER, true, IN_SECTION(length), LENGTH_UP_TO(100000)},
    {"segments", FIELD_INTEGER, IN_SECTION(segments), .max = 256},
    MATERIAL(IN_SECTION),
};
static const JsonTable SECTION_TABLE = {SECTION_FIELDS, COUNT(SECTION_FIELDS), NULL};

static const JsonField WINCH_FIELDS[] = {
    {"length_m", FIELD_RANGE, true, IN_LINE(winch.length), LENGTH_UP_TO(100000)},
    {"speed_ms", FIELD_NUMBER, true, IN_LINE(winch.speed), .max = 100, .above_min = true, .unit = "m/s"},
};
static const JsonTable WINCH_TABLE = {WINCH_FIELDS, COUNT(WINCH_FIELDS), NULL};

static const JsonField LINE_FIELDS[] = {
    {"name", FIELD_NAME, true, IN_LINE(name), .count_max = SCENE_NAME_SIZE},
    {"anchor", FIELD_OBJECT, true, IN_LINE(anchor), .table = &END_TABLE},
    {"fairlead", FIELD_OBJECT, true, IN_LINE(fairlead), .table = &END_TABLE},
    {"length_m", FIELD_NUMBER, IN_LINE(length), LENGTH_UP_TO(100000)},
    {"pretension_n", FIELD_NUMBER, IN_LINE(pretension), .max = 1e12, .above_min = true, .unit = "N"},
    {"segments", FIELD_INTEGER, IN_LINE(segments), .min = 1, .max = 256},
    MATERIAL(IN_LINE),
    {"bed_stiffness_pa_per_m", FIELD_NUMBER, IN_LINE(bed_stiffness), .max = 1e12, .unit = "Pa/m"},
    {"bed_damping_pa_s_per_m", FIELD_NUMBER, IN_LINE(bed_damping), .max = 1e12, .unit = "Pa s/m"},
    {"bed_friction", FIELD_NUMBER, IN_LINE(bed_friction), .max = 5},
    {"water", FIELD_CHOICE, IN_LINE(water), .choices = {"incident", "sph"}},
    {"winch", FIELD_OBJECT, .table = &WINCH_TABLE},
    {"sections", FIELD_LIST, IN_LINE(sections), .table = &SECTION_TABLE,
     .item_size = sizeof(LineSection), .counter_offset = offsetof(LineScene, section_count),
     .count_max = SCENE_LINE_SECTIONS_MAX, .item_default = section_default},
};
const JsonTable LINE_TABLE = {LINE_FIELDS, COUNT(LINE_FIELDS), case_finish_line};
// clang-format on

#define REFUSE(key, ...)                                                                           \
    do {                                                                                           \
        char at_[JSON_PATH_SIZE];                                                                  \
        snprintf(at_, sizeof at_, "%.120s.%s", where, key);                                        \
        return table_refuse(reader, at_, tree_member(object, key), __VA_ARGS__);                   \
    } while (0)

static bool read_point_name(const JsonReader *reader, const JsonField *field,
                            const JsonValue *value, const char *where, void *target)
{
    (void)field;
    const Scene *scene = &reader->draft->scene;
    if (tree_type(value) != JSON_TEXT)
        return table_refuse(reader, where, value, "must be the name of a point in quotes");
    for (int i = 0; i < scene->point_count; i++)
        if (strcmp(scene->points[i].name, tree_text(value)) == 0) {
            *(int *)target = i;
            return true;
        }
    return table_refuse(
        reader, where, value, "no such point: must be the name of one in points%s%s%s",
        scene->point_count ? ", as \"" : " (there is none)",
        scene->point_count ? scene->points[0].name : "", scene->point_count ? "\"" : "");
}

/// Either at a point, or at a position on earth or on a body.
static bool finish_end(const JsonReader *reader, const JsonValue *object, const char *where,
                       void *target)
{
    LineEnd *end = target;
    bool placed = tree_member(object, "position_m");
    if (end->point >= 0 && (placed || end->body >= 0))
        REFUSE("point", "must stand alone: the point has its own position_m and body");
    if (end->point < 0 && !placed)
        REFUSE("position_m", "is missing: must be a list of 3 numbers >= -10000 and <= 10000 m, or "
                             "point must be given");
    if (end->point < 0) return true;
    const PointScene *point = &reader->draft->scene.points[end->point];
    end->body = point->kind == POINT_FIXED ? point->body : -1;
    end->position = point->position;
    return true;
}

static bool finish_point(const JsonReader *reader, const JsonValue *object, const char *where,
                         void *target)
{
    const PointScene *point = target;
    static const char *const free_only[] = {"mass_kg", "volume_m3", "drag_area_m2", "added_mass"};
    if (point->kind == POINT_FREE) {
        if (point->body >= 0) REFUSE("body", "must not be given for a free point");
        return true;
    }
    for (int i = 0; i < 4; i++)
        if (tree_member(object, free_only[i]))
            REFUSE(free_only[i], "must be given for a free point only");
    return true;
}

/// EA, mass and diameter come from the line, or from each of its sections.
static bool check_material(const JsonReader *reader, const JsonValue *object, const char *where,
                           const LineScene *line)
{
    static const char *const keys[3] = {"axial_stiffness_n", "mass_kgm", "diameter_m"};
    const double own[3] = {line->axial_stiffness, line->mass_per_length, line->diameter};
    for (int k = 0; k < 3; k++) {
        bool said = !isnan(own[k]);
        for (int i = 0; i < line->section_count && !said; i++) {
            const LineSection *s = &line->sections[i];
            const double values[3] = {s->axial_stiffness, s->mass_per_length, s->diameter};
            if (isnan(values[k])) break;
            said = i + 1 == line->section_count;
        }
        if (!said)
            REFUSE(keys[k], "is missing: must be > 0 here%s",
                   line->section_count ? " or in each of sections" : "");
    }
    return true;
}

static bool check_length(const JsonReader *reader, const JsonValue *object, const char *where,
                         const LineScene *line)
{
    bool length = !isnan(line->length), pretension = !isnan(line->pretension);
    if (line->section_count) {
        if (length) REFUSE("length_m", "must not be given beside sections: it is their sum");
        if (pretension) REFUSE("pretension_n", "must not be given beside sections");
        return true;
    }
    if (length && pretension)
        REFUSE("pretension_n", "must not be given beside length_m: one follows from the other");
    if (!length && !pretension)
        REFUSE("length_m", "is missing: must be > 0 and <= 100000 m (or pretension_n or sections "
                           "must be given)");
    return true;
}

bool case_finish_line(const JsonReader *reader, const JsonValue *object, const char *where,
                      void *target)
{
    LineScene *line = target;
    if (line->anchor.body >= 0 && line->anchor.body == line->fairlead.body)
        REFUSE("fairlead", "both ends hold the same body: must be two bodies, or one end on earth");
    if (line->anchor.point >= 0 && line->anchor.point == line->fairlead.point)
        REFUSE("fairlead", "both ends are at the same point: must be two");
    TRY(check_material(reader, object, where, line));
    TRY(check_length(reader, object, where, line));
    line_scene_complete(line);
    if (line->segments > 256)
        REFUSE("sections", "have %d segments: must be <= 256 together", line->segments);
    double length = line->length;
    if (line->winch.speed > 0 && !isnan(length) &&
        !(length >= line->winch.length.min && length <= line->winch.length.max))
        REFUSE("winch", "its length_m must hold the line's length, %.9g m", length);
    if (line->water == LINE_WATER_SPH && reader->draft->scene.domain.kind == DOMAIN_LINES)
        REFUSE("water", "must be \"incident\" in a domain of lines: there are no particles");
    return true;
}
