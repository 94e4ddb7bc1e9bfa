// Google Benchmark's CSV: its ten columns, then one for each counter that any entry has.
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/utf8.h"
#include "export/gbench.h"

struct names { // of counters
    const char **name;
    int count, capacity;
};

static void add_name(const struct sb_export_counter *counter, void *user)
{
    struct names *names = user;
    for (int i = 0; i < names->count; i++)
        if (strcmp(names->name[i], counter->name) == 0)
            return;
    names->name =
        sb_grow((void *)names->name, names->count, &names->capacity, sizeof *names->name);
    names->name[names->count++] = counter->name;
}

static void add_quoted(struct sb_text *text, const char *string)
{
    struct sb_text clean = {0};
    sb_utf8_add(&clean, string);
    sb_text_add(text, "\"");
    for (const char *p = sb_text_get(&clean); *p; p++) {
        if (*p == '"')
            sb_text_add(text, "\"");
        sb_text_add_n(text, p, 1);
    }
    sb_text_add(text, "\"");
    sb_text_free(&clean);
}

struct wanted { // one counter of an entry
    const char *name;
    struct sb_text *text;
};

static void add_if_wanted(const struct sb_export_counter *counter, void *user)
{
    const struct wanted *wanted = user;
    if (strcmp(counter->name, wanted->name) == 0)
        sb_export_number(wanted->text, counter->value);
}

static void add_times(const struct sb_gbench_entry *entry, struct sb_text *text)
{
    const char *status = entry->row->status;
    sb_text_printf(text, "%d,",
                   entry->aggregate ? entry->repetitions : entry->row->batch);
    sb_export_number(text, entry->real_ns);
    sb_text_add(text, ",");
    sb_export_number(text, entry->cpu_ns);
    sb_text_add(text, ",ns,,,"); // no bytes, no items
    if (entry->whole && status && strcmp(status, "ok") != 0)
        add_quoted(text, status);
    sb_text_add(text, ",,");
}

static void add_failure(const struct sb_gbench_entry *entry, struct sb_text *text)
{
    struct sb_text says = {0};
    sb_gbench_why(entry, &says);
    sb_text_printf(text, ",,,,,,,%s,",
                   entry->row->outcome == SB_EXPORT_ERROR ? "true" : "false");
    add_quoted(text, sb_text_get(&says));
    sb_text_free(&says);
}

static void add_entry(const struct sb_gbench_entry *entry, const struct names *names,
                      struct sb_text *text)
{
    struct sb_text name = {0};
    sb_gbench_name(entry, &name);
    add_quoted(text, sb_text_get(&name));
    sb_text_add(text, ",");
    sb_text_free(&name);
    if (entry->failed)
        add_failure(entry, text);
    else
        add_times(entry, text);
    for (int i = 0; i < names->count; i++) {
        struct wanted wanted = {names->name[i], text};
        sb_text_add(text, ",");
        sb_gbench_counters(entry, add_if_wanted, &wanted);
    }
    sb_text_add(text, "\n");
}

void sb_export_gbench_csv(const struct sb_export *export, struct sb_text *text)
{
    struct sb_gbench_entries entries;
    struct names names = {0};
    sb_gbench_entries_make(export, true, &entries);
    for (int i = 0; i < entries.count; i++)
        sb_gbench_counters(&entries.entry[i], add_name, &names);
    sb_text_add(text, "name,iterations,real_time,cpu_time,time_unit,bytes_per_second,"
                      "items_per_second,label,error_occurred,error_message");
    for (int i = 0; i < names.count; i++)
        sb_text_printf(text, ",\"%s\"", names.name[i]);
    sb_text_add(text, "\n");
    for (int i = 0; i < entries.count; i++)
        add_entry(&entries.entry[i], &names, text);
    free((void *)names.name);
    sb_gbench_entries_free(&entries);
}
