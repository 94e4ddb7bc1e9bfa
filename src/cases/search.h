// Search for hard cases that nobody has written down: random points, the worst of them bred, and
// what is found shrunk to the fewest inputs that still fail.
#pragma once

#include "cases/case.h"

struct sb_search_params {
    const struct sb_case_env *env;
    double seconds;
    uint64_t seed;
    enum sb_case_form form; // naive forms have much to be found
    enum sb_case_precision precision;
    bool (*stop)(void *user); // asked now and then; NULL: never
    void *user;
};
struct sb_found {
    const char *given;       // of the variant
    struct sb_points points; // one, shrunk
    double measured;         // steps of 1/255, over max(|right|, 1); INFINITY: not finite
    double spread; // by which an input that is off by one unit in the last place moves it
};
struct sb_findings {
    struct sb_found *row; // the worst of each variant that has any
    int count, capacity;
    int64_t asked; // points
};
// An error counts where it is above the bound (half a step in highp, four in half precision) and
// above four times what the last places of the inputs (of a vector: that of its largest component) make
// of the reference: beyond that the formula is bad, not the input hard. *findings must be zeroed; free
// it also after failure.
bool sb_search(const struct sb_search_params *params, struct sb_findings *findings,
               struct sb_error *err);
void sb_findings_free(struct sb_findings *findings);

// A finding as C, ready to stand in a family's file: the function that makes its point, and the row.
void sb_found_text(const struct sb_found *found, const struct sb_search_params *params,
                   int number, struct sb_text *text);
