// Asking the cases of a family: in robust form they must hold, in naive form they must fail.
#pragma once

#include "cases/case.h"
#include "gl_test.h"
#include "local/local.h"
#include "test.h"

static struct sb_driver driver;

static inline struct sb_case_env case_env(void)
{
    return (struct sb_case_env){
        .axes = sb_axes_builtin(), .driver = &driver, .data_dir = SB_SOURCE_DIR};
}

static inline void open_driver(void)
{
    struct sb_error err = {0};
    const struct sb_driver_params params = {
        .runner = &sb_runner_local,
        .context = {.context = gl_test_context(), .gles = gl_test_gles(), .device = -1},
    };
    if (!sb_driver_connect(&params, &driver, &err) || !sb_driver_probe(&driver, &err))
        gl_test_unavailable(&err);
}

// Asks a cell and checks its verdict; what cannot be asked here is passed over.
static inline void check_cell(const struct sb_case *it, enum sb_case_form form,
                              enum sb_case_precision precision, bool vertex,
                              enum sb_verdict wanted)
{
    const struct sb_case_env env = case_env();
    struct sb_outcome outcome;
    sb_case_ask(&env, it, form, precision, vertex, &outcome);
    printf("%-20s %-8s %s %-7s %.4g of %.4g %s\n", it->id,
           sb_case_precisions[precision].name, vertex ? "vertex  " : "fragment",
           sb_case_form_names[form], outcome.measured, outcome.bound,
           sb_text_get(&outcome.note));
    const bool unavailable =
        outcome.verdict == SB_VERDICT_NA && sb_case_unavailable(&env, precision, vertex);
    if (!unavailable && outcome.verdict != wanted)
        fail_msg("%s: %s, not %s", it->id, sb_verdict_names[outcome.verdict],
                 sb_verdict_names[wanted]);
    sb_text_free(&outcome.note);
}

static inline bool is_asked(const struct sb_case *it, int precision, int vertex)
{
    return (it->precisions >> precision & 1) && (it->stages >> vertex & 1);
}

static inline void check_robust(const struct sb_case_family *family)
{
    for (int i = 0; i < family->count; i++)
        for (int cell = 0; cell < 2 * SB_CASE_PRECISION_COUNT; cell++)
            if (is_asked(&family->row[i], cell / 2, cell % 2))
                check_cell(&family->row[i], SB_CASE_ROBUST,
                           (enum sb_case_precision)(cell / 2), cell % 2, SB_VERDICT_PASS);
}

static inline int run_family(const struct CMUnitTest *tests, size_t count)
{
    const int code = _cmocka_run_group_tests("tests", tests, count, NULL, NULL);
    sb_driver_close(&driver);
    return code;
}
