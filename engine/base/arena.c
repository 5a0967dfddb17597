#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct ArenaBlock {
    ArenaBlock *next;
    char padding[ARENA_ALIGNMENT - sizeof(ArenaBlock *)]; ///< keeps the data aligned
};

Arena arena_create(size_t limit)
{
    Arena arena = {NULL, 0, limit};
    return arena;
}

void *arena_take(Arena *arena, size_t count, size_t size, const char *what, Error *error)
{
    if (size && count > (SIZE_MAX - 2 * ARENA_ALIGNMENT) / size) {
        error_set(error, ERROR_SYSTEM, "memory: %s: %zu items of %zu bytes cannot be addressed",
                  what, count, size);
        return NULL;
    }
    size_t bytes = (count * size + ARENA_ALIGNMENT - 1) / ARENA_ALIGNMENT * ARENA_ALIGNMENT;
    if (arena->limit && arena->bytes + bytes > arena->limit) {
        error_set(error, ERROR_SYSTEM, "memory: %s needs %zu bytes; %zu of %zu are left", what,
                  bytes, arena->limit - arena->bytes, arena->limit);
        return NULL;
    }
    ArenaBlock *block = aligned_alloc(ARENA_ALIGNMENT, sizeof *block + bytes);
    if (!block) {
        error_set(error, ERROR_SYSTEM, "memory: %s needs %zu bytes and the system gave none", what,
                  bytes);
        return NULL;
    }
    block->next = arena->blocks;
    arena->blocks = block;
    arena->bytes += bytes;
    return memset(block + 1, 0, bytes);
}

void arena_destroy(Arena *arena)
{
    for (ArenaBlock *block = arena->blocks; block;) {
        ArenaBlock *next = block->next;
        free(block);
        block = next;
    }
    arena->blocks = NULL;
    arena->bytes = 0;
}
