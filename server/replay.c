#include "replay.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool add(Replay *replay, const JournalCommand *command)
{
    if (replay->count % 64 == 0) {
        size_t size = ((size_t)replay->count + 64) * sizeof *replay->commands;
        JournalCommand *commands = realloc(replay->commands, size);
        if (!commands) return false;
        replay->commands = commands;
    }
    replay->commands[replay->count++] = *command;
    return true;
}

static bool load_lines(FILE *file, const char *path, Replay *replay, Error *error)
{
    char line[4096];
    double last = 0;
    for (int number = 1; fgets(line, sizeof line, file); number++) {
        if (!line[strspn(line, " \t\r\n")]) continue;
        bool is_command;
        JournalCommand command;
        Error reason;
        if (!protocol_parse_journal(line, &is_command, &command, &reason))
            return error_set(error, ERROR_INPUT, "%s line %d: %s", path, number, reason.message);
        if (!is_command) continue;
        if (command.time < last)
            return error_set(error, ERROR_INPUT,
                             "%s line %d: time_s: %.9g is before the line above", path, number,
                             command.time);
        last = command.time;
        if (!add(replay, &command))
            return error_set(error, ERROR_SYSTEM, "no memory left for %s", path);
    }
    return true;
}

bool replay_load(const char *path, Replay *replay, Error *error)
{
    *replay = (Replay){0};
    FILE *file = fopen(path, "r");
    if (!file) return error_set(error, ERROR_INPUT, "%s: cannot read: %s", path, strerror(errno));
    bool good = load_lines(file, path, replay, error);
    fclose(file);
    if (!good) replay_destroy(replay);
    return good;
}

void replay_destroy(Replay *replay)
{
    free(replay->commands);
    *replay = (Replay){0};
}

const JournalCommand *replay_next(Replay *replay, double time, double time_step)
{
    if (replay->next >= replay->count) return NULL;
    // a journal rounds its times: within a quarter of a step it means this one
    double slack = time_step > 0 ? time_step / 4 : 0;
    if (replay->commands[replay->next].time > time + slack) return NULL;
    return &replay->commands[replay->next++];
}
