// The matrix: cases by precision, stage and form.
#pragma once

#include "cases/case.h"

struct sb_matrix_cell {
    const struct sb_case *it;
    const struct sb_case_family *family;
    enum sb_case_form form;
    enum sb_case_precision precision;
    bool vertex;
    struct sb_outcome outcome;
    double cost, cost_lo,
        cost_hi; // time over that of the naive form and its 95 % interval; NAN: not measured
    bool broken;     // its breaking point was asked for
    double holds_to; // as in struct sb_breaking; NAN where it was not
    bool to_the_end;
};
struct sb_matrix {
    struct sb_matrix_cell *cell;
    int count, capacity;
};

struct sb_crew; // crew.h

struct sb_matrix_params {
    const struct sb_case_env *env;
    const struct sb_case *const *it; // NULL: all
    int count;
    unsigned forms; // bit of enum sb_case_form; 0: both
    unsigned
        precisions; // bits of enum sb_case_precision; 0: those that say most here: highp, and
                    // half precision as the driver has it or, where it has none, emulated
    bool (*stop)(void *user); // asked before each cell; NULL: never
    struct sb_crew *crew;     // who asks cells, too; NULL: nobody
    // After each cell, whoever has asked it: in any order where there is a crew.
    void (*done)(void *user, const struct sb_matrix_cell *cell, int count, int total);
    void *user;
};
// Asks every cell, in the order of the catalogue, which is that of *matrix too. It must be zeroed; free it
// afterwards. Where it was stopped, only what was asked stands in it.
void sb_matrix_ask(const struct sb_matrix_params *params, struct sb_matrix *matrix);
// Asks the breaking point of every cell whose case scales; one that cannot be asked stays as it is.
void sb_matrix_break(const struct sb_matrix_params *params, struct sb_matrix *matrix);
void sb_matrix_free(struct sb_matrix *matrix);

// Asks cells for another process's sb_matrix_ask, whose params are the same but for its own driver,
// until none is left.
void sb_matrix_help(const struct sb_matrix_params *params);

// Does the cell hold what it should? A robust form must pass, or be refused where the remedy is on
// the CPU; what naive forms do is only told.
bool sb_matrix_holds(const struct sb_matrix_cell *cell);
