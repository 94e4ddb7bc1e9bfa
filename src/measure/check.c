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

// Of the twins: above the numbers of all tasks.
static const uint32_t TWIN = UINT32_C(1) << 31;

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
    if (task->assembly.undefined)
        sb_task_note(task, "the text starts from a variable that nothing has set: the "
                           "picture may be anything, and is not judged");
    else if (task->nonfinite)
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

// The picture with some lights off; side 0: of its own size.
static bool picture_of(const struct sb_task *task, const struct sb_driver *driver,
                       int side, int first, int count, struct sb_image *image,
                       struct sb_error *err)
{
    const struct sb_image_request request = {
        .job = task->assembly.job.id,
        .kind = SB_IMAGE_COLOUR,
        .width = side,
        .height = side,
        .wide = true,
        .off_first = first,
        .off_count = count,
    };
    return driver->fns->image(driver->runner, &request, image, err);
}

static bool small_picture(const struct sb_task *task, const struct sb_driver *driver,
                          int first, int count, struct sb_image *image,
                          struct sb_error *err)
{
    return picture_of(task, driver, LIGHT_CHECK_SIDE, first, count, image, err);
}

// Is the light in no program's list, because a policy has found that it matters nowhere?
static bool is_left_out(const struct sb_task *task, int light)
{
    const struct sb_job *job = &task->assembly.job;
    for (int i = 0; i < job->lit_count; i++) {
        int count = 0;
        for (int t = 0; t < SB_JOB_LIGHT_TYPES; t++)
            count += job->lit[i].light_count[t];
        for (int k = 0; k < count; k++)
            if (job->lit[i].light[k] == light)
                return false;
    }
    return job->lit_count > 0;
}

// Lights [first, end) are switched on one after another, those behind them being off: each
// must change the picture that the ones before it made, unless a policy leaves it out. Sets
// *stopped to the first light that the time did not suffice for, or `end`.
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
        if (difference.pixels == 0 && !is_left_out(task, *stopped)) {
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
        const int count =
            sb_lights_shining(&task->entry->variant, (enum sb_light_type)type);
        end += count;
        if (count && !check_one_by_one(task, driver, end - 1, end, &stopped, err))
            return false;
    }
    return true;
}

// Is the picture of the twin that of the task?
static bool check_twin(struct sb_task *task, const struct sb_task *twin,
                       const struct sb_driver *driver, struct sb_error *err)
{
    struct sb_image mine = {0}, theirs = {0};
    const bool good = small_picture(task, driver, 0, 0, &mine, err) &&
                      small_picture(twin, driver, 0, 0, &theirs, err) &&
                      sb_check_pair(
                          &(struct sb_class_pair){
                              .id = task->entry->id,
                              .other_id = "the same lights as uniforms",
                              .picture = &mine,
                              .other = &theirs,
                              .exact = sb_platform_class_exact(&task->entry->variant),
                          },
                          &task->class_spread, err);
    sb_image_free(&mine);
    sb_image_free(&theirs);
    return good;
}

// False: there is no twin whose lights could be checked, and the task knows why.
static bool make_twin(struct sb_task *task, const struct sb_prepare_params *params,
                      struct sb_task *twin)
{
    struct sb_prepare_params movable = *params;
    struct sb_error err = {0};
    movable.movable_lights = true;
    *twin = (struct sb_task){.entry = task->entry};
    sb_task_prepare(twin, &movable, task->assembly.job.id | TWIN);
    if (twin->loaded && check_twin(task, twin, params->driver, &err))
        return true;
    // That as many lights do not fit into uniforms is no fault of the constants.
    if (twin->status == SB_OVER_LIMIT)
        sb_task_note(task, "the lights, which are constants, were not checked: %s",
                     sb_text_get(&twin->note));
    else if (!twin->loaded)
        sb_fail(&err, twin->status, "the same lights as uniforms: %s",
                sb_text_get(&twin->note));
    if (err.status != SB_OK)
        sb_task_fail(task, &err);
    sb_task_free(twin, params->driver);
    return false;
}

void sb_check_lights(struct sb_task *task, const struct sb_prepare_params *params,
                     bool thorough)
{
    const int count = sb_task_light_count(task);
    int stopped = count;
    struct sb_error err = {0};
    struct sb_task twin = {0};
    const bool fixed = task->assembly.lights_fixed;
    if (count == 0 || task->assembly.undefined ||
        sb_platform_leaves_out(&task->entry->variant) ||
        (fixed && !make_twin(task, params, &twin)))
        return;
    struct sb_task *lit = fixed ? &twin : task;
    const bool good =
        thorough ? check_one_by_one(lit, params->driver, 0, count, &stopped, &err)
                 : check_last_lights(lit, params->driver, &err);
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
    if (fixed)
        sb_task_free(&twin, params->driver);
}

bool sb_check_pair(const struct sb_class_pair *pair, double *spread, struct sb_error *err)
{
    static const char *const channels[] = {"red", "green", "blue", "alpha"};
    struct sb_image_difference difference;
    sb_image_compare(pair->picture, pair->other, &difference);
    *spread = fmax(*spread, difference.max); // fmax passes over NAN
    if (!pair->exact || difference.max <= SB_CLASS_BOUND + pair->left_out)
        return true;
    return sb_fail(
        err, SB_CLASS_BROKEN,
        "%s differs from %s by %g at pixel (%d, %d) of %d x %d, and should not: "
        "%s is %.9g, not %.9g",
        pair->id, pair->other_id, difference.max, difference.x, difference.y,
        pair->picture->width, pair->picture->height, channels[difference.channel],
        (double)difference.a, (double)difference.b);
}

void sb_check_class(struct sb_task *task, struct sb_task *other,
                    const struct sb_driver *driver)
{
    struct sb_error err = {0};
    struct sb_image mine = {0}, theirs = {0};
    const struct sb_variant *a = &task->entry->variant, *b = &other->entry->variant;
    const int side = sb_platform_pair_asked(a, b) ? LIGHT_CHECK_SIDE : 0;
    const struct sb_class_pair pair = {
        .id = task->entry->id,
        .other_id = other->entry->id,
        .picture = &mine,
        .other = &theirs,
        .exact = sb_platform_pair_exact(a, b),
        .left_out = sb_platform_left_out(a) + sb_platform_left_out(b),
    };
    if (!picture_of(task, driver, side, 0, 0, &mine, &err) ||
        !picture_of(other, driver, side, 0, 0, &theirs, &err) ||
        !sb_check_pair(&pair, &task->class_spread, &err))
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
