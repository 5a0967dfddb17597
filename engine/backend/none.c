/// The machine of a domain without particles: everything is nothing, so that the engine's passes
/// need no second way through.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backend.h"

struct Backend {
    double clocks[CLOCK_COUNT];
    int body_count;
};

static bool none_create(const BackendSetup *setup, const ParticleStart *start, Arena *arena,
                        Backend **backend, Error *error)
{
    (void)start;
    TRY(*backend = arena_take(arena, 1, sizeof **backend, "backend", error));
    (*backend)->body_count = setup->body_count;
    return true;
}

static void none_destroy(Backend *backend) { (void)backend; }
static const char *none_variant(void) { return "no particles"; }

static void none_place(Backend *backend, const Advance *advance)
{
    (void)backend;
    (void)advance;
}

static bool none_forces(Backend *backend, const Vec3 *about, BodyLoad *loads, Error *error)
{
    (void)about;
    (void)error;
    memset(loads, 0, (size_t)backend->body_count * sizeof *loads);
    return true;
}

static void none_advance(Backend *backend, const Advance *advance, ParticleSums *sums)
{
    (void)backend;
    (void)advance;
    memset(sums, 0, sizeof *sums);
    sums->sick = -1;
}

static int none_worst(const Backend *backend, WorstBy by, Vec3 *place)
{
    (void)backend;
    (void)by;
    (void)place;
    return -1;
}

static void none_download(Backend *backend, float (*position)[3], float (*velocity)[3],
                          float *pressure)
{
    (void)backend;
    (void)position;
    (void)velocity;
    (void)pressure;
}

static double none_elevation(Backend *backend, double x, double y)
{
    (void)backend;
    (void)x;
    (void)y;
    return NAN;
}

static double none_pressure(Backend *backend, Vec3 point, Vec3 normal)
{
    (void)backend;
    (void)point;
    (void)normal;
    return NAN;
}

static void none_velocity(Backend *backend, Vec3 point, Vec3 *velocity, double *share)
{
    (void)backend;
    (void)point;
    *velocity = vec3(0, 0, 0);
    *share = 0;
}

static void none_wetness(Backend *backend, Vec3 from, Vec3 to, int count, double *share)
{
    (void)backend;
    (void)from;
    (void)to;
    memset(share, 0, (size_t)count * sizeof *share);
}

static void none_columns(const Backend *backend, const BodyPose *pose, Vec3 min, Vec3 max,
                         const int count[2], double *volume)
{
    (void)backend;
    (void)pose;
    (void)min;
    (void)max;
    memset(volume, 0, (size_t)count[0] * (size_t)count[1] * sizeof *volume);
}

static FluidEnergy none_energy(const Backend *backend)
{
    (void)backend;
    FluidEnergy energy;
    memset(&energy, 0, sizeof energy);
    return energy;
}

static FluidWorks none_works(const Backend *backend)
{
    (void)backend;
    FluidWorks works;
    memset(&works, 0, sizeof works);
    return works;
}

static size_t none_state_size(const Backend *backend)
{
    (void)backend;
    return 1;
}

static void none_save(const Backend *backend, void *to)
{
    (void)backend;
    (void)to;
}

static void none_restore(Backend *backend, const void *from)
{
    (void)backend;
    (void)from;
}

static const double *none_clocks(const Backend *backend) { return backend->clocks; }

static void none_statistics(const Backend *backend, BackendStatistics *statistics)
{
    (void)backend;
    memset(statistics, 0, sizeof *statistics);
}

static double none_pair_cost(Backend *backend, unsigned bit)
{
    (void)backend;
    (void)bit;
    return 0;
}

static bool none_probe_rates(Backend *backend, float (*acceleration)[3], float *density_rate,
                             Error *error)
{
    (void)backend;
    (void)acceleration;
    (void)density_rate;
    (void)error;
    return true;
}

const BackendTable *backend_none(void)
{
    static const BackendTable table = {
        .name = "none",
        .create = none_create,
        .destroy = none_destroy,
        .variant = none_variant,
        .place = none_place,
        .forces = none_forces,
        .advance = none_advance,
        .worst = none_worst,
        .download = none_download,
        .elevation = none_elevation,
        .pressure = none_pressure,
        .velocity = none_velocity,
        .wetness = none_wetness,
        .columns = none_columns,
        .energy = none_energy,
        .works = none_works,
        .state_size = none_state_size,
        .save = none_save,
        .restore = none_restore,
        .clocks = none_clocks,
        .statistics = none_statistics,
        .pair_cost = none_pair_cost,
        .probe_rates = none_probe_rates,
    };
    return &table;
}
