#include "emulate/compile.h"

#include <string.h>

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>

// The first line that is an error; warnings may come before it.
static void fail_with(const char *log, bool fragment, struct sb_error *err)
{
    const char *line = strstr(log, "ERROR:");
    if (!line)
        line = log;
    sb_fail(err, SB_COMPILE_FAILED, "%s shader: %.*s", fragment ? "fragment" : "vertex",
            (int)strcspn(line, "\n"), line);
}

static glslang_input_t input_of(const char *source, bool fragment, bool spirv)
{
    return (glslang_input_t){
        .language = GLSLANG_SOURCE_GLSL,
        .stage = fragment ? GLSLANG_STAGE_FRAGMENT : GLSLANG_STAGE_VERTEX,
        .client = spirv ? GLSLANG_CLIENT_OPENGL : GLSLANG_CLIENT_NONE,
        .client_version = GLSLANG_TARGET_OPENGL_450,
        .target_language = spirv ? GLSLANG_TARGET_SPV : GLSLANG_TARGET_NONE,
        .target_language_version = GLSLANG_TARGET_SPV_1_0,
        .code = source,
        .default_version = 100,
        .default_profile = GLSLANG_ES_PROFILE,
        .messages = spirv ? GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_KEEP_UNCALLED_BIT
                          : GLSLANG_MSG_DEFAULT_BIT,
        .resource = glslang_default_resource(),
    };
}

char *sb_source_preprocess(const char *source, bool fragment, struct sb_arena *arena,
                           struct sb_error *err)
{
    // Counted by glslang and never undone: its tables of built-ins, which take longer to make
    // than a program to compile, would go with the last user.
    glslang_initialize_process();
    const glslang_input_t input = input_of(source, fragment, false);
    glslang_shader_t *shader = glslang_shader_create(&input);
    char *text = NULL;
    if (glslang_shader_preprocess(shader, &input))
        text = sb_arena_strdup(arena, glslang_shader_get_preprocessed_code(shader));
    else
        fail_with(glslang_shader_get_info_log(shader), fragment, err);
    glslang_shader_delete(shader);
    return text;
}

static bool link(glslang_program_t *program, glslang_stage_t stage, bool fragment,
                 struct sb_arena *arena, struct sb_spirv *spirv, struct sb_error *err)
{
    glslang_spv_options_t options = {.disable_optimizer = true};
    if (!glslang_program_link(program, GLSLANG_MSG_SPV_RULES_BIT |
                                           GLSLANG_MSG_KEEP_UNCALLED_BIT)) {
        fail_with(glslang_program_get_info_log(program), fragment, err);
        return false;
    }
    // No glslang_program_map_io: it would give locations and bindings to all.
    glslang_program_SPIRV_generate_with_options(program, stage, &options);
    spirv->count = glslang_program_SPIRV_get_size(program);
    spirv->word = sb_arena_alloc(arena, spirv->count * sizeof *spirv->word);
    glslang_program_SPIRV_get(program, spirv->word);
    return true;
}

bool sb_spirv_compile(const char *source, bool fragment, struct sb_arena *arena,
                      struct sb_spirv *spirv, struct sb_error *err)
{
    glslang_initialize_process();
    const glslang_input_t input = input_of(source, fragment, true);
    glslang_shader_t *shader = glslang_shader_create(&input);
    glslang_program_t *program = glslang_program_create();
    glslang_shader_set_options(shader, GLSLANG_SHADER_AUTO_MAP_BINDINGS |
                                           GLSLANG_SHADER_AUTO_MAP_LOCATIONS);
    bool good =
        glslang_shader_preprocess(shader, &input) && glslang_shader_parse(shader, &input);
    if (good) {
        glslang_program_add_shader(program, shader);
        good = link(program, input.stage, fragment, arena, spirv, err);
    } else {
        fail_with(glslang_shader_get_info_log(shader), fragment, err);
    }
    glslang_program_delete(program);
    glslang_shader_delete(shader);
    return good;
}
