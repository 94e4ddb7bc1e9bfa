// fit --json: everything that the text says, as numbers.
#include "cli/fit.h"
#include "scene/lights.h"

static json_t *interval_json(double point, double lo, double hi)
{
    return json_pack("{so so so}", "point", sb_compare_number(point), "lo",
                     sb_compare_number(lo), "hi", sb_compare_number(hi));
}

static json_t *lights_json(const struct sb_fit_lights *lights)
{
    return json_pack("{si sb sb sb}", "n", lights->n, "floor", lights->floor, "above",
                     lights->above, "below", lights->below);
}

static json_t *budgets_json(const struct sb_fit_report *report,
                            const struct sb_fit_group *group,
                            const struct sb_fit_type *type)
{
    double ms[SB_BUDGETS_MAX];
    const int count = sb_fit_budgets(report, group, ms);
    json_t *list = json_array();
    for (int b = 0; b < count; b++) {
        const struct sb_fit_lights point = sb_fit_lights_in(group, type, ms[b], 0);
        const struct sb_fit_lights lo = sb_fit_lights_in(group, type, ms[b], -1);
        const struct sb_fit_lights hi = sb_fit_lights_in(group, type, ms[b], 1);
        json_array_append_new(list, json_pack("{sf so so so}", "ms", ms[b], "lights",
                                              lights_json(&point), "lo", lights_json(&lo),
                                              "hi", lights_json(&hi)));
    }
    return list;
}

static json_t *counts_json(const struct sb_fit_type *type)
{
    json_t *list = json_array();
    for (int c = 0; c < type->counts; c++) {
        const struct sb_row *row = type->count[c].row;
        const struct sb_interval at = sb_fit_at(type, type->count[c].n);
        json_array_append_new(
            list, json_pack("{sf ss so so}", "n", type->count[c].n, "variant",
                            row->variant, "measured_ms",
                            interval_json(row->median_ms, row->ci_lo_ms, row->ci_hi_ms),
                            "model_ms", interval_json(at.point, at.lo, at.hi)));
    }
    return list;
}

static json_t *type_json(const struct sb_fit_report *report,
                         const struct sb_fit_group *group, const struct sb_fit_type *type)
{
    json_t *object = json_pack(
        "{ss ss so so so}", "type", report->compared->axes->row[type->axis].name, "shape",
        sb_fit_shape_words[type->shape], "ms_a_light",
        interval_json(type->price.point, type->price.lo, type->price.hi), "first_ms",
        sb_compare_number(type->first_ms), "line_ms_at_0",
        sb_compare_number(type->line.intercept));
    json_object_set_new(object, "line_off", sb_compare_number(type->off));
    json_object_set_new(object, "line_off_at", sb_compare_number(type->off_n));
    if (type->shape == SB_FIT_BEND)
        json_object_set_new(object, "flat_to", sb_compare_number(type->curve.at));
    if (type->jump_ms > 0)
        json_object_set_new(object, "jump",
                            json_pack("{sf sf sf}", "from", type->jump_from, "to",
                                      type->jump_to, "ms", type->jump_ms));
    json_object_set_new(object, "counts", counts_json(type));
    json_object_set_new(object, "fit_in", budgets_json(report, group, type));
    return object;
}

static json_t *mix_json(const struct sb_fit_report *report, const struct sb_fit_mix *mix)
{
    json_t *counts = json_object();
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const int axis = sb_light_structs[t].axis;
        json_object_set_new(counts, report->compared->axes->row[axis].name,
                            json_integer((json_int_t)mix->row->axes->value[axis]));
    }
    return json_pack(
        "{ss so so so so sb sb}", "variant", mix->row->variant, "counts", counts,
        "measured_ms",
        interval_json(mix->row->median_ms, mix->row->ci_lo_ms, mix->row->ci_hi_ms),
        "predicted_ms",
        interval_json(mix->predicted.point, mix->predicted.lo, mix->predicted.hi), "off",
        sb_compare_number(mix->off), "outside", mix->outside, "in_jump", mix->in_jump);
}

static json_t *group_json(const struct sb_fit_report *report,
                          const struct sb_fit_group *group)
{
    json_t *types = json_array(), *mixes = json_array();
    struct sb_text heading = {0};
    for (int t = 0; t < group->types; t++)
        json_array_append_new(types, type_json(report, group, &group->type[t]));
    for (int m = 0; m < group->mixes; m++)
        json_array_append_new(mixes, mix_json(report, &group->mix[m]));
    sb_fit_heading(report, group, &heading);
    json_t *object = json_pack(
        "{ss ss ss? so so so so}", "group", sb_text_get(&heading), "scene",
        group->row[0]->scene, "ci_kind", group->row[0]->ci_kind, "floor_ms",
        group->base ? interval_json(group->base->median_ms, group->base->ci_lo_ms,
                                    group->base->ci_hi_ms)
                    : json_null(),
        "lit_ms", sb_compare_number(group->lit_ms), "first_ms",
        sb_compare_number(group->first_ms), "types", types);
    json_object_set_new(object, "mixes", mixes);
    json_object_set_new(object, "interaction", sb_compare_number(group->interaction));
    json_object_set_new(object, "worst", sb_compare_number(group->worst));
    sb_text_free(&heading);
    return object;
}

static json_t *series_json(const struct sb_fit_report *report,
                           const struct sb_crossing_series *series)
{
    const struct sb_axis *axis = &report->compared->axes->row[series->axis];
    const char *a = axis->values[series->value_a].name;
    const char *b = axis->values[series->value_b].name;
    json_t *pairs = json_array(), *crossings = json_array();
    struct sb_text heading = {0};
    for (int i = 0; i < series->pairs; i++) {
        const struct sb_crossing_pair *pair = &series->pair[i];
        json_array_append_new(
            pairs, json_pack("{sf ss ss sf sf so}", "triangles_a_pixel", pair->density,
                             "a", pair->a->variant, "b", pair->b->variant, "a_ms",
                             pair->a->median_ms, "b_ms", pair->b->median_ms, "ratio",
                             interval_json(pair->ratio, pair->lo, pair->hi)));
    }
    for (int c = 0; c < series->crossings; c++) {
        const struct sb_crossing *at = &series->crossing[c];
        json_array_append_new(crossings,
                              json_pack("{ss so sb sb}", "faster_below",
                                        at->b_first ? b : a, "triangles_a_pixel",
                                        interval_json(at->density, at->lo, at->hi),
                                        "open_lo", at->open_lo, "open_hi", at->open_hi));
    }
    sb_fit_series_heading(report, series, &heading);
    json_t *object =
        json_pack("{ss ss ss ss so so}", "series", sb_text_get(&heading), "axis",
                  axis->name, "a", a, "b", b, "pairs", pairs, "crossings", crossings);
    sb_text_free(&heading);
    return object;
}

json_t *sb_fit_json(const struct sb_fit_report *report)
{
    json_t *groups = json_array(), *series = json_array();
    for (int g = 0; g < report->fit.count; g++)
        json_array_append_new(groups, group_json(report, &report->fit.group[g]));
    for (int s = 0; s < report->crossings.count; s++)
        json_array_append_new(series, series_json(report, &report->crossings.series[s]));
    return json_pack("{ss si si so so}", "file", report->compared->path, "without_time",
                     report->fit.without_time, "left_over", report->fit.left_over,
                     "groups", groups, "crossings", series);
}
