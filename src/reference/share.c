#include "reference/share.h"

#include <string.h>

#include "base/hash.h"
#include "reference/parts.h"

// Scene axes that change no pixel of the first frame.
static bool is_unseen(int axis)
{
    return axis == SB_AXIS_LAYERS || axis == SB_AXIS_UPDATE;
}

static uint64_t add(uint64_t key, const struct sb_variant *variant, int axis)
{
    return sb_hash(key, &variant->value[axis], sizeof variant->value[axis]);
}

bool sb_ref_stands_for_sphere(const struct sb_scene *scene)
{
    for (int i = 0; i < scene->mesh_count; i++)
        if (scene->mesh[i].sphere)
            return true;
    return false;
}

uint64_t sb_ref_ideal_key(const struct sb_axes *axes, const struct sb_variant *variant,
                          const struct sb_scene *scene)
{
    const bool sphere = sb_ref_stands_for_sphere(scene);
    uint64_t key = sb_hash(SB_HASH_START, scene->name, strlen(scene->name));
    for (int a = 0; a < axes->count; a++)
        if (axes->row[a].kind == SB_SCENE && !is_unseen(a) &&
            (a != SB_AXIS_TESSELLATION || !sphere))
            key = add(key, variant, a);
    // What a slip does depends on the space, and floats differ between ways of hoisting and
    // between origins.
    if (variant->value[SB_AXIS_TEXT] == SB_TEXT_AS_WRITTEN ||
        variant->value[SB_AXIS_SPACE] == SB_SPACE_EYE)
        key = add(key, variant, SB_AXIS_SPACE);
    return add(key, variant, SB_AXIS_HOIST);
}

uint64_t sb_ref_model_key(const struct sb_axes *axes, const struct sb_variant *variant,
                          const struct sb_scene *scene)
{
    static const int of_model[] = {
        SB_AXIS_TESSELLATION, SB_AXIS_STAGE,         SB_AXIS_NORMALISE,
        SB_AXIS_SHADOW_SIZE,  SB_AXIS_SHADOW_BIAS,   SB_AXIS_SHADOW_BIAS_KIND,
        SB_AXIS_SHADOW_STORE, SB_AXIS_SHADOW_FILTER, SB_AXIS_F_SHADOW,
        SB_AXIS_F_CONE,       SB_AXIS_F_FRAME,       SB_AXIS_NORMAL_STORE,
    };
    uint64_t key = sb_ref_ideal_key(axes, variant, scene);
    for (size_t i = 0; i < sizeof of_model / sizeof *of_model; i++)
        key = add(key, variant, of_model[i]);
    return key;
}

bool sb_ref_needs_frame(const struct sb_variant *variant)
{
    return sb_ref_needs_map(variant, SB_MAP_NORMAL);
}

bool sb_ref_needs_map(const struct sb_variant *variant, enum sb_map map)
{
    return sb_ref_maps_of(variant)[map];
}

bool sb_ref_needs_maps(const struct sb_variant *variant)
{
    for (int map = 0; map < SB_MAP_COUNT; map++)
        if (sb_ref_needs_map(variant, (enum sb_map)map))
            return true;
    return false;
}

bool sb_ref_mixes_edges(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_SAMPLES] > 1;
}

// A ray takes about as long as four lights.
double sb_ref_work(const struct sb_variant *variant)
{
    static const double taps[] = {
        [SB_SHADOW_FILTER_1] = 1, [SB_SHADOW_FILTER_4] = 4, [SB_SHADOW_FILTER_16] = 16};
    double lights = 1;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        lights += sb_lights_shining(variant, (enum sb_light_type)type);
    return lights + 4 * variant->value[SB_AXIS_SHADOWS] *
                        taps[(int)variant->value[SB_AXIS_SHADOW_FILTER]];
}
