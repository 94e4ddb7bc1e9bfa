// Cases about what compilers make of a shader.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assemble/assemble.h"
#include "cases/accumulation.h"
#include "cases/own.h"
#include "math/random.h"

// --- contraction --------------------------------------------------------------------------

// Points before lights that stand about them.
static void scatter(struct sb_points *points)
{
    struct sb_random random = sb_random_seed(21);
    for (int p = 0; p < 500; p++) {
        struct sb_point *point = sb_points_add(points);
        for (int c = 0; c < 3; c++) {
            point->position[c] = (float)(sb_random_unit(&random) - 0.5);
            point->normal[c] = (float)((c == 2) + sb_random_unit(&random) - 0.5);
            point->material.diffuse[c] = (float)(0.2 * sb_random_unit(&random));
        }
        for (int i = 0; i < points->lights; i++) {
            struct sb_light *light = sb_points_light(points, p, i);
            for (int c = 0; c < 3; c++)
                light->position[c] = (float)((c == 2) + sb_random_unit(&random));
            light->linear = (float)sb_random_unit(&random);
            light->quadratic = (float)sb_random_unit(&random);
        }
    }
}

static bool tell(const struct sb_case_env *env, const struct sb_case_setting *setting,
                 const struct sb_points *points, struct sb_unit_told *told,
                 struct sb_error *err)
{
    struct sb_unit unit = {0};
    const bool good = sb_case_unit_open(&unit, env, setting->variant, err) &&
                      sb_unit_light(&unit, points, points->lights, told, err);
    sb_unit_close(&unit);
    return good;
}

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double count_other_bits(const struct sb_image *a, const struct sb_image *b)
{
    double other = 0;
    for (int i = 0; i < a->width * a->height * a->channels; i++)
        other += bits_of(a->data[i]) != bits_of(b->data[i]);
    return other;
}

static double count_all_other_bits(const struct sb_unit_told told[2], int lights)
{
    double other = count_other_bits(&told[0].inputs, &told[1].inputs) +
                   count_other_bits(&told[0].frame, &told[1].frame);
    for (int i = 0; i < lights; i++)
        other += count_other_bits(&told[0].light[i], &told[1].light[i]);
    return other;
}

// The shader is compiled and asked twice: its bits repeat, and what the compiler was free to do
// leaves it within the case's bounds. Equal bits of two shaders that are equal in algebra only,
// nobody may ask for.
bool sb_case_run_repeat(const struct sb_case_env *env, const struct sb_case *it,
                        const struct sb_case_setting *setting, struct sb_outcome *outcome,
                        struct sb_error *err)
{
    struct sb_points points;
    struct sb_unit_told told[2] = {0};
    struct sb_points_truth truth = {0};
    sb_points_init(&points, setting->variant);
    scatter(&points);
    if (sb_case_precisions[setting->precision].half)
        sb_points_round(&points);
    const bool good = tell(env, setting, &points, &told[0], err) &&
                      tell(env, setting, &points, &told[1], err);
    if (good) {
        sb_points_truth_make(&points, setting->variant, &truth);
        const struct sb_judged judged = {it, setting, &points, &told[0], &truth};
        sb_outcome_measured(outcome, SB_FIGURE_OWN,
                            count_all_other_bits(told, points.lights), 0);
        for (int i = 0; it->criterion[i].figure != SB_FIGURE_NONE; i++) {
            int point;
            sb_outcome_measured(
                outcome, it->criterion[i].figure,
                sb_judge(&judged, &it->criterion[i], &point),
                sb_criterion_bound(&it->criterion[i], setting->precision));
        }
    }
    sb_points_truth_free(&truth);
    sb_unit_told_free(&told[0]);
    sb_unit_told_free(&told[1]);
    sb_points_free(&points);
    return good;
}

// --- link-precision -----------------------------------------------------------------------

// A shader that reads a uniform of the other stage, of a precision of its own: GLSL from before
// "void main()" and from behind its "{".
static void put_rival(const char *text, struct sb_text *out)
{
    const char *start = strstr(text, "void main()");
    const char *body = start ? strchr(start, '{') : NULL;
    if (!body) {
        sb_text_add(out, text);
        return;
    }
    sb_text_printf(out, "%.*s", (int)(start - text), text);
    sb_text_add(out, "uniform mediump vec3 u_camera_position;\n");
    sb_text_printf(out, "%.*s", (int)(body + 1 - start), start);
    sb_text_add(out, " gl_PointSize = u_camera_position.x;");
    sb_text_add(out, body + 1);
}

static bool run_rival(const struct sb_case_env *env,
                      const struct sb_case_setting *setting, struct sb_outcome *outcome,
                      struct sb_error *err)
{
    struct sb_assembly assembly = {0};
    struct sb_prepared prepared = {0};
    struct sb_text text = {0};
    const struct sb_driver *driver = env->driver;
    const struct sb_assemble_params params = {
        .data_dir = env->data_dir,
        .shaders = env->shaders,
        .axes = env->axes,
        .scene = "sphere",
        .variant = setting->variant,
        .caps = &driver->caps,
        .id = sb_case_next_job(),
    };
    const bool good = sb_assemble(&params, &assembly, err);
    if (good) {
        put_rival(assembly.program[0].vertex, &text);
        assembly.program[0].vertex = sb_text_get(&text);
        const bool links = driver->fns->prepare(driver->runner, &assembly.job, &prepared);
        sb_outcome_measured(outcome, SB_FIGURE_OWN, !links, 0);
        if (links)
            driver->fns->release(driver->runner, assembly.job.id);
        else if (prepared.log)
            sb_text_printf(&outcome->note, "%.*s", (int)strcspn(prepared.log, "\n"),
                           prepared.log);
    }
    free(prepared.log);
    sb_text_free(&text);
    sb_assembly_free(&assembly);
    return good;
}

// Naive: one uniform, two declarations. Robust: the shipped shaders, which declare no uniform in
// both stages, in every precision and with lights in uniforms and in blocks.
bool sb_case_run_links(const struct sb_case_env *env, const struct sb_case *it,
                       const struct sb_case_setting *setting, struct sb_outcome *outcome,
                       struct sb_error *err)
{
    static const char *const variants[] = {
        "stage=fragment precision=highp",
        "stage=fragment precision=mediump storage=ubo_std140",
        "stage=fragment precision=lowp space=view",
        "stage=fragment precision=mixed hoist=per_light",
        "stage=fragment precision=mixed storage=ubo_shared space=view",
        "stage=vertex precision=highp storage=ubo_std140",
        "stage=vertex precision=mediump space=view hoist=per_light",
        "stage=vertex precision=lowp",
        "stage=vertex precision=mixed storage=arrays",
    };
    int failed = 0;
    if (setting->form == SB_CASE_NAIVE)
        return run_rival(env, setting, outcome, err);
    for (size_t i = 0; i < sizeof variants / sizeof *variants; i++) {
        struct sb_variant variant;
        struct sb_case_task picture = {0};
        struct sb_error why = {0};
        if (!sb_case_variant(env, it, setting->form, setting->precision, false,
                             variants[i], &variant, err))
            return false;
        if (!sb_case_task_open(env, &variant, "sphere", &picture, &why) && failed++ == 0)
            sb_text_printf(&outcome->note, "%s: %s", variants[i], why.text);
        sb_case_task_free(env, &picture);
    }
    sb_outcome_measured(outcome, SB_FIGURE_OWN, failed, 0);
    return true;
}
