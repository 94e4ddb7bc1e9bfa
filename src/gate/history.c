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

// --- before the pairs ----------------------------------------------------------------------------

static bool prepare_all(struct sb_gate_session *session, struct sb_error *err)
{
    for (int i = 0; i < session->pair_count && !sb_interrupted(); i++) {
        char line[80];
        snprintf(line, sizeof line, "compiling variant %d of %d, and the anchor", i + 1,
                 session->pair_count);
        sb_progress(line);
        sb_gate_session_prepare(session, i, i);
        for (int side = 0; side < SB_SIDES; side++) {
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

static const char *hash_text(struct sb_arena *arena, uint64_t hash)
{
    return sb_arena_printf(arena, "%016llx", (unsigned long long)hash);
}

// How many threads draw, as far as the environment says: their levels differ.
static const char *threads_text(struct sb_arena *arena, const struct sb_caps *caps)
{
    const char *given = getenv("LP_NUM_THREADS");
    if (!caps->software)
        return NULL;
    return given && *given
               ? sb_arena_strdup(arena, given)
               : sb_arena_printf(arena, "auto-%ld", sysconf(_SC_NPROCESSORS_ONLN));
}

static enum sb_status status_of(const struct sb_gate_pair *pair)
{
    const struct sb_task *task = &pair->task[SB_HEAD];
    if (sb_status_rows[task->status].exit_code != 0)
        return task->status;
    if (task->untimed)
        return SB_ACCURACY_ONLY;
    return pair->count > 0       ? task->status
           : sb_interrupted()    ? SB_INTERRUPTED
           : pair->batch[0] == 0 ? SB_NOT_MEASURED
                                 : SB_SAMPLES_INVALID;
}

// The reading is of whole batches; a frame each is wanted.
static void fill_ratio(const struct sb_gate_pair *pair, struct sb_history_row *row)
{
    const struct sb_interval *ratio = &pair->reading.ratio;
    const double frames = (double)pair->batch[SB_BASE] / pair->batch[SB_HEAD];
    row->ratio = frames * ratio->point;
    row->ratio_lo = frames * ratio->lo;
    row->ratio_hi = frames * ratio->hi;
}

static void fill_row(const struct sb_gate_session *session, int i,
                     const struct sb_history_measure_params *params,
                     struct sb_history_measured *measured)
{
    const struct sb_gate_pair *pair = &session->pair[i];
    const struct sb_task *head = &pair->task[SB_HEAD], *anchor = &pair->task[SB_BASE];
    const enum sb_status status = status_of(pair);
    struct sb_history_row *row = &measured->row[i];
    struct sb_arena *arena = &measured->arena;
    sb_history_row_init(row);
    row->suite = params->suite->name;
    row->scene = params->suite->entry[i].scene;
    row->variant = params->suite->entry[i].id;
    row->metric = sb_metric_rows[session->metric].name;
    row->renderer = measured->caps.renderer;
    row->version = measured->caps.version;
    row->threads = threads_text(arena, &measured->caps);
    row->status = sb_status_rows[status].word;
    if (anchor->loaded)
        row->anchor =
            hash_text(arena, sb_anchor_mark(params->anchor, anchor->prepared.input_hash));
    if (head->loaded)
        row->source_hash = hash_text(arena, head->assembly.source_hash);
    row->pairs = pair->count;
    if (pair->count > 0 && sb_status_rows[status].exit_code == 0)
        fill_ratio(pair, row);
    else
        sb_warn("%s %s: %s%s%s", row->scene, row->variant, row->status,
                head->note.length ? ": " : "", sb_text_get(&head->note));
    measured->exit_code =
        sb_exit_code_worse(measured->exit_code, sb_status_rows[status].exit_code);
}

// --- the whole -----------------------------------------------------------------------------------

static bool measure(struct sb_gate_session *session, const struct sb_gate_params *gate,
                    struct sb_history_measured *measured, struct sb_error *err)
{
    sb_progress("opening the driver");
    if (!sb_gate_session_open(session, gate, err))
        return false;
    measured->metric = session->metric;
    measured->caps = session->driver[SB_BASE].caps;
    if (!prepare_all(session, err) || !sb_gate_make_ready(session, err))
        return false;
    struct sb_gate_rounds rounds = {
        .session = session,
        .rule = &gate->rule,
        .fixed = true,
        .seconds = gate->settings->budget,
        .arena = &measured->arena,
    };
    return sb_gate_rounds_run(&rounds, err);
}

bool sb_history_measure(const struct sb_history_measure_params *params,
                        struct sb_history_measured *measured, struct sb_error *err)
{
    const int count = params->suite->entry_count;
    const int64_t begin = sb_clock_ns();
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
    struct sb_gate_session session = {.pair_count = count};
    gate.rule.confirm_pairs = params->pairs;
    session.pair = sb_alloc(((size_t)count + 1) * sizeof *session.pair);
    const bool good = measure(&session, &gate, measured, err);
    sb_progress("");
    if (good) {
        measured->row = sb_alloc(((size_t)count + 1) * sizeof *measured->row);
        measured->row_count = count;
        for (int i = 0; i < count; i++)
            fill_row(&session, i, params, measured);
    }
    measured->seconds = (double)(sb_clock_ns() - begin) * 1e-9;
    sb_gate_session_close(&session);
    return good;
}

void sb_history_measured_free(struct sb_history_measured *measured)
{
    free(measured->row);
    sb_arena_free(&measured->arena);
    *measured = (struct sb_history_measured){0};
}
