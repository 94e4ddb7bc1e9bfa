// Heat maps: colours against lightness and against the scale that is drawn beside them,
// numbers against dots written out here.
#include "test.h"

#include "image/colour.h"
#include "image/heat.h"
#include "image/sheet.h"

static struct sb_image errors, heat, other;
static struct sb_image64 truth;

static int free_images(void **state)
{
    (void)state;
    sb_image_free(&errors);
    sb_image_free(&heat);
    sb_image_free(&other);
    sb_image64_free(&truth);
    return 0;
}

static void errors_init(int width, int height, float error)
{
    sb_image_init(&errors, width, height, 1);
    for (int i = 0; i < width * height; i++)
        errors.data[i] = error;
}

static void draw(double low, double high)
{
    const struct sb_heat_params params = {.test = &errors, .low = low, .high = high};
    sb_heat_map(&params, &heat);
}

// A pixel of the picture, counted from its own lower left.
static const float *picture_at(int x, int y)
{
    return sb_image_at(&heat, x, heat.height - errors.height + y);
}

static void check_pixel(const float *pixel, double r, double g, double b)
{
    check_close((double)pixel[0], r, 1e-6);
    check_close((double)pixel[1], g, 1e-6);
    check_close((double)pixel[2], b, 1e-6);
}

// CIE L* of linear RGB.
static double lightness(const float *pixel)
{
    const double y =
        0.2126 * (double)pixel[0] + 0.7152 * (double)pixel[1] + 0.0722 * (double)pixel[2];
    return y > 0.008856 ? 116 * cbrt(y) - 16 : 903.3 * y;
}

static void the_transfer_function_is_undone_by_its_inverse(void **state)
{
    (void)state;
    for (int i = -10; i <= 1100; i++) {
        const double encoded = i / 1000.0;
        check_close(sb_srgb_encode(sb_srgb_decode(encoded)), encoded, 1e-7);
    }
}

static void lightness_rises_with_every_step_of_the_error(void **state)
{
    (void)state;
    enum { STEPS = 200 };
    errors_init(STEPS, 1, 0);
    for (int i = 0; i < STEPS; i++)
        errors.data[i] = (float)pow(10, -6 + 6.0 * i / (STEPS - 1));
    draw(0, 0);
    const double whole =
        lightness(picture_at(STEPS - 1, 0)) - lightness(picture_at(0, 0));
    assert_true(whole > 70);
    for (int i = 1; i < STEPS; i++) {
        const double step = lightness(picture_at(i, 0)) - lightness(picture_at(i - 1, 0));
        check_close(step, whole / (STEPS - 1), 0.3 * whole / (STEPS - 1)); // evenly
    }
}

static void the_ends_have_the_colours_of_viridis_and_keep_them_beyond(void **state)
{
    (void)state;
    errors_init(6, 1, 0);
    const float value[] = {0, 1e-9f, 1e-6f, 1, 5, -5};
    memcpy(errors.data, value, sizeof value);
    draw(0, 0);
    for (int i = 0; i < 3; i++)
        check_pixel(picture_at(i, 0), sb_srgb_decode(0.267004), sb_srgb_decode(0.004874),
                    sb_srgb_decode(0.329415));
    for (int i = 3; i < 6; i++)
        check_pixel(picture_at(i, 0), sb_srgb_decode(0.993248), sb_srgb_decode(0.906157),
                    sb_srgb_decode(0.143936));
}

static void the_error_is_the_largest_of_the_channels(void **state)
{
    (void)state;
    sb_image64_init(&truth, 4, 3, 3);
    sb_image_init(&errors, 4, 3, 4);
    sb_image_at(&errors, 1, 2)[0] = 0.001f;
    sb_image_at(&errors, 1, 2)[2] = 0.01f;
    sb_image_at(&errors, 1, 2)[3] = 1; // alpha is not looked at
    sb_image64_at(&truth, 2, 0)[1] = 0.01;
    const struct sb_heat_params params = {.test = &errors, .truth = &truth};
    sb_heat_map(&params, &other);
    sb_image_free(&errors);
    errors_init(4, 3, 0);
    *sb_image_at(&errors, 1, 2) = *sb_image_at(&errors, 2, 0) = 0.01f;
    draw(0, 0);
    struct sb_image_difference difference;
    sb_image_compare(&heat, &other, &difference);
    assert_true(difference.max < 1e-6);
}

static void what_does_not_count_is_grey_and_what_is_not_finite_magenta(void **state)
{
    (void)state;
    sb_image64_init(&truth, 3, 2, 3);
    sb_image_init(&errors, 3, 2, 3);
    sb_image_at(&errors, 0, 0)[1] = NAN;
    sb_image_at(&errors, 1, 0)[2] = -INFINITY;
    sb_image64_at(&truth, 2, 0)[0] = NAN;
    sb_image_at(&errors, 0, 1)[0] = NAN;
    const struct sb_heat_params params = {
        .test = &errors,
        .truth = &truth,
        .counted = (const unsigned char[]){1, 1, 1, 0, 0, 1},
    };
    sb_heat_map(&params, &heat);
    for (int x = 0; x < 3; x++)
        check_pixel(picture_at(x, 0), 1, 0, 1);
    for (int x = 0; x < 2; x++)
        for (int c = 0; c < 3; c++)
            check_close(sb_srgb_encode((double)picture_at(x, 1)[c]), 0.5, 1e-6);
    assert_true(picture_at(2, 1)[2] < 0.2f && picture_at(2, 1)[1] < 0.01f);
}

static void the_size_is_the_picture_and_its_scale_in_whole_dots(void **state)
{
    (void)state;
    static const int size[][5] = {
        // width, height, dot, and of the map width and height
        {1, 1, 1, 1 + 52, 72},         {204, 256, 1, 204 + 52, 256},
        {205, 100, 2, 206 + 104, 144}, {256, 256, 2, 256 + 104, 256},
        {100, 257, 2, 100 + 104, 258}, {1023, 600, 6, 1026 + 312, 600},
    };
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        errors_init(size[i][0], size[i][1], 1);
        draw(0, 0);
        assert_int_equal(sb_heat_dot(size[i][0], size[i][1]), size[i][2]);
        assert_int_equal(heat.width, size[i][3]);
        assert_int_equal(heat.height, size[i][4]);
        assert_int_equal(heat.channels, 3);
        free_images(NULL);
    }
}

// What the bar beside the picture shows at a decade is what the picture shows of that
// error.
static void the_bar_has_the_colours_of_the_picture(void **state)
{
    (void)state;
    errors_init(30, 247 + 8, 0);
    // The bar is 247 dots high, from 4 to 250, so that a decade of six is 41.
    for (int y = 0; y < errors.height; y++)
        for (int x = 0; x < 30; x++)
            *sb_image_at(&errors, x, y) = (float)pow(10, -6 + (y - 4) / 41.0);
    draw(0, 0);
    assert_int_equal(heat.height, 255);
    for (int y = 4; y <= 250; y++)
        for (int c = 0; c < 3; c++)
            check_close((double)sb_image_at(&heat, 30 + 6, y)[c],
                        (double)picture_at(10, y)[c], 1e-5);
    for (int y = 0; y < 255; y++) { // ticks at the decades and nowhere else
        const bool decade = (y - 4) % 41 == 0;
        check_close((double)sb_image_at(&heat, 30 + 12, y)[1], decade, 0);
    }
}

// ---- reading the numbers ----

static const char *const glyphs_1e6[7] = {
    "  #                 ## ", //
    " ##                #   ", //
    "  #    ###        #    ", //
    "  #   #   #  ###  #### ", //
    "  #   #####       #   #", //
    "  #   #           #   #", //
    " ###   ###         ### ", //
};

// Whether the dots of the text stand at (left, bottom), counted in dots of `zoom` pixels.
static bool reads(const struct sb_image *image, const char *const rows[7], int left,
                  int bottom, int zoom)
{
    const int length = (int)strlen(rows[0]);
    for (int row = 0; row < 7; row++)
        for (int column = 0; column < length; column++)
            for (int i = 0; i < zoom * zoom; i++) {
                const int x = left + column * zoom + i % zoom;
                const int y = bottom + (6 - row) * zoom + i / zoom;
                const float wanted = rows[row][column] == '#';
                if (sb_image_at(image, x, y)[0] != wanted)
                    return false;
            }
    return true;
}

static const char *const glyph_1[7] = {
    // and nothing behind it
    "  #        ", //
    " ##        ", //
    "  #        ", //
    "  #        ", //
    "  #        ", //
    "  #        ", //
    " ###       ", //
};

static void the_ends_of_the_scale_are_written_beside_it(void **state)
{
    (void)state;
    errors_init(60, 100, 0);
    draw(0, 0);
    assert_true(reads(&heat, glyphs_1e6, 60 + 17, 1, 1));
    assert_true(reads(&heat, glyph_1, 60 + 17, 95 - 3, 1));
    sb_image_free(&heat);
    draw(1e-5, 0);
    assert_false(reads(&heat, glyphs_1e6, 60 + 17, 1, 1));
    assert_true(reads(&heat, glyph_1, 60 + 17, 95 - 3, 1));
    sb_image_free(&heat);
    draw(1e-6, 1e-2);
    assert_true(reads(&heat, glyphs_1e6, 60 + 17, 1, 1));
    assert_false(reads(&heat, glyph_1, 60 + 17, 95 - 3, 1));
}

static bool is_lit(int left, int y)
{
    bool lit = false;
    for (int x = left; x < heat.width; x++)
        lit = lit || sb_image_at(&heat, x, y)[0] > 0;
    return lit;
}

// Rows of dots between numbers are black, whatever the ends are.
static void numbers_never_run_into_each_other_or_out_of_the_scale(void **state)
{
    (void)state;
    errors_init(10, 80, 0);
    for (int low = -60; low < 20; low += 7)
        for (int tenths = 1; tenths < 300; tenths += 13) {
            draw(pow(10, low / 4.0), pow(10, low / 4.0 + tenths / 10.0));
            int numbers = 0, run = 0;
            for (int y = 0; y < heat.height; y++) {
                run = is_lit(10 + 17, y) ? run + 1 : 0;
                numbers += run == 1;
                assert_true(run <= 7);       // the digits are 7 dots high
                for (int u = 0; u < 10; u++) // what runs out comes in again on the left
                    assert_true(picture_at(u, y)[1] < 0.01f);
            }
            assert_true(numbers >= 2);
            sb_image_free(&heat);
        }
}

static void a_sheet_shrinks_the_map_to_whole_dots(void **state)
{
    (void)state;
    static const int size[][2] = {{204, 256}, {256, 256}, {640, 480}, {300, 1000}};
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        errors_init(size[i][0], size[i][1], 1e-3f);
        draw(0, 0);
        const int dot = sb_heat_dot(size[i][0], size[i][1]);
        sb_image_shrink(&heat, 256, &other);
        assert_int_equal(other.width, heat.width / dot);
        assert_int_equal(other.height, heat.height / dot);
        assert_true(reads(&heat, glyphs_1e6, heat.width - 35 * dot, dot, dot));
        assert_true(reads(&other, glyphs_1e6, other.width - 35, 1, 1));
        free_images(NULL);
    }
}

static void maps_of_different_sizes_go_on_one_sheet(void **state)
{
    (void)state;
    struct sb_image picture[2];
    errors_init(5, 5, 1);
    draw(0, 0);
    picture[0] = heat;
    heat = (struct sb_image){0};
    sb_image_free(&errors);
    errors_init(120, 90, 1);
    draw(0, 0);
    picture[1] = heat;
    heat = (struct sb_image){0};
    sb_sheet_make(picture, 2, &other);
    assert_int_equal(other.height, 90);
    assert_int_equal(other.width, 2 * 172 + 1);
    // Each at the top left of its cell, in the colour of the error 1.
    for (int i = 0; i < 2; i++)
        check_pixel(sb_image_at(&other, i * 173, 89), sb_srgb_decode(0.993248),
                    sb_srgb_decode(0.906157), sb_srgb_decode(0.143936));
    sb_image_free(&picture[0]);
    sb_image_free(&picture[1]);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_images)
    const struct CMUnitTest tests[] = {
        TEST(the_transfer_function_is_undone_by_its_inverse),
        TEST(lightness_rises_with_every_step_of_the_error),
        TEST(the_ends_have_the_colours_of_viridis_and_keep_them_beyond),
        TEST(the_error_is_the_largest_of_the_channels),
        TEST(what_does_not_count_is_grey_and_what_is_not_finite_magenta),
        TEST(the_size_is_the_picture_and_its_scale_in_whole_dots),
        TEST(the_bar_has_the_colours_of_the_picture),
        TEST(the_ends_of_the_scale_are_written_beside_it),
        TEST(numbers_never_run_into_each_other_or_out_of_the_scale),
        TEST(a_sheet_shrinks_the_map_to_whole_dots),
        TEST(maps_of_different_sizes_go_on_one_sheet),
    };
    return run_tests(tests);
}
