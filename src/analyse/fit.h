// A cost model of a run, from its rows: what a frame costs without lights, what each further
// light of a type costs, and how well that says what mixes of types cost, which were measured in
// the same run but not fitted.
//
//     ms(n1, n2, ...) = lit + sum over the types that there are of (ms_i(n_i) - lit)
//
// ms_i is what the frame takes with lights of type i alone, and `lit` the part of it that is paid
// once however many types there are: the frame without lights, and what the first light of any
// type brings (normals, the view vector). Nothing is said outside the counts that were measured.
#pragma once

#include "base/mem.h"
#include "results/row.h"
#include "stats/theil_sen.h"

struct sb_fit_params {
    const struct sb_axes *axes;
    const struct sb_row *row; // borrowed
    int count;
    const int *count_axis; // axes that say how many there are, each of another type
    int count_axes;
};

// A straight line, and the bend behind a flat part, are believed while every row lies within
// this share of it, or has it in its interval. What four types miss adds up, and is to stay
// below SB_FIT_WRONG.
#define SB_FIT_STRAIGHT 0.025
// Mixes that are off by more than this share are said to be wrong.
#define SB_FIT_WRONG 0.1
enum { SB_FIT_COUNTS_MIN = 3 }; // of one type, to fit it

enum sb_fit_shape {
    SB_FIT_LINE,
    SB_FIT_BEND,   // flat up to a count, then a line
    SB_FIT_UNEVEN, // neither holds: straight from each measured count to the next
    SB_FIT_SHAPE_COUNT
};
extern const char *const sb_fit_shape_words[SB_FIT_SHAPE_COUNT];

struct sb_fit_curve { // level + slope max(n - at, 0), ms
    double level, slope, at;
};

struct sb_fit_count {
    double n; // lights, above 0
    const struct sb_row *row;
};

// The lights of one type, all others at the lowest count of the group.
struct sb_fit_type {
    int axis;
    struct sb_fit_count *count; // ascending in n
    int counts;
    struct sb_line line; // over all counts, whatever the shape
    enum sb_fit_shape shape;
    struct sb_interval
        price; // ms a further light: the line's slope; of a bend that behind it
    // Of a line or a bend: it, and those that bound it: with the ends of the slope's interval
    // (scatter about the line), and through the ends of the rows' intervals.
    struct sb_fit_curve curve, bound[4];
    int bounds;
    double off,
        off_n; // the row that lies farthest from the line: row / line - 1, and its count
    // Uneven: the gap between two counts in which a light costs most, and by how much more than
    // at the median gap's price the time rises there. 0: no gap stands out by a quarter and by
    // more than the rows' intervals. Where in the gap is not known, so intervals hold a jump
    // behind either count.
    double jump_from, jump_to, jump_ms;
    // What the first light costs beyond the next one, from the two lowest counts; NAN where
    // the lowest is not 1, or the frame without lights is not in the run.
    double first_ms;
};

// A row with more than one type above its lowest count.
struct sb_fit_mix {
    const struct sb_row *row;
    // ms; NAN where it holds a count outside those measured for its type, or of a type that was
    // not fitted. The interval takes all parts at the same end at once.
    struct sb_interval predicted;
    double off;   // measured / predicted - 1
    bool outside; // the two intervals have no time in common
    bool in_jump; // a count lies inside the gap in which its type jumps
};

// Rows that differ in counts only. An axis that is moot for a row (the cone without spots) goes
// with any value, so a row may be in several groups.
struct sb_fit_group {
    const struct sb_row **row;
    int rows;
    double *lowest;            // of each count axis
    const struct sb_row *base; // all counts at their lowest; NULL: not in the run
    bool unlit;                // the lowest are all 0
    double lit_ms;             // paid once; see the top of this file
    double
        first_ms; // of it, what the first light brings: median over the types, not below 0
    struct sb_fit_type *type;
    int types;
    struct sb_fit_mix *mix;
    int mixes, predicted; // of the mixes, those that could be
    double interaction;   // median of `off`; NAN: no mix
    double worst;         // the `off` that is largest either way
};

struct sb_fit {
    struct sb_fit_group *group; // with at least one type; in the order of their first row
    int count;
    int without_time; // rows left out for their status
    int left_over;    // rows with a time that are in no group
    struct sb_arena arena;
};

// *fit must be zeroed. Groups none of whose types has SB_FIT_COUNTS_MIN counts are left out.
void sb_fit_make(const struct sb_fit_params *params, struct sb_fit *fit);
void sb_fit_free(struct sb_fit *fit);

// The frame with n lights of the type alone: point and interval, ms. NAN outside its counts.
struct sb_interval sb_fit_at(const struct sb_fit_type *type, double n);

// How many lights of the type fit in `ms`: all counts up to that take no longer.
struct sb_fit_lights {
    int n;
    bool floor; // the frame without them takes longer; n is 0
    bool above; // all that were measured fit: more than n, and how many is not known
    bool below; // the fewest that were measured do not fit: less than n, and n > 1
};
// side: 0 by the estimate, -1 by the upper end of its interval (fewer lights), 1 by the lower.
struct sb_fit_lights sb_fit_lights_in(const struct sb_fit_group *group,
                                      const struct sb_fit_type *type, double ms,
                                      int side);

// --- for fit.c only -------------------------------------------------------------------------
// Chooses the shape of the counts and fills what follows from it.
void sb_fit_shape_type(struct sb_fit_type *type);
