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
    grid.row_count = grid.slab_rows * grid.across_rows;
    // a block reaches into the one beside it only if it is as wide as the reach
    grid.blocks = grid.across_rows / (4 * ROW_REACH);
    grid.blocks = grid.blocks < 1 ? 1 : (grid.blocks > BLOCKS_MAX ? BLOCKS_MAX : grid.blocks);
    double reach = (support + skin) / grid.unit;
    grid.reach = (int32_t)reach + 1;
    grid.reach_squared = (float)(reach * reach);
    return grid;
}

/// Slots a row may spend on ending clusters early at gaps.
static int row_luxury(int count) { return CLUSTER + count / 8; }

static int slots_for(const Grid *grid, int count)
{
    // each occupied row: its particles, its luxury, the padding of its last cluster
    int rows = grid->row_count < count ? grid->row_count : count;
    return (count + count / 8) / CLUSTER * CLUSTER + CLUSTER * (2 * rows + 2);
}

bool set_create(ParticleSet *set, const Grid *grid, int count, int kept, Arena *arena, Error *error)
{
    memset(set, 0, sizeof *set);
    set->count = count;
    set->kept = kept;
    set->slot_capacity = slots_for(grid, count);
    size_t n = (size_t)set->slot_capacity, clusters = n / CLUSTER;
#define TAKE(pointer, items, type, what)                                                           \
    TRY((pointer) = arena_take(arena, (items), sizeof(type), "particles." what, error))
    TAKE(set->octet, clusters, Octet, "octet");
    for (int a = 0; a < 3; a++) {
        TAKE(set->boxes.min[a], clusters, int32_t, "boxes");
        TAKE(set->boxes.max[a], clusters, int32_t, "boxes");
    }
    TAKE(set->id, n, int32_t, "id");
    TAKE(set->row_begin, (size_t)grid->row_count + 1, int, "rows");
#undef TAKE
    // before the first sort the particles lie in slots 0 … count - 1
    set->cluster_count = (count + CLUSTER - 1) / CLUSTER;
    for (int i = count; i < set->cluster_count * CLUSTER; i++) {
        set->id[i] = -1;
        for (int a = 0; a < 3; a++)
            *position_of(set, a, i) = PADDING;
    }
    return true;
}

bool scratch_create(SortScratch *scratch, const Grid *grid, int slots, int threads, Arena *arena,
                    Error *error)
{
    int most = grid->row_count > grid->bins ? grid->row_count : grid->bins;
    scratch->threads = threads;
    scratch->histogram_size = (size_t)most + 1;
    for (int a = 0; a < 3; a++)
        TRY(scratch->slot[a] =
                arena_take(arena, (size_t)slots, sizeof(int32_t), "particles.rate", error));
    TRY(scratch->histogram = arena_take(arena, (size_t)threads * scratch->histogram_size,
                                        sizeof(int32_t), "sort.histogram", error));
    TRY(scratch->row_first =
            arena_take(arena, (size_t)grid->row_count + 1, sizeof(int), "sort.rows", error));
    return true;
}

static int32_t clamp_index(int32_t index, int32_t count)
{
    return index < 0 ? 0 : (index >= count ? count - 1 : index);
}

/// A set being sorted. `bin` and `row` by old slot; `order` old slots by row, then by row and bin.
typedef struct Sorting {
    ParticleSet *set;
    const Grid *grid;
    SortScratch *scratch;
    int32_t *bin, *row, *order;
    int slots; ///< in use before
} Sorting;

/// Slots of part t, in whole clusters: parts stand in the order of their slots, so that the sort is
/// stable and its result the same for any number of threads.
static int part_begin(const Sorting *s, int t)
{
    return (int)((int64_t)(s->slots / CLUSTER) * t / s->scratch->threads) * CLUSTER;
}

static void count_rows(const Sorting *s, int t)
{
    const Grid *grid = s->grid;
    const ParticleSet *set = s->set;
    int32_t *histogram = s->scratch->histogram + (size_t)t * s->scratch->histogram_size;
    memset(histogram, 0, (size_t)grid->row_count * sizeof *histogram);
    for (int i = part_begin(s, t); i < part_begin(s, t + 1); i++) {
        if (set->id[i] < 0) continue;
        int32_t slab = *position_of(set, grid->slab, i),
                across = *position_of(set, grid->across, i);
        int32_t row = clamp_index(slab / grid->row, grid->slab_rows) * grid->across_rows +
                      clamp_index(across / grid->row, grid->across_rows);
        s->row[i] = row;
        s->bin[i] = clamp_index(*position_of(set, grid->along, i) / grid->bin, grid->bins);
        histogram[row]++;
    }
}

static void place_rows(const Sorting *s)
{
    int next = 0;
    for (int row = 0; row < s->grid->row_count; row++) {
        s->scratch->row_first[row] = next;
        for (int t = 0; t < s->scratch->threads; t++) {
            int32_t *count = s->scratch->histogram + (size_t)t * s->scratch->histogram_size + row;
            int first = next;
            next += *count;
            *count = first;
        }
    }
    s->scratch->row_first[s->grid->row_count] = next;
}

static void scatter_to_rows(const Sorting *s, int t)
{
    int32_t *next = s->scratch->histogram + (size_t)t * s->scratch->histogram_size;
    for (int i = part_begin(s, t); i < part_begin(s, t + 1); i++)
        if (s->set->id[i] >= 0) s->order[next[s->row[i]]++] = i;
}

/// Sort one row by bin: from `order` into `to`, both by place.
static void sort_row(const Sorting *s, int row, int32_t *histogram, int32_t *to)
{
    int begin = s->scratch->row_first[row], end = s->scratch->row_first[row + 1];
    if (begin == end) return;
    memset(histogram, 0, ((size_t)s->grid->bins + 1) * sizeof *histogram);
    for (int n = begin; n < end; n++)
        histogram[s->bin[s->order[n]] + 1]++;
    for (int k = 0; k < s->grid->bins; k++)
        histogram[k + 1] += histogram[k];
    for (int n = begin; n < end; n++)
        to[begin + histogram[s->bin[s->order[n]]]++] = s->order[n];
}

/// Hand out the slots of one row; a cluster ends when full, at the row's end, or at a gap of more
/// than two spacings (else its box would span empty room), as long as slots are left for that
/// luxury. @param from  old slot of each new slot from row's first (-1: padding), or NULL to count
/// @return slots
static int cut_row(const Sorting *s, const int32_t *sorted, int row, int32_t *from)
{
    int begin = s->scratch->row_first[row], end = s->scratch->row_first[row + 1];
    int slot = 0, luxury = row_luxury(end - begin);
    for (int n = begin; n < end; n++) {
        int used = slot % CLUSTER;
        bool gap = n > begin && used && s->bin[sorted[n]] - s->bin[sorted[n - 1]] > 4;
        if (gap && luxury >= CLUSTER - used) {
            luxury -= CLUSTER - used;
            for (; slot % CLUSTER; slot++)
                if (from) from[slot] = -1;
        }
        if (from) from[slot] = sorted[n];
        slot++;
    }
    for (; slot % CLUSTER; slot++)
        if (from) from[slot] = -1;
    return slot;
}

/// Bring one array (of int32_t or float) into the new order. @param pitch  from a cluster's eight
/// to the next one's [byte]
static void gather(void *array, size_t pitch, int32_t *spare, const int32_t *from, int slots,
                   int32_t padding)
{
    char *first = array;
#define ITEM(slot)                                                                                 \
    (first + (size_t)(slot) / CLUSTER * pitch + (size_t)(slot) % CLUSTER * sizeof *spare)
#pragma omp for schedule(static)
    for (int i = 0; i < slots; i++) {
        int32_t value = padding;
        if (from[i] >= 0) memcpy(&value, ITEM(from[i]), sizeof value);
        spare[i] = value;
    }
#pragma omp for schedule(static)
    for (int i = 0; i < slots; i++)
        memcpy(ITEM(i), &spare[i], sizeof *spare);
#undef ITEM
}

static void gather_all(ParticleSet *set, int32_t *spare, const int32_t *from, int slots)
{
    const size_t octet = sizeof *set->octet, plain = CLUSTER * sizeof *spare;
    for (int k = 0; k < set->kept; k++) // positions come first
        gather((char *)set->octet + (size_t)k * plain, octet, spare, from, slots,
               k < 3 ? PADDING : 0);
    for (int a = 0; a < 3 && set->acceleration[a]; a++)
        gather(set->acceleration[a], plain, spare, from, slots, 0);
    gather(set->id, plain, spare, from, slots, -1);
}

void set_sort(ParticleSet *set, const Grid *grid, SortScratch *scratch)
{
    int rows = grid->row_count, slots = 0;
    Sorting s = {set,
                 grid,
                 scratch,
                 scratch->slot[0],
                 scratch->slot[1],
                 scratch->slot[2],
                 set->cluster_count * CLUSTER};
    // an array is dead when the next stage needs room: rows become the sorted order, then
    // `order` becomes the old slot of each new slot, and the bins the spare of the gathering
    int32_t *sorted = s.row, *from = s.order, *spare = s.bin;
#pragma omp parallel num_threads(scratch->threads)
    {
#pragma omp for schedule(static, 1)
        for (int t = 0; t < scratch->threads; t++)
            count_rows(&s, t);
#pragma omp single
        place_rows(&s);
#pragma omp for schedule(static, 1)
        for (int t = 0; t < scratch->threads; t++)
            scatter_to_rows(&s, t);
#pragma omp for schedule(static, 1)
        for (int t = 0; t < scratch->threads; t++)
            for (int row = t; row < rows; row += scratch->threads)
                sort_row(&s, row, scratch->histogram + (size_t)t * scratch->histogram_size, sorted);
#pragma omp for schedule(dynamic, 16)
        for (int row = 0; row < rows; row++)
            set->row_begin[row] = cut_row(&s, sorted, row, NULL) / CLUSTER;
#pragma omp single
        {
            for (int row = 0; row < rows; row++) {
                int clusters = set->row_begin[row];
                set->row_begin[row] = slots / CLUSTER;
                slots += clusters * CLUSTER;
            }
            set->row_begin[rows] = set->cluster_count = slots / CLUSTER;
        }
#pragma omp for schedule(dynamic, 16)
        for (int row = 0; row < rows; row++)
            cut_row(&s, sorted, row, from + set->row_begin[row] * CLUSTER);
        gather_all(set, spare, from, slots);
    }
}

void set_boxes(ParticleSet *set, int begin, int end)
{
    for (int c = begin; c < end; c++) {
        for (int a = 0; a < 3; a++) {
            const int32_t *p = set->octet[c].position[a];
            int32_t low = INT_MAX, high = INT_MIN;
#pragma omp simd reduction(min : low) reduction(max : high)
            for (int l = 0; l < CLUSTER; l++) {
                int32_t v = p[l], w = v == PADDING ? INT_MAX : v;
                low = w < low ? w : low;
                high = v > high ? v : high;
            }
            set->boxes.min[a][c] = low;
            set->boxes.max[a][c] = high;
        }
    }
}
