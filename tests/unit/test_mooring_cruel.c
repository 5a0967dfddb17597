/// Lines under cruel treatment: heaps, snaps of many segments, beds and breaks at once.
#include "mooring_cases.h"

/// Largest stretch of a whole segment, or NAN when anything is not finite or pushes.
static double stretch(const Line *line)
{
    double longest = 0, l = line->length / (line->node_count - 1);
    for (int i = 0; i < line->node_count; i++)
        if (!isfinite(vec3_norm(line->position[i]) + vec3_norm(line->velocity[i]))) return NAN;
    for (int i = 0; i + 1 < line->node_count; i++) {
        double s = vec3_norm(vec3_sub(line->position[i + 1], line->position[i]));
        if (!(line->tension[i] >= 0)) return NAN;
        if (!line->parted[i]) longest = maxd(longest, s / l);
    }
    return longest;
}

typedef struct Ordeal {
    const char *name;
    Vec3 anchor, fairlead;
    double surge, heave, period;
    double friction, breaking;
    int segments;
    double strain; ///< a segment may be stretched by so much [-]
} Ordeal;

static const Ordeal ordeals[] = {
    {"wire snaps in every wave", {0, 0, -.5}, {.398, 0, -.08}, 0, .03, 1, 0, 0, 20, .002},
    {"200 segments snap", {0, 0, -.5}, {.398, 0, -.08}, 0, .03, 1, 0, 0, 200, .002},
    {"heap on the bed", {0, 0, -.5}, {.05, 0, -.3}, .1, .15, 1, 0, 0, 20, .001},
    {"dragged over a rough bed", {0, 0, -.5}, {.4, 0, -.4}, .15, .08, 1, 1, 0, 20, .002},
    {"anchor above fairlead", {0, 0, -.08}, {.38, 0, -.45}, .05, .04, .7, 0, 0, 20, .002},
    {"parts mid-snap", {0, 0, -.5}, {.398, 0, -.08}, 0, .03, 1, 0, 300, 20, .002},
    {"in and out of the water", {0, 0, -.5}, {.28, 0, -.04}, .01, .06, .8, 0, 0, 20, .002},
};

/// Three periods each at a fluid's step, with steel wire.
TEST(nothing_done_to_a_steel_wire_gives_a_push_a_not_a_number_or_a_wild_stretch)
{
    for (size_t k = 0; k < sizeof ordeals / sizeof ordeals[0]; k++) {
        const Ordeal *o = &ordeals[k];
        DrivenCase c = *driven_case("c1");
        c.anchor = o->anchor;
        c.fairlead = o->fairlead;
        c.surge = o->surge;
        c.heave = o->heave;
        c.period = o->period;
        c.phase = 0;
        LineScene scene = driven_scene(&c, o->segments);
        scene.bed_friction = o->friction;
        scene.breaking_tension = o->breaking;
        WaterField water = driven_water(&c);
        Arena arena = arena_create(0);
        Line line;
        Error error = {0};
        bool good =
            line_create(&scene, c.anchor, c.fairlead, &water, o->name, &arena, &line, NULL, &error);
        EndPath anchor = still_path(c.anchor);
        double longest = 0, step = 1e-3, time = 0;
        for (; good && time < 3 * o->period; time += step) {
            EndPath path = driven_path(&c, time, step);
            good = line_advance(&line, &water, time, step, &anchor, &path, &error);
            longest = good ? maxd(longest, stretch(&line)) : longest;
            good = good && isfinite(stretch(&line));
        }
        if (!good) printf("  %s at %.4g s: %s\n", o->name, time, error.message);
        CHECK(good);
        CHECK(longest < 1 + o->strain);
        CHECK((line.parted_count > 0) == (o->breaking > 0));
        printf("  %s: up to %.4g N, %.2f steps a call\n", o->name, line.largest_tension,
               (double)line.substeps * step / time);
        arena_destroy(&arena);
    }
}

TEST(line_of_no_length_is_refused_and_a_winch_stops_short_of_it)
{
    const DrivenCase *c = driven_case("b7");
    LineScene scene = driven_scene(c, 20);
    WaterField water = driven_water(c);
    Arena arena = arena_create(0);
    Line line;
    LineStatics statics;
    Error error = {0};
    scene.length = 0;
    CHECK(!line_statics(&scene, c->anchor, c->anchor, &water, "lines.x", NULL, &statics, &error));
    CHECK(error.code == ERROR_INPUT);
    CHECK_CONTAINS(error.message, "length 0 m");
    scene.length = 10;
    CHECK(line_create(&scene, c->anchor, c->anchor, &water, "x", &arena, &line, NULL, &error));
    mooring_set_length(&line, 0, 5, 0);
    EndPath still = still_path(c->anchor);
    for (int k = 0; k < 1000; k++)
        CHECK(line_advance(&line, &water, k * 5e-3, 5e-3, &still, &still, &error));
    CHECK_NEAR(line.length, 1, 1e-12);
    CHECK(isfinite(stretch(&line)));
    arena_destroy(&arena);
}
