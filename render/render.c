/// One picture, in order: backdrop, bed and ships (all opaque) → a copy of them that the water
/// bends and dims → ships mirrored for the water → water, or particles → lines → text at the
/// picture's own size.
#include "render.h"

#include <stdio.h>
#include <string.h>

#include "colour_map.h"
#include "encode.h"
#include "parts.h"

/// Most nodes of the drawn surface. llvmpipe shades in blocks of 4 x 4 pixels, so that it works
/// through a small triangle's pixels several times.
enum { NODES_SOFTWARE = 14000, NODES_HARDWARE = 160000, NODES_STILL = 90000 };

struct Render {
    Context context;
    Gl gl;
    char description[256];
    bool software;
    GLuint frame_buffer_object; ///< uniform block
    GLuint maps;                ///< texture of all colour maps
    Target scene, behind, mirror, final;
    GLuint over; ///< framebuffer: colours of `scene`, depths of `behind`
    Stage stage;
    Bodies bodies;
    Lines lines;
    Water water;
    Particles particles;
    Overlay overlay;
    KeptRanges ranges;
    Encoder encoder;
    Scratch pixels, rows;
    int width, height; ///< of the last picture; 0 = none yet
};

static void describe(Render *render)
{
    const Gl *gl = &render->gl;
    const char *renderer = (const char *)gl->GetString(GL_RENDERER);
    const char *version = (const char *)gl->GetString(GL_VERSION);
    if (!renderer) renderer = "unknown";
    render->software =
        strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe") || strstr(renderer, "SWR");
    int digits = version ? (int)strcspn(version, " ") : 0;
    snprintf(render->description, sizeof render->description, "%s, %s, OpenGL %.*s",
             render->context.name, renderer, digits, version ? version : "");
}

static bool create_maps(Render *render, Error *error)
{
    uint8_t texels[MAP_COUNT][COLOUR_MAP_SIZE][4];
    for (int map = 0; map < MAP_COUNT; map++)
        for (int i = 0; i < COLOUR_MAP_SIZE; i++) {
            double rgb[3];
            colour_map((ColourMap)map, (double)i / (COLOUR_MAP_SIZE - 1), rgb);
            for (int k = 0; k < 3; k++)
                texels[map][i][k] = (uint8_t)(rgb[k] * 255.0 + 0.5);
            texels[map][i][3] = 255;
        }
    render->maps = gl_texture(&render->gl, GL_RGBA8, GL_RGBA, COLOUR_MAP_SIZE, MAP_COUNT, texels);
    return render->maps || error_set(error, ERROR_SYSTEM, "no texture for the colour maps");
}

static bool create_parts(Render *render, Error *error)
{
    const Gl *gl = &render->gl;
    TRY(gl_load(&render->gl, &render->context, error));
    describe(render);
    gl->GenBuffers(1, &render->frame_buffer_object);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LEQUAL);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    TRY(create_maps(render, error));
    TRY(stage_create(&render->stage, gl, error));
    TRY(bodies_create(&render->bodies, gl, error));
    TRY(lines_create(&render->lines, gl, error));
    TRY(water_create(&render->water, gl, render->software ? NODES_SOFTWARE : NODES_HARDWARE,
                     error));
    TRY(particles_create(&render->particles, gl, error));
    TRY(overlay_create(&render->overlay, gl, error));
    return true;
}

Render *render_create(Error *error)
{
    Render *render = calloc(1, sizeof *render);
    if (!render) {
        error_set(error, ERROR_SYSTEM, "out of memory");
        return NULL;
    }
    bool opened = context_create(&render->context, error);
    if (opened && create_parts(render, error)) {
        // Free for whichever thread draws.
        render->context.release(&render->context);
        return render;
    }
    if (opened) render->context.destroy(&render->context);
    free(render);
    return NULL;
}

void render_destroy(Render *render)
{
    if (!render) return;
    const Gl *gl = &render->gl;
    if (render->context.bind(&render->context)) {
        stage_destroy(&render->stage, gl);
        bodies_destroy(&render->bodies, gl);
        lines_destroy(&render->lines, gl);
        water_destroy(&render->water, gl);
        particles_destroy(&render->particles, gl);
        overlay_destroy(&render->overlay, gl);
        gl->DeleteBuffers(1, &render->frame_buffer_object);
        gl->DeleteTextures(1, &render->maps);
        if (render->over) gl->DeleteFramebuffers(1, &render->over);
        gl_target_destroy(gl, &render->scene);
        gl_target_destroy(gl, &render->behind);
        gl_target_destroy(gl, &render->mirror);
        gl_target_destroy(gl, &render->final);
    }
    render->context.destroy(&render->context);
    encoder_destroy(&render->encoder);
    scratch_free(&render->pixels);
    scratch_free(&render->rows);
    free(render);
}

const char *render_description(const Render *render) { return render->description; }

static void use_texture(const Gl *gl, int unit, GLuint texture)
{
    gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    gl->BindTexture(GL_TEXTURE_2D, texture);
}

/// The ships as the still water mirrors them, at half size.
static bool draw_mirror(Render *render, const Frame *frame, Error *error)
{
    const Gl *gl = &render->gl;
    TRY(gl_target_resize(gl, &render->mirror, render->scene.width / 2, render->scene.height / 2,
                         true, error));
    gl_target_use(gl, &render->mirror);
    gl->ClearColor(0, 0, 0, 0);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    bodies_draw(&render->bodies, gl, frame, &render->water.field);
    return true;
}

static bool draw_water(Render *render, const Frame *frame, Error *error)
{
    const Gl *gl = &render->gl;
    TRY(draw_mirror(render, frame, error));
    gl_target_use(gl, &render->scene);
    use_texture(gl, 0, render->behind.colour);
    use_texture(gl, 1, render->behind.depth);
    use_texture(gl, 2, render->maps);
    use_texture(gl, 3, render->mirror.colour);
    use_texture(gl, 4, render->water.cut_texture);
    return water_draw(&render->water, gl, frame, error);
}

static bool draw_scene(Render *render, const Frame *frame, Error *error)
{
    const Gl *gl = &render->gl;
    gl->BindBuffer(GL_UNIFORM_BUFFER, render->frame_buffer_object);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof frame->block, &frame->block, GL_STREAM_DRAW);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, GL_FRAME_BINDING, render->frame_buffer_object);
    gl_target_use(gl, &render->scene);
    TRY(stage_draw(&render->stage, gl, frame, &render->scene, frame->view->samples < 4, error));
    bodies_draw(&render->bodies, gl, frame, NULL);
    gl_target_copy(gl, &render->scene, &render->behind, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    bool particles = frame->view->water == WATER_PARTICLES;
    if (frame->snapshot->domain.kind == DOMAIN_LINES) {
        // no particles: no water is drawn
    } else if (particles) {
        gl_target_use(gl, &render->scene);
        use_texture(gl, 0, render->maps);
        TRY(particles_draw(&render->particles, gl, frame, &render->water, error));
    } else {
        TRY(draw_water(render, frame, error));
    }
    // Lines go on top of the water, hidden by ships only, so that their colours can be read.
    gl->BindFramebuffer(GL_FRAMEBUFFER, render->over);
    use_texture(gl, 0, render->maps);
    return lines_draw(&render->lines, gl, frame, particles ? 0.75 : 0.5, error);
}

/// The finished picture into memory: RGBA, which llvmpipe reads fastest.
static bool read_back(Render *render, const Target *target, Error *error)
{
    const Gl *gl = &render->gl;
    size_t size = (size_t)target->width * target->height * 4;
    void *pixels = scratch_need(&render->pixels, size, error);
    TRY(pixels);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->ReadPixels(0, 0, target->width, target->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    GLenum code = gl->GetError();
    if (code) return error_set(error, ERROR_SYSTEM, "OpenGL error 0x%x in a picture", code);
    render->width = target->width;
    render->height = target->height;
    return true;
}

/// Targets of the drawn size; `over` joins the colours of one to the depths of another.
static bool resize_targets(Render *render, int width, int height, Error *error)
{
    const Gl *gl = &render->gl;
    if (render->over && render->scene.width == width && render->scene.height == height) return true;
    if (render->over) gl->DeleteFramebuffers(1, &render->over);
    render->over = 0;
    TRY(gl_target_resize(gl, &render->scene, width, height, true, error));
    TRY(gl_target_resize(gl, &render->behind, width, height, true, error));
    gl->GenFramebuffers(1, &render->over);
    gl->BindFramebuffer(GL_FRAMEBUFFER, render->over);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                             render->scene.colour, 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                             render->behind.depth, 0);
    return true;
}

/// Nodes of a live picture in software: no closer than dp, over which the surface is smoothed.
static int live_nodes(const Snapshot *snapshot)
{
    const Domain *domain = &snapshot->domain;
    Vec3 size = vec3_scale(vec3_sub(domain->max, domain->min), 1.0 / snapshot->spacing);
    return domain->dimensions == 3 ? (int)mind(size.x * size.y, NODES_SOFTWARE) : NODES_SOFTWARE;
}

bool render_draw(Render *render, const Snapshot *snapshot, const ViewOptions *view, Error *error)
{
    const Gl *gl = &render->gl;
    TRY(view_check(view, error));
    if (!render->context.bind(&render->context))
        return error_set(error, ERROR_SYSTEM, "the picture's context belongs to another thread");
    int zoom = view->samples >= 4 ? 2 : 1;
    TRY(resize_targets(render, zoom * view->width, zoom * view->height, error));

    Frame frame;
    double largest = 0.0;
    frame_begin(&frame, snapshot, view, render->scene.width, render->scene.height);
    if (render->software) render->water.node_limit = zoom > 1 ? NODES_STILL : live_nodes(snapshot);
    TRY(bodies_update(&render->bodies, gl, &frame, error));
    TRY(water_update(&render->water, &frame, &largest, error));
    frame_scales(&frame, &render->ranges, largest);
    TRY(draw_scene(render, &frame, error));

    const Target *shown = &render->scene;
    if (zoom > 1) {
        TRY(gl_target_resize(gl, &render->final, view->width, view->height, false, error));
        gl_target_copy(gl, &render->scene, &render->final, GL_COLOR_BUFFER_BIT);
        shown = &render->final;
    }
    if (view->overlay) {
        gl_target_use(gl, shown);
        frame.block.target =
            vec4f(view->width, view->height, 1.0 / view->width, 1.0 / view->height);
        gl->BufferData(GL_UNIFORM_BUFFER, sizeof frame.block, &frame.block, GL_STREAM_DRAW);
        TRY(overlay_draw(&render->overlay, gl, &frame, error));
    }
    return read_back(render, shown, error);
}

const uint8_t *render_pixels(Render *render, int *width, int *height)
{
    size_t row = (size_t)render->width * 3;
    uint8_t *rows = scratch_need(&render->rows, row * (size_t)render->height + 1, NULL);
    *width = render->width;
    *height = render->height;
    if (!rows) return NULL;
    const uint8_t *from = render->pixels.data;
    for (int y = 0; y < render->height; y++) {
        const uint8_t *line = from + (size_t)(render->height - 1 - y) * render->width * 4;
        for (int x = 0; x < render->width; x++)
            memcpy(rows + (size_t)y * row + (size_t)x * 3, line + (size_t)x * 4, 3);
    }
    return rows;
}

static bool has_picture(const Render *render, Error *error)
{
    return render->width > 0 || error_set(error, ERROR_SYSTEM, "nothing has been drawn yet");
}

const uint8_t *render_jpeg(Render *render, int quality, size_t *size, Error *error)
{
    if (!has_picture(render, error)) return NULL;
    return encode_jpeg(&render->encoder, render->pixels.data, render->width, render->height,
                       quality, size, error);
}

const uint8_t *render_png(Render *render, size_t *size, Error *error)
{
    if (!has_picture(render, error)) return NULL;
    return encode_png(&render->encoder, render->pixels.data, render->width, render->height, size,
                      error);
}
