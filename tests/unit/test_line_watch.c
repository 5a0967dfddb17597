/// Snaps of lines: told once each, with their peak, and only when a slack line is suddenly taut.
#include "engine.h"
#include "mooring_cases.h"

/// Drive a reference case and watch it. @return snaps told
static int watched_snaps(const char *name, LineEvents *events, LineWatch *watch)
{
    const DrivenCase *c = driven_case(name);
    LineScene scene = driven_scene(c, 20);
    WaterField water = driven_water(c);
    Arena arena = arena_create(0);
    Line line;
    Error error = {0};
    CHECK(line_create(&scene, c->anchor, c->fairlead, &water, "line", &arena, &line, NULL, &error));
    *watch = line_watch_create(&line, &water);
    EndPath still = still_path(c->anchor);
    double step = 1e-3;
    for (int i = 0; i < (int)(c->until / step); i++) {
        EndPath path = driven_path(c, i * step, step);
        CHECK(line_advance(&line, &water, i * step, step, &still, &path, &error));
        line_watch_step(watch, &line, 0, (i + 1) * step, events);
    }
    arena_destroy(&arena);
    return (int)events->count;
}

/// Snaps above `loud`, at least 0.8 of a period apart, and the largest of them.
static int loud_snaps(const char *name, double loud, double *largest)
{
    LineEvents events = {0};
    LineWatch watch;
    int all = watched_snaps(name, &events, &watch), count = 0;
    CHECK(all == watch.snaps);
    double last = -INFINITY;
    for (int i = 0; i < all; i++) {
        if (events.kept[i].tension < loud) continue;
        CHECK(events.kept[i].time - last > 0.8 * driven_case(name)->period);
        last = events.kept[i].time;
        *largest = maxd(*largest, events.kept[i].tension);
        count++;
    }
    printf("  %s: %d snaps, %d loud, at rest %.4g N\n", name, all, count, watch.rest);
    return count;
}

TEST(a_steel_wire_and_a_taut_rope_that_snap_every_period_are_told_each_time_with_their_peak)
{
    double largest = 0;
    CHECK(loud_snaps("c3", 100, &largest) == 3);
    CHECK_NEAR(largest, 935.3, 0.01 * 935.3);
    largest = 0;
    CHECK(loud_snaps("b5", 2000, &largest) == 4);
    CHECK_NEAR(largest, 3573.5, 0.01 * 3573.5);
}

TEST(a_chain_in_small_heave_never_snaps)
{
    LineEvents events = {0};
    LineWatch watch;
    CHECK(watched_snaps("b1", &events, &watch) == 0);
}

static double pulled[1];
static Line plain_line(LineScene *scene, double rest)
{
    memset(scene, 0, sizeof *scene);
    scene->length = 9.81;
    scene->segments = 1;
    scene->mass_per_length = 0.001;
    scene->diameter = 1e-6;
    pulled[0] = rest;
    Line line = {.scene = scene, .node_count = 2, .tension = pulled};
    return line;
}

/// Tension falls to nothing at 1 s and rises to `peak` within `rise` seconds. @return snaps told
static int rise_of(double rise, double peak, LineEvents *events)
{
    LineScene scene;
    Line line = plain_line(&scene, 10);
    WaterField water = {NULL, NULL, 0, 1000, 9.81, -10};
    LineWatch watch = line_watch_create(&line, &water);
    for (int i = 0; i < 3000; i++) {
        double t = i * 1e-3;
        pulled[0] = t < 1 ? 10 : t < 1 + rise ? peak * (t - 1) / rise : 10;
        line_watch_step(&watch, &line, 0, t, events);
    }
    return watch.snaps;
}

TEST(a_snap_is_a_rise_above_twice_the_rest_within_the_root_of_length_over_gravity)
{
    LineEvents events = {0};
    CHECK(rise_of(0.05, 30, &events) == 1);
    CHECK(rise_of(0.05, 19, &(LineEvents){0}) == 0);
    CHECK(rise_of(1.9, 30, &(LineEvents){0}) == 0); // too slow: sqrt(L/g) is 1 s
}

TEST(what_was_told_before_a_roll_back_is_not_told_again)
{
    LineEvents events = {0};
    rise_of(0.05, 30, &events);
    rise_of(0.05, 30, &events);
    CHECK(events.count == 1);
    int64_t seen = 0;
    CHECK(line_events_next(&events, &seen) && !line_events_next(&events, &seen));
}

TEST(the_journal_names_the_line_and_its_peak)
{
    static Scene scene;
    strcpy(scene.lines[1].name, "bow_line");
    LineEvent event = {LINE_SNAPPED, 1, 2.5, 345.25};
    char text[200];
    journal_format_line(&scene, &event, text, sizeof text);
    CHECK(!strcmp(
        text, "{\"time_s\":2.5,\"event\":\"snap\",\"line\":\"bow_line\",\"tension_n\":345.25}"));
    line_event_describe(&scene, &event, text, sizeof text);
    CHECK(!strcmp(text, "bow line snaps: 345.2 N"));
}

TEST(a_line_whose_sections_alone_say_what_it_is_made_of_is_watched_too)
{
    Scene pendant;
    Error error = {0};
    Plan plan;
    State *state = NULL;
    EngineOptions options = {.threads = 1, .backend = "auto"};
    static const char *const lines_only[] = {"domain.kind=lines", "fluid.spacing_m=null",
                                             "waves.kind=none", "bodies.ship.freedoms=fixed"};
    bool good =
        scene_load(SOURCE_DIR "/cases/moored_ship_pendant.json", lines_only, 4, &pendant, &error) &&
        plan_build(&pendant, &options, &plan, &error) &&
        state_create(&pendant, &plan, &state, &error);
    if (!good) printf("  %s\n", error.message);
    CHECK(good);
    if (!good) return;
    CHECK(pendant.lines[0].diameter == 0.002213);
    CHECK_NEAR(state->watches[0].rest, state->lines[0].tension[24], 1e-9);
    CHECK(state->watches[0].rest > 3);
    state_destroy(state);
    plan_destroy(&plan);
}
