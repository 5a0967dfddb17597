/// Lines of a case: length or pretension, sections, points.
#include <unistd.h>

#include "engine.h"
#include "test.h"

static Scene scene;
static Error error;

static bool load(const char *lines)
{
    char path[100], text[3000];
    snprintf(path, sizeof path, "/tmp/fairlead_lines_%d.json", (int)getpid());
    snprintf(
        text, sizeof text,
        "{\"domain\": {\"kind\": \"lines\", \"depth_m\": 10}, \"fluid\": {\"density_kgm3\": 1025},"
        "\"bodies\": [{\"name\": \"ship\", \"shape\": \"box\", \"size_m\": [2, 2, 2],"
        "\"position_m\": [0, 0], \"draft_m\": 1, \"freedoms\": \"fixed\"}],%s}",
        lines);
    FILE *file = fopen(path, "w");
    if (file) {
        fputs(text, file);
        fclose(file);
    }
    error.message[0] = 0;
    bool good = scene_load(path, NULL, 0, &scene, &error);
    if (!good) printf("  %s\n", error.message);
    unlink(path);
    return good;
}

#define CHAIN                                                                                      \
    "\"axial_stiffness_n\": 8.54e6, \"mass_kgm\": 1.99, \"diameter_m\": 0.018, \"segments\": 40"
#define ENDS                                                                                       \
    "\"anchor\": {\"position_m\": [8, 0, -10]}, \"fairlead\": {\"body\": \"ship\", "               \
    "\"position_m\": "                                                                             \
    "[1, 0, 0]}"

TEST(length_and_pretension_follow_from_each_other)
{
    EngineOptions options = {.threads = 1, .backend = "auto"};
    Plan plan;
    for (int i = 0; i < 3; i++) {
        double length = 12.3 + 1.5 * i, tension = 0; // from nearly taut to one that lies on the bed
        char text[600];
        snprintf(text, sizeof text, "\"lines\": [{\"name\": \"a\", %s, %s, \"length_m\": %.17g}]",
                 ENDS, CHAIN, length);
        bool good = load(text) && plan_build(&scene, &options, &plan, &error);
        CHECK(good);
        if (!good) continue;
        tension = plan.lines[0].statics.fairlead_tension;
        plan_destroy(&plan);
        snprintf(text, sizeof text,
                 "\"lines\": [{\"name\": \"a\", %s, %s, \"pretension_n\": %.17g}]", ENDS, CHAIN,
                 tension);
        CHECK(load(text));
        printf("  %.4g m, %.6g N, back %.9g m\n", length, tension, scene.lines[0].length);
        CHECK_NEAR(scene.lines[0].length, length, 1e-6);
    }
}

TEST(sections_fill_in_from_their_line_and_sum_up)
{
    CHECK(
        load("\"lines\": [{\"name\": \"a\", " ENDS ", " CHAIN ", \"sections\": [{\"length_m\": 9},"
             "{\"length_m\": 3, \"mass_kgm\": 0.5, \"segments\": 7, \"bending_stiffness_nm2\": 2}],"
             "\"winch\": {\"length_m\": [11, 13], \"speed_ms\": 0.2}}]"));
    const LineScene *line = &scene.lines[0];
    CHECK(line->section_count == 2 && line->length == 12 && line->segments == 37);
    CHECK(line->sections[0].segments == 30 && line->sections[0].mass_per_length == 1.99);
    CHECK(line->sections[1].mass_per_length == 0.5 && line->sections[1].bending_stiffness == 2);
    CHECK(line->sections[1].axial_stiffness == 8.54e6);
    CHECK(line->winch.length.max == 13 && line->winch.speed == 0.2);
}

TEST(lines_meet_at_points)
{
    CHECK(load("\"points\": [{\"name\": \"clump\", \"kind\": \"free\", \"position_m\": [4, 0, -8], "
               "\"mass_kg\": 5},"
               "{\"name\": \"bollard\", \"kind\": \"fixed\", \"body\": \"ship\", \"position_m\": "
               "[1, 0, 0]}],"
               "\"lines\": [{\"name\": \"a\", " CHAIN
               ", \"anchor\": {\"position_m\": [8, 0, -10]}, \"fairlead\": {\"point\": \"clump\"}, "
               "\"length_m\": 5},"
               "{\"name\": \"b\", " CHAIN ", \"anchor\": {\"point\": \"clump\"}, \"fairlead\": "
               "{\"point\": \"bollard\"}, \"length_m\": 9}]"));
    CHECK(scene.point_count == 2 && scene.points[0].kind == POINT_FREE);
    CHECK(scene.lines[0].fairlead.point == 0 && scene.lines[1].anchor.point == 0);
    CHECK(scene.lines[1].fairlead.point == 1 && scene.lines[1].fairlead.body == 0);
    CHECK(scene.lines[1].fairlead.position.x == 1 && scene.points[0].added_mass == 0.5);
}
