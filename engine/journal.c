/// Lines of journal.jsonl: one JSON object each, always complete however short the room.
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"

/// A line being written. Nothing is written that would leave no room for `reserve` closing
/// characters, so that a line cut short is still JSON.
typedef struct Writer {
    char *text;
    int size, used;
    int reserve;
} Writer;

static Writer writer_create(char *text, int size, int reserve)
{
    Writer writer = {text, size, 0, reserve};
    if (size > 0) text[0] = '\0';
    return writer;
}

/// Append a whole piece or none of it.
__attribute__((format(printf, 2, 3))) static void put(Writer *writer, const char *format, ...)
{
    char piece[512];
    va_list list;
    va_start(list, format);
    int length = vsnprintf(piece, sizeof piece, format, list);
    va_end(list);
    if (length < 0 || length >= (int)sizeof piece) return;
    if (writer->used + length + writer->reserve >= writer->size) return;
    memcpy(writer->text + writer->used, piece, (size_t)length + 1);
    writer->used += length;
}

/// Bytes of the UTF-8 character that begins with `first`.
static int character_length(unsigned char first)
{
    return first < 0xC0 ? 1 : (first < 0xE0 ? 2 : (first < 0xF0 ? 3 : 4));
}

/// A text in quotes, escaped (RFC 8259, 7); cut at a whole character where the room ends.
static void put_text(Writer *writer, const char *text)
{
    put(writer, "\"");
    writer->reserve += 1;
    for (const char *c = text; *c;) {
        int before = writer->used, length = character_length((unsigned char)*c);
        if (length > (int)strlen(c)) break;
        if (*c == '"' || *c == '\\')
            put(writer, "\\%c", *c);
        else if ((unsigned char)*c < 0x20)
            put(writer, "\\u%04x", (unsigned)*c);
        else
            put(writer, "%.*s", length, c);
        if (writer->used == before) break;
        c += length;
    }
    writer->reserve -= 1;
    put(writer, "\"");
}

/// The fewest digits that are read back as the same number.
static void put_number(Writer *writer, double value)
{
    char text[40];
    for (int digits = 9; digits <= 17; digits += 2) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    put(writer, "%s", isfinite(value) ? text : "null");
}

static void put_sea(Writer *writer, const WaveTarget *sea)
{
    put(writer, "\"wave\":{\"height_m\":");
    put_number(writer, sea->height);
    put(writer, ",\"period_s\":");
    put_number(writer, sea->period);
    put(writer, ",\"heading_deg\":");
    // A reader's * (PI / 180) gives back the radians that came from degrees, bit by bit (tested).
    put_number(writer, sea->heading / (PI / 180));
    put(writer, "}");
}

static void put_effects(Writer *writer, const Plan *plan)
{
    bool first = true;
    put(writer, ",\"effects\":[");
    for (int i = 0; i < EFFECT_COUNT; i++) {
        if (!plan->effects[i].active) continue;
        put(writer, first ? "\"%s\"" : ",\"%s\"", plan->effects[i].name);
        first = false;
    }
    put(writer, "]");
}

void journal_format_start(const Scene *scene, const Plan *plan, char *text, int size)
{
    Writer writer = writer_create(text, size, 0);
    put(&writer, "{\"time_s\":0,\"event\":\"start\",\"case\":");
    put_text(&writer, scene->name);
    put(&writer, ",\"title\":");
    put_text(&writer, scene->title);
    put(&writer, ",\"hash\":\"%016llx\"", (unsigned long long)scene->hash);
    put(&writer, ",\"backend\":");
    put_text(&writer, plan->backend ? plan->backend : "");
    put(&writer, ",\"variant\":");
    put_text(&writer, plan->variant);
    put(&writer, ",\"threads\":%d,\"particles\":%d,\"spacing_m\":", plan->options.threads,
        plan->fluid_count + plan->wall_count + plan->body_particle_count);
    put_number(&writer, scene->fluid.spacing);
    put(&writer, ",\"time_step_s\":");
    put_number(&writer, plan->time_step);
    put(&writer, ",\"sound_speed_m_s\":");
    put_number(&writer, plan->sound_speed);
    put_effects(&writer, plan);
    if (scene->waves.kind != WAVES_NONE) {
        put(&writer, ",");
        put_sea(&writer, &scene->waves.initial);
    }
    put(&writer, "}");
}

static void put_order(Writer *writer, const Command *command)
{
    static const char *const places[] = {"anchor", "middle", "fairlead"};
    put(writer, "\"line\":{\"name\":");
    put_text(writer, command->line);
    if (!isnan(command->line_length)) {
        put(writer, ",\"length_m\":");
        put_number(writer, command->line_length);
    }
    if (command->line_cut != CUT_NOWHERE) put(writer, ",\"cut\":\"%s\"", places[command->line_cut]);
    put(writer, "}");
}

void journal_format_command(double time, const Command *command, const WaveTarget *asked,
                            char *text, int size)
{
    Writer writer = writer_create(text, size, 0);
    put(&writer, "{\"time_s\":%.17g,\"event\":\"command\",", time);
    if (command->line[0])
        put_order(&writer, command);
    else
        put_sea(&writer, asked);
    put(&writer, "}");
}

void journal_format_line(const Scene *scene, const LineEvent *event, char *text, int size)
{
    Writer writer = writer_create(text, size, 0);
    put(&writer, "{\"time_s\":%.17g,\"event\":\"%s\",\"line\":", event->time,
        event->kind == LINE_BROKE ? "break" : "snap");
    put_text(&writer, scene->lines[event->line].name);
    put(&writer, ",\"tension_n\":");
    put_number(&writer, event->tension);
    put(&writer, "}");
}

void line_event_describe(const Scene *scene, const LineEvent *event, char *text, int size)
{
    char name[SCENE_NAME_SIZE];
    snprintf(name, sizeof name, "%s", scene->lines[event->line].name);
    for (char *c = name; *c; c++)
        if (*c == '_') *c = ' ';
    snprintf(text, (size_t)size,
             event->kind == LINE_BROKE ? "%s breaks: %.4g N" : "%s snaps: %.4g N", name,
             event->tension);
}

void journal_format_health(double time, const char *message, char *text, int size)
{
    Writer writer = writer_create(text, size, 1);
    put(&writer, "{\"time_s\":%.17g,\"event\":\"health\",\"message\":", time);
    put_text(&writer, message);
    writer.reserve = 0;
    put(&writer, "}");
}
