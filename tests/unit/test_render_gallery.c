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
    {"pressure", WATER_SURFACE, FIELD_PRESSURE, false, -1.05, 0.36, 9.6, 0},
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

static void draw_look(Render *render, const Fixture *fixture, const Look *look, Vec3 target,
                      const char *folder)
{
    ViewOptions view = fixture_view();
    view.camera.target = target;
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
    double begin = now(), work = (double)clock();
    int repeats = 10;
    for (int i = 0; i < repeats; i++)
        render_draw(render, &fixture->snapshot, &view, &error);
    double drawn = (now() - begin) / repeats;
    work = ((double)clock() - work) / CLOCKS_PER_SEC / repeats;
    size_t jpeg_size = 0, png_size = 0;
    begin = now();
    render_jpeg(render, 80, &jpeg_size, &error);
    double jpeg = now() - begin;
    begin = now();
    const uint8_t *png = render_png(render, &png_size, &error);
    printf("  %-20s %6.1f ms (%5.1f of processor)  jpeg %4.1f ms %4zu kB  png %5.1f ms %4zu kB\n",
           look->name, 1e3 * drawn, 1e3 * work, 1e3 * jpeg, jpeg_size / 1024, 1e3 * (now() - begin),
           png_size / 1024);
    write_file(folder, look->name, png, png_size);
}

/// A dam that has begun to run, in a tank of 3.2 m x 1 m x 1 m; a slice of it in 2-D.
static Fixture running_dam(double dp, int dimensions)
{
    Fixture fixture = {.seed = 3, .jitter = 0.3, .wave_length = 1.0};
    fixture.snapshot.domain = (Domain){DOMAIN_TANK, dimensions, {0, -0.5, 0}, {3.22, 0.5, 1.0}};
    fixture.snapshot.spacing = dp;
    fixture.snapshot.level = 0.55;
    fixture_water(&fixture);
    int kept = 0;
    for (int i = 0; i < fixture.snapshot.fluid_count; i++) {
        float *p = fixture.snapshot.position[i];
        double front = 1.1 + 1.1 * pow(maxd(0.0, 1.0 - p[2] / 0.5), 2.2);
        if (p[2] < 0 || p[0] > front || p[2] > 0.5 - 0.12 * maxd(0, p[0] - 0.6)) continue;
        memcpy(fixture.snapshot.position[kept], p, 12);
        fixture.snapshot.velocity[kept][0] = p[0];
        fixture.snapshot.pressure[kept++] = (float)(9810 * (0.52 - p[2]));
    }
    fixture.snapshot.fluid_count = kept;
    return fixture;
}

TEST(a_running_dam_can_be_drawn_in_space_and_as_a_slice)
{
    const char *folder = getenv("FAIRLEAD_PICTURES");
    Error error = {0};
    Render *render = render_create(&error);
    CHECK(render);
    if (!render) return;
    static const Look dams[] = {
        {"dam", WATER_SURFACE, FIELD_NONE, false, -1.2, 0.33, 4.4, 4},
        {"dam_speed", WATER_SURFACE, FIELD_SPEED, false, -1.2, 0.33, 4.4, 0},
        {"dam_particles", WATER_PARTICLES, FIELD_PRESSURE, true, -1.2, 0.33, 4.4, 0},
    };
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        Fixture fixture = running_dam(folder ? 0.02 : 0.05, dimensions);
        for (size_t i = 0; i < sizeof dams / sizeof *dams; i++) {
            Look look = dams[i];
            char name[64];
            snprintf(name, sizeof name, "%s_%dd", look.name, dimensions);
            look.name = name;
            draw_look(render, &fixture, &look, vec3(1.5, 0, 0.3), folder);
        }
        fixture_free(&fixture);
    }
    render_destroy(render);
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
    Arena arena = arena_create(0);
    TriangleMesh coaster;
    if (folder && mesh_load(SOURCE_DIR "/assets/coaster.stl", 1.0, &arena, &coaster, &error))
        fixture.snapshot.bodies[0].mesh = &coaster;
    fixture_line(&fixture);
    fixture_water(&fixture);
    if (folder) printf("  %d particles\n", fixture.snapshot.fluid_count);
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++)
        draw_look(render, &fixture, &looks[i], vec3(0.1, 0, -0.35), folder);
    fixture_free(&fixture);
    arena_destroy(&arena);
    render_destroy(render);
}
