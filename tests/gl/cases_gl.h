// What the tests of the hard cases' families share: a probed driver, and cells of the matrix.
#pragma once

#include <math.h>
#include <string.h>

#include "cases/verify.h"
#include "gl_test.h"
#include "local/local.h"
#include "math/random.h"
#include "measure/driver.h"
#include "test.h"

static struct sb_driver driver;
static struct sb_case_env env;

static inline const struct sb_case *case_of(const char *id)
{
    struct sb_error err = {0};
    const struct sb_case *it = sb_case_expect(id, NULL, &err);
    if (!it)
        fail_msg("%s", err.text);
    return it;
}

// The cells of one case and form, each to be looked at.
struct cells {
    const struct sb_case *it;
    enum sb_case_form form;
    unsigned precisions;
    void (*look)(const struct cells *cells, enum sb_case_precision precision,
                 bool vertex);
    void (*scatter)(struct sb_points *points, const void *user);
    const void *user;
    const char *more; // axis assignments
};

// What takes long is left out: half precision emulated where the driver has it, unless nothing
// else is asked for, and naive forms in a second stage.
static inline void each_cell(const struct cells *cells)
{
    unsigned precisions = cells->it->precisions & cells->precisions;
    if (precisions & 1u << SB_CASE_HALF)
        precisions &=
            ~(1u << (sb_case_unavailable(&env, SB_CASE_HALF, false) ? SB_CASE_HALF
                                                                    : SB_CASE_EMULATED));
    for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++)
        for (int vertex = 0; vertex < 2; vertex++) {
            const bool second = vertex && cells->it->stages & SB_IN_FRAGMENT;
            if (precisions >> precision & 1 && cells->it->stages >> vertex & 1 &&
                !(cells->form == SB_CASE_NAIVE && second))
                cells->look(cells, (enum sb_case_precision)precision, vertex);
        }
}

static inline void told_wrong(const struct cells *cells, enum sb_case_precision precision,
                              bool vertex, const struct sb_outcome *outcome)
{
    fail_msg("%s, %s, %s, %s: %s, %g of %g %s at point %d: %s", cells->it->id,
             sb_case_form_names[cells->form], sb_case_precisions[precision].name,
             vertex ? "vertex" : "fragment", sb_verdict_names[outcome->verdict],
             outcome->measured, outcome->bound,
             outcome->figure ? sb_figure_rows[outcome->figure].name : "", outcome->point,
             sb_text_get(&outcome->note));
}

static inline void ask_cell(const struct cells *cells, enum sb_case_precision precision,
                            bool vertex)
{
    struct sb_outcome outcome;
    sb_case_ask(&env, cells->it, cells->form, precision, vertex, &outcome);
    const bool passes = outcome.verdict == SB_VERDICT_PASS ||
                        (outcome.verdict == SB_VERDICT_REFUSED && cells->it->on_cpu);
    if (cells->form == SB_CASE_ROBUST ? !passes : outcome.verdict != SB_VERDICT_FAIL)
        told_wrong(cells, precision, vertex, &outcome);
    sb_text_free(&outcome.note);
}

// Every case of the family, in its robust form.
static inline void check_robust(const struct sb_case_family *family)
{
    for (int i = 0; i < family->count; i++)
        each_cell(&(struct cells){.it = &family->row[i],
                                  .form = SB_CASE_ROBUST,
                                  .precisions = ~0u,
                                  .look = ask_cell});
}

// The naive form fails in all of these precisions.
static inline void check_naive(const char *id, unsigned precisions)
{
    each_cell(&(struct cells){.it = case_of(id),
                              .form = SB_CASE_NAIVE,
                              .precisions = precisions,
                              .look = ask_cell});
}

static inline void ask_scattered(const struct cells *cells,
                                 enum sb_case_precision precision, bool vertex)
{
    struct sb_variant variant;
    struct sb_points points;
    struct sb_error err = {0};
    struct sb_outcome outcome = {.point = -1};
    const struct sb_case_setting setting = {SB_CASE_ROBUST, precision, vertex, &variant};
    if (!sb_case_variant(&env, cells->it, SB_CASE_ROBUST, precision, vertex, cells->more,
                         &variant, &err))
        fail_msg("%s: %s", cells->it->id, err.text);
    sb_points_init(&points, &variant);
    cells->scatter(&points, cells->user);
    if (!sb_points_validate(&points, &err) ||
        !sb_case_ask_points(&env, cells->it, &setting, &points, &outcome, &err))
        fail_msg("%s: %s", cells->it->id, err.text);
    if (outcome.verdict != SB_VERDICT_PASS)
        told_wrong(cells, precision, vertex, &outcome);
    sb_text_free(&outcome.note);
    sb_points_free(&points);
}

// The robust form holds at other points, too.
static inline void check_points_of(const struct sb_case *it,
                                   void (*scatter)(struct sb_points *, const void *),
                                   const void *user)
{
    each_cell(&(struct cells){.it = it,
                              .form = SB_CASE_ROBUST,
                              .precisions = ~0u,
                              .look = ask_scattered,
                              .scatter = scatter,
                              .user = user});
}

static inline void check_points(const char *id,
                                void (*scatter)(struct sb_points *, const void *),
                                const void *user)
{
    check_points_of(case_of(id), scatter, user);
}

// The same with emulated precision that is otherwise at fault.
static inline void check_points_with(const char *id, const char *more,
                                     void (*scatter)(struct sb_points *, const void *),
                                     const void *user)
{
    each_cell(&(struct cells){.it = case_of(id),
                              .form = SB_CASE_ROBUST,
                              .precisions = 1u << SB_CASE_EMULATED,
                              .look = ask_scattered,
                              .scatter = scatter,
                              .user = user,
                              .more = more});
}

// The robust form has a message that holds `words`.
static inline void check_refused(const char *id, const char *words)
{
    struct sb_outcome outcome;
    sb_case_ask(&env, case_of(id), SB_CASE_ROBUST, SB_CASE_HIGHP, false, &outcome);
    if (!strstr(sb_text_get(&outcome.note), words))
        fail_msg("%s: %s", id, sb_text_get(&outcome.note));
    sb_text_free(&outcome.note);
}

static inline int run_case_tests(const struct CMUnitTest *tests, size_t count)
{
    struct sb_error err = {0};
    const struct sb_driver_params params = {
        .runner = &sb_runner_local,
        .context = {.context = gl_test_context(), .gles = gl_test_gles(), .device = -1},
    };
    if (!sb_driver_connect(&params, &driver, &err) || !sb_driver_probe(&driver, &err))
        gl_test_unavailable(&err);
    env = (struct sb_case_env){sb_axes_builtin(), &driver, SB_SOURCE_DIR, NULL};
    const int code = _cmocka_run_group_tests("cases", tests, count, NULL, NULL);
    sb_driver_close(&driver);
    return code;
}
