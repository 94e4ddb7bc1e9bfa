#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assemble/platform.h"
#include "measure/rounds.h"
#include "measure/summary.h"
#include "stats/between.h"
#include "stats/paired.h"

static const double share_of_valid_samples = 0.8;

// The valid frame times of one process (-1: of all), in order of measuring.
static int frame_times(const struct sb_task *task, int64_t process, double *ms)
{
    int n = 0;
    for (int i = 0; i < task->sample_count; i++) {
        const double one = sb_sample_frame_ms(&task->sample[i]);
        if (!isnan(one) && (process < 0 || task->sample[i].process == process))
            ms[n++] = one;
    }
    return n;
}

static int64_t process_count(const struct sb_task *task)
{
    return task->sample_count ? task->sample[task->sample_count - 1].process + 1 : 0;
}

// A process that was interrupted before its first look says nothing about levels, unless
// there is no other.
static bool process_counts(const struct sb_task *task, int64_t process, double *ms,
                           const struct sb_measure_settings *settings)
{
    int most = 0;
    for (int64_t p = 0; p < process_count(task); p++) {
        const int n = frame_times(task, p, ms);
        most = n > most ? n : most;
    }
    const int wanted = most < settings->first_look ? most : (int)settings->first_look;
    return most > 0 && frame_times(task, process, ms) >= wanted;
}

// Median of one of the clocks a frame, in ms.
static double clock_ms(const struct sb_task *task, size_t column, double *scratch)
{
    int n = 0;
    for (int i = 0; i < task->sample_count; i++) {
        const struct sb_sample_row *sample = &task->sample[i];
        if (!isnan(sb_sample_frame_ms(sample)))
            scratch[n++] = (double)*(const int64_t *)((const char *)sample + column) *
                           1e-6 / (double)sample->batch;
    }
    sb_sort_doubles(scratch, n);
    return sb_median(scratch, n);
}

static void fill_spread(const struct sb_task *task, struct sb_row *row, double *ms)
{
    int n = frame_times(task, -1, ms);
    sb_sort_doubles(ms, n);
    row->rounds = n;
    row->p05_ms = sb_quantile(ms, n, 0.05);
    row->p95_ms = sb_quantile(ms, n, 0.95);
    row->min_ms = n ? ms[0] : NAN;
    // Deviations from each process's own median, or levels would count as spread.
    n = 0;
    for (int64_t p = 0; p < process_count(task); p++) {
        double *own = ms + n;
        const int count = frame_times(task, p, own);
        if (count == 0)
            continue;
        double *sorted = sb_alloc((size_t)count * sizeof *sorted);
        memcpy(sorted, own, (size_t)count * sizeof *sorted);
        sb_sort_doubles(sorted, count);
        const double median = sb_median(sorted, count);
        row->autocorrelation = sb_sign_autocorrelation(own, count, median);
        for (int i = 0; i < count; i++)
            own[i] = fabs(own[i] - median);
        n += count;
        free(sorted);
    }
    sb_sort_doubles(ms, n);
    row->mad_ms = sb_median(ms, n);
}

static void fill_level(const struct sb_task *task, struct sb_row *row, double *ms,
                       const struct sb_measure_settings *settings)
{
    const struct sb_looks looks = sb_looks_of(settings);
    struct sb_interval interval = {NAN, NAN, NAN, 0};
    double *median = sb_alloc(((size_t)process_count(task) + 1) * sizeof *median);
    int processes = 0;
    for (int64_t p = 0; p < process_count(task); p++) {
        if (!process_counts(task, p, ms, settings))
            continue;
        const int n = frame_times(task, p, ms);
        sb_sort_doubles(ms, n);
        interval = sb_median_interval(ms, n, sb_look_level(&looks));
        median[processes++] = interval.point;
    }
    row->ci_kind = "ci95_within_run";
    if (processes > 1) {
        interval = sb_between_processes(median, processes, 0.95);
        row->ci_kind = "ci95_between_processes";
    }
    free(median);
    row->processes = processes;
    row->median_ms = interval.point;
    row->ci_lo_ms = interval.lo;
    row->ci_hi_ms = interval.hi;
    row->fps = 1000 / interval.point;
}

// Pairs of one round of one process: samples stand in order of rounds in both tasks.
static int pairs_of(const struct sb_task *first, const struct sb_task *task,
                    int64_t process, double *a, double *b)
{
    int n = 0;
    for (int i = 0, j = 0; i < first->sample_count && j < task->sample_count;) {
        const struct sb_sample_row *x = &first->sample[i], *y = &task->sample[j];
        const int64_t order =
            x->process != y->process ? x->process - y->process : x->round - y->round;
        if (order == 0 && x->process == process) {
            a[n] = sb_sample_frame_ms(x);
            b[n] = sb_sample_frame_ms(y);
            n += !isnan(a[n]) && !isnan(b[n]);
        }
        i += order <= 0;
        j += order >= 0;
    }
    return n;
}

static void fill_ratio(const struct sb_task *first, const struct sb_task *task,
                       struct sb_row *row)
{
    const size_t room = (size_t)task->sample_count + 1;
    double *a = sb_alloc(4 * room * sizeof *a);
    double *b = a + room, *scratch = b + room, *point = scratch + room;
    struct sb_interval ratio = {NAN, NAN, NAN, 0};
    int processes = 0;
    for (int64_t p = 0; p < process_count(task); p++) {
        const int n = pairs_of(first, task, p, a, b);
        if (n == 0)
            continue;
        ratio = sb_paired_ratio(a, b, n, 0.95, scratch);
        point[processes++] = ratio.point;
    }
    if (processes > 1)
        ratio = sb_between_processes(point, processes, 0.95);
    free(a);
    row->ratio = ratio.point;
    row->ratio_lo = ratio.lo;
    row->ratio_hi = ratio.hi;
}

static const char *hash_text(struct sb_arena *arena, uint64_t hash)
{
    return hash ? sb_arena_printf(arena, "%016" PRIx64, hash) : NULL;
}

static void fill_work(const struct sb_task *task, struct sb_row *row,
                      struct sb_arena *arena)
{
    const struct sb_prepared *prepared = &task->prepared;
    row->source_hash = hash_text(arena, task->assembly.source_hash);
    if (!task->loaded)
        return;
    row->gl_calls = prepared->gl_calls;
    row->vertices = prepared->vertices;
    row->fragments = prepared->fragments;
    row->compile_ms = prepared->compile_ms;
    row->link_ms = prepared->link_ms;
    row->first_draw_ms = prepared->first_draw_ms;
    row->input_hash = hash_text(arena, prepared->input_hash);
    row->binary_hash = hash_text(arena, prepared->binary_hash);
    row->nonfinite = task->nonfinite;
    row->negative = task->negative;
    row->growth_4x = task->growth > 0 ? task->growth : NAN;
    row->batch = task->batch ? task->batch : SB_NO_COUNT;
}

static const char *effective_precision(const struct sb_driver *driver,
                                       const struct sb_variant *variant)
{
    static const char *const words[] = {
        [SB_EFFECTIVE_FP32] = "fp32",
        [SB_EFFECTIVE_FP16] = "fp16",
        [SB_EFFECTIVE_OTHER] = "other",
    };
    const struct sb_asked_precision asked = sb_platform_precision(variant);
    const struct sb_precision_verdict *verdict =
        sb_driver_precision(driver, asked.vertex_stage, asked.lowest);
    if (!verdict || verdict->effective == SB_EFFECTIVE_UNKNOWN)
        return NULL;
    if (verdict->effective == SB_EFFECTIVE_FP16 && !asked.uniform)
        return "fp16 in the lowered terms";
    return words[verdict->effective];
}

static void fill_status(const struct sb_task *task, struct sb_row *row)
{
    enum sb_status status = task->status;
    const bool failed = sb_status_rows[status].exit_code != 0;
    if (!failed && task->sample_count == 0)
        status = SB_NOT_MEASURED;
    else if (!failed &&
             (double)row->rounds < share_of_valid_samples * (double)task->sample_count)
        status = SB_SAMPLES_INVALID;
    row->status = sb_status_rows[status].word;
    row->note = task->note.length ? task->note.data : NULL;
    row->stop = task->stop;
}

static const struct sb_task *first_of_scene(const struct sb_summary_params *params,
                                            const struct sb_task *task)
{
    for (int i = 0; i < params->task_count; i++)
        if (strcmp(params->task[i].entry->scene, task->entry->scene) == 0)
            return &params->task[i];
    return task;
}

static void fill_times(const struct sb_summary_params *params, const struct sb_task *task,
                       struct sb_row *row)
{
    double *ms = sb_alloc(((size_t)task->sample_count + 1) * sizeof *ms);
    fill_spread(task, row, ms);
    fill_level(task, row, ms, &params->suite->measure);
    fill_ratio(first_of_scene(params, task), task, row);
    row->cpu_ms = clock_ms(task, offsetof(struct sb_sample_row, cpu_ns), ms);
    row->wall_ms = clock_ms(task, offsetof(struct sb_sample_row, wall_ns), ms);
    row->submit_ms = clock_ms(task, offsetof(struct sb_sample_row, submit_ns), ms);
    if (row->fragments > 0)
        row->ns_per_fragment = row->median_ms * 1e6 / (double)row->fragments;
    free(ms);
}

void sb_summarise(const struct sb_summary_params *params, struct sb_row *row,
                  struct sb_arena *arena)
{
    const struct sb_driver *driver = params->driver;
    const struct sb_timer_source *timer = &driver->audit.source[driver->timer];
    for (int i = 0; i < params->task_count; i++) {
        const struct sb_task *task = &params->task[i];
        sb_row_init(&row[i]);
        row[i].axes = task->loaded ? &task->assembly.job.variant : &task->entry->variant;
        row[i].variant = task->entry->id;
        row[i].scene = task->entry->scene;
        row[i].renderer = driver->caps.renderer;
        row[i].version = driver->caps.version;
        row[i].timer_source = timer->name;
        row[i].timer_error = timer->error;
        row[i].precision_effective = effective_precision(driver, row[i].axes);
        fill_work(task, &row[i], arena);
        if (task->sample_count)
            fill_times(params, task, &row[i]);
        fill_status(task, &row[i]);
    }
}
