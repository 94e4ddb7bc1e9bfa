// The cost model on rows whose costs are known: it must give back what they were made from.
#include "test.h"

#include "analyse/crossing.h"
#include "analyse/fit.h"
#include "math/random.h"

enum { ROWS = 64 };
static const int count_axis[] = {SB_AXIS_DIR, SB_AXIS_POINT, SB_AXIS_SPOT};
enum { TYPES = 3 };

static struct sb_row row[ROWS];
static struct sb_variant variant[ROWS];
static int rows;
static struct sb_fit fit;
static struct sb_crossings crossings;

static int begin(void **state)
{
    (void)state;
    rows = 0;
    sb_fit_free(&fit);
    sb_crossings_free(&crossings);
    return 0;
}

static struct sb_row *add(double ms, double half)
{
    struct sb_row *it = &row[rows];
    assert_true(rows < ROWS);
    sb_row_init(it);
    sb_variant_init(sb_axes_builtin(), &variant[rows]);
    it->axes = &variant[rows++];
    it->variant = "a variant";
    it->scene = "containers";
    it->renderer = "a driver";
    it->version = "1";
    it->timer_source = "elapsed";
    it->status = "ok";
    it->ci_kind = "ci95_within_run";
    it->median_ms = ms;
    it->ci_lo_ms = ms - half;
    it->ci_hi_ms = ms + half;
    return it;
}

static struct sb_row *add_lights(int dir, int point, int spot, double ms)
{
    struct sb_row *it = add(ms, 0.002 * ms);
    variant[rows - 1].value[SB_AXIS_DIR] = dir;
    variant[rows - 1].value[SB_AXIS_POINT] = point;
    variant[rows - 1].value[SB_AXIS_SPOT] = spot;
    return it;
}

static void make(void)
{
    const struct sb_fit_params params = {
        .axes = sb_axes_builtin(),
        .row = row,
        .count = rows,
        .count_axis = count_axis,
        .count_axes = TYPES,
    };
    sb_fit_free(&fit);
    sb_fit_make(&params, &fit);
}

// 0.5 ms, 0.3 more with any light, 0.2, 0.25 and 0.4 for each.
static double known_cost(int dir, int point, int spot)
{
    return 0.5 + (dir + point + spot > 0 ? 0.3 : 0) + 0.2 * dir + 0.25 * point +
           0.4 * spot;
}

static const int counts[] = {1, 2, 4, 8, 12, 16};
enum { COUNTS = 6 };

static void add_counts(double cost(int, int, int))
{
    for (int c = 0; c < COUNTS; c++) {
        add_lights(counts[c], 0, 0, cost(counts[c], 0, 0));
        add_lights(0, counts[c], 0, cost(0, counts[c], 0));
        add_lights(0, 0, counts[c], cost(0, 0, counts[c]));
    }
}

static void known_costs_come_back_and_mixes_are_their_sum(void **state)
{
    (void)state;
    add_lights(0, 0, 0, known_cost(0, 0, 0));
    add_counts(known_cost);
    add_lights(2, 3, 2, known_cost(2, 3, 2));
    add_lights(0, 8, 5, known_cost(0, 8, 5));
    make();
    assert_int_equal(fit.count, 1);
    assert_int_equal(fit.left_over, 0);
    const struct sb_fit_group *group = &fit.group[0];
    static const double price[] = {0.2, 0.25, 0.4};
    assert_true(group->unlit);
    check_close(group->base->median_ms, 0.5, 0);
    check_close(group->first_ms, 0.3, 1e-12);
    check_close(group->lit_ms, 0.8, 1e-12);
    assert_int_equal(group->types, 3);
    for (int t = 0; t < 3; t++) {
        assert_int_equal(group->type[t].axis, count_axis[t]);
        assert_int_equal(group->type[t].shape, SB_FIT_LINE);
        check_close(group->type[t].price.point, price[t], 1e-12);
        check_close(group->type[t].price.lo, price[t], 1e-12);
        check_close(group->type[t].price.hi, price[t], 1e-12);
        check_close(group->type[t].first_ms, 0.3, 1e-12);
        check_close(group->type[t].off, 0, 1e-12);
    }
    assert_int_equal(group->mixes, 2);
    for (int m = 0; m < 2; m++) {
        check_close(group->mix[m].off, 0, 1e-12);
        assert_false(group->mix[m].outside);
    }
    check_close(group->interaction, 0, 1e-12);
    assert_true(isnan(sb_fit_at(&group->type[0], 0).point));
    check_close(sb_fit_at(&group->type[0], 5).point, 1.8, 1e-12);
    assert_true(isnan(sb_fit_at(&group->type[0], 17).point));
}

static void noise_widens_intervals_and_leaves_prices_near(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    int covered = 0, sets = 200;
    for (int s = 0; s < sets; s++) {
        rows = 0;
        add_lights(0, 0, 0, 0.5);
        for (int c = 0; c < COUNTS; c++) {
            const double noise = (double)sb_random_below(&random, 1000) / 1000 - 0.5;
            add_lights(counts[c], 0, 0, known_cost(counts[c], 0, 0) + 0.03 * noise);
        }
        make();
        const struct sb_fit_type *type = &fit.group[0].type[0];
        check_close(type->price.point, 0.2, 0.02);
        covered += type->price.lo <= 0.2 && 0.2 <= type->price.hi;
        assert_true(type->price.lo < type->price.hi);
    }
    assert_true(covered > 0.93 * sets);
}

static void few_counts_have_a_price_and_no_interval_and_fewer_none(void **state)
{
    (void)state;
    add_lights(0, 0, 0, 0.5);
    for (int c = 0; c < 4; c++)
        add_lights(counts[c], 0, 0, known_cost(counts[c], 0, 0));
    add_lights(0, 1, 0, known_cost(0, 1, 0));
    add_lights(0, 2, 0, known_cost(0, 2, 0));
    add_lights(1, 1, 0, known_cost(1, 1, 0));
    make();
    assert_int_equal(fit.group[0].types, 1);
    check_close(fit.group[0].type[0].price.point, 0.2, 1e-12);
    assert_true(isnan(fit.group[0].type[0].price.lo));
    assert_int_equal(fit.group[0].mixes, 1);
    assert_int_equal(fit.group[0].predicted, 0);
    assert_true(isnan(fit.group[0].mix[0].off) && isnan(fit.group[0].interaction));
}

// --- shapes -------------------------------------------------------------------------------

static double free_at_first(int n)
{
    return 2 + 0.3 * fmax(n - 5, 0);
}

static void lights_that_cost_nothing_are_a_flat_part(void **state)
{
    (void)state;
    add_lights(0, 0, 0, 2);
    for (int n = 1; n <= 10; n++)
        add_lights(n, 0, 0, free_at_first(n) * (n % 2 ? 1.001 : 0.999));
    make();
    const struct sb_fit_type *type = &fit.group[0].type[0];
    assert_int_equal(type->shape, SB_FIT_BEND);
    check_close(type->curve.at, 5, 0.1);
    check_close(type->price.point, 0.3, 0.005);
    for (int n = 1; n <= 10; n++) {
        const struct sb_interval at = sb_fit_at(type, n);
        check_close(at.point, free_at_first(n), 0.01);
        assert_true(at.lo <= at.point && at.point <= at.hi);
    }
    assert_int_equal(sb_fit_lights_in(&fit.group[0], type, 2.1, 0).n, 5);
    assert_int_equal(sb_fit_lights_in(&fit.group[0], type, 2.7, 0).n, 7);
}

// As a driver does that unrolls loops up to a length.
static double with_a_jump(int dir, int point, int spot)
{
    return known_cost(dir, point, spot) + (dir > 6 ? 0.8 : 0) + (point > 6 ? 0.8 : 0) +
           (spot > 6 ? 1.5 : 0);
}

static void a_jump_is_read_off_between_counts_and_said(void **state)
{
    (void)state;
    add_lights(0, 0, 0, with_a_jump(0, 0, 0));
    add_counts(with_a_jump);
    add_lights(4, 4, 4, with_a_jump(4, 4, 4));
    add_lights(8, 0, 12, with_a_jump(8, 0, 12));
    add_lights(5, 1, 0, with_a_jump(5, 1, 0));
    make();
    const struct sb_fit_group *group = &fit.group[0];
    const struct sb_fit_type *type = &group->type[0];
    assert_int_equal(type->shape, SB_FIT_UNEVEN);
    assert_true(fabs(type->off) > SB_FIT_STRAIGHT);
    check_close(type->jump_from, 4, 0);
    check_close(type->jump_to, 8, 0);
    check_close(type->jump_ms, 0.8, 1e-9);
    for (int m = 0; m < 2; m++) {
        check_close(group->mix[m].off, 0, 1e-12);
        assert_false(group->mix[m].in_jump);
    }
    assert_true(group->mix[2].in_jump && !group->mix[2].outside);
    // Both 5 before the jump and 5 behind it are possible.
    const struct sb_interval at = sb_fit_at(type, 5);
    assert_true(at.lo <= with_a_jump(5, 0, 0) && at.hi >= with_a_jump(5, 0, 0) + 0.8);
    const struct sb_interval known = sb_fit_at(type, 8);
    check_close(known.hi - known.lo, 0.004 * known.point, 1e-12);
}

// --- mixes --------------------------------------------------------------------------------

static void interactions_are_the_median_of_what_is_left(void **state)
{
    (void)state;
    static const int mix[][3] = {{1, 1, 0}, {0, 2, 2}, {2, 3, 2}, {8, 0, 8}, {4, 4, 4}};
    static const double factor[] = {0.97, 1.02, 0.8, 0.95, 0.9999};
    add_lights(0, 0, 0, known_cost(0, 0, 0));
    add_counts(known_cost);
    for (int m = 0; m < 5; m++)
        add_lights(mix[m][0], mix[m][1], mix[m][2],
                   factor[m] * known_cost(mix[m][0], mix[m][1], mix[m][2]));
    add_lights(20, 1, 0, 5); // 20 were not measured
    make();
    const struct sb_fit_group *group = &fit.group[0];
    assert_int_equal(group->mixes, 6);
    assert_int_equal(group->predicted, 5);
    for (int m = 0; m < 5; m++) {
        check_close(group->mix[m].off, factor[m] - 1, 1e-12);
        assert_int_equal(group->mix[m].outside, m != 4);
    }
    check_close(group->interaction, -0.03, 1e-12);
    check_close(group->worst, -0.2, 1e-12);
}

static void without_the_dark_frame_the_lines_say_where_it_begins(void **state)
{
    (void)state;
    add_counts(known_cost);
    add_lights(2, 3, 2, known_cost(2, 3, 2));
    make();
    assert_null(fit.group[0].base);
    check_close(fit.group[0].lit_ms, 0.8, 1e-12);
    check_close(fit.group[0].mix[0].off, 0, 1e-12);
    assert_true(isnan(fit.group[0].type[0].first_ms));
}

// As in `base: {dir: 1, spot: 1}`, `sweep: {point: …}`.
static void lights_that_all_rows_have_belong_to_the_floor(void **state)
{
    (void)state;
    add_lights(1, 0, 1, known_cost(1, 0, 1));
    for (int c = 0; c < COUNTS; c++) {
        add_lights(1, counts[c], 1, known_cost(1, counts[c], 1));
        if (counts[c] > 1)
            add_lights(counts[c], 0, 1, known_cost(counts[c], 0, 1));
    }
    add_lights(4, 3, 1, known_cost(4, 3, 1));
    make();
    const struct sb_fit_group *group = &fit.group[0];
    assert_false(group->unlit);
    assert_int_equal(group->types, 2);
    check_close(group->type[0].count[0].n, 1,
                0); // the base is a point of the line of dir
    check_close(group->type[1].count[0].n, 1, 0);
    check_close(group->mix[0].off, 0, 1e-12);
}

// --- groups -------------------------------------------------------------------------------

static void other_stages_drivers_and_failed_rows_are_kept_apart(void **state)
{
    (void)state;
    for (int stage = 0; stage < 2; stage++)
        for (int c = 0; c < COUNTS; c++) {
            add_lights(counts[c], 0, 0, known_cost(counts[c], 0, 0) / (1 + stage));
            variant[rows - 1].value[SB_AXIS_STAGE] = stage;
        }
    add_lights(6, 0, 0, 99)->renderer = "another";
    add_lights(6, 0, 0, 99)->timer_source = "wall";
    add_lights(6, 0, 0, 99)->scene = "room";
    add_lights(6, 0, 0, 99)->status = "samples_invalid";
    add_lights(6, 0, 0, NAN)->status = "not_measured";
    make();
    assert_int_equal(fit.count, 2);
    check_close(fit.group[0].type[0].price.point, 0.2, 1e-12);
    check_close(fit.group[1].type[0].price.point, 0.1, 1e-12);
    assert_int_equal(fit.group[0].type[0].counts + fit.group[1].type[0].counts, 12);
    assert_int_equal(fit.without_time, 2);
    assert_int_equal(fit.left_over, 3);
}

// The cone is moot without spots: the dark frame and the other types serve both cones.
static void a_moot_axis_goes_with_every_value(void **state)
{
    (void)state;
    add_lights(0, 0, 0, known_cost(0, 0, 0));
    for (int c = 0; c < COUNTS; c++)
        add_lights(counts[c], 0, 0, known_cost(counts[c], 0, 0));
    for (int cone = SB_CONE_HARD; cone <= SB_CONE_EXPONENT; cone++) {
        for (int c = 0; c < COUNTS; c++) {
            add_lights(0, 0, counts[c], (1 + cone) * known_cost(0, 0, counts[c]));
            variant[rows - 1].value[SB_AXIS_CONE] = cone;
        }
        add_lights(2, 0, 2, 1);
        variant[rows - 1].value[SB_AXIS_CONE] = cone;
    }
    make();
    assert_int_equal(fit.count, 2);
    for (int g = 0; g < 2; g++) {
        assert_int_equal(fit.group[g].types, 2);
        assert_int_equal(fit.group[g].mixes, 1);
        check_close(fit.group[g].type[0].price.point, 0.2, 1e-12);
        check_close(fit.group[g].type[1].price.point, 0.4 * (1 + g), 1e-12);
    }
}

// --- lights that fit ----------------------------------------------------------------------

static void lights_that_fit_are_whole_and_never_beyond_what_was_measured(void **state)
{
    (void)state;
    add(0.5, 0.1);
    for (int c = 0; c < COUNTS; c++) {
        const double ms = known_cost(counts[c], 0, 0); // 0.8 + 0.2 n
        struct sb_row *it = add_lights(counts[c], 0, 0, ms);
        it->ci_lo_ms = 0.9 * ms;
        it->ci_hi_ms = 1.1 * ms;
    }
    make();
    const struct sb_fit_group *group = &fit.group[0];
    const struct sb_fit_type *type = &group->type[0];
    static const double ms[] = {0.3, 0.7, 1.01, 2.01, 2.19, 3.99, 4.01, 100};
    static const int lights[] = {0, 0, 1, 6, 6, 15, 16, 16};
    for (int i = 0; i < 8; i++) {
        const struct sb_fit_lights fits = sb_fit_lights_in(group, type, ms[i], 0);
        assert_int_equal(fits.n, lights[i]);
        assert_int_equal(fits.floor, i == 0);
        assert_int_equal(fits.above, i >= 6);
        assert_false(fits.below);
    }
    // Of rows a tenth lower: 0.72 + 0.18 n; a tenth higher: 0.88 + 0.22 n.
    assert_int_equal(sb_fit_lights_in(group, type, 2.01, 1).n, 7);
    assert_int_equal(sb_fit_lights_in(group, type, 2.01, -1).n, 5);
    assert_true(sb_fit_lights_in(group, type, 0.55, -1).floor);
    assert_false(sb_fit_lights_in(group, type, 0.55, 1).floor);
}

static void counts_that_begin_above_one_say_nothing_of_one(void **state)
{
    (void)state;
    add_lights(0, 0, 0, 0.5);
    for (int c = 2; c < COUNTS; c++) // from 4 on
        add_lights(counts[c], 0, 0, known_cost(counts[c], 0, 0));
    make();
    const struct sb_fit_lights fits =
        sb_fit_lights_in(&fit.group[0], &fit.group[0].type[0], 1.1, 0);
    assert_true(fits.below && !fits.floor && !fits.above);
    assert_int_equal(fits.n, 4);
}

// --- crossings ----------------------------------------------------------------------------

// ratio[i] of fragment over vertex at 10^i triangles on 1000 fragments.
static void add_stages(const double *ratio, double half, int count)
{
    for (int i = 0; i < count; i++)
        for (int stage = 0; stage < 2; stage++) {
            struct sb_row *it = add(stage ? 1 : ratio[i], 0);
            it->ci_lo_ms = it->median_ms / (1 + half);
            it->ci_hi_ms = it->median_ms * (1 + half);
            it->vertices = 3 * (int64_t)pow(10, i);
            it->fragments = 1000;
            variant[rows - 1].value[SB_AXIS_STAGE] = stage;
            variant[rows - 1].value[SB_AXIS_TESSELLATION] = pow(10, i);
        }
    sb_crossings_find(sb_axes_builtin(), row, rows, &crossings);
}

static void a_crossing_lies_where_the_logarithms_meet(void **state)
{
    (void)state;
    static const double ratio[] = {4, 2, 0.5, 0.25};
    add_stages(ratio, 0.1, 4);
    assert_int_equal(crossings.count, 1);
    const struct sb_crossing_series *series = crossings.series;
    assert_int_equal(series->axis, SB_AXIS_STAGE);
    assert_int_equal(series->pairs, 4);
    check_close(series->pair[0].density, 0.001, 1e-15);
    check_close(series->pair[1].ratio, 2, 0);
    assert_int_equal(series->crossings, 1);
    const struct sb_crossing *at = series->crossing;
    assert_true(at->b_first && !at->open_lo && !at->open_hi);
    check_close(at->density, pow(10, -1.5), 1e-12);
    // The ends of the ratio's interval are 1.21 times away: so much later they come to 1.
    const double shift = log(1.21) / (2 * log(2));
    check_close(log10(at->lo), -1.5 - shift, 1e-9);
    check_close(log10(at->hi), -1.5 + shift, 1e-9);
}

static void a_crossing_at_the_end_of_what_was_measured_is_open(void **state)
{
    (void)state;
    static const double ratio[] = {4, 2, 0.98};
    add_stages(ratio, 0.05, 3);
    const struct sb_crossing *at = crossings.series->crossing;
    assert_int_equal(crossings.series->crossings, 1);
    assert_true(at->open_hi && !at->open_lo);
    check_close(at->hi, 0.1, 1e-12);
}

static void no_crossing_is_made_up_and_one_density_is_no_series(void **state)
{
    (void)state;
    static const double ratio[] = {4, 2, 1.5};
    add_stages(ratio, 0.01, 3);
    assert_int_equal(crossings.count, 1);
    assert_int_equal(crossings.series->crossings, 0);
    begin(NULL);
    add_stages(ratio, 0.01, 1);
    assert_int_equal(crossings.count, 0);
}

static void series_differ_in_more_than_triangles(void **state)
{
    (void)state;
    static const double ratio[] = {4, 0.5}, other[] = {0.5, 4};
    add_stages(ratio, 0.01, 2);
    sb_crossings_free(&crossings);
    const int first = rows;
    add_stages(other, 0.01, 2);
    sb_crossings_free(&crossings);
    for (int i = first; i < rows; i++)
        variant[i].value[SB_AXIS_POINT] = 4;
    sb_crossings_find(sb_axes_builtin(), row, rows, &crossings);
    assert_int_equal(crossings.count, 2);
    assert_true(crossings.series[0].crossing[0].b_first);
    assert_false(crossings.series[1].crossing[0].b_first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(known_costs_come_back_and_mixes_are_their_sum, begin),
        cmocka_unit_test_setup(noise_widens_intervals_and_leaves_prices_near, begin),
        cmocka_unit_test_setup(few_counts_have_a_price_and_no_interval_and_fewer_none,
                               begin),
        cmocka_unit_test_setup(lights_that_cost_nothing_are_a_flat_part, begin),
        cmocka_unit_test_setup(a_jump_is_read_off_between_counts_and_said, begin),
        cmocka_unit_test_setup(interactions_are_the_median_of_what_is_left, begin),
        cmocka_unit_test_setup(without_the_dark_frame_the_lines_say_where_it_begins,
                               begin),
        cmocka_unit_test_setup(lights_that_all_rows_have_belong_to_the_floor, begin),
        cmocka_unit_test_setup(other_stages_drivers_and_failed_rows_are_kept_apart,
                               begin),
        cmocka_unit_test_setup(a_moot_axis_goes_with_every_value, begin),
        cmocka_unit_test_setup(
            lights_that_fit_are_whole_and_never_beyond_what_was_measured, begin),
        cmocka_unit_test_setup(counts_that_begin_above_one_say_nothing_of_one, begin),
        cmocka_unit_test_setup(a_crossing_lies_where_the_logarithms_meet, begin),
        cmocka_unit_test_setup(a_crossing_at_the_end_of_what_was_measured_is_open, begin),
        cmocka_unit_test_setup(no_crossing_is_made_up_and_one_density_is_no_series,
                               begin),
        cmocka_unit_test_setup(series_differ_in_more_than_triangles, begin),
    };
    const int failed = run_tests(tests);
    begin(NULL);
    return failed;
}
