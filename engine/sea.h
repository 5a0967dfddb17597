/// Irregular seas and focused groups: a sum of components that replaces the single train of a
/// layer. A scene of regular waves has no Sea.
///
/// A component is Airy's wave with dispersion of its own, followed along particles: columns move on
/// the sum of the closed orbits about their mean places, and the velocity at a place is that of the
/// particle that is there now. So ring and zone agree, short waves ride on long ones, and there is
/// no drift at all, crossed terms included (docs/physics.md).
#ifndef FAIRLEAD_SEA_H
#define FAIRLEAD_SEA_H

#include "base/arena.h"
#include "base/error.h"
#include "piston_second.h"
#include "waves.h"

/// One component whatever height, period and heading are: what seed and spectrum decide.
typedef struct SeaShape {
    double frequency; ///< of the peak's [-]
    double share; ///< amplitude: irregular, of the significant height; focused, of the crest [-]
    double turn;  ///< direction off the heading [rad]
    double phase; ///< irregular only [rad]
} SeaShape;

/// The components of one layer, ready for evaluation. Arrays of count values.
typedef struct SeaLayer {
    WaveTarget target; ///< with its gain; this and the next are what the arrays were made of
    double time_origin;
    bool made;
    double *amplitude;         ///< a/(1 - E) [m]
    double *wave_number;       ///< k [1/m]
    double *angular_frequency; ///< [rad/s]
    double *turns_x, *turns_y; ///< wave number vector / 2 pi [1/m]
    double *turns;             ///< theta / 2 pi at x = y = 0 and `time_origin`
    double *depth_ratio;       ///< E = exp(-2kd)
    double *cosine, *sine;     ///< of the direction
    PistonPairs pairs;         ///< only where Sea.second
    double pairs_start;        ///< what they give at `time_origin`, taken off [m]
} SeaLayer;

typedef struct Sea {
    int count;
    SeaShape *shape; ///< [count]
    SeaLayer layers[WAVE_LAYERS_MAX];
    double depth, level, gravity, centre_x, centre_y;
    double focus_x, focus_y, focus_time;
    bool focused, plane;
    bool second;     ///< a piston makes it, to second order
    double piston_x; ///< mean place [m]
    double slowest;  ///< lowest seiche of the flume [rad/s]
} Sea;

/// Components by the scene's spectrum, spreading and seed.
bool sea_create(const Scene *scene, Arena *arena, Sea **sea, Error *error);

/// Make anew what does not fit the layers any more; after every change of them.
void sea_refresh(Sea *sea, const WaveState *waves);

/// What waves.h promises, for a sea; weights are those of the layers at `time`.
Vec3 sea_displacement(const WaveState *waves, Vec3 mean, double time);
Vec3 sea_orbit_velocity(const WaveState *waves, Vec3 mean, double time);
Vec3 sea_velocity(const WaveState *waves, Vec3 point, double time);
Vec3 sea_acceleration(const WaveState *waves, Vec3 point, double time);
double sea_elevation(const WaveState *waves, double x, double y, double time);
void sea_ring_places(const WaveState *waves, double time, int count, const Vec3 *mean, Vec3 *place);
void sea_zone_batch(const WaveState *waves, double time, int count, const float *x, const float *y,
                    const float *z, float *u, float *v, float *w);

/// Spectral density over m0/f_p at f/f_p, JONSWAP's form; peak enhancement 1 is that of Pierson &
/// Moskowitz. Not normalised.
/// S ~ x^-5 exp(-5/4 x^-4) gamma^b, b = exp(-(x - 1)^2/(2 s^2)), s = 0.07 (x <= 1) or 0.09.
/// Source: Hasselmann et al. (1973), Dtsch. Hydrogr. Z. Suppl. A8(12); Pierson & Moskowitz (1964),
/// doi:10.1029/JZ069i024p05181.
double sea_density(double x, double peak_enhancement);

/// The generator of phases and directions: SplitMix64, equal bits everywhere.
/// Source: Steele, Lea & Flood (2014), doi:10.1145/2660193.2660195.
uint64_t sea_random(uint64_t *state);

#endif
