// The statistics of an error against values written out, against sorting, and where
// values are missing or not finite.
#include "test.h"

#include "image/colour.h"
#include "image/metrics.h"
#include "math/random.h"

static struct sb_image test;
static struct sb_image64 truth;
static struct sb_metrics metrics;

static int free_images(void **state)
{
    (void)state;
    sb_image_free(&test);
    sb_image64_free(&truth);
    return 0;
}

static void both_init(int width, int height)
{
    sb_image_init(&test, width, height, 3);
    sb_image64_init(&truth, width, height, 3);
}

static void measure(const unsigned char *counted)
{
    const struct sb_metrics_params params = {
        .test = &test,
        .truth = &truth,
        .counted = counted,
    };
    sb_metrics_measure(&params, &metrics);
}

// Both pictures grey at the pixel.
static void set(int x, int y, float t, double r)
{
    for (int c = 0; c < 3; c++) {
        sb_image_at(&test, x, y)[c] = t;
        sb_image64_at(&truth, x, y)[c] = r;
    }
}

static void check_all_nan(void)
{
    const double figure[] = {metrics.max,       metrics.p50,      metrics.p99,
                             metrics.p999,      metrics.rmse,     metrics.bias,
                             metrics.psnr_db,   metrics.jnd1,     metrics.jnd2,
                             metrics.jnd1_srgb, metrics.relative, metrics.jnd2_srgb};
    for (size_t i = 0; i < sizeof figure / sizeof *figure; i++)
        assert_true(isnan(figure[i]));
    assert_int_equal(metrics.pixels, 0);
}

static void equal_pictures_have_no_error_and_an_infinite_ratio(void **state)
{
    (void)state;
    both_init(4, 3);
    for (int i = 0; i < 12; i++)
        set(i % 4, i / 4, (float)i / 8, i / 8.0);
    measure(NULL);
    assert_int_equal(metrics.pixels, 12);
    assert_int_equal(metrics.nonfinite, 0);
    assert_int_equal(metrics.negative, 0);
    const double zero[] = {metrics.max,       metrics.p50,      metrics.p99,
                           metrics.p999,      metrics.rmse,     metrics.bias,
                           metrics.jnd1,      metrics.jnd2,     metrics.relative,
                           metrics.jnd1_srgb, metrics.jnd2_srgb};
    for (size_t i = 0; i < sizeof zero / sizeof *zero; i++)
        assert_true(zero[i] == 0);
    assert_true(metrics.psnr_db == INFINITY);
    assert_int_equal(metrics.max_x + metrics.max_y + metrics.max_channel, 0);
}

static void a_single_wrong_channel_gives_the_figures_of_the_formulas(void **state)
{
    (void)state;
    both_init(4, 2);
    for (int i = 0; i < 8; i++)
        set(i % 4, i / 4, 0.5f, 0.5);
    sb_image_at(&test, 2, 1)[1] = 0.75f;
    sb_image_at(&test, 0, 0)[2] = 0.375f;
    measure(NULL);
    assert_int_equal(metrics.pixels, 8);
    check_close(metrics.max, 0.25, 0);
    assert_int_equal(metrics.max_x, 2);
    assert_int_equal(metrics.max_y, 1);
    assert_int_equal(metrics.max_channel, 1);
    check_close(metrics.p50, 0, 0);
    check_close(metrics.p99, 0.25, 0); // the nearest rank: the 8th of 8
    check_close(metrics.p999, 0.25, 0);
    const double mse = (0.25 * 0.25 + 0.125 * 0.125) / 24;
    check_close(metrics.rmse, sqrt(mse), 1e-15);
    check_close(metrics.psnr_db, 10 * log10(1 / mse), 1e-12);
    check_close(metrics.bias, (0.25 - 0.125) / 24, 1e-15);
    check_close(metrics.relative, 0.5, 0);
    check_close(metrics.jnd1, 0.25, 0);
    check_close(metrics.jnd2, 0.25, 0);
}

static int ascending(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

// The nearest rank in whole numbers: the first that `per_mille` of the values do not
// exceed.
static double nearest_rank(const double *sorted, long count, long per_mille)
{
    long rank = 1;
    while (rank * 1000 < per_mille * count)
        rank++;
    return sorted[rank - 1];
}

static void quantiles_are_those_of_the_sorted_errors(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(11);
    static double sorted[1201];
    for (int count = 1; count <= 1201; count += count < 20 ? 1 : 59) {
        both_init(count, 1);
        for (int i = 0; i < count; i++) {
            // Few distinct errors, so that many are equal.
            const bool coarse = count % 2;
            set(i, 0, 0, 0);
            sb_image_at(&test, i, 0)[i % 3] = // exact: the sorted figure must be equal
                (float)(coarse ? (double)sb_random_below(&random, 5) / 4
                               : sb_random_unit(&random));
            sorted[i] = (double)sb_image_at(&test, i, 0)[i % 3];
        }
        qsort(sorted, (size_t)count, sizeof *sorted, ascending);
        measure(NULL);
        check_close(metrics.p50, nearest_rank(sorted, count, 500), 0);
        check_close(metrics.p99, nearest_rank(sorted, count, 990), 0);
        check_close(metrics.p999, nearest_rank(sorted, count, 999), 0);
        check_close(metrics.max, sorted[count - 1], 0);
        free_images(NULL);
    }
}

// Orders in which a badly chosen pivot would take a time that grows with the square.
static void quantiles_are_found_among_ordered_errors(void **state)
{
    (void)state;
    enum { COUNT = 20000 };
    for (int way = 0; way < 3; way++) {
        both_init(COUNT, 1);
        for (int i = 0; i < COUNT; i++) {
            const int rank = way == 0 ? i : way == 1 ? COUNT - 1 - i : (i ^ 1);
            set(i, 0, (float)rank, 0);
        }
        measure(NULL);
        check_close(metrics.p50, COUNT / 2 - 1, 0);
        check_close(metrics.p99, COUNT * 0.99 - 1, 0);
        check_close(metrics.p999, COUNT * 0.999 - 1, 0);
        free_images(NULL);
    }
}

static void what_does_not_count_changes_nothing(void **state)
{
    (void)state;
    both_init(3, 2);
    for (int i = 0; i < 6; i++)
        set(i % 3, i / 3, 0.25f, 0.25);
    set(1, 0, NAN, 9);
    set(2, 1, -3, 9);
    set(0, 1, 0.5f, 0.25);
    measure((const unsigned char[]){1, 0, 1, 1, 1, 0});
    assert_int_equal(metrics.pixels, 4);
    assert_int_equal(metrics.nonfinite, 0);
    assert_int_equal(metrics.negative, 0);
    check_close(metrics.max, 0.25, 0);
    assert_int_equal(metrics.max_x, 0);
    assert_int_equal(metrics.max_y, 1);
    check_close(metrics.bias, 0.0625, 1e-16);
    check_close(metrics.jnd1, 0.25, 0);
}

static void values_that_are_not_finite_are_counted_and_are_in_no_mean(void **state)
{
    (void)state;
    both_init(4, 1);
    for (int x = 0; x < 4; x++)
        set(x, 0, 0.5f, 0.25);
    sb_image_at(&test, 1, 0)[0] = NAN;
    sb_image_at(&test, 1, 0)[1] = -INFINITY;
    sb_image_at(&test, 1, 0)[2] = -1; // counts as negative though its pixel is left out
    sb_image_at(&test, 2, 0)[2] = INFINITY;
    sb_image64_at(&truth, 3, 0)[0] = NAN; // not the test's fault: not counted
    sb_image_at(&test, 0, 0)[1] = -0.0f;  // not negative
    measure(NULL);
    assert_int_equal(metrics.nonfinite, 3);
    assert_int_equal(metrics.negative, 1);
    assert_int_equal(metrics.pixels, 1);
    check_close(metrics.max, 0.25, 0);
    check_close(metrics.rmse, 0.25, 1e-15);
    check_close(metrics.bias, 0.25 / 3, 1e-15);
    check_close(metrics.p999, 0.25, 0);
}

static void negative_values_are_errors_as_any_other(void **state)
{
    (void)state;
    both_init(2, 1);
    set(0, 0, -0.5f, 0);
    set(1, 0, 0, 0);
    measure(NULL);
    assert_int_equal(metrics.negative, 3);
    assert_int_equal(metrics.pixels, 2);
    check_close(metrics.max, 0.5, 0);
    check_close(metrics.bias, -0.25, 0);
    check_close(metrics.jnd1, 0, 0); // a display shows black
}

static void no_pixel_has_no_figures(void **state)
{
    (void)state;
    both_init(2, 1);
    set(0, 0, NAN, 0);
    set(1, 0, 1, 0);
    measure((const unsigned char[]){0, 0});
    check_all_nan();
    assert_int_equal(metrics.nonfinite, 0);
    measure((const unsigned char[]){1, 0});
    check_all_nan();
    assert_int_equal(metrics.nonfinite, 3);
}

// From the middle of one 8-bit step to that of another, in linear light and behind the
// transfer function: 1/255 is 12 or 13 steps near black, and less than one near white.
static void steps_are_counted_behind_the_transfer_function_too(void **state)
{
    (void)state;
    both_init(1, 1);
    for (int from = 0; from < 255; from++)
        for (int by = 0; by <= 2 && from + by <= 255; by++) {
            set(0, 0, (float)((from + by) / 255.0), from / 255.0);
            measure(NULL);
            check_close(metrics.jnd1, by >= 1, 0);
            check_close(metrics.jnd2, by >= 2, 0);
            const double a = floor(255 * sb_srgb_encode((double)test.data[0]) + 0.5);
            const double b = floor(255 * sb_srgb_encode(truth.data[0]) + 0.5);
            check_close(metrics.jnd1_srgb, fabs(a - b) >= 1, 0);
            check_close(metrics.jnd2_srgb, fabs(a - b) >= 2, 0);
        }
    set(0, 0, 1 / 255.0f, 0);
    measure(NULL);
    check_close(metrics.jnd2, 0, 0);
    check_close(metrics.jnd2_srgb, 1, 0);
    set(0, 0, 254 / 255.0f, 1);
    measure(NULL);
    check_close(metrics.jnd1, 1, 0);
    check_close(metrics.jnd1_srgb, 0, 0);
    set(0, 0, 7, 1); // both white
    measure(NULL);
    check_close(metrics.jnd1, 0, 0);
    check_close(metrics.max, 6, 0);
}

static void the_relative_error_is_held_below_by_a_thousandth(void **state)
{
    (void)state;
    both_init(1, 1);
    set(0, 0, 0.5e-3f, 0);
    measure(NULL);
    check_close(metrics.relative, 0.5, 1e-6);
    set(0, 0, 300, -200);
    measure(NULL);
    check_close(metrics.relative, 2.5, 0);
}

static void a_fourth_channel_is_not_looked_at(void **state)
{
    (void)state;
    sb_image_init(&test, 2, 2, 4);
    sb_image64_init(&truth, 2, 2, 3);
    for (int i = 0; i < 4; i++) {
        set(i % 2, i / 2, 0.5f, 0.5);
        sb_image_at(&test, i % 2, i / 2)[3] = NAN;
    }
    measure(NULL);
    assert_int_equal(metrics.pixels, 4);
    assert_int_equal(metrics.nonfinite, 0);
    check_close(metrics.max, 0, 0);
}

// Scaling every error scales the figures that are linear in it.
static void twice_the_error_is_twice_the_figures_and_6_decibels(void **state)
{
    (void)state;
    both_init(16, 16);
    struct sb_random random = sb_random_seed(5);
    for (int i = 0; i < 16 * 16 * 3; i++) {
        truth.data[i] = 1;
        test.data[i] =
            (float)(1 + ldexp((double)sb_random_below(&random, 257) - 128, -12));
    }
    measure(NULL);
    const struct sb_metrics once = metrics;
    for (int i = 0; i < 16 * 16 * 3; i++)
        test.data[i] = 1 + 2 * (test.data[i] - 1);
    measure(NULL);
    check_close(metrics.max, 2 * once.max, 0);
    check_close(metrics.p50, 2 * once.p50, 0);
    check_close(metrics.p99, 2 * once.p99, 0);
    check_close(metrics.rmse, 2 * once.rmse, 1e-15);
    check_close(metrics.bias, 2 * once.bias, 1e-15);
    check_close(metrics.psnr_db, once.psnr_db - 20 * log10(2), 1e-12);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_images)
    const struct CMUnitTest tests[] = {
        TEST(equal_pictures_have_no_error_and_an_infinite_ratio),
        TEST(a_single_wrong_channel_gives_the_figures_of_the_formulas),
        TEST(quantiles_are_those_of_the_sorted_errors),
        TEST(quantiles_are_found_among_ordered_errors),
        TEST(what_does_not_count_changes_nothing),
        TEST(values_that_are_not_finite_are_counted_and_are_in_no_mean),
        TEST(negative_values_are_errors_as_any_other),
        TEST(no_pixel_has_no_figures),
        TEST(steps_are_counted_behind_the_transfer_function_too),
        TEST(the_relative_error_is_held_below_by_a_thousandth),
        TEST(a_fourth_channel_is_not_looked_at),
        TEST(twice_the_error_is_twice_the_figures_and_6_decibels),
    };
    return run_tests(tests);
}
