// Timed pairs: a batch of base and one of head, back to back, first the one, then the other.
#include <math.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/log.h"
#include "gate/state.h"
#include "measure/calibrate.h"
#include "measure/interrupt.h"
#include "stats/schedule.h"

enum { BATCH_MAX = 4096, WARM_ROUNDS = 2 };
#define LONGEST_NS 100e6 // a batch of the slower side, where the sides differ a lot

static struct sb_shot shot_of(const struct sb_gate_pair *pair, int side, int frames)
{
    return (struct sb_shot){
        .job = pair->task[side].assembly.job.id, .frames = frames, .shrink = 1};
}

bool sb_gate_pair_timed(const struct sb_gate_pair *pair)
{
    return pair->timed && sb_task_timed(&pair->task[SB_BASE]) &&
           sb_task_timed(&pair->task[SB_HEAD]);
}

static bool shoot(struct sb_gate_session *session, const struct sb_shot *shot, int side,
                  struct sb_sample *sample, struct sb_error *err)
{
    const struct sb_driver *driver = &session->driver[side];
    return driver->fns->round(driver->runner, shot, 1, sample, err);
}

// One batch by the metric in ns, the least of three that are sound.
static bool least(struct sb_gate_session *session, const struct sb_gate_pair *pair,
                  int side, int frames, int shrink, double *ns, struct sb_error *err)
{
    struct sb_shot shot = shot_of(pair, side, frames);
    shot.shrink = shrink;
    *ns = INFINITY;
    for (int good = 0, tries = 0; good < 3 && tries < 8; tries++) {
        struct sb_sample sample = {0};
        if (!shoot(session, &shot, side, &sample, err))
            return false;
        const int64_t value = sb_metric_value(session->metric, &sample);
        if (value > 0) {
            *ns = fmin(*ns, (double)value);
            good++;
        } else if (sample.flags & SB_SAMPLE_LOST &&
                   !sb_driver_holds(&session->driver[side], shot.job, err)) {
            return false;
        }
    }
    return isfinite(*ns) || sb_fail(err, SB_SAMPLES_INVALID,
                                    "no batch of %d frames has a valid time", frames);
}

// How long a batch must be: batch_ms, and by a GPU's timer what its step and what it misses ask for.
static double wanted_ns(const struct sb_gate_session *session, int from, int to)
{
    const struct sb_measure_settings *settings = session->params->settings;
    double wanted = settings->batch_ms * 1e6;
    for (int side = from; side < to && session->metric == SB_METRIC_GPU; side++)
        wanted = fmax(wanted, sb_calibrate_wanted_ns(&session->driver[side], settings));
    return wanted;
}

// The fewest frames for which sides [from, to) all take that, unless one then takes too long.
// *failed: the side where it failed.
static bool calibrate_sides(struct sb_gate_session *session, struct sb_gate_pair *pair,
                            int from, int to, enum sb_side *failed, struct sb_error *err)
{
    const struct sb_measure_settings *settings = session->params->settings;
    const double wanted = wanted_ns(session, from, to);
    int batch = settings->batch > 0 ? (int)settings->batch : 1;
    for (int step = 0; step < 16 && settings->batch <= 0; step++) {
        double shorter = INFINITY, longer = 0;
        for (int side = from; side < to; side++) {
            double ns;
            *failed = (enum sb_side)side;
            if (!least(session, pair, side, batch, 1, &ns, err))
                return false;
            shorter = fmin(shorter, ns);
            longer = fmax(longer, ns);
        }
        if (shorter >= wanted || longer >= LONGEST_NS || batch >= BATCH_MAX)
            break;
        const double factor =
            fmin(fmin(fmax(wanted / shorter, 1.1), 10), fmax(LONGEST_NS / longer, 1.1));
        batch = (int)fmin(ceil(batch * factor), BATCH_MAX);
    }
    for (int side = from; side < to; side++)
        pair->batch[side] = batch;
    return true;
}

static bool calibrate(struct sb_gate_session *session, struct sb_gate_pair *pair,
                      enum sb_side *failed, struct sb_error *err)
{
    if (!session->params->own_batches)
        return calibrate_sides(session, pair, 0, SB_SIDES, failed, err);
    for (int side = 0; side < SB_SIDES; side++)
        if (!calibrate_sides(session, pair, side, side + 1, failed, err))
            return false;
    return true;
}

// The pixels of K frames in one batch must take what those of K frames take that are drained one by
// one, or nearly: else the driver drops draws that nobody will see, and the metric compares the
// wrong work. A frame of a quarter of the pixels tells what they take: what waiting costs, which
// of a small frame is the most, is in both. Frames under a millisecond tell nothing, nor do those
// that hardly depend on their pixels: *judged. *share: of what the pixels take.
static bool read_metric(struct sb_gate_session *session, const struct sb_gate_pair *pair,
                        int side, bool *judged, double *share, struct sb_error *err)
{
    enum { FRAMES = 4 };
    double one, quarter, batch;
    *share = 1;
    if (!least(session, pair, side, 1, 1, &one, err))
        return false;
    *judged = one >= 1e6;
    if (!*judged)
        return true;
    if (!least(session, pair, side, 1, 2, &quarter, err) ||
        !least(session, pair, side, FRAMES, 1, &batch, err))
        return false;
    const double pixels = (one - quarter) / 0.75;
    *judged = pixels >= 0.25 * one;
    if (*judged)
        *share = batch / (FRAMES * pixels);
    return true;
}

// On a busy machine a reading may be wrong. A driver that drops draws does it each time.
static bool check_metric(struct sb_gate_session *session, const struct sb_gate_pair *pair,
                         int side, bool *judged, struct sb_error *err)
{
    double share = 0;
    for (int attempt = 0; attempt < 4 && share < 0.7; attempt++)
        if (!read_metric(session, pair, side, judged, &share, err))
            return false;
    return share >= 0.7 ||
           sb_fail(err, SB_NO_TIMER,
                   "%s of four frames in one batch is %.2f of what as many frames take "
                   "for their pixels alone, drained one by one: draws were dropped",
                   sb_metric_rows[session->metric].name, share);
}

bool sb_gate_pair_shoot(struct sb_gate_session *session, const struct sb_gate_pair *pair,
                        enum sb_side first, struct sb_sample sample[SB_SIDES],
                        struct sb_error *err)
{
    const enum sb_side order[SB_SIDES] = {first, first == SB_BASE ? SB_HEAD : SB_BASE};
    struct sb_shot shot[SB_SIDES];
    struct sb_sample got[SB_SIDES] = {{0}};
    for (int i = 0; i < SB_SIDES; i++)
        shot[i] = shot_of(pair, order[i], pair->batch[order[i]]);
    bool good = true;
    if (!session->params->apart) {
        const struct sb_driver *driver = &session->driver[SB_BASE];
        good = driver->fns->round(driver->runner, shot, SB_SIDES, got, err);
    } else {
        for (int i = 0; good && i < SB_SIDES; i++)
            good = shoot(session, &shot[i], (int)order[i], &got[i], err);
    }
    for (int i = 0; i < SB_SIDES; i++)
        sample[order[i]] = got[i];
    return good;
}

// Whose fault is it that a pair failed? Base's, if it fails alone and head does not: else nothing
// speaks for head.
static enum sb_side blame(struct sb_gate_session *session,
                          const struct sb_gate_pair *pair)
{
    bool good[SB_SIDES];
    for (int side = 0; side < SB_SIDES; side++) {
        const struct sb_shot shot = shot_of(pair, side, 1);
        struct sb_sample sample;
        struct sb_error ignored = {0};
        good[side] = shoot(session, &shot, side, &sample, &ignored);
    }
    return good[SB_HEAD] && !good[SB_BASE] ? SB_BASE : SB_HEAD;
}

static void fail_pair(struct sb_gate_pair *pair, enum sb_side side,
                      const struct sb_error *err)
{
    sb_task_fail(&pair->task[side], err);
    pair->active = false;
}

// Before the pairs, a side at a time: whose fault it is is known.
static bool ready_sides(struct sb_gate_session *session, struct sb_gate_pair *pair,
                        bool *proven, enum sb_side *side, struct sb_error *err)
{
    struct sb_sample sample[SB_SIDES];
    bool judged[SB_SIDES] = {*proven, *proven};
    for (*side = SB_BASE; !*proven && *side < SB_SIDES; (*side)++)
        if (!check_metric(session, pair, (int)*side, &judged[*side], err))
            return false;
    *proven = judged[SB_BASE] && judged[SB_HEAD];
    if (!calibrate(session, pair, side, err))
        return false;
    for (int r = 0; r < WARM_ROUNDS; r++)
        if (!sb_gate_pair_shoot(session, pair, r % 2 ? SB_HEAD : SB_BASE, sample, err)) {
            *side = blame(session, pair);
            return false;
        }
    return true;
}

bool sb_gate_make_ready(struct sb_gate_session *session, struct sb_error *err)
{
    // By the audit, or, in a confirmation, before.
    bool proven = session->metric == SB_METRIC_GPU || session->process > 0;
    for (int i = 0; i < session->pair_count && !sb_interrupted(); i++) {
        struct sb_gate_pair *pair = &session->pair[i];
        struct sb_error failure = {0};
        enum sb_side side;
        pair->active = sb_gate_pair_timed(pair);
        if (!pair->active)
            continue;
        if (ready_sides(session, pair, &proven, &side, &failure))
            continue;
        if (failure.status == SB_NO_TIMER) { // of all variants
            *err = failure;
            return false;
        }
        fail_pair(pair, side, &failure);
    }
    return true;
}

// --- the rounds ----------------------------------------------------------------------------------

void sb_gate_pair_keep(struct sb_gate_pair *pair, enum sb_metric metric, int process,
                       const struct sb_sample sample[SB_SIDES])
{
    int capacity = pair->capacity;
    int64_t value[SB_SIDES];
    const unsigned flags = sample[SB_BASE].flags | sample[SB_HEAD].flags;
    for (int side = 0; side < SB_SIDES; side++)
        if ((value[side] = sb_metric_value(metric, &sample[side])) <= 0) {
            pair->flagged += !(flags & SB_SAMPLE_LOST);
            return;
        }
    pair->process = sb_grow(pair->process, pair->count, &capacity, sizeof *pair->process);
    pair->process[pair->count] = process;
    for (int side = 0; side < SB_SIDES; side++) {
        capacity = pair->capacity;
        pair->value[side] =
            sb_grow(pair->value[side], pair->count, &capacity, sizeof *pair->value[side]);
        pair->value[side][pair->count] = (double)value[side];
    }
    pair->capacity = capacity;
    pair->count++;
}

void sb_gate_pair_row(const struct sb_gate_session *session,
                      const struct sb_gate_pair *pair, int round, enum sb_side first,
                      const struct sb_sample sample[SB_SIDES], struct sb_pair_row *row)
{
    int64_t value[SB_SIDES];
    for (int side = 0; side < SB_SIDES; side++) {
        const int64_t one = sb_metric_value(session->metric, &sample[side]);
        value[side] = one > 0 ? one : SB_NO_COUNT;
    }
    *row = (struct sb_pair_row){
        .process = session->process,
        .round = round,
        .scene = pair->task[SB_HEAD].entry->scene,
        .variant = pair->task[SB_HEAD].entry->id,
        .first = sb_side_names[first],
        .batch = pair->batch[SB_HEAD],
        .metric = sb_metric_rows[session->metric].name,
        .base = value[SB_BASE],
        .head = value[SB_HEAD],
        .base_wall_ns = sample[SB_BASE].wall_ns,
        .head_wall_ns = sample[SB_HEAD].wall_ns,
        .base_flags = sample[SB_BASE].flags,
        .head_flags = sample[SB_HEAD].flags,
    };
}

static void measure_pair(struct sb_gate_rounds *rounds, int place, int round,
                         struct sb_pair_row *row, int *row_count)
{
    struct sb_gate_session *session = rounds->session;
    struct sb_gate_pair *pair = &session->pair[place];
    struct sb_sample sample[SB_SIDES];
    struct sb_error failure = {0};
    const enum sb_side first = (round + place) % 2 ? SB_HEAD : SB_BASE;
    if (!sb_gate_pair_shoot(session, pair, first, sample, &failure)) {
        fail_pair(pair, blame(session, pair), &failure);
        return;
    }
    sb_gate_pair_row(session, pair, round, first, sample, &row[(*row_count)++]);
    for (int side = 0; side < SB_SIDES; side++) {
        if (!sb_driver_holds(&session->driver[side], sample[side].job, &failure)) {
            fail_pair(pair, (enum sb_side)side, &failure);
            return;
        }
    }
    sb_gate_pair_keep(pair, session->metric, round / SB_GATE_BLOCK, sample);
}

// Sides in processes of their own are measured in many of them.
static bool is_renewed(const struct sb_gate_session *session)
{
    return session->params->apart && session->driver[SB_BASE].fns->renew &&
           session->driver[SB_HEAD].fns->renew;
}

// Fresh processes, and a round in which they compile what is still open.
static void renew(struct sb_gate_session *session, const int *active, int count)
{
    for (int side = 0; side < SB_SIDES; side++)
        session->driver[side].fns->renew(session->driver[side].runner);
    for (int i = 0; i < count && !sb_interrupted(); i++) {
        struct sb_gate_pair *pair = &session->pair[active[i]];
        struct sb_sample ignored[SB_SIDES];
        struct sb_error failure = {0};
        if (!sb_gate_pair_shoot(session, pair, SB_BASE, ignored, &failure))
            fail_pair(pair, blame(session, pair), &failure);
    }
}

// As of the rows of a run: what is left of so many is a choice that nobody made.
static void check_flagged(struct sb_gate_pair *pair)
{
    const double least_share = 0.8;
    struct sb_error err;
    if (pair->count >= least_share * (pair->count + pair->flagged))
        return;
    sb_fail(&err, SB_SAMPLES_INVALID,
            "%d of %d pairs have no time: their batches were disjoint or absurd",
            pair->flagged, pair->count + pair->flagged);
    fail_pair(pair, SB_HEAD, &err);
}

// `over`: no more pairs will come.
static void look(struct sb_gate_rounds *rounds, struct sb_gate_pair *pair, bool over)
{
    double *scratch = sb_alloc((4 * (size_t)pair->count + 4) * sizeof *scratch);
    pair->reading = (rounds->fixed ? sb_gate_confirm : sb_gate_read)(
        rounds->rule, pair->value[SB_BASE], pair->value[SB_HEAD],
        is_renewed(rounds->session) ? pair->process : NULL, pair->count, over, scratch);
    pair->active = pair->reading.verdict == SB_GATE_OPEN;
    free(scratch);
    if (!pair->active)
        check_flagged(pair);
}

// Verdicts are read from what is on disk, and from nothing else.
static void forget_unwritten(struct sb_gate_rounds *rounds)
{
    struct sb_gate_session *session = rounds->session;
    for (int i = 0; i < session->pair_count; i++) {
        struct sb_gate_pair *pair = &session->pair[i];
        pair->count = pair->written;
        if (pair->active)
            look(rounds, pair, true);
    }
}

static int find_active(const struct sb_gate_session *session, int *active)
{
    int count = 0;
    for (int i = 0; i < session->pair_count; i++)
        if (session->pair[i].active)
            active[count++] = i;
    return count;
}

static void show(const struct sb_gate_session *session, int round, int active,
                 double left)
{
    char line[120];
    snprintf(line, sizeof line,
             "pair %d of each, %d of %d variants are open, at most %.0f s left",
             round + 1, active, session->pair_count, left);
    sb_progress(line);
}

static bool loop(struct sb_gate_rounds *rounds, int *active, int *order,
                 struct sb_pair_row *row, struct sb_error *err)
{
    struct sb_gate_session *session = rounds->session;
    int64_t begin =
        sb_clock_ns(); // of the pairs alone: fresh processes take no time of theirs
    // A round may be lost to a worker, and is taken again; not for ever.
    const int most =
        2 * (rounds->fixed ? rounds->rule->confirm_pairs : rounds->rule->looks.rounds);
    for (int round = 0;; round++) {
        int rows = 0;
        const int count = find_active(session, active);
        const double seconds = (double)(sb_clock_ns() - begin) * 1e-9;
        const bool over = seconds >= rounds->seconds || sb_interrupted() || round >= most;
        for (int i = 0; over && i < count; i++)
            look(rounds, &session->pair[active[i]], true);
        if (count == 0 || over)
            return true;
        show(session, round, count, rounds->seconds - seconds);
        if (round > 0 && round % SB_GATE_BLOCK == 0 && is_renewed(session)) {
            const int64_t now = sb_clock_ns();
            renew(session, active, count);
            begin += sb_clock_ns() - now;
        }
        sb_schedule_order((uint64_t)session->params->settings->seed, count, round, order);
        for (int i = 0; i < count; i++)
            if (session->pair[active[order[i]]].active)
                measure_pair(rounds, active[order[i]], round, row, &rows);
        if (rounds->file && !sb_row_file_add(rounds->file, row, rows, sizeof *row, err)) {
            forget_unwritten(rounds);
            return false;
        }
        for (int i = 0; i < count; i++) {
            struct sb_gate_pair *pair = &session->pair[active[i]];
            pair->written = pair->count;
            if (pair->active)
                look(rounds, pair, false);
        }
    }
}

bool sb_gate_rounds_run(struct sb_gate_rounds *rounds, struct sb_error *err)
{
    const size_t count = (size_t)rounds->session->pair_count + 1;
    int *active = sb_alloc(count * sizeof *active);
    int *order = sb_alloc(count * sizeof *order);
    struct sb_pair_row *row = sb_alloc(count * sizeof *row);
    const bool good = loop(rounds, active, order, row, err);
    sb_progress("");
    free(row);
    free(order);
    free(active);
    return good;
}
