#include <math.h>

#include "assemble/platform.h"
#include "base/clock.h"
#include "measure/check.h"
#include "measure/interrupt.h"
#include "scene/lights.h"

enum {
    LIGHT_CHECK_SIDE = 48
}; // pixels; every scene keeps every light visible at this size

// A picture with n lights costs n, and there are n of them: 768 lights on a software
// rasteriser would take minutes.
static const int64_t LIGHT_CHECK_NS = INT64_C(10000000000);

// Linear light, full scale 1. Implementations may add the same numbers in another order: a
// sum of 768 lights then differs by some 768 x 2^-24.
static const double CLASS_BOUND = 1e-4;

// Counts over the pixels that the scene covers; the background says nothing of the shader.
static bool count_values(const struct sb_image *colour, const struct sb_image *id,
                         struct sb_task *task)
{
    bool lit = false;
    task->nonfinite = task->negative = 0;
    for (long i = 0; i < (long)colour->width * colour->height; i++)
        for (int c = 0; c < 3 && id->data[i] != 0; c++) {
            const float value = colour->data[i * colour->channels + c];
            task->nonfinite += !isfinite(value);
            task->negative += value < 0;
            lit |= value > 0;
        }
    return lit;
}

void sb_check_picture(struct sb_task *task, const struct sb_driver *driver)
{
    struct sb_error err = {0};
    struct sb_image colour = {0}, id = {0};
    struct sb_image_request request = {.job = task->assembly.job.id,
                                       .kind = SB_IMAGE_COLOUR};
    if (!driver->fns->image(driver->runner, &request, &colour, &err))
        goto done;
    request.kind = SB_IMAGE_ID;
    if (!driver->fns->image(driver->runner, &request, &id, &err))
        goto done;
    const bool lit = count_values(&colour, &id, task);
    if (task->nonfinite)
        sb_fail(&err, SB_NON_FINITE, "%lld values of the picture are NaN or infinite",
                (long long)task->nonfinite);
    else if (task->prepared.fragments == 0)
        sb_fail(&err, SB_BLANK, "the scene covers no pixel");
    else if (!lit)
        sb_fail(&err, SB_BLANK, "every covered pixel is black");

done:
    if (err.status != SB_OK)
        sb_task_fail(task, &err);
    sb_image_free(&colour);
    sb_image_free(&id);
}

// The picture with some lights off.
static bool small_picture(const struct sb_task *task, const struct sb_driver *driver,
                          int first, int count, struct sb_image *image,
                          struct sb_error *err)
{
    const struct sb_image_request request = {
        .job = task->assembly.job.id,
        .kind = SB_IMAGE_COLOUR,
        .width = LIGHT_CHECK_SIDE,
        .height = LIGHT_CHECK_SIDE,
        .wide = true,
        .off_first = first,
        .off_count = count,
    };
    return driver->fns->image(driver->runner, &request, image, err);
}

// Lights [first, end) are switched on one after another, those behind them being off: each
// must change the picture that the ones before it made. Sets *stopped to the first light that
// the time did not suffice for, or `end`.
static bool check_one_by_one(struct sb_task *task, const struct sb_driver *driver,
                             int first, int end, int *stopped, struct sb_error *err)
{
    const int64_t deadline = sb_clock_ns() + LIGHT_CHECK_NS;
    const int count = sb_task_light_count(task);
    struct sb_image before = {0}, after = {0};
    bool good = small_picture(task, driver, first, count - first, &before, err);
    for (*stopped = first; good && *stopped < end; (*stopped)++) {
        const int on = *stopped + 1;
        struct sb_image_difference difference;
        if (sb_clock_ns() > deadline || sb_interrupted())
            break;
        good = small_picture(task, driver, on, count - on, &after, err);
        if (!good)
            break;
        sb_image_compare(&before, &after, &difference);
        if (difference.pixels == 0) {
            struct sb_text name = {0};
            sb_task_light_name(task, *stopped, &name);
            good = sb_fail(err, SB_DEAD_LIGHT, "%s changes no pixel", sb_text_get(&name));
            sb_text_free(&name);
        }
        sb_image_free(&before);
        before = after;
        after = (struct sb_image){0};
    }
    sb_image_free(&before);
    sb_image_free(&after);
    return good;
}

static bool check_last_lights(struct sb_task *task, const struct sb_driver *driver,
                              struct sb_error *err)
{
    int end = 0, stopped;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const int count = (int)task->entry->variant.value[sb_light_types[type].axis];
        end += count;
        if (count && !check_one_by_one(task, driver, end - 1, end, &stopped, err))
            return false;
    }
    return true;
}

void sb_check_lights(struct sb_task *task, const struct sb_driver *driver, bool thorough)
{
    const int count = sb_task_light_count(task);
    int stopped = count;
    struct sb_error err = {0};
    if (count == 0)
        return;
    const bool good = thorough ? check_one_by_one(task, driver, 0, count, &stopped, &err)
                               : check_last_lights(task, driver, &err);
    // Lit per vertex, a light may fall between the vertices: an error of the stage, that the
    // reader should know of, but the program did its work.
    if (!good && err.status == SB_DEAD_LIGHT && task->assembly.lit_per_vertex)
        sb_task_note(task, "%s: it falls between the vertices", err.text);
    else if (!good)
        sb_task_fail(task, &err);
    else if (stopped < count)
        sb_task_note(task,
                     "%d of %d lights were checked, for as long as a check may take",
                     stopped, count);
}

void sb_check_class(struct sb_task *task, struct sb_task *other,
                    const struct sb_driver *driver)
{
    struct sb_error err = {0};
    struct sb_image mine = {0}, theirs = {0};
    struct sb_image_difference difference;
    const bool drawn = small_picture(task, driver, 0, 0, &mine, &err) &&
                       small_picture(other, driver, 0, 0, &theirs, &err);
    if (drawn) {
        sb_image_compare(&mine, &theirs, &difference);
        task->class_spread = fmax(task->class_spread, difference.max);
        if (difference.max > CLASS_BOUND &&
            sb_platform_class_exact(&task->entry->variant))
            sb_fail(&err, SB_CLASS_BROKEN,
                    "differs from %s by %g at (%d, %d) of %d x %d, and should not",
                    other->entry->id, difference.max, difference.x, difference.y,
                    LIGHT_CHECK_SIDE, LIGHT_CHECK_SIDE);
    }
    if (err.status != SB_OK)
        sb_task_fail(task, &err);
    sb_image_free(&mine);
    sb_image_free(&theirs);
}

void sb_check_same_code(struct sb_task *tasks, int count)
{
    for (int i = 1; i < count; i++) {
        const uint64_t hash = tasks[i].prepared.binary_hash;
        for (int j = 0; hash && j < i; j++)
            if (tasks[j].prepared.binary_hash == hash) {
                sb_task_note(&tasks[i], "same code as %s", tasks[j].entry->id);
                break;
            }
    }
}
