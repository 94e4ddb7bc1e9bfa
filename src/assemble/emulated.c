#include "assemble/emulated.h"

#include <string.h>

#include "base/hash.h"
#include "emulate/emulate.h"

bool sb_is_emulated(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_EMULATE] != SB_EMULATE_NONE;
}

// Rounding works on the bits of floats, which GLSL ES 1.00 cannot get at.
bool sb_decide_emulation(const struct sb_glsl_version *version,
                         const struct sb_variant *variant, struct sb_error *err)
{
    return !sb_is_emulated(variant) || version->number >= 300 ||
           sb_fail(
               err, SB_BAD_INPUT,
               "emulated precision with glsl=100: it has no operations on bits; valid: "
               "glsl=300es, glsl=310es");
}

const struct sb_glsl_version *sb_emulated_source_version(const struct sb_variant *variant)
{
    return sb_glsl_version_of(sb_shadows_want_es310(variant) ? SB_GLSL_310ES
                                                             : SB_GLSL_300ES);
}

static struct sb_emulate_rules rules_of(const struct sb_variant *variant)
{
    const double *value = variant->value;
    return (struct sb_emulate_rules){
        .lowp = value[SB_AXIS_EMULATE] == SB_EMULATE_FIXED10 ? SB_LOWP_FIXED10
                                                             : SB_LOWP_AS_MEDIUMP,
        .saturate = value[SB_AXIS_EMULATE_OVERFLOW] == SB_EMULATE_OVERFLOW_SATURATE,
        .flush = value[SB_AXIS_EMULATE_SUBNORMALS] == SB_EMULATE_SUBNORMALS_FLUSH,
        .towards_zero = value[SB_AXIS_EMULATE_ROUNDING] == SB_EMULATE_ROUNDING_ZERO,
        .allowed_error = value[SB_AXIS_EMULATE_BUILTINS] == SB_EMULATE_BUILTINS_ALLOWED,
    };
}

static void replace(struct sb_glsl_source *source, const char *text)
{
    source->text = sb_arena_strdup(&source->arena, text);
    source->hash = sb_hash(SB_HASH_START, text, strlen(text));
    source->line_count = 1;
    for (const char *p = text; *p; p++)
        source->line_count += *p == '\n';
    source->line =
        sb_arena_alloc(&source->arena, (size_t)source->line_count * sizeof *source->line);
    for (int i = 0; i < source->line_count; i++)
        source->line[i] = (struct sb_glsl_line){.file = -1, .line = i + 1};
}

bool sb_emulate_sources(const struct sb_variant *variant,
                        const struct sb_glsl_version *version,
                        struct sb_glsl_source *vertex, struct sb_glsl_source *fragment,
                        struct sb_error *err)
{
    const struct sb_emulate_params params = {
        .vertex = vertex->text,
        .fragment = fragment->text,
        .rules = rules_of(variant),
        .gles = version->gles,
        .version = (int)version->number,
    };
    struct sb_arena arena = {0};
    struct sb_emulated emulated;
    const bool good = sb_emulate(&params, &arena, &emulated, err);
    if (good) {
        replace(vertex, emulated.vertex);
        replace(fragment, emulated.fragment);
    }
    sb_arena_free(&arena);
    return good;
}
