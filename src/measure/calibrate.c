#include <math.h>

#include "base/clock.h"
#include "measure/calibrate.h"
#include "measure/interrupt.h"
#include "stats/order.h"

enum { MAX_BATCH = 4096 };

static struct sb_shot whole_frames(const struct sb_task *task, int frames)
{
    return (struct sb_shot){.job = task->assembly.job.id, .frames = frames, .shrink = 1};
}

// One shot's time for the whole batch, in ns, by the timer in use. A flagged sample (absurd,
// disjoint, lost) is no time: it is taken again, a few times.
static bool shoot(const struct sb_driver *driver, const struct sb_shot *shot, double *ns,
                  struct sb_error *err)
{
    struct sb_sample sample = {0};
    for (int attempt = 0; attempt < 5; attempt++) {
        if (!driver->fns->round(driver->runner, shot, 1, &sample, err))
            return false;
        if (sample.flags == 0)
            break;
        if (sample.flags & SB_SAMPLE_LOST && !sb_driver_holds(driver, shot->job, err))
            return false;
    }
    *ns = (double)(sample.gpu_ns == SB_NO_TIME || sample.flags ? sample.wall_ns
                                                               : sample.gpu_ns);
    return true;
}

// The least of three: a preemption only ever adds.
static bool shoot_least(const struct sb_driver *driver, const struct sb_shot *shot,
                        double *ns, struct sb_error *err)
{
    *ns = INFINITY;
    for (int i = 0; i < 3; i++) {
        double one;
        if (!shoot(driver, shot, &one, err))
            return false;
        *ns = fmin(*ns, one);
    }
    return true;
}

double sb_calibrate_wanted_ns(const struct sb_driver *driver,
                              const struct sb_measure_settings *settings)
{
    const struct sb_timer_source *source = &driver->audit.source[driver->timer];
    const double floor = fmax(fmax(1000 * source->granularity_ns, 50 * source->empty_ns),
                              50 * source->missing_ns);
    return fmin(fmax(floor, settings->batch_ms * 1e6),
                fmax(20e6, settings->batch_ms * 1e6));
}

bool sb_calibrate_batch(struct sb_task *task, const struct sb_driver *driver,
                        const struct sb_measure_settings *settings, struct sb_error *err)
{
    if (settings->batch > 0) {
        task->batch = (int)settings->batch;
        return true;
    }
    if (task->batch == 0)
        task->batch = 1;
    const double wanted = sb_calibrate_wanted_ns(driver, settings);
    for (int step = 0; step < 16; step++) {
        double ns;
        const struct sb_shot shot = whole_frames(task, task->batch);
        if (!shoot_least(driver, &shot, &ns, err))
            return false;
        if (ns >= wanted || task->batch >= MAX_BATCH)
            break;
        // Grow by what is missing, at most tenfold: short batches are the least exact.
        const double factor = fmin(fmax(wanted / fmax(ns, 1), 1.1), 10);
        task->batch = (int)fmin(ceil(task->batch * factor), MAX_BATCH);
    }
    return true;
}

// One unrecorded round; its total. A task whose shot fails is out.
static double warm_round(struct sb_task *tasks, int count, const struct sb_driver *driver)
{
    double total = 0, ns;
    for (int i = 0; i < count; i++) {
        struct sb_error err = {0};
        const struct sb_shot shot = whole_frames(&tasks[i], tasks[i].batch);
        if (!sb_task_timed(&tasks[i]))
            continue;
        if (shoot(driver, &shot, &ns, &err))
            total += ns;
        else
            sb_task_fail(&tasks[i], &err);
    }
    return total;
}

void sb_warm_up(struct sb_task *tasks, int count, const struct sb_driver *driver,
                const struct sb_measure_settings *settings)
{
    const int64_t limit = (int64_t)(1e9 * fmin(settings->budget / 20, 1));
    const int64_t begin = sb_clock_ns();
    double total[5];
    for (int round = 0; !sb_interrupted(); round++) {
        total[round % 5] = warm_round(tasks, count, driver);
        double least = INFINITY, most = 0;
        for (int i = 0; i < 5 && i <= round; i++) {
            least = fmin(least, total[i]);
            most = fmax(most, total[i]);
        }
        if (round >= 4 && most <= 1.05 * least)
            return;
        if (sb_clock_ns() - begin >= limit)
            break;
    }
    for (int i = 0; i < count; i++)
        if (sb_task_timed(&tasks[i]))
            sb_task_note(&tasks[i], "no_steady_state before the first round");
}

bool sb_check_fragment_bound(struct sb_task *task, const struct sb_driver *driver,
                             struct sb_error *err)
{
    enum { PAIRS = 7 };
    double ratio[PAIRS];
    const uint32_t id = task->assembly.job.id;
    // Batches of about equal length, so that constant costs of a batch weigh on both alike;
    // in pairs, so that a machine that slows down hits both.
    const struct sb_shot large = whole_frames(task, task->batch);
    const struct sb_shot small = {.job = id, .frames = task->batch * 4, .shrink = 2};
    for (int i = 0; i < PAIRS; i++) {
        double whole, quarter;
        if (!shoot(driver, &large, &whole, err) || !shoot(driver, &small, &quarter, err))
            return false;
        ratio[i] = whole / (quarter / 4);
    }
    sb_sort_doubles(ratio, PAIRS);
    task->growth = sb_median(ratio, PAIRS);
    if (task->growth < 3 && task->status == SB_OK)
        task->status = SB_NOT_FRAGMENT_BOUND;
    return true;
}

bool sb_split_shadows(struct sb_task *task, const struct sb_driver *driver,
                      struct sb_error *err)
{
    enum { PAIRS = 15 };
    double share[PAIRS], whole, part;
    if (!task->prepared.draws_shadows)
        return true;
    const struct sb_shot frames = whole_frames(task, task->batch);
    struct sb_shot shadows = frames;
    shadows.part = SB_PART_SHADOWS;
    if (!shoot_least(driver, &frames, &whole, err) ||
        !shoot_least(driver, &shadows, &part, err))
        return false;
    const double longer = round(whole / fmax(part, 1));
    shadows.frames = (int)fmin(frames.frames * fmin(fmax(longer, 1), 16), MAX_BATCH);
    for (int i = 0; i < PAIRS; i++) {
        if (!shoot(driver, &frames, &whole, err) || !shoot(driver, &shadows, &part, err))
            return false;
        share[i] = (part / shadows.frames) / (whole / frames.frames);
    }
    sb_sort_doubles(share, PAIRS);
    task->shadow_share = sb_median(share, PAIRS);
    return true;
}
