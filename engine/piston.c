#include "piston.h"

#include "waves.h"

double piston_stroke_ratio(double kd)
{
    // for large kd the ratio of the exponentials
    if (kd > 300) return 0.5;
    return (sinh(2 * kd) + 2 * kd) / (2 * (cosh(2 * kd) - 1));
}

/// First-order piston: the far field is eta = a cos(kx - omega t + phase), so the paddle's velocity
/// is in phase with the elevation it makes and its displacement a quarter period behind.
static double piston_displacement(const WaveState *waves, double time)
{
    double displacement = 0, below = 1;
    for (int i = waves->layer_count - 1; i >= 0; i--) {
        const WaveLayer *layer = &waves->layers[i];
        double s = layer->duration > 0 ? (time - layer->begin) / layer->duration : 1;
        s = s < 0 ? 0 : (s > 1 ? 1 : s);
        double opacity = i == 0 && layer->duration <= 0 ? 1 : s * s * s * (10 - 15 * s + 6 * s * s);
        const WaveTrain *t = &layer->train;
        double half_stroke =
            t->amplitude * piston_stroke_ratio(t->terms.wave_number * t->terms.depth);
        double angle = t->terms.angular_frequency * (time - t->time_origin) - t->phase;
        displacement += below * opacity * half_stroke * sin(angle);
        below *= 1 - opacity;
    }
    return displacement;
}

void piston_move(const void *context, double time, int count, const Vec3 *mean, Vec3 *place)
{
    double shift = piston_displacement(context, time);
    for (int i = 0; i < count; i++)
        place[i] = vec3(mean[i].x + shift, mean[i].y, mean[i].z);
}
