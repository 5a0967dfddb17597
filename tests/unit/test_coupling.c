/// Bodies on lines, through the coupling that a step of the engine uses.
#include "coupling_rig.h"

/// Energy of body and line. The body's velocity belongs to the middle of the last step.
static double rig_energy(Vec3 next_velocity)
{
    Vec3 v = vec3_scale(vec3_add(rig.body.velocity, next_velocity), 0.5);
    return 0.5 * 50 * vec3_dot(v, v) + 50 * 9.81 * rig.body.position.z +
           mooring_energy(&rig.mooring);
}

/// Without any damping in the line; 150 steps in a period of 0.31 s are steps of 2 ms.
TEST(mass_on_a_spring_line_in_a_vacuum_keeps_its_energy)
{
    enum { STEPS = 150, PERIODS = 100 };
    double period = rig_start(0, 0, LINE_STEPPER_BDF2);
    double rest = rig_energy(rig.body.velocity), lowest = INFINITY, highest = -INFINITY;
    arena_destroy(&rig.arena);
    rig_start(0.015, 0, LINE_STEPPER_BDF2);
    double first = NAN, mean = 0;
    for (int k = 0; k < STEPS * PERIODS && rig.good; k++) {
        double before = mooring_energy(&rig.mooring) + 50 * 9.81 * rig.body.position.z;
        Vec3 v = rig.body.velocity;
        rig_step(period / STEPS);
        v = vec3_scale(vec3_add(v, rig.body.velocity), 0.5); // leapfrog's, at the step's begin
        mean += (0.5 * 50 * vec3_dot(v, v) + before - rest) / STEPS;
        if (k % STEPS != STEPS - 1) continue;
        first = isnan(first) ? mean : first;
        lowest = mind(lowest, mean);
        highest = maxd(highest, mean);
        mean = 0;
    }
    CHECK(rig.good);
    CHECK_NEAR(first, 0.5 * 20000 * 0.015 * 0.015, 0.05);
    CHECK(highest - lowest < 1e-3 * first);
    printf("  energy of a period between %.7g and %.7g J\n", lowest, highest);
    arena_destroy(&rig.arena);
}

/// What the line takes from the body it gives to its anchor: momentum of all three, over snaps.
TEST(body_line_and_anchor_exchange_momentum_without_loss)
{
    for (int stepper = 0; stepper < 2; stepper++) {
        rig_start(-0.3, 0.5, stepper ? LINE_STEPPER_BDF2 : LINE_STEPPER_RK2); // falls into the line
        double dt = 1e-3, given = 0, largest = 0, worst = 0;
        for (int k = 0; k < 1500 && rig.good; k++) {
            rig_step(dt);
            given += dt * (-rig.mooring.lines[0].anchor_force.z - 50.2 * 9.81);
            double momentum = 50 * rig.body.velocity.z;
            const Line *line = &rig.mooring.lines[0];
            for (int i = 0; i < line->node_count; i++)
                momentum +=
                    (i == 0 || i == line->node_count - 1 ? 0.01 : 0.02) * line->velocity[i].z;
            largest = maxd(largest, fabs(momentum));
            worst = maxd(worst, fabs(momentum - given));
        }
        CHECK(rig.good);
        CHECK(largest > 100);
        printf("  momentum up to %.4g N s, out of balance by at most %.3g N s\n", largest, worst);
        CHECK(worst < 0.02 * largest); // the pull of the step in hand, which has not acted yet
        arena_destroy(&rig.arena);
    }
}
