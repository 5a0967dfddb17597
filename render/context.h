/// An off-screen OpenGL core context, one file per way of getting one. Third-party headers stay in
/// those files.
#ifndef FAIRLEAD_CONTEXT_H
#define FAIRLEAD_CONTEXT_H

#include <stdbool.h>

#include "base/error.h"

typedef void (*ContextFunction)(void);

typedef struct Context {
    const char *name; ///< "EGL device", "EGL surfaceless", "OSMesa"
    void *data;       ///< owned by the kind of context
    ContextFunction (*function)(const char *name);
    bool (*bind)(struct Context *context);    ///< make current on this thread
    void (*release)(struct Context *context); ///< no longer current on this thread
    void (*destroy)(struct Context *context);
} Context;

/// Try EGL device (hardware) → EGL surfaceless → EGL software device → OSMesa; the environment's
/// FAIRLEAD_GL=egl-device|surfaceless|software|osmesa allows one of them only. The context is
/// current on this thread afterwards.
/// @return false with ERROR_SYSTEM listing what was tried and why it failed
bool context_create(Context *context, Error *error);

// The kinds. Each returns false with `error` set when this machine does not have it.

/// @param software  the software device instead of the first hardware device
bool context_egl_device(Context *context, bool software, Error *error);
bool context_egl_surfaceless(Context *context, Error *error);
bool context_osmesa(Context *context, Error *error);

#endif
