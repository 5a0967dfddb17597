// The session, without sockets.
#include <stdlib.h>
#include <unistd.h>

#include "commands.h"
#include "session.h"
#include "test.h"

static char folder[] = "/tmp/fairlead-session-XXXXXX";

/// A session of the stand-in engine, not yet started.
static Session *make_session(Prepared *prepared, const char *wish)
{
    OptionList overrides = {.count = wish ? 1 : 0, .values = {wish}};
    EngineOptions engine = {.backend = "auto"};
    Error error = {0};
    if (strstr(folder, "XXXXXX") && !mkdtemp(folder)) return NULL;
    bool good =
        prepare(SOURCE_DIR "/tests/server/fake_case.json", &overrides, &engine, prepared, &error);
    Session *session = good ? session_create(prepared->scene, prepared->plan, prepared->table,
                                             folder, (Wake){0}, &error)
                            : NULL;
    if (!session) printf("  %s\n", error.message);
    return session;
}

static void drop_session(Prepared *prepared, Session *session)
{
    session_destroy(session);
    prepared_destroy(prepared);
}

/// Wait for the next reply, at most five seconds.
static bool wait_reply(Session *session, SessionReply *reply)
{
    double end = clock_seconds() + 5;
    while (clock_seconds() < end) {
        if (session_next_reply(session, reply)) return true;
        usleep(1000);
    }
    return false;
}

TEST(a_session_shows_its_first_moment_before_it_starts)
{
    Prepared prepared;
    bool fresh;
    Session *session = make_session(&prepared, NULL);
    if (!session) return;
    const Snapshot *snapshot = session_snapshot(session, &fresh);
    CHECK(snapshot && fresh && snapshot->time == 0);
    CHECK(session_status(session).state == RUN_RUNNING && session_status(session).time == 0);
    HistoryCursor cursor = history_begin(session_history(session));
    double row[4];
    CHECK(history_read_rows(session_history(session), &cursor, row, 1) == 1 && row[0] == 0);
    drop_session(&prepared, session);
}

TEST(requests_beyond_the_queue_are_refused_and_all_others_answered)
{
    Prepared prepared;
    Session *session = make_session(&prepared, NULL);
    if (!session) return;
    SessionRequest request = {.kind = REQUEST_COMMAND, .client = 5, .command = {0.1, NAN, NAN}};
    uint32_t stored = 0, answered = 0;
    while (stored < 10000 && session_ask(session, &request))
        request.id = ++stored;
    CHECK(stored >= 100 && stored < 10000);
    Error error;
    CHECK(session_start(session, &error));
    SessionReply reply;
    while (answered < stored && wait_reply(session, &reply)) {
        CHECK(reply.accepted && reply.client == 5 && reply.refusal.id == answered);
        answered++;
    }
    CHECK(answered == stored);
    drop_session(&prepared, session);
}

TEST(a_snapshot_is_taken_only_when_it_is_wanted)
{
    Prepared prepared;
    bool fresh;
    Error error;
    Session *session = make_session(&prepared, "step_ms=1");
    if (!session) return;
    session_snapshot(session, &fresh);
    CHECK(session_start(session, &error));
    usleep(100000);
    session_snapshot(session, &fresh);
    CHECK(!fresh);
    session_want_snapshot(session);
    usleep(100000);
    const Snapshot *snapshot = session_snapshot(session, &fresh);
    CHECK(fresh && snapshot->time > 0);
    drop_session(&prepared, session);
}

TEST(a_session_ends_quickly_whatever_its_state)
{
    static const RunAction actions[] = {ACTION_START, ACTION_PAUSE, ACTION_RESET};
    for (int i = 0; i < 3; i++) {
        Prepared prepared;
        Error error;
        SessionReply reply;
        Session *session = make_session(&prepared, NULL);
        if (!session) return;
        SessionRequest request = {.kind = REQUEST_RUN, .action = actions[i]};
        CHECK(session_start(session, &error) && session_ask(session, &request));
        CHECK(wait_reply(session, &reply) && reply.accepted);
        double begin = clock_seconds();
        session_stop(session);
        CHECK(clock_seconds() - begin < 0.5);
        drop_session(&prepared, session);
    }
}

TEST(sessions_that_start_in_one_second_have_folders_of_their_own)
{
    Prepared first, second;
    Session *one = make_session(&first, NULL), *two = make_session(&second, NULL);
    if (!one || !two) return;
    CHECK(strcmp(session_folder(one), session_folder(two)) != 0);
    drop_session(&first, one);
    drop_session(&second, two);
}

__attribute__((destructor)) static void remove_folder(void)
{
    char command[200];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (!strstr(folder, "XXXXXX") && system(command)) printf("%s is left\n", folder);
}
