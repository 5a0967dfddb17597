#include <string.h>

#include "commands.h"
#include "effects.h"
#include "json.h"

static int particle_total(const Plan *plan)
{
    return plan->fluid_count + plan->wall_count + plan->body_particle_count;
}

// ---- for people ---------------------------------------------------------------------------------

static void format_bytes(double bytes, char *text, size_t size)
{
    static const char *const units[] = {"B", "kB", "MB", "GB", "TB"};
    int unit = 0;
    for (; bytes >= 1000 && unit < 4; unit++)
        bytes /= 1000;
    snprintf(text, size, unit ? "%.3g %s" : "%.0f %s", bytes, units[unit]);
}

static void print_effects(const Plan *plan, bool active)
{
    char bytes[32];
    printf(active ? "\nEffects that take part\n" : "\nEffects that are left out\n");
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const EffectPlan *effect = &plan->effects[i];
        if (effect->active != active) continue;
        const char *kind = effect->kind == EFFECT_PAIR ? "pair" : "pass";
        if (!active) {
            printf("  %-20s %-4s off because %s; called for by %s\n", effect->name, kind,
                   effect->because, effect->called_by);
            continue;
        }
        format_bytes((double)effect->bytes, bytes, sizeof bytes);
        printf("  %-20s %-4s on because %s\n", effect->name, kind, effect->because);
        printf("  %-20s      %s: %s\n", "", bytes, effect->arrays);
        if (isfinite(effect->step_limit))
            printf("  %-20s      stable up to a step of %.3g s: %s\n", "", effect->step_limit,
                   effect->step);
        printf("  %-20s      %s\n", "", effect->source);
    }
}

static void print_numerics(const Scene *scene, const Plan *plan)
{
    char bytes[32];
    format_bytes((double)plan->bytes, bytes, sizeof bytes);
    printf("\nParticles             %d: %d fluid, %d wall, %d body\n", particle_total(plan),
           plan->fluid_count, plan->wall_count, plan->body_particle_count);
    printf("Spacing, h            %.4g m, %.4g m\n", scene->fluid.spacing, plan->smoothing_length);
    printf("Particle mass         %.4g kg\n", plan->particle_mass);
    printf("Memory of the state   %s (%.0f B per particle)\n", bytes,
           (double)plan->bytes / (particle_total(plan) > 0 ? particle_total(plan) : 1));
    printf("Sound speed           %.4g m/s: %s\n", plan->sound_speed, plan->sound_speed_because);
    printf("Time step             %.4g s: %s\n", plan->time_step, plan->time_step_limit);
    printf("Backend               %s, %s, %d threads\n", plan->backend, plan->variant,
           plan->options.threads);
    if (plan->zone_width > 0) printf("Relaxation zone       %.3g m\n", plan->zone_width);
}

static void print_body(const BodyScene *body, const BodyPlan *plan)
{
    const Hydrostatics *h = &plan->geometry.hydrostatics;
    printf("\nBody %s\n", body->name);
    printf("  mass %.6g kg, centre of gravity (%.4g, %.4g, %.4g) m, %d particles\n",
           plan->geometry.mass, plan->geometry.centre_of_gravity.x,
           plan->geometry.centre_of_gravity.y, plan->geometry.centre_of_gravity.z,
           plan->particle_count);
    if (!plan->geometry.floats) {
        printf("  does not reach into the water\n");
        return;
    }
    printf("  draft %.4g m, displaced %.6g m^3, centre of buoyancy (%.4g, %.4g, %.4g) m\n",
           h->draft, h->displacement, h->centre_of_buoyancy.x, h->centre_of_buoyancy.y,
           h->centre_of_buoyancy.z);
    printf("  waterplane %.5g m^2, GM transverse %.4g m, longitudinal %.4g m\n", h->waterplane_area,
           h->gm_transverse, h->gm_longitudinal);
    printf("  natural periods without added mass: heave %.3g s, roll %.3g s, pitch %.3g s\n",
           h->heave_period, h->roll_period, h->pitch_period);
}

static void print_line(const LineScene *line, const LinePlan *plan)
{
    const LineStatics *s = &plan->statics;
    printf("\nLine %s\n", line->name);
    printf("  span %.4g m, unstretched %.4g m, stretched %.6g m, on the bed %.4g m\n", s->span,
           s->reach, s->stretched_length, s->touchdown);
    printf("  tension at rest: fairlead %.4g N, anchor %.4g N, horizontal %.4g N\n",
           s->fairlead_tension, s->anchor_tension, s->horizontal_force);
}

static void print_text(const Scene *scene, const Plan *plan, const char *prediction)
{
    char waves[256];
    printf("Case %s: %s (%016llx)\n", scene->name, scene->title, (unsigned long long)scene->hash);
    if (scene->waves.kind != WAVES_NONE) {
        waves_tell(scene, waves, sizeof waves);
        printf("Waves                 %s\n", waves);
    }
    print_numerics(scene, plan);
    print_effects(plan, true);
    print_effects(plan, false);
    for (int i = 0; i < scene->body_count; i++)
        print_body(&scene->bodies[i], &plan->bodies[i]);
    for (int i = 0; i < scene->line_count; i++)
        print_line(&scene->lines[i], &plan->lines[i]);
    if (scene->notes[0]) printf("\nNotes                 %s\n", scene->notes);
    if (plan->warnings[0]) printf("\nWarnings              %s\n", plan->warnings);
    printf("\nPredicted             %s\n", prediction);
}

// ---- for programs -------------------------------------------------------------------------------

static void write_bodies(Json *json, const Scene *scene, const Plan *plan)
{
    json_array(json, "bodies");
    for (int i = 0; i < scene->body_count; i++) {
        const BodyGeometry *geometry = &plan->bodies[i].geometry;
        const Hydrostatics *h = &geometry->hydrostatics;
        json_object(json, NULL);
        json_string(json, "name", scene->bodies[i].name);
        json_integer(json, "particles", plan->bodies[i].particle_count);
        json_bool(json, "floats", geometry->floats);
        json_number(json, "mass_kg", geometry->mass);
        json_vector(json, "centre_of_gravity_m", geometry->centre_of_gravity);
        json_number(json, "draft_m", h->draft);
        json_number(json, "displacement_m3", h->displacement);
        json_vector(json, "centre_of_buoyancy_m", h->centre_of_buoyancy);
        json_number(json, "waterplane_area_m2", h->waterplane_area);
        json_number(json, "gm_transverse_m", h->gm_transverse);
        json_number(json, "gm_longitudinal_m", h->gm_longitudinal);
        json_number(json, "heave_period_s", h->heave_period);
        json_number(json, "roll_period_s", h->roll_period);
        json_number(json, "pitch_period_s", h->pitch_period);
        json_object_end(json);
    }
    json_array_end(json);
}

static void write_lines(Json *json, const Scene *scene, const Plan *plan)
{
    json_array(json, "lines");
    for (int i = 0; i < scene->line_count; i++) {
        const LineStatics *s = &plan->lines[i].statics;
        json_object(json, NULL);
        json_string(json, "name", scene->lines[i].name);
        json_number(json, "span_m", s->span);
        json_number(json, "unstretched_m", s->reach);
        json_number(json, "stretched_m", s->stretched_length);
        json_number(json, "touchdown_m", s->touchdown);
        json_number(json, "fairlead_tension_n", s->fairlead_tension);
        json_number(json, "anchor_tension_n", s->anchor_tension);
        json_number(json, "horizontal_force_n", s->horizontal_force);
        json_object_end(json);
    }
    json_array_end(json);
}

static void print_json(const Scene *scene, const Plan *plan)
{
    Text text = {0};
    char hash[20];
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)scene->hash);
    Json json = json_begin(&text);
    json_object(&json, NULL);
    json_string(&json, "version", FAIRLEAD_VERSION);
    json_string(&json, "case", scene->name);
    json_string(&json, "title", scene->title);
    json_string(&json, "case_hash", hash);
    json_string(&json, "backend", plan->backend);
    json_string(&json, "variant", plan->variant);
    json_integer(&json, "threads", plan->options.threads);
    json_integer(&json, "particles", particle_total(plan));
    json_integer(&json, "fluid_particles", plan->fluid_count);
    json_integer(&json, "wall_particles", plan->wall_count);
    json_integer(&json, "body_particles", plan->body_particle_count);
    json_integer(&json, "bytes", (int64_t)plan->bytes);
    json_number(&json, "spacing_m", scene->fluid.spacing);
    json_number(&json, "smoothing_length_m", plan->smoothing_length);
    json_number(&json, "sound_speed_m_s", plan->sound_speed);
    json_string(&json, "sound_speed_because", plan->sound_speed_because);
    json_number(&json, "time_step_s", plan->time_step);
    json_string(&json, "time_step_limit", plan->time_step_limit);
    json_number(&json, "zone_width_m", plan->zone_width);
    if (scene->waves.kind != WAVES_NONE) {
        char waves[256];
        waves_tell(scene, waves, sizeof waves);
        json_string(&json, "waves", waves);
    }
    json_number(&json, "seconds_per_simulated_second", plan->predicted_slowness);
    effects_write(&json, plan);
    write_bodies(&json, scene, plan);
    write_lines(&json, scene, plan);
    json_string(&json, "notes", scene->notes);
    json_string(&json, "warnings", plan->warnings);
    json_object_end(&json);
    printf("%s\n", text_string(&text));
    text_destroy(&text);
}

int command_explain(int count, char **words)
{
    const char *path = NULL;
    bool as_json = false;
    OptionList overrides = {0};
    const Option options[] = {
        {"--set", "path=value", OPTION_LIST, false, &overrides, 0, 0, NULL,
         "change a value of the case, such as waves.height_m=0.2"},
        {"--json", NULL, OPTION_SWITCH, false, &as_json, 0, 0, NULL, "the same as JSON"},
    };
    OptionTable table = {
        .command = "explain",
        .summary = "Say what a case would simulate: effects, particles, memory, time step, "
                   "hydrostatics, lines, speed.",
        .positional = "CASE",
        .positional_required = true,
        .positional_value = &path,
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    Error error = {0};
    OptionsResult result = options_parse(&table, count, words, stdout, &error);
    if (result == OPTIONS_HELP) return EXIT_GOOD;
    if (result == OPTIONS_REFUSED) return report(&error);
    Prepared prepared;
    EngineOptions engine = {.backend = "auto"};
    if (!prepare(path, &overrides, &engine, &prepared, &error)) return report(&error);
    char prediction[900];
    if (plan_predict(prepared.scene, prepared.plan, &error))
        snprintf(prediction, sizeof prediction, "%.4g s of this machine per simulated second",
                 prepared.plan->predicted_slowness);
    else
        snprintf(prediction, sizeof prediction, "not measured: %s", error.message);
    if (as_json)
        print_json(prepared.scene, prepared.plan);
    else
        print_text(prepared.scene, prepared.plan, prediction);
    prepared_destroy(&prepared);
    return EXIT_GOOD;
}
