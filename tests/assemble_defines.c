#include "assemble_words.h"

#include "effects/effects.h"

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
        assert_int_equal(defines_of(assembly.vertex.text, axes->row[i].define, value), 1);
        assert_int_equal(defines_of(assembly.fragment.text, axes->row[i].define, value),
                         1);
    }
    check_define(&assembly.fragment, "NR_POINT_LIGHTS", " 2");
    check_define(&assembly.fragment, "NR_DIR_LIGHTS", " 0");
    check_define(&assembly.fragment, "CONE", " smooth");
    check_define(&assembly.fragment, "STORAGE", " uniform");
    check_define(&assembly.fragment, "P_VECTOR", " highp");
    check_define(&assembly.fragment, "SHADOW_BIAS", " 0.01");
    check_define(&assembly.fragment, "GLSL_FAMILY", " gl");
    sb_assembly_free(&assembly);
}

// The text that comes from files.
static const char *body(const struct sb_glsl_source *source)
{
    const char *at = source->text;
    for (int i = 0; i < source->line_count && source->line[i].file < 0; i++)
        at = strchr(at, '\n') + 1;
    return at;
}

// Picks another file, or stands in one.
static bool makes_a_difference(const struct sb_axis *axis, const struct sb_assembly *a,
                               const struct sb_assembly *b)
{
    return strcmp(body(&a->vertex), body(&b->vertex)) != 0 ||
           strcmp(body(&a->fragment), body(&b->fragment)) != 0 ||
           strstr(body(&b->vertex), axis->define) ||
           strstr(body(&b->fragment), axis->define);
}

static void check_axis(const struct sb_axis *axis, const char *word,
                       const struct sb_assembly *first, const char *base)
{
    char words[128];
    snprintf(words, sizeof words, "%s %s=%s", base, axis->name, word);
    struct sb_assembly other;
    assemble(words, &other);
    if (other.source_hash == first->source_hash ||
        !makes_a_difference(axis, first, &other))
        fail_msg("%s: the same shaders as %s", words, base);
    sb_assembly_free(&other);
}

static void every_implemented_value_of_a_macro_axis_makes_other_shaders(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    const char *const base = "dir=1 point=2 spot=1";
    struct sb_assembly first;
    assemble(base, &first);
    for (int i = 0; i < axes->count; i++) {
        const struct sb_axis *axis = &axes->row[i];
        if (!*axis->define || (axis->flags & SB_TODO) ||
            sb_variant_moot(axes, &first.job.variant, i))
            continue;
        if (!axis->values)
            check_axis(axis, "3", &first, base);
        for (int v = 0; v < axis->value_count; v++)
            if (v != (int)first.job.variant.value[i] &&
                !(axis->values[v].flags & SB_TODO) && i != SB_AXIS_STORAGE)
                check_axis(axis, axis->values[v].name, &first, base);
    }
    check_axis(&axes->row[SB_AXIS_STORAGE], "ubo_std140", &first, base);
    sb_assembly_free(&first);
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
    check_define(&assembly.vertex, "RIM", " 1.5");
    check_define(&assembly.vertex, "BEND", " 2.0");
    check_define(&assembly.vertex, "TAPS", " 3");
    const uint64_t hash = assembly.source_hash;
    sb_assembly_free(&assembly);
    assert_true(
        assemble_with(&axes, "rim=sharp bend=-0.25 taps=-3", NULL, &assembly, &err));
    check_define(&assembly.fragment, "RIM", " 1");
    check_define(&assembly.fragment, "BEND", " (-0.25)");
    check_define(&assembly.fragment, "TAPS", " (-3)");
    assert_true(assembly.source_hash != hash);
    sb_assembly_free(&assembly);
}

static void a_macro_that_shadebench_defines_itself_is_refused(void **state)
{
    (void)state;
    static const char *const taken[] = {"GLSL_FAMILY", "IF_SPECULAR"};
    for (int i = 0; i < 2; i++) {
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
    DIFFUSE = 1 << SB_EFFECT_DIFFUSE,
    SPECULAR = 1 << SB_EFFECT_SPECULAR,
    ATTENUATION = 1 << SB_EFFECT_ATTENUATION,
    CONE = 1 << SB_EFFECT_CONE,
    DIFFUSE_MAP = 1 << SB_EFFECT_DIFFUSE_MAP,
    SPECULAR_MAP = 1 << SB_EFFECT_SPECULAR_MAP,
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
    {"point=1 maps=diffuse+specular",
     AMBIENT | DIFFUSE | SPECULAR | ATTENUATION | DIFFUSE_MAP | SPECULAR_MAP},
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
            check_define(&assembly.vertex, sb_effect_rows[e].macro, value);
            check_define(&assembly.fragment, sb_effect_rows[e].macro, value);
        }
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
        cmocka_unit_test(every_implemented_value_of_a_macro_axis_makes_other_shaders),
        cmocka_unit_test(an_axis_without_a_macro_leaves_the_source_alone),
        cmocka_unit_test(the_axes_of_a_suite_are_defined_too),
        cmocka_unit_test(a_macro_that_shadebench_defines_itself_is_refused),
        cmocka_unit_test(each_effect_is_called_for_where_it_can_change_a_pixel),
        cmocka_unit_test(the_macro_of_an_effect_vanishes_where_it_is_not_called_for),
        cmocka_unit_test(the_condition_of_every_effect_parses),
    };
    return run_tests(tests);
}
