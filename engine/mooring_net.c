/// All lines of a scene: which move together, their start, their steps.
#include <stdio.h>
#include <string.h>

#include "mooring_internal.h"

/// A line that free points stretch by more than this at rest was meant to be longer [-].
static const double STRETCH_MAX = 0.05;

typedef struct Net {
    LineNet net;
    int *line; ///< index of each line [line_count]
    LineSpan *spans;
} Net;

/// Smallest index of a line that moves together with line `l`, by what is known in `group`.
static int group_of(const int *group, int l)
{
    while (group[l] != l)
        l = group[l];
    return l;
}

static int free_point(const Scene *scene, int line, int side)
{
    const LineEnd *end = side ? &scene->lines[line].fairlead : &scene->lines[line].anchor;
    bool free = end->point >= 0 && scene->points[end->point].kind == POINT_FREE;
    return free ? end->point : -1;
}

/// Lines that share a free point, directly or by others, get the same number.
static void find_groups(const Scene *scene, int group[SCENE_LINES_MAX])
{
    int first[SCENE_POINTS_MAX];
    for (int p = 0; p < scene->point_count; p++)
        first[p] = -1;
    for (int l = 0; l < scene->line_count; l++) {
        group[l] = l;
        for (int side = 0; side < 2; side++) {
            int p = free_point(scene, l, side);
            if (p < 0) continue;
            if (first[p] < 0) first[p] = l;
            int a = group_of(group, l), b = group_of(group, first[p]);
            group[a > b ? a : b] = a > b ? b : a;
        }
    }
    for (int l = 0; l < scene->line_count; l++)
        group[l] = group_of(group, l);
}

/// A point as a node without direction. The bed carries it on the square of its diameter.
static LineConstants point_constants(const PointScene *point, const WaterField *water,
                                     const PointWork *work)
{
    LineConstants c;
    memset(&c, 0, sizeof c);
    double displaced = water->density * point->volume;
    c.mass = point->mass;
    c.weight = point->mass * water->gravity;
    c.buoyancy = displaced * water->gravity;
    c.water_mass = displaced;
    c.added_normal = c.added_tangential = displaced * point->added_mass;
    c.drag_normal = c.drag_tangential = 0.5 * water->density * point->drag_area;
    c.radius = cbrt(3 * point->volume / (4 * PI));
    c.bed = water->bed;
    c.friction_cap = INFINITY;
    for (int k = 0; k < work->joint_count; k++) {
        const LineWork *line = work->lines[k]->workspace;
        const LineScene *scene = work->lines[k]->scene;
        const LineConstants *end = line->makeup.segment[work->sides[k] ? line->node_count - 2 : 0];
        c.radius = maxd(c.radius, end->radius);
        c.bed_ramp = maxd(c.bed_ramp, end->bed_ramp);
        c.bed_stiffness = maxd(c.bed_stiffness, scene->bed_stiffness);
        c.bed_damping = maxd(c.bed_damping, scene->bed_damping);
        c.bed_friction = maxd(c.bed_friction, scene->bed_friction);
        c.friction_speed = end->friction_speed;
        c.friction_cap = mind(c.friction_cap, c.mass / line->makeup.step_limit + end->friction_cap);
    }
    c.bed_stiffness *= 4 * c.radius * c.radius;
    c.bed_damping *= 4 * c.radius * c.radius;
    c.breaking = INFINITY;
    return c;
}

/// Line ends that meet at free point `p`.
static bool join_point(const Scene *scene, int p, const WaterField *water, Arena *arena,
                       Mooring *mooring, Error *error)
{
    MooringPoint *point = &mooring->points[p];
    const char *name = scene->points[p].name;
    PointWork *work = arena_take(arena, 1, sizeof *work, name, error);
    if (!work) return false;
    size_t ends = 2 * (size_t)scene->line_count;
    TRY(work->lines = arena_take(arena, ends, sizeof(Line *), name, error));
    TRY(work->sides = arena_take(arena, ends, sizeof(int), name, error));
    for (int l = 0; l < scene->line_count; l++)
        for (int side = 0; side < 2; side++) {
            if (free_point(scene, l, side) != p) continue;
            work->lines[work->joint_count] = &mooring->lines[l];
            work->sides[work->joint_count++] = side;
        }
    work->constants = point_constants(&scene->points[p], water, work);
    point->workspace = work;
    return true;
}

/// The smallest limit of the explicit step that a point puts on its lines: springs 2 k on the mass
/// of the point and of half a segment of each line.
static void limit_steps(const PointWork *point)
{
    double stiffness = 0, mass = point->constants.mass, bed = point->constants.bed_stiffness;
    for (int k = 0; k < point->joint_count; k++) {
        const LineWork *work = point->lines[k]->workspace;
        int node = point->sides[k] ? work->node_count - 1 : 0;
        const LineConstants *segment = work->makeup.segment[node ? node - 1 : 0];
        stiffness += 2 * segment->stiffness;
        mass += work->makeup.node[node]->mass;
        bed += work->makeup.node[node]->bed_stiffness;
    }
    double omega = sqrt(maxd(stiffness, bed) / mass);
    for (int k = 0; k < point->joint_count; k++) {
        Line *line = point->lines[k];
        line->step_limit = mind(line->step_limit, line_midpoint_limit(1) / omega);
    }
}

/// The start of lines that are joined: guesses between the points' guesses, then all together.
static bool start_net(const Scene *scene, const Net *own, const LineEnds *ends,
                      const int *point_index, const WaterField *water, const char *where,
                      Mooring *mooring, Arena *arena, LineStatics *statics, Error *error)
{
    const LineNet *net = &own->net;
    size_t points = (size_t)net->block.count, count = (size_t)net->line_count;
    RelaxLine *lines = arena_take(arena, count, sizeof *lines, where, error);
    RelaxPoint *free_points = arena_take(arena, points, sizeof *free_points, where, error);
    if (!lines || !free_points) return false;
    for (size_t p = 0; p < points; p++) {
        free_points[p].constants = ((PointWork *)net->points[p]->workspace)->constants;
        free_points[p].position = scene->points[point_index[p]].position;
    }
    for (int k = 0; k < net->line_count; k++) {
        Line *line = net->lines[k];
        const LineWork *work = line->workspace;
        Vec3 place[2];
        for (int side = 0; side < 2; side++)
            place[side] = work->point[side] >= 0 ? free_points[work->point[side]].position
                                                 : ends[own->line[k]].place[side];
        line_guess(&work->makeup, place[0], place[1], water, line->position);
        line->position[0] = place[0];
        line->position[line->node_count - 1] = place[1];
        RelaxLine relaxed = {&work->makeup,
                             {work->point[0], work->point[1]},
                             line->position,
                             statics ? &statics[own->line[k]] : NULL};
        lines[k] = relaxed;
    }
    TRY(lines_relax(lines, net->line_count, free_points, net->block.count, water->level, where,
                    error));
    for (int k = 0; k < net->line_count; k++) {
        const Line *line = net->lines[k];
        double stretched = 0;
        for (int i = 0; i + 1 < line->node_count; i++)
            stretched += vec3_norm(vec3_sub(line->position[i + 1], line->position[i]));
        if (statics) {
            statics[own->line[k]].reach = line->length;
            statics[own->line[k]].span =
                vec3_norm(vec3_sub(line->position[line->node_count - 1], line->position[0]));
        }
        if (stretched > line->length * (1 + STRETCH_MAX))
            return error_set(error, ERROR_INPUT,
                             "lines[%d]: the line cannot reach: at rest it is stretched to %.6g m "
                             "and it is %.6g m long (reach); accepted length: at least %.6g m",
                             own->line[k], stretched, line->length, stretched / (1 + STRETCH_MAX));
        line_settle(net->lines[k], water);
    }
    return true;
}

static void place_points(const Net *own)
{
    for (int p = 0; p < own->net.block.count; p++) {
        MooringPoint *point = own->net.points[p];
        const PointWork *work = point->workspace;
        int end = work->sides[0] ? work->lines[0]->node_count - 1 : 0;
        point->position = work->lines[0]->position[end];
        point->velocity = work->lines[0]->velocity[end];
    }
}

/// Lines of one group with their free points, and how they start.
static bool create_net(const Scene *scene, const int *group, int first, const LineEnds *ends,
                       const WaterField *water, Arena *arena, Mooring *mooring, Net *own,
                       LineStatics *statics, Error *error)
{
    char where[32];
    int local[SCENE_POINTS_MAX], point_index[SCENE_POINTS_MAX] = {0}, points = 0, count = 0;
    snprintf(where, sizeof where, "lines[%d]", first);
    for (int p = 0; p < scene->point_count; p++)
        local[p] = -1;
    size_t most = (size_t)scene->line_count;
    TRY(own->line = arena_take(arena, most, sizeof(int), where, error));
    TRY(own->spans = arena_take(arena, most, sizeof(LineSpan), where, error));
    TRY(own->net.lines = arena_take(arena, most, sizeof(Line *), where, error));
    TRY(own->net.chains = arena_take(arena, most, sizeof(Chain *), where, error));
    TRY(own->net.impulse = arena_take(arena, most, sizeof(Vec3[2]), where, error));
    for (int l = first; l < scene->line_count; l++) {
        if (group[l] != first) continue;
        int point[2];
        for (int side = 0; side < 2; side++) {
            int p = free_point(scene, l, side);
            if (p >= 0 && local[p] < 0) {
                local[p] = points;
                point_index[points++] = p;
            }
            point[side] = p >= 0 ? local[p] : -1;
        }
        snprintf(where, sizeof where, "lines[%d]", l);
        TRY(line_take(&scene->lines[l], water, point, where, arena, &mooring->lines[l], error));
        own->line[count] = l;
        own->net.lines[count] = &mooring->lines[l];
        own->net.chains[count++] = line_bdf2_chain(&mooring->lines[l]);
    }
    own->net.line_count = count;
    TRY(point_block_create(&own->net.block, points, arena, where, error));
    TRY(own->net.points =
            arena_take(arena, (size_t)points + 1, sizeof(MooringPoint *), where, error));
    for (int p = 0; p < points; p++) {
        own->net.points[p] = &mooring->points[point_index[p]];
        TRY(join_point(scene, point_index[p], water, arena, mooring, error));
    }
    if (points > 0)
        TRY(start_net(scene, own, ends, point_index, water, where, mooring, arena, statics, error));
    for (int p = 0; p < points; p++)
        limit_steps(own->net.points[p]->workspace);
    place_points(own);
    return true;
}

/// Places of all points, and whether each free one has a line.
static bool create_points(const Scene *scene, Mooring *mooring, Error *error)
{
    for (int p = 0; p < scene->point_count; p++) {
        const PointScene *point = &scene->points[p];
        mooring->points[p].scene = point;
        mooring->points[p].position = point->position;
        int joints = 0;
        for (int l = 0; l < scene->line_count; l++)
            joints += (free_point(scene, l, 0) == p) + (free_point(scene, l, 1) == p);
        if (point->kind == POINT_FREE && joints == 0)
            return error_set(error, ERROR_INPUT,
                             "points[%d] (%s): no line ends at this free point; accepted: at "
                             "least one",
                             p, point->name);
    }
    return true;
}

bool mooring_create(const Scene *scene, const LineEnds *ends, const WaterField *water, Arena *arena,
                    Mooring *mooring, LineStatics *statics, Error *error)
{
    int group[SCENE_LINES_MAX];
    size_t lines = (size_t)scene->line_count, points = (size_t)scene->point_count;
    memset(mooring, 0, sizeof *mooring);
    mooring->line_count = scene->line_count;
    mooring->point_count = scene->point_count;
    TRY(mooring->lines = arena_take(arena, lines, sizeof(Line), "lines", error));
    TRY(mooring->points = arena_take(arena, points, sizeof(MooringPoint), "points", error));
    Net *nets = arena_take(arena, lines, sizeof *nets, "lines", error);
    if (!nets) return false;
    mooring->nets = nets;
    TRY(create_points(scene, mooring, error));
    find_groups(scene, group);
    for (int l = 0; l < scene->line_count; l++)
        if (group[l] == l)
            TRY(create_net(scene, group, l, ends, water, arena, mooring,
                           &nets[mooring->net_count++], statics, error));
    for (int n = 0; n < mooring->net_count; n++) {
        if (nets[n].net.block.count > 0) continue;
        int l = nets[n].line[0];
        char where[32];
        LineStatics unused;
        snprintf(where, sizeof where, "lines[%d]", l);
        TRY(line_statics(&scene->lines[l], ends[l].place[0], ends[l].place[1], water, where,
                         mooring->lines[l].position, statics ? &statics[l] : &unused, error));
        line_settle(&mooring->lines[l], water);
    }
    return true;
}

bool mooring_advance(Mooring *mooring, const WaterField *water, double time, double duration,
                     const EndPath (*paths)[2], Error *error)
{
    Net *nets = mooring->nets;
    for (int n = 0; n < mooring->net_count; n++) {
        Net *own = &nets[n];
        for (int k = 0; k < own->net.line_count; k++) {
            const EndPath *path = paths[own->line[k]];
            LineSpan span = {time, duration, &path[0], &path[1]};
            own->spans[k] = span;
        }
        TRY(net_advance(&own->net, water, own->spans, error));
        place_points(own);
    }
    return true;
}

double mooring_energy(const Mooring *mooring)
{
    double energy = 0;
    for (int l = 0; l < mooring->line_count; l++)
        energy += line_energy(&mooring->lines[l]);
    for (int p = 0; p < mooring->point_count; p++) {
        const MooringPoint *point = &mooring->points[p];
        if (!point->workspace) continue;
        const LineConstants *c = &((const PointWork *)point->workspace)->constants;
        energy += 0.5 * c->mass * vec3_dot(point->velocity, point->velocity) +
                  (c->weight - c->buoyancy) * point->position.z;
    }
    return energy;
}
