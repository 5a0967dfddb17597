/// Lists of neighbouring clusters, rebuilt when the particles have moved half the skin.
#include <stdlib.h>
#include <string.h>

#include "backend/sweep.h"

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

/// Neighbours of the clusters of one row; counts them when the list has no place for them yet.
static void fill_row(const ListOrder *order, int row, bool count_only)
{
    const ParticleSet *a = order->a, *b = order->b;
    const Grid *grid = order->grid;
    Window windows[(2 * ROW_REACH + 1) * (2 * ROW_REACH + 1)];
    if (a->row_begin[row] == a->row_begin[row + 1]) return;
    int opened = open_windows(b, grid, row / grid->across_rows, row % grid->across_rows,
                              order->half, windows);
    const int32_t *a_min = a->boxes.min[grid->along], *a_max = a->boxes.max[grid->along];
    const int32_t *b_min = b->boxes.min[grid->along], *b_max = b->boxes.max[grid->along];
    // clusters of a row are sorted by bin: their ends may overlap by one
    int32_t slack = grid->reach + grid->bin;
    for (int i = a->row_begin[row]; i < a->row_begin[row + 1]; i++) {
        uint32_t *entry = count_only ? NULL : order->list->entry + order->list->begin[i];
        int32_t low = a_min[i] - slack, high = a_max[i] + slack;
        int count = 0;
        for (int w = 0; w < opened; w++) {
            int begin = windows[w].cluster, end;
            while (begin < windows[w].end && b_max[begin] < low - grid->bin)
                begin++;
            windows[w].cluster = begin;
            if (order->half && begin <= i) begin = i + 1;
            for (end = begin; end < windows[w].end && b_min[end] <= high;)
                end++;
            count += order->near_clusters(&a->boxes, i, &b->boxes, begin, end, grid->reach_squared,
                                          entry ? entry + count : NULL, ENTRIES_MAX - count);
        }
        order->list->count[i] = (uint32_t)count;
    }
}

static bool make_room(ClusterList *list, int clusters)
{
    size_t need = 0;
    for (int i = 0; i < clusters; i++) {
        list->begin[i] = (uint32_t)need;
        need += (list->count[i] + 7) / 8 * 8;
    }
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

bool list_build(const ListOrder *order, int threads)
{
    int rows = order->grid->row_count;
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads)
    for (int row = 0; row < rows; row++)
        fill_row(order, row, true);
    if (!make_room(order->list, order->a->cluster_count)) return false;
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads)
    for (int row = 0; row < rows; row++)
        fill_row(order, row, false);
    return true;
}
