/// Meshes as such: room, welding, and the check that they bound a volume.
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "hull_internal.h"

static const double WELD_FRACTION = 1e-6;       ///< of the bounding box's diagonal
static const double DEGENERATE_FRACTION = 1e-9; ///< least height of a triangle over that diagonal

bool mesh_allocate(TriangleMesh *mesh, int vertex_count, int triangle_count, Arena *arena,
                   Error *error)
{
    mesh->vertex_count = vertex_count;
    mesh->triangle_count = triangle_count;
    mesh->vertices =
        arena_take(arena, (size_t)vertex_count, sizeof *mesh->vertices, "mesh vertices", error);
    mesh->triangles =
        arena_take(arena, (size_t)triangle_count, sizeof *mesh->triangles, "mesh triangles", error);
    return mesh->vertices && mesh->triangles;
}

/// Points already met, by cells of twice the tolerance: a chained hash table.
typedef struct WeldTable {
    double cell, tolerance;
    uint32_t mask;
    int *first; ///< [mask + 1] vertex or -1
    int *next;  ///< [point_count]
} WeldTable;

static uint32_t cell_hash(int64_t x, int64_t y, int64_t z)
{
    uint64_t h = (uint64_t)x * 0x9E3779B97F4A7C15u ^ (uint64_t)y * 0xC2B2AE3D27D4EB4Fu ^
                 (uint64_t)z * 0x165667B19E3779F9u;
    return (uint32_t)(h ^ h >> 32);
}

/// Vertex within the tolerance of a point, or -1. The point's ball touches at most eight cells.
static int weld_find(const WeldTable *table, const Vec3 *vertices, Vec3 p)
{
    int64_t low[3], high[3];
    double c[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; k++) {
        low[k] = (int64_t)floor((c[k] - table->tolerance) / table->cell);
        high[k] = (int64_t)floor((c[k] + table->tolerance) / table->cell);
    }
    int found = -1;
    for (int64_t z = low[2]; z <= high[2]; z++)
        for (int64_t y = low[1]; y <= high[1]; y++)
            for (int64_t x = low[0]; x <= high[0]; x++)
                for (int v = table->first[cell_hash(x, y, z) & table->mask]; v >= 0;
                     v = table->next[v])
                    if (vec3_norm(vec3_sub(vertices[v], p)) <= table->tolerance &&
                        (found < 0 || v < found))
                        found = v;
    return found;
}

static void weld_insert(WeldTable *table, Vec3 p, int vertex)
{
    uint32_t slot = cell_hash((int64_t)floor(p.x / table->cell), (int64_t)floor(p.y / table->cell),
                              (int64_t)floor(p.z / table->cell)) &
                    table->mask;
    table->next[vertex] = table->first[slot];
    table->first[slot] = vertex;
}

/// Single-precision files far from their origin carry a coarser rounding than the fraction.
static double weld_tolerance(const Vec3 *points, int point_count)
{
    Vec3 min = points[0], max = points[0];
    for (int i = 1; i < point_count; i++) {
        min = vec3(mind(min.x, points[i].x), mind(min.y, points[i].y), mind(min.z, points[i].z));
        max = vec3(maxd(max.x, points[i].x), maxd(max.y, points[i].y), maxd(max.z, points[i].z));
    }
    double farthest = maxd(maxd(fabs(min.x), fabs(max.x)),
                           maxd(maxd(fabs(min.y), fabs(max.y)), maxd(fabs(min.z), fabs(max.z))));
    double tolerance =
        maxd(WELD_FRACTION * vec3_norm(vec3_sub(max, min)), 4 * FLT_EPSILON * farthest);
    return maxd(tolerance, DBL_MIN * 1e6);
}

bool mesh_weld(const Vec3 *points, int point_count, const int (*triangles)[3], int triangle_count,
               Arena *arena, TriangleMesh *mesh, Error *error)
{
    Arena scratch = arena_create(0);
    uint32_t slots = 16;
    while (slots < (uint32_t)point_count && slots < 1u << 30)
        slots *= 2;
    WeldTable table = {.tolerance = weld_tolerance(points, point_count), .mask = slots - 1};
    table.cell = 4 * table.tolerance;
    table.first = arena_take(&scratch, slots, sizeof *table.first, "weld table", error);
    table.next = arena_take(&scratch, (size_t)point_count, sizeof *table.next, "weld table", error);
    int *vertex_of =
        arena_take(&scratch, (size_t)point_count, sizeof *vertex_of, "weld table", error);
    Vec3 *vertices =
        arena_take(&scratch, (size_t)point_count, sizeof *vertices, "weld table", error);
    if (!table.first || !table.next || !vertex_of || !vertices) {
        arena_destroy(&scratch);
        return false;
    }
    for (uint32_t i = 0; i < slots; i++)
        table.first[i] = -1;
    int vertex_count = 0;
    for (int i = 0; i < point_count; i++) {
        int vertex = weld_find(&table, vertices, points[i]);
        if (vertex < 0) {
            vertex = vertex_count++;
            vertices[vertex] = points[i];
            weld_insert(&table, points[i], vertex);
        }
        vertex_of[i] = vertex;
    }
    bool good = mesh_allocate(mesh, vertex_count, triangle_count, arena, error);
    if (good) {
        for (int i = 0; i < vertex_count; i++)
            mesh->vertices[i] = vertices[i];
        mesh->triangle_count = 0;
        for (int i = 0; i < triangle_count; i++) {
            int a = vertex_of[triangles[i][0]], b = vertex_of[triangles[i][1]],
                c = vertex_of[triangles[i][2]];
            if (a == b || b == c || c == a) continue;
            int *kept = mesh->triangles[mesh->triangle_count++];
            kept[0] = a;
            kept[1] = b;
            kept[2] = c;
        }
    }
    arena_destroy(&scratch);
    return good;
}

/// One side of a triangle, named by its lower and upper vertex.
typedef struct Edge {
    int low, high;
    int forward; ///< 1 when the triangle runs from low to high
} Edge;

static int compare_edges(const void *left, const void *right)
{
    const Edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->forward - b->forward;
}

/// A kind of broken edge: how many, and where the first one is.
typedef struct Defect {
    int count;
    Vec3 first;
} Defect;

static void defect_add(Defect *defect, Vec3 where)
{
    if (!defect->count++) defect->first = where;
}

/// @param kind          "open: " or nothing
/// @param one, several  what the defect is, after its number
static bool report(const Defect *defect, const char *where, const char *kind, const char *one,
                   const char *several, Error *error)
{
    if (!defect->count) return true;
    return error_set(
        error, ERROR_INPUT,
        "%s: %s%d %s, first near (%.6g, %.6g, %.6g) m; a closed, outward oriented mesh "
        "is needed",
        where, kind, defect->count, defect->count == 1 ? one : several, defect->first.x,
        defect->first.y, defect->first.z);
}

static bool check_edges(const TriangleMesh *mesh, const char *where, Edge *edges, Error *error)
{
    int count = 0;
    for (int i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            int a = mesh->triangles[i][k], b = mesh->triangles[i][(k + 1) % 3];
            edges[count++] = (Edge){a < b ? a : b, a < b ? b : a, a < b};
        }
    qsort(edges, (size_t)count, sizeof *edges, compare_edges);
    Defect open = {0}, crowded = {0}, flipped = {0};
    for (int i = 0, end; i < count; i = end) {
        int forward = 0;
        for (end = i;
             end < count && edges[end].low == edges[i].low && edges[end].high == edges[i].high;
             end++)
            forward += edges[end].forward;
        Vec3 middle =
            vec3_scale(vec3_add(mesh->vertices[edges[i].low], mesh->vertices[edges[i].high]), 0.5);
        if (end - i == 1)
            defect_add(&open, middle);
        else if (end - i > 2)
            defect_add(&crowded, middle);
        else if (forward != 1)
            defect_add(&flipped, middle);
    }
    TRY(report(&open, where, "open: ", "edge has one triangle only", "edges have one triangle only",
               error));
    TRY(report(&crowded, where, "", "edge is shared by more than two triangles",
               "edges are shared by more than two triangles", error));
    return report(&flipped, where, "", "edge lies between triangles of opposite orientation",
                  "edges lie between triangles of opposite orientation", error);
}

static bool check_areas(const TriangleMesh *mesh, double least_height, const char *where,
                        Error *error)
{
    Defect flat = {0};
    for (int i = 0; i < mesh->triangle_count; i++) {
        Vec3 a = mesh->vertices[mesh->triangles[i][0]], b = mesh->vertices[mesh->triangles[i][1]],
             c = mesh->vertices[mesh->triangles[i][2]];
        Vec3 ab = vec3_sub(b, a), ac = vec3_sub(c, a), bc = vec3_sub(c, b);
        double longest = maxd(vec3_norm(ab), maxd(vec3_norm(ac), vec3_norm(bc)));
        if (!(vec3_norm(vec3_cross(ab, ac)) > least_height * longest)) defect_add(&flat, a);
    }
    return report(&flat, where, "", "triangle has no area", "triangles have no area", error);
}

bool mesh_check(const TriangleMesh *mesh, const char *where, Error *error)
{
    if (mesh->triangle_count < 4)
        return error_set(error, ERROR_INPUT, "%s: %d triangles; a closed mesh has at least 4",
                         where, mesh->triangle_count);
    Arena scratch = arena_create(0);
    Edge *edges =
        arena_take(&scratch, 3 * (size_t)mesh->triangle_count, sizeof *edges, "mesh edges", error);
    bool good = edges && check_edges(mesh, where, edges, error);
    arena_destroy(&scratch);
    TRY(good);
    MeshProperties properties = mesh_properties(mesh);
    double diagonal = vec3_norm(vec3_sub(properties.max, properties.min));
    TRY(check_areas(mesh, DEGENERATE_FRACTION * diagonal, where, error));
    if (properties.volume < 0)
        return error_set(error, ERROR_INPUT,
                         "%s: oriented inward (volume %.6g m^3); reverse its triangles so that "
                         "they run counter-clockwise seen from outside",
                         where, properties.volume);
    if (!(properties.volume > 1e-12 * diagonal * diagonal * diagonal))
        return error_set(error, ERROR_INPUT, "%s: it encloses no volume (%.3g m^3)", where,
                         properties.volume);
    return true;
}
