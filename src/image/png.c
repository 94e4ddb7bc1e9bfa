#include <math.h>
#include <stdlib.h>

#include <png.h>

#include "base/file.h"
#include "base/mem.h"
#include "image/colour.h"
#include "image/image.h"

static png_byte encode(float linear)
{
    const double clamped = fmin(fmax(linear, 0), 1);
    return (png_byte)floor(sb_srgb_encode(clamped) * 255 + 0.5);
}

static void encode_pixel(const float *pixel, int channels, png_byte rgb[static 3])
{
    const int colours = channels < 3 ? channels : 3;
    bool nan = false;
    for (int c = 0; c < 3; c++) {
        rgb[c] = c < colours ? encode(pixel[c]) : colours == 1 ? rgb[0] : 0;
        nan = nan || (c < colours && isnan(pixel[c]));
    }
    if (nan) {
        rgb[0] = rgb[2] = 255;
        rgb[1] = 0;
    }
}

bool sb_image_write_png(const struct sb_image *image, const char *path,
                        struct sb_error *err)
{
    // libpng's simplified interface keeps its setjmp to itself.
    png_image png = {
        .version = PNG_IMAGE_VERSION,
        .format = PNG_FORMAT_RGB,
        .width = (png_uint_32)image->width,
        .height = (png_uint_32)image->height,
    };
    const long pixels = (long)image->width * image->height;
    png_byte *rgb = sb_alloc((size_t)pixels * 3);
    for (long i = 0; i < pixels; i++)
        encode_pixel(image->data + i * image->channels, image->channels, rgb + i * 3);

    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    char *data = sb_alloc(size);
    // A negative stride: the first row in memory is the bottom one.
    bool good =
        png_image_write_to_memory(&png, data, &size, 0, rgb, -image->width * 3, NULL);
    if (good)
        good = sb_file_replace(path, data, size, err);
    else
        sb_fail(err, SB_WRITE_FAILED, "%s: no PNG of %d x %d pixels: %s", path,
                image->width, image->height, png.message);
    free(data);
    free(rgb);
    return good;
}
