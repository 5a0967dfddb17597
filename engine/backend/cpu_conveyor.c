/// Water in and out of a basin on a current. Ring and water go with it; once a layer of the ring's
/// lattice upstream has come into the basin it becomes water, and as many particles, those that
/// went farthest beyond the downstream side, become the ring's there, in their places. Beyond reach
/// of the water, as many of the ring go back upstream as a new last layer of the lattice. Nothing
/// is made or lost, and nothing moves that water feels. Layers are counted by mean places: each
/// holds as many particles whatever the waves do.
///
/// Mean places of the ring (moving_reference) are those in the frame that goes with the water.
#include <math.h>
#include <string.h>

#include "backend/cpu.h"
#include "physics/fluid.h"

enum { BLOCK = 256 };

/// One axis of the flow while a layer passes.
typedef struct Passage {
    Backend *backend;
    const Advance *advance;
    int axis;
    double sign, pitch;     ///< where the flow goes; thickness of a layer [m]
    double inflow, outflow; ///< sides of the basin [m]
    double carried[2];      ///< whole pitches that the water has gone by, this one included [m]
} Passage;

/// Slots of a list and what they are ranked by; borrowed from the sorting scratch, which nobody
/// needs between two steps: rates are summed anew.
typedef struct Ranking {
    const int32_t *id; ///< by slot
    int32_t *slot;
    float *key;
    int count;
} Ranking;

static double along_of(Vec3 v, int axis) { return axis == 0 ? v.x : v.y; }

static Vec3 shifted(Vec3 v, int axis, double by)
{
    return axis == 0 ? vec3(v.x + by, v.y, v.z) : vec3(v.x, v.y + by, v.z);
}

bool conveyor_create(Backend *b, Arena *arena, Error *error)
{
    for (int a = 0; a < 2; a++) {
        double sign = b->setup.flow[a], first = INFINITY, half = 0.5 * b->setup.pitch[a];
        int *count = &b->conveyor.site_count[a];
        if (sign == 0) continue;
        for (int i = 0; i < b->moving.count; i++)
            if (b->moving_owner[i] == OWNER_RING)
                first = mind(first, sign * along_of(b->moving_reference[i], a));
        for (int write = 0; write < 2; write++) {
            *count = 0;
            for (int i = 0; i < b->moving.count; i++) {
                Vec3 mean = b->moving_reference[i];
                if (b->moving_owner[i] != OWNER_RING) continue;
                if (sign * along_of(mean, a) > first + half) continue;
                if (write) b->conveyor.site[a][*count] = mean;
                (*count)++;
            }
            size_t room = (size_t)*count;
            if (!write)
                TRY(b->conveyor.site[a] = arena_take(arena, room, sizeof(Vec3), "sites", error));
        }
    }
    return true;
}

/// What a particle of water has of energy [J/kg].
static double energy_of(const Backend *b, int slot)
{
    const ParticleSet *f = &b->fluid;
    double speed2 = 0, height = b->grid.unit * *position_of(f, 2, slot);
    for (int a = 0; a < 3; a++)
        speed2 += (double)*velocity_of(f, a, slot) * (double)*velocity_of(f, a, slot);
    return 0.5 * speed2 + b->setup.gravity * height +
           tait_energy_torn(*excess_of(f, slot), b->excess_floor, b->sweep.tait_b,
                            b->setup.rest_density);
}

static bool is_ring(const Backend *b, int slot)
{
    int id = b->moving.id[slot];
    return id >= 0 && b->moving_owner[id] == OWNER_RING;
}

/// Mean place as the lattice has it that lies upon the basin: less what it has gone since it last
/// lay there.
static Vec3 lattice_place(const Passage *p, Vec3 reference)
{
    return vec3(reference.x + p->carried[0], reference.y + p->carried[1], reference.z);
}

/// Dummies that have come in, of the layer that was the first one beyond the inflow: those under
/// still water, or those above it.
static Ranking list_entering(const Passage *p, bool wet)
{
    const Backend *b = p->backend;
    Ranking list = {b->moving.id, b->scratch.slot[0], NULL, 0};
    const double *low = p->advance->zone.side_min, *high = p->advance->zone.side_max;
    int other = 1 - p->axis;
    for (int i = 0; i < b->moving.cluster_count * CLUSTER; i++) {
        if (!is_ring(b, i)) continue;
        Vec3 mean = lattice_place(p, b->moving_reference[b->moving.id[i]]);
        double inside = p->sign * (along_of(mean, p->axis) - p->inflow);
        double across = along_of(mean, other);
        if ((mean.z < b->setup.level) != wet || inside < 0 || inside > p->pitch) continue;
        if (across > low[other] && across < high[other]) list.slot[list.count++] = i;
    }
    return list;
}

/// Water near the outflow, ranked by how far it is beyond the ring's face.
static Ranking list_leaving(const Passage *p)
{
    const Backend *b = p->backend;
    const Advance *advance = p->advance;
    const ParticleSet *f = &b->fluid;
    Ranking list = {f->id, b->scratch.slot[1], (float *)b->scratch.slot[2], 0};
    double near = p->outflow - p->sign * 4 * p->pitch;
    int begun = 0, slots = f->cluster_count * CLUSTER;
    Vec3 face[BLOCK], place[BLOCK];
    for (int i = 0; i < slots; i++) {
        double at = to_metres(&b->grid, p->axis, *position_of(f, p->axis, i));
        if (f->id[i] >= 0 && p->sign * (at - near) > 0) {
            Vec3 here = vec3_sub(place_of(&b->grid, f, i), vec3(p->carried[0], p->carried[1], 0));
            face[list.count - begun] = shifted(here, p->axis, p->outflow - at);
            list.key[list.count] = (float)at;
            list.slot[list.count++] = i;
        }
        if (list.count - begun < BLOCK && i < slots - 1) continue;
        advance->ring(advance->waves, advance->time + advance->dt, list.count - begun, face, place);
        for (int k = begun; k < list.count; k++)
            list.key[k] =
                (float)(p->sign * ((double)list.key[k] - along_of(place[k - begun], p->axis)));
        begun = list.count;
    }
    return list;
}

/// Dummies beyond the outflow, ranked by how far.
static Ranking list_beyond(const Passage *p)
{
    const Backend *b = p->backend;
    Ranking list = {b->moving.id, b->scratch.slot[0], (float *)b->scratch.slot[2], 0};
    for (int i = 0; i < b->moving.cluster_count * CLUSTER; i++) {
        if (!is_ring(b, i)) continue;
        Vec3 mean = lattice_place(p, b->moving_reference[b->moving.id[i]]);
        double beyond = p->sign * (along_of(mean, p->axis) - p->outflow);
        if (beyond < 0) continue;
        list.key[list.count] = (float)beyond;
        list.slot[list.count++] = i;
    }
    return list;
}

/// Whether the first of two goes before the second: farther, or by number where they tie.
static bool goes_first(const Ranking *list, int i, int k)
{
    if (list->key[i] != list->key[k]) return list->key[i] > list->key[k];
    return list->id[list->slot[i]] < list->id[list->slot[k]];
}

static void swap_ranked(const Ranking *list, int i, int k)
{
    int32_t slot = list->slot[i];
    float key = list->key[i];
    list->slot[i] = list->slot[k];
    list->key[i] = list->key[k];
    list->slot[k] = slot;
    list->key[k] = key;
}

/// Bring those that go first to the first `wanted` places (Hoare's selection). @return how many
/// there are
static int select_first(const Ranking *list, int wanted)
{
    int low = 0, high = list->count - 1;
    if (wanted >= list->count) return list->count;
    while (low < high) {
        int store = low;
        swap_ranked(list, low + (high - low) / 2, high);
        for (int i = low; i < high; i++)
            if (goes_first(list, i, high)) swap_ranked(list, i, store++);
        swap_ranked(list, store, high);
        if (store == wanted || store == wanted - 1) break;
        if (store < wanted)
            low = store + 1;
        else
            high = store - 1;
    }
    return wanted;
}

/// Bring the first `count` into the order of their numbers, so that who goes where does not depend
/// on the order of slots (Shell's sort).
static void order_by_number(const Ranking *list, int count)
{
    for (int gap = count / 2; gap > 0; gap /= 2)
        for (int i = gap; i < count; i++) {
            int32_t slot = list->slot[i];
            int k = i;
            for (; k >= gap && list->id[list->slot[k - gap]] > list->id[slot]; k -= gap)
                list->slot[k] = list->slot[k - gap];
            list->slot[k] = slot;
        }
}

/// Put a dummy where its mean place says, with the velocity that it has there: acceleration is told
/// by the next step's.
static void settle(const Passage *p, int slot)
{
    ParticleSet *m = &p->backend->moving;
    const Grid *grid = &p->backend->grid;
    const Advance *advance = p->advance;
    Vec3 mean = p->backend->moving_reference[m->id[slot]], now, before;
    advance->ring(advance->waves, advance->time + advance->dt, 1, &mean, &now);
    advance->ring(advance->waves, advance->time, 1, &mean, &before);
    Vec3 v = vec3_scale(vec3_sub(now, before), 1 / advance->dt);
    *position_of(m, 0, slot) = to_coordinate(grid, 0, now.x);
    *position_of(m, 1, slot) = to_coordinate(grid, 1, now.y);
    *position_of(m, 2, slot) = to_coordinate(grid, 2, now.z);
    *velocity_of(m, 0, slot) = (float)v.x;
    *velocity_of(m, 1, slot) = (float)v.y;
    *velocity_of(m, 2, slot) = (float)v.z;
}

/// Mean place of what is at `place`, by substitution.
static Vec3 mean_of(const Passage *p, Vec3 place)
{
    const Advance *advance = p->advance;
    Vec3 mean = vec3(place.x - p->carried[0], place.y - p->carried[1], place.z), there;
    for (int i = 0; i < 5; i++) {
        advance->ring(advance->waves, advance->time + advance->dt, 1, &mean, &there);
        mean = vec3_add(mean, vec3_sub(place, there));
    }
    return mean;
}

/// A dummy and a particle of water change parts: the water takes the dummy's place, velocity and
/// the pressure it had extrapolated; the dummy the water's place.
static void change_parts(const Passage *p, int dummy, int water)
{
    Backend *b = p->backend;
    ParticleSet *f = &b->fluid, *m = &b->moving;
    double rho0 = b->setup.rest_density, excess = 0;
    Vec3 left = place_of(&b->grid, f, water);
    for (int i = 0; i < 4; i++) { // P = p/rho^2
        double rho = rho0 * (1 + excess);
        excess = tait_excess((float)((double)*pressure_of(m, dummy) * rho * rho), b->sweep.tait_b);
    }
    for (int a = 0; a < 3; a++) {
        *position_of(f, a, water) = *position_of(m, a, dummy);
        *velocity_of(f, a, water) = *velocity_of(m, a, dummy);
    }
    *excess_of(f, water) = (float)excess;
    b->moving_reference[m->id[dummy]] = mean_of(p, left);
    settle(p, dummy);
}

/// A dummy that has come in goes over to the outflow.
static void pass_over(const Passage *p, int slot)
{
    Vec3 *mean = &p->backend->moving_reference[p->backend->moving.id[slot]];
    *mean = shifted(*mean, p->axis, p->outflow - p->inflow);
    settle(p, slot);
}

/// Bring the highest of those from `count` on down to the end of the list.
static void highest_last(const Passage *p, const Ranking *list, int count)
{
    const Vec3 *mean = p->backend->moving_reference;
    for (int last = list->count - 1; last >= count; last--) {
        int highest = last;
        for (int i = 0; i < last; i++) {
            double above = mean[list->id[list->slot[i]]].z - mean[list->id[list->slot[highest]]].z;
            bool lower_number = list->id[list->slot[i]] < list->id[list->slot[highest]];
            if (above > 0 || (above == 0 && lower_number)) highest = i;
        }
        int32_t slot = list->slot[last];
        list->slot[last] = list->slot[highest];
        list->slot[highest] = slot;
    }
}

/// As many come in as have gone beyond the ring's face, but no more than a layer has; the highest
/// places stay empty. Were a whole layer taken out each time, the face would move upstream, by
/// 0.4 spacings in 12 s of steep waves: water takes more room once its lattice has melted.
static void let_through(const Passage *p)
{
    Backend *b = p->backend;
    Ranking entering = list_entering(p, true), leaving = list_leaving(p);
    int beyond = 0;
    for (int k = 0; k < leaving.count; k++)
        beyond += leaving.key[k] > 0;
    int count = select_first(&leaving, beyond < entering.count ? beyond : entering.count);
    highest_last(p, &entering, count);
    order_by_number(&entering, count);
    order_by_number(&leaving, count);
    double gained = 0;
    for (int k = 0; k < count; k++) {
        if (b->setup.works) gained -= energy_of(b, leaving.slot[k]);
        change_parts(p, entering.slot[k], leaving.slot[k]);
        if (b->setup.works) gained += energy_of(b, leaving.slot[k]);
    }
    b->works.sums.current += b->setup.particle_mass * gained;
    for (int k = count; k < entering.count; k++)
        pass_over(p, entering.slot[k]);
    entering = list_entering(p, false);
    for (int k = 0; k < entering.count; k++)
        pass_over(p, entering.slot[k]);
}

/// The farthest dummies become a new last layer upstream.
static void lay_last_layer(const Passage *p)
{
    Backend *b = p->backend;
    Ranking list = list_beyond(p);
    int count = select_first(&list, b->conveyor.site_count[p->axis]);
    order_by_number(&list, count);
    for (int k = 0; k < count; k++) {
        Vec3 site = b->conveyor.site[p->axis][k];
        b->moving_reference[b->moving.id[list.slot[k]]] =
            vec3(site.x - p->carried[0], site.y - p->carried[1], site.z);
        settle(p, list.slot[k]);
    }
}

void cpu_convey(Backend *b, const Advance *advance)
{
    double start = cpu_clock();
    const double *low = advance->zone.side_min, *high = advance->zone.side_max;
    Passage p = {.backend = b, .advance = advance};
    for (int a = 0; a < 2; a++)
        p.carried[a] = advance->carried[a];
    for (int a = 0; a < 2; a++) {
        double gone = advance->passes[a];
        if (gone == 0) continue;
        p.axis = a;
        p.sign = gone > 0 ? 1 : -1;
        p.pitch = fabs(gone);
        p.inflow = gone > 0 ? low[a] : high[a];
        p.outflow = gone > 0 ? high[a] : low[a];
        p.carried[a] += gone;
        let_through(&p);
        lay_last_layer(&p);
    }
    b->table->update_pressure(b);
    b->sorted = b->boxes_fresh = false;
    b->clock[CLOCK_CONVEYOR] += cpu_clock() - start;
}
