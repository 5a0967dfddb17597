/// Pictures for the eye: with FAIRLEAD_PICTURES=folder in the environment every look is written
/// there as PNG and timed; without, a small one is drawn so that the list itself is tested.
#include "test.h"

#include <stdlib.h>
#include <time.h>

#include "render_fixture.h"

typedef struct Look {
    const char *name;
    WaterMode water;
    ColourField field;
    bool dark;
    double azimuth, elevation, distance;
    int samples;
} Look;

static const Look looks[] = {
    {"water_light", WATER_SURFACE, FIELD_NONE, false, -1.05, 0.36, 9.6, 0},
    {"water_dark", WATER_SURFACE, FIELD_NONE, true, -1.05, 0.36, 9.6, 0},
    {"water_still", WATER_SURFACE, FIELD_NONE, false, -1.05, 0.36, 9.6, 4},
    {"water_low", WATER_SURFACE, FIELD_NONE, false, -0.5, 0.08, 7.0, 0},
    {"water_near", WATER_SURFACE, FIELD_NONE, false, -0.7, 0.25, 4.2, 4},
    {"elevation", WATER_SURFACE, FIELD_ELEVATION, false, -1.05, 0.5, 9.6, 0},
    {"speed_dark", WATER_SURFACE, FIELD_SPEED, true, -2.2, 0.4, 9.6, 0},
    {"particles", WATER_PARTICLES, FIELD_SPEED, false, -1.05, 0.36, 9.6, 0},
    {"particles_pressure", WATER_PARTICLES, FIELD_PRESSURE, true, -1.05, 0.3, 9.6, 0},
    {"from_below", WATER_SURFACE, FIELD_NONE, false, -1.05, -0.03, 7.5, 0},
    {"from_above", WATER_SURFACE, FIELD_NONE, false, -1.57, 1.5, 9.6, 0},
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void write_file(const char *folder, const char *name, const uint8_t *bytes, size_t size)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    FILE *file = fopen(path, "wb");
    if (!file) return;
    fwrite(bytes, 1, size, file);
    fclose(file);
}

static void draw_look(Render *render, const Fixture *fixture, const Look *look, const char *folder)
{
    ViewOptions view = fixture_view();
    view.water = look->water;
    view.field = look->field;
    view.dark = look->dark;
    view.samples = look->samples;
    view.camera.azimuth = look->azimuth;
    view.camera.elevation = look->elevation;
    view.camera.distance = look->distance;
    if (!folder) view.width = 160, view.height = 90;
    Error error = {0};
    CHECK(render_draw(render, &fixture->snapshot, &view, &error));
    if (error.code) printf("  %s: %s\n", look->name, error.message);
    if (!folder) return;
    double begin = now();
    int repeats = 10;
    for (int i = 0; i < repeats; i++)
        render_draw(render, &fixture->snapshot, &view, &error);
    double drawn = (now() - begin) / repeats;
    size_t jpeg_size = 0, png_size = 0;
    begin = now();
    render_jpeg(render, 80, &jpeg_size, &error);
    double jpeg = now() - begin;
    begin = now();
    const uint8_t *png = render_png(render, &png_size, &error);
    printf("  %-20s %6.1f ms  jpeg %4.1f ms %4zu kB  png %5.1f ms %4zu kB\n", look->name,
           1e3 * drawn, 1e3 * jpeg, jpeg_size / 1024, 1e3 * (now() - begin), png_size / 1024);
    write_file(folder, look->name, png, png_size);
}

TEST(every_look_can_be_drawn)
{
    const char *folder = getenv("FAIRLEAD_PICTURES");
    Error error = {0};
    double begin = now();
    Render *render = render_create(&error);
    CHECK(render);
    if (!render) {
        printf("  %s\n", error.message);
        return;
    }
    if (folder) printf("  %s (%.0f ms)\n", render_description(render), 1e3 * (now() - begin));
    Fixture fixture = fixture_basin(folder ? 0.05 : 0.1, 0.18);
    fixture_ship(&fixture);
    fixture_line(&fixture);
    fixture_water(&fixture);
    if (folder) printf("  %d particles\n", fixture.snapshot.fluid_count);
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++)
        draw_look(render, &fixture, &looks[i], folder);
    fixture_free(&fixture);
    render_destroy(render);
}
