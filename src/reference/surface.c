// The point that is lit: where it is, its normal, and where the eye is.
#include <math.h>

#include "reference/parts.h"

struct sb_vec3 sb_ref_to_world(const struct sb_ref_shading *shading, struct sb_vec3 v)
{
    if (!shading->view_space)
        return v;
    const float *m = shading->scene->camera.view;
    return (struct sb_vec3){
        m[0] * v.x + m[1] * v.y + m[2] * v.z,
        m[4] * v.x + m[5] * v.y + m[6] * v.z,
        m[8] * v.x + m[9] * v.y + m[10] * v.z,
    };
}

struct sb_vec3 sb_ref_from_world(const struct sb_ref_shading *shading, struct sb_vec3 v)
{
    if (!shading->view_space)
        return v;
    const float *m = shading->scene->camera.view;
    return (struct sb_vec3){
        m[0] * v.x + m[4] * v.y + m[8] * v.z,
        m[1] * v.x + m[5] * v.y + m[9] * v.z,
        m[2] * v.x + m[6] * v.y + m[10] * v.z,
    };
}

// The slip of `lwjgl` subtracts the position in view space from the camera's in world space.
static struct sb_vec3 eye(const struct sb_ref_shading *shading,
                          const struct sb_ref_choice *choice)
{
    if (shading->view_space && choice->slips != SB_SOURCE_LWJGL)
        return (struct sb_vec3){0, 0, 0};
    return sb_ref_vec(shading->scene->camera.eye);
}

// Eight bits: 0 is 128, and 1 is 255.
static double decoded(const struct sb_ref_choice *choice, double component)
{
    return choice->spreads ? 2 * component - 1 : (255 * component - 128) / 127;
}

static struct sb_vec3 bump_of(const struct sb_ref_shading *shading,
                              const struct sb_ref_choice *choice,
                              const struct sb_ref_input *input)
{
    const struct sb_vec3 texel = sb_ref_texel(shading, input, SB_MAP_NORMAL);
    const double x = decoded(choice, texel.x), y = decoded(choice, texel.y);
    const double z =
        choice->restores ? sqrt(fmax(1 - x * x - y * y, 0)) : decoded(choice, texel.z);
    return (struct sb_vec3){x, y, z};
}

// The normal that the map gives in the frame of tangent, bitangent and normal; in a frame that is
// flat, the normal itself. Flat: the determinant of its unit vectors is 1/1024 at most.
static struct sb_vec3 mapped(const struct sb_ref_shading *shading,
                             const struct sb_ref_choice *choice,
                             const struct sb_ref_input *input, struct sb_vec3 normal)
{
    const struct sb_vec3 bump = bump_of(shading, choice, input);
    const struct sb_vec3 t = sb_ref_unit(input->tangent);
    const struct sb_vec3 b = sb_ref_unit(input->bitangent);
    if (!(fabs(sb_vec3_dot(sb_vec3_cross(t, b), normal)) > 1.0 / 1024))
        return normal;
    const struct sb_vec3 along =
        sb_vec3_add(sb_vec3_scale(t, bump.x), sb_vec3_scale(b, bump.y));
    return sb_ref_unit(sb_vec3_add(along, sb_vec3_scale(normal, bump.z)));
}

struct sb_ref_surface sb_ref_surface_of(const struct sb_ref_shading *shading,
                                        const struct sb_ref_choice *choice,
                                        const struct sb_ref_input *input,
                                        const struct sb_material *material)
{
    const struct sb_vec3 to_eye = sb_vec3_sub(eye(shading, choice), input->position);
    struct sb_ref_surface surface = {
        .position = input->position,
        .normal = choice->keeps_length ? input->normal : sb_ref_unit(input->normal),
        .view = sb_ref_unit(to_eye),
        .shininess = material->shininess,
    };
    if (choice->maps[SB_MAP_NORMAL])
        surface.normal = mapped(shading, choice, input, surface.normal);
    else if (choice->keeps_length)
        surface.shortfall = 1 - sb_vec3_dot(surface.normal, surface.normal);
    return surface;
}
