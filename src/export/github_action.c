// github-action-benchmark's customSmallerIsBetter: a list of name, unit, value, range and extra.
// It alerts where a value has grown by a share, so a ratio that was measured against something in
// the same run serves it, and a time, which moves with the machine, only where there is none.
//
// What a gate has not measured because both sides are one program is a ratio of 1: most changes touch
// no shader, and of an empty list the action says "No benchmark result was found" and fails the job.
#include <math.h>

#include "export/formats.h"

static void add_extra(const struct sb_export *export, const struct sb_export_row *row,
                      json_t *object)
{
    struct sb_text extra = {0};
    if (row->equal) {
        sb_text_add(&extra, "base and head are the same program");
    } else {
        sb_export_times(row, &extra);
        sb_text_printf(&extra, "\nsamples: %d", row->sample_count);
    }
    if (row->batch)
        sb_text_printf(&extra, " of %d frames", row->batch);
    if (row->status || row->message) {
        sb_text_add(&extra, "\n");
        sb_export_says(row, &extra);
    }
    for (int i = 0; i < export->property_count; i++)
        if (export->property[i].value && export->property[i].flags & SB_EXPORT_HEAD)
            sb_text_printf(&extra, "\n%s: %s", export->property[i].name,
                           export->property[i].value);
    sb_export_json_text(object, "extra", sb_text_get(&extra));
    sb_text_free(&extra);
}

void sb_export_github_action(const struct sb_export *export, struct sb_text *text)
{
    json_t *list = json_array();
    const struct sb_interval one = {1, NAN, NAN, 0};
    struct sb_text name = {0}, half = {0}, range = {0};
    for (int i = 0; i < export->row_count; i++) {
        const struct sb_export_row *row = &export->row[i];
        const bool ratio = row->equal || sb_export_has_ratio(row);
        const struct sb_interval *value = row->equal ? &one
                                          : ratio    ? &row->ratio
                                                     : &row->frame_ns;
        if (sb_export_is_base(row) || (!ratio && !sb_export_timed(row)))
            continue;
        json_t *object = json_object();
        sb_text_clear(&name);
        sb_text_clear(&half);
        sb_text_clear(&range);
        sb_export_row_name(row, &name);
        sb_export_json_text(object, "name", sb_text_get(&name));
        sb_export_json_text(object, "unit", ratio ? "ratio" : "ns/frame");
        sb_export_json_number(object, "value", value->point);
        if (sb_export_half_percent(value, &half)) {
            sb_text_printf(&range, "± %s%%", half.data);
            sb_export_json_text(object, "range", range.data);
        }
        add_extra(export, row, object);
        json_array_append_new(list, object);
    }
    sb_text_free(&name);
    sb_text_free(&half);
    sb_text_free(&range);
    sb_export_json_add(list, text);
}
