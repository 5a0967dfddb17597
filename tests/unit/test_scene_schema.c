/// cases/schema.json says to editors what the reader's tables say to the program: the same keys,
/// types, ranges and defaults, both ways; and every shipped case is valid by it.
#include <dirent.h>
#include <stdlib.h>

#include "scene_case.h"
#include "test.h"

static JsonValue *schema;

static void say(const char *where, const char *what)
{
    printf("  %s: %s\n", where, what);
    test_failures++;
}

static const JsonValue *resolve(const JsonValue *node)
{
    static const char PREFIX[] = "#/definitions/";
    const JsonValue *reference = node ? tree_member(node, "$ref") : NULL;
    if (!reference) return node;
    return tree_member(tree_member(schema, "definitions"),
                       tree_text(reference) + sizeof PREFIX - 1);
}

static double number_of(const JsonValue *node, const char *key)
{
    const JsonValue *value = node ? tree_member(node, key) : NULL;
    return value && tree_type(value) == JSON_NUMBER ? tree_number(value) : NAN;
}

static bool text_is(const JsonValue *value, const char *text)
{
    return value && tree_type(value) == JSON_TEXT && strcmp(tree_text(value), text) == 0;
}

static bool list_has(const JsonValue *list, const char *text)
{
    for (const JsonValue *v = list ? tree_first(list) : NULL; v; v = tree_next(v))
        if (text_is(v, text)) return true;
    return false;
}

// ------------------------------------------------------- the part of draft-07 that the schema uses

static const char *type_name(const JsonValue *value)
{
    switch (tree_type(value)) {
    case JSON_NULL:
        return "null";
    case JSON_BOOL:
        return "boolean";
    case JSON_NUMBER:
        return tree_number(value) == floor(tree_number(value)) ? "integer" : "number";
    case JSON_TEXT:
        return "string";
    case JSON_LIST:
        return "array";
    case JSON_OBJECT:
        return "object";
    }
    return "";
}

static bool type_fits(const JsonValue *value, const JsonValue *type)
{
    const char *name = type_name(value);
    return text_is(type, name) || (text_is(type, "number") && strcmp(name, "integer") == 0);
}

static bool valid(const JsonValue *value, const JsonValue *node);

static bool valid_object(const JsonValue *value, const JsonValue *node)
{
    const JsonValue *properties = tree_member(node, "properties");
    const JsonValue *required = tree_member(node, "required");
    for (const JsonValue *r = required ? tree_first(required) : NULL; r; r = tree_next(r))
        if (!tree_member(value, tree_text(r))) return false;
    for (const JsonValue *v = tree_first(value); v; v = tree_next(v)) {
        const JsonValue *property = properties ? tree_member(properties, tree_key(v)) : NULL;
        if (!property || !valid(v, property)) return false; // additionalProperties is always false
    }
    return true;
}

static bool valid_list(const JsonValue *value, const JsonValue *node)
{
    int count = tree_count(value);
    if (count < number_of(node, "minItems") || count > number_of(node, "maxItems")) return false;
    for (const JsonValue *v = tree_first(value); v; v = tree_next(v))
        if (!valid(v, tree_member(node, "items"))) return false;
    return true;
}

static bool valid_number(double value, const JsonValue *node)
{
    // comparisons with the NAN of an absent bound are false, as they should be
    return !(value < number_of(node, "minimum") || value <= number_of(node, "exclusiveMinimum") ||
             value > number_of(node, "maximum"));
}

static bool valid(const JsonValue *value, const JsonValue *node)
{
    node = resolve(node);
    if (!node) return false;
    const JsonValue *type = tree_member(node, "type"), *any = tree_member(node, "anyOf");
    const JsonValue *choices = tree_member(node, "enum");
    for (const JsonValue *option = any ? tree_first(any) : NULL; option; option = tree_next(option))
        if (valid(value, option)) return true;
    if (any || (type && !type_fits(value, type))) return false;
    if (choices && !(tree_type(value) == JSON_TEXT && list_has(choices, tree_text(value))))
        return false;
    switch (tree_type(value)) {
    case JSON_OBJECT:
        return valid_object(value, node);
    case JSON_LIST:
        return valid_list(value, node);
    case JSON_NUMBER:
        return valid_number(tree_number(value), node);
    default:
        return true;
    }
}

// ------------------------------------------------------------------------------- tables and schema

static void compare_table(const JsonTable *table, const JsonValue *node, const void *defaults,
                          const char *where);

/// `node` itself or that of its alternatives which has the type.
static const JsonValue *of_type(const JsonValue *node, const char *type)
{
    node = resolve(node);
    const JsonValue *any = node ? tree_member(node, "anyOf") : NULL;
    for (const JsonValue *option = any ? tree_first(any) : NULL; option; option = tree_next(option))
        if (text_is(tree_member(resolve(option), "type"), type)) return resolve(option);
    return node && text_is(tree_member(node, "type"), type) ? node : NULL;
}

static void compare_range(const JsonField *field, const JsonValue *node, const char *where)
{
    double min = number_of(node, field->above_min ? "exclusiveMinimum" : "minimum");
    if (min != field->min || number_of(node, "maximum") != field->max)
        say(where, "the accepted range differs");
}

static void compare_list(const JsonField *field, const JsonValue *node, int min, int max,
                         const char *where)
{
    if (number_of(node, "maxItems") != max || (min && number_of(node, "minItems") != min))
        say(where, "the accepted number of items differs");
    if (field->kind != FIELD_LIST) compare_range(field, resolve(tree_member(node, "items")), where);
}

/// A default that the program has must stand in the schema, and the other way round.
static void compare_default(const JsonField *field, const JsonValue *node, const void *defaults,
                            const char *where)
{
    double value = NAN, told = number_of(node, "default");
    if (field->required) return;
    if (field->kind == FIELD_NUMBER)
        memcpy(&value, (const char *)defaults + field->offset, sizeof value);
    else {
        int whole;
        memcpy(&whole, (const char *)defaults + field->offset, sizeof whole);
        value = whole;
        if (field->kind == FIELD_CHOICE) {
            if (!text_is(tree_member(node, "default"), field->choices[whole]))
                say(where, "the default differs");
            return;
        }
    }
    value /= field->to_si != 0 ? field->to_si : 1;
    if (isnan(value) != isnan(told) || fabs(value - told) > 1e-9 * (1 + fabs(told)))
        say(where, "the default differs");
}

static void compare_choices(const JsonField *field, const JsonValue *node, const char *where)
{
    const JsonValue *choices = tree_member(node, "enum");
    int count = 0;
    for (; field->choices[count]; count++)
        if (!list_has(choices, field->choices[count])) say(where, "a choice is missing");
    if (!choices || tree_count(choices) != count) say(where, "there is a choice too many");
}

static void compare_custom(const JsonField *field, const JsonValue *node, const void *defaults,
                           const char *where)
{
    if (field->table) compare_table(field->table, of_type(node, "object"), defaults, where);
    if (strcmp(field->key, "points_m") == 0) {
        compare_list(field, of_type(tree_member(node, "items"), "array"), 2, 2, where);
        CHECK(number_of(node, "maxItems") == SCENE_POLYGON_MAX);
    }
}

/// The schema's word for a kind of field; NULL where it has several.
static const char *schema_type(FieldKind kind)
{
    switch (kind) {
    case FIELD_NUMBER:
        return "number";
    case FIELD_INTEGER:
        return "integer";
    case FIELD_TEXT:
    case FIELD_NAME:
        return "string";
    case FIELD_OBJECT:
        return "object";
    case FIELD_CHOICE:
    case FIELD_CUSTOM:
        return NULL;
    default:
        return "array";
    }
}

static void compare_field(const JsonField *field, const JsonValue *node, const void *defaults,
                          const char *where)
{
    char item[sizeof(BodyScene)] = {0};
    const char *inside = (const char *)defaults + field->offset;
    const char *type = schema_type(field->kind);
    if (type && !text_is(tree_member(node, "type"), type)) say(where, "the type differs");
    switch (field->kind) {
    case FIELD_NUMBER:
    case FIELD_INTEGER:
        compare_range(field, node, where);
        compare_default(field, node, defaults, where);
        break;
    case FIELD_NUMBERS:
        compare_list(field, node, field->count_min, field->count_max, where);
        break;
    case FIELD_RANGE:
        compare_list(field, node, 2, 2, where);
        break;
    case FIELD_POINT:
        compare_list(field, node, 2, 3, where);
        break;
    case FIELD_POSITION:
        compare_list(field, node, 1, 3, where);
        break;
    case FIELD_TEXT:
    case FIELD_NAME:
        if (number_of(node, "maxLength") != field->count_max - 1) say(where, "the length differs");
        break;
    case FIELD_CHOICE:
        compare_choices(field, node, where);
        compare_default(field, node, defaults, where);
        break;
    case FIELD_OBJECT:
        compare_table(field->table, node, inside, where);
        break;
    case FIELD_LIST:
        CHECK(field->item_size <= sizeof item);
        if (field->item_default) field->item_default(item);
        compare_list(field, node, 0, field->count_max, where);
        compare_table(field->table, resolve(tree_member(node, "items")), item, where);
        break;
    case FIELD_CUSTOM:
        compare_custom(field, node, inside, where);
        break;
    }
}

static void compare_table(const JsonTable *table, const JsonValue *node, const void *defaults,
                          const char *where)
{
    char at[JSON_PATH_SIZE], additional[8] = "";
    const JsonValue *properties = node ? tree_member(node, "properties") : NULL;
    if (!properties) {
        say(where, "the schema has no such object");
        return;
    }
    if (tree_member(node, "additionalProperties"))
        tree_excerpt(tree_member(node, "additionalProperties"), additional, sizeof additional);
    if (strcmp(additional, "false") != 0) say(where, "additionalProperties must be false");
    if (!tree_member(properties, "notes")) say(where, "notes must be allowed");
    for (int i = 0; i < table->field_count; i++) {
        const JsonField *field = &table->fields[i];
        snprintf(at, sizeof at, "%.100s.%.50s", where, field->key);
        const JsonValue *property = resolve(tree_member(properties, field->key));
        if (!property) {
            say(at, "the schema lacks this key");
            continue;
        }
        if (!tree_member(property, "description")) say(at, "has no description");
        if (list_has(tree_member(node, "required"), field->key) != field->required)
            say(at, "required by one, not by the other");
        compare_field(field, property, defaults, at);
    }
    // every field was found, so a longer list has a key that the program refuses
    if (tree_count(properties) != table->field_count + 1)
        say(where, "the schema has a key too many");
}

static void load_schema(void)
{
    Error error = {0};
    if (!schema && !tree_read_file(SOURCE_DIR "/cases/schema.json", &schema, &error))
        say("schema", error.message);
}

TEST(schema_and_reader_accept_the_same_keys_ranges_and_defaults)
{
    load_schema();
    CaseFile defaults = case_file_default();
    compare_table(&CASE_TABLE, schema, &defaults, "");
}

TEST(every_shipped_case_is_valid_by_the_schema_and_loads)
{
    load_schema();
    DIR *folder = opendir(SOURCE_DIR "/cases");
    CHECK(folder != NULL);
    int count = 0;
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".json") != 0 || strcmp(entry->d_name, "schema.json") == 0)
            continue;
        char path[600];
        snprintf(path, sizeof path, "%s/cases/%s", SOURCE_DIR, entry->d_name);
        JsonValue *root = NULL;
        Scene scene;
        Error error = {0};
        if (!tree_read_file(path, &root, &error) || !scene_load(path, NULL, 0, &scene, &error))
            say(entry->d_name, error.message);
        else if (!valid(root, schema))
            say(entry->d_name, "is not valid by the schema");
        else if (!tree_member(root, "$schema"))
            say(entry->d_name, "does not name its schema");
        tree_destroy(root);
        count++;
    }
    if (folder) closedir(folder);
    CHECK(count >= 6);
}

/// `key` in back quotes or in double quotes.
static bool page_names(const char *page, const char *key)
{
    char quoted[80], text[80];
    snprintf(quoted, sizeof quoted, "`%s`", key);
    snprintf(text, sizeof text, "\"%s\"", key);
    return strstr(page, quoted) || strstr(page, text);
}

static void look_for_keys(const JsonTable *table, const char *page)
{
    for (int i = 0; i < table->field_count; i++) {
        const JsonField *field = &table->fields[i];
        if (!page_names(page, field->key)) say(field->key, "docs/case_file.md lacks it");
        if (field->table) look_for_keys(field->table, page);
    }
}

TEST(every_key_stands_in_the_documentation)
{
    static char page[1 << 16];
    FILE *file = fopen(SOURCE_DIR "/docs/case_file.md", "r");
    CHECK(file != NULL);
    if (file) {
        page[fread(page, 1, sizeof page - 1, file)] = 0;
        fclose(file);
    }
    look_for_keys(&CASE_TABLE, page);
}

/// A change of a good case that the schema must refuse as the program does.
static void check_refused(const char *assignment)
{
    const char *path = SOURCE_DIR "/tests/good_cases/steered.json";
    JsonValue *root = NULL;
    Error error = {0};
    Scene scene;
    load_schema();
    CHECK(tree_read_file(path, &root, &error));
    CHECK(valid(root, schema));
    CHECK(case_override(root, assignment, &error));
    if (valid(root, schema)) say(assignment, "the schema accepts it");
    if (scene_load(path, &assignment, 1, &scene, &error)) say(assignment, "the program accepts it");
    tree_destroy(root);
}

TEST(schema_refuses_what_the_reader_refuses)
{
    check_refused("fluid.spacing_m=0");
    check_refused("fluid.spacing_m=\"x\"");
    check_refused("fluid.spaceing_m=0.1");
    check_refused("waves.heading_deg=400");
    check_refused("waves.start=cold");
    check_refused("bodies.ship.freedoms={\"heave\":{\"spring\":{\"stiffness\":1}}}");
    check_refused("bodies.ship.freedoms=loose");
    check_refused("lines[0].segments=2.5");
    check_refused("lines[0].segments=0");
    check_refused("bodies.ship.position_m=[0,0,0,0]");
    check_refused("bodies.ship.notes=3");
}
