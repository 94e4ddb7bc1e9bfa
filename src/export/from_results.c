#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "export/from_results.h"
#include "results/csv.h"
#include "results/store.h"

// --- a row ----------------------------------------------------------------------------------

enum sb_export_outcome sb_export_outcome_of(enum sb_status status)
{
    switch (sb_status_rows[status].exit_code) {
    case 0:
        return SB_EXPORT_PASSED;
    case 1:
        return SB_EXPORT_FAILED;
    case 4:   // inconclusive
    case 77:  // not to be had here
    case 130: // interrupted
        return SB_EXPORT_SKIPPED;
    default:
        return SB_EXPORT_ERROR;
    }
}

// Columns of summary.csv that are worth a history.
static const struct {
    const char *name;
    size_t offset;
} counters[] = {
#define COUNTER(name)                                                                    \
    {                                                                                    \
#name, offsetof(struct sb_row, name)                                             \
    }
    COUNTER(ns_per_fragment), COUNTER(compile_ms), COUNTER(link_ms),
    COUNTER(max_err),         COUNTER(p999_err),   COUNTER(flip_mean),
#undef COUNTER
};
enum { COUNTERS = sizeof counters / sizeof *counters };

static const char *text_or_null(const char *text)
{
    return text && text[0] ? text : NULL;
}

void sb_export_row_from(const struct sb_row *row, struct sb_arena *arena,
                        struct sb_export_row *to)
{
    struct sb_export_counter *counter = sb_arena_alloc(arena, COUNTERS * sizeof *counter);
    const enum sb_status status = row->status ? sb_status_find(row->status) : SB_OK;
    const int rounds = row->rounds == SB_NO_COUNT ? 0 : (int)row->rounds;
    for (int i = 0; i < COUNTERS; i++)
        counter[i] = (struct sb_export_counter){
            counters[i].name, *(const double *)((const char *)row + counters[i].offset)};
    *to = (struct sb_export_row){
        .scene = row->scene,
        .variant = row->variant,
        .outcome =
            status == SB_STATUS_COUNT ? SB_EXPORT_ERROR : sb_export_outcome_of(status),
        .status = row->status,
        .message = text_or_null(row->note),
        .frame_ns = {1e6 * row->median_ms, 1e6 * row->ci_lo_ms, 1e6 * row->ci_hi_ms,
                     rounds},
        .cpu_ns = 1e6 * row->cpu_ms,
        .ratio = {row->ratio, row->ratio_lo, row->ratio_hi, rounds},
        .batch = row->batch == SB_NO_COUNT ? 0 : (int)row->batch,
        .counter = counter,
        .counter_count = COUNTERS,
    };
    if (to->outcome != SB_EXPORT_PASSED && status < SB_STATUS_COUNT)
        to->details =
            sb_arena_printf(arena, "%s: %s%s%s", row->status, sb_status_rows[status].help,
                            to->message ? "\n" : "", to->message ? to->message : "");
}

// --- samples --------------------------------------------------------------------------------

// Rounds go through the rows in an order of their own; most often it is one of the next.
static int find_row(const struct sb_export_row *row, int count, int from,
                    const struct sb_sample_row *sample)
{
    for (int i = 0; i < count && sample->scene && sample->variant; i++) {
        const struct sb_export_row *it = &row[(from + i) % count];
        if (strcmp(it->variant, sample->variant) == 0 &&
            strcmp(it->scene, sample->scene) == 0)
            return (from + i) % count;
    }
    return -1;
}

// In two passes over the file: how many each row has, then the samples.
static bool each_sample(const struct sb_csv *csv, struct sb_export_row *row, int count,
                        double *const *ns, double *const *cpu_ns, struct sb_error *err)
{
    int at = 0;
    for (int line = 1; line < csv->row_count; line++) {
        struct sb_sample_row sample;
        sb_sample_row_init(&sample);
        if (!sb_csv_get(csv, line, sb_sample_columns, sb_sample_column_count, &sample,
                        err))
            return false;
        const int found = find_row(row, count, at, &sample);
        if (found < 0 || sample.batch < 1 || isnan(sb_sample_frame_ns(&sample)))
            continue;
        at = found + 1;
        if (ns) {
            const bool known = sample.cpu_ns != SB_NO_COUNT;
            ns[found][row[found].sample_count] = sb_sample_frame_ns(&sample);
            cpu_ns[found][row[found].sample_count] =
                known ? (double)sample.cpu_ns / (double)sample.batch : NAN;
        }
        row[found].sample_count++;
    }
    return true;
}

bool sb_export_add_samples(const char *dir, struct sb_export_row *row, int count,
                           struct sb_arena *arena, struct sb_error *err)
{
    struct sb_csv csv = {0};
    double **ns = sb_arena_alloc(arena, ((size_t)count + 1) * sizeof *ns);
    double **cpu_ns = sb_arena_alloc(arena, ((size_t)count + 1) * sizeof *cpu_ns);
    bool good = sb_csv_read(sb_path_join(arena, dir, "samples.csv"), &csv, err) &&
                each_sample(&csv, row, count, NULL, NULL, err);
    for (int i = 0; i < count; i++) {
        const size_t size = ((size_t)row[i].sample_count + 1) * sizeof **ns;
        row[i].sample_ns = ns[i] = sb_arena_alloc(arena, size);
        row[i].sample_cpu_ns = cpu_ns[i] = sb_arena_alloc(arena, size);
        row[i].sample_count = 0;
    }
    good = good && each_sample(&csv, row, count, ns, cpu_ns, err);
    sb_csv_free(&csv);
    return good;
}

// --- properties -----------------------------------------------------------------------------

static const char *first_text(const struct sb_row *row, int count, size_t offset)
{
    const char *text = NULL;
    for (int i = 0; i < count && !text; i++)
        text = *(const char *const *)((const char *)&row[i] + offset);
    return text;
}

// A value of run.json as text; NULL where there is none.
static const char *json_text(const json_t *value, struct sb_arena *arena)
{
    char number[32];
    if (json_is_string(value))
        return text_or_null(sb_arena_strdup(arena, json_string_value(value)));
    return json_is_number(value)
               ? sb_arena_strdup(arena, sb_number_text(json_number_value(value), number))
               : NULL;
}

// Of "0.52 0.40 0.31 2/345 6789" the three averages, as Google Benchmark has them.
static const char *load_average(const json_t *machine, struct sb_arena *arena)
{
    const json_t *value = json_object_get(machine, "load_average");
    const char *text = json_is_string(value) ? json_string_value(value) : "";
    size_t length = 0;
    for (int i = 0; i < 3; i++) {
        length += strspn(text + length, " ");
        length += strcspn(text + length, " ");
    }
    return length ? sb_arena_printf(arena, "%.*s", (int)length, text) : NULL;
}

int sb_export_properties_from(const json_t *run, const struct sb_row *row, int count,
                              struct sb_arena *arena,
                              struct sb_export_property properties[SB_EXPORT_PROPERTIES])
{
    const json_t *caps = json_object_get(run, "caps"),
                 *processes = json_object_get(run, "processes"),
                 *last = json_array_get(processes, json_array_size(processes) - 1),
                 *machine = json_object_get(last, "machine");
    const char *renderer = first_text(row, count, offsetof(struct sb_row, renderer)),
               *version = first_text(row, count, offsetof(struct sb_row, version)),
               *timer = first_text(row, count, offsetof(struct sb_row, timer_source));
    if (!renderer)
        renderer = json_text(json_object_get(caps, "renderer"), arena);
    if (!version)
        version = json_text(json_object_get(caps, "version"), arena);
    const struct sb_export_property found[] = {
        {"renderer", renderer, SB_EXPORT_TEXT, SB_EXPORT_HEAD},
        {"gl_version", version, SB_EXPORT_TEXT, 0},
        {"timer", timer, SB_EXPORT_TEXT, SB_EXPORT_HEAD},
        {"cpu", json_text(json_object_get(machine, "cpu"), arena), SB_EXPORT_TEXT, 0},
        {"num_cpus", json_text(json_object_get(machine, "cpus"), arena), SB_EXPORT_NUMBER,
         0},
        {"kernel", json_text(json_object_get(machine, "kernel"), arena), SB_EXPORT_TEXT,
         SB_EXPORT_ONCE},
        {"load_avg", load_average(machine, arena), SB_EXPORT_NUMBERS, SB_EXPORT_ONCE},
        {"seed",
         json_text(json_object_get(json_object_get(run, "measure"), "seed"), arena),
         SB_EXPORT_NUMBER, SB_EXPORT_HEAD | SB_EXPORT_ONCE},
        {"processes",
         run ? sb_arena_printf(arena, "%d", (int)json_array_size(processes)) : NULL,
         SB_EXPORT_NUMBER, SB_EXPORT_ONCE},
        {"date", json_text(json_object_get(last, "written"), arena), SB_EXPORT_TEXT,
         SB_EXPORT_ONCE},
        {"shadebench", json_text(json_object_get(run, "shadebench"), arena),
         SB_EXPORT_TEXT, SB_EXPORT_ONCE},
    };
    enum { FOUND = sizeof found / sizeof *found };
    _Static_assert((int)FOUND <= (int)SB_EXPORT_PROPERTIES, "too many properties");
    memcpy(properties, found, sizeof found);
    return FOUND;
}

// --- all of it ------------------------------------------------------------------------------

bool sb_export_from_results(const struct sb_export_source *source,
                            struct sb_exported *exported, struct sb_error *err)
{
    struct sb_arena *arena = &exported->arena;
    json_t *run = source->dir ? sb_store_read_run(source->dir, err) : NULL;
    bool good = run || !source->dir;
    struct sb_export_row *row =
        sb_arena_alloc(arena, ((size_t)source->row_count + 1) * sizeof *row);
    struct sb_export_property *properties =
        sb_arena_alloc(arena, SB_EXPORT_PROPERTIES * sizeof *properties);
    for (int i = 0; i < source->row_count; i++)
        sb_export_row_from(&source->row[i], arena, &row[i]);
    exported->export = (struct sb_export){
        .name = source->name,
        .property = properties,
        .property_count = sb_export_properties_from(run, source->row, source->row_count,
                                                    arena, properties),
        .row = row,
        .row_count = source->row_count,
    };
    good = good && (!source->dir || sb_export_add_samples(source->dir, row,
                                                          source->row_count, arena, err));
    json_decref(run);
    return good;
}

void sb_exported_free(struct sb_exported *exported)
{
    sb_arena_free(&exported->arena);
    *exported = (struct sb_exported){0};
}
