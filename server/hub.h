/// What the server says to whom: clients, their cursors and credit, the shared view. Knows
/// messages, threads' mailboxes and pictures, but no sockets: websocket.c carries the bytes.
#ifndef FAIRLEAD_HUB_H
#define FAIRLEAD_HUB_H

#include "picture.h"
#include "session.h"

typedef struct Hub Hub;
typedef struct Client Client;

enum { HUB_CLIENTS_MAX = 32 };

/// Everything borrowed for the hub's life.
typedef struct HubParts {
    const Scene *scene;
    const Plan *plan;
    const SeriesTable *table;
    Session *session;
    Pictures *pictures;
    ViewOptions view; ///< first look
} HubParts;

Hub *hub_create(const HubParts *parts, Error *error);
/// All clients must have been closed.
void hub_destroy(Hub *hub);

/// @return NULL when there are too many already
Client *hub_open(Hub *hub);
void hub_close(Hub *hub, Client *client);
int hub_client_count(const Hub *hub);

/// One whole text message of a client.
/// @return false when the client abuses the protocol and must go
bool hub_receive(Hub *hub, Client *client, const char *text, size_t length);

/// Collect what the other threads have left: answers, stills. Call after every wake.
void hub_collect(Hub *hub);
/// Five times a second: a new status for everyone.
void hub_tick(Hub *hub);

/// Is there something to send to this client now?
bool hub_pending(Hub *hub, Client *client);

/// A message on its way.
typedef struct Outgoing {
    bool binary;
    const char *text; ///< borrowed until the next hub call; NULL when binary
    Picture *picture; ///< retained: the taker releases it; NULL when text
    size_t size;      ///< [byte]
} Outgoing;

/// The next message for this client. @return false when there is none
bool hub_next(Hub *hub, Client *client, Outgoing *message);

/// {"status":"ok", …} for GET /health.
void hub_format_health(Hub *hub, Text *text);

#endif
