// Metric instructions: a few counts of one frame of each side, by a process of their own, since
// valgrind is slow and shows a driver another processor. Pictures are judged before, without it.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cpu.h"
#include "base/log.h"
#include "gate/state.h"
#include "measure/interrupt.h"
#include "stats/counts.h"

enum { WARM_PAIRS = 2 }; // of the first variant: what a process binds late is bound then

const char *const sb_counts_environment[SB_COUNTS_ENVIRONMENT] = {
    "LP_NUM_THREADS=0", "MESA_SHADER_CACHE_DISABLE=true"};

static void add_clause(struct sb_text *text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void add_clause(struct sb_text *text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (text->length)
        sb_text_add(text, ", ");
    sb_text_vprintf(text, format, args);
    va_end(args);
}

void sb_gate_other_code(const struct sb_caps *timed, const struct sb_caps *counted,
                        char *words, size_t size)
{
    struct sb_text text = {0}, hidden = {0};
    sb_cpu_lacking(timed->cpu_features, counted->cpu_features, &hidden);
    if (hidden.length)
        add_clause(&text, "%s hides %s", counted->counter, hidden.data);
    if (strcmp(timed->cpu, counted->cpu) != 0)
        add_clause(&text, "shows %s for %s", counted->cpu, timed->cpu);
    if (strcmp(timed->renderer, counted->renderer) != 0)
        add_clause(&text, "the driver is %s there and %s here", counted->renderer,
                   timed->renderer);
    snprintf(words, size, "%s%s",
             text.length ? "the code counted is not the code timed: " : "",
             sb_text_get(&text));
    sb_text_free(&hidden);
    sb_text_free(&text);
}

// --- the process that counts ---------------------------------------------------------------------

static bool may_count(const struct sb_gate_session *session, struct sb_error *err)
{
    for (int side = 0; side < SB_SIDES; side++) {
        const struct sb_driver *driver = &session->driver[side];
        if (!driver->caps.software)
            return sb_fail(err, SB_BAD_INPUT,
                           "--metric instructions counts what a CPU does, and %s is not "
                           "known to draw on one; valid: gpu, cpu, wall",
                           driver->caps.renderer);
        if (!driver->fns->workers && strcmp(driver->caps.context, "null") != 0)
            return sb_fail(err, SB_BAD_INPUT,
                           "--metric instructions counts in a process of its own: leave "
                           "out --in-process");
    }
    return true;
}

static bool open_counting(const struct sb_gate_state *gate, struct sb_gate_session *to,
                          int process, struct sb_error *err)
{
    const struct sb_gate_session *plain = &gate->session;
    *to = (struct sb_gate_session){
        .process = process,
        .metric = SB_METRIC_INSTRUCTIONS,
        .callgrind = !plain->driver[SB_BASE].caps.counter[0],
        .pair_count = plain->pair_count,
        .pair = sb_alloc(((size_t)plain->pair_count + 1) * sizeof *to->pair),
    };
    if (!sb_gate_session_open(to, &gate->params, err))
        return false;
    for (int side = 0; side < SB_SIDES; side++)
        if (!to->driver[side].caps.counter[0])
            return sb_fail(err, SB_BAD_INPUT,
                           "nothing counts instructions here: the kernel offers no "
                           "counter, and this shadebench-worker was built without "
                           "valgrind's headers");
    return true;
}

bool sb_gate_counts_open(struct sb_gate_state *gate, struct sb_gate_result *result,
                         struct sb_error *err)
{
    if (!may_count(&gate->session, err) || !open_counting(gate, &gate->counting, 0, err))
        return false;
    struct sb_gate_counting *told = &result->counting;
    for (int side = 0; side < SB_SIDES; side++)
        told->caps[side] = gate->counting.driver[side].caps;
    result->timer = told->caps[SB_BASE].counter;
    sb_gate_other_code(&result->caps[SB_BASE], &told->caps[SB_BASE], told->other_code,
                       sizeof told->other_code);
    return true;
}

// All of them before the first count: to switch callgrind on or off throws away what valgrind has
// translated, and a compiler is a lot to translate again.
static void prepare_wanted(struct sb_gate_session *counting)
{
    for (int i = 0; i < counting->pair_count && !sb_interrupted(); i++) {
        char line[96];
        if (!counting->pair[i].active)
            continue;
        snprintf(line, sizeof line, "compiling variant %d of %d to be counted", i + 1,
                 counting->pair_count);
        sb_progress(line);
        sb_gate_session_prepare(counting, i, i);
    }
}

// --- counts --------------------------------------------------------------------------------------

static struct sb_counts_reading read_counts(const struct sb_gate_state *gate,
                                            const struct sb_gate_pair *pair, bool over)
{
    double scratch[SB_COUNTS_MOST];
    return sb_counts_read(gate->params.rule.tolerance, pair->value[SB_BASE],
                          pair->value[SB_HEAD], pair->count, over, scratch);
}

// Counts into the pair and the gate's file until the reading is not open. *failure: no count came.
// False: the file could not be written.
static bool count_repeats(struct sb_gate_state *gate, struct sb_gate_session *counting,
                          struct sb_gate_pair *pair, int warm, struct sb_error *failure,
                          struct sb_error *err)
{
    pair->batch[SB_BASE] = pair->batch[SB_HEAD] = 1;
    pair->counts.verdict = SB_GATE_OPEN;
    for (int r = -warm; pair->counts.verdict == SB_GATE_OPEN; r++) {
        const enum sb_side first = r % 2 ? SB_HEAD : SB_BASE;
        const bool over = sb_interrupted() || r + 1 >= 2 * SB_COUNTS_MOST;
        struct sb_sample sample[SB_SIDES];
        struct sb_pair_row row;
        if (!sb_gate_pair_shoot(counting, pair, first, sample, failure))
            return true;
        for (int side = 0; side < SB_SIDES; side++)
            if (!sb_driver_holds(&counting->driver[side], sample[side].job, failure))
                return true;
        if (r < 0)
            continue;
        sb_gate_pair_row(counting, pair, r, first, sample, &row);
        if (!sb_row_file_add(gate->pairs, &row, 1, sizeof row, err))
            return false;
        sb_gate_pair_keep(pair, SB_METRIC_INSTRUCTIONS, 0, sample);
        pair->counts = read_counts(gate, pair, over);
    }
    return true;
}

// Why a pair that was to be counted cannot be, and the side whose fault it is; SB_OK where it can.
// What both sides cannot is head's: nothing speaks for it.
static enum sb_side why_not(const struct sb_gate_pair *pair, struct sb_error *why)
{
    enum sb_side which = SB_HEAD;
    for (int side = 0; side < SB_SIDES; side++) {
        const struct sb_task *task = &pair->task[side];
        if (sb_task_sound(task))
            continue;
        which = (enum sb_side)side;
        sb_fail(why, task->status, "to be counted: %s", sb_text_get(&task->note));
    }
    return which;
}

struct outcome { // what becomes of a reading, and of a pair that has none
    void (*take)(struct sb_gate_state *, int i, const struct sb_gate_pair *counted);
    void (*lose)(struct sb_gate_state *, int i, enum sb_side, const struct sb_error *why);
};

// Counts the pairs of `counting` that are active.
static bool count_all(struct sb_gate_state *gate, struct sb_gate_session *counting,
                      const struct outcome *outcome, struct sb_error *err)
{
    int warm = WARM_PAIRS;
    prepare_wanted(counting);
    for (int i = 0; i < counting->pair_count && !sb_interrupted(); i++) {
        struct sb_gate_pair *pair = &counting->pair[i];
        struct sb_error failure = {0};
        char line[96];
        if (!pair->active)
            continue;
        snprintf(line, sizeof line, "counting variant %d of %d", i + 1,
                 counting->pair_count);
        sb_progress(line);
        const enum sb_side side = why_not(pair, &failure);
        if (failure.status == SB_OK &&
            !count_repeats(gate, counting, pair, warm, &failure, err))
            return false;
        warm = 0;
        if (failure.status != SB_OK)
            outcome->lose(gate, i, side, &failure);
        else
            outcome->take(gate, i, pair);
    }
    sb_progress("");
    return true;
}

// --- the gate's own, and confirmations -----------------------------------------------------------

static void take_first(struct sb_gate_state *gate, int i,
                       const struct sb_gate_pair *counted)
{
    struct sb_gate_pair *pair = &gate->session.pair[i];
    pair->batch[SB_BASE] = counted->batch[SB_BASE];
    pair->batch[SB_HEAD] = counted->batch[SB_HEAD];
    pair->counts = counted->counts;
    for (int side = 0; side < SB_SIDES; side++) {
        pair->value[side] =
            sb_alloc(((size_t)counted->count + 1) * sizeof *pair->value[side]);
        memcpy(pair->value[side], counted->value[side],
               (size_t)counted->count * sizeof *pair->value[side]);
    }
    pair->count = pair->capacity = counted->count;
    pair->reading = (struct sb_gate_reading){
        .verdict = pair->counts.verdict,
        .n = counted->count,
        .ratio = pair->counts.ratio,
        .p_slower = NAN,
        .p_within = NAN,
        .p_faster = NAN,
        .alpha_spent = NAN,
        .mde = NAN,
        .autocorrelation = NAN,
    };
    if (pair->counts.verdict == SB_GATE_INCONCLUSIVE && pair->count > 0)
        sb_task_note(&pair->task[SB_HEAD],
                     "counts of one frame differ by %.2g %%, the tolerance is %.3g %%",
                     100 * pair->counts.repeatability, 100 * gate->params.rule.tolerance);
}

static void lose_first(struct sb_gate_state *gate, int i, enum sb_side side,
                       const struct sb_error *why)
{
    sb_task_fail(&gate->session.pair[i].task[side], why);
}

static void add_reading(const struct sb_counts_reading *reading,
                        struct sb_gate_counting *told)
{
    told->repeatability = fmax(told->repeatability, reading->repeatability);
    told->counts += SB_SIDES * reading->n;
    told->apart += reading->apart;
    if (fabs(reading->farthest) > fabs(told->farthest))
        told->farthest = reading->farthest;
}

bool sb_gate_counts_run(struct sb_gate_state *gate, struct sb_gate_result *result,
                        struct sb_error *err)
{
    const struct sb_gate_session *session = &gate->session;
    for (int i = 0; i < session->pair_count; i++)
        gate->counting.pair[i].active = session->pair[i].active;
    const struct outcome outcome = {take_first, lose_first};
    const bool good = count_all(gate, &gate->counting, &outcome, err);
    result->counting.repeatability = NAN;
    for (int i = 0; i < session->pair_count; i++)
        if (session->pair[i].count > 0)
            add_reading(&session->pair[i].counts, &result->counting);
    return good;
}

static void take_again(struct sb_gate_state *gate, int i,
                       const struct sb_gate_pair *counted)
{
    gate->session.pair[i].reading.verdict = sb_counts_confirm(&counted->counts);
    gate->row[i].confirm_ratio = counted->counts.ratio.point;
}

// It stays a candidate, which nobody has confirmed.
static void lose_again(struct sb_gate_state *gate, int i, enum sb_side side,
                       const struct sb_error *why)
{
    sb_task_note(&gate->session.pair[i].task[SB_HEAD], "in a fresh process %s: %s",
                 sb_side_names[side], why->text);
}

bool sb_gate_counts_confirm(struct sb_gate_state *gate, struct sb_error *err)
{
    struct sb_gate_session fresh = {0};
    struct sb_gate_session *session = &gate->session;
    struct sb_error failure = {0};
    int candidates = 0;
    bool good = true;
    for (int i = 0; i < session->pair_count; i++)
        candidates += session->pair[i].reading.verdict == SB_GATE_CANDIDATE;
    if (candidates == 0)
        return true;
    sb_progress("confirming candidates in a fresh process");
    if (!sb_interrupted() && open_counting(gate, &fresh, 1, &failure)) {
        for (int i = 0; i < session->pair_count; i++)
            fresh.pair[i].active = session->pair[i].reading.verdict == SB_GATE_CANDIDATE;
        const struct outcome outcome = {take_again, lose_again};
        good = count_all(gate, &fresh, &outcome, err);
    }
    sb_gate_session_close(&fresh);
    for (int i = 0; i < session->pair_count; i++) {
        if (session->pair[i].reading.verdict != SB_GATE_CANDIDATE)
            continue;
        session->pair[i].reading.verdict = SB_GATE_INCONCLUSIVE;
        sb_task_note(&session->pair[i].task[SB_HEAD],
                     "more instructions, but no fresh process has confirmed it%s%s",
                     failure.text[0] ? ": " : "", failure.text);
    }
    return good;
}
