// The matrix as rows of cases.csv, as junit.xml and as JSON.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "cases/matrix_text.h"
#include "cli/report.h"
#include "cli/verify.h"
#include "measure/interrupt.h"
#include "measure/precision.h"
#include "results/junit.h"

// --- rows ---------------------------------------------------------------------------------

// NULL where the variant cannot be had here.
static const char *effective_precision(const struct sb_verify *verify,
                                       const struct sb_matrix_cell *cell,
                                       struct sb_arena *arena)
{
    struct sb_variant variant;
    struct sb_error ignored;
    if (!sb_case_variant(&verify->env, cell->it, cell->form, cell->precision,
                         cell->vertex, NULL, &variant, &ignored))
        return NULL;
    const struct sb_asked_precision asked = sb_platform_precision(&variant);
    return sb_precision_effective(&asked, &verify->driver, arena);
}

static double percent(double ratio)
{
    return 100 * (ratio - 1);
}

void sb_verify_row(const struct sb_verify *verify, const struct sb_matrix_cell *cell,
                   struct sb_arena *arena, struct sb_case_row *row)
{
    const struct sb_outcome *outcome = &cell->outcome;
    const struct sb_caps *caps = &verify->driver.caps;
    sb_case_row_init(row);
    row->id = cell->it->id;
    row->family = cell->family->name;
    row->form = sb_case_form_names[cell->form];
    row->stage = !cell->it->stages ? NULL : cell->vertex ? "vertex" : "fragment";
    row->precision = sb_case_precisions[cell->precision].name;
    row->verdict = sb_verdict_names[outcome->verdict];
    if (outcome->verdict != SB_VERDICT_NA)
        row->precision_effective = effective_precision(verify, cell, arena);
    if (outcome->figure != SB_FIGURE_NONE) {
        row->figure = sb_figure_rows[outcome->figure].name;
        row->of = sb_outcome_of(outcome);
        row->unit = sb_figure_rows[outcome->figure].unit;
    }
    row->measured = outcome->measured;
    row->bound = outcome->bound;
    if (outcome->point >= 0)
        row->point = outcome->point;
    row->holds_to = cell->holds_to;
    row->cost_pct = percent(cell->cost);
    row->cost_lo_pct = percent(cell->cost_lo);
    row->cost_hi_pct = percent(cell->cost_hi);
    if (outcome->note.length)
        row->note = sb_arena_strdup(arena, outcome->note.data);
    row->renderer = caps->renderer;
    row->version = caps->version;
    row->api = caps->gles ? "gles" : "gl";
}

// --- junit.xml ----------------------------------------------------------------------------

// What a cell says, in a line; of an n/a only why.
static const char *says(const struct sb_matrix_cell *cell, struct sb_arena *arena)
{
    struct sb_text text = {0};
    if (cell->outcome.verdict == SB_VERDICT_NA)
        sb_text_add(&text, sb_text_get(&cell->outcome.note));
    else
        sb_outcome_line(&cell->outcome, &text);
    const char *kept = sb_arena_strdup(arena, sb_text_get(&text));
    sb_text_free(&text);
    return kept;
}

static struct sb_junit_case junit_case(const struct sb_matrix_cell *cell,
                                       struct sb_arena *arena)
{
    struct sb_text name = {0};
    struct sb_junit_case row = {.class_name = cell->it->id};
    sb_matrix_cell_name(cell, &name);
    row.name = sb_arena_strdup(arena, sb_text_get(&name));
    sb_text_free(&name);
    if (cell->outcome.verdict == SB_VERDICT_NA) {
        row.outcome = SB_JUNIT_SKIPPED;
        row.message = says(cell, arena);
    } else if (!sb_matrix_holds(cell)) {
        const char *type = sb_figure_rows[cell->outcome.figure].name;
        row.outcome = SB_JUNIT_FAILED;
        row.type = type ? type : sb_verdict_names[cell->outcome.verdict];
        row.message = says(cell, arena);
    } else if (cell->form == SB_CASE_NAIVE || cell->outcome.note.length) {
        row.output = says(cell, arena);
    }
    return row;
}

// Families follow one another in the matrix: a suite each.
static int make_suites(const struct sb_matrix *matrix, struct sb_junit_case *row,
                       struct sb_junit_suite *suite, struct sb_arena *arena)
{
    int count = 0;
    const struct sb_case_family *family = NULL;
    for (int i = 0; i < matrix->count; i++) {
        if (matrix->cell[i].family != family) {
            family = matrix->cell[i].family;
            suite[count++] = (struct sb_junit_suite){family->name, &row[i], 0};
        }
        row[i] = junit_case(&matrix->cell[i], arena);
        suite[count - 1].count++;
    }
    return count;
}

bool sb_verify_write_junit(struct sb_verify *verify, struct sb_error *err)
{
    const struct sb_matrix *matrix = &verify->matrix;
    struct sb_junit_suite suite[SB_CASE_FAMILIES];
    struct sb_junit_case *row = sb_alloc(((size_t)matrix->count + 1) * sizeof *row);
    const struct sb_junit_property properties[] = {
        {"renderer", verify->driver.caps.renderer},
        {"version", verify->driver.caps.version},
    };
    const struct sb_junit junit = {
        .name = "shadebench verify",
        .suite = suite,
        .count = make_suites(matrix, row, suite, &verify->arena),
        .property = properties,
        .property_count = 2,
    };
    const bool good = sb_junit_write(
        &junit, sb_path_join(&verify->arena, verify->dir, "junit.xml"), err);
    free(row);
    return good;
}

// --- JSON ---------------------------------------------------------------------------------

static json_t *cells_json(struct sb_verify *verify)
{
    json_t *list = json_array();
    for (int i = 0; i < verify->matrix.count; i++) {
        struct sb_case_row row;
        json_t *object = json_object();
        sb_verify_row(verify, &verify->matrix.cell[i], &verify->arena, &row);
        for (int c = 0; c < sb_case_column_count; c++)
            json_object_set_new(object, sb_case_columns[c].name,
                                sb_report_cell_json(&row, &sb_case_columns[c]));
        if (isinf(row.measured)) // JSON has no infinity, and null is "not measured"
            json_object_set_new(object, "measured", json_string("inf"));
        json_object_set_new(object, "holds",
                            json_boolean(sb_matrix_holds(&verify->matrix.cell[i])));
        json_array_append_new(list, object);
    }
    return list;
}

static json_t *number_json(double value)
{
    return isnan(value)   ? json_null()
           : isinf(value) ? json_string("inf")
                          : json_real(value);
}

static json_t *found_json(const struct sb_verify *verify)
{
    json_t *list = json_array();
    for (int s = 0; s < verify->searched_count; s++)
        for (int i = 0; i < verify->searched[s].findings.count; i++) {
            const struct sb_cli_searched *searched = &verify->searched[s];
            const struct sb_found *found = &searched->findings.row[i];
            struct sb_text text = {0};
            sb_found_text(found, &searched->params, i + 1, &text);
            json_array_append_new(
                list, json_pack("{sssssososs}", "given", found->given, "precision",
                                sb_case_precisions[searched->params.precision].name,
                                "measured", number_json(found->measured), "spread",
                                number_json(found->spread), "c", sb_text_get(&text)));
            sb_text_free(&text);
        }
    return list;
}

static json_t *prices_json(const struct sb_verify *verify)
{
    json_t *list = json_array();
    for (int i = 0; verify->priced && i < verify->prices.count; i++) {
        const struct sb_price *price = &verify->prices.row[i];
        json_t *cases = json_array();
        for (int k = 0; k < price->case_count; k++)
            json_array_append_new(cases, json_string(price->it[k]->id));
        json_array_append_new(
            list,
            json_pack("{sssosssosososi}", "guards", sb_text_get(&price->guards), "cases",
                      cases, "note", sb_text_get(&price->note), "cost_pct",
                      number_json(percent(price->ratio.point)), "cost_lo_pct",
                      number_json(percent(price->ratio.lo)), "cost_hi_pct",
                      number_json(percent(price->ratio.hi)), "pairs", price->ratio.n));
    }
    return list;
}

json_t *sb_verify_json(struct sb_verify *verify)
{
    int64_t asked = 0;
    for (int i = 0; i < verify->searched_count; i++)
        asked += verify->searched[i].findings.asked;
    return json_pack("{sssssssssososIsosb}", "dir", verify->dir, "renderer",
                     verify->driver.caps.renderer, "version", verify->driver.caps.version,
                     "timer", verify->prices.timer, "cells", cells_json(verify), "found",
                     found_json(verify), "searched_points", (json_int_t)asked, "prices",
                     prices_json(verify), "interrupted", sb_interrupted());
}
