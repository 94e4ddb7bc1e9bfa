#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "measure/accuracy.h"
#include "measure/calibrate.h"
#include "measure/check.h"
#include "measure/dump.h"
#include "measure/interrupt.h"
#include "measure/payback.h"
#include "measure/pictures.h"
#include "measure/record.h"
#include "measure/resume.h"
#include "measure/rounds.h"
#include "measure/run.h"
#include "measure/summary.h"
#include "scene/lights.h"

struct sb_run_state {
    const struct sb_run_params *params;
    struct sb_driver driver;
    bool borrowed; // the driver is the caller's
    struct sb_task *task;
    int task_count;
    struct sb_store *store;
    struct sb_earlier earlier;
    char started[32];
    int64_t summary_ns;      // when summary.csv was last written,
    int64_t summary_cost_ns; // and how long that took
    struct sb_row *row;
    struct sb_variant *recalled; // axes of the rows of a complete folder
    struct sb_arena row_arena;   // texts of the rows of one summary
    struct sb_truths *truths;    // pictures of the reference
};

static void summarise(struct sb_run_state *run)
{
    const struct sb_summary_params params = {
        .task = run->task,
        .task_count = run->task_count,
        .driver = &run->driver,
        .suite = run->params->suite,
        .timer_error = run->earlier.timer_error,
    };
    sb_arena_free(&run->row_arena);
    sb_summarise(&params, run->row, &run->row_arena);
}

static bool write_files(struct sb_run_state *run, bool complete, struct sb_error *err)
{
    const struct sb_record_params params = {
        .suite = run->params->suite,
        .driver = &run->driver,
        .task = run->task,
        .task_count = run->task_count,
        .arguments = run->params->arguments,
        .process = run->earlier.process,
        .started = run->started,
        .complete = complete,
        .program_cache = run->params->driver.context.program_cache,
    };
    summarise(run);
    json_t *record = sb_record_make(&params, run->earlier.run);
    const bool good = sb_store_run(run->store, record, err) &&
                      sb_store_summary(run->store, run->row, run->task_count, err);
    json_decref(record);
    return good;
}

// --- before the rounds -----------------------------------------------------------------------

static void show_stage(const char *what, int done, int count)
{
    char line[160];
    snprintf(line, sizeof line, "%s %d of %d", what, done + 1, count);
    sb_progress(line);
}

static struct sb_prepare_params prepare_params(const struct sb_run_state *run)
{
    return (struct sb_prepare_params){
        .suite = run->params->suite,
        .driver = &run->driver,
        .data_dir = run->params->data_dir,
        .shaders = run->params->shaders,
    };
}

static void prepare_all(struct sb_run_state *run)
{
    const struct sb_prepare_params params = prepare_params(run);
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        show_stage("compiling variant", i, run->task_count);
        sb_task_prepare(&run->task[i], &params, (uint32_t)i + 1);
        run->task[i].untimed |= sb_driver_untimed(&run->params->driver);
    }
    sb_check_same_code(run->task, run->task_count);
}

static bool same_scene(const struct sb_task *a, const struct sb_task *b)
{
    return strcmp(a->entry->scene, b->entry->scene) == 0;
}

// Is the task's program one of fewer lights, and otherwise the same, as that of `other`?
static bool has_fewer_lights(const struct sb_run_state *run, const struct sb_task *task,
                             const struct sb_task *other)
{
    struct sb_variant raised = task->entry->variant;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const int axis = sb_light_structs[type].axis;
        if (raised.value[axis] > other->entry->variant.value[axis])
            return false;
        raised.value[axis] = other->entry->variant.value[axis];
    }
    return sb_variant_equal(&run->params->suite->axes, &raised, &other->entry->variant);
}

static bool is_covered(const struct sb_run_state *run, const struct sb_task *task)
{
    for (int i = 0; i < run->task_count; i++) {
        const struct sb_task *other = &run->task[i];
        if (other != task && sb_task_sound(other) && same_scene(task, other) &&
            has_fewer_lights(run, task, other))
            return true;
    }
    return false;
}

// The first sound task before this one that must draw the same picture.
static struct sb_task *class_mate(const struct sb_run_state *run,
                                  const struct sb_task *task)
{
    for (struct sb_task *other = run->task; other < task; other++)
        if (sb_task_sound(other) && same_scene(task, other) &&
            sb_variant_same_class(&run->params->suite->axes, &task->entry->variant,
                                  &other->entry->variant))
            return other;
    return NULL;
}

static void check_all(struct sb_run_state *run)
{
    const struct sb_prepare_params params = prepare_params(run);
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        struct sb_task *task = &run->task[i], *mate;
        show_stage("checking picture", i, run->task_count);
        if (sb_task_sound(task))
            sb_check_picture(task, &run->driver);
        if (sb_task_sound(task))
            sb_check_lights(task, &params, !is_covered(run, task));
        if (sb_task_sound(task) && (mate = class_mate(run, task)))
            sb_check_class(task, mate, &run->driver);
    }
}

static void measure_errors(struct sb_run_state *run)
{
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        struct sb_task *task = &run->task[i];
        show_stage("measuring the error of variant", i, run->task_count);
        if (task->loaded) // what went wrong is what its errors are asked for
            sb_accuracy_measure(task, &run->driver, run->truths);
    }
}

// Pictures are an extra: one that cannot be had or written is told, and the run goes on.
static void write_images(struct sb_run_state *run)
{
    struct sb_error err = {0};
    const struct sb_pictures_params params = {
        .task = run->task,
        .task_count = run->task_count,
        .driver = &run->driver,
        .truths = run->truths,
        .dir = run->params->dir,
    };
    if (!sb_pictures_write(&params, &err))
        sb_warn("%s; the run goes on without further pictures", err.text);
}

// A dump is what was asked for: one that cannot be written ends the run, before anything is
// measured.
static bool write_dumps(struct sb_run_state *run, struct sb_error *err)
{
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        show_stage("dumping variant", i, run->task_count);
        if (run->task[i].loaded &&
            !sb_dump(&run->task[i], &run->driver, &run->params->suite->axes,
                     run->params->dump, err))
            return false;
    }
    return true;
}

// Has one of the interrupted processes before this one measured the task to the end?
static bool was_precise(const struct sb_run_state *run, const struct sb_task *task)
{
    const struct sb_earlier *earlier = &run->earlier;
    for (int p = earlier->first_open; p < earlier->process; p++)
        if (sb_task_precise(task, p, &run->params->suite->measure))
            return true;
    return false;
}

// What this process measures: everything; after an interrupted process what it lacked, with
// the first row as an anchor between the two.
static void activate(struct sb_run_state *run)
{
    for (int i = 0; i < run->task_count; i++) {
        struct sb_task *task = &run->task[i];
        const bool done = i > 0 && was_precise(run, task);
        task->active = sb_task_timed(task) && !done;
        if (done)
            task->stop = "half_width";
    }
}

static void calibrate_all(struct sb_run_state *run)
{
    const struct sb_measure_settings *settings = &run->params->suite->measure;
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        struct sb_task *task = &run->task[i];
        struct sb_error failure = {0};
        show_stage("calibrating variant", i, run->task_count);
        // Samples of an earlier process fix the batch: lengths do not change within a row.
        if (sb_task_timed(task) && task->sample_count == 0 &&
            !sb_calibrate_batch(task, &run->driver, settings, &failure))
            sb_task_fail(task, &failure);
    }
}

static void check_fragment_bound(struct sb_run_state *run)
{
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        struct sb_task *task = &run->task[i];
        struct sb_error failure = {0};
        if (sb_task_timed(task) && !sb_check_fragment_bound(task, &run->driver, &failure))
            sb_task_fail(task, &failure);
    }
}

static void split_shadows(struct sb_run_state *run)
{
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        struct sb_task *task = &run->task[i];
        struct sb_error failure = {0};
        if (sb_task_timed(task) && !sb_split_shadows(task, &run->driver, &failure))
            sb_task_fail(task, &failure);
    }
}

// Cold frames take longer, so batches found before the warm-up may be too short after it.
static void make_ready(struct sb_run_state *run)
{
    calibrate_all(run);
    sb_warm_up(run->task, run->task_count, &run->driver, &run->params->suite->measure);
    calibrate_all(run);
    check_fragment_bound(run);
    split_shadows(run);
}

// --- the rounds ------------------------------------------------------------------------------

static void after_round(void *user, int rounds, int active, double seconds_left)
{
    struct sb_run_state *run = user;
    const int64_t now = sb_clock_ns();
    const int done = run->task_count - active;
    char line[160], bar[21];
    for (int i = 0; i < 20; i++)
        bar[i] = i * run->task_count < done * 20 ? '#' : '.';
    bar[20] = '\0';
    snprintf(line, sizeof line,
             "[%s] round %d, %d of %d variants done, at most %.0f s left", bar, rounds,
             done, run->task_count, seconds_left > 0 ? seconds_left : 0);
    sb_progress(line);
    // samples.csv has every round; summary.csv follows twice a second, or less often where
    // there are so many samples that it would take more than a share of the time.
    if (now - run->summary_ns < 500 * INT64_C(1000000) + 30 * run->summary_cost_ns)
        return;
    struct sb_error ignored;
    summarise(run);
    sb_store_summary(run->store, run->row, run->task_count, &ignored);
    run->summary_ns = sb_clock_ns();
    run->summary_cost_ns = run->summary_ns - now;
}

static void check_payback(struct sb_run_state *run)
{
    sb_progress("drawing the frames that pay back");
    summarise(run);
    sb_payback_check(&(struct sb_payback_params){
        .task = run->task,
        .task_count = run->task_count,
        .row = run->row,
        .driver = &run->driver,
    });
}

static bool measure(struct sb_run_state *run, struct sb_error *err)
{
    struct sb_rounds rounds = {
        .task = run->task,
        .task_count = run->task_count,
        .driver = &run->driver,
        .settings = &run->params->suite->measure,
        .process = run->earlier.process,
        .store = run->store,
        .after_round = after_round,
        .user = run,
    };
    prepare_all(run);
    if (run->params->append && !sb_interrupted() &&
        !sb_earlier_check_sources(&run->earlier, run->task, run->task_count, err))
        return false;
    check_all(run);
    measure_errors(run);
    if (run->params->images)
        write_images(run);
    if (run->params->dump && !write_dumps(run, err))
        return false;
    sb_truths_free(&run->truths); // memory that the driver may want while it is timed
    make_ready(run);
    activate(run);
    if (!write_files(run, false, err))
        return false;
    const bool good = sb_rounds_run(&rounds, err);
    if (good && run->params->payback && !sb_interrupted())
        check_payback(run);
    sb_progress("");
    return good;
}

// --- a run -----------------------------------------------------------------------------------

bool sb_run_copy_suite(const char *suite_file, const char *dir, struct sb_error *err)
{
    struct sb_arena arena = {0};
    size_t size = 0;
    const char *copy = sb_path_join(&arena, dir, SB_SUITE_COPY);
    const char *text = sb_file_read(&arena, suite_file, 1 << 20, &size, err);
    bool good = text != NULL;
    if (good && size == 0) // a pipe: the suite was read from it
        good = sb_fail(err, SB_BAD_INPUT,
                       "%s: cannot be read a second time, for its copy beside the "
                       "results; give a regular file",
                       suite_file);
    good = good && sb_file_replace(copy, text, size, err);
    sb_arena_free(&arena);
    return good;
}

// Pictures and dumps need no timer: they are written on a driver or a busy machine, too, where
// none is to be believed.
static void draw_untimed(struct sb_run_state *run, const struct sb_driver_params *driver)
{
    const struct sb_run_params *params = run->params;
    struct sb_error err = {0};
    if ((!params->images && !params->dump) ||
        !sb_driver_connect(driver, &run->driver, &err))
        return;
    prepare_all(run);
    check_all(run);
    measure_errors(run);
    if (params->images)
        write_images(run);
    if (params->dump && !write_dumps(run, &err))
        sb_warn("%s", err.text);
    sb_progress("");
    sb_warn("pictures are in %s; nothing was measured",
            params->dump ? params->dump : params->dir);
}

static bool open_all(struct sb_run_state *run, struct sb_error *err)
{
    const struct sb_run_params *params = run->params;
    struct sb_driver_params driver = params->driver;
    if (run->earlier.timer)
        driver.timer = run->earlier.timer;
    const struct sb_store_params store = {
        .dir = params->dir,
        .axes = &params->suite->axes,
        .append = params->append,
    };
    run->store = sb_store_open(&store, err);
    if (!run->store || (params->suite_file && !params->append &&
                        !sb_run_copy_suite(params->suite_file, params->dir, err)))
        return false;
    if (params->examined) {
        run->driver = *params->examined;
        run->borrowed = true;
        return sb_driver_use_timer(&run->driver, driver.timer, err);
    }
    sb_progress(sb_driver_untimed(&driver)
                    ? "opening the context"
                    : "opening the context and auditing its timers");
    if (!sb_driver_open(&driver, &run->driver, err)) {
        if (err->status == SB_NO_TIMER && !params->append)
            draw_untimed(run, &driver);
        return false;
    }
    sb_progress("");
    return !params->append ||
           (sb_earlier_check_driver(&run->earlier, &run->driver.caps, err) &&
            sb_earlier_hand_out(&run->earlier, run->task, run->task_count, err));
}

static void conclude(struct sb_run_state *run, struct sb_run_result *result)
{
    result->row = run->row;
    result->row_count = run->task_count;
    result->interrupted = sb_interrupted();
    result->processes_done =
        run->earlier.complete + (!result->interrupted && !run->recalled);
    for (int i = 0; i < run->task_count; i++)
        result->exit_code = sb_exit_code_worse(
            result->exit_code,
            sb_status_rows[sb_status_find(run->row[i].status)].exit_code);
    if (result->interrupted)
        result->exit_code = sb_exit_code_worse(result->exit_code, 130);
}

static bool is_complete(const struct sb_run_state *run)
{
    return run->earlier.complete > 0 && !run->earlier.last_incomplete &&
           run->earlier.complete >= run->params->suite->measure.processes;
}

// Measuring again what is there would make it another result.
static bool recall(struct sb_run_state *run, struct sb_run_result *result,
                   struct sb_error *err)
{
    const struct sb_run_params *params = run->params;
    run->recalled = sb_alloc((size_t)run->task_count * sizeof *run->recalled);
    if (!sb_earlier_recall(&run->earlier, params->dir, params->suite, run->row,
                           run->recalled, err))
        return false;
    sb_info("%s is complete, nothing is measured; more processes: --processes %d",
            params->dir, run->earlier.complete + 1);
    conclude(run, result);
    return true;
}

bool sb_run(const struct sb_run_params *params, struct sb_run_result *result,
            struct sb_error *err)
{
    struct sb_run_state *run = sb_alloc(sizeof *run);
    result->state = run;
    run->params = params;
    run->task_count = params->suite->entry_count;
    run->task = sb_alloc((size_t)run->task_count * sizeof *run->task);
    run->row = sb_alloc((size_t)run->task_count * sizeof *run->row);
    for (int i = 0; i < run->task_count; i++)
        run->task[i].entry = &params->suite->entry[i];
    run->truths = sb_truths_new(&params->suite->axes);
    sb_timestamp(run->started);

    if (params->append &&
        !sb_earlier_load(params->dir, params->suite, &run->earlier, err))
        return false;
    if (is_complete(run))
        return recall(run, result, err);
    if (params->append && run->earlier.last_incomplete)
        sb_info("%s: process %d of this run was stopped; a fresh one measures what it "
                "lacked",
                params->dir, run->earlier.process);
    if (!open_all(run, err))
        return false;
    const bool good = measure(run, err) && write_files(run, !sb_interrupted(), err);
    if (!good)
        summarise(run); // whatever was measured is shown, if it cannot be written
    conclude(run, result);
    return good;
}

void sb_run_result_free(struct sb_run_result *result)
{
    struct sb_run_state *run = result->state;
    if (!run)
        return;
    for (int i = 0; i < run->task_count; i++)
        sb_task_free(&run->task[i], &run->driver);
    if (!run->borrowed)
        sb_driver_close(&run->driver);
    sb_store_close(&run->store);
    sb_earlier_free(&run->earlier);
    sb_truths_free(&run->truths);
    sb_arena_free(&run->row_arena);
    free(run->recalled);
    free(run->task);
    free(run->row);
    free(run);
    *result = (struct sb_run_result){0};
}
