#include "command.h"

#include <math.h>
#include <string.h>

#include "physics/wave_theory.h"
#include "waves.h"

static const double SLACK = 1e-9; ///< a limit met up to rounding (degrees to radians) is met

Command command_default(void)
{
    Command command = {NAN, NAN, NAN, "", NAN, CUT_NOWHERE};
    return command;
}

/// One value asked for: the last one where none is; refused outside of its range.
/// @param scale  from SI to the unit of the message
static bool choose(const char *path, double asked, double last, Range range, double scale,
                   const char *unit, double *chosen, Error *error)
{
    *chosen = isnan(asked) ? last : asked;
    double slack = SLACK * (1 + fabs(*chosen));
    if (isfinite(*chosen) && *chosen >= range.min - slack && *chosen <= range.max + slack)
        return true;
    return error_set(error, ERROR_INPUT, "%s = %.9g: must be >= %.9g and <= %.9g %s", path,
                     *chosen * scale, range.min * scale, range.max * scale, unit);
}

/// The same direction, turned by full circles into the limits where that is possible.
static double wrap_heading(double heading, Range limits)
{
    if (!isfinite(heading) || fabs(heading) > 1e6) return heading;
    double turn = 2 * PI, slack = SLACK * turn;
    while (heading > limits.max + slack && heading - turn >= limits.min - slack)
        heading -= turn;
    while (heading < limits.min - slack && heading + turn <= limits.max + slack)
        heading += turn;
    return heading;
}

bool command_check(const Scene *scene, const Command *command, const WaveTarget *last,
                   WaveTarget *target, Error *error)
{
    const Waves *waves = &scene->waves;
    if (waves->kind == WAVES_NONE)
        return error_set(error, ERROR_INPUT,
                         "wave: this case has no waves to change: waves.kind is \"none\"");
    if (waves->kind == WAVES_RECORD)
        return error_set(error, ERROR_INPUT,
                         "wave: the piston of this case follows a record (waves.piston_motion): "
                         "its waves cannot be changed");
    WaveTarget sea;
    TRY(choose("wave.height_m", command->wave_height, last->height, waves->height_limits, 1, "m",
               &sea.height, error));
    TRY(choose("wave.period_s", command->wave_period, last->period, waves->period_limits, 1, "s",
               &sea.period, error));
    TRY(choose("wave.heading_deg", wrap_heading(command->wave_heading, waves->heading_limits),
               last->heading, waves->heading_limits, 180 / PI, "deg", &sea.heading, error));
    if (scene->domain.dimensions == 2 && fabs(sin(sea.heading)) > 1e-6)
        return error_set(error, ERROR_INPUT, "wave.heading_deg = %.9g: must be 0 or 180 in 2-D",
                         sea.heading * 180 / PI);
    double depth = scene->fluid.level - scene->domain.min.z;
    double number = wave_number_airy(2 * PI / sea.period, depth, scene->fluid.gravity);
    double most = 2 * wave_breaking_height(number, depth);
    if (sea.height > most)
        return error_set(error, ERROR_INPUT,
                         "wave.height_m = %.9g: must be >= %.9g and <= %.4g m, twice the breaking "
                         "height at a period of %.9g s",
                         sea.height, waves->height_limits.min, most, sea.period);
    if (!waves_may_run(scene, &sea))
        return error_set(error, ERROR_INPUT,
                         "wave.period_s = %.9g: must be longer: against the current "
                         "(waves.current.speed_ms %.9g) no such wave can run",
                         sea.period, waves->current.speed);
    *target = sea;
    return true;
}

bool command_check_line(const Scene *scene, const Command *command, const LineOrder *orders,
                        int *line, Error *error)
{
    *line = -1;
    for (int l = 0; l < scene->line_count; l++)
        if (!strcmp(scene->lines[l].name, command->line)) *line = l;
    if (*line < 0)
        return error_set(error, ERROR_INPUT,
                         "line.name = \"%s\": must be one of this case's lines%s%s", command->line,
                         scene->line_count ? ", as " : " (there is none)",
                         scene->line_count ? scene->lines[0].name : "");
    const LineScene *scene_line = &scene->lines[*line];
    if (isnan(command->line_length) && command->line_cut == CUT_NOWHERE)
        return error_set(error, ERROR_INPUT, "line: length_m or cut must be given");
    if (orders[*line].cut != CUT_NOWHERE)
        return error_set(error, ERROR_INPUT,
                         "line.name = \"%s\": has been cut: must be a whole line", command->line);
    if (isnan(command->line_length)) return true;
    if (!(scene_line->winch.speed > 0))
        return error_set(
            error, ERROR_INPUT,
            "line.length_m = %.9g: line %s has no winch: must be left as it is (%.9g m)",
            command->line_length, command->line, scene_line->length);
    double length;
    return choose("line.length_m", command->line_length, scene_line->length,
                  scene_line->winch.length, 1, "m", &length, error);
}
