/// What joins the threads: a slot where the latest wins, a bounded queue, a bell to wait on.
#ifndef FAIRLEAD_MAILBOX_H
#define FAIRLEAD_MAILBOX_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/// Seconds of a clock that never jumps.
double clock_seconds(void);

/// Lock-free hand-over of the latest of three buffers from one writer to one reader: neither ever
/// waits, the reader always gets the newest complete one.
///
///     writer fills [back], publish swaps it with the middle; take swaps the middle with [front]
typedef struct TripleSlot {
    atomic_uint middle; ///< index of the middle buffer, plus TRIPLE_FRESH when unread
    unsigned back;      ///< the writer's
    unsigned front;     ///< the reader's
} TripleSlot;

void triple_slot_init(TripleSlot *slot);
/// Writer: buffer `back` is complete. @return the index to fill next (also in slot->back)
unsigned triple_slot_publish(TripleSlot *slot);
/// Reader: make the newest the front. @return false when nothing new came; front stays valid
bool triple_slot_take(TripleSlot *slot);

/// Bounded first-in first-out queue of plain items, for any number of threads.
typedef struct Queue {
    pthread_mutex_t mutex;
    size_t item_size, capacity, count, first;
    unsigned char *items;
} Queue;

bool queue_init(Queue *queue, size_t item_size, size_t capacity);
void queue_destroy(Queue *queue);
/// @return false when full: nothing is stored
bool queue_put(Queue *queue, const void *item);
/// @return false when empty
bool queue_take(Queue *queue, void *item);
bool queue_is_empty(Queue *queue);

/// A bell that remembers one ring.
typedef struct Bell {
    pthread_mutex_t mutex;
    pthread_cond_t condition;
    bool rung;
} Bell;

void bell_init(Bell *bell);
void bell_destroy(Bell *bell);
void bell_ring(Bell *bell);
/// Wait for a ring, at most `seconds`. @return whether it rang
bool bell_wait(Bell *bell, double seconds);

/// How a thread tells the socket thread that something is ready.
typedef struct Wake {
    void (*call)(void *context);
    void *context;
} Wake;
static inline void wake(const Wake *target)
{
    if (target->call) target->call(target->context);
}

#endif
