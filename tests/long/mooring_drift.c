/// A million implicit steps of one line.
#include "unit/mooring_cases.h"

/// Chain on the bed in heave: 500 periods of 2 s at 1 ms. The mean tension of the last 50 is that
/// of the first 50 after the start, and the line is no longer than it was.
TEST(a_million_steps_do_not_drift)
{
    const DrivenCase *c = driven_case("b1");
    LineScene scene = driven_scene(c, 20);
    WaterField water = driven_water(c);
    Arena arena = arena_create(0);
    Line line;
    Error error = {0};
    CHECK(line_create(&scene, c->anchor, c->fairlead, &water, "x", &arena, &line, NULL, &error));
    EndPath anchor = still_path(c->anchor);
    double first = 0, last = 0, longest = 0, step = 1e-3;
    bool good = true;
    for (long k = 0; good && k < 1000000; k++) {
        EndPath path = driven_path(c, (double)k * step, step);
        good = line_advance(&line, &water, (double)k * step, step, &anchor, &path, &error);
        if (k >= 10000 && k < 110000) first += line.tension[19] / 100000;
        if (k >= 900000) last += line.tension[19] / 100000;
        if (k % 100) continue;
        double length = 0;
        for (int i = 0; i < 20; i++)
            length += vec3_norm(vec3_sub(line.position[i + 1], line.position[i]));
        longest = maxd(longest, length);
    }
    CHECK(good);
    printf("  mean %.9g and %.9g N, length up to %.9g m, %ld steps\n", first, last, longest,
           line.substeps);
    CHECK_NEAR(last / first, 1, 1e-5);
    CHECK(longest < 6.0001);
    CHECK(line.substeps >= 1000000 && line.substeps < 1010000);
    arena_destroy(&arena);
}
