#include "scene/scene.h"

// By an affine matrix of floats; w is 1 for points, 0 for directions. In double, so that a
// world far from the origin loses nothing but what its floats have lost.
static void transform(const float matrix[16], double w, float v[3])
{
    double out[3];
    for (int row = 0; row < 3; row++) {
        out[row] = matrix[12 + row] * w;
        for (int k = 0; k < 3; k++)
            out[row] += (double)matrix[4 * k + row] * v[k];
    }
    for (int row = 0; row < 3; row++)
        v[row] = (float)out[row];
}

struct sb_light sb_light_to_view(const struct sb_light *light, enum sb_light_type type,
                                 const struct sb_camera *camera, bool keep_sun)
{
    struct sb_light view = *light;
    if (type != SB_LIGHT_DIR)
        transform(camera->view, 1, view.position);
    if (type != SB_LIGHT_DIR || !keep_sun)
        transform(camera->view, 0, view.direction);
    return view;
}

struct sb_light sb_light_as_lit(const struct sb_light *light, enum sb_light_type type,
                                const struct sb_variant *variant,
                                const struct sb_camera *camera)
{
    const bool keep_sun = variant->value[SB_AXIS_SOURCE] == SB_SOURCE_LWJGL &&
                          variant->value[SB_AXIS_TEXT] == SB_TEXT_AS_WRITTEN;
    struct sb_light lit = *light;
    if (variant->value[SB_AXIS_SPACE] == SB_SPACE_VIEW)
        lit = sb_light_to_view(light, type, camera, keep_sun);
    return variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED
               ? sb_light_unified(&lit, type)
               : lit;
}
