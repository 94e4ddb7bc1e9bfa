#include "reference/parts.h"

// Where a coordinate falls among the centres of `size` texels, repeated: between `low` and its
// neighbour `high`, `share` of the way (OpenGL 4.6 core, equations 8.8 to 8.10).
struct place {
    int low, high;
    double share;
};

static struct place place_of(double coordinate, int size)
{
    // The whole part is taken off exactly, before the product can round.
    const double at = (coordinate - floor(coordinate)) * size - 0.5;
    const double below = floor(at);
    const int low = ((int)below + size) % size; // from -1 to size - 1
    return (struct place){low, (low + 1) % size, at - below};
}

static struct sb_vec3 texel_at(const struct sb_texture *texture, int x, int y)
{
    const unsigned char *t =
        texture->texel + 4 * ((size_t)y * (size_t)texture->width + (size_t)x);
    return (struct sb_vec3){t[0], t[1], t[2]};
}

static struct sb_vec3 between(struct sb_vec3 a, struct sb_vec3 b, double share)
{
    return sb_vec3_add(sb_vec3_scale(a, 1 - share), sb_vec3_scale(b, share));
}

struct sb_vec3 sb_ref_texture(const struct sb_texture *texture, const double uv[2])
{
    const struct place x = place_of(uv[0], texture->width);
    const struct place y = place_of(uv[1], texture->height);
    const struct sb_vec3 low = between(texel_at(texture, x.low, y.low),
                                       texel_at(texture, x.high, y.low), x.share);
    const struct sb_vec3 high = between(texel_at(texture, x.low, y.high),
                                        texel_at(texture, x.high, y.high), x.share);
    const struct sb_vec3 sum = between(low, high, y.share);
    return (struct sb_vec3){sum.x / 255, sum.y / 255, sum.z / 255};
}

// Of a material without the map: what changes nothing.
static struct sb_vec3 neutral(enum sb_map map)
{
    if (map == SB_MAP_NORMAL)
        return (struct sb_vec3){128.0 / 255, 128.0 / 255, 1};
    return (struct sb_vec3){1, 1, 1};
}

struct sb_vec3 sb_ref_texel(const struct sb_ref_shading *shading,
                            const struct sb_ref_input *input, enum sb_map map)
{
    if (!input->sampled && input->lacks >> map & 1)
        return neutral(map);
    return input->sampled ? input->texel[map]
                          : sb_ref_texture(&shading->scene->map[map], input->uv);
}
