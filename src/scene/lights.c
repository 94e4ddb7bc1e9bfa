#include "scene/lights.h"

#include <assert.h>
#include <math.h>

#include "math/mat.h"

// --- the members, for whoever sets, prints or checks them one at a time ----------------

// A member is there where some formula of the variant reads it. The conditions name the values
// that do not: a new law, cone or shape has all members until its row here says otherwise. Of a
// formula with two forms both are compiled, and so have their members but for the smooth cone's,
// of which hoist/once.glsl names the one form's only.
// clang-format off
#define FIELD(name, components, range, when) \
    {#name, offsetof(struct sb_light, name), components, range, when}

#define DIRECTION(when) FIELD(direction, 3, SB_FINITE, when)
#define INTENSITY       FIELD(intensity, 1, SB_NOT_NEGATIVE, "loop=padded")
#define AMBIENT         FIELD(ambient,   3, SB_NOT_NEGATIVE, "ambient!=none,ambient!=scene")
#define DIFFUSE         FIELD(diffuse,   3, SB_NOT_NEGATIVE, "")
#define SPECULAR        FIELD(specular,  3, SB_NOT_NEGATIVE, "model!=lambert")
#define POSITION        FIELD(position,  3, SB_PLACE,  "")
#define RANGE           FIELD(range,     1, SB_NOT_NEGATIVE, \
    "shadows>0|attenuation!=none,attenuation!=polynomial")

// A float behind a vec3 shares its 16 bytes in std140.
#define POLYNOMIAL "attenuation!=none,attenuation!=radius,attenuation!=windowed"
#define COLOURS_AND_ATTENUATION \
    AMBIENT,  FIELD(constant,  1, SB_NOT_NEGATIVE, POLYNOMIAL), \
    DIFFUSE,  FIELD(linear,    1, SB_NOT_NEGATIVE, POLYNOMIAL), \
    SPECULAR, FIELD(quadratic, 1, SB_NOT_NEGATIVE, POLYNOMIAL)

#define RAMP "cone!=hard,cone!=exponent,cone!=linear"
#define CONE \
    DIRECTION(""), \
    FIELD(cos_cutoff,        1, SB_COSINE, \
          "layout=unified|hoist=once,cone!=smooth|hoist=once,f_cone=naive"), \
    FIELD(cos_inner,         1, SB_FINITE,       "hoist=once,f_cone=naive," RAMP), \
    FIELD(exponent,          1, SB_NOT_NEGATIVE, "cone!=hard,cone!=linear,cone!=smooth"), \
    FIELD(inv_one_minus_cos, 1, SB_NOT_NEGATIVE, \
          "hoist=once,cone!=hard,cone!=exponent,cone!=smooth"), \
    FIELD(cone_scale,        1, SB_NOT_NEGATIVE, "hoist=once,f_cone=robust," RAMP), \
    FIELD(cone_offset,       1, SB_FINITE,       "hoist=once,f_cone=robust," RAMP), \
    INTENSITY, \
    FIELD(cutoff,            1, SB_HALF_ANGLE, \
          "hoist=per_light|cone!=exponent,cone!=linear,cone!=smooth"), \
    FIELD(inner,             1, SB_HALF_ANGLE,   "hoist=per_light," RAMP)

static const struct sb_light_field dir_fields[] = {
    DIRECTION(""), INTENSITY, AMBIENT, DIFFUSE, SPECULAR,
};
static const struct sb_light_field point_fields[] = {
    POSITION, RANGE, COLOURS_AND_ATTENUATION, INTENSITY,
};
static const struct sb_light_field spot_fields[] = {
    POSITION, RANGE, COLOURS_AND_ATTENUATION, CONE,
};
static const struct sb_light_field area_fields[] = {
    POSITION, RANGE, COLOURS_AND_ATTENUATION,
    DIRECTION("area_shape!=sphere,area_shape!=box"),
    FIELD(radius, 1, SB_NOT_NEGATIVE, "area_shape!=tube,area_shape!=box"),
    FIELD(extent, 3, SB_NOT_NEGATIVE,
          "area_shape!=sphere,area_shape!=tube,area_shape!=capsule"),
    INTENSITY,
};
// By w and cos_cutoff its types are told apart.
static const struct sb_light_field unified_fields[] = {
    POSITION, FIELD(w, 1, SB_NOT_NEGATIVE, ""), COLOURS_AND_ATTENUATION, CONE, RANGE,
};
static_assert(sizeof unified_fields / sizeof *unified_fields <= SB_LIGHT_FIELD_MAX,
              "room for the largest struct");

#define ROW(name, type, element, stem, axis) \
    {name, type, element, "u_" #stem, "u_" #stem "_count", stem##_fields, \
     (int)(sizeof stem##_fields / sizeof *stem##_fields), axis}
#define light_fields unified_fields

const struct sb_light_struct sb_light_structs[SB_LIGHT_STRUCT_COUNT] = {
    [SB_LIGHT_DIR]     = ROW("directional light", "DirLight",   "DIR_LIGHT",   dir,   SB_AXIS_DIR),
    [SB_LIGHT_POINT]   = ROW("point light",       "PointLight", "POINT_LIGHT", point, SB_AXIS_POINT),
    [SB_LIGHT_SPOT]    = ROW("spot light",        "SpotLight",  "SPOT_LIGHT",  spot,  SB_AXIS_SPOT),
    [SB_LIGHT_AREA]    = ROW("area light",        "AreaLight",  "AREA_LIGHT",  area,  SB_AXIS_AREA),
    [SB_LIGHT_UNIFIED] = ROW("light",             "Light",      "LIGHT",       light, -1),
};
// clang-format on

int sb_light_struct_of(const struct sb_variant *variant, enum sb_light_type type)
{
    const bool unified = variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
    return unified ? SB_LIGHT_UNIFIED : (int)type;
}

static size_t round_up(size_t size, size_t unit)
{
    return (size + unit - 1) / unit * unit;
}

void sb_light_members_of(const struct sb_light_struct *row,
                         const struct sb_variant *variant,
                         struct sb_light_members *members)
{
    members->count = 0;
    for (int f = 0; f < row->field_count; f++)
        if (sb_condition_holds(sb_axes_builtin(), row->field[f].when, variant))
            members->field[members->count++] = &row->field[f];
}

// Where the members before number `end` end; the alignment of each is 16 for a vec3, 4 for a
// float.
static size_t std140_end(const struct sb_light_members *members, int end)
{
    size_t at = 0;
    for (int i = 0; i < end; i++) {
        const int components = members->field[i]->components;
        at = round_up(at, components == 1 ? 4 : 16) + 4 * (size_t)components;
    }
    return at;
}

size_t sb_light_std140_offset(const struct sb_light_members *members, int number)
{
    return round_up(std140_end(members, number),
                    members->field[number]->components == 1 ? 4 : 16);
}

size_t sb_light_std140_size(const struct sb_light_members *members)
{
    return round_up(std140_end(members, members->count), 16);
}

// --- lists -----------------------------------------------------------------------------

const struct sb_light *sb_lights_of(const struct sb_lights *lights,
                                    enum sb_light_type type, int *count)
{
    const struct sb_light *light = lights->light;
    for (int t = 0; t < (int)type; t++)
        light += lights->count[t];
    *count = lights->count[type];
    return light;
}

int sb_lights_total(const struct sb_lights *lights)
{
    int total = 0;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        total += lights->count[t];
    return total;
}

int sb_lights_shining(const struct sb_variant *variant, enum sb_light_type type)
{
    const int asked = (int)variant->value[sb_light_structs[type].axis];
    const bool night = variant->value[SB_AXIS_SUN] > 90;
    return type == SB_LIGHT_DIR && night && asked > 0 ? asked - 1 : asked;
}

int sb_lights_slots(const struct sb_variant *variant, enum sb_light_type type)
{
    const int asked = (int)variant->value[sb_light_structs[type].axis];
    const int capacity = (int)variant->value[SB_AXIS_CAPACITY];
    const int loop = (int)variant->value[SB_AXIS_LOOP];
    if (loop != SB_LOOP_DYNAMIC && loop != SB_LOOP_PADDED)
        return sb_lights_shining(variant, type);
    if (type == SB_LIGHT_DIR) // the slot of a sun that is down stays
        return asked;
    if (variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED)
        return asked; // free slots are of no type
    // No room for a type that the scene has none of: it would be paid for in each fragment.
    return asked > 0 && capacity > asked ? capacity : asked;
}

int sb_lights_unified_slots(const struct sb_variant *variant)
{
    const int capacity = (int)variant->value[SB_AXIS_CAPACITY];
    const int loop = (int)variant->value[SB_AXIS_LOOP];
    int slots = 0;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        slots += sb_lights_slots(variant, (enum sb_light_type)t);
    const bool roomy = loop == SB_LOOP_DYNAMIC || loop == SB_LOOP_PADDED;
    const bool unified = variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
    return roomy && unified && capacity > slots ? capacity : slots;
}

// --- making them -----------------------------------------------------------------------

// The float nearest to a quarter turn is a little more than one: its cosine of -4.4e-8 would light
// what a quarter turn only grazes.
static double cone_cosine(double angle)
{
    return (float)angle == (float)(SB_PI / 2) ? 0 : cos(angle);
}

static void set_no_cone(struct sb_light *light)
{
    light->cos_cutoff = SB_COS_NO_CONE;
    light->cos_inner = -1;
    light->exponent = 0;
    light->inv_one_minus_cos = 0;
    light->cone_scale = 0;
    light->cone_offset = 1;
}

void sb_light_set_cone(struct sb_light *light, double inner, double outer)
{
    const double cos_inner = cone_cosine(inner), cos_outer = cone_cosine(outer);
    const double half = sin(outer / 2);
    const double scale = 1 / fmax(cos_inner - cos_outer, 1.0 / 1024);
    light->cutoff = (float)outer;
    light->inner = (float)inner;
    light->cos_cutoff = (float)cos_outer;
    light->cos_inner = (float)cos_inner;
    light->inv_one_minus_cos = (float)(1 / (2 * half * half)); // 1 - cos a = 2 sin^2(a/2)
    light->cone_scale = (float)scale;
    light->cone_offset = (float)(-cos_outer * scale);
    if (light->cutoff >= (float)SB_PI)
        set_no_cone(light);
}

struct sb_light sb_light_unified(const struct sb_light *light, enum sb_light_type type)
{
    struct sb_light unified = *light;
    unified.w = type == SB_LIGHT_DIR ? 0 : 1;
    if (type == SB_LIGHT_DIR) {
        const float *d = light->direction;
        const double length =
            sb_vec3_length((struct sb_vec3){d[0], d[1], d[2]}); // of any, and not 0
        for (int i = 0; i < 3; i++)
            unified.position[i] = (float)(-d[i] / length);
        unified.constant = 1; // a shader that masks must not divide by 0
    }
    if (type != SB_LIGHT_SPOT) { // no cone: the cosine of half a turn, and 1 by every law
        unified.cutoff = (float)SB_PI;
        unified.inner = (float)SB_PI;
        unified.cos_cutoff = -1;
        unified.cos_inner = -1;
        unified.exponent = 0;
        unified.inv_one_minus_cos = 0;
        unified.cone_scale = 0;
        unified.cone_offset = 1;
    }
    return unified;
}
