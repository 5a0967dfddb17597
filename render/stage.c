#include "parts.h"

bool stage_create(Stage *stage, const Gl *gl, Error *error)
{
    TRY(stage->backdrop = gl_program(gl, "backdrop", NULL, error));
    TRY(stage->bed = gl_program(gl, "bed", NULL, error));
    gl->GenVertexArrays(1, &stage->array);
    return true;
}

void stage_draw(const Stage *stage, const Gl *gl, const Frame *frame)
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

void stage_destroy(Stage *stage, const Gl *gl)
{
    gl->DeleteProgram(stage->backdrop);
    gl->DeleteProgram(stage->bed);
    gl->DeleteVertexArrays(1, &stage->array);
}
