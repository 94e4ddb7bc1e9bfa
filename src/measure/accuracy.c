#include "measure/accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/heat.h"
#include "measure/explain.h"
#include "reference/share.h"

// Of the largest reference, pixels times sb_ref_work: its three pictures take some two seconds on
// two cores. And pixels, of which a page of the probe takes 64 bytes each.
static const double WORK_MAX = 2e7, PIXELS_MAX = 1 << 21;

// How far from going the other way a branch may have been in double, in cosines, for rounding to
// explain that it went there: some hundred units in the last place.
static double decision_bound(int bits)
{
    return ldexp(1, bits > 11 ? -14 : -5);
}

enum { TERM_LIGHTS = 64 }; // that are looked at for the term that went wrong

// All that is drawn of a task, at one size.
struct pictures {
    struct sb_image own, wide, single, geometry, probe_colour, inputs, frame, maps;
    int full_width; // of the task's own picture
};

static void pictures_free(struct pictures *pictures)
{
    sb_image_free(&pictures->own);
    sb_image_free(&pictures->wide);
    sb_image_free(&pictures->single);
    sb_image_free(&pictures->geometry);
    sb_image_free(&pictures->probe_colour);
    sb_image_free(&pictures->inputs);
    sb_image_free(&pictures->frame);
    sb_image_free(&pictures->maps);
}

struct drawing {
    const struct sb_task *task;
    const struct sb_driver *driver;
    int width, height; // 0: the task's own
    bool inputs_only;  // of the two probes, that which tells less
    bool single;       // one sample a pixel
};

static bool draw(const struct drawing *drawing, enum sb_image_kind kind,
                 enum sb_probe_page page, bool wide, struct sb_image *image,
                 struct sb_error *err)
{
    const struct sb_image_request request = {
        .job = drawing->task->assembly.job.id,
        .kind = kind,
        .page = page,
        .width = drawing->width,
        .height = drawing->height,
        .wide = wide,
        .single = drawing->single,
        .inputs_only = drawing->inputs_only,
    };
    return drawing->driver->fns->image(drawing->driver->runner, &request, image, err);
}

static bool is_too_large(int width, int height, double work)
{
    const double pixels = (double)width * height;
    return pixels > PIXELS_MAX || pixels * work > WORK_MAX;
}

// The picture in its own target, at its own size or, where the reference would take too long, at
// the half, a quarter … of it.
static bool draw_own(struct drawing *drawing, struct pictures *pictures,
                     struct sb_error *err)
{
    const double work = sb_ref_work(&drawing->task->assembly.job.variant);
    if (!draw(drawing, SB_IMAGE_COLOUR, 0, false, &pictures->own, err))
        return false;
    int width = pictures->own.width, height = pictures->own.height;
    pictures->full_width = width;
    while (width > 64 && height > 64 && is_too_large(width, height, work)) {
        width /= 2;
        height /= 2;
    }
    drawing->width = width;
    drawing->height = height;
    if (width == pictures->full_width)
        return true;
    sb_image_free(&pictures->own);
    return draw(drawing, SB_IMAGE_COLOUR, 0, false, &pictures->own, err);
}

// The colour as floats: of all samples, and of the one that a probe has.
static bool draw_wide(struct drawing *drawing, struct pictures *pictures,
                      struct sb_error *err)
{
    bool good = draw(drawing, SB_IMAGE_COLOUR, 0, true, &pictures->wide, err);
    if (!good || !sb_ref_mixes_edges(&drawing->task->assembly.job.variant))
        return good;
    drawing->single = true;
    good = draw(drawing, SB_IMAGE_COLOUR, 0, true, &pictures->single, err);
    drawing->single = false;
    return good;
}

static bool draw_pages(const struct drawing *drawing, struct pictures *pictures,
                       struct sb_error *err)
{
    const struct sb_variant *variant = &drawing->task->assembly.job.variant;
    const struct {
        enum sb_probe_page page;
        bool needed;
        struct sb_image *image;
    } pages[] = {
        {SB_PROBE_INPUTS, true, &pictures->inputs},
        {SB_PROBE_FRAME, sb_ref_needs_frame(variant), &pictures->frame},
        {SB_PROBE_MAPS, sb_ref_needs_maps(variant), &pictures->maps},
    };
    for (size_t i = 0; i < sizeof pages / sizeof *pages; i++)
        if (pages[i].needed &&
            !draw(drawing, SB_IMAGE_PROBE, pages[i].page, false, pages[i].image, err))
            return false;
    return true;
}

static bool same_bits(const struct sb_image *a, const struct sb_image *b)
{
    const size_t bytes =
        (size_t)a->width * (size_t)a->height * (size_t)a->channels * sizeof *a->data;
    return memcmp(a->data, b->data, bytes) == 0;
}

// False, with SB_INSTRUMENTATION, where the instrumented program draws another picture.
static bool draws_same(const struct drawing *drawing, struct pictures *pictures,
                       struct sb_error *err)
{
    const struct sb_image *timed =
        pictures->single.data ? &pictures->single : &pictures->wide;
    struct sb_image_difference difference;
    sb_image_free(&pictures->probe_colour);
    if (!draw(drawing, SB_IMAGE_PROBE_COLOUR, 0, true, &pictures->probe_colour, err))
        return false;
    if (same_bits(timed, &pictures->probe_colour))
        return true;
    sb_image_compare(timed, &pictures->probe_colour, &difference);
    return sb_fail(err, SB_INSTRUMENTATION,
                   "the instrumented program draws %ld pixels otherwise, by up to %.3g",
                   difference.pixels, difference.max);
}

enum told { NOTHING, INPUTS, ALL };

// What an instrumented program tells. Where it is less than ALL, *err says why and what is missing;
// with SB_INSTRUMENTATION where the one that tells all draws another picture. A job of several
// programs, or of one that leaves something out, has a twin that lights everything: what its
// lighting is given is what theirs is, and no more is asked.
static enum told draw_probe(struct drawing *drawing, struct pictures *pictures,
                            struct sb_error *err)
{
    struct sb_error other = {0};
    if (drawing->task->assembly.job.lit_count > 0) {
        drawing->inputs_only = true;
        const bool good = draw_pages(drawing, pictures, err);
        drawing->inputs_only = false;
        return good ? INPUTS : NOTHING;
    }
    if (draws_same(drawing, pictures, err))
        return draw_pages(drawing, pictures, err) ? ALL : NOTHING;
    if (err->status != SB_INSTRUMENTATION)
        return NOTHING;
    drawing->inputs_only = true;
    const bool given =
        draws_same(drawing, pictures, &other) && draw_pages(drawing, pictures, &other);
    drawing->inputs_only = false;
    sb_fail(err, SB_INSTRUMENTATION, "%s: nothing is known of %s", err->text,
            given ? "raw terms and of the driver's branches"
                  : "inputs, raw terms and the driver's branches");
    return given ? INPUTS : NOTHING;
}

// --- the numbers -------------------------------------------------------------------------

// The ideal as it is to be compared with what is seen: where driver and reference show another draw
// there is nothing to compare, and nor is there where several samples mix at an edge.
static void seen_truth(const struct sb_truth *truth, const struct pictures *pictures,
                       bool interior, struct sb_image64 *seen)
{
    const struct sb_ref_ground *ground = truth->ground;
    sb_image64_init(seen, ground->width, ground->height, 3);
    for (int y = 0; y < ground->height; y++)
        for (int x = 0; x < ground->width; x++) {
            const long at = (long)y * ground->width + x;
            const float *geometry = sb_image_at(&pictures->geometry, x, y);
            const float *own = sb_image_at(&pictures->own, x, y);
            const bool same = (int)geometry[0] - 1 == ground->cover[at].draw &&
                              (!interior || ground->cover[at].draw < 0 ||
                               sb_ref_ground_interior(ground, x, y));
            for (int c = 0; c < 3; c++)
                seen->data[3 * at + c] = same && truth->ideal->valid[at]
                                             ? truth->ideal->colour.data[3 * at + c]
                                             : (double)own[c];
        }
}

static void find_term(struct sb_task *task, const struct drawing *drawing,
                      struct sb_truths *truths)
{
    const struct sb_split *split = &task->accuracy.split;
    struct sb_explanation explanation = {0};
    struct sb_error ignored = {0};
    const struct sb_explain_params params = {
        .task = task,
        .driver = drawing->driver,
        .truths = truths,
        .width = drawing->width,
        .height = drawing->height,
        .x = split->part[SB_BY_ARITHMETIC].x,
        .y = split->part[SB_BY_ARITHMETIC].y,
        .light_max = TERM_LIGHTS,
    };
    if (split->part[SB_BY_ARITHMETIC].max > 0 &&
        sb_explain(&params, &explanation, &ignored) && explanation.wrong_term >= 0)
        task->accuracy.term = sb_term_rows[explanation.wrong_term].name;
    sb_explanation_free(&explanation);
}

// The picture drawn, and its error by source. `no_probe` says why not all is known of what the
// driver had; false: nothing is known at all, and *err says why.
static bool measure_split(struct drawing *drawing, struct sb_truths *truths,
                          struct pictures *pictures, struct sb_truth *truth,
                          struct sb_split *split, struct sb_error *no_probe,
                          struct sb_error *err)
{
    const struct sb_variant *variant = &drawing->task->assembly.job.variant;
    struct sb_ref_picture given = {0};
    if (!draw_own(drawing, pictures, err) || !draw_wide(drawing, pictures, err) ||
        !draw(drawing, SB_IMAGE_GEOMETRY, 0, false, &pictures->geometry, err) ||
        !sb_truths_get(truths, drawing->task, drawing->width, drawing->height, truth,
                       err))
        return false;
    const enum told told = draw_probe(drawing, pictures, no_probe);
    const struct sb_ref_given inputs = {
        .geometry = &pictures->geometry,
        .inputs = &pictures->inputs,
        .frame = pictures->frame.data ? &pictures->frame : NULL,
        .maps = pictures->maps.data ? &pictures->maps : NULL,
    };
    if (told != NOTHING)
        sb_ref_given(truth->ground, variant, &inputs, &given);
    const struct sb_split_params params = {
        .ground = truth->ground,
        .ideal = truth->ideal,
        .model = truth->model,
        .given = told != NOTHING ? &given : NULL,
        .geometry = &pictures->geometry,
        .wide = &pictures->wide,
        .own = &pictures->own,
        .probe = told == ALL ? &pictures->inputs : NULL,
        .decision_bound =
            decision_bound(sb_effective_bits(drawing->task, drawing->driver, NULL)),
        .interior = sb_ref_mixes_edges(variant),
    };
    sb_split_measure(&params, split);
    sb_ref_picture_free(&given);
    return true;
}

static void take_totals(struct sb_task *task, const struct sb_truth *truth,
                        const struct pictures *pictures)
{
    struct sb_accuracy *accuracy = &task->accuracy;
    struct sb_image64 seen = {0};
    const struct sb_metrics_params total = {
        .test = &pictures->own,
        .truth = &truth->ideal->colour,
        .counted = accuracy->split.counted,
    };
    sb_metrics_measure(&total, &accuracy->total);
    seen_truth(truth, pictures, sb_ref_mixes_edges(&task->assembly.job.variant), &seen);
    accuracy->flip = sb_flip_measure(&pictures->own, &seen, SB_FLIP_PPD, NULL);
    accuracy->known = true;
    sb_image64_free(&seen);
}

// Errors over a part of the picture are not those of the picture.
static void note_left_out(struct sb_task *task)
{
    const struct sb_split *split = &task->accuracy.split;
    const double out =
        (double)(split->covered - split->compared) / (double)split->covered;
    if (split->covered > 0 && out > 0.01)
        sb_task_note(task,
                     "%.0f %% of the covered pixels are left out of the errors: branches "
                     "that rounding may take either way, and edges",
                     ceil(100 * out));
}

void sb_accuracy_measure(struct sb_task *task, const struct sb_driver *driver,
                         struct sb_truths *truths)
{
    struct drawing drawing = {.task = task, .driver = driver};
    struct sb_accuracy *accuracy = &task->accuracy;
    struct pictures pictures = {0};
    struct sb_truth truth;
    struct sb_error err = {0}, no_probe = {0};
    if (task->assembly.undefined) // noted already
        return;
    if (!measure_split(&drawing, truths, &pictures, &truth, &accuracy->split, &no_probe,
                       &err)) {
        sb_task_note(task, "no errors: %s", err.text);
        goto done;
    }
    take_totals(task, &truth, &pictures);
    if (drawing.width != pictures.full_width)
        sb_task_note(task, "errors are those of a picture of %d x %d pixels",
                     drawing.width, drawing.height);
    note_left_out(task);
    if (no_probe.status != SB_OK)
        sb_task_note(task, "%s", no_probe.text);
    else if (task->assembly.job.lit_count == 0)
        find_term(task, &drawing, truths);
    if (no_probe.status == SB_INSTRUMENTATION && task->status == SB_OK)
        task->status = SB_INSTRUMENTATION;

done:
    free(accuracy->split.counted);
    accuracy->split.counted = NULL;
    pictures_free(&pictures);
}

bool sb_accuracy_heat(const struct sb_task *task, const struct sb_driver *driver,
                      struct sb_truths *truths, struct sb_image *heat,
                      struct sb_error *err)
{
    struct drawing drawing = {.task = task, .driver = driver};
    struct pictures pictures = {0};
    struct sb_truth truth;
    struct sb_split split = {0};
    struct sb_error no_probe = {0};
    const bool good =
        measure_split(&drawing, truths, &pictures, &truth, &split, &no_probe, err);
    if (good)
        sb_heat_map(
            &(struct sb_heat_params){
                .test = &pictures.own,
                .truth = &truth.ideal->colour,
                .counted = split.counted,
            },
            heat);
    free(split.counted);
    pictures_free(&pictures);
    return good;
}

// --- the row -----------------------------------------------------------------------------

// The model of the parts is the whole variant's: of a job that leaves something out, or lights each
// draw by a program of its own, only the sum is known.
static void fill_split(const struct sb_split *split, bool whole, struct sb_row *row)
{
    row->pixels_compared = split->compared;
    row->pixels_mismatched = split->mismatched;
    if (!whole)
        return;
    if (split->flips >= 0)
        row->decision_flips = split->flips;
    if (split->raw_nonfinite >= 0) {
        row->raw_nonfinite = split->raw_nonfinite;
        row->raw_negative = split->raw_negative;
    }
    row->err_formulation = split->part[SB_BY_FORMULATION].max;
    row->err_interpolation = split->part[SB_BY_INTERPOLATION].max;
    row->err_arithmetic = split->part[SB_BY_ARITHMETIC].max;
    row->err_quantisation = split->part[SB_BY_QUANTISATION].max;
    row->mean_formulation = split->part[SB_BY_FORMULATION].mean;
    row->mean_interpolation = split->part[SB_BY_INTERPOLATION].mean;
    row->mean_arithmetic = split->part[SB_BY_ARITHMETIC].mean;
    row->mean_quantisation = split->part[SB_BY_QUANTISATION].mean;
    row->err_gouraud = split->gouraud;
}

void sb_accuracy_fill(const struct sb_task *task, struct sb_row *row)
{
    const struct sb_metrics *total = &task->accuracy.total;
    if (!task->accuracy.known)
        return;
    fill_split(&task->accuracy.split, task->assembly.job.lit_count == 0, row);
    row->err_term = task->accuracy.term;
    row->flip_mean = task->accuracy.flip.mean;
    row->flip_max = task->accuracy.flip.max;
    if (total->pixels == 0)
        return;
    row->max_err = total->max;
    row->max_err_x = total->max_x;
    row->max_err_y = total->max_y;
    row->p50_err = total->p50;
    row->p99_err = total->p99;
    row->p999_err = total->p999;
    row->rmse = total->rmse;
    row->psnr_db = total->psnr_db;
    row->bias = total->bias;
    row->max_rel_err = total->relative;
    row->jnd1_share = total->jnd1;
    row->jnd2_share = total->jnd2;
    row->jnd1_srgb_share = total->jnd1_srgb;
    row->jnd2_srgb_share = total->jnd2_srgb;
}
