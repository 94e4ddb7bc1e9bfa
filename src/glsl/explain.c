#include "glsl/glsl.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

// Where a message says it stands: string number, line, and column where there is one.
struct where {
    size_t length; // of the prefix that says so, with its colon and blanks
    long line;
    long column; // 0: not said
};

static bool read_number(const char **at, long *number)
{
    if (!isdigit((unsigned char)**at))
        return false;
    char *end;
    *number = strtol(*at, &end, 10);
    *at = end;
    return true;
}

static bool read_word(const char **at, const char *word)
{
    if (strncmp(*at, word, strlen(word)) != 0)
        return false;
    *at += strlen(word);
    return true;
}

// Mesa and NVIDIA: 0:12(5): and 0(12) : ; AMD, Apple, glslang and Mali: 0:12: . All count
// the strings given to glShaderSource from 0, and we give one.
static bool find_where(const char *text, struct where *where)
{
    const char *at = text;
    long string;
    *where = (struct where){0};
    if (!read_number(&at, &string) || string != 0)
        return false;
    if (read_word(&at, ":")) {
        if (!read_number(&at, &where->line))
            return false;
        if (read_word(&at, "(") &&
            (!read_number(&at, &where->column) || !read_word(&at, ")")))
            return false;
    } else if (!read_word(&at, "(") || !read_number(&at, &where->line) ||
               !read_word(&at, ")")) {
        return false;
    }
    at += strspn(at, " ");
    if (!read_word(&at, ":"))
        return false;
    at += strspn(at, " ");
    where->length = (size_t)(at - text);
    return true;
}

static void add_where(const struct sb_glsl_source *source, const struct where *where,
                      struct sb_text *text)
{
    // Parsers report an unexpected end one line behind the last.
    const long last = source->line_count;
    const long line = where->line == last + 1 ? last : where->line;
    const struct sb_glsl_line from = source->line[line - 1];
    if (from.file < 0)
        sb_text_printf(text, "(generated):%d", from.line);
    else
        sb_text_printf(text, "%s:%d", source->file_name[from.file], from.line);
    if (where->column > 0)
        sb_text_printf(text, ":%ld", where->column);
    sb_text_add(text, ": ");
}

static void explain_line(const struct sb_glsl_source *source, const char *line,
                         size_t length, struct sb_text *text)
{
    static const char *const severity[] = {"ERROR: ", "WARNING: "};
    const char *at = line;
    for (size_t i = 0; i < sizeof severity / sizeof *severity; i++)
        if (read_word(&at, severity[i]))
            break;
    struct where where;
    if (find_where(at, &where) && where.line >= 1 &&
        where.line <= source->line_count + 1L) {
        sb_text_add_n(text, line, (size_t)(at - line));
        add_where(source, &where, text);
        at += where.length;
    } else {
        at = line;
    }
    sb_text_add_n(text, at, (size_t)(line + length - at));
}

void sb_glsl_explain(const struct sb_glsl_source *source, const char *log,
                     struct sb_text *text)
{
    while (*log) {
        const size_t length = strcspn(log, "\n");
        explain_line(source, log, length, text);
        log += length;
        if (*log) {
            sb_text_add(text, "\n");
            log++;
        }
    }
}
