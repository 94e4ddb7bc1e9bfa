// Errors of single variants on a real driver, for the tests of accuracy: as `run` measures them,
// without its timers.
#pragma once

#include "gl_test.h"
#include "local/local.h"
#include "measure/accuracy.h"
#include "test.h"

static struct sb_driver driver;

static inline void open_driver(void)
{
    struct sb_error err = {0};
    const struct sb_driver_params params = {
        .runner = &sb_runner_local,
        .context = {.context = gl_test_context(), .gles = gl_test_gles(), .device = -1},
    };
    if (!sb_driver_connect(&params, &driver, &err) || !sb_driver_probe(&driver, &err))
        gl_test_unavailable(&err);
}

// One variant, prepared: `preset` may be NULL, `words` are "point=4,stage=vertex".
struct one {
    struct sb_suite suite;
    struct sb_task task;
    struct sb_truths *truths;
};

struct one_params {
    const char *scene, *preset, *words, *shaders;
};

static inline void one_make(struct one *one, const struct one_params *params)
{
    struct sb_error err = {0};
    struct sb_assignment set[32] = {
        {.axis = "api", .values = gl_test_gles() ? "gles" : "gl", .origin = "test"}};
    char words[512];
    int count = 1;
    *one = (struct one){0};
    snprintf(words, sizeof words, "%s", params->words);
    for (char *word = strtok(words, ","); word; word = strtok(NULL, ",")) {
        char *equals = strchr(word, '=');
        assert_non_null(equals);
        *equals = '\0';
        set[count++] =
            (struct sb_assignment){.axis = word, .values = equals + 1, .origin = "test"};
    }
    const struct sb_suite_params suite = {
        .preset = params->preset,
        .data_dir = SB_SOURCE_DIR,
        .scene = params->scene,
        .set = set,
        .set_count = count,
    };
    if (!sb_suite_load(&suite, &one->suite, &err))
        fail_msg("%s", err.text);
    assert_int_equal(one->suite.entry_count, 1);
    one->task.entry = &one->suite.entry[0];
    one->truths = sb_truths_new(&one->suite.axes);
    const struct sb_prepare_params prepare = {
        .suite = &one->suite,
        .driver = &driver,
        .data_dir = SB_SOURCE_DIR,
        .shaders = params->shaders,
    };
    static uint32_t number; // a test that failed has not released its job
    sb_task_prepare(&one->task, &prepare, ++number);
    if (!one->task.loaded)
        fail_msg("%s: %s", params->words, sb_text_get(&one->task.note));
}

static inline void one_free(struct one *one)
{
    sb_truths_free(&one->truths);
    sb_task_free(&one->task, &driver);
    sb_suite_free(&one->suite);
}

static inline void one_measure(struct one *one, const struct one_params *params)
{
    one_make(one, params);
    sb_accuracy_measure(&one->task, &driver, one->truths);
    if (!one->task.accuracy.known)
        fail_msg("%s: %s", params->words, sb_text_get(&one->task.note));
}

// The share of a part in the sum of all four, by their means.
static inline double share_of(const struct one *one, enum sb_error_source part)
{
    double sum = 0;
    for (int p = 0; p < SB_BY_COUNT; p++)
        sum += one->task.accuracy.split.part[p].mean;
    return one->task.accuracy.split.part[part].mean / sum;
}
