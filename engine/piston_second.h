/// The piston to second order in a sea: what its motion must have beside the strokes of the
/// components, so that neither free long waves nor free short ones are made. The derivation is in
/// docs/physics.md (Flume).
///
/// Convention: a component's progressive wave at the piston is Re{a e^{i omega t}}, its stroke
/// Re{-i a (S/H) e^{i omega t}}.
#ifndef FAIRLEAD_PISTON_SECOND_H
#define FAIRLEAD_PISTON_SECOND_H

#include "base/arena.h"
#include "base/error.h"

/// Evanescent modes that are summed; those beyond by their asymptote, which leaves 0.3 % of
/// a transfer up to kd 3, 2 % at kd 6.
enum { PISTON_MODES = 16 };

/// One component's first-order field before the piston: the wave that leaves, and what stays.
typedef struct PistonModes {
    double angular_frequency;   ///< [rad/s]
    double wave_number;         ///< of the wave that leaves [1/m]
    double elevation;           ///< its amplitude over that of the piston, H/S [-]
    double decay[PISTON_MODES]; ///< q: mode j falls off as exp(-q x) [1/m]
    double share[PISTON_MODES]; ///< b: its amplitude at the piston over the wave's is -i b [-]
    double wall;                ///< sum of all b but the asymptote's [-]
} PistonModes;

typedef enum PistonProduct {
    PISTON_SUM,        ///< of two frequencies
    PISTON_DIFFERENCE, ///< of them
} PistonProduct;

/// Complex amplitude of the piston's motion over the product of two components' [1/m].
typedef struct PistonTransfer {
    double real, imaginary;
} PistonTransfer;

/// A table for one layer of a sea of `count` components, evaluated every step: for n >= m, lines
/// packed one after another, the four sums that leave eight multiplications to a pair.
typedef struct PistonPairs {
    int count;
    PistonModes *modes; ///< of the components, while the table is filled [count]
    double *along_cosine, *along_sine, *across_cosine, *across_sine; ///< [count (count + 1)/2][m]
} PistonPairs;

/// Modes of a component. Source: Biesel & Suquet (1951); Dean & Dalrymple (1991), ch. 6.
PistonModes piston_modes(double angular_frequency, double depth, double gravity);

/// Transfer of a pair. Of the sum of a component with itself the half is returned, as its square
/// has it.
/// @param fast, slow  the first one's frequency is the higher, or equal in a sum
/// Source: Schaffer (1996), Ocean Engng 23(1), 47, for the problem; the form of its solution here
/// is our own.
PistonTransfer piston_transfer(const PistonModes *fast, const PistonModes *slow,
                               PistonProduct product, double depth, double gravity);

bool piston_pairs_take(PistonPairs *pairs, int count, Arena *arena, Error *error);

/// Fill the table.
/// @param amplitude, angular_frequency  of the components, by rising frequency [count]
/// @param slowest  differences fade below it by 1 - exp(-(Omega/slowest)^2) [rad/s]; 0 = none does
void piston_pairs_make(PistonPairs *pairs, const double *amplitude, const double *angular_frequency,
                       double depth, double gravity, double slowest);

/// Second-order displacement [m]. @param cosine, sine  of the components' angles now [count]
double piston_pairs_sum(const PistonPairs *pairs, const double *cosine, const double *sine);

#endif
