#include "base/file.h"
#include "cli/platforms.h"
#include "cli/results.h"
#include "measure/record.h"
#include "results/store.h"

// Of one run's list, each with the platform's name.
static void add_all(json_t *to, const json_t *list, const char *label)
{
    size_t i;
    const json_t *item;
    json_array_foreach(list, i, item)
    {
        json_t *copy = json_deep_copy(item);
        json_object_set_new(copy, "platform", json_string(label));
        json_array_append_new(to, copy);
    }
}

bool sb_platforms_record(const struct sb_platforms_run *run, struct sb_error *err)
{
    const struct sb_suite *suite = run->suite;
    struct sb_arena arena = {0};
    json_t *platforms = json_array(), *processes = json_array(), *entries = json_array();
    for (int i = 0; i < run->platforms->count; i++) {
        struct sb_error ignored;
        const char *label = run->platforms->label[i];
        // One that was not begun has none.
        json_t *own = sb_store_read_run(sb_path_join(&arena, run->dir, label), &ignored);
        json_array_append_new(platforms,
                              json_pack("{sssb}", "platform", label, "complete",
                                        own && sb_run_is_whole(own)));
        add_all(processes, json_object_get(own, "processes"), label);
        add_all(entries, json_object_get(own, "entries"), label);
        json_decref(own);
    }
    json_t *record = json_pack("{ssssss}", "shadebench", SB_VERSION, "suite", suite->name,
                               "about", suite->about ? suite->about : "");
    json_object_set_new(record, "arguments", json_deep_copy(run->arguments));
    json_object_set_new(record, "measure", sb_settings_json(&suite->measure));
    json_object_set_new(record, "platforms", platforms);
    json_object_set_new(record, "processes", processes);
    json_object_set_new(record, "entries", entries);
    const bool good = sb_store_run_in(run->dir, record, err);
    json_decref(record);
    sb_arena_free(&arena);
    return good;
}
