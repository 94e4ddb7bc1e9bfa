// The table itself: every row, built-in or added, must be one that input can name.
#include "test.h"

#include "axis/variant.h"

static struct sb_axes axes;
static struct sb_error err;

static int use_builtin(void **state)
{
    (void)state;
    axes = *sb_axes_builtin();
    err = (struct sb_error){0};
    return 0;
}

// sb_axes_add refuses taken names and defines, an init out of range, conditions that do
// not parse and conditions that name later rows.
static void every_builtin_row_would_be_accepted_as_an_added_one(void **state)
{
    (void)state;
    struct sb_axes rebuilt = {.count = 0};
    for (int i = 0; i < axes.count; i++)
        if (!sb_axes_add(&rebuilt, &axes.row[i], &err))
            fail_msg("%s", err.text);
    assert_int_equal(rebuilt.count, SB_AXIS_BUILTIN_COUNT);
}

static void every_row_and_value_has_help(void **state)
{
    (void)state;
    for (int i = 0; i < axes.count; i++) {
        assert_true(strlen(axes.row[i].help) > 0);
        for (int k = 0; k < axes.row[i].value_count; k++)
            if (!*axes.row[i].values[k].help)
                fail_msg("%s=%s has no help", axes.row[i].name,
                         axes.row[i].values[k].name);
    }
}

static void the_ids_of_the_enums_are_the_places_of_the_rows(void **state)
{
    (void)state;
    assert_int_equal(sb_axes_find(&axes, "api"), SB_AXIS_API);
    assert_int_equal(sb_axes_find(&axes, "spot"), SB_AXIS_SPOT);
    assert_int_equal(sb_axes_find(&axes, "p_sampler"), SB_AXIS_P_SAMPLER);
    assert_int_equal(sb_axes_find(&axes, "without"), SB_AXIS_WITHOUT);
    assert_int_equal(SB_AXIS_WITHOUT, SB_AXIS_BUILTIN_COUNT - 1);
    const struct sb_axis *stage = &axes.row[SB_AXIS_STAGE];
    assert_int_equal(sb_axis_value_find(stage, "vertex"), SB_STAGE_VERTEX);
    assert_int_equal(stage->value_count, SB_STAGE_VALUE_COUNT);
    const struct sb_axis *sampler = &axes.row[SB_AXIS_P_SAMPLER];
    assert_int_equal(sb_axis_value_find(sampler, "lowp"), SB_P_SAMPLER_LOWP);
    assert_string_equal(sampler->define, "P_SAMPLER");
    assert_string_equal(axes.row[SB_AXIS_POINT].define, "NR_POINT_LIGHTS");
    assert_int_equal(sb_axes_find(&axes, "no_such_axis"), -1);
    assert_int_equal(sb_axis_value_find(stage, "no_such_value"), -1);
}

static void every_word_that_a_shorthand_sets_exists(void **state)
{
    (void)state;
    int shorthands = 0;
    for (int i = 0; i < axes.count; i++) {
        for (int k = 0; k < axes.row[i].value_count; k++) {
            if (!*axes.row[i].values[k].sets)
                continue;
            char sets[1024];
            snprintf(sets, sizeof sets, "%s", axes.row[i].values[k].sets);
            shorthands++;
            for (char *rest = sets, *word; (word = strtok_r(rest, " ", &rest));) {
                char *const equals = strchr(word, '=');
                assert_non_null(equals);
                *equals = '\0';
                const int axis = sb_axes_find(&axes, word);
                assert_true(axis >= 0);
                assert_true(sb_axis_value_find(&axes.row[axis], equals + 1) >= 0);
            }
        }
    }
    assert_int_equal(shorthands, SB_PRECISION_VALUE_COUNT + SB_FORM_VALUE_COUNT);
}

static void an_unknown_axis_is_answered_with_the_nearest_and_all_names(void **state)
{
    (void)state;
    assert_int_equal(sb_axes_expect(&axes, "stgae", &err), -1);
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text,
                   "unknown axis \"stgae\"; did you mean \"stage\"? valid: api glsl ");
    for (int i = 0; i < axes.count; i++)
        check_contains(err.text, axes.row[i].name);
    assert_int_equal(sb_axes_expect(&axes, "qqqqqqqqq", &err), -1);
    check_contains(err.text, "unknown axis \"qqqqqqqqq\"; valid: api");
}

static const struct sb_value two_words[] = {{"linear", "linear", "", "", 0},
                                            {"cubic", "cubic", "", "", 0}};

static struct sb_axis new_choice(void)
{
    return (struct sb_axis){.name = "curve",
                            .define = "CURVE",
                            .when = "",
                            .needs = "",
                            .help = "",
                            .kind = SB_QUALITY,
                            .values = two_words,
                            .value_count = 2};
}

static struct sb_axis new_number(void)
{
    return (struct sb_axis){.name = "taps",
                            .define = "TAPS",
                            .when = "",
                            .needs = "",
                            .help = "",
                            .kind = SB_QUALITY,
                            .flags = SB_WHOLE,
                            .init = 4,
                            .min = 1,
                            .max = 16};
}

static void refused(struct sb_axis row, const char *part)
{
    const int before = axes.count;
    assert_false(sb_axes_add(&axes, &row, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, part);
    assert_int_equal(axes.count, before);
}

static void a_good_row_is_added_at_the_end(void **state)
{
    (void)state;
    struct sb_axis row = new_choice();
    assert_true(sb_axes_add(&axes, &row, &err));
    assert_int_equal(sb_axes_find(&axes, "curve"), SB_AXIS_BUILTIN_COUNT);
    row = new_number();
    row.when = "curve=cubic"; // a row may depend on one above it
    assert_true(sb_axes_add(&axes, &row, &err));
    assert_int_equal(axes.count, SB_AXIS_BUILTIN_COUNT + 2);
}

static void bad_names_and_defines_are_refused(void **state)
{
    (void)state;
    struct sb_axis row = new_choice();
    row.name = "stage";
    refused(row, "\"stage\": there is one of that name already");
    row.name = "2nd";
    refused(row, "\"2nd\"");
    row.name = "";
    refused(row, "name must be");
    row.name = "a_name_of_more_than_sixty_three_letters_that_no_condition_could_hold";
    refused(row, "at most 63");
    row = new_choice();
    row.define = "STAGE";
    refused(row, "define STAGE belongs to axis \"stage\"");
    row.define = "GL_CURVE";
    refused(row, "GL_CURVE");
    row.define = "MY__CURVE";
    refused(row, "MY__CURVE");
    row.define = "MY-CURVE";
    refused(row, "MY-CURVE");
}

static void bad_values_and_numbers_are_refused(void **state)
{
    (void)state;
    static const struct sb_value blank[] = {{"two words", "", "", "", 0}};
    static const struct sb_value comma[] = {{"a,b", "", "", "", 0}};
    static const struct sb_value lines[] = {{"a", "1\n#error", "", "", 0}};
    static const struct sb_value longer[] = {
        {"a_word_of_more_than_sixty_three_letters_that_no_condition_could_hold", "", "",
         "", 0}};
    static const struct sb_value twice[] = {{"a", "", "", "", 0}, {"a", "", "", "", 0}};
    struct sb_axis row = new_choice();
    row.init = 2;
    refused(row, "init");
    row = new_choice();
    row.value_count = 0;
    refused(row, "no values");
    row.value_count = 1;
    row.values = blank;
    refused(row, "two words");
    row.values = comma;
    refused(row, "a,b");
    row.values = longer;
    refused(row, "at most 63 bytes");
    row.values = lines;
    refused(row, "one line");
    row.values = twice;
    row.value_count = 2;
    refused(row, "twice");
    row = new_number();
    row.init = 17;
    refused(row, "init must lie between");
    row = new_number();
    row.max = 0;
    refused(row, "min must be at most max");
    row = new_number();
    row.max = 16.5;
    refused(row, "whole numbers");
    row = new_number();
    row.max = INFINITY;
    refused(row, "min must be at most max");
}

static void conditions_must_parse_and_name_rows_above(void **state)
{
    (void)state;
    struct sb_axis row = new_choice();
    row.when = "taps>4";
    refused(row, "unknown axis \"taps\"");
    row.when = "curve=linear"; // itself
    refused(row, "unknown axis \"curve\"");
    row.when = "";
    row.needs = "stage=vretex";
    refused(row, "did you mean \"vertex\"?");
}

static void there_is_room_for_96_rows(void **state)
{
    (void)state;
    char name[SB_AXIS_MAX][16];
    struct sb_axis row = new_number();
    row.define = "";
    for (int i = axes.count; i < SB_AXIS_MAX; i++) {
        snprintf(name[i], sizeof name[i], "axis%d", i);
        row.name = name[i];
        assert_true(sb_axes_add(&axes, &row, &err));
    }
    row.name = "one_more";
    refused(row, "room for 96");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(every_builtin_row_would_be_accepted_as_an_added_one,
                               use_builtin),
        cmocka_unit_test_setup(every_row_and_value_has_help, use_builtin),
        cmocka_unit_test_setup(the_ids_of_the_enums_are_the_places_of_the_rows,
                               use_builtin),
        cmocka_unit_test_setup(every_word_that_a_shorthand_sets_exists, use_builtin),
        cmocka_unit_test_setup(an_unknown_axis_is_answered_with_the_nearest_and_all_names,
                               use_builtin),
        cmocka_unit_test_setup(a_good_row_is_added_at_the_end, use_builtin),
        cmocka_unit_test_setup(bad_names_and_defines_are_refused, use_builtin),
        cmocka_unit_test_setup(bad_values_and_numbers_are_refused, use_builtin),
        cmocka_unit_test_setup(conditions_must_parse_and_name_rows_above, use_builtin),
        cmocka_unit_test_setup(there_is_room_for_96_rows, use_builtin),
    };
    return run_tests(tests);
}
