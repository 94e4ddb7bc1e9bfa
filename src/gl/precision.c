// The precision probe: what the qualifiers are worth here, found out by arithmetic whose
// result differs between formats. glGetShaderPrecisionFormat is not asked: drivers answer
// it with constants.
#include <string.h>

#include "base/text.h"
#include "gl/audit.h"
#include "gl/program.h"
#include "gl/target.h"

// Two dependent operations at least: Mesa does a single mediump operation between highp
// values at highp. Each operand is a uniform of its own, so that (a * b) / c cannot be
// simplified. Results leave as bits, so that nothing on the way out rounds them.
static const char results[] = "uniform P float u[20];\n"
                              "uint result(int which) {\n"
                              "    P float zero_by_zero = u[16] / u[17];\n"
                              "    P float x = 0.0;\n"
                              "    if (which == 0) x = (u[0] + u[1]) + u[2];\n"
                              "    if (which == 1) x = (u[3] * u[4]) / u[5];\n"
                              "    if (which == 2) x = ((u[6] * u[7]) * u[8]) * u[9];\n"
                              "    if (which == 3) x = (u[10] + u[11]) * u[12] - u[13];\n"
                              "    if (which == 4) x = max(zero_by_zero, u[14]);\n"
                              "    if (which == 5) x = max(u[15], zero_by_zero);\n"
                              "    if (which == 6) x = pow(u[18], u[19]);\n"
                              "    highp float wide = x;\n"
                              "    return floatBitsToUint(wide);\n"
                              "}\n";

enum { OPERAND_COUNT = 20, RESULT_COUNT = 7 };
static const float operands[OPERAND_COUNT] = {
    2048,     1,          1,                // [0]  add
    256,      256,        256,              // [3]  square
    0x1p-14f, 0x1p-6f,    0x1p10f, 0x1p10f, // [6]  tiny
    1,        0x1.8p-11f, 1,       1,       // [10] round
    1,        1,                            // [14] nan_left, nan_right
    0,        0,                            // [16] the NaN
    0,        0,                            // [18] pow_zero
};

// Point number i lands on pixel number i of a row of eight.
#define PLACE                                                                            \
    "    gl_Position = vec4((float(gl_VertexID) + 0.5) / 4.0 - 1.0, 0.0, 0.0, 1.0);\n"   \
    "    gl_PointSize = 1.0;\n"

static const struct {
    bool with_results[2]; // the vertex shader, the fragment shader
    const char *vertex, *fragment;
} stages[2] = {
    {{false, true},
     "void main() {\n" PLACE "}\n",
     "out highp uint o_bits;\n"
     "void main() {\n    o_bits = result(int(gl_FragCoord.x));\n}\n"},
    {{true, false},
     "flat out highp uint v_bits;\n"
     "void main() {\n    v_bits = result(gl_VertexID);\n" PLACE "}\n",
     "flat in highp uint v_bits;\n"
     "out highp uint o_bits;\n"
     "void main() {\n    o_bits = v_bits;\n}\n"},
};

static void shader_text(struct sb_text *text, bool gles, const char *precision,
                        bool with_results, const char *main_text)
{
    sb_text_add(text, gles ? "#version 300 es\nprecision highp float;\n"
                             "precision highp int;\n"
                           : "#version 330\n");
    sb_text_printf(text, "#define P %s\n", precision);
    sb_text_add(text, with_results ? results : "");
    sb_text_add(text, main_text);
}

static bool make_program(struct sb_gl_program *program, bool gles, int stage,
                         const char *precision, struct sb_error *err)
{
    struct sb_text vertex = {0}, fragment = {0};
    shader_text(&vertex, gles, precision, stages[stage].with_results[0],
                stages[stage].vertex);
    shader_text(&fragment, gles, precision, stages[stage].with_results[1],
                stages[stage].fragment);
    const bool made =
        sb_gl_program_make(&(struct sb_program){.vertex = sb_text_get(&vertex),
                                                .fragment = sb_text_get(&fragment)},
                           program);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
    if (!made)
        sb_fail(err, SB_COMPILE_FAILED, "the precision probe's own shader (%s): %s",
                precision, program->log);
    return made;
}

static void draw_results(const struct sb_gl_program *program,
                         struct sb_precision_reading *reading)
{
    GLuint bits[8][4] = {{0}};
    float x[RESULT_COUNT];
    glUseProgram(program->name);
    glUniform1fv(glGetUniformLocation(program->name, "u"), OPERAND_COUNT, operands);
    glClearBufferuiv(GL_COLOR, 0, bits[0]);
    glDrawArrays(GL_POINTS, 0, RESULT_COUNT);
    glReadPixels(0, 0, 8, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits);
    for (int i = 0; i < RESULT_COUNT; i++)
        memcpy(&x[i], &bits[i][0], sizeof x[i]);
    reading->add = x[0];
    reading->square = x[1];
    reading->tiny = x[2];
    reading->round = x[3];
    reading->nan_left = x[4];
    reading->nan_right = x[5];
    reading->pow_zero = x[6];
}

static bool probe_one(bool gles, int stage, int precision,
                      struct sb_precision_reading *reading, struct sb_error *err)
{
    static const char *const words[] = {"highp", "mediump", "lowp"};
    struct sb_gl_program program;
    const bool made = make_program(&program, gles, stage, words[precision], err);
    reading->vertex_stage = stage;
    reading->precision = precision;
    if (made)
        draw_results(&program, reading);
    glUseProgram(0); // a program in use outlives its deletion
    sb_gl_program_free(&program);
    return made;
}

bool sb_gl_probe_precision(const struct sb_caps *caps, struct sb_probe *probe,
                           struct sb_error *err)
{
    const struct sb_target_params results_target = {8, 1, 1, SB_GL_R32UI};
    struct sb_target target;
    GLuint vertex_array;
    *probe = (struct sb_probe){0};
    if (!sb_target_make(&target, caps, &results_target, err))
        return false;
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glViewport(0, 0, 8, 1);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    bool ok = true;
    for (int i = 0; ok && i < 6; i++)
        ok = probe_one(caps->gles, i / 3, i % 3, &probe->reading[probe->count++], err);
    glDeleteVertexArrays(1, &vertex_array);
    sb_target_free(&target);
    const char *error = sb_gl_error();
    if (ok && error)
        ok = sb_fail(err, SB_GL_ERROR, "%s during the precision probe", error);
    return ok;
}
