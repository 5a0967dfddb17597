/// One arena per owner: memory is taken piecewise and given back all at once.
#ifndef FAIRLEAD_BASE_ARENA_H
#define FAIRLEAD_BASE_ARENA_H

#include <stddef.h>

#include "base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ArenaBlock ArenaBlock;

typedef struct Arena {
    ArenaBlock *blocks; ///< newest first
    size_t bytes;       ///< handed out so far [byte]
    size_t limit;       ///< most that may be handed out [byte]; 0 = no limit
} Arena;

/// Every array starts on a cache line (and a full AVX-512 register).
enum { ARENA_ALIGNMENT = 64 };

/// An empty arena that refuses to hand out more than `limit` bytes (0 = no limit).
Arena arena_create(size_t limit);

/// Zeroed memory for `count` items of `size` bytes, aligned to ARENA_ALIGNMENT.
/// @param what  name of the array, for the error message
/// @return NULL with `error` set (ERROR_SYSTEM) when memory or the limit is exhausted
void *arena_take(Arena *arena, size_t count, size_t size, const char *what, Error *error);

/// Give everything back; the arena may be used again.
void arena_destroy(Arena *arena);

#ifdef __cplusplus
}
#endif
#endif
