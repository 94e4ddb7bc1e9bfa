// How deep conditionals may be nested inside a loop: a source text reports a driver that broke
// down there, and specifications set no limit that could be asked for.
#include "gl/audit.h"
#include "gl/program.h"
#include "gl/target.h"

static const char vertex_text[] = "void main()\n"
                                  "{\n"
                                  "    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n"
                                  "    gl_PointSize = 1.0;\n"
                                  "}\n";

// Each level adds 1 where u is above it, and far too much where it is not; two turns.
static void fragment_text(struct sb_text *text, int depth)
{
    sb_text_add(text, "uniform float u;\n"
                      "out uint o_count;\n"
                      "void main()\n"
                      "{\n"
                      "    o_count = 0u;\n"
                      "    for (int i = 0; i < 2; i++) {\n");
    for (int level = 0; level < depth; level++)
        sb_text_printf(text, "if (u > %d.5) { o_count += 1u;\n", level);
    for (int level = 0; level < depth; level++)
        sb_text_add(text, "} else { o_count += 10000u; }\n");
    sb_text_add(text, "    }\n"
                      "}\n");
}

static bool draws_right(bool gles, int depth)
{
    const char *head = gles ? "#version 300 es\nprecision highp float;\n"
                              "precision highp int;\n"
                            : "#version 330\n";
    static const GLuint nothing[4];
    struct sb_text vertex = {0}, fragment = {0};
    struct sb_gl_program program;
    GLuint count[4] = {0};
    sb_text_printf(&vertex, "%s%s", head, vertex_text);
    sb_text_add(&fragment, head);
    fragment_text(&fragment, depth);
    if (sb_gl_program_make(&(struct sb_program){.vertex = sb_text_get(&vertex),
                                                .fragment = sb_text_get(&fragment)},
                           &program)) {
        glUseProgram(program.name);
        glUniform1f(glGetUniformLocation(program.name, "u"), (float)depth);
        glClearBufferuiv(GL_COLOR, 0, nothing);
        glDrawArrays(GL_POINTS, 0, 1);
        glReadPixels(0, 0, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, count);
    }
    glUseProgram(0); // a program in use outlives its deletion
    sb_gl_program_free(&program);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
    return !sb_gl_error() && count[0] == 2 * (GLuint)depth;
}

bool sb_gl_probe_nesting(const struct sb_caps *caps, int *nesting, struct sb_error *err)
{
    const struct sb_target_params params = {1, 1, 1, SB_GL_R32UI};
    struct sb_target target;
    GLuint vertex_array;
    *nesting = 0;
    if (!sb_target_make(&target, caps, &params, err))
        return false;
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glViewport(0, 0, 1, 1);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    if (!caps->gles)
        glEnable(GL_PROGRAM_POINT_SIZE);
    for (int depth = SB_NESTING_ASKED; *nesting == 0 && depth > 0; depth /= 2) {
        if (draws_right(caps->gles, depth))
            *nesting = depth;
    }
    if (!caps->gles)
        glDisable(GL_PROGRAM_POINT_SIZE);
    glDeleteVertexArrays(1, &vertex_array);
    sb_target_free(&target);
    return true;
}
