// The price of each term, from rows whose prices are known.
#include "test.h"

#include "analyse/terms.h"

enum { FIRST = SB_AXIS_P_POSITION, LAST = SB_AXIS_P_SAMPLER, TERMS = LAST - FIRST + 1 };
enum { HIGHP = SB_P_SUM_HIGHP, MEDIUMP = SB_P_SUM_MEDIUMP, LOWP = SB_P_SUM_LOWP };
enum { ROWS = 64 };

static struct sb_row rows[ROWS];
static struct sb_variant variants[ROWS];
static int count;
static struct sb_terms terms;

static int begin(void **state)
{
    (void)state;
    count = 0;
    return 0;
}

static int end(void **state)
{
    (void)state;
    sb_terms_free(&terms);
    return 0;
}

// All terms at `level`, but for `axis` (-1: none), which is at `other`.
static struct sb_row *add(int level, int axis, int other)
{
    assert_true(count < ROWS);
    struct sb_variant *v = &variants[count];
    struct sb_row *row = &rows[count++];
    sb_variant_init(sb_axes_builtin(), v);
    for (int a = FIRST; a <= LAST; a++)
        v->value[a] = a == axis ? other : level;
    v->value[SB_AXIS_PRECISION] = level;
    sb_row_init(row);
    row->axes = v;
    row->variant = "a row";
    row->scene = "sphere";
    row->renderer = "a driver";
    row->version = "1";
    row->timer_source = "elapsed";
    row->status = "ok";
    row->median_ms = 2;
    row->ci_lo_ms = 1.99;
    row->ci_hi_ms = 2.01;
    row->max_err = 0.001;
    row->flip_mean = 0.0001;
    row->nonfinite = 0;
    return row;
}

static void price(void)
{
    sb_terms_free(&terms);
    sb_terms_price(sb_axes_builtin(), rows, count, &terms);
}

static void the_terms_are_the_axes_that_precision_sets(void **state)
{
    (void)state;
    int axis[SB_AXIS_MAX];
    assert_int_equal(sb_terms_find(sb_axes_builtin(), axis), TERMS);
    for (int t = 0; t < TERMS; t++)
        assert_int_equal(axis[t], FIRST + t);
}

static void each_term_has_its_own_two_rows(void **state)
{
    (void)state;
    struct sb_row *high = add(HIGHP, -1, 0);
    struct sb_row *lowered[TERMS], *raised[TERMS];
    for (int t = 0; t < TERMS; t++) {
        lowered[t] = add(HIGHP, FIRST + t, MEDIUMP);
        lowered[t]->median_ms = 3 + t;
        lowered[t]->max_err = 0.01 * t;
        raised[t] = add(MEDIUMP, FIRST + t, HIGHP);
        raised[t]->median_ms = 20 - t;
    }
    struct sb_row *low = add(MEDIUMP, -1, 0);
    low->median_ms = 10;
    low->ci_lo_ms = 9;
    low->ci_hi_ms = 11;
    variants[2].value[SB_AXIS_PRECISION] =
        SB_PRECISION_MIXED; // of a row: it is shorthand
    price();
    assert_int_equal(terms.count, 1);
    const struct sb_term_prices *group = terms.group;
    assert_ptr_equal(group->high, high);
    assert_ptr_equal(group->low, low);
    assert_string_equal(group->high_word, "highp");
    assert_string_equal(group->low_word, "mediump");
    assert_int_equal(group->count, TERMS);
    for (int t = 0; t < TERMS; t++) {
        const struct sb_term_price *one = &group->price[t];
        assert_int_equal(one->axis, FIRST + t);
        assert_ptr_equal(one->lowered.row, lowered[t]);
        assert_ptr_equal(one->raised.row, raised[t]);
        check_close(one->lowered.time, (3 + t) / 2.0, 1e-12);
        check_close(one->lowered.max_err, 0.01 * t, 0);
        check_close(one->raised.time, (20 - t) / 10.0, 1e-12);
        check_close(one->raised.flip_mean, 0.0001, 0);
        check_close(one->raised.time_lo, 1.99 / 11, 1e-12);
        check_close(one->raised.time_hi, 2.01 / 9, 1e-12);
    }
}

static const struct sb_term_change *lowered_sum(void)
{
    price();
    assert_true(terms.count > 0);
    return &terms.group[0].price[SB_AXIS_P_SUM - FIRST].lowered;
}

// summary.csv has ratios over the first row of the scene, and over no other.
static void ratios_of_pairs_are_used_where_the_base_is_the_first_row_of_its_scene(
    void **state)
{
    (void)state;
    struct sb_row *other = add(LOWP, -1, 0);
    add(HIGHP, -1, 0);
    struct sb_row *row = add(HIGHP, SB_AXIS_P_SUM, MEDIUMP);
    row->ratio = 1.5;
    row->ratio_lo = 1.4;
    row->ratio_hi = 1.6;
    assert_false(lowered_sum()->paired);
    check_close(lowered_sum()->time, 1, 0);
    other->scene = "room";
    assert_true(lowered_sum()->paired);
    check_close(lowered_sum()->time, 1.5, 0);
    check_close(lowered_sum()->time_lo, 1.4, 0);
    check_close(lowered_sum()->time_hi, 1.6, 0);
    row->ratio = NAN;
    assert_false(lowered_sum()->paired);
}

struct expectation {
    double high_err, err, lo, hi; // hi: of the ratio
    int64_t nonfinite;
    enum sb_term_verdict verdict;
};

static void verdicts_follow_the_rules_to_the_bound(void **state)
{
    (void)state;
    static const struct expectation expected[] = {
        {0.0001, 0.49 / 255, 0.98, 1.02, 0, SB_TERM_FREE},
        {0.0001, 0.49 / 255, 0.8, 0.9, 0, SB_TERM_FREE},
        {0.0001, 0.51 / 255, 0.98, 1.02, 0, SB_TERM_COSTS},
        {0.01, 0.0109, 0.98, 1.02, 0, SB_TERM_FREE}, // within 1.1 times
        {0.01, 0.0111, 0.98, 1.02, 0, SB_TERM_COSTS},
        {0.03, 0.032, 0.98, 1.02, 0, SB_TERM_FREE}, // 8/255, and so has all highp
        {0.0001, 3.99 / 255, 0.98, 1.02, 0, SB_TERM_COSTS},
        {0.0001, 4.01 / 255, 0.5, 0.6, 0, SB_TERM_BREAKS}, // however fast
        {0.0001, 0.0001, 0.5, 0.6, 1, SB_TERM_BREAKS},
        {0.0001, 0.0001, 1, 1.05, 0, SB_TERM_FREE},
        {0.0001, 0.0001, 1.01, 1.02, 0, SB_TERM_COSTS},   // slower for certain
        {0.0001, 0.0001, 0.99, 1.06, 0, SB_TERM_UNKNOWN}, // slower, perhaps
        {0.0001, 0.0001, NAN, NAN, 0, SB_TERM_UNKNOWN},
        {0.0001, NAN, 0.98, 1.02, 0, SB_TERM_UNKNOWN},
        {0.0001, NAN, 0.98, 1.02, 7, SB_TERM_BREAKS},
        {NAN, 0.01, 0.98, 1.02, 0, SB_TERM_UNKNOWN}, // 1.1 times of what?
        {NAN, 0.0001, 0.98, 1.02, 0, SB_TERM_FREE},
    };
    struct sb_row *high = add(HIGHP, -1, 0);
    struct sb_row *row = add(HIGHP, SB_AXIS_P_SUM, MEDIUMP);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const struct expectation *e = &expected[i];
        high->max_err = e->high_err;
        row->max_err = e->err;
        row->nonfinite = e->nonfinite;
        row->ratio = (e->lo + e->hi) / 2;
        row->ratio_lo = e->lo;
        row->ratio_hi = e->hi;
        if (isnan(row->ratio))
            row->ratio = 1;
        price();
        const enum sb_term_verdict verdict =
            terms.group[0].price[SB_AXIS_P_SUM - FIRST].verdict;
        if (verdict != e->verdict)
            fail_msg("case %d: %s, not %s", (int)i, sb_term_verdict_words[verdict],
                     sb_term_verdict_words[e->verdict]);
    }
    assert_int_equal(terms.group[0].price[0].verdict, SB_TERM_UNKNOWN);
}

// Times of what failed its checks mean nothing; its errors do.
static void a_row_that_failed_has_errors_but_no_time(void **state)
{
    (void)state;
    add(HIGHP, -1, 0);
    struct sb_row *row = add(HIGHP, SB_AXIS_P_SUM, MEDIUMP);
    row->status = "non_finite";
    row->ratio = 1;
    row->max_err = 0.5;
    assert_true(isnan(lowered_sum()->time));
    check_close(lowered_sum()->max_err, 0.5, 0);
    row->status = "no such status";
    assert_true(isnan(lowered_sum()->time));
    rows[0].status = "class_broken";
    row->status = "ok";
    assert_true(isnan(lowered_sum()->time));
}

static void rows_that_differ_in_anything_else_are_groups_of_their_own(void **state)
{
    (void)state;
    for (int g = 0; g < 4; g++)
        for (int r = 0; r < 2; r++) {
            struct sb_row *row = add(HIGHP, r ? SB_AXIS_P_SUM : -1, MEDIUMP);
            struct sb_variant *v = &variants[count - 1];
            v->value[SB_AXIS_LOOP] = g == 1 ? SB_LOOP_DYNAMIC : SB_LOOP_CONSTANT;
            v->value[SB_AXIS_POINT] = g == 2 ? 5 : 0;
            row->scene = g == 3 ? "room" : "sphere";
        }
    add(HIGHP, SB_AXIS_P_SUM, MEDIUMP)->renderer = "another"; // without a base
    price();
    assert_int_equal(terms.count, 4);
    for (int g = 0; g < 4; g++) {
        assert_ptr_equal(terms.group[g].high, &rows[2 * g]);
        assert_ptr_equal(terms.group[g].price[SB_AXIS_P_SUM - FIRST].lowered.row,
                         &rows[2 * g + 1]);
    }
}

static void lowp_is_priced_apart_from_mediump_and_mixtures_not_at_all(void **state)
{
    (void)state;
    add(HIGHP, -1, 0);
    add(HIGHP, SB_AXIS_P_SUM, LOWP);
    add(HIGHP, SB_AXIS_P_COLOR, MEDIUMP);
    add(MEDIUMP, SB_AXIS_P_COLOR, LOWP);
    add(HIGHP, SB_AXIS_P_VECTOR, MEDIUMP);
    variants[count - 1].value[SB_AXIS_P_OUTPUT] = MEDIUMP; // two are lowered
    price();
    assert_int_equal(terms.count, 2);
    assert_string_equal(terms.group[0].low_word, "mediump");
    assert_string_equal(terms.group[1].low_word, "lowp");
    for (int g = 0; g < 2; g++)
        for (int t = 0; t < TERMS; t++) {
            const bool own = FIRST + t == (g ? SB_AXIS_P_SUM : SB_AXIS_P_COLOR);
            assert_true((terms.group[g].price[t].lowered.row != NULL) == own);
        }
}

static void rows_without_a_base_or_a_change_have_no_prices(void **state)
{
    (void)state;
    price();
    assert_int_equal(terms.count, 0);
    add(HIGHP, -1, 0);
    add(MEDIUMP, -1, 0);
    price();
    assert_int_equal(terms.count, 0);
    count = 0;
    add(HIGHP, SB_AXIS_P_SUM, MEDIUMP);
    add(MEDIUMP, SB_AXIS_P_SUM, HIGHP);
    price();
    assert_int_equal(terms.count, 0);
}

// No name stands in the code: a table with a shorthand of its own does as well.
static void any_shorthand_will_do(void **state)
{
    (void)state;
    static const struct sb_value grades[] = {{"fine", "", "", "", 0},
                                             {"coarse", "", "", "", 0}};
    static const struct sb_value sums[] = {
        {"mixed", "", "a=fine b=coarse c=fine", "", 0},
        {"rough", "", "a=coarse b=coarse c=coarse", "", 0},
        {"good", "", "a=fine b=fine c=fine", "", 0}};
    static struct sb_axes axes = {.count = 4};
    axes.row[0] = (struct sb_axis){
        .name = "all", .values = sums, .value_count = 3, .init = 2, .kind = SB_QUALITY};
    for (int a = 1; a < 4; a++)
        axes.row[a] = (struct sb_axis){.name = a == 1   ? "a"
                                               : a == 2 ? "b"
                                                        : "c",
                                       .values = grades,
                                       .value_count = 2,
                                       .kind = SB_QUALITY};
    static const double value[][4] = {
        {2, 0, 0, 0}, {1, 1, 1, 1}, {2, 1, 0, 0}, {1, 1, 1, 0}};
    for (int i = 0; i < 4; i++) {
        add(HIGHP, -1, 0);
        memcpy(variants[i].value, value[i], sizeof value[i]);
    }
    sb_terms_free(&terms);
    sb_terms_price(&axes, rows, count, &terms);
    assert_int_equal(terms.count, 1);
    assert_string_equal(terms.group[0].high_word, "good");
    assert_string_equal(terms.group[0].low_word, "rough");
    assert_ptr_equal(terms.group[0].low, &rows[1]);
    assert_int_equal(terms.group[0].count, 3);
    assert_ptr_equal(terms.group[0].price[0].lowered.row, &rows[2]);
    assert_ptr_equal(terms.group[0].price[2].raised.row, &rows[3]);
    assert_null(terms.group[0].price[1].lowered.row);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(the_terms_are_the_axes_that_precision_sets),
        TEST(each_term_has_its_own_two_rows),
        TEST(ratios_of_pairs_are_used_where_the_base_is_the_first_row_of_its_scene),
        TEST(verdicts_follow_the_rules_to_the_bound),
        TEST(a_row_that_failed_has_errors_but_no_time),
        TEST(rows_that_differ_in_anything_else_are_groups_of_their_own),
        TEST(lowp_is_priced_apart_from_mediump_and_mixtures_not_at_all),
        TEST(rows_without_a_base_or_a_change_have_no_prices),
        TEST(any_shorthand_will_do),
    };
    return run_tests(tests);
}
