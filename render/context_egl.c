/// Off-screen OpenGL through EGL: a device of its own choosing, or Mesa's surfaceless platform.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <stdlib.h>
#include <string.h>

#include "context.h"

enum { DEVICES_MAX = 32 };

typedef struct EglData {
    EGLDisplay display;
    EGLContext context;
    bool counted; ///< the display counts its users, so that it may be terminated
} EglData;

/// A whole word of a blank-separated list of extensions.
static bool has_extension(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || !at[length])) return true;
    return false;
}

static ContextFunction egl_function(const char *name)
{
    return (ContextFunction)eglGetProcAddress(name);
}

static bool egl_bind(Context *context)
{
    EglData *data = context->data;
    return eglMakeCurrent(data->display, EGL_NO_SURFACE, EGL_NO_SURFACE, data->context);
}

static void egl_release(Context *context)
{
    EglData *data = context->data;
    eglMakeCurrent(data->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

static void egl_destroy(Context *context)
{
    EglData *data = context->data;
    if (!data) return;
    if (data->context != EGL_NO_CONTEXT) {
        egl_release(context);
        eglDestroyContext(data->display, data->context);
    }
    // One display serves every Render of the process: ending it would end the others' contexts.
    if (data->counted) eglTerminate(data->display);
    eglReleaseThread();
    free(data);
    context->data = NULL;
}

/// The newest core context from 4.5 down to 3.3.
static EGLContext create_core_context(EGLDisplay display, EGLConfig config)
{
    static const int versions[][2] = {{4, 5}, {4, 3}, {4, 1}, {3, 3}};
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               versions[i][0],
                               EGL_CONTEXT_MINOR_VERSION,
                               versions[i][1],
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
        EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
        if (context != EGL_NO_CONTEXT) return context;
    }
    return EGL_NO_CONTEXT;
}

/// Finish a context on an initialised display.
static bool open_context(Context *context, Error *error)
{
    EglData *data = context->data;
    if (!has_extension(eglQueryString(data->display, EGL_EXTENSIONS),
                       "EGL_KHR_surfaceless_context"))
        return error_set(error, ERROR_SYSTEM, "no contexts without a surface");
    if (!eglBindAPI(EGL_OPENGL_API)) return error_set(error, ERROR_SYSTEM, "no desktop OpenGL");
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = NULL;
    EGLint count = 0;
    if (!eglChooseConfig(data->display, wanted, &config, 1, &count) || count < 1)
        config = EGL_NO_CONFIG_KHR;
    data->context = create_core_context(data->display, config);
    if (data->context == EGL_NO_CONTEXT)
        return error_set(error, ERROR_SYSTEM, "no OpenGL 3.3 core context (EGL error 0x%x)",
                         eglGetError());
    if (!egl_bind(context))
        return error_set(error, ERROR_SYSTEM, "the context cannot be made current (EGL error 0x%x)",
                         eglGetError());
    return true;
}

/// Get and initialise a display of a platform, then a context on it.
static bool open_platform(Context *context, const char *name, EGLenum platform, void *native,
                          Error *error)
{
    const char *client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (!get_display) return error_set(error, ERROR_SYSTEM, "no EGL platforms");
    bool counted = has_extension(client, "EGL_KHR_display_reference");
    const EGLint counting[] = {EGL_TRACK_REFERENCES_KHR, EGL_TRUE, EGL_NONE};
    EGLDisplay display = get_display(platform, native, counted ? counting : NULL);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL))
        return error_set(error, ERROR_SYSTEM, "the display cannot be initialised (EGL error 0x%x)",
                         eglGetError());
    EglData *data = calloc(1, sizeof *data);
    if (!data) return error_set(error, ERROR_SYSTEM, "out of memory");
    data->display = display;
    data->counted = counted;
    Context opened = {name, data, egl_function, egl_bind, egl_release, egl_destroy};
    data->context = EGL_NO_CONTEXT;
    if (!open_context(&opened, error)) {
        egl_destroy(&opened);
        return false;
    }
    *context = opened;
    return true;
}

bool context_egl_device(Context *context, bool software, Error *error)
{
    PFNEGLQUERYDEVICESEXTPROC query_devices =
        (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    PFNEGLQUERYDEVICESTRINGEXTPROC query_string =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)eglGetProcAddress("eglQueryDeviceStringEXT");
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint count = 0;
    if (!query_devices || !query_string || !query_devices(DEVICES_MAX, devices, &count))
        return error_set(error, ERROR_SYSTEM, "EGL lists no devices");
    error_set(error, ERROR_SYSTEM, "no %s device", software ? "software" : "hardware");
    for (EGLint i = 0; i < count; i++) {
        const char *extensions = query_string(devices[i], EGL_EXTENSIONS);
        if (has_extension(extensions, "EGL_MESA_device_software") != software) continue;
        if (open_platform(context, software ? "EGL software device" : "EGL device",
                          EGL_PLATFORM_DEVICE_EXT, devices[i], error))
            return true;
    }
    return false;
}

bool context_egl_surfaceless(Context *context, Error *error)
{
    if (!has_extension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS),
                       "EGL_MESA_platform_surfaceless"))
        return error_set(error, ERROR_SYSTEM, "EGL has no surfaceless platform");
    return open_platform(context, "EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA,
                         EGL_DEFAULT_DISPLAY, error);
}
