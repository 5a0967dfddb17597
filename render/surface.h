/// The free surface as a height field made from the particles: the top of every column, averaged
/// with a kernel and carried smoothly through floating bodies. Pure C, knows no GL.
///
/// 1. Columns of about 2 dp take the mean of their highest layer, from their three highest
///    particles: a lone drop of spray does not lift the surface.
/// 2. Each node of a finer grid takes the kernel-weighted mean of the particles at the top of their
///    columns, plus dp/2, because a particle stands for the water dp/2 around it.
/// 3. Nodes whose column is filled by a body take a harmonic continuation of the water around it,
///    so that the surface meets the hull; columns without water and without body are dry.
/// 4. Binomial smoothing over about one dp.
#ifndef FAIRLEAD_SURFACE_H
#define FAIRLEAD_SURFACE_H

#include "engine.h"

typedef enum NodeKind {
    NODE_DRY,    ///< no water: height is the bed
    NODE_WATER,  ///< made from particles
    NODE_FILLED, ///< inside a body, continued from around it
} NodeKind;

typedef struct HeightField {
    int count[2];     ///< nodes along x, y; y has 1 in 2-D
    double origin[2]; ///< of node (0, 0) [m]
    double cell[2];   ///< distance of nodes [m]; y is 0 in 2-D
    float *height;    ///< z of the surface [m], [count[1]][count[0]]
    float *scalar;    ///< a field at the surface, same shape
    uint8_t *kind;    ///< NodeKind, same shape

    int column_count[2];
    double column[2]; ///< size of a column [m]
    float *top;       ///< z of the top of each column, -INFINITY without water
    float (*highest)[3];
    uint8_t *beside; ///< per column: a body stands in it
    float *weight, *spare;
    float *body_bottom, *body_top; ///< per node; INFINITY, -INFINITY without body
    int *filled;                   ///< indices of NODE_FILLED
    Arena arena;
} HeightField;

/// Make room for a snapshot's domain; keeps what it has when the shape is unchanged.
/// @param node_limit  most nodes wanted; they are never closer than dp/3
/// @return false with ERROR_SYSTEM when memory is exhausted
bool height_field_resize(HeightField *field, const Snapshot *snapshot, int node_limit,
                         Error *error);

/// Build the surface. Particles that are not finite or outside the domain are passed over.
/// @param scalar  value per particle [fluid_count], borrowed; NULL leaves field->scalar zero
void height_field_build(HeightField *field, const Snapshot *snapshot, const float *scalar);

/// Height at a point by bilinear interpolation, clamped to the grid [m].
double height_field_sample(const HeightField *field, double x, double y);

/// Indices of the particles that can be seen from outside: near the top of their own or a lower
/// neighbouring column, or at a side of the domain. After height_field_build.
/// @param indices  room for fluid_count
/// @return number of indices
int height_field_shell(const HeightField *field, const Snapshot *snapshot, int *indices);

void height_field_destroy(HeightField *field);

#endif
