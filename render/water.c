#include "parts.h"

#include <string.h>

/// A corner of the water's skin, as water.vert.glsl reads it.
typedef struct WaterVertex {
    float position[3], wet, normal[3], value, below;
} WaterVertex;

static GLuint water_program(const Gl *gl, const char *defines, Error *error)
{
    static const char *const samplers[] = {"opaque_colour", "opaque_depth", "maps",
                                           "mirror",        "cut",          NULL};
    return gl_program_variant(gl, "water", defines, samplers, error);
}

bool water_create(Water *water, const Gl *gl, int node_limit, Error *error)
{
    TRY(water->surface_program[0] = water_program(gl, "", error));
    TRY(water->surface_program[1] = water_program(gl, "#define COLOURED\n", error));
    TRY(water->wall_program[0] = water_program(gl, "#define WALL\n", error));
    TRY(water->wall_program[1] = water_program(gl, "#define WALL\n#define COLOURED\n", error));
    water->faces = gl->GetUniformLocation(water->wall_program[1], "faces");
    const int sizes[] = {4, 4, 1, 0};
    gl_mesh_create(gl, &water->surface, sizes);
    gl_mesh_create(gl, &water->walls, sizes);
    water->cut_texture = gl_texture(gl, GL_RGBA8, GL_RGBA, 1, 1, NULL);
    water->node_limit = node_limit;
    return true;
}

void water_destroy(Water *water, const Gl *gl)
{
    for (int coloured = 0; coloured < 2; coloured++) {
        gl->DeleteProgram(water->surface_program[coloured]);
        gl->DeleteProgram(water->wall_program[coloured]);
    }
    gl_mesh_destroy(gl, &water->surface);
    gl_mesh_destroy(gl, &water->walls);
    gl->DeleteTextures(1, &water->cut_texture);
    cut_faces_destroy(&water->cut);
    height_field_destroy(&water->field);
    scratch_free(&water->vertices);
    scratch_free(&water->scalar);
    scratch_free(&water->shell);
}

/// The drawn field of every particle. @return NULL without `error` when none is drawn
static float *particle_scalar(Water *water, const Frame *frame, Error *error)
{
    const Snapshot *snapshot = frame->snapshot;
    if (frame->field != FIELD_SPEED && frame->field != FIELD_PRESSURE) return NULL;
    float *scalar = scratch_need(&water->scalar,
                                 (size_t)maxd(snapshot->fluid_count, 1) * sizeof *scalar, error);
    if (!scalar) return NULL;
    for (int i = 0; i < snapshot->fluid_count; i++) {
        const float *v = snapshot->velocity[i];
        float value = frame->field == FIELD_SPEED ? sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
                                                  : snapshot->pressure[i];
        scalar[i] = isfinite(value) ? value : 0.0f;
    }
    return scalar;
}

/// Largest magnitude on the surface of what colours it.
static double largest_on_surface(const HeightField *field, const Frame *frame)
{
    double largest = 0.0;
    int nodes = field->count[0] * field->count[1];
    for (int n = 0; n < nodes; n++) {
        if (field->kind[n] != NODE_WATER) continue;
        double value = frame->field == FIELD_ELEVATION ? field->height[n] - frame->snapshot->level
                                                       : field->scalar[n];
        largest = maxd(largest, fabs(value));
    }
    return largest;
}

/// Largest magnitude among visible particles, a few stray ones left out.
static double largest_in_shell(const Water *water, const Frame *frame)
{
    const int *shell = water->shell.data;
    const float *scalar = water->scalar.data;
    double sum = 0.0, square = 0.0, largest = 0.0;
    for (int i = 0; i < water->shell_count; i++) {
        double value = frame->field == FIELD_ELEVATION
                           ? frame->snapshot->position[shell[i]][2] - frame->snapshot->level
                           : scalar[shell[i]];
        sum += fabs(value);
        square += value * value;
        largest = maxd(largest, fabs(value));
    }
    double count = maxd(water->shell_count, 1), mean = sum / count;
    return mind(largest, mean + 4.0 * sqrt(maxd(square / count - mean * mean, 0.0)));
}

bool water_update(Water *water, const Frame *frame, double *largest, Error *error)
{
    const Snapshot *snapshot = frame->snapshot;
    TRY(height_field_resize(&water->field, snapshot, water->node_limit, error));
    float *scalar = particle_scalar(water, frame, error);
    bool needed = frame->field == FIELD_SPEED || frame->field == FIELD_PRESSURE;
    TRY(scalar || !needed);
    height_field_build(&water->field, snapshot, scalar);
    water->shell_count = 0;
    if (frame->view->water == WATER_PARTICLES) {
        size_t size = (size_t)maxd(snapshot->fluid_count, 1) * sizeof(int);
        TRY(scratch_need(&water->shell, size, error));
        water->shell_count = height_field_shell(&water->field, snapshot, water->shell.data);
        *largest = largest_in_shell(water, frame);
    } else {
        *largest = largest_on_surface(&water->field, frame);
    }
    water->cut_shown = needed && frame->view->water == WATER_SURFACE;
    if (!water->cut_shown) return true;
    TRY(cut_faces_build(&water->cut, snapshot, scalar, frame->box_min, frame->box_max, error));
    int cells = water->cut.width * water->cut.rows;
    for (int i = 0; i < cells; i++)
        *largest = maxd(*largest, fabsf(water->cut.value[i]));
    return true;
}

/// Rows of the drawn grid: a slice has one row of nodes, drawn twice.
static int drawn_rows(const HeightField *field)
{
    return field->count[1] > 1 ? field->count[1] : 2;
}

/// Slope along an axis; at the foot of a front it includes the dry bed.
static float slope(const HeightField *field, int x, int y, int axis)
{
    int at = axis ? y : x, n = y * field->count[0] + x, stride = axis ? field->count[0] : 1;
    if (field->count[axis] < 2) return 0.0f;
    int low = at > 0 ? 1 : 0, high = at + 1 < field->count[axis] ? 1 : 0;
    float rise = field->height[n + high * stride] - field->height[n - low * stride];
    return rise / (float)((low + high) * field->cell[axis]);
}

/// Water, or the foot of a front: a dry node beside a wet one, down to which the surface is draped.
static bool is_drawn(const HeightField *field, int x, int y)
{
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++)
            if (i >= 0 && j >= 0 && i < field->count[0] && j < field->count[1] &&
                field->kind[j * field->count[0] + i] != NODE_DRY)
                return true;
    return false;
}

static void surface_vertices(const HeightField *field, const Frame *frame, WaterVertex *out)
{
    int rows = drawn_rows(field);
    for (int j = 0; j < rows; j++) {
        int y = field->count[1] > 1 ? j : 0;
        double place = frame->box_min.y + (frame->box_max.y - frame->box_min.y) * j / (rows - 1);
        for (int x = 0; x < field->count[0]; x++) {
            int n = y * field->count[0] + x;
            float dx = slope(field, x, y, 0), dy = slope(field, x, y, 1);
            float norm = 1.0f / sqrtf(1.0f + dx * dx + dy * dy);
            *out++ = (WaterVertex){
                .position = {(float)(field->origin[0] + x * field->cell[0]), (float)place,
                             field->height[n]},
                .wet = is_drawn(field, x, y),
                .normal = {-dx * norm, -dy * norm, norm},
                .value = field->scalar[n],
                .below = -1.0f,
            };
        }
    }
}

/// Number of nodes round the edge of the drawn grid, corners once per side.
static int edge_count(const HeightField *field)
{
    return 2 * (field->count[0] + drawn_rows(field));
}

/// Two corners per node of the edge, at the surface and at the bed; side after side.
static void wall_vertices(const Water *water, const Frame *frame, const WaterVertex *surface,
                          WaterVertex *out)
{
    const HeightField *field = &water->field;
    const float sides[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    int columns = field->count[0], rows = drawn_rows(field);
    float bed = (float)frame->box_min.z;
    for (int side = 0; side < 4; side++) {
        int count = side % 2 ? rows : columns;
        for (int i = 0; i < count; i++) {
            int x = side % 2 ? (side == 1 ? columns - 1 : 0) : i;
            int y = side % 2 ? i : (side == 2 ? rows - 1 : 0);
            WaterVertex top = surface[y * columns + x];
            top.normal[0] = sides[side][0];
            top.normal[1] = sides[side][1];
            top.normal[2] = 0.0f;
            top.below = 0.0f;
            if (water->cut_shown)
                top.value = (float)cut_faces_u(&water->cut, side, (double)i / (count - 1));
            WaterVertex foot = top;
            foot.position[2] = bed;
            foot.below = maxf(top.position[2] - bed, 0.0f);
            *out++ = top;
            *out++ = foot;
        }
    }
}

static bool make_indices(Water *water, const Gl *gl, Error *error)
{
    int columns = water->field.count[0], rows = drawn_rows(&water->field);
    if (water->shape[0] == columns && water->shape[1] == rows) return true;
    size_t room = (size_t)6 * columns * rows + (size_t)6 * edge_count(&water->field);
    GLuint *indices = scratch_need(&water->vertices, room * sizeof *indices, error);
    TRY(indices);
    int count = 0;
    for (int j = 0; j + 1 < rows; j++)
        for (int i = 0; i + 1 < columns; i++) {
            GLuint a = (GLuint)(j * columns + i), b = a + 1, c = a + (GLuint)columns, d = c + 1;
            const GLuint quad[6] = {a, b, d, a, d, c};
            memcpy(indices + count, quad, sizeof quad);
            count += 6;
        }
    gl_mesh_indices(gl, &water->surface, indices, count);
    count = 0;
    for (int side = 0, node = 0; side < 4; side++) {
        int length = side % 2 ? rows : columns;
        for (int i = 0; i + 1 < length; i++) {
            GLuint a = (GLuint)(2 * (node + i));
            const GLuint quad[6] = {a, a + 1, a + 2, a + 2, a + 1, a + 3};
            memcpy(indices + count, quad, sizeof quad);
            count += 6;
        }
        node += length;
    }
    gl_mesh_indices(gl, &water->walls, indices, count);
    water->shape[0] = columns;
    water->shape[1] = rows;
    return true;
}

bool water_draw(Water *water, const Gl *gl, const Frame *frame, Error *error)
{
    const HeightField *field = &water->field;
    TRY(make_indices(water, gl, error));
    size_t nodes = (size_t)field->count[0] * drawn_rows(field);
    size_t edge = 2 * (size_t)edge_count(field);
    WaterVertex *vertices =
        scratch_need(&water->vertices, (nodes + edge) * sizeof *vertices, error);
    TRY(vertices);
    surface_vertices(field, frame, vertices);
    wall_vertices(water, frame, vertices, vertices + nodes);
    gl_mesh_vertices(gl, &water->surface, vertices, nodes * sizeof *vertices);
    gl_mesh_vertices(gl, &water->walls, vertices + nodes, edge * sizeof *vertices);
    if (water->cut_shown) {
        gl->ActiveTexture(GL_TEXTURE4);
        gl->BindTexture(GL_TEXTURE_2D, water->cut_texture);
        gl->TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, water->cut.width, water->cut.rows, 0, GL_RED,
                       GL_FLOAT, water->cut.value);
    }
    gl->UseProgram(water->wall_program[water->cut_shown]);
    if (water->cut_shown)
        gl->Uniform3f(water->faces, (float)water->cut.bed, (float)water->cut.step,
                      (float)water->cut.rows);
    gl->BindVertexArray(water->walls.array);
    gl->DrawElements(GL_TRIANGLES, water->walls.index_count, GL_UNSIGNED_INT, NULL);
    gl->UseProgram(water->surface_program[frame->field != FIELD_NONE]);
    gl->BindVertexArray(water->surface.array);
    gl->DrawElements(GL_TRIANGLES, water->surface.index_count, GL_UNSIGNED_INT, NULL);
    return true;
}
