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

static uint64_t hash_binary(GLuint name)
{
    GLint formats = 0, size = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats > 0)
        glGetProgramiv(name, GL_PROGRAM_BINARY_LENGTH, &size);
    if (size <= 0)
        return 0;
    unsigned char *binary = sb_alloc((size_t)size);
    GLenum format = 0;
    GLsizei length = 0;
    glGetProgramBinary(name, size, &length, &format, binary);
    const uint64_t hash = sb_hash(SB_HASH_START, binary, (size_t)length);
    free(binary);
    return length > 0 ? hash : 0;
}

static bool link_program(GLuint vertex, GLuint fragment, struct sb_gl_program *program)
{
    static const char *const attributes[] = {"a_position", "a_normal", "a_uv",
                                             "a_tangent"};
    const int64_t start = sb_clock_ns();
    const GLuint name = glCreateProgram();
    GLint done = GL_FALSE;
    glAttachShader(name, vertex);
    glAttachShader(name, fragment);
    for (GLuint i = 0; i < sizeof attributes / sizeof *attributes; i++)
        glBindAttribLocation(name, i, attributes[i]);
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
    glDetachShader(name, vertex);
    glDetachShader(name, fragment);
    program->name = name;
    program->binary_hash = glGetProgramBinary ? hash_binary(name) : 0;
    return true;
}

bool sb_gl_program_make(const char *vertex, const char *fragment,
                        struct sb_gl_program *program)
{
    *program = (struct sb_gl_program){0};
    if (GLAD_GL_KHR_parallel_shader_compile)
        glMaxShaderCompilerThreadsKHR(0);
    const GLuint vert = compile(GL_VERTEX_SHADER, vertex, SB_STAGE_VERT, program);
    const GLuint frag =
        vert ? compile(GL_FRAGMENT_SHADER, fragment, SB_STAGE_FRAG, program) : 0;
    const bool linked = vert && frag && link_program(vert, frag, program);
    glDeleteShader(vert); // 0 is ignored
    glDeleteShader(frag);
    return linked;
}

void sb_gl_program_free(struct sb_gl_program *program)
{
    glDeleteProgram(program->name);
    free(program->log);
    *program = (struct sb_gl_program){0};
}
