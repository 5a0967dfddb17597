/// The CPU backend: creation, neighbours, forces. Integration is in cpu_step.c, pair effects in
/// cpu_pairs.c, probes in cpu_probe.c.
#include "backend/cpu.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "physics/fluid.h"

double cpu_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void place(ParticleSet *set, const Grid *grid, int slot, int id, Vec3 position)
{
    set->id[slot] = id;
    *position_of(set, 0, slot) = to_coordinate(grid, 0, position.x);
    *position_of(set, 1, slot) = to_coordinate(grid, 1, position.y);
    *position_of(set, 2, slot) = to_coordinate(grid, 2, position.z);
}

static void place_particles(Backend *b, const ParticleStart *start)
{
    for (int i = 0; i < start->fluid_count; i++) {
        place(&b->fluid, &b->grid, i, i, start->fluid_position[i]);
        *velocity_of(&b->fluid, 0, i) = (float)start->fluid_velocity[i].x;
        *velocity_of(&b->fluid, 1, i) = (float)start->fluid_velocity[i].y;
        *velocity_of(&b->fluid, 2, i) = (float)start->fluid_velocity[i].z;
        *excess_of(&b->fluid, i) = start->fluid_excess[i];
    }
    int fixed = 0, moving = 0;
    for (int i = 0; i < start->dummy_count; i++) {
        if (start->dummy_owner[i] == OWNER_FIXED) {
            place(&b->fixed, &b->grid, fixed, fixed, start->dummy_reference[i]);
            fixed++;
        } else {
            b->moving_reference[moving] = start->dummy_reference[i];
            b->moving_owner[moving] = start->dummy_owner[i];
            place(&b->moving, &b->grid, moving, moving, start->dummy_reference[i]);
            moving++;
        }
    }
}

/// Moving dummies and all that they need.
static bool take_moving(Backend *b, int count, Arena *arena, Error *error)
{
    ParticleSet *m = &b->moving;
    TRY(set_create(m, &b->grid, count, OCTET_DUMMY, arena, error));
    size_t slots = (size_t)m->slot_capacity;
    for (int a = 0; a < 3; a++) {
        TRY(m->acceleration[a] =
                arena_take(arena, slots, sizeof(float), "particles.acceleration", error));
        TRY(m->rate[a] = arena_take(arena, slots, sizeof(float), "particles.rate", error));
        TRY(m->target[a] = arena_take(arena, slots, sizeof(int32_t), "particles.target", error));
    }
    TRY(list_create(&b->fluid_moving, &b->fluid, arena, error));
    TRY(list_create(&b->moving_fluid, m, arena, error));
    TRY(b->moving_reference = arena_take(arena, (size_t)count, sizeof(Vec3), "references", error));
    TRY(b->moving_owner = arena_take(arena, (size_t)count, sizeof(int16_t), "owners", error));
    return true;
}

static bool take_arrays(Backend *b, const ParticleStart *start, Arena *arena, Error *error)
{
    int moving = 0;
    for (int i = 0; i < start->dummy_count; i++)
        moving += start->dummy_owner[i] != OWNER_FIXED;
    int fixed = start->dummy_count - moving;
    TRY(set_create(&b->fluid, &b->grid, start->fluid_count, OCTET_FLUID, arena, error));
    if (fixed) TRY(set_create(&b->fixed, &b->grid, fixed, OCTET_DUMMY, arena, error));
    if (moving) TRY(take_moving(b, moving, arena, error));
    int slots = b->fluid.slot_capacity;
    slots = slots > b->fixed.slot_capacity ? slots : b->fixed.slot_capacity;
    slots = slots > b->moving.slot_capacity ? slots : b->moving.slot_capacity;
    TRY(scratch_create(&b->scratch, &b->grid, slots, b->setup.threads, arena, error));
    for (int a = 0; a < 3; a++)
        b->fluid.rate[a] = (float *)b->scratch.slot[a];
    TRY(pairs_create(b, arena, error));
    TRY(rows_create(&b->rows, &b->grid, arena, error));
    TRY(b->meet = arena_take(arena, (size_t)(b->grid.slab_count + 1) * (size_t)(b->grid.blocks + 2),
                             1, "slabs", error));
    TRY(list_create(&b->fluid_fluid, &b->fluid, arena, error));
    if (fixed) {
        TRY(list_create(&b->fluid_fixed, &b->fluid, arena, error));
        TRY(list_create(&b->fixed_fluid, &b->fixed, arena, error));
    }
    return true;
}

static Sweep make_sweep(Backend *b)
{
    const BackendSetup *s = &b->setup;
    Sweep sweep;
    memset(&sweep, 0, sizeof sweep);
    sweep.fluid = &b->fluid;
    sweep.walls[0] = &b->fixed;
    sweep.walls[1] = &b->moving;
    sweep.fluid_fluid = &b->fluid_fluid;
    sweep.fluid_wall[0] = &b->fluid_fixed;
    sweep.fluid_wall[1] = &b->fluid_moving;
    sweep.wall_fluid[0] = &b->fixed_fluid;
    sweep.wall_fluid[1] = &b->moving_fluid;
    sweep.moving_owner = b->moving_owner;
    sweep.constants =
        sweep_constants(s->kernel, s->smoothing_length, s->dimensions, b->grid.unit,
                        s->particle_mass, s->rest_density, s->sound_speed, s->alpha, s->delta);
    sweep.viscous = viscous_constants(s->kernel, s->smoothing_length, s->dimensions, b->grid.unit,
                                      s->particle_mass / s->rest_density, s->spacing,
                                      s->rest_density, s->viscosity);
    sweep.gravity[2] = (float)-s->gravity;
    sweep.tait_b = (float)(s->sound_speed * s->sound_speed * s->rest_density / TAIT_GAMMA);
    sweep.rest_density = (float)s->rest_density;
    sweep.unit = (float)b->grid.unit;
    sweep.dimensions = s->dimensions;
    // K of the slope, (2h)^2 of the offsets, V = m/rho0
    double h = s->smoothing_length;
    sweep.moment_factor = (float)(kernel_slope_constant(s->kernel, h, s->dimensions) * 4 * h * h *
                                  s->particle_mass / s->rest_density);
    sweep.shift = shift_constants(s->shifting, (double)sweep.moment_factor, s->dimensions);
    return sweep;
}

static bool cpu_create(const BackendSetup *setup, const ParticleStart *start, Arena *arena,
                       Backend **backend, Error *error)
{
    Backend *b;
    TRY(b = arena_take(arena, 1, sizeof *b, "backend", error));
    b->setup = *setup;
    b->skin = maxd(0.3 * setup->spacing, mind(14 * setup->largest_travel, 0.8 * setup->spacing));
    b->grid = grid_create(setup->room_min, setup->room_max, setup->dimensions,
                          2 * setup->smoothing_length, b->skin, setup->spacing);
    double rows = (double)b->grid.slab_rows * b->grid.across_rows;
    if (rows * b->grid.bins > INT32_MAX)
        return error_set(error, ERROR_INPUT,
                         "fluid.spacing_m = %g: the domain needs %.3g sorting bins; at most %d",
                         setup->spacing, rows * b->grid.bins, INT32_MAX);
    b->rows.spacing = (float)setup->spacing;
    b->rows.least_margin = 0.02f * (float)setup->spacing;
    for (int a = 0; a < 3; a++) {
        b->inside_min[a] = to_coordinate(&b->grid, a, setup->inside_min[a] - setup->spacing);
        b->inside_max[a] = to_coordinate(&b->grid, a, setup->inside_max[a] + setup->spacing);
    }
    for (int a = 0; a < 3; a++) {
        bool low = isfinite(setup->barrier_min[a]), high = isfinite(setup->barrier_max[a]);
        b->barrier_min[a] = low ? to_coordinate(&b->grid, a, setup->barrier_min[a]) : 0;
        b->barrier_max[a] =
            high ? to_coordinate(&b->grid, a, setup->barrier_max[a]) : COORDINATE_END;
    }
    b->barrier_top = to_coordinate(&b->grid, 2, setup->barrier_top);
    b->barrier_depth = (int32_t)(2 * setup->spacing / b->grid.unit);
    TRY(take_arrays(b, start, arena, error));
    if (setup->works) TRY(works_create(b, arena, error));
    place_particles(b, start);
    if (setup->body_count) TRY(hulls_create(b, arena, error));
    if (setup->flow[0] != 0 || setup->flow[1] != 0) TRY(conveyor_create(b, arena, error));
    b->sweep = make_sweep(b);
    b->excess_floor =
        (float)tension_floor(setup->gravity, setup->smoothing_length, setup->sound_speed);
    double h = setup->smoothing_length;
    b->surface = surface_excess_of(setup->gravity * h / (setup->sound_speed * setup->sound_speed),
                                   surface_head_most(setup->kernel, h / setup->spacing));
    b->excess_alone = (float)excess_alone(setup->kernel, setup->smoothing_length, setup->dimensions,
                                          setup->particle_mass, setup->rest_density);
    b->table = sweep_table_choose(setup->kernel);
    b->first_step = true;
    if (b->fixed.count) {
        set_sort(&b->fixed, &b->grid, &b->scratch);
        set_boxes(&b->fixed, 0, b->fixed.cluster_count);
    }
    b->table->update_pressure(b);
    *backend = b;
    return true;
}

static void cpu_destroy(Backend *b)
{
    ClusterList *lists[] = {&b->fluid_fluid, &b->fluid_fixed, &b->fluid_moving, &b->fixed_fluid,
                            &b->moving_fluid};
    for (int i = 0; i < 5; i++)
        list_destroy(lists[i]);
}

static const char *cpu_variant(void) { return sweep_table_choose(KERNEL_WENDLAND)->level; }

static void refresh_boxes(ParticleSet *set, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int block = 0; block < set->cluster_count; block += 64)
        set_boxes(set, block, block + 64 < set->cluster_count ? block + 64 : set->cluster_count);
}

void cpu_refresh_boxes(Backend *b)
{
    if (b->boxes_fresh) return;
    refresh_boxes(&b->fluid, b->setup.threads);
    refresh_boxes(&b->moving, b->setup.threads);
    b->boxes_fresh = true;
}

static bool rebuild_lists(Backend *b)
{
    ParticleSet *fluid = &b->fluid, *fixed = &b->fixed, *moving = &b->moving;
    int (*near)(const Boxes *, int, const Boxes *, int, int, float, uint32_t *, int) =
        b->table->near_clusters;
    const ListOrder orders[] = {{&b->fluid_fluid, fluid, fluid, &b->grid, true, near},
                                {&b->fluid_fixed, fluid, fixed, &b->grid, false, near},
                                {&b->fixed_fluid, fixed, fluid, &b->grid, false, near},
                                {&b->fluid_moving, fluid, moving, &b->grid, false, near},
                                {&b->moving_fluid, moving, fluid, &b->grid, false, near}};
    for (int k = 0; k < 5; k++)
        if (orders[k].a->count && orders[k].b->count && !list_build(&orders[k], b->setup.threads))
            return false;
    return true;
}

static void prune_row(Backend *b, int row)
{
    const RowPruning pruning = rows_pruned(&b->rows, row, b->last_step, b->skin);
    double reach = (2 * b->setup.smoothing_length + pruning.margin) / b->grid.unit;
    float squared = (float)(reach * reach);
    ParticleSet *fluid = &b->fluid, *fixed = &b->fixed, *moving = &b->moving;
    struct {
        ClusterList *list;
        const ParticleSet *a, *b;
    } lists[] = {{&b->fluid_fluid, fluid, fluid},
                 {&b->fluid_fixed, fluid, fixed},
                 {&b->fixed_fluid, fixed, fluid},
                 {&b->fluid_moving, fluid, moving},
                 {&b->moving_fluid, moving, fluid}};
    for (int k = 0; k < 5; k++)
        if (lists[k].a->count && lists[k].b->count)
            b->table->prune(lists[k].list, lists[k].a, lists[k].b, lists[k].a->row_begin[row],
                            lists[k].a->row_begin[row + 1], squared, pruning.exact);
}

void cpu_prune(Backend *b)
{
    bool any = false;
    for (int row = 0; row < b->grid.row_count && !any; row++)
        any = rows_due(&b->rows, row);
    if (!any) return;
    cpu_refresh_boxes(b);
#pragma omp parallel for schedule(dynamic, 4) num_threads(b->setup.threads)
    for (int row = 0; row < b->grid.row_count; row++)
        if (rows_due(&b->rows, row)) prune_row(b, row);
}

bool cpu_neighbours(Backend *b, Error *error)
{
    if (!b->sorted || !rows_lists_hold(&b->rows, &b->grid, b->last_step, b->skin)) {
        set_sort(&b->fluid, &b->grid, &b->scratch);
        b->table->update_pressure(b);
        if (EFFECTS_BUILT && b->moving.count) set_sort(&b->moving, &b->grid, &b->scratch);
        b->boxes_fresh = false;
        cpu_refresh_boxes(b);
        b->sorted = rebuild_lists(b);
        rows_sorted(&b->rows, &b->grid);
        b->strayed = 0;
        b->sorts++;
        if (!b->sorted) return error_set(error, ERROR_SYSTEM, "memory: neighbour lists do not fit");
    }
    cpu_prune(b);
    return true;
}

/// Clusters of a block: its part of each of the slab's rows of rows.
static void sweep_block(const Backend *b, void (*function)(const Sweep *, int, int), int slab,
                        int block)
{
    const Grid *grid = &b->grid;
    int first = grid->across_rows * block / grid->blocks;
    int last = grid->across_rows * (block + 1) / grid->blocks;
    for (int s = slab * SLAB_ROWS; s < (slab + 1) * SLAB_ROWS && s < grid->slab_rows; s++)
        function(&b->sweep, b->fluid.row_begin[s * grid->across_rows + first],
                 b->fluid.row_begin[s * grid->across_rows + last]);
}

/// A half list leads into the own and the next slab, there into the own block and those beside it.
/// The tasks of blocks that meet wait for each other in the order of their creation, so sums have
/// the same bits for any number of threads; colours keep neighbours apart.
void cpu_sweep_fluid(Backend *b, SweepFunction function)
{
    int slabs = b->grid.slab_count, blocks = b->grid.blocks, width = blocks + 2;
    char *meet = b->meet; // never written: only places that tasks name
#pragma omp parallel num_threads(b->setup.threads)
#pragma omp single
    for (int colour = 0; colour < 4; colour++)
        for (int slab = colour / 2; slab < slabs; slab += 2)
            for (int block = colour % 2; block < blocks; block += 2) {
                char *own = meet + slab * width + block + 1;
                (void)own; // gcc does not count what only `depend` names
#pragma omp task firstprivate(slab, block)                                                         \
    depend(inout                                                                                   \
           : own[-1], own[0], own[1], own[width - 1], own[width], own[width + 1])
                sweep_block(b, function, slab, block);
            }
}

static void zero_rates(Backend *b, int rates)
{
    ParticleSet *f = &b->fluid;
#pragma omp parallel for schedule(static) num_threads(b->setup.threads)
    for (int block = 0; block < f->cluster_count; block += 64) {
        int end = block + 64 < f->cluster_count ? block + 64 : f->cluster_count;
        for (int a = 0; a < rates; a++)
            memset(f->rate[a] + block * CLUSTER, 0,
                   (size_t)(end - block) * CLUSTER * sizeof(float));
    }
}

static void extrapolate_walls(Backend *b, int set)
{
    int clusters = b->sweep.walls[set]->cluster_count;
#pragma omp parallel for schedule(dynamic, 1) num_threads(b->setup.threads)
    for (int begin = 0; begin < clusters; begin += 64)
        b->table->extrapolate(&b->sweep, set, begin, begin + 64 < clusters ? begin + 64 : clusters);
}

/// Reactions on the dummies of each body, summed in slot order: the same bits for any thread count.
static void sum_loads(Backend *b, const Vec3 *about, BodyLoad *loads)
{
    SweepFunction loads_of = cpu_loads(b, b->setup.pair_mask);
    int clusters = b->moving.cluster_count;
#pragma omp parallel for schedule(dynamic, 1) num_threads(b->setup.threads)
    for (int begin = 0; begin < clusters; begin += 32)
        loads_of(&b->sweep, begin, begin + 32 < clusters ? begin + 32 : clusters);
    double factor = b->sweep.constants.acceleration_factor * b->setup.particle_mass;
    const ParticleSet *m = &b->moving;
    for (int slot = 0; slot < clusters * CLUSTER; slot++) {
        if (m->id[slot] < 0 || b->moving_owner[m->id[slot]] < 0) continue;
        int body = b->moving_owner[m->id[slot]];
        Vec3 force =
            vec3(factor * m->rate[0][slot], factor * m->rate[1][slot], factor * m->rate[2][slot]);
        Vec3 arm = vec3_sub(place_of(&b->grid, m, slot), about[body]);
        loads[body].force = vec3_add(loads[body].force, force);
        loads[body].moment = vec3_add(loads[body].moment, vec3_cross(arm, force));
    }
}

static bool cpu_forces(Backend *b, const Vec3 *about, BodyLoad *loads, Error *error)
{
    double start = cpu_clock(), now;
#define LAP(which) (now = cpu_clock(), b->clock[which] += now - start, start = now)
    TRY(cpu_neighbours(b, error));
    LAP(CLOCK_SORT);
    zero_rates(b, 3);
    LAP(CLOCK_INTEGRATE);
    if (b->fixed.count) {
        extrapolate_walls(b, 0);
        LAP(CLOCK_EXTRAPOLATE);
    }
    if (EFFECTS_BUILT && b->moving.count) {
        extrapolate_walls(b, 1);
        LAP(CLOCK_EXTRAPOLATE_MOVING);
    }
    if (EFFECTS_BUILT && (b->setup.pair_mask & PAIR_GRADIENT)) {
        pairs_correct_gradients(b);
        LAP(CLOCK_GRADIENT);
    }
    if (EFFECTS_BUILT && (b->setup.pair_mask & PAIR_NO_SLIP)) {
        pairs_mirror_velocities(b);
        LAP(CLOCK_NO_SLIP);
    }
    if (EFFECTS_BUILT && (b->setup.pair_mask & PAIR_TURBULENCE)) {
        pairs_find_stresses(b);
        LAP(CLOCK_TURBULENCE);
    }
    if (EFFECTS_BUILT && (b->setup.pair_mask & PAIR_SHIFTING)) {
        pairs_shift(b);
        LAP(CLOCK_SHIFTING);
    }
    if (EFFECTS_BUILT && b->setup.works) {
        works_before_momentum(b);
        LAP(CLOCK_WORKS);
    }
    cpu_sweep_fluid(b, cpu_acceleration(b, b->setup.pair_mask));
    LAP(CLOCK_MOMENTUM);
    if (EFFECTS_BUILT && b->setup.body_count) {
        memset(loads, 0, (size_t)b->setup.body_count * sizeof *loads);
        sum_loads(b, about, loads);
        hulls_give(b, about, loads);
        LAP(CLOCK_LOADS);
    }
    if (EFFECTS_BUILT && b->setup.works) {
        works_after_forces(b);
        LAP(CLOCK_WORKS);
    }
#undef LAP
    return true;
}

/// The kept arrays of all octets in use, one octet's after the other's.
static void octets_transfer(ParticleSet *set, char *to, const char *from)
{
    size_t size = (size_t)set->kept * sizeof set->octet->excess;
    for (size_t c = 0; c < (size_t)set->cluster_count; c++) {
        if (to) memcpy(to + c * size, &set->octet[c], size);
        if (from) memcpy(&set->octet[c], from + c * size, size);
    }
}

/// Bytes of one set that a checkpoint has room for; with `to` what is in use is written, with
/// `from` read.
static size_t set_transfer(ParticleSet *set, char *to, const char *from)
{
    size_t size = 0, item = sizeof(int32_t);
    if (!set->count) return 0;
#define MOVE(pointer, room, used)                                                                  \
    do {                                                                                           \
        if (to) memcpy(to + size, (pointer), (used));                                              \
        if (from) memcpy((pointer), from + size, (used));                                          \
        size += (room);                                                                            \
    } while (0)
    MOVE(&set->cluster_count, sizeof(int), sizeof(int));
    size_t room = (size_t)set->slot_capacity * item;
    size_t used = (size_t)set->cluster_count * CLUSTER * item;
    octets_transfer(set, to ? to + size : NULL, from ? from + size : NULL);
    size += (size_t)set->kept * room;
    for (int a = 0; a < 3 && set->acceleration[a]; a++)
        MOVE(set->acceleration[a], room, used);
    MOVE(set->id, room, used);
#undef MOVE
    return size;
}

/// What else changes, as set_transfer.
static size_t rest_transfer(Backend *b, char *to, const char *from)
{
    bool flows = b->setup.flow[0] != 0 || b->setup.flow[1] != 0;
    struct {
        void *data;
        size_t size;
    } parts[] = {{&b->first_step, sizeof(bool)},
                 {b->sweep.gravity, sizeof b->sweep.gravity},
                 {b->moving_reference, flows ? (size_t)b->moving.count * sizeof(Vec3) : 0},
                 {b->hulls, (size_t)b->setup.body_count * sizeof(HullHold)},
                 {&b->works.sums, b->setup.works ? sizeof(FluidWorks) : 0}};
    size_t size = 0;
    for (int i = 0; i < 5; i++) {
        if (to && parts[i].size) memcpy(to + size, parts[i].data, parts[i].size);
        if (from && parts[i].size) memcpy(parts[i].data, from + size, parts[i].size);
        size += parts[i].size;
    }
    return size;
}

static size_t cpu_state_size(const Backend *b)
{
    Backend *own = (Backend *)b;
    return set_transfer(&own->fluid, NULL, NULL) + set_transfer(&own->moving, NULL, NULL) +
           rest_transfer(own, NULL, NULL);
}

static void cpu_save(const Backend *b, void *to)
{
    Backend *own = (Backend *)b;
    size_t fluid = set_transfer(&own->fluid, to, NULL);
    size_t moving = set_transfer(&own->moving, (char *)to + fluid, NULL);
    rest_transfer(own, (char *)to + fluid + moving, NULL);
}

static void cpu_restore(Backend *b, const void *from)
{
    size_t fluid = set_transfer(&b->fluid, NULL, from);
    size_t moving = set_transfer(&b->moving, NULL, (const char *)from + fluid);
    rest_transfer(b, NULL, (const char *)from + fluid + moving);
    b->sorted = b->boxes_fresh = false;
    b->table->update_pressure(b);
}

static FluidWorks cpu_works(const Backend *b) { return b->works.sums; }

static const double *cpu_clocks(const Backend *b) { return b->clock; }

static bool cpu_probe_rates(Backend *b, float (*acceleration)[3], float *density_rate, Error *error)
{
    TRY(cpu_neighbours(b, error));
    int slots = b->fluid.cluster_count * CLUSTER;
    const SweepConstants *c = &b->sweep.constants;
    zero_rates(b, 3);
    for (int set = 0; set < 2; set++)
        if (b->sweep.walls[set]->count) extrapolate_walls(b, set);
    if (b->setup.pair_mask & PAIR_GRADIENT) pairs_correct_gradients(b);
    if (b->setup.pair_mask & PAIR_NO_SLIP) pairs_mirror_velocities(b);
    if (b->setup.pair_mask & PAIR_TURBULENCE) pairs_find_stresses(b);
    cpu_sweep_fluid(b, cpu_acceleration(b, b->setup.pair_mask));
    for (int s = 0; s < slots; s++)
        for (int a = 0; a < 3 && b->fluid.id[s] >= 0; a++)
            acceleration[b->fluid.id[s]][a] =
                c->acceleration_factor * b->fluid.rate[a][s] + b->sweep.gravity[a];
    if (b->setup.pair_mask & PAIR_DIFFUSION) b->table->update_dynamic(b);
    zero_rates(b, 1);
    cpu_sweep_fluid(b, b->table->density[(b->setup.pair_mask & PAIR_DIFFUSION) != 0]);
    for (int s = 0; s < slots; s++)
        if (b->fluid.id[s] >= 0)
            density_rate[b->fluid.id[s]] = c->density_factor * b->fluid.rate[0][s];
    return true;
}

static void cpu_place(Backend *b, const Advance *advance) { b->table->place(b, advance); }

static void cpu_advance(Backend *b, const Advance *advance, ParticleSums *sums)
{
    b->sweep.gravity[0] = (float)advance->drive[0];
    b->sweep.gravity[1] = (float)advance->drive[1];
    b->table->advance(b, advance, sums);
    if (EFFECTS_BUILT && (advance->passes[0] != 0 || advance->passes[1] != 0))
        cpu_convey(b, advance);
}

const BackendTable *backend_cpu(void)
{
    static const BackendTable table = {
        .name = "cpu",
        .create = cpu_create,
        .destroy = cpu_destroy,
        .variant = cpu_variant,
        .place = cpu_place,
        .forces = cpu_forces,
        .advance = cpu_advance,
        .worst = cpu_worst,
        .download = cpu_download,
        .elevation = cpu_elevation,
        .velocity = cpu_velocity,
        .pressure = cpu_pressure,
        .wetness = cpu_wetness,
        .columns = cpu_columns,
        .energy = cpu_energy,
        .works = cpu_works,
        .state_size = cpu_state_size,
        .save = cpu_save,
        .restore = cpu_restore,
        .clocks = cpu_clocks,
        .statistics = cpu_statistics,
        .pair_cost = pairs_cost,
        .probe_rates = cpu_probe_rates,
    };
    return &table;
}
