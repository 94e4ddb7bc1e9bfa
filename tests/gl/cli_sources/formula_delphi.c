// "Multiple Lights", DelphiLearnOpenGL: CalcDirLight, CalcPointLight, and the CalcSpotLight
// that the text leaves as an exercise, made from its chapter on light casters (a soft edge
// between the cosines of two angles). World space. It has no slip.
#include "sources.h"

struct material_here { // the text's maps hold the material's colours
    struct vec ambient, diffuse, specular;
    double shininess;
};

static struct vec combine(const struct dump_light *light, const struct material_here *m,
                          struct vec light_dir, struct vec normal, struct vec view_dir,
                          double factor)
{
    const double diff = fmax(dot(normal, light_dir), 0);
    const struct vec reflect_dir = reflect(scaled(light_dir, -1), normal);
    const double spec = pow(fmax(dot(view_dir, reflect_dir), 0), m->shininess);
    const struct vec ambient = times(light->ambient, m->ambient);
    const struct vec diffuse = scaled(times(light->diffuse, m->diffuse), diff);
    const struct vec specular = scaled(times(light->specular, m->specular), spec);
    return scaled(add(ambient, add(diffuse, specular)), factor);
}

static double attenuation(const struct dump_light *light, double distance)
{
    return 1 / (light->constant + light->linear * distance +
                light->quadratic * (distance * distance));
}

struct vec formula_delphi(const struct dump *dump, const struct surface *at,
                          bool as_written, struct decisions *made)
{
    (void)as_written;
    (void)made;
    const struct vec norm = normalize(at->normal);
    const struct vec view_dir = normalize(minus(dump->eye, at->position));
    const struct vec diffuse_map = diffuse_texel(dump, at);
    const struct material_here m = {
        .ambient = times(at->material->ambient, diffuse_map),
        .diffuse = times(at->material->diffuse, diffuse_map),
        .specular = times(at->material->specular, specular_texel(dump, at)),
        .shininess = at->material->shininess,
    };
    struct vec result = {0, 0, 0};
    for (int i = 0; i < dump->dir.count; i++) {
        const struct dump_light *light = &dump->dir.light[i];
        result = add(result, combine(light, &m, normalize(scaled(light->direction, -1)),
                                     norm, view_dir, 1));
    }
    for (int i = 0; i < dump->point.count; i++) {
        const struct dump_light *light = &dump->point.light[i];
        const struct vec to = minus(light->position, at->position);
        result = add(result, combine(light, &m, normalize(to), norm, view_dir,
                                     attenuation(light, length(to))));
    }
    for (int i = 0; i < dump->spot.count; i++) {
        const struct dump_light *light = &dump->spot.light[i];
        const struct vec to = minus(light->position, at->position);
        const double theta = dot(normalize(to), normalize(scaled(light->direction, -1)));
        const double epsilon = cos(light->inner) - cos(light->cutoff);
        const double intensity = fmin(fmax((theta - cos(light->cutoff)) / epsilon, 0), 1);
        result = add(result, combine(light, &m, normalize(to), norm, view_dir,
                                     attenuation(light, length(to)) * intensity));
    }
    return result;
}
