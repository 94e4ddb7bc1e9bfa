#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "base/words.h"
#include "export/formats.h"

// clang-format off
const struct sb_export_format sb_export_formats[] = {
    {"gbench-json", "Google Benchmark's JSON, an entry a sample: compare.py and its U test", sb_export_gbench_json},
    {"gbench-json-aggregates", "its means and medians alone: Bencher's cpp_google, github-action-benchmark's googlecpp", sb_export_gbench_aggregates},
    {"gbench-csv", "Google Benchmark's CSV, a line a sample", sb_export_gbench_csv},
    {"github-action-benchmark", "its customSmallerIsBetter: a ratio a variant", sb_export_github_action},
    {"bencher", "Bencher Metric Format, JSON: bencher run --adapter json", sb_export_bencher},
    {"go", "Go's benchmark text, a line a sample: benchstat", sb_export_go},
    {"junit", "JUnit XML, a test case a variant: what CI services show", sb_export_junit},
    {"markdown", "a table for a pull request, what passed folded away", sb_export_markdown},
};
// clang-format on
const int sb_export_format_count = sizeof sb_export_formats / sizeof *sb_export_formats;

const struct sb_export_format *sb_export_format_find(const char *owner, const char *word,
                                                     struct sb_error *err)
{
    enum { COUNT = sizeof sb_export_formats / sizeof *sb_export_formats };
    const char *names[COUNT];
    for (int i = 0; i < COUNT; i++) {
        names[i] = sb_export_formats[i].name;
        if (strcmp(names[i], word) == 0)
            return &sb_export_formats[i];
    }
    struct sb_error unknown;
    sb_fail_unknown(&unknown, owner, "format", word, names, COUNT);
    sb_fail(err, SB_USAGE, "%s", unknown.text);
    return NULL;
}

// --- rows -----------------------------------------------------------------------------------

const struct sb_export_row sb_export_row_unknown = {
    .frame_ns = {NAN, NAN, NAN, 0},
    .cpu_ns = NAN,
    .ratio = {NAN, NAN, NAN, 0},
};

void sb_export_row_name(const struct sb_export_row *row, struct sb_text *text)
{
    sb_text_printf(text, "%s%s%s/%s", row->side ? row->side : "", row->side ? "/" : "",
                   row->scene, row->variant);
}

bool sb_export_is_base(const struct sb_export_row *row)
{
    return row->side && strcmp(row->side, "base") == 0;
}

// Of a base nothing is judged, and its outcome is that of the pair.
static bool is_valid(const struct sb_export_row *row)
{
    return sb_export_is_base(row) || row->outcome != SB_EXPORT_ERROR;
}

bool sb_export_timed(const struct sb_export_row *row)
{
    return is_valid(row) && isfinite(row->frame_ns.point);
}

double sb_export_instructions(const struct sb_export_row *row)
{
    for (int i = 0; is_valid(row) && i < row->counter_count; i++)
        if (strcmp(row->counter[i].name, "instructions") == 0)
            return row->counter[i].value;
    return NAN;
}

bool sb_export_has_ratio(const struct sb_export_row *row)
{
    return !sb_export_is_base(row) && is_valid(row) && isfinite(row->ratio.point);
}

const struct sb_export_row *sb_export_base_of(const struct sb_export *export,
                                              const struct sb_export_row *row)
{
    for (int i = 0; row->side && i < export->row_count; i++) {
        const struct sb_export_row *other = &export->row[i];
        if (other != row && sb_export_is_base(other) &&
            (sb_export_timed(other) || isfinite(sb_export_instructions(other))) &&
            strcmp(other->scene, row->scene) == 0 &&
            strcmp(other->variant, row->variant) == 0)
            return other;
    }
    return NULL;
}

// --- in words -------------------------------------------------------------------------------

void sb_export_says(const struct sb_export_row *row, struct sb_text *text)
{
    const char *status = row->status ? row->status : "";
    sb_text_printf(text, "%s%s%s", status, *status && row->message ? ": " : "",
                   row->message ? row->message : "");
}

static void add_interval(struct sb_text *text, const char *format, double scale,
                         const struct sb_interval *interval)
{
    sb_text_printf(text, format, scale * interval->point);
    if (!isfinite(interval->lo) || !isfinite(interval->hi))
        return;
    sb_text_add(text, " [");
    sb_text_printf(text, format, scale * interval->lo);
    sb_text_add(text, ", ");
    sb_text_printf(text, format, scale * interval->hi);
    sb_text_add(text, "]");
}

void sb_export_times(const struct sb_export_row *row, struct sb_text *text)
{
    const double instructions = sb_export_instructions(row);
    const size_t before = text->length;
    if (isfinite(row->frame_ns.point)) {
        sb_text_add(text, "ms a frame: ");
        add_interval(text, "%.4g", 1e-6, &row->frame_ns);
    }
    if (isfinite(instructions))
        sb_text_printf(text, "%sinstructions a frame: %.0f",
                       text->length > before ? ", " : "", instructions);
    if (isfinite(row->ratio.point)) {
        sb_text_add(text, text->length > before ? ", ratio: " : "ratio: ");
        add_interval(text, "%.4g", 1, &row->ratio);
    }
}

bool sb_export_half_percent(const struct sb_interval *interval, struct sb_text *text)
{
    const double half =
        fmax(interval->hi - interval->point, interval->point - interval->lo);
    if (!isfinite(interval->lo) || !isfinite(interval->hi) || interval->point == 0)
        return false;
    sb_text_printf(text, "%.1f", 100 * half / fabs(interval->point));
    return true;
}

void sb_export_number(struct sb_text *text, double value)
{
    if (fabs(value) < 9007199254740992 && value == floor(value)) // 2^53
        sb_text_printf(text, "%.0f", value);
    else
        sb_text_number(text, value);
}

// --- JSON -----------------------------------------------------------------------------------

void sb_export_json_text(json_t *object, const char *key, const char *value)
{
    struct sb_text text = {0};
    sb_utf8_add(&text, value);
    json_object_set_new(object, key, json_string(sb_text_get(&text)));
    sb_text_free(&text);
}

void sb_export_json_object(json_t *object, const char *key, json_t *value)
{
    struct sb_text text = {0};
    sb_utf8_add(&text, key);
    json_object_set_new(object, sb_text_get(&text), value);
    sb_text_free(&text);
}

void sb_export_json_number(json_t *object, const char *key, double value)
{
    if (isfinite(value))
        json_object_set_new(object, key, json_real(value));
}

void sb_export_json_add(json_t *value, struct sb_text *text)
{
    char *dump = json_dumps(value, JSON_INDENT(1) | JSON_REAL_PRECISION(17));
    sb_text_add(text, dump ? dump : "null");
    sb_text_add(text, "\n");
    free(dump);
    json_decref(value);
}
