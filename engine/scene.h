/// Everything a case says, in SI units and radians, constant after load. Values that may be steered
/// live (wave height, period, heading) are *initial* values here.
///
/// Axes, once and for all: right-handed, z up, still water at z = 0 unless the case fills the tank
/// otherwise, x forward. Headings are directions the waves travel *to*: 0 along +x, 90 deg along
/// +y. Attitudes are intrinsic yaw-pitch-roll angles; quaternions are (w, x, y, z), body to world.
#ifndef FAIRLEAD_SCENE_H
#define FAIRLEAD_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/error.h"
#include "base/portable.h"
#include "physics/kernel_kind.h"

enum {
    SCENE_NAME_SIZE = 48,
    SCENE_PATH_SIZE = 512,
    SCENE_BODIES_MAX = 32,
    SCENE_LINES_MAX = 64,
    SCENE_LINE_SECTIONS_MAX = 16,
    SCENE_POINTS_MAX = 64,
    SCENE_GAUGES_MAX = 32,
    SCENE_PRESSURE_PROBES_MAX = 64,
    SCENE_RUN_UPS_MAX = 32,
    SCENE_SLAMMINGS_MAX = 32,
    SCENE_GREEN_WATERS_MAX = 32,
    SCENE_FLUID_BLOCKS_MAX = 16,
    SCENE_POLYGON_MAX = 256,
    SCENE_COMPONENTS_MAX = 512, ///< of a sea
};

typedef enum DomainKind {
    DOMAIN_TANK,  ///< closed by walls on all sides and the bed
    DOMAIN_FLUME, ///< piston at x min, damping beach at x max, walls at y
    DOMAIN_BASIN, ///< ring of wave-driven columns and relaxation zone on all lateral sides
    DOMAIN_LINES, ///< no particles at all: lines and bodies in the incident wave
} DomainKind;

typedef struct Domain {
    DomainKind kind;
    int dimensions; ///< 3, or 2 for the x-z plane (y is then ignored)
    Vec3 min;       ///< lower corner of the water's room [m]; min.z is the bed
    Vec3 max;       ///< upper corner [m]; max.z is the top of walls (tank) or of the ring (basin)
} Domain;

typedef struct FluidBlock {
    Vec3 min, max; ///< box filled with water at t = 0 [m]
} FluidBlock;

typedef enum GradientKind { GRADIENT_PLAIN, GRADIENT_CORRECTED } GradientKind;

typedef enum TurbulenceKind { TURBULENCE_NONE, TURBULENCE_SPS } TurbulenceKind;
typedef enum WallKind { WALLS_SLIP, WALLS_NO_SLIP } WallKind;

typedef struct Fluid {
    double spacing;            ///< initial particle distance dp [m], > 0
    double smoothing_ratio;    ///< h/dp, 1.2 to 3
    Kernel kernel;             ///< physics/kernel.h
    double density;            ///< rest density [kg/m^3]
    double alpha;              ///< artificial viscosity [-]
    double delta;              ///< density diffusion [-]
    GradientKind gradient;     ///< of the kernel, in pressure forces
    double viscosity;          ///< molecular, kinematic [m^2/s]; 0 = none
    TurbulenceKind turbulence; ///< stresses of what is not resolved; needs a viscosity
    WallKind walls;            ///< whether walls and bodies hold the water; needs a viscosity
    double shifting;           ///< of particles: A of physics/shift.h [-]; 0 = none
    double sound_speed;        ///< c0 [m/s]; 0 = by the rule (see plan.h)
    double sound_speed_ratio;  ///< rule: c0 = ratio * largest expected speed, 7 to 20
    double gravity;            ///< [m/s^2], downwards
    double level;              ///< still-water level z [m]
    int block_count;           ///< 0 = the whole domain is filled up to `level`
    FluidBlock blocks[SCENE_FLUID_BLOCKS_MAX];
    double standing_height; ///< crest to trough of a standing wave at t = 0 [m]; 0 = none
    int standing_mode;      ///< its half waves in the tank's length
} Fluid;

typedef enum WaveKind {
    WAVES_NONE,
    WAVES_REGULAR,
    WAVES_IRREGULAR, ///< height is the significant one, period the peak's
    WAVES_FOCUSED,   ///< a group: height is twice its crest at the focus, period the peak's
    WAVES_RECORD,    ///< flume: the piston follows a table; height and period of the largest wave
} WaveKind;
/// How a regular wave is described (steady_wave.h).
typedef enum WaveTheory {
    WAVE_THEORY_AUTO,    ///< the stream function
    WAVE_THEORY_AIRY,    ///< first order
    WAVE_THEORY_STOKES2, ///< second order
    WAVE_THEORY_STOKES5, ///< fifth order: deep and intermediate water
    WAVE_THEORY_STREAM,  ///< stream function: every wave up to near the highest
} WaveTheory;
typedef enum WaveStart { WAVE_START_RAMP, WAVE_START_HOT } WaveStart;

/// A regular wave as the user names it.
typedef struct WaveTarget {
    double height;  ///< crest to trough H [m]
    double period;  ///< T [s]
    double heading; ///< direction of travel [rad]
} WaveTarget;

typedef struct Range {
    double min, max;
} Range;

typedef enum SpectrumKind { SPECTRUM_JONSWAP, SPECTRUM_PIERSON_MOSKOWITZ } SpectrumKind;

/// What an irregular sea or a group is made of (sea.h).
typedef struct Spectrum {
    SpectrumKind kind;
    double peak_enhancement; ///< gamma of JONSWAP [-], >= 1
    double spreading;        ///< s of cos^2s(theta/2) [-]; 0 = long-crested
    int components;          ///< 8 to 512
    int seed;                ///< of phases and directions
} Spectrum;

/// Where and when the crests of a group meet.
typedef struct Focus {
    double x, y; ///< [m]
    double time; ///< [s]
} Focus;

/// A slow gain on the incident wave (wave_quality.h).
typedef struct WaveGain {
    int gauge;      ///< index of the gauge whose wave is to be as asked; -1 = none
    double start;   ///< what the first wave is made with, known from an earlier run [-]
    double largest; ///< bound; one over it is the smallest [-]
    char gauge_name[SCENE_NAME_SIZE]; ///< as the file says it
} WaveGain;

/// A steady uniform current (current.h).
typedef struct Current {
    double speed;   ///< [m/s]
    double heading; ///< where it flows to [rad]
    double ramp;    ///< time to grow from rest [s]; 0 = it flows from the start
} Current;

typedef struct Waves {
    WaveKind kind;
    WaveTheory theory;
    Spectrum spectrum; ///< irregular, focused
    Focus focus;       ///< focused
    WaveGain gain;
    Current current;
    int piston_order;                  ///< flume: 1, or 2 without free waves of second order
    char piston_path[SCENE_PATH_SIZE]; ///< record: the table, resolved against the case's folder
    WaveTarget initial;
    WaveStart start;
    double ramp_time;     ///< time to grow from rest [s] (ramp start)
    double blend_periods; ///< length of a live change in periods [-], default 1.5
    double zone_width;    ///< relaxation zone [m]; 0 = 0.75 of the longest allowed wave length
    Range height_limits;  ///< what may be set live [m]
    Range period_limits;  ///< [s]
    Range heading_limits; ///< [rad]
} Waves;

typedef enum BodyShape {
    BODY_BOX,      ///< size: length x, breadth y, height z; origin at its centre
    BODY_SPHERE,   ///< radius; origin at its centre
    BODY_CYLINDER, ///< radius, length, axis 0|1|2; origin at its centre
    BODY_WIGLEY,   ///< size: length, beam, depth; draft_design; origin midship on the keel
    BODY_POLYGON,  ///< closed x-z section (any winding), extruded over `breadth` in y when 3-D
    BODY_MESH,     ///< STL or OBJ file, closed and outward oriented, times `scale`
} BodyShape;

typedef enum FreedomKind {
    FREEDOM_FREE,
    FREEDOM_FIXED,
    FREEDOM_PRESCRIBED, ///< ramp * amplitude * sin(2 pi t / period + phase) about the reference
                        ///< pose
    FREEDOM_SPRING,     ///< free, with -stiffness (x - rest) - damping v added
} FreedomKind;

/// One of the six degrees of freedom: surge, sway, heave [m]; roll, pitch, yaw [rad].
typedef struct Freedom {
    FreedomKind kind;
    double amplitude;       ///< [m] or [rad]
    double period, phase;   ///< [s], [rad]
    double ramp;            ///< prescribed: grows as (1 - cos(pi t/ramp))/2 until this time [s]
    double stiffness, rest; ///< [N/m] or [N m/rad]; [m] or [rad]
    double damping;         ///< [N s/m] or [N m s/rad]
} Freedom;

typedef struct BodyScene {
    char name[SCENE_NAME_SIZE];
    BodyShape shape;
    Vec3 size;
    double radius, length;
    int axis;
    double draft_design;
    double breadth;
    int polygon_count;
    double polygon[SCENE_POLYGON_MAX][2]; ///< x, z [m]
    char mesh_path[SCENE_PATH_SIZE];      ///< resolved against the case's folder
    double scale;

    Vec3 position; ///< of the geometry's origin [m]; z is NAN when it follows from draft or mass
    Vec3 attitude; ///< roll, pitch, yaw [rad]
    double mass;   ///< [kg]; NAN = the mass of the water displaced at `draft`
    double draft;  ///< lowest point below still water [m]; NAN = not given
    Vec3 centre_of_gravity; ///< in geometry axes [m]; NANs = the volume's centroid
    Vec3 radii_of_gyration; ///< about the centre of gravity [m]; NANs = not given
    double inertia[6];      ///< xx yy zz xy xz yz [kg m^2] about the centre of gravity; NANs = not
                            ///< given (then radii, else a homogeneous body)
    Freedom freedoms[6];    ///< surge sway heave roll pitch yaw
    char motion_path[SCENE_PATH_SIZE]; ///< table that prescribes all six; "" = none
    double initial_offset[6];          ///< added to the reference pose at t = 0 [m], [rad]
    double initial_velocity[6];        ///< [m/s], [rad/s]
    double hold_time;                  ///< held at its initial pose for this long [s]
    double colour[3];                  ///< for pictures, 0..1
} BodyScene;

typedef enum PointKind {
    POINT_FIXED, ///< on earth or on a body
    POINT_FREE,  ///< moved by the lines it joins, its weight and the water
} PointKind;

/// A place where line ends meet: fixed, or a clump weight or buoy that moves freely.
typedef struct PointScene {
    char name[SCENE_NAME_SIZE];
    PointKind kind;
    int body;          ///< of a fixed point: index into bodies, -1 = earth
    Vec3 position;     ///< [m], world axes or the body's; of a free point: a first guess
    double mass;       ///< of a free point, without its lines [kg], >= 0
    double volume;     ///< displaced when under water [m^3], >= 0
    double drag_area;  ///< Cd A [m^2]
    double added_mass; ///< coefficient Ca: added mass over displaced mass [-]
} PointScene;

typedef enum ContactKind { CONTACTS_AUTO, CONTACTS_NONE } ContactKind;

/// What happens when bodies touch each other, the bed or walls.
typedef struct Contacts {
    ContactKind kind;
    double friction; ///< Coulomb's coefficient [-]
} Contacts;

/// An end of a line: at a point of the scene, or fixed on earth or on a body.
typedef struct LineEnd {
    int point;     ///< index into points, -1 = none: the end is held by what follows
    int body;      ///< index into bodies, -1 = earth
    Vec3 position; ///< [m], world axes (earth) or the body's geometry axes
} LineEnd;

/// Piece of a line of one type, counted from the anchor; NAN (segments: 0) = as the line says.
typedef struct LineSection {
    double length;            ///< unstretched [m]
    int segments;             ///< 0 = in proportion to its length
    double axial_stiffness;   ///< EA [N]
    double mass_per_length;   ///< in air [kg/m]
    double diameter;          ///< volume-equivalent [m]
    double drag_normal;       ///< Cdn [-]
    double drag_tangential;   ///< Cdt [-]
    double added_normal;      ///< Can [-]
    double added_tangential;  ///< Cat [-]
    double damping_ratio;     ///< internal damping, fraction of critical per segment [-]
    double bending_stiffness; ///< EI [N m^2]
    double breaking_tension;  ///< [N]
} LineSection;

/// Whose velocity the drag on a line is relative to.
typedef enum LineWater {
    LINE_WATER_INCIDENT, ///< the wave's that comes in
    LINE_WATER_SPH,      ///< the simulated water's at the nodes
} LineWater;

/// What may be done to a line's length while it runs.
typedef struct WinchScene {
    Range length; ///< unstretched, of the whole line [m]
    double speed; ///< at most [m/s]; 0 = there is no winch
} WinchScene;

typedef struct LineScene {
    char name[SCENE_NAME_SIZE];
    LineEnd anchor, fairlead;
    double length;           ///< unstretched [m]
    double pretension;       ///< at the fairlead at rest [N]; the length follows. NAN = not given
    double axial_stiffness;  ///< EA [N]
    double mass_per_length;  ///< in air [kg/m]
    double diameter;         ///< volume-equivalent [m]
    double drag_normal;      ///< Cdn [-]
    double drag_tangential;  ///< Cdt [-]
    double added_normal;     ///< Can [-]
    double added_tangential; ///< Cat [-]
    double damping_ratio;    ///< internal damping, fraction of critical per segment [-]
    int segments;
    double bed_stiffness;     ///< kb [Pa/m]: force per area and penetration
    double bed_damping;       ///< cb [Pa s/m]
    double bed_friction;      ///< Coulomb coefficient [-]
    double bending_stiffness; ///< EI [N m^2]; 0 = none
    double breaking_tension;  ///< a segment that carries more parts [N]; 0 = never
    LineWater water;
    WinchScene winch;
    int section_count;                             ///< 0 = the same from end to end
    LineSection sections[SCENE_LINE_SECTIONS_MAX]; ///< anchor first
} LineScene;

typedef struct GaugeScene {
    char name[SCENE_NAME_SIZE];
    double x, y; ///< [m]
} GaugeScene;

typedef struct PressureProbeScene {
    char name[SCENE_NAME_SIZE];
    int body;      ///< index into bodies, -1 = earth (fixed in the world)
    Vec3 position; ///< [m], world or geometry axes
    Vec3 normal;   ///< into the water, the same axes; NANs = water all round counts
    double patch;  ///< diameter of the disc that is averaged over [m]; 0 = a point
} PressureProbeScene;

/// How far water reaches along a straight line: up a wall or a hull, or along the bed.
typedef struct RunUpScene {
    char name[SCENE_NAME_SIZE];
    int body;      ///< index into bodies, -1 = earth
    Vec3 from, to; ///< [m], world or geometry axes
} RunUpScene;

/// The fast part of the water's force on a body.
typedef struct SlammingScene {
    char name[SCENE_NAME_SIZE];
    int body;
    double cutoff; ///< of the low-pass filter that is taken off [Hz]
    int order;     ///< of that filter, 1 to 4
} SlammingScene;

/// Water on a deck: a box in a body's axes, standing on the deck.
typedef struct GreenWaterScene {
    char name[SCENE_NAME_SIZE];
    int body;
    Vec3 min, max; ///< geometry axes [m]
} GreenWaterScene;

/// What is kept of the energies.
typedef enum EnergyProbe {
    ENERGY_NONE,
    ENERGY_LEVELS, ///< of water, bodies and lines, at each sample
    ENERGY_BUDGET, ///< and what each effect gives and takes, at each step
} EnergyProbe;

typedef struct Outputs {
    double series_interval; ///< time between samples [s]
    double lines_interval;  ///< between shapes of lines in files [s]; 0 = none
} Outputs;

/// First look of the camera at the scene.
typedef struct CameraScene {
    Vec3 target;      ///< [m]; NANs = the bodies' centre, or the domain's
    double distance;  ///< [m]; NAN = fits the scene
    double azimuth;   ///< [rad], where the eye stands as seen from the target, from +x to +y
    double elevation; ///< [rad] above the horizon
} CameraScene;

typedef struct Scene {
    char name[SCENE_NAME_SIZE]; ///< file name without folder and extension
    char title[160];
    char path[SCENE_PATH_SIZE]; ///< the case file
    uint64_t hash;              ///< FNV-1a 64 of the case's text after --set (canonical printing)
    Domain domain;
    double lines_step; ///< of a domain of lines [s]; NAN = by the rule (see plan.c)
    Fluid fluid;
    Waves waves;
    int body_count;
    BodyScene bodies[SCENE_BODIES_MAX];
    Contacts contacts;
    int line_count;
    LineScene lines[SCENE_LINES_MAX];
    int point_count;
    PointScene points[SCENE_POINTS_MAX];
    int gauge_count;
    GaugeScene gauges[SCENE_GAUGES_MAX];
    int quality_gauge_count; ///< 0 or 3
    int quality_gauges[3];   ///< by whose waves quality is judged
    int pressure_probe_count;
    PressureProbeScene pressure_probes[SCENE_PRESSURE_PROBES_MAX];
    int run_up_count;
    RunUpScene run_ups[SCENE_RUN_UPS_MAX];
    int slamming_count;
    SlammingScene slammings[SCENE_SLAMMINGS_MAX];
    int green_water_count;
    GreenWaterScene green_waters[SCENE_GREEN_WATERS_MAX];
    EnergyProbe energy;
    Outputs outputs;
    CameraScene camera;
    char notes[1024]; ///< what the reader of a MoorDyn file left out, lines joined by "; "
} Scene;

/// Whether a ring of moving dummies bounds the domain: a basin with waves or a current.
static inline bool scene_has_ring(const Scene *scene)
{
    const Waves *waves = &scene->waves;
    return scene->domain.kind == DOMAIN_BASIN &&
           (waves->kind != WAVES_NONE || waves->current.speed > 0);
}

/// Defaults for everything; required numbers are NAN so that scene_check refuses them.
/// (scene_default.c; each value stands beside its source)
Scene scene_default(void);
BodyScene body_scene_default(void);
LineScene line_scene_default(void);
LineSection line_section_default(void);
PointScene point_scene_default(void);

/// Fill in what the sections leave to the line and set the line's own `length` and `segments` to
/// their sums (and what the line itself leaves out to that of the section at the fairlead); does
/// nothing to a line without sections. Every line must have passed through here.
void line_scene_complete(LineScene *line);

/// Read, override and check a case.
/// @param path           the case file (JSON)
/// @param overrides      "path.to.key=value" or "bodies[0].mass_kg=3" or "bodies.ship.mass_kg=3",
/// value
///                       in JSON or a bare word [override_count], borrowed
/// @param scene          filled only on success
/// @return false with ERROR_INPUT naming the JSON path, the value and the accepted range
bool scene_load(const char *path, const char *const *overrides, int override_count, Scene *scene,
                Error *error);

#endif
