#include "reference/parts.h"

static const bool maps[SB_MAPS_VALUE_COUNT][SB_MAP_COUNT] = {
    [SB_MAPS_D] = {[SB_MAP_DIFFUSE] = true},
    [SB_MAPS_S] = {[SB_MAP_SPECULAR] = true},
    [SB_MAPS_N] = {[SB_MAP_NORMAL] = true},
    [SB_MAPS_DS] = {[SB_MAP_DIFFUSE] = true, [SB_MAP_SPECULAR] = true},
    [SB_MAPS_DN] = {[SB_MAP_DIFFUSE] = true, [SB_MAP_NORMAL] = true},
    [SB_MAPS_SN] = {[SB_MAP_SPECULAR] = true, [SB_MAP_NORMAL] = true},
    [SB_MAPS_DSN] = {true, true, true},
};

static const int taps[SB_SHADOW_FILTER_VALUE_COUNT] = {
    [SB_SHADOW_FILTER_1] = 1,
    [SB_SHADOW_FILTER_4] = 2,
    [SB_SHADOW_FILTER_16] = 4,
};

// The slip of `ubo` is part of the text and so of the ideal; normalise=off is not. At vertices
// normals are unit vectors.
static bool keeps_length(const struct sb_ref_shading *shading, int slips)
{
    const double *value = shading->variant->value;
    if (value[SB_AXIS_STAGE] == SB_STAGE_VERTEX)
        return false;
    return slips == SB_SOURCE_UBO ||
           (!shading->ideal && value[SB_AXIS_NORMALISE] == SB_NORMALISE_OFF);
}

struct sb_ref_choice sb_ref_choose(const struct sb_ref_shading *shading)
{
    const double *value = shading->variant->value;
    const int slips = value[SB_AXIS_TEXT] == SB_TEXT_AS_WRITTEN
                          ? (int)value[SB_AXIS_SOURCE]
                          : SB_SOURCE_NONE;
    struct sb_ref_choice choice = {
        .model = (int)value[SB_AXIS_MODEL],
        .ambient = (int)value[SB_AXIS_AMBIENT],
        .attenuation = (int)value[SB_AXIS_ATTENUATION],
        .cone = (int)value[SB_AXIS_CONE],
        .area_shape = (int)value[SB_AXIS_AREA_SHAPE],
        .slips = slips,
        .cuts_back = value[SB_AXIS_SPECULAR_SIDE] == SB_SPECULAR_FRONT,
        .keeps_length = keeps_length(shading, slips),
        .makes_cone = value[SB_AXIS_HOIST] == SB_HOIST_PER_LIGHT,
        .unified = value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED,
        .passes_off = value[SB_AXIS_LOOP] == SB_LOOP_PADDED,
        .casters = (int)value[SB_AXIS_SHADOWS],
        .taps = taps[(int)value[SB_AXIS_SHADOW_FILTER]],
        .size = (int)value[SB_AXIS_SHADOW_SIZE],
        .store = (int)value[SB_AXIS_SHADOW_STORE],
        .bias = (float)value[SB_AXIS_SHADOW_BIAS], // a literal of the GLSL
        .bias_slopes = value[SB_AXIS_SHADOW_BIAS_KIND] == SB_SHADOW_BIAS_SLOPE,
    };
    const bool *used = maps[(int)value[SB_AXIS_MAPS]];
    for (int i = 0; i < SB_MAP_COUNT; i++)
        choice.maps[i] = used[i];
    return choice;
}
