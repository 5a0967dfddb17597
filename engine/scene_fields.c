/// The keys of a case file, those of bodies and lines apart: one row per key. cases/schema.json
/// tells editors the same; tests/unit/test_scene_schema.c holds the two together.
#include "scene_case.h"

// clang-format off
#define IN_CASE(member) .offset = offsetof(CaseFile, member)
#define COUNT(fields) (int)(sizeof(fields) / sizeof *(fields))
// Ranges are wide enough for full scale and narrow enough to catch a slip of units.
#define COORDINATE .min = -10000, .max = 10000, .unit = "m"
#define LENGTH_UP_TO(max_) .max = max_, .above_min = true, .unit = "m"
#define DEGREES(min_, max_) .min = min_, .max = max_, .unit = "deg", .to_si = PI / 180

static const JsonField DOMAIN_FIELDS[] = {
    {"kind", FIELD_CHOICE, true, IN_CASE(scene.domain.kind), .choices = {"tank", "flume", "basin", "lines"}},
    {"dimensions", FIELD_INTEGER, IN_CASE(scene.domain.dimensions), .min = 2, .max = 3},
    {"min_m", FIELD_POINT, IN_CASE(scene.domain.min), COORDINATE},
    {"max_m", FIELD_POINT, IN_CASE(scene.domain.max), COORDINATE},
    {"length_m", FIELD_NUMBER, IN_CASE(basin_length), LENGTH_UP_TO(20000)},
    {"breadth_m", FIELD_NUMBER, IN_CASE(basin_breadth), LENGTH_UP_TO(20000)},
    {"depth_m", FIELD_NUMBER, IN_CASE(basin_depth), LENGTH_UP_TO(10000)},
    {"freeboard_m", FIELD_NUMBER, IN_CASE(basin_freeboard), LENGTH_UP_TO(1000)},
    {"time_step_s", FIELD_NUMBER, IN_CASE(scene.lines_step), .max = 10, .above_min = true, .unit = "s"},
};
static const JsonTable DOMAIN_TABLE = {DOMAIN_FIELDS, COUNT(DOMAIN_FIELDS), NULL};

static const JsonField BLOCK_FIELDS[] = {
    {"min_m", FIELD_POINT, true, .offset = offsetof(FluidBlock, min), COORDINATE},
    {"max_m", FIELD_POINT, true, .offset = offsetof(FluidBlock, max), COORDINATE},
};
static const JsonTable BLOCK_TABLE = {BLOCK_FIELDS, COUNT(BLOCK_FIELDS), NULL};

static const JsonField STANDING_FIELDS[] = {
    {"height_m", FIELD_NUMBER, true, IN_CASE(scene.fluid.standing_height), .max = 50, .unit = "m"},
    {"half_waves", FIELD_INTEGER, IN_CASE(scene.fluid.standing_mode), .min = 1, .max = 1000},
};
static const JsonTable STANDING_TABLE = {STANDING_FIELDS, COUNT(STANDING_FIELDS), NULL};

static const JsonField FLUID_FIELDS[] = {
    {"spacing_m", FIELD_NUMBER, IN_CASE(scene.fluid.spacing), LENGTH_UP_TO(10)},
    {"smoothing_ratio", FIELD_NUMBER, IN_CASE(scene.fluid.smoothing_ratio), .min = 1.2, .max = 3},
    {"kernel", FIELD_CHOICE, IN_CASE(scene.fluid.kernel), .choices = {"wendland", "yielding"}},
    {"density_kgm3", FIELD_NUMBER, IN_CASE(scene.fluid.density), .min = 100, .max = 20000, .unit = "kg/m3"},
    {"alpha", FIELD_NUMBER, IN_CASE(scene.fluid.alpha), .max = 1},
    {"delta", FIELD_NUMBER, IN_CASE(scene.fluid.delta), .max = 1},
    {"gradient", FIELD_CHOICE, IN_CASE(scene.fluid.gradient), .choices = {"plain", "corrected"}},
    {"viscosity_m2s", FIELD_NUMBER, IN_CASE(scene.fluid.viscosity), .max = 1, .unit = "m2/s"},
    {"turbulence", FIELD_CHOICE, IN_CASE(scene.fluid.turbulence), .choices = {"none", "sps"}},
    {"walls", FIELD_CHOICE, IN_CASE(scene.fluid.walls), .choices = {"slip", "no_slip"}},
    {"shifting", FIELD_NUMBER, IN_CASE(scene.fluid.shifting), .max = 10},
    {"sound_speed_ms", FIELD_NUMBER, IN_CASE(scene.fluid.sound_speed), .max = 5000, .unit = "m/s"},
    {"sound_speed_ratio", FIELD_NUMBER, IN_CASE(scene.fluid.sound_speed_ratio), .min = 7, .max = 20},
    {"gravity_ms2", FIELD_NUMBER, IN_CASE(scene.fluid.gravity), .min = 0.1, .max = 100, .unit = "m/s2"},
    {"level_m", FIELD_NUMBER, IN_CASE(scene.fluid.level), COORDINATE},
    {"blocks", FIELD_LIST, IN_CASE(scene.fluid.blocks), .table = &BLOCK_TABLE,
     .item_size = sizeof(FluidBlock), .counter_offset = offsetof(CaseFile, scene.fluid.block_count),
     .count_max = SCENE_FLUID_BLOCKS_MAX},
    {"standing_wave", FIELD_OBJECT, .table = &STANDING_TABLE},
};
static const JsonTable FLUID_TABLE = {FLUID_FIELDS, COUNT(FLUID_FIELDS), NULL};

#define WAVE_HEIGHT .max = 50, .unit = "m"
#define WAVE_PERIOD .min = 0.1, .max = 60, .unit = "s"

static const JsonField LIMIT_FIELDS[] = {
    {"height_m", FIELD_RANGE, IN_CASE(scene.waves.height_limits), WAVE_HEIGHT},
    {"period_s", FIELD_RANGE, IN_CASE(scene.waves.period_limits), WAVE_PERIOD},
    {"heading_deg", FIELD_RANGE, IN_CASE(scene.waves.heading_limits), DEGREES(-180, 360)},
};
static const JsonTable LIMIT_TABLE = {LIMIT_FIELDS, COUNT(LIMIT_FIELDS), NULL};

static const JsonField SPECTRUM_FIELDS[] = {
    {"shape", FIELD_CHOICE, IN_CASE(scene.waves.spectrum.kind), .choices = {"jonswap", "pierson_moskowitz"}},
    {"peak_enhancement", FIELD_NUMBER, IN_CASE(scene.waves.spectrum.peak_enhancement), .min = 1, .max = 20},
    {"spreading", FIELD_NUMBER, IN_CASE(scene.waves.spectrum.spreading), .max = 200},
    {"components", FIELD_INTEGER, IN_CASE(scene.waves.spectrum.components), .min = 8, .max = SCENE_COMPONENTS_MAX},
    {"seed", FIELD_INTEGER, IN_CASE(scene.waves.spectrum.seed), .max = 2147483647},
};
static const JsonTable SPECTRUM_TABLE = {SPECTRUM_FIELDS, COUNT(SPECTRUM_FIELDS), NULL};

static const JsonField FOCUS_FIELDS[] = {
    {"x_m", FIELD_NUMBER, IN_CASE(scene.waves.focus.x), COORDINATE},
    {"y_m", FIELD_NUMBER, IN_CASE(scene.waves.focus.y), COORDINATE},
    {"time_s", FIELD_NUMBER, true, IN_CASE(scene.waves.focus.time), .max = 100000, .unit = "s"},
};
static const JsonTable FOCUS_TABLE = {FOCUS_FIELDS, COUNT(FOCUS_FIELDS), NULL};

static const JsonField GAIN_FIELDS[] = {
    {"gauge", FIELD_NAME, true, IN_CASE(scene.waves.gain.gauge_name), .count_max = SCENE_NAME_SIZE},
    {"start", FIELD_NUMBER, IN_CASE(scene.waves.gain.start), .min = 0.5, .max = 2},
    {"largest", FIELD_NUMBER, IN_CASE(scene.waves.gain.largest), .min = 1, .max = 2},
};
static const JsonTable GAIN_TABLE = {GAIN_FIELDS, COUNT(GAIN_FIELDS), NULL};

static const JsonField CURRENT_FIELDS[] = {
    {"speed_ms", FIELD_NUMBER, true, IN_CASE(scene.waves.current.speed), .max = 10, .unit = "m/s"},
    {"heading_deg", FIELD_NUMBER, IN_CASE(scene.waves.current.heading), DEGREES(-180, 360)},
    {"ramp_s", FIELD_NUMBER, IN_CASE(scene.waves.current.ramp), .max = 1000, .unit = "s"},
};
static const JsonTable CURRENT_TABLE = {CURRENT_FIELDS, COUNT(CURRENT_FIELDS), NULL};

static const JsonField WAVE_FIELDS[] = {
    {"kind", FIELD_CHOICE, true, IN_CASE(scene.waves.kind),
     .choices = {"none", "regular", "irregular", "focused", "record"}},
    {"theory", FIELD_CHOICE, IN_CASE(scene.waves.theory),
     .choices = {"auto", "airy", "stokes2", "stokes5", "stream"}},
    {"height_m", FIELD_NUMBER, IN_CASE(scene.waves.initial.height), WAVE_HEIGHT},
    {"period_s", FIELD_NUMBER, IN_CASE(scene.waves.initial.period), WAVE_PERIOD},
    {"heading_deg", FIELD_NUMBER, IN_CASE(scene.waves.initial.heading), DEGREES(-180, 360)},
    {"start", FIELD_CHOICE, IN_CASE(scene.waves.start), .choices = {"ramp", "hot"}},
    {"ramp_s", FIELD_NUMBER, IN_CASE(scene.waves.ramp_time), .max = 1000, .unit = "s"},
    {"blend_periods", FIELD_NUMBER, IN_CASE(scene.waves.blend_periods), .min = 0.5, .max = 10},
    {"zone_width_m", FIELD_NUMBER, IN_CASE(scene.waves.zone_width), .max = 1000, .unit = "m"},
    {"spectrum", FIELD_OBJECT, .table = &SPECTRUM_TABLE},
    {"focus", FIELD_OBJECT, .table = &FOCUS_TABLE},
    {"current", FIELD_OBJECT, .table = &CURRENT_TABLE},
    {"gain", FIELD_OBJECT, .table = &GAIN_TABLE},
    {"piston_order", FIELD_INTEGER, IN_CASE(scene.waves.piston_order), .min = 1, .max = 2},
    {"piston_motion", FIELD_TEXT, IN_CASE(scene.waves.piston_path), .count_max = SCENE_PATH_SIZE},
    {"limits", FIELD_OBJECT, .table = &LIMIT_TABLE},
};
static const JsonTable WAVE_TABLE = {WAVE_FIELDS, COUNT(WAVE_FIELDS), case_finish_waves};

static const JsonField GAUGE_FIELDS[] = {
    {"name", FIELD_NAME, true, .offset = offsetof(GaugeScene, name), .count_max = SCENE_NAME_SIZE},
    {"x_m", FIELD_NUMBER, true, .offset = offsetof(GaugeScene, x), COORDINATE},
    {"y_m", FIELD_NUMBER, .offset = offsetof(GaugeScene, y), COORDINATE},
};
static const JsonTable GAUGE_TABLE = {GAUGE_FIELDS, COUNT(GAUGE_FIELDS), NULL};

static const JsonField PRESSURE_FIELDS[] = {
    {"name", FIELD_NAME, true, .offset = offsetof(PressureProbeScene, name), .count_max = SCENE_NAME_SIZE},
    {"body", FIELD_CUSTOM, .offset = offsetof(PressureProbeScene, body), .read = case_read_body},
    {"position_m", FIELD_POINT, true, .offset = offsetof(PressureProbeScene, position), COORDINATE},
    {"normal", FIELD_POINT, .offset = offsetof(PressureProbeScene, normal), .min = -1, .max = 1},
    {"patch_diameter_m", FIELD_NUMBER, .offset = offsetof(PressureProbeScene, patch), .max = 100, .unit = "m"},
};
static const JsonTable PRESSURE_TABLE = {PRESSURE_FIELDS, COUNT(PRESSURE_FIELDS), NULL};

static void pressure_default(void *item)
{
    ((PressureProbeScene *)item)->body = -1;
    ((PressureProbeScene *)item)->normal = vec3(NAN, NAN, NAN);
}

static const JsonField RUN_UP_FIELDS[] = {
    {"name", FIELD_NAME, true, .offset = offsetof(RunUpScene, name), .count_max = SCENE_NAME_SIZE},
    {"body", FIELD_CUSTOM, .offset = offsetof(RunUpScene, body), .read = case_read_body},
    {"from_m", FIELD_POINT, true, .offset = offsetof(RunUpScene, from), COORDINATE},
    {"to_m", FIELD_POINT, true, .offset = offsetof(RunUpScene, to), COORDINATE},
};
static const JsonTable RUN_UP_TABLE = {RUN_UP_FIELDS, COUNT(RUN_UP_FIELDS), NULL};

static void run_up_default(void *item) { ((RunUpScene *)item)->body = -1; }

static const JsonField SLAMMING_FIELDS[] = {
    {"name", FIELD_NAME, true, .offset = offsetof(SlammingScene, name), .count_max = SCENE_NAME_SIZE},
    {"body", FIELD_CUSTOM, true, .offset = offsetof(SlammingScene, body), .read = case_read_body},
    {"cutoff_hz", FIELD_NUMBER, true, .offset = offsetof(SlammingScene, cutoff), .max = 10000, .above_min = true, .unit = "Hz"},
    {"order", FIELD_INTEGER, .offset = offsetof(SlammingScene, order), .min = 1, .max = 4},
};
static const JsonTable SLAMMING_TABLE = {SLAMMING_FIELDS, COUNT(SLAMMING_FIELDS), NULL};

static void slamming_default(void *item) { ((SlammingScene *)item)->order = 2; }

static const JsonField GREEN_WATER_FIELDS[] = {
    {"name", FIELD_NAME, true, .offset = offsetof(GreenWaterScene, name), .count_max = SCENE_NAME_SIZE},
    {"body", FIELD_CUSTOM, true, .offset = offsetof(GreenWaterScene, body), .read = case_read_body},
    {"min_m", FIELD_POINT, true, .offset = offsetof(GreenWaterScene, min), COORDINATE},
    {"max_m", FIELD_POINT, true, .offset = offsetof(GreenWaterScene, max), COORDINATE},
};
static const JsonTable GREEN_WATER_TABLE = {GREEN_WATER_FIELDS, COUNT(GREEN_WATER_FIELDS), NULL};

static const JsonField QUALITY_FIELDS[] = {
    {"first", FIELD_NAME, true, IN_CASE(quality_names[0]), .count_max = SCENE_NAME_SIZE},
    {"second", FIELD_NAME, true, IN_CASE(quality_names[1]), .count_max = SCENE_NAME_SIZE},
    {"third", FIELD_NAME, true, IN_CASE(quality_names[2]), .count_max = SCENE_NAME_SIZE},
};
static const JsonTable QUALITY_TABLE = {QUALITY_FIELDS, COUNT(QUALITY_FIELDS), NULL};

static const JsonField PROBE_FIELDS[] = {
    {"gauges", FIELD_LIST, IN_CASE(scene.gauges), .table = &GAUGE_TABLE,
     .item_size = sizeof(GaugeScene), .counter_offset = offsetof(CaseFile, scene.gauge_count),
     .count_max = SCENE_GAUGES_MAX},
    {"pressure", FIELD_LIST, IN_CASE(scene.pressure_probes), .table = &PRESSURE_TABLE,
     .item_size = sizeof(PressureProbeScene),
     .counter_offset = offsetof(CaseFile, scene.pressure_probe_count),
     .count_max = SCENE_PRESSURE_PROBES_MAX, .item_default = pressure_default},
    {"run_up", FIELD_LIST, IN_CASE(scene.run_ups), .table = &RUN_UP_TABLE,
     .item_size = sizeof(RunUpScene), .counter_offset = offsetof(CaseFile, scene.run_up_count),
     .count_max = SCENE_RUN_UPS_MAX, .item_default = run_up_default},
    {"slamming", FIELD_LIST, IN_CASE(scene.slammings), .table = &SLAMMING_TABLE,
     .item_size = sizeof(SlammingScene), .counter_offset = offsetof(CaseFile, scene.slamming_count),
     .count_max = SCENE_SLAMMINGS_MAX, .item_default = slamming_default},
    {"green_water", FIELD_LIST, IN_CASE(scene.green_waters), .table = &GREEN_WATER_TABLE,
     .item_size = sizeof(GreenWaterScene),
     .counter_offset = offsetof(CaseFile, scene.green_water_count),
     .count_max = SCENE_GREEN_WATERS_MAX},
    {"wave_quality", FIELD_OBJECT, .table = &QUALITY_TABLE},
    {"energy", FIELD_CHOICE, IN_CASE(scene.energy), .choices = {"none", "levels", "budget"}},
};
static const JsonTable PROBE_TABLE = {PROBE_FIELDS, COUNT(PROBE_FIELDS), NULL};

static const JsonField CONTACT_FIELDS[] = {
    {"kind", FIELD_CHOICE, IN_CASE(scene.contacts.kind), .choices = {"auto", "none"}},
    {"friction", FIELD_NUMBER, IN_CASE(scene.contacts.friction), .max = 2},
};
static const JsonTable CONTACT_TABLE = {CONTACT_FIELDS, COUNT(CONTACT_FIELDS), NULL};

static const JsonField OUTPUT_FIELDS[] = {
    {"series_interval_s", FIELD_NUMBER, IN_CASE(scene.outputs.series_interval), .min = 0.0001,
     .max = 100, .unit = "s"},
    {"lines_interval_s", FIELD_NUMBER, IN_CASE(scene.outputs.lines_interval), .max = 1000, .unit = "s"},
};
static const JsonTable OUTPUT_TABLE = {OUTPUT_FIELDS, COUNT(OUTPUT_FIELDS), NULL};

static const JsonField CAMERA_FIELDS[] = {
    {"target_m", FIELD_POINT, IN_CASE(scene.camera.target), COORDINATE},
    {"distance_m", FIELD_NUMBER, IN_CASE(scene.camera.distance), LENGTH_UP_TO(100000)},
    {"azimuth_deg", FIELD_NUMBER, IN_CASE(scene.camera.azimuth), DEGREES(-360, 360)},
    {"elevation_deg", FIELD_NUMBER, IN_CASE(scene.camera.elevation), DEGREES(-89, 89)},
};
static const JsonTable CAMERA_TABLE = {CAMERA_FIELDS, COUNT(CAMERA_FIELDS), NULL};

static void body_default(void *item) { *(BodyScene *)item = body_scene_default(); }
static void point_default(void *item) { *(PointScene *)item = point_scene_default(); }
static void line_default(void *item) { *(LineScene *)item = line_scene_default(); }

// In the order in which they are read: points need the dimensions, lines and probes the bodies.
static const JsonField CASE_FIELDS[] = {
    {"$schema", FIELD_TEXT, IN_CASE(schema), .count_max = sizeof((CaseFile *)0)->schema},
    {"title", FIELD_TEXT, IN_CASE(scene.title), .count_max = sizeof((CaseFile *)0)->scene.title},
    {"domain", FIELD_OBJECT, true, .table = &DOMAIN_TABLE},
    {"fluid", FIELD_OBJECT, .table = &FLUID_TABLE},
    {"waves", FIELD_OBJECT, .table = &WAVE_TABLE},
    {"bodies", FIELD_LIST, IN_CASE(scene.bodies), .table = &BODY_TABLE,
     .item_size = sizeof(BodyScene), .counter_offset = offsetof(CaseFile, scene.body_count),
     .count_max = SCENE_BODIES_MAX, .item_default = body_default},
    {"contacts", FIELD_OBJECT, .table = &CONTACT_TABLE},
    {"points", FIELD_LIST, IN_CASE(scene.points), .table = &POINT_TABLE,
     .item_size = sizeof(PointScene), .counter_offset = offsetof(CaseFile, scene.point_count),
     .count_max = SCENE_POINTS_MAX, .item_default = point_default},
    {"lines", FIELD_LIST, IN_CASE(scene.lines), .table = &LINE_TABLE,
     .item_size = sizeof(LineScene), .counter_offset = offsetof(CaseFile, scene.line_count),
     .count_max = SCENE_LINES_MAX, .item_default = line_default},
    {"moordyn_file", FIELD_TEXT, IN_CASE(moordyn_path), .count_max = SCENE_PATH_SIZE},
    {"moordyn_body", FIELD_CUSTOM, IN_CASE(moordyn_body), .read = case_read_body},
    {"moordyn_axes", FIELD_CHOICE, IN_CASE(moordyn_axes), .choices = {"world", "body"}},
    {"probes", FIELD_OBJECT, .table = &PROBE_TABLE},
    {"outputs", FIELD_OBJECT, .table = &OUTPUT_TABLE},
    {"camera", FIELD_OBJECT, .table = &CAMERA_TABLE},
};
const JsonTable CASE_TABLE = {CASE_FIELDS, COUNT(CASE_FIELDS), NULL};
// clang-format on
