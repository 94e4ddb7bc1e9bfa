#include "scene/lights.h"

#include <assert.h>
#include <math.h>

#include "axis/axis.h"

// --- the members, for whoever sets or checks them one at a time ------------------------

// clang-format off
#define FIELD(type, name, components, range) \
    {#name, offsetof(struct sb_##type##_light, name), components, range}

static const struct sb_light_field dir_fields[] = {
    FIELD(dir, direction, 3, SB_FINITE),
    FIELD(dir, pad0,      1, SB_FINITE),
    FIELD(dir, ambient,   3, SB_NOT_NEGATIVE),
    FIELD(dir, pad1,      1, SB_FINITE),
    FIELD(dir, diffuse,   3, SB_NOT_NEGATIVE),
    FIELD(dir, pad2,      1, SB_FINITE),
    FIELD(dir, specular,  3, SB_NOT_NEGATIVE),
    FIELD(dir, pad3,      1, SB_FINITE),
};

#define POINT_FIELDS(type) \
    FIELD(type, position,  3, SB_FINITE), \
    FIELD(type, range,     1, SB_NOT_NEGATIVE), \
    FIELD(type, ambient,   3, SB_NOT_NEGATIVE), \
    FIELD(type, constant,  1, SB_NOT_NEGATIVE), \
    FIELD(type, diffuse,   3, SB_NOT_NEGATIVE), \
    FIELD(type, linear,    1, SB_NOT_NEGATIVE), \
    FIELD(type, specular,  3, SB_NOT_NEGATIVE), \
    FIELD(type, quadratic, 1, SB_NOT_NEGATIVE)

static const struct sb_light_field point_fields[] = {
    POINT_FIELDS(point),
};

static const struct sb_light_field spot_fields[] = {
    POINT_FIELDS(spot),
    FIELD(spot, direction,         3, SB_FINITE),
    FIELD(spot, cos_cutoff,        1, SB_COSINE),
    FIELD(spot, exponent,          1, SB_NOT_NEGATIVE),
    FIELD(spot, inv_one_minus_cos, 1, SB_NOT_NEGATIVE),
    FIELD(spot, cone_scale,        1, SB_NOT_NEGATIVE),
    FIELD(spot, cone_offset,       1, SB_FINITE),
};

#define ROW(type, name, axis) \
    {name, "u_" #type, sizeof(struct sb_##type##_light), type##_fields, \
     (int)(sizeof type##_fields / sizeof *type##_fields), axis}

const struct sb_light_type_row sb_light_types[SB_LIGHT_TYPE_COUNT] = {
    [SB_LIGHT_DIR]   = ROW(dir,   "directional light", SB_AXIS_DIR),
    [SB_LIGHT_POINT] = ROW(point, "point light",       SB_AXIS_POINT),
    [SB_LIGHT_SPOT]  = ROW(spot,  "spot light",        SB_AXIS_SPOT),
};
// clang-format on

// OpenGL 4.6 core, 7.6.2.2, rules 9 and 10: the stride of an array of structs is a
// multiple of 16 bytes, and in C the stride is the size.
static_assert(sizeof(struct sb_dir_light) == 64, "std140");
static_assert(sizeof(struct sb_point_light) == 64, "std140");
static_assert(sizeof(struct sb_spot_light) == 96, "std140");

const void *sb_lights_of(const struct sb_lights *lights, enum sb_light_type type,
                         int *count)
{
    switch (type) {
    case SB_LIGHT_DIR:
        *count = lights->dir_count;
        return lights->dir;
    case SB_LIGHT_POINT:
        *count = lights->point_count;
        return lights->point;
    case SB_LIGHT_SPOT:
        *count = lights->spot_count;
        return lights->spot;
    default:
        *count = 0;
        return NULL;
    }
}

void sb_spot_light_set_cone(struct sb_spot_light *light, double inner, double outer)
{
    const double cos_inner = cos(inner), cos_outer = cos(outer), half = sin(outer / 2);
    const double scale = 1 / fmax(cos_inner - cos_outer, 1.0 / 1024);
    light->cos_cutoff = (float)cos_outer;
    light->inv_one_minus_cos = (float)(1 / (2 * half * half)); // 1 - cos a = 2 sin^2(a/2)
    light->cone_scale = (float)scale;
    light->cone_offset = (float)(-cos_outer * scale);
}
