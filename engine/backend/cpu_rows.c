/// How far neighbours have moved against each other, row by row: it decides when visit bits and
/// lists have to be made anew. Neighbours in a wave move almost together, so a bound on their
/// relative speed lets bits live several times longer than the largest speed would; and where the
/// water is wild only the rows there pay for it.
#include <math.h>
#include <string.h>

#include "backend/cpu.h"

static void span_clear(VelocitySpan *span)
{
    for (int a = 0; a < 3; a++) {
        span->min[a] = INFINITY;
        span->max[a] = -INFINITY;
    }
}

static void span_add(VelocitySpan *span, const VelocitySpan *other)
{
    for (int a = 0; a < 3; a++) {
        span->min[a] = minf(span->min[a], other->min[a]);
        span->max[a] = maxf(span->max[a], other->max[a]);
    }
}

bool rows_create(Rows *rows, const Grid *grid, Arena *arena, Error *error)
{
    size_t n = (size_t)grid->row_count;
    TRY(rows->span = arena_take(arena, n, sizeof(VelocitySpan), "rows.span", error));
    TRY(rows->speed = arena_take(arena, n, sizeof(float), "rows.speed", error));
    TRY(rows->stretch = arena_take(arena, n, sizeof(float), "rows.stretch", error));
    TRY(rows->margin = arena_take(arena, n, sizeof(float), "rows.margin", error));
    TRY(rows->total = arena_take(arena, n, sizeof(float), "rows.total", error));
    return true;
}

void rows_sorted(Rows *rows, const Grid *grid)
{
    for (int r = 0; r < grid->row_count; r++) {
        rows->total[r] = rows->stretch[r] = 0;
        rows->margin[r] = -1; // no bits yet
    }
}

void rows_note_rest(Rows *rows, const ParticleSet *fixed, int row)
{
    static const VelocitySpan rest = {{0, 0, 0}, {0, 0, 0}};
    span_clear(&rows->span[row]);
    if (fixed->count && fixed->row_begin[row] < fixed->row_begin[row + 1])
        span_add(&rows->span[row], &rest);
}

void rows_note_velocity(Rows *rows, const ParticleSet *set, int row)
{
    if (!set->count) return;
    VelocitySpan *span = &rows->span[row];
    int begin = set->row_begin[row], end = set->row_begin[row + 1];
    for (int a = 0; a < 3; a++) {
        const float *shift = set->shift[a];
        float low = span->min[a], high = span->max[a];
        // padding has no velocity: the span may only grow by it
        for (int c = begin; c < end; c++) {
            const float *v = set->octet[c].velocity[a];
#pragma omp simd reduction(min : low) reduction(max : high)
            for (int l = 0; l < CLUSTER; l++) {
                low = v[l] < low ? v[l] : low;
                high = v[l] > high ? v[l] : high;
            }
            for (int l = 0; l < CLUSTER && shift; l++) {
                low = minf(low, v[l] + shift[c * CLUSTER + l]);
                high = maxf(high, v[l] + shift[c * CLUSTER + l]);
            }
        }
        span->min[a] = low;
        span->max[a] = high;
    }
}

/// Bound on the speed at which particles of this row and of those around it part [m/s].
static float relative_speed(const Rows *rows, const Grid *grid, int row)
{
    const VelocitySpan *own = &rows->span[row];
    if (own->min[0] > own->max[0]) return 0;
    int s = row / grid->across_rows, c = row % grid->across_rows;
    VelocitySpan around = *own;
    for (int ds = -ROW_REACH; ds <= ROW_REACH; ds++)
        for (int dc = -ROW_REACH; dc <= ROW_REACH; dc++) {
            int rs = s + ds, rc = c + dc;
            if (rs < 0 || rs >= grid->slab_rows || rc < 0 || rc >= grid->across_rows) continue;
            span_add(&around, &rows->span[rs * grid->across_rows + rc]);
        }
    float sum = 0;
    for (int a = 0; a < 3; a++) {
        float d = maxf(around.max[a] - own->min[a], own->max[a] - around.min[a]);
        sum += d * d;
    }
    return sqrtf(sum);
}

void rows_measure(Rows *rows, const Grid *grid, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < grid->row_count; row++)
        rows->speed[row] = relative_speed(rows, grid, row);
}

void rows_move(Rows *rows, const Grid *grid, double dt)
{
    for (int row = 0; row < grid->row_count; row++) {
        float path = rows->speed[row] * (float)dt;
        rows->stretch[row] += path;
        rows->total[row] += path;
    }
}

bool rows_lists_hold(const Rows *rows, const Grid *grid, double dt, double skin)
{
    for (int row = 0; row < grid->row_count; row++)
        if (rows->total[row] + 0.75 * dt * rows->speed[row] + rows->least_margin > skin)
            return false;
    return true;
}

/// Visits cost three times the margin over their mean distance, pruning its cost over the steps
/// that the margin lasts: the sum is least at a root of the path of a step. Exact bits cost four
/// times as much and save 7 % of all visits: worth it where they last for eight steps.
RowPruning rows_pruned(Rows *rows, int row, double dt, double skin)
{
    float path = rows->speed[row] * (float)dt, root = sqrtf(path * rows->spacing);
    RowPruning pruning = {0.6f * root, 0.6f * root >= 8 * path};
    if (!pruning.exact) pruning.margin = 0.35f * root;
    float left = (float)skin - rows->total[row]; // the lists know no farther neighbours
    pruning.margin = pruning.margin < left ? pruning.margin : left;
    pruning.margin = maxf(pruning.margin, rows->least_margin);
    rows->margin[row] = pruning.margin;
    rows->stretch[row] = 0;
    return pruning;
}

bool rows_due(const Rows *rows, int row) { return rows->stretch[row] > rows->margin[row]; }
