/// What a case file becomes: units, defaults, values that follow from others, overrides, the hash.
#include <stdlib.h>
#include <unistd.h>

#include "scene_case.h"
#include "test.h"

#define CASE(name) SOURCE_DIR "/cases/" name
#define STEERED SOURCE_DIR "/tests/good_cases/steered.json"

static Scene scene;
static Error error;

/// Load a case written here.
static bool load_text(const char *text)
{
    char path[] = "/tmp/fairlead_test_scene_XXXXXX";
    int file = mkstemp(path);
    bool written = file >= 0 && write(file, text, strlen(text)) == (ssize_t)strlen(text);
    if (file >= 0) close(file);
    bool good = written && scene_load(path, NULL, 0, &scene, &error);
    unlink(path);
    return good;
}

static bool load_with(const char *path, const char *assignment)
{
    return scene_load(path, &assignment, assignment ? 1 : 0, &scene, &error);
}

/// A shipped case with one override is refused with this text.
static void check_refusal(const char *path, const char *assignment, const char *text)
{
    error.message[0] = 0;
    CHECK(!load_with(path, assignment));
    CHECK_CONTAINS(error.message, text);
}

TEST(a_case_is_read_into_si_units_and_radians)
{
    CHECK(load_with(STEERED, NULL));
    CHECK(strcmp(scene.name, "steered") == 0);
    CHECK(scene.domain.kind == DOMAIN_BASIN && scene.domain.dimensions == 3);
    CHECK_NEAR(scene.waves.initial.heading, PI, 1e-12);
    CHECK_NEAR(scene.waves.heading_limits.max, 2 * PI, 1e-12);
    CHECK(scene.waves.start == WAVE_START_HOT);
    CHECK(scene.body_count == 1 && scene.bodies[0].shape == BODY_MESH);
    CHECK(isnan(scene.bodies[0].position.z) && isnan(scene.bodies[0].mass));
    CHECK_NEAR(scene.bodies[0].colour[0], 0xb5 / 255.0, 1e-12);
    CHECK(scene.line_count == 1 && scene.lines[0].anchor.body == -1);
    CHECK(scene.lines[0].fairlead.body == 0);
    CHECK_NEAR(scene.lines[0].fairlead.position.x, 1.5, 1e-12);
    CHECK(scene.gauge_count == 2 && strcmp(scene.gauges[0].name, "g1") == 0);
    CHECK_CONTAINS(scene.bodies[0].mesh_path, "/good_cases/../../assets/coaster.stl");
}

TEST(what_a_case_leaves_out_has_its_default)
{
    CHECK(load_text("{\"domain\": {\"kind\": \"tank\", \"min_m\": [0,0,-1], \"max_m\": [1,1,1]},"
                    " \"fluid\": {\"spacing_m\": 0.1}}"));
    CHECK_NEAR(scene.fluid.smoothing_ratio, 2.0, 0);
    CHECK_NEAR(scene.fluid.alpha, 0.002, 0);
    CHECK_NEAR(scene.fluid.delta, 0.1, 0);
    CHECK_NEAR(scene.fluid.density, 1000, 0);
    CHECK_NEAR(scene.fluid.gravity, 9.81, 0);
    CHECK_NEAR(scene.fluid.level, 0, 0);
    CHECK(scene.waves.kind == WAVES_NONE && scene.body_count == 0 && scene.line_count == 0);
    CHECK(scene.title[0] != 0);
    CHECK(isnan(scene.camera.distance));
}

TEST(required_numbers_default_to_not_a_number)
{
    Scene empty = scene_default();
    BodyScene body = body_scene_default();
    LineScene line = line_scene_default();
    CHECK(isnan(empty.fluid.spacing) && isnan(empty.domain.min.x));
    CHECK(isnan(body.mass) && isnan(body.radius) && isnan(body.position.x));
    CHECK(isnan(line.length) && isnan(line.axial_stiffness) && isnan(line.diameter));
    CHECK_NEAR(line.drag_normal, 1.6, 0);
    CHECK(line.segments == 20);
}

TEST(basin_is_centred_and_its_ring_stands_above_the_largest_wave)
{
    CHECK(load_with(STEERED, "waves.limits.height_m=[0,0.2]"));
    CHECK_NEAR(scene.domain.min.x, -scene.domain.max.x, 0);
    CHECK_NEAR(scene.domain.min.y, -scene.domain.max.y, 0);
    CHECK_NEAR(scene.domain.min.z, -1.2, 1e-12);
    CHECK_NEAR(scene.domain.max.z, 1.3 * 0.2, 1e-12);
}

TEST(limits_left_out_allow_lower_waves_and_any_heading_only)
{
    CHECK(load_with(STEERED, "waves.limits=null"));
    CHECK_NEAR(scene.waves.height_limits.min, 0, 0);
    CHECK_NEAR(scene.waves.height_limits.max, 0.2, 0);
    CHECK_NEAR(scene.waves.period_limits.min, 1.58, 0);
    CHECK_NEAR(scene.waves.period_limits.max, 1.58, 0);
    CHECK_NEAR(scene.waves.heading_limits.max, 2 * PI, 1e-12);
    CHECK_NEAR(scene.waves.ramp_time, 2 * 1.58, 1e-12);
}

TEST(waves_can_be_switched_off_without_taking_them_out)
{
    CHECK(load_with(STEERED, "waves.kind=none"));
    CHECK(scene.waves.kind == WAVES_NONE && scene.waves.initial.height == 0);
    CHECK_NEAR(scene.domain.max.z, 1.3 * 0.3, 1e-12);
}

static const char PLANE[] =
    "{\"domain\": {\"kind\": \"tank\", \"dimensions\": 2, \"min_m\": [-2,-1], \"max_m\": [2, 9, "
    "1]},"
    " \"fluid\": {\"spacing_m\": 0.1}, \"bodies\": ["
    "{\"name\": \"a\", \"shape\": \"box\", \"size_m\": [0.4, 0.2], \"position_m\": [1], "
    "\"draft_m\": 0.1},"
    "{\"name\": \"b\", \"shape\": \"polygon\", \"points_m\": [[0,0],[0.5,0],[0,0.5]],"
    " \"position_m\": [0.5, 0.2], \"mass_kg\": 10, \"freedoms\": {\"others\": \"fixed\","
    " \"pitch\": {\"spring\": {\"stiffness_n_m_per_rad\": 7, \"rest_deg\": 90}},"
    " \"heave\": {\"prescribed\": {\"amplitude_m\": 0.1, \"period_s\": 2, \"phase_deg\": 180}}}}]}";

TEST(points_of_two_numbers_are_x_and_z_in_the_plane)
{
    CHECK(load_text(PLANE));
    CHECK_NEAR(scene.domain.min.z, -1, 0);
    CHECK_NEAR(scene.domain.max.z, 1, 0);
    CHECK_NEAR(scene.domain.max.y - scene.domain.min.y, 1, 0);
    CHECK_NEAR(scene.bodies[0].size.y, 1, 0);
    CHECK_NEAR(scene.bodies[0].size.z, 0.2, 0);
    CHECK_NEAR(scene.bodies[0].position.x, 1, 0);
    CHECK(isnan(scene.bodies[0].position.z));
    CHECK_NEAR(scene.bodies[1].position.z, 0.2, 0);
    CHECK(scene.bodies[1].polygon_count == 3);
    CHECK_NEAR(scene.bodies[1].polygon[2][1], 0.5, 0);
}

TEST(freedoms_are_read_by_name_and_by_word)
{
    CHECK(load_text(PLANE));
    const Freedom *a = scene.bodies[0].freedoms, *b = scene.bodies[1].freedoms;
    CHECK(a[0].kind == FREEDOM_FREE && a[2].kind == FREEDOM_FREE && a[4].kind == FREEDOM_FREE);
    CHECK(a[1].kind == FREEDOM_FIXED && a[3].kind == FREEDOM_FIXED && a[5].kind == FREEDOM_FIXED);
    CHECK(b[0].kind == FREEDOM_FIXED);
    CHECK(b[2].kind == FREEDOM_PRESCRIBED && b[4].kind == FREEDOM_SPRING);
    CHECK_NEAR(b[2].phase, PI, 1e-12);
    CHECK_NEAR(b[2].amplitude, 0.1, 0);
    CHECK_NEAR(b[4].stiffness, 7, 0);
    CHECK_NEAR(b[4].rest, PI / 2, 1e-12);
    CHECK(load_with(CASE("heave_decay.json"), "bodies.sphere.freedoms=fixed"));
    CHECK(scene.bodies[0].freedoms[2].kind == FREEDOM_FIXED);
}

TEST(three_moments_of_inertia_have_no_products)
{
    CHECK(load_with(CASE("moored_box.json"), NULL));
    CHECK_NEAR(scene.bodies[0].inertia[2], 0.021, 0);
    for (int i = 3; i < 6; i++)
        CHECK_NEAR(scene.bodies[0].inertia[i], 0, 0);
    CHECK(isnan(scene.bodies[0].radii_of_gyration.x));
}

TEST(overrides_name_items_by_index_or_by_name_and_create_what_is_missing)
{
    const char *const all[] = {"bodies.ship.mass_kg=400",       "bodies[0].position_m[1]=0.25",
                               "outputs.series_interval_s=0.5", "waves.start=ramp",
                               "title=\"in quotes\"",           "probes.gauges.g2.x_m=1"};
    CHECK(scene_load(STEERED, all, 6, &scene, &error));
    CHECK_NEAR(scene.bodies[0].mass, 400, 0);
    CHECK_NEAR(scene.bodies[0].position.y, 0.25, 0);
    CHECK_NEAR(scene.outputs.series_interval, 0.5, 0);
    CHECK(scene.waves.start == WAVE_START_RAMP);
    CHECK(strcmp(scene.title, "in quotes") == 0);
    CHECK_NEAR(scene.gauges[1].x, 1, 0);
}

TEST(overrides_that_lead_nowhere_are_refused)
{
    const char *ship = STEERED;
    check_refusal(ship, "waves.period_s", "--set waves.period_s: must be path=value");
    check_refusal(ship, "=3", "must be path=value");
    check_refusal(ship, "waves.=3", "must be path=value");
    check_refusal(ship, "waves..x=3", "must be path=value");
    check_refusal(ship, "bodies[x].mass_kg=3", "must be path=value");
    check_refusal(ship, "bodies[7].mass_kg=3", "index 7: must be >= 0 and < 1");
    check_refusal(ship, "bodies.boat.mass_kg=3", "nothing in this list is named \"boat\"");
    check_refusal(ship, "title.x=3", "leads through a value that is no object");
    check_refusal(ship, "waves.perod_s=3",
                  "waves.perod_s: unknown key: the nearest known one is "
                  "\"period_s\"");
    check_refusal(ship, "fluid.spacing_m=0,1", "fluid.spacing_m = \"0,1\": must be a number > 0");
    check_refusal(ship, "fluid=null", "fluid.spacing_m: is missing");
}

TEST(hash_knows_what_was_changed_and_not_how_the_file_is_laid_out)
{
    CHECK(load_with(STEERED, NULL));
    uint64_t plain = scene.hash;
    CHECK(load_with(STEERED, "waves.period_s=1.58"));
    CHECK(scene.hash == plain);
    CHECK(load_with(STEERED, "waves.period_s=1.59"));
    CHECK(scene.hash != plain);
    JsonValue *list = tree_parse(" [ 1 ] ");
    CHECK(tree_hash(list) == 0xdc72d61a20e83324ull); // FNV-1a of "[1]"
    tree_destroy(list);
}

TEST(a_refused_case_leaves_the_scene_as_it_was)
{
    CHECK(load_with(CASE("dam_break.json"), NULL));
    CHECK(!load_with(STEERED, "fluid.spacing_m=-1"));
    CHECK(strcmp(scene.name, "dam_break") == 0);
}

TEST(memory_check_names_a_spacing_that_fits)
{
    CHECK(load_with(STEERED, NULL));
    CaseFile draft = case_file_default();
    JsonReader reader = {"case", &draft, &error};
    const double memory = 1e6; // 4000 particles
    CHECK(!case_check_memory(&reader, &scene, memory));
    const char *named = strstr(error.message, ">= ");
    double spacing = named ? atof(named + 3) : NAN;
    CHECK(spacing > scene.fluid.spacing);
    CHECK(case_particle_estimate(&scene, spacing) <= memory / 250);
    CHECK(case_particle_estimate(&scene, 0.98 * spacing) > memory / 250);
    double needed = 250 * case_particle_estimate(&scene, scene.fluid.spacing);
    CHECK(case_check_memory(&reader, &scene, 1.001 * needed));
    CHECK(!case_check_memory(&reader, &scene, 0.999 * needed));
}

TEST(messages_shorten_long_values_within_a_character)
{
    char text[512] = "title=\"";
    for (int i = 0; i < 100; i++)
        strcat(text, "\xc3\xa4"); // ä
    strcat(text, "\"");
    check_refusal(CASE("dam_break.json"), text, "...: must have 1 to 159 characters");
    const char *c = strchr(error.message, '"');
    for (c = c ? c + 1 : ""; strncmp(c, "\xc3\xa4", 2) == 0; c += 2) {
    }
    CHECK(strncmp(c, "...", 3) == 0);
}
