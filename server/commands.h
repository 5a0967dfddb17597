/// The subcommands. Each reads its own words and returns the program's exit code.
#ifndef FAIRLEAD_COMMANDS_H
#define FAIRLEAD_COMMANDS_H

#include "engine.h"
#include "options.h"

enum {
    EXIT_GOOD = 0,
    EXIT_REFUSED = 2, ///< bad input, or the machine refused
    EXIT_SICK = 3,    ///< physics that could not be recovered
    EXIT_INTERRUPTED = 130,
};

int command_serve(int count, char **words);
int command_run(int count, char **words);
int command_explain(int count, char **words);
int command_bench(int count, char **words);

/// All subcommands by name. @return the exit code
int fairlead_main(int argc, char **argv);

/// A scene with its plan, the start of every subcommand.
typedef struct Prepared {
    Scene *scene;       ///< owned
    Plan *plan;         ///< owned
    SeriesTable *table; ///< owned
} Prepared;

/// Load, check and plan. @return false with `error` set; then nothing is owned
bool prepare(const char *path, const OptionList *overrides, const EngineOptions *options,
             Prepared *prepared, Error *error);
void prepared_destroy(Prepared *prepared);

/// Print "fairlead: message" as one line on stderr. @return the exit code of that error
int report(const Error *error);

/// Folder of the running program, "." when unknown.
void program_folder(char *folder, int size);

#define DEFAULT_CASE "cases/moored_ship.json"
/// The default case lies in the working folder, or beside the folder of the program.
/// @param room  for a path that has to be put together [size]
const char *find_default_case(char *room, int size);

#endif
