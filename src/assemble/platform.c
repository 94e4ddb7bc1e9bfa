#include <stdlib.h>
#include <string.h>

#include "assemble/platform.h"

// The environment of each value of the driver axis. Mesa: docs.mesa3d.org/envvars.html
static const struct {
    int driver;
    const char *name, *value; // NULL: must not be set
} environment[] = {
    {SB_DRIVER_LLVMPIPE, "LIBGL_ALWAYS_SOFTWARE", "1"},
    {SB_DRIVER_LLVMPIPE, "GALLIUM_DRIVER", "llvmpipe"},
    {SB_DRIVER_LLVMPIPE, "MESA_LOADER_DRIVER_OVERRIDE", NULL},
    {SB_DRIVER_SOFTPIPE, "LIBGL_ALWAYS_SOFTWARE", "1"},
    {SB_DRIVER_SOFTPIPE, "GALLIUM_DRIVER", "softpipe"},
    {SB_DRIVER_SOFTPIPE, "MESA_LOADER_DRIVER_OVERRIDE", NULL},
    {SB_DRIVER_ZINK, "LIBGL_ALWAYS_SOFTWARE", "1"},
    {SB_DRIVER_ZINK, "GALLIUM_DRIVER", "zink"},
    {SB_DRIVER_ZINK, "MESA_LOADER_DRIVER_OVERRIDE", "zink"},
};

// Asked for by name, a driver wins over what the environment says: a row must not name one
// and measure another.
static void set_driver(int driver)
{
    for (size_t i = 0; i < sizeof environment / sizeof *environment; i++) {
        if (environment[i].driver != driver)
            continue;
        if (environment[i].value)
            setenv(environment[i].name, environment[i].value, 1);
        else
            unsetenv(environment[i].name);
    }
    if (driver == SB_DRIVER_ZINK)
        setenv("XDG_RUNTIME_DIR", "/tmp", 0); // lavapipe's loader wants one
}

// Mesa offers program binaries only where its own disk cache is not disabled. Without a folder that
// cache keeps nothing, which is as good as off. Whoever has switched it on keeps it.
static void set_binaries(void)
{
    const char *off = getenv("MESA_SHADER_CACHE_DISABLE");
    if (off && off[0] && strchr("0nNfF", off[0]))
        return;
    setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
    setenv("MESA_SHADER_CACHE_DIR", "/dev/null", 1);
}

static bool check_equal(const struct sb_suite *suite, struct sb_error *err)
{
    const struct sb_variant *first = &suite->entry[0].variant;
    for (int a = 0; a < suite->axes.count; a++) {
        // The GLSL version is a matter of each program, not of the context.
        if (suite->axes.row[a].kind != SB_PLATFORM || a == SB_AXIS_GLSL)
            continue;
        for (int i = 1; i < suite->entry_count; i++)
            if (suite->entry[i].variant.value[a] != first->value[a])
                return sb_fail(err, SB_BAD_INPUT,
                               "%s differs between variants; one run has one driver, so "
                               "give it in `base` or with --%s, and run once for each",
                               suite->axes.row[a].name, suite->axes.row[a].name);
    }
    return true;
}

const char *sb_platform_differs(const struct sb_suite *a, const struct sb_suite *b)
{
    for (int axis = 0; axis < a->axes.count; axis++)
        if (a->axes.row[axis].kind == SB_PLATFORM && axis != SB_AXIS_GLSL &&
            a->entry[0].variant.value[axis] != b->entry[0].variant.value[axis])
            return a->axes.row[axis].name;
    return NULL;
}

bool sb_platform_apply(const struct sb_suite *suite, struct sb_context_params *params,
                       struct sb_error *err)
{
    if (!check_equal(suite, err))
        return false;
    const double *value = suite->entry[0].variant.value;
    set_driver((int)value[SB_AXIS_DRIVER]);
    if (value[SB_AXIS_THREADS] >= 0) {
        char number[32];
        setenv("LP_NUM_THREADS", sb_number_text(value[SB_AXIS_THREADS], number), 1);
    }
    if (params->program_cache)
        set_binaries();
    // A compile time that a disk cache answered is not one; whoever wants it can say so.
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
    setenv("__GL_SHADER_DISK_CACHE", "0", 0);
    const struct sb_axis *context = &suite->axes.row[SB_AXIS_CONTEXT];
    params->context = context->values[(int)value[SB_AXIS_CONTEXT]].name;
    params->gles = value[SB_AXIS_API] == SB_API_GLES;
    return true;
}

void sb_platform_record(const struct sb_caps *caps, struct sb_variant *variant)
{
    const struct sb_axis *context = &sb_axes_builtin()->row[SB_AXIS_CONTEXT];
    const int value = sb_axis_value_find(context, caps->context);
    if (value >= 0)
        variant->value[SB_AXIS_CONTEXT] = value;
}

// What each term stands on. A varying is what both stages declare, and maps are looked up for
// each fragment, wherever the lighting is evaluated.
static const struct {
    int axis;
    enum sb_carrier carrier;
    bool follows; // the stage that lights; else the fragment stage
} terms[SB_PRECISION_TERMS] = {
    {SB_AXIS_P_POSITION, SB_CARRIER_ARITHMETIC, true},
    {SB_AXIS_P_VECTOR, SB_CARRIER_ARITHMETIC, true},
    {SB_AXIS_P_ATTENUATION, SB_CARRIER_ARITHMETIC, true},
    {SB_AXIS_P_SPECULAR, SB_CARRIER_ARITHMETIC, true},
    {SB_AXIS_P_COLOR, SB_CARRIER_ARITHMETIC, true},
    {SB_AXIS_P_SUM, SB_CARRIER_ARITHMETIC, true},
    {SB_AXIS_P_OUTPUT, SB_CARRIER_OUTPUT, false},
    {SB_AXIS_P_VARYING, SB_CARRIER_VARYING, false},
    {SB_AXIS_P_UNIFORM, SB_CARRIER_UNIFORM, true},
    {SB_AXIS_P_SAMPLER, SB_CARRIER_SAMPLER, false},
};

struct sb_asked_precision sb_platform_precision(const struct sb_variant *variant)
{
    static const enum sb_emulation emulations[] = {
        [SB_EMULATE_NONE] = SB_EMULATED_NOT,
        [SB_EMULATE_FP16] = SB_EMULATED_FP16,
        [SB_EMULATE_FIXED10] = SB_EMULATED_FIXED10,
    };
    const double *value = variant->value;
    struct sb_asked_precision asked = {
        .vertex_stage = value[SB_AXIS_STAGE] == SB_STAGE_VERTEX,
        .emulation = emulations[(int)value[SB_AXIS_EMULATE]],
    };
    for (int i = 0; i < SB_PRECISION_TERMS; i++) {
        struct sb_asked_term *term = &asked.term[i];
        // Each of these axes has highp, mediump, lowp in this order.
        const int precision = (int)value[terms[i].axis];
        *term = (struct sb_asked_term){
            .name = sb_axes_builtin()->row[terms[i].axis].name,
            .precision = precision,
            .declared = precision,
            .vertex_stage = terms[i].follows && asked.vertex_stage,
            .carrier = terms[i].carrier,
        };
        if (terms[i].axis == SB_AXIS_P_OUTPUT && value[SB_AXIS_GLSL] == SB_GLSL_100)
            term->declared = 1;
        if (precision > asked.lowest)
            asked.lowest = precision;
    }
    return asked;
}

bool sb_platform_undefined(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_TEXT] == SB_TEXT_AS_WRITTEN &&
           variant->value[SB_AXIS_SOURCE] == SB_SOURCE_UBO;
}

static bool is_robust(const struct sb_variant *variant)
{
    static const int forms[] = {
        SB_AXIS_F_UNIT, SB_AXIS_F_ATTENUATION, SB_AXIS_F_CONE,   SB_AXIS_F_HIGHLIGHT,
        SB_AXIS_F_AREA, SB_AXIS_F_FRAME,       SB_AXIS_F_OUTPUT, SB_AXIS_F_SHADOW};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (variant->value[forms[i]] !=
            0) // each of these axes has robust, naive in this order
            return false;
    return true;
}

bool sb_platform_class_exact(const struct sb_variant *variant)
{
    return !sb_platform_undefined(variant) &&
           sb_platform_precision(variant).lowest == 0 && is_robust(variant) &&
           variant->value[SB_AXIS_EMULATE] == SB_EMULATE_NONE &&
           variant->value[SB_AXIS_OFFSET] == 0;
}

bool sb_platform_pair_exact(const struct sb_variant *a, const struct sb_variant *b)
{
    const bool one_origin = (a->value[SB_AXIS_SPACE] == SB_SPACE_EYE) ==
                            (b->value[SB_AXIS_SPACE] == SB_SPACE_EYE);
    return sb_platform_class_exact(a) &&
           (one_origin || a->value[SB_AXIS_MAPS] == SB_MAPS_NONE);
}

double sb_platform_left_out(const struct sb_variant *variant)
{
    const int policy = (int)variant->value[SB_AXIS_SPECIALISE];
    return policy == SB_SPECIALISE_SCENE || policy == SB_SPECIALISE_OBJECT
               ? variant->value[SB_AXIS_THRESHOLD]
               : 0;
}

bool sb_platform_pair_asked(const struct sb_variant *a, const struct sb_variant *b)
{
    return a->value[SB_AXIS_SPECIALISE] == SB_SPECIALISE_ASKED &&
           b->value[SB_AXIS_SPECIALISE] == SB_SPECIALISE_ASKED;
}

bool sb_platform_leaves_out(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_WITHOUT] != SB_WITHOUT_NOTHING;
}

bool sb_platform_held_against(const struct sb_axes *axes, const struct sb_variant *other,
                              const struct sb_variant *variant)
{
    struct sb_variant twin = *variant;
    if (sb_platform_leaves_out(variant)) {
        twin.value[SB_AXIS_WITHOUT] = SB_WITHOUT_NOTHING;
        return sb_variant_equal(axes, other, &twin);
    }
    twin.value[SB_AXIS_THRESHOLD] = other->value[SB_AXIS_THRESHOLD];
    return other->value[SB_AXIS_SPECIALISE] == SB_SPECIALISE_UBER &&
           sb_platform_is_policy(variant) && sb_variant_same_class(axes, other, &twin);
}

bool sb_platform_is_policy(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_SPECIALISE] != SB_SPECIALISE_ASKED &&
           !sb_platform_leaves_out(variant);
}
