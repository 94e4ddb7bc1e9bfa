// "Dynamic Point Lighting": GetNormal, Spec, Intensity and main() for each light. World space.
// Whether a point is lit is not looked up, but found by a ray to the light.
//
// Slips: Intensity() stands inside the power and again outside; highlights are tinted by the
// diffuse map.
#include "sources.h"

// Distance between the points of a surface that neighbouring texels of the map see.
static double texel_width(const struct dump *dump, struct vec from_light)
{
    const double main_axis =
        fmax(fabs(from_light.x), fmax(fabs(from_light.y), fabs(from_light.z)));
    return 2 * main_axis / dump->shadow_size;
}

static bool is_lit(const struct dump *dump, struct vec point,
                   const struct dump_light *light, struct decisions *made)
{
    const double distance = length(minus(light->position, point));
    const double bias = dump->shadow_bias * light->range;
    double nearest;
    const bool blocked =
        trace_blocked(dump, point, light->position, 1e-6 * distance, &nearest);
    // What is nearer to the point than the bias does not darken it in the map.
    made->doubtful |= blocked && nearest < 2 * bias;
    return !blocked;
}

static double visible(const struct dump *dump, const struct surface *at,
                      const struct dump_light *light, struct decisions *made)
{
    const struct vec from_light = minus(at->position, light->position);
    const double width = texel_width(dump, from_light);
    const double cosine = fabs(dot(at->facet, normalize(from_light)));
    const double bias = dump->shadow_bias * light->range;
    const bool lit = is_lit(dump, at->position, light, made);
    // The texel's distance is that of a point up to a texel aside, which on a slope is nearer.
    const double slope = sqrt(1 - cosine * cosine) / fmax(cosine, 1e-9);
    made->doubtful |= 1.5 * width * slope > bias;
    // The map knows the edge of a shadow to a texel or so.
    const struct vec aside =
        normalize(cross(at->facet, fabs(at->facet.x) < 0.9 ? (struct vec){1, 0, 0}
                                                           : (struct vec){0, 1, 0}));
    const struct vec across = cross(at->facet, aside);
    const double reach = 2 * width / fmax(cosine, 1e-9);
    for (int i = 0; i < 4; i++) {
        const struct vec way = i < 2 ? aside : across;
        const struct vec moved = add(at->position, scaled(way, i % 2 ? reach : -reach));
        made->doubtful |= is_lit(dump, moved, light, made) != lit;
    }
    return decide(made, lit) ? 1 : 0;
}

static struct vec get_normal(const struct dump *dump, const struct surface *at)
{
    const struct vec n = normalize(at->normal);
    if (!dump->has_normal_map)
        return n;
    const struct vec bump = texel(&dump->normal_map, at->u, at->v);
    return normalize(add(scaled(normalize(at->tangent), bump.x * 2 - 1),
                         add(scaled(normalize(at->bitangent), bump.y * 2 - 1),
                             scaled(n, bump.z * 2 - 1))));
}

struct vec formula_shadows(const struct dump *dump, const struct surface *at,
                           bool as_written, struct decisions *made)
{
    const struct vec normal = get_normal(dump, at), white = {1, 1, 1};
    const struct vec tex_col = diffuse_texel(dump, at);
    const struct dump_material *material = at->material;
    struct vec col = {0, 0, 0};
    for (int i = 0; i < dump->point.count; i++) {
        const struct dump_light *light = &dump->point.light[i];
        const struct vec to = minus(light->position, at->position);
        // The light's brightness is part of its colours.
        const double v = fmax(1 - length(to) / light->range, 0);
        const bool shadowed = dump->shadow_size > 0 && v > 0;
        const double intensity = shadowed ? v * visible(dump, at, light, made) : v;

        const double d = fmax(0, dot(normal, normalize(to)));
        const struct vec e = normalize(minus(dump->eye, at->position));
        const struct vec r = reflect(scaled(normalize(to), -1), normal);
        const double s = fmax(0, dot(e, r) * (as_written ? intensity : 1));
        const double spe = pow(s, material->shininess);
        const struct vec diffuse =
            scaled(times(tex_col, times(material->diffuse, light->diffuse)), d);
        const struct vec specular =
            scaled(times(as_written ? tex_col : white,
                         times(material->specular, light->specular)),
                   spe);
        col = add(col, scaled(add(diffuse, specular), intensity));
    }
    return col;
}
