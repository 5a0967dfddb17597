/// Bodies as closed triangle meshes: reading, making, checking; hydrostatics; dummy particles.
/// Meshes are in geometry axes: the frame in which a case gives points on the body.
#ifndef FAIRLEAD_HULL_H
#define FAIRLEAD_HULL_H

#include "base/arena.h"
#include "base/error.h"
#include "base/portable.h"
#include "motion.h"
#include "scene.h"

typedef struct TriangleMesh {
    int vertex_count;
    Vec3 *vertices; ///< [vertex_count][m], welded
    int triangle_count;
    int (*triangles)[3]; ///< counter-clockwise seen from outside
} TriangleMesh;

/// Volume integrals of a closed mesh of unit density.
typedef struct MeshProperties {
    double volume;     ///< [m^3]
    double area;       ///< [m^2]
    Vec3 centroid;     ///< [m]
    double inertia[6]; ///< xx yy zz xy xz yz of the tensor about the centroid (xy = -integral of
                       ///< x y), unit density [m^5]
    Vec3 min, max;     ///< bounding box [m]
} MeshProperties;

/// What still water does to a body in a given pose.
typedef struct Hydrostatics {
    double draft;            ///< lowest point below still water [m], < 0 above it
    double mass;             ///< of the body [kg]
    double displacement;     ///< displaced volume [m^3]
    Vec3 centre_of_buoyancy; ///< geometry axes [m]; NANs when dry
    double waterplane_area;  ///< [m^2]
    double gm_transverse;    ///< metacentric height [m]
    double gm_longitudinal;  ///< [m]
    double heave_period, roll_period, pitch_period; ///< [s], without added mass; NAN if unstable
    double trim_moment; ///< about y through the centre of gravity at this pose [N m], bow-down > 0
    double heel_moment; ///< about x [N m]
} Hydrostatics;

/// A body ready for the engine: shape, mass properties, resting pose.
typedef struct BodyGeometry {
    TriangleMesh mesh;
    MeshProperties properties;
    Vec3 origin;            ///< reference position of the geometry's origin in the world [m]
    Quat attitude;          ///< reference attitude
    Vec3 centre_of_gravity; ///< geometry axes [m]
    double mass;            ///< [kg]
    double inertia[3][3];   ///< about the centre of gravity, geometry axes [kg m^2]
    Hydrostatics hydrostatics;
    bool floats;               ///< mesh reaches into the water at its reference pose
    const MotionTable *motion; ///< of bodies[].motion; NULL without
} BodyGeometry;

/// Read STL (ASCII, binary) or OBJ, weld vertices, scale. Errors name the file (and line).
bool mesh_load(const char *path, double scale, Arena *arena, TriangleMesh *mesh, Error *error);

/// The mesh of any shape a case can name (box, sphere, cylinder, Wigley, polygon, file). In 2-D
/// (`dimensions` 2) sections are extruded over breadth 1 m, so that loads are per metre.
/// `where` is the JSON path of the body, for messages.
bool mesh_create(const BodyScene *body, int dimensions, const char *where, Arena *arena,
                 TriangleMesh *mesh, Error *error);

/// Closed (each edge twice, in opposite directions), oriented outward (volume > 0), not degenerate.
bool mesh_check(const TriangleMesh *mesh, const char *where, Error *error);

MeshProperties mesh_properties(const TriangleMesh *mesh);

/// Mesh cut by the horizontal plane z = level after rotation and translation.
Hydrostatics mesh_hydrostatics(const TriangleMesh *mesh, Vec3 origin, Quat attitude,
                               Vec3 centre_of_gravity, double mass, const double inertia[3][3],
                               double level, double density, double gravity);

/// Mesh, mass, centre of gravity, inertia and reference pose of body `index`; solves draft from
/// mass or mass from draft. Errors name `bodies[index]…`.
bool body_geometry_create(const Scene *scene, int index, Arena *arena, BodyGeometry *geometry,
                          Error *error);

/// Dummy particles that fill the hull to a depth of `thickness` below its skin, on the layers
/// dp/2, 3dp/2, … so that the skin lies midway between fluid and dummies. Boxes are filled exactly;
/// other hulls on a lattice whose outermost points are chosen, layer by layer, so that the
/// particles displace what the hull does. Some of these may lie up to 0.4 dp outside the skin.
/// @param dimensions  2: particles on y = 0 only
/// @param points      taken from the arena, geometry axes [count][m]
/// @param count       number of points
bool hull_particles(const TriangleMesh *mesh, double spacing, double thickness, int dimensions,
                    Arena *arena, Vec3 **points, int *count, Error *error);

/// Signed distance to the mesh, negative inside, exact within `band` and clamped beyond; built once
/// as a grid for carving fluid and for pictures.
typedef struct DistanceGrid {
    Vec3 min;
    double cell;
    int count[3];
    float *values; ///< [x fastest] [m]
} DistanceGrid;
bool distance_grid_create(const TriangleMesh *mesh, double cell, double band, Arena *arena,
                          DistanceGrid *grid, Error *error);
/// Trilinear; outside the grid returns +band.
double distance_grid_sample(const DistanceGrid *grid, Vec3 point);

#endif
