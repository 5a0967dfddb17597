/// How good the waves are where it matters: height at gauges over the height asked for, reflection,
/// and a slow gain that makes the wave at one gauge as high as was asked.
#ifndef FAIRLEAD_WAVE_QUALITY_H
#define FAIRLEAD_WAVE_QUALITY_H

#include "scene.h"
#include "waves.h"

enum {
    QUALITY_GAUGES = 3,
    QUALITY_SLOTS = QUALITY_GAUGES + 1, ///< the last for the gain
    QUALITY_HARMONICS = 5,
};

/// One gauge: the period under way, and means over the last ones.
typedef struct GaugeWave {
    double cosine[QUALITY_HARMONICS]; ///< sum of 2 eta cos j omega t dt of this period [m s]
    double sine[QUALITY_HARMONICS];
    double square;                  ///< sum of eta^2 dt [m^2 s], for seas
    double eta;                     ///< of the last sample [m]
    double height;                  ///< [m]; NAN before the first whole period
    double real[QUALITY_HARMONICS]; ///< means: eta = sum real cos j omega t + imaginary sin [m]
    double imaginary[QUALITY_HARMONICS];
} GaugeWave;

/// Plain data; a checkpoint copies it.
typedef struct WaveQuality {
    GaugeWave gauge[QUALITY_SLOTS];
    double begun;      ///< of the present period, NAN = none yet [s]
    double sampled;    ///< last [s]
    int periods;       ///< whole ones since the waves last changed
    double settled;    ///< nothing is counted before [s]; NAN = not known yet
    double reflection; ///< wave that runs back over the one that comes [-]; NAN unknown
} WaveQuality;

WaveQuality wave_quality_create(void);

/// Whether the scene asks for any of it.
bool wave_quality_asked(const Scene *scene);

/// Elevation of a gauge by its index [m].
typedef double (*GaugeReader)(const void *context, int gauge);

/// After a step: samples gauges forty times a period, closes periods, moves the gain.
void wave_quality_advance(WaveQuality *quality, const Scene *scene, WaveState *waves, double time,
                          GaugeReader read, const void *context);

/// Amplitudes of the incident and the reflected wave from complex amplitudes at places `along` its
/// way [m], by least squares: eta = a exp(ikx) + b exp(-ikx).
/// @return |b/a|; NAN where the places cannot tell (all multiples of half a wave apart)
/// Source: Mansard & Funke (1980), Proc. 17th Coastal Eng. Conf., 154.
double wave_reflection(double wave_number, int count, const double *along, const double *real,
                       const double *imaginary);

#endif
