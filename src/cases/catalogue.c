#include "cases/case.h"

#include <string.h>

#include "base/words.h"

const char *const sb_case_form_names[SB_CASE_FORM_COUNT] = {"naive", "robust"};
const char *const sb_verdict_names[SB_VERDICT_COUNT] = {"pass", "fail", "refused", "na"};

const struct sb_case_precision_row sb_case_precisions[SB_CASE_PRECISION_COUNT] = {
    [SB_CASE_HIGHP] = {"highp", "precision=highp", false},
    [SB_CASE_HALF] = {"mediump", "precision=mediump", true},
    [SB_CASE_EMULATED] = {"fp16", "precision=mediump emulate=fp16", true},
    [SB_CASE_FIXED] = {"fixed10", "precision=lowp emulate=fixed10", true},
};

// clang-format off
const struct sb_figure_row sb_figure_rows[SB_FIGURE_COUNT] = {
    [SB_FIGURE_FINITE]   = {"finite",   "values", "NaN and infinite values among raw terms and colours, and negative light"},
    [SB_FIGURE_ABSOLUTE] = {"absolute", "/255",   "largest error"},
    [SB_FIGURE_RELATIVE] = {"relative", "",       "largest relative error"},
    [SB_FIGURE_ANGLE]    = {"angle",    "deg",    "largest angle to the right vector"},
    [SB_FIGURE_RISES]    = {"rises",    "points", "points at which it rises instead of falls"},
    [SB_FIGURE_LEAKS]    = {"leaks",    "/255",   "largest value where 0 is right"},
    [SB_FIGURE_FLIPS]    = {"flips",    "%",      "points of which a branch went another way"},
    [SB_FIGURE_OWN]      = {"own",      "",       "as the case says"},
};
// clang-format on

const struct sb_case_family *const sb_case_families[SB_CASE_FAMILIES] = {
    &sb_cases_distance, &sb_cases_vectors, &sb_cases_specular,     &sb_cases_cones,
    &sb_cases_area,     &sb_cases_shadows, &sb_cases_accumulation, &sb_cases_relations,
};

int sb_case_total(void)
{
    int total = 0;
    for (int f = 0; f < SB_CASE_FAMILIES; f++)
        total += sb_case_families[f]->count;
    return total;
}

enum { CASES_MAX = 128 };

const struct sb_case *sb_case_expect(const char *id, const struct sb_case_family **family,
                                     struct sb_error *err)
{
    const char *valid[CASES_MAX];
    int count = 0;
    for (int f = 0; f < SB_CASE_FAMILIES; f++)
        for (int i = 0; i < sb_case_families[f]->count; i++) {
            const struct sb_case *it = &sb_case_families[f]->row[i];
            if (strcmp(it->id, id) == 0) {
                if (family)
                    *family = sb_case_families[f];
                return it;
            }
            valid[count++] = it->id;
        }
    sb_fail_unknown(err, "", "case", id, valid, count);
    return NULL;
}
