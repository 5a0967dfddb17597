#include "mailbox.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { TRIPLE_FRESH = 4, TRIPLE_INDEX = 3 };

double clock_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void triple_slot_init(TripleSlot *slot)
{
    slot->back = 0;
    slot->front = 1;
    atomic_init(&slot->middle, 2);
}

unsigned triple_slot_publish(TripleSlot *slot)
{
    unsigned old =
        atomic_exchange_explicit(&slot->middle, slot->back | TRIPLE_FRESH, memory_order_acq_rel);
    slot->back = old & TRIPLE_INDEX;
    return slot->back;
}

bool triple_slot_take(TripleSlot *slot)
{
    if (!(atomic_load_explicit(&slot->middle, memory_order_relaxed) & TRIPLE_FRESH)) return false;
    unsigned old = atomic_exchange_explicit(&slot->middle, slot->front, memory_order_acq_rel);
    slot->front = old & TRIPLE_INDEX;
    return true;
}

bool queue_init(Queue *queue, size_t item_size, size_t capacity)
{
    *queue = (Queue){.item_size = item_size, .capacity = capacity};
    pthread_mutex_init(&queue->mutex, NULL);
    queue->items = calloc(capacity, item_size);
    return queue->items != NULL;
}

void queue_destroy(Queue *queue)
{
    pthread_mutex_destroy(&queue->mutex);
    free(queue->items);
}

bool queue_put(Queue *queue, const void *item)
{
    pthread_mutex_lock(&queue->mutex);
    bool room = queue->count < queue->capacity;
    if (room) {
        size_t place = (queue->first + queue->count++) % queue->capacity;
        memcpy(queue->items + place * queue->item_size, item, queue->item_size);
    }
    pthread_mutex_unlock(&queue->mutex);
    return room;
}

bool queue_take(Queue *queue, void *item)
{
    pthread_mutex_lock(&queue->mutex);
    bool some = queue->count > 0;
    if (some) {
        memcpy(item, queue->items + queue->first * queue->item_size, queue->item_size);
        queue->first = (queue->first + 1) % queue->capacity;
        queue->count--;
    }
    pthread_mutex_unlock(&queue->mutex);
    return some;
}

bool queue_is_empty(Queue *queue)
{
    pthread_mutex_lock(&queue->mutex);
    bool empty = queue->count == 0;
    pthread_mutex_unlock(&queue->mutex);
    return empty;
}

void bell_init(Bell *bell)
{
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_mutex_init(&bell->mutex, NULL);
    pthread_cond_init(&bell->condition, &attributes);
    pthread_condattr_destroy(&attributes);
    bell->rung = false;
}

void bell_destroy(Bell *bell)
{
    pthread_cond_destroy(&bell->condition);
    pthread_mutex_destroy(&bell->mutex);
}

void bell_ring(Bell *bell)
{
    pthread_mutex_lock(&bell->mutex);
    bell->rung = true;
    pthread_cond_signal(&bell->condition);
    pthread_mutex_unlock(&bell->mutex);
}

bool bell_wait(Bell *bell, double seconds)
{
    double until = clock_seconds() + (seconds > 0 ? seconds : 0);
    struct timespec deadline = {.tv_sec = (time_t)until};
    deadline.tv_nsec = (long)((until - (double)deadline.tv_sec) * 1e9);
    pthread_mutex_lock(&bell->mutex);
    int status = 0;
    while (!bell->rung && status != ETIMEDOUT)
        status = pthread_cond_timedwait(&bell->condition, &bell->mutex, &deadline);
    bool rung = bell->rung;
    bell->rung = false;
    pthread_mutex_unlock(&bell->mutex);
    return rung;
}
