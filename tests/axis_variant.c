#include "test.h"

#include "axis/variant.h"

static struct sb_axes axes;
static struct sb_variant v;
static struct sb_error err;
static struct sb_text text;

static int use_default(void **state)
{
    (void)state;
    axes = *sb_axes_builtin();
    sb_variant_init(&axes, &v);
    err = (struct sb_error){0};
    return 0;
}

static int free_text(void **state)
{
    (void)state;
    sb_text_free(&text);
    return 0;
}

// "axis=value,axis=value", as an id is written, onto `variant`.
static void set_all(struct sb_variant *variant, const char *words)
{
    char copy[512];
    snprintf(copy, sizeof copy, "%s", words);
    for (char *rest = copy, *word; (word = strtok_r(rest, ",", &rest));) {
        char *const equals = strchr(word, '=');
        assert_non_null(equals);
        *equals = '\0';
        const int axis = sb_axes_expect(&axes, word, &err);
        if (axis < 0 || !sb_variant_set(&axes, variant, axis, equals + 1, &err))
            fail_msg("%s", err.text);
    }
}

static struct sb_variant resolved(const char *words)
{
    struct sb_variant made;
    sb_variant_init(&axes, &made);
    set_all(&made, words);
    if (!sb_variant_resolve(&axes, &made, &err))
        fail_msg("%s: %s", words, err.text);
    return made;
}

static const char *id_of(const struct sb_variant *variant)
{
    sb_text_clear(&text);
    sb_variant_id(&axes, variant, &text);
    return sb_text_get(&text);
}

static const char *value_of(const struct sb_variant *variant, int axis)
{
    sb_text_clear(&text);
    sb_variant_value_text(&axes, variant, axis, &text);
    return sb_text_get(&text);
}

static void the_default_variant_resolves_to_itself(void **state)
{
    (void)state;
    const struct sb_variant before = v;
    assert_true(sb_variant_resolve(&axes, &v, &err));
    assert_memory_equal(&before, &v, sizeof v);
    assert_string_equal(id_of(&v), "default");
}

// So every init is implemented; that of a moot axis need not be, as nothing reads it.
static void every_init_that_counts_can_be_set_by_its_own_text(void **state)
{
    (void)state;
    for (int i = 0; i < axes.count; i++)
        if (!sb_variant_moot(&axes, &v, i)) {
            const double init = v.value[i];
            if (!sb_variant_set(&axes, &v, i, value_of(&v, i), &err))
                fail_msg("%s", err.text);
            assert_true(v.value[i] == init);
        }
}

static void every_value_of_every_axis_prints_and_parses_alike(void **state)
{
    (void)state;
    for (int i = 0; i < axes.count; i++) {
        struct sb_axis *const axis = &axes.row[i];
        axis->flags &= ~(unsigned)SB_TODO;
        axis->when = "";
        const int steps = axis->values ? axis->value_count - 1 : 64;
        for (int k = 0; k <= steps; k++) {
            double value = axis->min + (axis->max - axis->min) * k / steps;
            if (axis->flags & SB_WHOLE)
                value = floor(value);
            sb_variant_put(&v, i, value);
            if (axis->values) // places, for a value may be refused as not implemented
                assert_int_equal(sb_axis_value_find(axis, value_of(&v, i)), k);
            else if (!sb_variant_set(&axes, &v, i, value_of(&v, i), &err))
                fail_msg("%s", err.text);
            assert_true(v.value[i] == value);
        }
    }
}

static void an_id_parses_back_to_the_variant_it_names(void **state)
{
    (void)state;
    static const char *const words[] = {
        "point=4",
        "spot=3,cone=linear,stage=vertex",
        "precision=mediump,p_specular=highp",
        "offset=0.1,scale=1e-06,tessellation=4e+06,width=512",
        "api=gles,glsl=300es,target=rgba16f,maps=diffuse+specular",
        "threads=-1,dir=0",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const struct sb_variant first = resolved(words[i]);
        char id[512];
        snprintf(id, sizeof id, "%s", id_of(&first));
        const struct sb_variant second = resolved(id);
        assert_memory_equal(&first, &second, sizeof first);
        assert_string_equal(id_of(&second), id);
    }
}

static void an_id_is_in_table_order_whatever_the_order_of_the_words(void **state)
{
    (void)state;
    const struct sb_variant a = resolved("stage=vertex,spot=1,dir=2,api=gles");
    const struct sb_variant b = resolved("api=gles,dir=2,spot=1,stage=vertex");
    assert_string_equal(id_of(&a), "api=gles,dir=2,spot=1,stage=vertex");
    assert_string_equal(id_of(&b), "api=gles,dir=2,spot=1,stage=vertex");
}

static void numbers_that_are_equal_have_one_text(void **state)
{
    (void)state;
    assert_true(sb_variant_set(&axes, &v, SB_AXIS_POINT, "-0", &err));
    assert_string_equal(id_of(&v), "point=0");
    assert_true(sb_variant_set(&axes, &v, SB_AXIS_POINT, "8.0", &err));
    assert_string_equal(id_of(&v), "point=8");
}

static void shorthand_sets_what_was_not_given_by_name(void **state)
{
    (void)state;
    static const char *const orders[] = {"p_specular=highp,precision=mediump",
                                         "precision=mediump,p_specular=highp"};
    for (int i = 0; i < 2; i++) {
        const struct sb_variant mixed = resolved(orders[i]);
        for (int axis = SB_AXIS_P_POSITION; axis <= SB_AXIS_P_SAMPLER; axis++)
            assert_string_equal(value_of(&mixed, axis),
                                axis == SB_AXIS_P_SPECULAR ? "highp" : "mediump");
        assert_string_equal(id_of(&mixed), "precision=mediump,p_specular=highp");
    }
}

static void variants_compare_by_what_shorthand_stands_for(void **state)
{
    (void)state;
    const struct sb_variant plain = resolved("");
    const struct sb_variant same = resolved("precision=highp,point=0");
    const struct sb_variant other = resolved("precision=mediump");
    const struct sb_variant by_name =
        resolved("precision=mediump,p_position=highp,p_vector=highp,p_attenuation=highp,"
                 "p_specular=highp,p_color=highp,p_sum=highp,p_output=highp,"
                 "p_varying=highp,p_uniform=highp,p_sampler=highp");
    assert_true(sb_variant_equal(&axes, &plain, &same));
    assert_true(sb_variant_equal(&axes, &plain, &by_name));
    assert_false(sb_variant_equal(&axes, &plain, &other));
    assert_true(sb_variant_hash(&axes, &plain) == sb_variant_hash(&axes, &by_name));
    assert_true(sb_variant_hash(&axes, &plain) != sb_variant_hash(&axes, &other));
}

static void a_class_leaves_out_the_implementation_axes_only(void **state)
{
    (void)state;
    for (int i = 0; i < axes.count; i++) {
        struct sb_variant other = v;
        sb_variant_put(&other, i, axes.row[i].init == 0 ? 1 : 0);
        const bool implementation = axes.row[i].kind == SB_IMPLEMENTATION;
        const bool shorthand = i == SB_AXIS_PRECISION || i == SB_AXIS_FORM;
        assert_int_equal(sb_variant_equal(&axes, &v, &other), shorthand);
        assert_int_equal(sb_variant_same_class(&axes, &v, &other),
                         shorthand || implementation);
    }
}

static void a_moot_axis_takes_init_even_when_given_and_leaves_the_id(void **state)
{
    (void)state;
    const struct sb_variant moot = resolved("point=1,cone=hard");
    assert_true(sb_variant_moot(&axes, &moot, SB_AXIS_CONE));
    assert_true(moot.value[SB_AXIS_CONE] == SB_CONE_SMOOTH);
    assert_string_equal(value_of(&moot, SB_AXIS_CONE), "");
    assert_string_equal(id_of(&moot), "point=1");
    const struct sb_variant plain = resolved("point=1");
    assert_true(sb_variant_equal(&axes, &moot, &plain));

    const struct sb_variant live = resolved("spot=1,cone=hard");
    assert_false(sb_variant_moot(&axes, &live, SB_AXIS_CONE));
    assert_string_equal(id_of(&live), "spot=1,cone=hard");
    assert_true(sb_variant_moot(&axes, &plain, SB_AXIS_CONE));
    // attenuation: point>0|spot>0|area>0
    const struct sb_variant sun = resolved("dir=1,attenuation=none");
    assert_string_equal(id_of(&sun), "dir=1");
    // normalise: stage=fragment
    const struct sb_variant vertex = resolved("stage=vertex,normalise=off");
    assert_string_equal(id_of(&vertex), "stage=vertex");
}

static const struct sb_value off_on[] = {{"off", "0", "", "", 0}, {"on", "1", "", "", 0}};

static int add_switch(const char *name, const char *when, const char *needs)
{
    const struct sb_axis row = {name, "",     when, needs, "", SB_QUALITY,
                                0,    off_on, 2,    0,     0,  1};
    if (!sb_axes_add(&axes, &row, &err))
        fail_msg("%s", err.text);
    return axes.count - 1;
}

static void what_depends_on_a_moot_axis_is_judged_by_its_init(void **state)
{
    (void)state;
    const int first = add_switch("first", "spot>0", "");
    const int second = add_switch("second", "first=on", "");
    const int third = add_switch("third", "second=on", "");
    const struct sb_variant live = resolved("spot=1,first=on,second=on,third=on");
    assert_string_equal(id_of(&live), "spot=1,first=on,second=on,third=on");
    const struct sb_variant moot = resolved("first=on,second=on,third=on");
    assert_true(moot.value[first] == 0 && moot.value[second] == 0 &&
                moot.value[third] == 0);
    assert_string_equal(id_of(&moot), "default");
}

static void an_axis_needs_what_it_needs_unless_at_init_or_moot(void **state)
{
    (void)state;
    const int axis = add_switch("block_order", "point>0", "storage=ubo_std140");
    resolved("point=1,block_order=off");
    resolved("point=1,block_order=on,storage=ubo_std140");
    resolved("point=0,block_order=on");
    set_all(&v, "point=1");
    assert_true(sb_variant_set(&axes, &v, axis, "on", &err));
    assert_false(sb_variant_resolve(&axes, &v, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, "block_order=on needs storage=ubo_std140");
}

static void a_variant_that_fails_its_checks_is_expanded_all_the_same(void **state)
{
    (void)state;
    add_switch("block_order", "", "storage=ubo_std140");
    sb_variant_init(&axes, &v);
    set_all(&v, "block_order=on,precision=mediump,cone=hard");
    assert_false(sb_variant_resolve(&axes, &v, &err));
    assert_true(v.value[SB_AXIS_P_SUM] == SB_P_SUM_MEDIUMP);
    assert_true(v.value[SB_AXIS_CONE] == SB_CONE_SMOOTH);
}

static void not_set(int axis, const char *word, enum sb_status status, const char *part)
{
    const struct sb_variant before = v;
    assert_false(sb_variant_set(&axes, &v, axis, word, &err));
    assert_int_equal(err.status, status);
    check_contains(err.text, part);
    assert_memory_equal(&before, &v, sizeof v);
}

static void bad_words_are_refused_with_the_valid_ones(void **state)
{
    (void)state;
    not_set(SB_AXIS_STAGE, "vretex", SB_BAD_INPUT,
            "stage: unknown value \"vretex\"; did you mean \"vertex\"? valid: fragment "
            "vertex");
    not_set(SB_AXIS_STAGE, "1", SB_BAD_INPUT, "unknown value \"1\"");
    not_set(SB_AXIS_POINT, "1000000000", SB_BAD_INPUT,
            "point: 1000000000 is out of range; valid: whole numbers from 0 to 256");
    not_set(SB_AXIS_POINT, "-1", SB_BAD_INPUT, "out of range");
    not_set(SB_AXIS_POINT, "4x", SB_BAD_INPUT,
            "point: \"4x\" is not a number; valid: whole numbers from 0 to 256");
    not_set(SB_AXIS_POINT, "", SB_BAD_INPUT, "is not a number");
    not_set(SB_AXIS_POINT, "nan", SB_BAD_INPUT, "is not a number");
    not_set(SB_AXIS_POINT, "2.5", SB_BAD_INPUT,
            "point: 2.5 is not a whole number; valid: wh");
    not_set(SB_AXIS_SCALE, "0", SB_BAD_INPUT,
            "scale: 0 is out of range; valid: numbers from");
}

static void what_is_not_implemented_is_refused_by_set_and_by_resolve(void **state)
{
    (void)state;
    static const struct sb_value curve[] = {
        {"line", "", "", "", 0}, {"arc", "", "", "", 0}, {"spiral", "", "", "", SB_TODO}};
    static const struct sb_value knot[] = {{"reef", "", "", "", SB_TODO}};
    const struct sb_axis rows[] = {
        {"curve", "", "spot>0", "", "", SB_QUALITY, 0, curve, 3, 0, 0, 2},
        {"turns", "", "", "", "", SB_QUALITY, SB_WHOLE | SB_TODO, NULL, 0, 0, 0, 9},
        {"knot", "", "", "", "", SB_QUALITY, 0, knot, 1, 0, 0, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_true(sb_axes_add(&axes, &rows[i], &err));
    const int first = axes.count - 3;
    not_set(first, "spiral", SB_NOT_IMPLEMENTED,
            "curve=spiral: not implemented yet; implemented: line arc");
    not_set(first + 1, "4", SB_NOT_IMPLEMENTED,
            "turns=4: not implemented yet; implemented: 0");
    not_set(first + 2, "reef", SB_NOT_IMPLEMENTED, "implemented: none");
    assert_true(sb_variant_set(&axes, &v, first + 1, "0", &err));
    axes.row[first + 2].values = curve; // for resolve, one that is
    sb_variant_put(&v, SB_AXIS_SPOT, 1);
    sb_variant_put(&v, first, 2);
    assert_false(sb_variant_resolve(&axes, &v, &err));
    assert_int_equal(err.status, SB_NOT_IMPLEMENTED);
    sb_variant_put(&v, SB_AXIS_SPOT, 0); // moot now, so at init
    assert_true(sb_variant_resolve(&axes, &v, &err));
}

static void values_that_no_input_can_give_are_refused_by_resolve(void **state)
{
    (void)state;
    static const struct {
        int axis;
        double value;
    } bad[] = {{SB_AXIS_STAGE, 2},   {SB_AXIS_STAGE, -1},  {SB_AXIS_STAGE, 0.5},
               {SB_AXIS_POINT, 257}, {SB_AXIS_POINT, 0.5}, {SB_AXIS_SCALE, 0},
               {SB_AXIS_OFFSET, NAN}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        sb_variant_init(&axes, &v);
        sb_variant_put(&v, bad[i].axis, bad[i].value);
        assert_false(sb_variant_resolve(&axes, &v, &err));
        check_contains(err.text, axes.row[bad[i].axis].name);
    }
}

static void the_given_bit_of_every_row_is_its_own(void **state)
{
    (void)state;
    for (int i = 0; i < SB_AXIS_MAX; i++) {
        struct sb_variant one = {0};
        sb_variant_put(&one, i, 1);
        for (int k = 0; k < SB_AXIS_MAX; k++)
            assert_int_equal(sb_variant_given(&one, k), i == k);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, use_default, free_text)
    const struct CMUnitTest tests[] = {
        TEST(the_default_variant_resolves_to_itself),
        TEST(every_init_that_counts_can_be_set_by_its_own_text),
        TEST(every_value_of_every_axis_prints_and_parses_alike),
        TEST(an_id_parses_back_to_the_variant_it_names),
        TEST(an_id_is_in_table_order_whatever_the_order_of_the_words),
        TEST(numbers_that_are_equal_have_one_text),
        TEST(shorthand_sets_what_was_not_given_by_name),
        TEST(variants_compare_by_what_shorthand_stands_for),
        TEST(a_class_leaves_out_the_implementation_axes_only),
        TEST(a_moot_axis_takes_init_even_when_given_and_leaves_the_id),
        TEST(what_depends_on_a_moot_axis_is_judged_by_its_init),
        TEST(an_axis_needs_what_it_needs_unless_at_init_or_moot),
        TEST(a_variant_that_fails_its_checks_is_expanded_all_the_same),
        TEST(bad_words_are_refused_with_the_valid_ones),
        TEST(what_is_not_implemented_is_refused_by_set_and_by_resolve),
        TEST(values_that_no_input_can_give_are_refused_by_resolve),
        TEST(the_given_bit_of_every_row_is_its_own),
    };
    return run_tests(tests);
}
