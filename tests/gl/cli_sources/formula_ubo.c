// Lights and materials in uniform blocks: pointLight() for each of num_lights. View space.
//
// Slips: the power takes normal * reflection where it should take view * reflection; diffuse
// light takes the normal as it was interpolated, not of unit length. (The output that the sum
// starts from is never set; a driver that gives it 0 shows nothing of that.)
#include "sources.h"

static struct vec point_light(const struct dump *dump, const struct surface *at,
                              const struct dump_light *light, bool as_written,
                              struct decisions *made)
{
    const struct vec v_position = transform(dump->view, at->position, 1);
    const struct vec v_normal = transform(dump->view, at->normal, 0);
    const struct dump_material *material = at->material;
    struct vec vp = minus(transform(dump->view, light->position, 1), v_position);
    const double d = length(vp);
    vp = normalize(vp);
    const double attenuation =
        1 / (light->constant + light->linear * d + light->quadratic * d * d);
    const struct vec reflection = normalize(reflect(scaled(vp, -1), normalize(v_normal)));
    const struct vec view = normalize(scaled(v_position, -1));

    const double n_dot_vp = fmax(0, dot(as_written ? v_normal : normalize(v_normal), vp));
    const double cosine =
        fmax(0, dot(as_written ? normalize(v_normal) : view, reflection));
    const double pf = decide(made, n_dot_vp == 0) ? 0 : pow(cosine, material->shininess);

    const struct vec ambient = times(material->ambient, light->ambient);
    const struct vec diffuse = scaled(times(material->diffuse, light->diffuse), n_dot_vp);
    const struct vec specular = scaled(times(material->specular, light->specular), pf);
    return scaled(add(ambient, add(diffuse, specular)), attenuation);
}

struct vec formula_ubo(const struct dump *dump, const struct surface *at, bool as_written,
                       struct decisions *made)
{
    struct vec colour = {0, 0, 0};
    for (int i = 0; i < dump->point.count; i++)
        colour =
            add(colour, point_light(dump, at, &dump->point.light[i], as_written, made));
    return colour;
}
