#include "image/digits.h"

#include <assert.h>
#include <stddef.h>

struct glyph {
    char character;
    const char *row[SB_DIGIT_HEIGHT]; // from the top
};

static const struct glyph glyphs[] = {
    {'0', {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    {'2', {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"}},
    {'3', {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}},
    {'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {"  ## ", " #   ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "  #  ", "  #  ", "  #  ", "  #  "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "   # ", " ##  "}},
    {'e', {"     ", "     ", " ### ", "#   #", "#####", "#    ", " ### "}},
    {'-', {"     ", "     ", "     ", " ### ", "     ", "     ", "     "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}},
};

static const struct glyph *glyph_of(char character)
{
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++)
        if (glyphs[i].character == character)
            return &glyphs[i];
    return NULL;
}

static void dot(struct sb_image *image, int left, int bottom, int zoom)
{
    for (int y = bottom; y < bottom + zoom; y++)
        for (int x = left; x < left + zoom; x++)
            for (int c = 0; c < 3; c++)
                sb_image_at(image, x, y)[c] = 1;
}

void sb_digits_draw(struct sb_image *image, int x, int y, int zoom, const char *text)
{
    assert(image->channels == 3);
    for (; *text; text++, x += SB_DIGIT_ADVANCE * zoom) {
        const struct glyph *const glyph = glyph_of(*text);
        for (int row = 0; glyph && row < SB_DIGIT_HEIGHT; row++)
            for (int column = 0; column < SB_DIGIT_WIDTH; column++)
                if (glyph->row[row][column] == '#')
                    dot(image, x + column * zoom, y + (SB_DIGIT_HEIGHT - 1 - row) * zoom,
                        zoom);
    }
}
