#include "session.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "recorder.h"

enum { REQUESTS_MAX = 256, REPLIES_MAX = 1024 };

static const double STATUS_INTERVAL = 0.1;  ///< between copies of the status [s of wall time]
static const double MEASURE_INTERVAL = 1.0; ///< over which speed and shares are taken [s]
static const double FLUSH_INTERVAL = 1.0;   ///< series.csv reaches the disk this often [s]

/// Counters at the beginning of a measuring window; speed and shares are differences.
typedef struct Window {
    double wall, time;
    int64_t step;
    double effect_seconds[EFFECT_COUNT], base_seconds;
} Window;

struct Session {
    const Scene *scene;
    const Plan *plan;
    const SeriesTable *table;
    Wake wake;
    pthread_t thread;
    bool started;
    atomic_bool stop;

    // shared
    Bell bell; ///< rung for the simulation thread: a request, a wanted snapshot, the end
    Queue requests, replies;
    History *history;
    pthread_mutex_t status_mutex;
    SessionStatus status;
    TripleSlot slot;
    Snapshot snapshots[3];
    bool has_snapshot; ///< reader's own: something was taken from the slot
    atomic_bool snapshot_wanted;
    Bell *snapshot_bell;

    // the simulation thread's own
    State *state; ///< NULL when a reset failed
    RunState run_state;
    int recoveries;
    int64_t line_events; ///< told so far
    char failure[768];
    SampleClock clock;
    double *row;
    Recorder recorder;
    char base_folder[SCENE_PATH_SIZE]; ///< of the first run; later ones append -2, -3, …
    int run_number;
    Window window;
    double paced_wall, paced_time; ///< since when a domain of lines keeps to the clock
    double status_at, flushed_at;
    double speed, particle_steps_per_second;
    int share_count;
    EffectShare shares[EFFECT_COUNT + 1];
};

// ---- files --------------------------------------------------------------------------------------

/// A full disk must not end the simulation: say it once and go on without files.
static void give_up_recording(Session *session, const Error *error)
{
    double time = session->state ? session->state->time : 0;
    char text[200];
    snprintf(text, sizeof text, "recording stopped: %.150s", error->message);
    history_add_marker(session->history, time, text);
    fprintf(stderr, "fairlead: %s\n", text);
    recorder_close(&session->recorder, NULL);
}

static void journal(Session *session, const char *line)
{
    Error error;
    if (!recorder_journal(&session->recorder, line, &error)) give_up_recording(session, &error);
}

static bool open_recorder(Session *session, Error *error)
{
    char folder[SCENE_PATH_SIZE + 16];
    session->run_number++;
    if (session->run_number == 1)
        snprintf(folder, sizeof folder, "%s", session->base_folder);
    else
        snprintf(folder, sizeof folder, "%s-%d", session->base_folder, session->run_number);
    char line[4096];
    journal_format_start(session->scene, session->plan, line, sizeof line);
    return recorder_open(&session->recorder, folder, session->table, line, error);
}

/// DATA/case-20260131-235959 (UTC), made unique when two start within a second.
static bool name_folder(Session *session, const char *data_folder, Error *error)
{
    TRY(folder_create(data_folder, error));
    char stamp[32];
    time_t now = time(NULL);
    struct tm utc;
    gmtime_r(&now, &utc);
    strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", &utc);
    for (int i = 0; i < 100; i++) {
        char suffix[8] = "";
        if (i) snprintf(suffix, sizeof suffix, "-%c%c", 'a' + i / 26, 'a' + i % 26);
        int length = snprintf(session->base_folder, sizeof session->base_folder, "%s/%s-%s%s",
                              data_folder, session->scene->name, stamp, suffix);
        if (length >= (int)sizeof session->base_folder - 8)
            return error_set(error, ERROR_INPUT, "--data: the path is too long");
        char probe[SCENE_PATH_SIZE + 16];
        snprintf(probe, sizeof probe, "%s/series.csv", session->base_folder);
        FILE *file = fopen(probe, "r");
        if (!file) return true;
        fclose(file);
    }
    return true;
}

// ---- what others read ---------------------------------------------------------------------------

static void take_sample(Session *session)
{
    State *state = session->state;
    if (!sample_clock_due(&session->clock, state->time)) return;
    series_sample(session->scene, session->plan, state, session->row);
    history_add_row(session->history, session->row);
    Error error;
    if (!recorder_sample(&session->recorder, session->row, session->table->count, &error))
        give_up_recording(session, &error);
    wake(&session->wake);
}

static void publish_snapshot(Session *session)
{
    if (!session->state || !atomic_exchange(&session->snapshot_wanted, false)) return;
    snapshot_take(session->scene, session->plan, session->state,
                  &session->snapshots[session->slot.back]);
    triple_slot_publish(&session->slot);
    if (session->snapshot_bell) bell_ring(session->snapshot_bell);
}

static void begin_window(Session *session, double wall)
{
    const State *state = session->state;
    Window *window = &session->window;
    window->wall = wall;
    window->time = state->time;
    window->step = state->step;
    memcpy(window->effect_seconds, state->effect_seconds, sizeof window->effect_seconds);
    window->base_seconds = state->base_seconds;
}

/// Speed, throughput and each effect's share of a step, over the last second or so.
static void measure(Session *session, double wall)
{
    const State *state = session->state;
    const Window *window = &session->window;
    const Plan *plan = session->plan;
    double elapsed = wall - window->wall;
    int64_t steps = state->step - window->step;
    double particles = (double)plan->fluid_count + plan->wall_count + plan->body_particle_count;
    session->speed = (state->time - window->time) / elapsed;
    session->particle_steps_per_second = (double)steps * particles / elapsed;
    double total = state->base_seconds - window->base_seconds;
    for (int i = 0; i < EFFECT_COUNT; i++)
        total += state->effect_seconds[i] - window->effect_seconds[i];
    if (steps > 0 && total > 0) {
        int count = 0;
        session->shares[count++] = (EffectShare){
            .name = "base", .share = (state->base_seconds - window->base_seconds) / total};
        for (int i = 0; i < EFFECT_COUNT; i++) {
            if (!plan->effects[i].active) continue;
            double seconds = state->effect_seconds[i] - window->effect_seconds[i];
            session->shares[count++] =
                (EffectShare){.name = plan->effects[i].name, .share = seconds / total};
        }
        session->share_count = count;
    }
    begin_window(session, wall);
}

static void fill_from_state(const Session *session, SessionStatus *status)
{
    const State *state = session->state;
    status->time = state->time;
    status->step = state->step;
    status->time_step = state->time_step;
    status->density_error = state->density_error;
    status->health = state->health.status;
    snprintf(status->health_message, sizeof status->health_message, "%s", state->health.message);
    status->line_count = session->scene->line_count;
    for (int l = 0; l < status->line_count; l++)
        status->lines[l] = (LineStatus){.length = state->lines[l].length,
                                        .asked = state->orders[l].length,
                                        .largest = state->lines[l].largest_tension,
                                        .parted = state->lines[l].parted_count > 0};
    WaveKind kind = session->scene->waves.kind;
    if (kind == WAVES_NONE || kind == WAVES_RECORD) return; // nothing to ask for
    status->has_waves = true;
    status->wave_asked = state->waves->asked;
    status->wave_now = waves_now(state->waves, state->time);
    status->wave_changing = state->waves->active || state->waves->has_queued;
}

static void publish_status(Session *session)
{
    bool running = session->run_state == RUN_RUNNING;
    SessionStatus status = {
        .state = session->run_state,
        .speed = running ? session->speed : 0,
        .particle_steps_per_second = running ? session->particle_steps_per_second : 0,
        .share_count = session->share_count,
    };
    memcpy(status.shares, session->shares, sizeof status.shares);
    if (session->state) fill_from_state(session, &status);
    if (session->run_state == RUN_FAILED) {
        status.health = HEALTH_FAILED;
        snprintf(status.health_message, sizeof status.health_message, "%s", session->failure);
    }
    pthread_mutex_lock(&session->status_mutex);
    session->status = status;
    pthread_mutex_unlock(&session->status_mutex);
}

// ---- requests -----------------------------------------------------------------------------------

static void fail(Session *session, const char *message)
{
    double time = session->state ? session->state->time : 0;
    session->run_state = RUN_FAILED;
    snprintf(session->failure, sizeof session->failure, "%s", message);
    history_add_marker(session->history, time, message);
    char line[1024];
    journal_format_health(time, message, line, sizeof line);
    journal(session, line);
    Error error;
    if (!recorder_flush(&session->recorder, &error)) give_up_recording(session, &error);
    publish_status(session);
    wake(&session->wake);
}

static void begin_pace(Session *session)
{
    session->paced_wall = clock_seconds();
    session->paced_time = session->state->time;
}

/// Everything that begins anew with a State: sampling, measuring, health.
static void begin_run(Session *session)
{
    session->clock = (SampleClock){.interval = session->scene->outputs.series_interval};
    session->recoveries = session->state->health.recoveries;
    session->line_events = 0;
    session->failure[0] = 0;
    session->speed = session->particle_steps_per_second = 0;
    session->share_count = 0;
    begin_window(session, clock_seconds());
    begin_pace(session);
    take_sample(session);
    publish_status(session);
}

static bool reset(Session *session, Error *error)
{
    state_destroy(session->state);
    session->state = NULL;
    Error closing;
    if (!recorder_close(&session->recorder, &closing)) give_up_recording(session, &closing);
    history_reset(session->history);
    if (!state_create(session->scene, session->plan, &session->state, error)) {
        session->state = NULL;
        fail(session, error->message);
        return false;
    }
    Error opening;
    if (!open_recorder(session, &opening)) give_up_recording(session, &opening);
    if (session->run_state == RUN_FAILED) session->run_state = RUN_RUNNING;
    history_add_marker(session->history, 0, "reset");
    atomic_store(&session->snapshot_wanted, true);
    begin_run(session);
    return true;
}

static bool carry_out_run(Session *session, RunAction action, Error *error)
{
    if (session->run_state == RUN_FAILED && action != ACTION_RESET)
        return error_set(error, ERROR_INPUT, "the simulation has failed: reset it first");
    switch (action) {
    case ACTION_START:
        session->run_state = RUN_RUNNING;
        begin_window(session, clock_seconds());
        begin_pace(session);
        return true;
    case ACTION_PAUSE:
        session->run_state = RUN_PAUSED;
        return true;
    case ACTION_RESET:
        return reset(session, error);
    }
    return false;
}

/// What a command changes, short enough for a label on a plot: "height 0.2 m, heading 210°".
static void describe_sea(const Command *command, char *text, int size)
{
    int length = 0;
    text[0] = 0;
    if (!isnan(command->wave_height))
        length += snprintf(text + length, (size_t)(size - length), "%sheight %.3g m",
                           length ? ", " : "", command->wave_height);
    if (!isnan(command->wave_period))
        length += snprintf(text + length, (size_t)(size - length), "%speriod %.3g s",
                           length ? ", " : "", command->wave_period);
    if (!isnan(command->wave_heading))
        snprintf(text + length, (size_t)(size - length), "%sheading %.4g°", length ? ", " : "",
                 command->wave_heading * (180.0 / PI));
}

/// The same for a line: "bow line to 5.2 m".
static void describe_order(const Command *command, char *text, int size)
{
    static const char *const places[] = {"anchor", "middle", "fairlead"};
    char name[SCENE_NAME_SIZE];
    snprintf(name, sizeof name, "%s", command->line);
    for (char *c = name; *c; c++)
        if (*c == '_') *c = ' ';
    if (command->line_cut != CUT_NOWHERE)
        snprintf(text, (size_t)size, "%s cut at %s", name, places[command->line_cut]);
    else
        snprintf(text, (size_t)size, "%s to %.4g m", name, command->line_length);
}

static bool carry_out_command(Session *session, const Command *command, Error *error)
{
    State *state = session->state;
    if (session->run_state == RUN_FAILED || !state)
        return error_set(error, ERROR_INPUT, "the simulation has failed: reset it first");
    TRY(state_command(session->scene, state, command, error));
    const WaveTarget *asked = &state->waves->asked;
    if (state->waves->has_queued) asked = &state->waves->queued;
    char line[1024], text[200];
    journal_format_command(state->time, command, asked, line, sizeof line);
    journal(session, line);
    (command->line[0] ? describe_order : describe_sea)(command, text, sizeof text);
    history_add_marker(session->history, state->time, text);
    return true;
}

/// The engine begins its message with the path it is about: "wave.height_m = 9: …".
static void split_path(const char *kind, const Error *error, Refusal *refusal)
{
    size_t length = strcspn(error->message, " :=");
    bool about = !strncmp(error->message, "wave", 4) || !strncmp(error->message, "line", 4);
    bool path = length < sizeof refusal->path && about &&
                (error->message[length] == ':' || error->message[length] == ' ');
    snprintf(refusal->path, sizeof refusal->path, "%.*s", path ? (int)length : (int)strlen(kind),
             path ? error->message : kind);
    snprintf(refusal->message, sizeof refusal->message, "%s", error->message);
}

static void answer_requests(Session *session)
{
    SessionRequest request;
    bool some = false;
    while (queue_take(&session->requests, &request)) {
        Error error = {0};
        bool command = request.kind == REQUEST_COMMAND;
        SessionReply reply = {.client = request.client, .refusal = {.has_id = true}};
        reply.refusal.id = request.id;
        reply.accepted = command ? carry_out_command(session, &request.command, &error)
                                 : carry_out_run(session, request.action, &error);
        reply.time = session->state ? session->state->time : 0;
        const char *kind = !command ? "run.action" : request.command.line[0] ? "line" : "wave";
        if (!reply.accepted) split_path(kind, &error, &reply.refusal);
        queue_put(&session->replies, &reply);
        some = true;
    }
    if (!some) return;
    publish_status(session);
    wake(&session->wake);
}

// ---- the thread ---------------------------------------------------------------------------------

/// Lines without water are many times faster than they are: nobody could watch or steer them.
static void keep_pace(Session *session)
{
    if (session->scene->domain.kind != DOMAIN_LINES) return;
    double elapsed = clock_seconds() - session->paced_wall;
    double ahead = session->state->time - session->paced_time - elapsed;
    if (ahead > 0.005) bell_wait(&session->bell, ahead < STATUS_INTERVAL ? ahead : STATUS_INTERVAL);
}

/// Snaps and breaks of lines since the last look.
static void tell_line_events(Session *session)
{
    const LineEvent *event;
    if (!session->state->events) return;
    while ((event = line_events_next(session->state->events, &session->line_events))) {
        char line[1024], text[200];
        journal_format_line(session->scene, event, line, sizeof line);
        journal(session, line);
        line_event_describe(session->scene, event, text, sizeof text);
        history_add_marker(session->history, event->time, text);
    }
}

static void step(Session *session)
{
    State *state = session->state;
    Error error = {0};
    if (!step_advance(session->scene, session->plan, state, &error)) {
        fail(session, error.message);
        return;
    }
    if (state->health.recoveries != session->recoveries) {
        session->recoveries = state->health.recoveries;
        char line[1024], text[200];
        journal_format_health(state->time, state->health.message, line, sizeof line);
        journal(session, line);
        snprintf(text, sizeof text, "rolled back: %.180s", state->health.message);
        history_add_marker(session->history, state->time, text);
    }
    tell_line_events(session);
    take_sample(session);
    keep_pace(session);
}

static void housekeeping(Session *session)
{
    double now = clock_seconds();
    if (session->state && now - session->window.wall >= MEASURE_INTERVAL) measure(session, now);
    if (now - session->status_at >= STATUS_INTERVAL) {
        session->status_at = now;
        publish_status(session);
    }
    if (now - session->flushed_at >= FLUSH_INTERVAL) {
        session->flushed_at = now;
        Error error;
        if (!recorder_flush(&session->recorder, &error)) give_up_recording(session, &error);
    }
}

static void *session_main(void *argument)
{
    Session *session = argument;
    begin_window(session, clock_seconds());
    while (!atomic_load(&session->stop)) {
        answer_requests(session);
        publish_snapshot(session);
        if (session->run_state == RUN_RUNNING)
            step(session);
        else
            bell_wait(&session->bell, STATUS_INTERVAL);
        housekeeping(session);
    }
    return NULL;
}

// ---- the others' side ---------------------------------------------------------------------------

static bool session_setup(Session *session, const char *data_folder, Error *error)
{
    if (!queue_init(&session->requests, sizeof(SessionRequest), REQUESTS_MAX) ||
        !queue_init(&session->replies, sizeof(SessionReply), REPLIES_MAX) ||
        !(session->history = history_create(session->table->count)) ||
        !(session->row = calloc((size_t)session->table->count, sizeof *session->row)))
        return error_set(error, ERROR_SYSTEM, "no memory left for the session");
    TRY(state_create(session->scene, session->plan, &session->state, error));
    for (int i = 0; i < 3; i++)
        TRY(snapshot_create(session->scene, session->plan, &session->snapshots[i], error));
    TRY(name_folder(session, data_folder, error));
    TRY(open_recorder(session, error));
    atomic_store(&session->snapshot_wanted, true);
    begin_run(session);
    publish_snapshot(session);
    return true;
}

Session *session_create(const Scene *scene, const Plan *plan, const SeriesTable *table,
                        const char *data_folder, Wake to_wake, Error *error)
{
    Session *session = calloc(1, sizeof *session);
    if (!session) {
        error_set(error, ERROR_SYSTEM, "no memory left for the session");
        return NULL;
    }
    session->scene = scene;
    session->plan = plan;
    session->table = table;
    session->wake = to_wake;
    bell_init(&session->bell);
    pthread_mutex_init(&session->status_mutex, NULL);
    triple_slot_init(&session->slot);
    if (!session_setup(session, data_folder, error)) {
        session_destroy(session);
        return NULL;
    }
    return session;
}

bool session_start(Session *session, Error *error)
{
    if (pthread_create(&session->thread, NULL, session_main, session))
        return error_set(error, ERROR_SYSTEM, "cannot start the simulation thread");
    session->started = true;
    return true;
}

void session_stop(Session *session)
{
    atomic_store(&session->stop, true);
    bell_ring(&session->bell);
    if (session->started) pthread_join(session->thread, NULL);
    session->started = false;
    Error error;
    if (!recorder_close(&session->recorder, &error))
        fprintf(stderr, "fairlead: %s\n", error.message);
}

void session_destroy(Session *session)
{
    if (!session) return;
    session_stop(session);
    for (int i = 0; i < 3; i++)
        if (session->snapshots[i].storage) snapshot_destroy(&session->snapshots[i]);
    if (session->state) state_destroy(session->state);
    history_destroy(session->history);
    if (session->requests.items) queue_destroy(&session->requests);
    if (session->replies.items) queue_destroy(&session->replies);
    pthread_mutex_destroy(&session->status_mutex);
    bell_destroy(&session->bell);
    free(session->row);
    free(session);
}

bool session_ask(Session *session, const SessionRequest *request)
{
    bool stored = queue_put(&session->requests, request);
    bell_ring(&session->bell);
    return stored;
}

bool session_next_reply(Session *session, SessionReply *reply)
{
    return queue_take(&session->replies, reply);
}

SessionStatus session_status(Session *session)
{
    pthread_mutex_lock(&session->status_mutex);
    SessionStatus status = session->status;
    pthread_mutex_unlock(&session->status_mutex);
    return status;
}

History *session_history(Session *session) { return session->history; }
const char *session_folder(const Session *session) { return session->base_folder; }

void session_want_snapshot(Session *session)
{
    atomic_store(&session->snapshot_wanted, true);
    bell_ring(&session->bell);
}

void session_set_snapshot_bell(Session *session, Bell *bell) { session->snapshot_bell = bell; }

const Snapshot *session_snapshot(Session *session, bool *fresh)
{
    *fresh = triple_slot_take(&session->slot);
    session->has_snapshot = session->has_snapshot || *fresh;
    return session->has_snapshot ? &session->snapshots[session->slot.front] : NULL;
}
