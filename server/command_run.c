#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "interrupt.h"
#include "line_files.h"
#include "mailbox.h"
#include "progress.h"
#include "protocol.h"
#include "recorder.h"
#include "replay.h"
#include "summary.h"

typedef struct RunOptions {
    const char *path, *out, *backend, *commands;
    double until, frames, lines_every;
    int threads;
    bool quiet;
    OptionList overrides;
} RunOptions;

/// Everything a headless run holds.
typedef struct Run {
    const RunOptions *options;
    Prepared prepared;
    State *state;
    Recorder recorder;
    SampleClock clock, frame_clock, line_clock;
    LineFiles line_files;
    double *row;
    Replay replay;
    Render *render; ///< NULL without --frames
    Snapshot snapshot;
    ViewOptions view;
    int frame_count;
    int recoveries;
    int64_t line_events; ///< told so far
    double wall;
} Run;

static OptionsResult read_options(int count, char **words, RunOptions *to, Error *error)
{
    const Option options[] = {
        {"--until", "SECONDS", OPTION_NUMBER, true, &to->until, 1e-9, 1e9, NULL,
         "simulated time at the end"},
        {"--out", "DIR", OPTION_TEXT, true, &to->out, 0, 0, NULL,
         "folder for series.csv, summary.json, journal.jsonl"},
        {"--set", "path=value", OPTION_LIST, false, &to->overrides, 0, 0, NULL,
         "change a value of the case, such as waves.height_m=0.2"},
        {"--frames", "FPS", OPTION_NUMBER, false, &to->frames, 1e-6, 1e4, NULL,
         "also write PNG frames, so many per simulated second"},
        {"--lines-every", "SECONDS", OPTION_NUMBER, false, &to->lines_every, 1e-6, 1e6, NULL,
         "also write shapes and tensions of lines (lines.csv, lines/*.vtk) at this interval"},
        {"--threads", "N", OPTION_INTEGER, false, &to->threads, 0, 1024, NULL,
         "threads of the solver; 0 takes all cores"},
        {"--backend", "B", OPTION_TEXT, false, &to->backend, 0, 0, "auto|cpu|cuda",
         "auto, cpu or cuda"},
        {"--commands", "FILE", OPTION_TEXT, false, &to->commands, 0, 0, NULL,
         "replay the commands of a journal.jsonl at their simulated times"},
        {"--quiet", NULL, OPTION_SWITCH, false, &to->quiet, 0, 0, NULL, "print nothing but errors"},
    };
    OptionTable table = {
        .command = "run",
        .summary = "Simulate a case without a page and write what happened to a folder.",
        .positional = "CASE",
        .positional_required = true,
        .positional_value = &to->path,
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .notes = "A line of a commands file, as a journal has it:\n"
                 "  {\"event\":\"command\",\"time_s\":30,\"wave\":{\"heading_deg\":60}}\n"
                 "Exit codes: 0 good, 2 bad input, 3 physics that could not be recovered.",
    };
    return options_parse(&table, count, words, stdout, error);
}

static bool write_frame(Run *run, Error *error)
{
    size_t size;
    snapshot_take(run->prepared.scene, run->prepared.plan, run->state, &run->snapshot);
    TRY(render_draw(run->render, &run->snapshot, &run->view, error));
    const uint8_t *png = render_png(run->render, &size, error);
    if (!png) return false;
    char path[SCENE_PATH_SIZE + 40];
    snprintf(path, sizeof path, "%s/frames/frame_%06d.png", run->options->out, ++run->frame_count);
    FILE *file = fopen(path, "wb");
    bool good = file && fwrite(png, 1, size, file) == size;
    if (file && fclose(file)) good = false;
    return good || error_set(error, ERROR_SYSTEM, "%s: cannot write: %s", path, strerror(errno));
}

/// What is due at the present time: a sample, a frame.
static bool record(Run *run, Error *error)
{
    const Scene *scene = run->prepared.scene;
    if (sample_clock_due(&run->clock, run->state->time)) {
        series_sample(scene, run->prepared.plan, run->state, run->row);
        TRY(recorder_sample(&run->recorder, run->row, run->prepared.table->count, error));
    }
    if (run->line_files.table && sample_clock_due(&run->line_clock, run->state->time))
        TRY(line_files_write(&run->line_files, scene, run->state, error));
    if (run->render && sample_clock_due(&run->frame_clock, run->state->time))
        TRY(write_frame(run, error));
    return true;
}

static bool apply_commands(Run *run, Error *error)
{
    State *state = run->state;
    const JournalCommand *due;
    while ((due = replay_next(&run->replay, state->time, state->time_step))) {
        Error reason = {0};
        if (!state_command(run->prepared.scene, state, &due->command, &reason))
            return error_set(error, reason.code, "%.200s: command at %.9g s: %.500s",
                             run->options->commands, due->time, reason.message);
        char line[1024];
        journal_format_command(state->time, &due->command, &state->waves->asked, line, sizeof line);
        TRY(recorder_journal(&run->recorder, line, error));
    }
    return true;
}

static bool journal_health(Run *run, const char *message, Error *error)
{
    char line[1024];
    journal_format_health(run->state->time, message, line, sizeof line);
    return recorder_journal(&run->recorder, line, error);
}

static bool journal_line_events(Run *run, Error *error)
{
    const LineEvent *event;
    if (!run->state->events) return true;
    while ((event = line_events_next(run->state->events, &run->line_events))) {
        char line[1024];
        journal_format_line(run->prepared.scene, event, line, sizeof line);
        TRY(recorder_journal(&run->recorder, line, error));
    }
    return true;
}

static bool run_setup(Run *run, Error *error)
{
    const RunOptions *options = run->options;
    const Prepared *prepared = &run->prepared;
    if (options->commands) TRY(replay_load(options->commands, &run->replay, error));
    char line[4096];
    journal_format_start(prepared->scene, prepared->plan, line, sizeof line);
    TRY(recorder_open(&run->recorder, options->out, prepared->table, line, error));
    run->row = calloc((size_t)prepared->table->count + 1, sizeof *run->row);
    if (!run->row) return error_set(error, ERROR_SYSTEM, "no memory left for a sample");
    run->clock.interval = prepared->scene->outputs.series_interval;
    TRY(state_create(prepared->scene, prepared->plan, &run->state, error));
    run->line_clock.interval =
        options->lines_every > 0 ? options->lines_every : prepared->scene->outputs.lines_interval;
    if (run->line_clock.interval > 0 && prepared->scene->line_count)
        TRY(line_files_open(&run->line_files, options->out, error));
    if (!(options->frames > 0)) return true;
    char folder[SCENE_PATH_SIZE];
    snprintf(folder, sizeof folder, "%s/frames", options->out);
    TRY(folder_create(folder, error));
    run->frame_clock.interval = 1 / options->frames;
    run->view = view_options_default();
    run->view.width = 1280;
    run->view.height = 720;
    run->view.samples = 4;
    run->view.overlay = true;
    run->view.camera = camera_for_scene(prepared->scene);
    TRY(snapshot_create(prepared->scene, prepared->plan, &run->snapshot, error));
    run->render = render_create(error);
    return run->render != NULL;
}

/// Step until the end, a signal or a failure. @return false with `error` set
static bool run_loop(Run *run, RunExit *how, Error *error)
{
    const Prepared *prepared = &run->prepared;
    Progress progress = progress_begin(stdout, run->options->quiet, run->options->until);
    bool good = record(run, error);
    while (good && run->state->time < run->options->until && !interrupt_came) {
        good = apply_commands(run, error) &&
               step_advance(prepared->scene, prepared->plan, run->state, error);
        if (good && run->state->health.recoveries != run->recoveries) {
            run->recoveries = run->state->health.recoveries;
            good = journal_health(run, run->state->health.message, error);
        }
        good = good && journal_line_events(run, error) && record(run, error);
        progress_update(&progress, run->state->time, run->state->step);
    }
    run->wall = clock_seconds() - progress.began_at;
    progress_end(&progress, run->state->time, run->state->step);
    *how = !good && error->code == ERROR_PHYSICS ? EXIT_BY_PHYSICS
           : !good                               ? EXIT_BY_ERROR
           : interrupt_came                      ? EXIT_BY_SIGNAL
                                                 : EXIT_BY_TIME;
    if (*how == EXIT_BY_PHYSICS) journal_health(run, error->message, NULL);
    return good;
}

/// The run itself and its summary, which is written however the run ended.
static int run_case(Run *run, Error *error)
{
    if (!run_setup(run, error)) return report(error);
    RunExit how;
    bool good = run_loop(run, &how, error);
    SummaryInfo info = {.scene = run->prepared.scene,
                        .plan = run->prepared.plan,
                        .state = run->state,
                        .wall = run->wall,
                        .how = how,
                        .message = good ? "" : error->message,
                        .frame_count = run->frame_count};
    Error closing = {0};
    bool written = recorder_close(&run->recorder, &closing) &&
                   line_files_close(&run->line_files, &closing) &&
                   summary_write(run->options->out, &info, &closing);
    if (!good) return report(error);
    if (!written) return report(&closing);
    return how == EXIT_BY_SIGNAL ? EXIT_INTERRUPTED : EXIT_GOOD;
}

int command_run(int count, char **words)
{
    RunOptions options = {.backend = "auto"};
    Run run = {.options = &options};
    Error error = {0};
    OptionsResult result = read_options(count, words, &options, &error);
    if (result == OPTIONS_HELP) return EXIT_GOOD;
    if (result == OPTIONS_REFUSED) return report(&error);
    EngineOptions engine = {
        .threads = options.threads, .backend = options.backend, .pictures = options.frames > 0};
    if (!prepare(options.path, &options.overrides, &engine, &run.prepared, &error))
        return report(&error);
    interrupt_catch();
    int code = run_case(&run, &error);
    recorder_close(&run.recorder, NULL);
    line_files_close(&run.line_files, NULL);
    if (run.render) render_destroy(run.render);
    if (run.snapshot.storage) snapshot_destroy(&run.snapshot);
    if (run.state) state_destroy(run.state);
    replay_destroy(&run.replay);
    free(run.row);
    prepared_destroy(&run.prepared);
    return code;
}
