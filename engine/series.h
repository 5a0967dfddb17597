/// Time series: one table of columns, the same for series.csv and for the page.
#ifndef FAIRLEAD_SERIES_H
#define FAIRLEAD_SERIES_H

#include "plan.h"
#include "state.h"

enum { SERIES_COLUMNS_MAX = 1024, SERIES_COLUMN_SIZE = 80 };

/// Column names, units inside: "t_s", "ship.surge_m", …, "bow_line.fairlead_tension_n",
/// "g1.elevation_m".
typedef struct SeriesTable {
    int count;
    char names[SERIES_COLUMNS_MAX][SERIES_COLUMN_SIZE];
} SeriesTable;

/// Columns of a scene, in the order: t_s; per body surge_m sway_m heave_m roll_deg pitch_deg
/// yaw_deg fluid_fx_n fluid_fy_n fluid_fz_n fluid_mx_nm fluid_my_nm fluid_mz_nm; per line
/// fairlead_tension_n anchor_tension_n largest_tension_n touchdown_m; per gauge elevation_m; per
/// pressure probe pressure_pa; per line of run-up run_up_m; per slamming probe slam_fx_n slam_fy_n
/// slam_fz_n; per deck green_volume_m3 green_height_m; energy.kinetic_j … as docs/case_file.md
/// says.
void series_table(const Scene *scene, SeriesTable *table);

/// Values of all columns now; what reading them takes counts to their effects' clocks.
/// @param row  [table->count]
void series_sample(const Scene *scene, const Plan *plan, State *state, double *row);

#endif
