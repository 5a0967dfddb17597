/// Who is near whom, by boxes: entries of the lists and the visit bits of their particles. Compiled
/// once per instruction level (sweep.h).
#include "backend/sweep.h"

enum { CHUNK = 256 };

/// Whether boxes begin … end - 1 lie within reach of box i.
static void test_boxes(const Boxes *a, int i, const Boxes *b, int begin, int end,
                       float reach_squared, int32_t near[CHUNK])
{
    const int32_t *x_min = b->min[0], *y_min = b->min[1], *z_min = b->min[2];
    const int32_t *x_max = b->max[0], *y_max = b->max[1], *z_max = b->max[2];
    const int32_t low[3] = {a->min[0][i], a->min[1][i], a->min[2][i]};
    const int32_t high[3] = {a->max[0][i], a->max[1][i], a->max[2][i]};
#pragma omp simd
    for (int k = begin; k < end; k++) {
        int32_t bx = x_min[k] - high[0], ax = low[0] - x_max[k];
        int32_t by = y_min[k] - high[1], ay = low[1] - y_max[k];
        int32_t bz = z_min[k] - high[2], az = low[2] - z_max[k];
        bx = bx > ax ? bx : ax;
        by = by > ay ? by : ay;
        bz = bz > az ? bz : az;
        float gx = (float)(bx > 0 ? bx : 0), gy = (float)(by > 0 ? by : 0);
        float gz = (float)(bz > 0 ? bz : 0);
        near[k - begin] = gx * gx + gy * gy + gz * gz < reach_squared;
    }
}

int AT_LEVEL(near_clusters)(const Boxes *a, int i, const Boxes *b, int begin, int end,
                            float reach_squared, uint32_t *entry, int room)
{
    int32_t near[CHUNK];
    int count = 0;
    for (int chunk = begin; chunk < end; chunk += CHUNK) {
        int last = chunk + CHUNK < end ? chunk + CHUNK : end;
        test_boxes(a, i, b, chunk, last, reach_squared, near);
        for (int k = 0; k < last - chunk && count < room; k++) {
            if (entry && near[k]) entry[count] = (uint32_t)(chunk + k);
            count += near[k];
        }
    }
    return count;
}

/// Boxes of one cluster's neighbours, side by side for the vectorised test.
typedef struct Neighbourhood {
    int count;
    int32_t min[3][ENTRIES_MAX], max[3][ENTRIES_MAX];
} Neighbourhood;

static void gather_boxes(Neighbourhood *n, const ClusterList *list, int i, const Boxes *boxes)
{
    const uint32_t *entry = list->entry + list->begin[i];
    int count = (int)list->count[i];
    n->count = count;
    for (int k = 0; k < n->count; k++) {
        uint32_t c = entry[k];
        for (int a = 0; a < 3; a++) {
            n->min[a][k] = boxes->min[a][c];
            n->max[a][k] = boxes->max[a][c];
        }
    }
}

/// Visit bits of one particle: clusters whose box lies within the reach of the point.
static void write_near(const Neighbourhood *n, int32_t x, int32_t y, int32_t z, float reach_squared,
                       uint8_t *bits)
{
    int32_t near[ENTRIES_MAX];
#pragma omp simd
    for (int k = 0; k < n->count; k++) {
        int32_t bx = n->min[0][k] - x, ax = x - n->max[0][k];
        int32_t by = n->min[1][k] - y, ay = y - n->max[1][k];
        int32_t bz = n->min[2][k] - z, az = z - n->max[2][k];
        bx = bx > ax ? bx : ax;
        by = by > ay ? by : ay;
        bz = bz > az ? bz : az;
        float gx = (float)(bx > 0 ? bx : 0), gy = (float)(by > 0 ? by : 0);
        float gz = (float)(bz > 0 ? bz : 0);
        near[k] = gx * gx + gy * gy + gz * gz < reach_squared ? 1 << (k & 7) : 0;
    }
    int bytes = (n->count + 7) / 8;
    for (int k = n->count; k < 8 * bytes; k++)
        near[k] = 0;
    for (int byte = 0; byte < bytes; byte++) {
        int32_t sum = 0;
        for (int k = 0; k < 8; k++)
            sum += near[8 * byte + k];
        bits[byte] = (uint8_t)sum;
    }
}

void AT_LEVEL(near_prune)(ClusterList *list, const ParticleSet *a, const ParticleSet *b, int begin, int end,
                  float reach_squared)
{
    Neighbourhood n;
    for (int i = begin; i < end; i++) {
        if (!list->count[i]) continue;
        gather_boxes(&n, list, i, &b->boxes);
        int bytes = (n.count + 7) / 8;
        for (int l = 0; l < CLUSTER; l++) {
            int slot = i * CLUSTER + l;
            write_near(&n, a->position[0][slot], a->position[1][slot], a->position[2][slot],
                       reach_squared, list->near + list->begin[i] + l * bytes);
        }
    }
}
