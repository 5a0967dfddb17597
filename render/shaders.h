/// The files of assets/shaders, embedded at build time (embed_shaders.cmake).
#ifndef FAIRLEAD_SHADERS_H
#define FAIRLEAD_SHADERS_H

typedef struct ShaderFile {
    const char *name; ///< file name without ".glsl", such as "water.frag"
    const char *text; ///< zero-terminated
} ShaderFile;

extern const ShaderFile shader_files[];
extern const int shader_file_count;

#endif
