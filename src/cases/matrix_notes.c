// What stands below the matrix: notes, failures, the summary and breaking points.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/matrix_text.h"

static bool same_note(const struct sb_matrix_cell *a, const struct sb_matrix_cell *b)
{
    return (a->outcome.verdict == SB_VERDICT_NA) ==
               (b->outcome.verdict == SB_VERDICT_NA) &&
           strcmp(sb_text_get(&a->outcome.note), sb_text_get(&b->outcome.note)) == 0;
}

static bool is_first(const struct sb_matrix *matrix, int i, bool of_case)
{
    for (int k = 0; k < i; k++)
        if (same_note(&matrix->cell[k], &matrix->cell[i]) &&
            (!of_case || matrix->cell[k].it == matrix->cell[i].it))
            return false;
    return true;
}

static void add_note(const struct sb_matrix *matrix, int i, struct sb_text *text)
{
    const struct sb_matrix_cell *cell = &matrix->cell[i];
    int others = 0;
    for (int k = i + 1; k < matrix->count; k++)
        others += matrix->cell[k].it == cell->it && same_note(&matrix->cell[k], cell);
    sb_text_printf(text, "%s ", cell->it->id);
    sb_matrix_cell_name(cell, text);
    if (others)
        sb_text_printf(text, " and %d more", others);
    sb_text_printf(text, ": %s\n", sb_text_get(&cell->outcome.note));
}

// The reason, and the cases that have it in any cell.
static void add_reason(const struct sb_matrix *matrix, int i, int width,
                       struct sb_text *text)
{
    const struct sb_matrix_cell *cell = &matrix->cell[i];
    int cells = 0, column = 0;
    for (int k = i; k < matrix->count; k++)
        cells += same_note(&matrix->cell[k], cell);
    sb_text_printf(text, "n/a, %d cell%s: %s\n", cells, cells == 1 ? "" : "s",
                   sb_text_get(&cell->outcome.note));
    const struct sb_case *said = NULL;
    for (int k = i; k < matrix->count; k++) {
        const struct sb_case *it = matrix->cell[k].it;
        if (it == said || !same_note(&matrix->cell[k], cell))
            continue;
        const int length = (int)strlen(it->id);
        const bool wrap = column > 0 && column + 2 + length > width;
        if (column == 0 || wrap)
            column = 2;
        else
            column += 2;
        sb_text_printf(text, "%s%s%s", said ? "," : "", wrap ? "\n" : "",
                       !said || wrap ? "  " : " ");
        sb_text_add(text, it->id);
        column += length;
        said = it;
    }
    sb_text_add(text, "\n");
}

void sb_matrix_notes(const struct sb_matrix *matrix, int width, struct sb_text *text)
{
    for (int i = 0; i < matrix->count; i++)
        if (matrix->cell[i].outcome.verdict != SB_VERDICT_NA &&
            matrix->cell[i].outcome.note.length && is_first(matrix, i, true))
            add_note(matrix, i, text);
    for (int i = 0; i < matrix->count; i++)
        if (matrix->cell[i].outcome.verdict == SB_VERDICT_NA &&
            is_first(matrix, i, false))
            add_reason(matrix, i, width, text);
}

void sb_matrix_failures(const struct sb_matrix *matrix, struct sb_text *text)
{
    for (int i = 0; i < matrix->count; i++) {
        const struct sb_matrix_cell *cell = &matrix->cell[i];
        if (sb_matrix_holds(cell))
            continue;
        sb_text_printf(text, "%s ", cell->it->id);
        sb_matrix_cell_name(cell, text);
        sb_text_add(text, ": ");
        sb_outcome_line(&cell->outcome, text);
        sb_text_add(text, "\n");
    }
}

// --- the summary --------------------------------------------------------------------------

struct tally {
    int cases, robust, hold, na;
    int naive, fail; // forms: one a case
};

static bool is_last(const struct sb_matrix *matrix, int i)
{
    return i + 1 == matrix->count || matrix->cell[i + 1].it != matrix->cell[i].it;
}

static void add_passing(const struct sb_case *it, struct sb_text *text)
{
    sb_text_printf(text, "%s: naive passes wherever it was asked: %s\n", it->id,
                   it->holds ? it->holds : "it should not everywhere");
}

void sb_matrix_summary(const struct sb_matrix *matrix, struct sb_text *text)
{
    struct tally tally = {0};
    struct sb_text passing = {0};
    bool asked = false, failed = false; // the naive form of this case
    for (int i = 0; i < matrix->count; i++) {
        const struct sb_matrix_cell *cell = &matrix->cell[i];
        if (cell->outcome.verdict == SB_VERDICT_NA) {
            tally.na++;
        } else if (cell->form == SB_CASE_ROBUST) {
            tally.robust++;
            tally.hold += sb_matrix_holds(cell);
        } else {
            asked = true;
            failed = failed || cell->outcome.verdict == SB_VERDICT_FAIL;
        }
        if (!is_last(matrix, i))
            continue;
        tally.cases++;
        tally.naive += asked;
        tally.fail += failed;
        if (asked && !failed)
            add_passing(cell->it, &passing);
        asked = failed = false;
    }
    sb_text_add(text, sb_text_get(&passing));
    sb_text_printf(
        text,
        "%d case%s: %d of %d robust cells hold, %d of %d naive forms fail as they "
        "should, %d cells n/a\n",
        tally.cases, tally.cases == 1 ? "" : "s", tally.hold, tally.robust, tally.fail,
        tally.naive, tally.na);
    sb_text_free(&passing);
}

// --- breaking points ----------------------------------------------------------------------

// How far a precision and form hold: in the stage that breaks first.
static const struct sb_matrix_cell *first_to_break(const struct sb_matrix *matrix,
                                                   const struct sb_case *it,
                                                   int precision, int form)
{
    const struct sb_matrix_cell *first = NULL;
    for (int i = 0; i < matrix->count; i++) {
        const struct sb_matrix_cell *cell = &matrix->cell[i];
        if (cell->it != it || !cell->broken || (int)cell->precision != precision ||
            (int)cell->form != form)
            continue;
        if (!first || isnan(cell->holds_to) || cell->holds_to < first->holds_to)
            first = cell;
    }
    return first;
}

static void add_reach(const struct sb_matrix_cell *cell, struct sb_text *text)
{
    char digits[32], number[32];
    snprintf(digits, sizeof digits, "%.3g",
             isnan(cell->holds_to) ? cell->it->scale.from : cell->holds_to);
    sb_number_text(strtod(digits, NULL), number);
    if (isnan(cell->holds_to))
        sb_text_printf(text, " not even at %s", number);
    else
        sb_text_printf(text, " to %s%s", number, cell->to_the_end ? " (all)" : "");
}

static bool same_reach(const struct sb_matrix_cell *a, const struct sb_matrix_cell *b)
{
    return a && b &&
           (a->holds_to == b->holds_to || (isnan(a->holds_to) && isnan(b->holds_to)));
}

static void add_case_reach(const struct sb_matrix *matrix, const struct sb_case *it,
                           struct sb_text *text)
{
    const char *between = "";
    sb_text_printf(text, "%s: %s:", it->id, it->scale.name);
    for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++) {
        const struct sb_matrix_cell *cell[SB_CASE_FORM_COUNT];
        for (int form = 0; form < SB_CASE_FORM_COUNT; form++)
            cell[form] = first_to_break(matrix, it, precision, form);
        const bool same = same_reach(cell[SB_CASE_NAIVE], cell[SB_CASE_ROBUST]);
        if (!cell[SB_CASE_NAIVE] && !cell[SB_CASE_ROBUST])
            continue;
        sb_text_printf(text, "%s %s", between, sb_case_precisions[precision].name);
        const char *comma = "";
        for (int form = 0; form < SB_CASE_FORM_COUNT; form++) {
            if (!cell[form] || (same && form != SB_CASE_ROBUST))
                continue;
            if (!same)
                sb_text_printf(text, "%s %s", comma, sb_case_form_names[form]);
            add_reach(cell[form], text);
            comma = ",";
        }
        between = ";";
    }
    sb_text_printf(text, " %s\n", it->scale.unit ? it->scale.unit : "");
}

void sb_matrix_breaking(const struct sb_matrix *matrix, struct sb_text *text)
{
    bool any = false;
    for (int i = 0; i < matrix->count; i++) {
        any = any || matrix->cell[i].broken;
        if (!is_last(matrix, i))
            continue;
        if (any)
            add_case_reach(matrix, matrix->cell[i].it, text);
        any = false;
    }
}
