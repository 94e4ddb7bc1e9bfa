#include "emulate/emulate.h"

#include <string.h>

#include "emulate/helpers.h"
#include "emulate/round.h"
#include "emulate/source.h"
#include "emulate/write.h"

// Behind the directives, which must come first.
static const char *first_declaration(const char *text)
{
    for (;;) {
        const char *line = text + strspn(text, " \t\n");
        if (*line != '#')
            return line;
        text = line + strcspn(line, "\n");
    }
}

// With highp for mediump, said or, of integers in fragment shaders, unsaid (GLSL ES 3.00, 4.5.4):
// what is still relaxed then is lowp.
static bool compile_lowp(const char *source, bool fragment, struct sb_arena *arena,
                         struct sb_spirv *spirv, struct sb_error *err)
{
    struct sb_text text = {0};
    const char *declarations = first_declaration(source);
    sb_text_add_n(&text, source, (size_t)(declarations - source));
    sb_text_add(&text, "precision highp int;\n");
    sb_source_swap(declarations, "mediump", "highp", &text);
    const bool good = sb_spirv_compile(sb_text_get(&text), fragment, arena, spirv, err);
    sb_text_free(&text);
    return good;
}

static bool read_module(const struct sb_source *source, bool fragment,
                        const struct sb_emulate_rules *rules, struct sb_arena *arena,
                        struct sb_module *module, struct sb_error *err)
{
    struct sb_text text = {0};
    struct sb_spirv spirv, lowp;
    const bool with_lowp = rules->lowp == SB_LOWP_FIXED10;
    sb_text_add(&text, source->text);
    sb_text_add(&text, "\n");
    sb_emulate_helpers(rules, &text);
    const char *whole = sb_text_get(&text);
    const bool good =
        sb_spirv_compile(whole, fragment, arena, &spirv, err) &&
        (!with_lowp || compile_lowp(whole, fragment, arena, &lowp, err)) &&
        sb_module_read(&spirv, with_lowp ? &lowp : NULL, arena, module, err);
    sb_text_free(&text);
    return good;
}

// `scratch` holds what is needed on the way only. NULL: failed.
static const char *emulate_stage(const struct sb_emulate_params *params, bool fragment,
                                 struct sb_arena *arena, struct sb_arena *scratch,
                                 int *rounded, struct sb_error *err)
{
    struct sb_source source;
    struct sb_module module;
    struct sb_rounding rounding;
    if (!sb_source_read(fragment ? params->fragment : params->vertex, fragment, scratch,
                        &source, err) ||
        !read_module(&source, fragment, &params->rules, scratch, &module, err))
        return NULL;
    sb_module_round(&module, source.bindings, scratch, &rounding);
    *rounded += rounding.rounded;
    struct sb_text written = {0}, restored = {0};
    const char *text = NULL;
    if (sb_spirv_write(&rounding.spirv, params->gles, params->version, &written, err)) {
        sb_source_restore(&source, sb_text_get(&written), &restored);
        text = sb_arena_strdup(arena, sb_text_get(&restored));
    }
    sb_text_free(&written);
    sb_text_free(&restored);
    return text;
}

bool sb_emulate(const struct sb_emulate_params *params, struct sb_arena *arena,
                struct sb_emulated *emulated, struct sb_error *err)
{
    struct sb_arena scratch = {0};
    *emulated = (struct sb_emulated){0};
    emulated->vertex =
        emulate_stage(params, false, arena, &scratch, &emulated->rounded, err);
    if (emulated->vertex)
        emulated->fragment =
            emulate_stage(params, true, arena, &scratch, &emulated->rounded, err);
    sb_arena_free(&scratch);
    return emulated->fragment;
}
