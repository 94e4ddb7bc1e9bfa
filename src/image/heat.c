#include "image/heat.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/colour.h"
#include "image/digits.h"

// Sides of the picture, in pixels of a dot, that leave room for the scale on a sheet's
// 256.
enum { SHEET_SIDE = 256, PICTURE_SIDE = SHEET_SIDE - SB_HEAT_SCALE_WIDTH };

// Where things stand in the scale, in dots from its left or bottom.
enum {
    BAR_LEFT = 4,
    BAR_WIDTH = 8,
    TICK = 2,
    TEXT_LEFT = 17,
    TEXT_LENGTH = 6, // characters, up to the right edge
    MARGIN = 4,      // below and above the bar: half a number is there
    LINE = 9,        // from one number to the next
};
_Static_assert(TEXT_LEFT + TEXT_LENGTH * SB_DIGIT_ADVANCE - 1 == SB_HEAT_SCALE_WIDTH,
               "the numbers end where the scale does");

// Every 16th colour and the last of viridis (N. Smith and S. van der Walt, 2015, CC0), as
// sRGB: lightness rises evenly from one to the next, for all kinds of colour vision.
static const double viridis[][3] = {
    {0.267004, 0.004874, 0.329415}, {0.282327, 0.094955, 0.417331},
    {0.278826, 0.175490, 0.483397}, {0.258965, 0.251537, 0.524736},
    {0.229739, 0.322361, 0.545706}, {0.199430, 0.387607, 0.554642},
    {0.172719, 0.448791, 0.557885}, {0.149039, 0.508051, 0.557250},
    {0.127568, 0.566949, 0.550556}, {0.120638, 0.625828, 0.533488},
    {0.157851, 0.683765, 0.501686}, {0.246070, 0.738910, 0.452024},
    {0.369214, 0.788888, 0.382914}, {0.515992, 0.831158, 0.294279},
    {0.678489, 0.863742, 0.189503}, {0.845561, 0.887322, 0.099702},
    {0.993248, 0.906157, 0.143936},
};
enum { STEPS = sizeof viridis / sizeof *viridis - 1 };

// Decades, between which the colours are spread evenly.
struct range {
    double low, high;
};

static double position(const struct range *range, double error)
{
    const double at = (log10(error) - range->low) / (range->high - range->low);
    return fmin(fmax(at, 0), 1); // of no error the logarithm is -infinity
}

static void set_colour(float pixel[static 3], double at)
{
    const int step = fmin(floor(at * STEPS), STEPS - 1);
    const double part = at * STEPS - step;
    for (int c = 0; c < 3; c++) {
        const double from = viridis[step][c], to = viridis[step + 1][c];
        pixel[c] = (float)sb_srgb_decode(from + part * (to - from));
    }
}

// Infinite where a value is not finite.
static double error_at(const struct sb_heat_params *params, int x, int y)
{
    const float *const t = sb_image_at(params->test, x, y);
    if (!params->truth)
        return isfinite(t[0]) ? fabs((double)t[0]) : INFINITY;
    const double *const r = sb_image64_at(params->truth, x, y);
    double largest = 0;
    for (int c = 0; c < 3; c++) {
        if (!isfinite(t[c]) || !isfinite(r[c]))
            return INFINITY;
        largest = fmax(largest, fabs((double)t[c] - r[c]));
    }
    return largest;
}

static void draw_picture(const struct sb_heat_params *params, const struct range *range,
                         struct sb_image *heat)
{
    static const float magenta[3] = {1, 0, 1};
    const int width = params->test->width, height = params->test->height;
    const float grey = (float)sb_srgb_decode(0.5);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            float *const pixel = sb_image_at(heat, x, heat->height - height + y);
            const double error = error_at(params, x, y);
            if (params->counted && !params->counted[(long)y * width + x])
                pixel[0] = pixel[1] = pixel[2] = grey;
            else if (!isfinite(error))
                for (int c = 0; c < 3; c++)
                    pixel[c] = magenta[c];
            else
                set_colour(pixel, position(range, error));
        }
}

// Two digits, or one where two do not fit: 1, 5e-1, 2.5e-4, 3e-12.
static void print_number(double value, char text[static 32])
{
    int exponent = (int)floor(log10(value) + 1e-9);
    int tenths = (int)rint(value / pow(10, exponent) * 10);
    if (tenths == 100) {
        tenths = 10;
        exponent++;
    }
    char power[16] = "";
    if (exponent)
        snprintf(power, sizeof power, "e%d", exponent);
    if (tenths % 10 && strlen(power) <= TEXT_LENGTH - strlen("2.5"))
        snprintf(text, 32, "%d.%d%s", tenths / 10, tenths % 10, power);
    else
        snprintf(text, 32, "%.0f%s", tenths / 10., power);
}

struct scale {
    struct sb_image *heat;
    const struct range *range;
    int left, zoom;  // in pixels
    int bottom, top; // of the bar, in dots from below
};

static int dots_of(const struct scale *scale, double decade)
{
    const struct range *const range = scale->range;
    const double at = (decade - range->low) / (range->high - range->low);
    return scale->bottom + (int)rint(at * (scale->top - scale->bottom));
}

static void draw_bar(const struct scale *scale)
{
    const int zoom = scale->zoom, height = scale->top - scale->bottom;
    for (int y = scale->bottom * zoom; y < (scale->top + 1) * zoom; y++)
        for (int x = BAR_LEFT * zoom; x < (BAR_LEFT + BAR_WIDTH) * zoom; x++)
            set_colour(sb_image_at(scale->heat, scale->left + x, y),
                       (double)(y / zoom - scale->bottom) / height);
}

static void draw_tick(const struct scale *scale, int dots)
{
    const int zoom = scale->zoom, left = BAR_LEFT + BAR_WIDTH;
    for (int y = dots * zoom; y < (dots + 1) * zoom; y++)
        for (int x = left * zoom; x < (left + TICK) * zoom; x++)
            for (int c = 0; c < 3; c++)
                sb_image_at(scale->heat, scale->left + x, y)[c] = 1;
}

static void draw_number(const struct scale *scale, double decade)
{
    char text[32];
    print_number(pow(10, decade), text);
    sb_digits_draw(scale->heat, scale->left + TEXT_LEFT * scale->zoom,
                   (dots_of(scale, decade) - SB_DIGIT_HEIGHT / 2) * scale->zoom,
                   scale->zoom, text);
}

// Numbers at both ends, and at the decades between as far as there is room.
static void draw_scale(const struct scale *scale)
{
    const struct range *const range = scale->range;
    int free_from = scale->bottom + LINE;
    draw_bar(scale);
    draw_tick(scale, scale->bottom);
    draw_number(scale, range->low);
    draw_tick(scale, scale->top);
    draw_number(scale, range->high);
    for (int decade = (int)ceil(range->low); decade < range->high; decade++) {
        const int dots = dots_of(scale, decade);
        draw_tick(scale, dots);
        if (dots >= free_from && dots <= scale->top - LINE) {
            draw_number(scale, decade);
            free_from = dots + LINE;
        }
    }
}

static int divided_up(int value, int by)
{
    return (value + by - 1) / by;
}

int sb_heat_dot(int width, int height)
{
    const int across = divided_up(width, PICTURE_SIDE);
    const int up = divided_up(height, SHEET_SIDE);
    return across > up ? across : up;
}

void sb_heat_map(const struct sb_heat_params *params, struct sb_image *heat)
{
    const struct sb_image *const test = params->test;
    assert(test->channels >= (params->truth ? 3 : 1));
    assert(!params->truth || (test->width == params->truth->width &&
                              test->height == params->truth->height));
    const struct range range = {
        .low = log10(params->low > 0 ? params->low : 1e-6),
        .high = log10(params->high > 0 ? params->high : 1),
    };
    assert(-99 <= range.low && range.low < range.high && range.high <= 99);
    const int zoom = sb_heat_dot(test->width, test->height);
    const int left = divided_up(test->width, zoom) * zoom;
    int rows = divided_up(test->height, zoom);
    rows = rows > SB_HEAT_LEAST_HEIGHT ? rows : SB_HEAT_LEAST_HEIGHT;
    sb_image_init(heat, left + SB_HEAT_SCALE_WIDTH * zoom, rows * zoom, 3);
    draw_picture(params, &range, heat);
    draw_scale(&(struct scale){
        .heat = heat,
        .range = &range,
        .left = left,
        .zoom = zoom,
        .bottom = MARGIN,
        .top = rows - 1 - MARGIN,
    });
}
