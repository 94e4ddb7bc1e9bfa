// The table: cases down, precisions and forms across.
#include "cases/matrix_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "measure/explain.h"

const char *sb_outcome_of(const struct sb_outcome *outcome)
{
    switch (outcome->figure) {
    case SB_FIGURE_NONE:
    case SB_FIGURE_FINITE:
    case SB_FIGURE_FLIPS:
    case SB_FIGURE_OWN:
    case SB_FIGURE_COUNT:
        return NULL;
    case SB_FIGURE_ABSOLUTE:
    case SB_FIGURE_EXCESS:
    case SB_FIGURE_RELATIVE:
    case SB_FIGURE_ANGLE:
    case SB_FIGURE_RISES:
    case SB_FIGURE_LEAKS:
        break;
    }
    return outcome->of >= 0              ? sb_term_rows[outcome->of].name
           : outcome->of == SB_OF_NORMAL ? "normal"
           : outcome->of == SB_OF_VIEW   ? "view"
                                         : "colour";
}

void sb_outcome_text(const struct sb_outcome *outcome, struct sb_text *text)
{
    const struct sb_figure_row *row = &sb_figure_rows[outcome->figure];
    if (isnan(outcome->measured) && isnan(outcome->bound))
        return;
    const char *unit = outcome->figure == SB_FIGURE_RELATIVE ? row->name : row->unit;
    sb_text_printf(text, "%.3g", outcome->measured);
    if (!isnan(outcome->bound))
        sb_text_printf(text, " %s %.3g", outcome->measured <= outcome->bound ? "of" : ">",
                       outcome->bound);
    if (unit && *unit)
        sb_text_printf(text, " %s", unit);
}

void sb_outcome_line(const struct sb_outcome *outcome, struct sb_text *text)
{
    sb_text_add(text, sb_verdict_names[outcome->verdict]);
    if (!isnan(outcome->measured)) {
        const char *of = sb_outcome_of(outcome);
        if (outcome->figure != SB_FIGURE_NONE && outcome->figure != SB_FIGURE_OWN)
            sb_text_printf(text, ": %s%s%s", sb_figure_rows[outcome->figure].name,
                           of ? " of " : "", of ? of : "");
        sb_text_add(text, ": ");
        sb_outcome_text(outcome, text);
        if (outcome->point >= 0)
            sb_text_printf(text, " at point %d", outcome->point);
    }
    if (outcome->note.length)
        sb_text_printf(text, ": %s", outcome->note.data);
}

void sb_matrix_cell_name(const struct sb_matrix_cell *cell, struct sb_text *text)
{
    sb_text_printf(text, "%s %s", sb_case_form_names[cell->form],
                   sb_case_precisions[cell->precision].name);
    if (cell->it->stages)
        sb_text_printf(text, " %s", cell->vertex ? "vertex" : "fragment");
}

// --- a cell of the table: both stages -----------------------------------------------------

// How far a cell is over its bound; what was not measured is worst.
static double excess(const struct sb_outcome *outcome)
{
    if (isnan(outcome->measured) || isnan(outcome->bound))
        return INFINITY;
    return outcome->bound > 0 ? outcome->measured / outcome->bound : outcome->measured;
}

static bool is_worse(const struct sb_matrix_cell *cell, const struct sb_matrix_cell *than)
{
    static const int rank[SB_VERDICT_COUNT] = {
        [SB_VERDICT_NA] = 0,
        [SB_VERDICT_PASS] = 1,
        [SB_VERDICT_REFUSED] = 2,
        [SB_VERDICT_FAIL] = 3,
    };
    const int one = rank[cell->outcome.verdict], other = rank[than->outcome.verdict];
    if (one != other)
        return one > other;
    return cell->outcome.verdict == SB_VERDICT_FAIL &&
           excess(&cell->outcome) > excess(&than->outcome);
}

// The cells of a case stand together.
static int case_end(const struct sb_matrix *matrix, int first)
{
    int end = first;
    while (end < matrix->count && matrix->cell[end].it == matrix->cell[first].it)
        end++;
    return end;
}

// The worse stage; NULL: the case is not asked in that precision and form.
static const struct sb_matrix_cell *folded(const struct sb_matrix *matrix, int first,
                                           int precision, int form)
{
    const struct sb_matrix_cell *worst = NULL;
    const int end = case_end(matrix, first);
    for (int i = first; i < end; i++) {
        const struct sb_matrix_cell *cell = &matrix->cell[i];
        if ((int)cell->precision == precision && (int)cell->form == form &&
            (!worst || is_worse(cell, worst)))
            worst = cell;
    }
    return worst;
}

static void cell_text(const struct sb_matrix_cell *cell, struct sb_text *text)
{
    static const char *const words[SB_VERDICT_COUNT] = {"pass", "FAIL", "refused", "n/a"};
    sb_text_clear(text);
    if (!cell)
        return;
    sb_text_add(text, words[cell->outcome.verdict]);
    if (cell->outcome.verdict != SB_VERDICT_FAIL)
        return;
    const size_t before = text->length;
    sb_text_add(text, " ");
    sb_outcome_text(&cell->outcome, text);
    if (text->length == before + 1) // nothing was measured: the notes say why
        text->data[--text->length] = '\0';
}

// --- the table ----------------------------------------------------------------------------

enum { GAP = 2 };

struct layout {
    const struct sb_matrix *matrix;
    int id;                                                 // width of the first column
    bool form[SB_CASE_PRECISION_COUNT][SB_CASE_FORM_COUNT]; // there is such a column …
    int width[SB_CASE_PRECISION_COUNT][SB_CASE_FORM_COUNT]; // … of that width
};

static void widen(int *width, const char *text)
{
    if (sb_text_width(text) > *width)
        *width = sb_text_width(text);
}

static int precision_width(const struct layout *layout, int precision)
{
    int width = 0;
    for (int form = 0; form < SB_CASE_FORM_COUNT; form++)
        if (layout->form[precision][form])
            width += GAP + layout->width[precision][form];
    return width;
}

static void measure_layout(struct layout *layout, const struct sb_matrix *matrix)
{
    struct sb_text text = {0};
    *layout = (struct layout){.matrix = matrix};
    widen(&layout->id, "case");
    for (int first = 0; first < matrix->count; first = case_end(matrix, first)) {
        widen(&layout->id, matrix->cell[first].it->id);
        for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++)
            for (int form = 0; form < SB_CASE_FORM_COUNT; form++) {
                const struct sb_matrix_cell *cell =
                    folded(matrix, first, precision, form);
                if (!cell)
                    continue;
                cell_text(cell, &text);
                layout->form[precision][form] = true;
                widen(&layout->width[precision][form], sb_text_get(&text));
                widen(&layout->width[precision][form], sb_case_form_names[form]);
            }
    }
    // A precision's name stands over its columns.
    for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++)
        for (int form = SB_CASE_FORM_COUNT - 1; form >= 0; form--)
            if (layout->form[precision][form]) {
                const int more = (int)strlen(sb_case_precisions[precision].name) + GAP -
                                 precision_width(layout, precision);
                layout->width[precision][form] += more > 0 ? more : 0;
                break;
            }
    sb_text_free(&text);
}

static void end_line(struct sb_text *text)
{
    while (text->length && text->data[text->length - 1] == ' ')
        text->data[--text->length] = '\0';
    sb_text_add(text, "\n");
}

static void padded(struct sb_text *text, const char *word, int width)
{
    sb_text_printf(text, "%s%*s", word, width - sb_text_width(word), "");
}

static void add_header(const struct layout *layout, int from, int to,
                       struct sb_text *text)
{
    padded(text, "", layout->id);
    for (int precision = from; precision < to; precision++)
        if (precision_width(layout, precision)) {
            padded(text, "", GAP);
            padded(text, sb_case_precisions[precision].name,
                   precision_width(layout, precision) - GAP);
        }
    end_line(text);
    padded(text, "case", layout->id);
    for (int precision = from; precision < to; precision++)
        for (int form = 0; form < SB_CASE_FORM_COUNT; form++)
            if (layout->form[precision][form]) {
                padded(text, "", GAP);
                padded(text, sb_case_form_names[form], layout->width[precision][form]);
            }
    end_line(text);
}

// False: the case has no cell in these precisions.
static bool add_row(const struct layout *layout, int first, int from, int to,
                    struct sb_text *text)
{
    struct sb_text cell = {0};
    bool any = false;
    padded(text, layout->matrix->cell[first].it->id, layout->id);
    for (int precision = from; precision < to; precision++)
        for (int form = 0; form < SB_CASE_FORM_COUNT; form++) {
            if (!layout->form[precision][form])
                continue;
            cell_text(folded(layout->matrix, first, precision, form), &cell);
            any = any || cell.length > 0;
            padded(text, "", GAP);
            padded(text, sb_text_get(&cell), layout->width[precision][form]);
        }
    end_line(text);
    sb_text_free(&cell);
    return any;
}

static void add_block(const struct layout *layout, int from, int to, struct sb_text *text)
{
    const struct sb_matrix *matrix = layout->matrix;
    const struct sb_case_family *family = NULL;
    struct sb_text row = {0};
    add_header(layout, from, to, text);
    for (int first = 0; first < matrix->count; first = case_end(matrix, first)) {
        sb_text_clear(&row);
        if (!add_row(layout, first, from, to, &row))
            continue;
        if (matrix->cell[first].family != family) {
            family = matrix->cell[first].family;
            sb_text_printf(text, "%s: %s\n", family->name, family->help);
        }
        sb_text_add(text, sb_text_get(&row));
    }
    sb_text_free(&row);
}

void sb_matrix_table(const struct sb_matrix *matrix, int width, struct sb_text *text)
{
    struct layout layout;
    measure_layout(&layout, matrix);
    for (int from = 0; from < SB_CASE_PRECISION_COUNT;) {
        int to = from, used = layout.id;
        while (to < SB_CASE_PRECISION_COUNT &&
               (used == layout.id || used + precision_width(&layout, to) <= width))
            used += precision_width(&layout, to++);
        if (used > layout.id) {
            if (from > 0)
                sb_text_add(text, "\n");
            add_block(&layout, from, to, text);
        }
        from = to;
    }
}
