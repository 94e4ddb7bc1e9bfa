// Cases about what is interpolated: pictures of small scenes.
#include <math.h>
#include <stdlib.h>

#include "cases/accumulation.h"
#include "cases/own.h"
#include "measure/accuracy.h"

// --- gouraud-highlight --------------------------------------------------------------------

// In steps of 1/255; where it is not known, or of less than half of what is seen, it is infinite:
// the split passes over what is not finite.
static double steps(const struct sb_split *split, double error)
{
    return isfinite(error) && 2 * split->compared >= split->covered ? 255 * error
                                                                    : INFINITY;
}

static double count_nonfinite(const struct sb_image *image)
{
    double bad = 0;
    for (int i = 0; i < image->width * image->height; i++)
        for (int c = 0; c < 3; c++)
            bad += !isfinite(image->data[i * image->channels + c]);
    return bad;
}

// The corridor, whose triangles are its truth, so that lit per fragment nothing is left but
// arithmetic. `ideal`: it is judged against that; else, lit per vertex, against Gouraud shading in
// double, since what that loses is the model's and not the driver's.
static bool judge_corridor(const struct sb_case_env *env,
                           const struct sb_variant *variant, bool ideal,
                           struct sb_outcome *outcome, struct sb_error *err)
{
    struct sb_case_task picture;
    struct sb_image image = {0};
    struct sb_truths *truths = sb_truths_new(env->axes);
    const bool good =
        sb_case_task_open(env, variant, "plane", &picture, err) &&
        env->driver->fns->image(
            env->driver->runner,
            &(struct sb_image_request){.job = picture.task.assembly.job.id}, &image, err);
    if (good) {
        struct sb_task *task = &picture.task;
        const struct sb_split *split = &task->accuracy.split;
        sb_accuracy_measure(task, env->driver, truths);
        const double raw = split->raw_nonfinite > 0 ? (double)split->raw_nonfinite : 0;
        const double formulation = steps(split, split->part[SB_BY_FORMULATION].max);
        sb_outcome_measured(outcome, SB_FIGURE_FINITE, raw + count_nonfinite(&image), 0);
        if (variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX) {
            const double gouraud = steps(split, split->gouraud);
            sb_outcome_measured(outcome, SB_FIGURE_ABSOLUTE, gouraud, 0.5);
            sb_text_printf(
                &outcome->note,
                "lit per vertex, of Gouraud shading in double it is %.3g steps "
                "off; that is %.3g off the ideal",
                gouraud, formulation);
        }
        if (ideal) {
            sb_outcome_measured(outcome, SB_FIGURE_ABSOLUTE, formulation, 0.5);
            sb_outcome_measured(outcome, SB_FIGURE_ABSOLUTE,
                                steps(split, split->part[SB_BY_ARITHMETIC].max), 0.5);
        }
        if (task->note.length)
            sb_text_printf(&outcome->note, "%s%s", outcome->note.length ? "; " : "",
                           sb_text_get(&task->note));
    }
    sb_image_free(&image);
    sb_case_task_free(env, &picture);
    sb_truths_free(&truths);
    return good;
}

// Robust: the picture that is lit per fragment, and of the one that is lit per vertex the
// arithmetic, whose error is none of the model's.
bool sb_case_run_gouraud(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting,
                         struct sb_outcome *outcome, struct sb_error *err)
{
    struct sb_variant lit_per_vertex;
    return judge_corridor(env, setting->variant, true, outcome, err) &&
           (setting->form == SB_CASE_NAIVE ||
            (sb_case_variant(env, it, setting->form, setting->precision, setting->vertex,
                             "stage=vertex", &lit_per_vertex, err) &&
             judge_corridor(env, &lit_per_vertex, false, outcome, err)));
}

// --- msaa-extrapolation -------------------------------------------------------------------

static bool draw(const struct sb_case_env *env, const struct sb_variant *variant,
                 const struct sb_image_request *asked, struct sb_image *image,
                 struct sb_image *geometry, struct sb_error *err)
{
    struct sb_case_task picture;
    struct sb_image_request request = *asked;
    bool good = sb_case_task_open(env, variant, "sphere", &picture, err);
    request.job = picture.task.assembly.job.id;
    good = good && env->driver->fns->image(env->driver->runner, &request, image, err);
    request.kind = SB_IMAGE_GEOMETRY;
    good = good && (!geometry || env->driver->fns->image(env->driver->runner, &request,
                                                         geometry, err));
    sb_case_task_free(env, &picture);
    return good;
}

// Do all eight neighbours show the same triangle? Then so do all samples.
static bool is_inside(const struct sb_image *geometry, int x, int y)
{
    const float *here = sb_image_at(geometry, x, y);
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++) {
            if (u < 0 || v < 0 || u >= geometry->width || v >= geometry->height)
                return false;
            const float *there = sb_image_at(geometry, u, v);
            if (there[0] != here[0] || there[1] != here[1])
                return false;
        }
    return here[0] > 0;
}

// The largest difference, in steps of 1/255, where a pixel lies in one triangle; infinity where
// either is not finite, and where there is no such pixel.
static double compare_inside(const struct sb_image *a, const struct sb_image *b,
                             const struct sb_image *geometry)
{
    double worst = -1;
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++)
            for (int c = 0; c < 3 && is_inside(geometry, x, y); c++) {
                const double error =
                    255 * fabs((double)sb_image_at(a, x, y)[c] - sb_image_at(b, x, y)[c]);
                if (!(error <= worst))
                    worst = isfinite(error) ? error : INFINITY;
            }
    return worst < 0 ? INFINITY : worst;
}

// The picture of four samples must have nothing below 0. Its output cuts that off, and would make
// 0 of a NaN too: so it is held, inside of triangles, against one of a sample at each centre, as
// floats and with nothing cut off, where no light is extrapolated.
bool sb_case_run_extrapolation(const struct sb_case_env *env, const struct sb_case *it,
                               const struct sb_case_setting *setting,
                               struct sb_outcome *outcome, struct sb_error *err)
{
    struct sb_variant raw;
    struct sb_image image = {0}, centre = {0}, geometry = {0};
    const bool good =
        sb_case_variant(env, it, setting->form, setting->precision, setting->vertex,
                        "f_output=naive", &raw, err) &&
        draw(env, setting->variant, &(struct sb_image_request){0}, &image, NULL, err) &&
        draw(env, &raw, &(struct sb_image_request){.wide = true, .single = true}, &centre,
             &geometry, err);
    if (good) {
        double bad = count_nonfinite(&centre);
        for (int i = 0; i < image.width * image.height; i++)
            for (int c = 0; c < 3; c++) {
                const float value = image.data[i * image.channels + c];
                bad += !(isfinite(value) && value >= 0);
            }
        sb_outcome_measured(outcome, SB_FIGURE_FINITE, bad, 0);
        sb_outcome_measured(outcome, SB_FIGURE_ABSOLUTE,
                            compare_inside(&image, &centre, &geometry), 1);
    }
    sb_image_free(&image);
    sb_image_free(&centre);
    sb_image_free(&geometry);
    return good;
}
