#include "emulate/write.h"

#include <spirv_cross_c.h>

static bool set_options(spvc_compiler compiler, bool gles, int version)
{
    spvc_compiler_options options;
    return spvc_compiler_create_compiler_options(compiler, &options) == SPVC_SUCCESS &&
           spvc_compiler_options_set_uint(options, SPVC_COMPILER_OPTION_GLSL_VERSION,
                                          (unsigned)version) == SPVC_SUCCESS &&
           spvc_compiler_options_set_bool(options, SPVC_COMPILER_OPTION_GLSL_ES, gles) ==
               SPVC_SUCCESS &&
           spvc_compiler_options_set_bool(
               options, SPVC_COMPILER_OPTION_GLSL_ES_DEFAULT_FLOAT_PRECISION_HIGHP,
               SPVC_TRUE) == SPVC_SUCCESS &&
           spvc_compiler_options_set_bool(
               options, SPVC_COMPILER_OPTION_GLSL_ES_DEFAULT_INT_PRECISION_HIGHP,
               SPVC_TRUE) == SPVC_SUCCESS &&
           spvc_compiler_options_set_bool(
               options, SPVC_COMPILER_OPTION_GLSL_ENABLE_420PACK_EXTENSION, SPVC_FALSE) ==
               SPVC_SUCCESS &&
           spvc_compiler_install_compiler_options(compiler, options) == SPVC_SUCCESS;
}

// Core from GLSL 4.00 and GLSL ES 3.20 on; SPIRV-Cross does not ask for it. A driver may know either
// extension of ES, and only warns of the other.
static bool ask_for_cube_arrays(spvc_compiler compiler, bool gles, int version)
{
    static const char *const lines[] = {
        "#extension GL_ARB_texture_cube_map_array : enable",
        "#extension GL_EXT_texture_cube_map_array : enable",
        "#extension GL_OES_texture_cube_map_array : enable",
    };
    const SpvCapability *capability = NULL;
    size_t count = 0;
    bool good = spvc_compiler_get_declared_capabilities(compiler, &capability, &count) ==
                SPVC_SUCCESS;
    bool used = false;
    for (size_t i = 0; i < count; i++)
        used |= capability[i] == SpvCapabilitySampledCubeArray;
    if (!used || version >= (gles ? 320 : 400))
        return good;
    for (int i = gles ? 1 : 0; i < (gles ? 3 : 1); i++)
        good &= spvc_compiler_add_header_line(compiler, lines[i]) == SPVC_SUCCESS;
    return good;
}

bool sb_spirv_write(const struct sb_spirv *spirv, bool gles, int version,
                    struct sb_text *text, struct sb_error *err)
{
    spvc_context context;
    spvc_parsed_ir ir;
    spvc_compiler compiler;
    const char *source = NULL;
    if (spvc_context_create(&context) != SPVC_SUCCESS)
        return sb_fail(err, SB_INTERNAL, "SPIRV-Cross gives no context");
    const bool good = spvc_context_parse_spirv(context, spirv->word, spirv->count, &ir) ==
                          SPVC_SUCCESS &&
                      spvc_context_create_compiler(context, SPVC_BACKEND_GLSL, ir,
                                                   SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                                   &compiler) == SPVC_SUCCESS &&
                      set_options(compiler, gles, version) &&
                      ask_for_cube_arrays(compiler, gles, version) &&
                      spvc_compiler_compile(compiler, &source) == SPVC_SUCCESS;
    if (good)
        sb_text_add(text, source);
    else
        sb_fail(err, SB_COMPILE_FAILED, "in GLSL %d%s: %s", version, gles ? " es" : "",
                spvc_context_get_last_error_string(context));
    spvc_context_destroy(context);
    return good;
}
