/// Sections come after headers that are marked by dashes; each table begins with a row of names and
/// a row of units. `!`, `#` and `%` begin comments. Words are read in any case.
#include "moordyn_read.h"

#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROW_SIZE = 1024, WORDS_MAX = 32 };

typedef enum Section {
    SECTION_NONE, ///< front matter, or behind "need this line"
    SECTION_TYPES,
    SECTION_ROD_TYPES,
    SECTION_BODIES,
    SECTION_RODS,
    SECTION_POINTS,
    SECTION_LINES,
    SECTION_FAILURE,
    SECTION_CONTROL,
    SECTION_LOADS,
    SECTION_SYROPE,
    SECTION_OPTIONS,
    SECTION_OUTPUTS,
} Section;

/// One body of the file, as far as points may hang on it.
typedef struct FileBody {
    int id;
    MoordynHold hold;
    Vec3 origin; ///< [m]
    Quat attitude;
} FileBody;

typedef struct Reader {
    const char *path;
    int row; ///< line of the file
    Section section;
    int heads;  ///< rows of names and units seen in this table
    bool begun; ///< the first section was seen
    char words[WORDS_MAX][ROW_SIZE / 4];
    int word_count;
    int body_count;
    FileBody bodies[MOORDYN_BODIES_MAX];
    char ignored[256]; ///< options without effect here
    MoordynFile *file;
    Error *error;
} Reader;

static bool refuse(const Reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool refuse(const Reader *r, const char *format, ...)
{
    char text[500];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return error_set(r->error, ERROR_INPUT, "%.300s line %d: %s", r->path, r->row, text);
}

static void note(Reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void note(Reader *r, const char *format, ...)
{
    size_t used = strlen(r->file->notes);
    if (used + 3 >= MOORDYN_NOTES_SIZE) return;
    if (used) used += (size_t)snprintf(r->file->notes + used, MOORDYN_NOTES_SIZE - used, "; ");
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->file->notes + used, MOORDYN_NOTES_SIZE - used, format, arguments);
    va_end(arguments);
}

// ---- words and numbers --------------------------------------------------------------------------

/// A whole number or real one, also with Fortran's D exponent. @return false for anything else
static bool parse_number(const char *word, double *value)
{
    char copy[64], *end;
    if (strlen(word) >= sizeof copy) return false;
    snprintf(copy, sizeof copy, "%s", word);
    for (char *c = copy; *c; c++)
        if (*c == 'd' || *c == 'D') *c = 'e';
    *value = strtod(copy, &end);
    return end != copy && !*end && isfinite(*value);
}

static bool parse_whole(const char *word, int *value)
{
    double number;
    if (!parse_number(word, &number) || number != floor(number) || fabs(number) > 1e9) return false;
    *value = (int)number;
    return true;
}

static bool same_word(const char *a, const char *b)
{
    for (; *a && *b; a++, b++)
        if (tolower((unsigned char)*a) != tolower((unsigned char)*b)) return false;
    return !*a && !*b;
}

/// Is it one of the words in "a|b|c", in any case?
static bool is_one_of(const char *word, const char *words)
{
    char one[64];
    while (*words) {
        size_t length = strcspn(words, "|");
        snprintf(one, sizeof one, "%.*s", (int)length, words);
        if (same_word(word, one)) return true;
        words += length + (words[length] == '|');
    }
    return false;
}

/// The value at column `at` of the present row.
static bool column(const Reader *r, int at, const char *name, double min, bool above_min,
                   double *value)
{
    if (at >= r->word_count)
        return refuse(r, "%s is missing: the row has %d values", name, r->word_count);
    if (!parse_number(r->words[at], value))
        return refuse(r, "%s = %.60s: must be a number", name, r->words[at]);
    if (*value < min || (above_min && *value <= min))
        return refuse(r, "%s = %.60s: must be %s %g", name, r->words[at],
                      above_min ? ">" : ">=", min);
    return true;
}

static bool whole_column(const Reader *r, int at, const char *name, int min, int max, int *value)
{
    if (at >= r->word_count)
        return refuse(r, "%s is missing: the row has %d values", name, r->word_count);
    if (!parse_whole(r->words[at], value) || *value < min || *value > max)
        return refuse(r, "%s = %.60s: must be a whole number >= %d and <= %d", name, r->words[at],
                      min, max);
    return true;
}

// ---- tables -------------------------------------------------------------------------------------

static bool read_stiffness(const Reader *r, MoordynType *type)
{
    if (strchr(r->words[3], '|'))
        return refuse(r, "EA = %.60s: viscoelastic stiffness is not supported: must be one number",
                      r->words[3]);
    double unused;
    if (!parse_number(r->words[3], &unused))
        return refuse(r, "EA = %.60s: stiffness from a file is not supported: must be a number",
                      r->words[3]);
    TRY(column(r, 3, "EA", 0, true, &type->stiffness));
    if (strchr(r->words[4], '|'))
        return refuse(r,
                      "BA/-zeta = %.60s: static and dynamic damping are not supported: must be "
                      "one number",
                      r->words[4]);
    return column(r, 4, "BA/-zeta", -1e300, false, &type->damping);
}

static bool read_type(Reader *r)
{
    MoordynFile *file = r->file;
    if (r->word_count < 10)
        return refuse(r,
                      "LINE TYPES: %d values: must be 10 at least (a version 1 file has 9: the "
                      "column EI comes after BA/-zeta since version 2)",
                      r->word_count);
    if (file->type_count == MOORDYN_TYPES_MAX)
        return refuse(r, "LINE TYPES: more than %d types", MOORDYN_TYPES_MAX);
    MoordynType *type = &file->types[file->type_count];
    snprintf(type->name, sizeof type->name, "%.*s", SCENE_NAME_SIZE - 1, r->words[0]);
    TRY(column(r, 1, "Diam", 0, true, &type->diameter));
    TRY(column(r, 2, "Mass/m", 0, true, &type->mass));
    TRY(read_stiffness(r, type));
    TRY(column(r, 5, "EI", 0, false, &type->bending));
    TRY(column(r, 6, "Cd", 0, false, &type->drag_normal));
    TRY(column(r, 7, "Ca", 0, false, &type->added_normal));
    TRY(column(r, 8, "CdAx", 0, false, &type->drag_axial));
    TRY(column(r, 9, "CaAx", 0, false, &type->added_axial));
    double lift = 0;
    if (r->word_count > 10 && parse_number(r->words[10], &lift) && lift != 0)
        return refuse(r, "Cl = %.60s: vortex-induced vibration is not supported: must be 0",
                      r->words[10]);
    file->type_count++;
    return true;
}

/// What a word like "Body1Pinned" says: the body's number, 0 for other words.
static int body_number(const char *word, const char *prefix, bool *pinned)
{
    size_t length = strlen(prefix);
    for (size_t i = 0; i < length; i++)
        if (tolower((unsigned char)word[i]) != prefix[i]) return 0;
    char *end;
    long number = strtol(word + length, &end, 10);
    *pinned = same_word(end, "pinned");
    return end != word + length && (!*end || *pinned) && number > 0 && number < 1000 ? (int)number
                                                                                     : 0;
}

static bool read_body(Reader *r)
{
    if (r->body_count == MOORDYN_BODIES_MAX)
        return refuse(r, "BODIES: more than %d bodies", MOORDYN_BODIES_MAX);
    FileBody *body = &r->bodies[r->body_count];
    double v[6];
    static const char *const names[6] = {"X0", "Y0", "Z0", "r0", "p0", "y0"};
    TRY(whole_column(r, 0, "ID", 1, 1000000, &body->id));
    for (int i = 0; i < 6; i++)
        TRY(column(r, 2 + i, names[i], -1e9, false, &v[i]));
    if (is_one_of(r->words[1], "fixed|fix|anchor"))
        body->hold = MOORDYN_FIXED;
    else if (is_one_of(r->words[1], "coupled|vessel|ves|cpld"))
        body->hold = MOORDYN_COUPLED;
    else
        return refuse(r,
                      "BODIES: attachment %.40s is not supported: must be Fixed, Coupled or Vessel "
                      "(a floating body is one of the case's own bodies)",
                      r->words[1]);
    if ((v[3] != 0) + (v[4] != 0) + (v[5] != 0) > 1)
        return refuse(r,
                      "BODIES: body %d is turned about several axes: only one of r0, p0, y0 may "
                      "differ from 0",
                      body->id);
    body->origin = vec3(v[0], v[1], v[2]);
    body->attitude = quat_from_euler(v[3] * PI / 180, v[4] * PI / 180, v[5] * PI / 180);
    for (int i = 8; i < r->word_count; i++) {
        double value;
        if (!parse_number(r->words[i], &value) || value != 0) {
            note(r, "body %d: mass, volume and coefficients are those of the case's body",
                 body->id);
            break;
        }
    }
    r->body_count++;
    return true;
}

/// How a point is held; a point on a body gets its place in the world.
static bool read_hold(Reader *r, MoordynPoint *point)
{
    const char *word = r->words[1];
    bool pinned = false;
    int number = body_number(word, "body", &pinned);
    if (is_one_of(word, "fixed|fix|anchor")) {
        point->hold = MOORDYN_FIXED;
    } else if (is_one_of(word, "coupled|vessel|ves|cpld")) {
        point->hold = MOORDYN_COUPLED;
    } else if (is_one_of(word, "free|point|connect|connection|con")) {
        point->hold = MOORDYN_FREE;
    } else if (number > 0 && !pinned) {
        for (int b = 0; b < r->body_count; b++) {
            const FileBody *body = &r->bodies[b];
            if (body->id != number) continue;
            point->hold = body->hold;
            point->position = vec3_add(body->origin, quat_rotate(body->attitude, point->position));
            return true;
        }
        return refuse(r, "POINTS: point %d is on body %d, which is not in BODIES", point->id,
                      number);
    } else {
        return refuse(r,
                      "POINTS: attachment %.40s is not supported: must be Fixed, Coupled, Vessel, "
                      "Free or Body with its number",
                      word);
    }
    return true;
}

static bool read_point(Reader *r)
{
    MoordynFile *file = r->file;
    if (r->word_count < 5)
        return refuse(r, "POINTS: %d values: must be 5 at least (9 with Mass, Volume, CdA, Ca)",
                      r->word_count);
    if (file->point_count == MOORDYN_POINTS_MAX)
        return refuse(r, "POINTS: more than %d points", MOORDYN_POINTS_MAX);
    MoordynPoint *point = &file->points[file->point_count];
    point->row = r->row;
    TRY(whole_column(r, 0, "ID", 1, 1000000, &point->id));
    for (int i = 0; i < file->point_count; i++)
        if (file->points[i].id == point->id)
            return refuse(r, "POINTS: ID %d stands twice", point->id);
    double xyz[3], *rest[4] = {&point->mass, &point->volume, &point->drag_area, &point->added_mass};
    static const char *const names[7] = {"X", "Y", "Z", "Mass", "Volume", "CdA", "Ca"};
    for (int i = 0; i < 3; i++)
        TRY(column(r, 2 + i, names[i], -1e9, false, &xyz[i]));
    for (int i = 0; i < 4 && 5 + i < r->word_count; i++)
        TRY(column(r, 5 + i, names[3 + i], 0, false, rest[i]));
    point->position = vec3(xyz[0], xyz[1], xyz[2]);
    TRY(read_hold(r, point));
    file->point_count++;
    return true;
}

static bool find_point(const Reader *r, int at, const char *name, int *point)
{
    int id;
    const char *word = r->words[at];
    if (tolower((unsigned char)word[0]) == 'r' && isdigit((unsigned char)word[1]))
        return refuse(r, "LINES: %s = %.40s: rods are not supported: must be the ID of a point",
                      name, word);
    TRY(whole_column(r, at, name, 1, 1000000, &id));
    for (int i = 0; i < r->file->point_count; i++)
        if (r->file->points[i].id == id) {
            *point = i;
            return true;
        }
    return refuse(r, "LINES: %s = %d: there is no such point", name, id);
}

static bool read_line(Reader *r)
{
    MoordynFile *file = r->file;
    if (r->word_count < 6)
        return refuse(r,
                      "LINES: %d values: must be 6 at least: ID LineType AttachA AttachB UnstrLen "
                      "NumSegs",
                      r->word_count);
    if (file->line_count == SCENE_LINES_MAX)
        return refuse(r, "LINES: more than %d lines", SCENE_LINES_MAX);
    MoordynLine *line = &file->lines[file->line_count];
    line->row = r->row;
    TRY(whole_column(r, 0, "ID", 1, 1000000, &line->id));
    for (int i = 0; i < file->line_count; i++)
        if (file->lines[i].id == line->id) return refuse(r, "LINES: ID %d stands twice", line->id);
    line->type = -1;
    for (int i = 0; i < file->type_count; i++)
        if (same_word(file->types[i].name, r->words[1])) line->type = i;
    if (line->type < 0)
        return refuse(r, "LINES: LineType = %.40s: there is no such line type", r->words[1]);
    TRY(find_point(r, 2, "AttachA", &line->ends[0]));
    TRY(find_point(r, 3, "AttachB", &line->ends[1]));
    if (line->ends[0] == line->ends[1])
        return refuse(r, "LINES: both ends of line %d are at the same point", line->id);
    TRY(column(r, 4, "UnstrLen", 0, true, &line->length));
    TRY(whole_column(r, 5, "NumSegs", 1, 256, &line->segments));
    file->line_count++;
    return true;
}

// ---- options ------------------------------------------------------------------------------------

/// Options that say how MoorDyn computes or what it writes: no business of another program.
#define OWN_OPTIONS                                                                                \
    "writelog|dtm|cfl|tscheme|dtic|icdt|tmaxic|ictmax|cdscaleic|icdfac|threshic|icthresh|"         \
    "icgendynamic|"                                                                                \
    "fileic|dtout|outswitch|writeunits|disableoutput|disableouttime|echo|dtwave|unifycurrentgrid|" \
    "wavekin_rampt|inertialf|inertialf_rampt|fricdamp|cv|statdynfricscale|mc"

static bool read_number_option(Reader *r, const char *key, double min, bool above_min,
                               double *value)
{
    if (!parse_number(r->words[0], value))
        return refuse(r, "OPTIONS: %s = %.60s: must be a number", key, r->words[0]);
    if (*value < min || (above_min && *value <= min))
        return refuse(r, "OPTIONS: %s = %.60s: must be %s %g", key, r->words[0],
                      above_min ? ">" : ">=", min);
    return true;
}

/// 0, "", none or false.
static bool is_off(const char *word)
{
    double value;
    return (parse_number(word, &value) && value == 0) || is_one_of(word, "none|false|f|\"\"|''|-");
}

static bool read_friction(Reader *r, const char *key)
{
    double before = r->file->bed_friction;
    bool first = isnan(before);
    TRY(read_number_option(r, key, 0, false, &r->file->bed_friction));
    if (!first && before != r->file->bed_friction)
        return refuse(r,
                      "OPTIONS: %s = %.60s: friction along and across the line must be the same "
                      "(%g above)",
                      key, r->words[0], before);
    return true;
}

static bool read_option(Reader *r)
{
    MoordynFile *file = r->file;
    if (r->word_count < 2)
        return refuse(r, "OPTIONS: %.60s: must be a value and the option's name", r->words[0]);
    const char *value = r->words[0], *key = r->words[1];
    if (is_one_of(key, "g|gravity")) return read_number_option(r, key, 0, true, &file->gravity);
    if (is_one_of(key, "rho|rhow|wtrdnsty|wtrdens"))
        return read_number_option(r, key, 0, true, &file->density);
    if (is_one_of(key, "kbot|kb"))
        return read_number_option(r, key, 0, false, &file->bed_stiffness);
    if (is_one_of(key, "cbot|cb")) return read_number_option(r, key, 0, false, &file->bed_damping);
    if (is_one_of(key, "frictioncoefficient|mu_kt|mu_ka")) return read_friction(r, key);
    if (is_one_of(key, "wtrdpth|depth")) {
        double unused;
        if (!parse_number(value, &unused))
            return refuse(r,
                          "OPTIONS: %s = %.60s: a seafloor from a file is not supported: must be "
                          "a number",
                          key, value);
        return read_number_option(r, key, 0, true, &file->depth);
    }
    if (is_one_of(key,
                  "wavekin|currents|waterkin|seafloorfile|seafloorpath|bathymetryfile|bathfile")) {
        if (is_off(value)) return true;
        double number;
        if (same_word(key, "wavekin") && parse_number(value, &number) && number == 1) {
            note(r, "WaveKin 1: the waves are the case's");
            return true;
        }
        return refuse(r, "OPTIONS: %s = %.60s is not supported: must be 0%s", key, value,
                      same_word(key, "wavekin") ? " or 1 (waves are the case's)" : "");
    }
    if (!is_one_of(key, OWN_OPTIONS)) return refuse(r, "OPTIONS: %.40s is not known here", key);
    size_t used = strlen(r->ignored);
    snprintf(r->ignored + used, sizeof r->ignored - used, "%s%s", used ? " " : "", key);
    return true;
}

// ---- rows and sections --------------------------------------------------------------------------

typedef struct SectionName {
    const char *name; ///< how a header may call it, upper case
    Section section;
} SectionName;

/// The longer names first: "ROD TYPES" is not "RODS".
static const SectionName section_names[] = {
    {"LINE TYPE", SECTION_TYPES},     {"LINE DICTIONARY", SECTION_TYPES},
    {"ROD TYPE", SECTION_ROD_TYPES},  {"ROD DICTIONARY", SECTION_ROD_TYPES},
    {"SYROPE", SECTION_SYROPE},       {"EXTERNAL LOAD", SECTION_LOADS},
    {"BODIES", SECTION_BODIES},       {"BODY LIST", SECTION_BODIES},
    {"BODY PROPERT", SECTION_BODIES}, {"RODS", SECTION_RODS},
    {"ROD LIST", SECTION_RODS},       {"ROD PROPERT", SECTION_RODS},
    {"POINT", SECTION_POINTS},        {"CONNECTION", SECTION_POINTS},
    {"NODE", SECTION_POINTS},         {"FAILURE", SECTION_FAILURE},
    {"CONTROL", SECTION_CONTROL},     {"OPTION", SECTION_OPTIONS},
    {"OUTPUT", SECTION_OUTPUTS},      {"LINES", SECTION_LINES},
    {"LINE LIST", SECTION_LINES},     {"LINE PROPERT", SECTION_LINES},
};

static bool enter_section(Reader *r, const char *row)
{
    char upper[ROW_SIZE];
    bool letters = false;
    snprintf(upper, sizeof upper, "%s", row);
    for (char *c = upper; *c; c++) {
        letters = letters || isalpha((unsigned char)*c);
        *c = (char)toupper((unsigned char)*c);
    }
    r->heads = 0;
    for (size_t i = 0; i < sizeof section_names / sizeof *section_names; i++) {
        // line types come first: what stands before them is front matter, whatever it says
        if (!strstr(upper, section_names[i].name)) continue;
        if (!r->begun && section_names[i].section != SECTION_TYPES) continue;
        r->section = section_names[i].section;
        r->begun = true;
        return true;
    }
    bool front = !r->begun;
    if (front || !letters || strstr(upper, "NEED THIS LINE") || strstr(upper, "END")) {
        if (!front) r->section = SECTION_NONE;
        return true;
    }
    return refuse(r, "section %.80s is not known here", row + strspn(row, "- \t"));
}

static void split_words(Reader *r, const char *row)
{
    r->word_count = 0;
    while (r->word_count < WORDS_MAX) {
        row += strspn(row, " \t\r\n");
        if (!*row) return;
        size_t length = strcspn(row, " \t\r\n");
        snprintf(r->words[r->word_count++], sizeof r->words[0], "%.*s", (int)length, row);
        row += length;
    }
}

/// Tables begin with their columns' names and units: the first two rows that have no number where
/// every row of data has one.
static bool is_head(const Reader *r)
{
    static const int numeric[] = {
        [SECTION_TYPES] = 1,  [SECTION_ROD_TYPES] = 1, [SECTION_BODIES] = 2,  [SECTION_RODS] = 3,
        [SECTION_POINTS] = 2, [SECTION_LINES] = 4,     [SECTION_FAILURE] = 0, [SECTION_CONTROL] = 0,
        [SECTION_LOADS] = 0,  [SECTION_SYROPE] = 1};
    double value;
    int at = numeric[r->section];
    return r->heads < 2 && (at >= r->word_count || !parse_number(r->words[at], &value));
}

static bool read_row(Reader *r)
{
    if (r->section == SECTION_OPTIONS) return read_option(r);
    if (r->section == SECTION_NONE || r->section == SECTION_OUTPUTS) return true;
    if (is_head(r)) {
        r->heads++;
        return true;
    }
    r->heads = 2;
    switch (r->section) {
    case SECTION_TYPES:
        return read_type(r);
    case SECTION_BODIES:
        return read_body(r);
    case SECTION_POINTS:
        return read_point(r);
    case SECTION_LINES:
        return read_line(r);
    case SECTION_RODS:
        return refuse(r, "RODS: rods are not supported");
    case SECTION_FAILURE:
        return refuse(r,
                      "FAILURE: failure by this table is not supported: a line that breaks is one "
                      "of the case's own lines with breaking_tension_n");
    case SECTION_CONTROL:
        return refuse(r, "CONTROL: line control from outside is not supported: a line with a winch "
                         "is one of the case's own lines");
    case SECTION_LOADS:
        return refuse(r, "EXTERNAL LOADS: external loads are not supported");
    case SECTION_SYROPE:
        return refuse(r, "SYROPE IC: the Syrope model is not supported");
    default:
        return true; // rod types harm nobody while there are no rods
    }
}

static bool read_rows(Reader *r, FILE *stream)
{
    char row[ROW_SIZE];
    uint64_t hash = 14695981039346656037u;
    while (fgets(row, sizeof row, stream)) {
        r->row++;
        size_t length = strlen(row);
        for (size_t i = 0; i < length; i++)
            hash = (hash ^ (unsigned char)row[i]) * 1099511628211u;
        if (length == sizeof row - 1 && row[length - 1] != '\n')
            return refuse(r, "has more than %d characters", ROW_SIZE - 2);
        char *begin = row + (r->row == 1 && !strncmp(row, "\xEF\xBB\xBF", 3) ? 3 : 0);
        if (strstr(begin, "---") && !strchr("!#%", begin[strspn(begin, " \t")])) {
            TRY(enter_section(r, begin));
            continue;
        }
        if (r->section != SECTION_NONE) row[strcspn(row, "!#%")] = 0;
        split_words(r, begin);
        if (r->word_count) TRY(read_row(r));
    }
    r->file->hash = hash;
    return true;
}

static bool check_whole(Reader *r)
{
    const MoordynFile *file = r->file;
    const char *missing = !file->type_count    ? "LINE TYPES"
                          : !file->point_count ? "POINTS"
                          : !file->line_count  ? "LINES"
                                               : NULL;
    if (missing)
        return error_set(r->error, ERROR_INPUT,
                         "%.300s: no rows in section %s: a MoorDyn v2 file must have LINE TYPES, "
                         "POINTS and LINES",
                         r->path, missing);
    int coupled = 0;
    for (int b = 0; b < r->body_count; b++)
        coupled += r->bodies[b].hold == MOORDYN_COUPLED;
    if (coupled > 1)
        return error_set(r->error, ERROR_INPUT,
                         "%.300s: BODIES: %d coupled bodies: must be one at most", r->path,
                         coupled);
    return true;
}

bool moordyn_read(const char *path, MoordynFile *file, Error *error)
{
    memset(file, 0, sizeof *file);
    file->gravity = file->density = file->depth = file->bed_friction = NAN;
    file->bed_stiffness = 3e6; // MoorDyn's defaults (its documentation, Options)
    file->bed_damping = 3e5;
    static const Reader empty;
    Reader reader = empty;
    reader.path = path;
    reader.file = file;
    reader.error = error;
    FILE *stream = fopen(path, "r");
    if (!stream)
        return error_set(error, ERROR_INPUT, "%.300s: cannot read: %s", path, strerror(errno));
    bool good = read_rows(&reader, stream);
    fclose(stream);
    TRY(good && check_whole(&reader));
    if (isnan(file->bed_friction)) file->bed_friction = 0;
    if (reader.ignored[0]) note(&reader, "options without effect here: %s", reader.ignored);
    return true;
}
