#include "glsl/rename.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/text.h"

struct token { // an identifier, or one character of punctuation
    const char *at;
    int length;
    int depth;      // of braces around it
    bool in_struct; // between the braces of a struct or an interface block
    bool directive; // on a line that begins with #
    bool word;
};
struct tokens {
    struct token *item;
    int count, capacity;
};
struct names {
    const struct token **item;
    int count, capacity;
};

// --- reading -------------------------------------------------------------------------------------

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static const char *skip_comment(const char *p)
{
    if (p[1] == '/')
        return p + strcspn(p, "\n");
    const char *end = strstr(p + 2, "*/");
    return end ? end + 2 : p + strlen(p);
}

static const char *skip_word(const char *p)
{
    while (is_word(*p))
        p++;
    return p;
}

// A brace at depth 0 that follows `)` opens a function; any other one a struct or a block.
static bool opens_struct(const struct tokens *tokens)
{
    for (int i = tokens->count - 1; i >= 0; i--)
        if (!tokens->item[i].directive)
            return *tokens->item[i].at != ')';
    return true;
}

static void add(struct tokens *tokens, const struct token *token)
{
    tokens->item =
        sb_grow(tokens->item, tokens->count, &tokens->capacity, sizeof *tokens->item);
    tokens->item[tokens->count++] = *token;
}

static void read_tokens(const char *text, struct tokens *tokens)
{
    int depth = 0;
    bool in_struct = false, directive = false, line_start = true;
    for (const char *p = text; *p;) {
        if (*p == '\n') {
            directive &= p > text && p[-1] == '\\';
            line_start = true;
            p++;
        } else if (p[0] == '/' && (p[1] == '/' || p[1] == '*')) {
            p = skip_comment(p);
        } else if (isspace((unsigned char)*p)) {
            p++;
        } else {
            directive |= *p == '#' && line_start;
            line_start = false;
            const bool word = is_word(*p);
            const char *end = word ? skip_word(p) : p + 1;
            if (*p == '{' && !directive && depth++ == 0)
                in_struct = opens_struct(tokens);
            add(tokens, &(struct token){p, (int)(end - p), depth, in_struct, directive,
                                        word && !isdigit((unsigned char)*p)});
            if (*p == '}' && !directive && --depth == 0)
                in_struct = false;
            p = end;
        }
    }
}

// --- choosing ------------------------------------------------------------------------------------

static bool equal(const struct token *a, const struct token *b)
{
    return a->length == b->length && memcmp(a->at, b->at, (size_t)a->length) == 0;
}

static bool is(const struct token *token, const char *word)
{
    return (int)strlen(word) == token->length &&
           memcmp(token->at, word, (size_t)token->length) == 0;
}

static bool has(const struct names *names, const struct token *token)
{
    for (int i = 0; i < names->count; i++)
        if (equal(names->item[i], token))
            return true;
    return false;
}

static void add_name(struct names *names, const struct token *token)
{
    if (has(names, token))
        return;
    names->item =
        sb_grow(names->item, names->count, &names->capacity, sizeof(struct token *));
    names->item[names->count++] = token;
}

// What may stand before a name without declaring it, or stand where a name would.
static bool is_keyword(const struct token *token)
{
    static const char *const words[] = {
        "return", "else",   "do",        "in",     "out",     "inout", "if",
        "for",    "while",  "case",      "main",   "void",    "float", "int",
        "uint",   "bool",   "vec2",      "vec3",   "vec4",    "mat2",  "mat3",
        "mat4",   "struct", "precision", "layout", "defined",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (is(token, words[i]))
            return true;
    return false;
}

static bool is_char(const struct tokens *tokens, int i, const char *set)
{
    return i >= 0 && i < tokens->count && !tokens->item[i].word &&
           strchr(set, *tokens->item[i].at);
}

// `type name` in front of `(` outside of braces, or of one of `= ; , ) [ :` within a function or a
// list of parameters. Conservative: a declaration that it does not see keeps its name.
static void find_declared(const struct tokens *tokens, struct names *functions,
                          struct names *others)
{
    int parentheses = 0;
    for (int i = 0; i < tokens->count; i++) {
        const struct token *token = &tokens->item[i];
        parentheses += is_char(tokens, i, "(");
        parentheses -= is_char(tokens, i, ")");
        if (i == 0 || token->directive || !token->word || is_keyword(token) ||
            !tokens->item[i - 1].word || is(&tokens->item[i - 1], "return") ||
            is(&tokens->item[i - 1], "else") || token->in_struct)
            continue;
        if (token->depth == 0 && parentheses == 0 && is_char(tokens, i + 1, "("))
            add_name(functions, token);
        else if ((token->depth > 0 || parentheses > 0) &&
                 is_char(tokens, i + 1, "=;,)[:"))
            add_name(others, token);
    }
}

// What must keep its name: declared outside of functions, in structs, or behind a dot; what a
// directive defines; what is called without being defined here; all of a text that pastes names.
static void find_kept(const struct tokens *tokens, const struct names *functions,
                      struct names *kept)
{
    int parentheses = 0;
    for (int i = 0; i < tokens->count; i++) {
        const struct token *token = &tokens->item[i];
        parentheses += !token->directive && is_char(tokens, i, "(");
        parentheses -= !token->directive && is_char(tokens, i, ")");
        if (!token->word)
            continue;
        const bool behind_define = i > 0 && is(&tokens->item[i - 1], "define");
        const bool called = is_char(tokens, i + 1, "(") && !has(functions, token);
        const bool global = !token->directive && token->depth == 0 && parentheses == 0 &&
                            !has(functions, token);
        if (is_char(tokens, i - 1, ".") || token->in_struct || behind_define || called ||
            global || strncmp(token->at, "gl_", 3) == 0)
            add_name(kept, token);
    }
}

char *sb_glsl_rename(const char *text)
{
    struct tokens tokens = {0};
    struct names functions = {0}, others = {0}, kept = {0};
    struct sb_text out = {0};
    const char *done = text;
    read_tokens(text, &tokens);
    find_declared(&tokens, &functions, &others);
    find_kept(&tokens, &functions, &kept);
    const bool pastes = strstr(text, "##") != NULL;
    for (int i = 0; i < tokens.count && !pastes; i++) {
        const struct token *token = &tokens.item[i];
        if (!token->word || has(&kept, token) ||
            (!has(&functions, token) && !has(&others, token)))
            continue;
        sb_text_add_n(&out, done, (size_t)(token->at - done));
        sb_text_add(&out, "r_");
        done = token->at;
    }
    sb_text_add(&out, done);
    free(tokens.item);
    free(functions.item);
    free(others.item);
    free(kept.item);
    return out.data ? out.data : sb_strdup("");
}
