/// The table of the time series: names, order, units.
#include <stdlib.h>

#include "engine.h"
#include "test.h"

static Scene scene;
static SeriesTable table;

static void prepare(void)
{
    memset(&scene, 0, sizeof scene);
    scene.body_count = 2;
    strcpy(scene.bodies[0].name, "ship");
    strcpy(scene.bodies[1].name, "buoy");
    scene.line_count = 1;
    strcpy(scene.lines[0].name, "bow_line");
}

static int column(const char *name)
{
    for (int i = 0; i < table.count; i++)
        if (!strcmp(table.names[i], name)) return i;
    return -1;
}

TEST(columns_are_named_after_the_case_in_the_promised_order)
{
    prepare();
    scene.gauge_count = 2;
    strcpy(scene.gauges[0].name, "g1");
    strcpy(scene.gauges[1].name, "g2");
    scene.pressure_probe_count = 1;
    strcpy(scene.pressure_probes[0].name, "p1");
    series_table(&scene, &table);
    const char *order[] = {"t_s",
                           "ship.surge_m",
                           "ship.yaw_deg",
                           "ship.fluid_fx_n",
                           "ship.fluid_mz_nm",
                           "buoy.surge_m",
                           "buoy.fluid_fz_n",
                           "bow_line.fairlead_tension_n",
                           "bow_line.anchor_tension_n",
                           "bow_line.largest_tension_n",
                           "bow_line.touchdown_m",
                           "g1.elevation_m",
                           "g2.elevation_m",
                           "p1.pressure_pa"};
    int last = -1;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        CHECK(column(order[i]) > last);
        last = column(order[i]);
    }
    CHECK(table.count == 1 + 2 * 12 + 4 + 2 + 1);
}

TEST(the_longest_names_keep_their_units)
{
    prepare();
    memset(scene.lines[0].name, 'n', SCENE_NAME_SIZE - 1);
    series_table(&scene, &table);
    CHECK_CONTAINS(table.names[25], ".fairlead_tension_n");
    CHECK_CONTAINS(table.names[26], ".anchor_tension_n");
}

TEST(the_largest_scene_fits)
{
    memset(&scene, 0, sizeof scene);
    scene.body_count = SCENE_BODIES_MAX;
    scene.line_count = SCENE_LINES_MAX;
    scene.gauge_count = SCENE_GAUGES_MAX;
    scene.pressure_probe_count = SCENE_PRESSURE_PROBES_MAX;
    series_table(&scene, &table);
    CHECK(table.count <= SERIES_COLUMNS_MAX);
}

TEST(a_sample_fills_its_columns_in_their_units)
{
    static double row[SERIES_COLUMNS_MAX];
    static Plan plan;
    State state;
    Body bodies[2];
    Line line;
    double tension[3] = {10, 20, 30};
    prepare();
    memset(&state, 0, sizeof state);
    memset(bodies, 0, sizeof bodies);
    memset(&line, 0, sizeof line);
    bodies[0].attitude = quat_from_euler(0.1, -0.2, PI / 6 + 0.3);
    bodies[0].reference_attitude = quat_from_euler(0, 0, PI / 6);
    bodies[0].position = vec3(0, 0, 0.5);
    bodies[0].fluid_force = vec3(1, 2, 3);
    bodies[0].fluid_moment = vec3(4, 5, 6);
    bodies[1].attitude = bodies[1].reference_attitude = quat(1, 0, 0, 0);
    bodies[1].fluid_force = vec3(7, 8, 9);
    line.node_count = 4;
    line.tension = tension;
    line.largest_tension = 40;
    line.touchdown = 1.5;
    state.time = 2.5;
    state.bodies = bodies;
    state.lines = &line;
    series_table(&scene, &table);
    for (int i = 0; i <= table.count; i++)
        row[i] = -999;
    series_sample(&scene, &plan, &state, row);
    CHECK(row[table.count] == -999);
    CHECK(row[column("t_s")] == 2.5);
    CHECK_NEAR(row[column("ship.heave_m")], 0.5, 1e-15);
    CHECK_NEAR(row[column("ship.roll_deg")], 0.1 * 180 / PI, 1e-12);
    CHECK_NEAR(row[column("ship.pitch_deg")], -0.2 * 180 / PI, 1e-12);
    CHECK_NEAR(row[column("ship.yaw_deg")], 0.3 * 180 / PI, 1e-12);
    CHECK(row[column("ship.fluid_fz_n")] == 3);
    CHECK(row[column("ship.fluid_mx_nm")] == 4);
    CHECK(row[column("buoy.fluid_fy_n")] == 8);
    CHECK(row[column("bow_line.fairlead_tension_n")] == 30);
    CHECK(row[column("bow_line.anchor_tension_n")] == 10);
    CHECK(row[column("bow_line.largest_tension_n")] == 40);
    CHECK(row[column("bow_line.touchdown_m")] == 1.5);
}
