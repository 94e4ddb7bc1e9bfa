#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/pareto.h"
#include "analyse/policies.h"
#include "assemble/platform.h"
#include "measure/accuracy.h"
#include "measure/precision.h"
#include "measure/rounds.h"
#include "measure/summary.h"
#include "scene/scene.h"
#include "stats/between.h"
#include "stats/paired.h"
#include "stats/series.h"

static const double share_of_valid_samples = 0.8;

// The clocks of a sample, a frame, in ms.
typedef double clock_fn(const struct sb_sample_row *row);

static double cpu_ms(const struct sb_sample_row *row)
{
    return (double)row->cpu_ns / (double)row->batch * 1e-6;
}

static double wall_ms(const struct sb_sample_row *row)
{
    return (double)row->wall_ns / (double)row->batch * 1e-6;
}

static double submit_ms(const struct sb_sample_row *row)
{
    return (double)row->submit_ns / (double)row->batch * 1e-6;
}

// The values of a clock over the valid samples of one process, in order of measuring.
static int values_of(const struct sb_task *task, int64_t process, clock_fn *clock,
                     double *values)
{
    int n = 0;
    for (int i = 0; i < task->sample_count; i++) {
        const struct sb_sample_row *row = &task->sample[i];
        if (row->process == process && !isnan(sb_sample_frame_ms(row)))
            values[n++] = clock(row);
    }
    return n;
}

// What the estimates of one row share. A process that was interrupted before its first look
// says nothing about levels, and counts nowhere, unless there is no other.
struct basis {
    const struct sb_task *task;
    double level;     // of intervals: looks share the error
    int64_t *process; // those that count
    int process_count;
    double *a, *b, *scratch; // room for all samples of the task, each
};

static int64_t process_end(const struct sb_task *task)
{
    return task->sample_count ? task->sample[task->sample_count - 1].process + 1 : 0;
}

static void basis_make(struct basis *basis, const struct sb_task *task,
                       const struct sb_measure_settings *settings)
{
    const size_t room = (size_t)task->sample_count + 1;
    const struct sb_looks looks = sb_looks_of(settings);
    *basis = (struct basis){.task = task, .level = sb_look_level(&looks)};
    basis->a = sb_alloc(3 * room * sizeof *basis->a);
    basis->b = basis->a + room;
    basis->scratch = basis->b + room;
    basis->process = sb_alloc(room * sizeof *basis->process);
    int most = 0;
    for (int64_t p = 0; p < process_end(task); p++) {
        const int n = values_of(task, p, sb_sample_frame_ms, basis->a);
        most = n > most ? n : most;
    }
    const int wanted = most < settings->first_look ? most : (int)settings->first_look;
    for (int64_t p = 0; most > 0 && p < process_end(task); p++)
        if (values_of(task, p, sb_sample_frame_ms, basis->a) >= wanted)
            basis->process[basis->process_count++] = p;
}

static void basis_free(struct basis *basis)
{
    free(basis->a);
    free(basis->process);
}

// The level of a clock: the median of one process, or the mean of several processes' medians.
static double clock_level(const struct basis *basis, clock_fn *clock)
{
    double *median = basis->b;
    for (int i = 0; i < basis->process_count; i++) {
        const int n = values_of(basis->task, basis->process[i], clock, basis->a);
        sb_sort_doubles(basis->a, n);
        median[i] = sb_median(basis->a, n);
    }
    if (basis->process_count == 1)
        return median[0];
    return sb_between_processes(median, basis->process_count, 0.95).point;
}

static void fill_spread(const struct basis *basis, struct sb_row *row)
{
    int n = 0;
    for (int i = 0; i < basis->process_count; i++)
        n += values_of(basis->task, basis->process[i], sb_sample_frame_ms, basis->a + n);
    sb_sort_doubles(basis->a, n);
    row->rounds = n;
    row->p05_ms = sb_quantile(basis->a, n, 0.05);
    row->p95_ms = sb_quantile(basis->a, n, 0.95);
    row->min_ms = n ? basis->a[0] : NAN;
    // Deviations from each process's own median, or levels would count as spread.
    n = 0;
    for (int i = 0; i < basis->process_count; i++) {
        double *own = basis->a + n;
        const int count =
            values_of(basis->task, basis->process[i], sb_sample_frame_ms, own);
        memcpy(basis->scratch, own, (size_t)count * sizeof *own);
        sb_sort_doubles(basis->scratch, count);
        const double median = sb_median(basis->scratch, count);
        for (int k = 0; k < count; k++)
            own[k] = fabs(own[k] - median);
        n += count;
    }
    sb_sort_doubles(basis->a, n);
    row->mad_ms = sb_median(basis->a, n);
}

static void fill_level(const struct basis *basis, struct sb_row *row)
{
    struct sb_interval interval = {NAN, NAN, NAN, 0};
    double *median = basis->b;
    for (int i = 0; i < basis->process_count; i++) {
        double *const ms = basis->a, *const sorted = basis->scratch;
        const int n = values_of(basis->task, basis->process[i], sb_sample_frame_ms, ms);
        // fmax passes over NAN: the largest of the processes that have one.
        row->drift = fmax(row->drift, sb_drift(ms, n, sorted));
        memcpy(sorted, ms, (size_t)n * sizeof *ms);
        sb_sort_doubles(sorted, n);
        interval = sb_median_interval(sorted, n, basis->level);
        median[i] = interval.point;
        row->autocorrelation =
            fmax(row->autocorrelation, sb_sign_autocorrelation(ms, n, interval.point));
    }
    if (basis->process_count > 1)
        interval = sb_between_processes(median, basis->process_count, 0.95);
    if (!isnan(interval.lo))
        row->ci_kind =
            basis->process_count > 1 ? "ci95_between_processes" : "ci95_within_run";
    row->processes = basis->process_count;
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

// Of the task's frame time to that of another one.
static struct sb_interval ratio_to(const struct basis *basis, const struct sb_task *first)
{
    struct sb_interval ratio = {NAN, NAN, NAN, 0};
    double *point = sb_alloc(((size_t)basis->process_count + 1) * sizeof *point);
    int count = 0;
    for (int i = 0; i < basis->process_count; i++) {
        const int n = pairs_of(first, basis->task, basis->process[i], basis->a, basis->b);
        if (n == 0)
            continue;
        ratio = sb_paired_ratio(basis->a, basis->b, n, basis->level, basis->scratch);
        point[count++] = ratio.point;
    }
    if (count > 1)
        ratio = sb_between_processes(point, count, 0.95);
    free(point);
    return ratio;
}

static void fill_ratio(const struct basis *basis, const struct sb_task *first,
                       struct sb_row *row)
{
    const struct sb_interval ratio = ratio_to(basis, first);
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
    row->lit_hash = hash_text(arena, task->assembly.lit_hash);
    if (!task->loaded)
        return;
    row->gl_calls = prepared->gl_calls;
    row->vertices = prepared->vertices;
    row->fragments = prepared->fragments;
    row->programs = prepared->programs;
    row->switches = prepared->switches;
    row->programs_cached = prepared->programs_cached;
    row->compile_ms = prepared->compile_ms;
    row->link_ms = prepared->link_ms;
    row->first_draw_ms = prepared->first_draw_ms;
    row->input_hash = hash_text(arena, prepared->input_hash);
    row->binary_hash = hash_text(arena, prepared->binary_hash);
    if (prepared->driver_stats[0])
        row->driver_stats = prepared->driver_stats;
    row->nonfinite = task->nonfinite;
    row->class_spread = task->class_spread;
    row->negative = task->negative;
    row->growth_4x = task->growth > 0 ? task->growth : NAN;
    row->batch = task->batch ? task->batch : SB_NO_COUNT;
}

static void fill_precision(const struct sb_driver *driver, struct sb_row *row,
                           struct sb_arena *arena)
{
    const struct sb_asked_precision asked = sb_platform_precision(row->axes);
    row->precision_requested = sb_precision_requested(&asked, arena);
    row->precision_effective = sb_precision_effective(&asked, driver, arena);
}

static void fill_status(const struct sb_task *task, struct sb_row *row)
{
    enum sb_status status = task->status;
    const bool failed = sb_status_rows[status].exit_code != 0;
    int valid = 0;
    for (int i = 0; i < task->sample_count; i++)
        valid += !isnan(sb_sample_frame_ms(&task->sample[i]));
    if (!failed && task->sample_count == 0)
        status = !task->untimed || !task->accuracy.known ? SB_NOT_MEASURED
                 : status == SB_OK                       ? SB_ACCURACY_ONLY
                                                         : status;
    else if (!failed && valid < share_of_valid_samples * task->sample_count)
        status = SB_SAMPLES_INVALID;
    else if (!failed && isnan(row->ci_lo_ms))
        status = SB_TOO_FEW_SAMPLES;
    row->status = sb_status_rows[status].word;
    row->note = task->note.length ? task->note.data : NULL;
    row->stop = task->stop;
}

static double process_median(const struct sb_task *task, int64_t process)
{
    double *ms = sb_alloc(((size_t)task->sample_count + 1) * sizeof *ms);
    const int n = values_of(task, process, sb_sample_frame_ms, ms);
    sb_sort_doubles(ms, n);
    const double median = sb_median(ms, n);
    free(ms);
    return median;
}

// A row that an interrupted run left over is measured in a later process, at that one's level.
// The anchor, the first row of the plan, was measured in both and tells how far they differ.
static void note_resumed(const struct sb_task *anchor, const struct sb_task *task,
                         struct sb_row *row, struct sb_arena *arena)
{
    if (!anchor->sample_count || !task->sample_count)
        return;
    const int64_t began = anchor->sample[0].process, process = task->sample[0].process;
    if (process == began)
        return;
    row->note = sb_arena_printf(
        arena,
        "%s%smeasured in process %d of a resumed run, where the first row took %.2f "
        "times as long as in process %d",
        row->note ? row->note : "", row->note ? "; " : "", (int)process,
        process_median(anchor, process) / process_median(anchor, began), (int)began);
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
    struct basis basis;
    basis_make(&basis, task, &params->suite->measure);
    if (basis.process_count > 0) {
        fill_spread(&basis, row);
        fill_level(&basis, row);
        fill_ratio(&basis, first_of_scene(params, task), row);
        row->cpu_ms = clock_level(&basis, cpu_ms);
        row->wall_ms = clock_level(&basis, wall_ms);
        row->submit_ms = clock_level(&basis, submit_ms);
    }
    if (task->loaded) { // NAN where it draws none
        row->shadow_ms = task->shadow_share * row->median_ms;
        row->shading_ms = row->median_ms - row->shadow_ms;
    }
    if (row->fragments > 0)
        row->ns_per_fragment = row->median_ms * 1e6 / (double)row->fragments;
    basis_free(&basis);
}

// The place of the row that a task's is held against, the fastest where there are several; or -1.
static int find_other(const struct sb_summary_params *params, const struct sb_row *row,
                      int place)
{
    const struct sb_plan_entry *entry = params->task[place].entry;
    int best = -1;
    for (int i = 0; i < params->task_count; i++) {
        const struct sb_plan_entry *other = params->task[i].entry;
        if (strcmp(other->scene, entry->scene) == 0 && sb_task_timed(&params->task[i]) &&
            sb_platform_held_against(&params->suite->axes, &other->variant,
                                     &entry->variant) &&
            (best < 0 || row[i].median_ms < row[best].median_ms))
            best = i;
    }
    return best;
}

// With the rows of all tasks, which stand ready.
static void fill_against(const struct sb_summary_params *params, struct sb_row *row)
{
    for (int i = 0; i < params->task_count; i++) {
        const struct sb_task *task = &params->task[i];
        const int other = find_other(params, row, i);
        struct basis basis;
        if (other < 0 || task->sample_count == 0)
            continue;
        basis_make(&basis, task, &params->suite->measure);
        const struct sb_interval ratio = ratio_to(&basis, &params->task[other]);
        basis_free(&basis);
        row[i].against = row[other].variant;
        row[i].against_ratio = ratio.point;
        row[i].against_lo = ratio.lo;
        row[i].against_hi = ratio.hi;
        if (i != other && sb_platform_is_policy(&task->entry->variant))
            row[i].payback_frames =
                sb_payback_frames(sb_row_setup_ms(&row[i]) - sb_row_setup_ms(&row[other]),
                                  row[other].median_ms * (1 - ratio.point));
        row[i].payback_check = task->payback_check;
    }
}

void sb_summarise(const struct sb_summary_params *params, struct sb_row *row,
                  struct sb_arena *arena)
{
    const struct sb_driver *driver = params->driver;
    const struct sb_timer_source none = {.name = "none", .error = NAN},
                                 *timer = driver->timer < 0
                                              ? &none
                                              : &driver->audit.source[driver->timer];
    for (int i = 0; i < params->task_count; i++) {
        const struct sb_task *task = &params->task[i];
        sb_row_init(&row[i]);
        row[i].axes = task->decided ? &task->assembly.job.variant : &task->entry->variant;
        row[i].variant = task->entry->id;
        row[i].scene = task->entry->scene;
        row[i].renderer = driver->caps.renderer;
        row[i].version = driver->caps.version;
        row[i].timer_source = timer->name;
        // fmax passes over a NAN, which is what an error of no timer is.
        row[i].timer_error =
            driver->timer < 0 ? NAN : fmax(timer->error, params->timer_error);
        fill_precision(driver, &row[i], arena);
        fill_work(task, &row[i], arena);
        sb_accuracy_fill(task, &row[i]);
        if (task->sample_count)
            fill_times(params, task, &row[i]);
        fill_status(task, &row[i]);
        note_resumed(params->task, task, &row[i], arena);
    }
    fill_against(params, row);
    sb_pareto_mark(&(struct sb_pareto_params){
        .row = row,
        .count = params->task_count,
        .axes = &params->suite->axes,
        .analytic = sb_scene_analytic,
    });
}
