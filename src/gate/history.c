#include "gate/history.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/log.h"
#include "gate/state.h"
#include "measure/check.h"
#include "measure/interrupt.h"
#include "stats/between.h"

// --- before the pairs ----------------------------------------------------------------------------

static bool prepare_all(struct sb_gate_session *session, struct sb_error *err)
{
    for (int i = 0; i < session->pair_count && !sb_interrupted(); i++) {
        char line[80];
        snprintf(line, sizeof line, "compiling variant %d of %d, and the anchor", i + 1,
                 session->pair_count);
        sb_progress(line);
        sb_gate_session_prepare(session, i, i);
        for (int side = i == 0 ? SB_BASE : SB_HEAD; side < SB_SIDES; side++) {
            struct sb_task *task = &session->pair[i].task[side];
            if (sb_task_sound(task))
                sb_check_picture(task, &session->driver[side]);
        }
        const struct sb_task *anchor = &session->pair[i].task[SB_BASE];
        if (!sb_task_sound(anchor))
            return sb_fail(err, anchor->status, "the anchor: %s",
                           sb_text_get(&anchor->note));
    }
    return true;
}

// --- rows ----------------------------------------------------------------------------------------

// How many threads a software driver draws with, whose levels depend on it. Other drivers do not
// read the variable; which are which, not every context says.
static const char *threads_text(struct sb_arena *arena, const struct sb_caps *caps)
{
    const char *given = getenv("LP_NUM_THREADS");
    if (given && *given)
        return sb_arena_strdup(arena, given);
    return caps->software
               ? sb_arena_printf(arena, "auto-%ld", sysconf(_SC_NPROCESSORS_ONLN))
               : NULL;
}

// --- one process ---------------------------------------------------------------------------------

struct variant {               // a plan entry over all processes
    struct sb_interval *ratio; // of each process, a frame of it over one of the anchor
    int processes;             // that have one
    int64_t pairs;
    enum sb_status status; // the first that is not OK
    const char *note;      // to that
};

struct measuring {
    const struct sb_history_measure_params *params;
    struct sb_gate_params gate;
    struct sb_history_measured *measured;
    struct variant *variant;
};

// The reading is of whole batches; a frame each is wanted.
static struct sb_interval ratio_of(const struct sb_gate_pair *pair)
{
    struct sb_interval ratio = pair->reading.ratio;
    const double frames = (double)pair->batch[SB_BASE] / pair->batch[SB_HEAD];
    ratio.point *= frames;
    ratio.lo *= frames;
    ratio.hi *= frames;
    return ratio;
}

// Where it is OK, there is a ratio: rows that are, and have none, would spoil the file.
static enum sb_status status_of(const struct sb_gate_pair *pair,
                                const struct sb_interval *ratio)
{
    const struct sb_task *task = &pair->task[SB_HEAD];
    if (task->status != SB_OK)
        return task->status;
    if (task->untimed)
        return SB_ACCURACY_ONLY;
    if (pair->count == 0)
        return SB_SAMPLES_INVALID;
    return ratio->point > 0 && isfinite(ratio->point) ? SB_OK : SB_TOO_FEW_SAMPLES;
}

static void take(struct measuring *all, const struct sb_gate_session *session, int i)
{
    const struct sb_gate_pair *pair = &session->pair[i];
    const struct sb_task *head = &pair->task[SB_HEAD], *anchor = &pair->task[SB_BASE];
    struct variant *variant = &all->variant[i];
    struct sb_history_row *row = &all->measured->row[i];
    struct sb_arena *arena = &all->measured->arena;
    const struct sb_interval ratio = ratio_of(pair);
    const enum sb_status status = status_of(pair, &ratio);
    if (anchor->loaded)
        row->anchor = sb_gate_hash_text(
            arena, sb_anchor_mark(all->params->anchor, anchor->prepared.input_hash));
    if (head->loaded)
        row->source_hash = sb_gate_hash_text(arena, head->assembly.source_hash);
    if (variant->status == SB_OK && status != SB_OK) {
        variant->status = status;
        variant->note = sb_arena_strdup(arena, sb_text_get(&head->note));
    }
    if (status != SB_OK)
        return;
    variant->ratio[variant->processes++] = ratio;
    variant->pairs += pair->count;
}

static bool measure(struct measuring *all, struct sb_gate_session *session,
                    struct sb_error *err)
{
    const struct sb_gate_params *gate = &all->gate;
    sb_progress("opening the driver");
    if (!sb_gate_session_open(session, gate, err))
        return false;
    all->measured->metric = session->metric;
    all->measured->caps = session->driver[SB_BASE].caps;
    if (!prepare_all(session, err) || !sb_gate_make_ready(session, err))
        return false;
    struct sb_gate_rounds rounds = {
        .session = session,
        .rule = &gate->rule,
        .fixed = true,
        .seconds = gate->settings->budget,
        .arena = &all->measured->arena,
    };
    return sb_gate_rounds_run(&rounds, err);
}

// A process that was interrupted is none: its pairs are fewer than those of the others.
static bool measure_process(struct measuring *all, int process, int *done,
                            struct sb_error *err)
{
    const int count = all->params->suite->entry_count;
    struct sb_gate_session session = {.process = process, .pair_count = count};
    session.pair = sb_alloc(((size_t)count + 1) * sizeof *session.pair);
    const bool good = measure(all, &session, err);
    sb_progress("");
    const bool whole = good && !sb_interrupted();
    for (int i = 0; whole && i < count; i++)
        take(all, &session, i);
    *done += whole;
    sb_gate_session_close(&session);
    return good;
}

// --- the whole -----------------------------------------------------------------------------------

static void set_ratio(const struct variant *variant, struct sb_history_row *row)
{
    struct sb_interval ratio = variant->ratio[0];
    if (variant->processes > 1) {
        double *point = sb_alloc((size_t)variant->processes * sizeof *point);
        for (int p = 0; p < variant->processes; p++)
            point[p] = variant->ratio[p].point;
        ratio = sb_between_processes(point, variant->processes, 0.95);
        free(point);
    }
    row->ratio = ratio.point;
    row->ratio_lo = ratio.lo;
    row->ratio_hi = ratio.hi;
}

static void fill_row(struct measuring *all, int i)
{
    const struct sb_plan_entry *entry = &all->params->suite->entry[i];
    const struct variant *variant = &all->variant[i];
    struct sb_history_measured *measured = all->measured;
    struct sb_history_row *row = &measured->row[i];
    const int code = sb_status_rows[variant->status].exit_code;
    row->suite = all->params->suite->name;
    row->scene = entry->scene;
    row->variant = entry->id;
    row->metric = sb_metric_rows[measured->metric].name;
    row->renderer = measured->caps.renderer;
    row->version = measured->caps.version;
    row->threads = threads_text(&measured->arena, &measured->caps);
    row->status = sb_status_rows[variant->status].word;
    row->processes = variant->processes;
    row->pairs = variant->pairs;
    if (variant->status == SB_OK)
        set_ratio(variant, row);
    else
        sb_warn("%s %s: %s%s%s", row->scene, row->variant, row->status,
                variant->note && *variant->note ? ": " : "",
                variant->note ? variant->note : "");
    measured->exit_code = sb_exit_code_worse(measured->exit_code, code);
}

static struct sb_gate_params gate_params(const struct sb_history_measure_params *params)
{
    struct sb_gate_params gate = {
        .side = {[SB_BASE] = {.suite = &params->anchor->suite,
                              .driver = params->driver,
                              .frozen = &params->anchor->text},
                 [SB_HEAD] = {.suite = params->suite,
                              .driver = params->driver,
                              .shaders = params->shaders}},
        .keep_equal = true,
        .own_batches = true,
        .rule = sb_gate_rule_default(1),
        .metric = params->metric,
        .settings = &params->suite->measure,
        .data_dir = params->data_dir,
    };
    gate.rule.confirm_pairs = params->pairs;
    return gate;
}

bool sb_history_measure(const struct sb_history_measure_params *params,
                        struct sb_history_measured *measured, struct sb_error *err)
{
    const int count = params->suite->entry_count,
              processes = (int)params->suite->measure.processes;
    const int64_t begin = sb_clock_ns();
    struct measuring all = {
        .params = params, .gate = gate_params(params), .measured = measured};
    struct sb_arena arena = {0};
    bool good = true;
    int done = 0;
    all.variant = sb_arena_alloc(&arena, ((size_t)count + 1) * sizeof *all.variant);
    measured->row = sb_alloc(((size_t)count + 1) * sizeof *measured->row);
    for (int i = 0; i < count; i++) {
        all.variant[i].ratio =
            sb_arena_alloc(&arena, (size_t)processes * sizeof *all.variant[i].ratio);
        sb_history_row_init(&measured->row[i]);
    }
    for (int p = 0; good && p < processes && !sb_interrupted(); p++)
        good = measure_process(&all, p, &done, err);
    if (good && done == 0)
        good = sb_fail(err, SB_INTERRUPTED,
                       "interrupted before a process was done: nothing is kept");
    if (good && done < processes) {
        sb_warn("interrupted: %d of %d processes were done, and are kept", done,
                processes);
        measured->exit_code = sb_status_rows[SB_INTERRUPTED].exit_code;
    }
    for (int i = 0; good && i < count; i++)
        fill_row(&all, i);
    measured->row_count = good ? count : 0;
    measured->seconds = (double)(sb_clock_ns() - begin) * 1e-9;
    sb_arena_free(&arena);
    return good;
}

void sb_history_measured_free(struct sb_history_measured *measured)
{
    free(measured->row);
    sb_arena_free(&measured->arena);
    *measured = (struct sb_history_measured){0};
}
