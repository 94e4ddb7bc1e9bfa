// A crate of the kind that LearnOpenGL's containers wear: five boards in a metal frame,
// with rivets. Integers and square roots only, so every machine makes the same bytes.
#include "scene/make.h"

enum { SIZE = 256, FRAME = 24, BOARD = 42, GAP = 2 }; // texels

// A hash of two integers, 0 to 255.
static int noise(int x, int y)
{
    uint32_t h = (uint32_t)x * UINT32_C(0x8da6b343) ^ (uint32_t)y * UINT32_C(0xd8163841);
    h = (h ^ (h >> 15)) * UINT32_C(0x2c1b3c6d);
    h = (h ^ (h >> 12)) * UINT32_C(0x297a2d39);
    return (int)((h ^ (h >> 15)) >> 24);
}

static bool in_frame(int x, int y)
{
    return x < FRAME || y < FRAME || x >= SIZE - FRAME || y >= SIZE - FRAME;
}

static bool in_gap(int y)
{
    return (y - FRAME) % BOARD < GAP;
}

static bool in_rivet(int x, int y)
{
    // One at every 32nd texel around the middle of the frame.
    const int dx = x % 32 - 12, dy = y % 32 - 12;
    return dx * dx + dy * dy <= 16;
}

// The texture repeats, and so must what lies beyond its edges.
static double height_at(int x, int y)
{
    x = (x + SIZE) % SIZE;
    y = (y + SIZE) % SIZE;
    if (in_frame(x, y))
        return in_rivet(x, y) ? 3 : 2;
    if (in_gap(y))
        return 0;
    return 1 + noise(x / 16, y) / 1024.0; // grain along the boards
}

static void put(unsigned char *texel, int r, int g, int b)
{
    texel[0] = (unsigned char)r;
    texel[1] = (unsigned char)g;
    texel[2] = (unsigned char)b;
    texel[3] = 255;
}

static void put_diffuse(unsigned char *texel, int x, int y)
{
    if (in_frame(x, y)) {
        const int grey = (in_rivet(x, y) ? 150 : 110) + noise(x, y) / 32;
        put(texel, grey, grey, grey);
        return;
    }
    if (in_gap(y)) {
        put(texel, 48, 44, 40);
        return;
    }
    // Each board has its own tone, and grain that runs along it.
    const int board = (y - FRAME) / BOARD;
    const int tone = 160 + noise(board, -1) / 8 + noise(x / 16, y) / 8 + noise(x, y) / 32;
    put(texel, tone, tone * 15 / 16, tone * 7 / 8);
}

static void put_specular(unsigned char *texel, int x, int y)
{
    const int shine = in_frame(x, y) ? 200 + noise(x, y) / 8 : 0;
    put(texel, shine, shine, shine);
}

// -1 is 1, 0 is 128 and 1 is 255: a flat texel is exactly flat (f_frame=robust decodes so).
static int encoded(double component)
{
    return (int)(128 + 127 * component + 0.5);
}

static void put_normal(unsigned char *texel, int x, int y)
{
    // Central differences; one unit of height is half a texel, so slopes stay moderate.
    const double dx = (height_at(x + 1, y) - height_at(x - 1, y)) / 4;
    const double dy = (height_at(x, y + 1) - height_at(x, y - 1)) / 4;
    const struct sb_vec3 n = sb_vec3_normalise((struct sb_vec3){-dx, -dy, 1});
    put(texel, encoded(n.x), encoded(n.y), encoded(n.z));
}

void sb_texture_make(struct sb_arena *arena, struct sb_texture map[SB_MAP_COUNT])
{
    static void (*const put_texel[SB_MAP_COUNT])(unsigned char *texel, int x, int y) = {
        [SB_MAP_DIFFUSE] = put_diffuse,
        [SB_MAP_SPECULAR] = put_specular,
        [SB_MAP_NORMAL] = put_normal,
    };
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        unsigned char *texel = sb_arena_alloc(arena, 4 * SIZE * SIZE);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++)
                put_texel[i](texel + 4 * (y * SIZE + x), x, y);
        }
        map[i] = (struct sb_texture){SIZE, SIZE, texel};
    }
}
