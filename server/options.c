#include "options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_MAX = 40 };

static int smallest(int a, int b) { return a < b ? a : b; }

int options_distance(const char *a, const char *b)
{
    int rows[3][WORD_MAX + 1];
    int length_a = smallest((int)strlen(a), WORD_MAX),
        length_b = smallest((int)strlen(b), WORD_MAX);
    for (int j = 0; j <= length_b; j++)
        rows[0][j] = j;
    for (int i = 1; i <= length_a; i++) {
        int *now = rows[i % 3], *before = rows[(i + 2) % 3], *earlier = rows[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= length_b; j++) {
            int change = before[j - 1] + (a[i - 1] != b[j - 1]);
            now[j] = smallest(change, smallest(before[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = smallest(now[j], earlier[j - 2] + 1);
        }
    }
    return rows[length_a % 3][length_b];
}

static const char *nearest_option(const OptionTable *table, const char *word)
{
    const char *best = "--help";
    int distance = options_distance(word, best);
    for (int i = 0; i < table->option_count; i++) {
        int d = options_distance(word, table->options[i].name);
        if (d < distance) {
            distance = d;
            best = table->options[i].name;
        }
    }
    return best;
}

static bool is_choice(const char *choices, const char *word)
{
    size_t length = strlen(word);
    for (const char *c = choices; c; c = strchr(c, '|') ? strchr(c, '|') + 1 : NULL)
        if (length && !strncmp(c, word, length) && (c[length] == '|' || !c[length])) return true;
    return false;
}

static bool parse_number(const Option *option, const char *word, double *number, Error *error)
{
    char *end;
    errno = 0;
    *number = strtod(word, &end);
    bool whole = option->kind != OPTION_INTEGER || *number == floor(*number);
    if (end == word || *end || errno || !isfinite(*number) || !whole || *number < option->minimum ||
        *number > option->maximum)
        return error_set(error, ERROR_INPUT, "%s: '%s' is not accepted: a%s number from %g to %g",
                         option->name, word, option->kind == OPTION_INTEGER ? " whole" : "",
                         option->minimum, option->maximum);
    return true;
}

static bool store(const Option *option, const char *word, Error *error)
{
    double number;
    switch (option->kind) {
    case OPTION_SWITCH:
        *(bool *)option->value = true;
        return true;
    case OPTION_INTEGER:
        TRY(parse_number(option, word, &number, error));
        *(int *)option->value = (int)number;
        return true;
    case OPTION_NUMBER:
        TRY(parse_number(option, word, &number, error));
        *(double *)option->value = number;
        return true;
    case OPTION_TEXT:
        if (option->choices && !is_choice(option->choices, word))
            return error_set(error, ERROR_INPUT, "%s: '%s' is not accepted: one of %s",
                             option->name, word, option->choices);
        *(const char **)option->value = word;
        return true;
    case OPTION_LIST: {
        OptionList *list = option->value;
        if (list->count == OPTION_LIST_MAX)
            return error_set(error, ERROR_INPUT, "%s: given more than %d times", option->name,
                             OPTION_LIST_MAX);
        list->values[list->count++] = word;
        return true;
    }
    }
    return false;
}

/// One `--name`, `--name value` or `--name=value`; advances *index over what it used.
static bool parse_option(const OptionTable *table, int count, char **words, int *index,
                         const Option **seen, Error *error)
{
    const char *word = words[*index], *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    for (int i = 0; i < table->option_count; i++) {
        const Option *option = &table->options[i];
        if (strlen(option->name) != length || strncmp(option->name, word, length) != 0) continue;
        *seen = option;
        if (option->kind == OPTION_SWITCH) {
            if (equals)
                return error_set(error, ERROR_INPUT, "%s takes no value, found '%s'", option->name,
                                 equals + 1);
            return store(option, NULL, error);
        }
        if (equals) return store(option, equals + 1, error);
        if (*index + 1 >= count)
            return error_set(error, ERROR_INPUT, "%s needs a value: %s %s", option->name,
                             option->name, option->argument);
        return store(option, words[++*index], error);
    }
    char name[WORD_MAX + 1];
    snprintf(name, sizeof name, "%.*s", (int)length, word);
    return error_set(error, ERROR_INPUT,
                     "%s: unknown flag; did you mean %s? ('fairlead %s --help')", name,
                     nearest_option(table, name), table->command);
}

OptionsResult options_parse(const OptionTable *table, int count, char **words, FILE *out,
                            Error *error)
{
    bool given[64] = {false}, has_positional = false;
    ASSERT(table->option_count <= 64);
    // asked for anywhere, help comes before any complaint
    for (int i = 0; i < count; i++)
        if (!strcmp(words[i], "--help") || !strcmp(words[i], "-h")) {
            options_print_help(table, out);
            return OPTIONS_HELP;
        }
    for (int i = 0; i < count; i++) {
        if (words[i][0] == '-' && words[i][1]) {
            const Option *seen = NULL;
            if (!parse_option(table, count, words, &i, &seen, error)) return OPTIONS_REFUSED;
            given[seen - table->options] = true;
        } else if (table->positional && !has_positional) {
            *table->positional_value = words[i];
            has_positional = true;
        } else {
            error_set(error, ERROR_INPUT, "'%s' is one word too many ('fairlead %s --help')",
                      words[i], table->command);
            return OPTIONS_REFUSED;
        }
    }
    if (table->positional_required && !has_positional) {
        error_set(error, ERROR_INPUT, "fairlead %s needs a %s ('fairlead %s --help')",
                  table->command, table->positional, table->command);
        return OPTIONS_REFUSED;
    }
    for (int i = 0; i < table->option_count; i++)
        if (table->options[i].required && !given[i]) {
            error_set(error, ERROR_INPUT, "fairlead %s needs %s %s ('fairlead %s --help')",
                      table->command, table->options[i].name, table->options[i].argument,
                      table->command);
            return OPTIONS_REFUSED;
        }
    return OPTIONS_GO;
}

static void print_default(const Option *option, FILE *out)
{
    if (option->required)
        fprintf(out, " (required)");
    else if (option->kind == OPTION_INTEGER)
        fprintf(out, " (default %d)", *(int *)option->value);
    else if (option->kind == OPTION_TEXT && *(const char **)option->value)
        fprintf(out, " (default %s)", *(const char **)option->value);
}

void options_print_help(const OptionTable *table, FILE *out)
{
    fprintf(out, "fairlead %s", table->command);
    if (table->positional)
        fprintf(out, table->positional_required ? " %s" : " [%s]", table->positional);
    for (int i = 0; i < table->option_count; i++) {
        const Option *option = &table->options[i];
        fprintf(out, option->required ? " %s" : " [%s", option->name);
        if (option->argument) fprintf(out, " %s", option->argument);
        if (!option->required) fprintf(out, option->kind == OPTION_LIST ? "]..." : "]");
    }
    fprintf(out, "\n\n%s\n\n", table->summary);
    for (int i = 0; i < table->option_count; i++) {
        const Option *option = &table->options[i];
        char left[64];
        snprintf(left, sizeof left, "%s%s%s", option->name, option->argument ? " " : "",
                 option->argument ? option->argument : "");
        fprintf(out, "  %-24s %s", left, option->help);
        print_default(option, out);
        fprintf(out, "\n");
    }
    fprintf(out, "  %-24s %s\n", "--help", "this text");
    if (table->notes) fprintf(out, "\n%s\n", table->notes);
}
