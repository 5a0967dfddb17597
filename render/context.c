#include "context.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool hardware_device(Context *context, Error *error)
{
    return context_egl_device(context, false, error);
}

static bool software_device(Context *context, Error *error)
{
    return context_egl_device(context, true, error);
}

#ifndef FAIRLEAD_HAVE_OSMESA
bool context_osmesa(Context *context, Error *error)
{
    return error_set(error, ERROR_SYSTEM, "this build has no OSMesa");
}
#endif

/// In the order of trial: surfaceless before hardware devices may silently choose the processor
/// beside a graphics card.
static const struct {
    const char *key;
    bool (*create)(Context *context, Error *error);
} kinds[] = {
    {"egl-device", hardware_device},
    {"surfaceless", context_egl_surfaceless},
    {"software", software_device},
    {"osmesa", context_osmesa},
};

bool context_create(Context *context, Error *error)
{
    const char *wanted = getenv("FAIRLEAD_GL");
    char tried[720] = "";
    bool known = false;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (wanted && *wanted && strcmp(wanted, kinds[i].key) != 0) continue;
        known = true;
        Error reason = {0};
        if (kinds[i].create(context, &reason)) return true;
        size_t used = strlen(tried);
        snprintf(tried + used, sizeof tried - used, "%s%s: %.150s", used ? "; " : "", kinds[i].key,
                 reason.message);
    }
    if (!known)
        return error_set(error, ERROR_SYSTEM,
                         "FAIRLEAD_GL=%s: accepted are egl-device, surfaceless, software, osmesa",
                         wanted);
    return error_set(error, ERROR_SYSTEM, "no OpenGL context for pictures (%s)", tried);
}
