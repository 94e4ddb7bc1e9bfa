// The lighting of one point in double precision, with formulas that do not cancel: the
// equation of docs/glsl.md, evaluated from the floats that were uploaded.
//
// The GLSL is not its source, and shares nothing with it: a formula exists twice, there and
// here, and tests hold both against MPFR or closed forms.
//
// Conventions where a formula is undefined (the same as the robust GLSL's): the unit vector of
// a zero vector is zero; the polynomial attenuation's divisor is at least 1e-4; pow(0, 0) = 1
// cannot occur, shininess being above 0; a tangent frame whose determinant is at most 1/1024 leaves
// the normal as it is; a cone's cosine is clamped to [1e-4, 1] under its exponent; the float next to a
// quarter turn of cut-off is one, and from that next to half a turn on there is no cone.
#pragma once

#include "reference/geometry.h"
#include "scene/lights.h"

struct sb_ref_shading {
    const struct sb_variant *variant; // resolved: which model, laws, cone, maps, slips …
    const struct sb_scene *scene;     // materials, textures, ambient light, camera
    const struct sb_ref_geometry *geometry; // for shadows; NULL where there are none
    // As the shaders have them: sb_light_as_lit of the variant, or the scene's own in world
    // space.
    struct sb_lights lights;
    bool view_space; // inputs and lights are in view space, where the eye is the origin
    // The ideal model, whatever the quality axes say: normals renormalised, shadows by exact
    // visibility. Else as the variant has it: interpolated normals as they are with
    // normalise=off, the formulas of f_cone, f_frame and normal_store, shadows by looking up a map of shadow_size texels, with its bias, filter and
    // format, whose texels hold the exact distance along their centres.
    bool ideal;
};

// The parts of one light's contribution, in the order in which they follow from each other: the
// first that is wrong spoils those behind it. One list: name, components, place of the first
// in the page "light" of the probe (docs/glsl.md), the axes whose precision it has, its own or that
// of what it is made from, help.
#define SB_REF_TERMS(TERM)                                                               \
    TERM(distance, 1, 0, "p_position p_attenuation p_uniform",                           \
         "from the surface to the light; 0 for directional lights")                      \
    TERM(direction, 3, 6, "p_position p_vector p_uniform",                               \
         "unit vector to the light, in the space of the lighting")                       \
    TERM(attenuation, 1, 1, "p_position p_attenuation p_uniform",                        \
         "attenuation; 1 where the variant has none")                                    \
    TERM(cone, 1, 2, "p_position p_vector p_attenuation p_uniform",                      \
         "attenuation across the cone of a spot light; else 1")                          \
    TERM(shown, 1, 3, "p_position p_vector p_attenuation p_uniform",                     \
         "share of the light that no shadow takes")                                      \
    TERM(n_dot_l, 1, 4, "p_position p_vector p_uniform",                                 \
         "cosine between normal and light")                                              \
    TERM(specular, 1, 5, "p_position p_vector p_specular p_uniform",                     \
         "specular factor; 0 where the variant has none or it is cut")                   \
    TERM(diffuse_weight, 1, 9, "p_position p_vector p_attenuation p_color p_uniform",    \
         "factor on the light's diffuse colour")                                         \
    TERM(specular_weight, 1, 10,                                                         \
         "p_position p_vector p_attenuation p_specular p_color p_uniform",               \
         "factor on the light's specular colour")

struct sb_ref_terms {
#define TERM(name, components, place, axes, help) double name[components];
    SB_REF_TERMS(TERM)
#undef TERM
};

// What leaves the surface, before the maps that multiply it.
struct sb_ref_shade {
    struct sb_vec3 diffuse, specular; // ambient light is part of diffuse
    struct sb_vec3 view, normal;      // unit vector to the eye; the normal that was lit
    // Which way every branch went, light by light in the order of the list: the hash
    // sb_ref_decide, over, where there is one, the hard or exponential cone's (cosine >= that of
    // the cut-off), then of the lights that cast shadows (int)(16 * shown + 0.5), then, where highlights
    // are cut on back faces, n_dot_l > 0.
    uint32_t decisions;
    // How far the nearest of these branches is from going the other way, in cosines; 0 where there
    // are shadows, whose edges lie anywhere; INFINITY where there is no branch.
    double margin;
};
static inline uint32_t sb_ref_decide(uint32_t decisions, int outcome)
{
    return (decisions * 31 + (uint32_t)outcome + 1) & 0xFFFFFF;
}

// `terms`: one element a light, in the order of the whole list; NULL: not asked for.
void sb_ref_shade(const struct sb_ref_shading *shading, const struct sb_ref_input *input,
                  const struct sb_material *material, struct sb_ref_shade *shade,
                  struct sb_ref_terms *terms);

// The colour of the pixel: the maps of `input` applied to what leaves the surface.
struct sb_vec3 sb_ref_colour(const struct sb_ref_shading *shading,
                             const struct sb_ref_shade *shade,
                             const struct sb_ref_input *input);

// A texture at uv as OpenGL defines it: repeated, bilinear at full size (OpenGL 4.6 core,
// 8.14.2 and 8.14.3), in double.
struct sb_vec3 sb_ref_texture(const struct sb_texture *texture, const double uv[2]);
