#include "surface.h"

#include <float.h>
#include <string.h>

enum { FILL_SWEEPS = 60 };

/// Reach of the kernel mean [dp].
static const double kernel_reach = 2.0;
/// Particles this far below the top of their column still belong to it [dp], fading to nothing.
static const float top_band = 0.8f;
/// Particles within this of each other are of one layer [dp].
static const float layer_band = 0.7f;
/// A particle this far above the next of its column is not part of the water's body [dp].
static const float support_gap = 1.7f;
/// A single particle of a column is water rather than spray when it is this near the bed [dp].
static const float sheet_band = 2.5f;
/// Particles further above the top of their column are spray [dp].
static const float spray_band = 1.5f;
/// Open water gives a node a weight of 4 (2 in a slice); one beside a hull with less than this is
/// rather continued from its neighbours.
static const float thin_weight = 1.4f;
/// A hull's underside this far above the water under it is dry, and that water is free [dp].
static const float wetted_gap = 2.5f;

static bool plane(const Snapshot *snapshot) { return snapshot->domain.dimensions == 2; }

bool height_field_resize(HeightField *field, const Snapshot *snapshot, int node_limit, Error *error)
{
    const Domain *domain = &snapshot->domain;
    const double dp = snapshot->spacing;
    const double length[2] = {domain->max.x - domain->min.x,
                              plane(snapshot) ? 0.0 : domain->max.y - domain->min.y};
    double cell =
        plane(snapshot) ? length[0] / node_limit : sqrt(length[0] * length[1] / node_limit);
    cell = maxd(cell, dp / 3.0);
    int count[2], columns[2];
    for (int axis = 0; axis < 2; axis++) {
        count[axis] = length[axis] > 0 ? (int)maxd(1.0, ceil(length[axis] / cell - 1e-6)) + 1 : 1;
        columns[axis] = (int)maxd(1.0, round(length[axis] / (2.0 * dp)));
    }
    bool same = field->height && count[0] == field->count[0] && count[1] == field->count[1] &&
                columns[0] == field->column_count[0] && columns[1] == field->column_count[1];
    if (!same) arena_destroy(&field->arena);
    for (int axis = 0; axis < 2; axis++) {
        field->origin[axis] = axis ? domain->min.y : domain->min.x;
        field->count[axis] = count[axis];
        field->cell[axis] = count[axis] > 1 ? length[axis] / (count[axis] - 1) : 0.0;
        field->column_count[axis] = columns[axis];
        field->column[axis] = length[axis] > 0 ? length[axis] / columns[axis] : 1.0;
    }
    if (plane(snapshot)) field->origin[1] = 0.0;
    if (same) return true;

    field->height = NULL;
    Arena *arena = &field->arena;
    size_t nodes = (size_t)count[0] * count[1], column_total = (size_t)columns[0] * columns[1];
    TRY(field->top = arena_take(arena, column_total, sizeof *field->top, "column tops", error));
    TRY(field->highest =
            arena_take(arena, column_total, sizeof *field->highest, "column particles", error));
    TRY(field->beside = arena_take(arena, column_total, sizeof *field->beside, "columns", error));
    TRY(field->scalar = arena_take(arena, nodes, sizeof *field->scalar, "surface field", error));
    TRY(field->kind = arena_take(arena, nodes, sizeof *field->kind, "surface kinds", error));
    TRY(field->weight = arena_take(arena, nodes, sizeof *field->weight, "surface weights", error));
    TRY(field->spare = arena_take(arena, nodes, sizeof *field->spare, "surface smoothing", error));
    TRY(field->filled = arena_take(arena, nodes, sizeof *field->filled, "surface fill", error));
    TRY(field->body_bottom = arena_take(arena, nodes, sizeof(float), "body undersides", error));
    TRY(field->body_top = arena_take(arena, nodes, sizeof(float), "body tops", error));
    TRY(field->height = arena_take(arena, nodes, sizeof *field->height, "surface heights", error));
    return true;
}

void height_field_destroy(HeightField *field)
{
    arena_destroy(&field->arena);
    *field = (HeightField){0};
}

/// Column of a particle, or -1 for one that is not finite or outside the domain.
static int column_of(const HeightField *field, const Snapshot *snapshot, const float *position)
{
    double x = (position[0] - field->origin[0]) / field->column[0];
    double y = plane(snapshot) ? 0.0 : (position[1] - field->origin[1]) / field->column[1];
    // Written so that a not-a-number fails every comparison.
    if (!(x >= 0.0 && x <= field->column_count[0] && y >= 0.0 && y <= field->column_count[1]))
        return -1;
    if (!(position[2] >= -FLT_MAX && position[2] <= FLT_MAX)) return -1;
    int i = (int)x, j = (int)y;
    if (i == field->column_count[0]) i--;
    if (j == field->column_count[1]) j--;
    return j * field->column_count[0] + i;
}

/// The mean of the layer on top, of the three highest particles of a column. A highest particle
/// with nothing close below it is spray; one standing on a stack beside a hull, or lying on the bed
/// in a thin sheet, is not.
static float column_top(const float highest[3], float dp, float bed)
{
    int first = highest[0] - highest[1] > support_gap * dp ? 1 : 0;
    float sum = 0.0f, top = highest[first];
    int count = 0;
    if (!(highest[1] > -INFINITY))
        return highest[0] < bed + sheet_band * dp ? highest[0] : -INFINITY;
    for (int k = first; k < 3 && highest[k] > top - layer_band * dp; k++, count++)
        sum += highest[k];
    return sum / (float)count;
}

/// Step 1: the top of every column.
static void find_tops(HeightField *field, const Snapshot *snapshot)
{
    int columns = field->column_count[0] * field->column_count[1];
    for (int c = 0; c < columns; c++)
        for (int k = 0; k < 3; k++)
            field->highest[c][k] = -INFINITY;
    for (int i = 0; i < snapshot->fluid_count; i++) {
        int c = column_of(field, snapshot, snapshot->position[i]);
        if (c < 0) continue;
        float z = snapshot->position[i][2], *highest = field->highest[c];
        if (z <= highest[2]) continue;
        if (z > highest[0]) {
            highest[2] = highest[1];
            highest[1] = highest[0];
            highest[0] = z;
        } else if (z > highest[1]) {
            highest[2] = highest[1];
            highest[1] = z;
        } else {
            highest[2] = z;
        }
    }
    const float dp = (float)snapshot->spacing, bed = (float)snapshot->domain.min.z;
    for (int c = 0; c < columns; c++)
        field->top[c] = column_top(field->highest[c], dp, bed);
}

/// Nodes within `reach` of a coordinate: [*begin, *end).
static void node_range(const HeightField *field, int axis, double at, double reach, int *begin,
                       int *end)
{
    if (field->count[axis] == 1) {
        *begin = 0;
        *end = 1;
        return;
    }
    double low = ceil((at - reach - field->origin[axis]) / field->cell[axis]);
    double high = floor((at + reach - field->origin[axis]) / field->cell[axis]);
    *begin = (int)maxd(0.0, low);
    *end = (int)mind(field->count[axis] - 1.0, high) + 1;
}

/// Is a particle in touch with a hull above it? Its column says nothing about the free surface.
static bool under_hull(const HeightField *field, const float *position, float dp)
{
    int at[2] = {0, 0};
    for (int axis = 0; axis < 2; axis++)
        if (field->count[axis] > 1)
            at[axis] = (int)((position[axis] - field->origin[axis]) / field->cell[axis] + 0.5);
    for (int y = at[1] - 1; y <= at[1] + 1; y++) {
        for (int x = at[0] - 1; x <= at[0] + 1; x++) {
            if (x < 0 || y < 0 || x >= field->count[0] || y >= field->count[1]) continue;
            size_t node = (size_t)y * field->count[0] + x;
            bool own = x == at[0] && y == at[1];
            // Beside a flared side the water below it counts as covered too.
            float roof = own ? field->body_top[node] : field->body_bottom[node] + 0.5f * dp;
            if (field->body_top[node] > -INFINITY && position[2] < roof &&
                position[2] > field->body_bottom[node] - wetted_gap * dp)
                return true;
        }
    }
    return false;
}

/// Step 2: kernel sums over the particles at the top of their columns.
static void sum_tops(HeightField *field, const Snapshot *snapshot, const float *scalar)
{
    const double reach = maxd(kernel_reach * snapshot->spacing, 1.5 * field->cell[0]);
    const float dp = (float)snapshot->spacing;
    const double inverse = 1.0 / (reach * reach);
    for (int i = 0; i < snapshot->fluid_count; i++) {
        const float *position = snapshot->position[i];
        int c = column_of(field, snapshot, position);
        if (c < 0) continue;
        float above = (position[2] - field->top[c]) / dp;
        if (!(above > -top_band && above < spray_band)) continue;
        if (under_hull(field, position, dp)) continue;
        float share = above >= 0.0f ? 1.0f : 1.0f + above / top_band;
        int x_begin, x_end, y_begin, y_end;
        node_range(field, 0, position[0], reach, &x_begin, &x_end);
        node_range(field, 1, position[1], reach, &y_begin, &y_end);
        for (int y = y_begin; y < y_end; y++) {
            double dy = plane(snapshot) ? 0.0 : field->origin[1] + y * field->cell[1] - position[1];
            for (int x = x_begin; x < x_end; x++) {
                double dx = field->origin[0] + x * field->cell[0] - position[0];
                double q = 1.0 - (dx * dx + dy * dy) * inverse;
                if (q <= 0.0) continue;
                float w = share * (float)(q * q);
                size_t node = (size_t)y * field->count[0] + x;
                field->weight[node] += w;
                field->height[node] += w * position[2];
                if (scalar) field->scalar[node] += w * scalar[i];
            }
        }
    }
}

/// Lowest and highest point of a triangle above the nodes it covers. Its bounding box is taken half
/// a cell larger, so that a hull's edge does not slip between nodes.
static void mark_triangle(HeightField *field, const Vec3 corner[3])
{
    double low[2], high[2];
    for (int axis = 0; axis < 2; axis++) {
        double a = axis ? corner[0].y : corner[0].x, b = axis ? corner[1].y : corner[1].x;
        double c = axis ? corner[2].y : corner[2].x;
        low[axis] = mind(a, mind(b, c));
        high[axis] = maxd(a, maxd(b, c));
    }
    double area = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                  (corner[2].x - corner[0].x) * (corner[1].y - corner[0].y);
    double z_low = mind(corner[0].z, mind(corner[1].z, corner[2].z));
    double z_high = maxd(corner[0].z, maxd(corner[1].z, corner[2].z));
    int begin[2], end[2];
    for (int axis = 0; axis < 2; axis++)
        node_range(field, axis, 0.5 * (low[axis] + high[axis]),
                   0.5 * (high[axis] - low[axis]) + 0.5 * field->cell[axis], &begin[axis],
                   &end[axis]);
    for (int y = begin[1]; y < end[1]; y++) {
        for (int x = begin[0]; x < end[0]; x++) {
            double px = field->origin[0] + x * field->cell[0];
            double py = field->count[1] > 1 ? field->origin[1] + y * field->cell[1] : corner[0].y;
            size_t node = (size_t)y * field->count[0] + x;
            double z_min = z_low, z_max = z_high;
            if (field->count[1] > 1 && fabs(area) > 1e-12) {
                double u = ((px - corner[0].x) * (corner[2].y - corner[0].y) -
                            (corner[2].x - corner[0].x) * (py - corner[0].y)) /
                           area;
                double v = ((corner[1].x - corner[0].x) * (py - corner[0].y) -
                            (px - corner[0].x) * (corner[1].y - corner[0].y)) /
                           area;
                double slack = 0.02;
                if (u < -slack || v < -slack || u + v > 1.0 + slack) continue;
                double z =
                    corner[0].z + u * (corner[1].z - corner[0].z) + v * (corner[2].z - corner[0].z);
                z_min = z_max = mind(maxd(z, z_low), z_high);
            }
            field->body_bottom[node] = minf(field->body_bottom[node], (float)z_min);
            field->body_top[node] = maxf(field->body_top[node], (float)z_max);
        }
    }
}

static void mark_bodies(HeightField *field, const Snapshot *snapshot)
{
    size_t nodes = (size_t)field->count[0] * field->count[1];
    for (size_t n = 0; n < nodes; n++) {
        field->body_bottom[n] = INFINITY;
        field->body_top[n] = -INFINITY;
    }
    for (int b = 0; b < snapshot->body_count; b++) {
        const BodySnapshot *body = &snapshot->bodies[b];
        if (!body->mesh || !(fabs(body->origin.x + body->origin.y + body->origin.z) < 1e6))
            continue;
        for (int t = 0; t < body->mesh->triangle_count; t++) {
            Vec3 corner[3];
            for (int k = 0; k < 3; k++) {
                Vec3 vertex = body->mesh->vertices[body->mesh->triangles[t][k]];
                corner[k] = vec3_add(body->origin, quat_rotate(body->attitude, vertex));
            }
            mark_triangle(field, corner);
        }
    }
}

/// Columns that a hull fills in part may have lost their highest layer: one that stands lower than
/// the open water around it says nothing and is emptied.
static void screen_columns(HeightField *field, const Snapshot *snapshot)
{
    const int *count = field->column_count;
    memset(field->beside, 0, (size_t)count[0] * count[1]);
    for (int n = 0; n < field->count[0] * field->count[1]; n++) {
        if (!(field->body_top[n] > -INFINITY)) continue;
        int at[2] = {n % field->count[0], n / field->count[0]};
        for (int axis = 0; axis < 2; axis++)
            at[axis] =
                (int)mind(at[axis] * field->cell[axis] / field->column[axis], count[axis] - 1.0);
        field->beside[at[1] * count[0] + at[0]] = 1;
    }
    for (int c = 0; c < count[0] * count[1]; c++) {
        if (!field->beside[c]) continue;
        float sum = 0.0f;
        int open = 0;
        for (int y = c / count[0] - 1; y <= c / count[0] + 1; y++)
            for (int x = c % count[0] - 1; x <= c % count[0] + 1; x++) {
                if (x < 0 || y < 0 || x >= count[0] || y >= count[1]) continue;
                int other = y * count[0] + x;
                if (field->beside[other] || !(field->top[other] > -INFINITY)) continue;
                sum += field->top[other];
                open++;
            }
        if (open && field->top[c] < sum / (float)open - (float)snapshot->spacing)
            field->top[c] = -INFINITY;
    }
}

/// Does a body stand within two nodes of this one?
static bool near_body(const HeightField *field, int n)
{
    int column = n % field->count[0], row = n / field->count[0];
    for (int y = row - 2; y <= row + 2; y++)
        for (int x = column - 2; x <= column + 2; x++)
            if (x >= 0 && y >= 0 && x < field->count[0] && y < field->count[1] &&
                field->body_top[y * field->count[0] + x] > -INFINITY)
                return true;
    return false;
}

/// Means from sums; what each node is. @return number of nodes to fill, listed in field->filled
static int classify(HeightField *field, const Snapshot *snapshot, float *mean)
{
    const float dp = (float)snapshot->spacing, bed = (float)snapshot->domain.min.z;
    int nodes = field->count[0] * field->count[1], fill_count = 0, water = 0;
    double sum = 0.0;
    for (int n = 0; n < nodes; n++) {
        bool wet = field->weight[n] > 0.02f;
        if (wet) {
            field->height[n] = field->height[n] / field->weight[n] + 0.5f * dp;
            field->scalar[n] /= field->weight[n];
        }
        bool body = field->body_top[n] > -INFINITY;
        // Under a hull in touch with the water, or beside water missing under it.
        bool under = body && (!wet || (field->height[n] > field->body_bottom[n] - wetted_gap * dp &&
                                       field->height[n] < field->body_top[n] - 0.25f * dp));
        bool dry_gap = body && !wet && field->body_bottom[n] > bed + wetted_gap * dp &&
                       field->body_bottom[n] > (float)snapshot->level + wetted_gap * dp;
        bool thin = field->weight[n] < thin_weight && wet && snapshot->body_count > 0;
        if ((under && !dry_gap) || (thin && near_body(field, n))) {
            field->kind[n] = NODE_FILLED;
            field->filled[fill_count++] = n;
        } else if (wet) {
            field->kind[n] = NODE_WATER;
            sum += field->height[n];
            water++;
        } else {
            field->kind[n] = NODE_DRY;
            field->height[n] = bed;
            field->scalar[n] = 0.0f;
        }
    }
    *mean = water ? (float)(sum / water) : (float)snapshot->level;
    return fill_count;
}

/// Mean of a node's wet neighbours; false without one.
static bool neighbour_mean(const HeightField *field, const float *values, int n, float *mean)
{
    int x = n % field->count[0], y = n / field->count[0], count = 0;
    float sum = 0.0f;
    const int dx[4] = {-1, 1, 0, 0}, dy[4] = {0, 0, -1, 1};
    for (int k = 0; k < 4; k++) {
        int i = x + dx[k], j = y + dy[k];
        if (i < 0 || j < 0 || i >= field->count[0] || j >= field->count[1]) continue;
        int m = j * field->count[0] + i;
        if (field->kind[m] == NODE_DRY) continue;
        sum += values[m];
        count++;
    }
    if (!count) return false;
    *mean = sum / (float)count;
    return true;
}

/// Step 3: Laplace's equation inside the bodies by successive over-relaxation, swept in alternating
/// directions; then held below a dry deck.
static void fill_bodies(HeightField *field, const Snapshot *snapshot, int fill_count, float mean)
{
    const float relaxation = 1.7f;
    for (int f = 0; f < fill_count; f++) {
        field->height[field->filled[f]] = mean;
        field->scalar[field->filled[f]] = 0.0f;
    }
    for (int sweep = 0; sweep < FILL_SWEEPS; sweep++) {
        for (int f = 0; f < fill_count; f++) {
            int n = field->filled[sweep % 2 ? fill_count - 1 - f : f];
            float around;
            if (neighbour_mean(field, field->height, n, &around))
                field->height[n] += relaxation * (around - field->height[n]);
            if (neighbour_mean(field, field->scalar, n, &around))
                field->scalar[n] += relaxation * (around - field->scalar[n]);
        }
    }
    for (int f = 0; f < fill_count; f++) {
        int n = field->filled[f];
        if (!(field->body_top[n] > -INFINITY)) continue;
        float ceiling = field->body_top[n] - 0.6f * (float)snapshot->spacing;
        if (field->height[n] > ceiling) field->height[n] = ceiling;
    }
}

/// Step 4: 1-2-1 along one axis over the wet nodes.
static void smooth(const HeightField *field, const float *from, float *to, int axis)
{
    int stride = axis ? field->count[0] : 1;
    for (int y = 0; y < field->count[1]; y++) {
        for (int x = 0; x < field->count[0]; x++) {
            int n = y * field->count[0] + x, at = axis ? y : x;
            to[n] = from[n];
            if (field->kind[n] == NODE_DRY) continue;
            bool before = at > 0 && field->kind[n - stride] != NODE_DRY;
            bool after = at + 1 < field->count[axis] && field->kind[n + stride] != NODE_DRY;
            // At an edge the missing side is continued linearly, which leaves the edge as it is.
            if (before && after)
                to[n] = 0.5f * from[n] + 0.25f * (from[n - stride] + from[n + stride]);
        }
    }
}

void height_field_build(HeightField *field, const Snapshot *snapshot, const float *scalar)
{
    size_t nodes = (size_t)field->count[0] * field->count[1];
    memset(field->height, 0, nodes * sizeof *field->height);
    memset(field->scalar, 0, nodes * sizeof *field->scalar);
    memset(field->weight, 0, nodes * sizeof *field->weight);
    find_tops(field, snapshot);
    mark_bodies(field, snapshot);
    screen_columns(field, snapshot);
    sum_tops(field, snapshot, scalar);
    float mean;
    int fill_count = classify(field, snapshot, &mean);
    fill_bodies(field, snapshot, fill_count, mean);
    // The variance of 1-2-1 is half a cell squared: this many give a width of one dp.
    double ratio = snapshot->spacing / field->cell[0];
    int passes = (int)mind(8.0, maxd(1.0, round(ratio * ratio)));
    for (int pass = 0; pass < passes; pass++) {
        smooth(field, field->height, field->spare, 0);
        smooth(field, field->spare, field->height, 1);
        if (!scalar) continue;
        smooth(field, field->scalar, field->spare, 0);
        smooth(field, field->spare, field->scalar, 1);
    }
}

double height_field_sample(const HeightField *field, double x, double y)
{
    double at[2] = {x, y}, fraction[2] = {0.0, 0.0};
    int low[2] = {0, 0}, high[2] = {0, 0};
    for (int axis = 0; axis < 2; axis++) {
        if (field->count[axis] < 2) continue;
        double s = (at[axis] - field->origin[axis]) / field->cell[axis];
        s = mind(maxd(s, 0.0), field->count[axis] - 1.0);
        low[axis] = (int)mind(s, field->count[axis] - 2.0);
        high[axis] = low[axis] + 1;
        fraction[axis] = s - low[axis];
    }
    const float *h = field->height;
    int row = field->count[0];
    double south =
        h[low[1] * row + low[0]] * (1 - fraction[0]) + h[low[1] * row + high[0]] * fraction[0];
    double north =
        h[high[1] * row + low[0]] * (1 - fraction[0]) + h[high[1] * row + high[0]] * fraction[0];
    return south * (1 - fraction[1]) + north * fraction[1];
}

int height_field_shell(const HeightField *field, const Snapshot *snapshot, int *indices)
{
    const Domain *domain = &snapshot->domain;
    const float dp = (float)snapshot->spacing, side = 2.2f * dp;
    int count = 0;
    for (int i = 0; i < snapshot->fluid_count; i++) {
        const float *p = snapshot->position[i];
        int c = column_of(field, snapshot, p);
        if (c < 0) continue;
        bool seen = plane(snapshot) || p[0] < domain->min.x + side || p[0] > domain->max.x - side ||
                    p[1] < domain->min.y + side || p[1] > domain->max.y - side;
        int cx = c % field->column_count[0], cy = c / field->column_count[0];
        for (int y = cy - 1; y <= cy + 1 && !seen; y++) {
            for (int x = cx - 1; x <= cx + 1 && !seen; x++) {
                if (x < 0 || y < 0 || x >= field->column_count[0] || y >= field->column_count[1])
                    continue;
                seen = p[2] > field->top[y * field->column_count[0] + x] - 1.8f * dp;
            }
        }
        if (seen) indices[count++] = i;
    }
    return count;
}
