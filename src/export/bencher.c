// Bencher Metric Format: {"benchmark": {"measure": {"value", "lower_value", "upper_value"}}}.
// `latency` is a measure that every project has, in ns. Rows whose instructions were counted have none.
#include <math.h>

#include "base/hash.h"
#include "export/formats.h"

enum { NAME_MAX_BYTES = 1024 }; // its limit is in characters, of which these are not more

// A name that is too long is cut, and a hash of all of it follows.
static void add_name(const struct sb_export_row *row, struct sb_text *name)
{
    sb_export_row_name(row, name);
    if (name->length <= NAME_MAX_BYTES)
        return;
    const unsigned long long hash = sb_hash(SB_HASH_START, name->data, name->length);
    name->length = NAME_MAX_BYTES - 32;
    name->data[name->length] = '\0'; // half a character becomes U+FFFD
    sb_text_printf(name, "-%016llx", hash);
}

static void set_measure(json_t *measures, const char *name,
                        const struct sb_interval *value)
{
    if (!isfinite(value->point))
        return;
    json_t *measure = json_object();
    sb_export_json_number(measure, "value", value->point);
    sb_export_json_number(measure, "lower_value", value->lo);
    sb_export_json_number(measure, "upper_value", value->hi);
    json_object_set_new(measures, name, measure);
}

static void set_counter(json_t *measures, const struct sb_export_counter *counter)
{
    const struct sb_interval value = {counter->value, NAN, NAN, 0};
    struct sb_text name = {0};
    for (const char *p = counter->name; *p; p++)
        sb_text_add_n(&name, *p == '_' ? "-" : p, 1);
    set_measure(measures, sb_text_get(&name), &value);
    sb_text_free(&name);
}

void sb_export_bencher(const struct sb_export *export, struct sb_text *text)
{
    json_t *report = json_object();
    for (int i = 0; i < export->row_count; i++) {
        const struct sb_export_row *row = &export->row[i];
        const struct sb_interval cpu = {row->cpu_ns, NAN, NAN, 0};
        struct sb_text name = {0};
        const bool timed = sb_export_timed(row);
        if (!timed && !sb_export_has_ratio(row) && !isfinite(sb_export_instructions(row)))
            continue;
        json_t *measures = json_object();
        if (timed) {
            set_measure(measures, "latency", &row->frame_ns);
            set_measure(measures, "cpu-time", &cpu);
        }
        set_measure(measures, "ratio", &row->ratio);
        for (int c = 0; c < row->counter_count; c++)
            set_counter(measures, &row->counter[c]);
        add_name(row, &name);
        sb_export_json_object(report, sb_text_get(&name), measures);
        sb_text_free(&name);
    }
    sb_export_json_add(report, text);
}
