#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "export/gbench.h"

static struct sb_gbench_entry *add(struct sb_gbench_entries *entries,
                                   const struct sb_gbench_entry *like)
{
    entries->entry = sb_grow(entries->entry, entries->count, &entries->capacity,
                             sizeof *entries->entry);
    entries->entry[entries->count] = *like;
    return &entries->entry[entries->count++];
}

// There is a place for the CPU time in every entry, and none for its absence.
static double known(double value)
{
    return isfinite(value) ? value : 0;
}

static double sample_cpu(const struct sb_export_row *row, int i)
{
    return row->sample_cpu_ns ? known(row->sample_cpu_ns[i]) : 0;
}

static void add_samples(struct sb_gbench_entries *entries,
                        const struct sb_gbench_entry *like)
{
    const struct sb_export_row *row = like->row;
    for (int i = 0; i < row->sample_count; i++) {
        struct sb_gbench_entry *entry = add(entries, like);
        entry->index = i;
        entry->real_ns = row->sample_ns[i];
        entry->cpu_ns = sample_cpu(row, i);
    }
    if (row->sample_count)
        return;
    struct sb_gbench_entry *entry = add(entries, like);
    entry->real_ns = row->frame_ns.point;
    entry->cpu_ns = known(row->cpu_ns);
}

struct moments {
    double mean, deviation; // of a sample: over n - 1
};

// Zeros for fewer than two values, or where one is not known.
static struct moments moments_of(const double *values, int n)
{
    struct moments moments = {0, 0};
    if (!values || n < 2)
        return moments;
    for (int i = 0; i < n; i++)
        moments.mean += values[i] / n;
    for (int i = 0; i < n; i++)
        moments.deviation += pow(values[i] - moments.mean, 2) / (n - 1);
    moments.deviation = sqrt(moments.deviation);
    return isfinite(moments.mean) ? moments : (struct moments){0, 0};
}

static void add_aggregates(struct sb_gbench_entries *entries,
                           const struct sb_gbench_entry *like, bool spread)
{
    const struct sb_export_row *row = like->row;
    const int n = row->sample_count;
    const struct moments real = moments_of(row->sample_ns, n),
                         cpu = moments_of(row->sample_cpu_ns, n);
    const struct {
        const char *name;
        double real, cpu;
        bool level;
    } aggregates[] = {
        {"mean", real.mean, cpu.mean, true},
        // The row's own level: of several processes it is not the median of all samples.
        {"median", row->frame_ns.point, known(row->cpu_ns), true},
        {"stddev", real.deviation, cpu.deviation, false},
        {"cv", known(real.deviation / real.mean), known(cpu.deviation / cpu.mean), false},
    };
    for (size_t i = 0; i < sizeof aggregates / sizeof *aggregates; i++) {
        const bool median = strcmp(aggregates[i].name, "median") == 0;
        if ((n < 2 && !median) || (!aggregates[i].level && !spread))
            continue;
        struct sb_gbench_entry *entry = add(entries, like);
        entry->aggregate = aggregates[i].name;
        entry->whole = median;
        entry->real_ns = aggregates[i].real;
        entry->cpu_ns = aggregates[i].cpu;
    }
}

void sb_gbench_entries_make(const struct sb_export *export, bool samples,
                            struct sb_gbench_entries *entries)
{
    *entries = (struct sb_gbench_entries){0};
    for (int i = 0; i < export->row_count; i++) {
        const struct sb_export_row *row = &export->row[i];
        struct sb_gbench_entry like = {
            .row = row,
            .family = i,
            .repetitions = row->sample_count ? row->sample_count : 1,
        };
        if (sb_export_timed(row)) {
            if (samples)
                add_samples(entries, &like);
            // Who takes no samples takes each entry for a time that had better be small.
            add_aggregates(entries, &like, samples);
        } else if (samples && !sb_export_is_base(row)) {
            like.failed = like.whole = true;
            like.repetitions = 1;
            add(entries, &like);
        }
    }
}

void sb_gbench_entries_free(struct sb_gbench_entries *entries)
{
    free(entries->entry);
    *entries = (struct sb_gbench_entries){0};
}

void sb_gbench_why(const struct sb_gbench_entry *entry, struct sb_text *text)
{
    struct sb_text figures = {0};
    sb_export_says(entry->row, text);
    sb_export_times(entry->row, &figures);
    if (figures.length && entry->row->outcome != SB_EXPORT_ERROR)
        sb_text_printf(text, "%sno time, but %s", text->length ? "; " : "", figures.data);
    sb_text_free(&figures);
}

void sb_gbench_name(const struct sb_gbench_entry *entry, struct sb_text *text)
{
    sb_export_row_name(entry->row, text);
    if (entry->aggregate)
        sb_text_printf(text, "_%s", entry->aggregate);
}

void sb_gbench_counters(const struct sb_gbench_entry *entry,
                        void (*each)(const struct sb_export_counter *counter, void *user),
                        void *user)
{
    const struct sb_export_row *row = entry->row;
    const struct sb_export_counter own[] = {
        {"ci_lo_ns", row->frame_ns.lo}, {"ci_hi_ns", row->frame_ns.hi},
        {"ratio", row->ratio.point},    {"ratio_lo", row->ratio.lo},
        {"ratio_hi", row->ratio.hi},
    };
    if (!entry->whole || entry->failed)
        return;
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (isfinite(own[i].value))
            each(&own[i], user);
    for (int i = 0; i < row->counter_count; i++)
        if (isfinite(row->counter[i].value))
            each(&row->counter[i], user);
}
