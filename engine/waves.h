/// Regular waves that may be changed while they run: what the ring, the relaxation zone, the hot
/// start and the lines ask of the incident wave. Pure formulas are in physics/wave_theory.h.
#ifndef FAIRLEAD_WAVES_H
#define FAIRLEAD_WAVES_H

#include "base/portable.h"
#include "scene.h"

/// One regular wave train, ready for evaluation:
/// theta = k (x cos + y sin) - omega (t - time_origin) + phase.
typedef struct WaveTrain {
    double amplitude;         ///< a = H/2 [m]
    double wave_number;       ///< k [1/m]
    double angular_frequency; ///< omega [rad/s]
    double cos_heading, sin_heading;
    double phase;              ///< at the centre of the basin [rad] and `time_origin`
    double time_origin;        ///< [s]
    double centre_x, centre_y; ///< phases are matched there [m]
    double depth;              ///< [m]
    double level;              ///< still-water level [m]
} WaveTrain;

/// Everything about the waves that changes; plain data, copied by checkpoints.
/// A live change runs in one or two legs: a modest one blends old to new (1-b) old + b new over
/// blend_periods of the new period; when the heading turns far (over 60 deg) the old train is taken
/// down first and the new one raised after it.
typedef struct WaveState {
    WaveTarget asked;        ///< the last command
    WaveTrain from, to;      ///< trains before and after the current change
    double change_begin;     ///< [s]
    double from_end;         ///< `from` has faded out by then [s]
    double to_begin, to_end; ///< `to` grows in between [s]
    bool active;             ///< a change (or the starting ramp) is under way
    bool has_queued;         ///< another command came during the change
    WaveTarget queued;
} WaveState;

/// k of omega^2 = g k tanh(k d) [1/m] (Airy); relative error below 1e-12.
double wave_number_airy(double angular_frequency, double depth, double gravity);

/// Trains at t = 0 (hot start: full height at once; ramp: grows over ramp_time).
WaveState waves_create(const Scene *scene);

/// Ask for another sea; phases are matched at the basin's centre. The caller has checked the
/// limits.
void waves_command(WaveState *waves, const Scene *scene, const WaveTarget *target, double time);

/// Finish changes that are over and start queued ones; call once per step.
void waves_update(WaveState *waves, const Scene *scene, double time);

/// Weights of the two trains at `time`, each 0..1, and what the wave *is* for display.
void waves_weights(const WaveState *waves, double time, double *from, double *to);
WaveTarget waves_now(const WaveState *waves, double time);

/// Second-order closed-orbit displacement of the column point whose mean place is `mean`
/// (physics.md, basin), and its velocity by central differences in time.
Vec3 waves_displacement(const WaveState *waves, Vec3 mean, double time);
Vec3 waves_orbit_velocity(const WaveState *waves, Vec3 mean, double time);

/// Eulerian velocity at (x, min(z, eta)) less the Stokes drift: what the relaxation zone aims at.
Vec3 waves_zone_velocity(const WaveState *waves, Vec3 point, double time);

/// Incident elevation above still water [m], Eulerian velocity, acceleration (for lines, pictures).
double waves_elevation(const WaveState *waves, double x, double y, double time);
Vec3 waves_velocity(const WaveState *waves, Vec3 point, double time);
Vec3 waves_acceleration(const WaveState *waves, Vec3 point, double time);

/// Warnings a user should read: beyond breaking (Miche), too coarse (H/dp < 5), basin too small.
/// Writes at most `size` characters, lines joined by "; ". @return number of warnings
int waves_warnings(const Scene *scene, char *text, int size);

#endif
