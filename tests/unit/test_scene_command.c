/// Live changes against the limits of a case.
#include "command.h"
#include "test.h"

static Scene scene;
static Error error;
static WaveTarget target;

static bool ask(double height, double period, double heading_deg)
{
    Command command = command_default();
    command.wave_height = height;
    command.wave_period = period;
    command.wave_heading = heading_deg * PI / 180;
    WaveTarget last = {0.1, 1.5, PI};
    memset(&error, 0, sizeof error);
    target = (WaveTarget){-1, -1, -1};
    return command_check(&scene, &command, &last, &target, &error);
}

static void load(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", SOURCE_DIR, name);
    if (!scene_load(path, NULL, 0, &scene, &error)) printf("  %s\n", error.message);
}

TEST(command_keeps_what_it_does_not_name)
{
    load("tests/good_cases/steered.json");
    Command nothing = command_default();
    WaveTarget last = {0.1, 1.5, PI};
    CHECK(command_check(&scene, &nothing, &last, &target, &error));
    CHECK(target.height == 0.1 && target.period == 1.5 && target.heading == PI);
    CHECK(ask(0.2, NAN, NAN));
    CHECK(target.height == 0.2 && target.period == 1.5 && target.heading == PI);
}

TEST(command_outside_the_limits_is_refused_as_a_whole)
{
    load("tests/good_cases/steered.json");
    CHECK(!ask(0.31, 1.6, 90));
    CHECK_CONTAINS(error.message, "wave.height_m = 0.31: must be >= 0 and <= 0.3 m");
    CHECK(target.height == -1 && target.period == -1 && target.heading == -1);
    CHECK(!ask(NAN, 1.2, NAN));
    CHECK_CONTAINS(error.message, "wave.period_s = 1.2: must be >= 1.26 and <= 2 s");
    CHECK(!ask(INFINITY, NAN, NAN));
    CHECK(!ask(NAN, -INFINITY, NAN));
    CHECK(!ask(NAN, NAN, INFINITY));
    CHECK(error.code == ERROR_INPUT);
}

TEST(limits_themselves_are_accepted)
{
    load("tests/good_cases/steered.json");
    CHECK(ask(0.3, 1.26, 0));
    CHECK(ask(0, 2, 360));
}

TEST(heading_turns_by_full_circles_into_the_limits)
{
    load("tests/good_cases/steered.json");
    CHECK(ask(NAN, NAN, -90));
    CHECK_NEAR(target.heading, 1.5 * PI, 1e-12);
    CHECK(ask(NAN, NAN, 450));
    CHECK_NEAR(target.heading, 0.5 * PI, 1e-12);
    scene.waves.heading_limits = (Range){0, PI};
    CHECK(!ask(NAN, NAN, 270));
    CHECK_CONTAINS(error.message, "wave.heading_deg = 270: must be >= 0 and <= 180 deg");
}

TEST(a_wave_of_twice_the_breaking_height_is_refused)
{
    load("tests/good_cases/steered.json");
    scene.waves.height_limits.max = 1;
    CHECK(ask(0.4, 1.26, NAN)); // 0.142 L tanh kd = 0.349 m at 1.26 s in 1.2 m: it breaks
    CHECK(!ask(0.75, 1.26, NAN));
    CHECK_CONTAINS(error.message, "<= 0.6977 m");
    CHECK(ask(0.75, 2, NAN));
}

TEST(a_case_without_waves_takes_no_command)
{
    load("cases/dam_break.json");
    CHECK(!ask(0.1, 1, 0));
    CHECK_CONTAINS(error.message, "this case has no waves");
}

TEST(waves_in_the_plane_travel_along_it)
{
    load("tests/good_cases/steered.json");
    scene.domain.dimensions = 2;
    CHECK(ask(NAN, NAN, 0));
    CHECK(!ask(NAN, NAN, 30));
    CHECK_CONTAINS(error.message, "wave.heading_deg = 30: must be 0 or 180 in 2-D");
}
