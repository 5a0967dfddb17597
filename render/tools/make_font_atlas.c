/// Development tool: bakes a font into render/font_atlas.h as signed distances, base64.
///
///     gcc make_font_atlas.c -o make_font_atlas $(pkg-config --cflags --libs freetype2)
///     ./make_font_atlas /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf > ../font_atlas.h
///
/// Not part of the build: the header is committed, so that nobody needs FreeType or the font.
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EM = 26, SPREAD = 4, WIDTH = 256, HEIGHT_MAX = 1024 };

static unsigned char atlas[HEIGHT_MAX][WIDTH];

/// ASCII and the few signs that units and angles need.
static const unsigned extra[] = {0xB0, 0xB2, 0xB3, 0xB7, 0xD7, 0x3B7, 0x2192, 0x2212};

static void print_base64(const unsigned char *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        unsigned a = bytes[i], b = i + 1 < count ? bytes[i + 1] : 0,
                 c = i + 2 < count ? bytes[i + 2] : 0;
        unsigned word = a << 16 | b << 8 | c;
        if (i % 240 == 0) printf("%s    \"", i ? "\"\n" : "");
        printf("%c%c%c%c", digits[word >> 18], digits[word >> 12 & 63], digits[word >> 6 & 63],
               digits[word & 63]);
    }
    printf("\";\n");
}

int main(int argc, char **argv)
{
    FT_Library library;
    FT_Face face;
    if (argc != 2 || FT_Init_FreeType(&library) || FT_New_Face(library, argv[1], 0, &face)) {
        fprintf(stderr, "usage: make_font_atlas FONT.ttf\n");
        return 2;
    }
    FT_Int spread = SPREAD;
    FT_Property_Set(library, "sdf", "spread", &spread);
    FT_Set_Pixel_Sizes(face, 0, EM);
    printf("/// %s %s as signed distances; made by tools/make_font_atlas.c.\n", face->family_name,
           face->style_name);
    printf("/// Font licence: assets/font/LICENSE.txt.\n");
    printf("#ifndef FAIRLEAD_FONT_ATLAS_H\n#define FAIRLEAD_FONT_ATLAS_H\n\n");
    printf(
        "typedef struct AtlasGlyph {\n    unsigned short code;\n    short x, y, width, height; "
        "///< box in the atlas\n    short left, top;            ///< of the box from the pen, up\n"
        "    short advance;              ///< in 1/64 pixel\n} AtlasGlyph;\n\n");
    printf("// clang-format off\nstatic const AtlasGlyph atlas_glyphs[] = {\n");
    int x = 0, y = 0, row = 0, count = 0;
    for (unsigned i = 32; i < 127 + sizeof extra / sizeof *extra; i++) {
        unsigned code = i < 127 ? i : extra[i - 127];
        if (FT_Load_Char(face, code, FT_LOAD_DEFAULT | FT_LOAD_NO_HINTING)) return 1;
        FT_GlyphSlot slot = face->glyph;
        long advance = slot->linearHoriAdvance >> 10;
        int w = 0, h = 0;
        if (code != 32) {
            if (FT_Render_Glyph(slot, FT_RENDER_MODE_SDF)) return 1;
            w = (int)slot->bitmap.width;
            h = (int)slot->bitmap.rows;
        }
        if (x + w > WIDTH) {
            x = 0;
            y += row;
            row = 0;
        }
        for (int j = 0; j < h; j++)
            memcpy(&atlas[y + j][x], slot->bitmap.buffer + j * slot->bitmap.pitch, (size_t)w);
        printf("    {%u, %d, %d, %d, %d, %d, %d, %ld},\n", code, x, y, w, h, slot->bitmap_left,
               slot->bitmap_top, advance);
        x += w;
        row = h > row ? h : row;
        count++;
    }
    int height = y + row;
    printf("};\n// clang-format on\n\nenum {\n    ATLAS_GLYPHS = %d,\n    ATLAS_WIDTH = %d,\n"
           "    ATLAS_HEIGHT = %d,\n    ATLAS_EM = %d, ///< pixels per em in the atlas\n};\n\n",
           count, WIDTH, height, EM);
    printf("/// Rows from the top, one byte a texel: 128 on the outline, more inside.\n");
    printf("// clang-format off\nstatic const char atlas_base64[] =\n");
    print_base64(&atlas[0][0], (size_t)height * WIDTH);
    printf("// clang-format on\n\n#endif\n");
    return 0;
}
