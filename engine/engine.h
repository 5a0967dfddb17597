/// The public face of the engine: all that render, server and tools include.
///
///     scene_load ─▶ Scene ─ plan_build ─▶ Plan ─ state_create ─▶ State ─ step_advance (repeats)
///                                                                  └ snapshot_take ─▶ Snapshot
#ifndef FAIRLEAD_ENGINE_H
#define FAIRLEAD_ENGINE_H

#include "bench.h"
#include "command.h"
#include "plan.h"
#include "scene.h"
#include "series.h"
#include "snapshot.h"
#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Advance one time step, health checks and roll-back included.
/// @return false with ERROR_PHYSICS when roll-back could not cure it
bool step_advance(const Scene *scene, const Plan *plan, State *state, Error *error);

/// Apply a live change at the state's present time.
/// @return false with ERROR_INPUT naming value and range; nothing is half applied
bool state_command(const Scene *scene, State *state, const Command *command, Error *error);

/// Make room for snapshots of this plan (owned storage), fill one, give it back.
bool snapshot_create(const Scene *scene, const Plan *plan, Snapshot *snapshot, Error *error);
void snapshot_take(const Scene *scene, const Plan *plan, const State *state, Snapshot *snapshot);
void snapshot_destroy(Snapshot *snapshot);

/// A line of journal.jsonl about the start, a command or a health event; `size` bytes at most.
void journal_format_start(const Scene *scene, const Plan *plan, char *text, int size);
/// @param asked  the sea in force, for a command about the sea
void journal_format_command(double time, const Command *command, const WaveTarget *asked,
                            char *text, int size);
void journal_format_health(double time, const char *message, char *text, int size);
void journal_format_line(const Scene *scene, const LineEvent *event, char *text, int size);
/// The same in a few words, for a label on a plot: "bow line snaps: 345 N".
void line_event_describe(const Scene *scene, const LineEvent *event, char *text, int size);

#ifdef __cplusplus
}
#endif
#endif
