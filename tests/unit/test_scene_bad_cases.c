/// Each file of tests/bad_cases is refused before anything runs, with one line that contains what
/// tests/bad_cases/expected.txt says.
#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

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

/// A repeatable number below `range` (Knuth's MMIX generator).
static unsigned draw(unsigned long long *state, unsigned range)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (unsigned)(*state >> 33) % range;
}

/// Damage a text: a byte changed, a piece cut out, or a value replaced by an odd one.
static size_t damage(char *text, size_t length, unsigned long long *state)
{
    static const char *const odd[] = {"-1",       "1e999", "0",      "null", "[]",
                                      "{}",       "\"\"",  "1e300",  "true", "[1,2]",
                                      "\"free\"", "2.5",   "1e-300", "[[]]", "-"};
    size_t at = draw(state, (unsigned)length), cut = 1 + draw(state, 20);
    unsigned way = draw(state, 3);
    char *colon = memchr(text + at, ':', length - at);
    if (way == 0) {
        text[at] = (char)draw(state, 256);
    } else if (way == 1 && at + cut < length) {
        memmove(text + at, text + at + cut, length - at - cut);
        length -= cut;
    } else if (way == 2 && colon) {
        const char *value = odd[draw(state, sizeof odd / sizeof *odd)];
        size_t begin = (size_t)(colon - text) + 1, end = begin, size = strlen(value);
        while (end < length && !strchr(",\n}", text[end]))
            end++;
        memmove(text + begin + size, text + end, length - end);
        memcpy(text + begin, value, size);
        length = length - (end - begin) + size;
    }
    return length;
}

TEST(damaged_cases_are_loaded_or_refused_in_one_line_but_never_crash)
{
    static char good[8192], text[16384];
    static Scene scene;
    char path[] = "/tmp/fairlead_test_damage_XXXXXX";
    int file = mkstemp(path), refused = 0, odd_errors = 0;
    FILE *source = fopen(SOURCE_DIR "/tests/good_cases/steered.json", "rb");
    size_t size = source ? fread(good, 1, sizeof good, source) : 0;
    if (source) fclose(source);
    CHECK(file >= 0 && size > 0 && size < sizeof good);
    unsigned long long state = 20260101;
    for (int i = 0; i < 2000 && size; i++) {
        size_t length = size;
        memcpy(text, good, size);
        for (unsigned k = 1 + draw(&state, 3); k > 0 && length; k--)
            length = damage(text, length, &state);
        if (ftruncate(file, 0) || pwrite(file, text, length, 0) != (ssize_t)length) break;
        Error error = {0};
        if (scene_load(path, NULL, 0, &scene, &error)) continue;
        refused++;
        odd_errors += error.code != ERROR_INPUT || !error.message[0] || strchr(error.message, '\n');
    }
    if (file >= 0) close(file);
    unlink(path);
    CHECK(refused > 1000);
    CHECK(odd_errors == 0);
}
