#include "encode.h"

#include <png.h>
#include <string.h>
#include <turbojpeg.h>
#include <zlib.h>

const uint8_t *encode_jpeg(Encoder *encoder, const uint8_t *rgba, int width, int height,
                           int quality, size_t *size, Error *error)
{
    if (!encoder->jpeg) encoder->jpeg = tjInitCompress();
    if (!encoder->jpeg) {
        error_set(error, ERROR_SYSTEM, "turbojpeg cannot start");
        return NULL;
    }
    quality = quality < 1 ? 1 : quality > 100 ? 100 : quality;
    unsigned long length = encoder->capacity;
    int sampling = quality < 90 ? TJSAMP_420 : TJSAMP_444;
    // The rows come from below: turbojpeg turns them for nothing.
    if (tjCompress2(encoder->jpeg, rgba, width, 4 * width, height, TJPF_RGBA, &encoder->buffer,
                    &length, sampling, quality, TJFLAG_BOTTOMUP | TJFLAG_FASTDCT) != 0) {
        error_set(error, ERROR_SYSTEM, "JPEG: %s", tjGetErrorStr2(encoder->jpeg));
        return NULL;
    }
    if (length > encoder->capacity) encoder->capacity = length;
    *size = length;
    return encoder->buffer;
}

static void png_append(png_structp png, png_bytep bytes, png_size_t count)
{
    Encoder *encoder = png_get_io_ptr(png);
    if (!scratch_need(&encoder->png, encoder->png_size + count, NULL)) png_error(png, "memory");
    memcpy((uint8_t *)encoder->png.data + encoder->png_size, bytes, count);
    encoder->png_size += count;
}

static void png_no_flush(png_structp png) { (void)png; }

const uint8_t *encode_png(Encoder *encoder, const uint8_t *rgba, int width, int height,
                          size_t *size, Error *error)
{
    encoder->png_size = 0;
    uint8_t *volatile row = malloc((size_t)width * 3);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!row || !info || setjmp(png_jmpbuf(png))) {
        free(row);
        png_destroy_write_struct(&png, &info);
        error_set(error, ERROR_SYSTEM, "PNG: the picture cannot be written");
        return NULL;
    }
    png_set_write_fn(png, encoder, png_append, png_no_flush);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, Z_RLE);
    png_set_filter(png, 0, PNG_FILTER_SUB);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = height - 1; y >= 0; y--) {
        const uint8_t *from = rgba + (size_t)y * width * 4;
        for (int x = 0; x < width; x++)
            memcpy(row + (size_t)3 * x, from + (size_t)4 * x, 3);
        png_write_row(png, row);
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    free(row);
    *size = encoder->png_size;
    return encoder->png.data;
}

void encoder_destroy(Encoder *encoder)
{
    if (encoder->jpeg) tjDestroy(encoder->jpeg);
    tjFree(encoder->buffer);
    scratch_free(&encoder->png);
    *encoder = (Encoder){0};
}
