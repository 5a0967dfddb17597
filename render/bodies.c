#include "parts.h"

#include <string.h>

static const double crease_angle = 38.0 * PI / 180.0;
/// Below the waterline: red-brown, or dark grey under a hull that is red itself.
static const float bottom_paints[2][3] = {{0.47f, 0.15f, 0.12f}, {0.15f, 0.17f, 0.20f}};

bool bodies_create(Bodies *bodies, const Gl *gl, Error *error)
{
    TRY(bodies->program = gl_program(gl, "body", NULL, error));
    bodies->world_from_body = gl->GetUniformLocation(bodies->program, "world_from_body");
    bodies->flip = gl->GetUniformLocation(bodies->program, "flip");
    bodies->paint = gl->GetUniformLocation(bodies->program, "paint");
    bodies->anti = gl->GetUniformLocation(bodies->program, "anti");
    return true;
}

void bodies_destroy(Bodies *bodies, const Gl *gl)
{
    gl->DeleteProgram(bodies->program);
    for (int b = 0; b < SCENE_BODIES_MAX; b++)
        if (bodies->meshes[b].mesh.array) gl_mesh_destroy(gl, &bodies->meshes[b].mesh);
    scratch_free(&bodies->vertices);
}

/// Normal of a face times twice its area.
static Vec3 face_normal(const TriangleMesh *mesh, int triangle)
{
    const int *corner = mesh->triangles[triangle];
    Vec3 a = mesh->vertices[corner[0]];
    return vec3_cross(vec3_sub(mesh->vertices[corner[1]], a),
                      vec3_sub(mesh->vertices[corner[2]], a));
}

/// The faces around each vertex: faces[first[v]] to faces[first[v + 1]].
static void faces_around(const TriangleMesh *mesh, int *first, int *faces)
{
    for (int t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            first[mesh->triangles[t][k] + 1]++;
    for (int v = 0; v < mesh->vertex_count; v++)
        first[v + 1] += first[v];
    // Filled from the end of each range, which leaves `first` one vertex early; then moved back.
    for (int t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            faces[--first[mesh->triangles[t][k] + 1]] = t;
    for (int v = 0; v < mesh->vertex_count; v++)
        first[v] = first[v + 1];
    first[mesh->vertex_count] = 3 * mesh->triangle_count;
}

bool crease_normals(const TriangleMesh *mesh, double crease, float *out, Error *error)
{
    int *first = calloc((size_t)mesh->vertex_count + 1, sizeof *first);
    int *faces = calloc((size_t)mesh->triangle_count * 3 + 1, sizeof *faces);
    Vec3 *normals = calloc((size_t)mesh->triangle_count + 1, sizeof *normals);
    bool enough = first && faces && normals;
    if (enough) {
        const double smooth = cos(crease);
        for (int t = 0; t < mesh->triangle_count; t++)
            normals[t] = face_normal(mesh, t);
        faces_around(mesh, first, faces);
        for (int c = 0; c < mesh->triangle_count * 3; c++) {
            int vertex = mesh->triangles[c / 3][c % 3];
            Vec3 own = normals[c / 3], sum = vec3(0, 0, 0), at = mesh->vertices[vertex];
            for (int f = first[vertex]; f < first[vertex + 1]; f++) {
                Vec3 other = normals[faces[f]];
                if (vec3_dot(own, other) >= smooth * vec3_norm(own) * vec3_norm(other))
                    sum = vec3_add(sum, other);
            }
            sum = vec3_unit(vec3_norm(sum) > 0 ? sum : own);
            const float corner[6] = {(float)at.x,  (float)at.y,  (float)at.z,
                                     (float)sum.x, (float)sum.y, (float)sum.z};
            memcpy(out + (size_t)c * 6, corner, sizeof corner);
        }
    }
    free(first);
    free(faces);
    free(normals);
    return enough || error_set(error, ERROR_SYSTEM, "out of memory for a body's normals");
}

/// FNV-1a over vertices and triangles: an address alone does not tell one engine's mesh from the
/// next one's.
static uint64_t mesh_hash(const TriangleMesh *mesh)
{
    uint64_t hash = 14695981039346656037u;
    const struct {
        const void *data;
        size_t size;
    } pieces[] = {{mesh->vertices, (size_t)mesh->vertex_count * sizeof *mesh->vertices},
                  {mesh->triangles, (size_t)mesh->triangle_count * sizeof *mesh->triangles}};
    for (int p = 0; p < 2; p++) {
        const uint32_t *words = pieces[p].data;
        for (size_t i = 0; i < pieces[p].size / sizeof *words; i++)
            hash = (hash ^ words[i]) * 1099511628211u;
    }
    return hash ? hash : 1;
}

/// Two paints for a body whose still waterline lies well within its height.
static void choose_paint(BodyMesh *body, const BodySnapshot *snapshot, double level)
{
    double low = INFINITY, high = -INFINITY;
    for (int v = 0; v < snapshot->mesh->vertex_count; v++) {
        low = mind(low, snapshot->mesh->vertices[v].z);
        high = maxd(high, snapshot->mesh->vertices[v].z);
    }
    double up = quat_rotate(snapshot->attitude, vec3(0, 0, 1)).z;
    body->waterline = level - snapshot->origin.z;
    double share = (body->waterline - low) / (high - low);
    body->boot_top = up > 0.9 && share > 0.08 && share < 0.92 ? 0.035 * (high - low) : 0.0;
}

bool bodies_update(Bodies *bodies, const Gl *gl, const Frame *frame, Error *error)
{
    const Snapshot *snapshot = frame->snapshot;
    bool restarted = snapshot->time < bodies->last_time;
    bodies->last_time = snapshot->time;
    for (int b = 0; b < snapshot->body_count; b++) {
        const TriangleMesh *mesh = snapshot->bodies[b].mesh;
        BodyMesh *body = &bodies->meshes[b];
        if (!mesh || mesh->triangle_count < 1) {
            body->mesh.index_count = 0;
            body->hash = 0;
            continue;
        }
        uint64_t hash = mesh_hash(mesh);
        if (hash != body->hash || restarted)
            choose_paint(body, &snapshot->bodies[b], snapshot->level);
        if (hash == body->hash) continue;
        size_t size = (size_t)mesh->triangle_count * 18 * sizeof(float);
        float *vertices = scratch_need(&bodies->vertices, size, error);
        TRY(vertices && crease_normals(mesh, crease_angle, vertices, error));
        const int sizes[] = {3, 3, 0};
        if (!body->mesh.array) gl_mesh_create(gl, &body->mesh, sizes);
        gl_mesh_vertices(gl, &body->mesh, vertices, size);
        body->mesh.index_count = mesh->triangle_count * 3; // drawn without indices
        body->hash = hash;
    }
    return true;
}

void bodies_draw(const Bodies *bodies, const Gl *gl, const Frame *frame, const HeightField *mirror)
{
    gl->UseProgram(bodies->program);
    for (int b = 0; b < frame->snapshot->body_count; b++) {
        const BodySnapshot *snapshot = &frame->snapshot->bodies[b];
        const BodyMesh *body = &bodies->meshes[b];
        if (!body->mesh.index_count) continue;
        Mat4 pose = mat4_pose(snapshot->attitude, snapshot->origin);
        const double *colour = snapshot->colour;
        gl->UniformMatrix4fv(bodies->world_from_body, 1, GL_FALSE, pose.m);
        double level = mirror ? height_field_sample(mirror, pose.m[12], pose.m[13]) : 0.0;
        gl->Uniform4f(bodies->flip, mirror ? -1.0f : 1.0f, (float)level, (float)frame->breadth, 0);
        gl->Uniform4f(bodies->paint, (float)colour[0], (float)colour[1], (float)colour[2],
                      (float)body->waterline);
        bool red = colour[0] > 1.6 * colour[1] && colour[0] > 1.6 * colour[2];
        const float *bottom_paint = bottom_paints[red];
        gl->Uniform4f(bodies->anti, bottom_paint[0], bottom_paint[1], bottom_paint[2],
                      (float)body->boot_top);
        gl->BindVertexArray(body->mesh.array);
        gl->DrawArrays(GL_TRIANGLES, 0, body->mesh.index_count);
    }
}
