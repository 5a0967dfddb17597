#include "plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <omp.h>

#include "backend/backend.h"
#include "body.h"
#include "carve.h"
#include "coupling.h"
#include "effects.h"
#include "fill.h"
#include "physics/viscous.h"
#include "piston.h"
#include "waves.h"

/// c0 dt/h. What was tried of other values is in docs/performance.md.
static const double COURANT = 1.1;

/// (chosen) Speed of the water that a body strikes over the body's: where c0 is ten times the
/// body's own speed, a wedge of 30 deg deadrise has 9 % less force than it should and one of 20 deg
/// 24 % less, at twenty times 0 and 7 % less (docs/physics.md, fluid).
static const double STRIKE_RATIO = 2;

/// How far a body stands above still water at the start [m]; negative when it is in it.
static double clear_height(const Scene *scene, const Plan *plan, int index)
{
    const BodyGeometry *geometry = &plan->bodies[index].geometry;
    Body start = body_create(&scene->bodies[index], geometry);
    double lowest = INFINITY, level = scene->fluid.level;
    for (int i = 0; i < scene->fluid.block_count; i++)
        level = i ? maxd(level, scene->fluid.blocks[i].max.z) : scene->fluid.blocks[i].max.z;
    for (int v = 0; v < geometry->mesh.vertex_count; v++)
        lowest = mind(lowest, body_point(&start, geometry->mesh.vertices[v]).z);
    return lowest - level;
}

/// What water a body drives may do [m/s]: the body's own speed, or twice the speed with which one
/// that starts above the water strikes it.
static double speed_of_body(const Scene *scene, const Plan *plan, int index)
{
    const BodyScene *body = &scene->bodies[index];
    const MotionTable *motion = plan->bodies[index].geometry.motion;
    double speed = motion ? motion->largest_speed : 0;
    for (int f = 0; f < 3; f++) {
        const Freedom *freedom = &body->freedoms[f];
        speed = maxd(speed, fabs(body->initial_velocity[f]));
        if (freedom->kind == FREEDOM_PRESCRIBED)
            speed = maxd(speed, 2 * PI * freedom->amplitude / freedom->period);
    }
    double height = clear_height(scene, plan, index);
    bool falls = body->freedoms[2].kind == FREEDOM_FREE && !scene->line_count;
    if (height <= 0) return speed;
    if (falls) speed = sqrt(speed * speed + 2 * scene->fluid.gravity * height);
    return STRIKE_RATIO * speed;
}

static void choose_sound_speed(const Scene *scene, Plan *plan)
{
    const Fluid *fluid = &scene->fluid;
    double depth = fluid->level - scene->domain.min.z, speed = sqrt(fluid->gravity * depth);
    const char *what = "sqrt(g d)";
    if (fluid->block_count) {
        double top = scene->domain.min.z;
        for (int b = 0; b < fluid->block_count; b++)
            top = maxd(top, fluid->blocks[b].max.z);
        depth = top - scene->domain.min.z;
        speed = sqrt(2 * fluid->gravity * depth);
        what = "sqrt(2 g H) of a falling column";
    }
    for (int b = 0; b < scene->body_count; b++) {
        double body = speed_of_body(scene, plan, b);
        if (body <= speed) continue;
        speed = body;
        what = "water that a body drives or strikes";
    }
    if (plan->piston && plan->piston->largest_speed > speed) {
        speed = plan->piston->largest_speed;
        what = "speed of the piston";
    }
    plan->largest_speed = speed;
    plan->sound_speed = fluid->sound_speed_ratio * speed;
    snprintf(plan->sound_speed_because, sizeof plan->sound_speed_because, "%g x %.3g m/s (%s)",
             fluid->sound_speed_ratio, speed, what);
    if (fluid->sound_speed > 0) {
        plan->sound_speed = fluid->sound_speed;
        snprintf(plan->sound_speed_because, sizeof plan->sound_speed_because,
                 "given as fluid.sound_speed_ms; the rule asks for %.3g",
                 fluid->sound_speed_ratio * speed);
    }
}

static void limit_step(Plan *plan, double limit, const char *why)
{
    if (limit >= plan->time_step) return;
    plan->time_step = limit;
    snprintf(plan->time_step_limit, sizeof plan->time_step_limit, "%s", why);
}

/// Molecular viscosity, beside the artificial one, and that of eddies, which is at most
/// (C_s dp)^2 times the largest speed over dp. h^2/(8 nu) of Morris, Fox & Zhu (1997),
/// doi:10.1006/jcph.1997.5776, is for pairs that damp the stiffest mode by 7 nu/h^2; those of
/// viscous.h damp it by 14 nu/h^2, hence half of it.
static void limit_laminar_step(const Scene *scene, Plan *plan, double artificial)
{
    double h = plan->smoothing_length, nu = scene->fluid.viscosity + artificial;
    double eddy = SMAGORINSKY * SMAGORINSKY * scene->fluid.spacing * plan->largest_speed;
    if (scene->fluid.viscosity == 0) return;
    plan->effects[EFFECT_LAMINAR].step_limit = 0.0625 * h * h / nu;
    limit_step(plan, plan->effects[EFFECT_LAMINAR].step_limit, "laminar viscosity");
    if (scene->fluid.turbulence != TURBULENCE_SPS) return;
    plan->effects[EFFECT_TURBULENCE].step_limit = 0.0625 * h * h / (nu + eddy);
    limit_step(plan, plan->effects[EFFECT_TURBULENCE].step_limit, "viscosity of eddies");
}

/// Acoustic, gravity and viscous limits (Monaghan 1992); each effect's own.
static void choose_time_step(const Scene *scene, Plan *plan)
{
    double h = plan->smoothing_length, c0 = plan->sound_speed;
    plan->time_step = INFINITY;
    limit_step(plan, COURANT * h / c0, "sound");
    limit_step(plan, 0.25 * sqrt(h / scene->fluid.gravity), "gravity");
    // alpha h c0/(2 (n + 2)) is the artificial viscosity's kinematic equivalent
    double nu = scene->fluid.alpha * h * c0 / (2 * (scene->domain.dimensions + 2));
    if (nu > 0) {
        plan->effects[EFFECT_VISCOSITY].step_limit = 0.125 * h * h / nu;
        limit_step(plan, plan->effects[EFFECT_VISCOSITY].step_limit, "viscosity");
    }
    limit_laminar_step(scene, plan, nu);
    for (int b = 0; b < scene->body_count; b++) {
        Body body = body_create(&scene->bodies[b], &plan->bodies[b].geometry);
        double limit = body_step_limit(&body, &scene->bodies[b]);
        char why[64];
        snprintf(why, sizeof why, "springs of %.40s", scene->bodies[b].name);
        plan->effects[EFFECT_BODY_MOTION].step_limit =
            mind(plan->effects[EFFECT_BODY_MOTION].step_limit, limit);
        limit_step(plan, limit, why);
    }
}

/// Steps in the shortest prescribed or wave period, where lines are all that is stepped: at that
/// many the implicit step is right to 0.5 % of a snap's peak (docs/mooring.md).
static const double STEPS_PER_PERIOD = 2000;
/// (chosen) Steps between two rows of a body's motion.
static const double STEPS_PER_ROW = 4;

/// Lines alone: the given step, or a fine part of the shortest period that divides the time between
/// samples, so that samples fall on the times asked for.
static void choose_lines_step(const Scene *scene, Plan *plan)
{
    double interval = scene->outputs.series_interval, shortest = INFINITY;
    if (scene->waves.kind != WAVES_NONE) shortest = scene->waves.period_limits.min;
    for (int b = 0; b < scene->body_count; b++)
        for (int f = 0; f < 6; f++)
            if (scene->bodies[b].freedoms[f].kind == FREEDOM_PRESCRIBED)
                shortest = mind(shortest, scene->bodies[b].freedoms[f].period);
    double step = shortest / STEPS_PER_PERIOD;
    for (int b = 0; b < scene->body_count; b++) {
        const MotionTable *motion = plan->bodies[b].geometry.motion;
        if (motion) step = mind(step, motion->shortest / STEPS_PER_ROW);
    }
    plan->time_step = interval / ceil(maxd(1, interval / step) - 1e-9);
    snprintf(plan->time_step_limit, sizeof plan->time_step_limit, "%s",
             isinf(step)                          ? "outputs.series_interval_s"
             : step < shortest / STEPS_PER_PERIOD ? "a quarter of a row of a body's motion"
                                                  : "a 2000th of the shortest period");
    if (isnan(scene->lines_step)) return;
    plan->time_step = scene->lines_step;
    snprintf(plan->time_step_limit, sizeof plan->time_step_limit, "domain.time_step_s");
}

static bool mesh_bodies(const Scene *scene, Plan *plan, Error *error)
{
    size_t count = (size_t)scene->body_count;
    TRY(plan->bodies = arena_take(&plan->arena, count, sizeof(BodyPlan), "bodies", error));
    double dp = scene->fluid.spacing;
    for (int b = 0; b < scene->body_count; b++) {
        BodyPlan *body = &plan->bodies[b];
        TRY(body_geometry_create(scene, b, &plan->arena, &body->geometry, error));
        Body start = body_create(&scene->bodies[b], &body->geometry);
        body->start_origin = body_point(&start, vec3(0, 0, 0));
        body->start_attitude = start.attitude;
        if (scene->domain.kind == DOMAIN_LINES) continue; // nobody pushes it with particles
        TRY(hull_particles(&body->geometry.mesh, dp, plan->wall_layers * dp,
                           scene->domain.dimensions, &plan->arena, &body->particles,
                           &body->particle_count, error));
        TRY(distance_grid_create(&body->geometry.mesh, 0.5 * dp, 2 * dp, &plan->arena,
                                 &body->distance, error));
        TRY(carve_grid_create(body->particles, body->particle_count, dp, &plan->arena,
                              &body->dummies, error));
    }
    return true;
}

/// Where the held ends are at t = 0, and what the lines do there.
static bool hang_lines(const Scene *scene, Plan *plan, Error *error)
{
    size_t count = (size_t)scene->line_count;
    if (!count) return true;
    TRY(plan->lines = arena_take(&plan->arena, count, sizeof(LinePlan), "lines", error));
    WaterField water = {NULL,
                        NULL,
                        scene->fluid.level,
                        scene->fluid.density,
                        scene->fluid.gravity,
                        scene->domain.min.z};
    Body bodies[SCENE_BODIES_MAX];
    LineEnds ends[SCENE_LINES_MAX];
    LineStatics statics[SCENE_LINES_MAX];
    memset(statics, 0, sizeof statics);
    for (int b = 0; b < scene->body_count; b++)
        bodies[b] = body_create(&scene->bodies[b], &plan->bodies[b].geometry);
    for (int l = 0; l < scene->line_count; l++) {
        Vec3 velocity;
        coupling_end(scene, bodies, &scene->lines[l].anchor, &ends[l].place[0], &velocity);
        coupling_end(scene, bodies, &scene->lines[l].fairlead, &ends[l].place[1], &velocity);
    }
    Arena scratch = arena_create(0);
    Mooring mooring;
    bool good = mooring_create(scene, ends, &water, &scratch, &mooring, statics, error);
    for (int l = 0; good && l < scene->line_count; l++) {
        plan->lines[l].ends = ends[l];
        plan->lines[l].statics = statics[l];
    }
    arena_destroy(&scratch);
    return good;
}

static bool check_memory(const Scene *scene, const Plan *plan, Error *error)
{
    size_t limit = plan->options.memory_limit;
    if (!limit) limit = (size_t)sysconf(_SC_PHYS_PAGES) * (size_t)sysconf(_SC_PAGESIZE) / 4 * 3;
    if (plan->bytes <= limit) return true;
    double factor = cbrt((double)plan->bytes / (double)limit);
    return error_set(error, ERROR_INPUT,
                     "fluid.spacing_m = %g: %d particles need %.1f GB, %.1f GB may be used; "
                     "must be at least %.3g m here",
                     scene->fluid.spacing, plan->fluid_count, (double)plan->bytes / 1e9,
                     (double)limit / 1e9, scene->fluid.spacing * factor);
}

/// A domain of lines: nothing of what particles need.
static bool build_lines(const Scene *scene, Plan *plan, Error *error)
{
    plan->backend = backend_none()->name;
    snprintf(plan->variant, sizeof plan->variant, "%s", backend_none()->variant());
    snprintf(plan->sound_speed_because, sizeof plan->sound_speed_because, "no particles");
    effects_name(plan->effects);
    TRY(mesh_bodies(scene, plan, error));
    TRY(hang_lines(scene, plan, error));
    choose_lines_step(scene, plan);
    Fill fill = {0};
    effects_choose(scene, plan, &fill);
    return true;
}

/// What a user of a domain of lines should read.
static void lines_warnings(const Scene *scene, char *text, size_t size)
{
    size_t used = 0;
    for (int b = 0; b < scene->body_count; b++)
        for (int f = 0; f < 3; f++) {
            if (scene->bodies[b].freedoms[f].kind != FREEDOM_FREE || used + 100 > size) continue;
            used += (size_t)snprintf(text + used, size - used,
                                     "%sno water carries body %s, which is free to move",
                                     used ? "; " : "", scene->bodies[b].name);
            break;
        }
}

/// Where the differences of a sea move the piston farther than its waves do, second order is not
/// small.
static void warn_of_travel(const Scene *scene, Plan *plan)
{
    if (scene->waves.kind == WAVES_NONE || scene->domain.kind != DOMAIN_FLUME || plan->piston)
        return;
    double first = waves_wall_reach(scene);
    size_t used = strlen(plan->warnings), size = sizeof plan->warnings;
    if (plan->wall_reach <= first) return;
    snprintf(plan->warnings + used, size - used,
             "%spiston travels %.3g m to second order, %.3g m to first: water too shallow for it "
             "(lower waves, or waves.piston_order 1)",
             used ? "; " : "", plan->wall_reach, first);
}

/// The lattice of Wendland's kernel and plain gradients yields around what drifts slowly (measured,
/// docs/physics.md).
static void warn_of_drift(const Scene *scene, Plan *plan)
{
    const Fluid *fluid = &scene->fluid;
    if (scene->domain.kind == DOMAIN_LINES || scene->line_count) return;
    if (fluid->kernel == KERNEL_YIELDING || fluid->gradient == GRADIENT_CORRECTED ||
        fluid->viscosity > 0)
        return;
    for (int b = 0; b < scene->body_count; b++) {
        const BodyScene *body = &scene->bodies[b];
        bool drifts = body->freedoms[0].kind == FREEDOM_FREE ||
                      (scene->domain.dimensions == 3 && body->freedoms[1].kind == FREEDOM_FREE);
        size_t used = strlen(plan->warnings), size = sizeof plan->warnings;
        if (!drifts) continue;
        snprintf(plan->warnings + used, size - used,
                 "%sbody %s may drift: the lattice of Wendland's kernel brakes slow drift "
                 "(fluid.kernel \"yielding\" does far less)",
                 used ? "; " : "", body->name);
        return;
    }
}

/// How far ring or piston may go.
static bool reach_of_walls(const Scene *scene, Plan *plan, Error *error)
{
    if (scene->waves.kind == WAVES_NONE) return true;
    TRY(piston_load(scene, &plan->arena, &plan->piston, error));
    if (!plan->piston) return piston_reach(scene, &plan->wall_reach, error);
    plan->wall_reach = plan->piston->reach;
    return true;
}

/// Which way the current carries the ring, and the lattice that is carried.
static void choose_flow(const Scene *scene, Plan *plan)
{
    Vec3 current = current_velocity(&scene->waves.current, INFINITY);
    const double along[2] = {current.x, scene->domain.dimensions == 2 ? 0 : current.y};
    fill_pitches(scene, plan->pitch);
    for (int a = 0; a < 2; a++) // across the current rounding is all there is
        if (fabs(along[a]) > 1e-9 * scene->waves.current.speed)
            plan->flow[a] = along[a] > 0 ? 1 : -1;
}

static bool build(const Scene *scene, Plan *plan, Error *error)
{
    if (scene->domain.kind == DOMAIN_LINES) return build_lines(scene, plan, error);
    const BackendTable *table = backend_choose(plan->options.backend, error);
    TRY(table);
    plan->backend = table->name;
    const char *kernel = scene->fluid.kernel == KERNEL_YIELDING ? "yielding" : "Wendland";
    snprintf(plan->variant, sizeof plan->variant, "half-pair clusters of 8, %s, %s kernel",
             table->variant(), kernel);
    double dp = scene->fluid.spacing;
    plan->smoothing_length = scene->fluid.smoothing_ratio * dp;
    // a particle dp/2 from the wall sees layers at dp, 2 dp, …: those below 2h count
    plan->wall_layers = (int)ceil(2 * scene->fluid.smoothing_ratio - 1e-6) - 1;
    if (scene->waves.kind != WAVES_NONE || scene_has_ring(scene))
        plan->zone_width = waves_zone_width(scene);
    if (scene_has_ring(scene) && scene->waves.current.speed > 0) choose_flow(scene, plan);
    plan->pair_mask = (scene->fluid.alpha > 0 ? PAIR_VISCOSITY : 0) |
                      (scene->fluid.delta > 0 ? PAIR_DIFFUSION : 0) |
                      (scene->fluid.gradient == GRADIENT_CORRECTED ? PAIR_GRADIENT : 0) |
                      (scene->fluid.viscosity > 0 ? PAIR_LAMINAR : 0) |
                      (scene->fluid.turbulence == TURBULENCE_SPS ? PAIR_TURBULENCE : 0) |
                      (scene->fluid.walls == WALLS_NO_SLIP ? PAIR_NO_SLIP : 0) |
                      (scene->fluid.shifting > 0 ? PAIR_SHIFTING : 0);
    effects_name(plan->effects);
    TRY(reach_of_walls(scene, plan, error));
    TRY(mesh_bodies(scene, plan, error));
    choose_sound_speed(scene, plan);
    TRY(hang_lines(scene, plan, error));
    choose_time_step(scene, plan);
    Fill fill = {0};
    TRY(fill_particles(scene, plan, &fill, error));
    plan->fluid_count = fill.fluid_count;
    plan->wall_count = fill.wall_count + fill.ring_count + fill.piston_count;
    plan->body_particle_count = fill.body_count;
    plan->particle_mass = fill.particle_mass;
    if (!fill.fluid_count)
        return error_set(error, ERROR_INPUT,
                         "fluid.spacing_m = %g: the domain holds no particle; "
                         "must be smaller",
                         dp);
    effects_choose(scene, plan, &fill);
    return check_memory(scene, plan, error);
}

bool plan_build(const Scene *scene, const EngineOptions *options, Plan *plan, Error *error)
{
    memset(plan, 0, sizeof *plan);
    plan->options = *options;
    if (plan->options.threads <= 0) plan->options.threads = omp_get_max_threads();
    plan->arena = arena_create(0);
    plan->predicted_slowness = NAN;
    if (build(scene, plan, error)) {
        if (scene->domain.kind == DOMAIN_LINES)
            lines_warnings(scene, plan->warnings, sizeof plan->warnings);
        else if (scene->waves.kind != WAVES_NONE)
            waves_warnings(scene, plan->warnings, sizeof plan->warnings);
        warn_of_travel(scene, plan);
        warn_of_drift(scene, plan);
        return true;
    }
    plan_destroy(plan);
    return false;
}

void plan_destroy(Plan *plan)
{
    arena_destroy(&plan->arena);
    memset(plan, 0, sizeof *plan);
}
