#include <math.h>
#include <string.h>

#include "scene.h"

Scene scene_default(void)
{
    Scene scene;
    memset(&scene, 0, sizeof scene);
    Vec3 none = vec3(NAN, NAN, NAN);

    scene.domain.kind = DOMAIN_TANK;
    scene.domain.dimensions = 3;
    scene.domain.min = scene.domain.max = none;
    scene.lines_step = NAN;

    Fluid *fluid = &scene.fluid;
    fluid->spacing = NAN;
    fluid->smoothing_ratio = 2.0;    // waves lose 1.3 % of height per period (docs/physics.md)
    fluid->density = 1000.0;         // fresh water at 4 C, as in model basins
    fluid->alpha = 0.002;            // docs/physics.md: larger values damp waves
    fluid->delta = 0.1;              // Fourtakas et al. (2019), 10.1016/j.compfluid.2019.06.009
    fluid->sound_speed = 0;          // by the rule
    fluid->sound_speed_ratio = 10.0; // density within 1 %: Monaghan (1994), 10.1006/jcph.1994.1034
    fluid->gravity = 9.81;
    fluid->standing_mode = 1;
    fluid->level = 0;

    Waves *waves = &scene.waves;
    waves->kind = WAVES_NONE;
    waves->spectrum.peak_enhancement = 3.3; // mean of JONSWAP: Hasselmann et al. (1973)
    waves->spectrum.components = 64;
    waves->spectrum.seed = 1;
    waves->focus.x = waves->focus.y = 0;
    waves->focus.time = NAN; // required for a group
    waves->piston_order = 2;
    waves->gain.gauge = -1;
    waves->gain.start = 1;
    waves->gain.largest = 1.25;
    waves->initial.height = waves->initial.period = NAN;
    waves->initial.heading = 0;
    waves->start = WAVE_START_RAMP;
    waves->ramp_time = NAN;     // two periods, filled in after reading
    waves->blend_periods = 1.5; // docs/physics.md, basin, live change
    waves->zone_width = 0;      // 0.75 of the longest wave that may be asked for
    waves->height_limits.min = waves->height_limits.max = NAN;
    waves->period_limits = waves->heading_limits = waves->height_limits;

    scene.contacts.friction = 0.3;        // wet steel on steel or concrete
    scene.outputs.series_interval = 0.02; // 50 a second: 60 samples in the shortest wave of a flume
    scene.camera.target = none;
    scene.camera.distance = NAN;
    scene.camera.azimuth = -60 * PI / 180;
    scene.camera.elevation = 20 * PI / 180;
    return scene;
}

BodyScene body_scene_default(void)
{
    BodyScene body;
    memset(&body, 0, sizeof body);
    Vec3 none = vec3(NAN, NAN, NAN);
    body.shape = BODY_BOX;
    body.size = none;
    body.radius = body.length = body.draft_design = body.breadth = NAN;
    body.axis = 1; // across: the section of a cylinder lies in the x-z plane
    body.scale = 1;
    body.position = none;
    body.mass = body.draft = NAN;
    body.centre_of_gravity = body.radii_of_gyration = none;
    for (int i = 0; i < 6; i++) {
        body.inertia[i] = NAN;
        body.freedoms[i].kind = FREEDOM_FREE;
    }
    body.colour[0] = 0.78, body.colour[1] = 0.29, body.colour[2] = 0.18; // red lead
    return body;
}

LineScene line_scene_default(void)
{
    LineScene line;
    memset(&line, 0, sizeof line);
    line.anchor.body = line.fairlead.body = -1;
    line.anchor.point = line.fairlead.point = -1;
    line.anchor.position = line.fairlead.position = vec3(NAN, NAN, NAN);
    line.pretension = NAN;
    line.length = line.axial_stiffness = line.mass_per_length = line.diameter = NAN;
    // coefficients, internal damping and bed of MoorDyn's sample input (Hall 2015, users guide)
    line.drag_normal = 1.6;
    line.drag_tangential = 0.05;
    line.added_normal = 1.0;
    line.added_tangential = 0.0;
    line.damping_ratio = 0.8;
    line.segments = 20;
    line.bed_stiffness = 3.0e6;
    line.bed_damping = 3.0e5;
    line.bed_friction = 0;
    return line;
}

LineSection line_section_default(void)
{
    LineSection section;
    section.segments = 0;
    section.length = section.axial_stiffness = section.mass_per_length = section.diameter = NAN;
    section.drag_normal = section.drag_tangential = NAN;
    section.added_normal = section.added_tangential = NAN;
    section.damping_ratio = section.bending_stiffness = section.breaking_tension = NAN;
    return section;
}

PointScene point_scene_default(void)
{
    PointScene point;
    memset(&point, 0, sizeof point);
    point.kind = POINT_FREE;
    point.body = -1;
    point.position = vec3(NAN, NAN, NAN);
    point.added_mass = 0.5; // a sphere in unbounded water (Lamb 1932, Hydrodynamics, sec. 92)
    return point;
}

static void inherit(double *value, double from)
{
    if (isnan(*value)) *value = from;
}

void line_scene_complete(LineScene *line)
{
    if (line->section_count == 0) return;
    double length = 0;
    for (int i = 0; i < line->section_count; i++)
        length += line->sections[i].length;
    int asked = line->segments, count = 0;
    for (int i = 0; i < line->section_count; i++) {
        LineSection *s = &line->sections[i];
        if (s->segments == 0) s->segments = (int)maxd(1, round(asked * s->length / length));
        count += s->segments;
        inherit(&s->axial_stiffness, line->axial_stiffness);
        inherit(&s->mass_per_length, line->mass_per_length);
        inherit(&s->diameter, line->diameter);
        inherit(&s->drag_normal, line->drag_normal);
        inherit(&s->drag_tangential, line->drag_tangential);
        inherit(&s->added_normal, line->added_normal);
        inherit(&s->added_tangential, line->added_tangential);
        inherit(&s->damping_ratio, line->damping_ratio);
        inherit(&s->bending_stiffness, line->bending_stiffness);
        inherit(&s->breaking_tension, line->breaking_tension);
    }
    line->length = length;
    line->segments = count;
    // who asks the line as a whole gets what is at its fairlead
    const LineSection *last = &line->sections[line->section_count - 1];
    inherit(&line->axial_stiffness, last->axial_stiffness);
    inherit(&line->mass_per_length, last->mass_per_length);
    inherit(&line->diameter, last->diameter);
}
