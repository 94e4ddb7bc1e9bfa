#include "cases/unit.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

static bool fail_compile(const struct sb_unit *unit, struct sb_prepared *prepared,
                         struct sb_error *err)
{
    struct sb_text text = {0};
    if (prepared->log && *prepared->log)
        sb_assembly_explain(&unit->assembly, prepared, &text);
    if (text.length > 0)
        sb_fail(err, prepared->error.status, "%.*s",
                (int)strcspn(sb_text_get(&text), "\n"), sb_text_get(&text));
    else
        *err = prepared->error;
    sb_text_free(&text);
    free(prepared->log);
    return false;
}

bool sb_unit_open(struct sb_unit *unit, const struct sb_unit_params *params,
                  struct sb_error *err)
{
    const struct sb_assemble_params assemble = {
        .data_dir = params->data_dir,
        .shaders = params->shaders,
        .axes = params->axes,
        .variant = params->variant,
        .caps = &params->driver->caps,
        .id = params->id,
        .rows = true,
    };
    struct sb_prepared prepared = {0};
    unit->driver = params->driver;
    if (!sb_assemble(&assemble, &unit->assembly, err))
        return false;
    if (!params->driver->fns->prepare(params->driver->runner, &unit->assembly.job,
                                      &prepared))
        return fail_compile(unit, &prepared, err);
    free(prepared.log);
    unit->loaded = true;
    return true;
}

void sb_unit_close(struct sb_unit *unit)
{
    if (unit->loaded)
        unit->driver->fns->release(unit->driver->runner, unit->assembly.job.id);
    sb_assembly_free(&unit->assembly);
    *unit = (struct sb_unit){0};
}

static bool ask(const struct sb_unit *unit, const struct sb_image *table,
                struct sb_image_request request, struct sb_image *image,
                struct sb_error *err)
{
    request.job = unit->assembly.job.id;
    request.kind = SB_IMAGE_ROWS;
    request.rows = table;
    return unit->driver->fns->image(unit->driver->runner, &request, image, err);
}

bool sb_unit_light(const struct sb_unit *unit, const struct sb_points *points, int lights,
                   struct sb_unit_told *told, struct sb_error *err)
{
    struct sb_image table = {0};
    sb_points_table(points, &table);
    *told = (struct sb_unit_told){.lights = lights};
    told->light = sb_alloc((size_t)(lights + 1) * sizeof *told->light);
    bool good = ask(unit, &table, (struct sb_image_request){.page = SB_PROBE_INPUTS},
                    &told->inputs, err) &&
                ask(unit, &table, (struct sb_image_request){.page = SB_PROBE_FRAME},
                    &told->frame, err);
    for (int i = 0; good && i < lights; i++)
        good = ask(unit, &table,
                   (struct sb_image_request){.page = SB_PROBE_LIGHT, .light = i},
                   &told->light[i], err);
    sb_image_free(&table);
    return good;
}

void sb_unit_told_free(struct sb_unit_told *told)
{
    sb_image_free(&told->inputs);
    sb_image_free(&told->frame);
    for (int i = 0; told->light && i < told->lights; i++)
        sb_image_free(&told->light[i]);
    free(told->light);
    *told = (struct sb_unit_told){0};
}

bool sb_unit_add(const struct sb_unit *unit, const struct sb_points *points, int adding,
                 struct sb_image *sums, struct sb_error *err)
{
    struct sb_image table = {0};
    sb_points_table(points, &table);
    const bool good =
        ask(unit, &table, (struct sb_image_request){.adding = adding}, sums, err);
    sb_image_free(&table);
    return good;
}

enum { COLOUR = 4 }; // channels before those of the page

const float *sb_told_page(const struct sb_image *page, int point)
{
    return page->data + (size_t)point * (size_t)page->channels + COLOUR;
}

const float *sb_told_colour(const struct sb_unit_told *told, int point)
{
    return told->inputs.data + (size_t)point * (size_t)told->inputs.channels;
}
