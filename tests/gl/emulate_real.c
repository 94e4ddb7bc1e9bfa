// Emulated reduced precision against rounding in C, and against a driver that has it: llvmpipe
// computes mediump in binary16 in GLES contexts.
#include "gl_test.h"
#include "test.h"

#include "assemble_words.h"
#include "emulate/emulate.h"
#include "gl/audit.h"
#include "gl/program.h"
#include "math/random.h"

enum { SIDE = 128, PIXELS = SIDE * SIDE };

static struct gl_test test;
static bool real_half; // of mediump in fragment shaders
static GLuint framebuffer, renderbuffer, texture, vertex_array;
static float input[PIXELS][4];
static uint32_t emulated_bits[PIXELS][4], real_bits[PIXELS][4];

static const char vertex_text[] =
    "#version 300 es\n"
    "void main() {\n"
    "    vec2 p = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;\n"
    "    gl_Position = vec4(p, 0.0, 1.0);\n"
    "}\n";

static void set_up(void)
{
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glGenFramebuffers(1, &framebuffer);
    glGenRenderbuffers(1, &renderbuffer);
    glGenTextures(1, &texture);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32UI, SIDE, SIDE);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              renderbuffer);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glViewport(0, 0, SIDE, SIDE);
}

static void tear_down(void)
{
    glDeleteVertexArrays(1, &vertex_array);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &renderbuffer);
    glDeleteTextures(1, &texture);
}

static void draw(const char *vertex, const char *fragment, uint32_t bits[PIXELS][4])
{
    struct sb_gl_program program;
    const struct sb_program source = {.vertex = vertex, .fragment = fragment};
    if (!sb_gl_program_make(&source, &program))
        fail_msg("%s\n%s", program.log, fragment);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, SIDE, SIDE, 0, GL_RGBA, GL_FLOAT, input);
    glUseProgram(program.name);
    glUniform1i(glGetUniformLocation(program.name, "u_input"), 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glReadPixels(0, 0, SIDE, SIDE, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    glUseProgram(0);
    sb_gl_program_free(&program);
}

static void draw_emulated(const char *fragment, const struct sb_emulate_rules *rules,
                          uint32_t bits[PIXELS][4])
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    struct sb_emulated emulated;
    const struct sb_emulate_params params = {
        .vertex = vertex_text,
        .fragment = fragment,
        .rules = *rules,
        .gles = test.caps.gles,
        .version = test.caps.gles ? 300 : 330,
    };
    if (!sb_emulate(&params, &arena, &emulated, &err))
        fail_msg("%s", err.text);
    draw(emulated.vertex, emulated.fragment, bits);
    sb_arena_free(&arena);
}

// o_bits of a fragment that has t, four inputs.
static const char *fragment_of(const char *body)
{
    static char text[2048];
    snprintf(text, sizeof text,
             "#version 300 es\nprecision highp float;\nprecision highp int;\n"
             "uniform highp sampler2D u_input;\n"
             "out highp uvec4 o_bits;\n"
             "void main() {\n"
             "    highp vec4 t = texelFetch(u_input, ivec2(gl_FragCoord.xy), 0);\n"
             "%s}\n",
             body);
    return text;
}

// --- rounding in C, by arithmetic instead of bits ---

static double round_half(double x, const struct sb_emulate_rules *rules)
{
    if (isnan(x))
        return x;
    const double largest = 65504;
    if (isinf(x))
        return rules->saturate ? copysign(largest, x) : x;
    int exponent;
    frexp(x, &exponent); // |x| < 2^exponent
    const int place = (exponent > -13 ? exponent : -13) - 11;
    const double steps = ldexp(x, -place);
    double rounded = ldexp(rules->towards_zero ? trunc(steps) : nearbyint(steps), place);
    if (fabs(rounded) > largest)
        rounded = rules->saturate || rules->towards_zero ? copysign(largest, x)
                                                         : copysign(INFINITY, x);
    if (rules->flush && fabs(rounded) < 0x1p-14)
        rounded = 0;
    return copysign(rounded, x);
}

static double round_fixed(double x, const struct sb_emulate_rules *rules)
{
    if (isnan(x))
        return 0;
    const double bounded = fmin(fmax(x, -2), 2 - 1.0 / 256);
    return (rules->towards_zero ? trunc(bounded * 256) : nearbyint(bounded * 256)) / 256 +
           0.0;
}

static uint32_t bits_of(double x)
{
    const float narrow = (float)x;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    return bits;
}

static float float_of(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static bool same(uint32_t a, uint32_t b)
{
    return a == b || (isnan(float_of(a)) && isnan(float_of(b)));
}

// --- inputs ---

static uint32_t draw_bits(struct sb_random *random)
{
    return (uint32_t)sb_random_u64(random);
}

// Any binary32 that is no subnormal, which drivers may flush; half of them where binary16 changes:
// at its ties, next to them, around its ends.
static float any_float(struct sb_random *random)
{
    const uint32_t bits = draw_bits(random), how = draw_bits(random) % 4;
    float x = float_of(bits);
    if (how == 0) // 2^-27 to 2^18
        x = float_of((bits & 0x80000000) | (100 + bits % 46) << 23 |
                     (draw_bits(random) & 0x7fffff));
    if (how == 1) // ties of binary16 and their neighbours
        x = float_of((bits & 0x80000000) + ((100 + bits % 46) << 23) +
                     ((draw_bits(random) & 0x7ff) << 12) + draw_bits(random) % 3 - 1);
    if (how == 2) // the range of fixed point and its surroundings
        x = (float)((int)(bits % 4096) - 2048) / 512;
    return fpclassify(x) == FP_SUBNORMAL ? 0 : x;
}

static float any_half(struct sb_random *random)
{
    const uint32_t bits = draw_bits(random);
    // One in four over the whole range, with subnormals; the others from 2^-6 to 2^6.
    const int exponent =
        bits & 3 ? (int)(bits >> 8) % 12 - 6 : (int)(bits >> 8) % 31 - 15;
    const double sign = bits & 4 ? -1 : 1, fraction = (draw_bits(random) & 1023) / 1024.0;
    const bool subnormal = exponent == -15;
    return (float)(sign * ldexp(fraction + !subnormal, subnormal ? -14 : exponent));
}

static void fill_input(float (*any)(struct sb_random *random))
{
    struct sb_random random = sb_random_seed(16);
    for (int i = 0; i < PIXELS; i++)
        for (int c = 0; c < 4; c++)
            input[i][c] = any(&random);
}

// --- the rounding rules ---

static void check_rounding(const struct sb_emulate_rules *rules)
{
    draw_emulated(fragment_of("    mediump float m = t.x;\n"
                              "    mediump vec2 v = t.yz;\n"
                              "    lowp float l = t.w;\n"
                              "    highp vec4 wide = vec4(m, v, l);\n"
                              "    o_bits = floatBitsToUint(wide);\n"),
                  rules, emulated_bits);
    for (int i = 0; i < PIXELS; i++)
        for (int c = 0; c < 4; c++) {
            const bool fixed = c == 3 && rules->lowp == SB_LOWP_FIXED10;
            const float x = input[i][c];
            const uint32_t wanted =
                bits_of(fixed ? round_fixed(x, rules) : round_half(x, rules));
            if (!same(emulated_bits[i][c], wanted))
                fail_msg(
                    "%a becomes %a, not %a (fixed %d, saturate %d, flush %d, towards "
                    "zero %d)",
                    x, float_of(emulated_bits[i][c]), float_of(wanted), fixed,
                    rules->saturate, rules->flush, rules->towards_zero);
        }
}

static void every_rule_rounds_as_it_says(void **state)
{
    (void)state;
    fill_input(any_float);
    for (int rule = 0; rule < 16; rule++)
        check_rounding(&(struct sb_emulate_rules){
            .lowp = rule & 1 ? SB_LOWP_FIXED10 : SB_LOWP_AS_MEDIUMP,
            .saturate = rule & 2,
            .flush = rule & 4,
            .towards_zero = rule & 8,
        });
}

static void operations_are_those_of_binary16(void **state)
{
    (void)state;
    const struct sb_emulate_rules rules = {0};
    fill_input(any_half);
    draw_emulated(fragment_of("    mediump vec4 m = t;\n"
                              "    mediump float sum = (m.x + m.y) * m.z - m.w;\n"
                              "    mediump float d = dot(m.xyz, m.yzw);\n"
                              "    mediump float big = m.x * m.y;\n"
                              "    mediump float mixed = mix(m.x, m.y, 0.25);\n"
                              "    highp vec4 wide = vec4(sum, d, big, mixed);\n"
                              "    o_bits = floatBitsToUint(wide);\n"),
                  &rules, emulated_bits);
    for (int i = 0; i < PIXELS; i++) {
#define R(x) round_half(x, &rules)
        const float *m = input[i];
        const double wanted[4] = {
            R(R(R((double)m[0] + m[1]) * m[2]) - m[3]),
            R(R(R((double)m[0] * m[1]) + R((double)m[1] * m[2])) +
              R((double)m[2] * m[3])),
            R((double)m[0] * m[1]),
            R(R(m[0] * 0.75) + R(m[1] * 0.25)),
        };
#undef R
        for (int c = 0; c < 4; c++)
            if (!same(emulated_bits[i][c], bits_of(wanted[c])))
                fail_msg("%d of %a %a %a %a: %a, not %a", c, m[0], m[1], m[2], m[3],
                         float_of(emulated_bits[i][c]), wanted[c]);
    }
}

// --- the error that Vulkan allows ---

static double ulp_half(double y)
{
    int exponent;
    frexp(y, &exponent);
    return ldexp(1, (exponent > -13 ? exponent : -13) - 11);
}

// What is wrong with log2, exp2, inversesqrt and sin, in double.
static void missed(const float x[4], const struct sb_emulate_rules *rules, double out[4])
{
    const double l = log2(x[0]), e = exp2(x[1]), i = 1 / sqrt(x[2]), s = sin(x[3]);
    const double by[4] = {
        x[0] >= 0.5 && x[0] <= 2 ? -0x1p-7 : -3 * ulp_half(l),
        -(1 + 2 * fabs(x[1])) * ulp_half(e),
        2 * ulp_half(i),
        s < 0 ? -0x1p-7 : 0x1p-7,
    };
    out[0] = round_half(l + by[0], rules);
    out[1] = round_half(fmax(e + by[1], 0), rules);
    out[2] = round_half(i + by[2], rules);
    out[3] = round_half(s + by[3], rules);
}

// A driver's own functions are not exact: a result next to a tie may go the other way, and so may
// the ulp next to a power of two.
static void builtins_miss_by_the_largest_error_that_is_allowed(void **state)
{
    (void)state;
    const struct sb_emulate_rules rules = {.allowed_error = true};
    fill_input(any_half);
    for (int i = 0; i < PIXELS; i++) {
        input[i][0] = fabsf(input[i][0]) + 0x1p-14f;
        input[i][1] = fminf(fmaxf(input[i][1], -24), 15);
        input[i][2] = fabsf(input[i][2]) + 0x1p-14f;
        input[i][3] = fminf(fmaxf(input[i][3], -3), 3);
        for (int c = 0; c < 4; c++)
            input[i][c] = (float)round_half(input[i][c], &(struct sb_emulate_rules){0});
    }
    draw_emulated(fragment_of("    mediump vec4 m = t;\n"
                              "    mediump float l = log2(m.x), e = exp2(m.y);\n"
                              "    mediump vec2 i = inversesqrt(m.zz), s = sin(m.ww);\n"
                              "    highp vec4 wide = vec4(l, e, i.y, s.x);\n"
                              "    o_bits = floatBitsToUint(wide);\n"),
                  &rules, emulated_bits);
    int beside = 0;
    for (int i = 0; i < PIXELS; i++) {
        double wanted[4];
        missed(input[i], &rules, wanted);
        for (int c = 0; c < 4; c++) {
            const double got = float_of(emulated_bits[i][c]);
            beside += got != wanted[c];
            if (!(fabs(got - wanted[c]) <= (c == 1 ? 64 : 4) * ulp_half(wanted[c])))
                fail_msg("%d of %a: %a, not %a", c, input[i][c], got, wanted[c]);
        }
    }
    assert_in_range(beside, 0, 4 * PIXELS / 100);
}

// log2, pow, sqrt and normalize of 1, in mediump and in highp.
static void only_reduced_precision_misses(void **state)
{
    (void)state;
    static const char *const words[] = {"mediump", "highp"};
    for (int i = 0; i < PIXELS; i++)
        for (int c = 0; c < 4; c++)
            input[i][c] = 1;
    for (int precision = 0; precision < 2; precision++)
        for (int allowed = 0; allowed < 2; allowed++) {
            char body[512];
            snprintf(body, sizeof body,
                     "    %s vec4 m = t;\n"
                     "    %s float l = log2(m.x), p = pow(m.x, m.y * 64.0);\n"
                     "    %s float s = sqrt(m.x), n = normalize(vec2(m.x, 0.0)).x;\n"
                     "    highp vec4 wide = vec4(l, p, s, n);\n"
                     "    o_bits = floatBitsToUint(wide);\n",
                     words[precision], words[precision], words[precision]);
            draw_emulated(fragment_of(body),
                          &(struct sb_emulate_rules){.allowed_error = allowed},
                          emulated_bits);
            const bool wrong = allowed && precision == 0;
            const uint32_t *got = emulated_bits[0];
            assert_true(float_of(got[0]) == (wrong ? -0x1p-7f : 0));
            // 2^(-64/128), less 1 + 2/2 ulp.
            check_close(float_of(got[1]), wrong ? sqrt(0.5) - 2 * 0x1p-11 : 1,
                        wrong ? 0x1p-12 : 1e-6);
            check_close(float_of(got[2]), wrong ? 1 - 2 * 0x1p-10 : 1,
                        wrong ? 0x1p-12 : 1e-6);
            check_close(float_of(got[3]), wrong ? 1 + 2 * 0x1p-10 : 1,
                        wrong ? 0x1p-12 : 1e-6);
        }
}

// --- against a driver ---

// Of the others the share that differs is printed. Two operations at least: Mesa does a single one
// between highp values in highp. It sums dot products, and computes mix, smoothstep, cross and
// inversesqrt, in another order than the formulas of the specification.
static const struct chain {
    const char *text; // of the mediump floats a, b, c, d
    bool exact;       // IEEE 754 and GLSL leave no choice
} chains[] = {
    {"(a + b) + c", true},
    {"(a - b) - c", true},
    {"(a * b) * c", true},
    {"(a + b) * c", true},
    {"(a * b) + c", true},
    {"(a - b) * c + d", true},
    {"(a + b) / c", true},
    {"(a / b) / c", true},
    {"(a / b) * c - d", true},
    {"sqrt(abs(a * b)) + c", true},
    {"sqrt(abs(a)) * sqrt(abs(b)) * c", true},
    {"max(a * b, c) + min(a, b + d)", true},
    {"(a + b) * (c + d)", true},
    {"a * b", false},
    {"a / b", false},
    {"dot(vec3(a, b, c), vec3(d, a, b)) + c", false},
    {"inversesqrt(abs(a * b)) + c", false},
    {"exp2(a * 0.125) * b", false},
    {"log2(abs(a * b)) * c", false},
    {"pow(abs(a), b * 0.25) * c", false},
    {"sin(a) * b", false},
    {"mix(a, b, c) + d", false},
    {"smoothstep(-2.0, 2.0, a) * b", false},
    {"length(vec3(a, b, c)) + d", false},
    {"normalize(vec3(a, b, c)).x * d", false},
    {"reflect(vec2(a, b), vec2(c, d)).x + a", false},
    {"cross(vec3(a, b, c), vec3(d, a, b)).x + c", false},
    {"mod(a, b) + c", false},
    {"(a * 0.1 + b) + c", false},
};

static int count_different(const struct chain *chain)
{
    char body[512];
    const struct sb_emulate_rules rules = {0};
    snprintf(body, sizeof body,
             "    mediump float a = t.x, b = t.y, c = t.z, d = t.w;\n"
             "    mediump float r = %s;\n"
             "    highp float wide = r;\n"
             "    o_bits = uvec4(floatBitsToUint(wide));\n",
             chain->text);
    const char *fragment = fragment_of(body);
    draw(vertex_text, fragment, real_bits);
    draw_emulated(fragment, &rules, emulated_bits);
    int different = 0;
    for (int i = 0; i < PIXELS; i++)
        different += !same(real_bits[i][0], emulated_bits[i][0]);
    return different;
}

static void chains_of_exact_operations_are_bit_equal_to_real_half_floats(void **state)
{
    (void)state;
    if (!real_half)
        skip();
    fill_input(any_half);
    int broken = 0;
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        const int different = count_different(&chains[i]);
        print_message("%7.3f %% differ: %s\n", 100.0 * different / PIXELS,
                      chains[i].text);
        broken += chains[i].exact && different > 0;
    }
    assert_int_equal(broken, 0);
}

// --- names ---

static void emulate_words(const char *words, struct sb_gl_program *program)
{
    struct sb_assembly assembly;
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    struct sb_emulated emulated;
    assemble(words, &assembly);
    const struct sb_emulate_params params = {
        .vertex = shade_of(&assembly, VERTEX)->text,
        .fragment = shade_of(&assembly, FRAGMENT)->text,
        .gles = test.caps.gles,
        .version = test.caps.gles ? 300 : 330,
    };
    if (!sb_emulate(&params, &arena, &emulated, &err))
        fail_msg("%s", err.text);
    const struct sb_program source = {.vertex = emulated.vertex,
                                      .fragment = emulated.fragment};
    if (!sb_gl_program_make(&source, program))
        fail_msg("%s\n%s", program->log, emulated.fragment);
    sb_arena_free(&arena);
    sb_assembly_free(&assembly);
}

static void uniforms_and_attributes_are_found_by_their_names(void **state)
{
    (void)state;
    static const char *const uniforms[] = {
        "u_model",
        "u_view_projection",
        "u_normal_matrix",
        "u_scene_ambient",
        "u_camera_position",
        "u_point[0].position",
        "u_point[3].diffuse",
        "u_spot[1].direction",
        "u_material.shininess",
        "u_diffuse_map",
    };
    struct sb_gl_program program;
    emulate_words("api=gles glsl=300es precision=mediump point=4 spot=2 maps=diffuse",
                  &program);
    for (size_t i = 0; i < sizeof uniforms / sizeof *uniforms; i++)
        if (glGetUniformLocation(program.name, uniforms[i]) < 0)
            fail_msg("no uniform %s", uniforms[i]);
    assert_int_equal(glGetAttribLocation(program.name, "a_position"), 0);
    assert_int_equal(glGetAttribLocation(program.name, "a_normal"), 1);
    assert_int_equal(glGetAttribLocation(program.name, "a_uv"), 2);
    sb_gl_program_free(&program);
}

static void members_of_blocks_are_found_by_their_names(void **state)
{
    (void)state;
    static const char *const storages[] = {"ubo_std140", "ubo_shared"};
    const char *const names[] = {"u_point[1].position", "u_spot[0].cone_scale",
                                 "u_material.shininess"};
    for (int s = 0; s < 2; s++) {
        char words[128];
        struct sb_gl_program program;
        GLuint index[3];
        snprintf(words, sizeof words,
                 "api=gles glsl=300es precision=mediump point=2 spot=1 storage=%s",
                 storages[s]);
        emulate_words(words, &program);
        assert_int_not_equal(glGetUniformBlockIndex(program.name, "Lights"),
                             GL_INVALID_INDEX);
        assert_int_not_equal(glGetUniformBlockIndex(program.name, "MaterialBlock"),
                             GL_INVALID_INDEX);
        glGetUniformIndices(program.name, 3, names, index);
        for (int i = 0; i < 3; i++)
            if (index[i] == GL_INVALID_INDEX)
                fail_msg("no member %s with %s", names[i], storages[s]);
        sb_gl_program_free(&program);
    }
}

static bool has_real_half(void)
{
    struct sb_error err = {0};
    struct sb_probe probe;
    struct sb_precision_verdict verdict;
    if (!test.caps.gles || !sb_gl_probe_precision(&test.caps, &probe, &err))
        return false;
    sb_precision_judge(&probe.reading[1], &verdict);
    return verdict.effective == SB_EFFECTIVE_FP16;
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rule_rounds_as_it_says),
        cmocka_unit_test(operations_are_those_of_binary16),
        cmocka_unit_test(builtins_miss_by_the_largest_error_that_is_allowed),
        cmocka_unit_test(only_reduced_precision_misses),
        cmocka_unit_test(uniforms_and_attributes_are_found_by_their_names),
        cmocka_unit_test(members_of_blocks_are_found_by_their_names),
        cmocka_unit_test(chains_of_exact_operations_are_bit_equal_to_real_half_floats),
    };
    gl_test_open(&test);
    real_half = has_real_half();
    set_up();
    const int failed = run_tests(tests);
    tear_down();
    gl_test_close(&test);
    return failed;
}
