#include "json.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool text_reserve(Text *text, size_t more)
{
    if (text->failed) return false;
    size_t needed = text->length + more + 1;
    if (needed <= text->capacity) return true;
    size_t capacity = text->capacity ? text->capacity : 256;
    while (capacity < needed)
        capacity *= 2;
    char *data = realloc(text->data, capacity);
    if (!data) {
        text->failed = true;
        return false;
    }
    text->data = data;
    text->capacity = capacity;
    return true;
}

void text_append(Text *text, const char *bytes, size_t length)
{
    if (!text_reserve(text, length)) return;
    memcpy(text->data + text->length, bytes, length);
    text->length += length;
    text->data[text->length] = 0;
}

void text_print(Text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length > 0 && text_reserve(text, (size_t)length)) {
        vsnprintf(text->data + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
}

void text_clear(Text *text)
{
    text->length = 0;
    text->failed = false;
    if (text->data) text->data[0] = 0;
}

void text_destroy(Text *text)
{
    free(text->data);
    *text = (Text){0};
}

const char *text_string(const Text *text) { return text->data ? text->data : ""; }

Json json_begin(Text *text) { return (Json){.text = text}; }

/// Length of the well-formed UTF-8 sequence at `c` (2 to 4 bytes), 0 when it is broken or cut.
static int utf8_sequence(const unsigned char *c)
{
    int length = c[0] >= 0xf0 && c[0] < 0xf5 ? 4 : c[0] >= 0xe0 ? 3 : c[0] >= 0xc2 ? 2 : 0;
    if (c[0] >= 0xf5) return 0;
    for (int i = 1; i < length; i++)
        if ((c[i] & 0xc0) != 0x80) return 0;
    bool overlong = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90);
    bool surrogate = (c[0] == 0xed && c[1] >= 0xa0) || (c[0] == 0xf4 && c[1] >= 0x90);
    return overlong || surrogate ? 0 : length;
}

/// Broken UTF-8 becomes U+FFFD: a browser closes the socket on a text message that is not UTF-8.
static void append_quoted(Text *text, const char *value)
{
    text_append(text, "\"", 1);
    for (const unsigned char *c = (const unsigned char *)value; *c; c++) {
        if (*c == '"' || *c == '\\') {
            text_print(text, "\\%c", *c);
        } else if (*c < 0x20 || *c == 0x7f) {
            text_print(text, "\\u%04x", *c);
        } else if (*c < 0x80) {
            text_append(text, (const char *)c, 1);
        } else {
            int length = utf8_sequence(c);
            if (length)
                text_append(text, (const char *)c, (size_t)length);
            else
                text_append(text, "\xef\xbf\xbd", 3);
            if (length) c += length - 1;
        }
    }
    text_append(text, "\"", 1);
}

static void begin_value(Json *json, const char *key)
{
    if (json->comma) text_append(json->text, ",", 1);
    if (key) {
        append_quoted(json->text, key);
        text_append(json->text, ":", 1);
    }
    json->comma = true;
}

static void open_level(Json *json, const char *key, const char *bracket)
{
    begin_value(json, key);
    text_append(json->text, bracket, 1);
    json->comma = false;
}

static void close_level(Json *json, const char *bracket)
{
    text_append(json->text, bracket, 1);
    json->comma = true;
}

void json_object(Json *json, const char *key) { open_level(json, key, "{"); }
void json_object_end(Json *json) { close_level(json, "}"); }
void json_array(Json *json, const char *key) { open_level(json, key, "["); }
void json_array_end(Json *json) { close_level(json, "]"); }

void json_string(Json *json, const char *key, const char *value)
{
    begin_value(json, key);
    append_quoted(json->text, value);
}

void json_number(Json *json, const char *key, double value)
{
    begin_value(json, key);
    if (isfinite(value))
        text_print(json->text, "%.9g", value);
    else
        text_append(json->text, "null", 4);
}

void json_vector(Json *json, const char *key, Vec3 value)
{
    json_array(json, key);
    json_number(json, NULL, value.x);
    json_number(json, NULL, value.y);
    json_number(json, NULL, value.z);
    json_array_end(json);
}

void json_integer(Json *json, const char *key, int64_t value)
{
    begin_value(json, key);
    text_print(json->text, "%lld", (long long)value);
}

void json_bool(Json *json, const char *key, bool value)
{
    begin_value(json, key);
    text_print(json->text, "%s", value ? "true" : "false");
}

void json_null(Json *json, const char *key)
{
    begin_value(json, key);
    text_append(json->text, "null", 4);
}
