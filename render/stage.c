#include "parts.h"

bool stage_create(Stage *stage, const Gl *gl, Error *error)
{
    TRY(stage->backdrop = gl_program(gl, "backdrop", NULL, error));
    TRY(stage->bed = gl_program(gl, "bed", NULL, error));
    gl->GenVertexArrays(1, &stage->array);
    return true;
}

static void draw(const Stage *stage, const Gl *gl, const Frame *frame)
{
    gl->BindVertexArray(stage->array);
    gl->Disable(GL_DEPTH_TEST);
    gl->UseProgram(stage->backdrop);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->Enable(GL_DEPTH_TEST);
    // From below, the bed would hide everything.
    if (frame->eye.z <= frame->box_min.z) return;
    gl->UseProgram(stage->bed);
    gl->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

/// The block without what changes with every picture and the stage does not look at.
static FrameBlock seen_by_stage(const Frame *frame)
{
    FrameBlock block = frame->block;
    block.eye.w = block.range.w = 0.0f;
    block.field = block.tension = vec4f(0, 0, 0, 0);
    return block;
}

/// A block is floats throughout.
static bool same_block(const FrameBlock *one, const FrameBlock *other)
{
    const float *a = (const float *)one, *b = (const float *)other;
    for (size_t i = 0; i < sizeof *one / sizeof *a; i++)
        if (a[i] != b[i]) return false;
    return true;
}

bool stage_draw(Stage *stage, const Gl *gl, const Frame *frame, const Target *target, bool keep,
                Error *error)
{
    const GLbitfield all = GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT;
    FrameBlock block = seen_by_stage(frame);
    if (keep && stage->kept.framebuffer && same_block(&block, &stage->drawn)) {
        gl_target_copy(gl, &stage->kept, target, all);
        gl_target_use(gl, target);
        return true;
    }
    gl->Clear(GL_DEPTH_BUFFER_BIT);
    draw(stage, gl, frame);
    if (!keep) return true;
    TRY(gl_target_resize(gl, &stage->kept, target->width, target->height, true, error));
    gl_target_copy(gl, target, &stage->kept, all);
    gl_target_use(gl, target);
    stage->drawn = block;
    return true;
}

void stage_destroy(Stage *stage, const Gl *gl)
{
    gl->DeleteProgram(stage->backdrop);
    gl->DeleteProgram(stage->bed);
    gl->DeleteVertexArrays(1, &stage->array);
    gl_target_destroy(gl, &stage->kept);
}
