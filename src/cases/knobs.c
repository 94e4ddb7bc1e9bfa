#include "cases/knobs.h"

#include <math.h>

// clang-format off
#define OF_POINT(member, components, low, high, sign, zero) \
    {#member, false, offsetof(struct sb_point, member), components, low, high, sign, zero}
#define OF_LIGHT(member, components, low, high, sign, zero) \
    {"light->" #member, true, offsetof(struct sb_light, member), components, low, high, sign, zero}

// Lengths from a thousandth of a unit to a thousand, so that most pairs of points can be told apart
// in binary32; angles from a thousandth of a degree; exponents from 1, below which the power of a
// cosine is nearly a step.
const struct sb_knob sb_knobs[] = {
    OF_POINT(position,           3, 1e-3, 1e3,   true,  true),
    OF_POINT(normal,             3, 1e-3, 1,     true,  true),
    OF_POINT(eye,                3, 1e-3, 1e3,   true,  true),
    OF_POINT(tangent,            3, 1e-3, 1,     true,  true),
    OF_POINT(bitangent,          3, 1e-3, 1,     true,  true),
    OF_POINT(material.diffuse,   3, 1e-3, 1,     false, true),
    OF_POINT(material.specular,  3, 1e-3, 1,     false, true),
    OF_POINT(material.shininess, 1, 1, 1e6,   false, false),
    OF_POINT(texel[SB_MAP_NORMAL], 3, 1e-3, 1,   false, true),
    OF_LIGHT(position,           3, 1e-3, 1e3,   true,  true),
    OF_LIGHT(direction,          3, 1e-3, 1,     true,  true),
    OF_LIGHT(diffuse,            3, 1e-3, 1,     false, true),
    OF_LIGHT(specular,           3, 1e-3, 1,     false, true),
    OF_LIGHT(constant,           1, 1e-6, 1e3,   false, true),
    OF_LIGHT(linear,             1, 1e-6, 1e3,   false, true),
    OF_LIGHT(quadratic,          1, 1e-6, 1e3,   false, true),
    OF_LIGHT(range,              1, 1e-3, 1e4,   false, false),
    OF_LIGHT(cutoff,             1, 2e-5, 3.1,   false, false),
    OF_LIGHT(inner,              1, 2e-5, 3.1,   false, true),
    OF_LIGHT(exponent,           1, 1e-3, 1e4,   false, true),
    OF_LIGHT(radius,             1, 1e-6, 1e3,   false, true),
    OF_LIGHT(extent,             3, 1e-6, 1e3,   false, true),
};
// clang-format on
const int sb_knob_count = sizeof sb_knobs / sizeof *sb_knobs;

float *sb_knob_of(const struct sb_points *points, int point, const struct sb_knob *knob,
                  int c)
{
    char *owner = knob->of_light ? (char *)sb_points_light(points, point, 0)
                                 : (char *)&points->point[point];
    return (float *)(owner + knob->offset) + c;
}

double sb_knob_draw(const struct sb_knob *knob, struct sb_random *random)
{
    if (knob->zero && sb_random_below(random, 4) == 0)
        return 0;
    const double size = knob->low * pow(knob->high / knob->low, sb_random_unit(random));
    return knob->sign && sb_random_below(random, 2) ? -size : size;
}

double sb_knob_turn(const struct sb_knob *knob, double value, struct sb_random *random)
{
    const double how = sb_random_unit(random), way = 2 * sb_random_unit(random) - 1;
    if (value == 0 || how < 0.1)
        return sb_knob_draw(knob, random);
    const double turned =
        how < 0.6 ? value * exp2(4 * way * way * way) : value * (1 + ldexp(way, -20));
    const double size = fmin(fmax(fabs(turned), knob->low), knob->high);
    return copysign(size, value);
}

static bool is_zero(const float v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

void sb_knobs_settle(struct sb_points *points, int point)
{
    for (int i = 0; i < points->lights; i++) {
        struct sb_light *light = sb_points_light(points, point, i);
        const enum sb_light_type type = points->type[i];
        if (light->constant == 0 && light->linear == 0 && light->quadratic == 0)
            light->constant = 1;
        if (is_zero(light->direction) && type != SB_LIGHT_AREA)
            light->direction[2] = -1;
        if (type == SB_LIGHT_SPOT) {
            struct sb_vec3 axis = {light->direction[0], light->direction[1],
                                   light->direction[2]};
            axis = sb_vec3_normalise(axis);
            light->direction[0] = (float)axis.x;
            light->direction[1] = (float)axis.y;
            light->direction[2] = (float)axis.z;
        }
        sb_light_set_cone(light, fmin(light->inner, light->cutoff), light->cutoff);
    }
}
