// What a demand costs in a program, from the rows of a run: as measured, or by a line through what
// was measured.
#pragma once

#include "analyse/plan.h"
#include "results/row.h"

struct sb_plan_costs_params {
    const struct sb_axes *axes;
    const struct sb_row *row; // borrowed
    int count;
    int count_axis[SB_PLAN_TYPES]; // how many lights of each type
    bool padded[SB_PLAN_TYPES]; // a padded loop has room for more of them than there are
    int loop_axis, capacity_axis;
    int loop_value[SB_PLAN_KINDS]; // of the loop axis, of each kind
};

// ms = floor + sum over the types of price * lights + idle * (room - lights); none below 0.
struct sb_plan_line {
    double floor, price[SB_PLAN_TYPES], idle;
    double worst; // largest |row / line - 1| of the rows it is through
    int rows;     // 0: there is no line
    int least[SB_PLAN_TYPES],
        most[SB_PLAN_TYPES]; // that were measured, with room for them
};

struct sb_plan_costs; // opaque

// Rows that differ in counts, loop and capacity only: of several such groups the one with the most
// rows. NULL, with SB_BAD_INPUT, where no kind of loop has a line.
struct sb_plan_costs *sb_plan_costs_new(const struct sb_plan_costs_params *params,
                                        struct sb_error *err);
void sb_plan_costs_free(struct sb_plan_costs **costs);

const struct sb_plan_line *sb_plan_costs_line(const struct sb_plan_costs *costs,
                                              enum sb_plan_kind kind);
const struct sb_row *sb_plan_costs_first(const struct sb_plan_costs *costs);

// ms; INFINITY outside the counts that were measured: of a type that all rows have as many of, one.
// *measured (may be NULL): it is a row's own time.
double sb_plan_cost(const struct sb_plan_costs *costs,
                    const struct sb_plan_program *program, const struct sb_demand *demand,
                    bool *measured);
