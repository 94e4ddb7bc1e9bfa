// Portable float maps: "PF" (three channels) or "Pf" (one), width and height, a scale
// whose sign tells the byte order (negative: little-endian), one white space, and the
// floats, bottom row first (https://www.pauldebevec.com/Research/HDR/PFM/).

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/text.h"
#include "image/image.h"

static const size_t size_limit = (size_t)1 << 30;

bool sb_image_write_pfm(const struct sb_image *image, const char *path,
                        struct sb_error *err)
{
    if (image->channels == 2)
        return sb_fail(err, SB_WRITE_FAILED,
                       "%s: a PFM has 1 or 3 channels, this image has 2", path);
    const int channels = image->channels == 1 ? 1 : 3;
    const long pixels = (long)image->width * image->height;
    struct sb_text text = {0};
    sb_text_printf(&text, "%s\n%d %d\n-1.0\n", channels == 1 ? "Pf" : "PF", image->width,
                   image->height);
    for (long i = 0; i < pixels; i++)
        for (int c = 0; c < channels; c++) {
            uint32_t bits;
            memcpy(&bits, &image->data[i * image->channels + c], sizeof bits);
            const char bytes[4] = {(char)(bits & 255), (char)(bits >> 8 & 255),
                                   (char)(bits >> 16 & 255), (char)(bits >> 24)};
            sb_text_add_n(&text, bytes, sizeof bytes);
        }
    const bool good = sb_file_replace(path, text.data, text.length, err);
    sb_text_free(&text);
    return good;
}

// The next word of the header, with the one white space behind it. False at the end, or
// on a word that is too long to be any of the header's.
static bool next_word(const char **at, const char *end, char word[static 32])
{
    int length = 0;
    while (*at < end && isspace((unsigned char)**at))
        (*at)++;
    for (; *at < end && !isspace((unsigned char)**at) && length < 31; (*at)++)
        word[length++] = **at;
    word[length] = '\0';
    return length > 0 && *at < end && isspace((unsigned char)*(*at)++);
}

static bool next_size(const char **at, const char *end, int *size)
{
    char word[32];
    double value;
    if (!next_word(at, end, word) || !sb_parse_number(word, &value) || value < 1 ||
        value > 65536 || value != floor(value))
        return false;
    *size = (int)value;
    return true;
}

static float float_of(const unsigned char *b, bool little)
{
    const uint32_t bits =
        little ? b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24
               : b[3] | (uint32_t)b[2] << 8 | (uint32_t)b[1] << 16 | (uint32_t)b[0] << 24;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool sb_image_read_pfm(struct sb_image *image, const char *path, struct sb_error *err)
{
    struct sb_arena arena = {0};
    size_t size;
    *image = (struct sb_image){0};
    const char *at = sb_file_read(&arena, path, size_limit, &size, err);
    if (!at)
        goto error;
    const char *const end = at + size;

    char word[32];
    if (!next_word(&at, end, word) ||
        (strcmp(word, "PF") != 0 && strcmp(word, "Pf") != 0)) {
        sb_fail(err, SB_BAD_INPUT, "%s: not a PFM, which starts with PF or Pf", path);
        goto error;
    }
    const int channels = strcmp(word, "PF") == 0 ? 3 : 1;
    int width, height;
    if (!next_size(&at, end, &width) || !next_size(&at, end, &height)) {
        sb_fail(err, SB_BAD_INPUT,
                "%s: after the first word, a PFM has its width and height: whole numbers "
                "from 1 to 65536",
                path);
        goto error;
    }
    double scale;
    if (!next_word(&at, end, word) || !sb_parse_number(word, &scale) ||
        fabs(scale) != 1) {
        sb_fail(err, SB_BAD_INPUT, "%s: the scale of a PFM must be 1 or -1 here", path);
        goto error;
    }
    const size_t values = (size_t)width * (size_t)height * (size_t)channels;
    if ((size_t)(end - at) != values * 4) {
        sb_fail(err, SB_BAD_INPUT,
                "%s: %td bytes of pixels; %d x %d of %d channels are %zu", path, end - at,
                width, height, channels, values * 4);
        goto error;
    }
    sb_image_init(image, width, height, channels);
    for (size_t i = 0; i < values; i++)
        image->data[i] = float_of((const unsigned char *)at + i * 4, scale < 0);

error:
    sb_arena_free(&arena);
    return image->data != NULL;
}
