#include "motion.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/portable.h"

enum { ROW_SIZE = 1024, COLUMNS_MAX = 7, ROWS_MAX = 1000000 };

/// Names by place in a row; the first `needed` of them must be there.
typedef struct Columns {
    const char *names[COLUMNS_MAX];
    int count, needed;
    const char *list; ///< for messages
} Columns;

static const Columns columns_of[] = {
    [MOTION_OF_BODY] = {{"t_s", "surge_m", "sway_m", "heave_m", "roll_deg", "pitch_deg", "yaw_deg"},
                        7,
                        1,
                        "t_s, surge_m, sway_m, heave_m, roll_deg, pitch_deg, yaw_deg"},
    [MOTION_OF_PISTON] = {{"t_s", "x_m"}, 2, 2, "t_s, x_m"},
};

typedef struct Reader {
    const char *path;
    const Columns *known;
    int row;                  ///< line of the file
    int columns[COLUMNS_MAX]; ///< index into the known names of each column
    int column_count;         ///< 0 before the names
    double (*rows)[COLUMNS_MAX];
    int count, room;
    Error *error;
} Reader;

static bool read_names(Reader *r, char *text)
{
    bool seen[COLUMNS_MAX] = {false};
    for (char *rest = text, *word; (word = strtok_r(rest, ", \t\r\n", &rest));) {
        int at = -1;
        for (int i = 0; i < r->known->count; i++)
            if (!strcmp(word, r->known->names[i])) at = i;
        if (at < 0 || seen[at])
            return error_set(r->error, ERROR_INPUT,
                             "%.300s line %d: column %.40s: must be one of %s, each once", r->path,
                             r->row, word, r->known->list);
        seen[at] = true;
        r->columns[r->column_count++] = at;
    }
    for (int i = 0; i < r->known->needed; i++)
        if (!seen[i])
            return error_set(r->error, ERROR_INPUT, "%.300s line %d: column %s is missing", r->path,
                             r->row, r->known->names[i]);
    return true;
}

static bool read_numbers(Reader *r, char *text)
{
    if (r->count == r->room) {
        r->room = r->room ? 2 * r->room : 1024;
        double(*rows)[COLUMNS_MAX] = realloc(r->rows, (size_t)r->room * sizeof *rows);
        if (!rows) return error_set(r->error, ERROR_SYSTEM, "no memory left for %.300s", r->path);
        r->rows = rows;
    }
    double *row = r->rows[r->count];
    memset(row, 0, sizeof r->rows[0]);
    int column = 0;
    for (char *rest = text, *word, *end; (word = strtok_r(rest, ", \t\r\n", &rest)); column++) {
        double value = strtod(word, &end);
        if (*end || !isfinite(value))
            return error_set(r->error, ERROR_INPUT, "%.300s line %d: %.40s: must be a number",
                             r->path, r->row, word);
        if (column < r->column_count)
            row[r->columns[column]] = value * (r->columns[column] > 3 ? PI / 180 : 1);
    }
    if (column != r->column_count)
        return error_set(r->error, ERROR_INPUT, "%.300s line %d: %d values: must be %d", r->path,
                         r->row, column, r->column_count);
    if (r->count && !(row[0] > r->rows[r->count - 1][0]))
        return error_set(r->error, ERROR_INPUT,
                         "%.300s line %d: t_s = %g: must be > %g, the row above", r->path, r->row,
                         row[0], r->rows[r->count - 1][0]);
    if (++r->count > ROWS_MAX)
        return error_set(r->error, ERROR_INPUT, "%.300s: must have <= %d rows", r->path, ROWS_MAX);
    return true;
}

static bool read_rows(Reader *r, FILE *file)
{
    char text[ROW_SIZE];
    while (fgets(text, sizeof text, file)) {
        r->row++;
        text[strcspn(text, "#")] = 0;
        if (!text[strspn(text, " \t\r\n")]) continue;
        TRY(r->column_count ? read_numbers(r, text) : read_names(r, text));
    }
    return r->count >= 2 || error_set(r->error, ERROR_INPUT,
                                      "%.300s: must have at least two rows of numbers", r->path);
}

/// Second derivatives of the natural cubic spline; `work` is [count].
/// Source: Press et al., Numerical Recipes, 3.3 (tridiagonal system, ends free of bending).
static void bend(MotionTable *table, int column, double *work)
{
    int n = table->count;
    const double *t = table->time;
    table->bend[0][column] = work[0] = 0;
    for (int i = 1; i + 1 < n; i++) {
        double left = t[i] - t[i - 1], right = t[i + 1] - t[i], both = t[i + 1] - t[i - 1];
        double share = left / both, p = share * table->bend[i - 1][column] + 2;
        double turn = (table->value[i + 1][column] - table->value[i][column]) / right -
                      (table->value[i][column] - table->value[i - 1][column]) / left;
        table->bend[i][column] = (share - 1) / p;
        work[i] = (6 * turn / both - share * work[i - 1]) / p;
    }
    table->bend[n - 1][column] = 0;
    for (int i = n - 2; i >= 0; i--)
        table->bend[i][column] = table->bend[i][column] * table->bend[i + 1][column] + work[i];
}

static double surge_at(const MotionTable *table, double time)
{
    double value[6] = {0}, rate[6] = {0};
    motion_add(table, time, value, rate);
    return fabs(value[0]);
}

/// Largest |surge| from row i to the next: at the ends or where the cubic's rate, A b^2 + B b + C
/// over the share b of the gap, is zero.
static double reach_between(const MotionTable *table, int i)
{
    double gap = table->time[i + 1] - table->time[i];
    double left = table->bend[i][0], right = table->bend[i + 1][0];
    double A = gap / 2 * (right - left), B = gap * left;
    double C = (table->value[i + 1][0] - table->value[i][0]) / gap - gap / 6 * (right + 2 * left);
    double most = maxd(fabs(table->value[i][0]), fabs(table->value[i + 1][0]));
    if (B * B < 4 * A * C) return most;
    // both roots without cancellation (Press et al., Numerical Recipes, 5.6)
    double q = -0.5 * (B + (B < 0 ? -1 : 1) * sqrt(B * B - 4 * A * C));
    double roots[2] = {A != 0 ? q / A : -1, q != 0 ? C / q : -1};
    for (int n = 0; n < 2; n++)
        if (roots[n] > 0 && roots[n] < 1)
            most = maxd(most, surge_at(table, table->time[i] + roots[n] * gap));
    return most;
}

static bool fill_table(const Reader *r, Arena *arena, MotionTable *table, Error *error)
{
    size_t n = (size_t)r->count;
    table->count = r->count;
    TRY(table->time = arena_take(arena, n, sizeof *table->time, "motion", error));
    TRY(table->value = arena_take(arena, n, sizeof *table->value, "motion", error));
    TRY(table->bend = arena_take(arena, n, sizeof *table->bend, "motion", error));
    double *work = arena_take(arena, n, sizeof *work, "motion", error);
    TRY(work);
    table->shortest = INFINITY;
    for (int i = 0; i < r->count; i++) {
        table->time[i] = r->rows[i][0];
        memcpy(table->value[i], r->rows[i] + 1, sizeof table->value[i]);
        if (i) table->shortest = mind(table->shortest, table->time[i] - table->time[i - 1]);
    }
    for (int column = 0; column < 6; column++)
        bend(table, column, work);
    for (int i = 0; i + 1 < r->count; i++) {
        double value[6] = {0}, rate[6] = {0};
        table->reach = maxd(table->reach, reach_between(table, i));
        motion_add(table, table->time[i], value, rate);
        table->largest_speed =
            maxd(table->largest_speed, vec3_norm(vec3(rate[0], rate[1], rate[2])));
    }
    return true;
}

bool motion_load(const char *path, MotionOf who, Arena *arena, MotionTable **table, Error *error)
{
    FILE *file = fopen(path, "r");
    if (!file)
        return error_set(error, ERROR_INPUT, "%.300s: cannot read: %s", path, strerror(errno));
    Reader reader = {.path = path, .known = &columns_of[who], .error = error};
    bool good = read_rows(&reader, file);
    fclose(file);
    *table = good ? arena_take(arena, 1, sizeof **table, "motion", error) : NULL;
    good = *table && fill_table(&reader, arena, *table, error);
    free(reader.rows);
    return good;
}

void motion_add(const MotionTable *table, double time, double *value, double *rate)
{
    int begin = 0, end = table->count - 1;
    if (time <= table->time[0] || time >= table->time[end]) {
        bool rests = time < table->time[0] || time >= table->time[end];
        const double *held = table->value[time <= table->time[0] ? 0 : end];
        for (int i = 0; i < 6 && rests; i++)
            value[i] += held[i];
        if (rests) return;
    }
    while (end - begin > 1) {
        int middle = begin + (end - begin) / 2;
        *(table->time[middle] > time ? &end : &begin) = middle;
    }
    double gap = table->time[end] - table->time[begin];
    double b = (time - table->time[begin]) / gap, a = 1 - b, bends = gap * gap / 6;
    for (int i = 0; i < 6; i++) {
        double from = table->value[begin][i], to = table->value[end][i];
        double left = table->bend[begin][i], right = table->bend[end][i];
        value[i] += a * from + b * to + ((a * a * a - a) * left + (b * b * b - b) * right) * bends;
        rate[i] += (to - from) / gap + ((3 * b * b - 1) * right - (3 * a * a - 1) * left) * gap / 6;
    }
}
