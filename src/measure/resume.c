#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "measure/resume.h"
#include "results/rows.h"
#include "results/store.h"

static bool check_plan(const struct sb_earlier *earlier, const struct sb_suite *suite,
                       const char *dir, struct sb_error *err)
{
    const json_t *entries = json_object_get(earlier->run, "entries");
    if ((int)json_array_size(entries) != suite->entry_count)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s/run.json: %d variants, but the suite has %d now; start anew "
                       "with another -o",
                       dir, (int)json_array_size(entries), suite->entry_count);
    for (int i = 0; i < suite->entry_count; i++) {
        const json_t *entry = json_array_get(entries, (size_t)i);
        const char *id = json_string_value(json_object_get(entry, "variant"));
        const char *scene = json_string_value(json_object_get(entry, "scene"));
        if (!id || !scene || strcmp(id, suite->entry[i].id) != 0 ||
            strcmp(scene, suite->entry[i].scene) != 0)
            return sb_fail(
                err, SB_BAD_INPUT,
                "%s/run.json: variant %d is %s on %s, but the suite has %s on %s "
                "now; start anew with another -o",
                dir, i, id ? id : "missing", scene ? scene : "nothing",
                suite->entry[i].id, suite->entry[i].scene);
    }
    return true;
}

// Rows are appended in the order of the columns, so the header must be the one of today.
static bool check_header(const struct sb_csv *csv, const char *path, struct sb_error *err)
{
    bool same = csv->column_count == sb_sample_column_count;
    for (int i = 0; same && i < csv->column_count; i++)
        same = strcmp(csv->cell[0][i], sb_sample_columns[i].name) == 0;
    return same || sb_fail(err, SB_BAD_INPUT,
                           "%s:1: not the columns of samples.csv (shadebench list "
                           "columns); start anew with another -o",
                           path);
}

static void count_processes(struct sb_earlier *earlier)
{
    size_t i;
    const json_t *process;
    json_array_foreach(json_object_get(earlier->run, "processes"), i, process)
    {
        earlier->last_incomplete = !json_is_true(json_object_get(process, "complete"));
        earlier->complete += !earlier->last_incomplete;
        earlier->process = (int)i + 1;
        if (!earlier->last_incomplete)
            earlier->first_open = earlier->process;
        size_t t;
        const json_t *timer;
        json_array_foreach(json_object_get(process, "timers"), t, timer)
        {
            const double error = json_number_value(json_object_get(timer, "error"));
            if (json_is_true(json_object_get(timer, "chosen")))
                earlier->timer_error = fmax(earlier->timer_error, error);
        }
    }
}

bool sb_earlier_load(const char *dir, const struct sb_suite *suite,
                     struct sb_earlier *earlier, struct sb_error *err)
{
    struct sb_arena arena = {0};
    const char *path = sb_path_join(&arena, dir, "samples.csv");
    earlier->run = sb_store_read_run(dir, err);
    bool good = earlier->run && check_plan(earlier, suite, dir, err) &&
                sb_csv_read(path, &earlier->samples, err) &&
                check_header(&earlier->samples, path, err);
    if (good) {
        count_processes(earlier);
        const int timer = sb_csv_column(&earlier->samples, "timer_source");
        if (earlier->samples.row_count > 1 && timer >= 0)
            earlier->timer = earlier->samples.cell[1][timer];
    }
    sb_arena_free(&arena);
    return good;
}

bool sb_earlier_check_driver(const struct sb_earlier *earlier, const struct sb_caps *caps,
                             struct sb_error *err)
{
    const json_t *was = json_object_get(earlier->run, "caps");
    const char *renderer = json_string_value(json_object_get(was, "renderer"));
    const char *version = json_string_value(json_object_get(was, "version"));
    if (renderer && version && strcmp(renderer, caps->renderer) == 0 &&
        strcmp(version, caps->version) == 0)
        return true;
    return sb_fail(
        err, SB_BAD_INPUT,
        "the folder was measured on \"%s, %s\"; here is \"%s, %s\": start anew "
        "with another -o",
        renderer ? renderer : "", version ? version : "", caps->renderer, caps->version);
}

// A hash in run.json against one of now. A variant that was not prepared has none.
static bool same_hash(const json_t *entry, const char *key, uint64_t now)
{
    char text[32];
    const char *was = json_string_value(json_object_get(entry, key));
    snprintf(text, sizeof text, "%016llx", (unsigned long long)now);
    return !was || strspn(was, "0") == strlen(was) || now == 0 || strcmp(was, text) == 0;
}

bool sb_earlier_check_sources(const struct sb_earlier *earlier,
                              const struct sb_task *tasks, int count,
                              struct sb_error *err)
{
    for (int i = 0; i < count; i++) {
        const json_t *entry =
            json_array_get(json_object_get(earlier->run, "entries"), (size_t)i);
        const bool source =
            same_hash(entry, "source_hash", tasks[i].assembly.source_hash);
        if (!source || !same_hash(entry, "input_hash", tasks[i].prepared.input_hash))
            return sb_fail(err, SB_BAD_INPUT,
                           "%s: %s than when the folder was measured; start anew with "
                           "another -o",
                           tasks[i].entry->id,
                           source ? "the scene has other values"
                                  : "the shaders are others");
    }
    return true;
}

static struct sb_task *find_task(struct sb_task *tasks, int count,
                                 const struct sb_sample_row *row)
{
    for (int i = 0; i < count; i++)
        if (row->variant && row->scene && strcmp(tasks[i].entry->id, row->variant) == 0 &&
            strcmp(tasks[i].entry->scene, row->scene) == 0)
            return &tasks[i];
    return NULL;
}

bool sb_earlier_hand_out(const struct sb_earlier *earlier, struct sb_task *tasks,
                         int count, struct sb_error *err)
{
    for (int line = 1; line < earlier->samples.row_count; line++) {
        struct sb_sample_row row;
        sb_sample_row_init(&row);
        if (!sb_csv_get(&earlier->samples, line, sb_sample_columns,
                        sb_sample_column_count, &row, err))
            return sb_fail(err, SB_BAD_INPUT, "samples.csv: %s", err->text);
        struct sb_task *task = find_task(tasks, count, &row);
        if (!task)
            return sb_fail(
                err, SB_BAD_INPUT, "samples.csv:%d: %s on %s is no variant of the suite",
                line + 1, row.variant ? row.variant : "", row.scene ? row.scene : "");
        if (row.process < 0 || row.process >= earlier->process || row.round < 0 ||
            row.batch < 1 || row.wall_ns < 0 || row.flags < 0)
            return sb_fail(err, SB_BAD_INPUT,
                           "samples.csv:%d: damaged: a process below %d, and process, "
                           "round, batch, wall_ns and flags that are not negative are "
                           "wanted",
                           line + 1, earlier->process);
        task->batch = (int)row.batch;
        sb_task_add_sample(task, &row);
    }
    return true;
}

bool sb_earlier_recall(struct sb_earlier *earlier, const char *dir,
                       const struct sb_suite *suite, struct sb_row *rows,
                       struct sb_variant *variants, struct sb_error *err)
{
    struct sb_arena arena = {0};
    struct sb_csv *csv = &earlier->summary;
    const char *path = sb_path_join(&arena, dir, "summary.csv");
    bool good = sb_csv_read(path, csv, err);
    if (good && csv->row_count != suite->entry_count + 1)
        good = sb_fail(err, SB_BAD_INPUT, "%s: %d rows, but the suite has %d variants",
                       path, csv->row_count - 1, suite->entry_count);
    for (int i = 0; good && i < suite->entry_count; i++) {
        struct sb_row *row = &rows[i];
        variants[i] = suite->entry[i].variant;
        if (!sb_rows_get(csv, i + 1, &suite->axes, &variants[i], row, err))
            good = sb_fail(err, SB_BAD_INPUT, "%s:%d: %s", path, i + 2, err->text);
        else if (!row->variant || strcmp(row->variant, suite->entry[i].id) != 0 ||
                 !row->scene || !row->renderer || !row->version || !row->timer_source ||
                 !row->status || sb_status_find(row->status) == SB_STATUS_COUNT)
            good = sb_fail(err, SB_BAD_INPUT, "%s:%d: damaged: not a row of %s", path,
                           i + 2, suite->entry[i].id);
    }
    sb_arena_free(&arena);
    return good;
}

void sb_earlier_free(struct sb_earlier *earlier)
{
    json_decref(earlier->run);
    sb_csv_free(&earlier->samples);
    sb_csv_free(&earlier->summary);
    *earlier = (struct sb_earlier){0};
}
