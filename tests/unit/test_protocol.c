// The wire as docs/protocol.md words it.
#include "protocol.h"
#include "test.h"

static ClientMessage message;
static Refusal refusal;

static bool parse(const char *text)
{
    return protocol_parse(text, strlen(text), &message, &refusal);
}

TEST(each_message_of_the_page_is_read)
{
    CHECK(parse("{\"type\":\"hello\",\"protocol\":1}") && message.kind == MESSAGE_HELLO);
    CHECK(message.protocol == 1);
    CHECK(parse("{\"type\":\"ack\",\"frame\":4294967295}") && message.frame == 4294967295u);
    CHECK(parse("{\"type\":\"view\",\"water\":\"particles\",\"dark\":true}"));
    CHECK(message.kind == MESSAGE_VIEW && message.water == WATER_PARTICLES && message.dark == 1);
    CHECK(message.width == 0 && message.field == -1);
    CHECK(parse("{\"type\":\"camera\",\"azimuth_deg\":90,\"target_m\":[1,2,-3]}"));
    CHECK_NEAR(message.azimuth, PI / 2, 1e-15);
    CHECK(message.target.z == -3 && isnan(message.distance));
    CHECK(parse("{\"type\":\"wave\",\"id\":7,\"heading_deg\":-180}"));
    CHECK(message.id == 7 && isnan(message.command.wave_height) &&
          isnan(message.command.wave_period));
    CHECK_NEAR(message.command.wave_heading, -PI, 1e-15);
    CHECK(parse("{\"type\":\"run\",\"id\":0,\"action\":\"reset\"}") &&
          message.action == ACTION_RESET);
    CHECK(parse("{\"type\":\"snapshot\",\"id\":3,\"width\":1920,\"height\":1080}"));
    CHECK(message.width == 1920 && message.height == 1080 && message.id == 3);
}

TEST(what_is_not_understood_is_refused_and_named)
{
    static const struct {
        const char *text, *path, *words;
    } bad[] = {
        {"", "", "not JSON"},
        {"{", "", "not JSON"},
        {"[1]", "", "not a JSON object"},
        {"{} {}", "", "more than one"},
        {"{\"frame\":1}", "type", "missing"},
        {"{\"type\":5}", "type", "not a text"},
        {"{\"type\":\"shout\"}", "type", "shout"},
        {"{\"type\":\"ack\"}", "ack.frame", "missing"},
        {"{\"type\":\"ack\",\"frame\":-1}", "ack.frame", "-1 is not accepted"},
        {"{\"type\":\"ack\",\"frame\":1.5}", "ack.frame", "whole"},
        {"{\"type\":\"ack\",\"frame\":\"1\"}", "ack.frame", "number"},
        {"{\"type\":\"ack\",\"frame\":1,\"frame\":2}", "ack.frame", "twice"},
        {"{\"type\":\"ack\",\"frame\":1,\"extra\":2}", "ack.extra", "unknown"},
        {"{\"type\":\"view\"}", "view", "no value"},
        {"{\"type\":\"view\",\"width\":9}", "view.width", "160 to 2560"},
        {"{\"type\":\"view\",\"water\":\"steam\"}", "view.water", "surface|particles"},
        {"{\"type\":\"view\",\"dark\":1}", "view.dark", "true or false"},
        {"{\"type\":\"camera\",\"distance_m\":0}", "camera.distance_m", "0 is not accepted"},
        {"{\"type\":\"camera\",\"elevation_deg\":91}", "camera.elevation_deg", "-89 to 89"},
        {"{\"type\":\"camera\",\"target_m\":[1,2]}", "camera.target_m", "three numbers"},
        {"{\"type\":\"camera\",\"target_m\":[1,2,null]}", "camera.target_m", "three numbers"},
        {"{\"type\":\"wave\",\"id\":1}", "wave", "no value"},
        {"{\"type\":\"wave\",\"height_m\":1}", "wave.id", "missing"},
        {"{\"type\":\"wave\",\"id\":1,\"height_m\":null}", "wave.height_m", "number"},
        {"{\"type\":\"wave\",\"id\":1,\"height_m\":1e999}", "wave.height_m", "not accepted"},
        {"{\"type\":\"run\",\"id\":1,\"action\":\"stop\"}", "run.action", "start|pause|reset"},
        {"{\"type\":\"run\",\"id\":1,\"action\":\"\"}", "run.action", "start|pause|reset"},
        {"{\"type\":\"snapshot\",\"id\":1,\"width\":99999,\"height\":9}", "snapshot.width", "4096"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        CHECK(!parse(bad[i].text));
        if (strcmp(refusal.path, bad[i].path))
            printf("  %s: path '%s'\n", bad[i].text, refusal.path);
        CHECK(!strcmp(refusal.path, bad[i].path));
        CHECK_CONTAINS(refusal.message, bad[i].words);
    }
}

TEST(a_refusal_carries_the_id_when_there_is_one)
{
    CHECK(!parse("{\"type\":\"wave\",\"id\":12,\"height\":1}") && refusal.has_id &&
          refusal.id == 12);
    CHECK(!parse("{\"type\":\"nonsense\",\"id\":13}") && refusal.has_id && refusal.id == 13);
    CHECK(!parse("{\"type\":\"wave\",\"id\":-1,\"height_m\":1}") && !refusal.has_id);
}

TEST(hostile_text_is_refused_without_harm)
{
    char deep[40000];
    memset(deep, '[', sizeof deep);
    CHECK(!protocol_parse(deep, sizeof deep, &message, &refusal));
    const char cut[] = "{\"type\":\"ack\",\"frame\":12345";
    for (size_t length = 0; length < sizeof cut; length++)
        CHECK(!protocol_parse(cut, length, &message, &refusal));
    const char zero[] = "{\"type\":\"ack\",\0\"frame\":1}";
    CHECK(!protocol_parse(zero, sizeof zero - 1, &message, &refusal));
    CHECK(!parse("{\"type\":\"\xff\xfe\",\"id\":1}"));
}

TEST(a_view_changes_only_what_it_names)
{
    ViewOptions view = {.width = 960, .height = 540, .water = WATER_SURFACE, .field = FIELD_SPEED};
    view.camera.distance = 5;
    CHECK(parse("{\"type\":\"view\",\"width\":640}"));
    protocol_apply_view(&message, &view);
    CHECK(view.width == 640 && view.height == 540 && view.field == FIELD_SPEED && !view.dark);
    CHECK(parse("{\"type\":\"camera\",\"elevation_deg\":45}"));
    protocol_apply_view(&message, &view);
    CHECK_NEAR(view.camera.elevation, PI / 4, 1e-15);
    CHECK(view.camera.distance == 5);
}

TEST(numbers_that_are_not_finite_travel_as_null)
{
    Text text = {0};
    double rows[] = {0, NAN, 1.5, 1e300 * 1e300};
    protocol_format_series(&text, rows, 2, 2);
    CHECK(!strcmp(text.data, "{\"type\":\"series\",\"rows\":[[0,null],[1.5,null]]}"));
    text_destroy(&text);
}

TEST(answers_read_as_documented)
{
    Text text = {0};
    protocol_format_accepted(&text, 7, 1.25);
    CHECK(!strcmp(text.data, "{\"type\":\"accepted\",\"id\":7,\"time_s\":1.25}"));
    text_clear(&text);
    Refusal no = {.path = "wave.height_m", .message = "say \"please\"\n"};
    protocol_format_error(&text, &no);
    CHECK(!strcmp(text.data, "{\"type\":\"error\",\"id\":null,\"path\":\"wave.height_m\","
                             "\"message\":\"say \\\"please\\\"\\u000a\"}"));
    text_clear(&text);
    protocol_format_marker(&text, 3, "heading 60°");
    CHECK(!strcmp(text.data, "{\"type\":\"marker\",\"time_s\":3,\"text\":\"heading 60°\"}"));
    text_clear(&text);
    protocol_format_reset(&text);
    CHECK(!strcmp(text.data, "{\"type\":\"reset\"}"));
    text_destroy(&text);
}

TEST(broken_utf8_never_reaches_the_socket)
{
    static const char *const broken[] = {"\xff",     "\xc3",         "\xe2\x82",
                                         "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80"};
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        Text text = {0};
        protocol_format_marker(&text, 0, broken[i]);
        CHECK_CONTAINS(text.data, "\xef\xbf\xbd");
        CHECK(!strstr(text.data, broken[i]));
        text_destroy(&text);
    }
}

TEST(a_status_tells_the_sea_in_degrees)
{
    Text text = {0};
    SessionStatus status = {.time = 2, .state = RUN_PAUSED, .has_waves = true};
    status.wave_asked = (WaveTarget){0.3, 1.58, PI / 3};
    status.wave_now = status.wave_asked;
    status.share_count = 1;
    status.shares[0] = (EffectShare){"base", 0.5};
    protocol_format_status(&text, &status, 8.5, 2);
    CHECK_CONTAINS(text.data, "\"state\":\"paused\"");
    CHECK_CONTAINS(text.data, "\"asked\":{\"height_m\":0.3,\"period_s\":1.58,\"heading_deg\":60}");
    CHECK_CONTAINS(text.data, "\"shares\":{\"base\":0.5}");
    CHECK_CONTAINS(text.data, "\"frames_per_s\":8.5,\"clients\":2");
    text_clear(&text);
    status.has_waves = false;
    protocol_format_status(&text, &status, 0, 0);
    CHECK_CONTAINS(text.data, "\"wave\":null");
    text_destroy(&text);
}

TEST(a_picture_header_is_little_endian_and_as_documented)
{
    unsigned char bytes[PICTURE_HEADER_SIZE];
    PictureHeader header = {PICTURE_STILL, 0x01020304, 960, 540, 1.5, 0x0a0b};
    protocol_format_picture_header(&header, bytes);
    static const unsigned char expected[PICTURE_HEADER_SIZE] = {
        'F', 'L', 'F', '1', 1, 0, 0,    0,    4,    3,    2, 1, 0xc0, 3, 0x1c, 2,
        0,   0,   0,   0,   0, 0, 0xf8, 0x3f, 0x0b, 0x0a, 0, 0, 0,    0, 0,    0};
    CHECK(!memcmp(bytes, expected, sizeof expected));
}

TEST(orders_for_lines_are_read)
{
    CHECK(parse("{\"type\":\"line\",\"id\":3,\"name\":\"bow_line\",\"length_m\":5.5}"));
    CHECK(message.kind == MESSAGE_LINE && !strcmp(message.command.line, "bow_line"));
    CHECK(message.command.line_length == 5.5 && message.command.line_cut == CUT_NOWHERE);
    CHECK(parse("{\"type\":\"line\",\"id\":3,\"name\":\"bow_line\",\"cut\":\"fairlead\"}"));
    CHECK(message.command.line_cut == CUT_FAIRLEAD && isnan(message.command.line_length));
    CHECK(!parse("{\"type\":\"line\",\"id\":3,\"name\":\"bow_line\"}"));
    CHECK(!parse("{\"type\":\"line\",\"id\":3,\"name\":\"bow_line\",\"cut\":\"here\"}"));
    CHECK_CONTAINS(refusal.message, "anchor|middle|fairlead");
    CHECK(!parse("{\"type\":\"line\",\"id\":3,\"length_m\":5}") && refusal.has_id);
}

TEST(orders_for_lines_are_read_back_from_the_journal)
{
    bool is_command;
    JournalCommand read;
    Error error = {0};
    const WaveTarget sea = {0.1, 1, 0};
    Command order = command_default();
    snprintf(order.line, sizeof order.line, "bow_line");
    order.line_length = 0.1 + 0.2;
    order.line_cut = CUT_MIDDLE;
    char line[400];
    journal_format_command(2.5, &order, &sea, line, sizeof line);
    CHECK(protocol_parse_journal(line, &is_command, &read, &error) && is_command);
    CHECK(read.time == 2.5 && read.command.line_length == order.line_length);
    CHECK(!strcmp(read.command.line, "bow_line") && read.command.line_cut == CUT_MIDDLE);
    const char *snap = "{\"time_s\":1,\"event\":\"snap\",\"line\":\"bow_line\",\"tension_n\":3}";
    CHECK(protocol_parse_journal(snap, &is_command, &read, &error) && !is_command);
    CHECK(!protocol_parse_journal("{\"time_s\":1,\"line\":{\"length_m\":3}}", &is_command, &read,
                                  &error));
    CHECK_CONTAINS(error.message, "line.name");
}

TEST(journal_lines_are_read_back)
{
    bool is_command;
    JournalCommand command;
    Error error = {0};
    const char *line = "{\"event\":\"command\",\"time_s\":30.5,\"wave\":{\"heading_deg\":60}}\n";
    CHECK(protocol_parse_journal(line, &is_command, &command, &error) && is_command);
    CHECK(command.time == 30.5 && isnan(command.command.wave_height));
    CHECK_NEAR(command.command.wave_heading, PI / 3, 1e-15);
    CHECK(
        protocol_parse_journal("{\"event\":\"start\",\"wave\":{}}", &is_command, &command, &error));
    CHECK(!is_command);
    CHECK(!protocol_parse_journal("nonsense", &is_command, &command, &error));
    CHECK(!protocol_parse_journal("{\"event\":\"command\",\"wave\":{\"height_m\":1}}", &is_command,
                                  &command, &error));
    CHECK_CONTAINS(error.message, "time_s");
}
