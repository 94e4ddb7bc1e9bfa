// A run on the null runner in a folder of its own, for the tests of measure/.
#pragma once

#include "test.h"

#include <unistd.h>

#include "base/file.h"
#include "base/log.h"
#include "job/null.h"
#include "measure/run.h"
#include "results/csv.h"
#include "results/store.h"

struct fixture {
    struct sb_suite suite;
    struct sb_run_result result;
    struct sb_error err;
    char dir[64];
};

// What the next null runner is opened with. The runner is opened inside of sb_run, so the
// script cannot be handed over in any other way.
static struct sb_null_script next_script;

static inline void *open_with_script(const struct sb_context_params *params,
                                     struct sb_caps *caps, struct sb_error *err)
{
    void *runner = sb_runner_null.open(params, caps, err);
    *sb_null_script(runner) = next_script;
    return runner;
}

static inline void fixture_begin_suite(struct fixture *fixture,
                                       const struct sb_suite_params *params,
                                       const char *const *settings, int setting_count)
{
    *fixture = (struct fixture){0};
    sb_log_set_level(SB_LOG_QUIET);
    snprintf(fixture->dir, sizeof fixture->dir, "/tmp/shadebench-run-XXXXXX");
    assert_non_null(mkdtemp(fixture->dir));
    if (!sb_suite_load(params, &fixture->suite, &fixture->err))
        fail_msg("%s", fixture->err.text);
    // The null runner takes no time, so no look may wait for any.
    assert_true(sb_measure_set(&fixture->suite.measure, "span", "0", &fixture->err));
    for (int i = 0; i < setting_count; i += 2)
        assert_true(sb_measure_set(&fixture->suite.measure, settings[i], settings[i + 1],
                                   &fixture->err));
}

static inline void fixture_begin_axis(struct fixture *fixture, const char *axis,
                                      const char *sweep, const char *const *settings,
                                      int setting_count)
{
    const struct sb_assignment assignment = {axis, sweep, "--sweep"};
    const struct sb_suite_params params = {.sweep = &assignment, .sweep_count = 1};
    fixture_begin_suite(fixture, &params, settings, setting_count);
}

static inline void fixture_begin(struct fixture *fixture, const char *points,
                                 const char *const *settings, int setting_count)
{
    fixture_begin_axis(fixture, "point", points, settings, setting_count);
}

static inline bool fixture_run_with(struct fixture *fixture, bool append, bool images)
{
    static struct sb_runner_fns runner;
    runner = sb_runner_null;
    runner.open = open_with_script;
    json_t *arguments = json_array();
    const struct sb_run_params params = {
        .suite = &fixture->suite,
        .driver = {.runner = &runner, .context = {.context = "null", .device = -1}},
        .data_dir = SB_SOURCE_DIR,
        .dir = fixture->dir,
        .append = append,
        .images = images,
        .arguments = arguments,
    };
    sb_run_result_free(&fixture->result);
    const bool good = sb_run(&params, &fixture->result, &fixture->err);
    json_decref(arguments);
    return good;
}

static inline bool fixture_run(struct fixture *fixture, bool append)
{
    return fixture_run_with(fixture, append, false);
}

static inline void fixture_end(struct fixture *fixture)
{
    sb_run_result_free(&fixture->result);
    sb_suite_free(&fixture->suite);
    struct sb_arena arena = {0};
    static const char *const names[] = {"samples.csv", "summary.csv", "run.json"};
    for (int i = 0; i < 3; i++)
        unlink(sb_path_join(&arena, fixture->dir, names[i]));
    rmdir(fixture->dir);
    sb_arena_free(&arena);
    next_script = (struct sb_null_script){0};
}

// The samples on disk.
static inline void fixture_samples(const struct fixture *fixture, struct sb_csv *csv)
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    *csv = (struct sb_csv){0};
    if (!sb_csv_read(sb_path_join(&arena, fixture->dir, "samples.csv"), csv, &err))
        fail_msg("%s", err.text);
    sb_arena_free(&arena);
}
