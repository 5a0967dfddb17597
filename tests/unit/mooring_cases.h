/// The lines whose reference figures are in tests/data/mooring, and a driver for them.
#ifndef FAIRLEAD_MOORING_CASES_H
#define FAIRLEAD_MOORING_CASES_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mooring.h"
#ifndef MOORING_CASES_ALONE // for programs that are no tests
#include "test.h"
#endif

/// x(t) = x0 + ramp(t) A sin(2 pi t/T + phase), ramp = (1 - cos(pi t/T))/2 until T, then 1.
typedef struct DrivenCase {
    const char *name;
    double diameter, mass, stiffness; ///< [m], [kg/m], EA [N]
    double damping;                   ///< BA [N s]; negative: minus the damping ratio
    double length, drag_normal, added_normal, drag_tangential, added_tangential;
    Vec3 anchor, fairlead;
    double density, bed;
    double surge, heave, period, phase, until;
} DrivenCase;

#define CHAIN .018, 1.99, 8.54e6
#define CHAIN_WATER 2.4, 1.0, 0.36605636911135925, 0.5
#define ROPE .02, 0.43353978619539146, 50000
#define ROPE_WATER 1.2, 1.0, 0.02, 0
#define STEEL .002213, .0305, 742352.2312893625
#define STEEL_WATER 1.6, 1.0, 0.05, 0

__attribute__((unused)) static const DrivenCase driven_cases[] = {
    {"a1", CHAIN, -1, 10, CHAIN_WATER, {0, 0, -10}, {8, 0, -6}, 1025, -100, 0, 0, 1, 0, 0},
    {"a2", CHAIN, -1, 6, CHAIN_WATER, {0, 0, -3}, {5.2, 0, -1}, 1025, -3, 0, 0, 1, 0, 0},
    {"a3", ROPE, -1, 62, ROPE_WATER, {0, 0, -60}, {40, 0, -10}, 1025, -100, 0, 0, 1, 0, 0},
    {"a4", CHAIN, -1, 6, CHAIN_WATER, {0, 0, -5}, {2, 0, -5}, 1025, -100, 0, 0, 1, 0, 0},
    {"b1", CHAIN, 300, 6, CHAIN_WATER, {0, 0, -3}, {5.2, 0, -1}, 1025, -3, 0, .05, 2, 0, 10},
    {"b2", CHAIN, 300, 6, CHAIN_WATER, {0, 0, -3}, {5.2, 0, -1}, 1025, -3, .05, 0, 2, 0, 10},
    {"b4", ROPE, 100, 62, ROPE_WATER, {0, 0, -60}, {40, 0, -10}, 1025, -100, .1, 0, 5, 0, 25},
    {"b5", ROPE, 100, 62, ROPE_WATER, {0, 0, -60}, {40, 0, -10}, 1025, -100, 0, 3, 4, 0, 20},
    {"b7", CHAIN, 300, 10, CHAIN_WATER, {0, 0, -10}, {8, 0, -6}, 1025, -100, 0, .1, 3, 0, 12},
    {"c1", STEEL, -1, .6, STEEL_WATER, {0, 0, -.5}, {.38, 0, -.08}, 1000, -.5, 0, .03, 1, 0, 4},
    {"c2", STEEL, -1, .6, STEEL_WATER, {0, 0, -.5}, {.38, 0, -.08}, 1000, -.5, .03, 0, 1, 0, 4},
    {"c3", STEEL, 1, .6, STEEL_WATER, {0, 0, -.5}, {.398, 0, -.08}, 1000, -.5, 0, .03, 1, 0, 4},
    {"d1",
     CHAIN,
     300,
     6,
     CHAIN_WATER,
     {0, 0, -2},
     {5.4, 0, -.25},
     1000,
     -2,
     .25,
     .1,
     2,
     PI / 2,
     10},
};

__attribute__((unused)) static const DrivenCase *driven_case(const char *name)
{
    for (size_t i = 0; i < sizeof driven_cases / sizeof driven_cases[0]; i++)
        if (!strcmp(driven_cases[i].name, name)) return &driven_cases[i];
    abort();
}

__attribute__((unused)) static LineScene driven_scene(const DrivenCase *c, int segments)
{
    LineScene scene;
    memset(&scene, 0, sizeof scene);
    snprintf(scene.name, sizeof scene.name, "%s", c->name);
    scene.length = c->length;
    scene.axial_stiffness = c->stiffness;
    scene.mass_per_length = c->mass;
    scene.diameter = c->diameter;
    scene.drag_normal = c->drag_normal;
    scene.drag_tangential = c->drag_tangential;
    scene.added_normal = c->added_normal;
    scene.added_tangential = c->added_tangential;
    scene.damping_ratio = c->damping < 0
                              ? -c->damping
                              : c->damping / (c->length / segments * sqrt(c->stiffness * c->mass));
    scene.segments = segments;
    scene.bed_stiffness = 3e6;
    scene.bed_damping = 3e5;
    return scene;
}

__attribute__((unused)) static WaterField driven_water(const DrivenCase *c)
{
    WaterField water = {NULL, NULL, 0, c->density, 9.80665, c->bed};
    return water;
}

/// Fairlead path over one step.
__attribute__((unused)) static EndPath driven_path(const DrivenCase *c, double time, double step)
{
    EndPath path;
    double omega = 2 * PI / c->period;
    for (int k = 0; k < 2; k++) {
        double t = time + k * step, s = PI * t / c->period;
        double ramp = t < c->period ? 0.5 * (1 - cos(s)) : 1;
        double ramp_rate = t < c->period ? 0.5 * PI / c->period * sin(s) : 0;
        double angle = omega * t + c->phase;
        // the phase belongs to heave alone: d1 moves on an ellipse
        double x = ramp * sin(omega * t), z = ramp * sin(angle);
        double u = ramp_rate * sin(omega * t) + ramp * omega * cos(omega * t);
        double w = ramp_rate * sin(angle) + ramp * omega * cos(angle);
        path.position[k] =
            vec3(c->fairlead.x + c->surge * x, c->fairlead.y, c->fairlead.z + c->heave * z);
        path.velocity[k] = vec3(c->surge * u, 0, c->heave * w);
    }
    return path;
}

__attribute__((unused)) static EndPath still_path(Vec3 place)
{
    EndPath path = {{place, place}, {{0, 0, 0}, {0, 0, 0}}};
    return path;
}

/// Columns of a reference file, the first row being names. @return number of rows
__attribute__((unused)) static int read_reference(const char *file, int columns, int rows_max,
                                                  double *values)
{
    char path[512], text[512];
    snprintf(path, sizeof path, SOURCE_DIR "/tests/data/mooring/%s", file);
    FILE *stream = fopen(path, "r");
    int rows = 0;
    if (!stream) return 0;
    if (fgets(text, sizeof text, stream))
        while (rows < rows_max && fgets(text, sizeof text, stream)) {
            char *at = text;
            for (int k = 0; k < columns; k++, at += *at == ',')
                values[rows * columns + k] = strtod(at, &at);
            rows++;
        }
    fclose(stream);
    return rows;
}

#endif
