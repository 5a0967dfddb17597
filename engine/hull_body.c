/// A body of a case made ready for the engine: where it rests, what it weighs, how it is balanced.
///
///   mass_kg  draft_m  position z   what follows
///   -        given    any          mass = density * volume displaced at that draft
///   given    -        -            z at which it displaces its mass
///   given    given    -            z from the draft, mass as it is (it may rise or sink)
///   given    any      given        as it is
///   -        -        given        only when no freedom needs a mass; density * volume then
#include <math.h>
#include <stdio.h>

#include "hull_internal.h"

enum { DRAFT_ITERATIONS = 100 };
static const double FLOATING_MARGIN = 1e-9; ///< of the volume: a fuller hull has no draft to find
static const double ROOM_MARGIN = 1e-9;     ///< [m]: touching a wall is being inside

/// What every rule below needs to know.
typedef struct Setting {
    const Scene *scene;
    const BodyScene *body;
    char where[32]; ///< "bodies[3]"
    bool flat;      ///< 2-D
} Setting;

/// Freedoms that exist: all six, or surge, heave and pitch in 2-D.
static bool freedom_counts(const Setting *setting, int freedom)
{
    return !setting->flat || freedom == 0 || freedom == 2 || freedom == 4;
}

static bool needs_mass(const Setting *setting)
{
    for (int k = 0; k < 6; k++) {
        FreedomKind kind = setting->body->freedoms[k].kind;
        if (freedom_counts(setting, k) && (kind == FREEDOM_FREE || kind == FREEDOM_SPRING))
            return true;
    }
    return false;
}

/// z of the origin at which the submerged volume is `volume`: Newton's method on V(z), whose slope
/// is minus the waterplane area, kept within a shrinking bracket.
static double solve_height(const TriangleMesh *mesh, Vec3 origin, Quat attitude, double level,
                           double volume)
{
    Submerged s = mesh_submerged(mesh, origin, attitude, level);
    double low = origin.z - s.highest, high = origin.z - s.lowest; // just under, just clear
    double z = 0.5 * (low + high);
    for (int k = 0; k < DRAFT_ITERATIONS && high - low > 1e-12 * (fabs(high) + fabs(low) + 1);
         k++) {
        origin.z = z;
        s = mesh_submerged(mesh, origin, attitude, level);
        double excess = s.volume - volume;
        if (fabs(excess) < 1e-12 * volume) break;
        if (excess > 0)
            low = z;
        else
            high = z;
        double next = s.waterplane_area > 0 ? z + excess / s.waterplane_area : NAN;
        z = next > low && next < high ? next : 0.5 * (low + high);
    }
    return z;
}

static bool check_numbers(const Setting *s, Error *error)
{
    const BodyScene *b = s->body;
    if (!isnan(b->mass) && !(b->mass > 0 && isfinite(b->mass)))
        return error_set(error, ERROR_INPUT, "%s.mass_kg: %g; a number > 0 is needed", s->where,
                         b->mass);
    if (!isnan(b->draft) && !(b->draft > 0 && isfinite(b->draft)))
        return error_set(error, ERROR_INPUT, "%s.draft_m: %g; a number > 0 is needed", s->where,
                         b->draft);
    if (!isfinite(b->position.x) || (!s->flat && !isfinite(b->position.y)))
        return error_set(error, ERROR_INPUT, "%s.position_m: (%g, %g); two numbers are needed",
                         s->where, b->position.x, b->position.y);
    if (isinf(b->position.z))
        return error_set(error, ERROR_INPUT, "%s.position_m[2]: a number is needed", s->where);
    return true;
}

/// Pose and mass by the table above.
static bool settle(const Setting *s, BodyGeometry *g, Error *error)
{
    const BodyScene *b = s->body;
    double level = s->scene->fluid.level, density = s->scene->fluid.density;
    bool has_mass = !isnan(b->mass), has_draft = !isnan(b->draft),
         has_height = !isnan(b->position.z);
    g->origin = vec3(b->position.x, s->flat ? 0 : b->position.y, has_height ? b->position.z : 0);
    Vec3 at_draft = g->origin;
    if (has_draft) {
        Submerged dry = mesh_submerged(&g->mesh, g->origin, g->attitude, level);
        double height = dry.highest - dry.lowest;
        if (b->draft > height * (1 + 1e-9))
            return error_set(error, ERROR_INPUT,
                             "%s.draft_m: %g; the body is %g m high, at most that is accepted",
                             s->where, b->draft, height);
        at_draft.z = g->origin.z - dry.lowest - b->draft;
    }
    if (!has_mass && !has_draft) {
        if (needs_mass(s))
            return error_set(
                error, ERROR_INPUT,
                "%s.mass_kg: neither mass_kg nor draft_m is given; a body that is free "
                "to move needs one of them",
                s->where);
        if (!has_height)
            return error_set(error, ERROR_INPUT,
                             "%s.position_m: its z is needed when neither mass_kg nor draft_m is "
                             "given",
                             s->where);
        g->mass = density * g->properties.volume;
        return true;
    }
    g->mass = has_mass ? b->mass
                       : density * mesh_submerged(&g->mesh, at_draft, g->attitude, level).volume;
    if (has_height) return true;
    if (has_draft) {
        g->origin = at_draft;
        return true;
    }
    double volume = g->mass / density;
    if (volume >= g->properties.volume * (1 - FLOATING_MARGIN))
        return error_set(
            error, ERROR_INPUT,
            "%s.mass_kg: %g; it cannot float: the closed hull displaces %g kg of water "
            "at most; give less, or the z of position_m",
            s->where, g->mass, density * g->properties.volume);
    g->origin.z = solve_height(&g->mesh, g->origin, g->attitude, level, volume);
    return true;
}

static bool is_positive_definite(const double m[3][3])
{
    double minor = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    double scale = m[0][0] + m[1][1] + m[2][2];
    return m[0][0] > 0 && minor > 1e-12 * scale * scale &&
           determinant > 1e-18 * scale * scale * scale;
}

/// Centre of gravity and inertia: as given, or by radii of gyration, or of a homogeneous body
/// (about its own centroid, also when the centre of gravity is given elsewhere).
static bool balance(const Setting *s, BodyGeometry *g, Error *error)
{
    const BodyScene *b = s->body;
    Vec3 centroid = g->properties.centroid, given = b->centre_of_gravity;
    g->centre_of_gravity =
        vec3(isnan(given.x) ? centroid.x : given.x, isnan(given.y) ? centroid.y : given.y,
             isnan(given.z) ? centroid.z : given.z);
    if (s->flat) g->centre_of_gravity.y = 0;
    Vec3 r = b->radii_of_gyration;
    double six[6];
    const char *key = "inertia_kgm2";
    bool by_inertia = !isnan(b->inertia[0]), by_radii = !isnan(r.x);
    if (by_radii && !by_inertia) key = "radii_of_gyration_m";
    double scale = g->mass / g->properties.volume;
    double radii[6] = {g->mass * r.x * r.x, g->mass * r.y * r.y, g->mass * r.z * r.z, 0, 0, 0};
    for (int k = 0; k < 6; k++) {
        six[k] = by_inertia ? b->inertia[k]
                 : by_radii ? radii[k]
                            : scale * g->properties.inertia[k];
        if (by_inertia && k > 2 && isnan(six[k])) six[k] = 0;
    }
    const double full[3][3] = {
        {six[0], six[3], six[4]}, {six[3], six[1], six[5]}, {six[4], six[5], six[2]}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            g->inertia[i][j] = full[i][j];
    if (!is_positive_definite(full))
        return error_set(error, ERROR_INPUT,
                         "%s.%s: makes the inertia xx %g yy %g zz %g xy %g xz %g yz %g kg m^2; a "
                         "positive definite one is needed",
                         s->where, key, six[0], six[1], six[2], six[3], six[4], six[5]);
    return true;
}

/// The body must lie within the tank: all of it in x and y, above the bed in z. It may stick out of
/// the top.
static bool check_room(const Setting *s, const BodyGeometry *g, Vec3 origin, Quat attitude,
                       const char *key, Error *error)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < g->mesh.vertex_count; i++) {
        Vec3 p = vec3_add(origin, quat_rotate(attitude, g->mesh.vertices[i]));
        double at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; k++) {
            low[k] = mind(low[k], at[k]);
            high[k] = maxd(high[k], at[k]);
        }
    }
    const Domain *d = &s->scene->domain;
    double min[3] = {d->min.x, d->min.y, d->min.z};
    double max[3] = {d->max.x, d->max.y, INFINITY};
    for (int k = 0; k < 3; k++) {
        if (k == 1 && s->flat) continue;
        if (low[k] >= min[k] - ROOM_MARGIN && high[k] <= max[k] + ROOM_MARGIN) continue;
        char accepted[64];
        if (k == 2)
            snprintf(accepted, sizeof accepted, "above the bed at z %g", min[k]);
        else
            snprintf(accepted, sizeof accepted, "within %c %g to %g", "xyz"[k], min[k], max[k]);
        return error_set(error, ERROR_INPUT,
                         "%s.%s: the body would reach from %c %g to %g m; it must lie %s m",
                         s->where, key, "xyz"[k], low[k], high[k], accepted);
    }
    return true;
}

/// The pose at t = 0: the reference pose moved along its heading, turned about its centre of
/// gravity.
static bool check_initial_room(const Setting *s, const BodyGeometry *g, Error *error)
{
    double offset[6];
    bool moved = false;
    for (int k = 0; k < 6; k++) {
        offset[k] = freedom_counts(s, k) ? s->body->initial_offset[k] : 0;
        moved = moved || offset[k] != 0;
    }
    TRY(check_room(s, g, g->origin, g->attitude, "position_m", error));
    if (!moved) return true;
    double yaw = quat_to_euler(g->attitude).z;
    Vec3 shift = quat_rotate(quat_from_euler(0, 0, yaw), vec3(offset[0], offset[1], offset[2]));
    Vec3 centre = vec3_add(g->origin, quat_rotate(g->attitude, g->centre_of_gravity));
    Quat attitude = quat_mul(g->attitude, quat_from_euler(offset[3], offset[4], offset[5]));
    Vec3 origin = vec3_sub(vec3_add(centre, shift), quat_rotate(attitude, g->centre_of_gravity));
    return check_room(s, g, origin, attitude, "initial_offset", error);
}

bool body_geometry_create(const Scene *scene, int index, Arena *arena, BodyGeometry *geometry,
                          Error *error)
{
    Setting setting = {scene, &scene->bodies[index], "", scene->domain.dimensions == 2};
    snprintf(setting.where, sizeof setting.where, "bodies[%d]", index);
    BodyGeometry g = {0};
    TRY(check_numbers(&setting, error));
    TRY(mesh_create(setting.body, scene->domain.dimensions, setting.where, arena, &g.mesh, error));
    g.properties = mesh_properties(&g.mesh);
    Vec3 angles = setting.body->attitude;
    g.attitude = setting.flat ? quat_from_euler(0, angles.y, 0)
                              : quat_from_euler(angles.x, angles.y, angles.z);
    TRY(settle(&setting, &g, error));
    TRY(balance(&setting, &g, error));
    TRY(check_initial_room(&setting, &g, error));
    const Fluid *fluid = &scene->fluid;
    g.hydrostatics = mesh_hydrostatics(&g.mesh, g.origin, g.attitude, g.centre_of_gravity, g.mass,
                                       (const double(*)[3])g.inertia, fluid->level, fluid->density,
                                       fluid->gravity);
    g.floats = g.hydrostatics.draft > 0;
    if (setting.body->motion_path[0]) {
        MotionTable *motion;
        TRY(motion_load(setting.body->motion_path, MOTION_OF_BODY, arena, &motion, error));
        g.motion = motion;
    }
    *geometry = g;
    return true;
}
