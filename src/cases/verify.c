#include "cases/verify.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "base/mem.h"
#include "cases/breaking.h"
#include "cases/crew.h"

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

static void add_all(const struct sb_matrix_params *params, struct sb_matrix *matrix)
{
    for (int f = 0; f < SB_CASE_FAMILIES; f++)
        for (int i = 0; i < sb_case_families[f]->count; i++)
            if (is_asked_for(params, &sb_case_families[f]->row[i]))
                add_case(params, &sb_case_families[f]->row[i], sb_case_families[f],
                         matrix);
}

static bool is_stopped(const struct sb_matrix_params *params)
{
    return params->stop && params->stop(params->user);
}

static void ask_cell(const struct sb_matrix_params *params, struct sb_matrix_cell *cell)
{
    sb_case_ask(params->env, cell->it, cell->form, cell->precision, cell->vertex,
                &cell->outcome);
}

// What a matrix that is being asked knows of its cells.
struct asked {
    const struct sb_matrix_params *params;
    struct sb_matrix *matrix;
    bool *known; // a cell
    int count;
};

static void note_asked(struct asked *asked, int cell)
{
    asked->known[cell] = true;
    asked->count++;
    if (asked->params->done)
        asked->params->done(asked->params->user, &asked->matrix->cell[cell], asked->count,
                            asked->matrix->count);
}

static void gather(struct asked *asked)
{
    for (int i = 0; i < asked->matrix->count; i++)
        if (!asked->known[i] &&
            sb_crew_get(asked->params->crew, i, &asked->matrix->cell[i].outcome))
            note_asked(asked, i);
}

static void ask_alone(struct asked *asked)
{
    for (int i = 0; i < asked->matrix->count && !is_stopped(asked->params); i++) {
        ask_cell(asked->params, &asked->matrix->cell[i]);
        note_asked(asked, i);
    }
}

// Until all hands are done, or none has put a cell for so long that their driver must hang.
static void wait_for_crew(struct asked *asked)
{
    enum { MOMENTS = 180 * 50 }; // three minutes
    const struct timespec moment = {0, 20000000};
    int before;
    for (int still = 0; sb_crew_works(asked->params->crew) && still < MOMENTS &&
                        !is_stopped(asked->params);
         still = asked->count == before ? still + 1 : 0) {
        before = asked->count;
        gather(asked);
        nanosleep(&moment, NULL);
    }
    if (!is_stopped(asked->params))
        sb_crew_stop(asked->params->crew);
    gather(asked);
}

static void ask_together(struct asked *asked)
{
    int cell;
    while (!is_stopped(asked->params) &&
           (cell = sb_crew_take(asked->params->crew)) < asked->matrix->count) {
        ask_cell(asked->params, &asked->matrix->cell[cell]);
        note_asked(asked, cell);
        gather(asked);
    }
    wait_for_crew(asked);
    // What a hand had taken and never told of: it died before it could say which.
    for (int i = 0; i < asked->matrix->count && !is_stopped(asked->params); i++)
        if (!asked->known[i]) {
            ask_cell(asked->params, &asked->matrix->cell[i]);
            note_asked(asked, i);
        }
}

// What was not asked goes.
static void keep_known(struct asked *asked)
{
    struct sb_matrix *matrix = asked->matrix;
    int kept = 0;
    for (int i = 0; i < matrix->count; i++)
        if (asked->known[i])
            matrix->cell[kept++] = matrix->cell[i];
    matrix->count = kept;
}

void sb_matrix_ask(const struct sb_matrix_params *params, struct sb_matrix *matrix)
{
    add_all(params, matrix);
    struct asked asked = {.params = params, .matrix = matrix};
    asked.known = sb_alloc(((size_t)matrix->count + 1) * sizeof *asked.known);
    if (params->crew)
        ask_together(&asked);
    else
        ask_alone(&asked);
    keep_known(&asked);
    free(asked.known);
}

void sb_matrix_help(const struct sb_matrix_params *params)
{
    struct sb_matrix matrix = {0};
    int cell;
    add_all(params, &matrix);
    while (!is_stopped(params) && (cell = sb_crew_take(params->crew)) < matrix.count) {
        ask_cell(params, &matrix.cell[cell]);
        sb_crew_put(params->crew, cell, &matrix.cell[cell].outcome);
    }
    sb_matrix_free(&matrix);
}

void sb_matrix_break(const struct sb_matrix_params *params, struct sb_matrix *matrix)
{
    int total = 0, count = 0;
    for (int i = 0; i < matrix->count; i++)
        total += matrix->cell[i].it->scale.name != NULL;
    for (int i = 0; i < matrix->count; i++) {
        struct sb_matrix_cell *cell = &matrix->cell[i];
        struct sb_breaking breaking;
        struct sb_error err = {0};
        if (!cell->it->scale.name)
            continue;
        if (params->stop && params->stop(params->user))
            return;
        if (cell->outcome.verdict == SB_VERDICT_NA)
            continue;
        if (!sb_case_break(params->env, cell->it, cell->form, cell->precision,
                           cell->vertex, &breaking, &err)) {
            sb_text_printf(&cell->outcome.note, "%sno breaking point: %s",
                           cell->outcome.note.length ? "; " : "", err.text);
        } else {
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
