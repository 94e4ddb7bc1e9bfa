// What fails says so, and nothing is left behind.
#include "local_jobs.h"

// Prepares what must fail; a failed job leaves nothing behind, so its id is free again.
static void prepare_fails(const struct text_job *it, struct sb_prepared *prepared)
{
    struct sb_image image;
    struct sb_error err = {0};
    assert_false(fns->prepare(runner, &it->job, prepared));
    const struct sb_image_request request = {.job = it->job.id};
    assert_false(fns->image(runner, &request, &image, &err));
}

static void a_compile_error_comes_with_stage_and_log(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;

    job_init(&it, 1, "out vec4 o_color;\nvoid main() { o_color = vec4(nowhere); }\n");
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_COMPILE_FAILED);
    assert_int_equal(prepared.failed_program, 0);
    assert_int_equal(prepared.failed_stage, SB_STAGE_FRAG);
    check_contains(prepared.log, "nowhere");
    check_contains(prepared.error.text, "fragment");
    check_contains(prepared.error.text, "nowhere");
    free(prepared.log);
    job_free(&it);

    job_init(&it, 1, flat);
    sb_text_add(&it.vertex, "no glsl");
    it.program[0].vertex = it.vertex.data;
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_COMPILE_FAILED);
    assert_int_equal(prepared.failed_stage, SB_STAGE_VERT);
    free(prepared.log);
    job_free(&it);

    job_init(&it, 1,
             "in vec2 v_normal;\nout vec4 o_color;\n"
             "void main() { o_color = v_normal.xyxy; }\n");
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_COMPILE_FAILED);
    assert_int_equal(prepared.failed_stage, SB_STAGE_LINK);
    check_contains(prepared.log, "v_normal");
    free(prepared.log);
    job_free(&it);
}

static void an_error_of_another_program_names_its_role_and_place(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    job_init(&it, 1, flat);
    job_add_lamp(&it, "out vec4 o_color;\nvoid main() { o_color = vec4(nowhere); }\n");
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_COMPILE_FAILED);
    assert_int_equal(prepared.failed_program, 1);
    assert_int_equal(prepared.failed_stage, SB_STAGE_FRAG);
    check_contains(prepared.error.text, "\"lamp\"");
    check_contains(prepared.error.text, "fragment");
    check_contains(prepared.error.text, "nowhere");
    free(prepared.log);
    job_free(&it);

    job_init(&it, 1, flat);
    job_add_lamp(&it, lamp);
    it.program[1].geometry = "no glsl";
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_COMPILE_FAILED);
    assert_int_equal(prepared.failed_stage, SB_STAGE_GEOM);
    check_contains(prepared.error.text, "geometry");
    free(prepared.log);
    job_free(&it);
}

static void a_role_that_is_missing_unknown_or_given_twice_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *role;
        int count;
        const char *word;
    } wrong[] = {{"lamp", 1, "lamp"}, {"ghost", 2, "ghost"}, {"shade", 2, "shade"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct text_job it;
        struct sb_prepared prepared;
        job_init(&it, 1, flat);
        job_add_lamp(&it, lamp);
        it.program[1].role = wrong[i].role;
        it.job.program_count = wrong[i].count;
        prepare_fails(&it, &prepared);
        assert_int_equal(prepared.error.status, SB_BAD_INPUT);
        check_contains(prepared.error.text, wrong[i].word);
        job_free(&it);
    }
}

static void more_samples_than_the_driver_has_are_refused_with_its_limit(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    char limit[32];
    snprintf(limit, sizeof limit, "%lld", (long long)caps.samples);
    job_init(&it, 1, flat);
    sb_variant_put(&it.job.variant, SB_AXIS_SAMPLES, (double)caps.samples + 1);
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_OVER_LIMIT);
    check_contains(prepared.error.text, "samples");
    check_contains(prepared.error.text, limit);
    job_free(&it);
}

static void an_unknown_scene_fails_with_the_valid_names(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    job_init(&it, 1, flat);
    it.job.scene = "shpere";
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_BAD_INPUT);
    check_contains(prepared.error.text, "shpere");
    for (int i = 0; i < sb_scene_row_count; i++)
        check_contains(prepared.error.text, sb_scene_rows[i].name);
    job_free(&it);
}

static void a_target_over_the_limit_is_refused(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_image image;
    struct sb_error err = {0};
    job_init(&it, 1, flat);
    sb_variant_put(&it.job.variant, SB_AXIS_WIDTH, (double)caps.renderbuffer_size + 1);
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_OVER_LIMIT);

    sb_variant_put(&it.job.variant, SB_AXIS_WIDTH, SIZE);
    prepare(&it, &prepared);
    const struct sb_image_request request = {.job = 1,
                                             .width = (int)caps.renderbuffer_size + 1};
    assert_false(fns->image(runner, &request, &image, &err));
    assert_int_equal(err.status, SB_OVER_LIMIT);
    fns->release(runner, 1);
    job_free(&it);
}

static void a_job_without_a_program_or_with_an_id_in_use_is_refused(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    job_init(&it, 1, flat);
    it.program[0].role = "other";
    prepare_fails(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_BAD_INPUT);
    check_contains(prepared.error.text, "shade");

    it.program[0].role = "shade";
    prepare(&it, &prepared);
    assert_false(fns->prepare(runner, &it.job, &prepared));
    assert_int_equal(prepared.error.status, SB_INTERNAL);
    fns->release(runner, 1);
    job_free(&it);
}

static void a_released_job_fails_and_does_not_crash(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_image image;
    struct sb_sample sample;
    struct sb_error err = {0};
    job_init(&it, 1, flat);
    prepare(&it, &prepared);
    fns->release(runner, 1);
    fns->release(runner, 1);
    const struct sb_image_request request = {.job = 1};
    assert_false(fns->image(runner, &request, &image, &err));
    assert_int_equal(err.status, SB_INTERNAL);
    const struct sb_shot shot = {1, 1, 1, SB_PART_WHOLE};
    assert_false(fns->round(runner, &shot, 1, &sample, &err));
    job_free(&it);
}

static PFNGLDRAWELEMENTSPROC real_draw;

static void GLAD_API_PTR draw_with_error(GLenum mode, GLsizei count, GLenum type,
                                         const void *indices)
{
    real_draw(mode, count, type, indices);
    glEnable(0xffff);
}

static void gl_errors_are_reported_with_their_word_by_whatever_met_them(void **state)
{
    (void)state;
    static const struct sb_shot shot = {1, 1, 1, SB_PART_WHOLE};
    static const struct sb_image_request request = {.job = 1};
    struct text_job it, other;
    struct sb_prepared prepared;
    struct sb_sample sample;
    struct sb_image image;
    struct sb_error of_round = {0}, of_image = {0};
    job_init(&it, 1, flat);
    job_init(&other, 2, flat);
    prepare(&it, &prepared);
    real_draw = glad_glDrawElements;
    glad_glDrawElements = draw_with_error;
    const bool prepared_fine = fns->prepare(runner, &other.job, &prepared);
    const bool round_fine = fns->round(runner, &shot, 1, &sample, &of_round);
    const bool image_fine = fns->image(runner, &request, &image, &of_image);
    glad_glDrawElements = real_draw;
    assert_false(prepared_fine || round_fine || image_fine);
    check_contains(of_image.text, "drawing");
    const struct sb_error *errors[] = {&prepared.error, &of_round, &of_image};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(errors[i]->status, SB_GL_ERROR);
        check_contains(errors[i]->text, "GL_INVALID_ENUM");
    }
    prepare(&other,
            &prepared); // nothing of the failed attempt is left, its error neither
    fns->release(runner, 1);
    fns->release(runner, 2);
    job_free(&it);
    job_free(&other);
}

// Names of objects that live, among the first few thousand: drivers hand out low ones
// first, or go on counting.
static int live_objects(void)
{
    int count = 0;
    for (GLuint name = 1; name < 8192; name++)
        count += glIsBuffer(name) + glIsTexture(name) + glIsProgram(name) +
                 glIsShader(name) + glIsVertexArray(name) + glIsFramebuffer(name) +
                 glIsRenderbuffer(name) + glIsQuery(name);
    return count;
}

static void preparing_and_releasing_leaves_no_gl_object_behind(void **state)
{
    (void)state;
    const struct sb_shot shots[] = {{1, 2, 1, SB_PART_WHOLE}, {2, 2, 2, SB_PART_WHOLE}};
    struct sb_sample samples[2];
    struct sb_error err = {0};
    const int before = live_objects();
    for (int i = 0; i < 50; i++) {
        struct text_job it[2];
        struct sb_prepared prepared;
        struct sb_image image;
        for (uint32_t j = 0; j < 2; j++) {
            lit_init(&it[j], j + 1, j == 1 ? AS_STD140 : AS_UNIFORMS);
            // Every kind of object.
            job_add_lamp(&it[j], lamp);
            sb_variant_put(&it[j].job.variant, SB_AXIS_UPDATE, SB_UPDATE_LIGHTS);
            if (caps.samples >= 4)
                sb_variant_put(&it[j].job.variant, SB_AXIS_SAMPLES, 4);
            // A size of its own: what another test left behind would hide a leak.
            sb_variant_put(&it[j].job.variant, SB_AXIS_WIDTH, SIZE + 6);
            prepare(&it[j], &prepared);
        }
        assert_true(live_objects() > before);
        assert_true(fns->round(runner, shots, 2, samples, &err));
        image_of(1, SB_IMAGE_COLOUR, &image);
        sb_image_free(&image);
        for (uint32_t j = 0; j < 2; j++) {
            fns->release(runner, j + 1);
            job_free(&it[j]);
        }
        assert_int_equal(live_objects(), before);
    }
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void jobs_of_one_scene_and_size_share_its_upload_and_targets(void **state)
{
    (void)state;
    struct text_job it[3];
    struct sb_prepared prepared;
    struct sb_image before, after;
    for (uint32_t j = 0; j < 3; j++)
        job_init(&it[j], j + 1, flat);
    prepare(&it[0], &prepared);
    image_of(1, SB_IMAGE_COLOUR, &before);
    const int one = live_objects();
    prepare(&it[1], &prepared);
    assert_int_equal(live_objects(), one + 1);                   // the program
    sb_variant_put(&it[2].job.variant, SB_AXIS_WIDTH, 2 * SIZE); // another aspect ratio
    prepare(&it[2], &prepared);
    assert_true(live_objects() > one + 2);
    fns->release(runner, 3);
    fns->release(runner, 1);
    image_of(2, SB_IMAGE_COLOUR, &after); // what it shares is still there
    assert_int_equal(differing(&before, &after), 0);
    fns->release(runner, 2);
    sb_image_free(&before);
    sb_image_free(&after);
    for (uint32_t j = 0; j < 3; j++)
        job_free(&it[j]);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_compile_error_comes_with_stage_and_log),
        cmocka_unit_test(an_error_of_another_program_names_its_role_and_place),
        cmocka_unit_test(a_role_that_is_missing_unknown_or_given_twice_is_refused),
        cmocka_unit_test(more_samples_than_the_driver_has_are_refused_with_its_limit),
        cmocka_unit_test(an_unknown_scene_fails_with_the_valid_names),
        cmocka_unit_test(a_target_over_the_limit_is_refused),
        cmocka_unit_test(a_job_without_a_program_or_with_an_id_in_use_is_refused),
        cmocka_unit_test(a_released_job_fails_and_does_not_crash),
        cmocka_unit_test(gl_errors_are_reported_with_their_word_by_whatever_met_them),
        cmocka_unit_test(preparing_and_releasing_leaves_no_gl_object_behind),
        cmocka_unit_test(jobs_of_one_scene_and_size_share_its_upload_and_targets),
    };
    return run_with_runner(tests, sizeof tests / sizeof *tests);
}
