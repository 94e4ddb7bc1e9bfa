#include "scene/make.h"

struct sb_vec3 sb_light_spread(int i)
{
    // Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018), R3:
    // powers of the inverse of the root of x^4 = x + 1.
    const double a = 0.81917251339616443970, b = a * a, c = b * a;
    const double n = i + 1;
    return (struct sb_vec3){fmod(0.5 + n * a, 1), fmod(0.5 + n * b, 1),
                            fmod(0.5 + n * c, 1)};
}

struct sb_vec3 sb_light_cap(struct sb_vec3 axis, double cos_limit, double u, double v)
{
    // Archimedes: equal heights of a sphere have equal areas.
    const double height = 1 - u * (1 - cos_limit), radius = sqrt(1 - height * height);
    const double turn = 2 * SB_PI * v;
    const struct sb_vec3 z = sb_vec3_normalise(axis);
    const struct sb_vec3 x =
        sb_vec3_normalise(sb_vec3_cross((struct sb_vec3){0, 1, 0}, z));
    const struct sb_vec3 y = sb_vec3_cross(z, x);
    const struct sb_vec3 across = sb_vec3_add(sb_vec3_scale(x, radius * cos(turn)),
                                              sb_vec3_scale(y, radius * sin(turn)));
    return sb_vec3_add(sb_vec3_scale(z, height), across);
}

void sb_light_colour(struct sb_light_params *light, int i, double intensity)
{
    const double hue = fmod(i * 0.61803398874989484820, 1); // golden ratio
    const double third = 2 * SB_PI / 3, angle = 2 * SB_PI * hue;
    light->diffuse = (struct sb_vec3){intensity * (0.55 + 0.45 * cos(angle)),
                                      intensity * (0.55 + 0.45 * cos(angle - third)),
                                      intensity * (0.55 + 0.45 * cos(angle + third))};
    light->specular = light->diffuse;
    light->ambient = sb_vec3_scale(light->diffuse, 1.0 / 16);
}

struct sb_light_params sb_light_sun(void)
{
    return (struct sb_light_params){
        .direction = {-0.2, -1, -0.3}, // as in the text: not of unit length
        .ambient = {0.05, 0.05, 0.05},
        .diffuse = {0.4, 0.4, 0.4},
        .specular = {0.5, 0.5, 0.5},
    };
}

struct sb_light_params sb_light_from_front(int i)
{
    const struct sb_vec3 at = sb_light_spread(i);
    const struct sb_vec3 to_light =
        sb_light_cap((struct sb_vec3){0, 0, 1}, 0.5, at.x, at.y);
    struct sb_light_params light = {.direction = sb_vec3_scale(to_light, -1)};
    sb_light_colour(&light, i, 0.1);
    return light;
}

struct sb_light_params sb_light_above(int i, double room)
{
    const struct sb_vec3 at = sb_light_spread(i);
    struct sb_light_params light = {
        .position = {10 * (at.x - 0.5), 1.5 + room + at.y, 10 * (at.z - 0.5)},
        .range = 20,
        .constant = 1,
        .linear = 0.22,
        .quadratic = 0.2,
    };
    sb_light_colour(&light, i, 0.5);
    return light;
}

struct sb_light_params sb_light_torch(struct sb_vec3 eye)
{
    return (struct sb_light_params){
        .position = eye,
        .direction = {0, 0, -1},
        .diffuse = {1, 1, 1},
        .specular = {1, 1, 1},
        .range = 50,
        .constant = 1,
        .linear = 0.09,
        .quadratic = 0.032,
        .inner = 12.5 * SB_DEGREE,
        .outer = 15 * SB_DEGREE,
        .exponent = 8,
    };
}

void sb_light_shape(struct sb_light_params *light, int i)
{
    const double turn = i * SB_GOLDEN_ANGLE;
    light->direction =
        sb_vec3_scale((struct sb_vec3){cos(turn), 0.25 * sin(turn), sin(turn)}, 0.58);
    light->radius = 0.3;
    light->extent = (struct sb_vec3){0.3, 0.2, 0.4};
}
