// The figures of a hard case: what a driver told of its points against what is right.
#pragma once

#include "cases/case.h"
#include "cases/unit.h"

struct sb_judged {
    const struct sb_case *it;
    const struct sb_case_setting *setting;
    const struct sb_points *points;
    const struct sb_unit_told *told;
    const struct sb_points_truth *truth;
};

// A figure over all points, and the point that it is of (-1: none). A point of which a branch lies
// within rounding of going the other way is left out of errors, not of counts.
double sb_judge(const struct sb_judged *judged, const struct sb_criterion *criterion,
                int *point);

// Passes each criterion that covers the precision? Sets verdict, figure, of, measured, bound and point:
// of the first that fails, else of the one that comes nearest to its bound.
void sb_judge_all(const struct sb_judged *judged, struct sb_outcome *outcome);

// The bound in a precision; NAN where the criterion does not cover it.
double sb_criterion_bound(const struct sb_criterion *criterion,
                          enum sb_case_precision precision);
