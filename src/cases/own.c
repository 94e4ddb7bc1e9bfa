#include "cases/own.h"

#include <math.h>
#include <string.h>

// How near to failing, as sb_judge_all ranks them: above 1 it fails. A quotient, since with a bound
// of 0 products of any two figures are equal. NaN compares with nothing, and is as wrong as can be.
static double strain_of(double measured, double bound)
{
    if (measured <= bound)
        return bound > 0 ? measured / bound : 0;
    return bound > 0 && isfinite(measured) ? measured / bound : INFINITY;
}

void sb_outcome_measured(struct sb_outcome *outcome, enum sb_figure figure,
                         double measured, double bound)
{
    const double strain = strain_of(measured, bound);
    const bool first = isnan(outcome->bound);
    if (!first && (outcome->verdict == SB_VERDICT_FAIL ||
                   strain <= strain_of(outcome->measured, outcome->bound)))
        return;
    outcome->verdict = strain > 1 ? SB_VERDICT_FAIL : SB_VERDICT_PASS;
    outcome->figure = figure;
    outcome->of = SB_OF_COLOUR;
    outcome->measured = measured;
    outcome->bound = bound;
}

// --- the upload path ----------------------------------------------------------------------

// Drops the points that no scene may have; *first is why the first of them may not.
static int drop_refused(struct sb_points *points, struct sb_error *first)
{
    const size_t lights = (size_t)points->lights;
    int kept = 0, refused = 0;
    for (int p = 0; p < points->count; p++) {
        struct sb_points one = *points;
        struct sb_error err = {0};
        one.point = &points->point[p];
        one.light = &points->light[(size_t)p * lights];
        one.count = 1;
        if (!sb_points_validate(&one, &err)) {
            if (refused++ == 0)
                *first = err;
            continue;
        }
        points->point[kept] = points->point[p];
        memmove(&points->light[(size_t)kept * lights], one.light,
                lights * sizeof *one.light);
        kept++;
    }
    points->count = kept;
    return refused;
}

bool sb_case_run_upload(const struct sb_case_env *env, const struct sb_case *it,
                        const struct sb_case_setting *setting, struct sb_outcome *outcome,
                        struct sb_error *err)
{
    struct sb_points points;
    struct sb_error why = {0};
    int refused = 0;
    bool good = true;
    sb_points_init(&points, setting->variant);
    it->points(&points, setting);
    if (setting->form == SB_CASE_ROBUST)
        refused = drop_refused(&points, &why);
    if (points.count > 0)
        good = sb_case_ask_points(env, it, setting, &points, outcome, err);
    else
        outcome->verdict = SB_VERDICT_REFUSED;
    if (refused > 0)
        sb_text_printf(&outcome->note, "%d of %d are refused: %s", refused,
                       refused + points.count, why.text);
    sb_points_free(&points);
    return good;
}

// --- tasks --------------------------------------------------------------------------------

bool sb_case_task_open(const struct sb_case_env *env, const struct sb_variant *variant,
                       const char *scene, struct sb_case_task *one, struct sb_error *err)
{
    *one = (struct sb_case_task){
        .suite = {.name = "verify", .axes = *env->axes},
        .entry = {.scene = scene, .variant = *variant, .id = (char *)"verify"},
    };
    one->task.entry = &one->entry;
    const struct sb_prepare_params params = {
        .suite = &one->suite,
        .driver = env->driver,
        .data_dir = env->data_dir,
        .shaders = env->shaders,
    };
    sb_task_prepare(&one->task, &params, sb_case_next_job());
    return one->task.loaded ||
           sb_fail(err, one->task.status, "%s", sb_text_get(&one->task.note));
}

void sb_case_task_free(const struct sb_case_env *env, struct sb_case_task *one)
{
    sb_task_free(&one->task, env->driver);
}
