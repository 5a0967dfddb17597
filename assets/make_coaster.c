/// make_coaster OUT.stl: the mesh of the ship of the default case, a 30 m coaster at scale 1:10.
///
/// Length between perpendiculars 3.00 m, beam 0.75 m, draft 0.30 m, depth 0.50 m; flared bow, raked
/// stem, sheer, raised forecastle, transom stern, plain deck with two hatches, deckhouse,
/// wheelhouse and funnel. One closed surface, outward oriented. Axes: origin amidships on the
/// centreline at the baseline, x forward, y to port, z up. The numbers below were chosen so that at
/// 0.30 m the block coefficient is 0.62 and the centre of buoyancy lies 0.06 m aft of amidships:
/// with its centre of gravity at (-0.06, 0, 0.26) the ship floats on an even keel
/// (tests/unit/test_hull_coaster.c).
///
/// The side is a grid of stations (transom to stem) by lines (keel to deck edge); the deck is a
/// grid of the same stations by lines along the ship, whose cells may be raised: hatches and houses
/// are cells with a level of their own and walls between unequal neighbours. Coordinates are
/// rounded to 2^-16 m, so that the file is the same whatever the last bits of the mathematical
/// library.
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double HALF_PI = 1.57079632679489661923;
static const double HALF_BEAM = 0.375, DRAFT = 0.30, DEPTH = 0.50;
static const double QUANTUM = 1.0 / 65536; ///< [m]

// Stations, by their x at the design waterline [m]: named places with intervals between them.
typedef struct Stretch {
    double begin;
    int intervals;
} Stretch;
static const Stretch STRETCHES[] = {
    {-1.56, 4}, // transom
    {-1.42, 2}, // house, aft end
    {-1.34, 2}, // funnel
    {-1.22, 2}, //
    {-1.12, 4}, // wheelhouse
    {-0.88, 2}, //
    {-0.80, 4}, // house, forward end
    {-0.62, 9}, // after hatch
    {0.04, 1},  //
    {0.14, 9},  // forward hatch
    {0.80, 4},  //
    {0.99, 1},  // break of the forecastle
    {1.02, 16}, //
    {1.50, 0},  // stem
};
enum { STRETCH_COUNT = sizeof STRETCHES / sizeof *STRETCHES, STATIONS_MAX = 96 };

// Lines of the side: SIDE_LINES intervals from the keel to the sheer strake, one for the strake.
enum { SIDE_LINES = 16, SECTION_SAMPLES = 600 };
static const double STRAKE = 0.05;      ///< height of the sheer strake [m]
static const double TURN_WEIGHT = 0.30; ///< arc length that a turn of one radian counts as [m]

// Lines of the deck: half-breadths, the edge being the last [m].
static const double DECK_LINES[] = {0.06, 0.17, 0.25};
static const double DECK_LINES_ROOM = 0.285; ///< where the deck is narrower, its lines close up [m]
enum { HALF_LINES = 4, DECK_POINTS = 2 * HALF_LINES, DECK_CELLS = DECK_POINTS - 1 };

typedef enum Level { LEVEL_DECK, LEVEL_HATCH, LEVEL_HOUSE, LEVEL_WHEELHOUSE, LEVEL_FUNNEL } Level;
enum { LEVEL_COUNT = LEVEL_FUNNEL + 1 };

/// A raised part of the deck: stations from x to x, within a deck line on each side.
typedef struct Block {
    double aft, forward;
    int line;
    Level level;
} Block;
static const Block BLOCKS[] = {
    {-1.42, -0.80, 2, LEVEL_HOUSE},  {-1.12, -0.88, 1, LEVEL_WHEELHOUSE},
    {-1.34, -1.22, 0, LEVEL_FUNNEL}, {-0.62, 0.04, 2, LEVEL_HATCH},
    {0.14, 0.80, 2, LEVEL_HATCH},
};
enum { BLOCK_COUNT = sizeof BLOCKS / sizeof *BLOCKS };

typedef struct Point {
    double x, y, z;
} Point;

/// 0 at a and before, 1 at b and beyond, straight between.
static double ramp(double x, double a, double b)
{
    double t = (x - a) / (b - a);
    return t < 0 ? 0 : (t > 1 ? 1 : t);
}

static double smooth(double x, double a, double b)
{
    double t = ramp(x, a, b);
    return t * t * (3 - 2 * t);
}

// The lines of the ship, as functions of the station.

/// Half-breadth at the greatest beam of the body below the flare.
static double half_breadth(double station)
{
    double forward = ramp(station, 0.15, 1.50), aft = ramp(station, -0.60, -1.56);
    return HALF_BEAM * (1 - pow(forward, 1.85) - 0.20 * aft * aft);
}

/// Half-breadth that the flare adds at the sheer line.
static double flare(double station)
{
    double t = ramp(station, 0.15, 1.50);
    return 0.82 * HALF_BEAM * (pow(t, 1.85) - pow(t, 4.2));
}

/// Bottom: level, rising to the transom.
static double bottom(double station) { return 0.27 * pow(ramp(station, -0.413, -1.56), 1.6); }

/// Height at which a section reaches its half-breadth: the bilge runs out into the side there.
static double shoulder(double station) { return 0.36 + 0.09 * smooth(station, -0.8, -1.56); }

/// Exponent of the superellipse that a section follows from bottom to shoulder: 5 is a box with
/// rounded bilges, 2 an ellipse, towards 1 a V.
static double fullness(double station)
{
    return 4.4 - 2.8 * smooth(station, 0.0, 1.40) - 2.2 * smooth(station, -0.30, -1.40);
}

/// Deck at side without the forecastle: sheer, more forward than aft.
static double sheer(double station)
{
    double forward = ramp(station, 0.10, 1.50), aft = ramp(station, -0.30, -1.56);
    return DEPTH + 0.09 * forward * forward + 0.03 * aft * aft;
}

static double deck(double station) { return sheer(station) + 0.075 * ramp(station, 0.99, 1.02); }

/// x of the stem: forefoot, upright at the waterline, raked above.
static double stem(double z)
{
    double above = z - DRAFT, below = above < 0 ? -above : 0;
    return 1.50 + 0.30 * above + 0.35 * above * above - 6.5 * below * below * below;
}

/// x of a point at a height: towards the bow stations lean like the stem, towards the stern like
/// the transom.
static double lean(double station, double z)
{
    double bow = ramp(station, 0.90, 1.50), stern = ramp(station, -1.42, -1.56);
    return station + bow * bow * (stem(z) - 1.50) - stern * 0.22 * (z - DRAFT);
}

static double level_height(Level level, double station)
{
    switch (level) {
    case LEVEL_HATCH:
        return 0.575;
    case LEVEL_HOUSE:
        return 0.71;
    case LEVEL_WHEELHOUSE:
        return 0.89;
    case LEVEL_FUNNEL:
        return 0.87;
    case LEVEL_DECK:
        break;
    }
    return deck(station);
}

// The mesh.

enum { VERTICES_MAX = 8192, TRIANGLES_MAX = 16384 };
typedef struct Mesh {
    Point vertices[VERTICES_MAX];
    int vertex_count;
    int triangles[TRIANGLES_MAX][3];
    int triangle_count;
} Mesh;

static void give_up(const char *what)
{
    fprintf(stderr, "make_coaster: %s\n", what);
    exit(1);
}

static double rounded(double value) { return floor(value / QUANTUM + 0.5) * QUANTUM; }

/// Vertex at a point; the one that is there already, if any.
static int vertex(Mesh *mesh, Point p)
{
    Point q = {rounded(p.x), rounded(p.y), rounded(p.z)};
    for (int i = mesh->vertex_count - 1; i >= 0; i--)
        if (mesh->vertices[i].x == q.x && mesh->vertices[i].y == q.y && mesh->vertices[i].z == q.z)
            return i;
    if (mesh->vertex_count == VERTICES_MAX) give_up("too many vertices");
    mesh->vertices[mesh->vertex_count] = q;
    return mesh->vertex_count++;
}

static void triangle(Mesh *mesh, int a, int b, int c)
{
    if (a == b || b == c || c == a) return;
    if (mesh->triangle_count == TRIANGLES_MAX) give_up("too many triangles");
    int *corners = mesh->triangles[mesh->triangle_count++];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
}

static double distance(const Mesh *mesh, int a, int b)
{
    Point p = mesh->vertices[a], q = mesh->vertices[b];
    return sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
}

/// Quadrilateral a b c d, counter-clockwise from outside, cut along its shorter diagonal.
static void quadrilateral(Mesh *mesh, int a, int b, int c, int d)
{
    if (a == b || c == d || distance(mesh, a, c) <= distance(mesh, b, d)) {
        triangle(mesh, a, b, c);
        triangle(mesh, a, c, d);
    } else {
        triangle(mesh, a, b, d);
        triangle(mesh, b, c, d);
    }
}

/// Band between two chains that run the same way; seen from outside the first lies to the right.
static void band(Mesh *mesh, const int *right, int right_count, const int *left, int left_count)
{
    int i = 0, j = 0;
    while (i + 1 < right_count || j + 1 < left_count) {
        if (j + 1 == left_count ||
            (i + 1 < right_count &&
             distance(mesh, right[i + 1], left[j]) <= distance(mesh, right[i], left[j + 1]))) {
            triangle(mesh, right[i], right[i + 1], left[j]);
            i++;
        } else {
            triangle(mesh, right[i], left[j + 1], left[j]);
            j++;
        }
    }
}

// The side.

typedef struct Stations {
    double x[STATIONS_MAX]; ///< at the design waterline
    int count;
} Stations;

static Stations make_stations(void)
{
    Stations stations = {.count = 0};
    for (int k = 0; k < STRETCH_COUNT; k++) {
        double begin = STRETCHES[k].begin;
        double end = k + 1 < STRETCH_COUNT ? STRETCHES[k + 1].begin : begin;
        int intervals = STRETCHES[k].intervals ? STRETCHES[k].intervals : 1;
        if (stations.count + intervals > STATIONS_MAX) give_up("too many stations");
        for (int i = 0; i < intervals; i++)
            stations.x[stations.count++] = begin + (end - begin) * i / intervals;
    }
    return stations;
}

/// Half-breadth with flare at a height.
static double flared(double station, double breadth, double z)
{
    double height = (z - 0.20) / (sheer(station) - 0.20);
    return breadth + (height > 0 ? flare(station) * height * height : 0);
}

/// Fine polygon of a section from the keel to the strake: (x, y, z) without lean.
static void sample_section(double station, Point *samples)
{
    double low = bottom(station), side = shoulder(station), top = sheer(station) - STRAKE;
    double breadth = half_breadth(station), power = 2 / fullness(station);
    int curved = SECTION_SAMPLES * 3 / 4;
    for (int k = 0; k <= SECTION_SAMPLES; k++) {
        double y = breadth, z = 0;
        if (k <= curved) {
            double angle = HALF_PI * k / curved;
            y = k < curved ? breadth * pow(sin(angle), power) : breadth;
            z = k < curved ? side - (side - low) * pow(cos(angle), power) : side;
        } else {
            z = side + (top - side) * (k - curved) / (SECTION_SAMPLES - curved);
        }
        samples[k] = (Point){station, flared(station, y, z), z};
    }
}

/// Points of a section, keel first, deck edge last, closer together where it turns.
static void make_section(double station, Point *points)
{
    static Point samples[SECTION_SAMPLES + 1];
    static double measure[SECTION_SAMPLES + 1];
    sample_section(station, samples);
    double weight = TURN_WEIGHT * half_breadth(station) / HALF_BEAM, last = 0;
    measure[0] = 0;
    for (int k = 1; k <= SECTION_SAMPLES; k++) {
        double dy = samples[k].y - samples[k - 1].y, dz = samples[k].z - samples[k - 1].z;
        double direction = atan2(dz, dy), turn = k > 1 ? fabs(direction - last) : 0;
        measure[k] = measure[k - 1] + sqrt(dy * dy + dz * dz) + weight * turn;
        last = direction;
    }
    int k = 1;
    for (int j = 0; j <= SIDE_LINES; j++) {
        double target = measure[SECTION_SAMPLES] * j / SIDE_LINES;
        while (k < SECTION_SAMPLES && measure[k] < target)
            k++;
        double t = (target - measure[k - 1]) / (measure[k] - measure[k - 1]);
        t = t < 0 ? 0 : (t > 1 ? 1 : t);
        points[j].y = samples[k - 1].y + t * (samples[k].y - samples[k - 1].y);
        points[j].z = samples[k - 1].z + t * (samples[k].z - samples[k - 1].z);
    }
    points[0].y = 0;
    points[SIDE_LINES + 1].z = deck(station);
    points[SIDE_LINES + 1].y = flared(station, half_breadth(station), deck(station));
    for (int j = 0; j <= SIDE_LINES + 1; j++)
        points[j].x = lean(station, points[j].z);
}

enum { PORT, STARBOARD, SIDES };
typedef struct Grid {
    int side[STATIONS_MAX][SIDE_LINES + 2][SIDES]; ///< vertices
} Grid;

static void make_sides(Mesh *mesh, const Stations *stations, Grid *grid)
{
    for (int i = 0; i < stations->count; i++) {
        Point points[SIDE_LINES + 2];
        make_section(stations->x[i], points);
        for (int j = 0; j < SIDE_LINES + 2; j++) {
            Point p = points[j];
            if (i == stations->count - 1) p.y = 0; // the stem
            grid->side[i][j][PORT] = vertex(mesh, p);
            grid->side[i][j][STARBOARD] = vertex(mesh, (Point){p.x, -p.y, p.z});
        }
    }
    for (int i = 0; i + 1 < stations->count; i++)
        for (int j = 0; j < SIDE_LINES + 1; j++) {
            int(*aft)[SIDES] = grid->side[i], (*ahead)[SIDES] = grid->side[i + 1];
            quadrilateral(mesh, ahead[j][PORT], aft[j][PORT], aft[j + 1][PORT], ahead[j + 1][PORT]);
            quadrilateral(mesh, aft[j][STARBOARD], ahead[j][STARBOARD], ahead[j + 1][STARBOARD],
                          aft[j + 1][STARBOARD]);
        }
}

// The deck.

static double deck_y(int point, double edge)
{
    int line = point < HALF_LINES ? HALF_LINES - 1 - point : point - HALF_LINES;
    double room = edge < DECK_LINES_ROOM ? edge / DECK_LINES_ROOM : 1;
    double y = line == HALF_LINES - 1 ? edge : DECK_LINES[line] * room;
    return point < HALF_LINES ? -y : y;
}

/// Level of the cell between stations i, i + 1 and deck points j, j + 1.
static Level cell_level(const Stations *stations, int i, int j)
{
    Level level = LEVEL_DECK;
    if (i < 0 || j < 0 || i + 1 >= stations->count || j >= DECK_CELLS) return level;
    double middle = 0.5 * (stations->x[i] + stations->x[i + 1]);
    for (int k = 0; k < BLOCK_COUNT; k++) {
        const Block *b = &BLOCKS[k];
        bool within = middle > b->aft && middle < b->forward;
        if (within && j >= HALF_LINES - 1 - b->line && j < HALF_LINES + b->line) level = b->level;
    }
    return level;
}

/// Vertex above deck point (i, j) at a level. Deck edges are the sides' own vertices.
static int deck_vertex(Mesh *mesh, const Stations *stations, const Grid *grid, int i, int j,
                       Level level)
{
    if (j == 0) return grid->side[i][SIDE_LINES + 1][STARBOARD];
    if (j == DECK_CELLS) return grid->side[i][SIDE_LINES + 1][PORT];
    double station = stations->x[i], low = deck(station);
    double edge = i == stations->count - 1 ? 0 : flared(station, half_breadth(station), low);
    return vertex(mesh, (Point){lean(station, low), deck_y(j, edge), level_height(level, station)});
}

/// Vertices of deck point (i, j) between two levels, lower first: every level around the point that
/// lies between them, so that neighbouring walls meet at the same vertices.
static int make_chain(Mesh *mesh, const Stations *stations, const Grid *grid, int i, int j,
                      Level lower, Level upper, int *chain)
{
    double station = stations->x[i];
    double low = level_height(lower, station), high = level_height(upper, station);
    int count = 0;
    for (int turn = 0; turn < LEVEL_COUNT;
         turn++) { // next higher level present, until none is left
        Level next = upper;
        double best = high, above = count ? low : -1;
        for (int k = 0; k < 4; k++) {
            Level level = cell_level(stations, i - (k & 1), j - (k >> 1));
            double height = level_height(level, station);
            if (height > above && height >= level_height(lower, station) && height < best) {
                best = height;
                next = level;
            }
        }
        chain[count++] = deck_vertex(mesh, stations, grid, i, j, next);
        low = best;
        if (next == upper) break;
    }
    return count;
}

/// Wall over the deck line from point (i, j) to (k, l), whose higher cell lies to its left.
static void make_wall(Mesh *mesh, const Stations *stations, const Grid *grid, int i, int j, int k,
                      int l, Level lower, Level upper)
{
    int from[LEVEL_COUNT + 1], to[LEVEL_COUNT + 1];
    int from_count = make_chain(mesh, stations, grid, i, j, lower, upper, from);
    int to_count = make_chain(mesh, stations, grid, k, l, lower, upper, to);
    band(mesh, to, to_count, from, from_count);
}

static void make_deck(Mesh *mesh, const Stations *stations, const Grid *grid)
{
    for (int i = 0; i + 1 < stations->count; i++)
        for (int j = 0; j < DECK_CELLS; j++) {
            Level here = cell_level(stations, i, j), ahead = cell_level(stations, i + 1, j),
                  port = cell_level(stations, i, j + 1);
            quadrilateral(mesh, deck_vertex(mesh, stations, grid, i, j, here),
                          deck_vertex(mesh, stations, grid, i + 1, j, here),
                          deck_vertex(mesh, stations, grid, i + 1, j + 1, here),
                          deck_vertex(mesh, stations, grid, i, j + 1, here));
            double x = stations->x[i + 1];
            if (ahead != here) {
                if (level_height(ahead, x) > level_height(here, x))
                    make_wall(mesh, stations, grid, i + 1, j + 1, i + 1, j, here, ahead);
                else
                    make_wall(mesh, stations, grid, i + 1, j, i + 1, j + 1, ahead, here);
            }
            if (port != here) {
                if (level_height(port, x) > level_height(here, x))
                    make_wall(mesh, stations, grid, i, j + 1, i + 1, j + 1, here, port);
                else
                    make_wall(mesh, stations, grid, i + 1, j + 1, i, j + 1, port, here);
            }
        }
}

/// A ladder between the sides at the first station; its top rung is the deck's aft edge.
static void make_transom(Mesh *mesh, const Stations *stations, const Grid *grid)
{
    const int(*line)[SIDES] = grid->side[0];
    for (int j = 0; j < SIDE_LINES; j++)
        quadrilateral(mesh, line[j][PORT], line[j][STARBOARD], line[j + 1][STARBOARD],
                      line[j + 1][PORT]);
    int edge[DECK_POINTS];
    for (int j = 0; j < DECK_POINTS; j++)
        edge[j] = deck_vertex(mesh, stations, grid, 0, j, LEVEL_DECK);
    int rung[2] = {line[SIDE_LINES][STARBOARD], line[SIDE_LINES][PORT]};
    band(mesh, edge, DECK_POINTS, rung, 2);
}

// The file.

static void put_float(unsigned char *bytes, double value)
{
    float single = (float)value;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    for (int k = 0; k < 4; k++)
        bytes[k] = (unsigned char)(bits >> 8 * k);
}

static void put_point(unsigned char *bytes, Point p)
{
    put_float(bytes, p.x);
    put_float(bytes + 4, p.y);
    put_float(bytes + 8, p.z);
}

static void write_stl(const Mesh *mesh, const char *path)
{
    FILE *file = fopen(path, "wb");
    if (!file) give_up("the file cannot be written");
    unsigned char header[84] = "Fairlead coaster, scale 1:10, metres, z up, x forward";
    for (int k = 0; k < 4; k++)
        header[80 + k] = (unsigned char)((uint32_t)mesh->triangle_count >> 8 * k);
    fwrite(header, sizeof header, 1, file);
    for (int i = 0; i < mesh->triangle_count; i++) {
        const int *t = mesh->triangles[i];
        Point a = mesh->vertices[t[0]], b = mesh->vertices[t[1]], c = mesh->vertices[t[2]];
        Point u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
        Point n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        unsigned char record[50] = {0};
        put_point(record, (Point){n.x / length, n.y / length, n.z / length});
        put_point(record + 12, a);
        put_point(record + 24, b);
        put_point(record + 36, c);
        fwrite(record, sizeof record, 1, file);
    }
    if (fclose(file) != 0) give_up("the file cannot be written");
}

int main(int count, char **arguments)
{
    static Mesh mesh;
    static Grid grid;
    if (count != 2) give_up("usage: make_coaster OUT.stl");
    Stations stations = make_stations();
    make_sides(&mesh, &stations, &grid);
    make_deck(&mesh, &stations, &grid);
    make_transom(&mesh, &stations, &grid);
    write_stl(&mesh, arguments[1]);
    printf("%s: %d vertices, %d triangles\n", arguments[1], mesh.vertex_count, mesh.triangle_count);
    return 0;
}
