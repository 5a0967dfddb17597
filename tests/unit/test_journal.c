/// Lines of journal.jsonl: JSON, complete, and exact enough to replay.
#include <cjson/cJSON.h>
#include <stdlib.h>

#include "engine.h"
#include "test.h"

static Scene scene;
static Plan plan;
static const Command sea; // no line: a command about the sea

static void prepare(void)
{
    memset(&scene, 0, sizeof scene);
    memset(&plan, 0, sizeof plan);
    strcpy(scene.name, "moored_ship");
    strcpy(scene.title, "A \"ship\" with a \\ and\ta tab");
    scene.hash = 0x1234;
    scene.fluid.spacing = 0.075;
    plan.backend = "cpu";
    plan.options.threads = 2;
    plan.fluid_count = 100;
    plan.wall_count = 20;
    plan.body_particle_count = 3;
    plan.time_step = 4.1e-4;
    plan.sound_speed = 25;
    for (int i = 0; i < EFFECT_COUNT; i++)
        plan.effects[i].name = "effect";
    plan.effects[1].active = plan.effects[2].active = true;
}

static double number(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItem(object, key);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

static const char *text_of(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItem(object, key));
    return text ? text : "";
}

TEST(the_start_tells_case_engine_and_sea)
{
    char line[2048];
    prepare();
    journal_format_start(&scene, &plan, line, sizeof line);
    CHECK(strchr(line, '\n') == NULL);
    cJSON *json = cJSON_Parse(line);
    CHECK(json != NULL);
    CHECK(!strcmp(text_of(json, "event"), "start"));
    CHECK(number(json, "time_s") == 0);
    CHECK(!strcmp(text_of(json, "case"), "moored_ship"));
    CHECK(!strcmp(text_of(json, "title"), scene.title));
    CHECK(!strcmp(text_of(json, "hash"), "0000000000001234"));
    CHECK(!strcmp(text_of(json, "backend"), "cpu"));
    CHECK(number(json, "particles") == 123);
    CHECK(number(json, "time_step_s") == 4.1e-4);
    CHECK(cJSON_GetArraySize(cJSON_GetObjectItem(json, "effects")) == 2);
    CHECK(cJSON_GetObjectItem(json, "wave") == NULL);
    cJSON_Delete(json);
    scene.waves.kind = WAVES_REGULAR;
    scene.waves.initial.height = 0.3;
    scene.waves.initial.period = 1.58;
    journal_format_start(&scene, &plan, line, sizeof line);
    json = cJSON_Parse(line);
    CHECK(number(cJSON_GetObjectItem(json, "wave"), "period_s") == 1.58);
    cJSON_Delete(json);
}

TEST(a_command_is_read_back_bit_by_bit)
{
    char line[512];
    double time = 0;
    for (int i = 0; i < 2000; i++) {
        time += 4.1e-4 / 3;
        double degrees = -180 + 0.37 * i;
        WaveTarget asked = {0.1 + 1e-4 * i / 7, 1.2 + 1e-3 * i / 3, degrees * (PI / 180)};
        journal_format_command(time, &sea, &asked, line, sizeof line);
        cJSON *json = cJSON_Parse(line), *wave = cJSON_GetObjectItem(json, "wave");
        CHECK(!strcmp(text_of(json, "event"), "command"));
        CHECK(number(json, "time_s") == time);
        CHECK(number(wave, "height_m") == asked.height);
        CHECK(number(wave, "period_s") == asked.period);
        CHECK(number(wave, "heading_deg") * (PI / 180) == asked.heading);
        cJSON_Delete(json);
    }
}

TEST(a_command_reads_as_a_person_wrote_it)
{
    char line[512];
    WaveTarget asked = {0.3, 1.58, 45 * (PI / 180)};
    journal_format_command(12.5, &sea, &asked, line, sizeof line);
    CHECK_CONTAINS(line, "{\"time_s\":12.5,\"event\":\"command\",\"wave\":{\"height_m\":0.3,"
                         "\"period_s\":1.58,\"heading_deg\":45}}");
}

TEST(health_is_json_whatever_its_message_and_however_little_room)
{
    const char *message = "line \"bow\": node 3 broke\n\tat \\ 1e9 N, 7° from δ — stop";
    char line[400];
    for (int size = 60; size <= (int)sizeof line; size++) {
        memset(line, 'x', sizeof line);
        journal_format_health(3.25, message, line, size);
        CHECK((int)strlen(line) < size);
        CHECK(strpbrk(line, "\n\t") == NULL); // one line
        cJSON *json = cJSON_Parse(line);
        CHECK(json != NULL);
        CHECK(number(json, "time_s") == 3.25);
        const char *back = text_of(json, "message");
        CHECK(!strncmp(back, message, strlen(back)));
        CHECK((message[strlen(back)] & 0xC0) != 0x80); // no half characters
        if (size == (int)sizeof line) CHECK(!strcmp(back, message));
        cJSON_Delete(json);
    }
}
