#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "image/image.h"

void sb_image_init(struct sb_image *image, int width, int height, int channels)
{
    *image = (struct sb_image){width, height, channels, NULL};
    image->data =
        sb_alloc((size_t)width * (size_t)height * (size_t)channels * sizeof *image->data);
}

void sb_image_free(struct sb_image *image)
{
    free(image->data);
    *image = (struct sb_image){0};
}

void sb_image64_init(struct sb_image64 *image, int width, int height, int channels)
{
    *image = (struct sb_image64){width, height, channels, NULL};
    image->data =
        sb_alloc((size_t)width * (size_t)height * (size_t)channels * sizeof *image->data);
}

void sb_image64_free(struct sb_image64 *image)
{
    free(image->data);
    *image = (struct sb_image64){0};
}

long sb_image_count_nonfinite(const struct sb_image *image)
{
    const long values = (long)image->width * image->height * image->channels;
    long count = 0;
    for (long i = 0; i < values; i++)
        count += !isfinite(image->data[i]);
    return count;
}

static double difference_of(float a, float b)
{
    if (a == b || (isnan(a) && isnan(b)))
        return 0;
    if (!isfinite(a) || !isfinite(b))
        return INFINITY;
    return fabs((double)a - (double)b);
}

void sb_image_compare(const struct sb_image *a, const struct sb_image *b,
                      struct sb_image_difference *difference)
{
    assert(a->width == b->width && a->height == b->height && a->channels == b->channels);
    *difference = (struct sb_image_difference){0};
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            const float *const p = sb_image_at(a, x, y), *const q = sb_image_at(b, x, y);
            bool differs = false;
            for (int c = 0; c < a->channels; c++) {
                const double d = difference_of(p[c], q[c]);
                differs = differs || d > 0;
                if (d > difference->max) {
                    difference->max = d;
                    difference->x = x;
                    difference->y = y;
                    difference->channel = c;
                    difference->a = p[c];
                    difference->b = q[c];
                }
            }
            difference->pixels += differs;
        }
}
