// "Let there be even more light", the LWJGL book: calcLightColour, calcPointLight,
// calcDirectionalLight, the cone of its spot lights and its main(). View space.
//
// Slips: camera_pos is the world-space place of the camera, and positions are in view space;
// the direction of directional lights is handed over as it is, without the view transform.
#include "sources.h"

struct point { // the arguments that calcLightColour has for all lights
    struct vec position, normal, camera_pos;
    struct vec diffuse_c, specular_c;
    double specular_power;
};

static struct vec calc_light_colour(const struct dump_light *light,
                                    const struct point *at, struct vec to_light_dir)
{
    const double diffuse_factor = fmax(dot(at->normal, to_light_dir), 0);
    const struct vec diffuse =
        scaled(times(at->diffuse_c, light->diffuse), diffuse_factor);

    const struct vec camera_direction = normalize(minus(at->camera_pos, at->position));
    const struct vec reflected = normalize(reflect(scaled(to_light_dir, -1), at->normal));
    const double factor =
        pow(fmax(dot(camera_direction, reflected), 0), at->specular_power);
    return add(diffuse, scaled(times(at->specular_c, light->specular), factor));
}

// Of a point light, and of the point light that a spot light holds.
static struct vec calc_point_light(const struct dump *dump,
                                   const struct dump_light *light, const struct point *at)
{
    const struct vec way = minus(transform(dump->view, light->position, 1), at->position);
    const double distance = length(way);
    const double attenuation_inv = light->constant + light->linear * distance +
                                   light->quadratic * distance * distance;
    return scaled(calc_light_colour(light, at, normalize(way)), 1 / attenuation_inv);
}

static struct vec calc_spot_light(const struct dump *dump, const struct dump_light *light,
                                  const struct point *at)
{
    const struct vec from =
        minus(at->position, transform(dump->view, light->position, 1));
    const struct vec axis = normalize(transform(dump->view, light->direction, 0));
    const double cos_alpha = dot(normalize(from), axis), cos_cutoff = cos(light->cutoff);
    if (cos_alpha <= cos_cutoff)
        return (struct vec){0, 0, 0};
    return scaled(calc_point_light(dump, light, at),
                  1 - (1 - cos_alpha) / (1 - cos_cutoff));
}

struct vec formula_lwjgl(const struct dump *dump, const struct surface *at,
                         bool as_written, struct decisions *made)
{
    (void)made; // the cone ends at 0, so nothing jumps
    const struct vec texture = diffuse_texel(dump, at), origin = {0, 0, 0};
    const struct point here = {
        .position = transform(dump->view, at->position, 1),
        .normal = transform(dump->view, at->normal, 0),
        .camera_pos = as_written ? dump->eye : origin,
        .diffuse_c = times(at->material->diffuse, texture),
        .specular_c = times(at->material->specular, specular_texel(dump, at)),
        .specular_power = at->material->shininess,
    };
    struct vec sum = times(times(at->material->ambient, texture), dump->ambient);
    for (int i = 0; i < dump->dir.count; i++) {
        const struct dump_light *light = &dump->dir.light[i];
        const struct vec to_light = scaled(light->direction, -1);
        sum = add(sum, calc_light_colour(
                           light, &here,
                           normalize(as_written ? to_light
                                                : transform(dump->view, to_light, 0))));
    }
    for (int i = 0; i < dump->point.count; i++)
        if (dump->point.light[i].intensity > 0)
            sum = add(sum, calc_point_light(dump, &dump->point.light[i], &here));
    for (int i = 0; i < dump->spot.count; i++)
        if (dump->spot.light[i].intensity > 0)
            sum = add(sum, calc_spot_light(dump, &dump->spot.light[i], &here));
    return sum;
}
