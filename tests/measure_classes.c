// Equivalence classes on the null runner, whose pictures are scripted.
#include "test.h"

#include "base/log.h"
#include "job/null.h"
#include "measure/classes.h"

struct fixture {
    struct sb_suite suite;
    struct sb_driver driver;
    struct sb_classes classes;
    struct sb_text log;
    struct sb_error err;
};

static void verify(struct fixture *f, const char *set,
                   const struct sb_null_script *script, const char *const *sweeps,
                   int count)
{
    struct sb_assignment set_one = {"form", set, "--set"}, sweep[4];
    for (int i = 0; i < count; i++)
        sweep[i] = (struct sb_assignment){sweeps[2 * i], sweeps[2 * i + 1], "--cross"};
    const struct sb_suite_params suite = {
        .set = &set_one, .set_count = 1, .cross = sweep, .cross_count = count};
    const struct sb_driver_params driver = {.runner = &sb_runner_null,
                                            .context = {.context = "null"}};
    *f = (struct fixture){0};
    sb_log_set_level(SB_LOG_QUIET);
    if (!sb_suite_load(&suite, &f->suite, &f->err) ||
        !sb_driver_connect(&driver, &f->driver, &f->err))
        fail_msg("%s", f->err.text);
    *sb_null_script(f->driver.runner) = *script;
    sb_null_script(f->driver.runner)->log = &f->log;
    const struct sb_classes_params params = {
        .suite = &f->suite, .driver = &f->driver, .data_dir = SB_SOURCE_DIR};
    sb_classes_verify(&params, &f->classes);
}

#define SWEEPS(...)                                                                      \
    (const char *const[]){__VA_ARGS__},                                                  \
        (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *)) / 2

static void end(struct fixture *f)
{
    sb_classes_free(&f->classes);
    sb_driver_close(&f->driver);
    sb_suite_free(&f->suite);
    sb_text_free(&f->log);
}

// Models have pictures of their own; loop=dynamic is off by what `user` says.
static float colour_of_model(void *user, const struct sb_job *job,
                             const struct sb_image_request *request)
{
    (void)request;
    const float off =
        job->variant.value[SB_AXIS_LOOP] == SB_LOOP_DYNAMIC ? *(const float *)user : 0;
    return 0.25f + 0.125f * (float)job->variant.value[SB_AXIS_MODEL] + off;
}

static void variants_are_compared_within_their_class_only(void **state)
{
    (void)state;
    struct fixture f;
    float off = 0x1p-20f;
    verify(&f, "robust",
           &(struct sb_null_script){.colour = colour_of_model, .user = &off},
           SWEEPS("loop", "constant,unrolled,dynamic", "model", "lambert,blinn"));
    assert_int_equal(f.classes.exit_code, 0);
    assert_int_equal(f.classes.count, 2);
    assert_int_equal(f.classes.compared, 4);
    for (int c = 0; c < 2; c++) {
        const struct sb_class *class = &f.classes.row[c];
        assert_int_equal(class->status, SB_OK);
        assert_int_equal(class->members, 3);
        assert_int_equal(class->drawn, 3);
        assert_true(class->exact);
        check_close(class->spread, 0x1p-20, 0);
        struct sb_text name = {0};
        sb_class_name(&f.suite, &f.suite.entry[class->first], &name);
        assert_string_equal(name.data, c ? "model=blinn" : "model=lambert");
        sb_text_free(&name);
    }
    end(&f);
}

static void a_broken_class_names_both_variants_the_pixel_and_both_values(void **state)
{
    (void)state;
    struct fixture f;
    float off = 0.25f;
    verify(&f, "robust",
           &(struct sb_null_script){.colour = colour_of_model, .user = &off},
           SWEEPS("loop", "constant,dynamic,unrolled"));
    assert_int_equal(f.classes.exit_code, 3);
    assert_int_equal(f.classes.row[0].status, SB_CLASS_BROKEN);
    check_close(f.classes.row[0].spread, 0.25, 0);
    assert_int_equal(f.classes.member[0].status, SB_OK);
    assert_int_equal(f.classes.member[1].status, SB_CLASS_BROKEN);
    assert_int_equal(f.classes.member[2].status, SB_OK);
    check_contains(
        f.classes.member[1].note,
        "form=robust,loop=dynamic differs from form=robust,loop=constant by "
        "0.25 at pixel (0, 0) of 64 x 64, and should not: red is 0.75, not 0.5");
    end(&f);
}

static void the_bound_is_a_ten_thousandth(void **state)
{
    (void)state;
    struct fixture f;
    for (int i = 0; i < 2; i++) {
        float off = i ? 0.000101f : 0.000099f;
        verify(&f, "robust",
               &(struct sb_null_script){.colour = colour_of_model, .user = &off},
               SWEEPS("loop", "constant,dynamic"));
        assert_int_equal(f.classes.exit_code, i ? 3 : 0);
        end(&f);
    }
}

static void where_rounding_may_differ_the_difference_is_told_and_no_failure(void **state)
{
    (void)state;
    struct fixture f;
    float off = 0.25f;
    verify(&f, "naive", &(struct sb_null_script){.colour = colour_of_model, .user = &off},
           SWEEPS("loop", "constant,dynamic"));
    assert_int_equal(f.classes.exit_code, 0);
    assert_false(f.classes.row[0].exact);
    check_close(f.classes.row[0].spread, 0.25, 0);
    end(&f);
}

static float colour_of_origin(void *user, const struct sb_job *job,
                              const struct sb_image_request *request)
{
    (void)user;
    (void)request;
    return job->variant.value[SB_AXIS_SPACE] == SB_SPACE_EYE ? 0.5f : 0.25f;
}

static void another_origin_may_take_filtered_textures_apart_and_nothing_else(void **state)
{
    (void)state;
    struct fixture f;
    verify(&f, "robust", &(struct sb_null_script){.colour = colour_of_origin},
           SWEEPS("space", "world,view,eye", "maps", "none,normal"));
    assert_int_equal(f.classes.count, 2);
    assert_int_equal(f.classes.row[0].status, SB_CLASS_BROKEN);
    assert_int_equal(f.classes.row[1].status, SB_OK);
    assert_true(f.classes.row[1].exact);
    check_close(f.classes.row[1].spread, 0.25, 0);
    end(&f);
}

// user: the status that loop=constant, the first, ends with.
static void fail_first(void *user, const struct sb_job *job, struct sb_prepared *prepared)
{
    if (job->variant.value[SB_AXIS_LOOP] == SB_LOOP_CONSTANT)
        sb_fail(&prepared->error, *(const enum sb_status *)user, "scripted");
}

static void what_a_driver_cannot_have_is_told_and_no_failure(void **state)
{
    (void)state;
    struct fixture f;
    enum sb_status status = SB_OVER_LIMIT;
    verify(&f, "robust", &(struct sb_null_script){.prepare = fail_first, .user = &status},
           SWEEPS("loop", "constant,dynamic,unrolled"));
    assert_int_equal(f.classes.exit_code, 0);
    assert_int_equal(f.classes.row[0].status, SB_OK);
    assert_int_equal(f.classes.row[0].first, 1); // the first that was drawn
    assert_int_equal(f.classes.row[0].members, 3);
    assert_int_equal(f.classes.row[0].drawn, 2);
    assert_int_equal(f.classes.member[0].status, SB_OVER_LIMIT);
    assert_string_equal(f.classes.member[0].note, "scripted");
    assert_int_equal(f.classes.compared, 1);
    end(&f);
}

static void what_does_not_compile_fails(void **state)
{
    (void)state;
    struct fixture f;
    enum sb_status status = SB_COMPILE_FAILED;
    verify(&f, "robust", &(struct sb_null_script){.prepare = fail_first, .user = &status},
           SWEEPS("loop", "constant,dynamic,unrolled"));
    assert_int_equal(f.classes.exit_code, 3);
    assert_int_equal(f.classes.row[0].status, SB_COMPILE_FAILED);
    end(&f);
}

static float black(void *user, const struct sb_job *job,
                   const struct sb_image_request *request)
{
    (void)user;
    (void)job;
    (void)request;
    return 0;
}

static void pictures_that_show_nothing_do_not_agree(void **state)
{
    (void)state;
    struct fixture f;
    verify(&f, "robust", &(struct sb_null_script){.colour = black},
           SWEEPS("loop", "constant,dynamic"));
    assert_int_equal(f.classes.exit_code, 3);
    assert_int_equal(f.classes.row[0].status, SB_BLANK);
    assert_int_equal(f.classes.compared, 0);
    end(&f);
}

static void binaries(void *user, const struct sb_job *job, struct sb_prepared *prepared)
{
    (void)user;
    // One of guard=mask is that of guard=branch; no class has one of the other's.
    prepared->binary_hash = job->variant.value[SB_AXIS_LOOP] == SB_LOOP_UNROLLED ? 9 : 5;
    if (job->variant.value[SB_AXIS_LOOP] == SB_LOOP_PADDED)
        prepared->binary_hash = 0;
}

static void equal_binaries_are_the_same_code(void **state)
{
    (void)state;
    struct fixture f;
    verify(&f, "robust", &(struct sb_null_script){.prepare = binaries},
           SWEEPS("model", "lambert,blinn", "loop", "constant,unrolled,dynamic,padded"));
    for (int i = 0; i < 8; i++)
        assert_int_equal(f.classes.member[i].same_code, i % 4 == 2 ? i - 2 : -1);
    end(&f);
}

static void jobs_are_released_before_the_next_is_prepared(void **state)
{
    (void)state;
    struct fixture f;
    verify(&f, "robust", &(struct sb_null_script){0},
           SWEEPS("loop", "constant,dynamic,unrolled"));
    int open = 0;
    for (const char *line = f.log.data; line && *line; line = strchr(line, '\n') + 1) {
        open += strncmp(line, "prepare", 7) == 0;
        open -= strncmp(line, "release", 7) == 0;
        assert_in_range(open, 0, 1);
    }
    assert_int_equal(open, 0);
    assert_null(strstr(f.log.data, "audit")); // nothing is timed
    assert_null(strstr(f.log.data, "round"));
    end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(variants_are_compared_within_their_class_only),
        cmocka_unit_test(a_broken_class_names_both_variants_the_pixel_and_both_values),
        cmocka_unit_test(the_bound_is_a_ten_thousandth),
        cmocka_unit_test(where_rounding_may_differ_the_difference_is_told_and_no_failure),
        cmocka_unit_test(
            another_origin_may_take_filtered_textures_apart_and_nothing_else),
        cmocka_unit_test(what_a_driver_cannot_have_is_told_and_no_failure),
        cmocka_unit_test(what_does_not_compile_fails),
        cmocka_unit_test(pictures_that_show_nothing_do_not_agree),
        cmocka_unit_test(equal_binaries_are_the_same_code),
        cmocka_unit_test(jobs_are_released_before_the_next_is_prepared),
    };
    return run_tests(tests);
}
