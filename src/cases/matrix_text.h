// The matrix as text for a terminal.
#pragma once

#include "cases/verify.h"

// "44 > 0 values", "0.3 of 0.5 /255"; nothing where nothing was measured.
void sb_outcome_text(const struct sb_outcome *outcome, struct sb_text *text);

// What the figure is of: "colour", "attenuation". NULL: of all that a point tells, or of nothing.
const char *sb_outcome_of(const struct sb_outcome *outcome);

// "pass", "fail: absolute of colour: 12 > 2 /255 at point 3", and the note.
void sb_outcome_line(const struct sb_outcome *outcome, struct sb_text *text);

// "robust mediump fragment"
void sb_matrix_cell_name(const struct sb_matrix_cell *cell, struct sb_text *text);

// One row a case, under its family; columns are precisions and forms, the worse of the two stages
// in each cell. Where that is wider than `width` columns, table follows table.
void sb_matrix_table(const struct sb_matrix *matrix, int width, struct sb_text *text);

// What cells have to say, then why cells are n/a: equal words once.
void sb_matrix_notes(const struct sb_matrix *matrix, int width, struct sb_text *text);

// The cells that should hold and do not, one a line; nothing where there are none.
void sb_matrix_failures(const struct sb_matrix *matrix, struct sb_text *text);

// How many cases, how many robust cells hold, how many naive forms fail as they should; and each
// naive form that passes wherever it was asked, with the reason that the case gives.
void sb_matrix_summary(const struct sb_matrix *matrix, struct sb_text *text);

// One line a case whose breaking points were asked: "dist-overflow16: distance: highp to 30000
// (all); mediump naive to 255, robust to 29000 units".
void sb_matrix_breaking(const struct sb_matrix *matrix, struct sb_text *text);
