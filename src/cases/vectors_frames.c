// Tangent frames and normal maps.
#include <math.h>

#include "cases/vectors.h"

static void put(float *out, struct sb_vec3 v)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

static struct sb_vec3 get(const float *v)
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static const struct sb_vec3 ahead = {0, 0, 1};
static const struct sb_vec3 slanted = {2.0 / 7, 3.0 / 7, 6.0 / 7};
static const struct sb_vec3 mirrored = {-2.0 / 7, -3.0 / 7, 6.0 / 7};

// --- tbn-parallel -------------------------------------------------------------------------

// The bitangent as the vertex shader makes it, or what a mesh without texture coordinates has.
static void add_frame(struct sb_points *points, struct sb_vec3 normal,
                      struct sb_vec3 tangent)
{
    struct sb_point *point =
        sb_vectors_add(points, &(struct sb_vectors_point){normal, slanted, mirrored});
    put(point->tangent, tangent);
    put(point->bitangent, sb_vec3_cross(get(point->normal), get(point->tangent)));
    for (int c = 0; c < 3; c++)
        point->texel[SB_MAP_NORMAL][c] = (float[3]){0.75f, 0.625f, 0.875f}[c];
}

void sb_vectors_flat_frames(struct sb_points *points,
                            const struct sb_case_setting *setting)
{
    (void)setting;
    static const struct sb_vec3 none = {0};
    struct sb_random random = sb_random_seed(11);
    for (int i = 0; i < 32; i++) {
        const struct sb_vec3 tilt = sb_vec3_scale(sb_any_direction(&random), 0.5);
        const struct sb_vec3 normal = sb_vec3_normalise(sb_vec3_add(ahead, tilt));
        const struct sb_vec3 across = sb_vectors_across(normal);
        add_frame(points, normal, normal); // parallel
        add_frame(points, normal, sb_vec3_scale(normal, -2));
        add_frame(points, normal, none); // T = 0
        add_frame(points, normal, sb_vec3_add(normal, sb_vec3_scale(across, 1e-5)));
        add_frame(points, normal, across); // as it should be
    }
}

// --- normal maps --------------------------------------------------------------------------

// A point in the plane z = 0 of one frame, with a texel of 8 bits.
static struct sb_point *add_texel(struct sb_points *points, struct sb_vec3 eye,
                                  const int texel[3])
{
    struct sb_point *point =
        sb_vectors_add(points, &(struct sb_vectors_point){ahead, slanted, eye});
    for (int c = 0; c < 3; c++)
        point->texel[SB_MAP_NORMAL][c] = (float)(texel[c] / 255.0);
    return point;
}

// x and y as filtering and compression leave them, up to the corners of the square: outside of the
// circle, so that 0, which 128 stands for, is the z that is left. And inside of it, from the middle
// to a slope of 60 degrees, where z is what the root says: 0 everywhere is not right.
void sb_vectors_long_bumps(struct sb_points *points,
                           const struct sb_case_setting *setting)
{
    (void)setting;
    static const int xy[][2] = {{230, 217}, {217, 230}, {255, 255}, {1, 1},
                                {255, 160}, {30, 225},  {1, 255},   {219, 219}};
    for (size_t i = 0; i < sizeof xy / sizeof *xy; i++)
        add_texel(points, mirrored, (int[3]){xy[i][0], xy[i][1], 128});
    static const int inside[][2] = {{128, 128}, {160, 100}, {100, 150}, {128, 192},
                                    {64, 128},  {80, 75},   {200, 170}, {220, 100}};
    for (size_t i = 0; i < sizeof inside / sizeof *inside; i++) {
        const double x = (inside[i][0] - 128) / 127.0, y = (inside[i][1] - 128) / 127.0;
        const double z = sqrt(1 - x * x - y * y);
        struct sb_point *point =
            add_texel(points, mirrored, (int[3]){inside[i][0], inside[i][1], 128});
        point->texel[SB_MAP_NORMAL][2] = (float)((128 + 127 * z) / 255); // not of 8 bits
    }
}

// The eye around the mirrored direction, where a highlight is steep.
void sb_vectors_flat_bumps(struct sb_points *points,
                           const struct sb_case_setting *setting)
{
    (void)setting;
    for (int i = -8; i <= 8; i++)
        for (int j = -8; j <= 8; j++) {
            const struct sb_vec3 eye = {mirrored.x + i / 64.0, mirrored.y + j / 64.0,
                                        mirrored.z};
            add_texel(points, eye, (int[3]){128, 128, 255})->material.shininess = 256;
        }
}
