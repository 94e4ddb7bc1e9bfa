// Highlights: the power of a cosine. A power of n makes n times of a relative error, so near 1,
// where highlights are, the cosine's logarithm comes from the sine: log c = log1p(-s) / 2 with
// s = 1 - c^2, and s is the square of a cross product (Lagrange's identity), which does not
// cancel.
#include "reference/parts.h"

struct cosine {
    double c, s; // s: 1 - c^2, as exact relative to itself as the vectors allow
};

static double log_cosine(const struct cosine *cosine)
{
    return cosine->c > 0.75 ? 0.5 * log1p(-cosine->s) : log(cosine->c);
}

// clamp(c, 0, 1)^n
static double power(const struct cosine *cosine, double n)
{
    if (cosine->c <= 0)
        return 0;
    return cosine->s <= 0 ? 1 : exp(n * log_cosine(cosine));
}

// Vectors within 0.6 degrees of opposite have no half vector: floats have lost it there.
#define LEAST_HALF 1e-4 // of its square, before it is made a unit vector

static struct sb_vec3 half_vector(struct sb_vec3 a, struct sb_vec3 b)
{
    const struct sb_vec3 h = sb_vec3_add(a, b);
    const double h2 = sb_vec3_dot(h, h);
    return h2 > LEAST_HALF ? sb_vec3_scale(h, 1 / sqrt(h2)) : (struct sb_vec3){0, 0, 0};
}

// Between the half vector and the normal (Blinn 1977).
static struct cosine blinn(const struct sb_ref_surface *surface, struct sb_vec3 to_light)
{
    const struct sb_vec3 n = surface->normal;
    const struct sb_vec3 h = half_vector(to_light, surface->view);
    const struct sb_vec3 across = sb_vec3_cross(n, h);
    return (struct cosine){
        .c = sb_vec3_dot(n, h),
        .s = surface->shortfall + sb_vec3_dot(across, across),
    };
}

// Between the reflected ray and the view vector (Phong 1975). Of a normal whose square is 1 - f
// the ray's is 1 - 4 (N . L)^2 f.
static struct cosine phong(const struct sb_ref_surface *surface, struct sb_vec3 to_light)
{
    const struct sb_vec3 n = surface->normal, v = surface->view;
    const double n_dot_l = sb_vec3_dot(n, to_light);
    const struct sb_vec3 ray = sb_ref_reflect(to_light, n);
    const struct sb_vec3 across = sb_vec3_cross(ray, v);
    return (struct cosine){
        .c = sb_vec3_dot(ray, v),
        .s = 4 * n_dot_l * n_dot_l * surface->shortfall + sb_vec3_dot(across, across),
    };
}

// What makes up for the width of a power of n: for Blinn Akenine-Moeller, Haines, Hoffman,
// Real-Time Rendering, 3rd edition, 7.6; for Phong Lafortune and Willems 1994, where it is exact.
static double norm(int model, double n)
{
    return model == SB_MODEL_PHONG ? (n + 2) / (2 * SB_PI) : (n + 8) / (8 * SB_PI);
}

// --- the angle of view ----------------------------------------------------------------------

// 1 - |a . b|, where b has unit length and the square of a's is 1 - f. Where they are near each
// other the difference tells it: |a - b|^2 = 2 - f - 2 a . b.
static double off_one(struct sb_vec3 a, double f, struct sb_vec3 b)
{
    const double c = sb_vec3_dot(a, b);
    if (fabs(c) < 0.75)
        return 1 - fabs(c);
    const struct sb_vec3 off = sb_vec3_sub(c > 0 ? a : sb_vec3_scale(a, -1), b);
    return 0.5 * (sb_vec3_dot(off, off) + f);
}

double sb_ref_schlick(const struct sb_ref_choice *choice,
                      const struct sb_ref_surface *surface, struct sb_vec3 highlight)
{
    const struct sb_vec3 v = surface->view;
    const double x = choice->model == SB_MODEL_PHONG
                         ? off_one(surface->normal, surface->shortfall, v)
                         : off_one(half_vector(highlight, v), 0, v);
    return x * x * x * x * x;
}

// --- slips (docs/sources.md) ----------------------------------------------------------------

// `ubo` compares the reflected ray with the normal: their cosine is that of light and normal.
static double ubo(const struct sb_ref_surface *surface, struct sb_vec3 to_light)
{
    const struct sb_vec3 n = sb_ref_unit(surface->normal);
    const struct sb_vec3 across = sb_vec3_cross(n, to_light);
    const struct cosine cosine = {sb_vec3_dot(n, to_light), sb_vec3_dot(across, across)};
    return power(&cosine, surface->shininess);
}

// `shadows` has the intensity inside the power too.
static double shadows(const struct sb_ref_surface *surface, struct sb_vec3 to_light,
                      double intensity)
{
    const struct cosine cosine = phong(surface, to_light);
    if (!(cosine.c > 0 && intensity > 0))
        return 0;
    return exp(surface->shininess * (log_cosine(&cosine) + log(intensity)));
}

double sb_ref_specular(const struct sb_ref_choice *choice,
                       const struct sb_ref_surface *surface, struct sb_vec3 highlight,
                       double intensity)
{
    if (choice->slips == SB_SOURCE_UBO)
        return ubo(surface, highlight);
    if (choice->slips == SB_SOURCE_SHADOWS)
        return shadows(surface, highlight, intensity);
    const struct cosine cosine = choice->model == SB_MODEL_PHONG
                                     ? phong(surface, highlight)
                                     : blinn(surface, highlight);
    const double n = surface->shininess;
    return power(&cosine, n) * (choice->energy ? norm(choice->model, n) : 1);
}
