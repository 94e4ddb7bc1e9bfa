// A heat map: where in a picture the error is, on a logarithmic scale that is drawn
// beside it.
#pragma once

#include "image/image.h"

struct sb_heat_params {
    // At least 3 channels, of which the first three are looked at; without a truth at
    // least 1, of which the first is the error itself.
    const struct sb_image *test;
    const struct sb_image64 *truth; // of the same size, 3 channels; or NULL
    const unsigned char *counted;   // one byte a pixel: 0 leaves it out; NULL: all count
    double low, high; // errors at the ends of the scale, 1e-99 to 1e99; 0: 1e-6 and 1
};

enum {
    SB_HEAT_SCALE_WIDTH = 52, // of the scale, in dots
    SB_HEAT_LEAST_HEIGHT = 72,
};

// How many pixels wide and high a dot of the scale is: as many as one pixel stands for
// once the map is shrunk to sides of at most 256 pixels, as sheets have them, so that its
// numbers stay sharp. 1 up to 204 x 256 pixels.
int sb_heat_dot(int width, int height);

// *heat becomes RGB in linear light; the caller frees it, it must not own data yet. The
// picture is at its top left, at one pixel a pixel. Its width is the picture's, rounded
// up to whole dots, and SB_HEAT_SCALE_WIDTH dots; its height the picture's, rounded up to
// whole dots, or SB_HEAT_LEAST_HEIGHT dots if that is more.
//
// The error of a pixel is its largest channel error. Colours run from dark violet to
// yellow, lighter as the error is larger, and stay those of the ends beyond them. Pixels
// that do not count are mid grey; where a value is not finite they are magenta.
void sb_heat_map(const struct sb_heat_params *params, struct sb_image *heat);
