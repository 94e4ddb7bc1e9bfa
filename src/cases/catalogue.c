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
    [SB_FIGURE_EXCESS]   = {"excess",   "/255",   "largest value, less the 1 that it must not exceed"},
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

const struct sb_case *sb_case_expect(const char *id, const struct sb_case_family **family,
                                     struct sb_error *err)
{
    const char *valid[SB_CASES_MAX];
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

static void select_case(const struct sb_case *one, const struct sb_case **it, int *count)
{
    for (int i = 0; i < *count; i++)
        if (it[i] == one)
            return;
    if (*count < SB_CASES_MAX)
        it[(*count)++] = one;
}

// Of more than fifty valid words only the families are told.
static bool fail_word(const char *word, struct sb_error *err)
{
    const char *valid[SB_CASES_MAX + SB_CASE_FAMILIES];
    int count = 0;
    struct sb_text families = {0};
    for (int f = 0; f < SB_CASE_FAMILIES; f++) {
        if (sb_case_families[f]->count == 0)
            continue;
        valid[count++] = sb_case_families[f]->name;
        sb_text_printf(&families, " %s", sb_case_families[f]->name);
        for (int i = 0; i < sb_case_families[f]->count; i++)
            valid[count++] = sb_case_families[f]->row[i].id;
    }
    const char *nearest = sb_nearest_word(word, valid, count);
    sb_fail(err, SB_USAGE,
            "unknown case or family \"%s\";%s%s%s valid: the cases of shadebench list "
            "cases, and the families%s",
            word, nearest ? " did you mean \"" : "", nearest ? nearest : "",
            nearest ? "\"?" : "", sb_text_get(&families));
    sb_text_free(&families);
    return false;
}

bool sb_cases_select(const char *word, const struct sb_case **it, int *count,
                     struct sb_error *err)
{
    bool found = false;
    for (int f = 0; f < SB_CASE_FAMILIES; f++) {
        const struct sb_case_family *family = sb_case_families[f];
        const bool whole = strcmp(family->name, word) == 0;
        for (int i = 0; i < family->count; i++) {
            if (!whole && strcmp(family->row[i].id, word) != 0)
                continue;
            select_case(&family->row[i], it, count);
            found = true;
        }
    }
    return found || fail_word(word, err);
}
