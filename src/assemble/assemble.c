#include "assemble/assemble.h"

#include <string.h>

#include "assemble/decide.h"
#include "base/file.h"
#include "base/hash.h"
#include "effects/effects.h"

struct defines {
    struct sb_glsl_define row[SB_AXIS_MAX + SB_EFFECT_COUNT + 1];
    int count;
    struct sb_arena *arena;
};

static bool same_name(const char *a, const char *b)
{
    const size_t length = strcspn(a, "("); // of a macro with a parameter, the name
    return length == strcspn(b, "(") && !strncmp(a, b, length);
}

// A second #define of a name is an error in some drivers and a warning in others, and they
// differ in which value counts.
static bool add_define(struct defines *defines, const char *name, const char *value,
                       struct sb_error *err)
{
    for (int i = 0; i < defines->count; i++)
        if (same_name(defines->row[i].name, name))
            return sb_fail(err, SB_BAD_INPUT,
                           "define %s: the name is taken; another one is valid", name);
    defines->row[defines->count++] = (struct sb_glsl_define){name, value};
    return true;
}

// A GLSL literal: a float needs a dot or an exponent, and a minus sign parentheses, so that
// `x-BEND` does not become a decrement.
static const char *number_literal(struct sb_arena *arena, double value, bool whole)
{
    char number[32];
    sb_number_text(value, number);
    const bool bare = !whole && !strpbrk(number, ".e");
    return sb_arena_printf(arena, value < 0 ? "(%s%s)" : "%s%s", number,
                           bare ? ".0" : "");
}

static const char *axis_literal(struct sb_arena *arena, const struct sb_axis *axis,
                                double value)
{
    if (!axis->values)
        return number_literal(arena, value, axis->flags & SB_WHOLE);
    const char *text = axis->values[(int)value].text;
    return *text ? text : number_literal(arena, value, true);
}

static bool add_defines(struct defines *defines, const struct sb_axes *axes,
                        const struct sb_variant *variant, const char *family,
                        struct sb_error *err)
{
    if (!add_define(defines, "GLSL_FAMILY", family, err))
        return false;
    const uint32_t effects = sb_effects_of(axes, variant);
    for (int i = 0; i < SB_EFFECT_COUNT; i++) {
        const char *name =
            sb_arena_printf(defines->arena, "%s(code)", sb_effect_rows[i].macro);
        if (!add_define(defines, name, effects >> i & 1 ? "code" : "", err))
            return false;
    }
    for (int i = 0; i < axes->count; i++) {
        const struct sb_axis *axis = &axes->row[i];
        if (*axis->define &&
            !add_define(defines, axis->define,
                        axis_literal(defines->arena, axis, variant->value[i]), err))
            return false;
    }
    return true;
}

static bool check_api(const struct sb_variant *variant, const struct sb_caps *caps,
                      struct sb_error *err)
{
    const bool gles = variant->value[SB_AXIS_API] == SB_API_GLES;
    if (gles == (caps->gles != 0))
        return true;
    return sb_fail(err, SB_BAD_INPUT, "api=%s: the context is %s; valid here: %s",
                   gles ? "gles" : "gl", caps->gles ? "OpenGL ES" : "desktop OpenGL",
                   caps->gles ? "gles" : "gl");
}

static bool build(const struct sb_assemble_params *params, const char *version,
                  const struct defines *defines, struct sb_assembly *assembly,
                  struct sb_error *err)
{
    struct sb_glsl_params glsl = {
        .root = params->shaders
                    ? params->shaders
                    : sb_path_join(&assembly->arena, params->data_dir, "shaders"),
        .file = "shade.vert",
        .version = version,
        .define = defines->row,
        .define_count = defines->count,
    };
    if (!sb_glsl_build(&glsl, &assembly->vertex, err))
        return false;
    glsl.file = "shade.frag";
    if (!sb_glsl_build(&glsl, &assembly->fragment, err))
        return false;
    const uint64_t both[] = {assembly->vertex.hash, assembly->fragment.hash};
    assembly->source_hash = sb_hash(SB_HASH_START, both, sizeof both);
    return true;
}

bool sb_assemble(const struct sb_assemble_params *params, struct sb_assembly *assembly,
                 struct sb_error *err)
{
    struct sb_variant *variant = &assembly->job.variant;
    *variant = *params->variant;
    if (!check_api(variant, params->caps, err))
        return false;
    const struct sb_glsl_version *version =
        sb_decide_version(params->axes, params->caps, variant, err);
    if (!version || !sb_decide_storage(params->axes, params->caps, variant, err))
        return false;

    struct defines defines = {.arena = &assembly->arena};
    if (!add_defines(&defines, params->axes, variant, version->family, err) ||
        !build(params, version->text, &defines, assembly, err))
        return false;
    assembly->program[0] = (struct sb_program){
        .role = "shade",
        .vertex = assembly->vertex.text,
        .fragment = assembly->fragment.text,
    };
    assembly->lit_per_vertex = variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    assembly->job.id = params->id;
    assembly->job.scene = sb_arena_strdup(&assembly->arena, params->scene);
    assembly->job.program = assembly->program;
    assembly->job.program_count = 1;
    return true;
}

void sb_assembly_free(struct sb_assembly *assembly)
{
    sb_glsl_free(&assembly->vertex);
    sb_glsl_free(&assembly->fragment);
    sb_arena_free(&assembly->arena);
    memset(assembly, 0, sizeof *assembly);
}

void sb_assembly_explain(const struct sb_assembly *assembly,
                         const struct sb_prepared *prepared, struct sb_text *text)
{
    const char *log = prepared->log ? prepared->log : "";
    switch (prepared->failed_stage) {
    case SB_STAGE_VERT:
        sb_glsl_explain(&assembly->vertex, log, text);
        break;
    case SB_STAGE_FRAG:
        sb_glsl_explain(&assembly->fragment, log, text);
        break;
    case SB_STAGE_LINK: // speaks of both stages, by name
        sb_text_add(text, log);
        break;
    }
}

void sb_caps_ideal(bool gles, struct sb_caps *caps)
{
    *caps = (struct sb_caps){
        .context = "null",
        .vendor = "none",
        .renderer = "ideal",
        .gles = gles,
        .api_version = gles ? 320 : 460,
        .glsl = gles ? 320 : 460,
        .vertex_uniform_components = 65536,
        .fragment_uniform_components = 65536,
        .uniform_block_size = 65536,
        .varying_components = 128,
        .texture_units = 32,
        .texture_size = 16384,
        .renderbuffer_size = 16384,
        .samples = 32,
        .colour_float = 1,
        .colour_half = 1,
        .elapsed_bits = 64,
        .timestamp_bits = 64,
        .disjoint = gles,
        .samples_passed = !gles,
        .program_binary = 1,
        .geometry_shader = 1,
        .cube_map_array = 1,
    };
}
