/// Who is near whom, by boxes: entries of the lists and the visit bits of their particles. Compiled
/// once per instruction level (sweep.h).
#include "backend/lanes.h"
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

/// A cluster's particles, a lane each.
typedef struct Points {
    IntLanes x, y, z;
} Points;

/// How far each particle lies outside of a box along one axis; 0 inside [unit].
FN Lanes outside(IntLanes x, int32_t min, int32_t max)
{
    IntLanes below = min - x, above = x - max;
    return lanes_from_int(lanes_max_int(lanes_max_int(below, above), lanes_all_int(0)));
}

/// Which of the points have one of a cluster's particles within reach: all bits of their lanes.
FN IntLanes near_particles(const Points *p, const ParticleSet *set, uint32_t c, float reach_squared)
{
    IntLanes near = lanes_all_int(0);
    const Octet *o = &set->octet[c];
    for (int k = 0; k < CLUSTER; k++) {
        Lanes dx = lanes_from_int(p->x - o->position[0][k]);
        Lanes dy = lanes_from_int(p->y - o->position[1][k]);
        Lanes dz = lanes_from_int(p->z - o->position[2][k]);
        near |= dx * dx + dy * dy + dz * dz < reach_squared;
    }
    return near;
}

/// Which of the 32 entries each particle visits: a bit each. `exact`: one of the cluster's
/// particles is within reach, not only its box.
FN IntLanes visit_bits(const Points *p, const ParticleSet *set, const uint32_t *entry, int count,
                       float reach_squared, bool exact)
{
    const Boxes *boxes = &set->boxes;
    IntLanes bits = lanes_all_int(0);
    for (int k = 0; k < count; k++) {
        uint32_t c = entry[k];
        Lanes gx = outside(p->x, boxes->min[0][c], boxes->max[0][c]);
        Lanes gy = outside(p->y, boxes->min[1][c], boxes->max[1][c]);
        Lanes gz = outside(p->z, boxes->min[2][c], boxes->max[2][c]);
        IntLanes near = gx * gx + gy * gy + gz * gz < reach_squared;
        if (exact) near &= near_particles(p, set, c, reach_squared);
        bits |= near & (int32_t)(UINT32_C(1) << k);
    }
    return bits;
}

FN void prune(ClusterList *list, const ParticleSet *a, const ParticleSet *b, int i,
              float reach_squared, bool exact)
{
    const uint32_t *entry = list->entry + list->begin[i];
    int count = (int)list->count[i], bytes = (count + 7) / 8;
    uint8_t *bits = list->near + list->begin[i];
    const Octet *eight = &a->octet[i];
    const Points p = {lanes_load_int(eight->position[0]), lanes_load_int(eight->position[1]),
                      lanes_load_int(eight->position[2])};
    for (int k = 0; k < count; k += 32) {
        int entries = count - k < 32 ? count - k : 32;
        IntLanes word = visit_bits(&p, b, entry + k, entries, reach_squared, exact);
        size_t size = (size_t)(entries + 7) / 8;
        for (int l = 0; l < CLUSTER; l++) {
            int32_t own = word[l];
            memcpy(bits + l * bytes + k / 8, &own, size); // little-endian, checked in lanes.h
        }
    }
}

void AT_LEVEL(near_prune)(ClusterList *list, const ParticleSet *a, const ParticleSet *b, int begin,
                          int end, float reach_squared, bool exact)
{
    if (exact)
        for (int i = begin; i < end; i++)
            prune(list, a, b, i, reach_squared, true);
    else
        for (int i = begin; i < end; i++)
            prune(list, a, b, i, reach_squared, false);
}
