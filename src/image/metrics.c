#include "image/metrics.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "image/colour.h"

enum { CHANNELS = 3 };

struct sums {
    double square, signed_error;
    int64_t jnd1, jnd2, jnd1_srgb, jnd2_srgb; // pixels
    double *largest; // one a pixel that was added: its largest channel error; owned
};

// True when all of the pixel's values are finite. A value is counted as non-finite or as
// negative, never as both.
static bool count_values(const float *test, const double *truth,
                         struct sb_metrics *metrics)
{
    bool finite = true;
    for (int c = 0; c < CHANNELS; c++) {
        if (!isfinite(test[c]))
            metrics->nonfinite++;
        else
            metrics->negative += test[c] < 0;
        finite = finite && isfinite(test[c]) && isfinite(truth[c]);
    }
    return finite;
}

static double clamped(double value)
{
    return fmin(fmax(value, 0), 1);
}

// 8-bit steps between two values in [0,1], each rounded as a display does.
static double steps_between(double a, double b)
{
    return fabs(rint(255 * a) - rint(255 * b));
}

static void add_pixel(const float *test, const double *truth, int x, int y,
                      struct sb_metrics *metrics, struct sums *sums)
{
    double largest = 0, steps = 0, steps_srgb = 0;
    for (int c = 0; c < CHANNELS; c++) {
        const double difference = (double)test[c] - truth[c];
        const double error = fabs(difference);
        const double t = clamped((double)test[c]), r = clamped(truth[c]);
        sums->square += difference * difference;
        sums->signed_error += difference;
        largest = fmax(largest, error);
        if (error > metrics->max) {
            metrics->max = error;
            metrics->max_x = x;
            metrics->max_y = y;
            metrics->max_channel = c;
        }
        metrics->relative = fmax(metrics->relative, error / fmax(fabs(truth[c]), 1e-3));
        steps = fmax(steps, steps_between(t, r));
        steps_srgb =
            fmax(steps_srgb, steps_between(sb_srgb_encode(t), sb_srgb_encode(r)));
    }
    sums->largest[metrics->pixels++] = largest;
    sums->jnd1 += steps >= 1;
    sums->jnd2 += steps >= 2;
    sums->jnd1_srgb += steps_srgb >= 1;
    sums->jnd2_srgb += steps_srgb >= 2;
}

// Puts the value of the given rank (0: the least) where sorting would put it, with none
// larger before it and none smaller behind it (Hoare's FIND, CACM 4(7), 1961, algorithm
// 65).
static double select_rank(double *value, int64_t count, int64_t rank)
{
    int64_t first = 0, last = count - 1;
    while (first < last) {
        const double pivot = value[rank];
        int64_t i = first, j = last;
        while (i <= j) {
            while (value[i] < pivot)
                i++;
            while (pivot < value[j])
                j--;
            if (i <= j) {
                const double swapped = value[i];
                value[i++] = value[j];
                value[j--] = swapped;
            }
        }
        if (j < rank)
            first = i;
        if (rank < i)
            last = j;
    }
    return value[rank];
}

// The nearest rank: the least value that is no smaller than `per_mille` of all values.
static double quantile(double *value, int64_t count, int per_mille)
{
    const int64_t rank = (count * per_mille + 999) / 1000;
    return select_rank(value, count, rank - 1);
}

static void finish(struct sb_metrics *metrics, const struct sums *sums)
{
    const double pixels = (double)metrics->pixels, values = pixels * CHANNELS;
    metrics->p50 = quantile(sums->largest, metrics->pixels, 500);
    metrics->p99 = quantile(sums->largest, metrics->pixels, 990);
    metrics->p999 = quantile(sums->largest, metrics->pixels, 999);
    metrics->rmse = sqrt(sums->square / values);
    metrics->psnr_db = sums->square > 0 ? -20 * log10(metrics->rmse) : INFINITY;
    metrics->bias = sums->signed_error / values;
    metrics->jnd1 = (double)sums->jnd1 / pixels;
    metrics->jnd2 = (double)sums->jnd2 / pixels;
    metrics->jnd1_srgb = (double)sums->jnd1_srgb / pixels;
    metrics->jnd2_srgb = (double)sums->jnd2_srgb / pixels;
}

void sb_metrics_measure(const struct sb_metrics_params *params,
                        struct sb_metrics *metrics)
{
    const struct sb_image *const test = params->test;
    const struct sb_image64 *const truth = params->truth;
    assert(test->channels >= CHANNELS && truth->channels == CHANNELS);
    assert(test->width == truth->width && test->height == truth->height);
    const size_t room = (size_t)test->width * (size_t)test->height;
    struct sums sums = {.largest = sb_alloc(room * sizeof *sums.largest)};
    *metrics = (struct sb_metrics){0};
    for (int y = 0; y < test->height; y++)
        for (int x = 0; x < test->width; x++) {
            if (params->counted && !params->counted[(long)y * test->width + x])
                continue;
            const float *const t = sb_image_at(test, x, y);
            const double *const r = sb_image64_at(truth, x, y);
            if (count_values(t, r, metrics))
                add_pixel(t, r, x, y, metrics, &sums);
        }
    if (metrics->pixels > 0)
        finish(metrics, &sums);
    else
        *metrics = (struct sb_metrics){
            .nonfinite = metrics->nonfinite,
            .negative = metrics->negative,
            .max = NAN,
            .p50 = NAN,
            .p99 = NAN,
            .p999 = NAN,
            .rmse = NAN,
            .psnr_db = NAN,
            .bias = NAN,
            .jnd1 = NAN,
            .jnd2 = NAN,
            .jnd1_srgb = NAN,
            .jnd2_srgb = NAN,
            .relative = NAN,
        };
    free(sums.largest);
}
