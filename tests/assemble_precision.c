// From the precision axes of a variant to what each term stands on.
#include "test.h"

#include "assemble/platform.h"

static struct sb_asked_precision asked_by(const char *words)
{
    struct sb_variant variant;
    struct sb_error err = {0};
    char given[200];
    snprintf(given, sizeof given, "%s", words);
    sb_variant_init(sb_axes_builtin(), &variant);
    for (char *rest = given, *word; (word = strtok_r(rest, ",", &rest)) != NULL;) {
        char *value = strchr(word, '=');
        *value++ = '\0';
        const int axis = sb_axes_find(sb_axes_builtin(), word);
        const int number = sb_axis_value_find(&sb_axes_builtin()->row[axis], value);
        assert_true(axis >= 0 && number >= 0);
        sb_variant_put(&variant, axis, number);
    }
    sb_variant_resolve(sb_axes_builtin(), &variant, &err); // emulation may be refused
    return sb_platform_precision(&variant);
}

static const struct sb_asked_term *term_of(const struct sb_asked_precision *asked,
                                           const char *name)
{
    for (int i = 0; i < SB_PRECISION_TERMS; i++)
        if (strcmp(asked->term[i].name, name) == 0)
            return &asked->term[i];
    fail_msg("no term %s", name);
    return NULL;
}

static void every_precision_axis_is_a_term(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    const struct sb_asked_precision asked = asked_by("precision=highp");
    int place = 0;
    for (int a = 0; a < axes->count; a++)
        if (strncmp(axes->row[a].name, "p_", 2) == 0) {
            assert_true(place < SB_PRECISION_TERMS);
            assert_string_equal(asked.term[place++].name, axes->row[a].name);
        }
    assert_int_equal(place, SB_PRECISION_TERMS);
}

static void each_term_stands_on_its_carrier_in_the_stage_that_has_it(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        enum sb_carrier carrier;
        bool follows; // the stage that lights
    } wanted[] = {
        {"p_position", SB_CARRIER_ARITHMETIC, true},
        {"p_vector", SB_CARRIER_ARITHMETIC, true},
        {"p_attenuation", SB_CARRIER_ARITHMETIC, true},
        {"p_specular", SB_CARRIER_ARITHMETIC, true},
        {"p_color", SB_CARRIER_ARITHMETIC, true},
        {"p_sum", SB_CARRIER_ARITHMETIC, true},
        {"p_uniform", SB_CARRIER_UNIFORM, true},
        {"p_varying", SB_CARRIER_VARYING, false},
        {"p_sampler", SB_CARRIER_SAMPLER, false},
        {"p_output", SB_CARRIER_OUTPUT, false},
    };
    for (int stage = 0; stage < 2; stage++) {
        const struct sb_asked_precision asked =
            asked_by(stage ? "stage=vertex" : "stage=fragment");
        assert_int_equal(asked.vertex_stage, stage);
        for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
            const struct sb_asked_term *term = term_of(&asked, wanted[i].name);
            assert_int_equal(term->carrier, wanted[i].carrier);
            assert_int_equal(term->vertex_stage, stage && wanted[i].follows);
        }
    }
}

static void terms_have_the_precision_that_shorthand_and_axes_give_them(void **state)
{
    (void)state;
    struct sb_asked_precision asked = asked_by("precision=highp");
    assert_int_equal(asked.lowest, 0);
    asked = asked_by("precision=mediump,p_position=highp,p_color=lowp");
    assert_int_equal(asked.lowest, 2);
    for (int i = 0; i < SB_PRECISION_TERMS; i++) {
        const struct sb_asked_term *term = &asked.term[i];
        assert_int_equal(term->precision, strcmp(term->name, "p_position") == 0 ? 0
                                          : strcmp(term->name, "p_color") == 0  ? 2
                                                                                : 1);
        assert_int_equal(term->declared, term->precision);
    }
    asked = asked_by("p_sampler=mediump"); // the last of the table
    assert_int_equal(asked.lowest, 1);
}

static void the_output_of_glsl_es_100_is_mediump_whatever_is_asked_for(void **state)
{
    (void)state;
    const struct sb_asked_precision asked = asked_by("api=gles,glsl=100,precision=highp");
    assert_int_equal(term_of(&asked, "p_output")->precision, 0);
    assert_int_equal(term_of(&asked, "p_output")->declared, 1);
    assert_int_equal(term_of(&asked, "p_sum")->declared, 0);
    assert_int_equal(asked.lowest, 0);
}

static void emulation_is_told_by_its_axis(void **state)
{
    (void)state;
    assert_int_equal(asked_by("emulate=none").emulation, SB_EMULATED_NOT);
    assert_int_equal(asked_by("emulate=fp16").emulation, SB_EMULATED_FP16);
    assert_int_equal(asked_by("emulate=fixed10").emulation, SB_EMULATED_FIXED10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_precision_axis_is_a_term),
        cmocka_unit_test(each_term_stands_on_its_carrier_in_the_stage_that_has_it),
        cmocka_unit_test(terms_have_the_precision_that_shorthand_and_axes_give_them),
        cmocka_unit_test(the_output_of_glsl_es_100_is_mediump_whatever_is_asked_for),
        cmocka_unit_test(emulation_is_told_by_its_axis),
    };
    return run_tests(tests);
}
