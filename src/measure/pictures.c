#include "measure/pictures.h"

#include <stdlib.h>

#include "base/file.h"
#include "image/heat.h"
#include "image/sheet.h"
#include "measure/accuracy.h"
#include "measure/interrupt.h"

struct writer {
    const struct sb_pictures_params *params;
    const char *folder;
    int side;                      // of a picture on the sheet
    struct sb_image *small, *heat; // those on the sheets
    int count, heat_count;         // of them
    struct sb_text legend;
    struct sb_arena arena;
};

static const char *path_of(struct writer *writer, const struct sb_task *task,
                           const char *end)
{
    const char *name = sb_arena_printf(&writer->arena, "%s%s.png",
                                       sb_task_file_name(task, &writer->arena), end);
    return sb_path_join(&writer->arena, writer->folder, name);
}

static bool write_colour(struct writer *writer, const struct sb_task *task,
                         struct sb_error *err)
{
    const struct sb_driver *driver = writer->params->driver;
    struct sb_image image = {0};
    const struct sb_image_request request = {.job = task->assembly.job.id,
                                             .kind = SB_IMAGE_COLOUR};
    const bool good = driver->fns->image(driver->runner, &request, &image, err) &&
                      sb_image_write_png(&image, path_of(writer, task, ""), err);
    if (good) {
        const int place = writer->count++;
        sb_image_shrink(&image, writer->side, &writer->small[place]);
        sb_text_printf(&writer->legend, "%d\t%d\t%s\t%s\n", place / SB_SHEET_COLUMNS + 1,
                       place % SB_SHEET_COLUMNS + 1, task->entry->scene, task->entry->id);
    }
    sb_image_free(&image);
    return good;
}

static bool write_shadow(struct writer *writer, const struct sb_task *task, int caster,
                         struct sb_error *err)
{
    const struct sb_driver *driver = writer->params->driver;
    struct sb_image image = {0};
    const struct sb_image_request request = {
        .job = task->assembly.job.id,
        .kind = SB_IMAGE_SHADOW,
        .caster = caster,
    };
    const char *end = sb_arena_printf(&writer->arena, "-shadow%d", caster);
    bool good = driver->fns->image(driver->runner, &request, &image, err);
    if (good) {
        sb_image_stretch(&image);
        good = sb_image_write_png(&image, path_of(writer, task, end), err);
    }
    sb_image_free(&image);
    return good;
}

// Where the picture's error is. A task whose error is not known leaves its place black.
static bool write_heat(struct writer *writer, const struct sb_task *task,
                       struct sb_error *err)
{
    struct sb_image heat = {0};
    struct sb_image *small = &writer->heat[writer->heat_count++];
    struct sb_error ignored = {0};
    if (!task->accuracy.known ||
        !sb_accuracy_heat(task, writer->params->driver, writer->params->truths, &heat,
                          &ignored)) {
        sb_image_init(small, 1, 1, 3);
        return true;
    }
    const bool good = sb_image_write_png(&heat, path_of(writer, task, "-error"), err);
    sb_image_shrink(&heat, writer->side + SB_HEAT_SCALE_WIDTH, small);
    sb_image_free(&heat);
    return good;
}

static bool write_sheet(struct writer *writer, const struct sb_image *picture, int count,
                        const char *name, struct sb_error *err)
{
    struct sb_image sheet = {0};
    if (count == 0)
        return true;
    sb_sheet_make(picture, count, &sheet);
    const bool good = sb_image_write_png(
        &sheet, sb_path_join(&writer->arena, writer->folder, name), err);
    sb_image_free(&sheet);
    return good;
}

static bool write_sheets(struct writer *writer, struct sb_error *err)
{
    const char *legend = sb_path_join(&writer->arena, writer->folder, "sheet.txt");
    return write_sheet(writer, writer->small, writer->count, "sheet.png", err) &&
           write_sheet(writer, writer->heat, writer->heat_count, "sheet-error.png",
                       err) &&
           sb_file_replace(legend, writer->legend.data, writer->legend.length, err);
}

bool sb_pictures_write(const struct sb_pictures_params *params, struct sb_error *err)
{
    struct writer writer = {.params = params, .side = sb_sheet_side(params->task_count)};
    writer.small = sb_alloc((size_t)params->task_count * sizeof *writer.small);
    writer.heat = sb_alloc((size_t)params->task_count * sizeof *writer.heat);
    writer.folder = sb_path_join(&writer.arena, params->dir, "images");
    sb_text_add(&writer.legend, "row\tcolumn\tscene\tvariant\n");
    bool good = sb_dir_make(writer.folder, err);
    for (int i = 0; good && i < params->task_count && !sb_interrupted(); i++) {
        const struct sb_task *task = &params->task[i];
        if (!task->loaded)
            continue;
        good = write_colour(&writer, task, err) && write_heat(&writer, task, err);
        for (int caster = 0; good && caster < task->prepared.casters; caster++)
            good = write_shadow(&writer, task, caster, err);
    }
    good = good && write_sheets(&writer, err);
    for (int i = 0; i < writer.count; i++)
        sb_image_free(&writer.small[i]);
    for (int i = 0; i < writer.heat_count; i++)
        sb_image_free(&writer.heat[i]);
    free(writer.small);
    free(writer.heat);
    sb_text_free(&writer.legend);
    sb_arena_free(&writer.arena);
    return good;
}
