#include <math.h>
#include <stdlib.h>

#include "base/clock.h"
#include "measure/interrupt.h"
#include "measure/rounds.h"
#include "stats/schedule.h"

struct sb_looks sb_looks_of(const struct sb_measure_settings *settings)
{
    return (struct sb_looks){.first = (int)settings->first_look,
                             .rounds = (int)settings->rounds};
}

bool sb_task_precise(const struct sb_task *task, int process,
                     const struct sb_measure_settings *settings)
{
    const struct sb_looks looks = sb_looks_of(settings);
    const size_t room = (size_t)task->sample_count + 1;
    double *ms = sb_alloc(room * sizeof *ms);
    int n = 0, rounds = 0;
    for (int i = 0; i < task->sample_count; i++) {
        const double one = sb_sample_frame_ms(&task->sample[i]);
        if (task->sample[i].process != process)
            continue;
        rounds++;
        if (!isnan(one))
            ms[n++] = one;
    }
    sb_sort_doubles(ms, n);
    const struct sb_interval interval = sb_median_interval(ms, n, sb_look_level(&looks));
    free(ms);
    return rounds >= looks.first && sb_precise_enough(&interval, settings->half_width);
}

// One round as a message and back, as rows.
static bool run_round(const struct sb_rounds *rounds, int round, const int *active,
                      int count, struct sb_sample_row *row, struct sb_error *err)
{
    struct sb_shot *shot = sb_alloc((size_t)count * sizeof *shot);
    struct sb_sample *sample = sb_alloc((size_t)count * sizeof *sample);
    int *order = sb_alloc((size_t)count * sizeof *order);
    sb_schedule_order((uint64_t)rounds->settings->seed, count, round, order);
    for (int i = 0; i < count; i++) {
        const struct sb_task *task = &rounds->task[active[order[i]]];
        shot[i] = (struct sb_shot){
            .job = task->assembly.job.id, .frames = task->batch, .shrink = 1};
    }
    const struct sb_driver *driver = rounds->driver;
    const bool good = driver->fns->round(driver->runner, shot, count, sample, err);
    for (int i = 0; good && i < count; i++) {
        struct sb_task *task = &rounds->task[active[order[i]]];
        row[i] = (struct sb_sample_row){
            .process = rounds->process,
            .round = round,
            .place = i,
            .scene = task->entry->scene,
            .variant = task->entry->id,
            .timer_source = driver->audit.source[driver->timer].name,
            .batch = sample[i].frames,
            .gpu_ns = sample[i].gpu_ns,
            .wall_ns = sample[i].wall_ns,
            .cpu_ns = sample[i].cpu_ns,
            .submit_ns = sample[i].submit_ns,
            .flags = sample[i].flags,
        };
        sb_task_add_sample(task, &row[i]);
    }
    free(order);
    free(sample);
    free(shot);
    return good;
}

// A worker that was lost took its round with it; a job that took down two is out.
static void drop_given_up(struct sb_rounds *rounds, const int *active, int count)
{
    for (int i = 0; i < count; i++) {
        struct sb_task *task = &rounds->task[active[i]];
        struct sb_error why = {0};
        if (!sb_driver_holds(rounds->driver, task->assembly.job.id, &why))
            sb_task_fail(task, &why);
    }
}

// Levels differ between processes, those of two workers too.
static void note_workers(struct sb_rounds *rounds, int before)
{
    const int lost = sb_driver_workers(rounds->driver) - before;
    for (int i = 0; lost > 0 && i < rounds->task_count; i++)
        if (rounds->task[i].sample_count > 0)
            sb_task_note(&rounds->task[i],
                         "%d worker%s lost in the rounds: the samples are of several "
                         "processes, between which levels differ",
                         lost, lost > 1 ? "s were" : " was");
}

static int find_active(const struct sb_rounds *rounds, int *active)
{
    int count = 0;
    for (int i = 0; i < rounds->task_count; i++)
        if (rounds->task[i].active)
            active[count++] = i;
    return count;
}

static void stop_all(struct sb_rounds *rounds, const char *why)
{
    for (int i = 0; i < rounds->task_count; i++)
        if (rounds->task[i].active) {
            rounds->task[i].active = false;
            rounds->task[i].stop = why;
        }
}

static void look(struct sb_rounds *rounds)
{
    for (int i = 0; i < rounds->task_count; i++) {
        struct sb_task *task = &rounds->task[i];
        if (!task->active || !sb_task_precise(task, rounds->process, rounds->settings))
            continue;
        task->active = false;
        task->stop = "half_width";
    }
}

// Ends with `stop` set for every task. *row has room for all tasks.
static bool loop(struct sb_rounds *rounds, int *active, struct sb_sample_row *row,
                 struct sb_error *err)
{
    const struct sb_measure_settings *settings = rounds->settings;
    const struct sb_looks looks = sb_looks_of(settings);
    const int64_t begin = sb_clock_ns();
    for (int round = 0;; round++) {
        const int count = find_active(rounds, active);
        const double seconds = (double)(sb_clock_ns() - begin) * 1e-9;
        if (count == 0)
            return true;
        if (sb_interrupted())
            stop_all(rounds, "interrupted");
        else if (round >= settings->rounds)
            stop_all(rounds, "rounds");
        else if (seconds >= settings->budget)
            stop_all(rounds, "budget");
        if (!rounds->task[active[0]].active)
            return true;

        struct sb_error failure = {0};
        if (!run_round(rounds, round, active, count, row, &failure)) {
            for (int i = 0; i < count; i++)
                sb_task_fail(&rounds->task[active[i]], &failure);
            return true;
        }
        drop_given_up(rounds, active, count);
        if (!sb_store_samples(rounds->store, row, count, err)) {
            stop_all(rounds, "interrupted");
            return false;
        }
        if (sb_look_due(&looks, round + 1) && seconds >= settings->span)
            look(rounds);
        if (rounds->after_round)
            rounds->after_round(rounds->user, round + 1, count,
                                settings->budget - seconds);
    }
}

bool sb_rounds_run(struct sb_rounds *rounds, struct sb_error *err)
{
    const size_t count = (size_t)rounds->task_count;
    int *active = sb_alloc(count * sizeof *active);
    struct sb_sample_row *row = sb_alloc(count * sizeof *row);
    const int workers = sb_driver_workers(rounds->driver);
    const bool good = loop(rounds, active, row, err);
    note_workers(rounds, workers);
    free(row);
    free(active);
    return good;
}
