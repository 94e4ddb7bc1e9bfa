// A gate on the scripted null runner, in a folder of its own, for the tests of gate/.
#pragma once

#include "test.h"

#include <signal.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/log.h"
#include "gate/gate.h"
#include "job/null.h"
#include "noise.h"
#include "results/csv.h"
#include "shader_folder.h"

enum { VARIANTS = 3 }; // point=1, 2 and 4

static struct script {       // what both sides do; zeroed: they are one and the same
    double slower[VARIANTS]; // head's share over base, in the gate's own process
    double slower_fresh[VARIANTS]; // and in those of confirmations
    double noise;                  // deviation of a batch's share
    int64_t stop_at;               // SIGINT at this shot; 0: never
    int64_t sleep_ns;              // real time of a shot
    void (*prepare)(void *user, const struct sb_job *job, struct sb_prepared *prepared);
    float (*colour)(void *user, const struct sb_job *job,
                    const struct sb_image_request *request);
    unsigned (*flags)(void *user, const struct sb_shot *shot, int64_t count);
    bool (*round_fails)(void *user, int64_t round);
    // What came of it:
    int opened, closed;
    int64_t shots; // of all processes
    struct sb_random random;
} script;

// Jobs are numbered base, head, base, head, ... by plan entry.
static inline bool is_head(uint32_t job)
{
    return job % 2 == 0;
}
static inline int variant_of(uint32_t job)
{
    return (int)(job - 1) / 2;
}

static inline double scripted_ns(void *user, const struct sb_job *job,
                                 const struct sb_shot *shot, int64_t count)
{
    (void)user, (void)shot, (void)count;
    const int variant = variant_of(job->id) % VARIANTS;
    const double *slower = script.opened > 1 ? script.slower_fresh : script.slower;
    if (++script.shots == script.stop_at)
        raise(SIGINT);
    if (script.sleep_ns)
        sb_sleep_ns(script.sleep_ns);
    return 1e6 * (1 + variant) * (is_head(job->id) ? 1 + slower[variant] : 1) *
           exp(script.noise * normal_noise(&script.random));
}

static inline void *open_scripted(const struct sb_context_params *params,
                                  struct sb_caps *caps, struct sb_error *err)
{
    void *runner = sb_runner_null.open(params, caps, err);
    *sb_null_script(runner) = (struct sb_null_script){
        .frame_ns = scripted_ns,
        .prepare = script.prepare,
        .colour = script.colour,
        .flags = script.flags,
        .round_fails = script.round_fails,
    };
    script.opened++;
    return runner;
}

static inline void close_scripted(void *runner)
{
    script.closed++;
    sb_runner_null.close(runner);
}

struct gate {
    struct sb_suite suite;
    struct sb_gate_params params;
    struct sb_gate_result result;
    struct sb_error err;
    json_t *arguments;
    char dir[64];
    struct shader_folder head; // the shaders, a comment apart
};

static struct sb_runner_fns scripted_runner;

static inline void copy_shaders(struct shader_folder *folder)
{
    char line[256];
    folder_make(folder);
    snprintf(line, sizeof line, "cp -r '%s/shaders/.' '%s'", SB_SOURCE_DIR, folder->root);
    assert_int_equal(system(line), 0);
}

static inline void remove_folder(const char *path)
{
    char line[256];
    snprintf(line, sizeof line, "rm -rf '%s'", path);
    assert_int_equal(system(line), 0);
}

// Both sides have the same texts, head's with other names, and are timed all the same.
static inline void gate_begin(struct gate *gate)
{
    const struct sb_assignment assignment = {"point", "1,2,4", "--sweep"};
    const struct sb_suite_params suite = {.sweep = &assignment, .sweep_count = 1};
    *gate = (struct gate){0};
    script = (struct script){0};
    script.random = sb_random_seed(7);
    sb_log_set_level(SB_LOG_QUIET);
    snprintf(gate->dir, sizeof gate->dir, "/tmp/shadebench-gate-XXXXXX");
    assert_non_null(mkdtemp(gate->dir));
    if (!sb_suite_load(&suite, &gate->suite, &gate->err))
        fail_msg("%s", gate->err.text);
    assert_int_equal(gate->suite.entry_count, VARIANTS);
    gate->arguments = json_array();
    scripted_runner = sb_runner_null;
    scripted_runner.open = open_scripted;
    scripted_runner.close = close_scripted;
    gate->params = (struct sb_gate_params){
        .keep_equal = true,
        .rule = sb_gate_rule_default(1),
        .settings = &gate->suite.measure,
        .data_dir = SB_SOURCE_DIR,
        .dir = gate->dir,
        .arguments = gate->arguments,
    };
    for (int side = 0; side < SB_SIDES; side++)
        gate->params.side[side] = (struct sb_gate_side_params){
            .suite = &gate->suite,
            .driver = {.runner = &scripted_runner,
                       .context = {.context = "null", .device = -1}},
        };
    gate->params.side[SB_HEAD].renamed = true;
}

static inline bool gate_run(struct gate *gate)
{
    return sb_gate_run(&gate->params, &gate->result, &gate->err);
}

static inline void gate_run_good(struct gate *gate)
{
    if (!gate_run(gate))
        fail_msg("%s", gate->err.text);
    assert_int_equal(gate->result.row_count, VARIANTS);
    // What was opened is closed, but for what the result still holds.
    assert_in_range(script.opened - script.closed, 0, 1);
}

static inline void gate_end(struct gate *gate)
{
    sb_gate_result_free(&gate->result);
    assert_int_equal(script.opened, script.closed);
    sb_suite_free(&gate->suite);
    json_decref(gate->arguments);
    remove_folder(gate->dir);
    if (gate->head.root[0])
        remove_folder(gate->head.root);
    sb_arena_free(&gate->head.arena);
}

#define check_row(gate, row, verdict, status)                                            \
    check_row_at(gate, row, verdict, status, __FILE__, __LINE__)
static inline void check_row_at(const struct gate *gate, int row, const char *verdict,
                                const char *status, const char *file, int line)
{
    const struct sb_gate_row *it = &gate->result.row[row];
    const char *is = it->verdict ? it->verdict : "";
    if (strcmp(is, verdict) == 0 && strcmp(it->status, status) == 0)
        return;
    print_error("%s: %s, %s instead of %s, %s; %s\n", it->variant, is, it->status,
                verdict, status, it->note ? it->note : "no note");
    _fail(file, line);
}

static inline void gate_csv(const struct gate *gate, const char *name, struct sb_csv *csv)
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    *csv = (struct sb_csv){0};
    if (!sb_csv_read(sb_path_join(&arena, gate->dir, name), csv, &err))
        fail_msg("%s", err.text);
    sb_arena_free(&arena);
}

// pairs.csv, as the rows that were written; to be freed. The texts live in `arena`.
static inline struct sb_pair_row *read_pairs(const struct gate *gate, int *count,
                                             struct sb_csv *csv)
{
    struct sb_error err = {0};
    gate_csv(gate, "pairs.csv", csv);
    *count = csv->row_count - 1;
    struct sb_pair_row *row = malloc(((size_t)*count + 1) * sizeof *row);
    for (int i = 0; i < *count; i++) {
        sb_pair_row_init(&row[i]);
        if (!sb_csv_get(csv, i + 1, sb_pair_columns, sb_pair_column_count, &row[i], &err))
            fail_msg("%s", err.text);
    }
    return row;
}

// "complete" and "exit_code" of gate.json; -1: it has none.
static inline bool gate_complete(const struct gate *gate, int *exit_code)
{
    char path[96];
    snprintf(path, sizeof path, "%s/gate.json", gate->dir);
    json_t *json = json_load_file(path, 0, NULL);
    assert_non_null(json);
    const json_t *code = json_object_get(json, "exit_code");
    const bool complete = json_is_true(json_object_get(json, "complete"));
    *exit_code = code ? (int)json_integer_value(code) : -1;
    json_decref(json);
    return complete;
}
