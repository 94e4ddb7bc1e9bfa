// The atmospheres that the text of `containers` leaves as an exercise: the lights of a scene
// keep their places and how bright they are to each other; their colours and the background
// change. The numbers are ours.
#include "scene/make.h"

enum { POINT_COLOURS = 4 }; // in turn

// Factors for the largest component of a light's own colour. None is 0, so that no surface
// is blind to a light.
struct atmosphere {
    struct sb_vec3 ambient, diffuse,
        specular;                        // of directional lights; of the scene: ambient
    struct sb_vec3 point[POINT_COLOURS]; // of area lights too
    struct sb_vec3 spot;
    struct sb_vec3 clear; // as it is
};

// clang-format off
static const struct atmosphere atmospheres[SB_ATMOSPHERE_VALUE_COUNT] = {
    [SB_ATMOSPHERE_DESERT] = {
        .ambient = {2, 1.6, 1}, .diffuse = {1.8, 1.1, 0.7}, .specular = {1.2, 1, 0.8},
        .point = {{1, 0.6, 0.1}, {1, 0.25, 0.1}, {1, 0.9, 0.2}, {0.9, 0.5, 0.3}},
        .spot = {0.9, 0.8, 0.1},
        .clear = {0.74, 0.53, 0.31},
    },
    [SB_ATMOSPHERE_FACTORY] = {
        .ambient = {0.8, 0.9, 1.6}, .diffuse = {0.4, 0.5, 1.4}, .specular = {1.1, 1.2, 1.4},
        .point = {{0.2, 0.25, 0.7}, {0.3, 0.35, 0.8}, {0.1, 0.12, 0.4}, {0.4, 0.42, 0.5}},
        .spot = {0.9, 0.95, 1},
        .clear = {0.09, 0.1, 0.13},
    },
    [SB_ATMOSPHERE_HORROR] = {
        .ambient = {0.3, 0.25, 0.25}, .diffuse = {0.16, 0.14, 0.14}, .specular = {0.4, 0.35, 0.35},
        .point = {{0.35, 0.06, 0.05}, {0.2, 0.1, 0.1}, {0.5, 0.08, 0.06}, {0.25, 0.05, 0.05}},
        .spot = {1, 0.95, 0.85},
        .clear = {0, 0, 0},
    },
    [SB_ATMOSPHERE_LAB] = {
        .ambient = {2, 2, 1.9}, .diffuse = {2, 2, 1.9}, .specular = {1.6, 1.6, 1.6},
        .point = {{0.4, 0.8, 0.1}, {0.3, 0.9, 0.25}, {0.5, 1, 0.2}, {0.35, 0.7, 0.1}},
        .spot = {0.3, 1, 0.25},
        .clear = {0.9, 0.9, 0.88},
    },
};
// clang-format on

// The row that the variant asks for, or NULL for the scene's own colours.
static const struct atmosphere *asked(const struct sb_variant *variant)
{
    const int value = (int)variant->value[SB_AXIS_ATMOSPHERE];
    return value == SB_ATMOSPHERE_OWN ? NULL : &atmospheres[value];
}

static void tint(struct sb_vec3 *colour, struct sb_vec3 factor)
{
    *colour = sb_vec3_scale(factor, fmax(colour->x, fmax(colour->y, colour->z)));
}

void sb_light_tint(struct sb_light_params *light, enum sb_light_type type, int i,
                   const struct sb_variant *variant)
{
    const struct atmosphere *row = asked(variant);
    if (!row)
        return;
    const struct sb_vec3 one =
        type == SB_LIGHT_SPOT ? row->spot : row->point[i % POINT_COLOURS];
    const bool dir = type == SB_LIGHT_DIR;
    tint(&light->ambient, dir ? row->ambient : one);
    tint(&light->diffuse, dir ? row->diffuse : one);
    tint(&light->specular, dir ? row->specular : one);
}

void sb_background_tint(struct sb_vec3 *ambient, struct sb_vec3 *clear,
                        const struct sb_variant *variant)
{
    const struct atmosphere *row = asked(variant);
    if (!row)
        return;
    tint(ambient, row->ambient);
    *clear = row->clear;
}
