/// How often pictures are drawn, without drawing any.
#include "pace.h"
#include "test.h"

#include <math.h>

enum { CORES = 2 };

/// Draw as soon as the rule allows for a while; every picture costs the same.
/// @param wall  a picture takes this long to draw [s]
/// @return pictures per second
static double rate(double cost, double wall, bool running, bool new_view)
{
    const double span = 100;
    Pace pace = {0};
    int count = 0;
    double now = 0;
    for (; now < span; count++) {
        pace_drawn(&pace, now, cost, CORES, running);
        now = fmax(now + wall, pace_next(&pace, running, new_view));
    }
    return count / span;
}

TEST(pictures_take_their_share_of_all_cores)
{
    CHECK_NEAR(rate(0.04, 0.03, true, false) * 0.04, PACE_SHARE * CORES, 0.002);
    CHECK_NEAR(rate(0.10, 0.08, true, false) * 0.10, PACE_SHARE * CORES, 0.002);
}

TEST(whoever_looks_gets_a_picture_a_second_whatever_it_costs)
{
    CHECK_NEAR(rate(1.0, 0.5, true, false), 1, 0.02);
    CHECK_NEAR(rate(50.0, 0.9, true, false), 1, 0.02);
}

TEST(cheap_pictures_come_thirty_a_second_and_no_more)
{
    CHECK_NEAR(rate(0.001, 0.001, true, false), 30, 0.5);
    CHECK_NEAR(rate(0.0, 0.0, true, true), 30, 0.5);
}

TEST(while_the_solver_rests_pictures_are_free)
{
    CHECK_NEAR(rate(0.2, 0.01, false, false), 30, 0.5);
    Pace pace = {0};
    pace_drawn(&pace, 10, 0.2, CORES, false);
    CHECK_NEAR(pace_next(&pace, true, false), 10 + 1 / 30.0, 1e-12); // nor owed for afterwards
}

TEST(a_new_view_is_answered_at_once)
{
    Pace pace = {0};
    pace_drawn(&pace, 10, 0.1, CORES, true);
    CHECK(pace_next(&pace, true, false) > 10.5);
    CHECK_NEAR(pace_next(&pace, true, true), 10 + 1 / 30.0, 1e-12);
}

TEST(a_view_that_never_rests_takes_no_more_than_the_share)
{
    CHECK_NEAR(rate(0.04, 0.03, true, true) * 0.04, PACE_SHARE * CORES, 0.01);
}

TEST(one_dear_picture_is_forgotten_after_two_seconds)
{
    Pace pace = {0};
    pace_drawn(&pace, 10, 5.0, CORES, true);
    CHECK_NEAR(pace_next(&pace, true, false), 11, 1e-12);
    CHECK_NEAR(pace.paid_at, 12, 1e-12);
}
