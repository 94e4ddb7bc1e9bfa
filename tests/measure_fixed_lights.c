// Lights that are constants of the program cannot be switched off: a twin of the variant, with
// its lights as uniforms, is drawn and checked in its stead.
#include "measure_fixture.h"

#define SETTINGS(...)                                                                    \
    (const char *const[]){__VA_ARGS__},                                                  \
        (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

static bool lights_are_fixed(const struct sb_job *job)
{
    return job->variant.value[SB_AXIS_STORAGE] == SB_STORAGE_CONSTANT ||
           job->variant.value[SB_AXIS_STORAGE] == SB_STORAGE_GLOBAL;
}

enum { LIGHTS = 4 };
static int dead_light;     // changes nothing; -1: none is dead
static float twin_is_off;  // added to the pictures of the twin
static int fixed_pictures; // with a light off, of a program that has no such thing

static float colour(void *user, const struct sb_job *job,
                    const struct sb_image_request *request)
{
    (void)user;
    float sum = 0.25f;
    const bool fixed = lights_are_fixed(job);
    fixed_pictures += fixed && request->off_count > 0;
    for (int i = 0; i < LIGHTS; i++) {
        const bool off =
            i >= request->off_first && i < request->off_first + request->off_count;
        if (i != dead_light && (fixed || !off))
            sum += 0.0625f;
    }
    return sum + (fixed ? 0 : twin_is_off);
}

static void no_uniforms(void *user, const struct sb_job *job,
                        struct sb_prepared *prepared)
{
    (void)user;
    if (!lights_are_fixed(job))
        sb_fail(&prepared->error, SB_OVER_LIMIT, "scripted: too many lights");
}

static void begin(struct fixture *f, struct sb_text *log, const char *storage)
{
    const struct sb_assignment sets[] = {{"point", "4", "--set"},
                                         {"storage", storage, "--set"}};
    dead_light = -1;
    twin_is_off = 0;
    fixed_pictures = 0;
    next_script.colour = colour;
    next_script.log = log;
    const struct sb_suite_params params = {.set = sets, .set_count = 2};
    fixture_begin_suite(f, &params, SETTINGS("first_look", "20", "rounds", "20"));
}

static void run_one(struct fixture *f)
{
    if (!fixture_run(f, false))
        fail_msg("%s", f->err.text);
}

static void a_twin_is_prepared_checked_and_released_before_anything_is_timed(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_text log = {0};
    begin(&f, &log, "constant");
    run_one(&f);
    assert_string_equal(f.result.row[0].status, "ok");
    check_close(f.result.row[0].class_spread, 0, 0);
    assert_int_equal(fixed_pictures, 0);
    const char *const order[] = {"prepare 1\n", "prepare 2147483649\n",
                                 "image 2147483649\n", "release 2147483649\n", "round"};
    const char *at = log.data;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        at = strstr(at, order[i]);
        if (!at)
            fail_msg("no %s in its place: %s", order[i], log.data);
    }
    // Two pictures to compare, and one more than there are lights to check them.
    int images = 0;
    for (at = log.data; (at = strstr(at, "image 2147483649\n")); at++)
        images++;
    assert_int_equal(images, 1 + LIGHTS + 1);
    fixture_end(&f);
    sb_text_free(&log);
}

static void a_program_with_uniforms_has_no_twin(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_text log = {0};
    begin(&f, &log, "uniform");
    run_one(&f);
    assert_null(strstr(log.data, "prepare 2"));
    fixture_end(&f);
    sb_text_free(&log);
}

static void a_dead_light_among_constants_is_found_and_named(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, NULL, "global");
    dead_light = 2;
    run_one(&f);
    assert_string_equal(f.result.row[0].status, "dead_light");
    check_contains(f.result.row[0].note, "point light 2 changes no pixel");
    fixture_end(&f);
}

static void constants_that_draw_something_else_than_uniforms_break_the_class(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, NULL, "constant");
    twin_is_off = 0.125f;
    run_one(&f);
    assert_string_equal(f.result.row[0].status, "class_broken");
    check_contains(f.result.row[0].note, "point=4,storage=constant differs "
                                         "from the same lights as uniforms by "
                                         "0.125 at pixel (0, 0)");
    check_close(f.result.row[0].class_spread, 0.125, 0);
    fixture_end(&f);
}

static void lights_that_fit_only_as_constants_are_noted_as_unchecked(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, NULL, "constant");
    next_script.prepare = no_uniforms;
    run_one(&f);
    assert_string_equal(f.result.row[0].status, "ok");
    check_contains(f.result.row[0].note, "were not checked: scripted: too many lights");
    fixture_end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            a_twin_is_prepared_checked_and_released_before_anything_is_timed),
        cmocka_unit_test(a_program_with_uniforms_has_no_twin),
        cmocka_unit_test(a_dead_light_among_constants_is_found_and_named),
        cmocka_unit_test(
            constants_that_draw_something_else_than_uniforms_break_the_class),
        cmocka_unit_test(lights_that_fit_only_as_constants_are_noted_as_unchecked),
    };
    return run_tests(tests);
}
