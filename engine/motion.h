/// Motion of a body or of the piston from a table, as a smooth curve through its rows.
#ifndef FAIRLEAD_MOTION_H
#define FAIRLEAD_MOTION_H

#include "base/arena.h"
#include "base/error.h"

/// Who moves by a table, hence the names of its columns.
typedef enum MotionOf {
    MOTION_OF_BODY,   ///< t_s and any of surge_m, sway_m, heave_m, roll_deg, pitch_deg, yaw_deg
    MOTION_OF_PISTON, ///< t_s and x_m, which takes surge's place
} MotionOf;

/// Six freedoms over time: surge, sway, heave [m]; roll, pitch, yaw [rad]; columns that the file
/// lacks are 0. Between rows a natural cubic spline, so that velocity and acceleration are
/// continuous (a line at the body feels every jump); before the first and behind the last row rest.
typedef struct MotionTable {
    int count;
    double *time;         ///< [count][s], ascending
    double (*value)[6];   ///< [count]
    double (*bend)[6];    ///< second derivatives at the rows [count]
    double shortest;      ///< smallest time between rows [s]
    double largest_speed; ///< of surge, sway and heave together, at the rows [m/s]
    double reach;         ///< largest |surge| of the whole curve [m]
} MotionTable;

/// Read a table: a row of column names in any order, then numbers, separated by commas or blanks;
/// `#` begins a comment.
/// @return false with ERROR_INPUT naming the file and its line
bool motion_load(const char *path, MotionOf who, Arena *arena, MotionTable **table, Error *error);

/// Displacement and its rate at a time. @param value, rate  [6], added to
void motion_add(const MotionTable *table, double time, double *value, double *rate);

#endif
