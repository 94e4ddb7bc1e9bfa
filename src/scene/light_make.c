#include "scene/make.h"

#include <string.h>

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

// --- from the scene's own units to what is uploaded ------------------------------------

static void store(float out[3], struct sb_vec3 in)
{
    out[0] = (float)in.x;
    out[1] = (float)in.y;
    out[2] = (float)in.z;
}

static struct sb_dir_light dir_light(const struct sb_light_params *params)
{
    struct sb_dir_light light = {0};
    store(light.direction, params->direction);
    store(light.ambient, params->ambient);
    store(light.diffuse, params->diffuse);
    store(light.specular, params->specular);
    return light;
}

static struct sb_point_light point_light(const struct sb_light_params *params,
                                         const struct sb_placement *place)
{
    struct sb_point_light light = {
        .range = (float)(params->range * place->scale),
        .constant = (float)params->constant,
        .linear = (float)params->linear,
        .quadratic = (float)params->quadratic,
    };
    store(light.position, sb_placed(place, params->position));
    store(light.ambient, params->ambient);
    store(light.diffuse, params->diffuse);
    store(light.specular, params->specular);
    return light;
}

static struct sb_spot_light spot_light(const struct sb_light_params *params,
                                       const struct sb_placement *place)
{
    const struct sb_point_light point = point_light(params, place);
    struct sb_spot_light light = {0};
    memcpy(&light, &point, sizeof point); // the same members come first
    store(light.direction, sb_vec3_normalise(params->direction));
    light.exponent = (float)params->exponent;
    sb_spot_light_set_cone(&light, params->inner, params->outer);
    return light;
}

void sb_lights_make(struct sb_scene *scene, const struct sb_placement *place,
                    const sb_light_maker maker[SB_LIGHT_TYPE_COUNT],
                    const struct sb_variant *variant)
{
    const int dirs = (int)variant->value[SB_AXIS_DIR];
    const int points = (int)variant->value[SB_AXIS_POINT];
    const int spots = (int)variant->value[SB_AXIS_SPOT];
    struct sb_arena *arena = &scene->arena;
    struct sb_dir_light *dir = sb_arena_alloc(arena, (size_t)dirs * sizeof *dir);
    struct sb_point_light *point = sb_arena_alloc(arena, (size_t)points * sizeof *point);
    struct sb_spot_light *spot = sb_arena_alloc(arena, (size_t)spots * sizeof *spot);
    struct sb_light_params params;
    for (int i = 0; i < dirs; i++) {
        params = maker[SB_LIGHT_DIR](i);
        dir[i] = dir_light(&params);
    }
    for (int i = 0; i < points; i++) {
        params = maker[SB_LIGHT_POINT](i);
        point[i] = point_light(&params, place);
    }
    for (int i = 0; i < spots; i++) {
        params = maker[SB_LIGHT_SPOT](i);
        spot[i] = spot_light(&params, place);
    }
    scene->lights = (struct sb_lights){dir, point, spot, dirs, points, spots};
}
