/// Colour maps and scales.
#include "test.h"

#include "colour_map.h"

TEST(sequential_maps_change_lightness_evenly)
{
    const ColourMap maps[] = {MAP_SEQUENTIAL, MAP_TENSION};
    for (int m = 0; m < 2; m++) {
        double ends[2][3], last = -1, rgb[3];
        colour_map(maps[m], 0, ends[0]);
        colour_map(maps[m], 1, ends[1]);
        double low = colour_lightness(ends[0]), high = colour_lightness(ends[1]);
        CHECK(fabs(high - low) > 0.5);
        for (int i = 0; i <= 50; i++) {
            colour_map(maps[m], i / 50.0, rgb);
            double share = (colour_lightness(rgb) - low) / (high - low);
            CHECK(share > last);
            CHECK_NEAR(share, i / 50.0, 0.06);
            last = share;
        }
    }
}

TEST(the_diverging_map_is_lightest_in_its_middle)
{
    double rgb[3];
    colour_map(MAP_DIVERGING, 0.5, rgb);
    double middle = colour_lightness(rgb);
    for (int i = 0; i < 5; i++) {
        double low[3], high[3];
        colour_map(MAP_DIVERGING, 0.08 * i, low);
        colour_map(MAP_DIVERGING, 1.0 - 0.08 * i, high);
        CHECK(colour_lightness(low) < middle && colour_lightness(high) < middle);
        CHECK_NEAR(colour_lightness(low), colour_lightness(high), 0.03);
    }
}

TEST(values_outside_a_map_take_its_ends)
{
    double end[3], beyond[3];
    colour_map(MAP_SEQUENTIAL, 1, end);
    colour_map(MAP_SEQUENTIAL, 7, beyond);
    CHECK_NEAR(beyond[0], end[0], 0);
    colour_map(MAP_SEQUENTIAL, 0, end);
    colour_map(MAP_SEQUENTIAL, NAN, beyond);
    CHECK_NEAR(beyond[2], end[2], 0);
}

TEST(ends_of_scales_are_round_and_not_below_the_data)
{
    CHECK_NEAR(nice_ceiling(0.93), 1.0, 1e-12);
    CHECK_NEAR(nice_ceiling(1.0), 1.0, 1e-12);
    CHECK_NEAR(nice_ceiling(1.2), 1.5, 1e-12);
    CHECK_NEAR(nice_ceiling(0.117), 0.15, 1e-12);
    CHECK_NEAR(nice_ceiling(6200), 8000, 1e-9);
    CHECK_NEAR(nice_ceiling(0), 1, 0);
    CHECK_NEAR(nice_ceiling(NAN), 1, 0);
}

TEST(a_scale_stays_while_the_data_fill_it)
{
    CHECK_NEAR(steady_range(1.0, 0.5), 1.0, 0);
    CHECK_NEAR(steady_range(1.0, 1.2), 1.5, 1e-12);
    CHECK_NEAR(steady_range(1.0, 0.1), 0.1, 1e-12);
    CHECK_NEAR(steady_range(0.0, 0.7), 0.8, 1e-12);
}
