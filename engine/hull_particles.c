/// Dummy particles: a shell of the hull's inside on a lattice of the fluid's spacing.
///
/// The skin of the hull should lie midway between the fluid's first layer and the dummies' first.
/// On a box that can be had exactly. On a curved hull the lattice cuts the skin anywhere; what can
/// be had is that the dummies displace what the hull displaces: every lattice point stands for one
/// cell, and the cut-off distance is moved until their number is the hull's volume over the cell's.
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hull_internal.h"

static const double CUT_OFF_RANGE = 0.4; ///< of dp: an aligned layer (at dp/2) is never lost
static const double TIE = 1e-6;          ///< of dp: points as deep as each other go together
static const double OWED_MOST = 2;       ///< points: what a layer may pass on to the next

/// Eight vertices, all at the corners of the bounding box.
static bool mesh_is_box(const TriangleMesh *mesh, const MeshProperties *box)
{
    if (mesh->vertex_count != 8 || mesh->triangle_count != 12) return false;
    Vec3 size = vec3_sub(box->max, box->min);
    double volume = size.x * size.y * size.z;
    return fabs(box->volume - volume) <= 1e-9 * volume;
}

static bool box_particles(const MeshProperties *box, double spacing, double thickness,
                          int dimensions, Arena *arena, Vec3 **points, int *count, Error *error)
{
    double low[3] = {box->min.x, box->min.y, box->min.z};
    double size[3] = {box->max.x - low[0], box->max.y - low[1], box->max.z - low[2]};
    double pitch[3], cells = 1;
    int n[3];
    for (int k = 0; k < 3; k++) {
        double layers = maxd(1, round(size[k] / spacing));
        if (k == 1 && dimensions == 2) layers = 1; // the one layer lies on y = 0
        cells *= layers;
        if (cells > INT_MAX)
            return error_set(error, ERROR_INPUT,
                             "a box of %g x %g x %g m is too large for particles of %g m", size[0],
                             size[1], size[2], spacing);
        n[k] = (int)layers;
        pitch[k] = size[k] / layers;
    }
    // two rounds: count, then fill
    for (int round_ = 0; round_ < 2; round_++) {
        int found = 0;
        for (int z = 0; z < n[2]; z++)
            for (int y = 0; y < n[1]; y++)
                for (int x = 0; x < n[0]; x++) {
                    int index[3] = {x, y, z};
                    double depth = INFINITY, at[3];
                    for (int k = 0; k < 3; k++) {
                        int layer = index[k] < n[k] - 1 - index[k] ? index[k] : n[k] - 1 - index[k];
                        if (k != 1 || dimensions == 3)
                            depth = mind(depth, (layer + 0.5) * pitch[k]);
                        at[k] = low[k] + (index[k] + 0.5) * pitch[k];
                    }
                    if (depth > thickness * (1 + 1e-9)) continue;
                    if (round_) (*points)[found] = vec3(at[0], dimensions == 2 ? 0 : at[1], at[2]);
                    found++;
                }
        if (round_) break;
        *count = found;
        *points = arena_take(arena, (size_t)found, sizeof **points, "body particles", error);
        if (!*points) return false;
    }
    return true;
}

/// Lattice over a hull: symmetric about the middle of its length and breadth, its lowest layer dp/2
/// above the lowest point (flat bottoms are then exact); a hull of one or two layers is centred.
static Lattice hull_lattice(const MeshProperties *box, double spacing, int dimensions)
{
    double low[3] = {box->min.x, box->min.y, box->min.z};
    double high[3] = {box->max.x, box->max.y, box->max.z};
    double first[3];
    Lattice lattice = {.pitch = spacing};
    for (int k = 0; k < 3; k++) {
        double size = high[k] - low[k], middle = 0.5 * (low[k] + high[k]);
        if (fabs(middle) < 1e-6 * size) middle = 0;
        double layers = maxd(1, round(size / spacing));
        if (k == 2 && layers > 2) {
            first[k] = low[k] + 0.5 * spacing;
            layers = ceil(size / spacing);
        } else {
            layers += 2; // a point may lie inside beyond the rounded extent
            first[k] = middle - 0.5 * (layers - 1) * spacing;
        }
        lattice.count[k] = layers > INT_MAX / 2 ? INT_MAX / 2 : (int)layers;
    }
    if (dimensions == 2) {
        first[1] = 0;
        lattice.count[1] = 1;
    }
    lattice.min = vec3(first[0], first[1], first[2]);
    return lattice;
}

static int compare_floats(const void *left, const void *right)
{
    float a = *(const float *)left, b = *(const float *)right;
    return a < b ? -1 : a > b;
}

/// Signed distance below which the points of one layer count as inside, so that there are `target`
/// of them as nearly as the ties between equally deep points allow.
/// @param near    scratch [size], points within the range of the cut-off
/// @param chosen  how many they are
static double choose_cut_off(const float *distance, size_t size, double target, double spacing,
                             float *near, double *chosen)
{
    double range = CUT_OFF_RANGE * spacing;
    size_t inside = 0, near_count = 0;
    for (size_t i = 0; i < size; i++) {
        if (distance[i] < -range)
            inside++;
        else if (distance[i] <= range)
            near[near_count++] = distance[i];
    }
    qsort(near, near_count, sizeof *near, compare_floats);
    double best = fabs((double)inside - target), cut = -range;
    *chosen = (double)inside;
    for (size_t k = 0; k < near_count; k++) {
        bool tied = k + 1 < near_count && near[k + 1] - near[k] < TIE * spacing;
        double miss = fabs((double)(inside + k + 1) - target);
        if (tied || miss >= best) continue;
        best = miss;
        *chosen = (double)(inside + k + 1);
        cut = k + 1 < near_count ? 0.5 * ((double)near[k] + near[k + 1]) : range;
    }
    return cut;
}

/// Cut-off of every layer, from the keel up, so that the points up to each layer displace what the
/// hull does up to there: buoyancy is then right at any draft, not only when it is all under.
/// @param cell  volume of the hull that one point stands for [m^3]
/// @param cuts  filled [count z][m]
static void cut_layers(const TriangleMesh *mesh, const Lattice *lattice, const float *distance,
                       double cell, float *near, double *cuts)
{
    size_t layer = (size_t)lattice->count[0] * (size_t)lattice->count[1];
    double below = 0, owed = 0, total = 0;
    for (int z = 0; z < lattice->count[2]; z++) {
        double level = lattice->min.z + (z + 0.5) * lattice->pitch, chosen;
        double volume = mesh_submerged(mesh, vec3(0, 0, 0), quat(1, 0, 0, 0), level).volume;
        double target = (volume - below) / cell + owed;
        cuts[z] = choose_cut_off(distance + (size_t)z * layer, layer, target, lattice->pitch, near,
                                 &chosen);
        owed = maxd(-OWED_MOST, mind(OWED_MOST, target - chosen));
        total += chosen;
        below = volume;
    }
    // a sheet thinner than half a particle still needs its one layer
    if (total >= 0.5 * below / cell && total > 0) return;
    for (int z = 0; z < lattice->count[2]; z++)
        cuts[z] = CUT_OFF_RANGE * lattice->pitch;
}

/// Keep the points between the cut-off and the depth of the shell. @param points  NULL only counts
static int keep_shell(const Lattice *lattice, const float *distance, const double *cuts,
                      double thickness, Vec3 *points)
{
    double shell = -(thickness + TIE * lattice->pitch);
    int found = 0;
    size_t i = 0;
    for (int z = 0; z < lattice->count[2]; z++)
        for (int y = 0; y < lattice->count[1]; y++)
            for (int x = 0; x < lattice->count[0]; x++, i++) {
                if (!(distance[i] < cuts[z] && distance[i] >= shell)) continue;
                if (points)
                    points[found] = vec3(lattice->min.x + x * lattice->pitch,
                                         lattice->min.y + y * lattice->pitch,
                                         lattice->min.z + z * lattice->pitch);
                found++;
            }
    return found;
}

static bool lattice_particles(const TriangleMesh *mesh, const MeshProperties *box, double spacing,
                              double thickness, int dimensions, Arena *scratch, Arena *arena,
                              Vec3 **points, int *count, Error *error)
{
    Lattice lattice = hull_lattice(box, spacing, dimensions);
    Vec3 extent = vec3_sub(box->max, box->min);
    size_t size;
    if (!lattice_size(&lattice, &size))
        return error_set(error, ERROR_INPUT,
                         "a hull of %g x %g x %g m is too large for particles of %g m", extent.x,
                         extent.y, extent.z, spacing);
    float *distance = arena_take(scratch, size, sizeof *distance, "hull lattice", error);
    float *near = arena_take(scratch, size, sizeof *near, "hull lattice", error);
    double *cuts =
        arena_take(scratch, (size_t)lattice.count[2], sizeof *cuts, "hull lattice", error);
    if (!distance || !near || !cuts) return false;
    double deepest = mind(extent.x, extent.z); // nothing lies deeper than half of this
    if (dimensions == 3) deepest = mind(deepest, extent.y);
    double band = mind(thickness, 0.5 * deepest) + 2 * spacing;
    TRY(lattice_signed_distance(mesh, &lattice, band, dimensions == 2, distance, error));
    double across = dimensions == 2 ? extent.y : spacing;
    cut_layers(mesh, &lattice, distance, spacing * spacing * across, near, cuts);
    *count = keep_shell(&lattice, distance, cuts, thickness, NULL);
    if (!*count)
        return error_set(error, ERROR_INPUT,
                         "a hull of %g x %g x %g m holds no particle of %g m; a spacing below its "
                         "thickness is needed",
                         extent.x, extent.y, extent.z, spacing);
    *points = arena_take(arena, (size_t)*count, sizeof **points, "body particles", error);
    if (!*points) return false;
    keep_shell(&lattice, distance, cuts, thickness, *points);
    return true;
}

bool hull_particles(const TriangleMesh *mesh, double spacing, double thickness, int dimensions,
                    Arena *arena, Vec3 **points, int *count, Error *error)
{
    ASSERT(spacing > 0 && thickness > 0 && (dimensions == 2 || dimensions == 3));
    MeshProperties box = mesh_properties(mesh);
    if (mesh_is_box(mesh, &box))
        return box_particles(&box, spacing, thickness, dimensions, arena, points, count, error);
    Arena scratch = arena_create(0);
    bool good = lattice_particles(mesh, &box, spacing, thickness, dimensions, &scratch, arena,
                                  points, count, error);
    arena_destroy(&scratch);
    return good;
}
