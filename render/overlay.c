#include "colour_map.h"
#include "font_atlas.h"
#include "parts.h"

#include <stdio.h>
#include <string.h>

enum { QUADS_MAX = 1600, BAR_STEPS = 48, LINES_TOLD = 6 };

/// A snap stands beside its line for this long [simulated s].
static const double SNAP_TOLD = 1.0;

typedef struct OverlayVertex {
    float x, y, u, v, colour[4];
} OverlayVertex;

/// What is being laid out.
typedef struct Sheet {
    OverlayVertex *vertices;
    int quad_count;
    double em;       ///< size of text [pixel]
    float colour[4]; ///< of text
} Sheet;

static int base64_value(char digit)
{
    if (digit >= 'A' && digit <= 'Z') return digit - 'A';
    if (digit >= 'a' && digit <= 'z') return digit - 'a' + 26;
    if (digit >= '0' && digit <= '9') return digit - '0' + 52;
    return digit == '+' ? 62 : 63;
}

bool overlay_create(Overlay *overlay, const Gl *gl, Error *error)
{
    static const char *const samplers[] = {"atlas", NULL};
    TRY(overlay->program = gl_program(gl, "overlay", samplers, error));
    overlay->halo = gl->GetUniformLocation(overlay->program, "halo");
    const int sizes[] = {4, 4, 0};
    gl_mesh_create(gl, &overlay->mesh, sizes);
    unsigned char *texels = calloc(ATLAS_WIDTH * (ATLAS_HEIGHT + 1), 1);
    if (!texels) return error_set(error, ERROR_SYSTEM, "out of memory for the font");
    size_t length = strlen(atlas_base64) / 4;
    for (size_t i = 0; i < length && 3 * i + 2 < ATLAS_WIDTH * (ATLAS_HEIGHT + 1); i++) {
        unsigned word = 0;
        for (int k = 0; k < 4; k++)
            word = word << 6 | (unsigned)base64_value(atlas_base64[4 * i + (size_t)k]);
        for (int k = 0; k < 3; k++)
            texels[3 * i + (size_t)k] = (unsigned char)(word >> (16 - 8 * k));
    }
    overlay->atlas = gl_texture(gl, GL_R8, GL_RED, ATLAS_WIDTH, ATLAS_HEIGHT, texels);
    free(texels);
    GLuint *indices = calloc((size_t)QUADS_MAX * 6, sizeof *indices);
    if (!indices) return error_set(error, ERROR_SYSTEM, "out of memory for text");
    for (GLuint q = 0; q < QUADS_MAX; q++) {
        const GLuint corners[6] = {0, 1, 2, 2, 1, 3};
        for (int k = 0; k < 6; k++)
            indices[6 * q + (GLuint)k] = 4 * q + corners[k];
    }
    gl_mesh_indices(gl, &overlay->mesh, indices, QUADS_MAX * 6);
    free(indices);
    return true;
}

void overlay_destroy(Overlay *overlay, const Gl *gl)
{
    gl->DeleteProgram(overlay->program);
    gl->DeleteTextures(1, &overlay->atlas);
    gl_mesh_destroy(gl, &overlay->mesh);
    scratch_free(&overlay->vertices);
}

/// A rectangle from (x, y) with texture corners; the colours of its top and bottom edge may differ.
static void put_quad(Sheet *sheet, const double place[4], const double texture[4],
                     const float top[4], const float bottom[4])
{
    if (sheet->quad_count >= QUADS_MAX) return;
    OverlayVertex *out = sheet->vertices + 4 * sheet->quad_count++;
    for (int k = 0; k < 4; k++) {
        int right = k & 1, low = k >> 1;
        out[k].x = (float)(place[0] + right * place[2]);
        out[k].y = (float)(place[1] + low * place[3]);
        out[k].u = (float)(texture[0] + right * texture[2]);
        out[k].v = (float)(texture[1] + low * texture[3]);
        memcpy(out[k].colour, low ? bottom : top, sizeof out[k].colour);
    }
}

static void put_area(Sheet *sheet, double x, double y, double width, double height,
                     const float top[4], const float bottom[4])
{
    const double place[4] = {x, y, width, height}, none[4] = {-1, -1, 0, 0};
    put_quad(sheet, place, none, top, bottom);
}

static const AtlasGlyph *find_glyph(unsigned code)
{
    for (int g = 0; g < ATLAS_GLYPHS; g++)
        if (atlas_glyphs[g].code == code) return &atlas_glyphs[g];
    return NULL;
}

/// Next character of UTF-8 text; moves the pointer.
static unsigned next_code(const char **text)
{
    const unsigned char *t = (const unsigned char *)*text;
    int extra = t[0] >= 0xE0 ? 2 : t[0] >= 0xC0 ? 1 : 0;
    unsigned code = extra == 2 ? t[0] & 0x0Fu : extra ? t[0] & 0x1Fu : t[0];
    for (int k = 1; k <= extra && t[k]; k++)
        code = code << 6 | (t[k] & 0x3Fu);
    *text += 1;
    for (int k = 0; k < extra && **text; k++)
        *text += 1;
    return code;
}

/// Text with its baseline at y; measures only when `draw` is false. @return width [pixel]
static double put_text(Sheet *sheet, double x, double y, const char *text, bool draw)
{
    const double scale = sheet->em / ATLAS_EM;
    double pen = x;
    while (*text) {
        const AtlasGlyph *glyph = find_glyph(next_code(&text));
        if (!glyph) continue;
        if (draw && glyph->width > 0) {
            const double place[4] = {pen + glyph->left * scale, y - glyph->top * scale,
                                     glyph->width * scale, glyph->height * scale};
            const double texture[4] = {
                (double)glyph->x / ATLAS_WIDTH, (double)glyph->y / ATLAS_HEIGHT,
                (double)glyph->width / ATLAS_WIDTH, (double)glyph->height / ATLAS_HEIGHT};
            put_quad(sheet, place, texture, sheet->colour, sheet->colour);
        }
        pen += glyph->advance / 64.0 * scale;
    }
    return pen - x;
}

/// A number with a true minus sign.
static void format_number(char *text, size_t size, double value, int decimals)
{
    double tiny = 0.5 * pow(10.0, -decimals);
    snprintf(text, size, "%s%.*f", value < -tiny ? "\xE2\x88\x92" : "", decimals, fabs(value));
}

/// Distance of the ticks of a scale: 1, 2, 2.5 or 5 times a power of ten, about five of them.
static double tick_step(double span, int *decimals)
{
    static const double steps[] = {1, 2, 2.5, 5, 10};
    double raw = span / 5.0, power = pow(10.0, floor(log10(raw)));
    int choice = 0;
    while (choice < 4 && steps[choice] * power < raw * (1.0 - 1e-9))
        choice++;
    int exponent = (int)floor(log10(power) + 0.5) + (choice == 4);
    *decimals = (int)maxd(0, -exponent + (choice == 2));
    return steps[choice] * power;
}

/// A bar with title, unit and ticks, its labels ending at `right`. @return y below it
static double put_bar(Sheet *sheet, const Scale *scale, ColourMap map, double right, double y,
                      double height)
{
    const double em = sheet->em, width = 0.85 * em;
    bool kilo = scale->largest >= 10000.0;
    double factor = kilo ? 1e-3 : 1.0, least = scale->least * factor;
    double span = (scale->largest - scale->least) * factor;
    char text[64];
    snprintf(text, sizeof text, "%s [%s%s]", scale->title, kilo ? "k" : "", scale->unit);
    put_text(sheet, right - put_text(sheet, 0, 0, text, false), y + em, text, true);
    y += 1.75 * em;
    double left = right - width - 3.6 * em;
    float frame[4] = {sheet->colour[0], sheet->colour[1], sheet->colour[2], 0.8f};
    put_area(sheet, left - 1, y - 1, width + 2, height + 2, frame, frame);
    for (int step = 0; step < BAR_STEPS; step++) {
        float shade[2][4];
        for (int end = 0; end < 2; end++) {
            double rgb[3];
            colour_map(map, 1.0 - (double)(step + end) / BAR_STEPS, rgb);
            for (int k = 0; k < 3; k++)
                shade[end][k] = (float)rgb[k];
            shade[end][3] = 1.0f;
        }
        put_area(sheet, left, y + height * step / BAR_STEPS, width, height / BAR_STEPS, shade[0],
                 shade[1]);
    }
    int decimals;
    double step = tick_step(span, &decimals), first = ceil(least / step - 1e-9) * step;
    for (double value = first; value <= least + span * (1.0 + 1e-9); value += step) {
        double at = y + height * (1.0 - (value - least) / span);
        put_area(sheet, left + width, at - 0.5, 0.35 * em, 1.0, frame, frame);
        format_number(text, sizeof text, value, decimals);
        put_text(sheet, left + width + 0.6 * em, at + 0.36 * em, text, true);
    }
    return y + height + 1.2 * em;
}

/// What the tension's colours do not say: slack stretches, and those near their line's largest.
static void put_line_key(Sheet *sheet, double right, double y)
{
    const double em = sheet->em;
    float thick[4] = {0, 0, 0, 1},
          slack[4] = {SLACK_COLOUR[0], SLACK_COLOUR[1], SLACK_COLOUR[2], 1};
    double rgb[3];
    colour_map(MAP_TENSION, 0.7, rgb);
    for (int k = 0; k < 3; k++)
        thick[k] = (float)rgb[k];
    const char *const words[2] = {"slack", "near its largest"};
    for (int row = 0; row < 2; row++, y += 1.3 * em) {
        double left = right - put_text(sheet, 0, 0, words[row], false);
        double height = row ? 0.42 * em : 0.2 * em;
        put_text(sheet, left, y + 0.36 * em, words[row], true);
        put_area(sheet, left - 1.9 * em, y - 0.5 * height, 1.4 * em, height, row ? thick : slack,
                 row ? thick : slack);
    }
}

/// Tension now at the fairlead, largest so far, length on the bed; of the first lines only.
static void put_line_words(Sheet *sheet, const Snapshot *snapshot, double y)
{
    const double em = sheet->em;
    for (int l = 0; l < snapshot->line_count && l < LINES_TOLD; l++, y += 1.35 * em) {
        const LineSnapshot *line = &snapshot->lines[l];
        if (!line->name || line->node_count < 2) continue;
        char text[160], name[SCENE_NAME_SIZE];
        snprintf(name, sizeof name, "%s", line->name);
        for (char *c = name; *c; c++)
            if (*c == '_') *c = ' ';
        bool snap = snapshot->time - line->snap_time < SNAP_TOLD;
        snprintf(text, sizeof text, "%s  %.4g N   largest %.4g N   on the bed %.3g m%s", name,
                 maxd(line->tension[line->node_count - 2], 0), line->largest, line->touchdown,
                 snap ? "   SNAP" : "");
        put_text(sheet, 1.1 * em, y, text, true);
    }
}

static void put_sea(Sheet *sheet, double x, double y, const char *before, const WaveTarget *wave)
{
    char text[128], number[2][32];
    double heading = wave->heading * 180.0 / PI;
    format_number(number[0], sizeof number[0], heading, 0);
    snprintf(text, sizeof text, "%sH %.3g m   T %.3g s   heading %s\xC2\xB0", before, wave->height,
             wave->period, number[0]);
    put_text(sheet, x, y, text, true);
}

static void put_words(Sheet *sheet, const Snapshot *snapshot)
{
    const double em = sheet->em, margin = 1.1 * em;
    char text[128];
    snprintf(text, sizeof text, "t = %.2f s", snapshot->time);
    put_text(sheet, margin, margin + em, text, true);
    double y = margin + 2.5 * em;
    if (snapshot->has_waves) {
        put_sea(sheet, margin, y, "", &snapshot->wave_now);
        y += 1.5 * em;
        if (snapshot->wave_changing) {
            put_sea(sheet, margin, y, "\xE2\x86\x92 ", &snapshot->wave_asked);
            y += 1.5 * em;
        }
    }
    put_line_words(sheet, snapshot, y);
}

bool overlay_draw(Overlay *overlay, const Gl *gl, const Frame *frame, Error *error)
{
    Sheet sheet = {.em = maxd(9.0, frame->view->height / 37.0)};
    sheet.vertices =
        scratch_need(&overlay->vertices, (size_t)QUADS_MAX * 4 * sizeof(OverlayVertex), error);
    TRY(sheet.vertices);
    bool dark = frame->view->dark;
    const float ink[4] = {dark ? 0.92f : 0.10f, dark ? 0.95f : 0.13f, dark ? 0.97f : 0.17f, 1.0f};
    memcpy(sheet.colour, ink, sizeof ink);
    put_words(&sheet, frame->snapshot);
    double right = frame->view->width - 1.1 * sheet.em, y = 1.1 * sheet.em;
    double height = maxd(4.0 * sheet.em, 0.27 * frame->view->height);
    if (frame->field_scale.shown)
        y = put_bar(&sheet, &frame->field_scale,
                    frame->field == FIELD_ELEVATION ? MAP_DIVERGING : MAP_SEQUENTIAL, right, y,
                    height);
    if (frame->tension_scale.shown) {
        y = put_bar(&sheet, &frame->tension_scale, MAP_TENSION, right, y, height);
        put_line_key(&sheet, right, y);
    }

    gl_mesh_vertices(gl, &overlay->mesh, sheet.vertices,
                     (size_t)sheet.quad_count * 4 * sizeof(OverlayVertex));
    gl->UseProgram(overlay->program);
    gl->Uniform4f(overlay->halo, dark ? 0.04f : 0.97f, dark ? 0.05f : 0.98f, dark ? 0.07f : 0.99f,
                  dark ? 0.75f : 0.70f);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, overlay->atlas);
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_BLEND);
    gl->BindVertexArray(overlay->mesh.array);
    gl->DrawElements(GL_TRIANGLES, sheet.quad_count * 6, GL_UNSIGNED_INT, NULL);
    gl->Disable(GL_BLEND);
    gl->Enable(GL_DEPTH_TEST);
    return true;
}
