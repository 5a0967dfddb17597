/// Colour maps made in OKLab, so that equal steps of the value look like equal steps of colour, and
/// lightness alone tells the order (it survives grey print and colour blindness).
#ifndef FAIRLEAD_COLOUR_MAP_H
#define FAIRLEAD_COLOUR_MAP_H

#include <stdint.h>

typedef enum ColourMap {
    MAP_SEQUENTIAL, ///< dark blue, teal, yellow: speed, pressure
    MAP_DIVERGING,  ///< blue, near white, red: elevation about still water
    MAP_TENSION,    ///< near white, orange, deep red: line tension, told from the others
    MAP_COUNT,
} ColourMap;

enum { COLOUR_MAP_SIZE = 256 };

/// A slack line: violet, in no map, seen against water and bed.
extern const float SLACK_COLOUR[3];

/// Colour at 0..1 (clamped) as shown, red, green, blue 0..1.
/// Source: Ottosson (2020), "A perceptual color space for image processing".
void colour_map(ColourMap map, double at, double rgb[3]);

/// OKLab lightness of a shown colour, 0..1.
double colour_lightness(const double rgb[3]);

/// The smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not below `value`; 1 for
/// values that are not positive and finite.
double nice_ceiling(double value);

/// End of a scale for data that reach `largest`: `kept`, the end shown so far, while the data fill
/// 0.3 to 1 of it, so that the picture does not flicker; otherwise a new nice one. 0 = none kept.
double steady_range(double kept, double largest);

#endif
