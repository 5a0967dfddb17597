/// The meshes of the shapes a case can name.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hull_internal.h"

enum {
    SPHERE_DIVISIONS = 32, ///< of an octahedron's edge; volume 0.2 % below the sphere's
    CYLINDER_SIDES = 96,   ///< volume 0.07 % below the cylinder's
    WIGLEY_STATIONS = 80,
    WIGLEY_LEVELS = 20,
};
static const double BREADTH_2D = 1.0; ///< [m]: loads are per metre

static bool positive(double value, const char *where, const char *key, Error *error)
{
    if (value > 0 && isfinite(value)) return true;
    return error_set(error, ERROR_INPUT, "%s.%s: %g; a number > 0 is needed", where, key, value);
}

static void set_triangle(TriangleMesh *mesh, int *index, int a, int b, int c)
{
    int *triangle = mesh->triangles[(*index)++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

static bool box_create(Vec3 size, Arena *arena, TriangleMesh *mesh, Error *error)
{
    // corner k: bit 0 = +x, bit 1 = +y, bit 2 = +z; faces counter-clockwise from outside
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    TRY(mesh_allocate(mesh, 8, 12, arena, error));
    for (int k = 0; k < 8; k++)
        mesh->vertices[k] = vec3(k & 1 ? size.x / 2 : -size.x / 2, k & 2 ? size.y / 2 : -size.y / 2,
                                 k & 4 ? size.z / 2 : -size.z / 2);
    int t = 0;
    for (int f = 0; f < 6; f++) {
        set_triangle(mesh, &t, faces[f][0], faces[f][1], faces[f][2]);
        set_triangle(mesh, &t, faces[f][0], faces[f][2], faces[f][3]);
    }
    return true;
}

/// An octahedron whose faces are divided and pushed out onto the sphere: vertices on all three
/// planes of symmetry, so that it floats level and symmetric.
static bool sphere_create(double radius, Arena *arena, TriangleMesh *mesh, Error *error)
{
    enum { N = SPHERE_DIVISIONS, FACE_POINTS = (N + 1) * (N + 2) / 2 };
    Arena scratch = arena_create(0);
    Vec3 *points = arena_take(&scratch, 8 * FACE_POINTS, sizeof *points, "sphere", error);
    int(*triangles)[3] = arena_take(&scratch, 8 * N * N, sizeof *triangles, "sphere", error);
    if (!points || !triangles) {
        arena_destroy(&scratch);
        return false;
    }
    int point_count = 0, count = 0;
    for (int face = 0; face < 8; face++) {
        Vec3 sign = vec3(face & 1 ? 1 : -1, face & 2 ? 1 : -1, face & 4 ? 1 : -1);
        bool right_handed = sign.x * sign.y * sign.z > 0;
        int row = point_count; // first point of row i, which has N + 1 - i points
        for (int i = 0; i <= N; i++) {
            for (int j = 0; i + j <= N; j++) {
                Vec3 p = vec3(i * sign.x, j * sign.y, (N - i - j) * sign.z);
                points[point_count++] = vec3_scale(p, radius / vec3_norm(p));
            }
            int next = row + N + 1 - i;
            for (int j = 0; i + j < N; j++)
                for (int half = 0; half < (i + j < N - 1 ? 2 : 1); half++) {
                    int a = row + j + half, b = next + j, c = half ? next + j + 1 : row + j + 1;
                    int *triangle = triangles[count++];
                    triangle[0] = a;
                    triangle[1] = right_handed ? b : c;
                    triangle[2] = right_handed ? c : b;
                }
            row = next;
        }
    }
    bool good =
        mesh_weld(points, point_count, (const int(*)[3])triangles, count, arena, mesh, error);
    arena_destroy(&scratch);
    return good;
}

/// Point (u, v) of a section at station `along` on axis 0|1|2; (axis, u, v) is right-handed.
static Vec3 section_point(int axis, double along, double u, double v)
{
    return axis == 0 ? vec3(along, u, v) : axis == 1 ? vec3(v, along, u) : vec3(u, v, along);
}

/// Vertices of a prism: the section at the low end, then at the high end; and its sides.
/// @param section  counter-clockwise (u, v) [count]
static void prism_sides(TriangleMesh *mesh, int *t, const double (*section)[2], int count, int axis,
                        double length)
{
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < count; k++)
            mesh->vertices[end * count + k] =
                section_point(axis, end ? length / 2 : -length / 2, section[k][0], section[k][1]);
    for (int k = 0; k < count; k++) {
        int next = (k + 1) % count;
        set_triangle(mesh, t, k, next, count + next);
        set_triangle(mesh, t, k, count + next, count + k);
    }
}

static bool cylinder_create(double radius, double length, int axis, Arena *arena,
                            TriangleMesh *mesh, Error *error)
{
    enum { N = CYLINDER_SIDES };
    double section[N][2];
    for (int k = 0; k < N; k++) {
        section[k][0] = radius * cos(2 * PI * k / N);
        section[k][1] = radius * sin(2 * PI * k / N);
    }
    TRY(mesh_allocate(mesh, 2 * N + 2, 4 * N, arena, error));
    int t = 0;
    prism_sides(mesh, &t, (const double(*)[2])section, N, axis, length);
    mesh->vertices[2 * N] = section_point(axis, -length / 2, 0, 0);
    mesh->vertices[2 * N + 1] = section_point(axis, length / 2, 0, 0);
    for (int k = 0; k < N; k++) {
        int next = (k + 1) % N;
        set_triangle(mesh, &t, 2 * N, next, k);
        set_triangle(mesh, &t, 2 * N + 1, N + k, N + next);
    }
    return true;
}

/// Twice the area of (a, b, c), positive when counter-clockwise.
static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool segments_cross(const double a[2], const double b[2], const double c[2],
                           const double d[2])
{
    double abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
    return ((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc != 0 && abd != 0 &&
           cda != 0 && cdb != 0;
}

/// Cut a simple counter-clockwise polygon into count - 2 triangles by its ears.
static bool cut_ears(const double (*p)[2], int count, int (*triangles)[3])
{
    int ring[SCENE_POLYGON_MAX] = {0}, left = count, made = 0;
    if (count < 3) return false;
    for (int k = 0; k < count; k++)
        ring[k] = k;
    while (left > 3) {
        int ear = -1;
        for (int k = 0; k < left && ear < 0; k++) {
            int a = ring[(k + left - 1) % left], b = ring[k], c = ring[(k + 1) % left];
            if (turn(p[a], p[b], p[c]) <= 0) continue;
            bool empty = true;
            for (int m = 0; m < left && empty; m++) {
                int q = ring[m];
                if (q == a || q == b || q == c) continue;
                empty = turn(p[a], p[b], p[q]) < 0 || turn(p[b], p[c], p[q]) < 0 ||
                        turn(p[c], p[a], p[q]) < 0;
            }
            if (empty) ear = k;
        }
        if (ear < 0) return false;
        int *triangle = triangles[made++];
        triangle[0] = ring[(ear + left - 1) % left];
        triangle[1] = ring[ear];
        triangle[2] = ring[(ear + 1) % left];
        memmove(ring + ear, ring + ear + 1, (size_t)(left - ear - 1) * sizeof *ring);
        left--;
    }
    triangles[made][0] = ring[0];
    triangles[made][1] = ring[1];
    triangles[made][2] = ring[2];
    return turn(p[ring[0]], p[ring[1]], p[ring[2]]) > 0;
}

/// The section as (u, v) = (z, x), counter-clockwise, without repeated and collinear corners.
static int polygon_section(const BodyScene *body, double (*section)[2])
{
    int count = 0;
    double area = 0;
    for (int k = 0; k < body->polygon_count; k++) {
        const double *a = body->polygon[k], *b = body->polygon[(k + 1) % body->polygon_count];
        area += b[0] * a[1] - a[0] * b[1]; // (z, x) is the mirror image of (x, z)
    }
    for (int k = 0; k < body->polygon_count; k++) {
        const double *from = body->polygon[area > 0 ? k : body->polygon_count - 1 - k];
        double corner[2] = {from[1], from[0]};
        if (count && corner[0] == section[count - 1][0] && corner[1] == section[count - 1][1])
            continue;
        memcpy(section[count++], corner, sizeof corner);
    }
    while (count > 1 && section[0][0] == section[count - 1][0] &&
           section[0][1] == section[count - 1][1])
        count--;
    double size = sqrt(fabs(area));
    for (int k = 0; k < count && count > 3;) {
        const double *a = section[(k + count - 1) % count], *c = section[(k + 1) % count];
        if (fabs(turn(a, section[k], c)) > 1e-12 * size * size) {
            k++;
            continue;
        }
        memmove(section + k, section + k + 1, (size_t)(count - k - 1) * sizeof *section);
        count--;
    }
    return count;
}

static bool polygon_create(const BodyScene *body, double breadth, const char *where, Arena *arena,
                           TriangleMesh *mesh, Error *error)
{
    if (body->polygon_count < 3 || body->polygon_count > SCENE_POLYGON_MAX)
        return error_set(error, ERROR_INPUT, "%s.points_m: %d corners; 3 to %d are needed", where,
                         body->polygon_count, SCENE_POLYGON_MAX);
    double section[SCENE_POLYGON_MAX][2];
    int count = polygon_section(body, section);
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++)
            if (segments_cross(section[i], section[(i + 1) % count], section[j],
                               section[(j + 1) % count]))
                return error_set(error, ERROR_INPUT,
                                 "%s.points_m: its sides cross near (%g, %g) m; a simple polygon "
                                 "is needed",
                                 where, section[i][1], section[i][0]);
    int triangles[SCENE_POLYGON_MAX][3];
    if (!cut_ears((const double(*)[2])section, count, triangles))
        return error_set(error, ERROR_INPUT,
                         "%s.points_m: encloses no area or touches itself; a simple polygon is "
                         "needed",
                         where);
    TRY(mesh_allocate(mesh, 2 * count, 2 * count + 2 * (count - 2), arena, error));
    int t = 0;
    prism_sides(mesh, &t, (const double(*)[2])section, count, 1, breadth);
    for (int k = 0; k < count - 2; k++) {
        const int *c = triangles[k];
        set_triangle(mesh, &t, c[0], c[2], c[1]);
        set_triangle(mesh, &t, count + c[0], count + c[1], count + c[2]);
    }
    return true;
}

/// Half-breadth B/2 (1 - (2x/L)^2)(1 - ((z - T)/T)^2), z above the keel; vertical sides above the
/// design draft T. Source: Wigley (1942); Journee (1992), report 909, Delft.
static double wigley_half_breadth(double x, double z, double length, double beam, double draft)
{
    double s = 2 * x / length, q = z < draft ? (z - draft) / draft : 0;
    return beam / 2 * (1 - s * s) * (1 - q * q);
}

/// Vertex of the Wigley grid; those on the centre plane are shared by both sides.
static int wigley_vertex(int station, int level, int side)
{
    enum { N = WIGLEY_STATIONS };
    int base = level == 0 ? 0 : N + 1 + (level - 1) * 2 * N;
    if (level == 0) return station;
    if (station == 0 || station == N) return base + (station ? 1 : 0);
    return base + 2 + 2 * (station - 1) + side;
}

static bool wigley_create(const BodyScene *body, const char *where, Arena *arena,
                          TriangleMesh *mesh, Error *error)
{
    enum { N = WIGLEY_STATIONS, M = WIGLEY_LEVELS };
    double length = body->size.x, beam = body->size.y, depth = body->size.z;
    double draft = body->draft_design;
    TRY(positive(draft, where, "draft_design_m", error));
    if (draft > depth)
        return error_set(error, ERROR_INPUT, "%s.draft_design_m: %g; at most the depth %g", where,
                         draft, depth);
    int levels = depth > draft * (1 + 1e-9) ? M + 1 : M;
    TRY(mesh_allocate(mesh, N + 1 + levels * 2 * N, levels * 4 * N + 2 * N, arena, error));
    int t = 0;
    for (int j = 0; j <= levels; j++)
        for (int i = 0; i <= N; i++) {
            double x = length * ((double)i / N - 0.5), z = j > M ? depth : draft * j / M;
            double y = wigley_half_breadth(x, z, length, beam, draft);
            if (i == 0 || i == N || j == 0) y = 0;
            mesh->vertices[wigley_vertex(i, j, 0)] = vec3(x, y, z);
            mesh->vertices[wigley_vertex(i, j, 1)] = vec3(x, -y, z);
        }
    for (int j = 0; j <= levels; j++)
        for (int i = 0; i < N; i++)
            for (int side = 0; side < 2; side++) {
                bool deck = j == levels;
                if (deck && side) continue;
                int a = wigley_vertex(i, j, side), b = wigley_vertex(i + 1, j, side);
                int c = deck ? wigley_vertex(i + 1, j, 1) : wigley_vertex(i + 1, j + 1, side);
                int d = deck ? wigley_vertex(i, j, 1) : wigley_vertex(i, j + 1, side);
                // the diagonal leans so that no triangle lies in the centre plane
                bool aft = 2 * i < N;
                int corners[2][3] = {{a, b, aft ? c : d}, {aft ? a : b, c, d}};
                for (int k = 0; k < 2; k++) {
                    int *p = corners[k];
                    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
                    bool turned = deck || side == 0;
                    set_triangle(mesh, &t, p[0], turned ? p[2] : p[1], turned ? p[1] : p[2]);
                }
            }
    mesh->triangle_count = t;
    return true;
}

static bool shape_in_2d(const BodyScene *body, const char *where, Error *error)
{
    bool section = body->shape == BODY_BOX || body->shape == BODY_POLYGON ||
                   (body->shape == BODY_CYLINDER && body->axis == 1);
    return section || error_set(error, ERROR_INPUT,
                                "%s.shape: has no x-z section in a 2-D domain; box, polygon, or "
                                "cylinder with axis \"y\" are accepted",
                                where);
}

bool mesh_create(const BodyScene *body, int dimensions, const char *where, Arena *arena,
                 TriangleMesh *mesh, Error *error)
{
    bool flat = dimensions == 2;
    if (flat) TRY(shape_in_2d(body, where, error));
    Vec3 size = body->size;
    if (flat) size.y = BREADTH_2D;
    switch (body->shape) {
    case BODY_BOX:
    case BODY_WIGLEY:
        TRY(positive(size.x, where, "size_m[0]", error));
        TRY(positive(size.y, where, "size_m[1]", error));
        TRY(positive(size.z, where, "size_m[2]", error));
        return body->shape == BODY_BOX ? box_create(size, arena, mesh, error)
                                       : wigley_create(body, where, arena, mesh, error);
    case BODY_SPHERE:
        TRY(positive(body->radius, where, "radius_m", error));
        return sphere_create(body->radius, arena, mesh, error);
    case BODY_CYLINDER:
        TRY(positive(body->radius, where, "radius_m", error));
        if (!flat) TRY(positive(body->length, where, "length_m", error));
        if (body->axis < 0 || body->axis > 2)
            return error_set(error, ERROR_INPUT, "%s.axis: %d; \"x\" (0), \"y\" (1) or \"z\" (2)",
                             where, body->axis);
        return cylinder_create(body->radius, flat ? BREADTH_2D : body->length, body->axis, arena,
                               mesh, error);
    case BODY_POLYGON:
        if (!flat) TRY(positive(body->breadth, where, "breadth_m", error));
        return polygon_create(body, flat ? BREADTH_2D : body->breadth, where, arena, mesh, error);
    case BODY_MESH: {
        Error inner = {0};
        if (!mesh_load(body->mesh_path, body->scale, arena, mesh, &inner))
            return error_set(error, inner.code, "%s.mesh %s", where, inner.message);
        char place[SCENE_PATH_SIZE + 64];
        snprintf(place, sizeof place, "%s.mesh \"%s\"", where, body->mesh_path);
        return mesh_check(mesh, place, error);
    }
    }
    return error_set(error, ERROR_INPUT, "%s.shape: unknown", where);
}
