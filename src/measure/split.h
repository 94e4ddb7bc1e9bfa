// Where the error of a picture comes from: from the ideal to what is displayed there are four
// steps, and the differences of neighbours add up to the whole error, pixel by pixel.
//
//     ideal -> the variant's model -> the same on the driver's own inputs -> what the driver
//     computed, as floats -> the same in the target's format
#pragma once

#include "image/metrics.h"
#include "reference/render.h"

enum sb_error_source {
    SB_BY_FORMULATION,   // model - ideal: Gouraud, short normals, bias, tessellation
    SB_BY_INTERPOLATION, // given - model: the rasteriser, and how inputs are carried
    SB_BY_ARITHMETIC,    // wide - given: precision, and formulas that lose it
    SB_BY_QUANTISATION,  // own - wide: the target's format, clamping too
    SB_BY_COUNT
};

struct sb_split_params { // pictures of one size
    const struct sb_ref_ground *ground;
    const struct sb_ref_picture *ideal, *model;
    const struct sb_ref_picture *given; // NULL: what the driver was given is not known
    const struct sb_image *geometry;    // SB_IMAGE_GEOMETRY
    const struct sb_image *wide, *own; // the colour as floats, and in the target's format
    // Lit per fragment: page SB_PROBE_INPUTS. Lit per vertex: the same of all vertices. NULL: raw
    // terms and the driver's branches are not known, and flips are those of its inputs.
    const struct sb_image *probe;
    // A branch that went another way is left out of the errors where it is at most so far from
    // having done so in double, in cosines: rounding explains it. Farther off it is an error.
    double decision_bound;
    bool interior; // only pixels that lie in one triangle are compared
};

struct sb_split {
    int64_t covered; // by the scene, for the driver or the reference
    int64_t compared, mismatched;
    int64_t
        flips; // pixels of which a branch went another way, left out or not; -1: not known
    int64_t raw_nonfinite, raw_negative; // -1: not known
    unsigned char *counted;              // a pixel: compared; the caller frees
    struct {
        double max,
            mean; // of |difference|, over channels, and over pixels and channels; NAN:
                  // not known
        int x, y; // of max
    } part[SB_BY_COUNT];
    double gouraud; // lit per vertex: largest |own - model|; else NAN
};
void sb_split_measure(const struct sb_split_params *params, struct sb_split *split);
