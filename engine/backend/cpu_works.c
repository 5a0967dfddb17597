/// What each effect gives to the water in a step, measured, not estimated: the sweeps run again
/// without walls and without the effects, and what they differ by is multiplied by the velocities
/// (or, for density, by p/rho^2) halfway through the kick. Only where a case asks for it.
///
/// Between water and water the sums cancel: sum m P_i v_ik . m grad_i W of continuity is what
/// -sum m (P_i + P_k) grad_i W . v_i of momentum takes (Price 2012, doi:10.1016/j.jcp.2010.12.011,
/// section 3). What is left of `pressure` is the error of stepping in time.
#include <string.h>

#include "backend/cpu.h"
#include "physics/fluid.h"

/// Sums of a sweep with less and less left out.
enum { INNER, PLAIN, FULL };

/// All that acts by viscosity.
static const unsigned VISCOUS = PAIR_VISCOSITY | PAIR_LAMINAR | PAIR_TURBULENCE | PAIR_NO_SLIP;

static bool take_floats(float **array, size_t count, Arena *arena, Error *error)
{
    *array = arena_take(arena, count, sizeof(float), "works", error);
    return *array != NULL;
}

bool works_create(Backend *b, Arena *arena, Error *error)
{
    Works *w = &b->works;
    size_t slots = (size_t)b->fluid.slot_capacity, moving = (size_t)b->moving.count;
    for (int stage = 0; stage < 3; stage++)
        for (int a = 0; a < 3; a++)
            TRY(take_floats(&w->rate[stage][a], slots, arena, error));
    for (int a = 0; a < 3; a++)
        TRY(take_floats(&w->velocity[a], slots, arena, error));
    TRY(take_floats(&w->excess, slots, arena, error));
    TRY(w->height = arena_take(arena, slots, sizeof(int32_t), "works", error));
    TRY(w->anybody = arena_take(arena, moving, sizeof(int16_t), "works", error));
    TRY(w->none = arena_take(arena, 1, sizeof(ParticleSet), "works", error));
    return true;
}

static size_t slot_bytes(const Backend *b)
{
    return (size_t)b->fluid.cluster_count * CLUSTER * sizeof(float);
}

static void keep_rates(Backend *b, int stage, int rates)
{
    for (int a = 0; a < rates; a++)
        memcpy(b->works.rate[stage][a], b->fluid.rate[a], slot_bytes(b));
}

/// Sweep with the walls and without them, an effect's bit not set, and keep both; rates are zero
/// before and after.
static void sweep_without(Backend *b, SweepFunction plain, int rates)
{
    ParticleSet *walls[2] = {b->sweep.walls[0], b->sweep.walls[1]};
    for (int stage = INNER; stage <= PLAIN; stage++) {
        for (int set = 0; set < 2; set++)
            b->sweep.walls[set] = stage == INNER ? b->works.none : walls[set];
        cpu_sweep_fluid(b, plain);
        keep_rates(b, stage, rates);
        for (int a = 0; a < rates; a++)
            memset(b->fluid.rate[a], 0, slot_bytes(b));
    }
}

void works_before_momentum(Backend *b)
{
    sweep_without(b, cpu_acceleration(b, b->setup.pair_mask & ~VISCOUS), 3);
}

/// Power of the moving dummies' pushes, with their velocities now, by owner [W].
static MovingPower moving_power(const Backend *b)
{
    MovingPower power = {0, 0, 0};
    const ParticleSet *m = &b->moving;
    double factor = b->sweep.constants.acceleration_factor * b->setup.particle_mass;
    for (int i = 0; i < m->cluster_count * CLUSTER; i++) {
        if (m->id[i] < 0) continue;
        double sum = 0; // what the water does to the dummy
        for (int a = 0; a < 3; a++)
            sum += (double)m->rate[a][i] * *velocity_of(m, a, i);
        int owner = b->moving_owner[m->id[i]];
        *(owner == OWNER_RING     ? &power.ring
          : owner == OWNER_PISTON ? &power.piston
                                  : &power.bodies) -= factor * sum;
    }
    return power;
}

/// The pushes on all moving dummies, not on bodies only; their friction counts to viscosity.
void works_after_forces(Backend *b)
{
    const int16_t *owner = b->sweep.moving_owner;
    b->sweep.moving_owner = b->works.anybody;
    cpu_loads(b, b->setup.pair_mask & ~VISCOUS)(&b->sweep, 0, b->moving.cluster_count);
    b->sweep.moving_owner = owner;
    b->works.power = moving_power(b);
}

void works_before_kick(Backend *b)
{
    keep_rates(b, FULL, 3);
    for (int a = 0; a < 3; a++)
        for (int c = 0; c < b->fluid.cluster_count; c++)
            memcpy(b->works.velocity[a] + c * CLUSTER, b->fluid.octet[c].velocity[a],
                   sizeof b->fluid.octet[c].velocity[a]);
}

/// Velocity before and after the kick, relaxation left out.
static void kick_of(const Backend *b, int i, double dt, double before[3], double after[3])
{
    const Works *w = &b->works;
    for (int a = 0; a < 3; a++) {
        bool still = a == 1 && b->setup.dimensions == 2;
        double rate = b->sweep.constants.acceleration_factor * (double)w->rate[FULL][a][i];
        before[a] = w->velocity[a][i];
        after[a] = still ? 0 : before[a] + dt * (rate + b->sweep.gravity[a]);
    }
}

void works_after_kick(Backend *b, const Advance *advance)
{
    Works *w = &b->works;
    double dt = advance->dt, inner = 0, plain = 0, full = 0, relaxed = 0, kicked = 0;
    double driven = 0;
    for (int i = 0; i < b->fluid.cluster_count * CLUSTER; i++) {
        if (b->fluid.id[i] < 0) continue;
        double before[3], after[3];
        kick_of(b, i, dt, before, after);
        for (int a = 0; a < 3; a++) {
            double middle = 0.5 * (before[a] + after[a]), now = *velocity_of(&b->fluid, a, i);
            inner += w->rate[INNER][a][i] * middle;
            plain += w->rate[PLAIN][a][i] * middle;
            full += w->rate[FULL][a][i] * middle;
            if (a < 2) driven += b->sweep.gravity[a] * middle;
            relaxed += now * now - after[a] * after[a];
            kicked += after[a] * after[a] - before[a] * before[a];
            w->velocity[a][i] = (float)now;
        }
        w->height[i] = *position_of(&b->fluid, 2, i);
        w->excess[i] = *excess_of(&b->fluid, i);
    }
    double mass = b->setup.particle_mass,
           scale = mass * dt * b->sweep.constants.acceleration_factor;
    w->sums.pressure += scale * inner;
    w->sums.walls += scale * (plain - inner);
    w->sums.viscosity += scale * (full - plain);
    w->sums.current += mass * dt * driven;
    w->sums.last_kick = 0.5 * mass * kicked;
    if (advance->zone.width > 0) w->sums.zone += 0.5 * mass * relaxed;
    // what moving dummies do to the water, by their velocities before and in this step
    MovingPower now = moving_power(b);
    double ring = 0.5 * dt * (w->power.ring + now.ring);
    double piston = 0.5 * dt * (w->power.piston + now.piston);
    double bodies = 0.5 * dt * (w->power.bodies + now.bodies);
    w->sums.ring += ring;
    w->sums.piston += piston;
    w->sums.bodies += bodies;
    w->sums.walls -= ring + piston + bodies;
}

void works_after_density(Backend *b)
{
    keep_rates(b, FULL, 1);
    memset(b->fluid.rate[0], 0, slot_bytes(b));
    sweep_without(b, b->table->density[0], 1);
    memcpy(b->fluid.rate[0], b->works.rate[FULL][0], slot_bytes(b));
}

void works_after_step(Backend *b, double dt)
{
    Works *w = &b->works;
    const ParticleSet *f = &b->fluid;
    double tait = b->sweep.tait_b, rho0 = b->setup.rest_density, mass = b->setup.particle_mass;
    double floor = b->excess_floor;
    double factor = dt * b->sweep.constants.density_factor, unit = b->grid.unit;
    double inner = 0, plain = 0, full = 0, clipped = 0, speed2 = 0, lift = 0, shifted = 0;
    for (int i = 0; i < f->cluster_count * CLUSTER; i++) {
        if (f->id[i] < 0) continue;
        // de/ds = p rho0/rho^2 halfway between the pressures that push before and after the step
        double s0 = w->excess[i], s1 = *excess_of(f, i), middle = 0.5 * (s0 + s1);
        middle = middle > floor ? middle : floor;
        double slope =
            tait_pressure((float)middle, (float)tait) / rho0 / ((1 + middle) * (1 + middle));
        inner += slope * w->rate[INNER][0][i];
        plain += slope * w->rate[PLAIN][0][i];
        full += slope * w->rate[FULL][0][i];
        clipped += tait_energy_torn(s1, floor, tait, rho0) -
                   tait_energy_torn(s0, floor, tait, rho0) - slope * factor * w->rate[FULL][0][i];
        for (int a = 0; a < 3; a++)
            speed2 += (double)*velocity_of(f, a, i) * *velocity_of(f, a, i) -
                      (double)w->velocity[a][i] * w->velocity[a][i];
        lift +=
            unit * ((double)*position_of(f, 2, i) - w->height[i]) - 0.5 * dt * w->velocity[2][i];
        if (f->shift[2]) shifted += dt * f->shift[2][i];
    }
    w->sums.pressure += mass * factor * inner;
    w->sums.walls += mass * factor * (plain - inner);
    w->sums.diffusion += mass * factor * (full - plain);
    w->sums.shifting += mass * b->setup.gravity * shifted;
    // half of the shift came before the height was noted
    w->sums.limits += mass * (clipped + 0.5 * speed2 + b->setup.gravity * (lift - 0.5 * shifted));
}
