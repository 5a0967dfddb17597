/// The simulation thread: it alone owns State. Others ask by requests and read snapshots, status
/// and history; nobody ever makes it wait.
#ifndef FAIRLEAD_SESSION_H
#define FAIRLEAD_SESSION_H

#include "engine.h"
#include "history.h"
#include "mailbox.h"
#include "protocol.h"
#include "status.h"

typedef struct Session Session;

typedef enum RequestKind { REQUEST_COMMAND, REQUEST_RUN } RequestKind;

/// Asked by a client, carried out between two steps.
typedef struct SessionRequest {
    RequestKind kind;
    uint64_t client; ///< who is answered
    uint32_t id;
    Command command;
    RunAction action;
} SessionRequest;

/// Exactly one per request, in order.
typedef struct SessionReply {
    uint64_t client;
    bool accepted;
    double time;     ///< in force from here [s]
    Refusal refusal; ///< when not accepted; holds the id in both cases
} SessionReply;

/// Create State, open the session's folder below `data_folder`; the thread starts with
/// session_start. Scene, plan and table are borrowed for the session's life.
/// @return NULL with `error` set
Session *session_create(const Scene *scene, const Plan *plan, const SeriesTable *table,
                        const char *data_folder, Wake wake, Error *error);
bool session_start(Session *session, Error *error);
/// Stop the thread after its present step and close the files; nothing wakes anybody afterwards.
void session_stop(Session *session);
/// Stop and free everything.
void session_destroy(Session *session);

/// @return false when too many requests wait already
bool session_ask(Session *session, const SessionRequest *request);
bool session_next_reply(Session *session, SessionReply *reply);

SessionStatus session_status(Session *session);
History *session_history(Session *session);
const char *session_folder(const Session *session);

/// Render thread: ask for a fresh snapshot; the snapshot bell rings when it is there.
void session_want_snapshot(Session *session);
/// Rung whenever a snapshot was published. Set once before session_start.
void session_set_snapshot_bell(Session *session, Bell *bell);
/// Render thread: the newest snapshot, NULL before the first. @param fresh  not seen before
const Snapshot *session_snapshot(Session *session, bool *fresh);

#endif
