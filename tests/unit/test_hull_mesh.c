// Mesh files and the check that a mesh bounds a volume.
#include "hull.h"
#include "test.h"

#include <stdlib.h>
#include <unistd.h>

static const char *const TETRAHEDRON_OBJ = "# a corner of a cube\n"
                                           "o corner\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1 1.0\n"
                                           "vn 0 0 1\n"
                                           "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\n"
                                           "f 1 4 3\nf -3 -2 -1\n";

/// Load a mesh from text or bytes put into a temporary file.
static bool load_bytes(const void *bytes, size_t size, const char *ending, double scale,
                       Arena *arena, TriangleMesh *mesh, Error *error)
{
    char path[64];
    snprintf(path, sizeof path, "/tmp/fairlead_test_%d%s", (int)getpid(), ending);
    FILE *file = fopen(path, "wb");
    if (!file) return error_set(error, ERROR_SYSTEM, "no temporary file");
    fwrite(bytes, 1, size, file);
    fclose(file);
    bool good = mesh_load(path, scale, arena, mesh, error);
    unlink(path);
    return good;
}

static bool load_text(const char *text, const char *ending, Arena *arena, TriangleMesh *mesh,
                      Error *error)
{
    return load_bytes(text, strlen(text), ending, 1, arena, mesh, error);
}

static size_t to_binary_stl(const TriangleMesh *mesh, unsigned char *bytes)
{
    memset(bytes, 0, 84);
    memcpy(bytes, "solid like some exporters write", 31);
    unsigned count = (unsigned)mesh->triangle_count;
    for (int k = 0; k < 4; k++)
        bytes[80 + k] = (unsigned char)(count >> 8 * k);
    unsigned char *at = bytes + 84;
    for (int i = 0; i < mesh->triangle_count; i++) {
        memset(at, 0, 50);
        for (int k = 0; k < 3; k++) {
            Vec3 v = mesh->vertices[mesh->triangles[i][k]];
            float f[3] = {(float)v.x, (float)v.y, (float)v.z};
            memcpy(at + 12 + 12 * k, f, 12);
        }
        at += 50;
    }
    return (size_t)(at - bytes);
}

TEST(obj_with_texture_and_negative_indices_is_read)
{
    Arena arena = arena_create(0);
    TriangleMesh mesh;
    Error error = {0};
    CHECK(load_text(TETRAHEDRON_OBJ, ".obj", &arena, &mesh, &error));
    CHECK(mesh.vertex_count == 4 && mesh.triangle_count == 4);
    CHECK(mesh_check(&mesh, "bodies[0].mesh", &error));
    CHECK_NEAR(mesh_properties(&mesh).volume, 1.0 / 6, 1e-15);
    arena_destroy(&arena);
}

TEST(obj_scale_multiplies_lengths)
{
    Arena arena = arena_create(0);
    TriangleMesh mesh;
    Error error = {0};
    CHECK(load_bytes(TETRAHEDRON_OBJ, strlen(TETRAHEDRON_OBJ), ".obj", 0.1, &arena, &mesh, &error));
    CHECK_NEAR(mesh_properties(&mesh).volume, 1e-3 / 6, 1e-15);
    CHECK(
        !load_bytes(TETRAHEDRON_OBJ, strlen(TETRAHEDRON_OBJ), ".obj", NAN, &arena, &mesh, &error));
    CHECK_CONTAINS(error.message, "scale");
    arena_destroy(&arena);
}

TEST(binary_stl_that_starts_with_solid_is_read_and_welded)
{
    Arena arena = arena_create(0);
    TriangleMesh sphere, mesh;
    Error error = {0};
    BodyScene body = {.shape = BODY_SPHERE, .radius = 0.4};
    CHECK(mesh_create(&body, 3, "bodies[0]", &arena, &sphere, &error));
    unsigned char *bytes = malloc(84 + 50 * (size_t)sphere.triangle_count);
    size_t size = to_binary_stl(&sphere, bytes);
    CHECK(load_bytes(bytes, size, ".STL", 1, &arena, &mesh, &error) || !error.message[0]);
    CHECK(load_bytes(bytes, size, ".stl", 1, &arena, &mesh, &error));
    CHECK(mesh.vertex_count == sphere.vertex_count);
    CHECK(mesh_check(&mesh, "bodies[0].mesh", &error));
    CHECK_NEAR(mesh_properties(&mesh).volume, mesh_properties(&sphere).volume, 1e-7);
    free(bytes);
    arena_destroy(&arena);
}

TEST(corners_that_differ_by_rounding_are_welded)
{
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                               "v 1e-7 0 0\nv 0.9999999 0 1e-7\nv 0 1.0000001 0\n"
                               "f 1 3 2\nf 5 6 4\nf 1 4 7\nf 2 3 4\n";
    Arena arena = arena_create(0);
    TriangleMesh mesh;
    Error error = {0};
    CHECK(load_text(text, ".obj", &arena, &mesh, &error));
    CHECK(mesh.vertex_count == 4);
    CHECK(mesh_check(&mesh, "m", &error));
    arena_destroy(&arena);
}

TEST(ascii_stl_is_read)
{
    static const char text[] = "solid t\n"
                               "facet normal 0 0 -1\n outer loop\n  vertex 0 0 0\n  vertex 0 1 0\n "
                               " vertex 1 0 0\n endloop\nendfacet\n"
                               "facet normal 0 -1 0\n outer loop\n  vertex 0 0 0\n  vertex 1e0 0 "
                               "0\n  vertex 0 0 1\n endloop\nendfacet\r\n"
                               "facet normal -1 0 0\n outer loop\n  vertex 0 0 0\n  vertex 0 0 1\n "
                               " vertex 0 1 0\n endloop\nendfacet\n"
                               "FACET NORMAL 1 1 1\n OUTER LOOP\n  VERTEX 1 0 0\n  VERTEX 0 1 0\n  "
                               "VERTEX 0 0 1\n ENDLOOP\nENDFACET\n"
                               "endsolid t\n";
    Arena arena = arena_create(0);
    TriangleMesh mesh;
    Error error = {0};
    CHECK(load_text(text, ".stl", &arena, &mesh, &error));
    CHECK(mesh.vertex_count == 4 && mesh.triangle_count == 4);
    CHECK(mesh_check(&mesh, "m", &error));
    arena_destroy(&arena);
}

TEST(bad_files_are_refused_with_file_and_reason)
{
    static const struct {
        const char *ending, *text, *reason;
    } cases[] = {
        {".obj", "v 0 0 zero\n", "line 1"},
        {".obj", "v 0 0 0\nv nan 0 0\n", "line 2: vertex"},
        {".obj", "v 0 0 0\nv 1e300 0 0\n", "finite coordinates"},
        {".obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "vertex 3 of 2"},
        {".obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "face of 2 corners"},
        {".obj", "v 0 0 0\nf 1 -9999999999999999999 1\n", "does not exist"},
        {".obj", "v 0 0 0\nf 1 x 1\n", "vertex indices"},
        {".obj", "hello world\n", "line 1: \"hello world\" is not a statement of OBJ"},
        {".obj", "v 0 0 0\n", "no triangles"},
        {".obj", "", "no triangles"},
        {".stl", "", "0 bytes"},
        {".stl", "solid x\nendsolid x\n", "no triangles"},
        {".stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "line 4"},
        {".stl", "solid x\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nendloop\n", "2 vertices"},
        {".stl", "solid x\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 1 0\n", "truncated"},
        {".stl", "solid x\ngarbage\n", "line 2"},
        {".ply", "ply\n", ".stl or .obj"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena arena = arena_create(0);
        TriangleMesh mesh;
        Error error = {0};
        CHECK(!load_text(cases[i].text, cases[i].ending, &arena, &mesh, &error));
        CHECK(error.code == ERROR_INPUT);
        CHECK_CONTAINS(error.message, cases[i].reason);
        CHECK_CONTAINS(error.message, "fairlead_test_");
        arena_destroy(&arena);
    }
}

TEST(missing_file_and_folder_are_refused)
{
    Arena arena = arena_create(0);
    TriangleMesh mesh;
    Error error = {0};
    CHECK(!mesh_load("/nowhere/ship.stl", 1, &arena, &mesh, &error));
    CHECK_CONTAINS(error.message, "\"/nowhere/ship.stl\": no such file");
    BodyScene body = {.shape = BODY_MESH, .scale = 1};
    strcpy(body.mesh_path, "/nowhere/ship.stl");
    CHECK(!mesh_create(&body, 3, "bodies[2]", &arena, &mesh, &error));
    CHECK_CONTAINS(error.message, "bodies[2].mesh \"/nowhere/ship.stl\"");
    arena_destroy(&arena);
}

TEST(binary_stl_with_lying_count_or_nan_is_refused)
{
    Arena arena = arena_create(0);
    TriangleMesh box, mesh;
    Error error = {0};
    BodyScene body = {.shape = BODY_BOX, .size = {1, 1, 1}};
    CHECK(mesh_create(&body, 3, "bodies[0]", &arena, &box, &error));
    unsigned char bytes[84 + 50 * 12 + 7];
    size_t size = to_binary_stl(&box, bytes);
    memcpy(bytes, "binary", 6);
    CHECK(!load_bytes(bytes, size - 1, ".stl", 1, &arena, &mesh, &error));
    CHECK_CONTAINS(error.message, "announces 12 triangles");
    bytes[83] = 0xff;
    CHECK(!load_bytes(bytes, size, ".stl", 1, &arena, &mesh, &error));
    CHECK_CONTAINS(error.message, "truncated");
    bytes[83] = 0;
    float nan_value = NAN;
    memcpy(bytes + 84 + 50 * 3 + 12, &nan_value, 4);
    CHECK(!load_bytes(bytes, size, ".stl", 1, &arena, &mesh, &error));
    CHECK_CONTAINS(error.message, "triangle 4");
    arena_destroy(&arena);
}

/// A box whose mesh a test may spoil.
static TriangleMesh box_mesh(Arena *arena)
{
    BodyScene body = {.shape = BODY_BOX, .size = {1, 2, 3}};
    TriangleMesh mesh;
    Error error = {0};
    CHECK(mesh_create(&body, 3, "bodies[0]", arena, &mesh, &error));
    CHECK(mesh_check(&mesh, "bodies[0]", &error));
    return mesh;
}

TEST(open_mesh_is_refused_with_count_and_place)
{
    Arena arena = arena_create(0);
    TriangleMesh mesh = box_mesh(&arena);
    Error error = {0};
    mesh.triangle_count--;
    CHECK(!mesh_check(&mesh, "bodies[0].mesh \"x.stl\"", &error));
    CHECK_CONTAINS(error.message, "bodies[0].mesh \"x.stl\": open: 3 edges have one triangle only");
    CHECK_CONTAINS(error.message, "first near (");
    CHECK_CONTAINS(error.message, "a closed, outward oriented mesh is needed");
    arena_destroy(&arena);
}

static void flip(int *triangle)
{
    int first = triangle[0];
    triangle[0] = triangle[1];
    triangle[1] = first;
}

TEST(one_flipped_triangle_is_refused)
{
    Arena arena = arena_create(0);
    TriangleMesh mesh = box_mesh(&arena);
    Error error = {0};
    flip(mesh.triangles[5]);
    CHECK(!mesh_check(&mesh, "m", &error));
    CHECK_CONTAINS(error.message, "3 edges lie between triangles of opposite orientation");
    arena_destroy(&arena);
}

TEST(inward_mesh_is_refused_and_named_inward)
{
    Arena arena = arena_create(0);
    TriangleMesh mesh = box_mesh(&arena);
    Error error = {0};
    for (int i = 0; i < mesh.triangle_count; i++)
        flip(mesh.triangles[i]);
    CHECK(!mesh_check(&mesh, "m", &error));
    CHECK_CONTAINS(error.message, "oriented inward");
    arena_destroy(&arena);
}

TEST(doubled_and_flat_triangles_are_refused)
{
    Arena arena = arena_create(0);
    TriangleMesh mesh = box_mesh(&arena);
    Error error = {0};
    memcpy(mesh.triangles[1], mesh.triangles[0], sizeof mesh.triangles[0]);
    CHECK(!mesh_check(&mesh, "m", &error));
    arena_destroy(&arena);

    static const char *const flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv .5 0 0\n"
                                    "f 1 3 2\nf 1 5 4\nf 5 2 4\nf 1 2 5\nf 1 4 3\nf 2 3 4\n";
    CHECK(load_text(flat, ".obj", &arena, &mesh, &error));
    CHECK(!mesh_check(&mesh, "m", &error));
    CHECK_CONTAINS(error.message, "1 triangle has no area");
    arena_destroy(&arena);
}

TEST(garbage_never_crashes_the_readers)
{
    unsigned seed = 12345;
    for (int round_ = 0; round_ < 300; round_++) {
        unsigned char bytes[1200];
        size_t size = round_ % 2 ? strlen(TETRAHEDRON_OBJ) : sizeof bytes;
        for (size_t i = 0; i < size; i++) {
            seed = seed * 1664525u + 1013904223u;
            bool spoil = round_ % 2 == 0 || (seed >> 16) % 25 == 0;
            bytes[i] = spoil ? (unsigned char)(seed >> 24) : (unsigned char)TETRAHEDRON_OBJ[i];
        }
        if (round_ % 3 == 0) memcpy(bytes, "solid", 5);
        Arena arena = arena_create(0);
        TriangleMesh mesh;
        Error error = {0};
        if (load_bytes(bytes, size, round_ % 2 ? ".obj" : ".stl", 1, &arena, &mesh, &error))
            mesh_check(&mesh, "m", &error);
        else
            CHECK(error.code == ERROR_INPUT && error.message[0]);
        arena_destroy(&arena);
    }
}
