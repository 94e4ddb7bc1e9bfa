// What verify prints of the hard cases.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/matrix_text.h"
#include "cli/table.h"
#include "cli/verify.h"
#include "measure/interrupt.h"

enum { WIDTH = 100 };

// A paragraph under its title; nothing where there is nothing to say.
static void print_part(const char *title, struct sb_text *text)
{
    if (text->length)
        printf("\n%s%s%s", title, *title ? "\n" : "", sb_text_get(text));
    sb_text_clear(text);
}

static void print_searched(const struct sb_verify *verify)
{
    for (int s = 0; s < verify->searched_count; s++) {
        const struct sb_cli_searched *searched = &verify->searched[s];
        const struct sb_findings *findings = &searched->findings;
        const char *precision = sb_case_precisions[searched->params.precision].name;
        const char *form = sb_case_form_names[searched->params.form];
        printf("\nsearch, %s %s, seed %.0f, %.3g s: ", form, precision, verify->seed,
               searched->params.seconds);
        if (findings->asked == 0) // too short a time is no good news
            printf("no point was asked in that time\n");
        else if (findings->count == 0)
            printf("nothing found in %lld points\n", (long long)findings->asked);
        else
            printf("%d found in %lld points\n", findings->count,
                   (long long)findings->asked);
        for (int i = 0; i < findings->count; i++) {
            struct sb_text text = {0};
            sb_found_text(&findings->row[i], &searched->params, i + 1, &text);
            printf("\n%s", sb_text_get(&text));
            sb_text_free(&text);
        }
    }
    if (verify->searched_count)
        printf("The same seed draws the same points in the same order; how many of them, "
               "the "
               "clock decides.\n");
}

static void add_price(const struct sb_price *price, struct sb_table *table)
{
    struct sb_text cases = {0};
    for (int i = 0; i < price->case_count; i++)
        sb_text_printf(&cases, "%s%s", i ? " " : "", price->it[i]->id);
    sb_table_cell(table, sb_text_get(&price->guards));
    sb_table_cell(table, price->vertex ? "vertex" : "fragment");
    sb_table_real(table, "%+.1f %%", 100 * (price->ratio.point - 1));
    if (isnan(price->ratio.lo))
        sb_table_cell(table, "");
    else
        sb_table_cellf(table, "%+.1f … %+.1f", 100 * (price->ratio.lo - 1),
                       100 * (price->ratio.hi - 1));
    sb_table_cellf(table, "%d", price->ratio.n);
    sb_table_cell(table, sb_text_get(&cases));
    sb_text_free(&cases);
}

static void print_prices(const struct sb_verify *verify)
{
    static const char *const titles[] = {"guards", "stage", "cost",
                                         "95 %",   "pairs", "cases"};
    const struct sb_prices *prices = &verify->prices;
    if (verify->priced) {
        struct sb_table *table = sb_table_new();
        printf(
            "\nwhat the guards cost here: frame time of the robust form over the naive "
            "one, highp, containers, 256x256, 8 lights\n"
            "timer: %s, within %.1f %% of the wall clock of long drained batches; "
            "driver: %s\n",
            prices->timer, 100 * prices->timer_error, verify->driver.caps.renderer);
        for (int i = 0; i < 6; i++)
            sb_table_column(table, titles[i], i >= 2 && i <= 4);
        for (int i = 0; i < prices->count; i++)
            add_price(&prices->row[i], table);
        sb_table_print(table);
        sb_table_free(&table);
        for (int i = 0; i < prices->count; i++)
            if (prices->row[i].note.length)
                printf("%s: %s\n", prices->row[i].it[0]->id, prices->row[i].note.data);
    }
    if (prices->unpriced.length)
        printf("\nno price:\n%s", prices->unpriced.data);
}

void sb_verify_print(struct sb_verify *verify)
{
    const struct sb_matrix *matrix = &verify->matrix;
    struct sb_text text = {0};
    printf("driver: %s, %s\n", verify->driver.caps.renderer, verify->driver.caps.version);
    sb_matrix_table(matrix, WIDTH, &text);
    print_part("", &text);
    sb_matrix_notes(matrix, WIDTH, &text);
    print_part("", &text);
    sb_matrix_failures(matrix, &text);
    print_part("these should hold, and do not:", &text);
    sb_matrix_breaking(matrix, &text);
    print_part("how far they hold:", &text);
    print_prices(verify);
    print_searched(verify);
    sb_matrix_summary(matrix, &text);
    print_part("", &text);
    sb_text_free(&text);
    printf("results: %s/cases.csv, junit.xml\n", verify->dir);
    if (sb_interrupted())
        printf("interrupted: what was asked before is in the files\n");
}
