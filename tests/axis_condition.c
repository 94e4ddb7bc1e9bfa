#include "test.h"

#include "axis/variant.h"

static const struct sb_axes *axes;
static struct sb_variant v;
static struct sb_error err;

static int use_default(void **state)
{
    (void)state;
    axes = sb_axes_builtin();
    sb_variant_init(axes, &v);
    err = (struct sb_error){0};
    return 0;
}

static bool holds(const char *condition)
{
    if (!sb_condition_check(axes, condition, &err))
        fail_msg("%s", err.text);
    return sb_condition_holds(axes, condition, &v);
}

static void each_operator_compares_as_in_c(void **state)
{
    (void)state;
    for (int have = 0; have <= 4; have++) {
        sb_variant_put(&v, SB_AXIS_POINT, have);
        assert_int_equal(holds("point=2"), have == 2);
        assert_int_equal(holds("point!=2"), have != 2);
        assert_int_equal(holds("point<2"), have < 2);
        assert_int_equal(holds("point<=2"), have <= 2);
        assert_int_equal(holds("point>2"), have > 2);
        assert_int_equal(holds("point>=2"), have >= 2);
        assert_int_equal(holds("point > 1.5"), have > 1.5);
    }
}

static void words_compare_by_name(void **state)
{
    (void)state;
    assert_true(holds("stage=fragment"));
    assert_false(holds("stage=vertex"));
    assert_true(holds("stage!=vertex"));
    sb_variant_put(&v, SB_AXIS_MAPS, SB_MAPS_DS);
    assert_true(holds("maps=diffuse+specular"));
}

static void the_empty_condition_holds(void **state)
{
    (void)state;
    assert_true(holds(""));
    assert_true(holds("  "));
}

// Against C's own && and ||, over all 16 states of four terms.
static void comma_binds_stronger_than_bar(void **state)
{
    (void)state;
    for (int bits = 0; bits < 16; bits++) {
        const bool a = bits & 1, b = bits & 2, c = bits & 4, d = bits & 8;
        sb_variant_put(&v, SB_AXIS_DIR, a);
        sb_variant_put(&v, SB_AXIS_POINT, b);
        sb_variant_put(&v, SB_AXIS_SPOT, c);
        sb_variant_put(&v, SB_AXIS_AREA, d);
        assert_int_equal(holds("dir=1,point=1|spot=1,area=1"), (a && b) || (c && d));
        assert_int_equal(holds("dir=1|point=1,spot=1|area=1"), a || (b && c) || d);
        assert_int_equal(holds("dir=1 , point=1 , spot=1"), a && b && c);
        assert_int_equal(holds("dir=1 | point=1 | spot=1"), a || b || c);
    }
}

static void malformed_conditions_are_refused_and_do_not_hold(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"stage", "wanted: axis, one of"},
        {"stage vertex", "wanted: axis, one of"},
        {"stage=", "stage: unknown value \"\""},
        {"=vertex", "unknown axis \"\""},
        {"stage=vretex", "did you mean \"vertex\"? valid: fragment vertex"},
        {"stgae=vertex", "did you mean \"stage\"?"},
        {"stage<vertex", "stage: < is for numbers; valid here: = !="},
        {"stage==vertex", "stage: unknown value \"=vertex\""},
        {"point=x", "point: \"x\" is not a number"},
        {"point=", "point: \"\" is not a number"},
        {"point=inf", "is not a number"},
        {"point>0,", "wanted"},
        {"point>0|", "wanted"},
        {",point>0", "wanted"},
        {"|point>0", "wanted"},
        {"point>0||spot>0", "wanted"},
        {"point!0", "wanted"},
        {"point=1=1", "is not a number"},
        {",", "wanted"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        if (sb_condition_check(axes, bad[i][0], &err))
            fail_msg("\"%s\" was accepted", bad[i][0]);
        assert_int_equal(err.status, SB_BAD_INPUT);
        check_contains(err.text, bad[i][1]);
        sb_variant_put(&v, SB_AXIS_POINT, 1);
        assert_false(sb_condition_holds(axes, bad[i][0], &v));
    }
}

static void a_word_too_long_is_refused_and_not_cut(void **state)
{
    (void)state;
    char condition[512] = "point=0";
    memset(condition + 7, '0', 300);
    assert_false(sb_condition_check(axes, condition, &err));
    check_contains(err.text, "wanted");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_operator_compares_as_in_c, use_default),
        cmocka_unit_test_setup(words_compare_by_name, use_default),
        cmocka_unit_test_setup(the_empty_condition_holds, use_default),
        cmocka_unit_test_setup(comma_binds_stronger_than_bar, use_default),
        cmocka_unit_test_setup(malformed_conditions_are_refused_and_do_not_hold,
                               use_default),
        cmocka_unit_test_setup(a_word_too_long_is_refused_and_not_cut, use_default),
    };
    return run_tests(tests);
}
