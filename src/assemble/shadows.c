// What shadow maps ask of a driver.
#include <inttypes.h>

#include "assemble/decide.h"

enum { FACES = 6 };
// Units of the diffuse, specular and normal map: the shadow maps begin behind them.
enum { MAP_UNITS = 3 };

static bool is(const struct sb_variant *variant, int axis, int value)
{
    return (int)variant->value[axis] == value;
}

static const char *word(const struct sb_axes *axes, const struct sb_variant *variant,
                        int axis)
{
    return axes->row[axis].values[(int)variant->value[axis]].name;
}

// --- language and features -----------------------------------------------------------------

static bool is_cube_array(const struct sb_variant *variant)
{
    return is(variant, SB_AXIS_SHADOW_MAP, SB_SHADOW_MAP_CUBE_ARRAY);
}

static bool is_layered(const struct sb_variant *variant)
{
    return is(variant, SB_AXIS_SHADOW_PASS, SB_SHADOW_PASS_LAYERED);
}

bool sb_shadows_want_es310(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_SHADOWS] > 0 &&
           (is_cube_array(variant) || is_layered(variant));
}

static bool check_language(const struct sb_axes *axes, const struct sb_caps *caps,
                           const struct sb_variant *variant, struct sb_error *err)
{
    if (is(variant, SB_AXIS_GLSL, SB_GLSL_100))
        return sb_fail(err, SB_BAD_INPUT,
                       "shadows=%d: GLSL ES 1.00 has no shadow maps here; valid with "
                       "glsl=100: 0",
                       (int)variant->value[SB_AXIS_SHADOWS]);
    const bool es300 = is(variant, SB_AXIS_GLSL, SB_GLSL_300ES);
    if (is_cube_array(variant) && (!caps->cube_map_array || es300))
        return sb_fail(err, es300 ? SB_BAD_INPUT : SB_OVER_LIMIT,
                       "shadow_map=cube_array: %s has no cube map arrays; valid here: "
                       "six2d array2d cube",
                       es300 ? "GLSL ES 3.00" : "this driver");
    if (is_layered(variant) && (!caps->geometry_shader || es300))
        return sb_fail(
            err, es300 ? SB_BAD_INPUT : SB_OVER_LIMIT,
            "shadow_pass=layered: %s has no geometry shaders; valid here: faces",
            es300 ? "GLSL ES 3.00" : "this driver");
    const bool floats = caps->colour_float, halves = floats || caps->colour_half;
    if ((is(variant, SB_AXIS_SHADOW_STORE, SB_SHADOW_STORE_R32F) && !floats) ||
        (is(variant, SB_AXIS_SHADOW_STORE, SB_SHADOW_STORE_R16F) && !halves))
        return sb_fail(err, SB_OVER_LIMIT,
                       "shadow_store=%s: this driver cannot draw to it; valid here:%s r8 "
                       "depth",
                       word(axes, variant, SB_AXIS_SHADOW_STORE), halves ? " r16f" : "");
    return true;
}

// --- limits --------------------------------------------------------------------------------

// Samplers of the shade program.
struct units {
    int64_t shadow, maps;
};

static struct units count_units(const struct sb_variant *variant, int kind)
{
    const int64_t casters = (int64_t)variant->value[SB_AXIS_SHADOWS];
    static const int maps[SB_MAPS_VALUE_COUNT] = {
        [SB_MAPS_D] = 1,  [SB_MAPS_S] = 1,  [SB_MAPS_N] = 1,   [SB_MAPS_DS] = 2,
        [SB_MAPS_DN] = 2, [SB_MAPS_SN] = 2, [SB_MAPS_DSN] = 3,
    };
    struct units units = {1, maps[(int)variant->value[SB_AXIS_MAPS]]};
    if (kind == SB_SHADOW_MAP_SIX2D)
        units.shadow = FACES * casters;
    else if (kind == SB_SHADOW_MAP_CUBE)
        units.shadow = casters;
    return units;
}

static bool units_fit(const struct sb_caps *caps, const struct units *units)
{
    return units->shadow + units->maps <= caps->texture_units &&
           units->shadow + MAP_UNITS <= caps->combined_texture_units;
}

static bool layers_fit(const struct sb_caps *caps, const struct sb_variant *variant)
{
    return FACES * variant->value[SB_AXIS_SHADOWS] <= (double)caps->array_layers;
}

static bool check_units(const struct sb_axes *axes, const struct sb_caps *caps,
                        const struct sb_variant *variant, struct sb_error *err)
{
    const int casters = (int)variant->value[SB_AXIS_SHADOWS];
    const struct units units =
        count_units(variant, (int)variant->value[SB_AXIS_SHADOW_MAP]);
    if (units_fit(caps, &units))
        return true;
    const bool combined = units.shadow + units.maps <= caps->texture_units;
    const char *others = !layers_fit(caps, variant) ? "fewer casters fit"
                         : caps->cube_map_array     ? "cube_array or array2d fit"
                                                    : "array2d fits";
    return sb_fail(
        err, SB_OVER_LIMIT,
        "shadow_map=%s: %d casters want %" PRId64 " texture units and the maps "
        "%" PRId64 ", this driver has %" PRId64 " (GL_MAX_%sTEXTURE_IMAGE_UNITS); "
        "%s",
        word(axes, variant, SB_AXIS_SHADOW_MAP), casters, units.shadow,
        combined ? (int64_t)MAP_UNITS : units.maps,
        combined ? caps->combined_texture_units : caps->texture_units,
        combined ? "COMBINED_" : "", others);
}

static bool check_layers(const struct sb_axes *axes, const struct sb_caps *caps,
                         const struct sb_variant *variant, struct sb_error *err)
{
    const bool array =
        is(variant, SB_AXIS_SHADOW_MAP, SB_SHADOW_MAP_ARRAY2D) || is_cube_array(variant);
    if (!array || layers_fit(caps, variant))
        return true;
    const int casters = (int)variant->value[SB_AXIS_SHADOWS];
    return sb_fail(err, SB_OVER_LIMIT,
                   "shadow_map=%s: %d casters want %d layers, this driver has %" PRId64
                   " (GL_MAX_ARRAY_TEXTURE_LAYERS); %" PRId64 " casters fit",
                   word(axes, variant, SB_AXIS_SHADOW_MAP), casters, FACES * casters,
                   caps->array_layers, caps->array_layers / FACES);
}

static bool check_size(const struct sb_axes *axes, const struct sb_caps *caps,
                       const struct sb_variant *variant, struct sb_error *err)
{
    const bool cube =
        is(variant, SB_AXIS_SHADOW_MAP, SB_SHADOW_MAP_CUBE) || is_cube_array(variant);
    const int64_t limit = cube ? caps->cube_map_size : caps->texture_size;
    const int64_t size = (int64_t)variant->value[SB_AXIS_SHADOW_SIZE];
    // With one pass a face the depth buffer of the passes is a renderbuffer.
    const bool drawn = size <= caps->renderbuffer_size;
    if (size <= limit && drawn)
        return true;
    return sb_fail(err, SB_OVER_LIMIT,
                   "shadow_size=%" PRId64 ": shadow_map=%s takes up to %" PRId64
                   " texels a side on this driver (GL_MAX_%s_SIZE)",
                   size, word(axes, variant, SB_AXIS_SHADOW_MAP),
                   size > limit ? limit : caps->renderbuffer_size,
                   size <= limit ? "RENDERBUFFER"
                   : cube        ? "CUBE_MAP_TEXTURE"
                                 : "TEXTURE");
}

bool sb_decide_shadows(const struct sb_axes *axes, const struct sb_caps *caps,
                       const struct sb_variant *variant, struct sb_error *err)
{
    const int casters = (int)variant->value[SB_AXIS_SHADOWS];
    const int points = (int)variant->value[SB_AXIS_POINT];
    if (casters == 0 && is(variant, SB_AXIS_UPDATE, SB_UPDATE_SHADOWS))
        return sb_fail(err, SB_BAD_INPUT,
                       "update=lights+shadows: no light casts shadows; valid with "
                       "shadows=0: static lights");
    if (casters == 0)
        return true;
    if (casters > points)
        return sb_fail(
            err, SB_BAD_INPUT,
            "shadows=%d: point lights cast them, and there are %d; valid: 0 to "
            "%d",
            casters, points, points);
    return check_language(axes, caps, variant, err) &&
           check_units(axes, caps, variant, err) &&
           check_layers(axes, caps, variant, err) && check_size(axes, caps, variant, err);
}
