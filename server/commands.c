#include "commands.h"

#include <libgen.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool prepare(const char *path, const OptionList *overrides, const EngineOptions *options,
             Prepared *prepared, Error *error)
{
    *prepared = (Prepared){.scene = calloc(1, sizeof(Scene)),
                           .plan = calloc(1, sizeof(Plan)),
                           .table = calloc(1, sizeof(SeriesTable))};
    if (!prepared->scene || !prepared->plan || !prepared->table) {
        error_set(error, ERROR_SYSTEM, "no memory left for the case");
    } else if (scene_load(path, overrides->values, overrides->count, prepared->scene, error) &&
               plan_build(prepared->scene, options, prepared->plan, error)) {
        series_table(prepared->scene, prepared->table);
        return true;
    }
    free(prepared->scene);
    free(prepared->plan);
    free(prepared->table);
    *prepared = (Prepared){0};
    return false;
}

void prepared_destroy(Prepared *prepared)
{
    if (prepared->plan) plan_destroy(prepared->plan);
    free(prepared->scene);
    free(prepared->plan);
    free(prepared->table);
    *prepared = (Prepared){0};
}

int report(const Error *error)
{
    fprintf(stderr, "fairlead: %s\n", error->message);
    return error->code == ERROR_PHYSICS ? EXIT_SICK : EXIT_REFUSED;
}

void program_folder(char *folder, int size)
{
    char path[SCENE_PATH_SIZE];
    ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    snprintf(folder, (size_t)size, ".");
    if (length <= 0) return;
    path[length] = 0;
    snprintf(folder, (size_t)size, "%s", dirname(path));
}

const char *find_default_case(char *room, int size)
{
    if (!access(DEFAULT_CASE, R_OK)) return DEFAULT_CASE;
    char folder[SCENE_PATH_SIZE];
    program_folder(folder, sizeof folder);
    snprintf(room, (size_t)size, "%s/../%s", folder, DEFAULT_CASE);
    return access(room, R_OK) ? DEFAULT_CASE : room;
}

static const struct {
    const char *name;
    int (*function)(int count, char **words);
    const char *summary;
} subcommands[] = {
    {"serve", command_serve, "simulate, draw and show it in a web page where it can be steered"},
    {"run", command_run, "simulate without a page; write series, summary, journal and frames"},
    {"explain", command_explain, "say what would be simulated, why, and how fast"},
    {"bench", command_bench, "time steps of a scene of so many particles on this machine"},
};
enum { SUBCOMMAND_COUNT = sizeof subcommands / sizeof *subcommands };

static void print_help(void)
{
    printf("fairlead: a moored ship in waves, simulated with smoothed particles\n\n"
           "fairlead COMMAND ...\n\n");
    for (int i = 0; i < SUBCOMMAND_COUNT; i++)
        printf("  %-10s %s\n", subcommands[i].name, subcommands[i].summary);
    printf("\n  --help     this text; 'fairlead COMMAND --help' for one command\n"
           "  --version  the version\n\nWithout a command: fairlead serve\n");
}

static int refuse_command(const char *word)
{
    const char *best = subcommands[0].name;
    for (int i = 1; i < SUBCOMMAND_COUNT; i++)
        if (options_distance(word, subcommands[i].name) < options_distance(word, best))
            best = subcommands[i].name;
    if (word[0] == '-') best = options_distance(word, "--version") < 4 ? "--version" : "--help";
    fprintf(stderr, "fairlead: '%.40s': unknown %s; did you mean %s? ('fairlead --help')\n", word,
            word[0] == '-' ? "flag" : "command", best);
    return EXIT_REFUSED;
}

int fairlead_main(int argc, char **argv)
{
    if (argc < 2) return command_serve(0, NULL);
    if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h") || !strcmp(argv[1], "help")) {
        print_help();
        return EXIT_GOOD;
    }
    if (!strcmp(argv[1], "--version")) {
        printf("fairlead %s\n", FAIRLEAD_VERSION);
        return EXIT_GOOD;
    }
    for (int i = 0; i < SUBCOMMAND_COUNT; i++)
        if (!strcmp(argv[1], subcommands[i].name))
            return subcommands[i].function(argc - 2, argv + 2);
    return refuse_command(argv[1]);
}
