#define _GNU_SOURCE
#include "crew.h"

#include <dirent.h>
#include <pthread.h>
#include <sched.h>
#include <stdbool.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

void crew_stand_back(void)
{
    // No niceness beyond that: five steps of it stretched pictures to seconds on a busy machine.
    const struct sched_param none = {0};
    pthread_setschedparam(pthread_self(), SCHED_BATCH, &none);
}

static int list_threads(int threads[CREW_THREADS_MAX])
{
    int count = 0;
    DIR *folder = opendir("/proc/self/task");
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        int thread = (int)strtol(entry->d_name, NULL, 10);
        if (thread > 0 && count < CREW_THREADS_MAX) threads[count++] = thread;
    }
    if (folder) closedir(folder);
    return count;
}

void crew_begin(Crew *crew) { crew->count = list_threads(crew->threads); }

static bool contains(const int *threads, int count, int thread)
{
    for (int i = 0; i < count; i++)
        if (threads[i] == thread) return true;
    return false;
}

void crew_end(Crew *crew)
{
    int now[CREW_THREADS_MAX], count = list_threads(now), crew_count = 0;
    for (int i = 0; i < count; i++)
        if (now[i] == gettid() || !contains(crew->threads, crew->count, now[i]))
            now[crew_count++] = now[i];
    for (int i = 0; i < crew_count; i++)
        crew->threads[i] = now[i];
    crew->count = crew_count;
}

/// The clock of a thread known by number only, as pthread_getcpuclockid makes it.
static clockid_t thread_clock(int thread) { return (clockid_t)(~(unsigned)thread << 3 | 6u); }

double crew_seconds(const Crew *crew)
{
    double sum = 0;
    for (int i = 0; i < crew->count; i++) {
        struct timespec used;
        if (clock_gettime(thread_clock(crew->threads[i]), &used)) continue; // it has ended
        sum += (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
    }
    return sum;
}

int core_count(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set)) return (int)sysconf(_SC_NPROCESSORS_ONLN);
    return CPU_COUNT(&set);
}
