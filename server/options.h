/// A table of options per subcommand: parsing, --help, and the nearest known name for a typo.
#ifndef FAIRLEAD_OPTIONS_H
#define FAIRLEAD_OPTIONS_H

#include <stdbool.h>
#include <stdio.h>

#include "base/error.h"

typedef enum OptionKind {
    OPTION_SWITCH,  ///< bool
    OPTION_INTEGER, ///< int, minimum..maximum
    OPTION_NUMBER,  ///< double, minimum..maximum
    OPTION_TEXT,    ///< const char *, borrowed from argv
    OPTION_LIST,    ///< OptionList: may be given again and again
} OptionKind;

enum { OPTION_LIST_MAX = 64 };
typedef struct OptionList {
    int count;
    const char *values[OPTION_LIST_MAX]; ///< borrowed from argv
} OptionList;

typedef struct Option {
    const char *name;     ///< "--port"
    const char *argument; ///< word for the help ("N"); NULL for a switch
    OptionKind kind;
    bool required;
    void *value;             ///< where to put it, of the kind's type; holds the default
    double minimum, maximum; ///< accepted range of numbers
    const char *choices;     ///< "auto|cpu|cuda" for a closed list of words; else NULL
    const char *help;
} Option;

typedef struct OptionTable {
    const char *command;    ///< "run"
    const char *summary;    ///< one line
    const char *positional; ///< "CASE"; NULL when none is taken
    bool positional_required;
    const char **positional_value; ///< filled; keeps its default when absent
    const Option *options;
    int option_count;
    const char *notes; ///< more lines for the help, or NULL
} OptionTable;

typedef enum OptionsResult { OPTIONS_GO, OPTIONS_HELP, OPTIONS_REFUSED } OptionsResult;

/// Read the words after the subcommand.
/// @param out  where --help is printed
/// @return OPTIONS_REFUSED with ERROR_INPUT naming the word and what is accepted
OptionsResult options_parse(const OptionTable *table, int count, char **words, FILE *out,
                            Error *error);
void options_print_help(const OptionTable *table, FILE *out);

/// Optimal-string-alignment distance: insertions, deletions, changes, swaps of neighbours.
int options_distance(const char *a, const char *b);

#endif
