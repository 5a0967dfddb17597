/// A made-up snapshot for the tests of the renderer: particles under a regular wave, a ship-like
/// hull, one hanging line. No simulation.
#ifndef FAIRLEAD_RENDER_FIXTURE_H
#define FAIRLEAD_RENDER_FIXTURE_H

#include <stdlib.h>

#include "render.h"

enum { STATIONS = 41, LEVELS = 9, RING = 2 * LEVELS, FIXTURE_NODES = 41 };

typedef struct Fixture {
    Snapshot snapshot;
    TriangleMesh hull;
    float nodes[FIXTURE_NODES][3], tension[FIXTURE_NODES];
    double wave_height, wave_length; ///< [m]
    double jitter;                   ///< of particles [dp]
    uint32_t seed;
} Fixture;

static inline double fixture_elevation(const Fixture *fixture, double x, double y, double time)
{
    double heading = 0.35, k = 2.0 * PI / fixture->wave_length, omega = sqrt(9.81 * k);
    double theta = k * (x * cos(heading) + y * sin(heading)) - omega * time;
    double a = 0.5 * fixture->wave_height;
    return a * cos(theta) + 0.5 * k * a * a * cos(2 * theta);
}

static inline double fixture_random(Fixture *fixture)
{
    fixture->seed = fixture->seed * 1664525u + 1013904223u;
    return (fixture->seed >> 8) / 16777216.0 - 0.5;
}

/// Half breadth of the hull at x from midship and z above the keel [m]; 0 outside.
static inline double hull_half_breadth(double x, double z)
{
    if (z < 0 || z > 0.5 || x < -1.5 || x > 1.5) return 0;
    double s = z / 0.5, forward = maxd(0, (x - 0.3) / 1.2), aft = maxd(0, (-0.6 - x) / 0.9);
    double plan = (1 - pow(forward, 2.4 - 0.5 * s)) * (1 - (0.75 - 0.45 * s) * aft * aft);
    double section = pow(mind(1, s * 2.4), 0.30) * (0.93 + 0.07 * s);
    return maxd(0.375 * plan * section, 0);
}

/// A closed hull: rings of stations joined, bow and transom capped.
static inline void fixture_hull(Fixture *fixture)
{
    TriangleMesh *hull = &fixture->hull;
    hull->vertices = calloc(STATIONS * RING + 2, sizeof *hull->vertices);
    hull->triangles = calloc((STATIONS + 1) * RING * 2, sizeof *hull->triangles);
    int vertices = 0, triangles = 0;
    for (int s = 0; s < STATIONS; s++)
        for (int r = 0; r < RING; r++) {
            int level = r < LEVELS ? LEVELS - 1 - r : r - LEVELS;
            double x = -1.5 + 3.0 * s / (STATIONS - 1), up = (double)level / (LEVELS - 1);
            double z = 0.5 * up * up, b = maxd(hull_half_breadth(x, mind(z + 1e-3, 0.5)), 0.002);
            double sheer = level == LEVELS - 1 ? 0.10 * pow(maxd(x, 0) / 1.5, 2) : 0;
            hull->vertices[vertices++] = vec3(x, r < LEVELS ? b : -b, z + sheer);
        }
    for (int s = 0; s + 1 < STATIONS; s++)
        for (int r = 0; r < RING; r++) {
            int a = s * RING + r, b = s * RING + (r + 1) % RING, c = a + RING, d = b + RING;
            const int pair[2][3] = {{a, b, d}, {a, d, c}};
            for (int t = 0; t < 2; t++, triangles++)
                for (int k = 0; k < 3; k++)
                    hull->triangles[triangles][k] = pair[t][k];
        }
    for (int end = 0; end < 2; end++) {
        int base = end ? (STATIONS - 1) * RING : 0;
        for (int r = 1; r + 1 < RING; r++, triangles++) {
            hull->triangles[triangles][0] = base;
            hull->triangles[triangles][1] = base + (end ? r : r + 1);
            hull->triangles[triangles][2] = base + (end ? r + 1 : r);
        }
    }
    hull->vertex_count = vertices;
    hull->triangle_count = triangles;
}

static inline void fixture_ship(Fixture *fixture)
{
    fixture_hull(fixture);
    Snapshot *snapshot = &fixture->snapshot;
    double bow = fixture_elevation(fixture, 1.2, 0, snapshot->time);
    double stern = fixture_elevation(fixture, -1.2, 0, snapshot->time);
    snapshot->body_count = 1;
    snapshot->bodies[0] = (BodySnapshot){
        .origin = vec3(0, 0, -0.3 + 0.5 * (bow + stern)),
        .attitude = quat_from_euler(0.03, -0.55 * atan2(bow - stern, 2.4), 0.0),
        .mesh = &fixture->hull,
        .colour = {0.16, 0.28, 0.42},
    };
}

static inline void fixture_line(Fixture *fixture)
{
    Snapshot *snapshot = &fixture->snapshot;
    double bed = snapshot->domain.min.z;
    for (int n = 0; n < FIXTURE_NODES; n++) {
        double s = (double)n / (FIXTURE_NODES - 1);
        double rise = s < 0.3 ? 0 : pow((s - 0.3) / 0.7, 2.0);
        fixture->nodes[n][0] = (float)(3.4 - 1.95 * s);
        fixture->nodes[n][1] = 0.0f;
        fixture->nodes[n][2] = (float)(bed + 0.01 + (0.05 - bed) * rise);
        fixture->tension[n] = (float)(6.0 + 22.0 * rise);
    }
    snapshot->line_count = 1;
    snapshot->lines[0] = (LineSnapshot){.node_count = FIXTURE_NODES,
                                        .position = fixture->nodes,
                                        .tension = fixture->tension,
                                        .diameter = 0.0115,
                                        .name = "bow_line",
                                        .snap_time = -INFINITY,
                                        .ashore = {true, false},
                                        .lift_off = -1};
}

/// Is a point inside the ship, with a spacing's half of clearance?
static inline bool fixture_inside(const Fixture *fixture, Vec3 point, double clearance)
{
    if (!fixture->snapshot.body_count) return false;
    const BodySnapshot *body = &fixture->snapshot.bodies[0];
    Vec3 p = quat_rotate(quat_conjugate(body->attitude), vec3_sub(point, body->origin));
    double z = mind(maxd(p.z, 0.001), 0.499);
    return p.z > -clearance && p.z < 0.5 && fabs(p.x) < 1.5 + clearance &&
           fabs(p.y) < hull_half_breadth(mind(maxd(p.x, -1.5), 1.5), z) + clearance;
}

/// Fill the water; call after the ship is in place.
static inline void fixture_water(Fixture *fixture)
{
    Snapshot *snapshot = &fixture->snapshot;
    const Domain *domain = &snapshot->domain;
    const double dp = snapshot->spacing;
    bool plane = domain->dimensions == 2;
    int nx = (int)round((domain->max.x - domain->min.x) / dp);
    int ny = plane ? 1 : (int)round((domain->max.y - domain->min.y) / dp);
    int nz = (int)ceil((domain->max.z - domain->min.z) / dp);
    size_t room = (size_t)nx * ny * nz;
    snapshot->position = calloc(room, sizeof *snapshot->position);
    snapshot->velocity = calloc(room, sizeof *snapshot->velocity);
    snapshot->pressure = calloc(room, sizeof *snapshot->pressure);
    int count = 0;
    double k = 2 * PI / fixture->wave_length, omega = sqrt(9.81 * k);
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++)
            for (int l = 0; l < nz; l++) {
                double x = domain->min.x + (i + 0.5) * dp;
                double y = plane ? 0 : domain->min.y + (j + 0.5) * dp;
                double eta = fixture_elevation(fixture, x, y, snapshot->time);
                double z = snapshot->level + eta - (l + 0.5) * dp;
                if (z < domain->min.z) break;
                if (fixture_inside(fixture, vec3(x, y, z), 0.5 * dp)) continue;
                snapshot->position[count][0] =
                    (float)(x + fixture->jitter * dp * fixture_random(fixture));
                snapshot->position[count][1] =
                    plane ? 0.0f : (float)(y + fixture->jitter * dp * fixture_random(fixture));
                snapshot->position[count][2] =
                    (float)(z + fixture->jitter * dp * fixture_random(fixture));
                double fall = exp(k * z) * omega;
                snapshot->velocity[count][0] = (float)(eta * fall);
                snapshot->velocity[count][2] =
                    (float)(fixture_elevation(fixture, x, y, snapshot->time + 0.25) * fall);
                snapshot->pressure[count] = (float)(1000 * 9.81 * (snapshot->level + eta - z));
                count++;
            }
    snapshot->fluid_count = count;
}

/// A basin 7 m x 4 m x 1.2 m of spacing `dp` at still level; nothing in it yet.
static inline Fixture fixture_basin(double dp, double wave_height)
{
    Fixture fixture = {.wave_height = wave_height, .wave_length = 2.4, .jitter = 0.3, .seed = 7};
    fixture.snapshot.domain = (Domain){
        .kind = DOMAIN_BASIN, .dimensions = 3, .min = {-3.6, -2.0, -1.2}, .max = {3.6, 2.0, 0.4}};
    fixture.snapshot.spacing = dp;
    fixture.snapshot.time = 1.35;
    fixture.snapshot.has_waves = wave_height > 0;
    fixture.snapshot.wave_now = (WaveTarget){wave_height, 1.24, 0.35};
    fixture.snapshot.wave_asked = fixture.snapshot.wave_now;
    fixture.snapshot.zone_width = 0.8;
    return fixture;
}

static inline ViewOptions fixture_view(void)
{
    ViewOptions view = view_options_default();
    view.camera = (Camera){.target = {0.1, 0, -0.35},
                           .distance = 9.6,
                           .azimuth = -1.05,
                           .elevation = 0.36,
                           .field_of_view = 0.61};
    return view;
}

static inline void fixture_free(Fixture *fixture)
{
    free(fixture->snapshot.position);
    free(fixture->snapshot.velocity);
    free(fixture->snapshot.pressure);
    free(fixture->hull.vertices);
    free(fixture->hull.triangles);
}

#endif
