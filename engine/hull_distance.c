/// Signed distance on a lattice.
///
/// Distance: every triangle visits the lattice points within `band` of it; a bounding ball discards
/// most of them before the exact distance to the triangle is asked for.
///
/// Sign: the winding number along rays in +x, one per lattice row. A ray may hit an edge or a
/// vertex exactly (lattices and hulls are both fond of round numbers), so that "which side of the
/// edge" is decided as if the ray had been moved by an infinitely small (e, e^2) in (y, z): both
/// triangles of an edge then agree, and exactly one of them is hit. Should rounding defeat this,
/// the windings of the row do not close; the row is cast again a hair beside.
#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "hull_internal.h"

static const double JITTER = 1e-7; ///< of the pitch, when a row is cast again
enum { JITTER_ATTEMPTS = 8 };

/// A triangle prepared for distances.
typedef struct Facet {
    Vec3 corner[3], edge[3]; ///< edge k runs from corner k
    double edge_inverse[3];  ///< 1 / |edge|^2, 0 without length
    Vec3 normal;             ///< not normalised
    double normal_inverse;   ///< 1 / |normal|^2, 0 without area
    Vec3 centre;
    double radius; ///< of the ball about the centre
    Vec3 min, max;
} Facet;

static Facet facet_create(const TriangleMesh *mesh, int index)
{
    Facet f;
    for (int k = 0; k < 3; k++)
        f.corner[k] = mesh->vertices[mesh->triangles[index][k]];
    f.min = f.max = f.corner[0];
    for (int k = 0; k < 3; k++) {
        Vec3 c = f.corner[k];
        f.edge[k] = vec3_sub(f.corner[(k + 1) % 3], c);
        double square = vec3_dot(f.edge[k], f.edge[k]);
        f.edge_inverse[k] = square > 0 ? 1 / square : 0;
        f.min = vec3(mind(f.min.x, c.x), mind(f.min.y, c.y), mind(f.min.z, c.z));
        f.max = vec3(maxd(f.max.x, c.x), maxd(f.max.y, c.y), maxd(f.max.z, c.z));
    }
    f.normal = vec3_cross(f.edge[0], f.edge[1]);
    double square = vec3_dot(f.normal, f.normal);
    f.normal_inverse = square > 0 ? 1 / square : 0;
    f.centre = vec3_scale(vec3_add(f.min, f.max), 0.5);
    f.radius = 0;
    for (int k = 0; k < 3; k++)
        f.radius = maxd(f.radius, vec3_norm(vec3_sub(f.corner[k], f.centre)));
    return f;
}

static double facet_distance_squared(const Facet *f, Vec3 p)
{
    bool above = f->normal_inverse > 0;
    for (int k = 0; k < 3 && above; k++)
        above = vec3_dot(vec3_cross(f->edge[k], vec3_sub(p, f->corner[k])), f->normal) >= 0;
    if (above) {
        double height = vec3_dot(vec3_sub(p, f->corner[0]), f->normal);
        return height * height * f->normal_inverse;
    }
    double least = INFINITY;
    for (int k = 0; k < 3; k++) {
        Vec3 from = vec3_sub(p, f->corner[k]);
        double along = vec3_dot(from, f->edge[k]) * f->edge_inverse[k];
        along = along < 0 ? 0 : (along > 1 ? 1 : along);
        Vec3 rest = vec3_mad(from, f->edge[k], -along);
        least = mind(least, vec3_dot(rest, rest));
    }
    return least;
}

static Vec3 lattice_point(const Lattice *lattice, int x, int y, int z)
{
    return vec3(lattice->min.x + x * lattice->pitch, lattice->min.y + y * lattice->pitch,
                lattice->min.z + z * lattice->pitch);
}

static size_t lattice_row(const Lattice *lattice, int y, int z)
{
    return ((size_t)z * (size_t)lattice->count[1] + (size_t)y) * (size_t)lattice->count[0];
}

/// Lattice indices whose coordinate lies in [low, high], cut to the lattice.
static void index_range(double min, double pitch, int count, double low, double high, int *begin,
                        int *end)
{
    double first = ceil((low - min) / pitch - 1e-9), last = floor((high - min) / pitch + 1e-9);
    *begin = first < 0 ? 0 : (first > count ? count : (int)first);
    *end = last < 0 ? 0 : (last >= count ? count : (int)last + 1);
}

static double gap(double value, double low, double high)
{
    return value < low ? low - value : (value > high ? value - high : 0);
}

/// Lower the distances around one triangle. `values` holds unsigned distances.
static void spread_facet(const Facet *f, const Lattice *l, double band, float *values)
{
    int y0, y1, z0, z1;
    index_range(l->min.y, l->pitch, l->count[1], f->min.y - band, f->max.y + band, &y0, &y1);
    index_range(l->min.z, l->pitch, l->count[2], f->min.z - band, f->max.z + band, &z0, &z1);
    for (int z = z0; z < z1; z++)
        for (int y = y0; y < y1; y++) {
            Vec3 p = lattice_point(l, 0, y, z);
            double dy = gap(p.y, f->min.y, f->max.y), dz = gap(p.z, f->min.z, f->max.z);
            double left = band * band - dy * dy - dz * dz;
            if (left < 0) continue;
            int x0, x1;
            double reach = sqrt(left);
            index_range(l->min.x, l->pitch, l->count[0], f->min.x - reach, f->max.x + reach, &x0,
                        &x1);
            float *row = values + lattice_row(l, y, z);
            for (int x = x0; x < x1; x++) {
                p.x = l->min.x + x * l->pitch;
                Vec3 out = vec3_sub(p, f->centre);
                double best = row[x], near = best + f->radius;
                if (vec3_dot(out, out) >= near * near) continue;
                double square = facet_distance_squared(f, p);
                if (square < best * best) row[x] = (float)sqrt(square);
            }
        }
}

/// +1 when the ray through (y, z) passes left of the edge a -> b seen along +x, -1 right, 0 when
/// the edge is a point in this view.
static int side_of_edge(Vec3 a, Vec3 b, double y, double z)
{
    double side = (a.y - y) * (b.z - z) - (a.z - z) * (b.y - y);
    if (side == 0) side = a.z - b.z;
    if (side == 0) side = b.y - a.y;
    return side > 0 ? 1 : (side < 0 ? -1 : 0);
}

/// Add what one triangle does to the windings of a row: points behind the hit change by +-1.
/// @param steps  [count x + 1]
static void cast_row(const Facet *f, const Lattice *l, double y, double z, short *steps)
{
    int side[3];
    for (int k = 0; k < 3; k++)
        side[k] = side_of_edge(f->corner[k], f->corner[(k + 1) % 3], y, z);
    if (!side[0] || side[0] != side[1] || side[1] != side[2]) return;
    // the plane of the triangle at (y, z); its normal has an x part, or the sides would not agree
    double x = f->corner[0].x;
    if (f->normal.x != 0)
        x -=
            (f->normal.y * (y - f->corner[0].y) + f->normal.z * (z - f->corner[0].z)) / f->normal.x;
    x = x < f->min.x ? f->min.x : (x > f->max.x ? f->max.x : x);
    double index = ceil((x - l->min.x) / l->pitch);
    int first = index < 0 ? 0 : (index > l->count[0] ? l->count[0] : (int)index);
    steps[first] = (short)(steps[first] - side[0]); // side +1: the normal points to +x, we leave
}

/// A row again, beside its place, over all triangles.
static void recast_row(const TriangleMesh *mesh, const Lattice *l, int y, int z, short *steps)
{
    Vec3 p = lattice_point(l, 0, y, z);
    for (int attempt = 1; attempt <= JITTER_ATTEMPTS; attempt++) {
        memset(steps, 0, ((size_t)l->count[0] + 1) * sizeof *steps);
        for (int i = 0; i < mesh->triangle_count; i++) {
            Facet f = facet_create(mesh, i);
            cast_row(&f, l, p.y + attempt * JITTER * l->pitch,
                     p.z + attempt * 0.618 * JITTER * l->pitch, steps);
        }
        int winding = 0;
        for (int x = 0; x <= l->count[0]; x++)
            winding += steps[x];
        if (!winding) return;
    }
}

static bool set_signs(const TriangleMesh *mesh, const Lattice *l, float *values, Error *error)
{
    Arena scratch = arena_create(0);
    size_t row_size = (size_t)l->count[0] + 1, rows = (size_t)l->count[1] * (size_t)l->count[2];
    short *steps = arena_take(&scratch, rows * row_size, sizeof *steps, "winding numbers", error);
    if (!steps) return false;
    for (int i = 0; i < mesh->triangle_count; i++) {
        Facet f = facet_create(mesh, i);
        int y0, y1, z0, z1;
        index_range(l->min.y, l->pitch, l->count[1], f.min.y, f.max.y, &y0, &y1);
        index_range(l->min.z, l->pitch, l->count[2], f.min.z, f.max.z, &z0, &z1);
        for (int z = z0; z < z1; z++)
            for (int y = y0; y < y1; y++) {
                Vec3 p = lattice_point(l, 0, y, z);
                cast_row(&f, l, p.y, p.z,
                         steps + ((size_t)z * (size_t)l->count[1] + (size_t)y) * row_size);
            }
    }
    for (int z = 0; z < l->count[2]; z++)
        for (int y = 0; y < l->count[1]; y++) {
            short *row = steps + ((size_t)z * (size_t)l->count[1] + (size_t)y) * row_size;
            int winding = 0;
            for (int x = 0; x <= l->count[0]; x++)
                winding += row[x];
            if (winding) recast_row(mesh, l, y, z, row);
            float *value = values + lattice_row(l, y, z);
            winding = 0;
            for (int x = 0; x < l->count[0]; x++) {
                winding += row[x];
                if (winding > 0) value[x] = -value[x];
            }
        }
    arena_destroy(&scratch);
    return true;
}

bool lattice_size(const Lattice *lattice, size_t *size)
{
    double points = (double)lattice->count[0] * lattice->count[1] * lattice->count[2];
    *size = (size_t)points;
    return lattice->count[0] > 0 && lattice->count[1] > 0 && lattice->count[2] > 0 &&
           points < INT_MAX;
}

bool lattice_signed_distance(const TriangleMesh *mesh, const Lattice *lattice, double band,
                             bool ignore_ends, float *values, Error *error)
{
    size_t size;
    if (!lattice_size(lattice, &size))
        return error_set(error, ERROR_INPUT, "a lattice of %d x %d x %d points is too large",
                         lattice->count[0], lattice->count[1], lattice->count[2]);
    for (size_t i = 0; i < size; i++)
        values[i] = (float)band;
    for (int i = 0; i < mesh->triangle_count; i++) {
        Facet f = facet_create(mesh, i);
        double across = f.normal.y * f.normal.y * f.normal_inverse;
        if (!(ignore_ends && across > 0.9999)) spread_facet(&f, lattice, band, values);
    }
    return set_signs(mesh, lattice, values, error);
}

bool distance_grid_create(const TriangleMesh *mesh, double cell, double band, Arena *arena,
                          DistanceGrid *grid, Error *error)
{
    MeshProperties box = mesh_properties(mesh);
    double low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
    double first[3];
    Lattice lattice = {.pitch = cell};
    if (!(cell > 0) || !(band > 0))
        return error_set(error, ERROR_INPUT, "distance grid: cell %g m and band %g m must be > 0",
                         cell, band);
    for (int k = 0; k < 3; k++) { // the outermost points lie at least `band` away from the mesh
        double cells = ceil((high[k] - low[k] + 2 * band) / cell) + 1;
        if (cells > INT_MAX / 2)
            return error_set(error, ERROR_INPUT, "distance grid: cells of %g m are too small",
                             cell);
        lattice.count[k] = (int)cells + 1;
        first[k] = 0.5 * (low[k] + high[k]) - 0.5 * cells * cell;
    }
    lattice.min = vec3(first[0], first[1], first[2]);
    size_t size;
    if (!lattice_size(&lattice, &size))
        return error_set(error, ERROR_INPUT,
                         "distance grid: %d x %d x %d cells of %g m are too many", lattice.count[0],
                         lattice.count[1], lattice.count[2], cell);
    grid->min = lattice.min;
    grid->cell = cell;
    memcpy(grid->count, lattice.count, sizeof grid->count);
    grid->values = arena_take(arena, size, sizeof *grid->values, "distance grid", error);
    return grid->values &&
           lattice_signed_distance(mesh, &lattice, band, false, grid->values, error);
}

double distance_grid_sample(const DistanceGrid *grid, Vec3 point)
{
    double c[3] = {(point.x - grid->min.x) / grid->cell, (point.y - grid->min.y) / grid->cell,
                   (point.z - grid->min.z) / grid->cell};
    int base[3];
    double part[3];
    for (int k = 0; k < 3; k++) {
        // corners of the grid are `band` away from the mesh; so is everything outside
        if (!(c[k] >= 0 && c[k] < grid->count[k] - 1)) return grid->values[0];
        base[k] = (int)c[k];
        part[k] = c[k] - base[k];
    }
    size_t nx = (size_t)grid->count[0], layer = nx * (size_t)grid->count[1];
    const float *v =
        grid->values + (size_t)base[2] * layer + (size_t)base[1] * nx + (size_t)base[0];
    double edge[4];
    for (int k = 0; k < 4; k++) {
        const float *p = v + (k & 1 ? nx : 0) + (k & 2 ? layer : 0);
        edge[k] = p[0] + (p[1] - p[0]) * part[0];
    }
    double low = edge[0] + (edge[1] - edge[0]) * part[1];
    double high = edge[2] + (edge[3] - edge[2]) * part[1];
    return low + (high - low) * part[2];
}
