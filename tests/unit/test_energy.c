/// Energies against what they are by hand.
#include "scenes.h"

#include "energy.h"
#include "physics/fluid.h"

TEST(elastic_energy_is_the_work_of_taits_pressure)
{
    const double b = 1e5, rho0 = 1000;
    for (double s = -0.02; s < 0.1; s += 0.0301) {
        // Simpson's rule over p / rho^2 drho from rho0
        enum { PARTS = 200 };
        double sum = 0, step = s * rho0 / PARTS;
        for (int i = 0; i <= PARTS; i++) {
            double rho = rho0 + i * step, weight = i == 0 || i == PARTS ? 1 : (i % 2 ? 4 : 2);
            sum += weight * b * (pow(rho / rho0, 7) - 1) / (rho * rho);
        }
        CHECK_NEAR(tait_energy(s, b, rho0), sum * step / 3, 1e-6 * fabs(sum * step / 3));
    }
    CHECK(tait_energy(0, b, rho0) == 0);
}

TEST(water_that_falls_turns_height_into_speed)
{
    Scene scene = tank_2d(0.025);
    scene.domain.max.z = 1;
    scene.fluid.block_count = 1;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-0.3, -0.5, 0.2), vec3(0.3, 0.5, 0.6)};
    scene.energy = ENERGY_LEVELS;
    Run *run = start(&scene, 1);
    double mass = run->plan.particle_mass * run->plan.fluid_count;
    CHECK_NEAR(mass, 240, 2.4);
    CHECK_NEAR(run->state->energy_start.potential, mass * 9.81 * 0.4, mass * 0.02);
    CHECK(run->state->energy_start.kinetic == 0);
    advance_to(run, 0.2);
    // velocities are those half a step earlier
    double t = run->state->time - 0.5 * run->state->time_step, speed = 9.81 * t;
    EnergyLevels now = energy_levels(&run->scene, run->state);
    CHECK_NEAR(now.kinetic / (0.5 * mass * speed * speed), 1, 0.01);
    double fallen = 0.5 * 9.81 * run->state->time * run->state->time;
    CHECK_NEAR((run->state->energy_start.potential - now.potential) / (mass * 9.81 * fallen), 1,
               0.01);
    finish(run);
}

TEST(a_body_has_the_energy_of_its_flight_spin_and_height)
{
    Scene scene = tank_2d(0.05);
    scene.domain.dimensions = 3;
    scene.energy = ENERGY_LEVELS;
    scene.body_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    box->size = vec3(0.3, 0.2, 0.1);
    box->position = vec3(0, 0, 0.3);
    box->mass = 2;
    box->attitude = vec3(0.3, 0.2, 0.1);
    Run *run = start(&scene, 1);
    run->state->bodies[0].velocity = vec3(1, 2, 3);
    run->state->bodies[0].angular_velocity =
        quat_rotate(run->state->bodies[0].attitude, vec3(4, 0, 5));
    double xx = 2 * (0.04 + 0.01) / 12, zz = 2 * (0.09 + 0.04) / 12;
    CHECK_NEAR(energy_levels(&run->scene, run->state).bodies,
               0.5 * 2 * 14 + 0.5 * (xx * 16 + zz * 25) + 2 * 9.81 * 0.3, 1e-6);
    finish(run);
}

TEST(a_line_has_the_energy_of_its_weight_stretch_and_motion)
{
    Scene scene = tank_2d(0.05);
    scene.domain.dimensions = 3;
    scene.energy = ENERGY_LEVELS;
    scene.line_count = 1;
    LineScene *line = &scene.lines[0];
    *line = line_scene_default();
    line->anchor.position = vec3(0, 0, -0.5);
    line->fairlead.position = vec3(0, 0, 0);
    line->length = 0.5;
    line->axial_stiffness = 100;
    line->mass_per_length = 0.5;
    line->diameter = 0.01;
    line->segments = 10;
    Run *run = start(&scene, 1);
    // straight up; lighter by the water it displaces; stretched by a fifth
    for (int n = 0; n <= 10; n++) {
        run->state->lines[0].position[n] = vec3(0, 0, -0.5 + 0.06 * n);
        run->state->lines[0].velocity[n] = vec3(2, 0, 0);
    }
    double wet = 0.5 - 1000 * PI * 0.01 * 0.01 / 4;
    double weight = wet * 0.5 * 9.81 * -0.2, stretch = 0.5 * 100 / 0.5 * 0.1 * 0.1;
    CHECK_NEAR(energy_levels(&run->scene, run->state).lines, weight + stretch + 0.5 * 0.25 * 4,
               1e-9);
    finish(run);
}

TEST(columns_of_energy_come_with_what_they_belong_to)
{
    Scene scene = tank_2d(0.05);
    static SeriesTable table;
    series_table(&scene, &table);
    CHECK(table.count == 1);
    scene.energy = ENERGY_LEVELS;
    series_table(&scene, &table);
    CHECK(table.count == 4 && !strcmp(table.names[1], "energy.kinetic_j"));
    scene.body_count = scene.line_count = 1;
    series_table(&scene, &table);
    CHECK(!strcmp(table.names[table.count - 2], "energy.bodies_j"));
    CHECK(!strcmp(table.names[table.count - 1], "energy.lines_j"));
}

static double residual_of(Run *run)
{
    EnergyColumn column[ENERGY_COLUMNS_MAX];
    int count = energy_columns(&run->scene, run->state, column);
    CHECK(!strcmp(column[count - 1].name, "residual_j"));
    return column[count - 1].value;
}

/// Largest residual [J] until a time.
static double largest_residual(Run *run, double until)
{
    double largest = 0;
    while (run->state->time < until) {
        advance_to(run, run->state->time + 0.02);
        largest = maxd(largest, fabs(residual_of(run)));
    }
    return largest;
}

static FluidWorks works_of(const Run *run)
{
    return run->state->backend->works(run->state->particles);
}

TEST(the_budget_of_a_dam_break_closes_within_a_hundredth)
{
    Scene scene = tank_2d(0.04);
    scene.domain.max = vec3(0.6, 0.5, 0.7);
    scene.fluid.block_count = 1;
    scene.fluid.blocks[0] = (FluidBlock){vec3(-1, -0.5, -0.5), vec3(-0.6, 0.5, -0.1)};
    scene.energy = ENERGY_BUDGET;
    Run *run = start(&scene, 1);
    double largest = largest_residual(run, 1.2);
    double fallen =
        run->state->energy_start.potential - energy_levels(&run->scene, run->state).potential;
    FluidWorks w = works_of(run);
    printf("  %.3f J of %.1f J unaccounted for; viscosity %.2f, diffusion %.2f, walls %.2f J\n",
           largest, fallen, w.viscosity, w.diffusion, w.walls);
    CHECK(fallen > 100);
    CHECK(largest < 0.01 * fallen);
    CHECK(w.viscosity < 0 && w.diffusion < 0);
    CHECK(w.ring == 0 && w.piston == 0 && w.bodies == 0 && w.zone == 0);
    finish(run);
}

TEST(the_budget_of_still_water_closes_within_a_ten_thousandth_of_what_it_holds)
{
    Scene scene = tank_2d(0.05);
    scene.energy = ENERGY_BUDGET;
    Run *run = start(&scene, 1);
    double held = -run->state->energy_start.potential; // rho g d^2/2 per metre, times the length
    CHECK_NEAR(held, 1000 * 9.81 * 0.125 * 2, 25);
    double largest = largest_residual(run, 2);
    printf("  %.4f J of %.0f J unaccounted for\n", largest, held);
    CHECK(largest < 1e-4 * held);
    finish(run);
}

static Scene heaving_box(void)
{
    Scene scene = tank_2d(0.05);
    scene.energy = ENERGY_BUDGET;
    scene.body_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    box->size = vec3(0.5, 1, 0.4);
    box->position = vec3(0, 0, 0);
    box->mass = 100;
    for (int f = 0; f < 6; f++)
        box->freedoms[f].kind = FREEDOM_FIXED;
    box->freedoms[2] = (Freedom){.kind = FREEDOM_PRESCRIBED, .amplitude = 0.05, .period = 1};
    return scene;
}

TEST(the_budget_of_a_heaving_box_closes_and_its_work_is_force_times_velocity)
{
    Scene scene = heaving_box();
    Run *run = start(&scene, 1);
    double work = 0, turnover = 0, largest = 0, before = 0;
    while (run->state->time < 2) {
        double t = run->state->time, dt = run->state->time_step;
        // before the first step dummies rest
        double velocity = t > 0 ? 0.05 * 2 * PI * cos(2 * PI * t) : 0.5 * 0.05 * 2 * PI;
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        work -= dt * run->state->bodies[0].fluid_force.z * velocity;
        FluidWorks now = works_of(run);
        CHECK_NEAR(now.bodies, work, 0.05);
        turnover += fabs(now.bodies - before);
        before = now.bodies;
        largest = maxd(largest, fabs(residual_of(run)));
    }
    printf("  %.3f J unaccounted for, %.1f J passed to and fro\n", largest, turnover);
    CHECK(turnover > 300);
    CHECK(largest < 0.005 * turnover);
    finish(run);
}

TEST(a_roll_back_takes_the_budget_with_it)
{
    Scene scene = heaving_box();
    Run *run = start(&scene, 1);
    advance_to(run, 0.3);
    double step = run->state->time_step;
    run->state->time_step = 4 * step;
    double then = NAN, residual = NAN;
    while (run->state->health.recoveries == 0) {
        double time = run->state->time, now = residual_of(run);
        CHECK(step_advance(&run->scene, &run->plan, run->state, &error));
        if (run->state->checkpoint.time == time) then = time, residual = now;
    }
    CHECK(run->state->time == then);
    CHECK_NEAR(residual_of(run), residual, 1e-9);
    finish(run);
}

TEST(lines_work_on_bodies_is_what_they_lose_in_vacuo)
{
    // a weight that falls far above the water until its line goes taut
    Scene scene = tank_2d(0.05);
    scene.domain.dimensions = 3;
    scene.domain.min.y = -0.2;
    scene.domain.max.y = 0.2;
    scene.energy = ENERGY_BUDGET;
    scene.body_count = scene.line_count = 1;
    BodyScene *box = &scene.bodies[0];
    *box = body_scene_default();
    box->size = vec3(0.1, 0.1, 0.1);
    box->position = vec3(0, 0, 1.2);
    box->mass = 2;
    LineScene *line = &scene.lines[0];
    *line = line_scene_default();
    line->anchor.position = vec3(0, 0, 1.5);
    line->fairlead = (LineEnd){0};
    line->length = 0.485;
    line->axial_stiffness = 1000;
    line->mass_per_length = 0.01;
    line->diameter = 0.002;
    line->segments = 2;
    Run *run = start(&scene, 1);
    double begin = energy_levels(&run->scene, run->state).bodies;
    advance_to(run, 0.23);
    double end = energy_levels(&run->scene, run->state).bodies;
    CHECK(end - begin < -1);
    printf("  work %.4f J, gain %.4f J\n", run->state->line_work, end - begin);
    CHECK_NEAR(run->state->line_work, end - begin, 0.02 * fabs(end - begin));
    finish(run);
}
