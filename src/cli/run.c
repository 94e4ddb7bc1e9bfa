// shadebench run: measures a suite.
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "assemble/ablate.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/expect.h"
#include "cli/platforms.h"
#include "cli/report.h"
#include "cli/results.h"
#include "cli/write.h"
#include "export/from_results.h"
#include "measure/interrupt.h"
#include "measure/run.h"
#include "results/store.h"

// What a folder holds was measured with one plan on one driver; another is another run.
static bool check_resume(const struct sb_options *now, struct sb_error *err)
{
    const struct sb_assignments lists[] = {now->set, now->sweep, now->cross};
    const struct {
        const char *name, *value;
    } texts[] = {
        {"--scene", now->scene},
        {"--preset", now->preset},
        {"--output", now->output},
        {"--timer", now->timer},
        {"--device", now->device},
        {"--shaders", now->shaders},
        {"--dump", now->dump},
        {"the suite", now->word[0]},
        {"--program-cache", now->program_cache},
        {"--platform", now->platform},
    };
    const char *what = now->images ? "--images" : NULL, *value = "";
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (lists[i].count)
            what = lists[i].item[0].origin;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (texts[i].value) {
            what = texts[i].name;
            value = texts[i].value;
        }
    return !what ||
           sb_fail(err, SB_USAGE,
                   "--resume goes on with the plan and the driver of the folder: "
                   "leave out %s%s%s, or start anew",
                   what, *value ? " " : "", value);
}

// Who draws may be another than at first: the one of then may be what has stopped the run. The driver
// must be the same, which is checked.
static void take_worker(const struct sb_options *now, struct sb_options *options,
                        json_t *arguments)
{
    if (now->worker) {
        options->worker = now->worker;
        json_array_append_new(arguments, json_sprintf("--worker=%s", now->worker));
    }
    if (now->worker_limit) {
        options->worker_limit = now->worker_limit;
        json_array_append_new(arguments,
                              json_sprintf("--worker-limit=%s", now->worker_limit));
    }
    if (now->in_process && !options->in_process) {
        options->in_process = true;
        json_array_append_new(arguments, json_string("--in-process"));
    }
}

// --resume: the options of the first start, read from run.json, with those of now over them.
static bool load_earlier_options(const struct sb_options *now, struct sb_options *options,
                                 json_t **arguments, struct sb_arena *arena,
                                 struct sb_error *err)
{
    const struct sb_command *command = NULL;
    for (int i = 0; i < sb_command_count; i++)
        if (sb_commands[i].run == sb_cmd_run)
            command = &sb_commands[i];
    if (!check_resume(now, err))
        return false;
    json_t *run = sb_store_read_run(now->resume, err);
    if (!run)
        return false;
    *arguments = json_incref(json_object_get(run, "arguments"));
    char *words[2 * SB_ARGUMENTS_MAX];
    int count = 0;
    size_t i;
    const json_t *word;
    json_array_foreach(*arguments, i,
                       word) if (count < 2 * SB_ARGUMENTS_MAX && json_is_string(word))
        words[count++] = sb_arena_strdup(arena, json_string_value(word));
    json_decref(run);
    if (!sb_options_parse(command, count, words, options, arena, err))
        return false;
    options->resume = options->output = now->resume;
    // How to tell it is asked anew each time.
    options->json = now->json;
    options->write = now->write;
    options->quiet = now->quiet;
    options->check |= now->check;
    options->fail_on_inconclusive |= now->fail_on_inconclusive;
    sb_log_set_level(now->quiet     ? SB_LOG_QUIET
                     : now->verbose ? SB_LOG_VERBOSE
                                    : SB_LOG_NORMAL);
    for (int s = 0; s < now->setting.count && options->setting.count < SB_ASSIGNMENTS_MAX;
         s++) {
        const struct sb_assignment *setting = &now->setting.item[s];
        options->setting.item[options->setting.count++] = *setting;
        // For run.json, and so for the processes that follow.
        json_array_append_new(*arguments,
                              json_sprintf("--%s=%s", setting->axis, setting->values));
    }
    take_worker(now, options, *arguments);
    if (now->data)
        options->data = now->data;
    return true;
}

static const char *results_dir(const struct sb_options *options,
                               const struct sb_suite *suite, struct sb_arena *arena)
{
    char now[32];
    if (options->output)
        return options->output;
    sb_timestamp_name(now);
    return sb_arena_printf(arena, "shadebench-results/%s-%s", suite->name, now);
}

// The next process of --processes N: this program again, with a fresh address space, driver
// and JIT. It appends to the same folder; the last one prints the table.
static int next_process(const char *dir, const struct sb_options *options,
                        struct sb_error *err)
{
    struct sb_arena arena = {0};
    char *program = sb_executable(&arena, err);
    char *words[64] = {program, (char *)"run", (char *)"--resume", (char *)dir};
    int count = 4;
    if (options->json)
        words[count++] = (char *)"--json";
    if (options->quiet)
        words[count++] = (char *)"--quiet";
    if (options->check) // given now, it is not among the arguments of the first start
        words[count++] = (char *)"--check";
    if (options->fail_on_inconclusive)
        words[count++] = (char *)"--fail-on-inconclusive";
    if (options->data) {
        words[count++] = (char *)"--data";
        words[count++] = (char *)options->data;
    }
    for (int i = 0; i < options->write.count; i++) {
        words[count++] = (char *)"--write";
        words[count++] = (char *)options->write.item[i].word;
    }
    fflush(NULL);
    sb_interrupt_hold();
    if (sb_interrupted()) {
        sb_arena_free(&arena);
        return sb_status_rows[SB_INTERRUPTED].exit_code;
    }
    if (program) {
        execv(program, words);
        sb_fail(err, SB_INTERNAL, "%s: %s", program, strerror(errno));
    }
    sb_arena_free(&arena);
    return sb_cli_fail(err);
}

static void print_head(const struct sb_suite *suite, const struct sb_row *row,
                       bool same_kind, double drift)
{
    if (suite->about && suite->about[0])
        printf("%s: %s\n", suite->name, suite->about);
    printf("driver: %s, %s\n", row->renderer, row->version);
    if (!isfinite(row->timer_error)) {
        printf("timer: %s; pictures and errors alone, nothing was timed\n\n",
               row->timer_source);
        return;
    }
    printf("timer: %s, within %.1f %% of the wall clock of long drained batches\n",
           row->timer_source, 100 * row->timer_error);
    if (!same_kind)
        printf("±: 95 %%, within a run or between processes (ci_kind of each row)\n");
    else if (row->ci_kind)
        printf("±: %s\n", row->ci_kind);
    printf("levels drifted by up to %.1f %% within a process%s\n\n", 100 * drift,
           row->processes > 1 ? ""
                              : "; between processes they may by more: --processes 3");
}

// `expected` is NULL where nothing was judged.
static void print_results(const struct sb_options *options, const struct sb_suite *suite,
                          const struct sb_run_result *result,
                          const struct sb_expected *expected, const char *dir,
                          bool written)
{
    if (options->json) {
        json_t *object = json_object();
        json_object_set_new(object, "dir", json_string(dir));
        json_object_set_new(object, "interrupted", json_boolean(result->interrupted));
        json_object_set_new(object, "rows",
                            sb_report_json(&suite->axes, result->row, result->row_count));
        if (expected)
            json_object_set_new(object, "expected", sb_cli_expect_json(expected));
        sb_cli_print_json(object);
        return;
    }
    const struct sb_row *shown = result->row;
    bool same_kind = true;
    double drift = 0;
    for (int i = 0; i < result->row_count; i++) {
        const struct sb_row *row = &result->row[i];
        if (!shown->ci_kind)
            shown = row;
        else if (row->ci_kind)
            same_kind &= strcmp(row->ci_kind, shown->ci_kind) == 0;
        drift = fmax(drift, row->drift); // fmax passes over NAN
    }
    print_head(suite, shown, same_kind, drift);
    sb_report_table(&suite->axes, result->row, result->row_count);
    sb_report_policies(&suite->axes, result->row, result->row_count);
    sb_report_ablation(&suite->axes, result->row, result->row_count);
    if (expected)
        sb_cli_expect_print(expected);
    if (written)
        printf("\nresults: %s/summary.csv\n", dir);
    if (result->interrupted) {
        struct sb_arena arena = {0};
        printf("interrupted; go on with: shadebench run --resume %s\n",
               sb_results_whole(dir, &arena));
        sb_arena_free(&arena);
    }
}

// For other programs, in the forms that --write asks for; the exit code. `written`: the folder has
// all that was measured; else its rows are written here still. `expected`: NULL without --check.
static int write_outputs(const struct sb_options *options, const struct sb_suite *suite,
                         const struct sb_run_result *result,
                         const struct sb_expected *expected, const char *dir,
                         bool written, struct sb_arena *arena)
{
    struct sb_error err = {0};
    struct sb_exported exported = {0};
    const struct sb_export_source source = {
        .name = sb_arena_printf(arena, "shadebench run %s", suite->name),
        .row = result->row,
        .row_count = result->row_count,
        .dir = dir,
    };
    int code = 0;
    if (!options->write.count && !expected)
        return 0;
    if (!sb_export_from_results(&source, &exported, &err) && written)
        code = sb_cli_fail(&err);
    if (expected)
        sb_cli_expect_export(expected, result->row, &exported);
    code = sb_exit_code_worse(code, sb_outputs_write(&options->write, &exported.export));
    if (expected && !sb_export_step_summary(&exported.export, &err))
        code = sb_exit_code_worse(code, sb_cli_fail(&err));
    sb_exported_free(&exported);
    return code;
}

// What was measured, once the last process is done; the exit code. Files come first: whoever reads
// the table may leave in the midst of it.
static int show_results(const struct sb_options *options, const struct sb_suite *suite,
                        const struct sb_run_result *result,
                        const struct sb_expected *expected, const char *dir, bool written,
                        struct sb_arena *arena)
{
    const int code = write_outputs(options, suite, result, expected, dir, written, arena);
    if (!sb_outputs_take_stdout(&options->write))
        print_results(options, suite, result, expected, dir, written);
    else if (result->interrupted)
        sb_info("interrupted; go on with: shadebench run --resume %s",
                sb_results_whole(dir, arena));
    return code;
}

// What is to be run.
struct plan {
    const char *data; // folder
    const char *path; // of the suite; NULL: --set and --sweep alone
    struct sb_suite suite;
    struct sb_expected expected;
    struct sb_platforms platforms;
};

// A results folder that is gone on with has a copy of its suite.
static bool find_suite(const struct sb_options *options, struct plan *plan,
                       struct sb_arena *arena, struct sb_error *err)
{
    const char *copy =
        options->resume ? sb_path_join(arena, options->resume, SB_SUITE_COPY) : NULL;
    if (options->word_count > 1)
        return sb_cli_fail_axis("word", options->word[1], NULL, err)
                   ? false
                   : sb_fail(err, SB_USAGE, "run takes one suite; \"%s\" is one too many",
                             options->word[1]);
    if (copy && sb_file_exists(copy))
        plan->path = copy;
    else if (options->word_count)
        plan->path = sb_cli_suite_path(options->word[0], plan->data, arena, err);
    return plan->path || !options->word_count;
}

static bool load_plan(const struct sb_options *options, struct plan *plan,
                      struct sb_arena *arena, struct sb_error *err)
{
    plan->data = sb_data_dir(arena, options->data, err);
    if (!plan->data || !find_suite(options, plan, arena, err) ||
        !sb_cli_load_suite(options, plan->path, plan->data, &plan->suite, err) ||
        !sb_cli_expect(options, &plan->suite, &plan->expected, err) ||
        (options->platform && !sb_platforms_keep(&plan->suite, options->platform, err)))
        return false;
    sb_platforms_find(&plan->suite, &plan->platforms, arena);
    return true;
}

// One run a platform, and what is asked of all of them together.
static int run_platforms(const struct sb_options *options, struct plan *plan,
                         const json_t *arguments, struct sb_arena *arena)
{
    struct sb_platforms_rows rows = {0};
    const char *dir = results_dir(options, &plan->suite, arena);
    const struct sb_platforms_run run = {
        .suite = &plan->suite,
        .platforms = &plan->platforms,
        .dir = dir,
        .suite_file = plan->path,
        .options = options,
        .arguments = arguments,
        .quiet_output = options->json || sb_outputs_take_stdout(&options->write),
    };
    int code = sb_platforms_run(&run, &rows);
    const struct sb_run_result result = {
        .row = rows.row, .row_count = rows.count, .interrupted = rows.interrupted};
    const bool judged = options->check && !result.interrupted && rows.count > 0;
    const struct sb_expected *expected = judged ? &plan->expected : NULL;
    if (judged) {
        sb_expect_check(&plan->expected, result.row, result.row_count);
        code = sb_exit_code_worse(code, sb_cli_expect_code(options, expected));
    }
    if (rows.count > 0) // before all that is printed, as show_results
        code = sb_exit_code_worse(code, write_outputs(options, &plan->suite, &result,
                                                      expected, NULL, true, arena));
    if (judged && !run.quiet_output)
        sb_cli_expect_print(expected);
    if (options->json)
        print_results(options, &plan->suite, &result, expected, dir, true);
    else if (!run.quiet_output && rows.count > 0)
        printf("\nresults of all platforms: %s/summary.csv\n", dir);
    sb_platforms_rows_free(&rows);
    return code;
}

// A process of a run on one platform. The next one, where more are wanted, takes this one's place.
static int run_process(const struct sb_options *options, struct plan *plan,
                       const json_t *arguments, struct sb_arena *arena)
{
    struct sb_error err = {0};
    struct sb_run_result result = {0};
    struct sb_run_params params = {
        .suite = &plan->suite,
        .data_dir = plan->data,
        .shaders = options->shaders,
        .dir = results_dir(options, &plan->suite, arena),
        .append = options->resume != NULL,
        .images = options->images,
        .payback = options->payback,
        .dump = options->dump,
        .suite_file = plan->path,
        .arguments = arguments,
    };
    if (!sb_cli_driver_params(options, &plan->suite, &params.driver, &err))
        return sb_cli_fail(&err);
    if (sb_driver_untimed(&params.driver))
        plan->suite.measure.processes = 1; // pictures are those of any
    if (options->ablate)
        sb_ablate(&plan->suite);
    sb_info("%s: %d variants; results go to %s", plan->suite.name,
            plan->suite.entry_count, params.dir);
    const bool good = sb_run(&params, &result, &err);
    const bool more = good && !result.interrupted &&
                      result.processes_done < (int)plan->suite.measure.processes;
    // What an interrupted run has not measured is no miss.
    const bool judged = options->check && result.row && !result.interrupted && !more;
    const struct sb_expected *expected = judged ? &plan->expected : NULL;
    if (judged)
        sb_expect_check(&plan->expected, result.row, result.row_count);
    int code = result.exit_code;
    if (result.row && !more)
        code = sb_exit_code_worse(code, show_results(options, &plan->suite, &result,
                                                     expected, params.dir, good, arena));
    if (!good)
        code = sb_exit_code_worse(code, sb_cli_fail(&err));
    if (judged)
        code = sb_exit_code_worse(code, sb_cli_expect_code(options, expected));
    sb_run_result_free(&result);
    return more ? next_process(params.dir, options, &err) : code;
}

static int run_suite(const struct sb_options *options, const json_t *arguments,
                     struct sb_arena *arena)
{
    struct sb_error err = {0};
    struct plan plan = {0};
    const int code = !load_plan(options, &plan, arena, &err) ? sb_cli_fail(&err)
                     : plan.platforms.count > 1
                         ? run_platforms(options, &plan, arguments, arena)
                         : run_process(options, &plan, arguments, arena);
    sb_expect_free(&plan.expected);
    sb_suite_free(&plan.suite);
    return code;
}

int sb_cmd_run(const struct sb_options *given, int argc, char **argv)
{
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_options earlier = {0};
    const struct sb_options *options = given;
    json_t *arguments = NULL;
    int code;
    sb_interrupt_install();
    if (!sb_outputs_check(given, &err)) {
        code = sb_cli_fail(&err);
        goto done;
    }
    if (given->resume) {
        options = &earlier;
        if (!load_earlier_options(given, &earlier, &arguments, &arena, &err)) {
            code = sb_cli_fail(&err);
            goto done;
        }
    } else {
        arguments = sb_cli_arguments_json(argc, argv, &err);
        if (!arguments) {
            code = sb_cli_fail(&err);
            goto done;
        }
    }
    code = run_suite(options, arguments, &arena);

done:
    json_decref(arguments);
    sb_arena_free(&arena);
    return code;
}
