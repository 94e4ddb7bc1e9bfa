#include "cli/expect.h"

#include <stdio.h>

#include "base/log.h"

bool sb_cli_expect(const struct sb_options *options, const struct sb_suite *suite,
                   struct sb_expected *expected, struct sb_error *err)
{
    if (!sb_expect_resolve(suite, expected, err))
        return false;
    if (options->check && !expected->rule_count)
        return sb_fail(
            err, SB_USAGE,
            "--check: suite \"%s\" has no `expect:`, so there is nothing to check",
            suite->name);
    if (options->fail_on_inconclusive && !options->check)
        return sb_fail(err, SB_USAGE, "--fail-on-inconclusive goes with --check");
    if (expected->rule_count && !options->check)
        sb_info("%s: what it expects is judged with --check only", suite->name);
    return true;
}

void sb_cli_expect_print(const struct sb_expected *expected)
{
    struct sb_text text = {0};
    printf("\nexpected:");
    for (int v = 0; v < SB_EXPECT_VERDICT_COUNT; v++)
        printf("%s %d %s", v ? "," : "", expected->of[v], sb_expect_words[v]);
    printf("\n");
    for (int i = 0; i < expected->finding_count; i++) {
        const struct sb_expect_finding *finding = &expected->finding[i];
        if (finding->verdict == SB_EXPECT_HELD)
            continue;
        sb_text_clear(&text);
        sb_expect_text(finding, &text);
        printf("%s: %s\n", sb_expect_words[finding->verdict], sb_text_get(&text));
    }
    sb_text_free(&text);
}

json_t *sb_cli_expect_json(const struct sb_expected *expected)
{
    json_t *list = json_array();
    struct sb_text text = {0};
    for (int i = 0; i < expected->finding_count; i++) {
        const struct sb_expect_finding *finding = &expected->finding[i];
        const struct sb_row *row = finding->row;
        sb_text_clear(&text);
        sb_expect_rule_text(finding->rule, &text);
        json_t *object =
            json_pack("{ssssssss}", "expected", sb_text_get(&text), "verdict",
                      sb_expect_words[finding->verdict], "measured", finding->measured,
                      "at", finding->rule->expectation->bound_at);
        json_object_set_new(object, "scene", row ? json_string(row->scene) : json_null());
        json_object_set_new(object, "variant",
                            row ? json_string(row->variant) : json_null());
        json_array_append_new(list, object);
    }
    sb_text_free(&text);
    return list;
}

// A line behind those of earlier findings, and of a row that had failed behind its own message.
static const char *append(const char *text, const char *between, const char *line,
                          struct sb_arena *arena)
{
    return text ? sb_arena_printf(arena, "%s%s%s", text, between, line) : line;
}

// `own`: the row had failed before anything was expected of it.
static void apply_finding(const struct sb_expect_finding *finding, const char *line,
                          bool own, struct sb_export_row *to, struct sb_arena *arena)
{
    to->message = append(to->message, "; ", line, arena);
    if (to->details)
        to->details = append(to->details, "\n", line, arena);
    // One that is undecided takes nothing from what an earlier one has decided.
    const bool missed = finding->verdict == SB_EXPECT_MISSED;
    if (own || (!missed && to->outcome == SB_EXPORT_FAILED))
        return;
    to->outcome = missed ? SB_EXPORT_FAILED : SB_EXPORT_SKIPPED;
    to->status = sb_expect_words[finding->verdict];
}

static bool has_failed(const struct sb_export_row *row)
{
    return row->outcome == SB_EXPORT_FAILED || row->outcome == SB_EXPORT_ERROR;
}

void sb_cli_expect_export(const struct sb_expected *expected, const struct sb_row *row,
                          struct sb_exported *exported)
{
    struct sb_arena *arena = &exported->arena;
    const struct sb_export_row *was = exported->export.row;
    const int count = exported->export.row_count;
    struct sb_export_row *all = sb_arena_alloc(
        arena, (size_t)(count + expected->finding_count + 1) * sizeof *all);
    struct sb_text text = {0};
    int all_count = count;
    for (int i = 0; i < count; i++) {
        all[i] = was[i];
        if (!has_failed(&was[i]))
            all[i].message = NULL; // it follows the findings
    }
    for (int i = 0; i < expected->finding_count; i++) {
        const struct sb_expect_finding *finding = &expected->finding[i];
        const int at = finding->row ? (int)(finding->row - row) : all_count;
        if (finding->verdict == SB_EXPECT_HELD)
            continue;
        sb_text_clear(&text);
        sb_expect_text(finding, &text);
        const char *line = sb_arena_strdup(arena, sb_text_get(&text));
        if (!finding->row) {
            all[all_count] = sb_export_row_unknown;
            all[all_count].scene = "expect";
            all[all_count++].variant = line;
        }
        apply_finding(finding, line, at < count && has_failed(&was[at]), &all[at], arena);
    }
    for (int i = 0; i < count; i++)
        if (!has_failed(&was[i]) && was[i].message)
            all[i].message = append(all[i].message, "; ", was[i].message, arena);
    sb_text_free(&text);
    exported->export.row = all;
    exported->export.row_count = all_count;
}

int sb_cli_expect_code(const struct sb_options *options,
                       const struct sb_expected *expected)
{
    return expected->of[SB_EXPECT_MISSED]                                          ? 1
           : expected->of[SB_EXPECT_INCONCLUSIVE] && options->fail_on_inconclusive ? 4
                                                                                   : 0;
}
