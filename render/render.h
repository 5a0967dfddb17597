/// Snapshot → pixels → JPEG/PNG, off-screen. One Render owns one GL context and is used by one
/// thread.
#ifndef FAIRLEAD_RENDER_H
#define FAIRLEAD_RENDER_H

#include <stdint.h>

#include "engine.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Render Render; ///< opaque: GL context, shaders, buffers

typedef enum WaterMode { WATER_SURFACE, WATER_PARTICLES } WaterMode;
typedef enum ColourField {
    FIELD_NONE,      ///< looks like water
    FIELD_ELEVATION, ///< [m]
    FIELD_SPEED,     ///< [m/s]
    FIELD_PRESSURE,  ///< [Pa]
} ColourField;

/// Orbit camera.
typedef struct Camera {
    Vec3 target;          ///< [m]
    double distance;      ///< [m], > 0
    double azimuth;       ///< where the eye stands seen from the target, from +x to +y [rad]
    double elevation;     ///< above the horizon [rad], -pi/2..pi/2
    double field_of_view; ///< vertical [rad]
} Camera;

typedef struct ViewOptions {
    Camera camera;
    int width, height; ///< [pixel], 16 to 4096
    WaterMode water;
    ColourField field;
    bool dark;    ///< sky and overlay colours for a dark page
    bool overlay; ///< time and wave as text, colour bars
    int samples;  ///< 4 draws at twice the size and averages, for stills; 0 for live pictures
} ViewOptions;

ViewOptions view_options_default(void);
/// First look at a scene: the case's camera, gaps filled so that the scene fits.
Camera camera_for_scene(const Scene *scene);

/// EGL device (not the software one) → EGL surfaceless → software device → OSMesa.
/// @return NULL with ERROR_SYSTEM listing what was tried
Render *render_create(Error *error);
void render_destroy(Render *render);
/// "EGL surfaceless, llvmpipe (LLVM 15.0.6 …), OpenGL 4.5" for logs and the page.
const char *render_description(const Render *render);

/// Draw into the render's own target.
bool render_draw(Render *render, const Snapshot *snapshot, const ViewOptions *view, Error *error);

/// The last picture, top row first. @param rgb  [height][width][3], borrowed until the next draw
const uint8_t *render_pixels(Render *render, int *width, int *height);

/// The last picture as JPEG or PNG. @return bytes, borrowed until the next call of either
const uint8_t *render_jpeg(Render *render, int quality, size_t *size, Error *error);
const uint8_t *render_png(Render *render, size_t *size, Error *error);

#ifdef __cplusplus
}
#endif
#endif
