/// Pictures: the context comes up, water, ship and bars are where they belong, nothing crashes.
#include "test.h"

#include <png.h>
#include <turbojpeg.h>

#include "render_fixture.h"

static Render *open_render(void)
{
    Error error = {0};
    Render *render = render_create(&error);
    if (!render) printf("  %s\n", error.message);
    return render;
}

static bool draw(Render *render, const Snapshot *snapshot, const ViewOptions *view)
{
    Error error = {0};
    bool good = render_draw(render, snapshot, view, &error);
    if (!good) printf("  %s\n", error.message);
    return good;
}

static ViewOptions small_view(void)
{
    ViewOptions view = fixture_view();
    view.width = 320;
    view.height = 180;
    return view;
}

/// A still tank with ship and line, coarse enough for a quick test.
static void still_tank(Fixture *fixture)
{
    *fixture = fixture_basin(0.1, 0.0);
    fixture_ship(fixture);
    fixture_line(fixture);
    fixture_water(fixture);
}

static const uint8_t *probe(Render *render, double x, double y)
{
    int width, height;
    const uint8_t *rgb = render_pixels(render, &width, &height);
    return rgb + 3 * ((int)(y * height) * width + (int)(x * width));
}

static uint64_t picture_hash(Render *render)
{
    int width, height;
    const uint8_t *rgb = render_pixels(render, &width, &height);
    uint64_t hash = 1469598103934665603u;
    for (int i = 0; i < width * height * 3; i++)
        hash = (hash ^ rgb[i]) * 1099511628211u;
    return hash;
}

static bool bluish(const uint8_t *rgb) { return rgb[2] > rgb[0] + 25 && rgb[1] > rgb[0] + 10; }

TEST(a_context_comes_up_and_says_what_it_is)
{
    Render *render = open_render();
    CHECK(render);
    if (!render) return;
    CHECK_CONTAINS(render_description(render), "OpenGL");
    size_t size;
    Error error = {0};
    CHECK(!render_jpeg(render, 80, &size, &error)); // nothing drawn yet
    CHECK_CONTAINS(error.message, "nothing");
    render_destroy(render);
}

TEST(an_unknown_kind_of_context_is_refused_by_name)
{
    setenv("FAIRLEAD_GL", "vulkan", 1);
    Error error = {0};
    Render *render = render_create(&error);
    unsetenv("FAIRLEAD_GL");
    CHECK(!render && error.code == ERROR_SYSTEM);
    CHECK_CONTAINS(error.message, "vulkan");
}

TEST(osmesa_draws_the_same_scene_where_it_is_installed)
{
    setenv("FAIRLEAD_GL", "osmesa", 1);
    Error error = {0};
    Render *render = render_create(&error);
    unsetenv("FAIRLEAD_GL");
    if (!render) {
        printf("  left out: %s\n", error.message);
        return;
    }
    Fixture fixture;
    still_tank(&fixture);
    ViewOptions view = small_view();
    CHECK_CONTAINS(render_description(render), "OSMesa");
    CHECK(draw(render, &fixture.snapshot, &view));
    CHECK(bluish(probe(render, 0.5, 0.72)));
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(water_ship_and_backdrop_are_where_they_belong)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture;
    still_tank(&fixture);
    ViewOptions view = small_view();
    view.overlay = false;
    CHECK(draw(render, &fixture.snapshot, &view));
    CHECK(bluish(probe(render, 0.30, 0.52))); // surface
    CHECK(bluish(probe(render, 0.40, 0.66))); // side wall
    const uint8_t *sky = probe(render, 0.5, 0.05), *bed = probe(render, 0.05, 0.85);
    CHECK(sky[0] > 200 && !bluish(sky));
    CHECK(bed[0] > bed[2]);
    const uint8_t *deck = probe(render, 0.50, 0.41);
    CHECK(abs(deck[0] - deck[2]) < 30 && !bluish(deck));
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(turning_the_camera_changes_the_picture)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture;
    still_tank(&fixture);
    ViewOptions view = small_view();
    CHECK(draw(render, &fixture.snapshot, &view));
    uint64_t before = picture_hash(render);
    view.camera.azimuth += 0.2;
    CHECK(draw(render, &fixture.snapshot, &view));
    CHECK(picture_hash(render) != before);
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(the_same_snapshot_gives_the_same_pixels)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture;
    still_tank(&fixture);
    for (int mode = 0; mode < 6; mode++) {
        ViewOptions view = small_view();
        view.water = mode < 4 ? WATER_SURFACE : WATER_PARTICLES;
        view.field = (ColourField)(mode % 4);
        view.dark = mode % 2;
        CHECK(draw(render, &fixture.snapshot, &view));
        uint64_t first = picture_hash(render);
        CHECK(draw(render, &fixture.snapshot, &view));
        CHECK(picture_hash(render) == first);
    }
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(pictures_follow_a_change_of_size)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture;
    still_tank(&fixture);
    const int sizes[][2] = {{320, 180}, {200, 300}, {64, 48}, {320, 180}, {16, 16}};
    for (int i = 0; i < 5; i++) {
        ViewOptions view = small_view();
        view.width = sizes[i][0];
        view.height = sizes[i][1];
        view.samples = i == 1 ? 4 : 0;
        int width, height;
        CHECK(draw(render, &fixture.snapshot, &view));
        render_pixels(render, &width, &height);
        CHECK(width == sizes[i][0] && height == sizes[i][1]);
    }
    fixture_free(&fixture);
    render_destroy(render);
}

static int png_rows_seen;
typedef struct PngBytes {
    const uint8_t *data;
    size_t size, at;
} PngBytes;
static void png_take(png_structp png, png_bytep out, png_size_t count)
{
    PngBytes *bytes = png_get_io_ptr(png);
    if (bytes->at + count > bytes->size) png_error(png, "short");
    memcpy(out, bytes->data + bytes->at, count);
    bytes->at += count;
}

TEST(jpeg_and_png_decode_to_the_picture)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture;
    still_tank(&fixture);
    ViewOptions view = small_view();
    Error error = {0};
    CHECK(draw(render, &fixture.snapshot, &view));
    int width, height, jpeg_width = 0, jpeg_height = 0, sampling, space;
    const uint8_t *rgb = render_pixels(render, &width, &height);

    PngBytes bytes = {0};
    bytes.data = render_png(render, &bytes.size, &error);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &bytes, png_take);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    CHECK((int)png_get_image_width(png, info) == width);
    CHECK((int)png_get_image_height(png, info) == height);
    png_bytepp rows = png_get_rows(png, info);
    for (int y = 0; y < height; y++)
        png_rows_seen += memcmp(rows[y], rgb + (size_t)y * width * 3, (size_t)width * 3) == 0;
    CHECK(png_rows_seen == height);
    png_destroy_read_struct(&png, &info, NULL);

    for (int quality = 60; quality <= 95; quality += 35) {
        size_t size = 0;
        const uint8_t *jpeg = render_jpeg(render, quality, &size, &error);
        tjhandle decoder = tjInitDecompress();
        CHECK(jpeg && tjDecompressHeader3(decoder, jpeg, size, &jpeg_width, &jpeg_height, &sampling,
                                          &space) == 0);
        CHECK(jpeg_width == width && jpeg_height == height);
        uint8_t *decoded = calloc((size_t)width * height, 3);
        tjDecompress2(decoder, jpeg, size, decoded, width, 0, height, TJPF_RGB, 0);
        double sum = 0;
        for (int i = 0; i < width * height * 3; i++)
            sum += abs(decoded[i] - rgb[i]);
        CHECK_NEAR(sum / (width * height * 3.0), 0, 4);
        free(decoded);
        tjDestroy(decoder);
    }
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(sick_and_empty_snapshots_are_drawn_without_harm)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture;
    still_tank(&fixture);
    Snapshot *snapshot = &fixture.snapshot;
    ViewOptions view = small_view();
    snapshot->position[5][0] = snapshot->position[6][2] = NAN;
    snapshot->velocity[7][1] = INFINITY;
    fixture.nodes[3][2] = NAN;
    fixture.tension[9] = NAN;
    for (int water = 0; water < 2; water++)
        for (int field = 0; field < 4; field++) {
            view.water = (WaterMode)water;
            view.field = (ColourField)field;
            CHECK(draw(render, snapshot, &view));
        }
    snapshot->bodies[0].origin.x = NAN;
    CHECK(draw(render, snapshot, &view));
    snapshot->fluid_count = snapshot->body_count = snapshot->line_count = 0;
    for (int water = 0; water < 2; water++) {
        view.water = (WaterMode)water;
        CHECK(draw(render, snapshot, &view));
    }
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(a_line_brings_its_colour_bar)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture;
    still_tank(&fixture);
    ViewOptions view = small_view();
    view.width = 480;
    view.height = 270;
    int saturated[2] = {0, 0};
    for (int lines = 0; lines < 2; lines++) {
        fixture.snapshot.line_count = lines;
        CHECK(draw(render, &fixture.snapshot, &view));
        int width, height;
        const uint8_t *rgb = render_pixels(render, &width, &height);
        for (int y = 0; y < height / 2; y++)
            for (int x = width * 8 / 10; x < width; x++) {
                const uint8_t *p = rgb + 3 * (y * width + x);
                saturated[lines] += p[0] > p[2] + 60;
            }
    }
    CHECK(saturated[0] < 20);
    CHECK(saturated[1] > 150);
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(bad_views_are_refused)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture = fixture_basin(0.2, 0.0);
    fixture_water(&fixture);
    ViewOptions bad[4] = {small_view(), small_view(), small_view(), small_view()};
    bad[0].width = 5000;
    bad[1].camera.distance = 0;
    bad[2].camera.azimuth = NAN;
    bad[3].camera.field_of_view = 4;
    for (int i = 0; i < 4; i++) {
        Error error = {0};
        CHECK(!render_draw(render, &fixture.snapshot, &bad[i], &error));
        CHECK(error.code == ERROR_INPUT);
    }
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(a_slice_is_drawn_as_a_thin_tank)
{
    Render *render = open_render();
    if (!render) return;
    Fixture fixture = fixture_basin(0.05, 0.1);
    fixture.snapshot.domain.dimensions = 2;
    fixture_water(&fixture);
    ViewOptions view = small_view();
    view.overlay = false;
    view.camera.azimuth = -0.5 * PI;
    view.camera.elevation = 0.1;
    for (int water = 0; water < 2; water++) {
        view.water = (WaterMode)water;
        CHECK(draw(render, &fixture.snapshot, &view));
        CHECK(bluish(probe(render, 0.5, 0.55)));
        CHECK(!bluish(probe(render, 0.5, 0.15)));
    }
    fixture_free(&fixture);
    render_destroy(render);
}

TEST(a_kept_stage_looks_like_one_drawn_anew)
{
    static Fixture fixture;
    still_tank(&fixture);
    ViewOptions first = small_view(), moved = small_view();
    moved.camera.azimuth += 0.5;
    Render *used = open_render(), *anew = open_render();
    if (!used || !anew) return;
    CHECK(draw(anew, &fixture.snapshot, &moved));
    CHECK(draw(used, &fixture.snapshot, &first));
    CHECK(draw(used, &fixture.snapshot, &moved));
    CHECK(picture_hash(used) == picture_hash(anew)); // drawn for the moved camera
    CHECK(draw(used, &fixture.snapshot, &moved));
    CHECK(picture_hash(used) == picture_hash(anew)); // copied
    fixture_free(&fixture);
    render_destroy(used);
    render_destroy(anew);
}

TEST(the_first_camera_sees_the_whole_scene)
{
    Scene scene = {0};
    scene.domain = (Domain){DOMAIN_BASIN, 3, {-3.6, -2.0, -1.2}, {3.6, 2.0, 0.4}};
    scene.camera = (CameraScene){{NAN, NAN, NAN}, NAN, -1.05, 0.36};
    Camera camera = camera_for_scene(&scene);
    CHECK(camera.distance > 5 && camera.distance < 20);
    CHECK_NEAR(camera.target.x, 0, 1e-9);
    CHECK_NEAR(camera.azimuth, -1.05, 0);
    scene.camera.distance = 3.0;
    CHECK_NEAR(camera_for_scene(&scene).distance, 3.0, 0);
}
