/// Waves that may be changed while they run: what the ring, the relaxation zone, the hot
/// start and the lines ask of the incident wave. Pure formulas are in physics/wave_theory.h.
#ifndef FAIRLEAD_WAVES_H
#define FAIRLEAD_WAVES_H

#include "base/portable.h"
#include "current.h"
#include "physics/wave_theory.h"
#include "scene.h"

/// One regular wave train, ready for evaluation:
/// theta = k ((x - centre_x) cos + (y - centre_y) sin) - omega (t - time_origin) + phase.
typedef struct WaveTrain {
    double amplitude;          ///< a = H/2 [m]; 0 = rest
    double phase;              ///< at the centre of the basin [rad] and `time_origin`
    double time_origin;        ///< [s]
    double centre_x, centre_y; ///< phases are matched there [m]
    WaveTheory theory;         ///< that they are of: what was asked, or second order instead
    WaveTerms terms;           ///< wave number, coefficients; phase terms and weights are not set
    double second[2]; ///< flume: the piston's second harmonic over the wave's first squared,
                      ///< real and imaginary part (piston_second.h) [1/m]
    bool is_long;     ///< flume: the piston moves with the water of the whole wave (piston.c)
} WaveTrain;

/// A train laid over those before it. Its opacity b rises from 0 to 1 by a quintic smoothstep.
typedef struct WaveLayer {
    WaveTrain train;
    WaveTarget target;      ///< what it is, for display
    double begin, duration; ///< of the rise [s]; the oldest layer is opaque
    double gain;            ///< its height over the target's [-]
} WaveLayer;

enum {
    WAVE_LAYERS_MAX = 5, ///< the last one is kept for rest
};

/// Where particles may drift with the wave: inside a basin they do, and the water carries nothing
/// because it flows back below; towards the sides both fade over the zone's width, and what drifts
/// turns down there. Width 0: no drift anywhere.
typedef struct WaveInterior {
    double min[2], max[2]; ///< sides [m]; +-1e30 = none
    double width;          ///< [m]
} WaveInterior;

struct Sea;
struct MotionTable;

/// Everything about the waves that changes; plain data, copied by checkpoints (of a sea this holds
/// what its layers are; their components follow from it: waves_refresh).
///
/// A live change lays a new train over the present mixture M: (1 - b) M + b new, while M goes on
/// with whatever change it was in. So weights are never negative and always sum to one — the water
/// is never asked for more than the highest of the trains — and displacement stays twice
/// continuously differentiable however fast commands come. A layer that has become opaque drops all
/// below it.
///
/// Modest changes begin at the step after the command; while a dial is dragged the latest command
/// waits until the newest layer has run a third of its rise. When the heading turns by more than 60
/// deg or the period changes by more than 30 %, a layer of rest takes the old sea down over one old
/// period first: trains that differ much would superpose to nearly twice the height.
typedef struct WaveState {
    WaveTarget asked;                  ///< the last command
    int layer_count;                   ///< 0 = no waves
    WaveLayer layers[WAVE_LAYERS_MAX]; ///< oldest first
    bool active;                       ///< a change (or the starting ramp) is under way
    bool has_queued;                   ///< `queued` waits for its turn
    WaveTarget queued;
    WaveInterior interior;
    Current current;                  ///< that the waves ride on
    double gain;                      ///< of new layers
    struct Sea *sea;                  ///< components; NULL for regular waves; borrowed
    const struct MotionTable *record; ///< what the piston follows instead; NULL without; borrowed
} WaveState;

/// k of omega^2 = g k tanh(k d) [1/m] (Airy); relative error below 1e-12.
double wave_number_airy(double angular_frequency, double depth, double gravity);

/// Trains at t = 0 (hot start: full height at once; ramp: grows over ramp_time).
WaveState waves_create(const Scene *scene);

/// Give irregular or focused waves their components; nothing happens with others.
bool waves_take_sea(WaveState *waves, const Scene *scene, Arena *arena, Error *error);

/// After layers were put back from a copy.
void waves_refresh(const WaveState *waves);

/// Ask for another sea; phases are matched at the basin's centre. The caller has checked the
/// limits.
void waves_command(WaveState *waves, const Scene *scene, const WaveTarget *target, double time);

/// Make the waves' heights `gain` times what is asked for, by a live change of its own.
void waves_set_gain(WaveState *waves, const Scene *scene, double gain, double time);

/// Drop what is covered and start what is queued; call once per step.
void waves_update(WaveState *waves, const Scene *scene, double time);

/// Weights of all layers, w_i = b_i prod_{j > i} (1 - b_j), with time derivatives.
/// @param weights  filled, [layer_count]
void waves_layer_weights(const WaveState *waves, double time, WaveStep *weights);

/// Weight of the newest train at `time` and of all before it (rest included); they sum to one.
void waves_weights(const WaveState *waves, double time, double *from, double *to);
/// What the wave *is* for display: weighted means of the trains (heading on the circle).
WaveTarget waves_now(const WaveState *waves, double time);

/// Trains that count at `time`, ready for evaluation by physics/wave_theory.h (one call per step
/// and many places: what a batch or another backend needs).
/// @param terms  filled, [WAVE_LAYERS_MAX]   @return how many
int waves_terms(const WaveState *waves, double time, WaveTerms *terms);

/// Closed-orbit displacement of the column point whose mean place is `mean` (physics.md, basin),
/// and its velocity. Above still water (freeboard) a column moves with the point at still water:
/// the orbits' growth with height would fold it.
Vec3 waves_displacement(const WaveState *waves, Vec3 mean, double time);
Vec3 waves_orbit_velocity(const WaveState *waves, Vec3 mean, double time);

/// What the relaxation zone aims at, beside the current: Eulerian velocity at (x, min(z, eta))
/// less, towards the sides, the drift of particles (WaveInterior).
Vec3 waves_zone_velocity(const WaveState *waves, Vec3 point, double time);

/// Incident elevation above still water [m], Eulerian velocity beside the current and its rate of
/// change for who goes with the current, at (x, min(z, eta)).
double waves_elevation(const WaveState *waves, double x, double y, double time);
Vec3 waves_velocity(const WaveState *waves, Vec3 point, double time);
Vec3 waves_acceleration(const WaveState *waves, Vec3 point, double time);

/// Places of many ring points in double precision: mean + waves_displacement to 1e-15. For callers
/// that take the wall's velocity and acceleration by differences. Single-threaded: the caller
/// splits the range.
void waves_ring_places(const WaveState *waves, double time, int count, const Vec3 *mean,
                       Vec3 *place);

/// waves_zone_velocity of many places [count] in single precision; y and v may be NULL (2-D).
void waves_zone_batch(const WaveState *waves, double time, int count, const float *x,
                      const float *y, const float *z, float *u, float *v, float *w);

/// Whether a wave may run: against too fast a current there is none of its period.
bool waves_may_run(const Scene *scene, const WaveTarget *target);

/// Width of the basin's relaxation zone or of the flume's beach [m]: the case's, or 0.75 of the
/// longest wave that may be set live (the whole of it for a beach). 0 without waves and in a tank.
double waves_zone_width(const Scene *scene);

/// Ursell's number H L^2/d^3 beyond which second order grows a false crest in its trough.
enum { URSELL_OF_SECOND_ORDER = 26 };

/// Most that the ring's columns or the piston may move sideways in waves that may be set [m]; 0
/// without either. Of a piston that follows a record its table tells (Plan.wall_reach has both).
double waves_wall_reach(const Scene *scene);

/// Warnings a user should read: beyond breaking (Miche), too coarse (H/dp < 5), basin too small.
/// Writes at most `size` characters, lines joined by "; ". @return number of warnings
int waves_warnings(const Scene *scene, char *text, int size);

/// One line for `explain`: what was asked, and the wave that follows from it. The scene has waves.
void waves_tell(const Scene *scene, char *text, int size);

#endif
