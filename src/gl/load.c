#include "gl/load.h"

// The loop's bound and the phase are uniforms, each step needs the one before, and the
// result is the colour: nothing can be folded, hoisted or dropped.
#define CHURN                                                                            \
    "uniform int u_loops;\n"                                                             \
    "uniform float u_phase;\n"                                                           \
    "float churn(float x) {\n"                                                           \
    "    for (int i = 0; i < u_loops; i++)\n"                                            \
    "        x = fract(sin(x * 2.9 + u_phase) * 7.3);\n"                                 \
    "    return x;\n"                                                                    \
    "}\n"

#define DESKTOP "#version 330\n"
#define GLES    "#version 300 es\nprecision highp float;\nprecision highp int;\n"

// One triangle that covers the target; the fragments do the work.
#define FRAGMENT_LOAD_VERT                                                               \
    "void main() {\n"                                                                    \
    "    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0,\n"                            \
    "                       gl_VertexID == 2 ? 3.0 : -1.0);\n"                           \
    "    gl_Position = vec4(corner, 0.0, 1.0);\n"                                        \
    "}\n"
#define FRAGMENT_LOAD_FRAG                                                               \
    CHURN "out vec4 o_colour;\n"                                                         \
          "void main() {\n"                                                              \
          "    float x = churn(fract(dot(gl_FragCoord.xy, vec2(0.31, 0.17))));\n"        \
          "    o_colour = vec4(x, 1.0 - x, 0.5, 1.0);\n"                                 \
          "}\n"

// A grid of 32 x 32 triangles, each over the first pixel of a cell of 2 x 2 (on a target
// of 64 x 64 pixels): the vertices do the work.
enum { GRID = 32, VERTEX_LOAD_SIZE = 64 };
#define VERTEX_LOAD_VERT                                                                 \
    CHURN "out vec3 v_colour;\n"                                                         \
          "void main() {\n"                                                              \
          "    int cell = gl_VertexID / 3, corner = gl_VertexID % 3;\n"                  \
          "    vec2 pixel = 2.0 * vec2(float(cell % 32), float(cell / 32))\n"            \
          "        + vec2(corner == 1 ? 1.9 : 0.0, corner == 2 ? 1.9 : 0.0);\n"          \
          "    float x = churn(fract(float(gl_VertexID) * 0.37));\n"                     \
          "    v_colour = vec3(x, 1.0 - x, 0.5);\n"                                      \
          "    gl_Position = vec4(pixel / 32.0 - 1.0, 0.0, 1.0);\n"                      \
          "}\n"
#define VERTEX_LOAD_FRAG                                                                 \
    "in vec3 v_colour;\n"                                                                \
    "out vec4 o_colour;\n"                                                               \
    "void main() {\n"                                                                    \
    "    o_colour = vec4(v_colour, 1.0);\n"                                              \
    "}\n"

static const struct {
    const char *vertex[2], *fragment[2]; // desktop OpenGL, OpenGL ES
    int vertices;
} loads[SB_LOAD_COUNT] = {
    [SB_LOAD_FRAGMENT] = {{DESKTOP FRAGMENT_LOAD_VERT, GLES FRAGMENT_LOAD_VERT},
                          {DESKTOP FRAGMENT_LOAD_FRAG, GLES FRAGMENT_LOAD_FRAG},
                          3},
    [SB_LOAD_VERTEX] = {{DESKTOP VERTEX_LOAD_VERT, GLES VERTEX_LOAD_VERT},
                        {DESKTOP VERTEX_LOAD_FRAG, GLES VERTEX_LOAD_FRAG},
                        3 * GRID *GRID},
};

bool sb_gl_load_make(struct sb_gl_load *load, enum sb_load kind, int size,
                     const struct sb_caps *caps, struct sb_error *err)
{
    const struct sb_program source = {.vertex = loads[kind].vertex[caps->gles],
                                      .fragment = loads[kind].fragment[caps->gles]};
    const struct sb_target_params target = {size, size, 1, SB_GL_RGBA8};
    if (!sb_gl_program_make(&source, &load->program))
        return sb_fail(err, SB_COMPILE_FAILED, "the timer audit's own shader: %s",
                       load->program.log);
    for (int i = 0; i < SB_LOAD_RING; i++)
        if (!sb_target_make(&load->ring[i], caps, &target, err))
            return false;
    glGenVertexArrays(1, &load->vertex_array);
    glBindVertexArray(load->vertex_array);
    load->vertices = loads[kind].vertices;
    load->loops = glGetUniformLocation(load->program.name, "u_loops");
    glUseProgram(load->program.name);
    glUniform1f(glGetUniformLocation(load->program.name, "u_phase"), 0.61f);
    glViewport(0, 0, size, size);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    // Drivers compile once more at the first draw.
    sb_gl_load_set_loops(load, 1);
    sb_gl_load_draw(load, SB_LOAD_RING);
    sb_gl_drain();
    return true;
}

void sb_gl_load_free(struct sb_gl_load *load)
{
    glUseProgram(0); // a program in use outlives its deletion
    glDeleteVertexArrays(1, &load->vertex_array);
    for (int i = 0; i < SB_LOAD_RING; i++)
        sb_target_free(&load->ring[i]);
    sb_gl_program_free(&load->program);
}

void sb_gl_load_set_loops(const struct sb_gl_load *load, int loops)
{
    glUniform1i(load->loops, loops);
}

void sb_gl_load_draw(const struct sb_gl_load *load, int frames)
{
    for (int i = 0; i < frames; i++) {
        glBindFramebuffer(GL_FRAMEBUFFER, load->ring[i % SB_LOAD_RING].framebuffer);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glDrawArrays(GL_TRIANGLES, 0, load->vertices);
    }
}
