// Float images: linear light, rows from the bottom up as GL has them, channels
// interleaved.
#pragma once

#include <stdbool.h>

#include "base/error.h"

struct sb_image {
    int width, height, channels; // 1 to 4 in files, 16 in what a probe returns
    float *data;                 // width * height * channels; owned
};

// All zero. The image must not own data yet.
void sb_image_init(struct sb_image *image, int width, int height, int channels);
void sb_image_free(struct sb_image *image); // zeroes it
static inline float *sb_image_at(const struct sb_image *image, int x, int y)
{
    return image->data + ((long)y * image->width + x) * image->channels;
}

// The same in double: what a reference computes.
struct sb_image64 {
    int width, height, channels;
    double *data; // owned
};
void sb_image64_init(struct sb_image64 *image, int width, int height, int channels);
void sb_image64_free(struct sb_image64 *image); // zeroes it
static inline double *sb_image64_at(const struct sb_image64 *image, int x, int y)
{
    return image->data + ((long)y * image->width + x) * image->channels;
}

// 8-bit RGB PNG, top row first, through the sRGB transfer function (IEC 61966-2-1);
// values are clamped to [0,1], a pixel with a NaN becomes magenta so that it is seen. One
// channel is grey, two are red and green, a fourth is dropped: what was drawn is to be
// seen whatever alpha says. SB_WRITE_FAILED.
bool sb_image_write_png(const struct sb_image *image, const char *path,
                        struct sb_error *err);

// Portable float map, 1 or 3 channels (a 4th is dropped, 2 are refused), little-endian,
// bit-exact. SB_WRITE_FAILED.
bool sb_image_write_pfm(const struct sb_image *image, const char *path,
                        struct sb_error *err);

// Initialises the image, which stays zeroed on failure (SB_BAD_INPUT). Either byte order
// is read; a scale other than 1 or -1 is refused, since applying it would change the
// bits.
bool sb_image_read_pfm(struct sb_image *image, const char *path, struct sb_error *err);

// Non-finite values over all channels.
long sb_image_count_nonfinite(const struct sb_image *image);

struct sb_image_difference {
    double max;        // largest |a-b|; infinity where a and b differ and either is not
                       // finite; two NaN do not differ, nor do 0 and -0
    int x, y, channel; // where; 0, 0, 0 where nothing differs
    float a, b;        // what stands there; 0, 0 where nothing differs
    long pixels;       // how many pixels differ at all
};
// Both images must have the same shape.
void sb_image_compare(const struct sb_image *a, const struct sb_image *b,
                      struct sb_image_difference *difference);
