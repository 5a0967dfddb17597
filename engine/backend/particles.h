/// Particles of the CPU backend, in padded clusters of eight. What every sweep reads lies together,
/// cluster by cluster (Octet); the rest is an array each, by slot.
///
/// Positions are 32-bit fixed-point numbers in `Grid.unit`; differences are exact, so accuracy does
/// not depend on the distance from the origin (float positions lose it in a long tank,
/// docs/performance.md). Particles are sorted into *rows*: square columns of side `Grid.row` along
/// one axis, cut into clusters of CLUSTER slots; slots without a particle lie at PADDING, out of
/// everybody's reach.
#ifndef FAIRLEAD_BACKEND_PARTICLES_H
#define FAIRLEAD_BACKEND_PARTICLES_H

#include <stdint.h>

#include "base/arena.h"
#include "base/built.h"
#include "physics/pair.h"

enum { CLUSTER = 8, ROW_REACH = 2, SLAB_ROWS = 2 };
enum { BLOCKS_MAX = 4 };
enum { ENTRIES_MAX = 2048 }; ///< neighbours a cluster may have; only collapsed water has more
#define PADDING (-(1 << 30)) ///< coordinate of an empty slot [unit]; real ones are in [0, 2^30)
#define COORDINATE_END (1 << 30)

/// How space is cut. Rows are half of support + skin wide, so neighbours lie within ROW_REACH rows.
/// Axis `slab` is the longest lateral one: slabs of SLAB_ROWS rows, cut into blocks, are the units
/// of parallel work; a half list reaches only into the own and the next slab.
typedef struct Grid {
    double origin[3];        ///< world position of coordinate 0 [m]
    double unit;             ///< [m]
    int slab, across, along; ///< axes: 0 x, 1 y, 2 z
    int32_t row;             ///< side of a row [unit]
    int32_t bin;             ///< sorting bin along the row [unit]
    int slab_rows, across_rows, bins;
    int slab_count, row_count;
    int blocks;          ///< parts of a slab side by side, each a task
    float reach_squared; ///< (support + skin)^2 [unit^2]
    int32_t reach;       ///< support + skin [unit]
} Grid;

/// Bounding boxes of clusters [unit]; min > max when empty.
typedef struct Boxes {
    int32_t *min[3], *max[3]; ///< [cluster capacity]
} Boxes;

/// A cluster's particles as the sweeps read them: four cache lines at one address. In arrays of
/// their own they were ten lines at ten addresses, more than there are registers for.
typedef struct Octet {
    int32_t position[3][CLUSTER]; ///< [unit]; PADDING where nobody is
    float velocity[3][CLUSTER];   ///< [m/s]
    float excess[CLUSTER];        ///< fluid: rho/rho0 - 1
    float pressure[CLUSTER];      ///< P = p/rho^2 [Pa m^6/kg^2]; 0 in padding
} Octet;
enum { OCTET_DUMMY = 6, OCTET_FLUID = 7 }; ///< arrays of it that are sorted and saved

/// One set: fluid, fixed dummies, or moving dummies. Slots in use: cluster_count * CLUSTER.
typedef struct ParticleSet {
    int count;              ///< particles
    int slot_capacity;      ///< multiple of CLUSTER
    int cluster_count;      ///< in use
    int kept;               ///< OCTET_…
    Octet *octet;           ///< [slot_capacity / CLUSTER]
    int32_t *id;            ///< index at creation, -1 in padding
    float *dynamic;         ///< fluid: D = diffusion * (density excess less its hydrostatic part)
    float *rate[3];         ///< sums of the sweeps; fixed: none
    float *acceleration[3]; ///< moving, sorted: [m/s^2]
    float *correction[6];   ///< fluid, with PAIR_GRADIENT: B of physics/gradient.h
    float *stress[6];       ///< fluid, with PAIR_TURBULENCE: tau/rho^2 of physics/viscous.h
    float *shift[4];        ///< fluid, with PAIR_SHIFTING: u of physics/shift.h [m/s], fullness
    float *mirror[3];       ///< dummies, with PAIR_NO_SLIP: velocity that viscosity meets [m/s]
    int32_t *target[3];     ///< moving: places at the end of the step [unit]
    Boxes boxes;
    int *row_begin; ///< [rows + 1] first cluster of each row
} ParticleSet;

/// Memory that sorting borrows; slots of the largest set. Between sorts the fluid's rates live in
/// it.
typedef struct SortScratch {
    int32_t *slot[3];   ///< [largest slot_capacity]
    int32_t *histogram; ///< [threads][rows or bins, whichever is more]
    int *row_first;     ///< [rows + 1]
    size_t histogram_size;
    int threads;
} SortScratch;

/// For every cluster of one set the clusters of another within reach, and for each of its
/// particles which of them to visit: bit k of the bytes at `near + begin + l * ceil(count/8)` says
/// that particle l visits entry k. The entries hold until particles have moved by the skin, the
/// bits (a byte an entry, all eight particles together) until they have moved by a smaller margin.
typedef struct ClusterList {
    uint32_t *begin; ///< [cluster capacity] first entry, a multiple of 8
    uint32_t *count; ///< [cluster capacity]
    uint32_t *entry; ///< malloc'ed: grows, rarely, when a sort finds more neighbours
    uint8_t *near;   ///< [entry_capacity] visit bits
    size_t entry_capacity;
} ClusterList;

/// Cut the box [min, max] (metres) into rows for the given support (2h) and skin [m].
Grid grid_create(const double min[3], const double max[3], int dimensions, double support,
                 double skin, double spacing);

/// Arrays of a set, all but its rates, accelerations and targets. @param kept  OCTET_…
bool set_create(ParticleSet *set, const Grid *grid, int count, int kept, Arena *arena,
                Error *error);

bool scratch_create(SortScratch *scratch, const Grid *grid, int slots, int threads, Arena *arena,
                    Error *error);
/// Sort by row and bin and cut into clusters; positions, fields and ids follow.
void set_sort(ParticleSet *set, const Grid *grid, SortScratch *scratch);

/// Boxes of clusters begin..end from the present positions.
void set_boxes(ParticleSet *set, int begin, int end);

bool list_create(ClusterList *list, const ParticleSet *a, Arena *arena, Error *error);
void list_destroy(ClusterList *list);
size_t list_bytes(const ClusterList *list); ///< malloc'ed

static inline int32_t to_coordinate(const Grid *grid, int axis, double metres)
{
    double c = floor((metres - grid->origin[axis]) / grid->unit + 0.5);
    return (int32_t)(c < 0 ? 0 : (c > COORDINATE_END - 1 ? COORDINATE_END - 1 : c));
}
static inline double to_metres(const Grid *grid, int axis, int32_t coordinate)
{
    return grid->origin[axis] + grid->unit * coordinate;
}

// One particle's, by slot; for loops that are not worth going by clusters.
static inline int32_t *position_of(const ParticleSet *set, int axis, int slot)
{
    return &set->octet[(unsigned)slot / CLUSTER].position[axis][(unsigned)slot % CLUSTER];
}
static inline float *velocity_of(const ParticleSet *set, int axis, int slot)
{
    return &set->octet[(unsigned)slot / CLUSTER].velocity[axis][(unsigned)slot % CLUSTER];
}
static inline float *excess_of(const ParticleSet *set, int slot)
{
    return &set->octet[(unsigned)slot / CLUSTER].excess[(unsigned)slot % CLUSTER];
}
static inline float *pressure_of(const ParticleSet *set, int slot)
{
    return &set->octet[(unsigned)slot / CLUSTER].pressure[(unsigned)slot % CLUSTER];
}
/// Where a particle is [m].
static inline Vec3 place_of(const Grid *grid, const ParticleSet *set, int slot)
{
    return vec3(to_metres(grid, 0, *position_of(set, 0, slot)),
                to_metres(grid, 1, *position_of(set, 1, slot)),
                to_metres(grid, 2, *position_of(set, 2, slot)));
}

#endif
