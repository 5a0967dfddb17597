// Mailboxes between threads, and the history that every client reads at its own pace.
#include <stdlib.h>

#include "history.h"
#include "mailbox.h"
#include "origin.h"
#include "recorder.h"
#include "replay.h"
#include "test.h"

enum { PUBLISHED = 20000 };

typedef struct Handover {
    TripleSlot slot;
    int buffers[3][64]; ///< all 64 numbers are the same unless a buffer was torn
} Handover;

static void *publish_many(void *argument)
{
    Handover *handover = argument;
    for (int n = 1; n <= PUBLISHED; n++) {
        for (int i = 0; i < 64; i++)
            handover->buffers[handover->slot.back][i] = n;
        triple_slot_publish(&handover->slot);
    }
    return NULL;
}

TEST(the_latest_of_three_is_never_torn_and_never_older)
{
    static Handover handover;
    pthread_t writer;
    triple_slot_init(&handover.slot);
    pthread_create(&writer, NULL, publish_many, &handover);
    int last = 0, torn = 0, older = 0;
    double end = clock_seconds() + 20;
    while (last < PUBLISHED && clock_seconds() < end) {
        if (!triple_slot_take(&handover.slot)) continue;
        const int *front = handover.buffers[handover.slot.front];
        for (int i = 1; i < 64; i++)
            torn += front[i] != front[0];
        older += front[0] <= last;
        last = front[0];
    }
    pthread_join(writer, NULL);
    CHECK(last == PUBLISHED);
    CHECK(torn == 0);
    CHECK(older == 0);
}

TEST(writer_and_reader_never_hold_the_same_buffer)
{
    TripleSlot slot;
    int contents[3] = {0}, published = 0, taken = 0;
    unsigned pattern = 12345;
    triple_slot_init(&slot);
    for (int i = 0; i < 1000; i++) {
        pattern = pattern * 1103515245u + 12345u;
        if (pattern >> 16 & 1) {
            contents[slot.back] = ++published;
            triple_slot_publish(&slot);
        } else if (triple_slot_take(&slot)) {
            taken = contents[slot.front];
            CHECK(taken == published);
        }
        CHECK(slot.back != slot.front && slot.back < 3 && slot.front < 3);
        CHECK(taken == 0 || contents[slot.front] == taken);
    }
}

TEST(nothing_new_leaves_the_front_as_it_is)
{
    TripleSlot slot;
    triple_slot_init(&slot);
    CHECK(!triple_slot_take(&slot));
    unsigned filled = slot.back;
    triple_slot_publish(&slot);
    CHECK(triple_slot_take(&slot) && slot.front == filled);
    CHECK(!triple_slot_take(&slot) && slot.front == filled);
}

TEST(a_queue_keeps_the_order_and_refuses_when_full)
{
    Queue queue;
    int item;
    CHECK(queue_init(&queue, sizeof(int), 3));
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < 3; i++)
            CHECK(queue_put(&queue, &i));
        item = 9;
        CHECK(!queue_put(&queue, &item));
        for (int i = 0; i < 3; i++)
            CHECK(queue_take(&queue, &item) && item == i);
        CHECK(!queue_take(&queue, &item) && queue_is_empty(&queue));
        item = 7;
        CHECK(queue_put(&queue, &item) && queue_take(&queue, &item) && item == 7);
    }
    queue_destroy(&queue);
}

TEST(a_bell_remembers_one_ring)
{
    Bell bell;
    bell_init(&bell);
    double begin = clock_seconds();
    CHECK(!bell_wait(&bell, 0.02));
    CHECK(clock_seconds() - begin >= 0.019);
    bell_ring(&bell);
    bell_ring(&bell);
    CHECK(bell_wait(&bell, 5));
    CHECK(!bell_wait(&bell, 0));
    bell_destroy(&bell);
}

TEST(every_reader_gets_every_sample_once_and_in_order)
{
    History *history = history_create(2);
    HistoryCursor slow = history_begin(history), quick = slow;
    double rows[2 * 700];
    int quick_count = 0, slow_count = 0, wrong = 0;
    for (int i = 0; i < 5000; i++) {
        history_add_row(history, (double[]){i, 2 * i});
        int count = history_read_rows(history, &quick, rows, 10);
        for (int j = 0; j < count; j++)
            wrong += rows[2 * j] != quick_count++ || rows[2 * j + 1] != 2 * rows[2 * j];
    }
    for (int count; (count = history_read_rows(history, &slow, rows, 700)) > 0;)
        for (int j = 0; j < count; j++)
            wrong += rows[2 * j] != slow_count++;
    CHECK(quick_count == 5000 && slow_count == 5000 && wrong == 0);
    history_destroy(history);
}

TEST(a_reset_begins_a_new_epoch)
{
    History *history = history_create(1);
    double row = 1;
    Marker marker;
    history_add_row(history, &row);
    history_add_marker(history, 0.5, "old");
    HistoryCursor cursor = history_begin(history);
    CHECK(history_read_rows(history, &cursor, &row, 1) == 1);
    history_reset(history);
    history_add_row(history, (double[]){2});
    history_add_marker(history, 0, "new");
    CHECK(history_pending(history, &cursor).reset);
    CHECK(history_read_rows(history, &cursor, &row, 1) == 0);
    CHECK(!history_read_marker(history, &cursor, &marker));
    cursor = history_begin(history);
    CHECK(!history_pending(history, &cursor).reset && history_pending(history, &cursor).rows);
    CHECK(history_read_rows(history, &cursor, &row, 1) == 1 && row == 2);
    CHECK(history_read_marker(history, &cursor, &marker) && !strcmp(marker.text, "new"));
    HistoryPending pending = history_pending(history, &cursor);
    CHECK(!pending.reset && !pending.rows && !pending.markers);
    history_destroy(history);
}

TEST(a_long_history_thins_out_its_older_half_only)
{
    enum { TOTAL = HISTORY_ROWS_MAX + 1000, BATCH = 4096 };
    History *history = history_create(1);
    HistoryCursor live = history_begin(history), late = live;
    double *rows = calloc(BATCH, sizeof *rows), last = -1;
    int live_count = 0, late_count = 0, disorder = 0, gaps_late = 0;
    for (int i = 0; i < TOTAL; i++) {
        double value = i;
        history_add_row(history, &value);
        live_count += history_read_rows(history, &live, rows, BATCH);
    }
    for (int count; (count = history_read_rows(history, &late, rows, BATCH)) > 0;)
        for (int j = 0; j < count; j++) {
            disorder += rows[j] <= last;
            gaps_late += rows[j] > TOTAL / 2.0 + 1000 && rows[j] != last + 1;
            last = rows[j];
            late_count++;
        }
    CHECK(live_count == TOTAL);
    CHECK(late_count < HISTORY_ROWS_MAX && late_count > HISTORY_ROWS_MAX / 2);
    CHECK(disorder == 0 && gaps_late == 0 && last == TOTAL - 1);
    free(rows);
    history_destroy(history);
}

TEST(samples_fall_due_at_the_first_step_past_a_multiple)
{
    SampleClock clock = {.interval = 0.1};
    double times[] = {0, 0.04, 0.08, 0.12, 0.16, 0.2, 0.55, 0.59, 0.61};
    bool due[] = {true, false, false, true, false, true, true, false, true};
    for (int i = 0; i < 9; i++)
        CHECK(sample_clock_due(&clock, times[i]) == due[i]);
}

TEST(only_pages_of_this_server_match_its_host)
{
    CHECK(origin_matches_host("http://127.0.0.1:8080", "127.0.0.1:8080"));
    CHECK(origin_matches_host("HTTP://LocalHost:8080", "localhost:8080"));
    CHECK(origin_matches_host("http://localhost", "localhost:80"));
    CHECK(origin_matches_host("https://ship.test", "ship.test:443"));
    CHECK(origin_matches_host("http://[::1]:8080", "[::1]:8080"));
    CHECK(!origin_matches_host("http://127.0.0.1:8081", "127.0.0.1:8080"));
    CHECK(!origin_matches_host("http://evil.test", "127.0.0.1:8080"));
    CHECK(!origin_matches_host("http://127.0.0.1:8080.evil.test", "127.0.0.1:8080"));
    CHECK(!origin_matches_host("http://127.0.0.1", "127.0.0.1:8080"));
    CHECK(!origin_matches_host("null", "127.0.0.1:8080"));
    CHECK(!origin_matches_host("", "127.0.0.1:8080"));
    CHECK(!origin_matches_host("http://", ""));
    CHECK(!origin_matches_host("file://127.0.0.1:8080", "127.0.0.1:8080"));
}

TEST(only_names_of_this_machine_are_loopback)
{
    CHECK(host_is_loopback("127.0.0.1:8080") && host_is_loopback("localhost:1"));
    CHECK(host_is_loopback("127.8.9.1") && host_is_loopback("[::1]:8080"));
    CHECK(!host_is_loopback("evil.test:8080") && !host_is_loopback("127.0.0.1.evil.test"));
    CHECK(!host_is_loopback("") && !host_is_loopback("10.0.0.1:80"));
}

TEST(a_replay_gives_each_command_before_the_step_it_was_given_at)
{
    JournalCommand commands[] = {{.time = 0}, {.time = 0.3000000001}, {.time = 0.3}, {.time = 9}};
    Replay replay = {.commands = commands, .count = 4};
    CHECK(replay_next(&replay, 0, 0.1) == &commands[0]);
    CHECK(!replay_next(&replay, 0, 0.1));
    CHECK(!replay_next(&replay, 0.2, 0.1));
    CHECK(replay_next(&replay, 0.3, 0.1) == &commands[1]);
    CHECK(replay_next(&replay, 0.3, 0.1) == &commands[2]);
    CHECK(!replay_next(&replay, 0.4, 0.1));
}
