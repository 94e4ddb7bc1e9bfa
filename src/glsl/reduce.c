#include "glsl/reduce.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"

// --- tokens: names, and single characters; enough to tell declarations apart -----------------

struct token {
    const char *at;
    int length;
    bool name;
};

static bool is_name_char(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

// The next token of [at, end); length 0: none.
static struct token next_token(const char *at, const char *end)
{
    while (at < end && isspace((unsigned char)*at))
        at++;
    struct token token = {.at = at, .length = at < end};
    if (at == end)
        return token;
    while (token.length < end - at && is_name_char(*at) && is_name_char(at[token.length]))
        token.length++;
    token.name = is_name_char(*at) && !isdigit((unsigned char)*at);
    return token;
}

static bool is_char(struct token token, char c)
{
    return token.length == 1 && *token.at == c;
}

static bool is_word(struct token token, const char *word)
{
    return token.length == (int)strlen(word) &&
           strncmp(token.at, word, (size_t)token.length) == 0;
}

static bool same_name(struct token a, struct token b)
{
    return a.length == b.length && strncmp(a.at, b.at, (size_t)a.length) == 0;
}

// --- items: what stands on the outermost level -------------------------------------------------

enum kind { DIRECTIVE, FUNCTION, STRUCT, BLOCK, VARIABLE };

enum { NAMES_MAX = 24 };
struct item {
    const char *begin, *end;
    enum kind kind;
    struct token name[NAMES_MAX]; // that it declares
    int name_count;
    bool used;
};

struct items {
    struct item *item;
    int count, capacity;
};

static void add_name(struct item *item, struct token name)
{
    if (item->name_count == NAMES_MAX) // kept, since it is not understood
        item->used = true;
    else
        item->name[item->name_count++] = name;
}

// `type name[2] = value, name;`: names behind the type and behind commas, outside brackets.
static void name_variables(struct item *item)
{
    struct token before = {0};
    int depth = 0;
    bool wanted = true;
    for (struct token t = next_token(item->begin, item->end); t.length > 0;
         t = next_token(t.at + t.length, item->end)) {
        const bool ends =
            is_char(t, '[') || is_char(t, '=') || is_char(t, ';') || is_char(t, ',');
        if (depth == 0 && wanted && ends && before.name) {
            add_name(item, before);
            wanted = false;
        }
        depth += is_char(t, '(') || is_char(t, '[') || is_char(t, '{');
        depth -= is_char(t, ')') || is_char(t, ']') || is_char(t, '}');
        wanted |= depth == 0 && is_char(t, ',');
        before = t;
    }
}

// `uniform Block { type name; } instance;`: its members, itself and the instance.
static void name_block(struct item *item)
{
    struct token before = {0};
    for (struct token t = next_token(item->begin, item->end); t.length > 0;
         t = next_token(t.at + t.length, item->end)) {
        if (before.name && (is_char(t, '[') || is_char(t, ';') || is_char(t, '{')))
            add_name(item, before);
        before = t;
    }
}

static void name_function(struct item *item)
{
    struct token before = {0};
    for (struct token t = next_token(item->begin, item->end); t.length > 0;
         t = next_token(t.at + t.length, item->end)) {
        if (is_char(t, '(')) {
            add_name(item, before);
            return;
        }
        before = t;
    }
}

// What ended it: a body that followed a parenthesis, or a semicolon.
static void classify(struct item *item, bool body, bool braces, bool assigns)
{
    const struct token first = next_token(item->begin, item->end);
    const char *last = item->end - 1; // the semicolon
    while (last > item->begin && isspace((unsigned char)last[-1]))
        last--;
    if (is_word(first, "struct")) {
        item->kind = STRUCT;
        add_name(item, next_token(first.at + first.length, item->end));
    } else if (body || (!braces && !assigns && last[-1] == ')')) {
        item->kind = FUNCTION; // or a prototype
        name_function(item);
    } else if (braces && !assigns) {
        item->kind = BLOCK;
        name_block(item);
    } else {
        item->kind = VARIABLE;
        item->used = is_word(first, "precision");
        name_variables(item);
    }
}

static struct item *add_item(struct items *items, const char *begin, const char *end)
{
    items->item =
        sb_grow(items->item, items->count, &items->capacity, sizeof *items->item);
    struct item *item = &items->item[items->count++];
    *item = (struct item){.begin = begin, .end = end};
    return item;
}

// One item from `at`, which is its first token; returns where it ends, or NULL where it does not.
static const char *take_item(struct items *items, const char *at, const char *end)
{
    int depth = 0;
    bool braces = false, body = false, assigns = false;
    struct token before = {0};
    for (struct token t = next_token(at, end); t.length > 0;
         t = next_token(t.at + t.length, end)) {
        if (depth == 0 && is_char(t, '{')) {
            braces = true;
            body = is_char(before, ')') && !assigns;
        }
        assigns |= depth == 0 && is_char(t, '=');
        depth += is_char(t, '(') || is_char(t, '[') || is_char(t, '{');
        depth -= is_char(t, ')') || is_char(t, ']') || is_char(t, '}');
        if (depth == 0 && (is_char(t, ';') || (body && is_char(t, '}')))) {
            classify(add_item(items, at, t.at + 1), body, braces, assigns);
            return t.at + 1;
        }
        before = t;
    }
    return NULL;
}

static bool take_items(struct items *items, const char *text)
{
    const char *end = text + strlen(text);
    for (const char *at = text; (at = next_token(at, end).at) < end;) {
        if (*at == '#') {
            const char *stop = at + strcspn(at, "\n");
            struct item *item = add_item(items, at, stop);
            item->kind = DIRECTIVE;
            item->used = true;
            at = stop;
        } else if (!(at = take_item(items, at, end))) {
            return false;
        }
    }
    return true;
}

// --- what is used ------------------------------------------------------------------------------

static void use(struct items *items, struct token name)
{
    for (int i = 0; i < items->count; i++) {
        struct item *item = &items->item[i];
        for (int n = 0; !item->used && n < item->name_count; n++)
            item->used = same_name(item->name[n], name);
    }
}

// Until nothing new is found. There are some hundred items.
static void find_used(struct items *items)
{
    bool *read = sb_alloc((size_t)items->count * sizeof *read);
    use(items, (struct token){"main", 4, true});
    for (bool more = true; more;) {
        more = false;
        for (int i = 0; i < items->count; i++) {
            struct item *item = &items->item[i];
            if (!item->used || read[i])
                continue;
            read[i] = more = true;
            for (struct token t = next_token(item->begin, item->end); t.length > 0;
                 t = next_token(t.at + t.length, item->end))
                if (t.name)
                    use(items, t);
        }
    }
    free(read);
}

// --- calls of nothing ---------------------------------------------------------------------------

// `void name(…) { }`: what a choice leaves of a function that it has no use for.
static bool does_nothing(const struct item *item)
{
    const char *open = memchr(item->begin, '{', (size_t)(item->end - item->begin));
    return item->kind == FUNCTION && open && item->name_count == 1 &&
           is_word(next_token(item->begin, item->end), "void") &&
           is_char(next_token(open + 1, item->end), '}');
}

// Is the line nothing but a call of this function?
static bool calls(const char *line, const char *end, struct token name)
{
    const struct token first = next_token(line, end);
    while (end > line && isspace((unsigned char)end[-1]))
        end--;
    return first.length > 0 && same_name(first, name) && end - line > name.length + 2 &&
           is_char(next_token(first.at + first.length, end), '(') && end[-1] == ';' &&
           end[-2] == ')';
}

static void blank_calls(char *text, struct token name)
{
    for (char *line = text; *line;) {
        char *end = line + strcspn(line, "\n");
        if (calls(line, end, name))
            memset(line, ' ', (size_t)(end - line));
        line = end + (*end == '\n');
    }
}

// A copy of the text in which no line calls a function that does nothing.
static char *without_calls_of_nothing(const char *plain)
{
    struct items items = {0};
    char *text = sb_strdup(plain);
    if (take_items(&items, plain))
        for (int i = 0; i < items.count; i++)
            if (does_nothing(&items.item[i]))
                blank_calls(text, items.item[i].name[0]);
    free(items.item);
    return text;
}

// --- writing ------------------------------------------------------------------------------------

struct output {
    struct sb_text text;
    struct sb_glsl_line *line; // of the old text, one an output line
    int count, capacity;
};

static void end_line(struct output *out, struct sb_glsl_line from)
{
    sb_text_add(&out->text, "\n");
    out->line = sb_grow(out->line, out->count, &out->capacity, sizeof *out->line);
    out->line[out->count++] = from;
}

// " . ", as the preprocessor leaves it, without its blanks.
static void add_tidy(struct sb_text *text, const char *at, const char *end)
{
    while (at < end) {
        const bool dot = end - at > 3 && strncmp(at, " . ", 3) == 0;
        sb_text_add_n(text, dot ? "." : at, 1);
        at += dot ? 3 : 1;
    }
}

static int depth_change(const char *at, const char *end)
{
    int change = 0;
    for (; at < end; at++)
        change += (*at == '{' || *at == '(') - (*at == '}' || *at == ')');
    return change;
}

static void write_item(struct output *out, const struct sb_glsl_source *source,
                       const char *plain, const struct item *item)
{
    int line = 0, depth = 0;
    for (const char *p = plain; p < item->begin; p++)
        line += *p == '\n';
    for (const char *at = item->begin; at < item->end; line++) {
        const char *stop = at + strcspn(at, "\n");
        const char *end = stop < item->end ? stop : item->end;
        while (at < end && isspace((unsigned char)*at))
            at++;
        const int indent = depth - (at < end && *at == '}');
        const struct sb_glsl_line none = {.file = -1, .line = 1};
        if (at < end) {
            sb_text_printf(&out->text, "%*s", 4 * (indent > 0 ? indent : 0), "");
            add_tidy(&out->text, at, end);
            end_line(out, line < source->line_count ? source->line[line] : none);
        }
        depth += depth_change(at, end);
        at = stop + (*stop == '\n');
    }
}

static bool stands_apart(const struct item *item)
{
    return item->kind == FUNCTION || item->kind == STRUCT || item->kind == BLOCK;
}

void sb_glsl_reduce(struct sb_glsl_source *source, const char *plain_text)
{
    char *plain = without_calls_of_nothing(plain_text);
    struct items items = {0};
    struct output out = {0};
    const struct item *before = NULL;
    if (take_items(&items, plain)) {
        find_used(&items);
    } else { // as it is
        items.count = 0;
        add_item(&items, plain, plain + strlen(plain))->used = true;
    }
    for (int i = 0; i < items.count; i++) {
        const struct item *item = &items.item[i];
        if (!item->used)
            continue;
        if (before && (stands_apart(item) || stands_apart(before)))
            end_line(&out, (struct sb_glsl_line){.file = -1, .line = 1});
        write_item(&out, source, plain, item);
        before = item;
    }
    source->text = sb_arena_strdup(&source->arena, sb_text_get(&out.text));
    source->hash = sb_hash(SB_HASH_START, source->text, strlen(source->text));
    source->line_count = out.count;
    source->line =
        sb_arena_alloc(&source->arena, ((size_t)out.count + 1) * sizeof *source->line);
    if (out.count > 0)
        memcpy(source->line, out.line, (size_t)out.count * sizeof *source->line);
    sb_text_free(&out.text);
    free(out.line);
    free(items.item);
    free(plain);
}
