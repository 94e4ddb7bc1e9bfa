// GitHub's and GitLab's markdown: what did not pass in a table, the worst first, and what passed in
// another that is folded away.
#include <math.h>
#include <string.h>

#include "base/utf8.h"
#include "export/formats.h"

// The text as it is, in a cell of a table: every sign that markdown or HTML takes for its own is
// escaped, and a line end is a blank. `@` is followed by a space of no width, so that nobody is
// called.
static void add_cell(struct sb_text *text, const char *string)
{
    struct sb_text clean = {0};
    sb_utf8_add(&clean, string);
    for (const char *at = sb_text_get(&clean); *at; at++) {
        if ((unsigned char)*at < ' ')
            sb_text_add(text, " ");
        else if (*at == '<')
            sb_text_add(text, "&lt;");
        else if (*at == '>')
            sb_text_add(text, "&gt;");
        else if (*at == '&')
            sb_text_add(text, "&amp;");
        else if (strchr("\\`*_[]|~#", *at))
            sb_text_printf(text, "\\%c", *at);
        else if (*at == '@')
            sb_text_add(text, "@&#8203;");
        else
            sb_text_add_n(text, at, 1);
    }
    sb_text_free(&clean);
}

static void add_time(struct sb_text *text, const struct sb_interval *ns)
{
    if (isfinite(ns->point)) {
        sb_text_printf(text, "%.3f ms", 1e-6 * ns->point);
        struct sb_text half = {0};
        if (sb_export_half_percent(ns, &half))
            sb_text_printf(text, " ± %s %%", half.data);
        sb_text_free(&half);
    }
}

// What a frame of it costs.
static void add_cost(struct sb_text *text, const struct sb_export_row *row)
{
    const double instructions = sb_export_instructions(row);
    if (sb_export_timed(row))
        add_time(text, &row->frame_ns);
    else if (isfinite(instructions))
        sb_text_printf(text, "%.0f instructions", instructions);
}

static void add_ratio(struct sb_text *text, const struct sb_interval *ratio)
{
    if (isfinite(ratio->point))
        sb_text_printf(text, "%.3f", ratio->point);
    if (isfinite(ratio->lo) && isfinite(ratio->hi))
        sb_text_printf(text, " [%.3f, %.3f]", ratio->lo, ratio->hi);
}

static bool has_pairs(const struct sb_export *export)
{
    for (int i = 0; i < export->row_count; i++)
        if (export->row[i].side)
            return true;
    return false;
}

static void add_row(struct sb_text *text, const struct sb_export *export,
                    const struct sb_export_row *row)
{
    struct sb_text name = {0}, says = {0};
    sb_text_printf(&name, "%s/%s", row->scene, row->variant);
    sb_text_add(text, "| ");
    add_cell(text, sb_text_get(&name));
    sb_text_add(text, " | ");
    if (has_pairs(export)) {
        const struct sb_export_row *base = sb_export_base_of(export, row);
        if (base)
            add_cost(text, base);
        sb_text_add(text, " | ");
    }
    add_cost(text, row);
    sb_text_add(text, " | ");
    if (sb_export_has_ratio(row))
        add_ratio(text, &row->ratio);
    sb_text_add(text, " | ");
    sb_export_says(row, &says);
    add_cell(text, sb_text_get(&says));
    sb_text_add(text, " |\n");
    sb_text_free(&name);
    sb_text_free(&says);
}

static void add_titles(struct sb_text *text, const struct sb_export *export)
{
    sb_text_add(text, has_pairs(export)
                          ? "| variant | base | head | ratio [95 %] | verdict |\n"
                            "|:--|--:|--:|--:|:--|\n"
                          : "| variant | time a frame | ratio [95 %] | status |\n"
                            "|:--|--:|--:|:--|\n");
}

static int count_of(const struct sb_export *export, enum sb_export_outcome outcome)
{
    int count = 0;
    for (int i = 0; i < export->row_count; i++)
        count += !sb_export_is_base(&export->row[i]) && export->row[i].outcome == outcome;
    return count;
}

static void add_rows(struct sb_text *text, const struct sb_export *export,
                     enum sb_export_outcome outcome)
{
    for (int i = 0; i < export->row_count; i++)
        if (!sb_export_is_base(&export->row[i]) && export->row[i].outcome == outcome)
            add_row(text, export, &export->row[i]);
}

// "renderer: llvmpipe · timer: elapsed · seed: 1": a blank line follows.
static void add_head(struct sb_text *text, const struct sb_export *export)
{
    bool first = true;
    sb_text_add(text, "### ");
    add_cell(text, export->name);
    sb_text_add(text, "\n\n");
    for (int i = 0; i < export->property_count; i++) {
        const struct sb_export_property *property = &export->property[i];
        if (!property->value || !(property->flags & SB_EXPORT_HEAD))
            continue;
        sb_text_add(text, first ? "" : " · ");
        add_cell(text, property->name);
        sb_text_add(text, ": ");
        add_cell(text, property->value);
        first = false;
    }
    sb_text_add(text, first ? "" : "\n\n");
}

void sb_export_markdown(const struct sb_export *export, struct sb_text *text)
{
    static const struct {
        enum sb_export_outcome outcome;
        const char *word;
    } order[] = {
        {SB_EXPORT_FAILED, "failed"},
        {SB_EXPORT_ERROR, "not valid"},
        {SB_EXPORT_SKIPPED, "not decided"},
    };
    enum { OTHERS = sizeof order / sizeof *order };
    const int passed = count_of(export, SB_EXPORT_PASSED);
    int others = 0;
    add_head(text, export);
    for (int i = 0; i < OTHERS; i++) {
        const int count = count_of(export, order[i].outcome);
        others += count;
        if (count)
            sb_text_printf(text, "**%d %s**, ", count, order[i].word);
    }
    sb_text_printf(text, "%d passed\n\n", passed);
    if (others)
        add_titles(text, export);
    for (int i = 0; others && i < OTHERS; i++)
        add_rows(text, export, order[i].outcome);
    if (!passed)
        return;
    sb_text_printf(text, "%s<details><summary>%d passed</summary>\n\n",
                   others ? "\n" : "", passed);
    add_titles(text, export);
    add_rows(text, export, SB_EXPORT_PASSED);
    sb_text_add(text, "\n</details>\n");
}
