#include "results/junit.h"

#include <stdint.h>
#include <string.h>

#include "base/file.h"

// --- characters ---------------------------------------------------------------------------

// Steps over one code point of UTF-8 (RFC 3629, section 4); what is none is one byte, and -1.
static int32_t next_code(const char **at)
{
    static const int32_t least[] = {0, 0x80, 0x800, 0x10000};
    const unsigned char *byte = (const unsigned char *)*at;
    const int more = byte[0] < 0x80                       ? 0
                     : byte[0] >= 0xC2 && byte[0] <= 0xDF ? 1
                     : byte[0] >= 0xE0 && byte[0] <= 0xEF ? 2
                     : byte[0] >= 0xF0 && byte[0] <= 0xF4 ? 3
                                                          : -1;
    int32_t code = more > 0 ? byte[0] & (0x3F >> more) : byte[0];
    ++*at;
    if (more < 0)
        return -1;
    for (int i = 1; i <= more; i++) {
        if ((byte[i] & 0xC0) != 0x80)
            return -1;
        code = code << 6 | (byte[i] & 0x3F);
    }
    if (code < least[more] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF))
        return -1;
    *at += more;
    return code;
}

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
        const int32_t code = next_code(&at);
        if (code < 0 || !is_character(code))
            sb_text_add(text, "\xEF\xBF\xBD");
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

static void add_case(const struct sb_junit_case *row, struct sb_text *text)
{
    static const char *const elements[] = {NULL, "failure", "skipped"};
    sb_text_add(text, "    <testcase");
    add_attribute(text, "classname", row->class_name);
    add_attribute(text, "name", row->name);
    if (row->outcome == SB_JUNIT_PASSED && !row->output) {
        sb_text_add(text, "/>\n");
        return;
    }
    sb_text_add(text, ">\n");
    if (row->outcome != SB_JUNIT_PASSED) {
        sb_text_printf(text, "      <%s", elements[row->outcome]);
        add_attribute(text, "message", row->message);
        if (row->outcome == SB_JUNIT_FAILED) {
            // Some services show the text of a failure, and neither of its attributes.
            add_attribute(text, "type", row->type ? row->type : "failure");
            sb_text_add(text, ">");
            add_escaped(text, row->message ? row->message : "", false);
            sb_text_add(text, "</failure>\n");
        } else {
            sb_text_add(text, "/>\n");
        }
    }
    if (row->output) {
        sb_text_add(text, "      <system-out>");
        add_escaped(text, row->output, false);
        sb_text_add(text, "</system-out>\n");
    }
    sb_text_add(text, "    </testcase>\n");
}

static int count_of(const struct sb_junit_suite *suite, enum sb_junit_outcome outcome)
{
    int count = 0;
    for (int i = 0; i < suite->count; i++)
        count += suite->row[i].outcome == outcome;
    return count;
}

static void add_suite(const struct sb_junit *junit, const struct sb_junit_suite *suite,
                      struct sb_text *text)
{
    sb_text_add(text, "  <testsuite");
    add_attribute(text, "name", suite->name);
    sb_text_printf(text, " tests=\"%d\" failures=\"%d\" errors=\"0\" skipped=\"%d\">\n",
                   suite->count, count_of(suite, SB_JUNIT_FAILED),
                   count_of(suite, SB_JUNIT_SKIPPED));
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
    int tests = 0, failures = 0, skipped = 0;
    for (int i = 0; i < junit->count; i++) {
        tests += junit->suite[i].count;
        failures += count_of(&junit->suite[i], SB_JUNIT_FAILED);
        skipped += count_of(&junit->suite[i], SB_JUNIT_SKIPPED);
    }
    sb_text_add(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites");
    add_attribute(text, "name", junit->name);
    sb_text_printf(text, " tests=\"%d\" failures=\"%d\" errors=\"0\" skipped=\"%d\">\n",
                   tests, failures, skipped);
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
