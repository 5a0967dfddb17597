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

/// @param c  the next cluster   @return false when there is none
FN bool visits_next(Visits *v, size_t *c)
{
    while (!v->word) {
        v->bytes -= 8;
        if (v->bytes <= 0) return false;
        v->bits += 8;
        v->entry += 64;
        v->word = visits_word(v);
    }
    *c = v->entry[__builtin_ctzll(v->word)];
    v->word &= v->word - 1;
    return true;
}

/// Go round; the last of a function. Each visit ends after the next one has begun, when the place
/// of the one after that is known, so that nobody waits for roots and quotients. Two visits take
/// turns, because to move one to the other costs a tenth of it; it returns where it is done, which
/// gcc takes for rare, and is right (docs/performance.md).
/// @param Visit     type of what is begun    @param BEGIN(c)  begins a visit of cluster c
/// @param END(v)    ends it; they end in the order in which they began
#define VISIT_ALL(visits, Visit, BEGIN, END)                                                       \
    size_t next, c;                                                                                \
    if (!visits_next(&(visits), &next)) return;                                                    \
    Visit even = BEGIN(next), odd;                                                                 \
    for (bool more = visits_next(&(visits), &next);;) {                                            \
        if (!more) {                                                                               \
            END(&even);                                                                            \
            return;                                                                                \
        }                                                                                          \
        c = next;                                                                                  \
        more = visits_next(&(visits), &next);                                                      \
        odd = BEGIN(c);                                                                            \
        END(&even);                                                                                \
        if (!more) {                                                                               \
            END(&odd);                                                                             \
            return;                                                                                \
        }                                                                                          \
        c = next;                                                                                  \
        more = visits_next(&(visits), &next);                                                      \
        even = BEGIN(c);                                                                           \
        END(&odd);                                                                                 \
    }

/// What sweeps read and write of a set, out of reach of stores to it.
typedef struct Arrays {
    const Octet *octet;
    float *rate[3];
} Arrays;

FN Arrays arrays_of(const ParticleSet *set)
{
    Arrays a = {set->octet, {set->rate[0], set->rate[1], set->rate[2]}};
    return a;
}

/// One particle in all lanes.
typedef struct Self {
    IntLanes x, y, z;
    Lanes u, v, w, pressure;
} Self;

/// @param i  its slot
FN Self self_of(const Arrays *a, int i)
{
    const Octet *own = &a->octet[(unsigned)i / CLUSTER];
    const unsigned l = (unsigned)i % CLUSTER;
    Self self;
    self.x = lanes_all_int(own->position[0][l]);
    self.y = lanes_all_int(own->position[1][l]);
    self.z = lanes_all_int(own->position[2][l]);
    self.u = lanes_all(own->velocity[0][l]);
    self.v = lanes_all(own->velocity[1][l]);
    self.w = lanes_all(own->velocity[2][l]);
    self.pressure = lanes_all(own->pressure[l]);
    return self;
}

/// x_ik of one particle and eight others [unit].
typedef struct Offset {
    Lanes x, y, z;
} Offset;

FN Offset offset_to(const Self *self, const Octet *other)
{
    Offset d;
    d.x = lanes_from_int(self->x - lanes_load_int(other->position[0]));
    d.y = lanes_from_int(self->y - lanes_load_int(other->position[1]));
    d.z = lanes_from_int(self->z - lanes_load_int(other->position[2]));
    return d;
}

FN Lanes offset_square(Offset d) { return d.x * d.x + d.y * d.y + d.z * d.z; }

/// v_ik . x_ik
FN Lanes approach_of(const Self *self, const Octet *other, Offset d)
{
    return (self->u - lanes_load(other->velocity[0])) * d.x +
           (self->v - lanes_load(other->velocity[1])) * d.y +
           (self->w - lanes_load(other->velocity[2])) * d.z;
}

/// P_i + P_k
FN Lanes pressures_of(const Self *self, const Octet *other)
{
    return self->pressure + lanes_load(other->pressure);
}

/// Let cluster c feel a force on the particle that visits it.
FN void react(const Arrays *a, size_t c, Lanes force, Offset d)
{
    const size_t base = c * CLUSTER;
    lanes_store(a->rate[0] + base, lanes_load(a->rate[0] + base) - force * d.x);
    lanes_store(a->rate[1] + base, lanes_load(a->rate[1] + base) - force * d.y);
    lanes_store(a->rate[2] + base, lanes_load(a->rate[2] + base) - force * d.z);
}

FN bool has_walls(const Sweep *sweep, int set, int i)
{
    return sweep->walls[set]->count && sweep->fluid_wall[set]->count[i];
}

#endif
