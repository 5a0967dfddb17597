/// Growing text and a writer of JSON onto it. Reading JSON is protocol.c's business (cJSON).
#ifndef FAIRLEAD_JSON_H
#define FAIRLEAD_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/portable.h"

/// Growing text, always terminated. When memory runs out it stops growing and says so.
typedef struct Text {
    char *data; ///< owned; NULL while empty
    size_t length, capacity;
    bool failed; ///< memory ran out: what it holds is cut
} Text;

void text_append(Text *text, const char *bytes, size_t length);
void text_print(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_clear(Text *text);
void text_destroy(Text *text);
/// The characters so far, "" while empty; borrowed until the next call.
const char *text_string(const Text *text);

/// Writes one JSON value onto a Text, placing the commas. Keys are NULL inside arrays.
typedef struct Json {
    Text *text;
    bool comma; ///< a value precedes at this level
} Json;

Json json_begin(Text *text);
void json_object(Json *json, const char *key);
void json_object_end(Json *json);
void json_array(Json *json, const char *key);
void json_array_end(Json *json);
void json_string(Json *json, const char *key, const char *value);
/// Nine significant digits; numbers that are not finite become null.
void json_number(Json *json, const char *key, double value);
/// An array of x, y, z.
void json_vector(Json *json, const char *key, Vec3 value);
void json_integer(Json *json, const char *key, int64_t value);
void json_bool(Json *json, const char *key, bool value);
void json_null(Json *json, const char *key);

#endif
