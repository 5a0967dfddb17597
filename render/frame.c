#include "frame.h"

#include "colour_map.h"

/// In 2-D the slice is drawn this thick, as a share of its length.
static const double slice_share = 0.12;

ViewOptions view_options_default(void)
{
    return (ViewOptions){
        .camera = {.distance = 10.0,
                   .azimuth = -2.2,
                   .elevation = 0.35,
                   .field_of_view = 35.0 * PI / 180.0},
        .width = 960,
        .height = 540,
        .water = WATER_SURFACE,
        .field = FIELD_NONE,
        .overlay = true,
    };
}

Camera camera_for_scene(const Scene *scene)
{
    Camera camera = view_options_default().camera;
    const Domain *domain = &scene->domain;
    Vec3 centre = vec3_scale(vec3_add(domain->min, domain->max), 0.5);
    Vec3 length = vec3_sub(domain->max, domain->min);
    if (domain->dimensions == 2) {
        centre.y = 0.0;
        length.y = slice_share * length.x;
    }
    double level = scene->fluid.level;
    centre.z = isfinite(level) && domain->kind != DOMAIN_TANK
                   ? level - 0.25 * (level - domain->min.z)
                   : centre.z;
    camera.azimuth = isfinite(scene->camera.azimuth) ? scene->camera.azimuth : camera.azimuth;
    camera.elevation =
        isfinite(scene->camera.elevation) ? scene->camera.elevation : camera.elevation;
    if (scene->body_count > 0 && domain->dimensions == 3) {
        Vec3 bodies = vec3(0, 0, 0);
        for (int b = 0; b < scene->body_count; b++)
            bodies = vec3_mad(bodies, scene->bodies[b].position, 1.0 / scene->body_count);
        centre.x = 0.5 * (centre.x + bodies.x);
        centre.y = 0.5 * (centre.y + bodies.y);
    }
    Vec3 target = scene->camera.target;
    camera.target =
        vec3(isfinite(target.x) ? target.x : centre.x, isfinite(target.y) ? target.y : centre.y,
             isfinite(target.z) ? target.z : centre.z);
    // Seen across a 16:9 picture: the wider of the domain's outlines from this azimuth.
    double across = fabs(length.x * sin(camera.azimuth)) + fabs(length.y * cos(camera.azimuth));
    double deep = fabs(length.x * cos(camera.azimuth)) + fabs(length.y * sin(camera.azimuth));
    double tangent = tan(0.5 * camera.field_of_view);
    double fit =
        maxd(0.5 * across / (tangent * 16.0 / 9.0), 0.6 * length.z / tangent) + 0.42 * deep;
    camera.distance = isfinite(scene->camera.distance) && scene->camera.distance > 0
                          ? scene->camera.distance
                          : 1.06 * fit;
    return camera;
}

bool view_check(const ViewOptions *view, Error *error)
{
    const Camera *camera = &view->camera;
    double sum = camera->target.x + camera->target.y + camera->target.z + camera->azimuth +
                 camera->elevation;
    if (!isfinite(sum) || !(camera->distance > 0.0 && camera->distance < 1e9))
        return error_set(error, ERROR_INPUT, "camera: values must be finite, distance > 0");
    if (!(camera->field_of_view > 0.01 && camera->field_of_view < 3.0))
        return error_set(error, ERROR_INPUT, "camera: field of view %g, accepted 0.01 to 3 rad",
                         camera->field_of_view);
    if (view->width < 16 || view->width > 4096 || view->height < 16 || view->height > 4096)
        return error_set(error, ERROR_INPUT, "view: %d x %d pixels, accepted 16 to 4096",
                         view->width, view->height);
    return true;
}

/// The palette: two looks, one for light and one for dark pages.
static void paint_frame(FrameBlock *block, bool dark, double grid, double extinction)
{
    if (dark) {
        block->sky_zenith = vec4f(0.16, 0.26, 0.38, 0);
        block->sky_horizon = vec4f(0.56, 0.66, 0.74, 0);
        block->backdrop_top = vec4f(0.035, 0.055, 0.085, 0);
        block->backdrop_low = vec4f(0.085, 0.105, 0.135, 0);
        block->bed_colour = vec4f(0.30, 0.31, 0.31, grid);
        block->grid_colour = vec4f(0.44, 0.46, 0.47, 0.55);
        block->water_deep = vec4f(0.015, 0.120, 0.185, extinction);
        block->water_shallow = vec4f(0.10, 0.40, 0.47, 0.80);
    } else {
        block->sky_zenith = vec4f(0.36, 0.57, 0.78, 0);
        block->sky_horizon = vec4f(0.90, 0.94, 0.97, 0);
        block->backdrop_top = vec4f(0.78, 0.86, 0.93, 0);
        block->backdrop_low = vec4f(0.955, 0.965, 0.975, 0);
        block->bed_colour = vec4f(0.80, 0.78, 0.72, grid);
        block->grid_colour = vec4f(0.62, 0.60, 0.55, 0.55);
        block->water_deep = vec4f(0.02, 0.20, 0.32, extinction);
        block->water_shallow = vec4f(0.16, 0.56, 0.64, 0.85);
    }
}

void frame_begin(Frame *frame, const Snapshot *snapshot, const ViewOptions *view, int width,
                 int height)
{
    const Domain *domain = &snapshot->domain;
    *frame = (Frame){.snapshot = snapshot, .view = view, .breadth = 1.0, .field = view->field};
    frame->box_min = domain->min;
    frame->box_max = vec3(domain->max.x, domain->max.y, snapshot->level);
    if (domain->dimensions == 2) {
        frame->breadth = slice_share * (domain->max.x - domain->min.x);
        frame->box_min.y = -0.5 * frame->breadth;
        frame->box_max.y = 0.5 * frame->breadth;
    }
    if (view->water == WATER_PARTICLES && frame->field == FIELD_NONE) frame->field = FIELD_SPEED;

    const Camera *camera = &view->camera;
    double elevation = mind(maxd(camera->elevation, -1.55), 1.55);
    Vec3 out = vec3(cos(elevation) * cos(camera->azimuth), cos(elevation) * sin(camera->azimuth),
                    sin(elevation));
    frame->eye = vec3_mad(camera->target, out, camera->distance);
    Vec3 forward = vec3_scale(out, -1.0);
    Vec3 right = vec3_unit(vec3_cross(forward, vec3(0, 0, 1)));
    Vec3 up = vec3_cross(right, forward);

    Vec3 size = vec3_sub(frame->box_max, frame->box_min);
    Vec3 centre = vec3_scale(vec3_add(frame->box_max, frame->box_min), 0.5);
    double radius = maxd(0.5 * vec3_norm(size), 1e-3);
    double reach = vec3_norm(vec3_sub(frame->eye, centre));
    double far = reach + 8.0 * radius;
    double near = maxd(0.02 * camera->distance, mind(reach - 2.0 * radius, 0.5 * camera->distance));
    double tangent = tan(0.5 * camera->field_of_view), aspect = (double)width / height;

    FrameBlock *block = &frame->block;
    block->clip_from_world = mat4_multiply(mat4_perspective(tangent, aspect, near, far),
                                           mat4_view(frame->eye, right, up, forward));
    block->eye = vec4f_from(frame->eye, snapshot->time);
    block->forward = vec4f_from(forward, tangent);
    block->right = vec4f_from(vec3_scale(right, tangent * aspect), 0);
    block->up = vec4f_from(vec3_scale(up, tangent), 0);
    // The lamp goes round with the eye, so that no side of the ship is ever only dark.
    double lamp = camera->azimuth - 0.9, sun = camera->azimuth + PI - 0.5;
    block->light = vec4f_from(vec3_unit(vec3(cos(lamp), sin(lamp), 1.15)), 0);
    block->sun = vec4f_from(vec3_unit(vec3(cos(sun), sin(sun), 0.55)), 0);
    block->box_min = vec4f_from(frame->box_min, snapshot->spacing);
    block->box_max = vec4f_from(frame->box_max, maxd(snapshot->zone_width, 0.0));
    block->target = vec4f(width, height, 1.0 / width, 1.0 / height);
    double amplitude = snapshot->has_waves ? 0.5 * snapshot->wave_now.height : 0.0;
    block->range = vec4f(near, far, radius, maxd(amplitude, 0.01 * maxd(size.z, 1e-3)));
    double depth = maxd(size.z, 0.12 * radius);
    paint_frame(block, view->dark, nice_ceiling(radius / 9.0), 0.55 / depth);
}

void frame_scales(Frame *frame, KeptRanges *kept, double largest)
{
    const Snapshot *snapshot = frame->snapshot;
    double tension = 0.0;
    for (int l = 0; l < snapshot->line_count; l++)
        for (int s = 0; s + 1 < snapshot->lines[l].node_count; s++)
            if (isfinite(snapshot->lines[l].tension[s]))
                tension = maxd(tension, snapshot->lines[l].tension[s]);
    kept->tension = steady_range(kept->tension, tension);
    frame->tension_scale =
        (Scale){0.0, kept->tension, "Line tension", "N", snapshot->line_count > 0};

    Scale *scale = &frame->field_scale;
    if (frame->field == FIELD_ELEVATION) {
        double height = snapshot->has_waves
                            ? maxd(snapshot->wave_now.height, snapshot->wave_asked.height)
                            : 0.0;
        kept->elevation = steady_range(kept->elevation, maxd(largest, 0.65 * height));
        *scale = (Scale){-kept->elevation, kept->elevation, "Elevation", "m", true};
    } else if (frame->field == FIELD_SPEED) {
        kept->speed = steady_range(kept->speed, largest);
        *scale = (Scale){0.0, kept->speed, "Water speed", "m/s", true};
    } else if (frame->field == FIELD_PRESSURE) {
        kept->pressure = steady_range(kept->pressure, largest);
        *scale = (Scale){0.0, kept->pressure, "Pressure", "Pa", true};
    }
    ColourMap map = frame->field == FIELD_ELEVATION ? MAP_DIVERGING : MAP_SEQUENTIAL;
    double kind = frame->field == FIELD_NONE ? 0 : frame->field == FIELD_ELEVATION ? 1 : 2;
    frame->block.field = vec4f(scale->least, scale->largest, (map + 0.5) / MAP_COUNT, kind);
    frame->block.tension = vec4f(0.0, kept->tension, (MAP_TENSION + 0.5) / MAP_COUNT, 0);
}
