// Asking a case: its variant, its points, and what the driver makes of them.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/judge.h"

// --- the variant --------------------------------------------------------------------------

// "axis=value axis=value"
static bool assign(const struct sb_axes *axes, const char *words,
                   struct sb_variant *variant, struct sb_error *err)
{
    char word[128];
    for (const char *at = words ? words : ""; *at; at += strspn(at, " ")) {
        const size_t length = strcspn(at, " "), name = strcspn(at, "=");
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (name >= length || length >= sizeof word)
            return sb_fail(err, SB_BAD_INPUT, "\"%s\": axis=value is wanted", word);
        word[name] = '\0';
        const int axis = sb_axes_expect(axes, word, err);
        if (axis < 0 || !sb_variant_set(axes, variant, axis, word + name + 1, err))
            return false;
        at += length;
    }
    return true;
}

bool sb_case_variant(const struct sb_case_env *env, const struct sb_case *it,
                     enum sb_case_form form, enum sb_case_precision precision,
                     bool vertex, const char *more, struct sb_variant *variant,
                     struct sb_error *err)
{
    const struct sb_axes *axes = env->axes;
    const char *const words[] = {
        env->driver->caps.gles ? "api=gles" : "api=gl",
        vertex ? "stage=vertex" : "",
        it->given,
        sb_case_precisions[precision].given,
        it->form[form],
        more,
    };
    sb_variant_init(axes, variant);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!assign(axes, words[i], variant, err))
            return false;
    return sb_variant_resolve(axes, variant, err);
}

const char *sb_case_unavailable(const struct sb_case_env *env,
                                enum sb_case_precision precision, bool vertex)
{
    if (precision != SB_CASE_HALF)
        return NULL;
    const struct sb_precision_verdict *verdict =
        sb_driver_precision(env->driver, vertex, SB_CARRIER_ARITHMETIC, 1);
    return verdict && verdict->effective == SB_EFFECTIVE_FP16
               ? NULL
               : "the driver does not compute mediump in half precision; fp16 emulates "
                 "it";
}

// --- points -------------------------------------------------------------------------------

int sb_case_lights_asked(const struct sb_case *it, const struct sb_points *points)
{
    enum { MOST = 8 };
    for (int i = 0; i < SB_CRITERION_MAX; i++)
        if (it->criterion[i].figure != SB_FIGURE_NONE && it->criterion[i].of >= 0)
            return points->lights < MOST ? points->lights : MOST;
    return 0;
}

static bool right_variant(const struct sb_case_env *env, const struct sb_case *it,
                          const struct sb_case_setting *setting, struct sb_variant *right,
                          struct sb_error *err)
{
    *right = *setting->variant;
    return !it->right || (assign(env->axes, it->right, right, err) &&
                          sb_variant_resolve(env->axes, right, err));
}

uint32_t sb_case_next_job(void)
{
    static uint32_t job = 1u << 30; // apart from those of plans
    return job++;
}

bool sb_case_unit_open(struct sb_unit *unit, const struct sb_case_env *env,
                       const struct sb_variant *variant, struct sb_error *err)
{
    const struct sb_unit_params params = {
        .axes = env->axes,
        .variant = variant,
        .driver = env->driver,
        .data_dir = env->data_dir,
        .shaders = env->shaders,
        .id = sb_case_next_job(),
    };
    return sb_unit_open(unit, &params, err);
}

bool sb_case_ask_points(const struct sb_case_env *env, const struct sb_case *it,
                        const struct sb_case_setting *setting, struct sb_points *points,
                        struct sb_outcome *outcome, struct sb_error *err)
{
    struct sb_unit unit = {0};
    struct sb_unit_told told = {0};
    struct sb_points_truth truth = {0};
    struct sb_variant right;
    if (sb_case_precisions[setting->precision].half && !it->keeps_inputs)
        sb_points_round(points);
    const bool good =
        right_variant(env, it, setting, &right, err) &&
        sb_case_unit_open(&unit, env, setting->variant, err) &&
        sb_unit_light(&unit, points, sb_case_lights_asked(it, points), &told, err);
    if (good) {
        sb_points_truth_make(points, &right, &truth);
        const struct sb_judged judged = {it, setting, points, &told, &truth};
        sb_judge_all(&judged, outcome);
    }
    sb_points_truth_free(&truth);
    sb_unit_told_free(&told);
    sb_unit_close(&unit);
    return good;
}

static bool ask_own_points(const struct sb_case_env *env, const struct sb_case *it,
                           const struct sb_case_setting *setting,
                           struct sb_outcome *outcome, struct sb_error *err)
{
    struct sb_points points;
    sb_points_init(&points, setting->variant);
    it->points(&points, setting);
    const bool good = sb_case_ask_points(env, it, setting, &points, outcome, err);
    sb_points_free(&points);
    return good;
}

// --- a case -------------------------------------------------------------------------------

static void not_to_be_had(struct sb_outcome *outcome, enum sb_verdict verdict,
                          const char *why)
{
    outcome->verdict = verdict;
    sb_text_printf(&outcome->note, "%s%s", outcome->note.length ? "; " : "", why);
}

void sb_case_ask(const struct sb_case_env *env, const struct sb_case *it,
                 enum sb_case_form form, enum sb_case_precision precision, bool vertex,
                 struct sb_outcome *outcome)
{
    struct sb_variant variant;
    struct sb_error err = {0};
    const struct sb_case_setting setting = {form, precision, vertex, &variant};
    *outcome = (struct sb_outcome){
        .verdict = SB_VERDICT_NA, .measured = NAN, .bound = NAN, .point = -1};
    const char *why = sb_case_unavailable(env, precision, vertex);
    if (why) {
        not_to_be_had(outcome, SB_VERDICT_NA, why);
        return;
    }
    const bool good =
        sb_case_variant(env, it, form, precision, vertex, NULL, &variant, &err) &&
        (it->run ? it->run(env, it, &setting, outcome, &err)
                 : ask_own_points(env, it, &setting, outcome, &err));
    // What a driver has not is no failure. All else is: a shader that cannot be read, too.
    if (!good)
        not_to_be_had(outcome,
                      err.status == SB_OVER_LIMIT ? SB_VERDICT_NA : SB_VERDICT_FAIL,
                      err.text);
}
