/// A body on a line in a vacuum, stepped as the engine does.
#ifndef FAIRLEAD_TEST_COUPLING_RIG_H
#define FAIRLEAD_TEST_COUPLING_RIG_H

#include "coupling.h"
#include "line_ledger.h"

#include "mooring_cases.h"

typedef struct Rig {
    Scene scene;
    Body body;
    WaterField water;
    Arena arena;
    Mooring mooring;
    LinePaths paths;
    LineLedger ledger;
    double time;
    Error error;
    bool good;
} Rig;

static Rig rig; // a scene is large

/// A body of 50 kg that hangs in a vacuum on a line of 2 m and 0.2 kg, `mass` of which is the
/// body's; it was pulled down by `offset`. @return natural period [s]
static double rig_start(double offset, double damping, LineStepper stepper)
{
    memset(&rig, 0, sizeof rig);
    rig.scene = scene_default();
    rig.scene.body_count = 1;
    rig.scene.bodies[0] = body_scene_default();
    rig.scene.line_count = 1;
    LineScene *line = &rig.scene.lines[0];
    *line = line_scene_default();
    line->length = 2;
    line->axial_stiffness = 40000;
    line->mass_per_length = 0.1;
    line->diameter = 0.01;
    line->damping_ratio = damping;
    line->segments = 10;
    line->fairlead.body = 0;
    line->anchor.position = vec3(0, 0, 10);
    line->fairlead.position = vec3(0, 0, 0);
    rig.water.gravity = 9.81;
    rig.water.bed = -100;
    rig.body.mass = 50;
    rig.body.moving = true;
    rig.body.attitude = quat(1, 0, 0, 0);
    for (int i = 0; i < 3; i++)
        rig.body.inertia[i][i] = 1;
    double stretch = (50 + 0.1) * 9.81 / (40000 / 2.0);
    rig.body.position = rig.body.reference_position = vec3(0, 0, 8 - stretch - offset);
    rig.body.reference_attitude = rig.body.attitude;
    LineEnds ends = {{vec3(0, 0, 10), rig.body.position}};
    rig.arena = arena_create(0);
    rig.good =
        mooring_create(&rig.scene, &ends, &rig.water, &rig.arena, &rig.mooring, NULL, &rig.error);
    if (!rig.good) printf("  %s\n", rig.error.message);
    rig.mooring.lines[0].stepper = stepper;
    rig.ledger = line_ledger_create(&rig.scene, &rig.body, &rig.mooring);
    return 2 * PI * sqrt(50.07 / 20000);
}

/// One step as in step.c, without water. @param falsify  NULL = nothing between lines and body
static void rig_step_with(double dt, void (*falsify)(Body *))
{
    coupling_note_ends(&rig.scene, &rig.body, 0, &rig.paths);
    coupling_collect_loads(&rig.scene, rig.mooring.lines, &rig.body);
    if (falsify) falsify(&rig.body);
    body_advance(&rig.body, &rig.scene.bodies[0], 9.81, rig.time, dt);
    coupling_note_ends(&rig.scene, &rig.body, 1, &rig.paths);
    rig.good = rig.good &&
               mooring_advance(&rig.mooring, &rig.water, rig.time, dt, rig.paths.end, &rig.error);
    line_ledger_step(&rig.ledger, &rig.scene, &rig.body, rig.mooring.lines, &rig.paths, dt);
    rig.time += dt;
}

static inline void rig_step(double dt) { rig_step_with(dt, NULL); }

#endif
