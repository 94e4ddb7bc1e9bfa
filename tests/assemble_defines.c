#include "assemble_words.h"

#include "effects/effects.h"
#include "scene/lights.h"

// The lines of `text` that define `name`; *value is the rest of the last one.
static int defines_of(const char *text, const char *name, char value[static 128])
{
    int count = 0;
    char start[96];
    const int length = snprintf(start, sizeof start, "#define %s", name);
    for (const char *line = text; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncmp(line, start, (size_t)length) != 0 || !strchr(" (", line[length]))
            continue;
        count++;
        const char *rest = line + length;
        snprintf(value, 128, "%.*s", (int)strcspn(rest, "\n"), rest);
    }
    return count;
}

static void check_define(const struct sb_glsl_source *source, const char *name,
                         const char *expected)
{
    char value[128] = "";
    if (defines_of(source->text, name, value) != 1 || strcmp(value, expected) != 0)
        fail_msg("%s: wanted \"%s\", is \"%s\"", name, expected, value);
}

static void every_axis_with_a_macro_is_defined_once_in_both_stages(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    struct sb_assembly assembly;
    assemble("point=2 spot=1", &assembly);
    for (int i = 0; i < axes->count; i++) {
        char value[128];
        if (!*axes->row[i].define)
            continue;
        assert_int_equal(
            defines_of(shade_of(&assembly, VERTEX)->text, axes->row[i].define, value), 1);
        assert_int_equal(
            defines_of(shade_of(&assembly, FRAGMENT)->text, axes->row[i].define, value),
            1);
    }
    check_define(shade_of(&assembly, FRAGMENT), "NR_POINT_LIGHTS", " 2");
    check_define(shade_of(&assembly, FRAGMENT), "NR_DIR_LIGHTS", " 0");
    check_define(shade_of(&assembly, FRAGMENT), "CONE", " smooth");
    check_define(shade_of(&assembly, FRAGMENT), "STORAGE", " uniform");
    check_define(shade_of(&assembly, FRAGMENT), "P_VECTOR", " highp");
    check_define(shade_of(&assembly, FRAGMENT), "SHADOW_BIAS", " 0.01");
    check_define(shade_of(&assembly, FRAGMENT), "GLSL_FAMILY", " gl");
    sb_assembly_free(&assembly);
}

static void the_light_counts_are_those_that_shine_and_the_sizes_those_of_the_arrays(
    void **state)
{
    (void)state;
    static const struct {
        const char *words, *nr[SB_LIGHT_STRUCT_COUNT], *max[SB_LIGHT_STRUCT_COUNT];
    } rows[] = {
        {"dir=2 point=3 spot=1 area=4",
         {"2", "3", "1", "4", "10"},
         {"2", "3", "1", "4", "10"}},
        {"dir=2 point=3 sun=100", {"1", "3", "0", "0", "4"}, {"1", "3", "0", "0", "4"}},
        {"dir=2 sun=100 loop=padded point=3 capacity=5",
         {"1", "3", "0", "0", "4"},
         {"2", "5", "0", "0", "7"}},
        {"dir=1 loop=dynamic point=3 capacity=2",
         {"1", "3", "0", "0", "4"},
         {"1", "3", "0", "0", "4"}},
        {"dir=1 loop=padded point=3",
         {"1", "3", "0", "0", "4"},
         {"1", "3", "0", "0", "4"}},
        {"dir=1 loop=padded layout=unified point=1 capacity=5",
         {"1", "1", "0", "0", "2"},
         {"1", "1", "0", "0", "5"}},
        {"dir=1 loop=dynamic layout=unified point=5 spot=1 capacity=5",
         {"1", "5", "1", "0", "7"},
         {"1", "5", "1", "0", "7"}},
    };
    static const char *const names[] = {"DIR_LIGHTS", "POINT_LIGHTS", "SPOT_LIGHTS",
                                        "AREA_LIGHTS", "LIGHTS"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sb_assembly assembly;
        assemble(rows[i].words, &assembly);
        for (int row = 0; row < SB_LIGHT_STRUCT_COUNT; row++) {
            char name[32], value[32];
            snprintf(name, sizeof name, "NR_%s", names[row]);
            snprintf(value, sizeof value, " %s", rows[i].nr[row]);
            check_define(shade_of(&assembly, FRAGMENT), name, value);
            snprintf(name, sizeof name, "MAX_%s", names[row]);
            snprintf(value, sizeof value, " %s", rows[i].max[row]);
            check_define(shade_of(&assembly, FRAGMENT), name, value);
        }
        sb_assembly_free(&assembly);
    }
}

static void unrolled_loops_are_repetitions_and_casters_have_their_own(void **state)
{
    (void)state;
    char value[128];
    struct sb_assembly assembly;
    assemble("loop=unrolled dir=1 point=4 spot=2 shadows=2", &assembly);
    const struct sb_glsl_source *source = shade_of(&assembly, FRAGMENT);
    check_define(source, "UNROLLED_DIR", "(one) one(0)");
    check_define(source, "UNROLLED_POINT", "(one) one(2) one(3)");
    check_define(source, "UNROLLED_SPOT", "(one) one(0) one(1)");
    check_define(source, "UNROLLED_AREA", "(one) ");
    check_define(source, "UNROLLED_CASTER", "(one) one(0) one(1)");
    sb_assembly_free(&assembly);
    assemble("loop=unrolled layout=unified dir=2 sun=100 point=2", &assembly);
    check_define(shade_of(&assembly, FRAGMENT), "UNROLLED_LIGHT",
                 "(one) one(0) one(1) one(2)");
    sb_assembly_free(&assembly);
    assemble("point=2 shadows=1", &assembly);
    source = shade_of(&assembly, VERTEX);
    assert_int_equal(defines_of(source->text, "UNROLLED_POINT", value), 0);
    check_define(source, "UNROLLED_CASTER", "(one) one(0)");
    sb_assembly_free(&assembly);
}

static void slips_are_those_of_the_text_that_is_kept_as_written(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"", " none"},
        {"source=lwjgl", " none"},
        {"source=lwjgl text=as_written space=view", " lwjgl"},
        {"source=ubo text=as_written model=phong", " ubo"},
        {"source=delphi", " none"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sb_assembly assembly;
        assemble(rows[i][0], &assembly);
        check_define(shade_of(&assembly, FRAGMENT), "SLIPS", rows[i][1]);
        sb_assembly_free(&assembly);
    }
}

// The text that comes from files.
static const char *body(const struct sb_glsl_source *source)
{
    const char *at = source->text ? source->text : "";
    for (int i = 0; i < source->line_count && source->line[i].file < 0; i++)
        at = strchr(at, '\n') + 1;
    return at;
}

// A macro that has another value in the other head stands in this text.
static bool reads_what_differs(const struct sb_glsl_source *a,
                               const struct sb_glsl_source *b)
{
    for (int i = 0; i < b->line_count && b->line[i].file < 0; i++) {
        const char *line = b->text; // number i
        for (int skip = i; skip > 0; skip--)
            line = strchr(line, '\n') + 1;
        char name[96], here[128] = "", there[128] = "";
        if (sscanf(line, "#define %95[A-Z_0-9]", name) != 1)
            continue;
        defines_of(b->text, name, here);
        defines_of(a->text, name, there);
        if (strcmp(here, there) != 0 && strstr(body(b), name))
            return true;
    }
    return false;
}

// Picks another file, or stands in one, itself or in what is made of it.
static bool makes_a_difference(const struct sb_assembly *a, const struct sb_assembly *b)
{
    for (int role = 0; role < SB_ROLE_COUNT; role++)
        for (int stage = 0; stage < STAGES; stage++) {
            const struct sb_glsl_source *from =
                &sb_assembly_sources(a, (enum sb_role)role)[stage];
            const struct sb_glsl_source *to =
                &sb_assembly_sources(b, (enum sb_role)role)[stage];
            if (strcmp(body(from), body(to)) != 0 ||
                (to->text && reads_what_differs(from, to)))
                return true;
        }
    return false;
}

static bool can_have(const char *base, int axis, const char *word)
{
    const struct sb_axes *axes = sb_axes_builtin();
    struct sb_variant variant;
    struct sb_error err = {0};
    variant_of_words(axes, base, &variant);
    if (!sb_variant_set(axes, &variant, axis, word, &err))
        fail_msg("%s", err.text);
    return sb_variant_resolve(axes, &variant, &err) &&
           !sb_variant_moot(axes, &variant, axis);
}

static bool changes(int axis, const char *word, const char *base)
{
    char words[512];
    struct sb_error err = {0};
    struct sb_assembly first, other;
    snprintf(words, sizeof words, "%s %s=%s", base, sb_axes_builtin()->row[axis].name,
             word);
    assemble(base, &first);
    const bool changed = assemble_with(sb_axes_builtin(), words, NULL, &other, &err) &&
                         other.source_hash != first.source_hash &&
                         makes_a_difference(&first, &other);
    sb_assembly_free(&first);
    sb_assembly_free(&other);
    return changed;
}

// Not in every base: an array with room for seven lights is the same for two and for three.
static void check_value(int axis, const char *word)
{
    static const char *const bases[] = {
        "dir=1 point=2 spot=1 area=1 normalise=off loop=dynamic capacity=7",
        "dir=1 point=2 spot=1 area=1 model=phong ambient=none attenuation=none cone=hard "
        "area_shape=box specular_side=both fresnel=schlick specular_norm=energy "
        "maps=diffuse form=naive storage=global "
        "loop=padded hoist=per_light space=view guard=mask",
        "dir=1 point=2 layout=unified",
        "dir=1 point=2 stage=vertex",
        "dir=1 point=4 shadows=1",
        "dir=1 point=2 shadows=2 shadow_bias_kind=slope shadow_filter=4 shadow_store=r8 "
        "shadow_map=array2d shadow_pass=layered shadow_bias=0.5 shadow_size=64",
        "precision=mediump dir=1 point=2 spot=1 maps=diffuse+specular",
        "dir=1 maps=normal",
        "dir=1 maps=normal form=naive normal_store=rg",
        "point=2 shadows=1 form=naive",
        "area=1 form=naive maps=normal precision=mediump",
    };
    for (size_t i = 0; i < sizeof bases / sizeof *bases; i++)
        if (can_have(bases[i], axis, word) && changes(axis, word, bases[i]))
            return;
    fail_msg("%s=%s: the same shaders as without", sb_axes_builtin()->row[axis].name,
             word);
}

static void every_implemented_value_of_a_macro_axis_makes_other_shaders(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    for (int i = 0; i < axes->count; i++) {
        const struct sb_axis *axis = &axes->row[i];
        if (!*axis->define || (axis->flags & SB_TODO))
            continue;
        if (!axis->values)
            check_value(i, axis->flags & SB_WHOLE ? axis->min > 3 ? "32" : "3" : "0.25");
        for (int v = 0; v < axis->value_count; v++)
            if (!(axis->values[v].flags & SB_TODO) &&
                !(i == SB_AXIS_STORAGE && v == SB_STORAGE_AUTO))
                check_value(i, axis->values[v].name);
    }
}

static void an_axis_without_a_macro_leaves_the_source_alone(void **state)
{
    (void)state;
    struct sb_assembly first, second;
    assemble("point=1", &first);
    assemble("point=1 width=64 target=rgba32f offset=1000", &second);
    assert_true(first.source_hash == second.source_hash);
    sb_assembly_free(&first);
    sb_assembly_free(&second);
}

static const struct sb_value rims[] = {{"soft", "1.5", "", "", 0},
                                       {"sharp", "", "", "", 0}};

static void the_axes_of_a_suite_are_defined_too(void **state)
{
    (void)state;
    struct sb_axes axes = *sb_axes_builtin();
    struct sb_error err = {0};
    const struct sb_axis rows[] = {
        {.name = "rim",
         .define = "RIM",
         .when = "",
         .needs = "",
         .help = "h",
         .kind = SB_QUALITY,
         .values = rims,
         .value_count = 2},
        {.name = "bend",
         .define = "BEND",
         .when = "",
         .needs = "",
         .help = "h",
         .kind = SB_QUALITY,
         .init = 2,
         .min = -8,
         .max = 8},
        {.name = "taps",
         .define = "TAPS",
         .when = "",
         .needs = "",
         .help = "h",
         .kind = SB_QUALITY,
         .flags = SB_WHOLE,
         .init = 3,
         .min = -8,
         .max = 8},
    };
    for (int i = 0; i < 3; i++)
        if (!sb_axes_add(&axes, &rows[i], &err))
            fail_msg("%s", err.text);
    struct sb_assembly assembly;
    assert_true(assemble_with(&axes, "", NULL, &assembly, &err));
    check_define(shade_of(&assembly, VERTEX), "RIM", " 1.5");
    check_define(shade_of(&assembly, VERTEX), "BEND", " 2.0");
    check_define(shade_of(&assembly, VERTEX), "TAPS", " 3");
    const uint64_t hash = assembly.source_hash;
    sb_assembly_free(&assembly);
    assert_true(
        assemble_with(&axes, "rim=sharp bend=-0.25 taps=-3", NULL, &assembly, &err));
    check_define(shade_of(&assembly, FRAGMENT), "RIM", " 1");
    check_define(shade_of(&assembly, FRAGMENT), "BEND", " (-0.25)");
    check_define(shade_of(&assembly, FRAGMENT), "TAPS", " (-3)");
    assert_true(assembly.source_hash != hash);
    sb_assembly_free(&assembly);
}

static void a_macro_that_shadebench_defines_itself_is_refused(void **state)
{
    (void)state;
    static const char *const taken[] = {"GLSL_FAMILY", "IF_SPECULAR", "MAX_SPOT_LIGHTS",
                                        "NR_LIGHTS", "SLIPS"};
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        struct sb_axes axes = *sb_axes_builtin();
        struct sb_error err = {0};
        const struct sb_axis row = {.name = "mine",
                                    .define = taken[i],
                                    .when = "",
                                    .needs = "",
                                    .help = "h",
                                    .kind = SB_QUALITY,
                                    .max = 1};
        assert_true(sb_axes_add(&axes, &row, &err));
        struct sb_assembly assembly;
        assert_false(assemble_with(&axes, "", NULL, &assembly, &err));
        check_contains(err.text, taken[i]);
        sb_assembly_free(&assembly);
    }
}

static uint32_t effects_of(const char *words)
{
    struct sb_variant variant;
    variant_of_words(sb_axes_builtin(), words, &variant);
    return sb_effects_of(sb_axes_builtin(), &variant);
}

enum {
    AMBIENT = 1 << SB_EFFECT_AMBIENT,
    RENORMALISE = 1 << SB_EFFECT_RENORMALISE, // wherever fragments are lit
    DIFFUSE = 1 << SB_EFFECT_DIFFUSE | RENORMALISE,
    SPECULAR = 1 << SB_EFFECT_SPECULAR | 1 << SB_EFFECT_VIEW,
    SPECULAR_EACH = 1 << SB_EFFECT_SPECULAR | 1 << SB_EFFECT_VIEW_EACH,
    FRESNEL = 1 << SB_EFFECT_FRESNEL,
    SPECULAR_NORM = 1 << SB_EFFECT_SPECULAR_NORM,
    ATTENUATION =
        1 << SB_EFFECT_ATTENUATION | 1 << SB_EFFECT_LINEAR | 1 << SB_EFFECT_QUADRATIC,
    CONE = 1 << SB_EFFECT_CONE,
    DIFFUSE_MAP = 1 << SB_EFFECT_DIFFUSE_MAP,
    DIFFUSE_MAP_EACH = 1 << SB_EFFECT_DIFFUSE_MAP_EACH,
    SPECULAR_MAP = 1 << SB_EFFECT_SPECULAR_MAP,
    SPECULAR_MAP_EACH = 1 << SB_EFFECT_SPECULAR_MAP_EACH,
    NORMAL_MAP = 1 << SB_EFFECT_NORMAL_MAP,
};

static const struct {
    const char *words;
    uint32_t effects;
} calls[] = {
    {"", AMBIENT},
    {"ambient=none", 0},
    {"ambient=per_light", 0},
    {"ambient=none maps=diffuse+specular", DIFFUSE_MAP},
    {"ambient=none dir=1", DIFFUSE | SPECULAR},
    {"ambient=per_light dir=1 model=lambert", AMBIENT | DIFFUSE},
    {"ambient=none dir=1 model=lambert maps=diffuse+specular", DIFFUSE | DIFFUSE_MAP},
    {"ambient=none dir=1 model=phong maps=specular", DIFFUSE | SPECULAR | SPECULAR_MAP},
    {"point=1", AMBIENT | DIFFUSE | SPECULAR | ATTENUATION},
    {"point=1 attenuation=none", AMBIENT | DIFFUSE | SPECULAR},
    {"spot=1", AMBIENT | DIFFUSE | SPECULAR | ATTENUATION | CONE},
    {"spot=1 attenuation=none cone=hard", AMBIENT | DIFFUSE | SPECULAR | CONE},
    {"area=1", AMBIENT | DIFFUSE | SPECULAR | ATTENUATION},
    {"ambient=per_light area=1", AMBIENT | DIFFUSE | SPECULAR | ATTENUATION},
    {"point=1 maps=diffuse+specular",
     AMBIENT | DIFFUSE | SPECULAR | ATTENUATION | DIFFUSE_MAP | SPECULAR_MAP},
    {"ambient=none dir=1 maps=diffuse+specular+normal hoist=per_light",
     DIFFUSE | SPECULAR_EACH | DIFFUSE_MAP_EACH | SPECULAR_MAP_EACH | NORMAL_MAP},
    {"ambient=none dir=1 maps=diffuse+specular hoist=per_light stage=vertex",
     (DIFFUSE ^ RENORMALISE) | SPECULAR_EACH | DIFFUSE_MAP | SPECULAR_MAP},
    {"ambient=none dir=1 model=lambert normalise=off", DIFFUSE ^ RENORMALISE},
    {"ambient=none point=1 model=lambert attenuation=radius",
     DIFFUSE | 1 << SB_EFFECT_ATTENUATION},
    {"ambient=none dir=1 fresnel=schlick", DIFFUSE | SPECULAR | FRESNEL},
    {"ambient=none dir=1 model=phong specular_norm=energy",
     DIFFUSE | SPECULAR | SPECULAR_NORM},
    {"ambient=none dir=1 model=lambert fresnel=schlick specular_norm=energy", DIFFUSE},
    {"ambient=none fresnel=schlick specular_norm=energy", 0},
    {"ambient=none model=lambert dir=1 maps=normal", DIFFUSE | NORMAL_MAP},
};

static void each_effect_is_called_for_where_it_can_change_a_pixel(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        if (effects_of(calls[i].words) != calls[i].effects)
            fail_msg("\"%s\": effects %#x, wanted %#x", calls[i].words,
                     effects_of(calls[i].words), calls[i].effects);
}

static void the_macro_of_an_effect_vanishes_where_it_is_not_called_for(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        struct sb_assembly assembly;
        assemble(calls[i].words, &assembly);
        for (int e = 0; e < SB_EFFECT_COUNT; e++) {
            const bool wanted = calls[i].effects >> e & 1;
            const char *value = wanted ? "(code) code" : "(code) ";
            static const char *const kinds[] = {"IF_", "WITH_"};
            for (int k = 0; k < 2; k++) {
                char macro[64];
                snprintf(macro, sizeof macro, "%s%s", kinds[k], sb_effect_rows[e].stem);
                check_define(shade_of(&assembly, VERTEX), macro, value);
                check_define(shade_of(&assembly, FRAGMENT), macro, value);
            }
        }
        sb_assembly_free(&assembly);
    }
}

// A program that has room for a light holds the code for it; where the sun is down and no room
// is left, its code goes.
static void a_free_slot_calls_for_the_effects_of_its_light(void **state)
{
    (void)state;
    static const struct {
        const char *words, *macro, *value;
    } rows[] = {
        {"point=1 loop=padded", "IF_CONE", "(code) "},
        {"point=1 loop=padded capacity=2", "IF_CONE", "(code) "},
        {"point=1 spot=1 loop=padded capacity=2", "IF_CONE", "(code) code"},
        {"layout=unified loop=dynamic point=1 capacity=2", "IF_CONE", "(code) "},
        {"dir=1 sun=100", "IF_DIFFUSE", "(code) "},
        {"dir=1 sun=30", "IF_DIFFUSE", "(code) code"},
        {"dir=1 sun=100 loop=padded", "IF_DIFFUSE", "(code) code"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sb_assembly assembly;
        assemble(rows[i].words, &assembly);
        check_define(shade_of(&assembly, FRAGMENT), rows[i].macro, rows[i].value);
        sb_assembly_free(&assembly);
    }
}

static void the_condition_of_every_effect_parses(void **state)
{
    (void)state;
    for (int e = 0; e < SB_EFFECT_COUNT; e++) {
        struct sb_error err = {0};
        if (!sb_condition_check(sb_axes_builtin(), sb_effect_rows[e].when, &err))
            fail_msg("%s: %s", sb_effect_rows[e].name, err.text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_axis_with_a_macro_is_defined_once_in_both_stages),
        cmocka_unit_test(
            the_light_counts_are_those_that_shine_and_the_sizes_those_of_the_arrays),
        cmocka_unit_test(unrolled_loops_are_repetitions_and_casters_have_their_own),
        cmocka_unit_test(slips_are_those_of_the_text_that_is_kept_as_written),
        cmocka_unit_test(every_implemented_value_of_a_macro_axis_makes_other_shaders),
        cmocka_unit_test(an_axis_without_a_macro_leaves_the_source_alone),
        cmocka_unit_test(the_axes_of_a_suite_are_defined_too),
        cmocka_unit_test(a_macro_that_shadebench_defines_itself_is_refused),
        cmocka_unit_test(each_effect_is_called_for_where_it_can_change_a_pixel),
        cmocka_unit_test(the_macro_of_an_effect_vanishes_where_it_is_not_called_for),
        cmocka_unit_test(a_free_slot_calls_for_the_effects_of_its_light),
        cmocka_unit_test(the_condition_of_every_effect_parses),
    };
    return run_tests(tests);
}
