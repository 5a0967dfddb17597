/// How a sweep goes round: the clusters that a particle visits, the arrays it reads there, and the
/// offsets to eight neighbours at once. For files that are compiled once per instruction level.
#ifndef FAIRLEAD_BACKEND_VISITS_H
#define FAIRLEAD_BACKEND_VISITS_H

#include "backend/lanes.h"

#include <string.h>

#include "backend/sweep.h"

/// The clusters that a particle visits, one after the other. Reading a bit runs beside the
/// arithmetic of the visit before; written out first, the visits cost a tenth more.
typedef struct Visits {
    const uint32_t *entry; ///< that bit 0 of `word` stands for
    uint64_t word;         ///< bits not yet visited
    const uint8_t *bits;   ///< those in `word`
    int bytes;             ///< from those in `word` to the end
} Visits;

FN uint64_t visits_word(const Visits *v)
{
    uint64_t word;
    memcpy(&word, v->bits, sizeof word); // the list ends in spare bytes
    return v->bytes < 8 ? word & ((UINT64_C(1) << 8 * v->bytes) - 1) : word;
}

FN Visits visits_of(const ClusterList *list, int i, int l)
{
    Visits v;
    v.bytes = ((int)list->count[i] + 7) / 8;
    v.entry = list->entry + list->begin[i];
    v.bits = list->near + list->begin[i] + l * v.bytes;
    v.word = visits_word(&v);
    return v;
}

/// @param base  first slot of the next cluster   @return false when there is none
FN bool visits_next(Visits *v, size_t *base)
{
    while (!v->word) {
        v->bytes -= 8;
        if (v->bytes <= 0) return false;
        v->bits += 8;
        v->entry += 64;
        v->word = visits_word(v);
    }
    *base = (size_t)v->entry[__builtin_ctzll(v->word)] * CLUSTER;
    v->word &= v->word - 1;
    return true;
}

/// Arrays of a set, out of reach of stores to them.
typedef struct Arrays {
    const int32_t *x, *y, *z;
    const float *u, *v, *w, *pressure, *dynamic, *excess;
    float *rate[3];
} Arrays;

FN Arrays arrays_of(const ParticleSet *set)
{
    Arrays a = {set->position[0],       set->position[1],
                set->position[2],       set->field[VELOCITY_X],
                set->field[VELOCITY_Y], set->field[VELOCITY_Z],
                set->pressure,          set->dynamic,
                set->field[EXCESS],     {set->rate[0], set->rate[1], set->rate[2]}};
    return a;
}

/// One particle in all lanes.
typedef struct Self {
    IntLanes x, y, z;
    Lanes u, v, w, pressure, dynamic;
} Self;

FN Self self_of(const Arrays *a, int i)
{
    Self self;
    self.x = lanes_all_int(a->x[i]);
    self.y = lanes_all_int(a->y[i]);
    self.z = lanes_all_int(a->z[i]);
    self.u = lanes_all(a->u[i]);
    self.v = lanes_all(a->v[i]);
    self.w = lanes_all(a->w[i]);
    self.pressure = lanes_all(a->pressure[i]);
    self.dynamic = lanes_all(a->dynamic[i]);
    return self;
}

/// x_ik of one particle and eight others [unit].
typedef struct Offset {
    Lanes x, y, z;
} Offset;

FN Offset offset_to(const Self *self, const Arrays *other, size_t base)
{
    Offset d;
    d.x = lanes_from_int(self->x - lanes_load_int(other->x + base));
    d.y = lanes_from_int(self->y - lanes_load_int(other->y + base));
    d.z = lanes_from_int(self->z - lanes_load_int(other->z + base));
    return d;
}

FN Lanes offset_square(Offset d) { return d.x * d.x + d.y * d.y + d.z * d.z; }

/// v_ik . x_ik
FN Lanes approach_of(const Self *self, const Arrays *other, size_t base, Offset d)
{
    return (self->u - lanes_load(other->u + base)) * d.x +
           (self->v - lanes_load(other->v + base)) * d.y +
           (self->w - lanes_load(other->w + base)) * d.z;
}

FN bool has_walls(const Sweep *sweep, int set, int i)
{
    return sweep->walls[set]->count && sweep->fluid_wall[set]->count[i];
}

#endif
