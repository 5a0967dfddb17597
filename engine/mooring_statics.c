/// The elastic catenary over a flat bed, in closed form along the line and one unknown across it.
///
/// The vertical plane through both ends holds the line. With horizontal force H, wet weight w per
/// length and vertical force p at a point, a piece that hangs from where it leaves the bed has
///     run(H, p)  = H/w asinh(p/H) + H p/(w EA)
///     rise(H, p) = (sqrt(H^2 + p^2) - H)/w + p^2/(2 w EA)
/// so that a line that touches the bed is a hanging piece at either end with a straight one
/// between, and one that does not is the difference of two such pieces. For given H the heights of
/// the ends fix both vertical forces; the span then grows with H (the complementary energy is
/// convex), so that one bracketed unknown is left and every configuration converges: slack, taut,
/// vertical, heaped. Sources: Irvine (1981), Cable Structures; Jonkman (2007), NREL/TP-500-41958,
/// app. B.
///
/// A buoyant line (w < 0) is the mirror image of a heavy one, with the surface as its bed.
#include <string.h>

#include "mooring_internal.h"

/// A line may be asked to stretch this much before it counts as too short [-].
static const double STRETCH_MAX = 0.05;
/// Lighter than this share of EA, a line is a straight spring.
static const double WEIGHTLESS = 1e-10;

/// A line in its own vertical plane, anchor at x = 0, weight positive downwards.
typedef struct Catenary {
    double span, length;      ///< horizontal distance X, unstretched length L [m]
    double weight;            ///< in water per length w [N/m]
    double stiffness;         ///< EA [N]
    double anchor, fairlead;  ///< heights of the ends above the bed [m], >= 0
    double horizontal;        ///< H [N]
    double anchor_vertical;   ///< downward pull of the hanging piece at the anchor [N]
    double fairlead_vertical; ///< the same at the fairlead [N]
    double bed_length;        ///< unstretched length between the pieces [m]; < 0: never touches
} Catenary;

static double hanging_run(const Catenary *c, double h, double p)
{
    double stretch = h * p / (c->weight * c->stiffness);
    return h > 0 ? h / c->weight * asinh(p / h) + stretch : 0;
}

static double hanging_rise(const Catenary *c, double h, double p)
{
    return (p * p / (sqrt(h * h + p * p) + h + 1e-300) + p * p / (2 * c->stiffness)) / c->weight;
}

/// Vertical force p >= 0 of a piece that rises by `height`: Newton's iteration on a convex rising
/// function from above never overshoots.
static double hanging_force(const Catenary *c, double h, double height)
{
    double rise = c->weight * height;
    if (rise <= 0) return 0;
    double p = sqrt(rise * (rise + 2 * h)); // inelastic: an upper bound
    for (int i = 0; i < 100; i++) {
        double root = sqrt(h * h + p * p);
        double miss = p * p / (root + h) + p * p / (2 * c->stiffness) - rise;
        double next = p - miss / (p / root + p / c->stiffness);
        if (!(fabs(next - p) > 1e-15 * p)) break;
        p = next;
    }
    return p;
}

/// Height of the fairlead over the anchor of a line that touches no bed, under vertical force v at
/// the fairlead [m]; grows with v.
static double suspended_rise(const Catenary *c, double h, double v)
{
    return hanging_rise(c, h, v) - hanging_rise(c, h, v - c->weight * c->length);
}

/// Vertical force at the fairlead of a line that touches no bed [N].
static double suspended_force(const Catenary *c, double h)
{
    double total = c->weight * c->length, rise = c->fairlead - c->anchor;
    double low = -total, high = 2 * total, widen = total;
    for (; suspended_rise(c, h, low) > rise && widen < 1e300; widen *= 2)
        low -= widen;
    for (; suspended_rise(c, h, high) < rise && widen < 1e300; widen *= 2)
        high += widen;
    for (int i = 0; i < 200 && high - low > 1e-15 * (fabs(high) + fabs(low)); i++) {
        double v = 0.5 * (low + high);
        if (suspended_rise(c, h, v) < rise)
            low = v;
        else
            high = v;
    }
    return 0.5 * (low + high);
}

/// Span of the line under horizontal force h [m]; leaves forces and bed length in `c`.
static double catenary_span(Catenary *c, double h)
{
    c->horizontal = h;
    c->anchor_vertical = hanging_force(c, h, c->anchor);
    c->fairlead_vertical = hanging_force(c, h, c->fairlead);
    c->bed_length = c->length - (c->anchor_vertical + c->fairlead_vertical) / c->weight;
    if (c->bed_length >= 0)
        return hanging_run(c, h, c->anchor_vertical) + hanging_run(c, h, c->fairlead_vertical) +
               c->bed_length * (1 + h / c->stiffness);
    c->fairlead_vertical = suspended_force(c, h);
    c->anchor_vertical = c->weight * c->length - c->fairlead_vertical;
    return hanging_run(c, h, c->fairlead_vertical) + hanging_run(c, h, c->anchor_vertical);
}

/// Find the horizontal force. @return false when the bracket could not be closed
static bool catenary_solve(Catenary *c)
{
    if (catenary_span(c, 0) >= c->span) return true; // vertical, or a heap on the bed
    double high = c->weight * c->length;
    while (catenary_span(c, high) < c->span) {
        high *= 4;
        if (!(high < 1e300)) return false;
    }
    double low = high;
    while (catenary_span(c, low) > c->span) {
        low *= 0.25;
        if (low < 1e-300) break;
    }
    for (int i = 0; i < 200 && high - low > 1e-15 * high; i++) {
        double h = 0.5 * (low + high);
        if (catenary_span(c, h) < c->span)
            low = h;
        else
            high = h;
    }
    catenary_span(c, 0.5 * (low + high));
    return true;
}

/// Place of the point at unstretched length s from the anchor: x from the anchor, z above the bed.
static void catenary_point(const Catenary *c, double s, double *x, double *z)
{
    double h = c->horizontal, w = c->weight;
    double hanging = c->anchor_vertical / w;
    double up = c->fairlead_vertical - w * (c->length - s);
    if (c->bed_length < 0) {
        double start = -c->anchor_vertical;
        *x = h > 0 ? hanging_run(c, h, up) - hanging_run(c, h, start) : c->span * s / c->length;
        *z = c->anchor + hanging_rise(c, h, up) - hanging_rise(c, h, start);
    } else if (s < hanging) {
        double down = c->anchor_vertical - w * s;
        *x = hanging_run(c, h, c->anchor_vertical) - hanging_run(c, h, down);
        *z = hanging_rise(c, h, down);
    } else if (s > c->length - c->fairlead_vertical / w) {
        *x = c->span - hanging_run(c, h, c->fairlead_vertical) + hanging_run(c, h, up);
        *z = hanging_rise(c, h, up);
    } else { // in a heap (h = 0) the piece on the bed is shorter than its length
        double from = hanging_run(c, h, c->anchor_vertical);
        double to = c->span - hanging_run(c, h, c->fairlead_vertical);
        *x = c->bed_length > 0 ? from + (to - from) * (s - hanging) / c->bed_length : from;
        *z = 0;
    }
}

/// Stretched length: integral of 1 + T/EA; the pieces have closed forms.
static double stretched_length(const Catenary *c)
{
    // int_0^p sqrt(h^2 + p^2) dp = (p sqrt(h^2 + p^2) + h^2 asinh(p/h)) / 2, odd in p
    double ends[2] = {c->anchor_vertical, c->fairlead_vertical}, sum = 0, h = c->horizontal;
    for (int i = 0; i < 2; i++)
        sum += 0.5 * (ends[i] * sqrt(h * h + ends[i] * ends[i]) +
                      (h > 0 ? h * h * asinh(ends[i] / h) : 0));
    double bed = maxd(c->bed_length, 0) * h;
    return c->length + (sum / c->weight + bed) / c->stiffness;
}

/// A line of several sections as if it were one: mean weights, springs in a row.
typedef struct MeanLine {
    const LineMakeup *makeup;
    double length;    ///< unstretched [m]
    double dry, wet;  ///< weight per length in air and in water [N/m]
    double stiffness; ///< EA [N]
    bool uniform;     ///< it is one
} MeanLine;

static MeanLine mean_line(const LineMakeup *makeup)
{
    MeanLine mean = {makeup, 0, 0, 0, 0, makeup->run_count == 1};
    double weight = 0, buoyancy = 0, softness = 0;
    for (int i = 0; i < makeup->segments; i++) {
        const LineConstants *c = makeup->segment[i];
        weight += c->weight;
        buoyancy += c->buoyancy;
        softness += 1 / c->stiffness;
    }
    mean.length = makeup_arc(makeup, makeup->segments);
    mean.dry = weight / mean.length;
    mean.wet = (weight - buoyancy) / mean.length;
    mean.stiffness = mean.length / softness;
    return mean;
}

/// Straight spring between the ends (weightless line).
static void straight(const MeanLine *line, Vec3 anchor, Vec3 fairlead, Vec3 *nodes,
                     LineStatics *statics)
{
    Vec3 d = vec3_sub(fairlead, anchor);
    double tension = maxd(line->stiffness * (vec3_norm(d) / line->length - 1), 0);
    statics->fairlead_tension = statics->anchor_tension = tension;
    statics->horizontal_force = statics->span > 0 ? tension * hypot(d.x, d.y) / statics->span : 0;
    statics->stretched_length = maxd(line->length, statics->span);
    for (int i = 0; nodes && i <= line->makeup->segments; i++)
        nodes[i] = vec3_mad(anchor, d, makeup_arc(line->makeup, i) / line->length);
}

/// Analytic solution of a line of one wet weight.
static bool solve_catenary(const MeanLine *line, Vec3 anchor, Vec3 fairlead, double weight,
                           const WaterField *water, const char *where, Vec3 *nodes,
                           LineStatics *statics, Error *error)
{
    double up = weight > 0 ? 1 : -1; // a buoyant line hangs upside down from the surface
    double bed = weight > 0 ? water->bed : -water->level;
    Vec3 d = vec3_sub(fairlead, anchor);
    Catenary c;
    memset(&c, 0, sizeof c);
    c.span = hypot(d.x, d.y);
    c.length = line->length;
    c.weight = fabs(weight);
    c.stiffness = line->stiffness;
    c.anchor = maxd(up * anchor.z - bed, 0);
    c.fairlead = maxd(up * fairlead.z - bed, 0);
    if (!catenary_solve(&c))
        return error_set(error, ERROR_INPUT, "%s: no static equilibrium found", where);

    statics->horizontal_force = c.horizontal;
    statics->fairlead_tension = hypot(c.horizontal, c.fairlead_vertical);
    statics->anchor_tension = hypot(c.horizontal, c.anchor_vertical);
    statics->touchdown = weight > 0 ? maxd(c.bed_length, 0) : 0;
    statics->stretched_length = stretched_length(&c);
    Vec3 forward = c.span > 0 ? vec3(d.x / c.span, d.y / c.span, 0) : vec3(1, 0, 0);
    for (int i = 0; nodes && i <= line->makeup->segments; i++) {
        double x, z;
        catenary_point(&c, makeup_arc(line->makeup, i), &x, &z);
        nodes[i] = vec3(anchor.x + forward.x * x, anchor.y + forward.y * x, up * (bed + z));
    }
    if (nodes) {
        nodes[0] = anchor;
        nodes[line->makeup->segments] = fairlead;
    }
    return true;
}

/// The closed form for a line of one weight, or a straight spring.
static bool first_shape(const MeanLine *mean, Vec3 anchor, Vec3 fairlead, double weight,
                        const WaterField *water, const char *where, Vec3 *nodes,
                        LineStatics *statics, Error *error)
{
    if (fabs(weight) * mean->length < WEIGHTLESS * mean->stiffness) {
        straight(mean, anchor, fairlead, nodes, statics);
        return true;
    }
    return solve_catenary(mean, anchor, fairlead, weight, water, where, nodes, statics, error);
}

void line_guess(const LineMakeup *makeup, Vec3 anchor, Vec3 fairlead, const WaterField *water,
                Vec3 *nodes)
{
    MeanLine mean = mean_line(makeup);
    LineStatics unused;
    Error error;
    memset(&unused, 0, sizeof unused);
    unused.span = vec3_norm(vec3_sub(fairlead, anchor));
    double weight = water->bed >= water->level ? mean.dry : mean.wet;
    if (unused.span >= mean.length ||
        !first_shape(&mean, anchor, fairlead, weight, water, "", nodes, &unused, &error))
        straight(&mean, anchor, fairlead, nodes, &unused);
}

static bool check_line(const LineScene *line, Vec3 anchor, Vec3 fairlead, const char *where,
                       LineStatics *statics, Error *error)
{
    for (int k = 0; k < line_section_count(line); k++) {
        LineSection s = line_section(line, k);
        if (!(s.length > 0) || s.segments < 1 || !(s.axial_stiffness > 0) ||
            !(s.mass_per_length > 0) || !(s.diameter > 0))
            return error_set(error, ERROR_INPUT,
                             "%s: length %g m, %d segments, axial stiffness %g N, mass %g kg/m, "
                             "diameter %g m; accepted: all greater than 0",
                             where, s.length, s.segments, s.axial_stiffness, s.mass_per_length,
                             s.diameter);
    }
    statics->span = vec3_norm(vec3_sub(fairlead, anchor));
    statics->reach = line->length;
    if (!isfinite(statics->span))
        return error_set(error, ERROR_INPUT, "%s: an end of the line is not at a finite place",
                         where);
    if (statics->span > line->length * (1 + STRETCH_MAX))
        return error_set(error, ERROR_INPUT,
                         "%s: the line cannot reach: its ends are %.6g m apart (span) and it is "
                         "%.6g m long (reach); accepted length: at least %.6g m",
                         where, statics->span, line->length, statics->span / (1 + STRETCH_MAX));
    return true;
}

/// Uniform weight holds along the whole line: no part of it can be at the surface.
static bool weight_is_uniform(const WaterField *water, Vec3 anchor, Vec3 fairlead, double wet)
{
    bool both_wet = anchor.z < water->level && fairlead.z < water->level;
    bool both_dry = anchor.z > water->level && fairlead.z > water->level;
    return water->density == 0 || (both_wet && wet > 0) || (both_dry && water->bed >= water->level);
}

bool line_statics(const LineScene *line, Vec3 anchor, Vec3 fairlead, const WaterField *water,
                  const char *where, Vec3 *nodes, LineStatics *statics, Error *error)
{
    memset(statics, 0, sizeof *statics);
    TRY(check_line(line, anchor, fairlead, where, statics, error));
    Arena own = arena_create(0); // a line that is not uniform is solved as a lumped one in any case
    LineMakeup makeup;
    bool good = makeup_create(line, water, where, &own, &makeup, error);
    if (good) {
        MeanLine mean = mean_line(&makeup);
        double weight = water->bed >= water->level ? mean.dry : mean.wet;
        bool uniform = mean.uniform && weight_is_uniform(water, anchor, fairlead, mean.wet);
        uniform = uniform && !makeup.bends;
        if (!nodes && !uniform)
            nodes = arena_take(&own, (size_t)line->segments + 1, sizeof(Vec3), where, error);
        good = (uniform || nodes) &&
               first_shape(&mean, anchor, fairlead, weight, water, where, nodes, statics, error);
        RelaxLine relaxed = {&makeup, {-1, -1}, nodes, uniform ? NULL : statics};
        if (good && nodes) good = lines_relax(&relaxed, 1, NULL, 0, water->level, where, error);
    }
    arena_destroy(&own);
    return good;
}
