/// Everything the page plots since the last reset: samples and markers. The simulation writes, the
/// socket thread reads with one cursor per client, so that no sample is lost however slow a client.
#ifndef FAIRLEAD_HISTORY_H
#define FAIRLEAD_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

typedef struct History History;

/// A reader's place; starts zeroed with the current epoch.
typedef struct HistoryCursor {
    uint32_t epoch;  ///< counts resets
    uint64_t row;    ///< sequence number of the next sample
    uint64_t marker; ///< index of the next marker
} HistoryCursor;

typedef struct Marker {
    double time; ///< simulated [s]
    char text[200];
} Marker;

enum {
    HISTORY_ROWS_MAX = 200000, ///< beyond it the older half keeps every second sample
    HISTORY_MARKERS_MAX = 10000,
};

/// @return NULL when memory runs out
History *history_create(int columns);
void history_destroy(History *history);

/// Forget everything and begin a new epoch.
void history_reset(History *history);
/// @param row  [columns]; dropped only when memory runs out
void history_add_row(History *history, const double *row);
void history_add_marker(History *history, double time, const char *text);

/// A cursor at the beginning of the present epoch.
HistoryCursor history_begin(History *history);

/// Copy the next samples. @param rows  [most][columns]
/// @return how many; 0 when there are none or the epoch is over
int history_read_rows(History *history, HistoryCursor *cursor, double *rows, int most);
bool history_read_marker(History *history, HistoryCursor *cursor, Marker *marker);

/// What a reader at `cursor` has before it.
typedef struct HistoryPending {
    bool reset, rows, markers;
} HistoryPending;
HistoryPending history_pending(History *history, const HistoryCursor *cursor);

#endif
