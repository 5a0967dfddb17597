#include "parts.h"

static const double least_half_width = 1.4; ///< [pixel] of a picture 540 high
static const double anchor_size = 0.008;    ///< of the scene's radius

/// One corner of a ribbon: the nodes before, here and after, side, tension.
typedef struct LineVertex {
    float before[3], here[3], after[3], side, tension;
} LineVertex;

bool lines_create(Lines *lines, const Gl *gl, Error *error)
{
    static const char *const samplers[] = {"maps", NULL};
    TRY(lines->program = gl_program(gl, "line", samplers, error));
    lines->size = gl->GetUniformLocation(lines->program, "size");
    const int sizes[] = {3, 3, 3, 2, 0};
    gl_mesh_create(gl, &lines->mesh, sizes);
    return true;
}

void lines_destroy(Lines *lines, const Gl *gl)
{
    gl->DeleteProgram(lines->program);
    gl_mesh_destroy(gl, &lines->mesh);
    scratch_free(&lines->vertices);
    scratch_free(&lines->indices);
}

static bool finite_point(const float *p) { return isfinite(p[0] + p[1] + p[2]); }

static void put_pair(LineVertex *out, const float *before, const float *here, const float *after,
                     float tension)
{
    for (int side = 0; side < 2; side++) {
        for (int k = 0; k < 3; k++) {
            out[side].before[k] = before[k];
            out[side].here[k] = here[k];
            out[side].after[k] = after[k];
        }
        out[side].side = side ? 1.0f : -1.0f;
        out[side].tension = tension;
    }
}

/// Ribbon of one line; a line with a node that is not finite is left out. @return vertices written
static int line_vertices(const LineSnapshot *line, LineVertex *out)
{
    int nodes = line->node_count;
    for (int n = 0; n < nodes; n++)
        if (!finite_point(line->position[n])) return 0;
    if (nodes < 2) return 0;
    for (int n = 0; n < nodes; n++) {
        float low = line->tension[n > 0 ? n - 1 : 0];
        float high = line->tension[n < nodes - 1 ? n : nodes - 2];
        float tension = 0.5f * (low + high);
        put_pair(out + 2 * n, line->position[n > 0 ? n - 1 : 0], line->position[n],
                 line->position[n < nodes - 1 ? n + 1 : n], isfinite(tension) ? tension : 0.0f);
    }
    return 2 * nodes;
}

/// A post on the bed: a short upright ribbon, drawn wide; the tension -1 means plain dark.
static int anchor_vertices(const LineSnapshot *line, double size, LineVertex *out)
{
    if (line->node_count < 2 || !finite_point(line->position[0])) return 0;
    const float *foot = line->position[0];
    const float low[3] = {foot[0], foot[1], foot[2] - (float)size};
    const float top[3] = {foot[0], foot[1], foot[2] + (float)size};
    put_pair(out, low, low, top, -1.0f);
    put_pair(out + 2, low, top, top, -1.0f);
    return 4;
}

/// Two triangles per segment of a strip of `vertices` corners. @return indices written
static int strip_indices(GLuint base, int vertices, GLuint *out)
{
    int count = 0;
    for (GLuint v = 0; (int)v + 3 < vertices; v += 2) {
        const GLuint quad[6] = {v, v + 1, v + 2, v + 2, v + 1, v + 3};
        for (int k = 0; k < 6; k++)
            out[count++] = base + quad[k];
    }
    return count;
}

bool lines_draw(Lines *lines, const Gl *gl, const Frame *frame, double veil, Error *error)
{
    const Snapshot *snapshot = frame->snapshot;
    size_t room = 0;
    for (int l = 0; l < snapshot->line_count; l++)
        room += 2 * (size_t)maxd(snapshot->lines[l].node_count, 0) + 4;
    if (!room) return true;
    LineVertex *vertices = scratch_need(&lines->vertices, room * sizeof *vertices, error);
    GLuint *indices = scratch_need(&lines->indices, room * 3 * sizeof *indices, error);
    TRY(vertices && indices);
    int count = 0, index_count = 0, ends[SCENE_LINES_MAX];
    for (int l = 0; l < snapshot->line_count; l++) {
        int made = line_vertices(&snapshot->lines[l], vertices + count);
        index_count += strip_indices((GLuint)count, made, indices + index_count);
        count += made;
        ends[l] = index_count;
    }
    int line_indices = index_count;
    for (int l = 0; l < snapshot->line_count; l++) {
        int made = anchor_vertices(&snapshot->lines[l], anchor_size * frame->block.range.z,
                                   vertices + count);
        index_count += strip_indices((GLuint)count, made, indices + index_count);
        count += made;
    }
    gl_mesh_vertices(gl, &lines->mesh, vertices, (size_t)count * sizeof *vertices);
    gl_mesh_indices(gl, &lines->mesh, indices, index_count);

    float pixels = (float)(least_half_width * frame->block.target.y / 540.0);
    gl->UseProgram(lines->program);
    gl->BindVertexArray(lines->mesh.array);
    gl->Enable(GL_BLEND);
    gl->DepthMask(GL_FALSE);
    for (int l = 0, begin = 0; l < snapshot->line_count; begin = ends[l++]) {
        gl->Uniform4f(lines->size, 0.5f * (float)snapshot->lines[l].diameter, pixels, (float)veil,
                      0);
        gl->DrawElements(GL_TRIANGLES, ends[l] - begin, GL_UNSIGNED_INT,
                         (const void *)((size_t)begin * sizeof *indices));
    }
    gl->Uniform4f(lines->size, (float)(0.6 * anchor_size * frame->block.range.z), 2.0f * pixels,
                  (float)veil, 0);
    gl->DrawElements(GL_TRIANGLES, index_count - line_indices, GL_UNSIGNED_INT,
                     (const void *)((size_t)line_indices * sizeof *indices));
    gl->DepthMask(GL_TRUE);
    gl->Disable(GL_BLEND);
    return true;
}
