/// What lines and bodies exchange, by both accounts: what the bodies' integrator took and what the
/// lines' ends gave. They may differ by the coupling's error only.
///
/// Bodies move by leapfrog: the pull at the instant t_n is a kick of dt F_n, whose work is
/// dt F_n . (u_{n-1} + u_n)/2, u_n being the speed by the poses at both ends of a step. Lines
/// integrate force, moment and force times path over each step in between. The trapezoidal rule
/// says when the two agree, to second order: with the first and the last kick counted half.
#ifndef FAIRLEAD_LINE_LEDGER_H
#define FAIRLEAD_LINE_LEDGER_H

#include "coupling.h"

/// Sums since t = 0.
typedef struct Exchange {
    Vec3 impulse;         ///< [N s]
    Vec3 angular_impulse; ///< about the centre of gravity [N m s]
    double work;          ///< [J]
} Exchange;

/// One body's account. Plain data, part of a checkpoint.
typedef struct BodyLedger {
    Exchange taken;      ///< by the body's integrator, half of the first kick left out
    Exchange given;      ///< by the ends of lines that it holds
    double impulse_size; ///< sum of their magnitudes, end by end and step by step [N s]
    double angular_size; ///< of arm times impulse [N m s]
    double work_size;    ///< of their work [J]
    Vec3 position;       ///< of the centre of gravity at the last step's end [m]
    Quat attitude;       ///< there
    Vec3 velocity, spin; ///< over the last step, by its poses [m/s], [rad/s]
    double duration;     ///< of the last step [s], 0 = none yet
    bool holds;          ///< any line ends on it
} BodyLedger;

typedef struct LineLedger {
    BodyLedger body[SCENE_BODIES_MAX];
    double holders_work; ///< on all lines, at all held ends [J]
    double energy_start; ///< of all lines and free points at t = 0 [J]
} LineLedger;

/// Both accounts as they stand and how far apart they are.
typedef struct LedgerBalance {
    Exchange taken, given;
    /// Their differences over the sums of magnitudes [-]
    double impulse_error, angular_error, work_error;
    bool good; ///< all within the bounds below and what one step exchanges
} LedgerBalance;

/// (chosen) Largest differences that a coupling of second order may leave, see docs/mooring.md.
static const double LEDGER_IMPULSE_BOUND = 1e-3; ///< also of angular impulse [-]
static const double LEDGER_WORK_BOUND = 1e-2;    ///< [-]
/// (chosen) Nothing is judged before so many steps: sums over a few have nothing to be compared to.
enum { LEDGER_STEPS_LEAST = 500 };

LineLedger line_ledger_create(const Scene *scene, const Body *bodies, const Mooring *mooring);

/// Book a step: bodies and lines as they are at its end, the bodies' loads still those of its kick.
void line_ledger_step(LineLedger *ledger, const Scene *scene, const Body *bodies, const Line *lines,
                      const LinePaths *paths, double duration);

/// @param b  index of a body that holds lines
LedgerBalance line_ledger_balance(const LineLedger *ledger, const Scene *scene, const Body *bodies,
                                  const Line *lines, int b);

#endif
