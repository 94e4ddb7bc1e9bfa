#include "measure/payback.h"

#include <math.h>
#include <stdlib.h>

#include "analyse/policies.h"
#include "measure/interrupt.h"

static const double LONGEST_MS = 20000;

static bool draw_frames(const struct sb_task *task, const struct sb_driver *driver,
                        double frames, double *ms, struct sb_error *err)
{
    while (frames > 0) {
        const double batch = fmin(frames, task->batch > 0 ? task->batch : 1);
        const struct sb_shot shot = {
            .job = task->assembly.job.id, .frames = (int)batch, .shrink = 1};
        struct sb_sample sample;
        if (!driver->fns->round(driver->runner, &shot, 1, &sample, err))
            return false;
        *ms += (double)sample.wall_ns * 1e-6;
        frames -= batch;
    }
    return true;
}

// Makes the task's programs anew and draws so many frames, the first of them included.
static bool total_ms(struct sb_task *task, const struct sb_driver *driver, double frames,
                     double *ms, struct sb_error *err)
{
    struct sb_prepared prepared = {0};
    driver->fns->release(driver->runner, task->assembly.job.id);
    task->loaded = driver->fns->prepare(driver->runner, &task->assembly.job, &prepared);
    free(prepared.log);
    if (!task->loaded) {
        *err = prepared.error;
        return false;
    }
    *ms = prepared.compile_ms + prepared.link_ms + prepared.first_draw_ms;
    return draw_frames(task, driver, frames - 1, ms, err);
}

static void check(const struct sb_payback_params *params, int place)
{
    const struct sb_row *row = &params->row[place];
    struct sb_task *task = &params->task[place];
    const struct sb_row *other_row = sb_row_against(params->row, params->task_count, row);
    const double frames = fmax(ceil(row->payback_frames), 1);
    double own = 0, other = 0;
    struct sb_error err = {0};
    if (!other_row || other_row == row || !isfinite(row->payback_frames))
        return;
    struct sb_task *uber = &params->task[other_row - params->row];
    if (frames * other_row->median_ms > LONGEST_MS)
        sb_task_note(task, "payback was not drawn: %.0f frames take too long", frames);
    else if (total_ms(task, params->driver, frames, &own, &err) &&
             total_ms(uber, params->driver, frames, &other, &err))
        task->payback_check = own / other;
    else
        sb_task_note(task, "payback was not drawn: %s", err.text);
}

void sb_payback_check(const struct sb_payback_params *params)
{
    for (int i = 0; i < params->task_count && !sb_interrupted(); i++)
        check(params, i);
}
