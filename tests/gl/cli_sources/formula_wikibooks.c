// "Multiple Lights", GLSL Programming/GLUT: the loop over lights of one struct. World space. It
// has no slip.
#include "sources.h"

static const double pi = 3.14159265358979323846;

// A light with w = 0 (its position is the direction to it), without a cone where the cut-off
// angle is above 90 degrees.
static struct vec one_light(const struct dump *dump, const struct surface *at,
                            const struct dump_light *light, double w, double cutoff,
                            struct decisions *made)
{
    const struct dump_material *front = at->material;
    const struct vec normal_direction = normalize(at->normal);
    const struct vec view_direction = normalize(minus(dump->eye, at->position));
    struct vec light_direction;
    double attenuation;
    if (w == 0) {
        attenuation = 1;
        light_direction = normalize(scaled(light->direction, -1));
    } else {
        const struct vec to_source = minus(light->position, at->position);
        const double distance = length(to_source);
        light_direction = normalize(to_source);
        attenuation = 1 / (light->constant + light->linear * distance +
                           light->quadratic * distance * distance);
        if (cutoff <= pi / 2) {
            const double clamped_cosine =
                fmax(0, dot(scaled(light_direction, -1), normalize(light->direction)));
            if (decide(made, clamped_cosine < cos(cutoff)))
                attenuation = 0;
            else
                attenuation *= pow(clamped_cosine, light->exponent);
        }
    }
    const double n_dot_l = dot(normal_direction, light_direction);
    const struct vec diffuse =
        scaled(times(light->diffuse, times(front->diffuse, diffuse_texel(dump, at))),
               attenuation * fmax(0, n_dot_l));
    if (decide(made, n_dot_l < 0))
        return diffuse;
    const struct vec reflected = reflect(scaled(light_direction, -1), normal_direction);
    const double power = pow(fmax(0, dot(reflected, view_direction)), front->shininess);
    return add(diffuse, scaled(times(light->specular,
                                     times(front->specular, specular_texel(dump, at))),
                               attenuation * power));
}

struct vec formula_wikibooks(const struct dump *dump, const struct surface *at,
                             bool as_written, struct decisions *made)
{
    (void)as_written;
    struct vec total =
        times(dump->ambient, times(at->material->ambient, diffuse_texel(dump, at)));
    for (int i = 0; i < dump->dir.count; i++)
        total = add(total, one_light(dump, at, &dump->dir.light[i], 0, pi, made));
    for (int i = 0; i < dump->point.count; i++)
        total = add(total, one_light(dump, at, &dump->point.light[i], 1, pi, made));
    for (int i = 0; i < dump->spot.count; i++) {
        const struct dump_light *light = &dump->spot.light[i];
        total = add(total, one_light(dump, at, light, 1, light->cutoff, made));
    }
    return total;
}
