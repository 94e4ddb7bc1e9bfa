#include "analyse/expect.h"

#include <math.h>
#include <string.h>

#include "base/words.h"

const char *const sb_expect_words[SB_EXPECT_VERDICT_COUNT] = {
    [SB_EXPECT_HELD] = "held",
    [SB_EXPECT_MISSED] = "missed",
    [SB_EXPECT_INCONCLUSIVE] = "inconclusive",
};

// Two characters first, so that < does not take the place of <=.
static const char *const relation_words[SB_RELATION_COUNT] = {
    [SB_AT_MOST] = "<=", [SB_AT_LEAST] = ">=", [SB_LESS] = "<",
    [SB_MORE] = ">",     [SB_EQUAL] = "=",
};

// Columns with an interval: their own bounds, or those of the column that they follow in proportion.
static const struct interval_row {
    const char *column, *level, *lo, *hi;
    bool inverse; // falls where that one grows
} interval_rows[] = {
    {"median_ms", "median_ms", "ci_lo_ms", "ci_hi_ms", false},
    {"ns_per_fragment", "median_ms", "ci_lo_ms", "ci_hi_ms", false},
    {"fps", "median_ms", "ci_lo_ms", "ci_hi_ms", true},
    {"ratio", "ratio", "ratio_lo", "ratio_hi", false},
    {"against_ratio", "against_ratio", "against_lo", "against_hi", false},
};

static const struct interval_row *interval_of(const struct sb_column *column)
{
    for (size_t i = 0; i < sizeof interval_rows / sizeof *interval_rows; i++)
        if (strcmp(interval_rows[i].column, column->name) == 0)
            return &interval_rows[i];
    return NULL;
}

// --- rules ----------------------------------------------------------------------------------

static const struct sb_column *column_named(const char *name)
{
    for (int i = 0; i < sb_summary_column_count; i++)
        if (sb_summary_columns[i].name && strcmp(sb_summary_columns[i].name, name) == 0)
            return &sb_summary_columns[i];
    return NULL;
}

static bool fail_column(const struct sb_suite *suite, const struct sb_expectation *from,
                        struct sb_error *err)
{
    const char *names[256];
    int count = 0;
    for (int i = 0; i < sb_summary_column_count && count < 256; i++)
        if (sb_summary_columns[i].name)
            names[count++] = sb_summary_columns[i].name;
    if (sb_axes_find(&suite->axes, from->column) >= 0)
        return sb_fail(err, SB_BAD_INPUT, "%s: \"%s\" is an axis; it goes under where",
                       from->column_at, from->column);
    const char *nearest = sb_nearest_word(from->column, names, count);
    return sb_fail(err, SB_BAD_INPUT,
                   "%s: unknown column \"%s\"; %s%s%svalid: shadebench list columns, "
                   "those of summary.csv",
                   from->column_at, from->column, nearest ? "did you mean \"" : "",
                   nearest ? nearest : "", nearest ? "\"? " : "");
}

// A number, or one over another.
static bool read_limit(const char *word, double *limit)
{
    char above[64];
    double below;
    const char *slash = strchr(word, '/');
    const size_t length = slash ? (size_t)(slash - word) : strlen(word);
    if (length >= sizeof above)
        return false;
    memcpy(above, word, length);
    above[length] = '\0';
    if (!sb_parse_number(above, limit))
        return false;
    if (!slash)
        return true;
    if (!sb_parse_number(slash + 1, &below))
        return false;
    *limit /= below; // 0 makes no finite number
    return isfinite(*limit);
}

static bool read_bound(struct sb_expect_rule *rule, struct sb_error *err)
{
    const struct sb_expectation *from = rule->expectation;
    const char *at = from->bound + strspn(from->bound, " ");
    rule->relation = SB_RELATION_COUNT;
    for (int i = 0; i < SB_RELATION_COUNT && rule->relation == SB_RELATION_COUNT; i++)
        if (strncmp(at, relation_words[i], strlen(relation_words[i])) == 0)
            rule->relation = (enum sb_relation)i;
    const bool bare = rule->relation == SB_RELATION_COUNT;
    if (bare)
        rule->relation = SB_EQUAL;
    else
        at += strlen(relation_words[rule->relation]);
    rule->word = at + strspn(at, " ");
    if (rule->column->type == SB_TEXT)
        return (*rule->word && rule->relation == SB_EQUAL) ||
               sb_fail(err, SB_BAD_INPUT,
                       "%s: %s: \"%s\": a word is wanted; valid: = WORD", from->bound_at,
                       from->column, from->bound);
    if (!read_limit(rule->word, &rule->limit))
        return sb_fail(
            err, SB_BAD_INPUT,
            "%s: %s: \"%s\" is no bound; valid: one of <= >= < > = and a number "
            "or A/B, like <= 2/255",
            from->bound_at, from->column, from->bound);
    if (rule->relation == SB_EQUAL && interval_of(rule->column))
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: %s: \"%s\": a measured interval equals no number; valid: <= "
                       ">= < >",
                       from->bound_at, from->column, from->bound);
    return true;
}

bool sb_expect_resolve(const struct sb_suite *suite, struct sb_expected *expected,
                       struct sb_error *err)
{
    expected->rule_count = suite->expect_count;
    expected->rule = sb_arena_alloc(&expected->arena, ((size_t)suite->expect_count + 1) *
                                                          sizeof *expected->rule);
    for (int i = 0; i < suite->expect_count; i++) {
        struct sb_expect_rule *rule = &expected->rule[i];
        rule->expectation = &suite->expect[i];
        rule->column = column_named(rule->expectation->column);
        if (!rule->column)
            return fail_column(suite, rule->expectation, err);
        if (!read_bound(rule, err))
            return false;
    }
    return true;
}

void sb_expect_free(struct sb_expected *expected)
{
    sb_arena_free(&expected->arena);
    *expected = (struct sb_expected){0};
}

// --- rows -----------------------------------------------------------------------------------

static bool has_value(const struct sb_expect_axis *axis, const struct sb_variant *v)
{
    for (int i = 0; i < axis->count; i++)
        if (v->value[axis->axis] == axis->value[i])
            return true;
    return false;
}

static bool names_row(const struct sb_expectation *expectation, const struct sb_row *row)
{
    bool named = expectation->scene_count == 0;
    for (int i = 0; i < expectation->scene_count; i++)
        named |= strcmp(expectation->scene[i], row->scene) == 0;
    for (int i = 0; named && i < expectation->axis_count; i++)
        named = has_value(&expectation->axis[i], row->axes);
    return named;
}

static double number_in(const struct sb_row *row, const struct sb_column *column)
{
    const void *cell = (const char *)row + column->offset;
    if (column->type == SB_REAL)
        return *(const double *)cell;
    const int64_t count = *(const int64_t *)cell;
    return count == SB_NO_COUNT ? (double)NAN : (double)count;
}

static double bound_of(const struct sb_row *row, const struct interval_row *interval,
                       const char *end, double value)
{
    const double bound = number_in(row, column_named(end));
    if (strcmp(interval->column, interval->level) == 0)
        return bound; // to the last bit
    const double level = number_in(row, column_named(interval->level));
    return interval->inverse ? value * level / bound : value * bound / level;
}

static bool holds(const struct sb_expect_rule *rule, double value)
{
    switch (rule->relation) {
    case SB_AT_MOST:
        return value <= rule->limit;
    case SB_AT_LEAST:
        return value >= rule->limit;
    case SB_LESS:
        return value < rule->limit;
    case SB_MORE:
        return value > rule->limit;
    default:
        return value == rule->limit;
    }
}

static bool is(const struct sb_row *row, enum sb_status status)
{
    return row->status && sb_status_find(row->status) == status;
}

static void judge_number(struct sb_expect_finding *finding, struct sb_text *measured)
{
    const struct sb_expect_rule *rule = finding->rule;
    const double value = number_in(finding->row, rule->column);
    const struct interval_row *interval = interval_of(rule->column);
    if (isnan(value)) {
        const bool untimed = interval && is(finding->row, SB_ACCURACY_ONLY);
        finding->verdict = untimed ? SB_EXPECT_INCONCLUSIVE : SB_EXPECT_MISSED;
        sb_text_add(measured, untimed ? "not timed" : "not measured");
        return;
    }
    sb_text_printf(measured, "%.6g", value);
    finding->verdict = holds(rule, value) ? SB_EXPECT_HELD : SB_EXPECT_MISSED;
    if (!interval)
        return;
    const double lo = bound_of(finding->row, interval,
                               interval->inverse ? interval->hi : interval->lo, value),
                 hi = bound_of(finding->row, interval,
                               interval->inverse ? interval->lo : interval->hi, value);
    finding->verdict = SB_EXPECT_INCONCLUSIVE;
    if (isnan(lo) || isnan(hi)) {
        sb_text_add(measured, " without an interval");
        return;
    }
    if (holds(rule, lo) == holds(rule, hi))
        finding->verdict = holds(rule, lo) ? SB_EXPECT_HELD : SB_EXPECT_MISSED;
    sb_text_printf(measured, " (%.6g … %.6g)", lo, hi);
}

static void judge_word(struct sb_expect_finding *finding, struct sb_text *measured)
{
    const void *cell = (const char *)finding->row + finding->rule->column->offset;
    const char *word = *(const char *const *)cell;
    if (word && strcmp(word, finding->rule->word) == 0)
        finding->verdict = SB_EXPECT_HELD;
    sb_text_add(measured, word ? word : "not measured");
}

static bool has_failed(const struct sb_row *row)
{
    const enum sb_status status = row->status ? sb_status_find(row->status) : SB_INTERNAL;
    return status == SB_STATUS_COUNT || sb_status_rows[status].exit_code != 0;
}

static void judge(struct sb_expect_finding *finding, struct sb_text *measured)
{
    const struct sb_column *column = finding->rule->column;
    finding->verdict = SB_EXPECT_MISSED;
    if (column->type == SB_TEXT)
        judge_word(finding, measured);
    else
        judge_number(finding, measured);
    if (has_failed(finding->row) && strcmp(column->name, "status") != 0) {
        finding->verdict = SB_EXPECT_MISSED;
        sb_text_printf(measured, ", and the row is %s",
                       finding->row->status ? finding->row->status : "without a status");
    }
}

static void add_finding(struct sb_expected *expected, const struct sb_expect_rule *rule,
                        const struct sb_row *row)
{
    struct sb_text measured = {0};
    struct sb_expect_finding *finding = &expected->finding[expected->finding_count++];
    *finding = (struct sb_expect_finding){rule, row, SB_EXPECT_MISSED, ""};
    if (row)
        judge(finding, &measured);
    else
        sb_text_add(&measured, "it names no row");
    finding->measured = sb_arena_strdup(&expected->arena, sb_text_get(&measured));
    expected->of[finding->verdict]++;
    sb_text_free(&measured);
}

void sb_expect_check(struct sb_expected *expected, const struct sb_row *row, int count)
{
    const size_t room = (size_t)expected->rule_count * ((size_t)count + 1);
    expected->finding =
        sb_arena_alloc(&expected->arena, (room + 1) * sizeof *expected->finding);
    for (int i = 0; i < expected->rule_count; i++) {
        const struct sb_expect_rule *rule = &expected->rule[i];
        const int before = expected->finding_count;
        for (int k = 0; k < count; k++)
            if (names_row(rule->expectation, &row[k]))
                add_finding(expected, rule, &row[k]);
        if (expected->finding_count == before)
            add_finding(expected, rule, NULL);
    }
}

// --- words ----------------------------------------------------------------------------------

void sb_expect_rule_text(const struct sb_expect_rule *rule, struct sb_text *text)
{
    sb_text_printf(text, "%s %s %s", rule->column->name, relation_words[rule->relation],
                   rule->word);
}

void sb_expect_text(const struct sb_expect_finding *finding, struct sb_text *text)
{
    sb_expect_rule_text(finding->rule, text);
    if (finding->row)
        sb_text_printf(text, " of %s %s", finding->row->scene, finding->row->variant);
    sb_text_printf(text, ": %s (%s)", finding->measured,
                   finding->rule->expectation->bound_at);
}
