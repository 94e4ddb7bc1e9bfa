// The precision probe: what the qualifiers are worth here, found out by values and arithmetic
// whose results differ between formats. glGetShaderPrecisionFormat is not asked: drivers answer
// it with constants. Each carrier has a program of its own, so that none changes what the driver
// makes of another.
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "gl/audit.h"
#include "gl/program.h"
#include "gl/target.h"

// Two dependent operations at least: Mesa does a single mediump operation between highp
// values at highp. Each operand is a uniform of its own, so that (a * b) / c cannot be
// simplified. Results leave as bits, so that nothing on the way out rounds them.
static const char chains[] = "uniform P float u[20];\n"
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
                             // One operation, and no P variable that it could share.
                             "    highp float lone = u[0] + u[1];\n"
                             "    if (which == 7) wide = lone;\n"
                             "    return floatBitsToUint(wide);\n"
                             "}\n";

enum { OPERAND_COUNT = 20, VALUE_COUNT = 5, PIXEL_COUNT = 8 };
static const float operands[OPERAND_COUNT] = {
    2048,     1,          1,                // [0]  add, lone
    256,      256,        256,              // [3]  square
    0x1p-14f, 0x1p-6f,    0x1p10f, 0x1p10f, // [6]  tiny
    1,        0x1.8p-11f, 1,       1,       // [10] round
    1,        1,                            // [14] nan_left, nan_right
    0,        0,                            // [16] the NaN
    0,        0,                            // [18] pow_zero
};

// What is carried: none of these is a normal number of fp16. The last is for `used`.
static const float values[PIXEL_COUNT] = {2049, 65536, 0x1p-20f, 1 + 0x1.8p-11f, 2049};

// Reads what is carried at highp, and computes with it at its own precision.
static const char take[] = "uniform P float u_half;\n"
                           "uint result(int which) {\n"
                           "    highp float wide = CARRIED(which);\n"
                           "    P float used = (CARRIED(which) - u_half) - u_half;\n"
                           "    if (which == 4) wide = used;\n"
                           "    return floatBitsToUint(wide);\n"
                           "}\n";

static const char uniform[] = "uniform P float u_value[5];\n"
                              "#define CARRIED(which) u_value[which]\n";
static const char sampler[] = "uniform P_SAMPLER sampler2D u_map;\n"
                              "#define CARRIED(which) textureLod(u_map, "
                              "vec2((float(which) + 0.5) / 8.0, 0.5), 0.0).x\n";
static const char varying[] = "in P float v_value;\n"
                              "#define CARRIED(which) v_value\n";

// Point number i lands on pixel number i of a row of eight.
#define PLACE                                                                            \
    "    gl_Position = vec4((float(gl_VertexID) + 0.5) / 4.0 - 1.0, 0.0, 0.0, 1.0);\n"   \
    "    gl_PointSize = 1.0;\n"

// The main functions.
static const char place[] = "void main() {\n" PLACE "}\n";
static const char tell[] = "out highp uint o_bits;\n"
                           "void main() {\n"
                           "    o_bits = result(int(gl_FragCoord.x));\n"
                           "}\n";
static const char hand_over[] = "flat out highp uint v_bits;\n"
                                "void main() {\n"
                                "    v_bits = result(gl_VertexID);\n" PLACE "}\n";
static const char pass_on[] = "flat in highp uint v_bits;\n"
                              "out highp uint o_bits;\n"
                              "void main() {\n    o_bits = v_bits;\n}\n";
static const char write_varying[] = "uniform highp float u_value[5];\n"
                                    "out P float v_value;\n"
                                    "void main() {\n"
                                    "    v_value = u_value[gl_VertexID];\n" PLACE "}\n";
static const char read_wide[] = "in highp float v_value;\n"
                                "out highp uint o_bits;\n"
                                "void main() {\n"
                                "    o_bits = floatBitsToUint(v_value);\n"
                                "}\n";
static const char write_output[] = "uniform highp float u_value[5];\n"
                                   "out P vec4 o_value;\n"
                                   "void main() {\n"
                                   "    o_value = vec4(u_value[int(gl_FragCoord.x)]);\n"
                                   "}\n";

// A program asks of the fragment stage, or of the vertex stage; its shaders are these pieces.
struct pieces {
    const char *vertex[3], *fragment[3];
};
static const struct pieces pieces[SB_CARRIER_COUNT][2] = {
    [SB_CARRIER_ARITHMETIC] = {{{place}, {chains, tell}},
                               {{chains, hand_over}, {pass_on}}},
    [SB_CARRIER_UNIFORM] = {{{place}, {uniform, take, tell}},
                            {{uniform, take, hand_over}, {pass_on}}},
    [SB_CARRIER_VARYING] = {{{write_varying}, {varying, take, tell}},
                            {{write_varying}, {read_wide}}},
    [SB_CARRIER_SAMPLER] = {{{place}, {sampler, take, tell}},
                            {{sampler, take, hand_over}, {pass_on}}},
    [SB_CARRIER_OUTPUT] = {{{place}, {write_output}}},
};

// Desktop GLSL 3.30 has no precision qualifiers on samplers.
static void shader_text(struct sb_text *text, bool gles, const char *precision,
                        const char *const piece[3])
{
    sb_text_add(text, gles ? "#version 300 es\nprecision highp float;\n"
                             "precision highp int;\n"
                           : "#version 330\n");
    sb_text_printf(text, "#define P %s\n#define P_SAMPLER %s\n", precision,
                   gles ? precision : "");
    for (int i = 0; i < 3 && piece[i]; i++)
        sb_text_add(text, piece[i]);
}

static bool make_program(struct sb_gl_program *program, bool gles,
                         const struct sb_precision_reading *reading, struct sb_error *err)
{
    const char *precision = sb_precision_names[reading->precision];
    const struct pieces *own = &pieces[reading->carrier][reading->vertex_stage];
    struct sb_text vertex = {0}, fragment = {0};
    shader_text(&vertex, gles, precision, own->vertex);
    shader_text(&fragment, gles, precision, own->fragment);
    const bool made =
        sb_gl_program_make(&(struct sb_program){.vertex = sb_text_get(&vertex),
                                                .fragment = sb_text_get(&fragment)},
                           program);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
    if (!made)
        sb_fail(err, SB_COMPILE_FAILED, "the precision probe's own shader (%s, %s): %s",
                sb_carriers[reading->carrier].name, precision, program->log);
    return made;
}

// x[i]: what pixel i was given.
static void draw(const struct sb_gl_program *program, bool to_floats,
                 float x[PIXEL_COUNT])
{
    GLuint bits[PIXEL_COUNT][4] = {{0}};
    GLfloat floats[PIXEL_COUNT][4] = {{0}};
    glUseProgram(program->name);
    // Those that a program does not have are at -1, and skipped.
    glUniform1fv(glGetUniformLocation(program->name, "u"), OPERAND_COUNT, operands);
    glUniform1fv(glGetUniformLocation(program->name, "u_value"), VALUE_COUNT, values);
    glUniform1f(glGetUniformLocation(program->name, "u_half"), 1024);
    if (to_floats)
        glClearBufferfv(GL_COLOR, 0, floats[0]);
    else
        glClearBufferuiv(GL_COLOR, 0, bits[0]);
    glDrawArrays(GL_POINTS, 0, PIXEL_COUNT);
    if (to_floats)
        glReadPixels(0, 0, PIXEL_COUNT, 1, GL_RGBA, GL_FLOAT, floats);
    else
        glReadPixels(0, 0, PIXEL_COUNT, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits);
    for (int i = 0; i < PIXEL_COUNT; i++)
        memcpy(&x[i], to_floats ? (void *)&floats[i][0] : (void *)&bits[i][0],
               sizeof x[i]);
}

static void read_chains(const float x[PIXEL_COUNT], struct sb_precision_reading *reading)
{
    reading->add = x[0];
    reading->square = x[1];
    reading->tiny = x[2];
    reading->round = x[3];
    reading->nan_left = x[4];
    reading->nan_right = x[5];
    reading->pow_zero = x[6];
    reading->lone = x[7];
}

// The rest of the sums: exact in single precision.
static void read_carried(const float x[PIXEL_COUNT], struct sb_precision_reading *reading)
{
    const struct pieces *own = &pieces[reading->carrier][reading->vertex_stage];
    const bool takes = own->vertex[1] == take || own->fragment[1] == take;
    reading->add = 2 * x[0] - 2048;
    reading->square = x[1] / 256;
    reading->tiny = x[2] * 0x1p20f;
    reading->round = x[3] - 1;
    reading->used = takes ? x[4] : NAN;
}

struct bench {
    struct sb_target bits, floats; // floats: all zeros where there are no float targets
    GLuint vertex_array, texture;
};

static bool bench_make(struct bench *bench, const struct sb_caps *caps,
                       struct sb_error *err)
{
    const struct sb_target_params bits = {PIXEL_COUNT, 1, 1, SB_GL_R32UI};
    const struct sb_target_params floats = {PIXEL_COUNT, 1, 1, SB_GL_RGBA32F};
    GLfloat texels[PIXEL_COUNT][4] = {{0}};
    *bench = (struct bench){0};
    if (!sb_target_make(&bench->bits, caps, &bits, err) ||
        (caps->colour_float && !sb_target_make(&bench->floats, caps, &floats, err)))
        return false;
    glGenVertexArrays(1, &bench->vertex_array);
    glBindVertexArray(bench->vertex_array);
    for (int i = 0; i < PIXEL_COUNT; i++)
        texels[i][0] = values[i];
    glActiveTexture(GL_TEXTURE0);
    glGenTextures(1, &bench->texture);
    glBindTexture(GL_TEXTURE_2D, bench->texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, PIXEL_COUNT, 1, 0, GL_RGBA, GL_FLOAT,
                 texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glViewport(0, 0, PIXEL_COUNT, 1);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    return true;
}

static void bench_free(struct bench *bench)
{
    glDeleteTextures(1, &bench->texture); // 0 is ignored
    glDeleteVertexArrays(1, &bench->vertex_array);
    sb_target_free(&bench->floats);
    sb_target_free(&bench->bits);
}

static bool probe_one(const struct bench *bench, bool gles,
                      struct sb_precision_reading *reading, struct sb_error *err)
{
    struct sb_gl_program program;
    float x[PIXEL_COUNT];
    const bool to_floats = reading->carrier == SB_CARRIER_OUTPUT;
    const bool made = make_program(&program, gles, reading, err);
    if (made) {
        glBindFramebuffer(GL_FRAMEBUFFER, to_floats ? bench->floats.framebuffer
                                                    : bench->bits.framebuffer);
        draw(&program, to_floats, x);
        if (reading->carrier == SB_CARRIER_ARITHMETIC)
            read_chains(x, reading);
        else
            read_carried(x, reading);
    }
    glUseProgram(0); // a program in use outlives its deletion
    sb_gl_program_free(&program);
    return made;
}

bool sb_gl_probe_precision(const struct sb_caps *caps, struct sb_probe *probe,
                           struct sb_error *err)
{
    struct sb_precision_reading question[SB_PRECISION_MAX];
    const int count = sb_precision_questions(question);
    struct bench bench;
    *probe = (struct sb_probe){0};
    bool ok = bench_make(&bench, caps, err);
    for (int i = 0; ok && i < count; i++) {
        if (question[i].carrier == SB_CARRIER_OUTPUT && !caps->colour_float)
            continue; // a target of fewer bits would round by itself
        ok = probe_one(&bench, caps->gles, &question[i], err);
        probe->reading[probe->count++] = question[i];
    }
    bench_free(&bench);
    const char *error = sb_gl_error();
    if (ok && error)
        ok = sb_fail(err, SB_GL_ERROR, "%s during the precision probe", error);
    return ok;
}
