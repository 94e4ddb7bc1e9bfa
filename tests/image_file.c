#include "test.h"

#include <unistd.h>

#include <png.h>

#include "base/file.h"
#include "image/colour.h"
#include "image/image.h"

static char folder[] = "/tmp/sb_image_XXXXXX";
static char path[64];

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/file", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder); // fails if a temporary file was left behind
}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void srgb_encoding_has_the_constants_of_the_standard(void **state)
{
    (void)state;
    check_close(sb_srgb_encode(0), 0, 0);
    check_close(sb_srgb_encode(1), 1, 1e-15);
    check_close(sb_srgb_encode(0.0031308), 12.92 * 0.0031308, 0);
    // The standard's rounded constants leave a step of 3e-8 there.
    check_close(sb_srgb_encode(nextafter(0.0031308, 1)), 12.92 * 0.0031308, 3e-8);
    check_close(sb_srgb_encode(0.18), 0.461356129500442, 1e-14);
    check_close(sb_srgb_encode(0.5), 0.735356983052449, 1e-14);
    for (int i = 0; i <= 255; i++) { // back through the decoding side of the standard
        const double code = i / 255.0;
        const double linear =
            code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
        check_close(sb_srgb_encode(linear), code, 3e-8);
    }
}

static void read_png(png_byte *rgb, int width, int height)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&png, path));
    assert_int_equal(png.format & PNG_FORMAT_FLAG_LINEAR, 0);
    assert_int_equal(png.width, width);
    assert_int_equal(png.height, height);
    png.format = PNG_FORMAT_RGB;
    assert_true(png_image_finish_read(&png, NULL, rgb, 0, NULL));
}

static void png_has_the_top_row_first_in_srgb(void **state)
{
    (void)state;
    const float pixels[2][3][4] = {
        {{0, 0.5f, 1, 0}, {-1, 2, INFINITY, 1}, {NAN, 1, 0, 1}},          // bottom
        {{0.18f, 0.002f, 0.2f, 1}, {-INFINITY, 0, 0, 1}, {1, 1, 1, NAN}}, // top
    };
    const png_byte expected[2][3][3] = {
        {{118, 7, 124}, {0, 0, 0}, {255, 255, 255}},
        {{0, 188, 255}, {0, 255, 255}, {255, 0, 255}},
    };
    struct sb_image image;
    struct sb_error err = {0};
    sb_image_init(&image, 3, 2, 4);
    memcpy(image.data, pixels, sizeof pixels);
    assert_true(sb_image_write_png(&image, path, &err));
    png_byte rgb[sizeof expected];
    read_png(rgb, 3, 2);
    assert_memory_equal(rgb, expected, sizeof expected);
    sb_image_free(&image);
}

static void png_of_one_channel_is_grey_and_of_two_has_no_blue(void **state)
{
    (void)state;
    struct sb_image image;
    struct sb_error err = {0};
    png_byte rgb[6];
    sb_image_init(&image, 2, 1, 1);
    image.data[0] = 0.5f;
    image.data[1] = NAN;
    assert_true(sb_image_write_png(&image, path, &err));
    read_png(rgb, 2, 1);
    const png_byte grey[] = {188, 188, 188, 255, 0, 255};
    assert_memory_equal(rgb, grey, sizeof grey);
    sb_image_free(&image);

    sb_image_init(&image, 1, 1, 2);
    image.data[0] = 0.5f;
    image.data[1] = 1;
    assert_true(sb_image_write_png(&image, path, &err));
    read_png(rgb, 1, 1);
    const png_byte two[] = {188, 255, 0};
    assert_memory_equal(rgb, two, sizeof two);
    sb_image_free(&image);
}

static void failures_to_write_name_the_path_and_the_cause(void **state)
{
    (void)state;
    struct sb_image image;
    struct sb_error err = {0};
    const char *nowhere = "/tmp/sb_no_such_folder/picture";
    sb_image_init(&image, 1, 1, 3);
    assert_false(sb_image_write_png(&image, nowhere, &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    check_contains(err.text, nowhere);
    check_contains(err.text, "No such file or directory");
    memset(&err, 0, sizeof err);
    assert_false(sb_image_write_pfm(&image, nowhere, &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    check_contains(err.text, "No such file or directory");
    sb_image_free(&image);

    sb_image_init(&image, 1000001, 1, 1); // over libpng's own limit
    assert_false(sb_image_write_png(&image, path, &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    check_contains(err.text, path);
    check_contains(err.text, "1000001 x 1 pixels: Invalid IHDR data");
    sb_image_free(&image);
}

static const uint32_t patterns[] = {
    0x00000000, 0x80000000, 0x00000001, 0x807fffff, 0x7f800000, 0xff800000,
    0x7fc12345, 0xffd54321, 0x7f812345, 0x3f800000, 0x0d0a1a00, 0xbeefcafe,
};

static void pfm_round_trip_keeps_every_bit(void **state)
{
    (void)state;
    for (int channels = 1; channels <= 3; channels += 2) {
        struct sb_image image, read;
        struct sb_error err = {0};
        sb_image_init(&image, 4, 3 / channels, channels);
        memcpy(image.data, patterns, sizeof patterns);
        assert_true(sb_image_write_pfm(&image, path, &err));
        assert_true(sb_image_read_pfm(&read, path, &err));
        assert_int_equal(read.width, 4);
        assert_int_equal(read.height, 3 / channels);
        assert_int_equal(read.channels, channels);
        assert_memory_equal(read.data, patterns, sizeof patterns);
        sb_image_free(&image);
        sb_image_free(&read);
    }
}

static void pfm_is_little_endian_with_the_bottom_row_first(void **state)
{
    (void)state;
    struct sb_image image;
    struct sb_error err = {0};
    sb_image_init(&image, 1, 2, 4);
    const float pixels[] = {1, 2, -2, 99, 0.5f, 0, 0, 99};
    memcpy(image.data, pixels, sizeof pixels);
    assert_true(sb_image_write_pfm(&image, path, &err));
    sb_image_free(&image);
    static const char expected[] = "PF\n1 2\n-1.0\n"
                                   "\0\0\x80\x3f\0\0\0\x40\0\0\0\xc0"
                                   "\0\0\0\x3f\0\0\0\0\0\0\0\0";
    struct sb_arena arena = {0};
    size_t size;
    const char *found = sb_file_read(&arena, path, 1000, &size, &err);
    assert_int_equal(size, sizeof expected - 1);
    assert_memory_equal(found, expected, size);
    sb_arena_free(&arena);
}

static void pfm_of_two_channels_is_refused(void **state)
{
    (void)state;
    struct sb_image image;
    struct sb_error err = {0};
    sb_image_init(&image, 1, 1, 2);
    assert_false(sb_image_write_pfm(&image, path, &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    check_contains(err.text, "1 or 3 channels");
    sb_image_free(&image);
}

static void pfm_of_the_other_byte_order_is_read(void **state)
{
    (void)state;
    static const char big[] = "Pf 2 1 1.0 \x3f\x80\0\0\x7f\xc1\x23\x45";
    struct sb_image image;
    struct sb_error err = {0};
    assert_true(sb_file_replace(path, big, sizeof big - 1, &err));
    assert_true(sb_image_read_pfm(&image, path, &err));
    const float expected[] = {1, float_of(0x7fc12345)};
    assert_memory_equal(image.data, expected, sizeof expected);
    sb_image_free(&image);
}

static void broken_pfm_files_are_refused_with_a_reason(void **state)
{
    (void)state;
    static const struct {
        const char *text, *reason;
    } broken[] = {
        {"", "starts with PF or Pf"},
        {"P6\n1 1\n-1.0\n....", "starts with PF or Pf"},
        {"PF", "starts with PF or Pf"},
        {"Pf\n", "width and height"},
        {"Pf\n0 1\n-1.0\n", "width and height"},
        {"Pf\n-1 1\n-1.0\n", "width and height"},
        {"Pf\n1.5 1\n-1.0\n....", "width and height"},
        {"Pf\n1 70000\n-1.0\n....", "width and height"},
        {"Pf\n99999999999999999999999999999999999999 1\n-1.0\n", "width and height"},
        {"Pf\n1 1\n2.0\n....", "scale"},
        {"Pf\n1 1\nnan\n....", "scale"},
        {"Pf\n1 1\n-1.0", "scale"},
        {"Pf\n1 1\n-1.0\n...", "3 bytes of pixels; 1 x 1 of 1 channels are 4"},
        {"Pf\n1 1\n-1.0\n.....", "5 bytes of pixels"},
        {"PF\n65536 65536\n-1.0\n....", "4 bytes of pixels"},
    };
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        struct sb_image image = {1, 1, 1, NULL};
        struct sb_error err = {0};
        assert_true(sb_file_replace(path, broken[i].text, strlen(broken[i].text), &err));
        assert_false(sb_image_read_pfm(&image, path, &err));
        assert_int_equal(err.status, SB_BAD_INPUT);
        check_contains(err.text, path);
        check_contains(err.text, broken[i].reason);
        assert_true(!image.data && image.width == 0);
    }
    struct sb_image image;
    struct sb_error err = {0};
    assert_false(sb_image_read_pfm(&image, "/tmp/sb_no_such_file", &err));
    check_contains(err.text, "No such file or directory");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(srgb_encoding_has_the_constants_of_the_standard),
        cmocka_unit_test(png_has_the_top_row_first_in_srgb),
        cmocka_unit_test(png_of_one_channel_is_grey_and_of_two_has_no_blue),
        cmocka_unit_test(failures_to_write_name_the_path_and_the_cause),
        cmocka_unit_test(pfm_round_trip_keeps_every_bit),
        cmocka_unit_test(pfm_is_little_endian_with_the_bottom_row_first),
        cmocka_unit_test(pfm_of_two_channels_is_refused),
        cmocka_unit_test(pfm_of_the_other_byte_order_is_read),
        cmocka_unit_test(broken_pfm_files_are_refused_with_a_reason),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
