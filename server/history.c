#include "history.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK_ROWS = 1024, CHUNKS_MAX = HISTORY_ROWS_MAX / CHUNK_ROWS + 2 };

/// Samples live in chunks that never move, so that the writer is never held up by a large copy.
struct History {
    pthread_mutex_t mutex;
    int columns;
    uint32_t epoch;
    uint64_t next_row;          ///< sequence number of the next sample
    int count;                  ///< samples kept
    double *chunks[CHUNKS_MAX]; ///< [CHUNK_ROWS][columns] each
    uint64_t *numbers; ///< sequence number of each kept sample, ascending [HISTORY_ROWS_MAX]
    Marker *markers;
    int marker_count, marker_capacity;
};

History *history_create(int columns)
{
    History *history = calloc(1, sizeof *history);
    if (!history) return NULL;
    history->numbers = malloc(HISTORY_ROWS_MAX * sizeof *history->numbers);
    if (!history->numbers) {
        free(history);
        return NULL;
    }
    pthread_mutex_init(&history->mutex, NULL);
    history->columns = columns;
    return history;
}

void history_destroy(History *history)
{
    if (!history) return;
    for (int i = 0; i < CHUNKS_MAX; i++)
        free(history->chunks[i]);
    free(history->markers);
    free(history->numbers);
    pthread_mutex_destroy(&history->mutex);
    free(history);
}

void history_reset(History *history)
{
    pthread_mutex_lock(&history->mutex);
    history->epoch++;
    history->next_row = 0;
    history->count = 0;
    history->marker_count = 0;
    pthread_mutex_unlock(&history->mutex);
}

static double *row_at(const History *history, int index)
{
    return history->chunks[index / CHUNK_ROWS] +
           (size_t)(index % CHUNK_ROWS) * (size_t)history->columns;
}

/// Keep every second sample of the older half; the newer half stays complete.
static void thin_out(History *history)
{
    int half = history->count / 2, kept = 0;
    size_t size = (size_t)history->columns * sizeof(double);
    for (int i = 0; i < history->count; i += i < half ? 2 : 1) {
        if (kept != i) memcpy(row_at(history, kept), row_at(history, i), size);
        history->numbers[kept++] = history->numbers[i];
    }
    history->count = kept;
}

void history_add_row(History *history, const double *row)
{
    pthread_mutex_lock(&history->mutex);
    if (history->count == HISTORY_ROWS_MAX) thin_out(history);
    size_t size = (size_t)history->columns * sizeof(double);
    double **chunk = &history->chunks[history->count / CHUNK_ROWS];
    if (!*chunk) *chunk = malloc(CHUNK_ROWS * size);
    if (*chunk) {
        memcpy(row_at(history, history->count), row, size);
        history->numbers[history->count++] = history->next_row++;
    }
    pthread_mutex_unlock(&history->mutex);
}

void history_add_marker(History *history, double time, const char *text)
{
    pthread_mutex_lock(&history->mutex);
    if (history->marker_count == history->marker_capacity &&
        history->marker_capacity < HISTORY_MARKERS_MAX) {
        int capacity = history->marker_capacity ? 2 * history->marker_capacity : 64;
        if (capacity > HISTORY_MARKERS_MAX) capacity = HISTORY_MARKERS_MAX;
        Marker *markers = realloc(history->markers, (size_t)capacity * sizeof *markers);
        if (markers) {
            history->markers = markers;
            history->marker_capacity = capacity;
        }
    }
    if (history->marker_count < history->marker_capacity) {
        Marker *marker = &history->markers[history->marker_count++];
        marker->time = time;
        snprintf(marker->text, sizeof marker->text, "%s", text);
    }
    pthread_mutex_unlock(&history->mutex);
}

HistoryCursor history_begin(History *history)
{
    pthread_mutex_lock(&history->mutex);
    HistoryCursor cursor = {.epoch = history->epoch};
    pthread_mutex_unlock(&history->mutex);
    return cursor;
}

/// Index of the first kept sample whose number is at least `number`.
static int find_row(const History *history, uint64_t number)
{
    int begin = 0, end = history->count;
    while (begin < end) {
        int middle = begin + (end - begin) / 2;
        if (history->numbers[middle] < number)
            begin = middle + 1;
        else
            end = middle;
    }
    return begin;
}

int history_read_rows(History *history, HistoryCursor *cursor, double *rows, int most)
{
    int copied = 0;
    pthread_mutex_lock(&history->mutex);
    if (cursor->epoch == history->epoch && cursor->row < history->next_row) {
        size_t columns = (size_t)history->columns;
        for (int i = find_row(history, cursor->row); i < history->count && copied < most; i++) {
            memcpy(rows + columns * (size_t)copied++, row_at(history, i), columns * sizeof *rows);
            cursor->row = history->numbers[i] + 1;
        }
    }
    pthread_mutex_unlock(&history->mutex);
    return copied;
}

bool history_read_marker(History *history, HistoryCursor *cursor, Marker *marker)
{
    pthread_mutex_lock(&history->mutex);
    bool some = cursor->epoch == history->epoch && cursor->marker < (uint64_t)history->marker_count;
    if (some) *marker = history->markers[cursor->marker++];
    pthread_mutex_unlock(&history->mutex);
    return some;
}

HistoryPending history_pending(History *history, const HistoryCursor *cursor)
{
    pthread_mutex_lock(&history->mutex);
    HistoryPending pending = {.reset = cursor->epoch != history->epoch};
    if (!pending.reset) {
        pending.rows = cursor->row < history->next_row;
        pending.markers = cursor->marker < (uint64_t)history->marker_count;
    }
    pthread_mutex_unlock(&history->mutex);
    return pending;
}
