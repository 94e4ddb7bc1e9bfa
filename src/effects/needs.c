#include "effects/needs.h"

#include <assert.h>
#include <string.h>

static bool is(const struct sb_variant *variant, int axis, int value)
{
    return (int)variant->value[axis] == value;
}

// --- what `without` leaves out ---------------------------------------------------------------

// Of values that take a type of light, that type; else -1.
static int type_without(const struct sb_variant *variant)
{
    switch ((int)variant->value[SB_AXIS_WITHOUT]) {
    case SB_WITHOUT_DIR:
        return SB_LIGHT_DIR;
    case SB_WITHOUT_POINT:
        return SB_LIGHT_POINT;
    case SB_WITHOUT_SPOT:
        return SB_LIGHT_SPOT;
    case SB_WITHOUT_AREA:
        return SB_LIGHT_AREA;
    default:
        return -1;
    }
}

// Of values that take a map, its bit; else 0.
static unsigned map_without(const struct sb_variant *variant)
{
    switch ((int)variant->value[SB_AXIS_WITHOUT]) {
    case SB_WITHOUT_DIFFUSE_MAP:
        return 1U << SB_MAP_DIFFUSE;
    case SB_WITHOUT_SPECULAR_MAP:
        return 1U << SB_MAP_SPECULAR;
    case SB_WITHOUT_NORMAL_MAP:
        return 1U << SB_MAP_NORMAL;
    default:
        return 0;
    }
}

void sb_needs_leave_out(struct sb_needs *needs, const struct sb_variant *variant,
                        const struct sb_lights *lights)
{
    const int type = type_without(variant);
    int number = 0;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        for (int i = 0; i < lights->count[t]; i++, number++)
            needs->lit[number] &= t != type;
    needs->maps &= ~map_without(variant);
    needs->ambient &= !is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_AMBIENT);
    needs->diffuse &= !is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_DIFFUSE);
    needs->specular &= !is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_SPECULAR);
    needs->falls_off &= !is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_ATTENUATION);
    needs->cone &= !is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_CONE);
    needs->fresnel &= !is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_FRESNEL);
    needs->renormalise &= !is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_RENORMALISE);
    if (type == SB_LIGHT_POINT || is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_SHADOWS))
        needs->casters = 0;
}

// --- in the language of axes -----------------------------------------------------------------

// The texts of the values of `maps` are subsets of "dsn", in the order of enum sb_map.
static unsigned maps_of(int value)
{
    const char *text = sb_axes_builtin()->row[SB_AXIS_MAPS].values[value].text;
    unsigned maps = 0;
    for (int i = 0; value != SB_MAPS_NONE && i < SB_MAP_COUNT; i++)
        if (strchr(text, "dsn"[i]))
            maps |= 1U << i;
    return maps;
}

unsigned sb_maps_asked(const struct sb_variant *variant)
{
    return maps_of((int)variant->value[SB_AXIS_MAPS]);
}

int sb_maps_value(unsigned maps)
{
    for (int v = 0; v < SB_MAPS_VALUE_COUNT; v++)
        if (maps_of(v) == maps)
            return v;
    return SB_MAPS_NONE;
}

static uint32_t bit(enum sb_effect effect)
{
    return UINT32_C(1) << effect;
}

// What no axis turns off.
static uint32_t left_out(const struct sb_needs *needs)
{
    return (needs->diffuse ? 0 : bit(SB_EFFECT_DIFFUSE)) |
           (needs->linear ? 0 : bit(SB_EFFECT_LINEAR)) |
           (needs->quadratic ? 0 : bit(SB_EFFECT_QUADRATIC)) |
           (needs->cone ? 0 : bit(SB_EFFECT_CONE)) |
           (needs->renormalise ? 0 : bit(SB_EFFECT_RENORMALISE));
}

static void settle(const struct sb_axes *axes, struct sb_variant *variant)
{
    struct sb_error err = {0};
    const bool good = sb_variant_settle(axes, variant, &err);
    assert(good); // less than what was asked for contradicts nothing that it did not
    (void)good;
}

static void lower_effects(const struct sb_needs *needs, struct sb_variant *variant)
{
    double *value = variant->value;
    value[SB_AXIS_MAPS] = sb_maps_value(needs->maps);
    value[SB_AXIS_SHADOWS] = needs->casters;
    if (!needs->specular)
        value[SB_AXIS_MODEL] = SB_MODEL_LAMBERT;
    if (!needs->ambient)
        value[SB_AXIS_AMBIENT] = SB_AMBIENT_NONE;
    if (!needs->falls_off)
        value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_NONE;
    if (!needs->fresnel)
        value[SB_AXIS_FRESNEL] = SB_FRESNEL_NONE;
}

void sb_needs_to_calls(const struct sb_needs *needs, const struct sb_axes *axes,
                       const struct sb_variant *variant, const struct sb_lights *lights,
                       struct sb_arena *arena, struct sb_calls *calls)
{
    const int total = sb_lights_total(lights);
    int *light = sb_arena_alloc(arena, ((size_t)total + 1) * sizeof *light);
    int kept = 0, number = 0;
    *calls = (struct sb_calls){.variant = *variant, .light = light};
    double *value = calls->variant.value;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        for (int i = 0; i < lights->count[t]; i++, number++)
            if (needs->lit[number]) {
                light[kept++] = number;
                calls->light_count[t]++;
            }
        value[sb_light_structs[t].axis] = calls->light_count[t];
    }
    // The list says which directional lights there are; the sun is not taken off it again.
    value[SB_AXIS_SUN] = sb_axes_builtin()->row[SB_AXIS_SUN].init;
    lower_effects(needs, &calls->variant);
    settle(axes, &calls->variant);
    calls->effects = sb_effects_of(axes, &calls->variant) & ~left_out(needs);
}

int sb_calls_casters(const struct sb_calls *calls)
{
    return (int)calls->variant.value[SB_AXIS_SHADOWS];
}

// --- without looking at a scene ----------------------------------------------------------------

void sb_calls_asked(const struct sb_axes *axes, const struct sb_variant *variant,
                    struct sb_calls *calls)
{
    bool lit[SB_LIGHT_TYPE_COUNT];
    struct sb_lights one = {NULL, {1, 1, 1, 1}};
    struct sb_needs needs = {
        .lit = lit,
        .ambient = true,
        .diffuse = true,
        .specular = true,
        .maps = sb_maps_asked(variant),
        .falls_off = true,
        .linear = true,
        .quadratic = true,
        .cone = true,
        .fresnel = true,
        .renormalise = true,
        .casters = (int)variant->value[SB_AXIS_SHADOWS],
    };
    *calls = (struct sb_calls){.variant = *variant};
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        lit[t] = true;
    if (!is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_NOTHING)) {
        sb_needs_leave_out(&needs, variant, &one);
        lower_effects(&needs, &calls->variant);
        for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
            if (!lit[t])
                calls->variant.value[sb_light_structs[t].axis] = 0;
        settle(axes, &calls->variant);
    }
    calls->effects = sb_effects_of(axes, &calls->variant) & ~left_out(&needs);
}
