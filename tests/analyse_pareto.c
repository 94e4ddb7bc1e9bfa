// The Pareto front against its definition, written out again for rows made by chance.
#include "test.h"

#include "analyse/pareto.h"
#include "math/random.h"

enum { ROWS = 60, SETS = 300 };

struct set {
    struct sb_row row[ROWS];
    struct sb_variant variant[ROWS];
    char id[ROWS][16];
};

static bool is_sphere(const char *scene)
{
    return strcmp(scene, "sphere") == 0;
}

static void base_row(struct set *set, int i)
{
    struct sb_row *row = &set->row[i];
    sb_row_init(row);
    sb_variant_init(sb_axes_builtin(), &set->variant[i]);
    snprintf(set->id[i], sizeof set->id[i], "row%d", i);
    row->axes = &set->variant[i];
    row->variant = set->id[i];
    row->scene = "room";
    row->renderer = "a driver";
    row->version = "1.0";
    row->timer_source = "elapsed";
    row->status = "ok";
    row->ci_kind = "ci95_within_run";
    row->input_hash = "00c0ffee";
    row->median_ms = 2;
    row->ci_lo_ms = 1.9;
    row->ci_hi_ms = 2.1;
    row->max_err = 0.01;
    row->p999_err = 0.005;
    row->flip_mean = 0.001;
    row->nonfinite = 0;
}

static void set_time(struct sb_row *row, double ms, double half)
{
    row->median_ms = ms;
    row->ci_lo_ms = ms - half;
    row->ci_hi_ms = ms + half;
}

static void mark(struct set *set, int count)
{
    const struct sb_pareto_params params = {
        .row = set->row,
        .count = count,
        .axes = sb_axes_builtin(),
        .analytic = is_sphere,
    };
    sb_pareto_mark(&params);
}

// --- the definition once more -----------------------------------------------------------------

static bool counts(const struct sb_row *row)
{
    return (strcmp(row->status, "ok") == 0 ||
            strcmp(row->status, "not_fragment_bound") == 0) &&
           row->axes->value[SB_AXIS_EMULATE] == SB_EMULATE_NONE &&
           !isnan(row->median_ms) && !isnan(row->ci_lo_ms) && !isnan(row->max_err) &&
           !isnan(row->p999_err) && !isnan(row->flip_mean) &&
           row->nonfinite != SB_NO_COUNT;
}

// Platform and scene axes stand side by side in the table.
static bool same_question(const struct sb_row *a, const struct sb_row *b)
{
    for (int axis = SB_AXIS_API; axis <= SB_AXIS_TESSELLATION; axis++)
        if (a->axes->value[axis] != b->axes->value[axis] &&
            !(axis == SB_AXIS_TESSELLATION && is_sphere(a->scene)))
            return false;
    return a->axes->value[SB_AXIS_TARGET] == b->axes->value[SB_AXIS_TARGET] &&
           strcmp(a->scene, b->scene) == 0 && strcmp(a->renderer, b->renderer) == 0 &&
           strcmp(a->timer_source, b->timer_source) == 0 &&
           strcmp(a->ci_kind, b->ci_kind) == 0 &&
           (is_sphere(a->scene) || strcmp(a->input_hash, b->input_hash) == 0);
}

static bool beats(const struct sb_row *a, const struct sb_row *b)
{
    return counts(a) && counts(b) && same_question(a, b) && a->ci_hi_ms < b->ci_lo_ms &&
           !(a->max_err > b->max_err) && !(a->p999_err > b->p999_err) &&
           !(a->flip_mean > b->flip_mean) && !(a->nonfinite > b->nonfinite);
}

static bool is_beaten(const struct set *set, const struct sb_row *row)
{
    for (int i = 0; i < ROWS; i++)
        if (beats(&set->row[i], row))
            return true;
    return false;
}

static int pick(struct sb_random *random, int count)
{
    return (int)sb_random_below(random, (uint64_t)count);
}

// Few values each, so that rows are equal in many ways and different in some.
static void random_row(struct set *set, int i, struct sb_random *random)
{
    struct sb_row *row = &set->row[i];
    double *value = set->variant[i].value;
    base_row(set, i);
    set_time(row, 1 + pick(random, 12), 0.25 * (1 + pick(random, 6)));
    row->max_err = 0.01 * pick(random, 4);
    row->p999_err = 0.001 * pick(random, 3);
    row->flip_mean = 0.0001 * pick(random, 3);
    row->nonfinite = pick(random, 10) ? 0 : 3;
    row->scene = pick(random, 2) ? "sphere" : "room";
    row->renderer = pick(random, 8) ? "a driver" : "another";
    row->timer_source = pick(random, 8) ? "elapsed" : "wall";
    row->ci_kind = pick(random, 8) ? "ci95_within_run" : "ci95_between_processes";
    row->input_hash = pick(random, 8) ? "00c0ffee" : "0badcafe";
    value[SB_AXIS_TARGET] = pick(random, 8) ? SB_TARGET_RGBA8 : SB_TARGET_RGBA16F;
    value[SB_AXIS_TESSELLATION] = pick(random, 2) ? 0 : 800;
    value[SB_AXIS_WIDTH] = pick(random, 8) ? 256 : 512;
    value[SB_AXIS_API] = pick(random, 8) ? SB_API_GL : SB_API_GLES;
    value[SB_AXIS_P_SUM] = pick(random, 3);
    value[SB_AXIS_LOOP] = pick(random, 3);
    value[SB_AXIS_EMULATE] = pick(random, 10) ? SB_EMULATE_NONE : SB_EMULATE_FP16;
    static const char *const statuses[] = {"ok", "not_fragment_bound", "class_broken",
                                           "not_measured"};
    row->status = pick(random, 6) ? "ok" : statuses[pick(random, 4)];
    double *const lost[] = {&row->median_ms, &row->ci_lo_ms, &row->max_err,
                            &row->p999_err, &row->flip_mean};
    if (pick(random, 10) == 0)
        *lost[pick(random, 5)] = NAN;
    if (pick(random, 20) == 0)
        row->nonfinite = SB_NO_COUNT;
}

static void check_dominator(const struct set *set, const struct sb_row *row)
{
    const struct sb_row *named = NULL;
    double least = INFINITY, fastest = INFINITY;
    for (int i = 0; i < ROWS; i++) {
        const struct sb_row *other = &set->row[i];
        if (strcmp(other->variant, row->dominated_by) == 0)
            named = other;
        if (!beats(other, row) || is_beaten(set, other))
            continue;
        if (other->max_err < least ||
            (other->max_err == least && other->median_ms < fastest)) {
            least = other->max_err;
            fastest = other->median_ms;
        }
    }
    assert_non_null(named);
    assert_true(beats(named, row));
    assert_string_equal(named->front, "front");
    check_close(named->max_err, least, 0);
    check_close(named->median_ms, fastest, 0);
    check_close(row->dominated_time, row->median_ms / fastest, 1e-12);
    const double times = row->max_err == 0 ? 1 : row->max_err / least;
    check_close(row->dominated_err, times, isinf(times) ? 0 : 1e-12);
}

static void marks_of_random_rows_are_those_of_the_definition(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(8);
    static struct set set;
    int fronts = 0, dominated = 0, neither = 0;
    for (int s = 0; s < SETS; s++) {
        for (int i = 0; i < ROWS; i++)
            random_row(&set, i, &random);
        mark(&set, ROWS);
        for (int i = 0; i < ROWS; i++) {
            const struct sb_row *row = &set.row[i];
            if (!counts(row)) {
                assert_null(row->front);
                assert_null(row->dominated_by);
                neither++;
            } else if (is_beaten(&set, row)) {
                assert_string_equal(row->front, "dominated");
                check_dominator(&set, row);
                dominated++;
            } else {
                assert_string_equal(row->front, "front");
                assert_null(row->dominated_by);
                assert_true(isnan(row->dominated_time) && isnan(row->dominated_err));
                fronts++;
            }
        }
    }
    // Each of the three was met often enough to mean something.
    assert_true(fronts > 1000 && dominated > 1000 && neither > 1000);
}

// The first row is faster, and as good.
static const char *front_of_second(const struct set *set, bool analytic)
{
    static struct set copy;
    copy = *set;
    for (int i = 0; i < 2; i++) {
        copy.row[i].axes = &copy.variant[i];
        copy.row[i].scene = analytic ? "sphere" : "room";
    }
    mark(&copy, 2);
    assert_string_equal(copy.row[0].front, "front");
    return copy.row[1].front;
}

static void begin_pair(struct set *set)
{
    base_row(set, 0);
    base_row(set, 1);
    set_time(&set->row[0], 1, 0.1);
}

// What each axis is there for is asked of its kind; target, samples and tessellation are the
// exceptions.
static void every_platform_and_scene_axis_keeps_rows_apart_and_no_other_does(void **state)
{
    (void)state;
    static struct set set;
    for (int axis = 0; axis < SB_AXIS_BUILTIN_COUNT; axis++) {
        const struct sb_axis *row = &sb_axes_builtin()->row[axis];
        begin_pair(&set);
        set.variant[1].value[axis] = row->init == row->max ? row->min : row->max;
        if (axis == SB_AXIS_EMULATE) {
            assert_null(front_of_second(&set, false));
            continue;
        }
        const bool apart = axis <= SB_AXIS_TESSELLATION || axis == SB_AXIS_TARGET ||
                           axis == SB_AXIS_SAMPLES;
        assert_string_equal(front_of_second(&set, false), apart ? "front" : "dominated");
        const bool quality = axis == SB_AXIS_TESSELLATION;
        assert_string_equal(front_of_second(&set, true),
                            apart && !quality ? "front" : "dominated");
    }
}

static void intervals_that_touch_or_overlap_dominate_nothing(void **state)
{
    (void)state;
    static struct set set;
    begin_pair(&set);
    set.row[0].ci_hi_ms = set.row[1].ci_lo_ms;
    assert_string_equal(front_of_second(&set, false), "front");
    set.row[0].ci_hi_ms = 2;
    assert_string_equal(front_of_second(&set, false), "front");
    set.row[0].ci_hi_ms = nextafter(set.row[1].ci_lo_ms, 0);
    assert_string_equal(front_of_second(&set, false), "dominated");
}

static void one_worse_error_of_any_kind_saves_the_other(void **state)
{
    (void)state;
    static struct set set;
    struct sb_row *row = &set.row[0];
    begin_pair(&set);
    row->max_err = nextafter(row->max_err, 1);
    assert_string_equal(front_of_second(&set, false), "front");
    begin_pair(&set);
    row->p999_err = nextafter(row->p999_err, 1);
    assert_string_equal(front_of_second(&set, false), "front");
    begin_pair(&set);
    row->flip_mean = nextafter(row->flip_mean, 1);
    assert_string_equal(front_of_second(&set, false), "front");
    begin_pair(&set);
    row->nonfinite = 1;
    assert_string_equal(front_of_second(&set, false), "front");
}

// A damaged file must not send the search for a dominator round in circles.
static void an_interval_with_its_ends_swapped_is_none(void **state)
{
    (void)state;
    static struct set set;
    for (int i = 0; i < 2; i++) {
        base_row(&set, i);
        set.row[i].ci_lo_ms = 3;
        set.row[i].ci_hi_ms = 1;
    }
    mark(&set, 2);
    assert_null(set.row[0].front);
    assert_null(set.row[1].front);
}

static void marks_of_before_are_forgotten(void **state)
{
    (void)state;
    static struct set set;
    base_row(&set, 0);
    set.row[0].front = "dominated";
    set.row[0].dominated_by = "somebody";
    set.row[0].dominated_time = set.row[0].dominated_err = 9;
    mark(&set, 1);
    assert_string_equal(set.row[0].front, "front");
    assert_null(set.row[0].dominated_by);
    assert_true(isnan(set.row[0].dominated_time) && isnan(set.row[0].dominated_err));
    mark(&set, 0);
}

static void check_text(const struct sb_row *row, const char *expected)
{
    struct sb_text text = {0};
    sb_pareto_text(row, "ID", &text);
    assert_string_equal(sb_text_get(&text), expected);
    sb_text_free(&text);
}

static void the_words_say_by_how_much(void **state)
{
    (void)state;
    static struct set set;
    base_row(&set, 0);
    struct sb_row *row = &set.row[0];
    check_text(row, "");
    row->front = "front";
    check_text(row, "front");
    row->front = "dominated";
    row->dominated_by = "another";
    row->dominated_time = 1.04;
    row->dominated_err = 12.34;
    check_text(row, "dominated by ID (1.04 times slower, 12.3 times the error)");
    row->dominated_time = 6.5;
    row->dominated_err = 1;
    check_text(row, "dominated by ID (6.50 times slower, the same error)");
    row->dominated_err = INFINITY;
    check_text(row, "dominated by ID (6.50 times slower, an error where that has none)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_of_random_rows_are_those_of_the_definition),
        cmocka_unit_test(
            every_platform_and_scene_axis_keeps_rows_apart_and_no_other_does),
        cmocka_unit_test(intervals_that_touch_or_overlap_dominate_nothing),
        cmocka_unit_test(one_worse_error_of_any_kind_saves_the_other),
        cmocka_unit_test(an_interval_with_its_ends_swapped_is_none),
        cmocka_unit_test(marks_of_before_are_forgotten),
        cmocka_unit_test(the_words_say_by_how_much),
    };
    return run_tests(tests);
}
