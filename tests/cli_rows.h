// Rows of a results folder, changed by a test and written again.
#pragma once

#include "cli_fixture.h"

#include "results/rows.h"

#define RUN "run --context null -q --rounds 20 --first-look 20 "

static struct sb_rows rows;
static struct sb_axes axes;

static void read_rows(const char *name)
{
    char path[256];
    struct sb_error err = {0};
    sb_rows_free(&rows);
    axes = *sb_axes_builtin();
    snprintf(path, sizeof path, "%s/%s", test_dir, name);
    if (!sb_rows_read(path, &axes, &rows, &err))
        fail_msg("%s", err.text);
}

static void write_rows(const char *name)
{
    struct sb_text text = {0};
    sb_csv_header(&text, sb_summary_columns, sb_summary_column_count, &axes);
    for (int i = 0; i < rows.count; i++)
        sb_csv_row(&text, sb_summary_columns, sb_summary_column_count, &axes,
                   &rows.row[i]);
    write_file(name, text.data);
    sb_text_free(&text);
}

static void set_time(struct sb_row *row, double ms)
{
    row->median_ms = ms;
    row->ci_lo_ms = 0.99 * ms;
    row->ci_hi_ms = 1.01 * ms;
    row->ci_kind = "ci95_within_run";
    row->status = "ok";
}
