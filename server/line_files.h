/// Shapes of lines over time as files: lines.csv, a row per node, and legacy VTK polydata with
/// lines.vtk.series, which ParaView opens as one data set in time.
#ifndef FAIRLEAD_LINE_FILES_H
#define FAIRLEAD_LINE_FILES_H

#include <stdio.h>

#include "engine.h"

typedef struct LineFiles {
    char folder[SCENE_PATH_SIZE];
    FILE *table, *series; ///< NULL while closed
    int count;            ///< instants written
} LineFiles;

/// Make FOLDER/lines.csv and FOLDER/lines/.
bool line_files_open(LineFiles *files, const char *folder, Error *error);
/// Write the present instant: positions [m] and velocities [m/s] of nodes, tensions of segments
/// [N].
bool line_files_write(LineFiles *files, const Scene *scene, const State *state, Error *error);
/// Finish the files; may be called again. @param error  may be NULL
bool line_files_close(LineFiles *files, Error *error);

#endif
