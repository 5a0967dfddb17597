/// Direct solution of a line's system, alone or joined to others at free points.
#include "mooring_chain.h"

#include <string.h>

#include "base/clones.h"

/// Half bandwidth of a line that bends: three nodes of three unknowns, the diagonal among them.
enum { BAND = 9 };
/// A pivot below this share of its diagonal is rounding: the node hangs on nothing in some
/// direction.
static const double PIVOT_MIN = 1e-15;

bool chain_create(Chain *chain, int last, const int point[2], bool bends, Arena *arena,
                  const char *what, Error *error)
{
    size_t n = (size_t)last + 1;
    memset(chain, 0, sizeof *chain);
    chain->last = last;
    TRY(chain->diagonal = arena_take(arena, n, sizeof(Sym3), what, error));
    TRY(chain->links = arena_take(arena, n, sizeof(Coupling), what, error));
    TRY(chain->x = arena_take(arena, n, sizeof(Vec3), what, error));
    if (bends) {
        TRY(chain->bends = arena_take(arena, n, sizeof(Bend), what, error));
        TRY(chain->band = arena_take(arena, 3 * n * BAND, sizeof(double), what, error));
    }
    for (int side = 0; side < 2; side++) {
        chain->point[side] = point[side];
        if (point[side] >= 0)
            TRY(chain->column[side] = arena_take(arena, 3 * n, sizeof(Vec3), what, error));
    }
    return true;
}

bool point_block_create(PointBlock *points, int count, Arena *arena, const char *what, Error *error)
{
    size_t n = (size_t)count;
    memset(points, 0, sizeof *points);
    points->count = count;
    if (count == 0) return true;
    TRY(points->diagonal = arena_take(arena, n, sizeof(Sym3), what, error));
    TRY(points->x = arena_take(arena, n, sizeof(Vec3), what, error));
    TRY(points->matrix = arena_take(arena, 9 * n * n, sizeof(double), what, error));
    TRY(points->vector = arena_take(arena, 3 * n, sizeof(double), what, error));
    return true;
}

// ---- bending ------------------------------------------------------------------------------------

/// (I - q q^T) v / s: how the direction of a segment turns when its upper node moves by v.
static Vec3 turn(Vec3 q, double inverse, Vec3 v)
{
    return vec3_scale(vec3_mad(v, q, -vec3_dot(q, v)), inverse);
}

void bend_forces(const Bend *b, Vec3 force[3])
{
    force[0] = vec3_scale(turn(b->before, b->below, b->after), -b->stiffness);
    force[2] = vec3_scale(turn(b->after, b->above, b->before), b->stiffness);
    force[1] = vec3_scale(vec3_add(force[0], force[2]), -1);
}

void bend_change(const Bend *b, const Vec3 *move, Vec3 force[3])
{
    double k = -b->stiffness * b->growth;
    Vec3 turned = vec3_sub(turn(b->after, b->above, vec3_sub(move[2], move[1])),
                           turn(b->before, b->below, vec3_sub(move[1], move[0])));
    force[0] = vec3_scale(turn(b->before, b->below, turned), k);
    force[2] = vec3_scale(turn(b->after, b->above, turned), k);
    force[1] = vec3_scale(vec3_add(force[0], force[2]), -1);
}

/// Element (row, column) of a chain's band matrix, row >= column, both counted from node 0.
static double *band_at(Chain *chain, int row, int column)
{
    return &chain->band[row * BAND + BAND - 1 - (row - column)];
}

static void band_add_sym3(Chain *chain, int node, const Sym3 *m)
{
    int r = 3 * node;
    *band_at(chain, r, r) += m->xx;
    *band_at(chain, r + 1, r + 1) += m->yy;
    *band_at(chain, r + 2, r + 2) += m->zz;
    *band_at(chain, r + 1, r) += m->xy;
    *band_at(chain, r + 2, r) += m->xz;
    *band_at(chain, r + 2, r + 1) += m->yz;
}

/// The whole matrix of a line that bends, ends included.
static void band_assemble(Chain *chain)
{
    int last = chain->last;
    const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memset(chain->band, 0, (size_t)(3 * (last + 1) * BAND) * sizeof(double));
    for (int i = 0; i <= last; i++)
        band_add_sym3(chain, i, &chain->diagonal[i]);
    for (int i = 0; i < last; i++)
        for (int k = 0; k < 3; k++) {
            Vec3 b = coupling_apply(&chain->links[i], axes[k]);
            *band_at(chain, 3 * i + 3, 3 * i + k) -= b.x;
            *band_at(chain, 3 * i + 4, 3 * i + k) -= b.y;
            *band_at(chain, 3 * i + 5, 3 * i + k) -= b.z;
        }
    for (int i = 1; i < last; i++) {
        if (chain->bends[i].stiffness == 0) continue;
        for (int from = 0; from < 9; from++) {
            Vec3 move[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, force[3];
            move[from / 3] = axes[from % 3];
            bend_change(&chain->bends[i], move, force);
            for (int to = from; to < 9; to++) {
                double part[3] = {force[to / 3].x, force[to / 3].y, force[to / 3].z};
                *band_at(chain, 3 * i - 3 + to, 3 * i - 3 + from) -= part[to % 3];
            }
        }
    }
}

/// Cholesky's factors of the inner nodes' part, in place; the rows of the ends stay as they are.
static void band_factor(Chain *chain)
{
    int begin = 3, end = 3 * chain->last;
    for (int i = begin; i < end; i++)
        for (int j = i - BAND + 1 > begin ? i - BAND + 1 : begin; j <= i; j++) {
            double sum = *band_at(chain, i, j);
            for (int k = i - BAND + 1 > begin ? i - BAND + 1 : begin; k < j; k++)
                sum -= *band_at(chain, i, k) * *band_at(chain, j, k);
            *band_at(chain, i, j) = i == j ? sqrt(maxd(sum, PIVOT_MIN * *band_at(chain, i, i)))
                                           : sum / *band_at(chain, j, j);
        }
}

static void band_solve(Chain *chain, Vec3 *v)
{
    double *x = &v[0].x;
    int begin = 3, end = 3 * chain->last;
    for (int i = begin; i < end; i++) {
        for (int k = i - BAND + 1 > begin ? i - BAND + 1 : begin; k < i; k++)
            x[i] -= *band_at(chain, i, k) * x[k];
        x[i] /= *band_at(chain, i, i);
    }
    for (int i = end - 1; i >= begin; i--) {
        for (int k = i + 1; k < end && k < i + BAND; k++)
            x[i] -= *band_at(chain, k, i) * x[k];
        x[i] /= *band_at(chain, i, i);
    }
}

/// Matrix between unknown `axis` of an end and those of any node, as a move of the end makes it.
static double band_of_end(Chain *chain, int side, int axis, int node, int k)
{
    int row = 3 * node + k, end = (side ? 3 * chain->last : 0) + axis;
    int high = row > end ? row : end, low = row > end ? end : row;
    return high - low < BAND ? *band_at(chain, high, low) : 0;
}

// ---- free ends ----------------------------------------------------------------------------------

/// Force on the inner nodes for a unit move of an end.
static void end_column(Chain *chain, int side, int axis, Vec3 *to)
{
    int last = chain->last, inner = side ? last - 1 : 1;
    memset(to, 0, (size_t)(last + 1) * sizeof(Vec3));
    if (last < 2) return;
    if (!chain->bends) {
        Vec3 unit = vec3(axis == 0, axis == 1, axis == 2);
        to[inner] = coupling_apply(&chain->links[side ? last - 1 : 0], unit);
        return;
    }
    for (int i = 1; i < last; i++)
        to[i] = vec3(-band_of_end(chain, side, axis, i, 0), -band_of_end(chain, side, axis, i, 1),
                     -band_of_end(chain, side, axis, i, 2));
}

/// Force on an end for a move of the inner nodes.
static Vec3 end_answer(Chain *chain, int side, const Vec3 *move)
{
    int last = chain->last;
    if (last < 2) return vec3(0, 0, 0);
    if (!chain->bends)
        return coupling_apply(&chain->links[side ? last - 1 : 0], move[side ? last - 1 : 1]);
    double sum[3] = {0, 0, 0};
    int from = side ? last - 2 : 1, to = side ? last - 1 : 2;
    for (int i = from < 1 ? 1 : from; i <= to && i < last; i++)
        for (int k = 0; k < 3; k++)
            sum[k] -= band_of_end(chain, side, k, i, 0) * move[i].x +
                      band_of_end(chain, side, k, i, 1) * move[i].y +
                      band_of_end(chain, side, k, i, 2) * move[i].z;
    return vec3(sum[0], sum[1], sum[2]);
}

/// Force on the end at `side` for a unit move of the one at the other, nodes between held.
static Vec3 end_to_end(Chain *chain, int side, int axis)
{
    if (chain->bends && chain->last <= 2)
        return vec3(-band_of_end(chain, !side, axis, side ? chain->last : 0, 0),
                    -band_of_end(chain, !side, axis, side ? chain->last : 0, 1),
                    -band_of_end(chain, !side, axis, side ? chain->last : 0, 2));
    if (chain->last > 1) return vec3(0, 0, 0);
    return coupling_apply(&chain->links[0], vec3(axis == 0, axis == 1, axis == 2));
}

/// Inner nodes for the right side in `x`; of a line that bends, factors must be there already.
static void chain_solve(Chain *chain, Vec3 *x)
{
    if (chain->bends)
        band_solve(chain, x);
    else
        block_solve_again(1, chain->last, chain->diagonal, chain->links, x);
}

static void matrix_add(PointBlock *points, int row, int column, int axis, Vec3 v, double sign)
{
    double *at = points->matrix + 9 * row * points->count + 3 * column + axis;
    at[0] += sign * v.x;
    at[3 * points->count] += sign * v.y;
    at[6 * points->count] += sign * v.z;
}

static void vector_add(PointBlock *points, int row, Vec3 v)
{
    points->vector[3 * row] += v.x;
    points->vector[3 * row + 1] += v.y;
    points->vector[3 * row + 2] += v.z;
}

/// Eliminate the inner nodes; what is left of them goes to the points.
static void condense(Chain *chain, PointBlock *points)
{
    int last = chain->last;
    Sym3 ends[2] = {chain->diagonal[0], chain->diagonal[last]};
    if (chain->bends) {
        band_assemble(chain);
        band_factor(chain);
        band_solve(chain, chain->x);
    } else {
        block_solve(1, last, chain->diagonal, chain->links, chain->x);
    }
    for (int side = 0; side < 2; side++) {
        int point = chain->point[side], other = chain->point[!side];
        if (point < 0) continue;
        vector_add(points, point, chain->x[side ? last : 0]);
        vector_add(points, point, end_answer(chain, side, chain->x));
        for (int axis = 0; axis < 3; axis++) {
            Vec3 *column = chain->column[side] + axis * (last + 1);
            end_column(chain, side, axis, column);
            chain_solve(chain, column);
            Vec3 own = chain->bends
                           ? vec3(band_of_end(chain, side, axis, side ? last : 0, 0),
                                  band_of_end(chain, side, axis, side ? last : 0, 1),
                                  band_of_end(chain, side, axis, side ? last : 0, 2))
                           : sym3_apply(&ends[side], vec3(axis == 0, axis == 1, axis == 2));
            matrix_add(points, point, point, axis, own, 1);
            matrix_add(points, point, point, axis, end_answer(chain, side, column), -1);
            if (other < 0) continue;
            matrix_add(points, other, point, axis, end_answer(chain, !side, column), -1);
            matrix_add(points, other, point, axis, end_to_end(chain, !side, axis), -1);
        }
    }
}

/// Put the points' moves into a chain.
static void expand(Chain *chain, const PointBlock *points)
{
    int last = chain->last;
    for (int side = 0; side < 2; side++) {
        if (chain->point[side] < 0) continue;
        Vec3 move = points->x[chain->point[side]];
        double by[3] = {move.x, move.y, move.z};
        for (int axis = 0; axis < 3; axis++)
            for (int i = 1; i < last; i++)
                chain->x[i] =
                    vec3_mad(chain->x[i], chain->column[side][axis * (last + 1) + i], by[axis]);
    }
    for (int side = 0; side < 2; side++)
        if (chain->point[side] >= 0) chain->x[side ? last : 0] = points->x[chain->point[side]];
}

/// Cholesky's method in place on the points' matrix.
static void points_solve(PointBlock *points)
{
    int n = 3 * points->count;
    double *a = points->matrix, *x = points->vector;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = a[i * n + j];
            for (int k = 0; k < j; k++)
                sum -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = i == j ? sqrt(maxd(sum, PIVOT_MIN * a[i * n + i])) : sum / a[j * n + j];
        }
        for (int k = 0; k < i; k++)
            x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++)
            x[i] -= a[k * n + i] * x[k];
        x[i] /= a[i * n + i];
    }
}

CLONES("arch=x86-64-v3", "default")
__attribute__((flatten)) void chains_solve(Chain *const *chains, int count, PointBlock *points)
{
    int n = points->count;
    if (n > 0) memset(points->matrix, 0, (size_t)(9 * n * n) * sizeof(double));
    for (int p = 0; p < n; p++) {
        points->vector[3 * p] = points->vector[3 * p + 1] = points->vector[3 * p + 2] = 0;
        vector_add(points, p, points->x[p]);
        for (int axis = 0; axis < 3; axis++)
            matrix_add(points, p, p, axis,
                       sym3_apply(&points->diagonal[p], vec3(axis == 0, axis == 1, axis == 2)), 1);
    }
    for (int c = 0; c < count; c++)
        condense(chains[c], points);
    if (n == 0) return;
    points_solve(points);
    for (int p = 0; p < n; p++)
        points->x[p] =
            vec3(points->vector[3 * p], points->vector[3 * p + 1], points->vector[3 * p + 2]);
    for (int c = 0; c < count; c++)
        expand(chains[c], points);
}
