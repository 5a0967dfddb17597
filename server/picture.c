#include "picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "crew.h"
#include "pace.h"

enum { STILLS_MAX = 16 };
enum { QUALITY_MOVING = 80, QUALITY_REST = 90, QUALITY_LAGGING = 60 };

static const double SNAPSHOT_WAIT = 0.5; ///< look at the world again after this long [s]

struct Pictures {
    Session *session;
    Wake wake;
    pthread_t thread;
    Bell bell;  ///< rung for the render thread
    Bell ready; ///< the GL context is there, or will not be
    atomic_bool stop, wanted, lagging;
    Queue asked, answered; ///< stills

    pthread_mutex_t mutex; ///< of what follows
    ViewOptions view;
    uint64_t view_version;
    Picture *latest;
    double rate, last_at; ///< live frames per second; when the newest came [s]

    // the render thread's own
    Render *render;
    char renderer[256];
    bool available;
    uint64_t drawn_version;
    uint32_t frame_number;
    Crew crew; ///< the render thread and those its OpenGL started
    int cores; ///< shared with the solver
    Pace pace;
    bool unseen; ///< the newest snapshot has not been drawn live
    bool snapshot_asked;
    double snapshot_asked_at;
    double snapshot_latency; ///< from asking to having, the last time [s]
    double still_since;      ///< a still waits for its snapshot since then; 0 = none waits
    char complaint[768];     ///< the last one printed
};

Picture *picture_retain(Picture *picture)
{
    atomic_fetch_add(&picture->references, 1);
    return picture;
}

void picture_release(Picture *picture)
{
    if (picture && atomic_fetch_sub(&picture->references, 1) == 1) free(picture);
}

static Picture *picture_create(const PictureHeader *header, const uint8_t *payload)
{
    size_t size = PICTURE_HEADER_SIZE + header->size;
    Picture *picture = malloc(sizeof *picture + PICTURE_HEADROOM + size);
    if (!picture) return NULL;
    atomic_init(&picture->references, 1);
    picture->number = header->number;
    picture->size = size;
    unsigned char *bytes = picture->bytes + PICTURE_HEADROOM;
    protocol_format_picture_header(header, bytes);
    memcpy(bytes + PICTURE_HEADER_SIZE, payload, header->size);
    return picture;
}

static bool solver_runs(const Pictures *pictures)
{
    return session_status(pictures->session).state == RUN_RUNNING;
}

static void publish(Pictures *pictures, Picture *picture, double now)
{
    pthread_mutex_lock(&pictures->mutex);
    Picture *old = pictures->latest;
    pictures->latest = picture;
    double interval = now - pictures->last_at;
    double gain = pictures->rate <= 0 || interval > 2 ? 1 : 0.2;
    pictures->rate += gain * (1 / maxd(interval, 1e-3) - pictures->rate);
    pictures->last_at = now;
    pthread_mutex_unlock(&pictures->mutex);
    picture_release(old);
    wake(&pictures->wake);
}

static int choose_quality(const Pictures *pictures)
{
    if (!solver_runs(pictures)) return QUALITY_REST;
    return atomic_load(&pictures->lagging) ? QUALITY_LAGGING : QUALITY_MOVING;
}

static Picture *encode(Pictures *pictures, const Snapshot *snapshot, const ViewOptions *view,
                       PictureKind kind, uint32_t number, Error *error)
{
    size_t size = 0;
    if (!render_draw(pictures->render, snapshot, view, error)) return NULL;
    const uint8_t *payload =
        kind == PICTURE_LIVE ? render_jpeg(pictures->render, choose_quality(pictures), &size, error)
                             : render_png(pictures->render, &size, error);
    if (!payload) return NULL;
    PictureHeader header = {.kind = kind,
                            .number = number,
                            .width = view->width,
                            .height = view->height,
                            .time = snapshot->time,
                            .size = size};
    Picture *picture = picture_create(&header, payload);
    if (!picture) error_set(error, ERROR_SYSTEM, "no memory left for a picture");
    return picture;
}

static ViewOptions current_view(Pictures *pictures, uint64_t *version)
{
    pthread_mutex_lock(&pictures->mutex);
    ViewOptions view = pictures->view;
    *version = pictures->view_version;
    pthread_mutex_unlock(&pictures->mutex);
    return view;
}

static void draw_live(Pictures *pictures, const Snapshot *snapshot)
{
    uint64_t version;
    ViewOptions view = current_view(pictures, &version);
    double begin = clock_seconds(), used = crew_seconds(&pictures->crew);
    Error error = {0};
    Picture *picture =
        encode(pictures, snapshot, &view, PICTURE_LIVE, pictures->frame_number + 1, &error);
    pace_drawn(&pictures->pace, begin, crew_seconds(&pictures->crew) - used, pictures->cores,
               solver_runs(pictures));
    pictures->drawn_version = version;
    if (!picture) {
        if (strcmp(pictures->complaint, error.message) != 0)
            fprintf(stderr, "fairlead: no picture: %s\n", error.message);
        snprintf(pictures->complaint, sizeof pictures->complaint, "%s", error.message);
        pictures->pace.begun_at = clock_seconds() + 1; // not thirty times a second
        return;
    }
    pictures->frame_number++;
    publish(pictures, picture, clock_seconds());
}

static void draw_stills(Pictures *pictures, const Snapshot *snapshot)
{
    StillRequest request;
    while (queue_take(&pictures->asked, &request)) {
        uint64_t version;
        ViewOptions view = current_view(pictures, &version);
        view.width = request.width;
        view.height = request.height;
        view.samples = 4;
        StillReply reply = {.client = request.client, .id = request.id};
        Error error = {0};
        reply.picture = encode(pictures, snapshot, &view, PICTURE_STILL, request.id, &error);
        snprintf(reply.message, sizeof reply.message, "%s", error.message);
        if (!queue_put(&pictures->answered, &reply)) picture_release(reply.picture);
        wake(&pictures->wake);
    }
}

/// Ask for the next snapshot, once until it came: the simulation copies only what will be drawn.
static void want_snapshot(Pictures *pictures, double now)
{
    if (pictures->snapshot_asked && now - pictures->snapshot_asked_at < SNAPSHOT_WAIT) return;
    session_want_snapshot(pictures->session);
    pictures->snapshot_asked = true;
    pictures->snapshot_asked_at = now;
}

/// Has the simulation moved on since this snapshot?
static bool is_stale(const Pictures *pictures, const Snapshot *snapshot)
{
    return !snapshot || session_status(pictures->session).time != snapshot->time;
}

/// Stills show the present: they wait for a new snapshot, but not for ever (a step may be long).
static double serve_stills(Pictures *pictures, const Snapshot *snapshot, bool fresh, double now)
{
    if (queue_is_empty(&pictures->asked)) return SNAPSHOT_WAIT;
    if (!pictures->still_since) pictures->still_since = now;
    bool waited = now - pictures->still_since > 4 * SNAPSHOT_WAIT;
    if (snapshot && (fresh || waited || !is_stale(pictures, snapshot))) {
        draw_stills(pictures, snapshot);
        pictures->still_since = 0;
        return SNAPSHOT_WAIT;
    }
    want_snapshot(pictures, now);
    return SNAPSHOT_WAIT / 4;
}

/// Draw a live frame if it is time. @return how long to wait for that otherwise [s]
static double serve_live(Pictures *pictures, const Snapshot *snapshot, double now)
{
    // the very first picture is drawn unasked: it warms the shaders up and waits for the first page
    if (!atomic_load(&pictures->wanted) && pictures->frame_number) return SNAPSHOT_WAIT;
    uint64_t version;
    current_view(pictures, &version);
    bool new_view = version != pictures->drawn_version;
    double next_at = pace_next(&pictures->pace, solver_runs(pictures), new_view);
    double ask_at = next_at - pictures->snapshot_latency;
    if (now < ask_at) return ask_at - now;
    if (!pictures->unseen && is_stale(pictures, snapshot)) want_snapshot(pictures, now);
    if (now < next_at) return next_at - now;
    if (!snapshot || (!pictures->unseen && !new_view)) return SNAPSHOT_WAIT / 4;
    pictures->unseen = false;
    draw_live(pictures, snapshot);
    return 0;
}

/// One turn. @return how long there is nothing to do unless the bell rings [s]
static double turn(Pictures *pictures)
{
    bool fresh;
    double now = clock_seconds();
    const Snapshot *snapshot = session_snapshot(pictures->session, &fresh);
    if (fresh) {
        if (pictures->snapshot_asked)
            pictures->snapshot_latency = mind(now - pictures->snapshot_asked_at, SNAPSHOT_WAIT);
        pictures->snapshot_asked = false;
        pictures->unseen = true;
    }
    double still_wait = serve_stills(pictures, snapshot, fresh, now);
    return mind(still_wait, serve_live(pictures, snapshot, now));
}

static void *pictures_main(void *argument)
{
    Pictures *pictures = argument;
    Error error = {0};
    pictures->cores = core_count();
    crew_stand_back();
    crew_begin(&pictures->crew);
    pictures->render = render_create(&error);
    crew_end(&pictures->crew);
    pictures->available = pictures->render != NULL;
    snprintf(pictures->renderer, sizeof pictures->renderer, "%s%.240s",
             pictures->available ? "" : "none: ",
             pictures->available ? render_description(pictures->render) : error.message);
    bell_ring(&pictures->ready);
    while (pictures->available && !atomic_load(&pictures->stop)) {
        double wait = turn(pictures);
        if (wait > 0) bell_wait(&pictures->bell, wait);
    }
    if (pictures->render) render_destroy(pictures->render);
    return NULL;
}

Pictures *pictures_create(Session *session, const ViewOptions *view, Wake to_wake, Error *error)
{
    Pictures *pictures = calloc(1, sizeof *pictures);
    if (!pictures || !queue_init(&pictures->asked, sizeof(StillRequest), STILLS_MAX) ||
        !queue_init(&pictures->answered, sizeof(StillReply), STILLS_MAX)) {
        error_set(error, ERROR_SYSTEM, "no memory left for pictures");
        free(pictures);
        return NULL;
    }
    pictures->session = session;
    pictures->wake = to_wake;
    pictures->view = *view;
    pictures->view_version = 1;
    bell_init(&pictures->bell);
    bell_init(&pictures->ready);
    pthread_mutex_init(&pictures->mutex, NULL);
    session_set_snapshot_bell(session, &pictures->bell);
    if (pthread_create(&pictures->thread, NULL, pictures_main, pictures)) {
        error_set(error, ERROR_SYSTEM, "cannot start the render thread");
        free(pictures);
        return NULL;
    }
    while (!bell_wait(&pictures->ready, 1)) {
    }
    return pictures;
}

void pictures_stop(Pictures *pictures)
{
    if (atomic_exchange(&pictures->stop, true)) return;
    bell_ring(&pictures->bell);
    pthread_join(pictures->thread, NULL);
}

void pictures_destroy(Pictures *pictures)
{
    if (!pictures) return;
    pictures_stop(pictures);
    StillReply reply;
    while (queue_take(&pictures->answered, &reply))
        picture_release(reply.picture);
    picture_release(pictures->latest);
    queue_destroy(&pictures->asked);
    queue_destroy(&pictures->answered);
    pthread_mutex_destroy(&pictures->mutex);
    bell_destroy(&pictures->bell);
    bell_destroy(&pictures->ready);
    free(pictures);
}

const char *pictures_renderer(const Pictures *pictures) { return pictures->renderer; }
bool pictures_available(const Pictures *pictures) { return pictures->available; }

void pictures_set_view(Pictures *pictures, const ViewOptions *view)
{
    pthread_mutex_lock(&pictures->mutex);
    pictures->view = *view;
    pictures->view_version++;
    pthread_mutex_unlock(&pictures->mutex);
    bell_ring(&pictures->bell);
}

void pictures_set_demand(Pictures *pictures, bool wanted, bool lagging)
{
    atomic_store(&pictures->lagging, lagging);
    if (atomic_exchange(&pictures->wanted, wanted) != wanted && wanted) bell_ring(&pictures->bell);
}

uint32_t pictures_newest(Pictures *pictures)
{
    pthread_mutex_lock(&pictures->mutex);
    uint32_t number = pictures->latest ? pictures->latest->number : 0;
    pthread_mutex_unlock(&pictures->mutex);
    return number;
}

Picture *pictures_latest(Pictures *pictures)
{
    pthread_mutex_lock(&pictures->mutex);
    Picture *picture = pictures->latest ? picture_retain(pictures->latest) : NULL;
    pthread_mutex_unlock(&pictures->mutex);
    return picture;
}

double pictures_rate(Pictures *pictures)
{
    pthread_mutex_lock(&pictures->mutex);
    double rate = clock_seconds() - pictures->last_at < 2 ? pictures->rate : 0;
    pthread_mutex_unlock(&pictures->mutex);
    return rate;
}

bool pictures_ask_still(Pictures *pictures, const StillRequest *request)
{
    bool stored = queue_put(&pictures->asked, request);
    bell_ring(&pictures->bell);
    return stored;
}

bool pictures_next_still(Pictures *pictures, StillReply *reply)
{
    return queue_take(&pictures->answered, reply);
}
