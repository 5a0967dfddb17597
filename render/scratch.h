/// A buffer that only grows: what a picture needs is kept for the next one.
#ifndef FAIRLEAD_SCRATCH_H
#define FAIRLEAD_SCRATCH_H

#include <stdlib.h>

#include "base/error.h"

typedef struct Scratch {
    void *data;
    size_t size; ///< [byte]
} Scratch;

/// @return memory of at least `size` bytes, owned by the scratch; NULL with ERROR_SYSTEM
static inline void *scratch_need(Scratch *scratch, size_t size, Error *error)
{
    if (size <= scratch->size && scratch->data) return scratch->data;
    size_t grown = size + size / 4 + 64;
    void *data = realloc(scratch->data, grown);
    if (!data) {
        error_set(error, ERROR_SYSTEM, "out of memory for the picture (%zu bytes)", grown);
        return NULL;
    }
    scratch->data = data;
    scratch->size = grown;
    return data;
}

static inline void scratch_free(Scratch *scratch)
{
    free(scratch->data);
    *scratch = (Scratch){0};
}

#endif
