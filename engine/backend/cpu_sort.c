/// Sorting particles into rows and clusters: O(N), stable, hence the same for any thread count.
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "backend/particles.h"

Grid grid_create(const double min[3], const double max[3], int dimensions, double support,
                 double skin, double spacing)
{
    Grid grid;
    memset(&grid, 0, sizeof grid);
    double longest = 0;
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = min[a];
        longest = maxd(longest, max[a] - min[a]);
    }
    grid.unit = longest / (COORDINATE_END - 2);
    bool x_first = dimensions == 2 || max[0] - min[0] >= max[1] - min[1];
    grid.slab = x_first ? 0 : 1;
    grid.along = dimensions == 2 ? 2 : (x_first ? 1 : 0);
    grid.across = 3 - grid.slab - grid.along;
    double row = (support + skin) / ROW_REACH;
    grid.row = (int32_t)(row / grid.unit) + 1;
    grid.bin = (int32_t)(0.5 * spacing / grid.unit) + 1;
    int32_t size[3];
    for (int a = 0; a < 3; a++)
        size[a] = (int32_t)((max[a] - min[a]) / grid.unit);
    grid.slab_rows = size[grid.slab] / grid.row + 1;
    grid.across_rows = size[grid.across] / grid.row + 1;
    grid.bins = size[grid.along] / grid.bin + 1;
    grid.slab_count = (grid.slab_rows + SLAB_ROWS - 1) / SLAB_ROWS;
    double reach = (support + skin) / grid.unit;
    grid.reach = (int32_t)reach + 1;
    grid.reach_squared = (float)(reach * reach);
    return grid;
}

size_t grid_key_count(const Grid *grid)
{
    return (size_t)grid->slab_rows * grid->across_rows * grid->bins;
}

bool set_create(ParticleSet *set, const Grid *grid, int count, int field_count, Arena *arena,
                Error *error)
{
    memset(set, 0, sizeof *set);
    set->count = count;
    set->field_count = field_count;
    int rows = grid->slab_rows * grid->across_rows;
    set->slot_capacity =
        (count + count / 2) / CLUSTER * CLUSTER + CLUSTER * (rows < count ? rows : count);
    size_t n = (size_t)set->slot_capacity, clusters = n / CLUSTER;
#define TAKE(pointer, items, type, what)                                                           \
    TRY((pointer) = arena_take(arena, (items), sizeof(type), "particles." what, error))
    for (int a = 0; a < 3; a++) {
        TAKE(set->position[a], n, int32_t, "position");
        TAKE(set->spare_position[a], n, int32_t, "position");
        TAKE(set->rate[a], n, float, "rate");
        TAKE(set->boxes.min[a], clusters, int32_t, "boxes");
        TAKE(set->boxes.max[a], clusters, int32_t, "boxes");
    }
    for (int f = 0; f < (field_count < 3 ? 3 : field_count); f++) {
        TAKE(set->field[f], n, float, "field");
        if (f < field_count) TAKE(set->spare_field[f], n, float, "field");
    }
    TAKE(set->id, n, int32_t, "id");
    TAKE(set->spare_id, n, int32_t, "id");
    TAKE(set->pressure, n, float, "pressure");
    TAKE(set->dynamic, n, float, "dynamic");
    TAKE(set->key, n, int32_t, "key");
    TAKE(set->source, n, int32_t, "source");
    TAKE(set->row_begin, (size_t)rows + 1, int, "rows");
#undef TAKE
    for (size_t i = 0; i < n; i++) {
        set->id[i] = -1;
        for (int a = 0; a < 3; a++)
            set->position[a][i] = PADDING;
    }
    // before the first sort the particles lie in slots 0 … count - 1
    set->cluster_count = (count + CLUSTER - 1) / CLUSTER;
    return true;
}

static int32_t clamp_index(int32_t index, int32_t count)
{
    return index < 0 ? 0 : (index >= count ? count - 1 : index);
}

static void compute_keys(ParticleSet *set, const Grid *grid, int slots, int threads)
{
    const int32_t *s = set->position[grid->slab], *c = set->position[grid->across];
    const int32_t *l = set->position[grid->along];
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int i = 0; i < slots; i++) {
        int32_t row = clamp_index(s[i] / grid->row, grid->slab_rows) * grid->across_rows +
                      clamp_index(c[i] / grid->row, grid->across_rows);
        int32_t key = row * grid->bins + clamp_index(l[i] / grid->bin, grid->bins);
        set->key[i] = set->id[i] < 0 ? -1 : key;
    }
}

/// Old slots in the order of their keys, into set->source[0 … count - 1] (stable).
static void counting_sort(ParticleSet *set, int slots, size_t keys, int32_t *histogram)
{
    memset(histogram, 0, (keys + 1) * sizeof *histogram);
    for (int i = 0; i < slots; i++)
        if (set->key[i] >= 0) histogram[set->key[i] + 1]++;
    for (size_t k = 0; k < keys; k++)
        histogram[k + 1] += histogram[k];
    for (int i = 0; i < slots; i++)
        if (set->key[i] >= 0) set->source[histogram[set->key[i]]++] = i;
}

/// Hand out slots along each row; a cluster ends when full, at the row's end, or at a gap of more
/// than two spacings (else its box would span empty room), as long as slots are left for that
/// luxury. Leaves the old slot of each new slot in spare_id (-1: padding).
static int cut_clusters(ParticleSet *set, const Grid *grid)
{
    int rows = grid->slab_rows * grid->across_rows, slot = 0, row = 0;
    int luxury =
        set->slot_capacity - set->count - CLUSTER * (rows < set->count ? rows : set->count);
    int32_t *from = set->spare_id, last_key = -1;
    for (int n = 0; n < set->count; n++) {
        int32_t key = set->key[set->source[n]];
        int own_row = key / grid->bins;
        bool new_row = n == 0 || own_row != last_key / grid->bins;
        int used = slot % CLUSTER;
        bool gap = !new_row && key - last_key > 4 && used && luxury >= CLUSTER - used;
        if (gap) luxury -= CLUSTER - used;
        if (new_row || gap)
            while (slot % CLUSTER)
                from[slot++] = -1;
        for (; new_row && row <= own_row; row++)
            set->row_begin[row] = slot / CLUSTER;
        from[slot++] = set->source[n];
        last_key = key;
    }
    while (slot % CLUSTER)
        from[slot++] = -1;
    for (; row <= rows; row++)
        set->row_begin[row] = slot / CLUSTER;
    return slot / CLUSTER;
}

static void move_to_slots(ParticleSet *set, int clusters, int threads)
{
    const int32_t *from = set->spare_id;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int slot = 0; slot < clusters * CLUSTER; slot++) {
        int old = from[slot];
        for (int a = 0; a < 3; a++)
            set->spare_position[a][slot] = old < 0 ? PADDING : set->position[a][old];
        for (int f = 0; f < set->field_count; f++)
            set->spare_field[f][slot] = old < 0 ? 0.0f : set->field[f][old];
        set->source[slot] = old < 0 ? -1 : set->id[old];
        set->pressure[slot] = 0;
        set->dynamic[slot] = 0;
    }
    for (int a = 0; a < 3; a++) {
        int32_t *swap = set->position[a];
        set->position[a] = set->spare_position[a];
        set->spare_position[a] = swap;
    }
    for (int f = 0; f < set->field_count; f++) {
        float *swap = set->field[f];
        set->field[f] = set->spare_field[f];
        set->spare_field[f] = swap;
    }
    int32_t *swap = set->id;
    set->id = set->source;
    set->source = swap;
}

void set_sort(ParticleSet *set, const Grid *grid, int32_t *histogram, int threads)
{
    int slots = set->cluster_count * CLUSTER;
    compute_keys(set, grid, slots, threads);
    counting_sort(set, slots, grid_key_count(grid), histogram);
    set->cluster_count = cut_clusters(set, grid);
    move_to_slots(set, set->cluster_count, threads);
}

void set_boxes(ParticleSet *set, int begin, int end)
{
    for (int a = 0; a < 3; a++) {
        const int32_t *p = set->position[a];
        for (int c = begin; c < end; c++) {
            int32_t low = INT_MAX, high = INT_MIN;
#pragma omp simd reduction(min : low) reduction(max : high)
            for (int l = 0; l < CLUSTER; l++) {
                int32_t v = p[c * CLUSTER + l], w = v == PADDING ? INT_MAX : v;
                low = w < low ? w : low;
                high = v > high ? v : high;
            }
            set->boxes.min[a][c] = low;
            set->boxes.max[a][c] = high;
        }
    }
}
