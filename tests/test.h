/// A small test harness: each TEST is a named fact; main runs all, or those whose name contains
/// argv[1]. Exit status 1 when a check failed.
#ifndef FAIRLEAD_TEST_H
#define FAIRLEAD_TEST_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

typedef void (*TestFunction)(void);
typedef struct TestCase {
    const char *name;
    TestFunction function;
} TestCase;

enum { TESTS_MAX = 256 };
static TestCase test_cases[TESTS_MAX];
static int test_count, test_failures;

#define TEST(fact)                                                                                 \
    static void fact(void);                                                                        \
    __attribute__((constructor)) static void register_##fact(void)                                 \
    {                                                                                              \
        test_cases[test_count].name = #fact;                                                       \
        test_cases[test_count++].function = fact;                                                  \
    }                                                                                              \
    static void fact(void)

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            printf("  %s:%d: not true: %s\n", __FILE__, __LINE__, #condition);                     \
            test_failures++;                                                                       \
        }                                                                                          \
    } while (0)

/// |value - expected| <= tolerance; a not-a-number fails.
#define CHECK_NEAR(value, expected, tolerance)                                                     \
    do {                                                                                           \
        double v_ = (value), e_ = (expected), t_ = (tolerance);                                    \
        if (!(fabs(v_ - e_) <= t_)) {                                                              \
            printf("  %s:%d: %s = %.9g, expected %.9g +- %.3g\n", __FILE__, __LINE__, #value, v_,  \
                   e_, t_);                                                                        \
            test_failures++;                                                                       \
        }                                                                                          \
    } while (0)

#define CHECK_CONTAINS(text, part)                                                                 \
    do {                                                                                           \
        if (!strstr((text), (part))) {                                                             \
            printf("  %s:%d: \"%s\" does not contain \"%s\"\n", __FILE__, __LINE__, (text),        \
                   (part));                                                                        \
            test_failures++;                                                                       \
        }                                                                                          \
    } while (0)

int main(int argc, char **argv)
{
    int run = 0, failed = 0;
    for (int i = 0; i < test_count; i++) {
        if (argc > 1 && !strstr(test_cases[i].name, argv[1])) continue;
        int before = test_failures;
        test_cases[i].function();
        run++;
        failed += test_failures > before;
        printf("%s %s\n", test_failures > before ? "FAIL" : "ok  ", test_cases[i].name);
    }
    printf("%d facts, %d failed\n", run, failed);
    return failed || !run;
}

#endif
