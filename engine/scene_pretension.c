/// Lines whose tension is given instead of their length: the length follows from the elastic
/// catenary between the ends at rest.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "body.h"
#include "hull.h"
#include "mooring.h"
#include "scene_case.h"

/// Lengths are looked for between the span stretched by this much (the statics refuse 5 %) …
static const double MOST_STRETCH = 0.0499;
/// … and this many times the way down to the bed and along it.
static const double LONGEST_WAY = 1.5;
enum { BISECTIONS = 100 };

/// World place of an end with its body at rest.
static bool end_at_rest(const Scene *scene, const LineEnd *end, Vec3 *place, Error *error)
{
    *place = end->position;
    if (end->body < 0) return true;
    Arena scratch = arena_create(0);
    BodyGeometry geometry;
    bool good = body_geometry_create(scene, end->body, &scratch, &geometry, error);
    if (good) {
        Body body = body_create(&scene->bodies[end->body], &geometry);
        *place = body_point(&body, end->position);
    }
    arena_destroy(&scratch);
    return good;
}

typedef struct Pull {
    const WaterField *water;
    const char *where;
    Vec3 anchor, fairlead;
} Pull;

/// Tension at the fairlead of a line of this length [N]; NAN where there is none.
static double tension_of(LineScene *line, const Pull *pull, double length, Error *error)
{
    LineStatics statics;
    line->length = length;
    bool good = line_statics(line, pull->anchor, pull->fairlead, pull->water, pull->where, NULL,
                             &statics, error);
    return good ? statics.fairlead_tension : NAN;
}

/// Shorter lines pull harder: bisection on the logarithm of what the line is longer than the span.
static bool solve_length(const JsonReader *reader, LineScene *line, const Pull *pull)
{
    Error unused;
    double span = vec3_norm(vec3_sub(pull->fairlead, pull->anchor));
    double top = maxd(pull->anchor.z, pull->fairlead.z) - pull->water->bed;
    double shortest = span / (1 + MOST_STRETCH), longest = LONGEST_WAY * (span + 2 * maxd(top, 0));
    double strongest = tension_of(line, pull, shortest, &unused);
    double weakest = tension_of(line, pull, longest, &unused);
    double wanted = line->pretension;
    if (!(wanted <= strongest && wanted >= weakest)) {
        char at[JSON_PATH_SIZE];
        snprintf(at, sizeof at, "%.100s.pretension_n", pull->where);
        return table_refuse_number(reader, at, wanted,
                                   "must be >= %.6g N (a line that hangs down) and <= %.6g N (5 %% "
                                   "of stretch) here",
                                   weakest, strongest);
    }
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (shortest + longest);
        *(tension_of(line, pull, middle, &unused) > wanted ? &shortest : &longest) = middle;
    }
    line->length = 0.5 * (shortest + longest);
    return true;
}

bool case_resolve_pretension(const JsonReader *reader, Scene *scene)
{
    WaterField water = {NULL,
                        NULL,
                        scene->fluid.level,
                        scene->fluid.density,
                        scene->fluid.gravity,
                        scene->domain.min.z};
    for (int l = 0; l < scene->line_count; l++) {
        LineScene *line = &scene->lines[l];
        char where[32];
        if (isnan(line->pretension)) continue;
        snprintf(where, sizeof where, "lines[%d]", l);
        const LineEnd *ends[2] = {&line->anchor, &line->fairlead};
        for (int e = 0; e < 2; e++)
            if (ends[e]->point >= 0 && scene->points[ends[e]->point].kind == POINT_FREE) {
                char at[JSON_PATH_SIZE];
                snprintf(at, sizeof at, "%s.pretension_n", where);
                return table_refuse(
                    reader, at, NULL,
                    "must not be given for a line at a free point: must be length_m");
            }
        Pull pull = {&water, where, {0, 0, 0}, {0, 0, 0}};
        TRY(end_at_rest(scene, ends[0], &pull.anchor, reader->error));
        TRY(end_at_rest(scene, ends[1], &pull.fairlead, reader->error));
        TRY(solve_length(reader, line, &pull));
        if (line->winch.speed > 0 &&
            !(line->length >= line->winch.length.min && line->length <= line->winch.length.max))
            return table_refuse_number(reader, where, line->length,
                                       "the length that follows must be within winch.length_m");
    }
    return true;
}
