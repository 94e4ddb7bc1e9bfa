// A picture of a variant: for cases that take a scene, its rasteriser and its upload.
#pragma once

#include "cases/case.h"

struct sb_case_picture_params {
    const struct sb_case_env *env;
    const struct sb_variant *variant; // resolved; width and height are its own
    const char *scene;
};
struct sb_case_picture {
    struct sb_image
        colour; // 4 channels, as floats, of one sample a pixel: nothing is clamped, or
                // rounded to a target
    struct sb_image geometry; // SB_IMAGE_GEOMETRY: whose colour it is
};
// *picture must be zeroed; sb_case_picture_free also after failure.
bool sb_case_picture(const struct sb_case_picture_params *params,
                     struct sb_case_picture *picture, struct sb_error *err);
void sb_case_picture_free(struct sb_case_picture *picture);

// The largest difference in colour, in steps of 1/255, over the pixels that show the same triangle
// in both: what covers a pixel is a decision. Infinity where either is not finite, and where a smaller
// share of the pixels than `share`, from 0 to 1, shows the same.
double sb_case_picture_compare(const struct sb_case_picture *a,
                               const struct sb_case_picture *b, double share);
