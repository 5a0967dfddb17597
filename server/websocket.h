/// The socket thread: HTTP files, /health and the socket at /ws. The only user of libwebsockets.
#ifndef FAIRLEAD_WEBSOCKET_H
#define FAIRLEAD_WEBSOCKET_H

#include <signal.h>

#include "hub.h"

typedef struct WebServer WebServer;

typedef struct WebOptions {
    const char *bind; ///< IPv4 address, "localhost"
    int port;         ///< 0 = any free one
    const char *page; ///< folder with index.html; borrowed
} WebOptions;

/// Bind the port. @return NULL with ERROR_SYSTEM (port busy, not permitted, no such address)
WebServer *web_server_create(const WebOptions *options, Error *error);
int web_server_port(const WebServer *server);
bool web_server_has_page(const WebServer *server);

/// Thread-safe: the hub may have something to send.
void web_server_wake(void *server);

/// Serve until *stop is set (by a signal handler). `hub` is borrowed until web_server_destroy.
void web_server_run(WebServer *server, Hub *hub, const volatile sig_atomic_t *stop);

/// Close all connections and free.
void web_server_destroy(WebServer *server);

#endif
