/// Pixels → JPEG and PNG. Pictures are RGBA, 8 bits, bottom row first, as OpenGL gives them.
#ifndef FAIRLEAD_ENCODE_H
#define FAIRLEAD_ENCODE_H

#include <stddef.h>
#include <stdint.h>

#include "scratch.h"

typedef struct Encoder {
    void *jpeg;             ///< turbojpeg's handle
    unsigned char *buffer;  ///< turbojpeg's, kept from picture to picture
    unsigned long capacity; ///< [byte]
    Scratch png;
    size_t png_size;
} Encoder;

/// 4:2:0 below quality 90, 4:4:4 from there. @return bytes owned by the encoder; NULL with error
const uint8_t *encode_jpeg(Encoder *encoder, const uint8_t *rgba, int width, int height,
                           int quality, size_t *size, Error *error);
/// Fast settings: zlib level 1, run lengths, one filter.
const uint8_t *encode_png(Encoder *encoder, const uint8_t *rgba, int width, int height,
                          size_t *size, Error *error);
void encoder_destroy(Encoder *encoder);

#endif
