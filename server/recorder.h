/// The files of one run: series.csv and journal.jsonl in a folder of their own.
#ifndef FAIRLEAD_RECORDER_H
#define FAIRLEAD_RECORDER_H

#include <stdio.h>

#include "engine.h"

/// Says when the next sample is due: at the first step whose time is at least k * interval.
typedef struct SampleClock {
    double interval; ///< [s], > 0
    int64_t next;    ///< k
} SampleClock;
bool sample_clock_due(SampleClock *clock, double time);

typedef struct Recorder {
    char folder[SCENE_PATH_SIZE];
    FILE *series, *journal; ///< NULL when closed or given up
} Recorder;

/// Make the folder and its parents. @return false with ERROR_SYSTEM
bool folder_create(const char *folder, Error *error);

/// Create the folder and both files; write the header line and the journal's first line.
/// @param first_line  of journal_format_start
bool recorder_open(Recorder *recorder, const char *folder, const SeriesTable *table,
                   const char *first_line, Error *error);

/// One line of values with nine digits; not-a-number as "nan".
/// @return false with ERROR_SYSTEM naming the file when the disk refused
bool recorder_sample(Recorder *recorder, const double *row, int count, Error *error);
/// One line, flushed at once: a journal must survive a crash.
bool recorder_journal(Recorder *recorder, const char *line, Error *error);
bool recorder_flush(Recorder *recorder, Error *error);
/// Flush and close. @return false with ERROR_SYSTEM when something could not be written
bool recorder_close(Recorder *recorder, Error *error);

#endif
