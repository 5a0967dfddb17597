/// Lists of neighbouring clusters, rebuilt when the particles have moved half the skin.
#include <stdlib.h>
#include <string.h>

#include "backend/particles.h"

bool list_create(ClusterList *list, const ParticleSet *a, Arena *arena, Error *error)
{
    memset(list, 0, sizeof *list);
    size_t clusters = (size_t)a->slot_capacity / CLUSTER;
    TRY(list->begin = arena_take(arena, clusters, sizeof(uint32_t), "list.begin", error));
    TRY(list->count = arena_take(arena, clusters, sizeof(uint32_t), "list.count", error));
    return true;
}

void list_destroy(ClusterList *list)
{
    free(list->entry);
    free(list->near);
}

size_t list_bytes(const ClusterList *list)
{
    return list->entry_capacity * (sizeof *list->entry + sizeof *list->near);
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
        int32_t below = b->min[axis][k] - a->max[axis][i];
        int32_t above = a->min[axis][i] - b->max[axis][k];
        int32_t gap = below > above ? below : above;
        float g = gap > 0 ? (float)gap : 0.0f;
        sum += g * g;
    }
    return sum;
}

/// Neighbours of the clusters of one row; counts them when the list has no place for them yet.
static void fill_row(ClusterList *list, const ParticleSet *a, const ParticleSet *b,
                     const Grid *grid, bool half, int row, bool count_only)
{
    Window windows[(2 * ROW_REACH + 1) * (2 * ROW_REACH + 1)];
    if (a->row_begin[row] == a->row_begin[row + 1]) return;
    int windows_open =
        open_windows(b, grid, row / grid->across_rows, row % grid->across_rows, half, windows);
    int along = grid->along;
    // clusters of a row are sorted by bin: their ends may overlap by one
    int32_t slack = grid->reach + grid->bin;
    for (int i = a->row_begin[row]; i < a->row_begin[row + 1]; i++) {
        uint32_t *entry = count_only ? NULL : list->entry + list->begin[i], count = 0;
        int32_t low = a->boxes.min[along][i] - slack, high = a->boxes.max[along][i] + slack;
        for (int w = 0; w < windows_open; w++) {
            int k = windows[w].cluster;
            while (k < windows[w].end && b->boxes.max[along][k] < low - grid->bin)
                k++;
            windows[w].cluster = k;
            for (; k < windows[w].end && b->boxes.min[along][k] <= high && count < ENTRIES_MAX; k++) {
                if (half && k <= i) continue;
                if (box_gap(&a->boxes, i, &b->boxes, k) >= grid->reach_squared) continue;
                if (entry) entry[count] = (uint32_t)k;
                count++;
            }
        }
        list->count[i] = count;
    }
}

static bool make_room(ClusterList *list, int clusters)
{
    size_t need = 0;
    for (int i = 0; i < clusters; i++) {
        list->begin[i] = (uint32_t)need;
        need += (list->count[i] + 7) / 8 * 8;
    }
    list->entry_count = need;
    if (need + 8 > list->entry_capacity) {
        size_t capacity = need + need / 8 + 64;
        if (capacity > UINT32_MAX) return false;
        // the old entries are worthless: no need to copy them
        list_destroy(list);
        list->entry = malloc(capacity * sizeof *list->entry);
        list->near = malloc(capacity * sizeof *list->near);
        list->entry_capacity = list->entry && list->near ? capacity : 0;
    }
    return list->entry_capacity > 0;
}

bool list_build(ClusterList *list, const ParticleSet *a, const ParticleSet *b, const Grid *grid,
                bool half, int threads)
{
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads)
    for (int row = 0; row < grid->row_count; row++)
        fill_row(list, a, b, grid, half, row, true);
    if (!make_room(list, a->cluster_count)) return false;
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads)
    for (int row = 0; row < grid->row_count; row++)
        fill_row(list, a, b, grid, half, row, false);
    return true;
}
