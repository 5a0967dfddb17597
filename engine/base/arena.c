#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// Under the address sanitizer every array is a block of its own from malloc, so that an overrun or
// a leak is seen; otherwise arrays share blocks of fresh pages.
#if defined(__SANITIZE_ADDRESS__)
enum { FIRST_BLOCK = 0, LARGEST_BLOCK = 0 };
#else
#include <sys/mman.h>
#include <unistd.h>
enum { FIRST_BLOCK = 1 << 18, LARGEST_BLOCK = 1 << 26 };
#endif

/// A stretch of fresh pages that arrays are cut from. Pages that nobody writes cost no memory.
struct ArenaBlock {
    ArenaBlock *next;
    size_t size, used; ///< header included [byte]
    char padding[ARENA_ALIGNMENT - sizeof(ArenaBlock *) - 2 * sizeof(size_t)];
};

Arena arena_create(size_t limit)
{
    Arena arena = {NULL, 0, limit};
    return arena;
}

static size_t next_block_size(const ArenaBlock *last, size_t least)
{
    size_t size = last ? 2 * last->size : FIRST_BLOCK;
    size = size > LARGEST_BLOCK ? LARGEST_BLOCK : size;
    return size > least ? size : least;
}

#if defined(__SANITIZE_ADDRESS__)
static void *pages_take(size_t size)
{
    size = (size + ARENA_ALIGNMENT - 1) / ARENA_ALIGNMENT * ARENA_ALIGNMENT;
    void *memory = aligned_alloc(ARENA_ALIGNMENT, size);
    return memory ? memset(memory, 0, size) : NULL;
}
static void pages_give_back(ArenaBlock *block) { free(block); }
#else
/// Large blocks are asked to be huge pages: a sweep reads clusters at forty places at a time, more
/// small pages than the first-level TLB holds (docs/performance.md). They begin where huge pages
/// do, or how much of a block can be huge, and how much room a run takes, would be left to chance.
static void *pages_take(size_t size)
{
    const size_t huge = (size_t)2 << 20, room = size >= huge ? size + huge : size;
    char *pages = mmap(NULL, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) return NULL;
    if (room == size) return pages;
    size_t before = (huge - (uintptr_t)pages % huge) % huge;
    if (before) munmap(pages, before);
    size_t page = (size_t)sysconf(_SC_PAGESIZE), used = (size + page - 1) / page * page;
    if (room > before + used) munmap(pages + before + used, room - before - used);
    (void)madvise(pages + before, size, MADV_HUGEPAGE); // a wish; refusal is fine
    return pages + before;
}
static void pages_give_back(ArenaBlock *block) { munmap(block, block->size); }
#endif

static ArenaBlock *block_create(size_t size)
{
    ArenaBlock *block = pages_take(size);
    if (!block) return NULL;
    block->size = size;
    block->used = sizeof *block;
    return block;
}

void *arena_take(Arena *arena, size_t count, size_t size, const char *what, Error *error)
{
    if (size && count > (SIZE_MAX - 2 * sizeof(ArenaBlock) - ARENA_ALIGNMENT) / size) {
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
    ArenaBlock *block = arena->blocks;
    if (!block || block->size - block->used < bytes) {
        block = block_create(next_block_size(block, sizeof *block + bytes));
        if (!block) {
            error_set(error, ERROR_SYSTEM, "memory: %s needs %zu bytes and the system gave none",
                      what, bytes);
            return NULL;
        }
        block->next = arena->blocks;
        arena->blocks = block;
    }
    void *taken = (char *)block + block->used;
    block->used += bytes;
    arena->bytes += bytes;
    return taken;
}

void arena_destroy(Arena *arena)
{
    for (ArenaBlock *block = arena->blocks; block;) {
        ArenaBlock *next = block->next;
        pages_give_back(block);
        block = next;
    }
    arena->blocks = NULL;
    arena->bytes = 0;
}
