#include "test.h"

#include "image/image.h"

static struct sb_image a, b;

static int make_images(void **state)
{
    (void)state;
    sb_image_init(&a, 4, 3, 3);
    sb_image_init(&b, 4, 3, 3);
    for (int i = 0; i < 36; i++)
        a.data[i] = b.data[i] = (float)i;
    return 0;
}

static int free_images(void **state)
{
    (void)state;
    sb_image_free(&a);
    sb_image_free(&b);
    return a.data || b.width;
}

static void pixels_lie_row_by_row_with_their_channels_together(void **state)
{
    (void)state;
    assert_ptr_equal(sb_image_at(&a, 3, 2), a.data + (2 * 4 + 3) * 3);
}

static void a_new_image_is_black(void **state)
{
    (void)state;
    struct sb_image image;
    sb_image_init(&image, 5, 5, 4);
    for (int i = 0; i < 100; i++)
        check_close(image.data[i], 0, 0);
    sb_image_free(&image);
}

static void equal_images_do_not_differ(void **state)
{
    (void)state;
    struct sb_image_difference difference;
    a.data[0] = b.data[0] = INFINITY;
    a.data[1] = NAN;
    b.data[1] = -NAN;
    a.data[2] = 0.0f;
    b.data[2] = -0.0f;
    sb_image_compare(&a, &b, &difference);
    check_close(difference.max, 0, 0);
    assert_int_equal(difference.pixels, 0);
    assert_int_equal(difference.x + difference.y + difference.channel, 0);
    check_close(difference.a, 0, 0);
    check_close(difference.b, 0, 0);
}

static void the_largest_difference_is_found_with_its_place(void **state)
{
    (void)state;
    struct sb_image_difference difference;
    sb_image_at(&b, 1, 0)[0] += 0.25f;
    sb_image_at(&b, 1, 0)[2] += 0.5f; // the same pixel: counted once
    sb_image_at(&b, 3, 2)[1] -= 2;
    sb_image_at(&b, 0, 1)[2] = nextafterf(sb_image_at(&b, 0, 1)[2], 100);
    sb_image_compare(&a, &b, &difference);
    check_close(difference.max, 2, 0);
    assert_int_equal(difference.x, 3);
    assert_int_equal(difference.y, 2);
    assert_int_equal(difference.channel, 1);
    assert_int_equal(difference.pixels, 3);
    check_close(difference.a, (2 * 4 + 3) * 3 + 1, 0);
    check_close(difference.b, (2 * 4 + 3) * 3 + 1 - 2, 0);
}

static void differences_do_not_overflow(void **state)
{
    (void)state;
    struct sb_image_difference difference;
    a.data[5] = 3e38f;
    b.data[5] = -3e38f;
    sb_image_compare(&a, &b, &difference);
    check_close(difference.max, 6e38, 1e32);
}

static void non_finite_values_differ_infinitely_from_all_others(void **state)
{
    (void)state;
    const float pairs[][2] = {
        {NAN, 1}, {1, NAN}, {INFINITY, 1}, {INFINITY, -INFINITY}, {-INFINITY, NAN}};
    for (int i = 0; i < 5; i++) {
        struct sb_image_difference difference;
        a.data[7] = pairs[i][0];
        b.data[7] = pairs[i][1];
        sb_image_compare(&a, &b, &difference);
        check_close(difference.max, INFINITY, 0);
        assert_int_equal(difference.pixels, 1);
        assert_int_equal(difference.x, 2);
        assert_int_equal(difference.channel, 1);
    }
}

static void non_finite_values_are_counted_over_all_channels(void **state)
{
    (void)state;
    assert_int_equal(sb_image_count_nonfinite(&a), 0);
    a.data[0] = NAN;
    a.data[1] = -INFINITY;
    a.data[35] = INFINITY;
    assert_int_equal(sb_image_count_nonfinite(&a), 3);
}

#define with_images(test) cmocka_unit_test_setup_teardown(test, make_images, free_images)

int main(void)
{
    const struct CMUnitTest tests[] = {
        with_images(pixels_lie_row_by_row_with_their_channels_together),
        cmocka_unit_test(a_new_image_is_black),
        with_images(equal_images_do_not_differ),
        with_images(the_largest_difference_is_found_with_its_place),
        with_images(differences_do_not_overflow),
        with_images(non_finite_values_differ_infinitely_from_all_others),
        with_images(non_finite_values_are_counted_over_all_channels),
    };
    return run_tests(tests);
}
