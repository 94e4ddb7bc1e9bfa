// The figures of a hard case: what a driver told of its points against what is right.
#pragma once

#include "cases/case.h"
#include "cases/unit.h"

// A number for a job of the cases, that no plan's has.
uint32_t sb_case_next_job(void);

// A unit for points of a case.
bool sb_case_unit_open(struct sb_unit *unit, const struct sb_case_env *env,
                       const struct sb_variant *variant, struct sb_error *err);

// Of how many lights terms are asked: of none where no criterion is of a term.
int sb_case_lights_asked(const struct sb_case *it, const struct sb_points *points);

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

// The same of one point, for figures that a single point has.
double sb_judge_point(const struct sb_judged *judged,
                      const struct sb_criterion *criterion, int point);

// Passes each criterion that covers the precision? Sets verdict, figure, of, measured, bound and point:
// of the first that fails, else of the one that comes nearest to its bound.
void sb_judge_all(const struct sb_judged *judged, struct sb_outcome *outcome);

// The bound in a precision; NAN where the criterion does not cover it.
double sb_criterion_bound(const struct sb_criterion *criterion,
                          enum sb_case_precision precision);
