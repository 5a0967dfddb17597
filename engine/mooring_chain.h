/// Linear systems of lines: block-tridiagonal along a line, with bending block-pentadiagonal, and
/// the free points between lines. Not for others than mooring*.c.
#ifndef FAIRLEAD_MOORING_CHAIN_H
#define FAIRLEAD_MOORING_CHAIN_H

#include "base/arena.h"
#include "base/error.h"
#include "mooring_block.h"

/// Bending of a line at an inner node: k (1 - q-.q+), the energy of k = EI/l times half the squared
/// change of direction.
typedef struct Bend {
    double stiffness;    ///< k [J]
    double time;         ///< damping over stiffness [s]
    double growth;       ///< of the forces with a move: 1, in an implicit step also by the rate
    Vec3 before, after;  ///< unit vectors q-, q+
    double below, above; ///< 1/s-, 1/s+ [1/m]
} Bend;

/// A line's part of a system. Unknowns are the places of its inner nodes and of its ends that are
/// at free points.
typedef struct Chain {
    int last;        ///< index of the fairlead node
    int point[2];    ///< of the system, at anchor and fairlead; -1 = held
    Sym3 *diagonal;  ///< [last + 1]; ends without what the point itself adds
    Coupling *links; ///< [last]
    Bend *bends;     ///< [last + 1], NULL = the line does not bend
    double *band;    ///< its matrix when it bends
    Vec3 *x;         ///< right side, then solution [last + 1]; 0 at held ends
    Vec3 *column[2]; ///< of free ends: answer of the inner nodes to a unit move [3][last + 1]
} Chain;

/// The free points of a system.
typedef struct PointBlock {
    int count;
    Sym3 *diagonal; ///< of the points themselves [count]
    Vec3 *x;        ///< their right side, then solution [count]
    double *matrix; ///< [3 count][3 count]
    double *vector; ///< [3 count]
} PointBlock;

/// Arrays of a chain; columns for its free ends, a band when it `bends`.
bool chain_create(Chain *chain, int last, const int point[2], bool bends, Arena *arena,
                  const char *what, Error *error);
bool point_block_create(PointBlock *points, int count, Arena *arena, const char *what,
                        Error *error);

/// Solve for all chains and points: inner nodes are eliminated onto the points (Schur complement),
/// whose small dense system is solved by Cholesky's method. Diagonals are overwritten.
void chains_solve(Chain *const *chains, int count, PointBlock *points);

/// Forces of a bend on the node before, on it and after.
void bend_forces(const Bend *bend, Vec3 force[3]);

/// Growth of those forces with a move of the three nodes, to first order in small turns, times
/// `growth`; of the forces of damping with their velocities, times `time` in its place.
void bend_change(const Bend *bend, const Vec3 *move, Vec3 force[3]);

#endif
