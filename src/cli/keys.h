// What tells the rows of a table apart: a column for each axis that varies or, where these are
// many, one column with the distinct part of the id.
#pragma once

#include "cli/table.h"
#include "results/row.h"

struct sb_keys {
    const struct sb_axes *axes;
    const struct sb_row *row;
    int count;
    bool scene, id, axis[SB_AXIS_MAX];
    bool preset; // in the id
};

// Rows are borrowed.
void sb_keys_make(struct sb_keys *keys, const struct sb_axes *axes,
                  const struct sb_row *row, int count);
void sb_keys_columns(const struct sb_keys *keys, struct sb_table *table);
void sb_keys_cells(const struct sb_keys *keys, struct sb_table *table,
                   const struct sb_row *row);

// The part of the row's id that sets it apart from the others; "base" where nothing does.
void sb_keys_id(const struct sb_keys *keys, const struct sb_row *row,
                struct sb_text *text);
