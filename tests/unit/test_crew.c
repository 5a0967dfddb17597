/// What a thread and its helpers cost together.
#define _GNU_SOURCE
#include "crew.h"
#include "test.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <time.h>

typedef struct Helper {
    pthread_t thread;
    atomic_bool done, end;
    double work; ///< [s of processor time]
    int policy;
} Helper;

static double used_time(void)
{
    struct timespec used;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

static void *work(void *argument)
{
    Helper *helper = argument;
    const struct timespec moment = {.tv_nsec = 1000000};
    helper->policy = sched_getscheduler(0);
    while (used_time() < helper->work) {
    }
    atomic_store(&helper->done, true);
    while (!atomic_load(&helper->end))
        nanosleep(&moment, NULL);
    return NULL;
}

static void start(Helper *helper) { pthread_create(&helper->thread, NULL, work, helper); }

static void wait_done(const Helper *helper)
{
    const struct timespec moment = {.tv_nsec = 1000000};
    while (!atomic_load(&helper->done))
        nanosleep(&moment, NULL);
}

static void join(Helper *helper)
{
    atomic_store(&helper->end, true);
    pthread_join(helper->thread, NULL);
}

TEST(a_crew_costs_what_its_own_helpers_cost_and_nobody_else)
{
    static Crew crew;
    Helper stranger = {.work = 0.2}, helper = {.work = 0.05};
    start(&stranger);
    crew_begin(&crew);
    start(&helper);
    crew_end(&crew);
    CHECK(crew.count == 2);
    wait_done(&stranger);
    wait_done(&helper);
    double cost = crew_seconds(&crew) - used_time();
    CHECK(cost > 0.049 && cost < 0.1);
    join(&stranger);
    join(&helper);
}

TEST(helpers_inherit_that_their_crew_stands_back)
{
    Helper helper = {0}, other = {0};
    start(&other); // a thread that does not stand back stays as it is
    crew_stand_back();
    start(&helper);
    wait_done(&helper);
    wait_done(&other);
    CHECK(helper.policy == SCHED_BATCH);
    CHECK(other.policy == SCHED_OTHER);
    join(&helper);
    join(&other);
}

TEST(this_process_has_a_core) { CHECK(core_count() >= 1); }
