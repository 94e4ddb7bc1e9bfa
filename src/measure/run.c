#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "measure/calibrate.h"
#include "measure/check.h"
#include "measure/interrupt.h"
#include "measure/record.h"
#include "measure/resume.h"
#include "measure/rounds.h"
#include "measure/run.h"
#include "measure/summary.h"
#include "scene/lights.h"

struct sb_run_state {
    const struct sb_run_params *params;
    struct sb_driver driver;
    struct sb_task *task;
    int task_count;
    struct sb_store *store;
    struct sb_earlier earlier;
    char started[32];
    int64_t summary_ns; // when summary.csv was last written
    struct sb_row *row;
    struct sb_arena row_arena; // texts of the rows of one summary
};

static void summarise(struct sb_run_state *run)
{
    const struct sb_summary_params params = {
        .task = run->task,
        .task_count = run->task_count,
        .driver = &run->driver,
        .suite = run->params->suite,
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

static void prepare_all(struct sb_run_state *run)
{
    const struct sb_prepare_params params = {
        .suite = run->params->suite,
        .driver = &run->driver,
        .data_dir = run->params->data_dir,
        .shaders = run->params->shaders,
    };
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        show_stage("compiling variant", i, run->task_count);
        sb_task_prepare(&run->task[i], &params, (uint32_t)i + 1);
    }
    sb_check_same_code(run->task, run->task_count);
}

// Does a task of the same scene have as many lights of each type, and stand for `task`?
static bool is_covered(const struct sb_run_state *run, int index)
{
    const struct sb_task *task = &run->task[index];
    for (int i = 0; i < run->task_count; i++) {
        const struct sb_task *other = &run->task[i];
        bool covers = i != index && sb_task_sound(other) &&
                      other->assembly.lit_per_vertex == task->assembly.lit_per_vertex &&
                      strcmp(other->entry->scene, task->entry->scene) == 0;
        bool equal = true;
        for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
            const int axis = sb_light_types[type].axis;
            const double mine = task->entry->variant.value[axis];
            covers &= other->entry->variant.value[axis] >= mine;
            equal &= other->entry->variant.value[axis] == mine;
        }
        if (covers && (!equal || i < index))
            return true;
    }
    return false;
}

static void check_all(struct sb_run_state *run)
{
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        show_stage("checking picture", i, run->task_count);
        if (sb_task_sound(&run->task[i]))
            sb_check_picture(&run->task[i], &run->driver);
        if (sb_task_sound(&run->task[i]))
            sb_check_lights(&run->task[i], &run->driver, !is_covered(run, i));
    }
}

static bool write_images(struct sb_run_state *run, struct sb_error *err)
{
    struct sb_arena arena = {0};
    const char *folder = sb_path_join(&arena, run->params->dir, "images");
    bool good = sb_dir_make(folder, err);
    for (int i = 0; good && i < run->task_count; i++) {
        const struct sb_task *task = &run->task[i];
        struct sb_image image = {0};
        const struct sb_image_request request = {.job = task->assembly.job.id,
                                                 .kind = SB_IMAGE_COLOUR};
        if (!task->loaded)
            continue;
        char *name =
            sb_arena_printf(&arena, "%s-%s.png", task->entry->scene, task->entry->id);
        good = run->driver.fns->image(run->driver.runner, &request, &image, err) &&
               sb_image_write_png(&image, sb_path_join(&arena, folder, name), err);
        sb_image_free(&image);
    }
    sb_arena_free(&arena);
    return good;
}

// What this process measures: everything; after an interrupted process what it lacked, with
// the first row as an anchor between the two.
static void activate(struct sb_run_state *run)
{
    const struct sb_measure_settings *settings = &run->params->suite->measure;
    for (int i = 0; i < run->task_count; i++) {
        struct sb_task *task = &run->task[i];
        const bool done = run->earlier.last_incomplete && i > 0 &&
                          sb_task_precise(task, run->earlier.process - 1, settings);
        task->active = sb_task_sound(task) && !done;
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
        if (sb_task_sound(task) && task->sample_count == 0 &&
            !sb_calibrate_batch(task, &run->driver, settings, &failure))
            sb_task_fail(task, &failure);
    }
}

static void check_fragment_bound(struct sb_run_state *run)
{
    for (int i = 0; i < run->task_count && !sb_interrupted(); i++) {
        struct sb_task *task = &run->task[i];
        struct sb_error failure = {0};
        if (sb_task_sound(task) && !sb_check_fragment_bound(task, &run->driver, &failure))
            sb_task_fail(task, &failure);
    }
}

// Cold frames take longer, so batches found before the warm-up may be too short after it.
static bool make_ready(struct sb_run_state *run, struct sb_error *err)
{
    const struct sb_measure_settings *settings = &run->params->suite->measure;
    calibrate_all(run);
    if (!sb_warm_up(run->task, run->task_count, &run->driver, settings, err))
        return false;
    calibrate_all(run);
    check_fragment_bound(run);
    return true;
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
    // samples.csv has every round; summary.csv follows a few times a second.
    if (now - run->summary_ns < 500 * INT64_C(1000000))
        return;
    struct sb_error ignored;
    summarise(run);
    sb_store_summary(run->store, run->row, run->task_count, &ignored);
    run->summary_ns = now;
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
    check_all(run);
    if (run->params->images && !write_images(run, err))
        return false;
    if (!make_ready(run, err))
        return false;
    activate(run);
    if (!write_files(run, false, err))
        return false;
    const bool good = sb_rounds_run(&rounds, err);
    sb_progress("");
    return good;
}

// --- a run -----------------------------------------------------------------------------------

static bool copy_suite(const struct sb_run_params *params, struct sb_error *err)
{
    if (!params->suite_file || params->append)
        return true;
    struct sb_arena arena = {0};
    size_t size;
    const char *text = sb_file_read(&arena, params->suite_file, 1 << 20, &size, err);
    const bool good =
        text && sb_file_replace(sb_path_join(&arena, params->dir, SB_SUITE_COPY), text,
                                size, err);
    sb_arena_free(&arena);
    return good;
}

static bool open_all(struct sb_run_state *run, struct sb_error *err)
{
    const struct sb_run_params *params = run->params;
    struct sb_driver_params driver = params->driver;
    if (params->append) {
        if (!sb_earlier_load(params->dir, params->suite, &run->earlier, err))
            return false;
        if (run->earlier.timer)
            driver.timer = run->earlier.timer;
    }
    const struct sb_store_params store = {
        .dir = params->dir,
        .axes = &params->suite->axes,
        .append = params->append,
    };
    run->store = sb_store_open(&store, err);
    if (!run->store || !copy_suite(params, err))
        return false;
    sb_progress("opening the context and auditing its timers");
    if (!sb_driver_open(&driver, &run->driver, err))
        return false;
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
    result->processes_done = run->earlier.complete + !result->interrupted;
    for (int i = 0; i < run->task_count; i++)
        result->exit_code = sb_exit_code_worse(
            result->exit_code,
            sb_status_rows[sb_status_find(run->row[i].status)].exit_code);
    if (result->interrupted)
        result->exit_code = sb_exit_code_worse(result->exit_code, 130);
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
    sb_timestamp(run->started);

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
    sb_driver_close(&run->driver);
    sb_store_close(&run->store);
    sb_earlier_free(&run->earlier);
    sb_arena_free(&run->row_arena);
    free(run->task);
    free(run->row);
    free(run);
    *result = (struct sb_run_result){0};
}
