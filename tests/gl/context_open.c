#include <limits.h>

#include "gl_test.h"
#include "test.h"

static void *open_this(struct sb_context_options options, struct sb_error *err)
{
    const struct sb_context_fns *fns = NULL;
    void *self = sb_context_open(gl_test_context(), &options, &fns, err);
    if (self)
        fns->close(self);
    return self;
}

static void a_context_opens_again_after_it_was_closed(void **state)
{
    (void)state;
    char renderer[2][160];
    for (int i = 0; i < 2; i++) {
        struct gl_test test;
        gl_test_open(&test);
        strcpy(renderer[i], test.caps.renderer);
        if (test.fns->present)
            test.fns->present(test.context);
        gl_test_close(&test);
    }
    assert_string_equal(renderer[0], renderer[1]);
}

// "4.5 (Core Profile) Mesa" or "OpenGL ES GLSL ES 3.20": the first number, times 100.
static int hundred_times(const char *version)
{
    double number = 0;
    sscanf(version + strcspn(version, "0123456789"), "%lf", &number);
    return (int)lround(100 * number);
}

static void caps_are_at_least_what_the_version_guarantees(void **state)
{
    (void)state;
    struct gl_test test;
    gl_test_open(&test);
    const struct sb_caps *caps = &test.caps;
    assert_true(caps->vendor[0] && caps->renderer[0] && caps->version[0]);
    assert_int_equal(caps->gles, gl_test_gles());
    assert_in_range(caps->api_version, caps->gles ? 300 : 330, 999);
    assert_in_range(caps->glsl, caps->gles ? 300 : 330, 999);
    assert_int_equal(caps->api_version, hundred_times(caps->version));
    assert_int_equal(caps->glsl, hundred_times(caps->glsl_version));
    // OpenGL 3.3 core, tables 6.40 to 6.50, and OpenGL ES 3.0, tables 6.28 to 6.34: the
    // smaller minimum of the two.
    assert_true(caps->vertex_uniform_components >= 1024);
    assert_true(caps->fragment_uniform_components >= 896);
    assert_true(caps->uniform_block_size >= 16384);
    assert_true(caps->varying_components >= 60);
    assert_true(caps->texture_units >= 16);
    assert_true(caps->texture_size >= 1024);
    assert_true(caps->renderbuffer_size >= 1024);
    assert_true(caps->samples >= 4);
    assert_in_range(caps->elapsed_bits, 0, 64);
    assert_in_range(caps->timestamp_bits, 0, 64);
    if (!caps->gles) {
        assert_true(caps->colour_float && caps->colour_half && caps->geometry_shader);
        assert_true(caps->samples_passed);
        assert_false(caps->disjoint);
    } else {
        assert_false(caps->samples_passed);
        assert_true(caps->disjoint || caps->elapsed_bits == 0);
    }
    gl_test_close(&test);
}

static void gl_errors_are_words_and_are_cleared(void **state)
{
    (void)state;
    struct gl_test test;
    gl_test_open(&test);
    assert_null(sb_gl_error());
    glEnable(0xdead);
    glViewport(0, 0, -1, -1);
    assert_string_equal(sb_gl_error(), "GL_INVALID_ENUM");
    assert_null(sb_gl_error());
    gl_test_close(&test);
}

// --- errors that no driver here gives: glad's pointers are variables ---

static int errors_left;

static GLenum GLAD_API_PTR fake_error(void)
{
    return errors_left-- > 0 ? GL_OUT_OF_MEMORY : GL_NO_ERROR;
}

static void every_flag_of_a_distributed_driver_is_cleared(void **state)
{
    (void)state;
    struct gl_test test;
    gl_test_open(&test);
    const PFNGLGETERRORPROC get_error = glad_glGetError;
    glad_glGetError = fake_error;
    errors_left = 3;
    assert_string_equal(sb_gl_error(), "GL_OUT_OF_MEMORY");
    assert_null(sb_gl_error());
    errors_left = INT_MAX; // a lost context may report for ever
    assert_string_equal(sb_gl_error(), "GL_OUT_OF_MEMORY");
    glad_glGetError = get_error;
    gl_test_close(&test);
}

static void auto_opens_what_opens_by_name(void **state)
{
    (void)state;
    const struct sb_context_options options = {.gles = gl_test_gles(), .device = -1};
    const struct sb_context_fns *fns = NULL;
    struct sb_error err = {0};
    void *self = sb_context_open("auto", &options, &fns, &err);
    assert_non_null(self);
    fns->close(self);
    bool listed = false;
    for (int i = 0; sb_contexts[i]; i++)
        listed |= sb_contexts[i] == fns;
    assert_true(listed);
}

static void an_unknown_context_is_refused_with_the_valid_names(void **state)
{
    (void)state;
    const struct sb_context_options options = {.device = -1};
    const struct sb_context_fns *fns = NULL;
    struct sb_error err = {0};
    assert_null(sb_context_open("elg", &options, &fns, &err));
    assert_int_equal(err.status, SB_USAGE);
    check_contains(err.text, "\"elg\"");
    check_contains(err.text, "auto");
    for (int i = 0; sb_contexts[i]; i++)
        check_contains(err.text, sb_contexts[i]->name);
}

static void a_device_that_is_not_there_is_refused_and_nothing_else_opens(void **state)
{
    (void)state;
    struct sb_error err = {0};
    assert_null(open_this(
        (struct sb_context_options){.gles = gl_test_gles(), .device = 1000}, &err));
    assert_int_equal(err.status, SB_NO_GL);
    check_contains(err.text, "device");
    if (strcmp(gl_test_context(), "egl") == 0)
        check_contains(err.text, "there is no device 1000");
}

static void osmesa_says_that_it_has_no_opengl_es(void **state)
{
    (void)state;
    const struct sb_context_options options = {.gles = true, .device = -1};
    const struct sb_context_fns *fns = NULL;
    struct sb_error err = {0};
    assert_null(sb_context_open("osmesa", &options, &fns, &err));
    assert_int_equal(err.status, SB_NO_GL);
    check_contains(err.text, "OpenGL ES");
}

static void without_a_display_glfw_says_so(void **state)
{
    (void)state;
    const struct sb_context_options options = {.device = -1};
    const struct sb_context_fns *fns = NULL;
    struct sb_error err = {0};
    if (getenv("DISPLAY") || getenv("WAYLAND_DISPLAY"))
        skip();
    assert_null(sb_context_open("glfw", &options, &fns, &err));
    assert_int_equal(err.status, SB_NO_GL);
    check_contains(err.text, "glfw");
}

static void when_nothing_opens_auto_tells_every_reason(void **state)
{
    (void)state;
    // No context takes this device, whatever libraries are there.
    const struct sb_context_options options = {.device = 1000};
    const struct sb_context_fns *fns = NULL;
    struct sb_error err = {0};
    assert_null(sb_context_open("auto", &options, &fns, &err));
    assert_int_equal(err.status, SB_NO_GL);
    for (int i = 0; sb_contexts[i]; i++)
        check_contains(err.text, sb_contexts[i]->name);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_context_opens_again_after_it_was_closed),
        cmocka_unit_test(caps_are_at_least_what_the_version_guarantees),
        cmocka_unit_test(gl_errors_are_words_and_are_cleared),
        cmocka_unit_test(every_flag_of_a_distributed_driver_is_cleared),
        cmocka_unit_test(auto_opens_what_opens_by_name),
        cmocka_unit_test(an_unknown_context_is_refused_with_the_valid_names),
        cmocka_unit_test(a_device_that_is_not_there_is_refused_and_nothing_else_opens),
        cmocka_unit_test(osmesa_says_that_it_has_no_opengl_es),
        cmocka_unit_test(without_a_display_glfw_says_so),
        cmocka_unit_test(when_nothing_opens_auto_tells_every_reason),
    };
    struct gl_test test;
    gl_test_open(&test);
    gl_test_close(&test);
    return run_tests(tests);
}
