// From the scene's own units to what is uploaded.
#include "scene/make.h"

static void store(float out[3], struct sb_vec3 in)
{
    out[0] = (float)in.x;
    out[1] = (float)in.y;
    out[2] = (float)in.z;
}

static struct sb_light placed_light(const struct sb_light_params *params,
                                    enum sb_light_type type,
                                    const struct sb_placement *place)
{
    struct sb_light light = {
        .w = type == SB_LIGHT_DIR ? 0 : 1,
        .range = (float)(params->range * place->scale),
        .intensity = (float)params->intensity,
        .constant = (float)params->constant,
        .linear = (float)params->linear,
        .quadratic = (float)params->quadratic,
        .exponent = (float)params->exponent,
        .radius = (float)(params->radius * place->scale),
    };
    store(light.ambient, params->ambient);
    store(light.diffuse, params->diffuse);
    store(light.specular, params->specular);
    store(light.extent, sb_vec3_scale(params->extent, place->scale));
    struct sb_vec3 direction = params->direction;
    if (type == SB_LIGHT_SPOT) {
        direction = sb_vec3_normalise(direction);
        sb_light_set_cone(&light, params->inner, params->outer);
    } else if (type == SB_LIGHT_AREA) {
        direction = sb_vec3_scale(direction, place->scale);
    }
    store(light.direction, direction);
    if (type != SB_LIGHT_DIR)
        store(light.position, sb_placed(place, params->position));
    return light;
}

void sb_lights_make(struct sb_scene *scene, const struct sb_placement *place,
                    const sb_light_maker maker[SB_LIGHT_TYPE_COUNT],
                    const struct sb_variant *variant)
{
    struct sb_lights *lights = &scene->lights;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        lights->count[type] = sb_lights_shining(variant, type);
    struct sb_light *light =
        sb_arena_alloc(&scene->arena, (size_t)sb_lights_total(lights) * sizeof *light);
    lights->light = light;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        // A light that does not shine is the first of its type.
        const int asked = (int)variant->value[sb_light_structs[type].axis];
        for (int i = asked - lights->count[type]; i < asked; i++) {
            struct sb_light_params params = maker[type](i);
            params.intensity = 1;
            sb_light_tint(&params, type, i, variant);
            if (type == SB_LIGHT_DIR && i == 0)
                sb_light_follow_sun(&params, variant);
            *light++ = placed_light(&params, type, place);
        }
    }
}
