// Asking hard cases of a driver. What costs is compiling: in emulated half precision a cell takes
// three times as long as in another, so it is asked only where it alone shows what is on trial.
// `shadebench verify` asks every cell.
#pragma once

#include "cases/judge.h"
#include "cases/verify.h"
#include "gl_test.h"
#include "local/local.h"
#include "math/random.h"
#include "test.h"

static struct sb_driver case_driver;
static struct sb_case_env case_env;
static enum sb_case_precision case_half; // half precision as this context has it

static inline int run_case_tests(const struct CMUnitTest *tests, size_t count)
{
    struct sb_error err = {0};
    const struct sb_driver_params params = {
        .runner = &sb_runner_local,
        .context = {.context = gl_test_context(), .gles = gl_test_gles(), .device = -1},
    };
    if (!sb_driver_connect(&params, &case_driver, &err) ||
        !sb_driver_probe(&case_driver, &err))
        gl_test_unavailable(&err);
    case_env = (struct sb_case_env){sb_axes_builtin(), &case_driver, SB_SOURCE_DIR, NULL};
    case_half = sb_case_unavailable(&case_env, SB_CASE_HALF, false) ? SB_CASE_EMULATED
                                                                    : SB_CASE_HALF;
    const int code = _cmocka_run_group_tests("cases", tests, count, NULL, NULL);
    sb_driver_close(&case_driver);
    return code;
}
#define CASE_TESTS(tests) run_case_tests(tests, sizeof tests / sizeof *tests)

static inline const struct sb_case *case_of(const char *id)
{
    struct sb_error err = {0};
    const struct sb_case *it = sb_case_expect(id, NULL, &err);
    if (!it)
        fail_msg("%s", err.text);
    return it;
}

// --- one cell -----------------------------------------------------------------------------

struct cell {
    const struct sb_case *it;
    enum sb_case_form form;
    enum sb_case_precision precision;
    bool vertex;
};

// Robust forms hold, or turn their input away; naive ones fail.
static inline void check_outcome(const struct cell *cell,
                                 const struct sb_outcome *outcome)
{
    const struct sb_case *it = cell->it;
    const bool holds = outcome->verdict == SB_VERDICT_PASS ||
                       (outcome->verdict == SB_VERDICT_REFUSED && it->on_cpu);
    const bool right =
        cell->form == SB_CASE_ROBUST ? holds : outcome->verdict == SB_VERDICT_FAIL;
    char line[512];
    snprintf(line, sizeof line, "%s %s %s %s: %s, %s %.4g of %.4g at point %d %s", it->id,
             sb_case_form_names[cell->form], sb_case_precisions[cell->precision].name,
             cell->vertex ? "vertex" : "fragment", sb_verdict_names[outcome->verdict],
             outcome->figure ? sb_figure_rows[outcome->figure].name : "",
             outcome->measured, outcome->bound, outcome->point,
             sb_text_get(&outcome->note));
    if (!right)
        fail_msg("%s", line);
    printf("%s\n", line);
}

static inline void check_cell(const struct cell *cell)
{
    struct sb_outcome outcome;
    sb_case_ask(&case_env, cell->it, cell->form, cell->precision, cell->vertex, &outcome);
    check_outcome(cell, &outcome);
    sb_text_free(&outcome.note);
}

// --- the cells of a case ------------------------------------------------------------------

// Where half precision is the driver's own it stands for all that is wanted: the other API has
// none, and asks highp there. Emulated it is asked `emulated`, or where nothing else is wanted.
static inline unsigned precisions_of(const struct sb_case *it, unsigned wanted,
                                     bool emulated)
{
    const unsigned own = 1u << SB_CASE_HALF, emulation = 1u << SB_CASE_EMULATED;
    const unsigned all = it->precisions ? it->precisions : (unsigned)SB_IN_HIGHP;
    const unsigned asked = all & wanted;
    if (case_half == SB_CASE_HALF)
        return asked & own ? own : asked & ~emulation;
    return emulated || (asked & ~own) == emulation ? asked & ~own
                                                   : asked & ~own & ~emulation;
}

// Does the robust form say what half precision must not hold?
static inline bool is_about_half(const struct sb_case *it)
{
    return strstr(it->form[SB_CASE_ROBUST], "=highp") != NULL;
}

typedef void look_at(const struct cell *cell, const void *user);

static inline void each_precision(const struct sb_case *it, enum sb_case_form form,
                                  unsigned precisions, look_at *look, const void *user)
{
    for (int p = 0; p < SB_CASE_PRECISION_COUNT; p++)
        if (precisions >> p & 1)
            look(&(struct cell){it, form, (enum sb_case_precision)p,
                                it->stages == SB_IN_VERTEX},
                 user);
}

static inline void look_at_own_points(const struct cell *cell, const void *user)
{
    (void)user;
    check_cell(cell);
}

// Every case of the family in its robust form, per fragment where it has the choice.
static inline void check_robust(const struct sb_case_family *family)
{
    assert_true(family->count > 0);
    for (int i = 0; i < family->count; i++) {
        const struct sb_case *it = &family->row[i];
        const unsigned precisions = precisions_of(it, ~0u, is_about_half(it));
        assert_true(precisions != 0);
        each_precision(it, SB_CASE_ROBUST, precisions, look_at_own_points, NULL);
    }
}

// The robust form lit per vertex.
static inline void check_vertex(const char *id)
{
    struct sb_case it = *case_of(id);
    assert_true(it.stages & SB_IN_VERTEX);
    it.stages = SB_IN_VERTEX;
    each_precision(&it, SB_CASE_ROBUST, precisions_of(&it, ~0u, false),
                   look_at_own_points, NULL);
}

// The naive form fails in these precisions.
static inline void check_naive(const char *id, unsigned precisions)
{
    const struct sb_case *it = case_of(id);
    const unsigned asked = precisions_of(it, precisions, false);
    assert_true(asked != 0);
    each_precision(it, SB_CASE_NAIVE, asked, look_at_own_points, NULL);
}

// The robust form has a message that holds `words`.
static inline void check_refused(const char *id, const char *words)
{
    struct sb_outcome outcome;
    sb_case_ask(&case_env, case_of(id), SB_CASE_ROBUST, SB_CASE_HIGHP, false, &outcome);
    check_contains(sb_text_get(&outcome.note), words);
    sb_text_free(&outcome.note);
}

// --- inputs that are not in the catalogue -------------------------------------------------

struct inputs {
    void (*add)(struct sb_points *points, const struct sb_case_setting *setting,
                const void *user);
    const void *user;
    const char *more; // axis assignments
    bool any;         // also what no scene may have
};

static inline void look_at_inputs(const struct cell *cell, const void *user)
{
    const struct inputs *inputs = user;
    struct sb_variant variant;
    struct sb_points points;
    struct sb_error err = {0};
    struct sb_outcome outcome = {.point = -1};
    const struct sb_case_setting setting = {cell->form, cell->precision, cell->vertex,
                                            &variant};
    if (!sb_case_variant(&case_env, cell->it, cell->form, cell->precision, cell->vertex,
                         inputs->more, &variant, &err))
        fail_msg("%s: %s", cell->it->id, err.text);
    sb_points_init(&points, &variant);
    inputs->add(&points, &setting, inputs->user);
    assert_true(points.count > 0);
    if (!(inputs->any || sb_points_validate(&points, &err)) ||
        !sb_case_ask_points(&case_env, cell->it, &setting, &points, &outcome, &err))
        fail_msg("%s: %s", cell->it->id, err.text);
    printf("%d other points: ", points.count);
    check_outcome(cell, &outcome);
    sb_text_free(&outcome.note);
    sb_points_free(&points);
}

// The case's criteria hold of the robust form there, too.
static inline void check_inputs(const struct sb_case *it, unsigned precisions,
                                const struct inputs *inputs)
{
    const unsigned asked = precisions_of(it, precisions, is_about_half(it));
    assert_true(asked != 0);
    each_precision(it, SB_CASE_ROBUST, asked, look_at_inputs, inputs);
}

static inline void check_inputs_valid(const struct sb_case *it)
{
    struct sb_variant variant;
    struct sb_points points;
    struct sb_error err = {0};
    const struct sb_case_setting setting = {SB_CASE_ROBUST, SB_CASE_HIGHP, false,
                                            &variant};
    if (!sb_case_variant(&case_env, it, SB_CASE_ROBUST, SB_CASE_HIGHP, false, NULL,
                         &variant, &err))
        fail_msg("%s: %s", it->id, err.text);
    sb_points_init(&points, &variant);
    it->points(&points, &setting);
    for (double x = it->scale.from; it->scale.name && x <= it->scale.to; x *= 2)
        it->scale.points(&points, &setting, x);
    assert_true(points.count > 0);
    if (!sb_points_validate(&points, &err))
        fail_msg("%s: %s", it->id, err.text);
    sb_points_free(&points);
}

// What is asked could be a scene's.
static inline void check_family_valid(const struct sb_case_family *family)
{
    for (int i = 0; i < family->count; i++)
        if (family->row[i].points)
            check_inputs_valid(&family->row[i]);
}
