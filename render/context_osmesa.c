/// Off-screen OpenGL in plain memory through Mesa's OSMesa (gone from Mesa 25.1, so optional: its
/// header at build time, the library opened when the program runs).
#include <GL/osmesa.h>

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"

enum { BUFFER_SIDE = 16 }; ///< a bound buffer is required; drawing goes to framebuffer objects

typedef struct OsmesaData {
    OSMesaContext context;
    GLboolean (*make_current)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    void (*destroy_context)(OSMesaContext);
    unsigned char buffer[BUFFER_SIDE * BUFFER_SIDE * 4];
} OsmesaData;

/// A data pointer turned into a function pointer, which ISO C cannot cast.
static ContextFunction symbol(void *library, const char *name)
{
    void *address = library ? dlsym(library, name) : NULL;
    ContextFunction function = NULL;
    memcpy(&function, &address, sizeof function);
    return function;
}

/// Opened once more for each caller and never closed: llvmpipe's threads outlive a context.
static void *library(void)
{
    void *found = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    return found ? found : dlopen("libOSMesa.so", RTLD_NOW | RTLD_LOCAL);
}

static ContextFunction osmesa_function(const char *name)
{
    OSMESAproc (*get)(const char *) =
        (OSMESAproc(*)(const char *))symbol(library(), "OSMesaGetProcAddress");
    return get ? (ContextFunction)get(name) : NULL;
}

static bool osmesa_bind(Context *context)
{
    OsmesaData *data = context->data;
    return data->make_current(data->context, data->buffer, GL_UNSIGNED_BYTE, BUFFER_SIDE,
                              BUFFER_SIDE);
}

static void osmesa_release(Context *context)
{
    OsmesaData *data = context->data;
    data->make_current(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
}

static void osmesa_destroy(Context *context)
{
    OsmesaData *data = context->data;
    if (!data) return;
    osmesa_release(context);
    data->destroy_context(data->context);
    free(data);
    context->data = NULL;
}

bool context_osmesa(Context *context, Error *error)
{
    void *opened = library();
    if (!opened) return error_set(error, ERROR_SYSTEM, "libOSMesa is not installed");
    OSMesaContext (*create)(const int *, OSMesaContext) =
        (OSMesaContext(*)(const int *, OSMesaContext))symbol(opened, "OSMesaCreateContextAttribs");
    OsmesaData *data = calloc(1, sizeof *data);
    if (!data) return error_set(error, ERROR_SYSTEM, "out of memory");
    data->make_current = (GLboolean(*)(OSMesaContext, void *, GLenum, GLsizei, GLsizei))symbol(
        opened, "OSMesaMakeCurrent");
    data->destroy_context = (void (*)(OSMesaContext))symbol(opened, "OSMesaDestroyContext");
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    if (create && data->make_current && data->destroy_context)
        data->context = create(attributes, NULL);
    *context =
        (Context){"OSMesa", data, osmesa_function, osmesa_bind, osmesa_release, osmesa_destroy};
    if (data->context && osmesa_bind(context)) return true;
    if (data->context) data->destroy_context(data->context);
    free(data);
    context->data = NULL;
    return error_set(error, ERROR_SYSTEM, "OSMesa gives no OpenGL 3.3 core context");
}
