/// What the hull_*.c files share among themselves; nobody else includes this.
#ifndef FAIRLEAD_HULL_INTERNAL_H
#define FAIRLEAD_HULL_INTERNAL_H

#include "hull.h"

/// Room for a mesh of known size. @return false with ERROR_SYSTEM when memory is exhausted
bool mesh_allocate(TriangleMesh *mesh, int vertex_count, int triangle_count, Arena *arena,
                   Error *error);

/// Merge points closer than a millionth of the bounding box (STL files repeat every corner, in
/// single precision) and drop triangles that collapse by it.
/// @param points      borrowed [point_count][m]
/// @param triangles   borrowed [triangle_count], indices into points
bool mesh_weld(const Vec3 *points, int point_count, const int (*triangles)[3], int triangle_count,
               Arena *arena, TriangleMesh *mesh, Error *error);

/// The part of a mesh below the plane z = level. Integrals run over the wetted skin only: with the
/// origin of z in the plane, the missing waterplane contributes nothing to them.
typedef struct Submerged {
    double volume;          ///< [m^3]
    Vec3 moment;            ///< first moments about (origin.x, origin.y, level), world axes [m^4]
    double waterplane_area; ///< [m^2]
    double waterplane_x, waterplane_y;                  ///< first moments [m^3]
    double waterplane_xx, waterplane_yy, waterplane_xy; ///< second moments [m^4]
    double lowest, highest;                             ///< z of the mesh relative to the level [m]
} Submerged;
Submerged mesh_submerged(const TriangleMesh *mesh, Vec3 origin, Quat attitude, double level);

/// A regular set of points: min + index * pitch.
typedef struct Lattice {
    Vec3 min;     ///< first point [m]
    double pitch; ///< [m]
    int count[3];
} Lattice;

/// Number of points; false when it exceeds what memory could ever hold (2^31 - 1).
bool lattice_size(const Lattice *lattice, size_t *size);

/// Signed distance of every lattice point to the mesh: negative inside, exact within `band`, +-band
/// beyond. Inside means winding number > 0, so closed parts may overlap.
/// @param ignore_ends  leave the flat ends (normal along y) of an extruded section out of the
///                     distance, as 2-D asks for
/// @param values       filled [count z][count y][count x][m]
bool lattice_signed_distance(const TriangleMesh *mesh, const Lattice *lattice, double band,
                             bool ignore_ends, float *values, Error *error);

#endif
