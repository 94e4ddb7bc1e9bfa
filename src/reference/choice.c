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

const bool *sb_ref_maps_of(const struct sb_variant *variant)
{
    return maps[(int)variant->value[SB_AXIS_MAPS]];
}

// The slip of `ubo` is part of the text and so of the ideal; normalise=off is not.
static bool keeps_length(const struct sb_ref_shading *shading, int slips)
{
    const bool off = shading->variant->value[SB_AXIS_NORMALISE] == SB_NORMALISE_OFF;
    return slips == SB_SOURCE_UBO || (off && !shading->ideal);
}

// Where the naive form is another formula, the model of the variant follows it. Where it only
// lacks a guard or cancels, what it loses is an error of arithmetic.
static void choose_forms(const double *value, struct sb_ref_choice *choice)
{
    choice->spreads = value[SB_AXIS_F_FRAME] == SB_F_FRAME_NAIVE;
    choice->restores = value[SB_AXIS_NORMAL_STORE] == SB_NORMAL_STORE_RG;
    choice->eases = value[SB_AXIS_F_CONE] == SB_F_CONE_NAIVE;
    choice->per_vertex = value[SB_AXIS_F_SHADOW] == SB_F_SHADOW_NAIVE;
}

static void choose_shadows(const double *value, struct sb_ref_choice *choice)
{
    choice->taps = taps[(int)value[SB_AXIS_SHADOW_FILTER]];
    choice->size = (int)value[SB_AXIS_SHADOW_SIZE];
    choice->store = (int)value[SB_AXIS_SHADOW_STORE];
    choice->bias = (float)value[SB_AXIS_SHADOW_BIAS]; // a literal of the GLSL
    choice->bias_slopes = value[SB_AXIS_SHADOW_BIAS_KIND] == SB_SHADOW_BIAS_SLOPE;
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
        .schlick = value[SB_AXIS_FRESNEL] == SB_FRESNEL_SCHLICK,
        .energy = value[SB_AXIS_SPECULAR_NORM] == SB_SPECULAR_NORM_ENERGY,
        .cuts_back = value[SB_AXIS_SPECULAR_SIDE] == SB_SPECULAR_FRONT,
        .keeps_length = keeps_length(shading, slips),
        .makes_cone = value[SB_AXIS_HOIST] == SB_HOIST_PER_LIGHT,
        .unified = value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED,
        .passes_off = value[SB_AXIS_LOOP] == SB_LOOP_PADDED,
        .maps = sb_ref_maps_of(shading->variant),
        .casters = (int)value[SB_AXIS_SHADOWS],
    };
    if (!shading->ideal)
        choose_forms(value, &choice);
    if (choice.casters > 0)
        choose_shadows(value, &choice);
    return choice;
}
