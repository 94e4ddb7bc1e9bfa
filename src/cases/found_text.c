// Findings of the search as C.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/knobs.h"
#include "cases/search.h"

// A C literal: without a dot or an exponent the f would be an error.
static void add_float(float value, struct sb_text *text)
{
    char number[32];
    snprintf(number, sizeof number, "%.9g", (double)value);
    sb_text_printf(text, " = %s%sf;\n", number, strpbrk(number, ".e") ? "" : ".0");
}

// The members that are not a plain point's.
static void add_members(const struct sb_points *points, bool of_light,
                        struct sb_text *text)
{
    struct sb_points plain = sb_points_like(points);
    sb_points_add(&plain);
    for (int k = 0; k < sb_knob_count; k++)
        for (int c = 0; c < sb_knobs[k].components; c++) {
            const struct sb_knob *knob = &sb_knobs[k];
            const float value = *sb_knob_of(points, 0, knob, c);
            if (knob->of_light != of_light || value == *sb_knob_of(&plain, 0, knob, c))
                continue;
            sb_text_printf(text, "    %s%s", of_light ? "" : "point->", knob->name);
            if (knob->components > 1)
                sb_text_printf(text, "[%d]", c);
            add_float(value, text);
        }
    sb_points_free(&plain);
}

void sb_found_text(const struct sb_found *found, const struct sb_search_params *params,
                   int number, struct sb_text *text)
{
    const bool half = sb_case_precisions[params->precision].half;
    const bool spot = found->points.lights && found->points.type[0] == SB_LIGHT_SPOT;
    sb_text_printf(text,
                   "static void found_%d(struct sb_points *points, const struct "
                   "sb_case_setting *setting)\n{\n",
                   number);
    sb_text_add(
        text,
        "    (void)setting;\n    struct sb_point *point = sb_points_add(points);\n");
    sb_text_add(
        text,
        "    struct sb_light *light = sb_points_light(points, points->count - 1, 0);\n");
    add_members(&found->points, false, text);
    add_members(&found->points, true, text);
    if (spot)
        sb_text_add(text, "    sb_light_set_cone(light, light->inner, light->cutoff);\n");
    sb_text_add(text, "}\n\n");
    sb_text_printf(text, "    { // %s %s: ", sb_case_precisions[params->precision].name,
                   sb_case_form_names[params->form]);
    if (isfinite(found->measured))
        sb_text_printf(text, "%.3g of 255, where the last place of all inputs makes %.2g",
                       found->measured, found->spread);
    else
        sb_text_add(text, "not finite");
    sb_text_printf(
        text,
        "\n        .id = \"found-%d\",\n        .given = \"%s\",\n"
        "        .form = {\"form=naive\", \"\"},\n        .precisions = %s,\n"
        "        .stages = SB_IN_FRAGMENT,\n"
        "        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}, {SB_FIGURE_ABSOLUTE, "
        "SB_OF_COLOUR, 0.5, 4}},\n        .hdr = true,\n        .points = found_%d,\n    "
        "},\n",
        number, found->given, half ? "SB_IN_HALF" : "SB_IN_HIGHP", number);
}
