// Two runs side by side: which rows are the same, which compare, and what is said of them.
#include "test.h"

#include "analyse/runs.h"
#include "stats/between.h"

enum { ROWS = 8 };

struct run {
    struct sb_axes axes;
    struct sb_row row[ROWS];
    struct sb_variant variant[ROWS];
    char id[ROWS][256];
    struct sb_run_fact fact[4];
    int count, facts;
};
static struct run a, b;
static struct sb_runs runs;
static bool force;

// A row for "point=4,stage=vertex", 2 ms within 1 %.
static struct sb_row *add(struct run *run, const char *given)
{
    const int i = run->count++;
    char words[256];
    struct sb_text id = {0};
    struct sb_row *row = &run->row[i];
    sb_variant_init(&run->axes, &run->variant[i]);
    snprintf(words, sizeof words, "%s", given);
    for (char *rest, *word = strtok_r(words, ",", &rest); word;
         word = strtok_r(NULL, ",", &rest)) {
        char *value = strchr(word, '=');
        *value++ = '\0';
        assert_true(sb_variant_set(&run->axes, &run->variant[i],
                                   sb_axes_find(&run->axes, word), value, NULL));
    }
    assert_true(sb_variant_resolve(&run->axes, &run->variant[i], NULL));
    sb_variant_id(&run->axes, &run->variant[i], &id);
    snprintf(run->id[i], sizeof run->id[i], "%s", sb_text_get(&id));
    sb_text_free(&id);
    sb_row_init(row);
    row->axes = &run->variant[i];
    row->variant = run->id[i];
    row->scene = "room";
    row->renderer = "a driver";
    row->version = "1.0";
    row->timer_source = "elapsed";
    row->status = "ok";
    row->input_hash = "00c0ffee";
    row->source_hash = "5";
    row->processes = 1;
    row->median_ms = 2;
    row->ci_lo_ms = 2 * .99;
    row->ci_hi_ms = 2 * 1.01;
    row->max_err = 0.01;
    row->nonfinite = 0;
    return row;
}

static void set_time(struct sb_row *row, double lo, double ms, double hi)
{
    row->ci_lo_ms = lo;
    row->median_ms = ms;
    row->ci_hi_ms = hi;
}

static struct sb_run_side side(const struct run *run)
{
    return (struct sb_run_side){&run->axes, run->row, run->count, run->fact, run->facts};
}

static void compare(void)
{
    sb_runs_free(&runs);
    sb_runs_compare(
        &(struct sb_runs_params){
            .a = side(&a), .b = side(&b), .tolerance = .02, .force = force},
        &runs);
}

// One pair of the same row; both rows are to be changed, and compare() called again.
static struct sb_run_pair *one_pair(void)
{
    assert_int_equal(runs.count, 1);
    return &runs.pair[0];
}

static int set_up(void **state)
{
    (void)state;
    memset(&a, 0, sizeof a);
    memset(&b, 0, sizeof b);
    a.axes = b.axes = *sb_axes_builtin();
    force = false;
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    sb_runs_free(&runs);
    return 0;
}

// --- which rows -----------------------------------------------------------------------------

static void rows_are_matched_by_scene_and_id_in_any_order(void **state)
{
    (void)state;
    add(&a, "point=1");
    add(&a, "point=2");
    add(&a, "point=2")->scene = "hall";
    add(&a, "point=3");
    add(&b, "point=9");
    add(&b, "point=2")->scene = "hall";
    add(&b, "point=2");
    add(&b, "point=1");
    compare();
    assert_int_equal(runs.count, 5);
    const int partner[] = {3, 2, 1};
    for (int i = 0; i < 3; i++) {
        assert_ptr_equal(runs.pair[i].a, &a.row[i]);
        assert_ptr_equal(runs.pair[i].b, &b.row[partner[i]]);
        assert_int_equal(runs.pair[i].verdict, SB_RUN_UNCHANGED);
    }
    assert_int_equal(runs.pair[3].verdict, SB_RUN_LOST);
    assert_null(runs.pair[3].b);
    assert_int_equal(runs.pair[4].verdict, SB_RUN_GAINED);
    assert_ptr_equal(runs.pair[4].b, &b.row[0]);
    assert_int_equal(runs.comparable, 3);
    assert_int_equal(runs.of[SB_RUN_LOST], 1);
    assert_int_equal(runs.of[SB_RUN_GAINED], 1);
}

static void a_variant_that_is_gone_is_worse_where_it_was_sound(void **state)
{
    (void)state;
    add(&a, "point=1");
    add(&b, "point=1");
    struct sb_row *row = add(&a, "point=2");
    compare();
    assert_int_equal(runs.worse, 1);
    row->status = "accuracy_only";
    row->median_ms = NAN;
    compare();
    assert_int_equal(runs.worse, 1);
    row->status = "compile_failed";
    compare();
    assert_int_equal(runs.worse, 0);
    add(&b, "point=3");
    compare();
    assert_int_equal(runs.of[SB_RUN_GAINED], 1);
    assert_int_equal(runs.worse, 0);
}

// The same id in every scene, in every order.
static void scenes_are_told_apart_where_ids_are_not(void **state)
{
    (void)state;
    static const char *const scenes[] = {"room", "hall", "attic", "yard"};
    for (int turn = 0; turn < 4; turn++) {
        set_up(state);
        for (int i = 0; i < 4; i++) {
            add(&a, "point=2")->scene = scenes[i];
            add(&b, "point=2")->scene = scenes[(i + turn) % 4];
        }
        compare();
        assert_int_equal(runs.count, 4);
        for (int i = 0; i < 4; i++)
            assert_string_equal(runs.pair[i].b->scene, scenes[i]);
    }
}

static void a_row_has_one_partner(void **state)
{
    (void)state;
    add(&a, "point=2");
    add(&a, "point=2");
    add(&b, "point=2");
    compare();
    assert_int_equal(runs.count, 2);
    assert_int_equal(runs.pair[0].verdict, SB_RUN_UNCHANGED);
    assert_int_equal(runs.pair[1].verdict, SB_RUN_LOST);
}

// Their ids say so, and have nothing in common.
static void a_run_of_another_size_or_threads_is_refused_row_by_row(void **state)
{
    (void)state;
    add(&a, "point=1,width=64");
    add(&a, "point=2,width=64");
    add(&b, "threads=2,point=2,width=128");
    add(&b, "threads=2,point=1,width=128");
    compare();
    assert_int_equal(runs.count, 2);
    assert_int_equal(runs.of[SB_RUN_REFUSED], 2);
    assert_int_equal(runs.comparable, 0);
    assert_ptr_equal(runs.pair[0].b, &b.row[1]);
    assert_string_equal(runs.pair[0].differs, "threads -1 | 2; width 64 | 128");
    assert_true(isnan(runs.pair[0].ratio.point));
}

static void another_way_of_doing_it_compares_and_is_named(void **state)
{
    (void)state;
    add(&a, "point=1,form=robust");
    add(&a, "point=2,form=robust");
    add(&b, "point=2,form=naive");
    add(&b, "point=1,form=naive");
    compare();
    assert_int_equal(runs.of[SB_RUN_UNCHANGED], 2);
    assert_ptr_equal(runs.pair[0].b, &b.row[1]);
    check_contains(runs.pair[0].differs, "f_unit robust | naive");
    assert_null(strstr(runs.pair[0].differs, "form robust"));
    assert_false(runs.pair[0].unlike);
}

static void an_axis_that_one_run_alone_has_is_named_and_matches_every_value(void **state)
{
    (void)state;
    struct sb_axis knob = {.name = "knob",
                           .define = "KNOB",
                           .when = "",
                           .needs = "",
                           .help = "",
                           .kind = SB_QUALITY,
                           .max = 9};
    assert_true(sb_axes_add(&b.axes, &knob, NULL));
    knob.name = "other";
    knob.define = "OTHER";
    knob.when = "spot>0";
    assert_true(sb_axes_add(&b.axes, &knob, NULL)); // moot: there is no spot light
    add(&a, "point=1");
    add(&b, "point=1,knob=3");
    compare();
    assert_int_equal(runs.of[SB_RUN_UNCHANGED], 1);
    assert_string_equal(one_pair()->differs, "knob none | 3");
    assert_false(one_pair()->unlike);
    b.axes.row[b.axes.count - 2].kind = SB_SCENE;
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_REFUSED);
}

// --- which compare --------------------------------------------------------------------------

static void check_refused(const char *differs)
{
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_REFUSED);
    assert_string_equal(one_pair()->differs, differs);
    assert_int_equal(runs.comparable, 0);
    force = true;
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_UNCHANGED);
    assert_true(one_pair()->unlike);
    assert_string_equal(one_pair()->differs, differs);
    assert_int_equal(runs.comparable, 1);
    force = false;
}

static void rows_of_other_conditions_are_refused_unless_forced(void **state)
{
    (void)state;
    struct sb_row *row = add(&a, "point=1");
    const struct sb_row whole = *row;
    add(&b, "point=1");
    row->renderer = "another";
    check_refused("renderer another | a driver");
    *row = whole;
    row->version = "0.9";
    check_refused("version 0.9 | 1.0");
    *row = whole;
    row->timer_source = "wall";
    check_refused("timer wall | elapsed");
    *row = whole;
    row->scene = "hall";
    check_refused("scene hall | room");
    *row = whole;
    row->input_hash = "00c0ffed";
    check_refused("input hash 00c0ffed | 00c0ffee");
    *row = whole;
    const struct sb_variant before = a.variant[0]; // a preset's target stands in no id
    a.variant[0].value[SB_AXIS_TARGET] = SB_TARGET_RGBA16F;
    check_refused("target rgba16f | rgba8");
    a.variant[0] = before;
    row->input_hash = NULL;
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_UNCHANGED);
}

static void other_machines_are_refused_where_both_are_known(void **state)
{
    (void)state;
    add(&a, "point=1");
    add(&b, "point=1");
    a.fact[0] = b.fact[0] = (struct sb_run_fact){"cpu", "one"};
    a.facts = b.facts = 1;
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_UNCHANGED);
    b.fact[0].value = "other";
    check_refused("cpu one | other");
    b.fact[0] = (struct sb_run_fact){"LP_NUM_THREADS", "2"};
    check_refused("cpu one | none; LP_NUM_THREADS none | 2");
    b.facts = 0;
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_UNCHANGED);
}

// --- what is said ---------------------------------------------------------------------------

static void intervals_decide_where_they_lie(void **state)
{
    (void)state;
    static const struct {
        double lo, hi; // of B, of which A is 1 ms exactly
        enum sb_run_verdict verdict;
    } table[] = {
        {1.021, 1.3, SB_RUN_HURT},      {1.019, 1.3, SB_RUN_UNCLEAR},
        {.99, 1.019, SB_RUN_UNCHANGED}, {.981, 1.019, SB_RUN_UNCHANGED},
        {.979, 1.001, SB_RUN_UNCLEAR},  {.5, .979, SB_RUN_HELPED},
        {.5, .981, SB_RUN_UNCLEAR},     {.5, 2, SB_RUN_UNCLEAR},
        {NAN, NAN, SB_RUN_UNCLEAR},
    };
    set_time(add(&a, ""), 1, 1, 1);
    struct sb_row *row = add(&b, "");
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const bool none = isnan(table[i].lo);
        set_time(row, table[i].lo, none ? 1 : (table[i].lo + table[i].hi) / 2,
                 table[i].hi);
        compare();
        if (one_pair()->verdict != table[i].verdict)
            fail_msg("%g … %g is %s", table[i].lo, table[i].hi,
                     sb_run_verdict_rows[one_pair()->verdict].word);
        assert_int_equal(runs.worse, table[i].verdict == SB_RUN_HURT);
        assert_int_equal(runs.moved, table[i].verdict == SB_RUN_HURT ||
                                         table[i].verdict == SB_RUN_HELPED);
        assert_int_equal(runs.within, 1);
        if (!none) {
            check_close(one_pair()->ratio.lo, table[i].lo, 1e-14);
            check_close(one_pair()->ratio.hi, table[i].hi, 1e-14);
        }
    }
}

static void several_processes_count_by_their_medians(void **state)
{
    (void)state;
    const double before[] = {1, 1.02, 1.01}, after[] = {1.2, 1.21, 1.22};
    const struct sb_interval x = sb_between_processes(before, 3, .95),
                             y = sb_between_processes(after, 3, .95);
    struct sb_row *row = add(&a, ""), *other = add(&b, "");
    set_time(row, x.lo, x.point, x.hi);
    set_time(other, y.lo, y.point, y.hi);
    row->processes = other->processes = 3;
    compare();
    assert_true(one_pair()->between);
    assert_int_equal(runs.within, 0);
    assert_int_equal(runs.between, 1);
    assert_int_equal(one_pair()->verdict, SB_RUN_HURT);
    assert_int_equal(one_pair()->ratio.n, 6);
    check_close(log(one_pair()->ratio.point),
                (log(1.2) + log(1.21) + log(1.22) - log(1.02) - log(1.01)) / 3, 1e-14);
    // One process against three is judged by how those differ, not by its own narrow interval.
    set_time(other, 1.2, 1.2, 1.2);
    other->processes = 1;
    compare();
    assert_true(one_pair()->between);
    assert_true(one_pair()->ratio.hi / one_pair()->ratio.lo > 1.05);
}

static void times_that_come_and_go_are_lost_and_gained(void **state)
{
    (void)state;
    struct sb_row *row = add(&a, ""), *other = add(&b, "");
    other->status = "compile_failed";
    other->median_ms = NAN;
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_LOST);
    assert_int_equal(one_pair()->status, SB_RUN_WORSE);
    assert_int_equal(runs.comparable, 1);
    assert_int_equal(runs.within + runs.between, 0);
    assert_int_equal(runs.worse, 1);
    row->status = "accuracy_only";
    row->median_ms = NAN;
    other->status = "accuracy_only";
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_UNTIMED);
    assert_int_equal(one_pair()->status, SB_RUN_SAME);
    other->median_ms = 2;
    other->status = "ok";
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_GAINED);
}

// What was to be decided as it was prepared is undecided where that failed.
static void what_a_failed_row_left_open_is_no_other_condition(void **state)
{
    (void)state;
    struct sb_row *row = add(&a, "glsl=330"), *other = add(&b, "");
    a.variant[0].value[SB_AXIS_CONTEXT] = SB_CONTEXT_EGL;
    b.variant[0].value[SB_AXIS_CONTEXT] = SB_CONTEXT_AUTO;
    other->status = "compile_failed";
    other->median_ms = NAN;
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_LOST);
    assert_string_equal(one_pair()->differs, "");
    assert_int_equal(runs.worse, 1);
    b.variant[0].value[SB_AXIS_GLSL] = SB_GLSL_100; // which was asked for
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_REFUSED);
    b.variant[0].value[SB_AXIS_GLSL] = SB_GLSL_AUTO;
    *other = *row;
    other->axes = &b.variant[0];
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_REFUSED);
}

static void statuses_are_worse_by_their_exit_codes(void **state)
{
    (void)state;
    static const struct {
        const char *before, *after;
        enum sb_run_change change;
    } table[] = {
        {"ok", "not_fragment_bound", SB_RUN_SAME},
        {"ok", "dead_light", SB_RUN_WORSE},
        {"dead_light", "ok", SB_RUN_BETTER},
        {"dead_light", "blank_picture", SB_RUN_SAME},
        {"ok", "not_measured", SB_RUN_WORSE},
        {"not_measured", "blank_picture", SB_RUN_WORSE},
        {"blank_picture", "not_measured", SB_RUN_BETTER},
    };
    struct sb_row *row = add(&a, ""), *other = add(&b, "");
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        row->status = table[i].before;
        other->status = table[i].after;
        compare();
        assert_int_equal(one_pair()->status, table[i].change);
        assert_int_equal(runs.worse, table[i].change == SB_RUN_WORSE);
    }
}

static void errors_are_worse_beyond_the_tolerance(void **state)
{
    (void)state;
    struct sb_row *row = add(&a, ""), *other = add(&b, "");
    static const struct {
        double before, after;
        enum sb_run_change change;
    } table[] = {
        {.01, .01019, SB_RUN_SAME}, {.01, .01021, SB_RUN_WORSE},
        {.01019, .01, SB_RUN_SAME}, {.01021, .01, SB_RUN_BETTER},
        {0, 1e-9, SB_RUN_WORSE},    {0, 0, SB_RUN_SAME},
        {NAN, .5, SB_RUN_SAME},     {.5, NAN, SB_RUN_SAME},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        row->max_err = table[i].before;
        other->max_err = table[i].after;
        compare();
        assert_int_equal(one_pair()->error, table[i].change);
        assert_int_equal(runs.worse, table[i].change == SB_RUN_WORSE);
    }
    other->nonfinite = 1; // whatever the largest of the finite errors
    row->max_err = 1;
    other->max_err = .5;
    compare();
    assert_int_equal(one_pair()->error, SB_RUN_WORSE);
}

static void what_is_refused_is_not_worse(void **state)
{
    (void)state;
    add(&a, "");
    struct sb_row *other = add(&b, "");
    other->max_err = 1;
    set_time(other, 9, 9, 9);
    other->renderer = "another";
    compare();
    assert_int_equal(runs.worse, 0);
    force = true;
    compare();
    assert_int_equal(runs.worse, 1);
}

static void changed_code_is_known_where_both_have_a_hash(void **state)
{
    (void)state;
    struct sb_row *row = add(&a, ""), *other = add(&b, "");
    row->binary_hash = "7";
    compare();
    assert_int_equal(one_pair()->source, SB_RUN_CODE_SAME);
    assert_int_equal(one_pair()->binary, SB_RUN_CODE_UNKNOWN);
    other->binary_hash = "8";
    other->source_hash = "6";
    set_time(other, 3, 3, 3);
    compare();
    assert_int_equal(one_pair()->verdict, SB_RUN_HURT);
    assert_int_equal(runs.moved, 0);
    assert_int_equal(one_pair()->source, SB_RUN_CODE_CHANGED);
    assert_int_equal(one_pair()->binary, SB_RUN_CODE_CHANGED);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(rows_are_matched_by_scene_and_id_in_any_order),
        TEST(a_variant_that_is_gone_is_worse_where_it_was_sound),
        TEST(scenes_are_told_apart_where_ids_are_not),
        TEST(a_row_has_one_partner),
        TEST(a_run_of_another_size_or_threads_is_refused_row_by_row),
        TEST(another_way_of_doing_it_compares_and_is_named),
        TEST(an_axis_that_one_run_alone_has_is_named_and_matches_every_value),
        TEST(rows_of_other_conditions_are_refused_unless_forced),
        TEST(other_machines_are_refused_where_both_are_known),
        TEST(intervals_decide_where_they_lie),
        TEST(several_processes_count_by_their_medians),
        TEST(times_that_come_and_go_are_lost_and_gained),
        TEST(what_a_failed_row_left_open_is_no_other_condition),
        TEST(statuses_are_worse_by_their_exit_codes),
        TEST(errors_are_worse_beyond_the_tolerance),
        TEST(what_is_refused_is_not_worse),
        TEST(changed_code_is_known_where_both_have_a_hash),
    };
    return run_tests(tests);
}
