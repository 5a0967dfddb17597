/// What every part of one picture shares: the camera, the light, the scales. `FrameBlock` is the
/// uniform block of assets/shaders/common.glsl, member for member.
#ifndef FAIRLEAD_FRAME_H
#define FAIRLEAD_FRAME_H

#include "linear.h"
#include "render.h"

typedef struct FrameBlock {
    Mat4 clip_from_world;
    Vec4f eye, forward, right, up, light, sun, box_min, box_max, target, range;
    Vec4f sky_zenith, sky_horizon, backdrop_top, backdrop_low, bed_colour, grid_colour;
    Vec4f water_deep, water_shallow, field, tension;
} FrameBlock;

/// One colour scale of the picture.
typedef struct Scale {
    double least, largest;
    const char *title, *unit;
    bool shown;
} Scale;

/// Ends of the scales shown so far, so that they do not flicker from picture to picture.
typedef struct KeptRanges {
    double elevation, speed, pressure, tension;
} KeptRanges;

typedef struct Frame {
    FrameBlock block;
    const Snapshot *snapshot;
    const ViewOptions *view;
    Vec3 box_min, box_max; ///< of the water; z of box_max is the still level [m]
    double breadth;        ///< what a metre of geometry y is drawn as: 1 in 3-D
    ColourField field;     ///< what colours the water; particles are never plain
    Scale field_scale, tension_scale;
    Vec3 eye;
} Frame;

/// Camera, light and colours. The scales are filled later by frame_scales.
void frame_begin(Frame *frame, const Snapshot *snapshot, const ViewOptions *view, int width,
                 int height);

/// Scales from the largest values drawn. @param largest  of the field's magnitude among what is
/// drawn
void frame_scales(Frame *frame, KeptRanges *kept, double largest);

/// A not-a-number or infinite camera value makes the picture useless: it is refused here.
bool view_check(const ViewOptions *view, Error *error);

#endif
