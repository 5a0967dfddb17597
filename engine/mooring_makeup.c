/// Sections of a line, and what parted, become runs of equal segments.
#include "mooring_makeup.h"

#include <string.h>

/// Bed damping reaches its full value at this penetration, in diameters. A switch without a ramp
/// leaves implicit steps without a solution; a chain at rest lies about 0.02 d deep.
static const double BED_RAMP_DIAMETERS = 0.05;
/// Slip speed that tells sticking from sliding [m/s]; small against any dragging of interest.
static const double FRICTION_SPEED = 1e-3;
/// Explicit sub-steps stay this far below the smallest of the limits.
static const double STEP_SAFETY = 0.9;
/// A slack line that snaps taut over and over stays bounded below this many l/c (measured: 0.52).
static const double SLACK_LIMIT = 0.5;
/// A bent segment turns as if it were at least this long, in unstretched lengths: in a heap, where
/// segments shrink to nothing, their directions mean little.
static const double SHORTEST = 0.5;

int line_section_count(const LineScene *scene)
{
    return scene->section_count > 0 ? scene->section_count : 1;
}

LineSection line_section(const LineScene *scene, int k)
{
    if (scene->section_count > 0) return scene->sections[k];
    LineSection section = {
        scene->length,          scene->segments,          scene->axial_stiffness,
        scene->mass_per_length, scene->diameter,          scene->drag_normal,
        scene->drag_tangential, scene->added_normal,      scene->added_tangential,
        scene->damping_ratio,   scene->bending_stiffness, scene->breaking_tension};
    return section;
}

/// The fastest a beam of point masses swings [rad/s].
static double bending_frequency(const LineConstants *c)
{
    return 4 * sqrt(c->bending / (c->mass * c->length * c->length * c->length));
}

/// Constants of one segment of length `l` of a section.
static LineConstants segment_constants(const LineMakeup *makeup, const LineSection *section,
                                       double l)
{
    const LineScene *scene = makeup->scene;
    LineConstants c;
    double d = section->diameter;
    double displaced = makeup->density * PI / 4 * d * d * l;
    c.length = l;
    c.stiffness = section->axial_stiffness / l;
    c.damping = section->damping_ratio * sqrt(section->axial_stiffness * section->mass_per_length);
    c.mass = section->mass_per_length * l;
    c.weight = c.mass * makeup->gravity;
    c.buoyancy = displaced * makeup->gravity;
    c.water_mass = displaced;
    c.added_normal = displaced * section->added_normal;
    c.added_tangential = displaced * section->added_tangential;
    c.drag_normal = 0.5 * makeup->density * d * l * section->drag_normal;
    c.drag_tangential = 0.5 * makeup->density * PI * d * l * section->drag_tangential;
    c.radius = d / 2;
    c.bed = makeup->bed;
    c.bed_stiffness = scene->bed_stiffness * d * l;
    c.bed_damping = scene->bed_damping * d * l;
    c.bed_ramp = BED_RAMP_DIAMETERS * d;
    c.bed_friction = scene->bed_friction;
    c.friction_speed = FRICTION_SPEED;
    c.friction_cap = INFINITY;
    c.bending = section->bending_stiffness;
    c.bending_time = 0;
    if (c.bending >
        0) // the same ratio of critical for the shortest wave as a stretched segment has
        c.bending_time = 2 * section->damping_ratio / bending_frequency(&c);
    c.breaking = section->breaking_tension > 0 ? section->breaking_tension : INFINITY;
    return c;
}

/// Smallest of the explicit limits [s]: taut and slack segments (omega = 2 c/l) and the bed, in
/// air, where nodes are lightest.
static double explicit_limit(const LineConstants *c)
{
    double travel = sqrt(c->mass / c->stiffness); // l / c
    double zeta = c->damping / sqrt(c->stiffness * c->mass);
    double limit = travel * mind(0.5 * line_midpoint_limit(zeta), SLACK_LIMIT);
    if (c->bed_stiffness > 0) {
        double omega = sqrt(c->bed_stiffness / c->mass);
        double bed_zeta = c->bed_damping / (2 * c->mass * omega);
        limit = mind(limit, line_midpoint_limit(bed_zeta) / omega);
    }
    if (c->bending > 0) {
        double omega = bending_frequency(c);
        limit = mind(limit, line_midpoint_limit(0.5 * c->bending_time * omega) / omega);
    }
    return STEP_SAFETY * limit;
}

bool makeup_create(const LineScene *scene, const WaterField *water, const char *what, Arena *arena,
                   LineMakeup *makeup, Error *error)
{
    size_t n = (size_t)scene->segments + 1;
    memset(makeup, 0, sizeof *makeup);
    makeup->scene = scene;
    makeup->density = water->density;
    makeup->gravity = water->gravity;
    makeup->bed = water->bed;
    makeup->segments = scene->segments;
    makeup->fairlead_length = line_section(scene, line_section_count(scene) - 1).length;
    makeup->parted = arena_take(arena, n, sizeof *makeup->parted, what, error);
    makeup->runs = arena_take(arena, n, sizeof *makeup->runs, what, error);
    makeup->segment = arena_take(arena, n, sizeof *makeup->segment, what, error);
    makeup->node = arena_take(arena, n, sizeof *makeup->node, what, error);
    makeup->blends = arena_take(arena, n, sizeof *makeup->blends, what, error);
    makeup->special = arena_take(arena, n, sizeof *makeup->special, what, error);
    if (!makeup->parted || !makeup->runs || !makeup->segment || !makeup->node || !makeup->blends ||
        !makeup->special)
        return false;
    makeup_update(makeup);
    return true;
}

/// Add segments begin..end-1 as runs, those that parted as runs of their own.
static void add_runs(LineMakeup *makeup, LineConstants constants, int begin, int end)
{
    for (int i = begin; i < end; i++) {
        LineRun *run = &makeup->runs[makeup->run_count];
        if (i > begin && !makeup->parted[i] && !makeup->parted[i - 1]) {
            run[-1].end = i + 1;
        } else {
            run->constants = constants;
            if (makeup->parted[i])
                run->constants.stiffness = run->constants.damping = run->constants.bending = 0;
            run->begin = i;
            run->end = i + 1;
            makeup->run_count++;
        }
        makeup->segment[i] = &makeup->runs[makeup->run_count - 1].constants;
    }
}

/// What each node carries, and which are special.
static void blend_nodes(LineMakeup *makeup)
{
    int last = makeup->segments;
    makeup->special_count = 0;
    for (int i = 0; i <= last; i++) {
        const LineConstants *before = i > 0 ? makeup->segment[i - 1] : NULL;
        const LineConstants *after = i < last ? makeup->segment[i] : NULL;
        bool parted = (before && makeup->parted[i - 1]) || (after && makeup->parted[i]);
        if (parted || (before && after && before != after))
            makeup->special[makeup->special_count++] = i;
        makeup->node[i] = before;
        if (before == after && !parted) continue;
        LineConstants *blend = &makeup->blends[i];
        memset(blend, 0, sizeof *blend);
        if (before) line_add_half(blend, before, 1);
        if (after) line_add_half(blend, after, 1);
        makeup->node[i] = blend;
    }
}

void makeup_update(LineMakeup *makeup)
{
    const LineScene *scene = makeup->scene;
    int sections = line_section_count(scene), begin = 0;
    makeup->run_count = 0;
    makeup->step_limit = INFINITY;
    makeup->sound_speed = 0;
    makeup->can_part = makeup->bends = false;
    for (int k = 0; k < sections; k++) {
        LineSection section = line_section(scene, k);
        double length = k == sections - 1 ? makeup->fairlead_length : section.length;
        LineConstants c = segment_constants(makeup, &section, length / section.segments);
        makeup->step_limit = mind(makeup->step_limit, explicit_limit(&c));
        makeup->sound_speed =
            maxd(makeup->sound_speed, sqrt(section.axial_stiffness / section.mass_per_length));
        makeup->can_part = makeup->can_part || isfinite(c.breaking);
        makeup->bends = makeup->bends || c.bending > 0;
        add_runs(makeup, c, begin, begin + section.segments);
        begin += section.segments;
    }
    for (int r = 0; r < makeup->run_count; r++)
        makeup->runs[r].constants.friction_cap =
            makeup->runs[r].constants.mass / makeup->step_limit;
    blend_nodes(makeup);
}

SpecialNode makeup_special_node(const LineMakeup *makeup, int i, const Vec3 place[3],
                                const double elevation[3])
{
    SpecialNode node;
    memset(&node, 0, sizeof node);
    double depth = elevation[1] - place[1].z;
    for (int side = 0; side < 2; side++) {
        int s = i - 1 + side, other = 2 * side;
        if (s < 0 || s >= makeup->segments) continue;
        const LineConstants *c = makeup->segment[s];
        double beyond = makeup->parted[s] ? depth : elevation[other] - place[other].z;
        line_add_half(&node.sum, c, line_wet_fraction(depth, beyond, c->radius));
        if (makeup->parted[s]) continue;
        Vec3 d = vec3_sub(place[other], place[1]);
        node.q = vec3_mad(node.q, d, side ? 1 : -1);
    }
    double size = vec3_norm(node.q);
    node.q = vec3_scale(node.q, size > 1e-12 * node.sum.length ? 1 / size : 0);
    return node;
}

Bend makeup_bend(const LineMakeup *makeup, int i, Vec3 before, Vec3 after)
{
    const LineConstants *below = makeup->segment[i - 1], *above = makeup->segment[i];
    double s0 = vec3_norm(before), s1 = vec3_norm(after);
    Bend bend;
    memset(&bend, 0, sizeof bend);
    if (makeup->parted[i - 1] || makeup->parted[i] || s0 == 0 || s1 == 0) return bend;
    bend.stiffness = (below->bending + above->bending) / (below->length + above->length);
    bend.time = maxd(below->bending_time, above->bending_time);
    bend.growth = 1;
    bend.before = vec3_scale(before, 1 / s0);
    bend.after = vec3_scale(after, 1 / s1);
    bend.below = 1 / maxd(s0, SHORTEST * below->length);
    bend.above = 1 / maxd(s1, SHORTEST * above->length);
    return bend;
}

double makeup_arc(const LineMakeup *makeup, int i)
{
    double arc = 0;
    for (int r = 0; r < makeup->run_count && makeup->runs[r].begin < i; r++) {
        const LineRun *run = &makeup->runs[r];
        int end = i < run->end ? i : run->end;
        arc += (end - run->begin) * run->constants.length;
    }
    return arc;
}
