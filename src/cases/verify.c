#include "cases/verify.h"

#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "cases/breaking.h"

static unsigned precisions_of(const struct sb_matrix_params *params)
{
    if (params->precisions)
        return params->precisions;
    const bool real = !sb_case_unavailable(params->env, SB_CASE_HALF, false);
    return SB_IN_HIGHP | SB_IN_FIXED | 1u << (real ? SB_CASE_HALF : SB_CASE_EMULATED);
}

static void add_cell(struct sb_matrix *matrix, const struct sb_matrix_cell *cell)
{
    matrix->cell =
        sb_grow(matrix->cell, matrix->count, &matrix->capacity, sizeof *matrix->cell);
    matrix->cell[matrix->count++] = *cell;
}

static void add_case(const struct sb_matrix_params *params, const struct sb_case *it,
                     const struct sb_case_family *family, struct sb_matrix *matrix)
{
    const unsigned forms = params->forms ? params->forms : 3;
    // Of no precision, of no stage: once, where highp and fragments stand.
    const unsigned precisions =
        it->precisions ? it->precisions & precisions_of(params) : SB_IN_HIGHP;
    const unsigned stages = it->stages ? it->stages : SB_IN_FRAGMENT;
    struct sb_matrix_cell cell = {.it = it,
                                  .family = family,
                                  .cost = NAN,
                                  .cost_lo = NAN,
                                  .cost_hi = NAN,
                                  .holds_to = NAN};
    for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++)
        for (int vertex = 0; vertex < 2; vertex++)
            for (int form = 0; form < SB_CASE_FORM_COUNT; form++) {
                if (!(precisions >> precision & 1) || !(forms >> form & 1) ||
                    !(stages >> vertex & 1) || !it->form[form])
                    continue;
                cell.precision = (enum sb_case_precision)precision;
                cell.vertex = vertex;
                cell.form = (enum sb_case_form)form;
                add_cell(matrix, &cell);
            }
}

static bool is_asked_for(const struct sb_matrix_params *params, const struct sb_case *it)
{
    for (int i = 0; i < params->count; i++)
        if (params->it[i] == it)
            return true;
    return params->count == 0;
}

void sb_matrix_ask(const struct sb_matrix_params *params, struct sb_matrix *matrix)
{
    for (int f = 0; f < SB_CASE_FAMILIES; f++)
        for (int i = 0; i < sb_case_families[f]->count; i++)
            if (is_asked_for(params, &sb_case_families[f]->row[i]))
                add_case(params, &sb_case_families[f]->row[i], sb_case_families[f],
                         matrix);
    const int total = matrix->count;
    for (matrix->count = 0; matrix->count < total; matrix->count++) {
        struct sb_matrix_cell *cell = &matrix->cell[matrix->count];
        if (params->stop && params->stop(params->user))
            return;
        sb_case_ask(params->env, cell->it, cell->form, cell->precision, cell->vertex,
                    &cell->outcome);
        if (params->done)
            params->done(params->user, cell, matrix->count + 1, total);
    }
}

void sb_matrix_break(const struct sb_matrix_params *params, struct sb_matrix *matrix)
{
    int total = 0, count = 0;
    for (int i = 0; i < matrix->count; i++)
        total += matrix->cell[i].it->scale.name != NULL;
    for (int i = 0; i < matrix->count; i++) {
        struct sb_matrix_cell *cell = &matrix->cell[i];
        struct sb_breaking breaking;
        struct sb_error ignored; // the cell itself says why it cannot be asked
        if (!cell->it->scale.name)
            continue;
        if (params->stop && params->stop(params->user))
            return;
        if (cell->outcome.verdict != SB_VERDICT_NA &&
            sb_case_break(params->env, cell->it, cell->form, cell->precision,
                          cell->vertex, &breaking, &ignored)) {
            cell->broken = true;
            cell->holds_to = breaking.holds_to;
            cell->to_the_end = breaking.to_the_end;
            sb_text_free(&breaking.outcome.note);
        }
        if (params->done)
            params->done(params->user, cell, ++count, total);
    }
}

void sb_matrix_free(struct sb_matrix *matrix)
{
    for (int i = 0; i < matrix->count; i++)
        sb_text_free(&matrix->cell[i].outcome.note);
    free(matrix->cell);
    *matrix = (struct sb_matrix){0};
}

bool sb_matrix_holds(const struct sb_matrix_cell *cell)
{
    const enum sb_verdict verdict = cell->outcome.verdict;
    if (cell->form == SB_CASE_NAIVE || verdict == SB_VERDICT_NA)
        return true;
    return verdict == SB_VERDICT_PASS ||
           (verdict == SB_VERDICT_REFUSED && cell->it->on_cpu);
}
