// How wrong a picture is: statistics of a float image against a truth in double, over the
// pixels that count.
#pragma once

#include <stdint.h>

#include "image/image.h"

struct sb_metrics_params {
    const struct sb_image *test;    // at least 3 channels; the first three are looked at
    const struct sb_image64 *truth; // of the same size; 3 channels, linear light
    const unsigned char *counted;   // one byte a pixel: 0 leaves it out; NULL: all count
};

struct sb_metrics {
    int64_t pixels; // that count, and are finite in both
    int64_t nonfinite,
        negative; // values among those that count; never part of what follows
    // Absolute error over channels and pixels, linear light.
    double max;
    int max_x, max_y, max_channel;
    double p50, p99, p999; // nearest rank, of the pixels' largest channel error
    double rmse, psnr_db;  // peak 1; identical: INFINITY
    double bias;           // mean of test - truth
    // Shares of pixels whose nearest 8-bit step is at least one or two off in a channel,
    // in linear light and after the sRGB transfer function.
    double jnd1, jnd2, jnd1_srgb, jnd2_srgb;
    double relative; // largest of |t - r| / max(|r|, 1e-3)
};
// All NAN, and 0 pixels, where no pixel counts. A value of the test is counted as
// non-finite or as negative, never as both; a pixel that is not finite in both is in none
// of the other figures.
void sb_metrics_measure(const struct sb_metrics_params *params,
                        struct sb_metrics *metrics);

// LDR-FLIP (Andersson et al. 2020, "FLIP: a difference evaluator for alternating images")
// of two linear pictures, encoded as sRGB and clamped as a display would. Background
// included: it is a measure of what is seen; a NaN is seen as 0. At least 1 pixel a
// degree. `error`: NULL or an image to initialise with the per-pixel error (1 channel),
// which the caller frees.
struct sb_flip {
    double mean, max; // 0 to 1
};
#define SB_FLIP_PPD                                                                      \
    67.02 // pixels a degree: 0.7 m away from a 0.7 m wide display of 3840 pixels
struct sb_flip sb_flip_measure(const struct sb_image *test,
                               const struct sb_image64 *truth, double pixels_per_degree,
                               struct sb_image *error);
