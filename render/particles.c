#include "parts.h"

bool particles_create(Particles *particles, const Gl *gl, Error *error)
{
    static const char *const samplers[] = {"maps", NULL};
    TRY(particles->program = gl_program(gl, "particle", samplers, error));
    const int sizes[] = {4, 0};
    gl_mesh_create(gl, &particles->mesh, sizes);
    return true;
}

void particles_destroy(Particles *particles, const Gl *gl)
{
    gl->DeleteProgram(particles->program);
    gl_mesh_destroy(gl, &particles->mesh);
    scratch_free(&particles->vertices);
}

bool particles_draw(Particles *particles, const Gl *gl, const Frame *frame, const Water *water,
                    Error *error)
{
    const Snapshot *snapshot = frame->snapshot;
    const int *shell = water->shell.data;
    const float *scalar = water->scalar.data;
    int count = water->shell_count;
    if (!count) return true;
    float *place = scratch_need(&particles->vertices, (size_t)count * 4 * sizeof *place, error);
    TRY(place);
    // A slice is shown on the side of its thickness that faces the eye.
    bool slice = snapshot->domain.dimensions == 2;
    float side = (float)(frame->eye.y < 0 ? frame->box_min.y : frame->box_max.y);
    for (int i = 0; i < count; i++) {
        const float *p = snapshot->position[shell[i]];
        place[4 * i] = p[0];
        place[4 * i + 1] = slice ? side : p[1];
        place[4 * i + 2] = p[2];
        place[4 * i + 3] =
            frame->field == FIELD_ELEVATION ? p[2] - (float)snapshot->level : scalar[shell[i]];
    }
    gl_mesh_vertices(gl, &particles->mesh, place, (size_t)count * 4 * sizeof *place);
    gl->UseProgram(particles->program);
    gl->Enable(GL_PROGRAM_POINT_SIZE);
    gl->BindVertexArray(particles->mesh.array);
    gl->DrawArrays(GL_POINTS, 0, count);
    gl->Disable(GL_PROGRAM_POINT_SIZE);
    return true;
}
