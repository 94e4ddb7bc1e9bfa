// shadebench gate: from options to two sides.
#include <stdlib.h>
#include <string.h>

#include "assemble/platform.h"
#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/gate.h"
#include "cli/results.h"
#include "cli/shader_tree.h"
#include "cli/write.h"
#include "measure/interrupt.h"
#include "scene/scene.h"

struct sides {
    struct sb_options options[SB_SIDES];
    struct sb_suite suite[SB_SIDES];
    const char *said[SB_SIDES]; // what each is, in words
    const char *data, *dir;
    bool pinned;
    struct sb_gate_params params;
};

// --- what the sides are --------------------------------------------------------------------------

// A gate stops when it is sure, not when an interval is narrow. What a suite says of that is for `run`.
static bool check_settings(const struct sb_options *options, struct sb_error *err)
{
    static const char *const valid[] = {"budget", "batch_ms", "batch", "seed"};
    enum { VALID = sizeof valid / sizeof *valid };
    for (int i = 0; i < options->setting.count; i++) {
        int v = 0;
        while (v < VALID && strcmp(options->setting.item[i].axis, valid[v]) != 0)
            v++;
        if (v == VALID)
            return sb_fail(err, SB_USAGE,
                           "%s says nothing to a gate, which stops where it is sure; "
                           "valid: --budget, --batch-ms, --batch, --seed",
                           options->setting.item[i].origin);
    }
    return true;
}

static bool check_words(const struct sb_options *options, struct sb_error *err)
{
    const bool two = options->base || options->base_set.count ||
                     options->head_set.count || options->base_env.count ||
                     options->head_env.count;
    if (options->word_count > 1)
        return sb_fail(err, SB_USAGE, "gate takes one suite; \"%s\" is one too many",
                       options->word[1]);
    if (options->selftest && two)
        return sb_fail(
            err, SB_USAGE,
            "--selftest holds base against itself: leave out what makes two sides");
    if (!two && !options->selftest)
        return sb_fail(err, SB_USAGE,
                       "gate holds head against base: --base SHADERS (a folder or a git "
                       "revision), --base-set AXIS=VALUE, --base-env NAME=VALUE, or "
                       "--selftest");
    if (options->bisect && options->selftest)
        return sb_fail(err, SB_USAGE,
                       "--bisect wants verdicts, and --selftest gives none");
    return sb_gate_cases_check(options->cases, err) && check_settings(options, err);
}

// --base-env NAME=VALUE, as the runner takes it.
static void take_environment(const struct sb_assignments *given,
                             struct sb_context_params *context, struct sb_arena *arena)
{
    const char **setting =
        sb_arena_alloc(arena, ((size_t)given->count + 1) * sizeof(char *));
    for (int i = 0; i < given->count; i++)
        setting[i] =
            sb_arena_printf(arena, "%s=%s", given->item[i].axis, given->item[i].values);
    context->environment = setting;
    context->environment_count = given->count;
}

static bool add_assignments(struct sb_assignments *list,
                            const struct sb_assignments *more, struct sb_error *err)
{
    for (int i = 0; i < more->count; i++) {
        if (list->count == SB_ASSIGNMENTS_MAX)
            return sb_fail(err, SB_USAGE, "more than %d values are set",
                           SB_ASSIGNMENTS_MAX);
        list->item[list->count++] = more->item[i];
    }
    return true;
}

// More triangles are another scene, or a better picture of the same one.
static bool is_quality(const struct sb_axis *axis, const char *scene)
{
    return axis->flags & SB_TRUTH && sb_scene_analytic(scene);
}

// What is drawn must be the same: else neither times nor pictures can be held against each other.
static bool same_scenes(const struct sides *sides, struct sb_error *err)
{
    const struct sb_axes *axes = &sides->suite[SB_HEAD].axes;
    for (int i = 0; i < sides->suite[SB_HEAD].entry_count; i++) {
        const struct sb_plan_entry *base = &sides->suite[SB_BASE].entry[i],
                                   *head = &sides->suite[SB_HEAD].entry[i];
        for (int a = 0; a < axes->count; a++)
            if (axes->row[a].kind == SB_SCENE &&
                !is_quality(&axes->row[a], head->scene) &&
                base->variant.value[a] != head->variant.value[a])
                return sb_fail(err, SB_BAD_INPUT,
                               "base and head have another %s, so they draw two scenes; "
                               "what may differ is quality and implementation "
                               "(shadebench list axes)",
                               axes->row[a].name);
    }
    return true;
}

static bool load_suites(struct sides *sides, const struct sb_options *options,
                        struct sb_arena *arena, struct sb_error *err)
{
    // Two variants are a plan of their own; for those of a suite, name it.
    const bool planned =
        sb_cli_is_planned(options) || options->base_set.count || options->head_set.count;
    const char *word = options->word_count ? options->word[0] : planned ? NULL : "ci";
    const char *path = word ? sb_cli_suite_path(word, sides->data, arena, err) : NULL;
    if (word && !path)
        return false;
    const struct sb_assignments *more[SB_SIDES] = {&options->base_set,
                                                   &options->head_set};
    for (int side = 0; side < SB_SIDES; side++) {
        sides->options[side] = *options;
        if (!add_assignments(&sides->options[side].set, more[side], err) ||
            !sb_cli_load_suite(&sides->options[side], path, sides->data,
                               &sides->suite[side], err))
            return false;
    }
    const int base = sides->suite[SB_BASE].entry_count,
              head = sides->suite[SB_HEAD].entry_count;
    if (base != head)
        return sb_fail(err, SB_BAD_INPUT,
                       "base has %d variants and head %d, so they make no pairs: what "
                       "--base-set and --head-set set must not be swept",
                       base, head);
    return same_scenes(sides, err);
}

static bool find_folders(struct sides *sides, const struct sb_options *options,
                         struct sb_arena *arena, struct sb_error *err)
{
    const char *own =
        options->shaders ? options->shaders : sb_path_join(arena, sides->data, "shaders");
    const char *given[SB_SIDES] = {options->base, options->head};
    for (int side = 0; side < SB_SIDES; side++) {
        const char *name = side == SB_BASE ? "base-shaders" : "head-shaders";
        const char *folder =
            given[side] ? sb_shader_tree(given[side], own, sides->dir, name, arena, err)
                        : own;
        if (!folder)
            return false;
        sides->params.side[side].shaders = folder;
        sides->said[side] = given[side] ? given[side] : folder;
    }
    return true;
}

static const char *describe(const struct sides *sides, const struct sb_options *options,
                            int side, struct sb_arena *arena)
{
    enum { LISTS = 2 };
    const struct sb_assignments *lists[LISTS] = {
        side == SB_BASE ? &options->base_set : &options->head_set,
        side == SB_BASE ? &options->base_env : &options->head_env};
    struct sb_text text = {0};
    if (options->base || options->head)
        sb_text_add(&text, sides->said[side]);
    for (int l = 0; l < LISTS; l++)
        for (int i = 0; i < lists[l]->count; i++)
            sb_text_printf(&text, "%s%s=%s", text.length ? " " : "",
                           lists[l]->item[i].axis, lists[l]->item[i].values);
    if (!text.length)
        sb_text_add(&text, options->selftest && side == SB_HEAD
                               ? "the same with other names"
                               : "as it is");
    const char *said = sb_arena_strdup(arena, text.data);
    sb_text_free(&text);
    return said;
}

static bool find_drivers(struct sides *sides, const struct sb_options *options,
                         struct sb_arena *arena, struct sb_error *err)
{
    const struct sb_assignments *environment[SB_SIDES] = {&options->base_env,
                                                          &options->head_env};
    const char *differs =
        sb_platform_differs(&sides->suite[SB_BASE], &sides->suite[SB_HEAD]);
    if (differs)
        return sb_fail(
            err, SB_BAD_INPUT,
            "base and head have another %s; of what is outside of the shaders, "
            "the environment may differ: --base-env and --head-env",
            differs);
    for (int side = 0; side < SB_SIDES; side++) {
        struct sb_driver_params *driver = &sides->params.side[side].driver;
        if (!sb_cli_driver_params(&sides->options[side], &sides->suite[side], driver,
                                  err))
            return false;
        take_environment(environment[side], &driver->context, arena);
        sides->params.apart |= environment[side]->count > 0;
    }
    if (sides->params.apart && options->in_process)
        return sb_fail(err, SB_USAGE,
                       "--in-process has one environment: leave out --base-env and "
                       "--head-env");
    if (!sb_metric_find(options->metric, &sides->params.metric, err))
        return false;
    sides->pinned = sides->params.metric != SB_METRIC_INSTRUCTIONS &&
                    sb_cli_pin_threads(&sides->suite[SB_BASE]);
    return true;
}

static bool fill_params(struct sides *sides, const struct sb_options *options,
                        const json_t *arguments, struct sb_error *err)
{
    struct sb_gate_params *params = &sides->params;
    params->rule = sb_gate_rule_default(1);
    params->rule.tolerance = sb_metric_rows[params->metric].tolerance;
    if (options->tolerance && !sb_cli_read_share("--tolerance", options->tolerance,
                                                 &params->rule.tolerance, err))
        return false;
    for (int side = 0; side < SB_SIDES; side++)
        params->side[side].suite = &sides->suite[side];
    params->side[SB_HEAD].renamed = options->selftest || options->keep_equal;
    params->keep_equal = options->selftest || options->keep_equal;
    params->selftest = options->selftest;
    params->settings = &sides->suite[SB_HEAD].measure;
    params->data_dir = sides->data;
    params->dir = sides->dir;
    params->arguments = arguments;
    return true;
}

// --- afterwards ----------------------------------------------------------------------------------

static int show(const struct sb_gate_shown *shown)
{
    const struct sb_options *options = shown->options;
    struct sb_arena arena = {0};
    struct sb_export export;
    struct sb_error err = {0};
    // Files first: who reads the table may stop reading.
    sb_gate_export(shown, &arena, &export);
    int code = sb_outputs_write(&options->write, &export);
    if (!sb_export_step_summary(&export, &err))
        code = sb_exit_code_worse(code, sb_cli_fail(&err));
    if (options->json)
        sb_cli_print_json(sb_gate_json(shown));
    else if (!sb_outputs_take_stdout(&options->write))
        sb_gate_print(shown);
    sb_arena_free(&arena);
    return code;
}

// For git bisect run, to which 1 to 127 are "bad", 125 is "cannot be tested" and more ends the
// bisection: so does a command line or folder that is wrong at every commit.
static int bisect_code(int code, const struct sb_error *err)
{
    enum { SKIP = 125 };
    if (sb_status_rows[err->status].exit_code == sb_status_rows[SB_USAGE].exit_code)
        return SB_EXIT_STOP_BISECTION;
    return code > 1 && code < SKIP ? SKIP : code;
}

// Variants of which nothing is known: neither slower nor not, or base had nothing to compare with.
static int count_unjudged(const struct sb_gate_result *result)
{
    int count = result->count[SB_GATE_INCONCLUSIVE];
    for (int i = 0; i < result->row_count; i++)
        count += sb_gate_base_failed(&result->row[i]);
    return count;
}

// A base that is of no use for any variant is of none at any commit.
static bool is_base_lost(const struct sb_gate_result *result)
{
    int failed = 0;
    for (int i = 0; i < result->row_count; i++)
        failed += sb_gate_base_failed(&result->row[i]);
    return failed > 0 && failed == result->row_count - result->count[SB_GATE_SKIPPED];
}

static int judge(struct sides *sides, const struct sb_options *options,
                 struct sb_error *err)
{
    struct sb_gate_result result = {0};
    struct sb_gate_lost lost = {0};
    struct sb_gate_shown shown = {
        .options = options,
        .result = &result,
        .suite = &sides->suite[SB_HEAD],
        .dir = sides->dir,
        .base = sides->said[SB_BASE],
        .head = sides->said[SB_HEAD],
        .pinned = sides->pinned,
    };
    bool good = sb_gate_run(&sides->params, &result, err);
    int code = result.exit_code;
    if (good && options->cases && !result.interrupted) {
        good = sb_gate_cases(&sides->params, options->cases, &lost, err);
        shown.lost = good ? &lost : NULL;
        if (lost.count > 0)
            code = sb_exit_code_worse(code, sb_status_rows[SB_WORSE_PICTURE].exit_code);
    }
    // To git, 0 is "good", which what is not known is not.
    if ((options->fail_on_inconclusive || options->bisect) &&
        (count_unjudged(&result) > 0 || lost.unknown))
        code = sb_exit_code_worse(code, sb_status_rows[SB_INCONCLUSIVE].exit_code);
    if (result.row)
        code = sb_exit_code_worse(code, show(&shown));
    if (!good)
        code = sb_exit_code_worse(code, sb_cli_fail(err));
    if (options->bisect && is_base_lost(&result)) {
        sb_warn("base cannot be judged at all, here or at any other commit");
        code = SB_EXIT_STOP_BISECTION;
    }
    sb_gate_lost_free(&lost);
    sb_gate_result_free(&result);
    return code;
}

// As git bisect run asks, several gates may begin within a second.
static const char *default_dir(struct sb_arena *arena)
{
    char now[32];
    sb_timestamp_name(now);
    const char *dir = sb_arena_printf(arena, "shadebench-results/gate-%s", now);
    const char *free_dir = dir;
    for (int i = 2; sb_dir_exists(free_dir); i++)
        free_dir = sb_arena_printf(arena, "%s-%d", dir, i);
    return free_dir;
}

int sb_cmd_gate(const struct sb_options *options, int argc, char **argv)
{
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sides *sides = sb_alloc(sizeof *sides);
    int code;
    json_t *arguments = sb_cli_arguments_json(argc, argv, &err);
    sides->data = sb_data_dir(&arena, options->data, &err);
    sides->dir = options->output ? options->output : default_dir(&arena);
    sb_interrupt_install();
    sb_results_warn_gate(sides->dir);
    if (arguments && sides->data && check_words(options, &err) &&
        sb_outputs_check(options, &err) && load_suites(sides, options, &arena, &err) &&
        find_folders(sides, options, &arena, &err) &&
        find_drivers(sides, options, &arena, &err) &&
        fill_params(sides, options, arguments, &err)) {
        for (int side = 0; side < SB_SIDES; side++)
            sides->said[side] = describe(sides, options, side, &arena);
        code = judge(sides, options, &err);
    } else {
        code = sb_cli_fail(&err);
    }
    if (options->bisect)
        code = bisect_code(code, &err);
    for (int side = 0; side < SB_SIDES; side++)
        sb_suite_free(&sides->suite[side]);
    free(sides);
    json_decref(arguments);
    sb_arena_free(&arena);
    return code;
}
