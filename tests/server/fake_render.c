// render.h without OpenGL: a gradient whose colour follows time and camera, in real JPEG and PNG.
// FAKE_RENDER=none in the environment pretends that the machine has no OpenGL, FAKE_RENDER_MS=100
// that a picture costs 100 ms of processor time.
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <turbojpeg.h>

#include "render.h"

struct Render {
    int width, height;
    uint8_t *pixels;
    unsigned char *encoded;
    unsigned long encoded_size;
    double cost; ///< of a picture [s of processor time]
};

ViewOptions view_options_default(void)
{
    return (ViewOptions){
        .camera = {.distance = 10, .field_of_view = 0.8}, .width = 320, .height = 180};
}

Camera camera_for_scene(const Scene *scene)
{
    return (Camera){scene->camera.target, scene->camera.distance, scene->camera.azimuth,
                    scene->camera.elevation, 0.8};
}

Render *render_create(Error *error)
{
    const char *wish = getenv("FAKE_RENDER");
    if (wish && !strcmp(wish, "none")) {
        error_set(error, ERROR_SYSTEM, "no OpenGL: tried nothing");
        return NULL;
    }
    Render *render = calloc(1, sizeof *render);
    const char *cost = getenv("FAKE_RENDER_MS");
    if (render && cost) render->cost = 1e-3 * strtod(cost, NULL);
    return render;
}

void render_destroy(Render *render)
{
    free(render->pixels);
    tjFree(render->encoded);
    free(render);
}

const char *render_description(const Render *render) { return "fake renderer"; }

static double used_time(void)
{
    struct timespec used;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

bool render_draw(Render *render, const Snapshot *snapshot, const ViewOptions *view, Error *error)
{
    uint8_t *pixels = realloc(render->pixels, (size_t)view->width * (size_t)view->height * 3);
    if (!pixels) return error_set(error, ERROR_SYSTEM, "no memory");
    for (double end = used_time() + render->cost; used_time() < end;) {
    }
    render->pixels = pixels;
    render->width = view->width;
    render->height = view->height;
    int shade = (int)(snapshot->time * 100 + view->camera.azimuth * 40) & 255;
    size_t row = (size_t)view->width * 3;
    for (int x = 0; x < view->width; x++) {
        pixels[3 * x] = pixels[3 * x + 1] = (uint8_t)(255 * x / view->width);
        pixels[3 * x + 2] = (uint8_t)shade;
    }
    // row by row, so that a picture is cheap under the thread sanitizer too
    for (int y = 1; y < view->height; y++)
        memcpy(pixels + (size_t)y * row, pixels, row);
    return true;
}

const uint8_t *render_pixels(Render *render, int *width, int *height)
{
    *width = render->width;
    *height = render->height;
    return render->pixels;
}

const uint8_t *render_jpeg(Render *render, int quality, size_t *size, Error *error)
{
    tjhandle handle = tjInitCompress();
    tjFree(render->encoded);
    render->encoded = NULL;
    render->encoded_size = 0;
    tjCompress2(handle, render->pixels, render->width, 0, render->height, TJPF_RGB,
                &render->encoded, &render->encoded_size, TJSAMP_420, quality, TJFLAG_FASTDCT);
    tjDestroy(handle);
    *size = render->encoded_size;
    return render->encoded;
}

const uint8_t *render_png(Render *render, size_t *size, Error *error)
{
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)render->width,
                       .height = (png_uint_32)render->height,
                       .format = PNG_FORMAT_RGB};
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    tjFree(render->encoded);
    render->encoded = tjAlloc((int)bytes);
    if (!png_image_write_to_memory(&image, render->encoded, &bytes, 0, render->pixels, 0, NULL)) {
        error_set(error, ERROR_SYSTEM, "png: %s", image.message);
        return NULL;
    }
    *size = bytes;
    return render->encoded;
}
