// JUnit XML: a suite a scene, a case a variant. A base has no case of its own.
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "export/formats.h"
#include "results/junit.h"

static enum sb_junit_outcome outcome_of(const struct sb_export_row *row)
{
    static const enum sb_junit_outcome outcomes[SB_EXPORT_OUTCOMES] = {
        [SB_EXPORT_PASSED] = SB_JUNIT_PASSED,
        [SB_EXPORT_FAILED] = SB_JUNIT_FAILED,
        [SB_EXPORT_ERROR] = SB_JUNIT_ERROR,
        [SB_EXPORT_SKIPPED] = SB_JUNIT_SKIPPED,
    };
    return outcomes[row->outcome];
}

static const char *keep(struct sb_arena *arena, struct sb_text *text)
{
    const char *kept = text->length ? sb_arena_strdup(arena, text->data) : NULL;
    sb_text_clear(text);
    return kept;
}

static struct sb_junit_case make_case(const struct sb_export_row *row,
                                      struct sb_arena *arena)
{
    struct sb_text text = {0};
    struct sb_junit_case it = {
        .class_name = row->scene,
        .name = row->variant,
        .outcome = outcome_of(row),
    };
    sb_export_times(row, &text);
    it.output = keep(arena, &text);
    if (row->outcome != SB_EXPORT_PASSED) {
        it.type = row->status;
        sb_export_says(row, &text);
        it.message = keep(arena, &text);
        // Services that show the text alone are to show the figures, too.
        sb_text_printf(&text, "%s\n%s",
                       row->details ? row->details
                       : it.message ? it.message
                                    : "",
                       it.output ? it.output : "");
        it.details = keep(arena, &text);
    } else if (row->message) {
        sb_text_printf(&text, "%s%s", it.output ? it.output : "", it.output ? "\n" : "");
        sb_export_says(row, &text);
        it.output = keep(arena, &text);
    }
    sb_text_free(&text);
    return it;
}

static bool has_case(const struct sb_export_row *row)
{
    return !sb_export_is_base(row);
}

// Rows of a scene need not follow one another, so the cases are gathered by scene.
static int make_suites(const struct sb_export *export, struct sb_junit_case *cases,
                       struct sb_junit_suite *suites, struct sb_arena *arena)
{
    int suite_count = 0, case_count = 0;
    for (int i = 0; i < export->row_count; i++) {
        const char *scene = export->row[i].scene;
        bool known = !has_case(&export->row[i]);
        for (int s = 0; s < suite_count && !known; s++)
            known = strcmp(suites[s].name, scene) == 0;
        if (known)
            continue;
        struct sb_junit_suite *suite = &suites[suite_count++];
        *suite = (struct sb_junit_suite){scene, &cases[case_count], 0};
        for (int j = i; j < export->row_count; j++)
            if (has_case(&export->row[j]) && strcmp(export->row[j].scene, scene) == 0) {
                cases[case_count++] = make_case(&export->row[j], arena);
                suite->count++;
            }
    }
    return suite_count;
}

void sb_export_junit(const struct sb_export *export, struct sb_text *text)
{
    struct sb_arena arena = {0};
    const size_t rows = (size_t) export->row_count + 1;
    struct sb_junit_case *cases = sb_alloc(rows * sizeof *cases);
    struct sb_junit_suite *suites = sb_alloc(rows * sizeof *suites);
    struct sb_junit_property *properties =
        sb_alloc(((size_t) export->property_count + 1) * sizeof *properties);
    int property_count = 0;
    for (int i = 0; i < export->property_count; i++)
        if (export->property[i].value)
            properties[property_count++] = (struct sb_junit_property){
                export->property[i].name, export->property[i].value};
    const struct sb_junit junit = {
        .name = export->name,
        .suite = suites,
        .count = make_suites(export, cases, suites, &arena),
        .property = properties,
        .property_count = property_count,
    };
    sb_junit_text(&junit, text);
    free(cases);
    free(suites);
    free(properties);
    sb_arena_free(&arena);
}
