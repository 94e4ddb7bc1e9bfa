// What a variant draws into.
#include "render/render.h"

struct sb_shape sb_shape_of(const struct sb_variant *variant)
{
    static const enum sb_gl_format format[SB_TARGET_VALUE_COUNT] = {
        [SB_TARGET_RGBA8] = SB_GL_RGBA8,
        [SB_TARGET_RGBA16F] = SB_GL_RGBA16F,
        [SB_TARGET_RGBA32F] = SB_GL_RGBA32F,
    };
    return (struct sb_shape){
        .width = (int)variant->value[SB_AXIS_WIDTH],
        .height = (int)variant->value[SB_AXIS_HEIGHT],
        .format = format[(int)variant->value[SB_AXIS_TARGET]],
        .samples = (int)variant->value[SB_AXIS_SAMPLES],
        .layers = (int)variant->value[SB_AXIS_LAYERS],
    };
}

bool sb_lit_per_vertex(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
}

enum sb_gl_format sb_format_wide(const struct sb_caps *caps)
{
    return caps->colour_half && !caps->colour_float ? SB_GL_RGBA16F : SB_GL_RGBA32F;
}

bool sb_ring_make(struct sb_ring *ring, const struct sb_caps *caps,
                  const struct sb_shape *shape, struct sb_error *err)
{
    const struct sb_target_params target = {shape->width, shape->height, shape->samples,
                                            shape->format};
    for (int i = 0; i < SB_RING_SIZE; i++) {
        if (!sb_target_make(&ring->target[i], caps, &target, err))
            return false;
    }
    return true;
}

void sb_ring_free(struct sb_ring *ring)
{
    for (int i = 0; i < SB_RING_SIZE; i++)
        sb_target_free(&ring->target[i]);
}
