#include "gl.h"

#include <stdio.h>
#include <string.h>

#include "shaders.h"

bool gl_load(Gl *gl, const Context *context, Error *error)
{
#define GL_LOAD(type, name)                                                                        \
    gl->name = (type)context->function("gl" #name);                                                \
    if (!gl->name) return error_set(error, ERROR_SYSTEM, "OpenGL has no function gl" #name);
    GL_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    return true;
}

static const char *shader_text(const char *name, const char *stage)
{
    char full[64];
    snprintf(full, sizeof full, "%s%s%s", name, stage ? "." : "", stage ? stage : "");
    for (int i = 0; i < shader_file_count; i++)
        if (strcmp(shader_files[i].name, full) == 0) return shader_files[i].text;
    return NULL;
}

static GLuint compile(const Gl *gl, GLenum type, const char *name, const char *stage,
                      const char *defines, Error *error)
{
    const char *text = shader_text(name, stage);
    if (!text) {
        error_set(error, ERROR_SYSTEM, "no embedded shader %s.%s", name, stage);
        return 0;
    }
    const char *parts[] = {type == GL_FRAGMENT_SHADER ? "#version 330 core\n#define FRAGMENT\n"
                                                      : "#version 330 core\n",
                           defines, shader_text("common", NULL), "#line 1\n", text};
    GLuint shader = gl->CreateShader(type);
    gl->ShaderSource(shader, 5, parts, NULL);
    gl->CompileShader(shader);
    GLint good = 0;
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char log[512] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->DeleteShader(shader);
    error_set(error, ERROR_SYSTEM, "shader %s.%s: %s", name, stage, log);
    return 0;
}

GLuint gl_program(const Gl *gl, const char *name, const char *const *samplers, Error *error)
{
    return gl_program_variant(gl, name, "", samplers, error);
}

GLuint gl_program_variant(const Gl *gl, const char *name, const char *defines,
                          const char *const *samplers, Error *error)
{
    GLuint vertex = compile(gl, GL_VERTEX_SHADER, name, "vert", defines, error);
    if (!vertex) return 0;
    GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, name, "frag", defines, error);
    if (!fragment) {
        gl->DeleteShader(vertex);
        return 0;
    }
    GLuint program = gl->CreateProgram();
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    GLint good = 0;
    gl->GetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) {
        char log[512] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        gl->DeleteProgram(program);
        error_set(error, ERROR_SYSTEM, "shader %s does not link: %s", name, log);
        return 0;
    }
    GLuint block = gl->GetUniformBlockIndex(program, "Frame");
    if (block != GL_INVALID_INDEX) gl->UniformBlockBinding(program, block, GL_FRAME_BINDING);
    gl->UseProgram(program);
    for (int unit = 0; samplers && samplers[unit]; unit++)
        gl->Uniform1i(gl->GetUniformLocation(program, samplers[unit]), unit);
    return program;
}

void gl_mesh_create(const Gl *gl, Mesh *mesh, const int *sizes)
{
    gl->GenVertexArrays(1, &mesh->array);
    gl->GenBuffers(1, &mesh->vertices);
    gl->GenBuffers(1, &mesh->indices);
    mesh->index_count = 0;
    gl->BindVertexArray(mesh->array);
    gl->BindBuffer(GL_ARRAY_BUFFER, mesh->vertices);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh->indices);
    int stride = 0;
    for (int i = 0; sizes[i]; i++)
        stride += sizes[i];
    size_t offset = 0;
    for (int i = 0; sizes[i]; i++) {
        gl->EnableVertexAttribArray((GLuint)i);
        gl->VertexAttribPointer((GLuint)i, sizes[i], GL_FLOAT, GL_FALSE,
                                stride * (GLsizei)sizeof(float), gl_offset(offset));
        offset += (size_t)sizes[i] * sizeof(float);
    }
    gl->BindVertexArray(0);
}

void gl_mesh_vertices(const Gl *gl, const Mesh *mesh, const void *data, size_t size)
{
    gl->BindBuffer(GL_ARRAY_BUFFER, mesh->vertices);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, data, GL_STREAM_DRAW);
}

void gl_mesh_indices(const Gl *gl, Mesh *mesh, const GLuint *data, int count)
{
    gl->BindVertexArray(mesh->array);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh->indices);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * sizeof *data), data,
                   GL_STATIC_DRAW);
    gl->BindVertexArray(0);
    mesh->index_count = count;
}

void gl_mesh_destroy(const Gl *gl, Mesh *mesh)
{
    gl->DeleteVertexArrays(1, &mesh->array);
    gl->DeleteBuffers(1, &mesh->vertices);
    gl->DeleteBuffers(1, &mesh->indices);
    *mesh = (Mesh){0};
}

GLuint gl_texture(const Gl *gl, GLenum internal, GLenum format, int width, int height,
                  const void *pixels)
{
    GLuint texture = 0;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    GLenum type = format == GL_DEPTH_COMPONENT ? GL_UNSIGNED_INT : GL_UNSIGNED_BYTE;
    GLint filter = format == GL_DEPTH_COMPONENT ? GL_NEAREST : GL_LINEAR;
    gl->TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal, width, height, 0, format, type, pixels);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

bool gl_target_resize(const Gl *gl, Target *target, int width, int height, bool with_depth,
                      Error *error)
{
    if (target->framebuffer && target->width == width && target->height == height) return true;
    gl_target_destroy(gl, target);
    target->width = width;
    target->height = height;
    gl->GenFramebuffers(1, &target->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    target->colour = gl_texture(gl, GL_RGBA8, GL_RGBA, width, height, NULL);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target->colour,
                             0);
    if (with_depth) {
        target->depth =
            gl_texture(gl, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, width, height, NULL);
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, target->depth,
                                 0);
    }
    if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return true;
    gl_target_destroy(gl, target);
    return error_set(error, ERROR_SYSTEM, "a picture of %d x %d pixels cannot be allocated", width,
                     height);
}

void gl_target_use(const Gl *gl, const Target *target)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    gl->Viewport(0, 0, target->width, target->height);
}

void gl_target_copy(const Gl *gl, const Target *from, const Target *to, GLbitfield what)
{
    bool same = from->width == to->width;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, from->framebuffer);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, to->framebuffer);
    gl->BlitFramebuffer(0, 0, from->width, from->height, 0, 0, to->width, to->height, what,
                        same ? GL_NEAREST : GL_LINEAR);
}

void gl_target_destroy(const Gl *gl, Target *target)
{
    if (target->framebuffer) gl->DeleteFramebuffers(1, &target->framebuffer);
    if (target->colour) gl->DeleteTextures(1, &target->colour);
    if (target->depth) gl->DeleteTextures(1, &target->depth);
    *target = (Target){0};
}
