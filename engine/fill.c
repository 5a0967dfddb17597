#include "fill.h"

#include <math.h>
#include <string.h>

#include "carve.h"
#include "physics/fluid.h"
#include "waves.h"

/// Lattice of one box of water; pitches divide the box exactly.
typedef struct Lattice {
    Vec3 min;
    int count[3];
    double pitch[3];
} Lattice;

static Lattice lattice_of(Vec3 min, Vec3 max, double spacing, int dimensions)
{
    Lattice lattice;
    double low[3] = {min.x, min.y, min.z}, size[3] = {max.x - min.x, max.y - min.y, max.z - min.z};
    for (int a = 0; a < 3; a++) {
        int n = (int)floor(size[a] / spacing + 0.5);
        lattice.count[a] = n < 1 ? 1 : n;
        lattice.pitch[a] = size[a] / lattice.count[a];
    }
    if (dimensions == 2) {
        low[1] = -0.5;
        lattice.count[1] = 1;
        lattice.pitch[1] = 1;
    }
    lattice.min = vec3(low[0], low[1], low[2]);
    return lattice;
}

/// Depths at which a column of compressed water carries its own weight: density rho0 (1 + b/B),
/// B = c0^2/g, so the mass above depth b is rho0 (b + b^2/2B). A uniform lattice would sink by
/// about half a percent of the depth and ring.
static double column_mass(const Scene *scene, const Plan *plan, double depth)
{
    double scale = plan->sound_speed * plan->sound_speed / scene->fluid.gravity;
    return depth + depth * depth / (2 * scale);
}
static double column_depth(const Scene *scene, const Plan *plan, double mass)
{
    double scale = plan->sound_speed * plan->sound_speed / scene->fluid.gravity;
    return scale * (sqrt(1 + 2 * mass / scale) - 1);
}

static Vec3 lattice_point(const Lattice *l, int i, int j, int k)
{
    return vec3(l->min.x + (i + 0.5) * l->pitch[0], l->min.y + (j + 0.5) * l->pitch[1],
                l->min.z + (k + 0.5) * l->pitch[2]);
}

/// One box of water that is being filled.
typedef struct Box {
    const Scene *scene;
    const Plan *plan;
    const WaveState *waves; ///< displace water at t = 0; NULL = at rest
    Lattice lattice;
    double surface;    ///< z [m]
    double layer_mass; ///< of one layer: column_mass [m]
    Vec3 current;      ///< velocity of all water at t = 0 [m/s]
} Box;

static Vec3 mean_place(const Box *box, int i, int j, int k)
{
    Vec3 mean = lattice_point(&box->lattice, i, j, k);
    double mass = (box->lattice.count[2] - k - 0.5) * box->layer_mass;
    mean.z = box->surface - column_depth(box->scene, box->plan, mass);
    return mean;
}

/// A standing wave at rest at its highest, to first order: a = H/2, k X along the tank,
/// xi = -a (cosh K/sinh kd) sin kX, zeta = a (sinh K/sinh kd) cos kX (Dean & Dalrymple 1991, 4.6).
static Vec3 standing_shift(const Scene *scene, Vec3 mean)
{
    const Domain *domain = &scene->domain;
    double k = scene->fluid.standing_mode * PI / (domain->max.x - domain->min.x);
    double depth = scene->fluid.level - domain->min.z, along = k * (mean.x - domain->min.x);
    double e = exp(k * (mean.z - scene->fluid.level)), E = exp(-2 * k * depth);
    double amplitude = 0.5 * scene->fluid.standing_height / (1 - E);
    return vec3(-amplitude * (e + E / e) * sin(along), 0, amplitude * (e - E / e) * cos(along));
}

/// Its dynamic pressure over rho g there, less the lift: a particle keeps the rest [m].
static double standing_pressure(const Scene *scene, Vec3 mean, Vec3 shift)
{
    const Domain *domain = &scene->domain;
    double k = scene->fluid.standing_mode * PI / (domain->max.x - domain->min.x);
    double depth = scene->fluid.level - domain->min.z;
    double e = exp(k * (mean.z - scene->fluid.level)), E = exp(-2 * k * depth);
    double crest = 0.5 * scene->fluid.standing_height * cos(k * (mean.x - domain->min.x));
    return crest * (e + E / e) / (1 + E) - shift.z;
}

static void write_fluid(const Box *box, Fill *fill, int n, Vec3 mean, Vec3 shift)
{
    const WaveState *waves = box->waves;
    double below = box->surface - mean.z;
    fill->fluid_position[n] = vec3_add(mean, shift);
    fill->fluid_velocity[n] = box->current;
    if (box->scene->fluid.standing_height > 0) below += standing_pressure(box->scene, mean, shift);
    if (waves) {
        Vec3 orbit = waves->sea ? waves_orbit_velocity(waves, mean, 0)
                                : waves_zone_velocity(waves, fill->fluid_position[n], 0);
        fill->fluid_velocity[n] = vec3_add(fill->fluid_velocity[n], orbit);
        // a particle keeps its mean pressure but for what deep water theory leaves out:
        // p_dynamic/(rho g) - zeta = eta cosh K/cosh kd - zeta
        const WaveTerms *w = &waves->layers[0].train.terms;
        double e = exp(w->wave_number * (mean.z - w->level)), E = w->depth_ratio;
        double ratio = (e + E / e) / (1 + E); // cosh K/cosh kd
        Vec3 place = fill->fluid_position[n];
        below += waves_elevation(waves, place.x, place.y, 0) * ratio - shift.z;
    }
    double h = box->scene->fluid.smoothing_ratio * box->scene->fluid.spacing;
    below +=
        h * surface_head(maxd(0, below) / h, surface_head_most(box->scene->fluid.kernel,
                                                               box->scene->fluid.smoothing_ratio));
    fill->fluid_excess[n] =
        (float)hydrostatic_excess(below, box->scene->fluid.gravity, box->plan->sound_speed);
}

/// The lattice's plane i: counts its water and, when `first` is not negative, writes it from there
/// on.
static int fill_plane(const Box *box, Fill *fill, int i, int first)
{
    int count = 0;
    if (first < 0 && !box->scene->body_count) // nothing carves
        return box->lattice.count[1] * box->lattice.count[2];
    for (int j = 0; j < box->lattice.count[1]; j++)
        for (int k = 0; k < box->lattice.count[2]; k++) {
            Vec3 mean = mean_place(box, i, j, k), shift = vec3(0, 0, 0);
            if (box->waves) shift = waves_displacement(box->waves, mean, 0);
            if (box->scene->fluid.standing_height > 0) shift = standing_shift(box->scene, mean);
            if (box->scene->body_count && carve_hits(box->scene, box->plan, vec3_add(mean, shift)))
                continue;
            if (first >= 0) write_fluid(box, fill, first + count, mean, shift);
            count++;
        }
    return count;
}

/// Planes are counted side by side, told their place one after another, then written side by side.
static void fill_box(const Scene *scene, const Plan *plan, const WaveState *waves, Fill *fill,
                     Vec3 min, Vec3 max)
{
    Box box = {.scene = scene, .plan = plan, .waves = waves, .surface = max.z};
    box.lattice = lattice_of(min, max, scene->fluid.spacing, scene->domain.dimensions);
    if (scene->waves.current.speed > 0) box.current = current_velocity(&scene->waves.current, 0);
    box.layer_mass = column_mass(scene, plan, max.z - min.z) / box.lattice.count[2];
#pragma omp parallel for ordered schedule(static, 1) num_threads(plan->options.threads)
    for (int i = 0; i < box.lattice.count[0]; i++) {
        int first, count = fill_plane(&box, fill, i, -1);
#pragma omp ordered
        {
            first = fill->fluid_count;
            fill->fluid_count += count;
        }
        if (fill->fluid_position) fill_plane(&box, fill, i, first);
    }
}

static double box_mass(const Scene *scene, const Plan *plan, Vec3 min, Vec3 max)
{
    Lattice l = lattice_of(min, max, scene->fluid.spacing, scene->domain.dimensions);
    double high = column_mass(scene, plan, max.z - min.z) / l.count[2];
    return scene->fluid.density * l.pitch[0] * l.pitch[1] * high;
}

static bool fill_water(const Scene *scene, const Plan *plan, Fill *fill, Error *error)
{
    const Domain *domain = &scene->domain;
    WaveState state;
    Arena sea = arena_create(0);
    bool good = true;
    bool hot = scene->waves.kind != WAVES_NONE && scene->waves.start == WAVE_START_HOT &&
               domain->kind == DOMAIN_BASIN;
    if (hot) {
        state = waves_create(scene);
        good = waves_take_sea(&state, scene, &sea, error);
    }
    if (!scene->fluid.block_count && good) {
        Vec3 top = domain->max;
        top.z = scene->fluid.level;
        fill->particle_mass = box_mass(scene, plan, domain->min, top);
        fill_box(scene, plan, hot ? &state : NULL, fill, domain->min, top);
    }
    arena_destroy(&sea);
    if (!scene->fluid.block_count) return good;
    double mass = 0;
    for (int b = 0; b < scene->fluid.block_count; b++) {
        const FluidBlock *block = &scene->fluid.blocks[b];
        mass += box_mass(scene, plan, block->min, block->max) / scene->fluid.block_count;
        fill_box(scene, plan, NULL, fill, block->min, block->max);
    }
    fill->particle_mass = mass;
    return true;
}

static void add_dummy(Fill *fill, int *count, Vec3 reference, int owner)
{
    int n = fill->wall_count + fill->ring_count + fill->piston_count + fill->body_count;
    (*count)++;
    if (!fill->dummy_reference) return;
    fill->dummy_reference[n] = reference;
    fill->dummy_owner[n] = (int16_t)owner;
}

/// Which wall a lattice point outside the water belongs to.
static int *wall_of(const Scene *scene, Fill *fill, const Lattice *l, const int index[3],
                    int *owner)
{
    bool below = index[2] < 0;
    bool left = index[0] < 0;
    bool across = index[1] < 0 || index[1] >= l->count[1];
    *owner = OWNER_FIXED;
    if (below) return &fill->wall_count;
    if (scene_has_ring(scene)) {
        *owner = OWNER_RING;
        return &fill->ring_count;
    }
    if (scene->domain.kind == DOMAIN_FLUME && scene->waves.kind != WAVES_NONE && left && !across) {
        *owner = OWNER_PISTON;
        return &fill->piston_count;
    }
    return &fill->wall_count;
}

/// How many cells an index lies outside of 0 … count - 1; 0 inside.
static int cells_beyond(int index, int count)
{
    if (index < 0) return -index;
    return index < count ? 0 : index - count + 1;
}

static void fill_walls(const Scene *scene, const Plan *plan, Fill *fill)
{
    Vec3 top = scene->domain.max;
    top.z = scene->fluid.block_count ? scene->domain.max.z : scene->fluid.level;
    Lattice l = lattice_of(scene->domain.min, top, scene->fluid.spacing, scene->domain.dimensions);
    int n = plan->wall_layers, ny = scene->domain.dimensions == 2 ? 0 : n;
    int high = (int)ceil((scene->domain.max.z - scene->domain.min.z) / l.pitch[2] - 1e-6);
    // Ring and piston slide along the fixed walls, which go on as far: a hole behind the corner
    // would draw the water in.
    bool flume = scene->domain.kind == DOMAIN_FLUME;
    int apron = (int)ceil(plan->wall_reach / scene->fluid.spacing - 1e-6);
    int left = n + apron, right = flume ? n : left;
    if (ny && !flume) ny += apron;
    for (int i = -left; i < l.count[0] + right; i++)
        for (int j = -ny; j < l.count[1] + ny; j++)
            for (int k = -n; k < high; k++) {
                int x = cells_beyond(i, l.count[0]), y = cells_beyond(j, l.count[1]);
                bool water = k >= 0 && !x && !y, slides = k < 0 || (flume && y);
                if (water || ((x > n || y > n) && !slides)) continue;
                int index[3] = {i, j, k}, owner;
                int *count = wall_of(scene, fill, &l, index, &owner);
                add_dummy(fill, count, lattice_point(&l, i, j, k), owner);
            }
}

void fill_pitches(const Scene *scene, double pitch[2])
{
    Vec3 top = scene->domain.max;
    Lattice l = lattice_of(scene->domain.min, top, scene->fluid.spacing, scene->domain.dimensions);
    pitch[0] = l.pitch[0];
    pitch[1] = scene->domain.dimensions == 2 ? 0 : l.pitch[1];
}

bool fill_particles(const Scene *scene, const Plan *plan, Fill *fill, Error *error)
{
    fill->fluid_count = fill->wall_count = fill->ring_count = 0;
    fill->piston_count = fill->body_count = 0;
    TRY(fill_water(scene, plan, fill, error));
    fill_walls(scene, plan, fill);
    for (int b = 0; b < scene->body_count; b++)
        for (int p = 0; p < plan->bodies[b].particle_count; p++)
            add_dummy(fill, &fill->body_count, plan->bodies[b].particles[p], b);
    return true;
}

bool fill_create(const Scene *scene, const Plan *plan, Arena *arena, Fill *fill, Error *error)
{
    memset(fill, 0, sizeof *fill);
    size_t fluid = (size_t)plan->fluid_count;
    size_t dummies = (size_t)plan->wall_count + (size_t)plan->body_particle_count;
    TRY(fill->fluid_position = arena_take(arena, fluid, sizeof(Vec3), "start.position", error));
    TRY(fill->fluid_velocity = arena_take(arena, fluid, sizeof(Vec3), "start.velocity", error));
    TRY(fill->fluid_excess = arena_take(arena, fluid, sizeof(float), "start.excess", error));
    TRY(fill->dummy_reference = arena_take(arena, dummies, sizeof(Vec3), "start.dummies", error));
    TRY(fill->dummy_owner = arena_take(arena, dummies, sizeof(int16_t), "start.owners", error));
    return fill_particles(scene, plan, fill, error);
}
