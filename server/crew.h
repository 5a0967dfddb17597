/// A thread and the helpers that libraries start for it (llvmpipe draws with threads of its own):
/// what they cost together, and that they interrupt nobody.
#ifndef FAIRLEAD_CREW_H
#define FAIRLEAD_CREW_H

enum { CREW_THREADS_MAX = 1024 };

typedef struct Crew {
    int count;
    int threads[CREW_THREADS_MAX]; ///< Linux thread numbers
} Crew;

/// Let the calling thread, and those it starts, wait for a pause of the others when they wake up
/// rather than interrupt them. Their share of busy cores stays the same.
void crew_stand_back(void);

/// Note the threads there are, before the calling thread lets a library start helpers.
void crew_begin(Crew *crew);
/// The crew is the calling thread and all threads that came since crew_begin. Nobody else may start
/// any in between.
void crew_end(Crew *crew);
/// Processor time the crew has used so far [s].
double crew_seconds(const Crew *crew);

/// Cores this process may use.
int core_count(void);

#endif
