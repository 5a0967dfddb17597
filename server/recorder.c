#include "recorder.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

static const double CLOCK_SLACK = 1e-6; ///< of the interval

bool sample_clock_due(SampleClock *clock, double time)
{
    // steps that divide the interval add up to it but for rounding
    double slack = CLOCK_SLACK * clock->interval;
    if (time + slack < (double)clock->next * clock->interval) return false;
    // a step may be longer than the interval: one sample then stands for all that fell due
    clock->next = (int64_t)floor((time + slack) / clock->interval) + 1;
    while ((double)clock->next * clock->interval <= time + slack)
        clock->next++;
    return true;
}

bool folder_create(const char *folder, Error *error)
{
    char path[SCENE_PATH_SIZE];
    if (snprintf(path, sizeof path, "%s", folder) >= (int)sizeof path)
        return error_set(error, ERROR_INPUT, "%.60s…: the path is longer than %d characters",
                         folder, SCENE_PATH_SIZE - 1);
    for (char *c = path + 1;; c++) {
        if (*c && *c != '/') continue;
        char kept = *c;
        *c = 0;
        if (mkdir(path, 0777) && errno != EEXIST)
            return error_set(error, ERROR_SYSTEM, "%s: cannot make the folder: %s", path,
                             strerror(errno));
        *c = kept;
        if (!kept) break;
    }
    struct stat status;
    if (stat(path, &status) || !S_ISDIR(status.st_mode))
        return error_set(error, ERROR_SYSTEM, "%s: is not a folder", path);
    return true;
}

static bool open_file(const char *folder, const char *name, FILE **file, Error *error)
{
    char path[SCENE_PATH_SIZE + 32];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    *file = fopen(path, "w");
    return *file || error_set(error, ERROR_SYSTEM, "%s: cannot write: %s", path, strerror(errno));
}

static bool failed(const Recorder *recorder, const char *name, Error *error)
{
    return error_set(error, ERROR_SYSTEM, "%s/%s: cannot write: %s", recorder->folder, name,
                     strerror(errno));
}

static bool write_header(Recorder *recorder, const SeriesTable *table, Error *error)
{
    for (int i = 0; i < table->count; i++)
        fprintf(recorder->series, "%s%s", i ? "," : "", table->names[i]);
    fputc('\n', recorder->series);
    return !ferror(recorder->series) || failed(recorder, "series.csv", error);
}

bool recorder_open(Recorder *recorder, const char *folder, const SeriesTable *table,
                   const char *first_line, Error *error)
{
    *recorder = (Recorder){0};
    TRY(folder_create(folder, error));
    snprintf(recorder->folder, sizeof recorder->folder, "%s", folder);
    if (open_file(folder, "series.csv", &recorder->series, error) &&
        open_file(folder, "journal.jsonl", &recorder->journal, error) &&
        write_header(recorder, table, error) && recorder_journal(recorder, first_line, error))
        return true;
    recorder_close(recorder, NULL);
    return false;
}

bool recorder_sample(Recorder *recorder, const double *row, int count, Error *error)
{
    if (!recorder->series) return true;
    for (int i = 0; i < count; i++) {
        if (i) fputc(',', recorder->series);
        if (isnan(row[i]))
            fputs("nan", recorder->series);
        else
            fprintf(recorder->series, "%.9g", row[i]);
    }
    fputc('\n', recorder->series);
    return !ferror(recorder->series) || failed(recorder, "series.csv", error);
}

bool recorder_journal(Recorder *recorder, const char *line, Error *error)
{
    if (!recorder->journal) return true;
    size_t length = strcspn(line, "\n");
    fwrite(line, 1, length, recorder->journal);
    fputc('\n', recorder->journal);
    return !fflush(recorder->journal) || failed(recorder, "journal.jsonl", error);
}

bool recorder_flush(Recorder *recorder, Error *error)
{
    return !recorder->series || !fflush(recorder->series) || failed(recorder, "series.csv", error);
}

bool recorder_close(Recorder *recorder, Error *error)
{
    bool good = true;
    if (recorder->series && fclose(recorder->series)) good = failed(recorder, "series.csv", error);
    if (recorder->journal && fclose(recorder->journal))
        good = failed(recorder, "journal.jsonl", error);
    recorder->series = recorder->journal = NULL;
    return good;
}
