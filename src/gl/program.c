#include <stdlib.h>

#include "base/clock.h"
#include "base/hash.h"
#include "base/mem.h"
#include "gl/program.h"

static char *info_log(GLuint object, void(GLAD_API_PTR *get_iv)(GLuint, GLenum, GLint *),
                      void(GLAD_API_PTR *get_log)(GLuint, GLsizei, GLsizei *, GLchar *))
{
    GLint length = 0;
    get_iv(object, GL_INFO_LOG_LENGTH, &length);
    if (length <= 1)
        return sb_strdup("the driver gave no log");
    char *log = sb_alloc((size_t)length + 1);
    get_log(object, length, NULL, log);
    return log;
}

static GLuint compile(GLenum kind, const char *source, enum sb_failed_stage stage,
                      struct sb_gl_program *program)
{
    const int64_t start = sb_clock_ns();
    const GLuint shader = glCreateShader(kind);
    GLint done = GL_FALSE;
    if (shader == 0) { // GL_INVALID_ENUM: geometry shaders, where there are none
        sb_gl_error();
        program->failed_stage = stage;
        program->log = sb_strdup("the driver has no shaders of this stage");
        return 0;
    }
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    // Asking for the status waits for the compiler.
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    program->compile_ms += (double)(sb_clock_ns() - start) / 1e6;
    if (done)
        return shader;
    program->failed_stage = stage;
    program->log = info_log(shader, glGetShaderiv, glGetShaderInfoLog);
    glDeleteShader(shader);
    return 0;
}

const char *const sb_gl_attributes[SB_GL_ATTRIBUTES] = {"a_position", "a_normal", "a_uv",
                                                        "a_tangent"};

unsigned char *sb_gl_program_binary(GLuint name, GLenum *format, size_t *size)
{
    GLint formats = 0, room = 0;
    if (!glGetProgramBinary)
        return NULL;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats > 0)
        glGetProgramiv(name, GL_PROGRAM_BINARY_LENGTH, &room);
    if (room <= 0)
        return NULL;
    unsigned char *binary = sb_alloc((size_t)room);
    GLsizei length = 0;
    glGetProgramBinary(name, room, &length, format, binary);
    *size = (size_t)length;
    if (length > 0)
        return binary;
    free(binary);
    return NULL;
}

static uint64_t hash_binary(GLuint name)
{
    GLenum format = 0;
    size_t size = 0;
    unsigned char *binary = sb_gl_program_binary(name, &format, &size);
    const uint64_t hash = binary ? sb_hash(SB_HASH_START, binary, size) : 0;
    free(binary);
    return hash;
}

struct captured { // by transform feedback
    const char *const *varying;
    int count; // 0: nothing is
};

static bool link_program(const GLuint *shader, int count, const struct captured *captured,
                         struct sb_gl_program *program)
{
    const int64_t start = sb_clock_ns();
    const GLuint name = glCreateProgram();
    GLint done = GL_FALSE;
    for (int i = 0; i < count; i++)
        glAttachShader(name, shader[i]);
    for (GLuint i = 0; i < SB_GL_ATTRIBUTES; i++)
        glBindAttribLocation(name, i, sb_gl_attributes[i]);
    if (captured->count > 0)
        glTransformFeedbackVaryings(name, captured->count, captured->varying,
                                    GL_INTERLEAVED_ATTRIBS);
    if (glGetProgramBinary)
        glProgramParameteri(name, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(name);
    glGetProgramiv(name, GL_LINK_STATUS, &done);
    program->link_ms = (double)(sb_clock_ns() - start) / 1e6;
    if (!done) {
        program->failed_stage = SB_STAGE_LINK;
        program->log = info_log(name, glGetProgramiv, glGetProgramInfoLog);
        glDeleteProgram(name);
        return false;
    }
    for (int i = 0; i < count; i++)
        glDetachShader(name, shader[i]);
    program->name = name;
    program->binary_hash = hash_binary(name);
    return true;
}

bool sb_gl_program_make(const struct sb_program *source, struct sb_gl_program *program)
{
    return sb_gl_program_make_captured(source, NULL, 0, program);
}

bool sb_gl_program_make_captured(const struct sb_program *source,
                                 const char *const *varying, int varying_count,
                                 struct sb_gl_program *program)
{
    const struct captured captured = {varying, varying_count};
    const struct {
        GLenum kind;
        enum sb_failed_stage stage;
        const char *source;
    } stages[] = {
        {GL_VERTEX_SHADER, SB_STAGE_VERT, source->vertex},
        {GL_GEOMETRY_SHADER, SB_STAGE_GEOM, source->geometry},
        {GL_FRAGMENT_SHADER, SB_STAGE_FRAG, source->fragment},
    };
    GLuint shader[sizeof stages / sizeof *stages];
    int count = 0;
    bool ok = true;
    *program = (struct sb_gl_program){0};
    if (GLAD_GL_KHR_parallel_shader_compile)
        glMaxShaderCompilerThreadsKHR(0);
    for (size_t i = 0; ok && i < sizeof stages / sizeof *stages; i++) {
        if (!stages[i].source)
            continue;
        shader[count] =
            compile(stages[i].kind, stages[i].source, stages[i].stage, program);
        ok = shader[count] != 0;
        count += ok;
    }
    ok = ok && link_program(shader, count, &captured, program);
    for (int i = 0; i < count; i++)
        glDeleteShader(shader[i]);
    return ok;
}

void sb_gl_program_free(struct sb_gl_program *program)
{
    glDeleteProgram(program->name);
    free(program->log);
    *program = (struct sb_gl_program){0};
}
