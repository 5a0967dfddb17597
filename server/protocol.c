#include "protocol.h"

#include <cjson/cJSON.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef enum ValueKind {
    VALUE_COUNT,  ///< whole number into uint32_t
    VALUE_INT,    ///< whole number into int
    VALUE_NUMBER, ///< into double, times `scale`
    VALUE_WORD,   ///< one of `words` into int
    VALUE_NAME,   ///< text into char[SCENE_NAME_SIZE]
    VALUE_BOOL,   ///< into int
    VALUE_POINT,  ///< [x, y, z] into Vec3
} ValueKind;

/// One key a message may have.
typedef struct ValueRule {
    const char *key;
    ValueKind kind;
    size_t offset; ///< in ClientMessage
    double minimum, maximum;
    double scale;      ///< from the wire's unit to SI
    const char *words; ///< "start|pause|reset", in the order of the enumeration
    bool required;
} ValueRule;

enum { RULES_MAX = 6 };

typedef struct MessageRule {
    const char *type;
    ClientMessageKind kind;
    bool any_of; ///< at least one of the keys that are not required
    ValueRule values[RULES_MAX];
} MessageRule;

#define AT(member) offsetof(ClientMessage, member)
#define ID                                                                                         \
    {                                                                                              \
        "id", VALUE_COUNT, AT(id), 0, 4294967295.0, 1, NULL, true                                  \
    }
#define DEGREE (PI / 180.0)

static const MessageRule message_rules[] = {
    {"hello",
     MESSAGE_HELLO,
     false,
     {{"protocol", VALUE_COUNT, AT(protocol), 0, 1e6, 1, NULL, true}}},
    {"ack",
     MESSAGE_ACK,
     false,
     {{"frame", VALUE_COUNT, AT(frame), 0, 4294967295.0, 1, NULL, true}}},
    {"view",
     MESSAGE_VIEW,
     true,
     {{"width", VALUE_INT, AT(width), 160, 2560, 1, NULL, false},
      {"height", VALUE_INT, AT(height), 120, 1600, 1, NULL, false},
      {"water", VALUE_WORD, AT(water), 0, 0, 1, "surface|particles", false},
      {"field", VALUE_WORD, AT(field), 0, 0, 1, "none|elevation|speed|pressure", false},
      {"dark", VALUE_BOOL, AT(dark), 0, 0, 1, NULL, false}}},
    {"camera",
     MESSAGE_CAMERA,
     true,
     {{"azimuth_deg", VALUE_NUMBER, AT(azimuth), -3600, 3600, DEGREE, NULL, false},
      {"elevation_deg", VALUE_NUMBER, AT(elevation), -89, 89, DEGREE, NULL, false},
      {"distance_m", VALUE_NUMBER, AT(distance), 1e-3, 1e6, 1, NULL, false},
      {"target_m", VALUE_POINT, AT(target), -1e6, 1e6, 1, NULL, false}}},
    // the case's own limits are checked by the engine; these only keep nonsense out
    {"wave",
     MESSAGE_WAVE,
     true,
     {ID,
      {"height_m", VALUE_NUMBER, AT(command.wave_height), 0, 1e3, 1, NULL, false},
      {"period_s", VALUE_NUMBER, AT(command.wave_period), 0, 1e4, 1, NULL, false},
      {"heading_deg", VALUE_NUMBER, AT(command.wave_heading), -3600, 3600, DEGREE, NULL, false}}},
    {"line",
     MESSAGE_LINE,
     true,
     {ID,
      {"name", VALUE_NAME, AT(command.line), 0, 0, 1, NULL, true},
      {"length_m", VALUE_NUMBER, AT(command.line_length), 0, 1e6, 1, NULL, false},
      {"cut", VALUE_WORD, AT(command.line_cut), 0, 0, 1, "anchor|middle|fairlead", false}}},
    {"run",
     MESSAGE_RUN,
     false,
     {ID, {"action", VALUE_WORD, AT(action), 0, 0, 1, "start|pause|reset", true}}},
    {"snapshot",
     MESSAGE_SNAPSHOT,
     false,
     {ID,
      {"width", VALUE_INT, AT(width), 160, 4096, 1, NULL, true},
      {"height", VALUE_INT, AT(height), 120, 4096, 1, NULL, true}}},
};
enum { MESSAGE_RULE_COUNT = sizeof message_rules / sizeof *message_rules };

static ClientMessage message_default(void)
{
    return (ClientMessage){
        .water = -1,
        .field = -1,
        .dark = -1,
        .azimuth = NAN,
        .elevation = NAN,
        .distance = NAN,
        .target = {NAN, NAN, NAN},
        .command = command_default(),
    };
}

/// "type.key: what was found, what is accepted"
static bool refuse(Refusal *refusal, const char *type, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
static bool refuse(Refusal *refusal, const char *type, const char *key, const char *format, ...)
{
    snprintf(refusal->path, sizeof refusal->path, "%s%s%.40s", type, *key ? "." : "", key);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(refusal->message, sizeof refusal->message, format, arguments);
    va_end(arguments);
    return false;
}

/// Index of `word` in "a|b|c", -1 when absent.
static int word_index(const char *words, const char *word)
{
    size_t length = strlen(word);
    int index = 0;
    for (const char *c = words; c; index++) {
        if (length && !strncmp(c, word, length) && (c[length] == '|' || !c[length])) return index;
        c = strchr(c, '|');
        if (c) c++;
    }
    return -1;
}

static bool in_range(const cJSON *item, const ValueRule *rule)
{
    return cJSON_IsNumber(item) && item->valuedouble >= rule->minimum &&
           item->valuedouble <= rule->maximum;
}

static bool read_point(const cJSON *item, const ValueRule *rule, Vec3 *point)
{
    if (!cJSON_IsArray(item) || cJSON_GetArraySize(item) != 3) return false;
    const cJSON *x = item->child, *y = x->next, *z = y->next;
    if (!in_range(x, rule) || !in_range(y, rule) || !in_range(z, rule)) return false;
    *point = vec3(x->valuedouble, y->valuedouble, z->valuedouble);
    return true;
}

/// Check one value against its rule and put it in its place.
static bool read_value(const cJSON *item, const ValueRule *rule, const char *type,
                       ClientMessage *message, Refusal *refusal)
{
    char *place = (char *)message + rule->offset;
    bool whole = in_range(item, rule) && item->valuedouble == floor(item->valuedouble);
    switch (rule->kind) {
    case VALUE_COUNT:
        if (!whole) break;
        *(uint32_t *)place = (uint32_t)item->valuedouble;
        return true;
    case VALUE_INT:
        if (!whole) break;
        *(int *)place = (int)item->valuedouble;
        return true;
    case VALUE_NUMBER:
        if (!in_range(item, rule)) break;
        *(double *)place = item->valuedouble * rule->scale;
        return true;
    case VALUE_WORD: {
        int index = cJSON_IsString(item) ? word_index(rule->words, item->valuestring) : -1;
        if (index < 0)
            return refuse(refusal, type, rule->key, "accepted is one of %s", rule->words);
        *(int *)place = index;
        return true;
    }
    case VALUE_NAME:
        if (!cJSON_IsString(item) || !*item->valuestring ||
            strlen(item->valuestring) >= SCENE_NAME_SIZE)
            return refuse(refusal, type, rule->key, "accepted is a name of 1 to %d characters",
                          SCENE_NAME_SIZE - 1);
        snprintf(place, SCENE_NAME_SIZE, "%s", item->valuestring);
        return true;
    case VALUE_BOOL:
        if (!cJSON_IsBool(item))
            return refuse(refusal, type, rule->key, "accepted is true or false");
        *(int *)place = cJSON_IsTrue(item) ? 1 : 0;
        return true;
    case VALUE_POINT:
        if (read_point(item, rule, (Vec3 *)place)) return true;
        return refuse(refusal, type, rule->key, "accepted are three numbers from %g to %g",
                      rule->minimum, rule->maximum);
    }
    if (cJSON_IsNumber(item))
        return refuse(refusal, type, rule->key,
                      "%.9g is not accepted: a%s number from %.10g to %.10g", item->valuedouble,
                      rule->kind == VALUE_NUMBER ? "" : " whole", rule->minimum, rule->maximum);
    return refuse(refusal, type, rule->key, "accepted is a%s number from %.10g to %.10g",
                  rule->kind == VALUE_NUMBER ? "" : " whole", rule->minimum, rule->maximum);
}

static const ValueRule *find_rule(const MessageRule *message, const char *key)
{
    for (int i = 0; i < RULES_MAX && message->values[i].key; i++)
        if (!strcmp(message->values[i].key, key)) return &message->values[i];
    return NULL;
}

static bool read_keys(const cJSON *root, const MessageRule *rule, ClientMessage *message,
                      Refusal *refusal)
{
    bool seen[RULES_MAX] = {false}, some = false;
    for (const cJSON *item = root->child; item; item = item->next) {
        if (!strcmp(item->string, "type")) continue;
        const ValueRule *value = find_rule(rule, item->string);
        if (!value) return refuse(refusal, rule->type, item->string, "unknown key");
        if (seen[value - rule->values])
            return refuse(refusal, rule->type, value->key, "given twice");
        TRY(read_value(item, value, rule->type, message, refusal));
        seen[value - rule->values] = true;
        some = some || !value->required;
    }
    for (int i = 0; i < RULES_MAX && rule->values[i].key; i++)
        if (rule->values[i].required && !seen[i])
            return refuse(refusal, rule->type, rule->values[i].key, "missing");
    if (rule->any_of && !some) return refuse(refusal, rule->type, "", "no value is given");
    return true;
}

/// The id of a refused message, so that the sender can tell which one it was.
static void read_id(const cJSON *root, Refusal *refusal)
{
    const cJSON *id = cJSON_GetObjectItemCaseSensitive(root, "id");
    refusal->has_id = cJSON_IsNumber(id) && id->valuedouble >= 0 &&
                      id->valuedouble <= 4294967295.0 && id->valuedouble == floor(id->valuedouble);
    refusal->id = refusal->has_id ? (uint32_t)id->valuedouble : 0;
}

static bool parse_root(const cJSON *root, ClientMessage *message, Refusal *refusal)
{
    if (!cJSON_IsObject(root)) return refuse(refusal, "", "", "not a JSON object");
    read_id(root, refusal);
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(root, "type");
    if (!cJSON_IsString(type)) return refuse(refusal, "type", "", "missing, or not a text");
    for (int i = 0; i < MESSAGE_RULE_COUNT; i++) {
        if (strcmp(type->valuestring, message_rules[i].type) != 0) continue;
        message->kind = message_rules[i].kind;
        return read_keys(root, &message_rules[i], message, refusal);
    }
    return refuse(refusal, "type", "", "'%.40s' is not a known message", type->valuestring);
}

bool protocol_parse(const char *text, size_t length, ClientMessage *message, Refusal *refusal)
{
    *message = message_default();
    *refusal = (Refusal){0};
    const char *end = NULL;
    // cJSON takes a NUL for white space
    if (memchr(text, 0, length)) return refuse(refusal, "", "", "not JSON");
    cJSON *root = cJSON_ParseWithLengthOpts(text, length, &end, false);
    if (!root) return refuse(refusal, "", "", "not JSON");
    while (end < text + length && strchr(" \t\r\n", *end))
        end++;
    bool good = end >= text + length || !*end ? parse_root(root, message, refusal)
                                              : refuse(refusal, "", "", "more than one JSON value");
    cJSON_Delete(root);
    return good;
}

void protocol_apply_view(const ClientMessage *message, ViewOptions *view)
{
    if (message->kind == MESSAGE_VIEW) {
        if (message->width) view->width = message->width;
        if (message->height) view->height = message->height;
        if (message->water >= 0) view->water = (WaterMode)message->water;
        if (message->field >= 0) view->field = (ColourField)message->field;
        if (message->dark >= 0) view->dark = message->dark != 0;
    } else if (message->kind == MESSAGE_CAMERA) {
        if (isfinite(message->azimuth)) view->camera.azimuth = message->azimuth;
        if (isfinite(message->elevation)) view->camera.elevation = message->elevation;
        if (isfinite(message->distance)) view->camera.distance = message->distance;
        if (isfinite(message->target.x)) view->camera.target = message->target;
    }
}

static double number_or_nan(const cJSON *object, const char *key, double scale)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, key);
    return cJSON_IsNumber(item) ? item->valuedouble * scale : NAN;
}

/// What a journal line says of a line: {"name": …, "length_m": …, "cut": …}.
static bool read_order(const cJSON *order, Command *command, Error *error)
{
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(order, "name");
    const cJSON *cut = cJSON_GetObjectItemCaseSensitive(order, "cut");
    if (!cJSON_IsString(name) || !*name->valuestring)
        return error_set(error, ERROR_INPUT, "line.name: missing, or not a text");
    snprintf(command->line, sizeof command->line, "%s", name->valuestring);
    command->line_length = number_or_nan(order, "length_m", 1);
    if (!cut) return true;
    command->line_cut =
        cJSON_IsString(cut) ? word_index("anchor|middle|fairlead", cut->valuestring) : CUT_NOWHERE;
    return command->line_cut != CUT_NOWHERE ||
           error_set(error, ERROR_INPUT, "line.cut: accepted is one of anchor|middle|fairlead");
}

bool protocol_parse_journal(const char *line, bool *is_command, JournalCommand *command,
                            Error *error)
{
    *is_command = false;
    cJSON *root = cJSON_Parse(line);
    if (!cJSON_IsObject(root)) {
        cJSON_Delete(root);
        return error_set(error, ERROR_INPUT, "not a JSON object");
    }
    const cJSON *wave = cJSON_GetObjectItemCaseSensitive(root, "wave");
    const cJSON *order = cJSON_GetObjectItemCaseSensitive(root, "line");
    const cJSON *event = cJSON_GetObjectItemCaseSensitive(root, "event");
    bool wanted = !cJSON_IsString(event) || !strcmp(event->valuestring, "command");
    bool good = true;
    *is_command = wanted && (cJSON_IsObject(wave) || cJSON_IsObject(order));
    if (*is_command) {
        command->time = number_or_nan(root, "time_s", 1);
        command->command = command_default();
        if (cJSON_IsObject(order)) good = read_order(order, &command->command, error);
        if (cJSON_IsObject(wave) && !cJSON_IsObject(order)) {
            command->command.wave_height = number_or_nan(wave, "height_m", 1);
            command->command.wave_period = number_or_nan(wave, "period_s", 1);
            command->command.wave_heading = number_or_nan(wave, "heading_deg", DEGREE);
        }
        if (good && (!isfinite(command->time) || command->time < 0))
            good = error_set(error, ERROR_INPUT, "time_s: missing, or not a number from 0");
    }
    cJSON_Delete(root);
    return good;
}
