// Google Benchmark's JSON, schema version 1. What is not known of the machine is left out, but for
// `caches`, which Bencher wants to see.
#include <string.h>

#include "base/text.h"
#include "export/gbench.h"

static json_t *number_json(const char *text)
{
    double value = 0;
    if (!sb_parse_number(text, &value))
        return json_null();
    return value == (double)(json_int_t)value ? json_integer((json_int_t)value)
                                              : json_real(value);
}

// Numbers with blanks between them.
static json_t *numbers_json(const char *text)
{
    json_t *list = json_array();
    struct sb_text one = {0};
    for (text += strspn(text, " "); *text; text += strspn(text, " ")) {
        const size_t length = strcspn(text, " ");
        sb_text_clear(&one);
        sb_text_add_n(&one, text, length);
        json_array_append_new(list, number_json(one.data));
        text += length;
    }
    sb_text_free(&one);
    return list;
}

static json_t *context_json(const struct sb_export *export)
{
    json_t *context = json_object();
    sb_export_json_text(context, "executable", "shadebench");
    sb_export_json_text(context, "name", export->name);
    for (int i = 0; i < export->property_count; i++) {
        const struct sb_export_property *property = &export->property[i];
        if (!property->value)
            continue;
        if (property->type == SB_EXPORT_TEXT)
            sb_export_json_text(context, property->name, property->value);
        else
            json_object_set_new(context, property->name,
                                property->type == SB_EXPORT_NUMBER
                                    ? number_json(property->value)
                                    : numbers_json(property->value));
    }
    json_object_set_new(context, "caches", json_array());
    json_object_set_new(context, "json_schema_version", json_integer(1));
    return context;
}

static void set_counter(const struct sb_export_counter *counter, void *user)
{
    sb_export_json_number(user, counter->name, counter->value);
}

// What Google Benchmark writes of a benchmark that has failed has times, too, and compare.py
// ends without them.
static void set_failure(json_t *object, const struct sb_gbench_entry *entry)
{
    const bool error = entry->row->outcome == SB_EXPORT_ERROR;
    struct sb_text text = {0};
    sb_gbench_why(entry, &text);
    json_object_set_new(object, error ? "error_occurred" : "skipped", json_true());
    sb_export_json_text(object, error ? "error_message" : "skip_message",
                        sb_text_get(&text));
    sb_text_free(&text);
}

static json_t *entry_json(const struct sb_gbench_entry *entry)
{
    const struct sb_export_row *row = entry->row;
    json_t *object = json_object();
    struct sb_text name = {0};
    sb_gbench_name(entry, &name);
    sb_export_json_text(object, "name", sb_text_get(&name));
    sb_text_clear(&name);
    sb_export_row_name(row, &name);
    json_object_set_new(object, "family_index", json_integer(entry->family));
    json_object_set_new(object, "per_family_instance_index", json_integer(0));
    sb_export_json_text(object, "run_name", sb_text_get(&name));
    sb_export_json_text(object, "run_type", entry->aggregate ? "aggregate" : "iteration");
    json_object_set_new(object, "repetitions", json_integer(entry->repetitions));
    if (!entry->aggregate)
        json_object_set_new(object, "repetition_index", json_integer(entry->index));
    json_object_set_new(object, "threads", json_integer(1));
    if (entry->aggregate) {
        const bool share = strcmp(entry->aggregate, "cv") == 0;
        sb_export_json_text(object, "aggregate_name", entry->aggregate);
        sb_export_json_text(object, "aggregate_unit", share ? "percentage" : "time");
    }
    if (entry->failed)
        set_failure(object, entry);
    json_object_set_new(object, "iterations",
                        json_integer(entry->aggregate
                                         ? entry->repetitions
                                         : (entry->failed ? 0 : row->batch)));
    json_object_set_new(object, "real_time", json_real(entry->real_ns));
    json_object_set_new(object, "cpu_time", json_real(entry->cpu_ns));
    sb_export_json_text(object, "time_unit", "ns");
    sb_gbench_counters(entry, set_counter, object);
    if (entry->whole && row->status && strcmp(row->status, "ok") != 0)
        sb_export_json_text(object, "label", row->status);
    sb_text_free(&name);
    return object;
}

static void write_json(const struct sb_export *export, bool samples, struct sb_text *text)
{
    struct sb_gbench_entries entries;
    json_t *list = json_array();
    sb_gbench_entries_make(export, samples, &entries);
    for (int i = 0; i < entries.count; i++)
        json_array_append_new(list, entry_json(&entries.entry[i]));
    sb_gbench_entries_free(&entries);
    json_t *report = json_object();
    json_object_set_new(report, "context", context_json(export));
    json_object_set_new(report, "benchmarks", list);
    sb_export_json_add(report, text);
}

void sb_export_gbench_json(const struct sb_export *export, struct sb_text *text)
{
    write_json(export, true, text);
}

void sb_export_gbench_aggregates(const struct sb_export *export, struct sb_text *text)
{
    write_json(export, false, text);
}
