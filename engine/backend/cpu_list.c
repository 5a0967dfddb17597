/// Lists of neighbouring clusters, rebuilt when the particles have moved half the skin.
#include <stdlib.h>
#include <string.h>

#include "backend/particles.h"

bool list_create(ClusterList *list, const ParticleSet *a, uint32_t per_cluster, Arena *arena,
                 Error *error)
{
    memset(list, 0, sizeof *list);
    size_t clusters = (size_t)a->slot_capacity / CLUSTER;
    TRY(list->begin = arena_take(arena, clusters, sizeof(uint32_t), "list.begin", error));
    TRY(list->count = arena_take(arena, clusters, sizeof(uint32_t), "list.count", error));
    list->per_cluster = per_cluster;
    return true;
}

/// A row of `b` seen from a row of `a`: its clusters, and how far the window has moved.
typedef struct Window {
    int cluster, end;
} Window;

static int open_windows(const ParticleSet *b, const Grid *grid, int s, int c, bool half,
                        Window windows[(2 * ROW_REACH + 1) * (2 * ROW_REACH + 1)])
{
    int count = 0;
    for (int ds = half ? 0 : -ROW_REACH; ds <= ROW_REACH; ds++)
        for (int dc = half && ds == 0 ? 0 : -ROW_REACH; dc <= ROW_REACH; dc++) {
            int rs = s + ds, rc = c + dc;
            if (rs < 0 || rs >= grid->slab_rows || rc < 0 || rc >= grid->across_rows) continue;
            int row = rs * grid->across_rows + rc;
            if (b->row_begin[row] == b->row_begin[row + 1]) continue;
            windows[count].cluster = b->row_begin[row];
            windows[count++].end = b->row_begin[row + 1];
        }
    return count;
}

/// Squared distance of two boxes [unit^2].
static inline float box_gap(const Boxes *a, int i, const Boxes *b, int k)
{
    float sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        // halves keep the difference of far boxes inside 32 bits
        int32_t below = b->min[axis][k] / 2 - a->max[axis][i] / 2;
        int32_t above = a->min[axis][i] / 2 - b->max[axis][k] / 2;
        int32_t gap = below > above ? below : above;
        float g = gap > 0 ? 2.0f * (float)gap : 0.0f;
        sum += g * g;
    }
    return sum;
}

/// Entries of one row of `a`; returns the next free entry, or 0 when the region is full.
static size_t fill_row(ClusterList *list, const ParticleSet *a, const ParticleSet *b,
                       const Grid *grid, bool half, int s, int c, size_t next, size_t end)
{
    Window windows[(2 * ROW_REACH + 1) * (2 * ROW_REACH + 1)];
    int count = open_windows(b, grid, s, c, half, windows);
    int row = s * grid->across_rows + c, along = grid->along;
    int32_t slack = grid->reach + grid->bin;
    for (int i = a->row_begin[row]; i < a->row_begin[row + 1]; i++) {
        list->begin[i] = (uint32_t)next;
        int32_t low = a->boxes.min[along][i] - slack;
        int32_t high = a->boxes.max[along][i] + slack;
        for (int w = 0; w < count; w++) {
            int k = windows[w].cluster;
            while (k < windows[w].end && b->boxes.max[along][k] < low - grid->bin)
                k++;
            windows[w].cluster = k;
            for (; k < windows[w].end && b->boxes.min[along][k] <= high; k++) {
                if (half && k <= i) continue;
                if (box_gap(&a->boxes, i, &b->boxes, k) >= grid->reach_squared) continue;
                if (next == end) return 0;
                list->entry[next++] = (uint32_t)k;
            }
        }
        list->count[i] = (uint32_t)(next - list->begin[i]);
    }
    return next;
}

static bool fill_list(ClusterList *list, const ParticleSet *a, const ParticleSet *b,
                      const Grid *grid, bool half, int threads)
{
    bool fits = true;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(&& : fits)
    for (int slab = 0; slab < grid->slab_count; slab++) {
        int first = slab * SLAB_ROWS, last = first + SLAB_ROWS;
        last = last > grid->slab_rows ? grid->slab_rows : last;
        size_t next = (size_t)a->row_begin[first * grid->across_rows] * list->per_cluster + 1;
        size_t end = (size_t)a->row_begin[last * grid->across_rows] * list->per_cluster + 1;
        for (int s = first; s < last && next; s++)
            for (int c = 0; c < grid->across_rows && next; c++)
                next = fill_row(list, a, b, grid, half, s, c, next, end);
        fits = fits && next;
    }
    return fits;
}

bool list_build(ClusterList *list, const ParticleSet *a, const ParticleSet *b, const Grid *grid,
                bool half, int threads)
{
    for (;;) {
        size_t need = (size_t)a->cluster_count * list->per_cluster + 1;
        if (need > list->entry_capacity) {
            size_t capacity = need + need / 8;
            if (capacity > UINT32_MAX) return false;
            uint32_t *grown = realloc(list->entry, capacity * sizeof *grown);
            if (!grown) return false;
            list->entry = grown;
            list->entry_capacity = capacity;
        }
        if (fill_list(list, a, b, grid, half, threads)) return true;
        list->per_cluster += list->per_cluster / 2 + 8;
    }
}
