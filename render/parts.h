/// The parts of a picture. Each is created once with its shaders, drawn into the bound framebuffer
/// and destroyed with the context current.
#ifndef FAIRLEAD_PARTS_H
#define FAIRLEAD_PARTS_H

#include "cut.h"
#include "frame.h"
#include "gl.h"
#include "scratch.h"
#include "surface.h"

/// Backdrop and sea bed (stage.c).
typedef struct Stage {
    GLuint backdrop, bed, array;
    Target kept;      ///< the stage as last drawn for a live picture
    FrameBlock drawn; ///< what it was drawn with, of what the stage looks at
} Stage;
bool stage_create(Stage *stage, const Gl *gl, Error *error);
/// Draw into `target`, which is bound. It is the same from picture to picture until the camera
/// moves, so live pictures copy it. @param keep  false for a still: its size is not worth keeping
bool stage_draw(Stage *stage, const Gl *gl, const Frame *frame, const Target *target, bool keep,
                Error *error);
void stage_destroy(Stage *stage, const Gl *gl);

/// Ships and other bodies (bodies.c).
typedef struct BodyMesh {
    Mesh mesh;
    uint64_t hash;    ///< of the triangle mesh that was uploaded
    double waterline; ///< height of the still level in geometry axes when first seen [m]
    double boot_top;  ///< width of the white stripe above it [m]; 0 = one paint
} BodyMesh;
typedef struct Bodies {
    GLuint program;
    GLint world_from_body, flip, paint, anti;
    BodyMesh meshes[SCENE_BODIES_MAX];
    Scratch vertices;
    double last_time; ///< of the last picture [s]; time that runs backwards is a new run
} Bodies;
bool bodies_create(Bodies *bodies, const Gl *gl, Error *error);
/// Upload meshes that are new. To be called before bodies_draw.
bool bodies_update(Bodies *bodies, const Gl *gl, const Frame *frame, Error *error);
/// @param mirror  NULL, or the water in whose level at each body it is mirrored, without what is
///                below that level
void bodies_draw(const Bodies *bodies, const Gl *gl, const Frame *frame, const HeightField *mirror);
void bodies_destroy(Bodies *bodies, const Gl *gl);

/// Vertices of a mesh with smooth normals: position and normal of each corner, shared where the
/// faces around a vertex meet at less than the crease angle.
/// @param out  [triangle_count * 3][6]
bool crease_normals(const TriangleMesh *mesh, double crease, float *out, Error *error);

/// Mooring lines and their anchors (lines.c).
typedef struct Lines {
    GLuint program;
    GLint size, slack;
    Mesh mesh;
    Scratch vertices, indices;
} Lines;
bool lines_create(Lines *lines, const Gl *gl, Error *error);
/// @param veil  how much water hides of a line far below its surface, 0..1
bool lines_draw(Lines *lines, const Gl *gl, const Frame *frame, double veil, Error *error);
void lines_destroy(Lines *lines, const Gl *gl);

/// Free surface and side walls of the water (water.c).
typedef struct Water {
    GLuint surface_program[2], wall_program[2]; ///< plain, coloured by the field
    HeightField field;
    CutFaces cut;
    GLuint cut_texture; ///< the field on the cut faces, 32-bit floats
    bool cut_shown;
    GLint faces; ///< of the coloured wall's program
    Mesh surface, walls;
    int shape[2]; ///< nodes the indices were made for
    Scratch vertices, scalar, shell;
    int node_limit;
    int shell_count;
} Water;
/// @param node_limit  most nodes of the surface
bool water_create(Water *water, const Gl *gl, int node_limit, Error *error);
/// Build the height field from the snapshot. @param largest  largest magnitude of the field drawn
bool water_update(Water *water, const Frame *frame, double *largest, Error *error);
/// Textures 0 to 4 are the opaque picture, its depth, the colour maps, the mirrored ships, the
/// field on the cut faces.
bool water_draw(Water *water, const Gl *gl, const Frame *frame, Error *error);
void water_destroy(Water *water, const Gl *gl);

/// The particles that can be seen, as shaded discs (particles.c).
typedef struct Particles {
    GLuint program;
    Mesh mesh;
    Scratch vertices;
} Particles;
bool particles_create(Particles *particles, const Gl *gl, Error *error);
bool particles_draw(Particles *particles, const Gl *gl, const Frame *frame, const Water *water,
                    Error *error);
void particles_destroy(Particles *particles, const Gl *gl);

/// Text and colour bars (overlay.c).
typedef struct Overlay {
    GLuint program, atlas;
    GLint halo;
    Mesh mesh;
    Scratch vertices;
    int quad_count;
} Overlay;
bool overlay_create(Overlay *overlay, const Gl *gl, Error *error);
bool overlay_draw(Overlay *overlay, const Gl *gl, const Frame *frame, Error *error);
void overlay_destroy(Overlay *overlay, const Gl *gl);

#endif
