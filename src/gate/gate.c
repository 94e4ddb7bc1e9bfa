#include "gate/gate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/log.h"
#include "gate/state.h"
#include "measure/interrupt.h"
#include "stats/paired.h"

// --- before the pairs ----------------------------------------------------------------------------

static void prepare_all(struct sb_gate_session *session)
{
    for (int i = 0; i < session->pair_count && !sb_interrupted(); i++) {
        char line[80];
        snprintf(line, sizeof line, "compiling variant %d of %d on both sides", i + 1,
                 session->pair_count);
        sb_progress(line);
        sb_gate_session_prepare(session, i, i);
    }
}

static bool open_files(struct sb_gate_state *gate, struct sb_error *err)
{
    const char *dir = gate->params.dir;
    gate->pairs =
        sb_row_file_open(&(struct sb_row_file_params){dir, "pairs.csv", sb_pair_columns,
                                                      sb_pair_column_count},
                         err);
    gate->summary =
        gate->pairs ? sb_row_file_open(&(struct sb_row_file_params){dir, "gate.csv",
                                                                    sb_gate_columns,
                                                                    sb_gate_column_count},
                                       err)
                    : NULL;
    return gate->summary != NULL;
}

static int count_timed(const struct sb_gate_session *session)
{
    int count = 0;
    for (int i = 0; i < session->pair_count; i++)
        count += session->pair[i].active;
    return count;
}

// --- rows ----------------------------------------------------------------------------------------

const char *sb_gate_hash_text(struct sb_arena *arena, uint64_t hash)
{
    return sb_arena_printf(arena, "%016llx", (unsigned long long)hash);
}

static double median_frame(const struct sb_gate_pair *pair, int side)
{
    double *sorted = sb_alloc(((size_t)pair->count + 1) * sizeof *sorted);
    memcpy(sorted, pair->value[side], (size_t)pair->count * sizeof *sorted);
    sb_sort_doubles(sorted, pair->count);
    const double median = sb_median(sorted, pair->count);
    free(sorted);
    return median / pair->batch[side];
}

static void fill_values(const struct sb_gate_pair *pair, enum sb_metric metric,
                        struct sb_gate_row *row)
{
    const struct sb_gate_reading *reading = &pair->reading;
    row->batch = pair->batch[SB_HEAD];
    row->pairs = pair->count;
    row->ratio = reading->ratio.point;
    row->ratio_lo = reading->ratio.lo;
    row->ratio_hi = reading->ratio.hi;
    row->p_slower = reading->p_slower;
    row->p_within = reading->p_within;
    row->p_faster = reading->p_faster;
    row->alpha_spent = reading->alpha_spent;
    row->mde = reading->mde;
    row->autocorrelation = reading->autocorrelation;
    row->ties = reading->ties;
    if (metric == SB_METRIC_INSTRUCTIONS) {
        row->repeatability = pair->counts.repeatability;
        row->base_instructions = pair->counts.base / pair->batch[SB_BASE];
        row->head_instructions = pair->counts.head / pair->batch[SB_HEAD];
    } else {
        row->base_ms = median_frame(pair, SB_BASE) * 1e-6;
        row->head_ms = median_frame(pair, SB_HEAD) * 1e-6;
    }
}

static const char *note_of(struct sb_gate_state *gate, const struct sb_gate_pair *pair)
{
    struct sb_text text = {0};
    for (int side = 0; side < SB_SIDES; side++)
        if (pair->task[side].note.length)
            sb_text_printf(&text, "%s%s: %s", text.length ? "; " : "",
                           sb_side_names[side], pair->task[side].note.data);
    const char *note = text.length ? sb_arena_strdup(&gate->arena, text.data) : NULL;
    sb_text_free(&text);
    return note;
}

static enum sb_gate_verdict verdict_of(const struct sb_gate_pair *pair)
{
    const struct sb_task *base = &pair->task[SB_BASE], *head = &pair->task[SB_HEAD];
    if (!base->entry)
        return SB_GATE_INCONCLUSIVE; // interrupted before it was compiled
    if (!pair->timed && base->loaded && head->loaded)
        return SB_GATE_SKIPPED; // the same sources
    if (base->untimed && head->untimed)
        return SB_GATE_SKIPPED; // for accuracy only
    if (!sb_task_timed(base) || !sb_task_timed(head))
        return SB_GATE_INVALID;
    return pair->count == 0 ? SB_GATE_INCONCLUSIVE : pair->reading.verdict;
}

// What is held against itself is neither slower nor not.
static bool has_verdict(const struct sb_gate_state *gate, enum sb_gate_verdict verdict)
{
    return !gate->params.selftest || verdict == SB_GATE_INVALID ||
           verdict == SB_GATE_SKIPPED;
}

// What head got wrong comes first: base's own slips are mended by it.
static void fill_status(const struct sb_gate_pair *pair, struct sb_gate_row *row)
{
    const enum sb_side side =
        pair->task[SB_HEAD].status == SB_OK && pair->task[SB_BASE].status != SB_OK
            ? SB_BASE
            : SB_HEAD;
    const enum sb_status status = pair->task[side].status;
    row->status = sb_status_rows[status].word;
    if (status != SB_OK)
        row->status_of = sb_side_names[side];
}

static void fill_row(struct sb_gate_state *gate, int i)
{
    const struct sb_gate_pair *pair = &gate->session.pair[i];
    const struct sb_task *base = &pair->task[SB_BASE], *head = &pair->task[SB_HEAD];
    struct sb_gate_row *row = &gate->row[i];
    const struct sb_gate_row earlier = *row; // of a confirmation
    sb_gate_row_init(row);
    row->variant =
        head->entry ? head->entry->id : gate->params.side[SB_HEAD].suite->entry[i].id;
    row->scene = gate->params.side[SB_HEAD].suite->entry[i].scene;
    const enum sb_gate_verdict verdict = verdict_of(pair);
    if (has_verdict(gate, verdict))
        row->verdict = sb_gate_verdict_rows[verdict].word;
    fill_status(pair, row);
    row->picture = pair->picture;
    row->metric = sb_metric_rows[gate->session.metric].name;
    row->tolerance = gate->params.rule.tolerance;
    if (pair->count > 0)
        fill_values(pair, gate->session.metric, row);
    row->confirm_ratio = earlier.confirm_ratio;
    row->confirm_p = earlier.confirm_p;
    if (base->accuracy.known && head->accuracy.known) {
        row->base_max_err = base->accuracy.total.max;
        row->head_max_err = head->accuracy.total.max;
    }
    if (base->loaded)
        row->base_source = sb_gate_hash_text(&gate->arena, base->assembly.source_hash);
    if (head->loaded)
        row->head_source = sb_gate_hash_text(&gate->arena, head->assembly.source_hash);
    row->note = pair->timed || !base->loaded || !head->loaded
                    ? note_of(gate, pair)
                    : "the final sources are equal: nothing to compare";
}

static bool write_rows(struct sb_gate_state *gate, struct sb_error *err)
{
    for (int i = 0; i < gate->session.pair_count; i++)
        fill_row(gate, i);
    return sb_row_file_replace(gate->summary, gate->row, gate->session.pair_count,
                               sizeof *gate->row, err);
}

// --- confirmations -------------------------------------------------------------------------------

// A guard, not a budget: fewer pairs than all decide nothing, and these take seconds, unless a frame
// takes a quarter of one.
enum { CONFIRM_SECONDS = 60 };

// One candidate, alone, in a fresh process. What cannot be measured again is not confirmed, and
// says so.
static bool confirm(struct sb_gate_state *gate, int i, int process, struct sb_error *err)
{
    struct sb_gate_pair *candidate = &gate->session.pair[i];
    struct sb_gate_session fresh = {
        .process = process,
        .metric = gate->session.metric,
        .timer = gate->session.timer,
        .pair_count = 1,
    };
    struct sb_error failure = {0};
    bool good = true;
    fresh.pair = sb_alloc(sizeof *fresh.pair);
    sb_progress("confirming a candidate in a fresh process");
    if (!sb_gate_session_open(&fresh, &gate->params, &failure)) {
        sb_task_note(&candidate->task[SB_HEAD], "no fresh process: %s", failure.text);
        candidate->reading.verdict = SB_GATE_INCONCLUSIVE;
        goto done;
    }
    sb_gate_session_prepare(&fresh, 0, i);
    fresh.pair[0].timed = true;
    struct sb_gate_rounds rounds = {
        .session = &fresh,
        .rule = &gate->params.rule,
        .fixed = true,
        .seconds = fmax(gate->params.settings->budget, CONFIRM_SECONDS),
        .file = gate->pairs,
        .arena = &gate->arena,
    };
    good = !sb_gate_make_ready(&fresh, &failure) || sb_gate_rounds_run(&rounds, err);
    if (failure.status != SB_OK)
        sb_task_note(&candidate->task[SB_HEAD], "in a fresh process: %s", failure.text);
    const struct sb_gate_pair *pair = &fresh.pair[0];
    for (int side = 0; side < SB_SIDES; side++)
        if (sb_status_rows[pair->task[side].status].exit_code != 0)
            sb_task_note(&candidate->task[SB_HEAD], "in a fresh process %s: %s",
                         sb_side_names[side], sb_text_get(&pair->task[side].note));
    candidate->reading.verdict = sb_task_timed(&pair->task[SB_BASE]) &&
                                         sb_task_timed(&pair->task[SB_HEAD]) &&
                                         pair->count > 0
                                     ? pair->reading.verdict
                                     : SB_GATE_INCONCLUSIVE;
    if (candidate->reading.verdict == SB_GATE_INCONCLUSIVE)
        sb_task_note(
            &candidate->task[SB_HEAD],
            "slower, but a fresh process gave %d of %d pairs that could confirm it",
            pair->count, gate->params.rule.confirm_pairs);
    if (pair->count > 0) {
        gate->row[i].confirm_ratio = pair->reading.ratio.point;
        gate->row[i].confirm_p = pair->reading.p_slower;
    }
done:
    sb_gate_session_close(&fresh);
    sb_progress("");
    return good;
}

// A process has one context: where this one draws itself, it must let go first.
static void let_go(struct sb_gate_session *session)
{
    const bool apart = session->params->apart;
    for (int side = 0; side < SB_SIDES; side++) {
        struct sb_driver *driver = &session->driver[side];
        if (!session->open[side] || driver->fns->workers)
            continue;
        for (int i = 0; i < session->pair_count; i++)
            for (int s = 0; s < SB_SIDES; s++) {
                const struct sb_task *task = &session->pair[i].task[s];
                if (task->loaded && (s == side || !apart))
                    driver->fns->release(driver->runner, task->assembly.job.id);
            }
        sb_driver_close(driver);
        session->open[side] = false;
    }
    if (!apart)
        session->driver[SB_HEAD].runner = session->driver[SB_BASE].runner;
}

// A candidate that nobody could ask a second time is none.
static void drop_candidates(struct sb_gate_session *session, const char *why)
{
    for (int i = 0; i < session->pair_count; i++) {
        struct sb_gate_pair *pair = &session->pair[i];
        if (pair->count == 0 || pair->reading.verdict != SB_GATE_CANDIDATE)
            continue;
        pair->reading.verdict = SB_GATE_INCONCLUSIVE;
        sb_task_note(&pair->task[SB_HEAD],
                     "slower, but %s before a fresh process could confirm it", why);
    }
}

static bool confirm_all(struct sb_gate_state *gate, struct sb_error *err)
{
    struct sb_gate_session *session = &gate->session;
    int process = 0;
    for (int i = 0; i < session->pair_count; i++) {
        struct sb_gate_pair *pair = &session->pair[i];
        if (pair->reading.verdict != SB_GATE_CANDIDATE || pair->count == 0)
            continue;
        if (sb_interrupted())
            break;
        if (process == 0)
            let_go(session);
        if (!confirm(gate, i, ++process, err))
            return false;
    }
    drop_candidates(session, "interrupted");
    return true;
}

// --- the whole -----------------------------------------------------------------------------------

static void conclude(struct sb_gate_state *gate, struct sb_gate_result *result)
{
    const struct sb_gate_session *session = &gate->session;
    double *mde = sb_alloc(((size_t)session->pair_count + 1) * sizeof *mde);
    int timed = 0;
    for (int i = 0; i < session->pair_count; i++) {
        const struct sb_gate_pair *pair = &session->pair[i];
        const struct sb_task *base = &pair->task[SB_BASE], *head = &pair->task[SB_HEAD];
        const enum sb_gate_verdict verdict = verdict_of(pair);
        if (has_verdict(gate, verdict))
            result->count[verdict]++;
        int code = sb_status_rows[head->status].exit_code;
        // What base alone got wrong, head has mended.
        if (code == 0 && verdict == SB_GATE_INVALID &&
            sb_status_rows[base->status].exit_code == 0)
            code = sb_status_rows[SB_SAMPLES_INVALID].exit_code;
        if (verdict == SB_GATE_REGRESSION && !gate->params.selftest)
            code = sb_exit_code_worse(code, sb_status_rows[SB_WORSE_PICTURE].exit_code);
        result->exit_code = sb_exit_code_worse(result->exit_code, code);
        if (pair->count > 0 && !isnan(pair->reading.mde))
            mde[timed++] = pair->reading.mde;
    }
    sb_sort_doubles(mde, timed);
    result->median_mde = timed ? sb_median(mde, timed) : NAN;
    free(mde);
    result->interrupted = sb_interrupted();
    if (result->interrupted)
        result->exit_code = sb_exit_code_worse(result->exit_code,
                                               sb_status_rows[SB_INTERRUPTED].exit_code);
}

// The bias of a program against itself, over all variants. From fewer pairs than were planned
// there is none: small ones would pass for want of proof.
static void judge_bias(struct sb_gate_state *gate, struct sb_gate_result *result)
{
    const struct sb_gate_session *session = &gate->session;
    const bool counted = session->metric == SB_METRIC_INSTRUCTIONS;
    struct sb_interval *ratio =
        sb_alloc(((size_t)session->pair_count + 1) * sizeof *ratio);
    int count = 0;
    for (int i = 0; i < session->pair_count; i++)
        count += session->pair[i].count > 0;
    for (int i = 0; i < session->pair_count; i++) {
        const struct sb_gate_pair *pair = &session->pair[i];
        result->bias_incomplete |= !counted && sb_gate_pair_timed(pair) &&
                                   pair->count < gate->params.rule.confirm_pairs;
        if (counted && pair->count > 0) {
            ratio[i] = pair->reading.ratio;
            continue;
        }
        double *scratch = sb_alloc(((size_t)pair->count + 1) * sizeof *scratch);
        ratio[i] = sb_paired_ratio(pair->value[SB_BASE], pair->value[SB_HEAD],
                                   pair->count, 1 - 0.05 / fmax(count, 1), scratch);
        free(scratch);
    }
    result->bias = sb_gate_bias(ratio, session->pair_count, gate->params.rule.tolerance);
    result->bias.tolerable &= !result->bias_incomplete;
    if (!result->bias.tolerable && !result->interrupted)
        result->exit_code = sb_exit_code_worse(
            result->exit_code, sb_status_rows[SB_SAMPLES_INVALID].exit_code);
    free(ratio);
}

static void fail_timed(struct sb_gate_session *session, const struct sb_error *err)
{
    for (int i = 0; i < session->pair_count; i++) {
        struct sb_gate_pair *pair = &session->pair[i];
        if (sb_gate_pair_timed(pair))
            sb_task_fail(&pair->task[SB_HEAD], err);
        pair->active = false;
    }
}

static bool compare(struct sb_gate_state *gate, struct sb_gate_result *result,
                    struct sb_error *err)
{
    struct sb_gate_session *session = &gate->session;
    const struct sb_gate_params *params = &gate->params;
    sb_progress("opening the sides");
    if (!sb_gate_session_open(session, params, err))
        return false;
    result->metric = session->metric;
    const struct sb_driver *driver = &session->driver[SB_BASE];
    const bool counts = session->metric == SB_METRIC_INSTRUCTIONS;
    result->timer = sb_metric_rows[session->metric].source;
    if (!result->timer && !counts)
        result->timer = driver->audit.source[driver->timer].name;
    for (int side = 0; side < SB_SIDES; side++)
        result->caps[side] = session->driver[side].caps;
    if (counts && !sb_gate_counts_open(gate, result, err))
        return false;
    prepare_all(session);
    sb_progress("comparing the pictures");
    sb_gate_pictures(session);
    for (int i = 0; i < session->pair_count; i++)
        session->pair[i].active = sb_gate_pair_timed(&session->pair[i]);
    // Without a metric to believe there are pictures all the same, and what is wrong with them.
    struct sb_error none = {0};
    if (!counts && !sb_gate_make_ready(session, &none))
        fail_timed(session, &none);
    gate->params.rule.variants = count_timed(session) > 0 ? count_timed(session) : 1;
    result->rule = gate->params.rule;
    if (!sb_gate_record(gate, result, false, err) || !write_rows(gate, err))
        return false;
    if (counts)
        return sb_gate_counts_run(gate, result, err) &&
               (params->selftest || sb_gate_counts_confirm(gate, err));
    struct sb_gate_rounds rounds = {
        .session = session,
        .rule = &gate->params.rule,
        .fixed = params->selftest,
        .seconds = params->selftest ? fmax(params->settings->budget, CONFIRM_SECONDS)
                                    : params->settings->budget,
        .file = gate->pairs,
        .arena = &gate->arena,
    };
    return sb_gate_rounds_run(&rounds, err) &&
           (params->selftest || confirm_all(gate, err));
}

bool sb_gate_run(const struct sb_gate_params *params, struct sb_gate_result *result,
                 struct sb_error *err)
{
    struct sb_gate_state *gate = sb_alloc(sizeof *gate);
    const int count = params->side[SB_HEAD].suite->entry_count;
    const int64_t begin = sb_clock_ns();
    struct sb_error ignored;
    result->state = gate;
    gate->params = *params;
    sb_timestamp(gate->started);
    gate->session.pair = sb_alloc(((size_t)count + 1) * sizeof *gate->session.pair);
    gate->session.pair_count = count;
    gate->row = sb_alloc(((size_t)count + 1) * sizeof *gate->row);
    for (int i = 0; i < count; i++)
        sb_gate_row_init(&gate->row[i]);
    if (!open_files(gate, err))
        return false;
    const bool good = compare(gate, result, err);
    sb_progress("");
    result->seconds = (double)(sb_clock_ns() - begin) * 1e-9;
    if (!good && err->status != SB_WRITE_FAILED)
        return false;
    if (!good)
        drop_candidates(&gate->session, "the pairs could not be written");
    conclude(gate, result);
    if (params->selftest)
        judge_bias(gate, result);
    // What was measured is kept, whatever went wrong with the files before.
    const bool written = write_rows(gate, good ? err : &ignored);
    result->row = gate->row;
    result->row_count = count;
    if (good)
        return written && sb_gate_record(gate, result, !result->interrupted, err);
    result->exit_code =
        sb_exit_code_worse(result->exit_code, sb_status_rows[err->status].exit_code);
    return false;
}

const double *sb_gate_values(const struct sb_gate_result *result, int row,
                             enum sb_side side)
{
    return result->state->session.pair[row].value[side];
}

void sb_gate_result_free(struct sb_gate_result *result)
{
    struct sb_gate_state *gate = result->state;
    if (gate) {
        sb_gate_session_close(&gate->counting);
        sb_gate_session_close(&gate->session);
        sb_row_file_close(&gate->pairs);
        sb_row_file_close(&gate->summary);
        sb_arena_free(&gate->arena);
        free(gate->row);
        free(gate);
    }
    *result = (struct sb_gate_result){0};
}
