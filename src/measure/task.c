#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "assemble/platform.h"
#include "base/hash.h"
#include "measure/task.h"
#include "scene/lights.h"

void sb_task_note(struct sb_task *task, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (task->note.length)
        sb_text_add(&task->note, "; ");
    sb_text_vprintf(&task->note, format, args);
    va_end(args);
}

void sb_task_fail(struct sb_task *task, const struct sb_error *err)
{
    if (sb_status_rows[task->status].exit_code == 0)
        task->status = err->status;
    sb_task_note(task, "%s", err->text);
    task->active = false;
}

char *sb_task_file_name(const struct sb_task *task, struct sb_arena *arena)
{
    enum { ID_MAX = 180 }; // file names end at 255 bytes on most systems
    const char *id = task->entry->id;
    char *name = sb_arena_printf(arena, "%s-%.*s", task->entry->scene, ID_MAX, id);
    bool whole = strlen(id) <= ID_MAX;
    for (char *p = name; *p; p++) // the words of a suite's own axes may hold anything
        if (!isalnum((unsigned char)*p) && !strchr("-_.,=+", *p)) {
            *p = '_';
            whole = false;
        }
    return whole ? name
                 : sb_arena_printf(
                       arena, "%s-%016llx", name,
                       (unsigned long long)sb_hash(SB_HASH_START, id, strlen(id)));
}

bool sb_task_sound(const struct sb_task *task)
{
    return task->loaded && sb_status_rows[task->status].exit_code == 0;
}

bool sb_task_timed(const struct sb_task *task)
{
    return sb_task_sound(task) && !task->untimed;
}

int sb_task_light_count(const struct sb_task *task)
{
    int count = 0;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        count += sb_lights_shining(&task->entry->variant, (enum sb_light_type)type);
    return count;
}

void sb_task_light_name(const struct sb_task *task, int index, struct sb_text *text)
{
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const int count =
            sb_lights_shining(&task->entry->variant, (enum sb_light_type)type);
        if (index < count) {
            sb_text_printf(text, "%s %d", sb_light_structs[type].name, index);
            return;
        }
        index -= count;
    }
}

void sb_task_add_sample(struct sb_task *task, const struct sb_sample_row *row)
{
    task->sample =
        sb_grow(task->sample, task->sample_count, &task->sample_capacity, sizeof *row);
    task->sample[task->sample_count++] = *row;
}

void sb_task_free(struct sb_task *task, const struct sb_driver *driver)
{
    if (task->loaded && driver->runner)
        driver->fns->release(driver->runner, task->assembly.job.id);
    free(task->prepared.log);
    free(task->sample);
    sb_text_free(&task->note);
    sb_assembly_free(&task->assembly);
    *task = (struct sb_task){0};
}

static void fail_prepare(struct sb_task *task)
{
    struct sb_error *err = &task->prepared.error;
    if (err->status == SB_COMPILE_FAILED && task->prepared.log) {
        struct sb_text log = {0};
        sb_assembly_explain(&task->assembly, &task->prepared, &log);
        // The row takes one line; compilers say the cause first.
        char *first = log.data ? log.data + strspn(log.data, "\n") : NULL;
        if (first && *first) {
            first[strcspn(first, "\n")] = '\0';
            sb_fail(err, err->status, "%s", first);
        }
        sb_text_free(&log);
    }
    sb_task_fail(task, err);
}

void sb_task_prepare(struct sb_task *task, const struct sb_prepare_params *params,
                     uint32_t id)
{
    const struct sb_driver *driver = params->driver;
    const struct sb_assemble_params assemble = {
        .data_dir = params->data_dir,
        .shaders = params->shaders,
        .axes = &params->suite->axes,
        .suite = params->suite,
        .scene = task->entry->scene,
        .variant = &task->entry->variant,
        .caps = &driver->caps,
        .id = id,
        .movable_lights = params->movable_lights,
        .probe = !params->movable_lights,
    };
    const struct sb_frozen_params frozen = {
        .frozen = params->frozen,
        .scene = task->entry->scene,
        .variant = &task->entry->variant,
        .caps = &driver->caps,
        .id = id,
    };
    struct sb_error err = {0};
    task->untimed = sb_variant_untimed(&params->suite->axes, &task->entry->variant);
    task->nonfinite = task->negative = SB_NO_COUNT;
    task->class_spread = task->shadow_share = task->payback_check = NAN;
    task->assembly.job.variant = task->entry->variant;
    const bool assembled = params->frozen
                               ? sb_assemble_frozen(&frozen, &task->assembly, &err)
                               : sb_assemble(&assemble, &task->assembly, &err);
    // Of what fails, too, or its row would seem to be one of other conditions.
    sb_platform_record(&driver->caps, &task->assembly.job.variant);
    task->decided = true;
    if (!assembled) {
        sb_task_fail(task, &err);
        return;
    }
    if (params->renamed)
        sb_assembly_rename(&task->assembly);
    task->loaded =
        driver->fns->prepare(driver->runner, &task->assembly.job, &task->prepared);
    if (!task->loaded)
        fail_prepare(task);
}
