/// summary.json: what a run was and how it went.
#ifndef FAIRLEAD_SUMMARY_H
#define FAIRLEAD_SUMMARY_H

#include "engine.h"
#include "json.h"

typedef enum RunExit { EXIT_BY_TIME, EXIT_BY_SIGNAL, EXIT_BY_PHYSICS, EXIT_BY_ERROR } RunExit;

typedef struct SummaryInfo {
    const Scene *scene;
    const Plan *plan;
    const State *state;
    double wall; ///< of the whole loop, files and frames included [s]
    RunExit how;
    const char *message; ///< of the failure, or ""
    int frame_count;
} SummaryInfo;

void summary_format(Text *text, const SummaryInfo *info);
/// Write FOLDER/summary.json. @return false with ERROR_SYSTEM
bool summary_write(const char *folder, const SummaryInfo *info, Error *error);

#endif
