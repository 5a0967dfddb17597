/// The flume's piston: a recorded motion.
#include "piston.h"

#include <stdlib.h>
#include <unistd.h>

#include "engine.h"
#include "test.h"

static Error error;
static char folder[64]; ///< of the case and its table

static void written(const char *name, const char *text)
{
    char path[128];
    if (!folder[0]) {
        snprintf(folder, sizeof folder, "/tmp/fairlead_piston_XXXXXX");
        CHECK(mkdtemp(folder) != NULL);
    }
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *stream = fopen(path, "w");
    CHECK(stream != NULL);
    if (!stream) return;
    fputs(text, stream);
    fclose(stream);
}

static void swept(void)
{
    char path[128];
    static const char *const names[] = {"case.json", "paddle.csv"};
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
    folder[0] = 0;
}

typedef struct Flume {
    Scene scene;
    Plan plan;
    State *state;
} Flume;

/// A flume 3 m long with water of 0.5 m, and `waves` as in a case. @return NULL where it is refused
static Flume *flume_of(const char *waves)
{
    static Flume flume;
    char text[700], path[128];
    EngineOptions options = {.threads = 1, .backend = "cpu"};
    snprintf(text, sizeof text,
             "{\"domain\": {\"kind\": \"flume\", \"dimensions\": 2, \"min_m\": [0, -0.5], "
             "\"max_m\": [3, 0.2]}, \"fluid\": {\"spacing_m\": 0.05}, \"waves\": {%s}}",
             waves);
    written("case.json", text);
    snprintf(path, sizeof path, "%s/case.json", folder);
    memset(&flume, 0, sizeof flume);
    memset(&error, 0, sizeof error);
    if (!scene_load(path, NULL, 0, &flume.scene, &error)) return NULL;
    if (!plan_build(&flume.scene, &options, &flume.plan, &error)) return NULL;
    if (state_create(&flume.scene, &flume.plan, &flume.state, &error)) return &flume;
    plan_destroy(&flume.plan);
    return NULL;
}

static void drained(Flume *flume)
{
    state_destroy(flume->state);
    plan_destroy(&flume->plan);
}

/// Where a dummy is whose mean place is (-0.025, 0, -0.2), less that.
static double shift(const Flume *flume, double time)
{
    Vec3 mean = vec3(-0.025, 0, -0.2), place;
    piston_move(flume->state->waves, time, 1, &mean, &place);
    CHECK(place.y == mean.y && place.z == mean.z);
    return place.x - mean.x;
}

#define RECORD                                                                                     \
    "\"kind\": \"record\", \"piston_motion\": \"paddle.csv\", \"height_m\": 0.1, "                 \
    "\"period_s\": 1.5"

/// The natural cubic spline through 0, a, 0 at t = 0, 1, 2 is a (3t - t^3)/2 up to t = 1.
TEST(the_piston_follows_its_record_between_rows)
{
    written("paddle.csv", "# piston of a tank\nx_m, t_s\n0, 0\n0.04, 1\n0 2\n");
    Flume *flume = flume_of(RECORD);
    CHECK(flume != NULL);
    if (!flume) printf("  %s\n", error.message);
    for (int i = 0; flume && i <= 20; i++) {
        double t = 0.05 * i, expected = 0.04 * (3 * t - t * t * t) / 2;
        CHECK_NEAR(shift(flume, t), expected, 1e-15);
        CHECK_NEAR(shift(flume, 2 - t), expected, 1e-15);
    }
    if (flume) {
        CHECK(shift(flume, -1) == 0 && shift(flume, 3) == 0);
        CHECK_NEAR(flume->plan.wall_reach, 0.04, 1e-12);
        CHECK_CONTAINS(flume->plan.effects[EFFECT_PISTON].because, "3 rows from 0 to 2 s");
        for (int i = 0; i < 20; i++)
            CHECK(step_advance(&flume->scene, &flume->plan, flume->state, &error));
        drained(flume);
    }
    swept();
}

/// Rows every 10 ms, as tanks record; a free end of the spline is right again after 0.2 s.
TEST(a_recorded_stroke_of_first_order_is_the_built_in_one)
{
    enum { ROWS = 601 };
    static double path[2 * ROWS];
    static char table[ROWS * 40];
    Flume *flume = flume_of("\"kind\": \"regular\", \"height_m\": 0.1, \"period_s\": 1.5, "
                            "\"piston_order\": 1");
    CHECK(flume != NULL);
    if (!flume) return;
    size_t used = (size_t)snprintf(table, sizeof table, "t_s,x_m\n");
    double largest = 0;
    for (int i = 0; i < 2 * ROWS; i++) {
        path[i] = shift(flume, 0.005 * i);
        largest = maxd(largest, fabs(path[i]));
        if (i % 2 == 0)
            used += (size_t)snprintf(table + used, sizeof table - used, "%.3f,%.9f\n", 0.005 * i,
                                     path[i]);
    }
    drained(flume);
    CHECK(largest > 0.03);
    written("paddle.csv", table);
    flume = flume_of(RECORD);
    CHECK(flume != NULL);
    double worst = 0;
    for (int i = 0; flume && 0.005 * i < 5.8; i++)
        worst = maxd(worst, fabs(shift(flume, 0.005 * i) - path[i]));
    printf("  %.2g m off, of %.2g m\n", worst, largest);
    CHECK(worst < 1e-6);
    if (flume) drained(flume);
    swept();
}

/// The natural cubic spline through 0, a, a, 0 at t = 0 ... 3 rises above a between its rows: by
/// symmetry its bends are -6a/5, and x(3/2) = a + (6a/5)/8.
TEST(the_travel_of_a_record_counts_what_is_between_rows)
{
    written("paddle.csv", "t_s,x_m\n0,0\n1,-0.04\n2,-0.04\n3,0\n");
    Flume *flume = flume_of(RECORD);
    CHECK(flume != NULL);
    if (!flume) return;
    CHECK_NEAR(flume->plan.wall_reach, 0.04 * 1.15, 1e-12);
    drained(flume);
    swept();
}

TEST(a_record_cannot_be_changed_live)
{
    written("paddle.csv", "t_s,x_m\n0,0\n1,0.01\n2,0\n");
    Flume *flume = flume_of(RECORD);
    CHECK(flume != NULL);
    if (!flume) return;
    Command command = command_default();
    command.wave_height = 0.05;
    CHECK(!state_command(&flume->scene, flume->state, &command, &error));
    CHECK_CONTAINS(error.message, "follows a record (waves.piston_motion): its waves cannot be");
    CHECK(error.code == ERROR_INPUT);
    CHECK(flume->state->waves->asked.height == 0.1 && !flume->state->waves->has_queued);
    drained(flume);
    swept();
}

TEST(nothing_but_the_water_knows_what_a_record_makes)
{
    char text[400];
    written("paddle.csv", "t_s,x_m\n0,0\n1,0.01\n2,0\n");
    Flume *flume = flume_of(RECORD);
    CHECK(flume != NULL);
    if (!flume) return;
    CHECK(waves_elevation(flume->state->waves, 1, 0, 1.2) == 0);
    CHECK(vec3_norm(waves_velocity(flume->state->waves, vec3(1, 0, -0.1), 1.2)) == 0);
    waves_tell(&flume->scene, text, sizeof text);
    CHECK_CONTAINS(text, "piston follows a record");
    CHECK_CONTAINS(text, "paddle.csv");
    // the beach is one longest wave length, as of other waves
    CHECK(flume->plan.zone_width > 2.5 && flume->plan.zone_width < 3.5);
    drained(flume);
    swept();
}

/// A fast piston asks for more sound than the depth does: a stroke of 0.5 m in 0.1 s.
TEST(the_sound_speed_minds_a_fast_record)
{
    written("paddle.csv", "t_s,x_m\n0,0\n1,0\n1.1,0.5\n2,0.5\n");
    Flume *flume = flume_of(RECORD);
    CHECK(flume != NULL);
    if (!flume) return;
    CHECK_CONTAINS(flume->plan.sound_speed_because, "speed of the piston");
    CHECK(flume->plan.largest_speed > 2.4);
    drained(flume);
    swept();
}
