/// Fields on the cut faces of the water: the kernel mean of the particles beside each side of the
/// domain, so that the sides of the tank show what happens below the surface. Pure C, knows no GL.
#ifndef FAIRLEAD_CUT_H
#define FAIRLEAD_CUT_H

#include "engine.h"
#include "scratch.h"

/// Sides in the order y min, x max, y max, x min; each runs along its axis upwards. One row of
/// values holds all sides, one after another; rows go up from the bed.
typedef struct CutFaces {
    int columns[4];   ///< nodes along each side
    int first[4];     ///< column of each side's first node
    int width, rows;  ///< of the whole grid
    double bed, step; ///< z of the first row; distance of rows [m]
    float *value;     ///< [rows][width], borrowed from storage
    Scratch storage;
} CutFaces;

/// @param scalar    value per particle [fluid_count], borrowed
/// @param min, max  corners of the water's room as drawn [m]; a slice has its drawn thickness
bool cut_faces_build(CutFaces *cut, const Snapshot *snapshot, const float *scalar, Vec3 min,
                     Vec3 max, Error *error);

/// Place of a point of a side in a texture made of the grid, 0..1.
/// @param share  of the way along the side, 0..1
double cut_faces_u(const CutFaces *cut, int side, double share);

void cut_faces_destroy(CutFaces *cut);

#endif
