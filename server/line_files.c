#include "line_files.h"

#include <errno.h>
#include <string.h>

#include "recorder.h"

static bool failed(const LineFiles *files, const char *name, Error *error)
{
    return error_set(error, ERROR_SYSTEM, "%.400s/%s: cannot write: %s", files->folder, name,
                     strerror(errno));
}

static FILE *open_file(const LineFiles *files, const char *name)
{
    char path[SCENE_PATH_SIZE + 40];
    snprintf(path, sizeof path, "%s/%s", files->folder, name);
    return fopen(path, "w");
}

bool line_files_open(LineFiles *files, const char *folder, Error *error)
{
    *files = (LineFiles){0};
    char shapes[SCENE_PATH_SIZE + 8];
    snprintf(files->folder, sizeof files->folder, "%s", folder);
    snprintf(shapes, sizeof shapes, "%s/lines", folder);
    TRY(folder_create(shapes, error));
    files->table = open_file(files, "lines.csv");
    if (!files->table) return failed(files, "lines.csv", error);
    files->series = open_file(files, "lines/lines.vtk.series");
    if (!files->series) return failed(files, "lines/lines.vtk.series", error);
    fputs("t_s,line,node,x_m,y_m,z_m,u_ms,v_ms,w_ms,tension_n\n", files->table);
    fputs("{\"file-series-version\": \"1.0\", \"files\": [", files->series);
    return true;
}

/// The tension stands with the node at the anchor's side of its segment; the last node has none.
static void write_rows(FILE *table, const Scene *scene, const State *state)
{
    for (int l = 0; l < scene->line_count; l++) {
        const Line *line = &state->lines[l];
        for (int n = 0; n < line->node_count; n++) {
            Vec3 x = line->position[n], v = line->velocity[n];
            fprintf(table, "%.9g,%s,%d,%.9g,%.9g,%.9g,%.6g,%.6g,%.6g,", state->time,
                    scene->lines[l].name, n, x.x, x.y, x.z, v.x, v.y, v.z);
            if (n + 1 < line->node_count) fprintf(table, "%.9g", line->tension[n]);
            fputc('\n', table);
        }
    }
}

/// Each whole segment is a cell of its own, so that its tension is a value of that cell.
/// Format: Schroeder, Martin & Lorensen, The Visualization Toolkit, "VTK file formats", legacy.
static void write_polydata(FILE *file, const Scene *scene, const State *state)
{
    int nodes = 0, lines = scene->line_count, first = 0;
    for (int l = 0; l < lines; l++)
        nodes += state->lines[l].node_count;
    int segments = nodes - lines;
    for (int l = 0; l < lines; l++)
        segments -= state->lines[l].parted_count;
    fprintf(file, "# vtk DataFile Version 3.0\nmooring lines at t = %.9g s\nASCII\n", state->time);
    fprintf(file, "DATASET POLYDATA\nPOINTS %d double\n", nodes);
    for (int l = 0; l < lines; l++)
        for (int n = 0; n < state->lines[l].node_count; n++) {
            Vec3 x = state->lines[l].position[n];
            fprintf(file, "%.9g %.9g %.9g\n", x.x, x.y, x.z);
        }
    fprintf(file, "LINES %d %d\n", segments, 3 * segments);
    for (int l = 0; l < lines; first += state->lines[l++].node_count)
        for (int n = 0; n + 1 < state->lines[l].node_count; n++)
            if (!state->lines[l].parted[n]) fprintf(file, "2 %d %d\n", first + n, first + n + 1);
    fprintf(file, "CELL_DATA %d\nSCALARS tension_n double 1\nLOOKUP_TABLE default\n", segments);
    for (int l = 0; l < lines; l++)
        for (int n = 0; n + 1 < state->lines[l].node_count; n++)
            if (!state->lines[l].parted[n]) fprintf(file, "%.9g\n", state->lines[l].tension[n]);
    fprintf(file, "SCALARS line int 1\nLOOKUP_TABLE default\n");
    for (int l = 0; l < lines; l++)
        for (int n = 0; n + 1 < state->lines[l].node_count; n++)
            if (!state->lines[l].parted[n]) fprintf(file, "%d\n", l);
    fprintf(file, "POINT_DATA %d\nVECTORS velocity_ms double\n", nodes);
    for (int l = 0; l < lines; l++)
        for (int n = 0; n < state->lines[l].node_count; n++) {
            Vec3 v = state->lines[l].velocity[n];
            fprintf(file, "%.6g %.6g %.6g\n", v.x, v.y, v.z);
        }
}

bool line_files_write(LineFiles *files, const Scene *scene, const State *state, Error *error)
{
    char name[40];
    write_rows(files->table, scene, state);
    snprintf(name, sizeof name, "lines/lines_%06d.vtk", files->count + 1);
    FILE *file = open_file(files, name);
    if (!file) return failed(files, name, error);
    write_polydata(file, scene, state);
    bool good = !ferror(file);
    if (fclose(file) || !good) return failed(files, name, error);
    fprintf(files->series, "%s\n  {\"name\": \"%s\", \"time\": %.9g}", files->count++ ? "," : "",
            name + 6, state->time);
    if (ferror(files->table)) return failed(files, "lines.csv", error);
    return !ferror(files->series) || failed(files, "lines/lines.vtk.series", error);
}

bool line_files_close(LineFiles *files, Error *error)
{
    bool good = true;
    if (files->series) fputs("\n]}\n", files->series);
    if (files->series && fclose(files->series))
        good = failed(files, "lines/lines.vtk.series", error);
    if (files->table && fclose(files->table)) good = failed(files, "lines.csv", error);
    files->table = files->series = NULL;
    return good;
}
