#include "measure/classes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "assemble/platform.h"
#include "base/log.h"
#include "measure/check.h"

enum { SIDE = 64 }; // pixels

struct verify {
    const struct sb_classes_params *params;
    struct sb_classes *classes;
    struct sb_image picture; // of the first of the class
    int done;
};

static bool draw(const struct verify *verify, const struct sb_task *task,
                 struct sb_image *image, struct sb_error *err)
{
    const struct sb_driver *driver = verify->params->driver;
    const struct sb_image_request request = {
        .job = task->assembly.job.id,
        .kind = SB_IMAGE_COLOUR,
        .width = SIDE,
        .height = SIDE,
        .wide = true,
    };
    return driver->fns->image(driver->runner, &request, image, err);
}

// The picture that the others are held against must show something itself.
static void keep_first(struct verify *verify, struct sb_task *task, int entry,
                       struct sb_class *class)
{
    struct sb_error err = {0};
    sb_check_picture(task, verify->params->driver);
    if (sb_task_sound(task) && !draw(verify, task, &verify->picture, &err))
        sb_task_fail(task, &err);
    if (sb_task_sound(task))
        class->first = entry;
}

static void compare(struct verify *verify, struct sb_task *task, struct sb_class *class)
{
    struct sb_error err = {0};
    struct sb_image picture = {0};
    const struct sb_plan_entry *first = &verify->params->suite->entry[class->first];
    const struct sb_class_pair pair = {
        .id = task->entry->id,
        .other_id = first->id,
        .picture = &picture,
        .other = &verify->picture,
        .exact = sb_platform_pair_exact(&first->variant, &task->entry->variant),
        .left_out = sb_platform_left_out(&first->variant) +
                    sb_platform_left_out(&task->entry->variant),
    };
    if (!draw(verify, task, &picture, &err) ||
        !sb_check_pair(&pair, &class->spread, &err))
        sb_task_fail(task, &err);
    sb_image_free(&picture);
    verify->classes->compared++;
}

static int find_same_code(const struct verify *verify, int entry)
{
    const struct sb_class_member *member = verify->classes->member;
    for (int i = 0; member[entry].binary_hash && i < entry; i++)
        if (member[i].class == member[entry].class &&
            member[i].binary_hash == member[entry].binary_hash)
            return i;
    return -1;
}

static void verify_member(struct verify *verify, int entry, struct sb_class *class)
{
    struct sb_class_member *member = &verify->classes->member[entry];
    const struct sb_classes_params *params = verify->params;
    const struct sb_prepare_params prepare = {
        .suite = params->suite,
        .driver = params->driver,
        .data_dir = params->data_dir,
        .shaders = params->shaders,
    };
    struct sb_task task = {.entry = &params->suite->entry[entry]};
    char line[160];
    snprintf(line, sizeof line, "verifying variant %d of %d", ++verify->done,
             params->suite->entry_count);
    sb_progress(line);
    sb_task_prepare(&task, &prepare, (uint32_t)entry + 1);
    if (task.loaded && class->first < 0)
        keep_first(verify, &task, entry, class);
    else if (task.loaded)
        compare(verify, &task, class);
    class->members++;
    class->drawn += task.loaded;
    member->status = task.status;
    member->binary_hash = task.loaded ? task.prepared.binary_hash : 0;
    member->same_code = find_same_code(verify, entry);
    if (task.note.length)
        member->note = sb_arena_strdup(&verify->classes->arena, task.note.data);
    sb_task_free(&task, params->driver);
}

static bool same_class(const struct sb_suite *suite, int a, int b)
{
    return strcmp(suite->entry[a].scene, suite->entry[b].scene) == 0 &&
           sb_variant_same_class(&suite->axes, &suite->entry[a].variant,
                                 &suite->entry[b].variant);
}

static void verify_class(struct verify *verify, int first)
{
    struct sb_classes *classes = verify->classes;
    const struct sb_suite *suite = verify->params->suite;
    const int number = classes->count++;
    struct sb_class *class = &classes->row[number];
    *class = (struct sb_class){
        .first = -1,
        .exact = sb_platform_class_exact(&suite->entry[first].variant),
        .spread = NAN,
    };
    for (int i = first; i < suite->entry_count; i++) {
        if (classes->member[i].class >= 0 || !same_class(suite, first, i))
            continue;
        classes->member[i].class = number;
        verify_member(verify, i, class);
        const enum sb_status status = classes->member[i].status;
        const int code = status == SB_OVER_LIMIT ? 0 : sb_status_rows[status].exit_code;
        if (code && class->status == SB_OK)
            class->status = status;
        classes->exit_code = sb_exit_code_worse(classes->exit_code, code);
    }
    sb_image_free(&verify->picture);
}

void sb_classes_verify(const struct sb_classes_params *params, struct sb_classes *classes)
{
    const int count = params->suite->entry_count;
    struct verify verify = {.params = params, .classes = classes};
    classes->row = sb_arena_alloc(&classes->arena, (size_t)count * sizeof *classes->row);
    classes->member =
        sb_arena_alloc(&classes->arena, (size_t)count * sizeof *classes->member);
    for (int i = 0; i < count; i++)
        classes->member[i] = (struct sb_class_member){.class = -1, .same_code = -1};
    for (int i = 0; i < count; i++)
        if (classes->member[i].class < 0)
            verify_class(&verify, i);
    sb_progress("");
}

void sb_classes_free(struct sb_classes *classes)
{
    sb_arena_free(&classes->arena);
    *classes = (struct sb_classes){0};
}

// Was every entry given the axis, with one value?
static bool is_common(const struct sb_suite *suite, int axis)
{
    const struct sb_variant *first = &suite->entry[0].variant;
    for (int i = 0; i < suite->entry_count; i++)
        if (!sb_variant_given(&suite->entry[i].variant, axis) ||
            suite->entry[i].variant.value[axis] != first->value[axis])
            return false;
    return true;
}

void sb_class_name(const struct sb_suite *suite, const struct sb_plan_entry *entry,
                   struct sb_text *text)
{
    struct sb_variant named = entry->variant;
    for (int a = 0; a < suite->axes.count; a++)
        if (suite->axes.row[a].kind == SB_IMPLEMENTATION || is_common(suite, a))
            named.given[a / 64] &= ~(UINT64_C(1) << a % 64);
    if (entry->preset)
        sb_text_printf(text, "%s ", entry->preset);
    struct sb_text id = {0};
    sb_variant_id(&suite->axes, &named, &id);
    sb_text_add(text, strchr(id.data, '=') ? id.data : "base");
    sb_text_free(&id);
}
