// Cases about what is interpolated: pictures of small scenes.
#include <math.h>
#include <stdlib.h>

#include "cases/accumulation.h"
#include "cases/own.h"
#include "measure/accuracy.h"

// The corridor, whose triangles are its truth, so that lit per fragment nothing is left but
// arithmetic. Per vertex the picture is held against Gouraud shading in double as well: what it
// loses against the ideal is the model's, not the driver's.
bool sb_case_run_gouraud(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting,
                         struct sb_outcome *outcome, struct sb_error *err)
{
    (void)it;
    struct sb_case_task picture;
    struct sb_truths *truths = sb_truths_new(env->axes);
    const bool good = sb_case_task_open(env, setting->variant, "plane", &picture, err);
    if (good) {
        struct sb_task *task = &picture.task;
        sb_accuracy_measure(task, env->driver, truths);
        const struct sb_accuracy *accuracy = &task->accuracy;
        const double arithmetic = 255 * accuracy->split.part[SB_BY_ARITHMETIC].max;
        const double formulation = 255 * accuracy->split.part[SB_BY_FORMULATION].max;
        sb_outcome_measured(outcome, SB_FIGURE_ABSOLUTE,
                            accuracy->known ? fmax(arithmetic, formulation) : NAN, 0.5);
        if (setting->variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX)
            sb_text_printf(&outcome->note,
                           "of Gouraud shading in double it is %.3g steps off; that is "
                           "%.3g off the ideal",
                           255 * accuracy->split.gouraud, formulation);
        if (task->note.length)
            sb_text_printf(&outcome->note, "; %s", sb_text_get(&task->note));
    }
    sb_case_task_free(env, &picture);
    sb_truths_free(&truths);
    return good;
}

bool sb_case_run_extrapolation(const struct sb_case_env *env, const struct sb_case *it,
                               const struct sb_case_setting *setting,
                               struct sb_outcome *outcome, struct sb_error *err)
{
    (void)it;
    struct sb_case_task picture;
    struct sb_image image = {0};
    const bool good =
        sb_case_task_open(env, setting->variant, "sphere", &picture, err) &&
        env->driver->fns->image(
            env->driver->runner,
            &(struct sb_image_request){.job = picture.task.assembly.job.id}, &image, err);
    if (good) {
        double bad = 0;
        for (int i = 0; i < image.width * image.height; i++)
            for (int c = 0; c < 3; c++) {
                const float value = image.data[i * image.channels + c];
                bad += !(isfinite(value) && value >= 0);
            }
        sb_outcome_measured(outcome, SB_FIGURE_FINITE, bad, 0);
    }
    sb_image_free(&image);
    sb_case_task_free(env, &picture);
    return good;
}
