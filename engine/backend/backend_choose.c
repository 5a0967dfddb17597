#include <string.h>

#include "backend/backend.h"

#ifndef FAIRLEAD_CUDA
const BackendTable *backend_cuda(void) { return NULL; }
#endif

const BackendTable *backend_choose(const char *name, Error *error)
{
    if (!name || !strcmp(name, "auto")) return backend_cuda() ? backend_cuda() : backend_cpu();
    if (!strcmp(name, "cpu")) return backend_cpu();
    if (!strcmp(name, "cuda")) {
        if (backend_cuda()) return backend_cuda();
        error_set(error, ERROR_INPUT,
                  "--backend = cuda: this program was built without CUDA; use auto or cpu");
        return NULL;
    }
    error_set(error, ERROR_INPUT, "--backend = \"%s\": must be auto, cpu or cuda", name);
    return NULL;
}
