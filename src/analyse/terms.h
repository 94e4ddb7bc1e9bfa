// The price of each term: what its precision costs in time and buys in error. A term is an axis
// that a shorthand sets; its shorthand's default puts every term high. The rows of one group
// differ in their terms only; each term is changed alone, down from all high and up from all low.
#pragma once

#include "base/mem.h"
#include "results/row.h"

// One row against the row that it was changed from. NAN where either was not measured.
struct sb_term_change {
    const struct sb_row *row; // NULL: there is none
    // Frame time over that of the row it was changed from, and the ends of its interval. paired:
    // from pairs of one round, as summary.csv has it where that row is the first of its scene;
    // else the quotient of two medians, with every quotient of their intervals between the ends.
    double time, time_lo, time_hi;
    bool paired;
    double max_err, flip_mean; // of the row itself
};

enum sb_term_verdict {
    SB_TERM_UNKNOWN, // not lowered alone, no error, or no interval that decides
    SB_TERM_FREE,
    SB_TERM_COSTS,
    SB_TERM_BREAKS,
    SB_TERM_VERDICT_COUNT
};
extern const char *const sb_term_verdict_words[SB_TERM_VERDICT_COUNT];

// The bounds of the verdict; sb_term_rules says them in words.
#define SB_TERM_SAME_ERROR  1.1         // times the error of all high
#define SB_TERM_SMALL_ERROR (0.5 / 255) // rounds to the same 8-bit step, or the next
#define SB_TERM_LARGE_ERROR (4.0 / 255)
#define SB_TERM_SAME_TIME                                                                \
    1.05 // times that of all high; an interval up to it says "no slower"
extern const char sb_term_rules[];

struct sb_term_price {
    int axis;
    struct sb_term_change lowered, raised;
    enum sb_term_verdict verdict; // about lowering it
};

struct sb_term_prices {               // of one group
    const struct sb_row *high, *low;  // all terms high, all low; NULL: no such row
    const char *high_word, *low_word; // of the shorthand: highp, mediump
    struct sb_term_price *price;      // one a term, in the order of the axis table
    int count;
};

struct sb_terms {
    struct sb_term_prices *group; // in the order of their first row
    int count;
    struct sb_arena arena; // of the prices; rows and words are borrowed
};

// The terms of the axis table: axis[0 .. n - 1] and n, at most SB_AXIS_MAX.
int sb_terms_find(const struct sb_axes *axes, int *axis);

// Rows are borrowed. A group needs a row of all high or all low, and one changed from it;
// without any, terms->count is 0. *terms must be zeroed.
void sb_terms_price(const struct sb_axes *axes, const struct sb_row *row, int count,
                    struct sb_terms *terms);
void sb_terms_free(struct sb_terms *terms);
