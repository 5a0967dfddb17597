/// A case file as a tree of JSON values. The only place (with its .c) that knows the JSON library.
#ifndef FAIRLEAD_SCENE_TREE_H
#define FAIRLEAD_SCENE_TREE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

typedef struct cJSON JsonValue;

typedef enum JsonType {
    JSON_NULL,
    JSON_BOOL,
    JSON_NUMBER,
    JSON_TEXT,
    JSON_LIST,
    JSON_OBJECT,
} JsonType;

/// Read and parse a file: UTF-8, at most 1 MiB, one JSON object at its top.
/// @param root  owned by the caller: tree_destroy()
/// @return false with ERROR_INPUT naming file, line and column
bool tree_read_file(const char *path, JsonValue **root, Error *error);
/// Parse a text that is one JSON value as a whole. @return NULL if it is not; owned by the caller
JsonValue *tree_parse(const char *text);
/// @return a text value, or NULL without memory; owned by the caller
JsonValue *tree_create_text(const char *text);
JsonValue *tree_create_object(void);
void tree_destroy(JsonValue *value);

JsonType tree_type(const JsonValue *value);
double tree_number(const JsonValue *value);    ///< JSON_NUMBER only
const char *tree_text(const JsonValue *value); ///< JSON_TEXT only; borrowed
int tree_count(const JsonValue *value);        ///< of items or members
/// Children in their order: for (v = tree_first(list); v; v = tree_next(v)).
const JsonValue *tree_first(const JsonValue *value);
const JsonValue *tree_next(const JsonValue *value);
const char *tree_key(const JsonValue *value); ///< of a member; borrowed
/// @return NULL when there is none
const JsonValue *tree_member(const JsonValue *object, const char *key);
const JsonValue *tree_item(const JsonValue *list, int index);

/// Put a member, replacing one of that name; takes ownership of `value`, also when it fails.
/// @return false without memory
bool tree_put_member(JsonValue *object, const char *key, JsonValue *value);
/// Replace an item that exists; takes ownership of `value`.
bool tree_put_item(JsonValue *list, int index, JsonValue *value);
void tree_remove_member(JsonValue *object, const char *key);

/// The value as compact JSON, shortened to `size` characters with "..." at the end.
void tree_excerpt(const JsonValue *value, char *text, int size);
/// FNV-1a (64 bit) of the compact printing. @return 0 without memory
/// Source: Fowler, Noll, Vo; draft-eastlake-fnv.
uint64_t tree_hash(const JsonValue *root);

#endif
