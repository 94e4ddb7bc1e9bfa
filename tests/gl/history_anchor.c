// The anchor of histories on a real driver: its texts are frozen, and the program around them is
// not. Where a uniform has another name or meaning than it had, the anchor draws something else: then
// another anchor is wanted (docs/history.md).
#include "accuracy_world.h"

#include "gate/anchor.h"
#include "measure/check.h"

static struct sb_anchor anchor;

static void load(struct sb_suite *like)
{
    struct sb_error err = {0};
    struct sb_assignment api = {"api", gl_test_gles() ? "gles" : "gl", "test"};
    if (!sb_suite_load(&(struct sb_suite_params){.set = &api, .set_count = 1}, like,
                       &err) ||
        !sb_anchor_load(SB_SOURCE_DIR, like, gl_test_gles(), &anchor, &err))
        fail_msg("%s", err.text);
}

// The anchor's variant by the shaders of today, or by its frozen texts.
static void make(struct sb_task *task, const struct sb_frozen *frozen, uint32_t id)
{
    *task = (struct sb_task){.entry = &anchor.suite.entry[0]};
    sb_task_prepare(task,
                    &(struct sb_prepare_params){
                        .suite = &anchor.suite,
                        .driver = &driver,
                        .data_dir = SB_SOURCE_DIR,
                        .frozen = frozen,
                    },
                    id);
    if (task->loaded)
        sb_check_picture(task, &driver);
    if (!sb_task_sound(task))
        fail_msg("%s: %s", frozen ? "the anchor" : "its variant by the shaders of today",
                 sb_text_get(&task->note));
}

static void draw(const struct sb_task *task, struct sb_image *image)
{
    struct sb_error err = {0};
    const struct sb_image_request request = {.job = task->assembly.job.id,
                                             .kind = SB_IMAGE_COLOUR};
    if (!driver.fns->image(driver.runner, &request, image, &err))
        fail_msg("%s", err.text);
}

static void the_anchor_draws_what_its_variant_does_today(void **state)
{
    (void)state;
    struct sb_suite like = {0};
    struct sb_task task[2];
    struct sb_image image[2] = {{0}};
    struct sb_image_difference difference;
    load(&like);
    for (uint32_t i = 0; i < 2; i++) {
        make(&task[i], i == 0 ? &anchor.text : NULL, i + 1);
        draw(&task[i], &image[i]);
    }
    assert_true(task[0].prepared.fragments > 1000);
    assert_true(task[0].prepared.input_hash == task[1].prepared.input_hash);
    sb_image_compare(&image[0], &image[1], &difference);
    print_message("largest difference to today's shaders: %g/255 at (%d, %d)\n",
                  255 * difference.max, difference.x, difference.y);
    assert_true(difference.max <= 2.01 / 255);
    for (int i = 0; i < 2; i++) {
        sb_task_free(&task[i], &driver);
        sb_image_free(&image[i]);
    }
    sb_anchor_free(&anchor);
    sb_suite_free(&like);
}

int main(void)
{
    open_driver();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_anchor_draws_what_its_variant_does_today),
    };
    const int failed = run_tests(tests);
    sb_driver_close(&driver);
    return failed;
}
