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

int sb_cli_expect_code(const struct sb_options *options,
                       const struct sb_expected *expected)
{
    return expected->of[SB_EXPECT_MISSED]                                          ? 1
           : expected->of[SB_EXPECT_INCONCLUSIVE] && options->fail_on_inconclusive ? 4
                                                                                   : 0;
}
