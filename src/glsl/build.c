#include "glsl/glsl.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/hash.h"
#include "base/words.h"

enum {
    MAX_DEPTH = 16,     // of includes; the shipped shaders need 4
    MAX_FILE = 1 << 20, // bytes; a shader file is a few thousand
};

struct builder {
    const struct sb_glsl_params *params;
    struct sb_error *err;
    struct sb_arena *arena; // the source's: names and files
    struct sb_text text;
    struct sb_glsl_line *line;
    const char **file_name;
    int line_count, line_capacity, file_count, file_capacity;
    int open[MAX_DEPTH]; // files that are being read, outermost first
    int depth;
};

struct place { // of an #include; file NULL: the first file, which the caller asked for
    const char *file;
    int line;
};

static bool add_file(struct builder *b, struct place from, const char *name);

__attribute__((format(printf, 3, 4))) static bool fail_at(struct builder *b,
                                                          struct place at,
                                                          const char *format, ...)
{
    char what[900];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    if (!at.file)
        return sb_fail(b->err, SB_BAD_INPUT, "%s", what);
    return sb_fail(b->err, SB_BAD_INPUT, "%s:%d: %s", at.file, at.line, what);
}

static void add_line(struct builder *b, const char *text, size_t length,
                     struct sb_glsl_line from)
{
    sb_text_add_n(&b->text, text, length);
    sb_text_add(&b->text, "\n");
    b->line = sb_grow(b->line, b->line_count, &b->line_capacity, sizeof *b->line);
    b->line[b->line_count++] = from;
}

static void add_head(struct builder *b)
{
    struct sb_text text = {0};
    sb_text_printf(&text, "#version %s", b->params->version);
    add_line(b, sb_text_get(&text), text.length, (struct sb_glsl_line){-1, 1});
    for (int i = 0; i < b->params->define_count; i++) {
        const struct sb_glsl_define *define = &b->params->define[i];
        sb_text_clear(&text);
        sb_text_printf(&text, "#define %s %s", define->name, define->value);
        add_line(b, sb_text_get(&text), text.length, (struct sb_glsl_line){-1, i + 2});
    }
    sb_text_free(&text);
}

static const char *define_value(const struct sb_glsl_params *params, const char *name)
{
    for (int i = 0; i < params->define_count; i++)
        if (!strcmp(params->define[i].name, name))
            return params->define[i].value;
    return NULL;
}

static bool fail_no_define(struct builder *b, struct place at, const char *name)
{
    const char **valid =
        sb_arena_alloc(b->arena, (size_t)(b->params->define_count + 1) * sizeof *valid);
    for (int i = 0; i < b->params->define_count; i++)
        valid[i] = b->params->define[i].name;
    const char *nearest = sb_nearest_word(name, valid, b->params->define_count);
    if (nearest)
        return fail_at(b, at, "no define \"%s\"; did you mean \"%s\"?", name, nearest);
    struct sb_text list = {0};
    for (int i = 0; i < b->params->define_count; i++)
        sb_text_printf(&list, " %s", valid[i]);
    fail_at(b, at, "no define \"%s\"; valid:%s", name, sb_text_get(&list));
    sb_text_free(&list);
    return false;
}

// Puts the value of each $(NAME) of a directive in its place.
static char *expand(struct builder *b, struct place at, const char *line)
{
    struct sb_text text = {0};
    const char *rest = line;
    for (const char *mark; (mark = strstr(rest, "$(")) != NULL;) {
        const char *end = strchr(mark, ')');
        if (!end) {
            fail_at(b, at, "%s: \"$(\" without \")\"", line);
            goto error;
        }
        char *word = sb_arena_printf(b->arena, "%.*s", (int)(end - mark - 2), mark + 2);
        const char *value = define_value(b->params, word);
        if (!value) {
            fail_no_define(b, at, word);
            goto error;
        }
        sb_text_add_n(&text, rest, (size_t)(mark - rest));
        sb_text_add(&text, value);
        rest = end + 1;
    }
    sb_text_add(&text, rest);
    char *expanded = sb_arena_strdup(b->arena, sb_text_get(&text));
    sb_text_free(&text);
    return expanded;

error:
    sb_text_free(&text);
    return NULL;
}

// A shader folder may come from someone else: no name in it leads out of it.
static bool stays_inside(const char *name)
{
    if (!*name || *name == '/' || strchr(name, '\\'))
        return false;
    for (const char *part = name; part; part = strchr(part, '/')) {
        part += *part == '/';
        const size_t length = strcspn(part, "/");
        if (length == 0 || (length == 1 && part[0] == '.') ||
            (length == 2 && part[0] == '.' && part[1] == '.'))
            return false;
    }
    return true;
}

static bool is_directive(const char *line)
{
    return line[strspn(line, " \t")] == '#';
}

// Whether a directive is an #include, and what follows the word. Blanks may stand where the
// preprocessor allows them.
static bool is_include(const char *line, const char **rest)
{
    line = strchr(line, '#') + 1;
    line += strspn(line, " \t");
    if (strncmp(line, "include", 7) != 0)
        return false;
    *rest = line + 7 + strspn(line + 7, " \t");
    return true;
}

static bool add_include(struct builder *b, struct place at, const char *rest)
{
    const char *end = *rest == '"' ? strchr(rest + 1, '"') : NULL;
    const char *after = end ? end + 1 + strspn(end + 1, " \t") : NULL;
    if (!after || (*after && strncmp(after, "//", 2) != 0))
        return fail_at(b, at,
                       "#include wants a name in quotes, alone on its line: "
                       "#include \"lights/point.glsl\"");
    char *name = sb_arena_printf(b->arena, "%.*s", (int)(end - rest - 1), rest + 1);
    if (!stays_inside(name))
        return fail_at(b, at,
                       "#include \"%s\": names are relative to the shader folder, "
                       "without \".\" and \"..\"",
                       name);
    return add_file(b, at, name);
}

static bool add_directive(struct builder *b, const char *line, struct sb_glsl_line from)
{
    const struct place at = {b->file_name[from.file], from.line};
    const char *rest;
    line = expand(b, at, line);
    if (!line)
        return false;
    if (is_include(line, &rest))
        return add_include(b, at, rest);
    add_line(b, line, strlen(line), from);
    return true;
}

static bool add_lines(struct builder *b, char *data, int file)
{
    int number = 1;
    for (char *line = data; *line; number++) {
        char *end = line + strcspn(line, "\n");
        char *next = *end ? end + 1 : end;
        if (end > line && end[-1] == '\r')
            end--;
        *end = '\0';
        const struct sb_glsl_line from = {file, number};
        if (!is_directive(line))
            add_line(b, line, (size_t)(end - line), from);
        else if (!add_directive(b, line, from))
            return false;
        line = next;
    }
    return true;
}

static bool fail_cycle(struct builder *b, struct place from, int first)
{
    struct sb_text chain = {0};
    for (int i = first; i < b->depth; i++)
        sb_text_printf(&chain, "%s -> ", b->file_name[b->open[i]]);
    sb_text_add(&chain, b->file_name[b->open[first]]);
    fail_at(b, from, "files include each other: %s", sb_text_get(&chain));
    sb_text_free(&chain);
    return false;
}

static char *read_file(struct builder *b, struct place from, const char *name)
{
    for (int i = 0; i < b->params->given_count; i++)
        if (!strcmp(b->params->given[i].name, name))
            return sb_arena_strdup(b->arena, b->params->given[i].text);
    struct sb_error inner;
    size_t size;
    const char *path = sb_path_join(b->arena, b->params->root, name);
    char *data = sb_file_read(b->arena, path, MAX_FILE, &size, &inner);
    if (!data) {
        fail_at(b, from, "%s", inner.text);
    } else if (strlen(data) != size) {
        fail_at(b, from, "%s: holds a NUL byte; shaders are text", path);
        data = NULL;
    }
    return data;
}

static bool add_file(struct builder *b, struct place from, const char *name)
{
    for (int i = 0; i < b->depth; i++)
        if (!strcmp(b->file_name[b->open[i]], name))
            return fail_cycle(b, from, i);
    for (int i = 0; i < b->file_count; i++)
        if (!strcmp(b->file_name[i], name))
            return true; // each file once
    if (b->depth == MAX_DEPTH)
        return fail_at(b, from, "includes are nested deeper than %d files", MAX_DEPTH);

    char *data = read_file(b, from, name);
    if (!data)
        return false;

    const int file = b->file_count;
    b->file_name =
        sb_grow(b->file_name, b->file_count, &b->file_capacity, sizeof *b->file_name);
    b->file_name[b->file_count++] = sb_arena_strdup(b->arena, name);
    b->open[b->depth++] = file;
    if (!add_lines(b, data, file))
        return false;
    b->depth--;
    return true;
}

static void *keep(struct sb_arena *arena, const void *array, int count, size_t element)
{
    const size_t size = (size_t)count * element;
    void *kept = sb_arena_alloc(arena, size);
    return size ? memcpy(kept, array, size) : kept;
}

bool sb_glsl_build(const struct sb_glsl_params *params, struct sb_glsl_source *source,
                   struct sb_error *err)
{
    struct builder b = {.params = params, .err = err, .arena = &source->arena};
    add_head(&b);
    const bool good = add_file(&b, (struct place){0}, params->file);
    if (good) {
        source->text = sb_arena_strdup(&source->arena, sb_text_get(&b.text));
        source->line = keep(&source->arena, b.line, b.line_count, sizeof *b.line);
        source->line_count = b.line_count;
        source->file_name =
            keep(&source->arena, b.file_name, b.file_count, sizeof *b.file_name);
        source->file_count = b.file_count;
        source->hash = sb_hash(SB_HASH_START, b.text.data, b.text.length);
    }
    free(b.line);
    free(b.file_name);
    sb_text_free(&b.text);
    return good;
}

void sb_glsl_free(struct sb_glsl_source *source)
{
    sb_arena_free(&source->arena);
    memset(source, 0, sizeof *source);
}
