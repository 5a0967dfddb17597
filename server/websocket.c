#include "websocket.h"

#include <arpa/inet.h>
#include <errno.h>
#include <libwebsockets.h>
#include <netinet/tcp.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "origin.h"

_Static_assert(PICTURE_HEADROOM >= LWS_PRE, "pictures leave room for the frame header");

enum {
    TICK_MS = 200,         ///< between status messages
    STALL_LIMIT_S = 30,    ///< a client that takes nothing for so long is let go
    GREETING_LIMIT_S = 15, ///< a client must say hello within
    NOT_SENT_LIMIT =
        131072, ///< bytes the kernel may hold unsent: keeps pictures young on slow links
    CONNECTIONS_MAX = 192,
};

/// libwebsockets keeps one per WebSocket connection.
typedef struct Connection {
    struct Connection *next;
    struct lws *wsi;
    Client *client;
    Text incoming;        ///< a message in pieces
    double opened_at;     ///< [s]
    double waiting_since; ///< asked to write since then [s]; 0 = not waiting
    bool heard;           ///< has sent something
} Connection;

/// And one per HTTP request.
typedef struct HttpRequest {
    Text body;
} HttpRequest;

struct WebServer {
    struct lws_context *context;
    struct lws_vhost *vhost;
    lws_sorted_usec_list_t tick;
    Hub *hub;
    Connection *connections;
    atomic_bool woken;
    bool local; ///< bound to loopback
    bool has_page;
    struct lws_http_mount mounts[2];
    unsigned char *buffer; ///< [LWS_PRE + buffer_size], for text on its way
    size_t buffer_size;
};

static WebServer *server_of(struct lws *wsi) { return lws_context_user(lws_get_context(wsi)); }

// ---- HTTP ---------------------------------------------------------------------------------------

static const char NO_PAGE[] =
    "<!doctype html><meta charset=utf-8><title>Fairlead</title><h1>Fairlead</h1><p>The server "
    "runs, "
    "but its page has not been built: call <code>./fairlead build</code> and start again.</p>";

static int http_respond(struct lws *wsi, HttpRequest *request, unsigned status, const char *type)
{
    unsigned char head[LWS_PRE + 2048], *start = head + LWS_PRE, *at = start;
    unsigned char *end = head + sizeof head - 1;
    if (lws_add_http_common_headers(wsi, status, type, request->body.length, &at, end) ||
        lws_add_http_header_by_name(wsi, (const unsigned char *)"cache-control:",
                                    (const unsigned char *)"no-store", 8, &at, end) ||
        lws_finalize_write_http_header(wsi, start, &at, end))
        return -1;
    lws_callback_on_writable(wsi);
    return 0;
}

static int http_begin(WebServer *server, struct lws *wsi, HttpRequest *request)
{
    char path[64] = "";
    text_clear(&request->body);
    lws_hdr_copy(wsi, path, sizeof path, WSI_TOKEN_GET_URI);
    if (!strcmp(path, "/health")) {
        hub_format_health(server->hub, &request->body);
        return http_respond(wsi, request, HTTP_STATUS_OK, "application/json");
    }
    if (!strcmp(path, "/") && !server->has_page) {
        text_print(&request->body, "%s", NO_PAGE);
        return http_respond(wsi, request, HTTP_STATUS_OK, "text/html");
    }
    text_print(&request->body, "not found\n");
    return http_respond(wsi, request, HTTP_STATUS_NOT_FOUND, "text/plain");
}

static int http_write(WebServer *server, struct lws *wsi, HttpRequest *request)
{
    size_t length = request->body.length;
    unsigned char *bytes = malloc(LWS_PRE + length + 1);
    if (!bytes) return -1;
    memcpy(bytes + LWS_PRE, text_string(&request->body), length);
    int written = lws_write(wsi, bytes + LWS_PRE, length, LWS_WRITE_HTTP_FINAL);
    free(bytes);
    text_destroy(&request->body); // the next request on this connection begins with new user data
    return written != (int)length || lws_http_transaction_completed(wsi) ? -1 : 0;
}

/// protocols[0]: plain HTTP. Sockets that name no sub-protocol land here and are refused.
static int http_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                         size_t length)
{
    switch (reason) {
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        lws_return_http_status(wsi, HTTP_STATUS_FORBIDDEN, "sub-protocol fairlead expected");
        return -1;
    case LWS_CALLBACK_ESTABLISHED:
        return -1;
    case LWS_CALLBACK_FILTER_HTTP_CONNECTION:
        // nothing here takes a body, and a chunked one would hang
        return lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) > 0 ||
                       lws_hdr_total_length(wsi, WSI_TOKEN_HEAD_URI) > 0
                   ? 0
                   : -1;
    case LWS_CALLBACK_HTTP:
        return http_begin(server_of(wsi), wsi, user);
    case LWS_CALLBACK_HTTP_WRITEABLE:
        return user && ((HttpRequest *)user)->body.length ? http_write(server_of(wsi), wsi, user)
                                                          : 0;
    case LWS_CALLBACK_CLOSED_HTTP:
        if (user) text_destroy(&((HttpRequest *)user)->body);
        return 0;
    default:
        // among others it ends a file's transaction, so that the connection serves the next request
        return lws_callback_http_dummy(wsi, reason, user, in, length);
    }
}

// ---- the socket ---------------------------------------------------------------------------------

static bool header_is(struct lws *wsi, enum lws_token_indexes token, const char *value)
{
    char found[64] = "";
    return lws_hdr_copy(wsi, found, sizeof found, token) > 0 && !strcmp(found, value);
}

/// Same origin, right path; a client that is no browser sends no Origin and needs the sub-protocol,
/// which lws has checked by choosing this callback.
static bool may_connect(const WebServer *server, struct lws *wsi)
{
    char origin[300] = "", host[300] = "";
    if (!header_is(wsi, WSI_TOKEN_GET_URI, "/ws")) return false;
    if (lws_hdr_copy(wsi, host, sizeof host, WSI_TOKEN_HOST) <= 0) return false;
    if (server->local && !host_is_loopback(host)) return false;
    if (!lws_hdr_total_length(wsi, WSI_TOKEN_ORIGIN)) return true;
    if (lws_hdr_copy(wsi, origin, sizeof origin, WSI_TOKEN_ORIGIN) <= 0) return false;
    return origin_matches_host(origin, host);
}

static void ask_to_write(WebServer *server, Connection *connection)
{
    if (!connection->client || !hub_pending(server->hub, connection->client)) return;
    if (!connection->waiting_since) connection->waiting_since = clock_seconds();
    lws_callback_on_writable(connection->wsi);
}

static int socket_open(WebServer *server, struct lws *wsi, Connection *connection)
{
    int unsent = NOT_SENT_LIMIT;
    setsockopt(lws_get_socket_fd(wsi), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof unsent);
    *connection = (Connection){.wsi = wsi, .opened_at = clock_seconds()};
    connection->client = hub_open(server->hub);
    if (!connection->client) {
        static char busy[] = "too many clients";
        lws_close_reason(wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION, (unsigned char *)busy,
                         sizeof busy - 1);
        return -1;
    }
    connection->next = server->connections;
    server->connections = connection;
    return 0;
}

/// May come without a socket_open before it.
static void socket_closed(WebServer *server, Connection *connection)
{
    if (!connection || !connection->client) return;
    for (Connection **link = &server->connections; *link; link = &(*link)->next)
        if (*link == connection) {
            *link = connection->next;
            break;
        }
    hub_close(server->hub, connection->client);
    connection->client = NULL;
    text_destroy(&connection->incoming);
}

static int socket_refuse(struct lws *wsi, enum lws_close_status status, const char *why)
{
    char words[64];
    snprintf(words, sizeof words, "%s", why);
    lws_close_reason(wsi, status, (unsigned char *)words, strlen(words));
    return -1;
}

static int socket_receive(WebServer *server, struct lws *wsi, Connection *connection,
                          const char *bytes, size_t length)
{
    if (!connection->client) return -1;
    if (lws_frame_is_binary(wsi))
        return socket_refuse(wsi, LWS_CLOSE_STATUS_UNACCEPTABLE_OPCODE, "text only");
    if (connection->incoming.length + length > MESSAGE_SIZE_MAX)
        return socket_refuse(wsi, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, "64 kB at most");
    text_append(&connection->incoming, bytes, length);
    if (!lws_is_final_fragment(wsi) || lws_remaining_packet_payload(wsi)) return 0;
    connection->heard = true;
    bool good = hub_receive(server->hub, connection->client, text_string(&connection->incoming),
                            connection->incoming.length);
    text_clear(&connection->incoming);
    if (!good) return socket_refuse(wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION, "too many messages");
    // a view, an acknowledgement or a greeting may concern the others too
    for (Connection *other = server->connections; other; other = other->next)
        ask_to_write(server, other);
    return 0;
}

static bool write_text(WebServer *server, struct lws *wsi, const Outgoing *message)
{
    if (message->size > server->buffer_size) {
        unsigned char *buffer = realloc(server->buffer, LWS_PRE + message->size);
        if (!buffer) return false;
        server->buffer = buffer;
        server->buffer_size = message->size;
    }
    memcpy(server->buffer + LWS_PRE, message->text, message->size);
    return lws_write(wsi, server->buffer + LWS_PRE, message->size, LWS_WRITE_TEXT) >= 0;
}

/// One message per turn: libwebsockets wants one lws_write per WRITEABLE.
static int socket_write(WebServer *server, struct lws *wsi, Connection *connection)
{
    Outgoing message;
    connection->waiting_since = 0;
    if (!connection->client || !hub_next(server->hub, connection->client, &message)) return 0;
    bool good;
    if (message.binary) {
        good = lws_write(wsi, message.picture->bytes + PICTURE_HEADROOM, message.size,
                         LWS_WRITE_BINARY) >= 0;
        picture_release(message.picture);
    } else {
        good = write_text(server, wsi, &message);
    }
    ask_to_write(server, connection);
    return good ? 0 : -1;
}

static void serve_wake(WebServer *server)
{
    if (!server || !server->hub || !atomic_exchange(&server->woken, false)) return;
    hub_collect(server->hub);
    for (Connection *connection = server->connections; connection; connection = connection->next)
        ask_to_write(server, connection);
}

static int socket_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                           size_t length)
{
    WebServer *server = server_of(wsi);
    switch (reason) {
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        if (may_connect(server, wsi)) return 0;
        lws_return_http_status(wsi, HTTP_STATUS_FORBIDDEN, "other origin");
        return -1;
    case LWS_CALLBACK_ESTABLISHED:
        return socket_open(server, wsi, user);
    case LWS_CALLBACK_CLOSED:
        socket_closed(server, user);
        return 0;
    case LWS_CALLBACK_RECEIVE:
        return socket_receive(server, wsi, user, in, length);
    case LWS_CALLBACK_SERVER_WRITEABLE:
        return socket_write(server, wsi, user);
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        serve_wake(server);
        return 0;
    default:
        return 0;
    }
}

/// Let go of clients that take nothing, or never say who they are.
static void check_deadlines(WebServer *server)
{
    double now = clock_seconds();
    for (Connection *connection = server->connections; connection; connection = connection->next) {
        bool stalled = connection->waiting_since && now - connection->waiting_since > STALL_LIMIT_S;
        bool silent = !connection->heard && now - connection->opened_at > GREETING_LIMIT_S;
        if (stalled || silent)
            lws_set_timeout(connection->wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
    }
}

static void tick(lws_sorted_usec_list_t *list)
{
    WebServer *server = lws_container_of(list, WebServer, tick);
    hub_tick(server->hub);
    for (Connection *connection = server->connections; connection; connection = connection->next)
        ask_to_write(server, connection);
    check_deadlines(server);
    lws_sul_schedule(server->context, 0, &server->tick, tick, TICK_MS * LWS_US_PER_MS);
}

// ---- life ---------------------------------------------------------------------------------------

static const struct lws_protocols protocols[] = {
    {.name = "http", .callback = http_callback, .per_session_data_size = sizeof(HttpRequest)},
    {.name = "fairlead",
     .callback = socket_callback,
     .per_session_data_size = sizeof(Connection),
     .rx_buffer_size = 65536,
     .tx_packet_size = 65536},
    {0},
};

/// Sent with every answer: only our own scripts and pictures, no framing, no guessing of types.
static const struct lws_protocol_vhost_options security_headers[] = {
    {&security_headers[1], NULL, "content-security-policy:",
     "default-src 'self'; img-src 'self' blob: data:; object-src 'none'; base-uri 'none'; "
     "form-action 'none'; frame-ancestors 'none'"},
    {&security_headers[2], NULL, "x-content-type-options:", "nosniff"},
    {&security_headers[3], NULL, "x-frame-options:", "DENY"},
    {&security_headers[4], NULL, "referrer-policy:", "no-referrer"},
    {NULL, NULL, "cross-origin-opener-policy:", "same-origin"},
};

static const struct lws_protocol_vhost_options mime_types[] = {
    {&mime_types[1], NULL, ".mjs", "text/javascript"},
    {&mime_types[2], NULL, ".map", "application/json"},
    {&mime_types[3], NULL, ".json", "application/json"},
    {&mime_types[4], NULL, ".webmanifest", "application/manifest+json"},
    {&mime_types[5], NULL, ".woff2", "font/woff2"},
    {&mime_types[6], NULL, ".wasm", "application/wasm"},
    {NULL, NULL, ".bin", "application/octet-stream"},
};

/// Pings find peers that vanished without a word.
static const lws_retry_bo_t keep_alive = {.secs_since_valid_ping = 20,
                                          .secs_since_valid_hangup = 50};

/// Try the address with a socket of our own: libwebsockets does not say why it could not bind.
static bool probe_port(const char *address, int port, Error *error)
{
    struct sockaddr_in name = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    if (inet_pton(AF_INET, address, &name.sin_addr) != 1)
        return error_set(
            error, ERROR_INPUT,
            "--bind: '%s' is not accepted: an IPv4 address such as 127.0.0.1 or 0.0.0.0", address);
    int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), yes = 1;
    if (probe < 0)
        return error_set(error, ERROR_SYSTEM, "cannot make a socket: %s", strerror(errno));
    setsockopt(probe, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    int failed = bind(probe, (struct sockaddr *)&name, sizeof name) || listen(probe, 1) ? errno : 0;
    close(probe);
    if (failed == EADDRINUSE)
        return error_set(error, ERROR_SYSTEM,
                         "port %d at %s is taken by another program: choose one with --port N",
                         port, address);
    if (failed)
        return error_set(error, ERROR_SYSTEM, "cannot listen at %s port %d: %s", address, port,
                         strerror(failed));
    return true;
}

static void make_mounts(WebServer *server, const char *page)
{
    char index[1200];
    snprintf(index, sizeof index, "%s/index.html", page);
    server->has_page = !access(index, R_OK);
    server->mounts[0] = (struct lws_http_mount){
        .mountpoint = "/",
        .mountpoint_len = 1,
        .origin = server->has_page ? page : "http",
        .def = "index.html",
        .protocol = server->has_page ? NULL : "http",
        .extra_mimetypes = mime_types,
        .origin_protocol = server->has_page ? LWSMPRO_FILE : LWSMPRO_CALLBACK};
    server->mounts[1] = (struct lws_http_mount){.mount_next = &server->mounts[0],
                                                .mountpoint = "/health",
                                                .mountpoint_len = 7,
                                                .origin = "http",
                                                .protocol = "http",
                                                .origin_protocol = LWSMPRO_CALLBACK};
}

WebServer *web_server_create(const WebOptions *options, Error *error)
{
    const char *address = strcmp(options->bind, "localhost") ? options->bind : "127.0.0.1";
    if (!probe_port(address, options->port, error)) return NULL;
    WebServer *server = calloc(1, sizeof *server);
    if (!server) {
        error_set(error, ERROR_SYSTEM, "no memory left for the server");
        return NULL;
    }
    server->local = !strncmp(address, "127.", 4);
    make_mounts(server, options->page);
    lws_set_log_level(0, NULL); // what matters is said by us, once
    struct lws_context_creation_info info = {
        .port = options->port,
        .iface = strcmp(address, "0.0.0.0") ? address : NULL,
        .protocols = protocols,
        .mounts = &server->mounts[1],
        .headers = security_headers,
        .retry_and_idle_policy = &keep_alive,
        .server_string = "fairlead",
        .fd_limit_per_thread = CONNECTIONS_MAX,
        .options = LWS_SERVER_OPTION_VALIDATE_UTF8 | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND |
                   LWS_SERVER_OPTION_DISABLE_IPV6 | LWS_SERVER_OPTION_EXPLICIT_VHOSTS,
        .user = server,
    };
    server->context = lws_create_context(&info);
    server->vhost = server->context ? lws_create_vhost(server->context, &info) : NULL;
    if (!server->vhost) {
        error_set(error, ERROR_SYSTEM, "cannot listen at %s port %d", address, options->port);
        web_server_destroy(server);
        return NULL;
    }
    return server;
}

int web_server_port(const WebServer *server) { return lws_get_vhost_listen_port(server->vhost); }
bool web_server_has_page(const WebServer *server) { return server->has_page; }

void web_server_wake(void *context)
{
    WebServer *server = context;
    // one call is enough until the socket thread has looked
    if (!atomic_exchange(&server->woken, true)) lws_cancel_service(server->context);
}

void web_server_run(WebServer *server, Hub *hub, const volatile sig_atomic_t *stop)
{
    server->hub = hub;
    lws_sul_schedule(server->context, 0, &server->tick, tick, 1);
    while (!*stop && lws_service(server->context, 0) >= 0) {
    }
    lws_sul_cancel(&server->tick);
}

void web_server_destroy(WebServer *server)
{
    if (!server) return;
    if (server->context) lws_context_destroy(server->context);
    free(server->buffer);
    free(server);
}
