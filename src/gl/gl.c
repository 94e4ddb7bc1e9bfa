#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl/gl.h"

const char *sb_gl_error(void)
{
    static const struct {
        GLenum code;
        const char *word;
    } words[] = {
        {GL_INVALID_ENUM, "GL_INVALID_ENUM"},
        {GL_INVALID_VALUE, "GL_INVALID_VALUE"},
        {GL_INVALID_OPERATION, "GL_INVALID_OPERATION"},
        {GL_INVALID_FRAMEBUFFER_OPERATION, "GL_INVALID_FRAMEBUFFER_OPERATION"},
        {GL_OUT_OF_MEMORY, "GL_OUT_OF_MEMORY"},
        {GL_CONTEXT_LOST, "GL_CONTEXT_LOST"},
    };
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR)
        return NULL;
    // There may be one flag for each part of a distributed implementation (GL 4.6 core,
    // 2.3.1), hence the loop; a lost context may report for ever, hence the bound.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; i++)
        ;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (words[i].code == first)
            return words[i].word;
    return "an unknown GL error";
}

void sb_gl_drain(void)
{
    GLint framebuffer, type = GL_NONE;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &framebuffer);
    if (framebuffer != 0)
        glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                              GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE,
                                              &type);
    // The pairs of format and type that GLES 3.0 (4.3.2) grants for each kind of buffer.
    GLuint pixel[4];
    if (type == GL_UNSIGNED_INT)
        glReadPixels(0, 0, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, pixel);
    else if (type == GL_FLOAT)
        glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, pixel);
    else if (type == GL_UNSIGNED_NORMALIZED)
        glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    glFinish();
}

static bool has_extension(const char *name)
{
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++)
        if (strcmp((const char *)glGetStringi(GL_EXTENSIONS, (GLuint)i), name) == 0)
            return true;
    return false;
}

static int64_t limit(GLenum name)
{
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return value;
}

static int64_t counter_bits(GLenum target)
{
    GLint bits = 0;
    glGetQueryiv(target, GL_QUERY_COUNTER_BITS, &bits);
    return bits;
}

// Tried, not looked up: float formats came to GLES by three extensions and a core
// version.
static bool can_draw_to(GLenum format)
{
    GLuint framebuffer, colour;
    glGenFramebuffers(1, &framebuffer);
    glGenRenderbuffers(1, &colour);
    glBindRenderbuffer(GL_RENDERBUFFER, colour);
    glRenderbufferStorage(GL_RENDERBUFFER, format, 1, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              colour);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &colour);
    return status == GL_FRAMEBUFFER_COMPLETE && !sb_gl_error();
}

static void get_text(char *text, size_t size, GLenum name)
{
    const char *value = (const char *)glGetString(name);
    snprintf(text, size, "%s", value ? value : "");
}

// "4.50", "3.30 NVIDIA via Cg compiler", "OpenGL ES GLSL ES 3.20": 450, 330, 320.
static int glsl_number(const char *version)
{
    while (*version && !isdigit((unsigned char)*version))
        version++;
    char *rest;
    const long major = strtol(version, &rest, 10);
    const long minor = *rest == '.' ? strtol(rest + 1, NULL, 10) : 0;
    return (int)(major * 100 + minor);
}

static void get_limits(struct sb_caps *caps)
{
    caps->vertex_uniform_components = limit(GL_MAX_VERTEX_UNIFORM_COMPONENTS);
    caps->fragment_uniform_components = limit(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS);
    caps->uniform_block_size = limit(GL_MAX_UNIFORM_BLOCK_SIZE);
    caps->varying_components = limit(GL_MAX_VARYING_COMPONENTS);
    caps->texture_units = limit(GL_MAX_TEXTURE_IMAGE_UNITS);
    caps->combined_texture_units = limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    caps->texture_size = limit(GL_MAX_TEXTURE_SIZE);
    caps->cube_map_size = limit(GL_MAX_CUBE_MAP_TEXTURE_SIZE);
    caps->array_layers = limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
    caps->renderbuffer_size = limit(GL_MAX_RENDERBUFFER_SIZE);
    caps->samples = limit(GL_MAX_SAMPLES);
    caps->colour_float = can_draw_to(GL_RGBA32F);
    caps->colour_half = can_draw_to(GL_RGBA16F);
}

static void get_features(bool gles, struct sb_caps *caps)
{
    caps->disjoint = GLAD_GL_EXT_disjoint_timer_query != 0;
    if (!gles || caps->disjoint) {
        caps->elapsed_bits = counter_bits(GL_TIME_ELAPSED);
        caps->timestamp_bits = counter_bits(GL_TIMESTAMP);
    }
    // OpenGL ES tells only whether any sample passed.
    caps->samples_passed = !gles && counter_bits(GL_SAMPLES_PASSED) > 0;
    if (glGetProgramBinary)
        caps->program_binary = limit(GL_NUM_PROGRAM_BINARY_FORMATS);
    caps->geometry_shader = !gles || caps->api_version >= 320 ||
                            has_extension("GL_OES_geometry_shader") ||
                            has_extension("GL_EXT_geometry_shader");
    caps->cube_map_array = caps->api_version >= (gles ? 320 : 400) ||
                           has_extension("GL_ARB_texture_cube_map_array") ||
                           has_extension("GL_OES_texture_cube_map_array") ||
                           has_extension("GL_EXT_texture_cube_map_array");
}

bool sb_gl_load(void (*(*proc)(void *self, const char *name))(void), void *self,
                bool gles, struct sb_caps *caps, struct sb_error *err)
{
    const int version =
        gles ? gladLoadGLES2UserPtr(proc, self) : gladLoadGLUserPtr(proc, self);
    const int major = GLAD_VERSION_MAJOR(version), minor = GLAD_VERSION_MINOR(version);
    caps->gles = gles;
    caps->api_version = major * 100 + minor * 10;
    if (caps->api_version < (gles ? 300 : 330))
        return sb_fail(err, SB_NO_GL, "the context has %s %d.%d; %s or newer is needed",
                       gles ? "OpenGL ES" : "OpenGL", major, minor, gles ? "3.0" : "3.3");
    get_text(caps->vendor, sizeof caps->vendor, GL_VENDOR);
    get_text(caps->renderer, sizeof caps->renderer, GL_RENDERER);
    get_text(caps->version, sizeof caps->version, GL_VERSION);
    get_text(caps->glsl_version, sizeof caps->glsl_version, GL_SHADING_LANGUAGE_VERSION);
    caps->glsl = glsl_number(caps->glsl_version);
    get_limits(caps);
    get_features(gles, caps);
    const char *error = sb_gl_error();
    if (error)
        return sb_fail(err, SB_GL_ERROR, "%s when asking %s for its limits", error,
                       caps->renderer);
    return true;
}
