// The server's half of the wire: structs in, JSON text or picture headers out.
#include <stdio.h>
#include <string.h>

#include "effects.h"
#include "protocol.h"

static double degrees(double radians) { return radians * (180.0 / PI); }

static Json message_begin(Text *text, const char *type)
{
    Json json = json_begin(text);
    json_object(&json, NULL);
    json_string(&json, "type", type);
    return json;
}

static void write_range(Json *json, const char *key, Range range, double scale)
{
    json_array(json, key);
    json_number(json, NULL, range.min * scale);
    json_number(json, NULL, range.max * scale);
    json_array_end(json);
}

static void write_wave(Json *json, const char *key, const WaveTarget *wave)
{
    json_object(json, key);
    json_number(json, "height_m", wave->height);
    json_number(json, "period_s", wave->period);
    json_number(json, "heading_deg", degrees(wave->heading));
    json_object_end(json);
}

static void write_camera(Json *json, const Camera *camera)
{
    json_number(json, "azimuth_deg", degrees(camera->azimuth));
    json_number(json, "elevation_deg", degrees(camera->elevation));
    json_number(json, "distance_m", camera->distance);
    json_array(json, "target_m");
    json_number(json, NULL, camera->target.x);
    json_number(json, NULL, camera->target.y);
    json_number(json, NULL, camera->target.z);
    json_array_end(json);
}

static void write_view(Json *json, const ViewOptions *view)
{
    static const char *const water[] = {"surface", "particles"};
    static const char *const field[] = {"none", "elevation", "speed", "pressure"};
    json_integer(json, "width", view->width);
    json_integer(json, "height", view->height);
    json_string(json, "water", water[view->water]);
    json_string(json, "field", field[view->field]);
    json_bool(json, "dark", view->dark);
}

/// Warnings are joined by "; " in the plan; the page wants them one by one.
static void write_warnings(Json *json, const char *plan, const char *server)
{
    json_array(json, "warnings");
    for (const char *begin = plan; *begin;) {
        const char *end = strstr(begin, "; ");
        size_t length = end ? (size_t)(end - begin) : strlen(begin);
        char one[sizeof((Plan *)0)->warnings];
        memcpy(one, begin, length);
        one[length] = 0;
        json_string(json, NULL, one);
        begin += length + (end ? 2 : 0);
    }
    if (*server) json_string(json, NULL, server);
    json_array_end(json);
}

static void write_names(Json *json, const Scene *scene)
{
    json_array(json, "bodies");
    for (int i = 0; i < scene->body_count; i++)
        json_string(json, NULL, scene->bodies[i].name);
    json_array_end(json);
    json_array(json, "lines");
    for (int i = 0; i < scene->line_count; i++)
        json_string(json, NULL, scene->lines[i].name);
    json_array_end(json);
    json_array(json, "gauges");
    for (int i = 0; i < scene->gauge_count; i++)
        json_string(json, NULL, scene->gauges[i].name);
    json_array_end(json);
}

/// What may be done to each line's length, in the order of `lines`; null without a winch.
static void write_winches(Json *json, const Scene *scene)
{
    json_array(json, "winches");
    for (int i = 0; i < scene->line_count; i++) {
        const WinchScene *winch = &scene->lines[i].winch;
        if (!(winch->speed > 0)) {
            json_null(json, NULL);
            continue;
        }
        json_object(json, NULL);
        write_range(json, "length_m", winch->length, 1);
        json_number(json, "speed_ms", winch->speed);
        json_object_end(json);
    }
    json_array_end(json);
}

static void write_limits(Json *json, const Waves *waves)
{
    if (waves->kind == WAVES_NONE || waves->kind == WAVES_RECORD) { // nothing to change
        json_null(json, "limits");
        return;
    }
    json_object(json, "limits");
    write_range(json, "height_m", waves->height_limits, 1);
    write_range(json, "period_s", waves->period_limits, 1);
    write_range(json, "heading_deg", waves->heading_limits, 180.0 / PI);
    json_object_end(json);
}

static void write_current(Json *json, const Current *current)
{
    if (!(current->speed > 0)) {
        json_null(json, "current");
        return;
    }
    json_object(json, "current");
    json_number(json, "speed_ms", current->speed);
    json_number(json, "heading_deg", current->heading * 180.0 / PI);
    json_object_end(json);
}

void protocol_format_hello(Text *text, const HelloInfo *info)
{
    const Scene *scene = info->scene;
    const Plan *plan = info->plan;
    char hash[20];
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)scene->hash);
    Json json = message_begin(text, "hello");
    json_integer(&json, "protocol", PROTOCOL_VERSION);
    json_string(&json, "version", info->version);
    json_object(&json, "case");
    json_string(&json, "name", scene->name);
    json_string(&json, "title", scene->title);
    json_string(&json, "hash", hash);
    json_object_end(&json);
    json_string(&json, "backend", plan->backend);
    json_integer(&json, "threads", plan->options.threads);
    json_string(&json, "renderer", info->renderer);
    json_integer(&json, "particles",
                 (int64_t)plan->fluid_count + plan->wall_count + plan->body_particle_count);
    json_number(&json, "spacing_m", scene->fluid.spacing);
    json_array(&json, "columns");
    for (int i = 0; i < info->columns->count; i++)
        json_string(&json, NULL, info->columns->names[i]);
    json_array_end(&json);
    write_names(&json, scene);
    write_winches(&json, scene);
    write_limits(&json, &scene->waves);
    write_current(&json, &scene->waves.current);
    json_object(&json, "camera");
    write_camera(&json, &info->view->camera);
    json_object_end(&json);
    json_object(&json, "view");
    write_view(&json, info->view);
    json_object_end(&json);
    write_warnings(&json, plan->warnings, info->warning);
    effects_write(&json, plan);
    json_object_end(&json);
}

static void write_health(Json *json, const SessionStatus *status)
{
    static const char *const words[] = {"good", "recovered", "failed"};
    json_object(json, "health");
    json_string(json, "status", words[status->health]);
    json_string(json, "message", status->health_message);
    json_object_end(json);
}

void protocol_format_status(Text *text, const SessionStatus *status, double frames_per_second,
                            int clients)
{
    static const char *const states[] = {"running", "paused", "failed"};
    Json json = message_begin(text, "status");
    json_number(&json, "time_s", status->time);
    json_string(&json, "state", states[status->state]);
    json_number(&json, "speed", status->speed);
    json_integer(&json, "step", status->step);
    json_number(&json, "time_step_s", status->time_step);
    json_number(&json, "particle_steps_per_s", status->particle_steps_per_second);
    json_number(&json, "density_error", status->density_error);
    json_number(&json, "frames_per_s", frames_per_second);
    json_integer(&json, "clients", clients);
    write_health(&json, status);
    if (status->has_waves) {
        json_object(&json, "wave");
        write_wave(&json, "asked", &status->wave_asked);
        write_wave(&json, "now", &status->wave_now);
        json_bool(&json, "changing", status->wave_changing);
        json_object_end(&json);
    } else {
        json_null(&json, "wave");
    }
    json_array(&json, "lines");
    for (int i = 0; i < status->line_count; i++) {
        json_object(&json, NULL);
        json_number(&json, "length_m", status->lines[i].length);
        json_number(&json, "asked_m", status->lines[i].asked);
        json_number(&json, "largest_n", status->lines[i].largest);
        json_bool(&json, "parted", status->lines[i].parted);
        json_object_end(&json);
    }
    json_array_end(&json);
    json_object(&json, "shares");
    for (int i = 0; i < status->share_count; i++)
        json_number(&json, status->shares[i].name, status->shares[i].share);
    json_object_end(&json);
    json_object_end(&json);
}

void protocol_format_series(Text *text, const double *rows, int row_count, int column_count)
{
    Json json = message_begin(text, "series");
    json_array(&json, "rows");
    for (int i = 0; i < row_count; i++) {
        json_array(&json, NULL);
        for (int j = 0; j < column_count; j++)
            json_number(&json, NULL, rows[(size_t)i * column_count + j]);
        json_array_end(&json);
    }
    json_array_end(&json);
    json_object_end(&json);
}

void protocol_format_marker(Text *text, double time, const char *words)
{
    Json json = message_begin(text, "marker");
    json_number(&json, "time_s", time);
    json_string(&json, "text", words);
    json_object_end(&json);
}

void protocol_format_accepted(Text *text, uint32_t id, double time)
{
    Json json = message_begin(text, "accepted");
    json_integer(&json, "id", id);
    json_number(&json, "time_s", time);
    json_object_end(&json);
}

void protocol_format_error(Text *text, const Refusal *refusal)
{
    Json json = message_begin(text, "error");
    if (refusal->has_id)
        json_integer(&json, "id", refusal->id);
    else
        json_null(&json, "id");
    json_string(&json, "path", refusal->path);
    json_string(&json, "message", refusal->message);
    json_object_end(&json);
}

void protocol_format_reset(Text *text)
{
    Json json = message_begin(text, "reset");
    json_object_end(&json);
}

void protocol_format_view(Text *text, const ViewOptions *view)
{
    Json json = message_begin(text, "view");
    write_view(&json, view);
    json_object_end(&json);
}

void protocol_format_camera(Text *text, const Camera *camera)
{
    Json json = message_begin(text, "camera");
    write_camera(&json, camera);
    json_object_end(&json);
}

/// Least significant byte first, whatever the machine does.
static void put_little_endian(unsigned char *bytes, uint64_t value, int size)
{
    for (int i = 0; i < size; i++)
        bytes[i] = (unsigned char)(value >> (8 * i));
}

void protocol_format_picture_header(const PictureHeader *header,
                                    unsigned char bytes[PICTURE_HEADER_SIZE])
{
    uint64_t time;
    memcpy(&time, &header->time, sizeof time);
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)"FLF1"[i];
    put_little_endian(bytes + 4, header->kind, 4);
    put_little_endian(bytes + 8, header->number, 4);
    put_little_endian(bytes + 12, (uint64_t)header->width, 2);
    put_little_endian(bytes + 14, (uint64_t)header->height, 2);
    put_little_endian(bytes + 16, time, 8);
    put_little_endian(bytes + 24, (uint64_t)header->size, 4);
    put_little_endian(bytes + 28, 0, 4);
}
