#include "gl/program.h"
#include "gl/target.h"
#include "gl_test.h"
#include "test.h"

static struct gl_test test;

enum { WIDTH = 7, HEIGHT = 5 }; // odd: rows of bytes that no alignment divides

// The whole target in one colour, then its pixel (2, 1) in another.
static void paint(const struct sb_target *target, const float *all, const float *one)
{
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glClearBufferfv(GL_COLOR, 0, all);
    glEnable(GL_SCISSOR_TEST);
    glScissor(2, 1, 1, 1);
    glClearBufferfv(GL_COLOR, 0, one);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

// Values that the format holds exactly are read back bit for bit, bottom row first.
static void check_painted(enum sb_gl_format format, const float *all, const float *one)
{
    struct sb_target target;
    struct sb_image image;
    struct sb_error err = {0};
    const struct sb_target_params params = {WIDTH, HEIGHT, 1, format};
    if (!sb_target_make(&target, &test.caps, &params, &err))
        fail_msg("%s", err.text);
    paint(&target, all, one);
    if (!sb_target_read(&target, &image, &err))
        fail_msg("%s", err.text);
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    assert_int_equal(image.channels, 4);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_memory_equal(sb_image_at(&image, x, y), x == 2 && y == 1 ? one : all,
                                4 * sizeof(float));
    sb_image_free(&image);
    sb_target_free(&target);
    assert_null(sb_gl_error());
}

static void rgba8_reads_back_exactly(void **state)
{
    (void)state;
    const float all[4] = {0, 1.0f / 255.0f, 0.2f, 1}, one[4] = {128.0f / 255.0f, 1, 0, 0};
    check_painted(SB_GL_RGBA8, all, one);
}

static void rgba16f_reads_back_exactly(void **state)
{
    (void)state;
    const float all[4] = {-2, 65504, 0x1p-14f, 1.5f};
    const float one[4] = {1 + 0x1p-10f, -0.25f, 0, 4096};
    if (!test.caps.colour_half)
        skip();
    check_painted(SB_GL_RGBA16F, all, one);
}

static void rgba32f_reads_back_exactly(void **state)
{
    (void)state;
    const float all[4] = {-1e30f, 0.1f, 16777217.0f, 3.0e-30f};
    const float one[4] = {1 + 0x1p-23f, -7, INFINITY, 1e10f};
    if (!test.caps.colour_float)
        skip();
    check_painted(SB_GL_RGBA32F, all, one);
}

static void r32ui_reads_back_one_exact_channel(void **state)
{
    (void)state;
    const GLuint value[4] = {16777215, 1, 2, 3};
    const struct sb_target_params params = {WIDTH, HEIGHT, 1, SB_GL_R32UI};
    struct sb_target target;
    struct sb_image image;
    struct sb_error err = {0};
    assert_true(sb_target_make(&target, &test.caps, &params, &err));
    glClearBufferuiv(GL_COLOR, 0, value);
    assert_true(sb_target_read(&target, &image, &err));
    assert_int_equal(image.channels, 1);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        check_close(image.data[i], 16777215, 0);
    sb_image_free(&image);
    sb_target_free(&target);
}

static int reads;
static PFNGLREADPIXELSPROC read_pixels;

static void GLAD_API_PTR counting_read(GLint x, GLint y, GLsizei width, GLsizei height,
                                       GLenum format, GLenum type, void *pixels)
{
    reads++;
    read_pixels(x, y, width, height, format, type, pixels);
}

static void a_drain_reads_one_pixel_of_every_format(void **state)
{
    (void)state;
    static const enum sb_gl_format formats[] = {SB_GL_RGBA8, SB_GL_RGBA16F, SB_GL_RGBA32F,
                                                SB_GL_R32UI};
    read_pixels = glad_glReadPixels;
    glad_glReadPixels = counting_read;
    for (int i = 0; i < 4; i++) {
        struct sb_target target;
        const struct sb_target_params params = {4, 4, 1, formats[i]};
        const bool made = sb_target_make(&target, &test.caps, &params, NULL);
        reads = 0;
        sb_gl_drain();
        assert_int_equal(reads, made);
        assert_null(sb_gl_error());
        sb_target_free(&target);
    }
    reads = 0;
    sb_gl_drain(); // nothing is bound
    assert_int_equal(reads, 0);
    assert_null(sb_gl_error());
    glad_glReadPixels = read_pixels;
}

static void a_depth_attachment_is_there(void **state)
{
    (void)state;
    const struct sb_target_params params = {4, 4, 1, SB_GL_RGBA8};
    struct sb_target target;
    struct sb_error err = {0};
    GLint bits = 0;
    assert_true(sb_target_make(&target, &test.caps, &params, &err));
    glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                          GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, &bits);
    assert_true(bits >= 24);
    sb_target_free(&target);
}

// --- several samples a pixel -----------------------------------------------------------

// Half of the samples of every pixel in another colour than the rest.
static void paint_half(const struct sb_target *target, const float *all,
                       const float *half)
{
    const char *head =
        test.caps.gles ? "#version 300 es\nprecision highp float;\n" : "#version 330\n";
    char vertex[512], fragment[512];
    struct sb_gl_program program;
    GLuint vertex_array;
    snprintf(vertex, sizeof vertex,
             "%svoid main() {\n"
             "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,\n"
             "                       gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
             "}\n",
             head);
    snprintf(fragment, sizeof fragment,
             "%suniform vec4 u_colour;\n"
             "out vec4 o_color;\n"
             "void main() { o_color = u_colour; }\n",
             head);
    const struct sb_program source = {.vertex = vertex, .fragment = fragment};
    assert_true(sb_gl_program_make(&source, &program));
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glClearBufferfv(GL_COLOR, 0, all);
    glEnable(GL_SAMPLE_COVERAGE);
    glSampleCoverage(0.5f, GL_FALSE);
    glUseProgram(program.name);
    glUniform4fv(glGetUniformLocation(program.name, "u_colour"), 1, half);
    glViewport(0, 0, target->width, target->height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_DITHER);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SAMPLE_COVERAGE);
    glUseProgram(0);
    sb_gl_program_free(&program);
    glDeleteVertexArrays(1, &vertex_array);
}

static void samples_are_averaged_into_what_is_read(void **state)
{
    (void)state;
    static const enum sb_gl_format formats[] = {SB_GL_RGBA8, SB_GL_RGBA16F,
                                                SB_GL_RGBA32F};
    const float all[4] = {0, 1, 0.2f, 1}, half[4] = {1, 0, 0.2f, 1};
    if (test.caps.samples < 4)
        skip();
    for (int i = 0; i < 3; i++) {
        const struct sb_target_params params = {WIDTH, HEIGHT, 4, formats[i]};
        struct sb_target target;
        struct sb_image image;
        struct sb_error err = {0};
        if (!sb_target_make(&target, &test.caps, &params, &err)) {
            assert_int_equal(err.status, SB_OVER_LIMIT);
            continue; // such floats need not be to be had with samples
        }
        paint_half(&target, all, half);
        assert_int_equal(sb_target_resolve(&target), 3);
        reads = 0;
        read_pixels = glad_glReadPixels;
        glad_glReadPixels = counting_read;
        sb_gl_drain();
        glad_glReadPixels = read_pixels;
        assert_int_equal(reads, 1);
        assert_null(sb_gl_error());
        assert_true(sb_target_read(&target, &image, &err));
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                for (int c = 0; c < 4; c++)
                    check_close(sb_image_at(&image, x, y)[c], (all[c] + half[c]) / 2,
                                0.003);
        sb_image_free(&image);
        sb_target_free(&target);
        assert_null(sb_gl_error());
    }
}

static void a_target_of_one_sample_is_read_as_it_was_drawn(void **state)
{
    (void)state;
    const struct sb_target_params params = {WIDTH, HEIGHT, 1, SB_GL_RGBA8};
    struct sb_target target;
    assert_true(sb_target_make(&target, &test.caps, &params, NULL));
    assert_int_equal(target.resolved, 0);
    assert_int_equal(sb_target_resolve(&target), 0);
    sb_target_free(&target);
}

// Every count either is what is made of it, or is refused with the limit.
static void a_sample_count_is_kept_to_or_refused(void **state)
{
    (void)state;
    char limit[32];
    snprintf(limit, sizeof limit, "%lld", (long long)test.caps.samples);
    for (int samples = 2; samples <= 33; samples++) {
        const struct sb_target_params params = {4, 4, samples, SB_GL_RGBA8};
        struct sb_target target;
        struct sb_error err = {0};
        GLint made = 0;
        if (sb_target_make(&target, &test.caps, &params, &err)) {
            glGetIntegerv(GL_SAMPLES, &made);
            assert_int_equal(made, samples);
            assert_true(samples <= test.caps.samples);
        } else {
            assert_int_equal(err.status, SB_OVER_LIMIT);
            check_contains(err.text, limit);
            assert_int_equal(target.framebuffer, 0);
        }
        sb_target_free(&target);
        assert_null(sb_gl_error());
    }
}

static void check_refused(const struct sb_caps *caps, int width, int height,
                          enum sb_gl_format format, const char *word)
{
    const struct sb_target_params params = {width, height, 1, format};
    struct sb_target target;
    struct sb_error err = {0};
    assert_false(sb_target_make(&target, caps, &params, &err));
    assert_int_equal(err.status, SB_OVER_LIMIT);
    check_contains(err.text, word);
    assert_int_equal(target.framebuffer, 0);
    assert_null(sb_gl_error());
}

static void what_the_driver_cannot_have_is_refused_with_the_limit(void **state)
{
    (void)state;
    struct sb_caps caps = test.caps;
    char limit[32];
    snprintf(limit, sizeof limit, "%lld", (long long)caps.renderbuffer_size);
    check_refused(&caps, (int)caps.renderbuffer_size + 1, 1, SB_GL_RGBA8, limit);
    check_refused(&caps, 1, (int)caps.renderbuffer_size + 1, SB_GL_RGBA8, limit);
    check_refused(&caps, 0, 1, SB_GL_RGBA8, limit);
    caps.colour_float = caps.colour_half = 0;
    check_refused(&caps, 1, 1, SB_GL_RGBA32F, "rgba32f");
    check_refused(&caps, 1, 1, SB_GL_RGBA16F, "rgba16f");
    // A limit that the driver does not keep: its own refusal is passed on.
    caps.renderbuffer_size = 1 << 24;
    check_refused(&caps, 1 << 23, 1, SB_GL_RGBA8, "refused");
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(rgba8_reads_back_exactly),
        cmocka_unit_test(rgba16f_reads_back_exactly),
        cmocka_unit_test(rgba32f_reads_back_exactly),
        cmocka_unit_test(r32ui_reads_back_one_exact_channel),
        cmocka_unit_test(a_drain_reads_one_pixel_of_every_format),
        cmocka_unit_test(a_depth_attachment_is_there),
        cmocka_unit_test(samples_are_averaged_into_what_is_read),
        cmocka_unit_test(a_target_of_one_sample_is_read_as_it_was_drawn),
        cmocka_unit_test(a_sample_count_is_kept_to_or_refused),
        cmocka_unit_test(what_the_driver_cannot_have_is_refused_with_the_limit),
    };
    gl_test_open(&test);
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
