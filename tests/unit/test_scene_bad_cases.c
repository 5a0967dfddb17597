/// Each file of tests/bad_cases is refused before anything runs, with one line that contains what
/// tests/bad_cases/expected.txt says.
#include <dirent.h>

#include "engine.h"
#include "test.h"

#define FOLDER SOURCE_DIR "/tests/bad_cases/"

static void say(const char *name, const char *what)
{
    printf("  %s: %s\n", name, what);
    test_failures++;
}

/// Load and plan, as `fairlead run` does. @return true when the case is accepted
static bool accepted(const char *name, Error *error)
{
    char path[512];
    Scene scene;
    Plan plan;
    EngineOptions options = {.threads = 1, .backend = "cpu"};
    snprintf(path, sizeof path, "%s%s", FOLDER, name);
    if (!scene_load(path, NULL, 0, &scene, error)) return false;
    if (!plan_build(&scene, &options, &plan, error)) return false;
    plan_destroy(&plan);
    return true;
}

/// Next "file|substring" of the table; comments are skipped.
static bool next_row(FILE *table, char *line, int size, char **expected)
{
    while (fgets(line, size, table)) {
        line[strcspn(line, "\n")] = 0;
        *expected = strchr(line, '|');
        if (line[0] == '#' || !*expected) continue;
        *(*expected)++ = 0;
        return true;
    }
    return false;
}

TEST(bad_cases_are_refused_with_place_and_accepted_range)
{
    char line[512], *expected;
    int count = 0;
    FILE *table = fopen(FOLDER "expected.txt", "r");
    CHECK(table != NULL);
    while (table && next_row(table, line, sizeof line, &expected)) {
        Error error = {0};
        if (accepted(line, &error))
            say(line, "is accepted");
        else if (!strstr(error.message, expected))
            printf("  wanted: %s\n", expected), say(line, error.message);
        else if (error.code != ERROR_INPUT || strchr(error.message, '\n'))
            say(line, "is not one line about input");
        count++;
    }
    if (table) fclose(table);
    CHECK(count >= 24);
}

TEST(every_bad_case_stands_in_the_table)
{
    char line[512], *expected, listed[16384] = "|";
    FILE *table = fopen(FOLDER "expected.txt", "r");
    while (table && next_row(table, line, sizeof line, &expected)) {
        size_t used = strlen(listed);
        snprintf(listed + used, sizeof listed - used, "%s|", line);
    }
    if (table) fclose(table);
    DIR *folder = opendir(FOLDER);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char name[300];
        const char *dot = strrchr(entry->d_name, '.');
        snprintf(name, sizeof name, "|%s|", entry->d_name);
        if (dot && strcmp(dot, ".json") == 0 && !strstr(listed, name))
            say(entry->d_name, "is not in expected.txt");
    }
    if (folder) closedir(folder);
}

TEST(a_folder_or_a_missing_file_is_no_case)
{
    Error error = {0};
    Scene scene;
    CHECK(!scene_load(FOLDER, NULL, 0, &scene, &error));
    CHECK_CONTAINS(error.message, "cannot be read");
    CHECK(!scene_load(FOLDER "no_such_case.json", NULL, 0, &scene, &error));
    CHECK_CONTAINS(error.message, "no_such_case.json: cannot be opened");
    CHECK(error.code == ERROR_INPUT);
}
