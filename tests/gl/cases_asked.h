// Hard cases of a family, asked of the driver in every precision that it has. Each program asks
// one family, and has points of its own besides.
#pragma once

#include "case_world.h"

static inline void asked_tell(const struct sb_case *it, enum sb_case_form form,
                              enum sb_case_precision precision, bool vertex,
                              const struct sb_outcome *outcome)
{
    printf("%-18s %-8s %-8s %-6s %-8s %.4g of %g %s\n", it->id,
           sb_case_precisions[precision].name, vertex ? "vertex" : "fragment",
           sb_case_form_names[form], sb_verdict_names[outcome->verdict],
           outcome->measured, outcome->bound, sb_text_get(&outcome->note));
}

static inline enum sb_verdict asked(const struct sb_case *it, enum sb_case_form form,
                                    enum sb_case_precision precision, bool vertex)
{
    struct sb_outcome outcome;
    const struct sb_case_env env = case_env(NULL);
    sb_case_ask(&env, it, form, precision, vertex, &outcome);
    asked_tell(it, form, precision, vertex, &outcome);
    const enum sb_verdict verdict = outcome.verdict;
    sb_text_free(&outcome.note);
    return verdict;
}

static inline bool asked_holds(const struct sb_case *it, enum sb_verdict verdict)
{
    return verdict == SB_VERDICT_PASS || (verdict == SB_VERDICT_REFUSED && it->on_cpu);
}

// A case as the fragment stage has it, in one precision: the robust form has to hold.
static inline void asked_robust(const struct sb_case *it,
                                enum sb_case_precision precision)
{
    if (it->precisions >> precision & 1 &&
        !asked_holds(it, asked(it, SB_CASE_ROBUST, precision, false)))
        fail_msg("%s: the robust form does not hold", it->id);
}

// The naive form has to fail.
static inline void asked_naive(const char *id, enum sb_case_precision precision)
{
    struct sb_error err = {0};
    const struct sb_case *it = sb_case_expect(id, NULL, &err);
    if (!it)
        fail_msg("%s", err.text);
    if (asked(it, SB_CASE_NAIVE, precision, false) != SB_VERDICT_FAIL)
        fail_msg("%s: the naive form holds", it->id);
}

// The criteria of a case about other points, at each x of a list that ends with 0.
typedef void asked_points(struct sb_points *points, const struct sb_case_setting *setting,
                          double x);
static inline void asked_others(const char *id, enum sb_case_precision precision,
                                const char *more, asked_points *add, const double *x)
{
    struct sb_variant variant;
    struct sb_points points;
    struct sb_outcome outcome = {0};
    struct sb_error err = {0};
    const struct sb_case_env env = case_env(NULL);
    const struct sb_case *it = sb_case_expect(id, NULL, &err);
    if (!it || !sb_case_variant(&env, it, SB_CASE_ROBUST, precision, false, more,
                                &variant, &err))
        fail_msg("%s", err.text);
    const struct sb_case_setting setting = {SB_CASE_ROBUST, precision, false, &variant};
    sb_points_init(&points, &variant);
    for (const double *at = x; *at > 0; at++)
        add(&points, &setting, *at);
    if (!sb_points_validate(&points, &err) ||
        !sb_case_ask_points(&env, it, &setting, &points, &outcome, &err))
        fail_msg("%s: %s", it->id, err.text);
    printf("%d other points: ", points.count);
    asked_tell(it, SB_CASE_ROBUST, precision, false, &outcome);
    if (outcome.verdict != SB_VERDICT_PASS)
        fail_msg("%s: other points do not hold", it->id);
    sb_text_free(&outcome.note);
    sb_points_free(&points);
}
