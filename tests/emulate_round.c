// Emulated precision without GL: what is rounded, that names survive, and that all shipped
// shaders come out as valid GLSL of each version. tests/gl/emulate_real.c has the numbers.
#include "assemble_words.h"

#include "emulate/emulate.h"

#define PLAIN_VERTEX                                                                     \
    "#version 300 es\nin vec4 a_position;\nvoid main() { gl_Position = a_position; }\n"
#define HEAD "#version 300 es\nprecision mediump float;\nout vec4 o_color;\n"

struct fixture {
    struct sb_arena arena;
    struct sb_emulated out;
    struct sb_error err;
};

static bool emulate(struct fixture *fixture, const char *fragment,
                    enum sb_emulate_lowp lowp)
{
    const struct sb_emulate_params params = {
        .vertex = PLAIN_VERTEX,
        .fragment = fragment,
        .rules = {.lowp = lowp},
        .gles = true,
        .version = 300,
    };
    *fixture = (struct fixture){0};
    return sb_emulate(&params, &fixture->arena, &fixture->out, &fixture->err);
}

// The fragment shader of `main_text` behind HEAD holds `wanted`; so many are rounded.
static void check_text(const char *fragment, enum sb_emulate_lowp lowp, int rounded,
                       const char *wanted)
{
    struct fixture fixture;
    if (!emulate(&fixture, fragment, lowp))
        fail_msg("%s", fixture.err.text);
    check_contains(fixture.out.fragment, wanted);
    if (fixture.out.rounded != rounded)
        fail_msg("%d are rounded, not %d, in:\n%s", fixture.out.rounded, rounded,
                 fixture.out.fragment);
    sb_arena_free(&fixture.arena);
}

static void every_operation_is_rounded_and_a_uniform_where_it_is_read(void **state)
{
    (void)state;
    check_text(HEAD "uniform float a, b, c;\n"
                    "void main() { o_color = vec4(a * b + c); }\n",
               SB_LOWP_AS_MEDIUMP, 5,
               "sb_round_16(sb_round_16(sb_round_16(a) * sb_round_16(b)) + "
               "sb_round_16(c))");
}

static void a_function_of_several_operations_is_taken_apart(void **state)
{
    (void)state;
    check_text(HEAD "in vec3 v, w;\nvoid main() { o_color = vec4(dot(v, w)); }\n",
               SB_LOWP_AS_MEDIUMP, 3,
               "float sb_dot_16(vec3 a, vec3 b)\n"
               "{\n"
               "    vec3 p = sb_round_16(a * b);\n"
               "    return sb_round_16(sb_round_16(p.x + p.y) + p.z);\n}\n");
    check_text(HEAD "in vec3 v;\nuniform mat3 m;\n"
                    "void main() { o_color = vec4(normalize(m * v), 1.0); }\n",
               SB_LOWP_AS_MEDIUMP, 4, "sb_normalize_16(sb_mul_16(sb_round_16(m)");
    check_text(HEAD "in float x;\nvoid main() { o_color = vec4(pow(x, 2.0)); }\n",
               SB_LOWP_AS_MEDIUMP, 2, "sb_exp2_16(sb_round_16(y * sb_log2_16(x");
}

static void a_highp_value_is_rounded_when_a_mediump_variable_takes_it(void **state)
{
    (void)state;
    check_text(HEAD "in highp float h;\n"
                    "void main() { float m = h * h; o_color = vec4(m); }\n",
               SB_LOWP_AS_MEDIUMP, 1, "float m = sb_round_16(h * h);");
    // Not before it is added: an operation has the highest precision of its operands.
    check_text(HEAD "in highp float h;\n"
                    "void main() { float m = h; m += h; o_color = vec4(m); }\n",
               SB_LOWP_AS_MEDIUMP, 2, "m = sb_round_16(m + h);");
}

static void a_mediump_function_rounds_what_it_returns_and_takes(void **state)
{
    (void)state;
    check_text(HEAD "in highp float h;\n"
                    "float f(float a, highp float b) { return b; }\n"
                    "void main() { o_color = vec4(f(h, h)); }\n",
               SB_LOWP_AS_MEDIUMP, 2, "float param = sb_round_16(h);");
}

static void a_literal_is_rounded_only_where_rounding_changes_it(void **state)
{
    (void)state;
    check_text(HEAD "in float x;\nvoid main() { o_color = vec4(x * 0.5); }\n",
               SB_LOWP_AS_MEDIUMP, 2, "sb_round_16(sb_round_16(x) * 0.5)");
    check_text(HEAD "in float x;\nvoid main() { o_color = vec4(x * 0.1); }\n",
               SB_LOWP_AS_MEDIUMP, 2,
               "sb_round_16(sb_round_16(x) * sb_round_16(0.100000001490");
    check_text(HEAD "in float x;\nvoid main() { o_color = vec4(x > 0.1 ? 1.0 : 0.0); }\n",
               SB_LOWP_AS_MEDIUMP, 1, "sb_round_16(x) > sb_round_16(0.1");
}

static void a_mediump_member_of_a_struct_is_rounded_where_it_is_read(void **state)
{
    (void)state;
    check_text("#version 300 es\nout highp vec4 o_color;\n"
               "struct Light { mediump float a; highp float b; };\n"
               "uniform Light u_light[2];\n"
               "void main() { o_color = vec4(u_light[1].a, u_light[1].b, 0.0, 1.0); }\n",
               SB_LOWP_AS_MEDIUMP, 1, "vec4(sb_round_16(u_light[1].a), u_light[1].b,");
}

static void lowp_is_told_from_mediump_where_it_is_fixed_point(void **state)
{
    (void)state;
    static const char text[] = HEAD "in lowp float l;\nin float m;\n"
                                    "lowp float twice(lowp float x) { return x + x; }\n"
                                    "highp float wide(float x) { return x; }\n"
                                    "void main() {\n"
                                    "    lowp float s = l * 0.3;\n"
                                    "    o_color = vec4(s * m, twice(m), wide(m), 1.0);\n"
                                    "}\n";
    check_text(text, SB_LOWP_FIXED10, 10,
               "float s = sb_round_10(sb_round_10(l) * sb_round_10(0.3");
    check_text(text, SB_LOWP_FIXED10, 10, "sb_round_16(s * sb_round_16(m))");
    check_text(text, SB_LOWP_FIXED10, 10, "sb_round_10(x) + sb_round_10(x)");
    check_text(text, SB_LOWP_AS_MEDIUMP, 8, "sb_round_16(l) * sb_round_16(0.3");
}

static void what_is_mediump_by_default_is_not_lowp(void **state)
{
    (void)state;
    check_text(HEAD "flat in int i;\nvoid main() { o_color = vec4(float(i) * 3.0); }\n",
               SB_LOWP_FIXED10, 2, "vec4(sb_round_16(sb_round_16(float(i)) * 3.0))");
    check_text(HEAD "void main() { o_color = vec4(gl_PointCoord, 0.0, 1.0); }\n",
               SB_LOWP_FIXED10, 1, "sb_round_16(gl_PointCoord)");
}

static void a_sampler_without_precision_is_lowp(void **state)
{
    (void)state;
    check_text(HEAD "uniform sampler2D s;\nin highp vec2 v;\n"
                    "void main() { o_color = texture(s, v); }\n",
               SB_LOWP_FIXED10, 1, "o_color = sb_round_10(texture(s, v));");
}

static void highp_and_functions_that_nothing_calls_are_left_alone(void **state)
{
    (void)state;
    check_text("#version 300 es\nprecision highp float;\nout vec4 o_color;\nin vec3 v;\n"
               "mediump float unused(mediump float x) { return x * x; }\n"
               "void main() { o_color = vec4(normalize(v) * dot(v, v), 0.1); }\n",
               SB_LOWP_AS_MEDIUMP, 0, "normalize(v) * dot(v, v)");
}

static void an_invalid_source_gives_the_words_of_the_compiler(void **state)
{
    (void)state;
    struct fixture fixture;
    assert_false(emulate(&fixture, HEAD "void main()\n{\n    o_color = nothing;\n}\n",
                         SB_LOWP_AS_MEDIUMP));
    assert_int_equal(fixture.err.status, SB_COMPILE_FAILED);
    check_contains(fixture.err.text,
                   "fragment shader: ERROR: 0:6: 'nothing' : undeclared");
    sb_arena_free(&fixture.arena);
    assert_false(emulate(&fixture, "#version 100\nvoid main() {}\n", SB_LOWP_AS_MEDIUMP));
    assert_int_equal(fixture.err.status, SB_COMPILE_FAILED);
    check_contains(fixture.err.text, "300 es");
    sb_arena_free(&fixture.arena);
}

static void the_version_is_the_one_of_the_source_while_it_is_preprocessed(void **state)
{
    (void)state;
    check_text(HEAD
               "in float x;\nvoid main() {\n#if __VERSION__ == 300\n"
               "    o_color = vec4(x);\n#else\n    o_color = vec4(x * x);\n#endif\n}\n",
               SB_LOWP_AS_MEDIUMP, 1, "o_color = vec4(sb_round_16(x));");
}

static void blocks_keep_their_layout_and_have_no_instance_name(void **state)
{
    (void)state;
    static const char text[] =
        HEAD "layout(shared) uniform Lights { vec4 u_point[2]; };\n"
             "layout(std140) uniform Material { vec4 diffuse; } u_material;\n"
             "vec4 f(vec4 diffuse) { vec4 x = diffuse; return x; }\n"
             "void main() { o_color = f(u_point[1]) + u_material.diffuse; }\n";
    check_text(text, SB_LOWP_AS_MEDIUMP, 3,
               "layout(shared) uniform Lights\n{\n    vec4 u_point[2];\n} ;\n");
    check_text(text, SB_LOWP_AS_MEDIUMP, 3, " = sb_round_16(u_point[1])");
    check_text(text, SB_LOWP_AS_MEDIUMP, 3, "layout(std140) uniform Material\n");
    check_text(text, SB_LOWP_AS_MEDIUMP, 3, "} u_material;\n");
    check_text(text, SB_LOWP_AS_MEDIUMP, 3, "sb_round_16(u_material.diffuse)");
}

static void a_local_name_does_not_hide_a_member_of_a_block(void **state)
{
    (void)state;
    check_text(HEAD "layout(std140) uniform Lights { vec4 tint; };\n"
                    "vec4 g() { return tint; }\n"
                    "void main() { vec4 t; { vec4 tint = vec4(2.0); t = tint; }\n"
                    "    o_color = t * g(); }\n",
               SB_LOWP_AS_MEDIUMP, 2, "    vec4 _");
}

// --- the shipped shaders ---

static const struct output {
    bool gles;
    int version;
} outputs[] = {{true, 300}, {true, 310}, {false, 330}, {false, 450}};

// What came back takes the place of the sources, so that they are validated together.
static void put_back(struct sb_assembly *assembly, const struct sb_emulated *emulated)
{
    struct sb_glsl_source *source = assembly->built[0].source;
    source[VERTEX].text = (char *)emulated->vertex;
    source[FRAGMENT].text = (char *)emulated->fragment;
}

static void check_program(const char *words, bool fixed, const struct output *output)
{
    struct sb_assembly assembly;
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    struct sb_emulated emulated;
    assemble(words, &assembly);
    struct sb_glsl_source *source = assembly.built[0].source;
    char *const kept[] = {source[VERTEX].text, source[FRAGMENT].text};
    const struct sb_emulate_params params = {
        .vertex = kept[0],
        .fragment = kept[1],
        .rules = {.lowp = fixed ? SB_LOWP_FIXED10 : SB_LOWP_AS_MEDIUMP},
        .gles = output->gles,
        .version = output->version,
    };
    if (!sb_emulate(&params, &arena, &emulated, &err))
        fail_msg("%s to %d: %s", words, output->version, err.text);
    put_back(&assembly, &emulated);
    if (!sb_assembly_validate(&assembly, &err))
        fail_msg("%s to %d: %s\n%s", words, output->version, err.text, emulated.fragment);
    const bool highp = strstr(words, "precision=highp");
    if (highp != (emulated.rounded == 0))
        fail_msg("%s: %d are rounded", words, emulated.rounded);
    source[VERTEX].text = kept[0];
    source[FRAGMENT].text = kept[1];
    sb_arena_free(&arena);
    sb_assembly_free(&assembly);
}

static void all_shipped_shaders_come_out_valid_in_every_version(void **state)
{
    (void)state;
    static const char *const words[] = {
        "precision=highp dir=1 point=2 spot=1 p_sampler=highp",
        "precision=mediump dir=1 point=2 spot=2 area=1",
        "precision=mediump point=2 stage=vertex",
        "precision=mediump point=2 space=view model=phong specular_side=both",
        "precision=mixed point=4 maps=diffuse+specular+normal",
        "precision=mixed point=2 maps=diffuse p_sampler=lowp storage=ubo_std140",
        "precision=lowp dir=2 maps=normal",
        "precision=lowp spot=2 storage=ubo_shared",
        "precision=mediump point=3 storage=arrays loop=dynamic",
        "precision=mediump point=3 storage=constant",
        "precision=mediump point=3 storage=global loop=unrolled",
        "precision=mediump dir=1 point=2 spot=2 layout=unified storage=ubo_std140",
        "precision=mediump spot=2 cone=exponent attenuation=windowed guard=mask",
        "precision=mediump area=2 area_shape=tube form=naive",
        "precision=mediump area=2 area_shape=capsule ambient=per_light",
        "precision=mediump point=2 shadows=1 shadow_map=cube shadow_filter=4",
        "precision=mediump point=2 shadows=2 shadow_map=six2d shadow_store=depth",
        "precision=mediump point=2 shadows=1 shadow_map=array2d shadow_bias_kind=slope",
        "precision=mediump point=2 hoist=per_light loop=padded capacity=5",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        for (size_t o = 0; o < sizeof outputs / sizeof *outputs; o++) {
            char all[256];
            snprintf(all, sizeof all, "api=gles glsl=%s %s", o % 2 ? "310es" : "300es",
                     words[i]);
            check_program(all, i % 2, &outputs[o]);
        }
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_operation_is_rounded_and_a_uniform_where_it_is_read),
        cmocka_unit_test(a_function_of_several_operations_is_taken_apart),
        cmocka_unit_test(a_highp_value_is_rounded_when_a_mediump_variable_takes_it),
        cmocka_unit_test(a_mediump_function_rounds_what_it_returns_and_takes),
        cmocka_unit_test(a_literal_is_rounded_only_where_rounding_changes_it),
        cmocka_unit_test(a_mediump_member_of_a_struct_is_rounded_where_it_is_read),
        cmocka_unit_test(lowp_is_told_from_mediump_where_it_is_fixed_point),
        cmocka_unit_test(what_is_mediump_by_default_is_not_lowp),
        cmocka_unit_test(a_sampler_without_precision_is_lowp),
        cmocka_unit_test(highp_and_functions_that_nothing_calls_are_left_alone),
        cmocka_unit_test(an_invalid_source_gives_the_words_of_the_compiler),
        cmocka_unit_test(the_version_is_the_one_of_the_source_while_it_is_preprocessed),
        cmocka_unit_test(blocks_keep_their_layout_and_have_no_instance_name),
        cmocka_unit_test(a_local_name_does_not_hide_a_member_of_a_block),
        cmocka_unit_test(all_shipped_shaders_come_out_valid_in_every_version),
    };
    return validator_is_missing() ? 77 : run_tests(tests);
}
