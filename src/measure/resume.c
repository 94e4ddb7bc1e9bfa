#include <string.h>

#include "base/file.h"
#include "measure/resume.h"
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

static void count_processes(struct sb_earlier *earlier)
{
    size_t i;
    const json_t *process;
    json_array_foreach(json_object_get(earlier->run, "processes"), i, process)
    {
        earlier->last_incomplete = !json_is_true(json_object_get(process, "complete"));
        earlier->complete += !earlier->last_incomplete;
        earlier->process = (int)i + 1;
    }
}

bool sb_earlier_load(const char *dir, const struct sb_suite *suite,
                     struct sb_earlier *earlier, struct sb_error *err)
{
    struct sb_arena arena = {0};
    earlier->run = sb_store_read_run(dir, err);
    bool good =
        earlier->run && check_plan(earlier, suite, dir, err) &&
        sb_csv_read(sb_path_join(&arena, dir, "samples.csv"), &earlier->samples, err);
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
            return false;
        struct sb_task *task = find_task(tasks, count, &row);
        if (!task || row.batch < 1)
            return sb_fail(
                err, SB_BAD_INPUT, "samples.csv:%d: %s on %s is no variant of the suite",
                line + 1, row.variant ? row.variant : "", row.scene ? row.scene : "");
        task->batch = (int)row.batch;
        sb_task_add_sample(task, &row);
    }
    return true;
}

void sb_earlier_free(struct sb_earlier *earlier)
{
    json_decref(earlier->run);
    sb_csv_free(&earlier->samples);
    *earlier = (struct sb_earlier){0};
}
