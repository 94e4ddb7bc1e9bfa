#include "results/junit.h"

#include <stdint.h>

#include "base/file.h"
#include "base/utf8.h"

// --- characters ---------------------------------------------------------------------------

// Char of XML 1.0, 2.2.
static bool is_character(int32_t code)
{
    return code == '\t' || code == '\n' || code == '\r' ||
           (code >= 0x20 && code != 0xFFFE && code != 0xFFFF);
}

// A parser makes blanks of line ends and tabs in attributes (3.3.3), and line feeds of carriage
// returns anywhere (2.11): only references keep them. `>` is written as one always, because of ]]>.
static void add_escaped(struct sb_text *text, const char *string, bool attribute)
{
    for (const char *at = string; *at;) {
        const char *from = at;
        const int32_t code = sb_utf8_next(&at);
        if (code < 0 || !is_character(code))
            sb_text_add(text, SB_UTF8_REPLACEMENT);
        else if (code == '\r' || (attribute && (code == '\n' || code == '\t')))
            sb_text_printf(text, "&#%d;", (int)code);
        else if (code == '<')
            sb_text_add(text, "&lt;");
        else if (code == '>')
            sb_text_add(text, "&gt;");
        else if (code == '&')
            sb_text_add(text, "&amp;");
        else if (attribute && code == '"')
            sb_text_add(text, "&quot;");
        else
            sb_text_add_n(text, from, (size_t)(at - from));
    }
}

static void add_attribute(struct sb_text *text, const char *name, const char *value)
{
    if (!value)
        return;
    sb_text_printf(text, " %s=\"", name);
    add_escaped(text, value, true);
    sb_text_add(text, "\"");
}

// --- elements -----------------------------------------------------------------------------

// Some services show the text of a failure or an error, and neither of its attributes.
static void add_outcome(const struct sb_junit_case *row, struct sb_text *text)
{
    static const struct {
        const char *element, *type;
    } outcomes[] = {
        [SB_JUNIT_FAILED] = {"failure", "failure"},
        [SB_JUNIT_ERROR] = {"error", "error"},
        [SB_JUNIT_SKIPPED] = {"skipped", NULL},
    };
    const char *element = outcomes[row->outcome].element;
    const char *body = row->details ? row->details : row->message;
    sb_text_printf(text, "      <%s", element);
    add_attribute(text, "message", row->message);
    if (row->outcome == SB_JUNIT_SKIPPED) {
        sb_text_add(text, "/>\n");
        return;
    }
    add_attribute(text, "type", row->type ? row->type : outcomes[row->outcome].type);
    sb_text_add(text, ">");
    add_escaped(text, body ? body : "", false);
    sb_text_printf(text, "</%s>\n", element);
}

static void add_case(const struct sb_junit_case *row, struct sb_text *text)
{
    sb_text_add(text, "    <testcase");
    add_attribute(text, "classname", row->class_name);
    add_attribute(text, "name", row->name);
    if (row->outcome == SB_JUNIT_PASSED && !row->output) {
        sb_text_add(text, "/>\n");
        return;
    }
    sb_text_add(text, ">\n");
    if (row->outcome != SB_JUNIT_PASSED)
        add_outcome(row, text);
    if (row->output) {
        sb_text_add(text, "      <system-out>");
        add_escaped(text, row->output, false);
        sb_text_add(text, "</system-out>\n");
    }
    sb_text_add(text, "    </testcase>\n");
}

static void count_outcomes(const struct sb_junit_suite *suite,
                           int count[SB_JUNIT_OUTCOMES])
{
    for (int i = 0; i < suite->count; i++)
        count[suite->row[i].outcome]++;
}

static void add_counts(struct sb_text *text, int tests,
                       const int count[SB_JUNIT_OUTCOMES])
{
    sb_text_printf(text, " tests=\"%d\" failures=\"%d\" errors=\"%d\" skipped=\"%d\">\n",
                   tests, count[SB_JUNIT_FAILED], count[SB_JUNIT_ERROR],
                   count[SB_JUNIT_SKIPPED]);
}

static void add_suite(const struct sb_junit *junit, const struct sb_junit_suite *suite,
                      struct sb_text *text)
{
    int count[SB_JUNIT_OUTCOMES] = {0};
    count_outcomes(suite, count);
    sb_text_add(text, "  <testsuite");
    add_attribute(text, "name", suite->name);
    add_counts(text, suite->count, count);
    if (junit->property_count)
        sb_text_add(text, "    <properties>\n");
    for (int i = 0; i < junit->property_count; i++) {
        sb_text_add(text, "      <property");
        add_attribute(text, "name", junit->property[i].name);
        add_attribute(text, "value", junit->property[i].value);
        sb_text_add(text, "/>\n");
    }
    if (junit->property_count)
        sb_text_add(text, "    </properties>\n");
    for (int i = 0; i < suite->count; i++)
        add_case(&suite->row[i], text);
    sb_text_add(text, "  </testsuite>\n");
}

void sb_junit_text(const struct sb_junit *junit, struct sb_text *text)
{
    int tests = 0, count[SB_JUNIT_OUTCOMES] = {0};
    for (int i = 0; i < junit->count; i++) {
        tests += junit->suite[i].count;
        count_outcomes(&junit->suite[i], count);
    }
    sb_text_add(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites");
    add_attribute(text, "name", junit->name);
    add_counts(text, tests, count);
    for (int i = 0; i < junit->count; i++)
        add_suite(junit, &junit->suite[i], text);
    sb_text_add(text, "</testsuites>\n");
}

bool sb_junit_write(const struct sb_junit *junit, const char *path, struct sb_error *err)
{
    struct sb_text text = {0};
    sb_junit_text(junit, &text);
    const bool good = sb_file_replace(path, text.data, text.length, err);
    sb_text_free(&text);
    return good;
}
