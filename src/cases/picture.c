#include "cases/picture.h"

#include <math.h>
#include <stdlib.h>

#include "cases/judge.h"

static bool draw(const struct sb_driver *driver, struct sb_assembly *assembly,
                 struct sb_case_picture *picture, struct sb_error *err)
{
    struct sb_prepared prepared = {0};
    struct sb_image_request request = {
        .job = assembly->job.id, .kind = SB_IMAGE_COLOUR, .wide = true, .single = true};
    bool good = driver->fns->prepare(driver->runner, &assembly->job, &prepared);
    free(prepared.log);
    if (!good) {
        *err = prepared.error;
        return false;
    }
    good = driver->fns->image(driver->runner, &request, &picture->colour, err);
    request.kind = SB_IMAGE_GEOMETRY;
    good = good && driver->fns->image(driver->runner, &request, &picture->geometry, err);
    driver->fns->release(driver->runner, request.job);
    return good;
}

bool sb_case_picture(const struct sb_case_picture_params *params,
                     struct sb_case_picture *picture, struct sb_error *err)
{
    const struct sb_driver *driver = params->env->driver;
    const struct sb_assemble_params assemble = {
        .data_dir = params->env->data_dir,
        .shaders = params->env->shaders,
        .axes = params->env->axes,
        .scene = params->scene,
        .variant = params->variant,
        .caps = &driver->caps,
        .id = sb_case_next_job(),
    };
    struct sb_assembly assembly = {0};
    const bool good =
        sb_assemble(&assemble, &assembly, err) && draw(driver, &assembly, picture, err);
    sb_assembly_free(&assembly);
    return good;
}

void sb_case_picture_free(struct sb_case_picture *picture)
{
    sb_image_free(&picture->colour);
    sb_image_free(&picture->geometry);
}

static bool is_same_triangle(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

double sb_case_picture_compare(const struct sb_case_picture *a,
                               const struct sb_case_picture *b, double share)
{
    double worst = 0;
    int same = 0;
    for (int y = 0; y < a->colour.height; y++)
        for (int x = 0; x < a->colour.width; x++) {
            const float *one = sb_image_at(&a->colour, x, y);
            const float *other = sb_image_at(&b->colour, x, y);
            if (!is_same_triangle(sb_image_at(&a->geometry, x, y),
                                  sb_image_at(&b->geometry, x, y)))
                continue;
            same++;
            for (int c = 0; c < 3; c++) {
                const double error = 255 * fabs((double)one[c] - other[c]);
                worst = fmax(worst, isfinite(error) ? error : INFINITY);
            }
        }
    return same < share * a->colour.width * a->colour.height ? INFINITY : worst;
}
