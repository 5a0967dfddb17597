#include <string.h>

#include "commands.h"
#include "json.h"

/// Figures that follow from a report.
typedef struct Figures {
    double per_particle, per_fluid_particle; ///< [s] of a step
    double particle_steps, fluid_steps;      ///< per second
    double pairs_per_second;                 ///< directed
    double speed;                            ///< simulated seconds per second
    double neighbours;                       ///< of a water particle, dummies among them [-]
    double bytes;                            ///< of particles and lists
    double steps_per_sort;                   ///< a lower bound when no sort came
    double of_peak, of_bandwidth;            ///< [-]
} Figures;

static Figures figures_of(const BenchReport *r, const BenchOptions *options)
{
    double step = r->step_median;
    return (Figures){
        .per_particle = step / r->particle_count,
        .per_fluid_particle = step / r->fluid_count,
        .particle_steps = r->particle_count / step,
        .fluid_steps = r->fluid_count / step,
        .pairs_per_second = r->pairs / step,
        .speed = r->time_step / step,
        .neighbours = r->neighbours_fluid + r->neighbours_dummy,
        .bytes = (double)(r->state_bytes + r->list_bytes),
        .steps_per_sort = (double)options->steps / (double)(r->sorts > 0 ? r->sorts : 1),
        .of_peak = r->flops / step / r->machine.peak,
        .of_bandwidth = r->traffic / step / r->machine.bandwidth,
    };
}

// ---- for people ---------------------------------------------------------------------------------

static void print_machine(const BenchReport *r)
{
    const BenchMachine *m = &r->machine;
    printf("Machine               %s, %d threads\n", m->cpu, r->threads);
    printf("Backend, level        %s, %s\n", r->backend, r->level);
    printf(
        "Clock                 %.2f GHz while the steps ran (%.2f to %.2f), %.2f beside the peak\n",
        r->clock_median / 1e9, r->clock_lowest / 1e9, r->clock_highest / 1e9, m->peak_clock / 1e9);
    printf("Peak, measured        %.4g Gflop/s fp32 (%.3g a cycle and thread)\n", m->peak / 1e9,
           m->peak / m->peak_clock / r->threads);
    printf("Bandwidth, measured   %.3g GB/s (triad over %.0f MB)\n\n", m->bandwidth / 1e9,
           m->bandwidth_bytes / 1e6);
}

static void print_scene(const BenchReport *r, const BenchOptions *options)
{
    printf("Scene                 %s, %d dimensions, %d particles asked for\n", options->scene,
           r->dimensions, options->particles);
    printf("Particles             %d: %d fluid, %d dummies\n", r->particle_count, r->fluid_count,
           r->dummy_count);
    printf("Spacing, h/dp         %.5g m, %.4g\n", r->spacing, r->smoothing_length / r->spacing);
    printf(
        "Neighbours            %.1f of a fluid particle: %.1f fluid, %.1f dummies (mean of %d)\n",
        r->neighbours_fluid + r->neighbours_dummy, r->neighbours_fluid, r->neighbours_dummy,
        r->neighbours_sample);
    printf("Force passes a step   one momentum and one density pass\n");
    printf("Time step             %.4g s, c0 dt/h = %.3g\n\n", r->time_step, r->courant);
}

static void print_speed(const BenchReport *r, const Figures *f, const BenchOptions *options)
{
    printf("Steps                 %d in %d groups, after %d to warm up (t = %.3g s); the median:\n",
           options->steps, r->group_count, options->warm_up, r->start_time);
    printf("A step                %.4g ms (fastest %.4g, slowest %.4g, mean %.4g)\n",
           r->step_median * 1e3, r->step_fastest * 1e3, r->step_slowest * 1e3, r->step_mean * 1e3);
    printf("Per particle and step %.4g ns of all, %.4g ns of fluid\n", f->per_particle * 1e9,
           f->per_fluid_particle * 1e9);
    printf("Particle-steps        %.4g M/s of all, %.4g M/s of fluid\n", f->particle_steps / 1e6,
           f->fluid_steps / 1e6);
    printf("Pairs, directed       %.4g M/s, each once for momentum and once for density\n",
           f->pairs_per_second / 1e6);
    printf("Simulated             %.4g s per second\n", f->speed);
    if (r->sorts)
        printf("Sorts                 %lld, one in %.3g steps\n", (long long)r->sorts,
               f->steps_per_sort);
    else
        printf("Sorts                 none in %d steps: their time is not in these figures\n",
               options->steps);
    printf("Preempted             %ld times by other processes while the steps ran\n",
           r->preemptions);
    if (r->roll_backs)
        printf("Rolled back           %d times: the figures are of other steps than asked for\n",
               r->roll_backs);
    printf("Of the peak           %.1f %% (%.4g Gflop a step)\n", 100 * f->of_peak, r->flops / 1e9);
    printf("Of the bandwidth      %.1f %% (%.4g MB a step at least)\n\n", 100 * f->of_bandwidth,
           r->traffic / 1e6);
}

static void print_text(const BenchReport *r, const BenchOptions *options)
{
    Figures f = figures_of(r, options);
    print_machine(r);
    print_scene(r, options);
    print_speed(r, &f, options);
    for (int p = 0; p < r->pass_count; p++)
        if (r->passes[p].share > 0)
            printf("  %-19s %5.1f %%\n", r->passes[p].name, 100 * r->passes[p].share);
    printf("\nMemory of particles   %.4g MB: %.0f B a particle, %.0f B a fluid particle\n",
           f.bytes / 1e6, f.bytes / r->particle_count, f.bytes / r->fluid_count);
    printf("  of which lists      %.4g MB\n", (double)r->list_bytes / 1e6);
    printf("Memory of the plan    %.4g MB\n", (double)r->plan_bytes / 1e6);
    printf("Peak of the process   %.4g MB resident\n", (double)r->peak_resident / 1e6);
}

// ---- for programs -------------------------------------------------------------------------------

static void write_scene(Json *json, const BenchReport *r, const BenchOptions *options)
{
    json_string(json, "scene", options->scene);
    json_integer(json, "dimensions", r->dimensions);
    json_integer(json, "particles_asked", options->particles);
    json_integer(json, "particles", r->particle_count);
    json_integer(json, "fluid_particles", r->fluid_count);
    json_integer(json, "dummy_particles", r->dummy_count);
    json_number(json, "spacing_m", r->spacing);
    json_number(json, "smoothing_ratio", r->smoothing_length / r->spacing);
    json_number(json, "neighbours", r->neighbours_fluid + r->neighbours_dummy);
    json_number(json, "neighbours_fluid", r->neighbours_fluid);
    json_number(json, "neighbours_dummy", r->neighbours_dummy);
    json_integer(json, "neighbours_sample", r->neighbours_sample);
    json_integer(json, "momentum_passes_per_step", 1);
    json_integer(json, "density_passes_per_step", 1);
    json_number(json, "time_step_s", r->time_step);
    json_number(json, "courant", r->courant);
}

static void write_speed(Json *json, const BenchReport *r, const BenchOptions *options)
{
    Figures f = figures_of(r, options);
    json_integer(json, "warm_up_steps", options->warm_up);
    json_integer(json, "steps", options->steps);
    json_integer(json, "groups", r->group_count);
    json_number(json, "start_time_s", r->start_time);
    json_number(json, "step_s", r->step_median);
    json_number(json, "step_fastest_s", r->step_fastest);
    json_number(json, "step_slowest_s", r->step_slowest);
    json_array(json, "group_step_s");
    for (int g = 0; g < r->group_count; g++)
        json_number(json, NULL, r->step[g]);
    json_array_end(json);
    json_number(json, "step_mean_s", r->step_mean);
    json_number(json, "ns_per_particle_step", f.per_particle * 1e9);
    json_number(json, "ns_per_fluid_particle_step", f.per_fluid_particle * 1e9);
    json_number(json, "particle_steps_per_second", f.particle_steps);
    json_number(json, "fluid_particle_steps_per_second", f.fluid_steps);
    json_number(json, "directed_pairs_per_second", f.pairs_per_second);
    json_number(json, "simulated_seconds_per_second", f.speed);
    json_integer(json, "sorts", r->sorts);
    json_number(json, "steps_per_sort", f.steps_per_sort);
    json_integer(json, "preemptions", r->preemptions);
    json_integer(json, "roll_backs", r->roll_backs);
    json_object(json, "shares");
    for (int p = 0; p < r->pass_count; p++)
        json_number(json, r->passes[p].name, r->passes[p].share);
    json_object_end(json);
    json_number(json, "flops_per_step", r->flops);
    json_number(json, "fraction_of_peak", f.of_peak);
    json_number(json, "bytes_per_step", r->traffic);
    json_number(json, "fraction_of_bandwidth", f.of_bandwidth);
    json_number(json, "bytes_per_particle", f.bytes / r->particle_count);
    json_number(json, "bytes_per_fluid_particle", f.bytes / r->fluid_count);
    json_integer(json, "state_bytes", (int64_t)r->state_bytes);
    json_integer(json, "list_bytes", (int64_t)r->list_bytes);
    json_integer(json, "plan_bytes", (int64_t)r->plan_bytes);
    json_integer(json, "peak_resident_bytes", (int64_t)r->peak_resident);
}

static void write_machine(Json *json, const BenchReport *r)
{
    const BenchFlops flops = bench_flops();
    json_string(json, "cpu", r->machine.cpu);
    json_integer(json, "threads", r->threads);
    json_string(json, "backend", r->backend);
    json_string(json, "level", r->level);
    json_number(json, "clock_hz", r->clock_median);
    json_number(json, "clock_lowest_hz", r->clock_lowest);
    json_number(json, "clock_highest_hz", r->clock_highest);
    json_number(json, "peak_flops", r->machine.peak);
    json_number(json, "peak_clock_hz", r->machine.peak_clock);
    json_number(json, "bandwidth_bytes_per_second", r->machine.bandwidth);
    json_object(json, "flops_per_pair");
    json_integer(json, "fluid_momentum", flops.fluid_momentum);
    json_integer(json, "fluid_density", flops.fluid_density);
    json_integer(json, "dummy_momentum", flops.dummy_momentum);
    json_integer(json, "dummy_density", flops.dummy_density);
    json_object_end(json);
}

static void print_json(const BenchReport *r, const BenchOptions *options)
{
    Text text = {0};
    Json json = json_begin(&text);
    json_object(&json, NULL);
    json_string(&json, "version", FAIRLEAD_VERSION);
    write_machine(&json, r);
    write_scene(&json, r, options);
    write_speed(&json, r, options);
    json_object_end(&json);
    printf("%s\n", text_string(&text));
    text_destroy(&text);
}

// ---- the command --------------------------------------------------------------------------------

static OptionsResult read_options(int count, char **words, BenchOptions *to, bool *as_json,
                                  Error *error)
{
    const Option options[] = {
        {"--particles", "N", OPTION_INTEGER, false, &to->particles, 1000, 1e8, NULL,
         "particles in all, water and dummies; the spacing follows"},
        {"--smoothing-ratio", "R", OPTION_NUMBER, false, &to->smoothing_ratio, 1.2, 3, NULL,
         "h/dp (default 2.08)"},
        {"--scene", "S", OPTION_TEXT, false, &to->scene, 0, 0, "still|dam|ship",
         "still, dam or ship"},
        {"--steps", "N", OPTION_INTEGER, false, &to->steps, BENCH_GROUPS_LEAST, 1e6, NULL,
         "timed steps"},
        {"--warm-up", "N", OPTION_INTEGER, false, &to->warm_up, 10, 1e6, NULL,
         "steps before the clock starts"},
        {"--threads", "N", OPTION_INTEGER, false, &to->threads, 0, 1024, NULL,
         "threads of the solver; 0 takes all cores"},
        {"--json", NULL, OPTION_SWITCH, false, as_json, 0, 0, NULL, "the same as JSON"},
    };
    OptionTable table = {
        .command = "bench",
        .summary =
            "Time steps of a scene of so many particles and compare with what the machine can do.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .notes = "still: an open tank at rest; dam: a column of water falls in a tank; ship: the "
                 "basin of\n" DEFAULT_CASE ". docs/performance.md explains the figures.",
    };
    return options_parse(&table, count, words, stdout, error);
}

int command_bench(int count, char **words)
{
    BenchOptions options = {
        .scene = "still", .particles = 100000, .smoothing_ratio = 2.08, .warm_up = 10, .steps = 60};
    bool as_json = false;
    Error error = {0};
    OptionsResult result = read_options(count, words, &options, &as_json, &error);
    if (result == OPTIONS_HELP) return EXIT_GOOD;
    if (result == OPTIONS_REFUSED) return report(&error);
    char path[2 * SCENE_PATH_SIZE];
    BenchReport measured;
    options.ship_case = find_default_case(path, sizeof path);
    if (!bench_run(&options, &measured, &error)) return report(&error);
    if (as_json)
        print_json(&measured, &options);
    else
        print_text(&measured, &options);
    return EXIT_GOOD;
}
