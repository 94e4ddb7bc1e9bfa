// A point to be lit, by lights of any type, for the tests of the reference's shading; and rays
// in a world of closed forms.
#pragma once

#include "test.h"

#include "reference/parts.h"

// --- a scene without meshes -----------------------------------------------------------------

enum { WORLD_LIGHTS = 16 };

struct world {
    struct sb_variant variant;
    struct sb_scene scene;
    struct sb_light light[WORLD_LIGHTS];
    struct sb_material material;
    struct sb_ref_shading shading;
    struct sb_ref_input input;
};

// Words: "model=phong,cone=hard". The point is the origin, its normal +z, the eye at (0, 0, 4);
// colours are 1 but for the ambient ones, which are 0.
static inline void world_make(struct world *world, const char *words)
{
    const struct sb_axes *axes = sb_axes_builtin();
    *world = (struct world){
        .scene.camera.eye = {0, 0, 4},
        .material = {.diffuse = {1, 1, 1}, .specular = {1, 1, 1}, .shininess = 8},
        .input.normal = {0, 0, 1},
        .input.tangent = {1, 0, 0},
        .input.bitangent = {0, 1, 0},
    };
    for (int i = 0; i < 4; i++)
        world->scene.camera.view[5 * i] = 1;
    world->scene.camera.view[14] = -4;
    sb_variant_init(axes, &world->variant);
    char copy[512];
    snprintf(copy, sizeof copy, "%s", words);
    struct sb_error err = {0};
    for (char *word = strtok(copy, ","); word; word = strtok(NULL, ",")) {
        char *equals = strchr(word, '=');
        *equals = '\0';
        const int axis = sb_axes_find(axes, word);
        if (axis < 0 || !sb_variant_set(axes, &world->variant, axis, equals + 1, &err))
            fail_msg("%s=%s: %s", word, equals + 1, err.text);
    }
    world->shading = (struct sb_ref_shading){
        .variant = &world->variant,
        .scene = &world->scene,
        .lights.light = world->light,
    };
}

// One more light of a type; types must come in their order. With a neutral cone and law, to be
// changed by the caller.
static inline struct sb_light *world_add(struct world *world, enum sb_light_type type,
                                         float x, float y, float z)
{
    struct sb_lights *lights = &world->shading.lights;
    struct sb_light *light = &world->light[sb_lights_total(lights)];
    assert_true(sb_lights_total(lights) < WORLD_LIGHTS);
    lights->count[type]++;
    *light = (struct sb_light){
        .intensity = 1,
        .constant = 1,
        .range = 100,
        .diffuse = {1, 1, 1},
        .specular = {1, 1, 1},
    };
    float *at = type == SB_LIGHT_DIR ? light->direction : light->position;
    at[0] = x;
    at[1] = y;
    at[2] = z;
    return light;
}

static inline void put3(float out[3], double x, double y, double z)
{
    out[0] = (float)x;
    out[1] = (float)y;
    out[2] = (float)z;
}

static inline struct sb_ref_shade shade(const struct world *world,
                                        struct sb_ref_terms *terms)
{
    struct sb_ref_shade made;
    sb_ref_shade(&world->shading, &world->input, &world->material, &made, terms);
    return made;
}

// --- a world for rays -----------------------------------------------------------------------

// The unit ball around the origin over the plane y = -2, met from both sides. In the place of
// the library's rays, so that what is seen has a closed form; weak, so that a program that
// also wants the library's is linked with those.
static inline double nearest(double a, double b, double near, double far)
{
    const double t = a >= near ? a : b;
    return t >= near && t <= far ? t : INFINITY;
}

__attribute__((weak)) double sb_ref_geometry_hit(const struct sb_ref_geometry *geometry,
                                                 const struct sb_ref_ray *ray)
{
    (void)geometry;
    const struct sb_vec3 o = ray->origin, d = ray->direction;
    const double d2 = sb_vec3_dot(d, d), od = sb_vec3_dot(o, d);
    const double root = od * od - d2 * (sb_vec3_dot(o, o) - 1);
    const double plane = d.y != 0 ? (-2 - o.y) / d.y : INFINITY;
    double t = nearest(plane, plane, ray->near, ray->far);
    if (root >= 0)
        t = fmin(t, nearest((-od - sqrt(root)) / d2, (-od + sqrt(root)) / d2, ray->near,
                            ray->far));
    return t;
}

// Ball and plane have no corners.
__attribute__((weak)) double sb_ref_geometry_corners_away(
    const struct sb_ref_geometry *geometry, const struct sb_ref_ray *ray, double *away)
{
    const double t = sb_ref_geometry_hit(geometry, ray);
    *away = t * sb_vec3_length(ray->direction);
    return t;
}

__attribute__((weak)) bool sb_ref_geometry_blocked(const struct sb_ref_geometry *geometry,
                                                   const struct sb_ref_ray *ray)
{
    return isfinite(sb_ref_geometry_hit(geometry, ray));
}
