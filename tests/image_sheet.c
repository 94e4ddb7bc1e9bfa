// Scaling, shrinking and tiling against values written out.
#include "test.h"

#include "image/sheet.h"

static struct sb_image image, other;

static int free_images(void **state)
{
    (void)state;
    sb_image_free(&image);
    sb_image_free(&other);
    return 0;
}

static void fill(struct sb_image *to, int width, int height, int channels, float value)
{
    sb_image_init(to, width, height, channels);
    for (long i = 0; i < (long)width * height * channels; i++)
        to->data[i] = value;
}

static void stretching_keeps_0_black_and_spreads_the_rest(void **state)
{
    (void)state;
    fill(&image, 5, 1, 1, 0);
    const float stored[] = {0, 0.5f, 0.7f, 0.6f, NAN};
    memcpy(image.data, stored, sizeof stored);
    sb_image_stretch(&image);
    check_close(image.data[0], 0, 0);
    check_close(image.data[1], 0.1, 1e-6);
    check_close(image.data[2], 1, 0);
    check_close(image.data[3], 0.55, 1e-6);
    assert_true(isnan(image.data[4]));
}

static void stretching_a_flat_picture_makes_it_bright_and_an_empty_one_stays_so(
    void **state)
{
    (void)state;
    fill(&image, 2, 2, 1, 0.3f);
    sb_image_stretch(&image);
    check_close(image.data[3], 1, 0);
    fill(&other, 2, 2, 1, 0);
    sb_image_stretch(&other);
    check_close(other.data[3], 0, 0);
}

static void shrinking_takes_the_mean_of_whole_blocks(void **state)
{
    (void)state;
    fill(&image, 5, 4, 2, 0);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 5; x++) {
            sb_image_at(&image, x, y)[0] = (float)x;
            sb_image_at(&image, x, y)[1] = (float)(10 * y);
        }
    sb_image_shrink(&image, 3, &other); // by 2: 5 is too long, 3 is not
    assert_int_equal(other.width, 3);
    assert_int_equal(other.height, 2);
    check_close(sb_image_at(&other, 0, 0)[0], 0.5, 0);
    check_close(sb_image_at(&other, 1, 1)[0], 2.5, 0);
    check_close(sb_image_at(&other, 2, 1)[0], 4, 0); // half a block: its own mean
    check_close(sb_image_at(&other, 1, 0)[1], 5, 0);
    check_close(sb_image_at(&other, 1, 1)[1], 25, 0);
}

static void a_picture_that_fits_is_copied(void **state)
{
    (void)state;
    fill(&image, 3, 2, 3, 0.25f);
    sb_image_at(&image, 2, 1)[1] = 7;
    sb_image_shrink(&image, 3, &other);
    struct sb_image_difference difference;
    sb_image_compare(&image, &other, &difference);
    assert_int_equal(difference.pixels, 0);
}

static void a_sheet_runs_from_the_top_left_with_lines_between(void **state)
{
    (void)state;
    struct sb_image picture[10] = {{0}};
    for (int i = 0; i < 10; i++)
        fill(&picture[i], 3, 2, 1, (float)(i + 1));
    sb_sheet_make(picture, 10, &image);
    assert_int_equal(image.width, 8 * 3 + 7);
    assert_int_equal(image.height, 2 * 2 + 1);
    for (int i = 0; i < 10; i++)
        for (int y = 0; y < 2; y++)
            for (int x = 0; x < 3; x++) {
                const int line = i / 8 == 0 ? 3 + y : y; // lines count from the bottom
                check_close(*sb_image_at(&image, i % 8 * 4 + x, line), i + 1, 0);
            }
    for (int y = 0; y < 5; y++)
        check_close(*sb_image_at(&image, 3, y), 0.2, 1e-6);
    for (int x = 0; x < image.width; x++)
        check_close(*sb_image_at(&image, x, 2), 0.2, 1e-6);
    check_close(*sb_image_at(&image, 8, 0), 0, 0); // no picture there
    for (int i = 0; i < 10; i++)
        sb_image_free(&picture[i]);
}

static void smaller_pictures_stand_at_the_top_left_of_their_cells(void **state)
{
    (void)state;
    struct sb_image picture[2] = {{0}};
    fill(&picture[0], 4, 3, 1, 1);
    fill(&picture[1], 2, 1, 1, 2);
    sb_sheet_make(picture, 2, &image);
    assert_int_equal(image.width, 9);
    assert_int_equal(image.height, 3);
    check_close(*sb_image_at(&image, 5, 2), 2, 0);
    check_close(*sb_image_at(&image, 6, 2), 2, 0);
    check_close(*sb_image_at(&image, 7, 2), 0, 0);
    check_close(*sb_image_at(&image, 5, 1), 0, 0);
    sb_image_free(&picture[0]);
    sb_image_free(&picture[1]);
}

static void a_sheet_of_any_number_stays_below_16_million_pixels(void **state)
{
    (void)state;
    assert_int_equal(sb_sheet_side(1), 256);
    assert_int_equal(sb_sheet_side(200), 256);
    for (int count = 1; count <= 10000; count += 13) {
        const double columns = count < 8 ? count : 8, rows = ceil(count / 8.0);
        const double side = sb_sheet_side(count);
        assert_true(side >= 1);
        assert_true(columns * rows * side * side <= 1 << 24);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_images)
    const struct CMUnitTest tests[] = {
        TEST(stretching_keeps_0_black_and_spreads_the_rest),
        TEST(stretching_a_flat_picture_makes_it_bright_and_an_empty_one_stays_so),
        TEST(shrinking_takes_the_mean_of_whole_blocks),
        TEST(a_picture_that_fits_is_copied),
        TEST(a_sheet_runs_from_the_top_left_with_lines_between),
        TEST(smaller_pictures_stand_at_the_top_left_of_their_cells),
        TEST(a_sheet_of_any_number_stays_below_16_million_pixels),
    };
    return run_tests(tests);
}
