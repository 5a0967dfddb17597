/// The OpenGL 3.3 core functions that render uses, loaded through the context, and the few helpers
/// every part of the picture needs. No global function pointers: each Render has its own table.
#ifndef FAIRLEAD_GL_H
#define FAIRLEAD_GL_H

#include <GL/glcorearb.h>
#include <stddef.h>

#include "context.h"

#define GL_FUNCTIONS(X)                                                                            \
    X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                       \
    X(PFNGLATTACHSHADERPROC, AttachShader)                                                         \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                                                             \
    X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                     \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                   \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                                                           \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                   \
    X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                               \
    X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                                                   \
    X(PFNGLBUFFERDATAPROC, BufferData)                                                             \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                     \
    X(PFNGLCLEARPROC, Clear)                                                                       \
    X(PFNGLCLEARCOLORPROC, ClearColor)                                                             \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                                                       \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                       \
    X(PFNGLCREATESHADERPROC, CreateShader)                                                         \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                       \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                             \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                       \
    X(PFNGLDELETESHADERPROC, DeleteShader)                                                         \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                     \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                             \
    X(PFNGLDEPTHFUNCPROC, DepthFunc)                                                               \
    X(PFNGLDEPTHMASKPROC, DepthMask)                                                               \
    X(PFNGLDISABLEPROC, Disable)                                                                   \
    X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                             \
    X(PFNGLDRAWELEMENTSPROC, DrawElements)                                                         \
    X(PFNGLENABLEPROC, Enable)                                                                     \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                                   \
    X(PFNGLFINISHPROC, Finish)                                                                     \
    X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                                         \
    X(PFNGLGENBUFFERSPROC, GenBuffers)                                                             \
    X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                   \
    X(PFNGLGENTEXTURESPROC, GenTextures)                                                           \
    X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                                   \
    X(PFNGLGETERRORPROC, GetError)                                                                 \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                               \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                         \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                 \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                           \
    X(PFNGLGETSTRINGPROC, GetString)                                                               \
    X(PFNGLGETUNIFORMBLOCKINDEXPROC, GetUniformBlockIndex)                                         \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                             \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                           \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                           \
    X(PFNGLREADPIXELSPROC, ReadPixels)                                                             \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                         \
    X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                                             \
    X(PFNGLTEXPARAMETERIPROC, TexParameteri)                                                       \
    X(PFNGLUNIFORM1IPROC, Uniform1i)                                                               \
    X(PFNGLUNIFORM3FPROC, Uniform3f)                                                               \
    X(PFNGLUNIFORM4FPROC, Uniform4f)                                                               \
    X(PFNGLUNIFORMBLOCKBINDINGPROC, UniformBlockBinding)                                           \
    X(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                                                 \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                             \
    X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                           \
    X(PFNGLVIEWPORTPROC, Viewport)

typedef struct Gl {
#define GL_MEMBER(type, name) type name;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
} Gl;

/// Fill the table. @return false with ERROR_SYSTEM naming the missing function
bool gl_load(Gl *gl, const Context *context, Error *error);

/// Binding point of the Frame uniform block in every program.
enum { GL_FRAME_BINDING = 0 };

/// Compile and link "<name>.vert" and "<name>.frag" of the embedded shaders, "common" before each.
/// Samplers named in `samplers` (NULL-terminated) get the texture units 0, 1, …
/// @return 0 with ERROR_SYSTEM carrying the first lines of the driver's log
GLuint gl_program(const Gl *gl, const char *name, const char *const *samplers, Error *error);
/// The same with lines put before both shaders. @param defines  "#define WALL\n"
GLuint gl_program_variant(const Gl *gl, const char *name, const char *defines,
                          const char *const *samplers, Error *error);

/// OpenGL takes offsets into buffers as pointers.
static inline const void *gl_offset(size_t bytes)
{
    return (const void *)bytes; // NOLINT(performance-no-int-to-ptr)
}

/// One interleaved vertex array of floats.
typedef struct Mesh {
    GLuint array, vertices, indices;
    int index_count;
} Mesh;

/// @param sizes  floats per attribute, in the order of their locations, zero-terminated
void gl_mesh_create(const Gl *gl, Mesh *mesh, const int *sizes);
void gl_mesh_vertices(const Gl *gl, const Mesh *mesh, const void *data, size_t size);
void gl_mesh_indices(const Gl *gl, Mesh *mesh, const GLuint *data, int count);
void gl_mesh_destroy(const Gl *gl, Mesh *mesh);

/// Colour and depth textures behind one framebuffer.
typedef struct Target {
    GLuint framebuffer, colour, depth;
    int width, height;
} Target;

/// Make or resize. @param with_depth  depth texture, 24 bit
bool gl_target_resize(const Gl *gl, Target *target, int width, int height, bool with_depth,
                      Error *error);
/// Draw into it from now on, all of it.
void gl_target_use(const Gl *gl, const Target *target);
/// Copy one to the other; a larger one is averaged. @param what  GL_COLOR_BUFFER_BIT, …
void gl_target_copy(const Gl *gl, const Target *from, const Target *to, GLbitfield what);
void gl_target_destroy(const Gl *gl, Target *target);

/// A texture with linear filtering and clamped edges; format as for glTexImage2D, 8 bits a channel.
GLuint gl_texture(const Gl *gl, GLenum internal, GLenum format, int width, int height,
                  const void *pixels);

#endif
