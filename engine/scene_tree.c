#include "scene_tree.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_SIZE_MAX = 1 << 20 }; ///< a case of 32 bodies with full polygons has about 200 kB

/// Length of the UTF-8 character at `text`, 0 if it is none (RFC 3629).
static int utf8_length(const unsigned char *text, size_t left)
{
    int length = text[0] < 0x80   ? 1
                 : text[0] < 0xC2 ? 0
                 : text[0] < 0xE0 ? 2
                 : text[0] < 0xF0 ? 3
                 : text[0] < 0xF5 ? 4
                                  : 0;
    if ((size_t)length > left) return 0;
    for (int i = 1; i < length; i++)
        if ((text[i] & 0xC0) != 0x80) return 0;
    if (text[0] == 0xE0 && text[1] < 0xA0) return 0; // overlong
    if (text[0] == 0xED && text[1] > 0x9F) return 0; // surrogate
    if (text[0] == 0xF0 && text[1] < 0x90) return 0; // overlong
    if (text[0] == 0xF4 && text[1] > 0x8F) return 0; // beyond U+10FFFF
    return length;
}

/// "file:line:column: " of a place in the text, then what is wrong there.
static bool refuse_place(Error *error, const char *path, const char *text, const char *place,
                         const char *what)
{
    int line = 1, column = 1;
    for (const char *c = text; c < place; c++) {
        column++;
        if (*c == '\n') line++, column = 1;
    }
    return error_set(error, ERROR_INPUT, "%s:%d:%d: %s", path, line, column, what);
}

/// The whole file, terminated. @param text  owned by the caller (free), also after a failure
static bool read_text(const char *path, char **text, size_t *size, Error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return error_set(error, ERROR_INPUT, "%s: cannot be opened: %s", path, strerror(errno));
    *text = malloc(FILE_SIZE_MAX + 2);
    *size = *text ? fread(*text, 1, FILE_SIZE_MAX + 1, file) : 0;
    int failure = ferror(file) ? errno : 0;
    fclose(file);
    if (!*text) return error_set(error, ERROR_SYSTEM, "%s: no memory to read it", path);
    if (failure)
        return error_set(error, ERROR_INPUT, "%s: cannot be read: %s", path, strerror(failure));
    if (*size > FILE_SIZE_MAX)
        return error_set(error, ERROR_INPUT, "%s: a case file must be <= 1 MiB", path);
    (*text)[*size] = 0;
    return true;
}

static bool parse_file(const char *path, const char *text, size_t size, JsonValue **root,
                       Error *error)
{
    if (!size) return error_set(error, ERROR_INPUT, "%s: is empty: must be a JSON object", path);
    for (size_t i = 0; i < size;) {
        int length = utf8_length((const unsigned char *)text + i, size - i);
        if (!length || !text[i])
            return refuse_place(error, path, text, text + i, "not text: must be JSON in UTF-8");
        i += (size_t)length;
    }
    const char *end = text;
    *root = cJSON_ParseWithLengthOpts(text, size + 1, &end, 1);
    if (!*root) return refuse_place(error, path, text, end, "not JSON: an error stands here");
    if (tree_type(*root) != JSON_OBJECT)
        return error_set(error, ERROR_INPUT, "%s: must be a JSON object: { ... }", path);
    return true;
}

bool tree_read_file(const char *path, JsonValue **root, Error *error)
{
    char *text = NULL;
    size_t size = 0;
    *root = NULL;
    bool good = read_text(path, &text, &size, error) && parse_file(path, text, size, root, error);
    free(text);
    if (!good) {
        cJSON_Delete(*root);
        *root = NULL;
    }
    return good;
}

JsonValue *tree_parse(const char *text)
{
    return cJSON_ParseWithLengthOpts(text, strlen(text) + 1, NULL, 1);
}

JsonValue *tree_create_text(const char *text) { return cJSON_CreateString(text); }
JsonValue *tree_create_object(void) { return cJSON_CreateObject(); }
void tree_destroy(JsonValue *value) { cJSON_Delete(value); }

JsonType tree_type(const JsonValue *value)
{
    if (cJSON_IsNumber(value)) return JSON_NUMBER;
    if (cJSON_IsString(value)) return JSON_TEXT;
    if (cJSON_IsArray(value)) return JSON_LIST;
    if (cJSON_IsObject(value)) return JSON_OBJECT;
    return cJSON_IsBool(value) ? JSON_BOOL : JSON_NULL;
}

double tree_number(const JsonValue *value) { return value->valuedouble; }
const char *tree_text(const JsonValue *value) { return value->valuestring; }
int tree_count(const JsonValue *value) { return cJSON_GetArraySize(value); }
const JsonValue *tree_first(const JsonValue *value) { return value->child; }
const JsonValue *tree_next(const JsonValue *value) { return value->next; }
const char *tree_key(const JsonValue *value) { return value->string ? value->string : ""; }

const JsonValue *tree_member(const JsonValue *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

const JsonValue *tree_item(const JsonValue *list, int index)
{
    return cJSON_GetArrayItem(list, index);
}

bool tree_put_member(JsonValue *object, const char *key, JsonValue *value)
{
    if (value &&
        (tree_member(object, key) ? cJSON_ReplaceItemInObjectCaseSensitive(object, key, value)
                                  : cJSON_AddItemToObject(object, key, value)))
        return true;
    cJSON_Delete(value);
    return false;
}

bool tree_put_item(JsonValue *list, int index, JsonValue *value)
{
    if (value && cJSON_ReplaceItemInArray(list, index, value)) return true;
    cJSON_Delete(value);
    return false;
}

void tree_remove_member(JsonValue *object, const char *key)
{
    cJSON_DeleteItemFromObjectCaseSensitive(object, key);
}

void tree_excerpt(const JsonValue *value, char *text, int size)
{
    char *print = cJSON_PrintUnformatted(value);
    int length = snprintf(text, (size_t)size, "%s", print ? print : "?");
    cJSON_free(print);
    if (length < size) return;
    int end = size - 4;
    while (end > 0 && ((unsigned char)text[end] & 0xC0) == 0x80) // not within a character
        end--;
    snprintf(text + end, (size_t)(size - end), "...");
}

uint64_t tree_hash(const JsonValue *root)
{
    char *print = cJSON_PrintUnformatted(root);
    if (!print) return 0;
    uint64_t hash = 0xcbf29ce484222325u;
    for (const char *c = print; *c; c++)
        hash = (hash ^ (unsigned char)*c) * 0x100000001b3u;
    cJSON_free(print);
    return hash;
}
