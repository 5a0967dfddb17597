/// Block-tridiagonal systems of a line: one symmetric 3 x 3 block per node, and between neighbours
/// -(g I + (k - g) q q^T), a spring along the segment and its geometric stiffness across it.
/// Not for others than mooring*.c.
#ifndef FAIRLEAD_MOORING_BLOCK_H
#define FAIRLEAD_MOORING_BLOCK_H

#include "base/portable.h"

/// Symmetric 3 x 3 matrix.
typedef struct Sym3 {
    double xx, yy, zz, xy, xz, yz;
} Sym3;

/// Coupling of two nodes along unit vector q [N/m].
typedef struct Coupling {
    double along, across; ///< k, g
    Vec3 q;
} Coupling;

FN Vec3 sym3_apply(const Sym3 *m, Vec3 v)
{
    return vec3(m->xx * v.x + m->xy * v.y + m->xz * v.z, m->xy * v.x + m->yy * v.y + m->yz * v.z,
                m->xz * v.x + m->yz * v.y + m->zz * v.z);
}

/// m += a I + b q q^T.
FN void sym3_add(Sym3 *m, double a, double b, Vec3 q)
{
    Vec3 bq = vec3_scale(q, b);
    m->xx += a + bq.x * q.x;
    m->yy += a + bq.y * q.y;
    m->zz += a + bq.z * q.z;
    m->xy += bq.x * q.y;
    m->xz += bq.x * q.z;
    m->yz += bq.y * q.z;
}

FN Sym3 sym3_inverse(const Sym3 *m)
{
    Sym3 a;
    a.xx = m->yy * m->zz - m->yz * m->yz;
    a.xy = m->xz * m->yz - m->xy * m->zz;
    a.xz = m->xy * m->yz - m->xz * m->yy;
    double inverse = 1 / (m->xx * a.xx + m->xy * a.xy + m->xz * a.xz);
    a.yy = (m->xx * m->zz - m->xz * m->xz) * inverse;
    a.zz = (m->xx * m->yy - m->xy * m->xy) * inverse;
    a.yz = (m->xy * m->xz - m->xx * m->yz) * inverse;
    a.xx *= inverse;
    a.xy *= inverse;
    a.xz *= inverse;
    return a;
}

/// (g I + (k - g) q q^T) v, the coupling without its sign.
FN Vec3 coupling_apply(const Coupling *b, Vec3 v)
{
    return vec3_mad(vec3_scale(v, b->across), b->q, (b->along - b->across) * vec3_dot(b->q, v));
}

/// m -= B W B for B = g I + e q q^T and symmetric W.
FN void sym3_eliminate(Sym3 *m, const Coupling *b, const Sym3 *inverse)
{
    double g = b->across, e = b->along - b->across;
    Vec3 u = sym3_apply(inverse, b->q);
    double c = e * e * vec3_dot(b->q, u), gg = g * g;
    Vec3 r = vec3_add(vec3_scale(u, g * e), vec3_scale(b->q, 0.5 * c)); // B W B = g^2 W + q r + r q
    m->xx -= gg * inverse->xx + 2 * b->q.x * r.x;
    m->yy -= gg * inverse->yy + 2 * b->q.y * r.y;
    m->zz -= gg * inverse->zz + 2 * b->q.z * r.z;
    m->xy -= gg * inverse->xy + b->q.x * r.y + r.x * b->q.y;
    m->xz -= gg * inverse->xz + b->q.x * r.z + r.x * b->q.z;
    m->yz -= gg * inverse->yz + b->q.y * r.z + r.y * b->q.z;
}

/// Take node `from`, whose block is inverted, out of the row of its neighbour `to`.
FN void block_take_out(Sym3 *diagonal, Vec3 *x, int to, int from, const Coupling *link)
{
    sym3_eliminate(&diagonal[to], link, &diagonal[from]);
    x[to] = vec3_add(x[to], coupling_apply(link, sym3_apply(&diagonal[from], x[from])));
}

/// From the middle node outwards, with the inverse pivots in `diagonal`.
FN void block_substitute(int first, int last, int middle, const Sym3 *diagonal,
                         const Coupling *links, Vec3 *x)
{
    x[middle] = sym3_apply(&diagonal[middle], x[middle]);
    for (int i = middle - 1, k = middle + 1; i >= first || k < last; i--, k++) {
        if (i >= first)
            x[i] = sym3_apply(&diagonal[i], vec3_add(x[i], coupling_apply(&links[i], x[i + 1])));
        if (k < last)
            x[k] =
                sym3_apply(&diagonal[k], vec3_add(x[k], coupling_apply(&links[k - 1], x[k - 1])));
    }
}

/// Solve for nodes first..last-1; `links[i]` joins node i and i + 1. On return `diagonal` holds the
/// inverse pivots and `x` (the right side on entry) the solution. Elimination goes from both ends
/// to the middle: two chains of operations that do not wait for each other.
FN void block_solve(int first, int last, Sym3 *diagonal, const Coupling *links, Vec3 *x)
{
    if (first >= last) return;
    int middle = (first + last) / 2;
    for (int i = first, k = last - 1; i < middle || k > middle; i++, k--) {
        if (i < middle) diagonal[i] = sym3_inverse(&diagonal[i]);
        if (k > middle) diagonal[k] = sym3_inverse(&diagonal[k]);
        if (i < middle) block_take_out(diagonal, x, i + 1, i, &links[i]);
        if (k > middle) block_take_out(diagonal, x, k - 1, k, &links[k - 1]);
    }
    diagonal[middle] = sym3_inverse(&diagonal[middle]);
    block_substitute(first, last, middle, diagonal, links, x);
}

/// The same for another right side, once `diagonal` holds the inverse pivots.
FN void block_solve_again(int first, int last, const Sym3 *diagonal, const Coupling *links, Vec3 *x)
{
    if (first >= last) return;
    int middle = (first + last) / 2;
    for (int i = first, k = last - 1; i < middle || k > middle; i++, k--) {
        if (i < middle)
            x[i + 1] =
                vec3_add(x[i + 1], coupling_apply(&links[i], sym3_apply(&diagonal[i], x[i])));
        if (k > middle)
            x[k - 1] =
                vec3_add(x[k - 1], coupling_apply(&links[k - 1], sym3_apply(&diagonal[k], x[k])));
    }
    block_substitute(first, last, middle, diagonal, links, x);
}

#endif
