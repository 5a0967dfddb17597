#include "scene_table.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scene_case.h"

enum { EXCERPT_SIZE = 60, RANGE_TEXT_SIZE = 96 };

bool table_refuse(const JsonReader *reader, const char *where, const JsonValue *value,
                  const char *format, ...)
{
    char text[512], excerpt[EXCERPT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (!value)
        return error_set(reader->error, ERROR_INPUT, "%s: %s: %s", reader->file, where, text);
    if (tree_type(value) == JSON_NUMBER)
        snprintf(excerpt, sizeof excerpt, "%.12g", tree_number(value));
    else
        tree_excerpt(value, excerpt, sizeof excerpt);
    return error_set(reader->error, ERROR_INPUT, "%s: %s = %s: %s", reader->file, where, excerpt,
                     text);
}

bool table_refuse_number(const JsonReader *reader, const char *where, double value,
                         const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return error_set(reader->error, ERROR_INPUT, "%s: %s = %.9g: %s", reader->file, where, value,
                     text);
}

/// "> 0 and <= 10 m"
static const char *range_text(const JsonField *field, char text[RANGE_TEXT_SIZE])
{
    snprintf(text, RANGE_TEXT_SIZE, "%s %.9g and <= %.9g%s%s",
             field->above_min ? ">" : ">=", field->min, field->max, field->unit ? " " : "",
             field->unit ? field->unit : "");
    return text;
}

static bool read_number(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                        const char *where, double *number)
{
    char range[RANGE_TEXT_SIZE];
    if (tree_type(value) != JSON_NUMBER)
        return table_refuse(reader, where, value, "must be a number %s", range_text(field, range));
    double v = tree_number(value);
    if (!isfinite(v) || v < field->min || v > field->max || (field->above_min && v <= field->min))
        return table_refuse(reader, where, value, "must be %s", range_text(field, range));
    *number = v * (field->to_si != 0 ? field->to_si : 1);
    return true;
}

static bool read_integer(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                         const char *where, int *number)
{
    char range[RANGE_TEXT_SIZE];
    double v = tree_type(value) == JSON_NUMBER ? tree_number(value) : NAN;
    if (!(v >= field->min && v <= field->max) || v != floor(v))
        return table_refuse(reader, where, value, "must be a whole number %s",
                            range_text(field, range));
    *number = (int)v;
    return true;
}

/// Numbers of a list, one range for all; `count` says how many there were.
static bool read_numbers(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                         const char *where, int count_min, int count_max, double *numbers,
                         int *count)
{
    char range[RANGE_TEXT_SIZE], at[JSON_PATH_SIZE];
    *count = tree_type(value) == JSON_LIST ? tree_count(value) : -1;
    if (*count != count_min && *count != count_max) {
        char counts[32];
        snprintf(counts, sizeof counts, count_min == count_max ? "%d" : "%d or %d", count_min,
                 count_max);
        return table_refuse(reader, where, value, "must be a list of %s numbers %s", counts,
                            range_text(field, range));
    }
    const JsonValue *item = tree_first(value);
    for (int i = 0; i < *count; i++, item = tree_next(item)) {
        snprintf(at, sizeof at, "%s[%d]", where, i);
        TRY(read_number(reader, field, item, at, &numbers[i]));
    }
    return true;
}

static bool read_range(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                       const char *where, Range *range)
{
    double numbers[2] = {NAN, NAN};
    int count;
    TRY(read_numbers(reader, field, value, where, 2, 2, numbers, &count));
    if (numbers[0] > numbers[1])
        return table_refuse(reader, where, value, "must be [smallest, largest]");
    range->min = numbers[0];
    range->max = numbers[1];
    return true;
}

/// A point; with `floating` its z may be left out. In 2-D a point is [x, z], and y is always 0.
static bool read_point(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                       const char *where, bool floating, Vec3 *point)
{
    bool plane = reader->draft->scene.domain.dimensions == 2;
    int given = tree_type(value) == JSON_LIST ? tree_count(value) : 0;
    int least = (plane ? 2 : 3) - floating, count;
    double n[3] = {NAN, NAN, NAN};
    TRY(read_numbers(reader, field, value, where, plane && given == 2 ? 2 : least, 3, n, &count));
    if (!plane)
        *point = vec3(n[0], n[1], n[2]);
    else
        *point = vec3(n[0], 0, isnan(n[2]) ? n[1] : n[2]);
    return true;
}

static bool read_text(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                      const char *where, char *text)
{
    if (tree_type(value) != JSON_TEXT)
        return table_refuse(reader, where, value, "must be a text in quotes");
    const char *from = tree_text(value);
    size_t length = strlen(from);
    if (!length || length >= (size_t)field->count_max)
        return table_refuse(reader, where, value, "must have 1 to %d characters (bytes in UTF-8)",
                            field->count_max - 1);
    for (const char *c = from; *c; c++) {
        if (field->kind == FIELD_NAME && !isalnum((unsigned char)*c) && *c != '_' && *c != '-')
            return table_refuse(reader, where, value,
                                "must be a name of letters a-z A-Z, digits, _ and - (it heads "
                                "columns of the series)");
        if ((unsigned char)*c < 0x20 || *c == 0x7F)
            return table_refuse(reader, where, value,
                                "must be one line without control characters");
    }
    memcpy(text, from, length + 1);
    return true;
}

static bool read_choice(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                        const char *where, int *choice)
{
    char all[160] = "";
    for (int i = 0; field->choices[i]; i++) {
        if (tree_type(value) == JSON_TEXT && strcmp(tree_text(value), field->choices[i]) == 0) {
            *choice = i;
            return true;
        }
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s\"%s\"", i ? ", " : "", field->choices[i]);
    }
    return table_refuse(reader, where, value, "must be one of %s", all);
}

static bool read_list(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                      const char *where, void *target)
{
    if (tree_type(value) != JSON_LIST)
        return table_refuse(reader, where, value, "must be a list of objects: [ { ... } ]");
    int count = tree_count(value);
    if (count > field->count_max)
        return table_refuse(reader, where, NULL, "has %d items: must have <= %d", count,
                            field->count_max);
    int *counter = (int *)((char *)target + field->counter_offset);
    char *items = (char *)target + field->offset;
    *counter = 0;
    for (const JsonValue *item = tree_first(value); item; item = tree_next(item)) {
        char at[JSON_PATH_SIZE];
        snprintf(at, sizeof at, "%s[%d]", where, *counter);
        void *slot = items + (size_t)*counter * field->item_size;
        if (field->item_default) field->item_default(slot);
        TRY(table_read(reader, field->table, item, at, slot));
        ++*counter;
    }
    return true;
}

bool table_read_field(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                      const char *where, void *target)
{
    void *to = (char *)target + field->offset;
    int count;
    switch (field->kind) {
    case FIELD_NUMBER:
        return read_number(reader, field, value, where, to);
    case FIELD_INTEGER:
        return read_integer(reader, field, value, where, to);
    case FIELD_NUMBERS:
        return read_numbers(reader, field, value, where, field->count_min, field->count_max, to,
                            &count);
    case FIELD_RANGE:
        return read_range(reader, field, value, where, to);
    case FIELD_POINT:
        return read_point(reader, field, value, where, false, to);
    case FIELD_POSITION:
        return read_point(reader, field, value, where, true, to);
    case FIELD_TEXT:
    case FIELD_NAME:
        return read_text(reader, field, value, where, to);
    case FIELD_CHOICE:
        return read_choice(reader, field, value, where, to);
    case FIELD_OBJECT:
        return table_read(reader, field->table, value, where, to);
    case FIELD_LIST:
        return read_list(reader, field, value, where, target);
    case FIELD_CUSTOM:
        return field->read(reader, field, value, where, to);
    }
    return false;
}

/// Number of single-character changes from one key to another (Levenshtein 1966).
static int edit_distance(const char *a, const char *b)
{
    enum { LENGTH_MAX = 40 };
    int row[LENGTH_MAX + 1];
    int columns = (int)strnlen(b, LENGTH_MAX);
    for (int j = 0; j <= columns; j++)
        row[j] = j;
    for (int i = 1; a[i - 1] && i <= LENGTH_MAX; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= columns; j++) {
            int change = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            int least = row[j] < row[j - 1] ? row[j] + 1 : row[j - 1] + 1;
            row[j] = change < least ? change : least;
        }
    }
    return row[columns];
}

/// "fluid" + "spacing_m"; the top has no name.
static void member_path(char at[JSON_PATH_SIZE], const char *where, const char *key)
{
    snprintf(at, JSON_PATH_SIZE, "%.110s%s%.40s", where, *where ? "." : "", key);
}

static bool refuse_unknown(const JsonReader *reader, const JsonTable *table, const char *where,
                           const char *key)
{
    char at[JSON_PATH_SIZE];
    int nearest = 0, distance = 1000;
    for (int i = 0; i < table->field_count; i++) {
        int d = edit_distance(key, table->fields[i].key);
        if (d < distance) distance = d, nearest = i;
    }
    member_path(at, where, key);
    return table_refuse(reader, at, NULL, "unknown key: the nearest known one is \"%s\"",
                        table->fields[nearest].key);
}

static bool check_notes(const JsonReader *reader, const JsonValue *notes, const char *at)
{
    if (tree_type(notes) == JSON_TEXT) return true;
    bool texts = tree_type(notes) == JSON_LIST;
    for (const JsonValue *item = texts ? tree_first(notes) : NULL; item; item = tree_next(item))
        texts = texts && tree_type(item) == JSON_TEXT;
    return texts || table_refuse(reader, at, notes, "must be a text or a list of texts");
}

/// Every member is known and none stands twice.
static bool check_keys(const JsonReader *reader, const JsonTable *table, const JsonValue *object,
                       const char *where)
{
    char at[JSON_PATH_SIZE];
    unsigned long long seen = 0; // bit 63: notes
    ASSERT(table->field_count < 63);
    for (const JsonValue *member = tree_first(object); member; member = tree_next(member)) {
        const char *key = tree_key(member);
        int index = 0;
        while (index < table->field_count && strcmp(key, table->fields[index].key) != 0)
            index++;
        bool is_notes = strcmp(key, "notes") == 0;
        if (index == table->field_count && !is_notes)
            return refuse_unknown(reader, table, where, key);
        member_path(at, where, key);
        if (is_notes) TRY(check_notes(reader, member, at));
        unsigned long long bit = 1ULL << (is_notes ? 63 : index);
        if (seen & bit) return table_refuse(reader, at, member, "stands twice: must be given once");
        seen |= bit;
    }
    return true;
}

bool table_read(const JsonReader *reader, const JsonTable *table, const JsonValue *object,
                const char *where, void *target)
{
    char at[JSON_PATH_SIZE], range[RANGE_TEXT_SIZE];
    if (tree_type(object) != JSON_OBJECT)
        return table_refuse(reader, where, object, "must be an object: { ... }");
    TRY(check_keys(reader, table, object, where));
    for (int i = 0; i < table->field_count; i++) {
        const JsonField *field = &table->fields[i];
        const JsonValue *member = tree_member(object, field->key);
        member_path(at, where, field->key);
        if (member)
            TRY(table_read_field(reader, field, member, at, target));
        else if (field->required)
            return table_refuse(reader, at, NULL, "is missing: must be %s",
                                field->max > field->min ? range_text(field, range) : "given");
    }
    return table->finish ? table->finish(reader, object, where, target) : true;
}
