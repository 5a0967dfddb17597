#include "colour_map.h"
#include "parts.h"

enum { TANK_EDGES = 12 };

static const double least_half_width = 1.4; ///< [pixel] of a picture 540 high
static const double anchor_size = 0.008;    ///< of the scene's radius
static const double near_largest = 0.9;     ///< of a line's largest tension so far: drawn thick
static const double worth_telling = 1.5;    ///< a largest tension below this many times rest is not

/// What a stretch of line is told as: in the scale's colours, plainly slack, or thick.
typedef enum LineMark { MARK_WORKING, MARK_SLACK, MARK_NEAR_LARGEST } LineMark;

/// One corner of a ribbon: the nodes before, here and after, side, tension, mark.
typedef struct LineVertex {
    float before[3], here[3], after[3], side, tension, mark;
} LineVertex;

bool lines_create(Lines *lines, const Gl *gl, Error *error)
{
    static const char *const samplers[] = {"maps", NULL};
    TRY(lines->program = gl_program(gl, "line", samplers, error));
    lines->size = gl->GetUniformLocation(lines->program, "size");
    lines->slack = gl->GetUniformLocation(lines->program, "slack");
    const int sizes[] = {3, 3, 3, 3, 0};
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
                     float tension, LineMark mark)
{
    for (int side = 0; side < 2; side++) {
        for (int k = 0; k < 3; k++) {
            out[side].before[k] = before[k];
            out[side].here[k] = here[k];
            out[side].after[k] = after[k];
        }
        out[side].side = side ? 1.0f : -1.0f;
        out[side].tension = tension;
        out[side].mark = (float)mark;
    }
}

static LineMark mark_of(const LineSnapshot *line, double tension)
{
    if (tension < line->slack) return MARK_SLACK;
    bool told = line->largest >= worth_telling * line->rest && line->rest > 0;
    return told && tension >= near_largest * line->largest ? MARK_NEAR_LARGEST : MARK_WORKING;
}

/// Tension drawn at a node: the mean of the segments on either side that have not parted.
static float node_tension(const LineSnapshot *line, int node)
{
    float sum = 0.0f;
    int count = 0;
    for (int s = node - 1; s <= node; s++) {
        if (s < 0 || s + 1 >= line->node_count) continue;
        if (!isfinite(line->tension[s]) || line->tension[s] < 0.0f) continue;
        sum += line->tension[s];
        count++;
    }
    return count ? sum / (float)count : 0.0f;
}

/// Ribbon of the nodes from `first` to the next parted segment or the end.
/// @param next  filled: the node behind them   @return vertices written
static int piece_vertices(const LineSnapshot *line, int first, int *next, LineVertex *out)
{
    int last = first;
    while (last + 1 < line->node_count && !(line->tension[last] < 0.0f))
        last++;
    *next = last + 1;
    if (last == first) return 0;
    for (int n = first; n <= last; n++) {
        float tension = node_tension(line, n);
        put_pair(out + 2 * (n - first), line->position[n > first ? n - 1 : n], line->position[n],
                 line->position[n < last ? n + 1 : n], tension, mark_of(line, tension));
    }
    return 2 * (last - first + 1);
}

static bool can_be_drawn(const LineSnapshot *line)
{
    for (int n = 0; n < line->node_count; n++)
        if (!finite_point(line->position[n])) return false;
    return line->node_count >= 2;
}

/// A post at a node: a short upright ribbon, drawn wide; the tension -1 means plain dark.
static int post_vertices(const LineSnapshot *line, int node, double size, LineVertex *out)
{
    if (line->node_count < 2 || node < 0 || !finite_point(line->position[node])) return 0;
    const float *foot = line->position[node];
    const float low[3] = {foot[0], foot[1], foot[2] - (float)size};
    const float top[3] = {foot[0], foot[1], foot[2] + (float)size};
    put_pair(out, low, low, top, -1.0f, MARK_WORKING);
    put_pair(out + 2, low, top, top, -1.0f, MARK_WORKING);
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

/// The edges of a tank with walls, as plain ribbons; -2 instead of a tension means pale.
static int tank_vertices(const Frame *frame, LineVertex *out)
{
    const Domain *domain = &frame->snapshot->domain;
    if (domain->kind == DOMAIN_BASIN || domain->kind == DOMAIN_LINES) return 0;
    const float low[3] = {(float)frame->box_min.x, (float)frame->box_min.y, (float)domain->min.z};
    const float high[3] = {(float)frame->box_max.x, (float)frame->box_max.y, (float)domain->max.z};
    for (int edge = 0; edge < TANK_EDGES; edge++) {
        int axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
        float ends[2][3];
        for (int end = 0; end < 2; end++) {
            ends[end][axis] = end ? high[axis] : low[axis];
            ends[end][u] = edge & 1 ? high[u] : low[u];
            ends[end][v] = edge & 2 ? high[v] : low[v];
        }
        put_pair(out + 4 * edge, ends[0], ends[0], ends[1], -2.0f, MARK_WORKING);
        put_pair(out + 4 * edge + 2, ends[0], ends[1], ends[1], -2.0f, MARK_WORKING);
    }
    return 4 * TANK_EDGES;
}

/// Ribbons being gathered for one upload; each stretch is drawn with its own width.
typedef struct Batch {
    LineVertex *vertices;
    GLuint *indices;
    int vertex_count, index_count;
} Batch;

/// Take over `vertices` corners just written behind the batch, as one strip.
static void close_strip(Batch *batch, int vertices)
{
    batch->index_count +=
        strip_indices((GLuint)batch->vertex_count, vertices, batch->indices + batch->index_count);
    batch->vertex_count += vertices;
}

static void draw_stretch(const Lines *lines, const Gl *gl, int begin, int end, double radius,
                         double pixels, double veil)
{
    if (end <= begin) return;
    gl->Uniform4f(lines->size, (float)radius, (float)pixels, (float)veil, 0);
    gl->DrawElements(GL_TRIANGLES, end - begin, GL_UNSIGNED_INT,
                     gl_offset((size_t)begin * sizeof(GLuint)));
}

bool lines_draw(Lines *lines, const Gl *gl, const Frame *frame, double veil, Error *error)
{
    const Snapshot *snapshot = frame->snapshot;
    size_t room = 4 * TANK_EDGES;
    for (int l = 0; l < snapshot->line_count; l++)
        room += 2 * (size_t)maxd(snapshot->lines[l].node_count, 0) + 12;
    Batch batch = {scratch_need(&lines->vertices, room * sizeof *batch.vertices, error),
                   scratch_need(&lines->indices, room * 3 * sizeof *batch.indices, error), 0, 0};
    TRY(batch.vertices && batch.indices);
    const double anchor = anchor_size * frame->block.range.z;
    int tank = tank_vertices(frame, batch.vertices), ends[SCENE_LINES_MAX];
    for (int edge = 0; edge < tank / 4; edge++)
        close_strip(&batch, 4);
    int begin = batch.index_count;
    for (int l = 0; l < snapshot->line_count; l++) {
        const LineSnapshot *line = &snapshot->lines[l];
        for (int n = 0; can_be_drawn(line) && n < line->node_count;)
            close_strip(&batch, piece_vertices(line, n, &n, batch.vertices + batch.vertex_count));
        ends[l] = batch.index_count;
    }
    int anchors = batch.index_count;
    for (int l = 0; l < snapshot->line_count; l++)
        for (int e = 0; e < 2; e++) {
            const LineSnapshot *line = &snapshot->lines[l];
            if (line->ashore[e])
                close_strip(&batch, post_vertices(line, e ? line->node_count - 1 : 0, anchor,
                                                  batch.vertices + batch.vertex_count));
        }
    int lift_offs = batch.index_count;
    for (int l = 0; l < snapshot->line_count; l++)
        close_strip(&batch, post_vertices(&snapshot->lines[l], snapshot->lines[l].lift_off,
                                          0.5 * anchor, batch.vertices + batch.vertex_count));
    if (!batch.index_count) return true;
    gl_mesh_vertices(gl, &lines->mesh, batch.vertices,
                     (size_t)batch.vertex_count * sizeof *batch.vertices);
    gl_mesh_indices(gl, &lines->mesh, batch.indices, batch.index_count);

    const double pixels = least_half_width * frame->block.target.y / 540.0;
    gl->UseProgram(lines->program);
    gl->Uniform4f(lines->slack, SLACK_COLOUR[0], SLACK_COLOUR[1], SLACK_COLOUR[2], 1.0f);
    gl->BindVertexArray(lines->mesh.array);
    gl->Enable(GL_BLEND);
    gl->DepthMask(GL_FALSE);
    draw_stretch(lines, gl, 0, begin, 0.0, 0.4 * pixels, 0.0);
    for (int l = 0; l < snapshot->line_count; begin = ends[l++])
        draw_stretch(lines, gl, begin, ends[l], 0.5 * snapshot->lines[l].diameter, pixels, veil);
    draw_stretch(lines, gl, anchors, lift_offs, 0.6 * anchor, 2.0 * pixels, veil);
    draw_stretch(lines, gl, lift_offs, batch.index_count, 0.3 * anchor, 1.3 * pixels, veil);
    gl->DepthMask(GL_TRUE);
    gl->Disable(GL_BLEND);
    return true;
}
