#include "emulate/source.h"

#include <stdlib.h>
#include <string.h>

#include "emulate/rename.h"

static const char word_letters[] =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

static bool is_word(const char *text, size_t length, const char *word)
{
    return length == strlen(word) && strncmp(text, word, length) == 0;
}

// Steps over one word, or over the characters up to the next one. The length.
static size_t step(const char *text, bool *word)
{
    const size_t length = strspn(text, word_letters);
    *word = length > 0;
    return length ? length : strcspn(text, word_letters);
}

void sb_source_swap(const char *text, const char *from, const char *to,
                    struct sb_text *out)
{
    bool word;
    for (size_t length; *text; text += length) {
        length = step(text, &word);
        if (word && is_word(text, length, from))
            sb_text_add(out, to);
        else
            sb_text_add_n(out, text, length);
    }
}

// GLSL ES 3.00 has no way to SPIR-V, and is a part of 3.10. What hangs on __VERSION__ is decided
// by now.
static const char *raise_version(const char *text, struct sb_text *out,
                                 struct sb_error *err)
{
    static const char directive[] = "#version";
    const char *line = strstr(text, directive);
    char *rest = NULL;
    const long version = line ? strtol(line + strlen(directive), &rest, 10) : 0;
    const size_t length = line ? strcspn(line, "\n") : 0;
    if ((version != 300 && version != 310) || !memchr(line, 'e', length)) {
        sb_fail(err, SB_COMPILE_FAILED,
                "only shaders of #version 300 es and 310 es can be emulated");
        return NULL;
    }
    sb_text_add_n(out, text, (size_t)(line - text));
    sb_text_add(out, "#version 310 es");
    return line + length;
}

static void keep_shared(struct sb_source *read, struct sb_arena *arena, const char *name,
                        size_t length)
{
    if (read->shared_count < SB_SHARED_BLOCKS)
        read->shared[read->shared_count++] =
            sb_arena_printf(arena, "%.*s", (int)length, name);
}

// layout(shared) uniform NAME: std140, which is one of the ways to lay out a shared block.
static void replace_shared(const char *text, struct sb_source *read,
                           struct sb_arena *arena, struct sb_text *out)
{
    bool word, shared = false, uniform = false;
    for (size_t length; *text; text += length) {
        length = step(text, &word);
        if (word && is_word(text, length, "shared")) {
            shared = true;
            sb_text_add(out, "std140");
            continue;
        }
        sb_text_add_n(out, text, length);
        read->bindings |= word && is_word(text, length, "binding");
        if (!word && memchr(text, ';', length))
            shared = uniform = false;
        if (word && uniform) {
            keep_shared(read, arena, text, length);
            shared = uniform = false;
        }
        if (word && shared && is_word(text, length, "uniform"))
            uniform = true;
    }
}

bool sb_source_read(const char *source, bool fragment, struct sb_arena *arena,
                    struct sb_source *read, struct sb_error *err)
{
    struct sb_text text = {0};
    *read = (struct sb_source){0};
    const char *plain = sb_source_preprocess(source, fragment, arena, err);
    const char *rest = plain ? raise_version(plain, &text, err) : NULL;
    if (rest) {
        replace_shared(rest, read, arena, &text);
        read->text = sb_arena_strdup(arena, sb_text_get(&text));
    }
    sb_text_free(&text);
    return rest;
}

static bool is_shared(const struct sb_source *read, const char *name)
{
    const size_t length = strspn(name, word_letters);
    for (int i = 0; i < read->shared_count; i++)
        if (is_word(name, length, read->shared[i]))
            return true;
    return false;
}

// At "layout(std140) uniform NAME" of a block that was shared.
static bool begins_shared(const struct sb_source *read, const char *text)
{
    static const char uniform[] = " uniform ";
    const char *line_end = text + strcspn(text, "\n");
    const char *name = strstr(text, uniform);
    return name && name < line_end && is_shared(read, name + strlen(uniform));
}

void sb_source_restore(const struct sb_source *read, const char *text,
                       struct sb_text *out)
{
    bool word;
    for (size_t length; *text; text += length) {
        length = step(text, &word);
        if (word && is_word(text, length, "std140") && begins_shared(read, text)) {
            sb_text_add(out, "shared");
        } else if (word &&
                   strncmp(text, SB_UNNAMED_BLOCK, strlen(SB_UNNAMED_BLOCK)) == 0) {
            length += text[length] == '.'; // "} NAME;" and "NAME.member"
        } else {
            sb_text_add_n(out, text, length);
        }
    }
}
