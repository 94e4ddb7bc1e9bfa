#include "image/sheet.h"

#include <math.h>

void sb_image_stretch(struct sb_image *image)
{
    const long values = (long)image->width * image->height * image->channels;
    float least = INFINITY, most = -INFINITY;
    for (long i = 0; i < values; i++)
        if (isfinite(image->data[i]) && image->data[i] != 0) {
            least = fminf(least, image->data[i]);
            most = fmaxf(most, image->data[i]);
        }
    const float scale = most > least ? 0.9f / (most - least) : 0;
    for (long i = 0; i < values; i++)
        if (isfinite(image->data[i]) && image->data[i] != 0)
            image->data[i] = 1 - (most - image->data[i]) * scale;
}

void sb_image_shrink(const struct sb_image *from, int side, struct sb_image *to)
{
    const int longest = from->width > from->height ? from->width : from->height;
    const int by = (longest + side - 1) / side;
    sb_image_init(to, (from->width + by - 1) / by, (from->height + by - 1) / by,
                  from->channels);
    for (int y = 0; y < to->height; y++)
        for (int x = 0; x < to->width; x++)
            for (int c = 0; c < to->channels; c++) {
                double sum = 0;
                int count = 0;
                for (int v = y * by; v < (y + 1) * by && v < from->height; v++)
                    for (int u = x * by; u < (x + 1) * by && u < from->width; u++) {
                        sum += (double)sb_image_at(from, u, v)[c];
                        count++;
                    }
                sb_image_at(to, x, y)[c] = (float)(sum / count);
            }
}

int sb_sheet_side(int count)
{
    const int columns = count < SB_SHEET_COLUMNS ? count : SB_SHEET_COLUMNS;
    const int rows = (count + columns - 1) / columns;
    const int side = (int)sqrt((1 << 24) / ((double)columns * rows));
    return side > 256 ? 256 : side < 1 ? 1 : side;
}

static void copy(const struct sb_image *from, struct sb_image *to, int left, int bottom)
{
    for (int y = 0; y < from->height; y++)
        for (int x = 0; x < from->width; x++)
            for (int c = 0; c < to->channels; c++)
                sb_image_at(to, left + x, bottom + y)[c] = sb_image_at(from, x, y)[c];
}

void sb_sheet_make(const struct sb_image *picture, int count, struct sb_image *sheet)
{
    static const float line = 0.2f;
    const int columns = count < SB_SHEET_COLUMNS ? count : SB_SHEET_COLUMNS;
    const int rows = (count + columns - 1) / columns;
    int width = 0, height = 0;
    for (int i = 0; i < count; i++) {
        width = picture[i].width > width ? picture[i].width : width;
        height = picture[i].height > height ? picture[i].height : height;
    }
    sb_image_init(sheet, columns * (width + 1) - 1, rows * (height + 1) - 1,
                  picture[0].channels);
    for (int y = 0; y < sheet->height; y++)
        for (int x = 0; x < sheet->width; x++) {
            // Rows are counted from the top, the image's lines from the bottom.
            const int down = sheet->height - 1 - y;
            const bool between =
                x % (width + 1) == width || down % (height + 1) == height;
            for (int c = 0; c < sheet->channels; c++)
                sb_image_at(sheet, x, y)[c] = between ? line : 0;
        }
    for (int i = 0; i < count; i++) {
        const int top = sheet->height - i / columns * (height + 1);
        copy(&picture[i], sheet, i % columns * (width + 1), top - picture[i].height);
    }
}
