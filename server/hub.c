#include "hub.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROWS_PER_MESSAGE = 512,
    VALUES_PER_MESSAGE = 4096, ///< a message of about 50 kB
    ANSWERS_MAX = 256,         ///< unsent answers before a client counts as abusive
    CLIENT_STILLS_MAX = 4,
};
static const double LAG_LIMIT = 0.5; ///< an acknowledgement later than this lowers the quality [s]

/// An answer that waits to be sent.
typedef struct Answer {
    bool accepted;
    double time;
    Refusal refusal; ///< holds the id in both cases
} Answer;

struct Client {
    Client *next;
    uint64_t number; ///< never used again
    bool greeted;    ///< said hello
    bool hello_due;
    HistoryCursor cursor;
    uint64_t status_seen, view_seen, camera_seen; ///< versions
    uint32_t frame_sent, frame_acknowledged;
    double sent_at, lag; ///< [s]
    unsigned turn;       ///< takes series, status and pictures in turn
    Queue answers;
    Queue stills; ///< Picture *, owned
};

struct Hub {
    HubParts parts;
    ViewOptions view;
    uint64_t view_version, camera_version, status_version;
    SessionStatus status;
    Client *clients;
    int client_count;
    uint64_t next_number;
    Text text;
    double *rows; ///< [rows_most][columns]
    int rows_most;
    double began_at;
};

Hub *hub_create(const HubParts *parts, Error *error)
{
    Hub *hub = calloc(1, sizeof *hub);
    int columns = parts->table->count > 0 ? parts->table->count : 1;
    int rows = VALUES_PER_MESSAGE / columns;
    rows = rows < 1 ? 1 : rows > ROWS_PER_MESSAGE ? ROWS_PER_MESSAGE : rows;
    if (!hub || !(hub->rows = calloc((size_t)rows * (size_t)columns, sizeof *hub->rows))) {
        error_set(error, ERROR_SYSTEM, "no memory left for the server");
        free(hub);
        return NULL;
    }
    hub->parts = *parts;
    hub->view = parts->view;
    hub->rows_most = rows;
    hub->status = session_status(parts->session);
    hub->status_version = hub->view_version = hub->camera_version = 1;
    hub->began_at = clock_seconds();
    return hub;
}

void hub_destroy(Hub *hub)
{
    if (!hub) return;
    ASSERT(!hub->clients);
    text_destroy(&hub->text);
    free(hub->rows);
    free(hub);
}

/// Draw only for those who look: somebody has acknowledged the last picture sent.
static void update_demand(Hub *hub)
{
    bool wanted = false, lagging = false;
    for (const Client *client = hub->clients; client; client = client->next) {
        if (!client->greeted) continue;
        wanted = wanted || client->frame_sent == client->frame_acknowledged;
        lagging = lagging || client->lag > LAG_LIMIT;
    }
    pictures_set_demand(hub->parts.pictures, wanted, lagging);
}

Client *hub_open(Hub *hub)
{
    if (hub->client_count >= HUB_CLIENTS_MAX) return NULL;
    Client *client = calloc(1, sizeof *client);
    if (!client || !queue_init(&client->answers, sizeof(Answer), ANSWERS_MAX) ||
        !queue_init(&client->stills, sizeof(Picture *), CLIENT_STILLS_MAX)) {
        free(client);
        return NULL;
    }
    client->number = ++hub->next_number;
    client->next = hub->clients;
    hub->clients = client;
    hub->client_count++;
    return client;
}

void hub_close(Hub *hub, Client *client)
{
    for (Client **link = &hub->clients; *link; link = &(*link)->next)
        if (*link == client) {
            *link = client->next;
            hub->client_count--;
            break;
        }
    Picture *still;
    while (queue_take(&client->stills, &still))
        picture_release(still);
    queue_destroy(&client->answers);
    queue_destroy(&client->stills);
    free(client);
    update_demand(hub);
}

int hub_client_count(const Hub *hub) { return hub->client_count; }

static Client *find_client(Hub *hub, uint64_t number)
{
    for (Client *client = hub->clients; client; client = client->next)
        if (client->number == number) return client;
    return NULL;
}

// ---- receiving ----------------------------------------------------------------------------------

static bool answer_refused(Client *client, const Refusal *refusal)
{
    Answer answer = {.refusal = *refusal};
    return queue_put(&client->answers, &answer);
}

static bool answer_busy(Client *client, uint32_t id, const char *path, const char *message)
{
    Refusal refusal = {.has_id = true, .id = id};
    snprintf(refusal.path, sizeof refusal.path, "%s", path);
    snprintf(refusal.message, sizeof refusal.message, "%s", message);
    return answer_refused(client, &refusal);
}

static bool receive_hello(Hub *hub, Client *client, const ClientMessage *message)
{
    if (message->protocol != PROTOCOL_VERSION) {
        Refusal refusal = {.path = "hello.protocol"};
        snprintf(refusal.message, sizeof refusal.message,
                 "%u is not accepted: this server speaks %d", message->protocol, PROTOCOL_VERSION);
        return answer_refused(client, &refusal);
    }
    client->greeted = client->hello_due = true;
    client->cursor = history_begin(session_history(hub->parts.session));
    client->status_seen = 0;
    client->view_seen = hub->view_version;
    client->camera_seen = hub->camera_version;
    client->frame_sent = client->frame_acknowledged = 0;
    client->lag = 0;
    return true;
}

static void receive_look(Hub *hub, Client *client, const ClientMessage *message)
{
    protocol_apply_view(message, &hub->view);
    if (message->kind == MESSAGE_VIEW)
        client->view_seen = ++hub->view_version;
    else
        client->camera_seen = ++hub->camera_version;
    pictures_set_view(hub->parts.pictures, &hub->view);
}

static bool receive_request(Hub *hub, Client *client, const ClientMessage *message)
{
    SessionRequest request = {
        .kind = message->kind == MESSAGE_RUN ? REQUEST_RUN : REQUEST_COMMAND,
        .client = client->number,
        .id = message->id,
        .command = message->command,
        .action = (RunAction)message->action,
    };
    if (session_ask(hub->parts.session, &request)) return true;
    const char *type = message->kind == MESSAGE_RUN    ? "run"
                       : message->kind == MESSAGE_LINE ? "line"
                                                       : "wave";
    return answer_busy(client, message->id, type, "too many requests wait already: try again");
}

static bool receive_snapshot(Hub *hub, Client *client, const ClientMessage *message)
{
    StillRequest request = {client->number, message->id, message->width, message->height};
    if (!pictures_available(hub->parts.pictures))
        return answer_busy(client, message->id, "snapshot", pictures_renderer(hub->parts.pictures));
    if (pictures_ask_still(hub->parts.pictures, &request)) return true;
    return answer_busy(client, message->id, "snapshot",
                       "too many pictures wait already: try again");
}

static void receive_ack(Client *client, const ClientMessage *message)
{
    // an acknowledgement of a picture that was never sent gives no credit
    if (message->frame != client->frame_sent) return;
    client->frame_acknowledged = message->frame;
    client->lag = clock_seconds() - client->sent_at;
}

bool hub_receive(Hub *hub, Client *client, const char *text, size_t length)
{
    ClientMessage message;
    Refusal refusal;
    bool good = true;
    if (!protocol_parse(text, length, &message, &refusal)) return answer_refused(client, &refusal);
    if (!client->greeted && message.kind != MESSAGE_HELLO) {
        refusal = (Refusal){.path = "type", .message = "the first message must be hello"};
        return answer_refused(client, &refusal);
    }
    switch (message.kind) {
    case MESSAGE_HELLO:
        good = receive_hello(hub, client, &message);
        break;
    case MESSAGE_ACK:
        receive_ack(client, &message);
        break;
    case MESSAGE_VIEW:
    case MESSAGE_CAMERA:
        receive_look(hub, client, &message);
        break;
    case MESSAGE_WAVE:
    case MESSAGE_LINE:
    case MESSAGE_RUN:
        good = receive_request(hub, client, &message);
        break;
    case MESSAGE_SNAPSHOT:
        good = receive_snapshot(hub, client, &message);
        break;
    }
    update_demand(hub);
    return good;
}

// ---- collecting ---------------------------------------------------------------------------------

void hub_collect(Hub *hub)
{
    SessionReply reply;
    while (session_next_reply(hub->parts.session, &reply)) {
        Client *client = find_client(hub, reply.client);
        Answer answer = {reply.accepted, reply.time, reply.refusal};
        if (client) queue_put(&client->answers, &answer);
    }
    StillReply still;
    while (pictures_next_still(hub->parts.pictures, &still)) {
        Client *client = find_client(hub, still.client);
        if (!client) {
            picture_release(still.picture);
        } else if (!still.picture) {
            answer_busy(client, still.id, "snapshot", still.message);
        } else if (!queue_put(&client->stills, &still.picture)) {
            picture_release(still.picture);
            answer_busy(client, still.id, "snapshot", "too many pictures wait already");
        }
    }
}

void hub_tick(Hub *hub)
{
    hub->status = session_status(hub->parts.session);
    hub->status_version++;
    hub_collect(hub);
    update_demand(hub);
}

// ---- sending ------------------------------------------------------------------------------------

static bool may_send_picture(const Hub *hub, const Client *client)
{
    return client->frame_sent == client->frame_acknowledged &&
           pictures_newest(hub->parts.pictures) > client->frame_sent;
}

bool hub_pending(Hub *hub, Client *client)
{
    if (!queue_is_empty(&client->answers)) return true;
    if (!client->greeted) return false;
    if (client->hello_due || client->status_seen != hub->status_version ||
        client->view_seen != hub->view_version || client->camera_seen != hub->camera_version ||
        !queue_is_empty(&client->stills) || may_send_picture(hub, client))
        return true;
    HistoryPending pending = history_pending(session_history(hub->parts.session), &client->cursor);
    return pending.reset || pending.rows || pending.markers;
}

static bool next_answer(Hub *hub, Client *client)
{
    Answer answer;
    if (!queue_take(&client->answers, &answer)) return false;
    if (answer.accepted)
        protocol_format_accepted(&hub->text, answer.refusal.id, answer.time);
    else
        protocol_format_error(&hub->text, &answer.refusal);
    return true;
}

static bool next_hello(Hub *hub, Client *client)
{
    if (!client->hello_due) return false;
    client->hello_due = false;
    bool pictures = pictures_available(hub->parts.pictures);
    HelloInfo info = {.scene = hub->parts.scene,
                      .plan = hub->parts.plan,
                      .columns = hub->parts.table,
                      .view = &hub->view,
                      .version = FAIRLEAD_VERSION,
                      .renderer = pictures_renderer(hub->parts.pictures),
                      .warning =
                          pictures ? "" : "no pictures: this machine gave no OpenGL context"};
    protocol_format_hello(&hub->text, &info);
    return true;
}

/// Resets come before all that follows them, markers before samples.
static bool next_history(Hub *hub, Client *client)
{
    History *history = session_history(hub->parts.session);
    HistoryPending pending = history_pending(history, &client->cursor);
    if (pending.reset) {
        client->cursor = history_begin(history);
        protocol_format_reset(&hub->text);
        return true;
    }
    Marker marker;
    if (history_read_marker(history, &client->cursor, &marker)) {
        protocol_format_marker(&hub->text, marker.time, marker.text);
        return true;
    }
    int count = history_read_rows(history, &client->cursor, hub->rows, hub->rows_most);
    if (!count) return false;
    protocol_format_series(&hub->text, hub->rows, count, hub->parts.table->count);
    return true;
}

static bool next_status(Hub *hub, Client *client)
{
    if (client->status_seen == hub->status_version) return false;
    client->status_seen = hub->status_version;
    protocol_format_status(&hub->text, &hub->status, pictures_rate(hub->parts.pictures),
                           hub->client_count);
    return true;
}

static bool next_look(Hub *hub, Client *client)
{
    if (client->view_seen != hub->view_version) {
        client->view_seen = hub->view_version;
        protocol_format_view(&hub->text, &hub->view);
        return true;
    }
    if (client->camera_seen != hub->camera_version) {
        client->camera_seen = hub->camera_version;
        protocol_format_camera(&hub->text, &hub->view.camera);
        return true;
    }
    return false;
}

static bool next_picture(Hub *hub, Client *client, Outgoing *message)
{
    Picture *picture = NULL;
    if (!queue_take(&client->stills, &picture)) {
        if (!may_send_picture(hub, client)) return false;
        picture = pictures_latest(hub->parts.pictures);
        if (!picture) return false;
        client->frame_sent = picture->number;
        client->sent_at = clock_seconds();
        update_demand(hub);
    }
    *message = (Outgoing){.binary = true, .picture = picture, .size = picture->size};
    return true;
}

bool hub_next(Hub *hub, Client *client, Outgoing *message)
{
    text_clear(&hub->text);
    bool some = next_answer(hub, client);
    if (!some && client->greeted) {
        some = next_hello(hub, client) || next_look(hub, client);
        // in turn, so that a long history does not hold the picture up, nor the picture the series
        for (int i = 0; i < 3 && !some; i++) {
            unsigned turn = client->turn++ % 3;
            if (turn == 0)
                some = next_status(hub, client);
            else if (turn == 1)
                some = next_history(hub, client);
            else if (next_picture(hub, client, message))
                return true;
        }
    }
    *message = (Outgoing){.text = text_string(&hub->text), .size = hub->text.length};
    return some && !hub->text.failed;
}

void hub_format_health(Hub *hub, Text *text)
{
    static const char *const states[] = {"running", "paused", "failed"};
    SessionStatus status = session_status(hub->parts.session);
    Json json = json_begin(text);
    json_object(&json, NULL);
    json_string(&json, "status", status.state == RUN_FAILED ? "failed" : "ok");
    json_string(&json, "version", FAIRLEAD_VERSION);
    json_string(&json, "case", hub->parts.scene->name);
    json_string(&json, "state", states[status.state]);
    json_number(&json, "time_s", status.time);
    json_number(&json, "uptime_s", clock_seconds() - hub->began_at);
    json_integer(&json, "clients", hub->client_count);
    json_string(&json, "renderer", pictures_renderer(hub->parts.pictures));
    json_object_end(&json);
}
