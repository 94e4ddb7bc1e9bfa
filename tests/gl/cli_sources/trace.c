// Rays through triangles in double: what a pixel shows, and what lies between two points.
#include "sources.h"

struct ray {
    struct vec from, way; // points are from + t way
};
struct meeting {
    double t, b, c; // barycentric weights of the second and third corner
};

// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
static bool meets(const struct ray *ray, const struct dump_corner *corner,
                  struct meeting *meeting)
{
    const struct vec ab = minus(corner[1].position, corner[0].position);
    const struct vec ac = minus(corner[2].position, corner[0].position);
    const struct vec p = cross(ray->way, ac);
    const double determinant = dot(ab, p);
    if (determinant == 0)
        return false;
    const struct vec s = minus(ray->from, corner[0].position);
    const double b = dot(s, p) / determinant;
    if (b < 0 || b > 1)
        return false;
    const struct vec q = cross(s, ab);
    const double c = dot(ray->way, q) / determinant;
    if (c < 0 || b + c > 1)
        return false;
    *meeting = (struct meeting){dot(ac, q) / determinant, b, c};
    return true;
}

static bool passes_by(const struct ray *ray, const struct dump_draw *draw)
{
    const struct vec to = minus(draw->centre, ray->from);
    const struct vec off = cross(to, normalize(ray->way));
    return dot(off, off) > 1.0001 * draw->radius * draw->radius;
}

static struct vec facet_normal(const struct dump_corner *corner)
{
    return normalize(cross(minus(corner[1].position, corner[0].position),
                           minus(corner[2].position, corner[0].position)));
}

static struct vec between(struct vec a, struct vec b, struct vec c,
                          const struct meeting *at)
{
    return add(scaled(a, 1 - at->b - at->c), add(scaled(b, at->b), scaled(c, at->c)));
}

static struct surface surface_of(const struct dump *dump, int draw,
                                 const struct dump_corner *k, const struct meeting *at)
{
    const double a = 1 - at->b - at->c;
    return (struct surface){
        .draw = draw,
        .position = between(k[0].position, k[1].position, k[2].position, at),
        .normal = between(k[0].normal, k[1].normal, k[2].normal, at),
        .tangent = between(k[0].tangent, k[1].tangent, k[2].tangent, at),
        .bitangent = between(k[0].bitangent, k[1].bitangent, k[2].bitangent, at),
        .facet = facet_normal(k),
        .u = a * k[0].u + at->b * k[1].u + at->c * k[2].u,
        .v = a * k[0].v + at->b * k[1].v + at->c * k[2].v,
        .material = &dump->material[dump->draw[draw].material],
    };
}

// From normalised device coordinates.
static struct vec unproject(const struct dump *dump, double x, double y, double z)
{
    const double *m = dump->inverse;
    const double w = m[3] * x + m[7] * y + m[11] * z + m[15];
    return scaled(transform(m, (struct vec){x, y, z}, 1), 1 / w);
}

struct surface trace_pixel(const struct dump *dump, double x, double y)
{
    const double ndc_x = 2 * x / dump->colour.width - 1;
    const double ndc_y = 2 * y / dump->colour.height - 1;
    const struct vec near = unproject(dump, ndc_x, ndc_y, -1);
    const struct vec far = unproject(dump, ndc_x, ndc_y, 1);
    const struct ray ray = {near, minus(far, near)};
    struct surface seen = {.draw = -1};
    struct meeting at;
    double first = 1;
    for (int d = 0; d < dump->draw_count; d++) {
        const struct dump_draw *draw = &dump->draw[d];
        for (int i = 0; !passes_by(&ray, draw) && i < draw->triangle_count; i++) {
            const struct dump_corner *corner = &draw->corner[3 * i];
            // Counter-clockwise is the front; back sides are not drawn.
            if (!meets(&ray, corner, &at) || at.t < 0 || at.t > first ||
                dot(facet_normal(corner), ray.way) >= 0)
                continue;
            first = at.t;
            seen = surface_of(dump, d, corner, &at);
        }
    }
    return seen;
}

bool trace_blocked(const struct dump *dump, struct vec from, struct vec to, double gap,
                   double *nearest)
{
    const double distance = length(minus(to, from));
    const struct ray ray = {from, normalize(minus(to, from))};
    struct meeting at;
    *nearest = distance;
    for (int d = 0; d < dump->draw_count; d++) {
        const struct dump_draw *draw = &dump->draw[d];
        if (draw->lamp >= 0 || passes_by(&ray, draw))
            continue;
        for (int i = 0; i < draw->triangle_count; i++)
            if (meets(&ray, &draw->corner[3 * i], &at) && at.t > gap &&
                at.t < distance - gap)
                *nearest = fmin(*nearest, at.t);
    }
    return *nearest < distance;
}

static struct vec texel_at(const struct sb_image *map, long x, long y)
{
    const long w = map->width, h = map->height;
    const float *t = sb_image_at(map, (int)(((x % w) + w) % w), (int)(((y % h) + h) % h));
    return (struct vec){t[0], t[1], t[2]};
}

struct vec texel(const struct sb_image *map, double u, double v)
{
    const double x = u * map->width - 0.5, y = v * map->height - 0.5;
    const long x0 = (long)floor(x), y0 = (long)floor(y);
    const double fx = x - floor(x), fy = y - floor(y);
    const struct vec lower =
        add(scaled(texel_at(map, x0, y0), 1 - fx), scaled(texel_at(map, x0 + 1, y0), fx));
    const struct vec upper = add(scaled(texel_at(map, x0, y0 + 1), 1 - fx),
                                 scaled(texel_at(map, x0 + 1, y0 + 1), fx));
    return add(scaled(lower, 1 - fy), scaled(upper, fy));
}

struct vec diffuse_texel(const struct dump *dump, const struct surface *at)
{
    return dump->has_diffuse_map ? texel(&dump->diffuse_map, at->u, at->v)
                                 : (struct vec){1, 1, 1};
}

struct vec specular_texel(const struct dump *dump, const struct surface *at)
{
    return dump->has_specular_map ? texel(&dump->specular_map, at->u, at->v)
                                  : (struct vec){1, 1, 1};
}
