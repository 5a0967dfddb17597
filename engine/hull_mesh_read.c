/// Mesh files: STL (binary and ASCII) and OBJ. Files come from anywhere, so nothing in them is
/// believed before it is checked: counts against the size, indices against the vertices, numbers
/// against infinity.
#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "hull_internal.h"

enum {
    STL_HEADER = 84, ///< 80 bytes of text and the number of triangles
    STL_RECORD = 50, ///< normal, three corners, two unused bytes
    TRIANGLES_MAX = 20 * 1000 * 1000,
    FACE_CORNERS_MAX = 64,
};
static const double FILE_SIZE_MAX = 2e9;  ///< [byte]
static const double COORDINATE_MAX = 1e6; ///< [m]; a hull larger than this is a mistake in `scale`

/// Points and triangles as the file gives them.
typedef struct Soup {
    const char *path;
    double scale;
    Error *error;
    Vec3 *points;
    int point_count, point_capacity;
    int (*triangles)[3];
    int triangle_count, triangle_capacity;
} Soup;

static bool grow(void **array, int *capacity, size_t item, Error *error)
{
    int larger = *capacity ? *capacity * 2 : 4096;
    void *grown = realloc(*array, (size_t)larger * item);
    if (!grown)
        return error_set(error, ERROR_SYSTEM, "memory: a mesh of %d items does not fit", larger);
    *array = grown;
    *capacity = larger;
    return true;
}

/// @param place  "triangle 12" or "line 12", for the message
static bool soup_add_point(Soup *soup, Vec3 point, const char *place_kind, long place)
{
    Vec3 p = vec3_scale(point, soup->scale);
    double largest = maxd(fabs(p.x), maxd(fabs(p.y), fabs(p.z)));
    if (!isfinite(p.x + p.y + p.z) || largest > COORDINATE_MAX)
        return error_set(soup->error, ERROR_INPUT,
                         "\"%s\": %s %ld: vertex (%g, %g, %g) times scale %g; finite coordinates "
                         "within %g m are needed",
                         soup->path, place_kind, place, point.x, point.y, point.z, soup->scale,
                         COORDINATE_MAX);
    if (soup->point_count == soup->point_capacity)
        TRY(grow((void **)&soup->points, &soup->point_capacity, sizeof *soup->points, soup->error));
    soup->points[soup->point_count++] = p;
    return true;
}

static bool soup_add_triangle(Soup *soup, int a, int b, int c)
{
    if (soup->triangle_count == TRIANGLES_MAX)
        return error_set(soup->error, ERROR_INPUT, "\"%s\": more than %d triangles", soup->path,
                         TRIANGLES_MAX);
    if (soup->triangle_count == soup->triangle_capacity)
        TRY(grow((void **)&soup->triangles, &soup->triangle_capacity, sizeof *soup->triangles,
                 soup->error));
    int *triangle = soup->triangles[soup->triangle_count++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
    return true;
}

static float read_float(const unsigned char *bytes)
{
    uint32_t bits = (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                    (uint32_t)bytes[3] << 24;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t stl_binary_count(const unsigned char *bytes)
{
    return (uint32_t)bytes[80] | (uint32_t)bytes[81] << 8 | (uint32_t)bytes[82] << 16 |
           (uint32_t)bytes[83] << 24;
}

static bool parse_stl_binary(Soup *soup, const unsigned char *bytes, size_t size)
{
    uint32_t count = stl_binary_count(bytes);
    uint64_t needed = STL_HEADER + (uint64_t)count * STL_RECORD;
    if (needed > size)
        return error_set(soup->error, ERROR_INPUT,
                         "\"%s\": truncated or not an STL file: its header announces %u triangles "
                         "(%llu bytes), the file has %zu bytes",
                         soup->path, count, (unsigned long long)needed, size);
    for (uint32_t i = 0; i < count; i++) {
        const unsigned char *corner = bytes + STL_HEADER + (size_t)i * STL_RECORD + 12;
        int first = soup->point_count;
        for (int k = 0; k < 3; k++, corner += 12)
            TRY(soup_add_point(
                soup, vec3(read_float(corner), read_float(corner + 4), read_float(corner + 8)),
                "triangle", (long)i + 1));
        TRY(soup_add_triangle(soup, first, first + 1, first + 2));
    }
    return true;
}

/// Next line of a text, cut at its end; NULL at the end of the text.
static char *next_line(char **cursor)
{
    char *line = *cursor;
    if (!*line) return NULL;
    char *end = line + strcspn(line, "\n");
    *cursor = *end ? end + 1 : end;
    *end = 0;
    return line;
}

/// Does the line start with this word? Then `rest` points behind it.
static bool starts_with_word(const char *line, const char *word, char **rest)
{
    while (isspace((unsigned char)*line))
        line++;
    size_t length = strlen(word);
    if (strncasecmp(line, word, length) != 0) return false;
    if (line[length] && !isspace((unsigned char)line[length])) return false;
    *rest = (char *)line + length;
    return true;
}

static bool is_blank(const char *line)
{
    while (isspace((unsigned char)*line))
        line++;
    return !*line;
}

static bool parse_vertex(Soup *soup, char *text, long line)
{
    double value[3];
    for (int k = 0; k < 3; k++) {
        char *end;
        value[k] = strtod(text, &end);
        if (end == text)
            return error_set(soup->error, ERROR_INPUT,
                             "\"%s\": line %ld: three numbers are needed for a vertex, found %d",
                             soup->path, line, k);
        text = end;
    }
    return soup_add_point(soup, vec3(value[0], value[1], value[2]), "line", line);
}

static bool not_understood(Soup *soup, const char *line, long number, const char *format)
{
    char shown[41];
    int n = 0;
    for (; n < 40 && line[n]; n++)
        shown[n] = isprint((unsigned char)line[n]) ? line[n] : '?';
    shown[n] = 0;
    return error_set(soup->error, ERROR_INPUT, "\"%s\": line %ld: \"%s\" is not a statement of %s",
                     soup->path, number, shown, format);
}

static bool parse_stl_ascii(Soup *soup, char *text)
{
    static const char *const ignored[] = {"solid", "endsolid", "facet", "endfacet", "outer"};
    long number = 0;
    int corners = 0;
    char *line, *rest;
    while ((line = next_line(&text))) {
        number++;
        if (is_blank(line)) continue;
        if (starts_with_word(line, "vertex", &rest)) {
            TRY(parse_vertex(soup, rest, number));
            corners++;
        } else if (starts_with_word(line, "endloop", &rest)) {
            if (corners != 3)
                return error_set(soup->error, ERROR_INPUT,
                                 "\"%s\": line %ld: facet of %d vertices; 3 are needed", soup->path,
                                 number, corners);
            int last = soup->point_count;
            TRY(soup_add_triangle(soup, last - 3, last - 2, last - 1));
            corners = 0;
        } else {
            bool known = false;
            for (size_t k = 0; k < sizeof ignored / sizeof *ignored; k++)
                known = known || starts_with_word(line, ignored[k], &rest);
            if (!known) return not_understood(soup, line, number, "ASCII STL");
        }
    }
    if (corners)
        return error_set(soup->error, ERROR_INPUT, "\"%s\": truncated: it ends inside a facet",
                         soup->path);
    return true;
}

/// A face of 3 or more corners "v", "v/t", "v/t/n" or "v//n", cut into a fan. Indices count from 1,
/// negative ones from the last vertex.
static bool parse_obj_face(Soup *soup, char *text, long line)
{
    int corners[FACE_CORNERS_MAX], count = 0;
    while (!is_blank(text)) {
        char *end;
        long index = strtol(text, &end, 10);
        if (end == text || (*end && *end != '/' && !isspace((unsigned char)*end)))
            return error_set(soup->error, ERROR_INPUT,
                             "\"%s\": line %ld: a face needs vertex indices", soup->path, line);
        long vertex = index < 0 ? soup->point_count + index : index - 1;
        if (vertex < 0 || vertex >= soup->point_count)
            return error_set(soup->error, ERROR_INPUT,
                             "\"%s\": line %ld: vertex %ld of %d does not exist (yet)", soup->path,
                             line, index, soup->point_count);
        if (count == FACE_CORNERS_MAX)
            return error_set(soup->error, ERROR_INPUT,
                             "\"%s\": line %ld: a face of more than %d corners; cut it up",
                             soup->path, line, FACE_CORNERS_MAX);
        corners[count++] = (int)vertex;
        text = end + strcspn(end, " \t\r");
    }
    if (count < 3)
        return error_set(soup->error, ERROR_INPUT,
                         "\"%s\": line %ld: face of %d corners; at least 3 are needed", soup->path,
                         line, count);
    for (int k = 2; k < count; k++)
        TRY(soup_add_triangle(soup, corners[0], corners[k - 1], corners[k]));
    return true;
}

static bool parse_obj(Soup *soup, char *text)
{
    static const char *const ignored[] = {"vn", "vt",     "vp",     "g", "o", "s",
                                          "l",  "usemtl", "mtllib", "p", "mg"};
    long number = 0;
    char *line, *rest;
    while ((line = next_line(&text))) {
        number++;
        size_t start = strspn(line, " \t");
        if (is_blank(line) || line[start] == '#') continue;
        if (starts_with_word(line, "v", &rest)) {
            TRY(parse_vertex(soup, rest, number));
        } else if (starts_with_word(line, "f", &rest)) {
            TRY(parse_obj_face(soup, rest, number));
        } else {
            bool known = false;
            for (size_t k = 0; k < sizeof ignored / sizeof *ignored; k++)
                known = known || starts_with_word(line, ignored[k], &rest);
            if (!known) return not_understood(soup, line, number, "OBJ");
        }
    }
    return true;
}

/// The whole file and a terminating zero, to be freed by the caller.
static char *read_file(const char *path, size_t *size, Error *error)
{
    struct stat status;
    FILE *file = fopen(path, "rb");
    char *bytes = NULL;
    if (!file || fstat(fileno(file), &status) != 0) {
        error_set(error, ERROR_INPUT, "\"%s\": no such file, or not readable", path);
    } else if (!S_ISREG(status.st_mode)) {
        error_set(error, ERROR_INPUT, "\"%s\": not a file", path);
    } else if ((double)status.st_size > FILE_SIZE_MAX) {
        error_set(error, ERROR_INPUT, "\"%s\": %.3g bytes; at most %.3g are read", path,
                  (double)status.st_size, FILE_SIZE_MAX);
    } else if (!(bytes = malloc((size_t)status.st_size + 1))) {
        error_set(error, ERROR_SYSTEM, "memory: \"%s\" does not fit", path);
    } else {
        *size = fread(bytes, 1, (size_t)status.st_size, file);
        bytes[*size] = 0;
        if (*size != (size_t)status.st_size) {
            error_set(error, ERROR_SYSTEM, "\"%s\": reading stopped after %zu bytes", path, *size);
            free(bytes);
            bytes = NULL;
        }
    }
    if (file) fclose(file);
    return bytes;
}

static bool ends_with(const char *path, const char *ending)
{
    size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

/// Some exporters write "solid" into the header of binary files too, so the size decides first.
static bool parse_stl(Soup *soup, char *bytes, size_t size)
{
    const unsigned char *data = (const unsigned char *)bytes;
    if (size >= STL_HEADER && STL_HEADER + (uint64_t)stl_binary_count(data) * STL_RECORD == size)
        return parse_stl_binary(soup, data, size);
    char *rest;
    if (starts_with_word(bytes, "solid", &rest) && strlen(bytes) == size)
        return parse_stl_ascii(soup, bytes);
    if (size < STL_HEADER)
        return error_set(soup->error, ERROR_INPUT,
                         "\"%s\": %zu bytes are neither ASCII STL (starting with \"solid\") nor "
                         "binary STL (at least %d bytes)",
                         soup->path, size, STL_HEADER);
    return parse_stl_binary(soup, data, size);
}

static bool parse(Soup *soup, char *bytes, size_t size, Arena *arena, TriangleMesh *mesh)
{
    if (ends_with(soup->path, ".obj")) {
        if (strlen(bytes) != size)
            return error_set(soup->error, ERROR_INPUT, "\"%s\": not a text file", soup->path);
        TRY(parse_obj(soup, bytes));
    } else {
        TRY(parse_stl(soup, bytes, size));
    }
    if (!soup->triangle_count)
        return error_set(soup->error, ERROR_INPUT, "\"%s\": no triangles in it", soup->path);
    return mesh_weld(soup->points, soup->point_count, (const int(*)[3])soup->triangles,
                     soup->triangle_count, arena, mesh, soup->error);
}

bool mesh_load(const char *path, double scale, Arena *arena, TriangleMesh *mesh, Error *error)
{
    if (!ends_with(path, ".stl") && !ends_with(path, ".obj"))
        return error_set(error, ERROR_INPUT, "\"%s\": a file ending in .stl or .obj is needed",
                         path);
    if (!(scale > 0) || !isfinite(scale))
        return error_set(error, ERROR_INPUT, "\"%s\": scale %g; a number > 0 is needed", path,
                         scale);
    size_t size = 0;
    char *bytes = read_file(path, &size, error);
    if (!bytes) return false;
    Soup soup = {.path = path, .scale = scale, .error = error};
    bool good = parse(&soup, bytes, size, arena, mesh);
    free(soup.points);
    free(soup.triangles);
    free(bytes);
    return good;
}
