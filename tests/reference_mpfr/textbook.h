// The lighting of one point by the formulas that textbooks and papers print, in 200 bits, with
// the conventions of docs/glsl.md where those are undefined.
#pragma once

#include "wide.h"

#include "../lit_world.h"

// One light's terms; `margin`: how far the nearest decision is from going the other way. Lengths
// and cosines that are equal in 200 bits are so by construction, and are no doubt.
struct textbook {
    wide distance, attenuation, cone, n_dot_l, specular, diffuse_weight, specular_weight;
    struct wide3 direction, highlight;
    double margin;
};

struct textbook_surface {
    struct wide3 position, normal, view;
};

static inline bool chosen(const struct world *world, int axis, int value)
{
    return world->variant.value[axis] == value;
}

static inline struct textbook_surface textbook_surface(const struct world *world)
{
    const struct sb_ref_input *input = &world->input;
    const struct wide3 eye = floats3(world->scene.camera.eye);
    struct textbook_surface surface = {
        .position = of3(input->position),
        .normal = of3(input->normal),
    };
    if (chosen(world, SB_AXIS_NORMALISE, SB_NORMALISE_ON))
        surface.normal = unit3(surface.normal);
    if (chosen(world, SB_AXIS_MAPS, SB_MAPS_N)) { // of one texel
        const unsigned char *texel = world->scene.map[SB_MAP_NORMAL].texel;
        const struct wide3 frame[] = {unit3(of3(input->tangent)),
                                      unit3(of3(input->bitangent)), surface.normal};
        struct wide3 sum = of3((struct sb_vec3){0, 0, 0});
        for (int i = 0; i < 3; i++)
            sum =
                plus3(sum, times3(frame[i], over(minus(of(texel[i]), of(128)), of(127))));
        surface.normal = unit3(sum);
    }
    surface.view = unit3(minus3(eye, surface.position));
    return surface;
}

// --- falloff --------------------------------------------------------------------------------

static inline wide textbook_attenuation(const struct world *world,
                                        const struct sb_light *light, wide d)
{
    const wide q = over(d, of(light->range));
    if (chosen(world, SB_AXIS_ATTENUATION, SB_ATTENUATION_POLYNOMIAL)) {
        const wide sum = plus(plus(of(light->constant), times(of(light->linear), d)),
                              times(of(light->quadratic), times(d, d)));
        return over(of(1), larger(sum, of(1e-4)));
    }
    if (chosen(world, SB_AXIS_ATTENUATION, SB_ATTENUATION_RADIUS))
        return larger(minus(of(1), q), of(0));
    if (chosen(world, SB_AXIS_ATTENUATION, SB_ATTENUATION_WINDOWED)) {
        const wide window = minus(of(1), power(smaller(q, of(1)), of(4)));
        return over(times(window, window), plus(times(d, d), of(1)));
    }
    return of(1);
}

static inline void decide(struct textbook *it, wide a, wide b)
{
    const double gap = fabs(narrow(minus(a, b)));
    if (gap > 0)
        it->margin = fmin(it->margin, gap);
}

// hoist=once has the floats that were uploaded: the axis with the length that rounding left it
// in products, but for cone=linear, which is about the angle and divides by 1 - cos, and for the
// power of cone=exponent.
static inline wide textbook_cone(const struct world *world, const struct sb_light *light,
                                 struct wide3 to_light, struct textbook *it)
{
    const bool once = chosen(world, SB_AXIS_HOIST, SB_HOIST_ONCE);
    const bool linear = chosen(world, SB_AXIS_CONE, SB_CONE_LINEAR);
    struct wide3 axis = floats3(light->direction);
    if (!once || linear)
        axis = unit3(axis);
    const wide cos_a = negative(dot(to_light, axis));
    const wide of_angle = negative(dot(to_light, unit3(axis)));
    const bool quarter =
        light->cutoff == (float)(SB_PI / 2); // stands for one, and is more
    const wide edge = once      ? of(light->cos_cutoff)
                      : quarter ? of(0)
                                : cosine(of(light->cutoff));
    if (linear) {
        const wide inverse =
            once ? of(light->inv_one_minus_cos) : over(of(1), minus(of(1), edge));
        return larger(minus(of(1), times(minus(of(1), cos_a), inverse)), of(0));
    }
    if (chosen(world, SB_AXIS_CONE, SB_CONE_SMOOTH)) {
        wide scale = of(light->cone_scale), offset = of(light->cone_offset);
        if (!once) {
            scale = over(of(1),
                         larger(minus(cosine(of(light->inner)), edge), of(1.0 / 1024)));
            offset = negative(times(edge, scale));
        }
        return clamped(plus(times(cos_a, scale), offset), 0, 1);
    }
    it->margin = fabs(narrow(minus(cos_a, edge))); // equal: nobody's
    if (exceeds(edge, cos_a))
        return of(0);
    return chosen(world, SB_AXIS_CONE, SB_CONE_HARD)
               ? of(1)
               : power(clamped(of_angle, 1e-4, 1), of(light->exponent));
}

// --- area lights: Karis 2013, as printed ----------------------------------------------------

static inline struct wide3 ball_near(struct textbook *it, struct wide3 centre,
                                     wide radius)
{
    const wide d = length3(centre);
    decide(it, d, radius);
    return exceeds(d, radius) ? minus3(centre, times3(unit3(centre), radius))
                              : of3((struct sb_vec3){0, 0, 0});
}

static inline struct wide3 ball_near_ray(struct wide3 centre, wide radius,
                                         struct wide3 ray)
{
    const struct wide3 to_ray = minus3(times3(ray, dot(centre, ray)), centre);
    const wide away = length3(to_ray);
    return exceeds(away, radius) ? plus3(centre, times3(to_ray, over(radius, away)))
                                 : plus3(centre, to_ray);
}

static inline struct wide3 segment_at(struct wide3 centre, struct wide3 half, wide above,
                                      wide below)
{
    const wide t = positive(below) ? clamped(over(above, below), -1, 1) : of(0);
    return plus3(centre, times3(half, t));
}

static inline struct wide3 segment_near(struct wide3 centre, struct wide3 half)
{
    return segment_at(centre, half, negative(dot(centre, half)), dot(half, half));
}

static inline struct wide3 segment_near_ray(struct wide3 centre, struct wide3 half,
                                            struct wide3 ray)
{
    const struct wide3 c = minus3(centre, times3(ray, dot(centre, ray)));
    const struct wide3 a = minus3(half, times3(ray, dot(half, ray)));
    return segment_at(centre, half, negative(dot(c, a)), dot(a, a));
}

static inline wide into(wide at, double half)
{
    return clamped(at, -half, half);
}

static inline struct wide3 box_from(struct wide3 centre, const float half[3],
                                    struct wide3 at) // from the centre
{
    const struct wide3 in = {into(at.x, half[0]), into(at.y, half[1]),
                             into(at.z, half[2])};
    return plus3(centre, in);
}

static inline void textbook_area(const struct world *world, const struct sb_light *light,
                                 const struct textbook_surface *surface,
                                 struct wide3 centre, struct wide3 *to_light,
                                 struct textbook *it)
{
    const struct wide3 ray = reflect3(times3(surface->view, of(-1)), surface->normal);
    const struct wide3 half = floats3(light->direction);
    const wide radius = of(light->radius);
    struct wide3 bright;
    switch ((int)world->variant.value[SB_AXIS_AREA_SHAPE]) {
    case SB_AREA_SPHERE:
        *to_light = ball_near(it, centre, radius);
        bright = ball_near_ray(centre, radius, ray);
        break;
    case SB_AREA_TUBE:
        *to_light = segment_near(centre, half);
        bright = segment_near_ray(centre, half, ray);
        break;
    case SB_AREA_BOX: {
        const struct wide3 on = times3(ray, larger(dot(centre, ray), of(0)));
        *to_light = box_from(centre, light->extent, times3(centre, of(-1)));
        bright = box_from(centre, light->extent, minus3(on, centre));
        break;
    }
    default:
        *to_light = ball_near(it, segment_near(centre, half), radius);
        bright = ball_near_ray(segment_near_ray(centre, half, ray), radius, ray);
    }
    it->highlight = unit3(bright);
}

// --- one light ------------------------------------------------------------------------------

// Of vectors within 0.6 degrees of opposite there is none, by the convention of the shaders.
static inline struct wide3 half_vector3(struct wide3 from, struct wide3 view)
{
    const struct wide3 sum = plus3(from, view);
    return mpfr_cmp_d(dot(sum, sum), 1e-4) > 0 ? unit3(sum)
                                               : of3((struct sb_vec3){0, 0, 0});
}

static inline wide textbook_specular(const struct world *world,
                                     const struct textbook_surface *surface,
                                     struct wide3 from)
{
    wide c;
    if (chosen(world, SB_AXIS_MODEL, SB_MODEL_PHONG))
        c = dot(reflect3(times3(from, of(-1)), surface->normal), surface->view);
    else
        c = dot(surface->normal, half_vector3(from, surface->view));
    const wide n = of(world->material.shininess);
    wide norm = of(1);
    if (chosen(world, SB_AXIS_SPECULAR_NORM, SB_SPECULAR_NORM_ENERGY))
        norm = chosen(world, SB_AXIS_MODEL, SB_MODEL_PHONG)
                   ? over(plus(n, of(2)), times(of(2), pi()))
                   : over(plus(n, of(8)), times(of(8), pi()));
    return times(norm, power(clamped(c, 0, 1), n));
}

// What the surface reflects of a channel of this light (Schlick 1994, equation 15).
static inline wide textbook_fresnel(const struct world *world,
                                    const struct textbook_surface *surface,
                                    struct wide3 from, float f0)
{
    if (!chosen(world, SB_AXIS_FRESNEL, SB_FRESNEL_SCHLICK))
        return of(f0);
    const struct wide3 to = chosen(world, SB_AXIS_MODEL, SB_MODEL_PHONG)
                                ? surface->normal
                                : half_vector3(from, surface->view);
    const wide c = dot(surface->view, to);
    const wide x = minus(of(1), larger(c, negative(c)));
    return plus(of(f0), times(minus(of(1), of(f0)), power(x, of(5))));
}

static inline struct textbook textbook_light(const struct world *world,
                                             const struct textbook_surface *surface,
                                             const struct sb_light *light,
                                             enum sb_light_type type)
{
    struct textbook it = {.margin = 1};
    it.distance = of(0);
    it.attenuation = it.cone = of(1);
    if (type == SB_LIGHT_DIR) {
        it.direction = unit3(times3(floats3(light->direction), of(-1)));
    } else {
        struct wide3 to_light = minus3(floats3(light->position), surface->position);
        if (type == SB_LIGHT_AREA)
            textbook_area(world, light, surface, to_light, &to_light, &it);
        it.distance = length3(to_light);
        it.direction = unit3(to_light);
        it.attenuation = textbook_attenuation(world, light, it.distance);
    }
    if (type != SB_LIGHT_AREA)
        it.highlight = it.direction;
    if (type == SB_LIGHT_SPOT)
        it.cone = textbook_cone(world, light, it.direction, &it);
    it.n_dot_l = dot(surface->normal, it.direction);
    it.specular = of(0);
    if (!chosen(world, SB_AXIS_MODEL, SB_MODEL_LAMBERT)) {
        const bool front = chosen(world, SB_AXIS_SPECULAR_SIDE, SB_SPECULAR_FRONT);
        if (front)
            decide(&it, it.n_dot_l, of(0));
        if (!front || positive(it.n_dot_l))
            it.specular = textbook_specular(world, surface, it.highlight);
    }
    const wide factor = times(it.attenuation, it.cone);
    it.diffuse_weight = times(factor, larger(it.n_dot_l, of(0)));
    it.specular_weight = times(factor, it.specular);
    return it;
}
