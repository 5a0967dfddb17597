// The option table: values, ranges, help, and the nearest known flag for a typo.
#include "options.h"
#include "test.h"

static int port, threads;
static double until;
static bool quiet;
static const char *backend, *path;
static OptionList sets;

static OptionsResult parse(int count, char **words, Error *error)
{
    port = 8080;
    threads = 0;
    until = 0;
    quiet = false;
    backend = "auto";
    path = NULL;
    sets.count = 0;
    const Option options[] = {
        {"--port", "N", OPTION_INTEGER, false, &port, 0, 65535, NULL, "port"},
        {"--threads", "N", OPTION_INTEGER, false, &threads, 0, 64, NULL, "threads"},
        {"--until", "SECONDS", OPTION_NUMBER, true, &until, 1e-9, 1e9, NULL, "end"},
        {"--backend", "B", OPTION_TEXT, false, &backend, 0, 0, "auto|cpu|cuda", "backend"},
        {"--set", "path=value", OPTION_LIST, false, &sets, 0, 0, NULL, "change"},
        {"--quiet", NULL, OPTION_SWITCH, false, &quiet, 0, 0, NULL, "quiet"},
    };
    OptionTable table = {.command = "run",
                         .summary = "Run.",
                         .positional = "CASE",
                         .positional_required = true,
                         .positional_value = &path,
                         .options = options,
                         .option_count = 6};
    FILE *out = tmpfile();
    OptionsResult result = options_parse(&table, count, words, out, error);
    fclose(out);
    return result;
}

#define PARSE(...)                                                                                 \
    char *words[] = {__VA_ARGS__};                                                                 \
    Error error = {0};                                                                             \
    OptionsResult result = parse(sizeof words / sizeof *words, words, &error)

TEST(values_are_read_in_both_spellings)
{
    PARSE("case.json", "--port=9000", "--until", "2.5", "--set", "a.b=1", "--set=c=d", "--quiet",
          "--backend", "cpu");
    CHECK(result == OPTIONS_GO);
    CHECK(port == 9000 && until == 2.5 && quiet);
    CHECK(!strcmp(path, "case.json") && !strcmp(backend, "cpu"));
    CHECK(sets.count == 2 && !strcmp(sets.values[0], "a.b=1") && !strcmp(sets.values[1], "c=d"));
}

TEST(a_typo_is_refused_with_the_nearest_flag)
{
    PARSE("case.json", "--untl", "3");
    CHECK(result == OPTIONS_REFUSED && error.code == ERROR_INPUT);
    CHECK_CONTAINS(error.message, "--untl");
    CHECK_CONTAINS(error.message, "did you mean --until?");
}

TEST(swapped_letters_count_as_one_change)
{
    CHECK(options_distance("--until", "--until") == 0);
    CHECK(options_distance("--utnil", "--until") == 1);
    CHECK(options_distance("--thread", "--threads") == 1);
    CHECK(options_distance("", "abc") == 3);
    CHECK(options_distance("kitten", "sitting") == 3);
}

TEST(numbers_out_of_range_name_the_range)
{
    PARSE("case.json", "--until", "1", "--port", "70000");
    CHECK(result == OPTIONS_REFUSED);
    CHECK_CONTAINS(error.message, "--port: '70000'");
    CHECK_CONTAINS(error.message, "from 0 to 65535");
}

TEST(words_are_no_numbers)
{
    char *bad[] = {"x", "1.5", "", "1x", "nan", "1e999"};
    for (int i = 0; i < 6; i++) {
        PARSE("case.json", "--until", "1", "--threads", bad[i]);
        CHECK(result == OPTIONS_REFUSED);
    }
}

TEST(a_closed_list_of_words_is_kept)
{
    PARSE("case.json", "--until", "1", "--backend", "gpu");
    CHECK(result == OPTIONS_REFUSED);
    CHECK_CONTAINS(error.message, "auto|cpu|cuda");
}

TEST(what_is_required_is_asked_for)
{
    PARSE("case.json");
    CHECK(result == OPTIONS_REFUSED);
    CHECK_CONTAINS(error.message, "needs --until SECONDS");
}

TEST(a_missing_case_is_asked_for)
{
    PARSE("--until", "1");
    CHECK(result == OPTIONS_REFUSED);
    CHECK_CONTAINS(error.message, "needs a CASE");
}

TEST(a_missing_value_is_asked_for)
{
    PARSE("case.json", "--until");
    CHECK(result == OPTIONS_REFUSED);
    CHECK_CONTAINS(error.message, "--until needs a value");
}

TEST(a_switch_takes_no_value)
{
    PARSE("case.json", "--until", "1", "--quiet=yes");
    CHECK(result == OPTIONS_REFUSED);
    CHECK_CONTAINS(error.message, "takes no value");
}

TEST(a_word_too_many_is_refused)
{
    PARSE("case.json", "other.json", "--until", "1");
    CHECK(result == OPTIONS_REFUSED);
    CHECK_CONTAINS(error.message, "other.json");
}

TEST(help_wins_over_what_is_missing)
{
    PARSE("--help");
    CHECK(result == OPTIONS_HELP);
}
