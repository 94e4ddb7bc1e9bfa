// A renamed program is the same program.
#include "glsl/rename.h"
#include "test.h"

static void check_renamed(const char *text, const char *wanted)
{
    char *renamed = sb_glsl_rename(text);
    assert_string_equal(renamed, wanted);
    free(renamed);
}

static void functions_parameters_and_locals_have_other_names(void **state)
{
    (void)state;
    check_renamed("float half_of(float x)\n{\n    float y = x / 2.0;\n    return y;\n}\n",
                  "float r_half_of(float r_x)\n{\n    float r_y = r_x / 2.0;\n    return "
                  "r_y;\n}\n");
    check_renamed(
        "void main()\n{\n    for (int i = 0; i < 3; i++)\n        f(i);\n}\n",
        "void main()\n{\n    for (int r_i = 0; r_i < 3; r_i++)\n        f(r_i);\n}\n");
}

static void what_the_api_asks_for_keeps_its_name(void **state)
{
    (void)state;
    check_renamed(
        "uniform vec3 u_eye;\nin vec2 v_uv;\nstruct Light { vec3 position; };\n"
        "uniform Light lights[2];\nlayout(std140) uniform Block { vec4 tint; };\n"
        "void main() { vec3 position = lights[0].position; gl_Position = tint; }\n",
        "uniform vec3 u_eye;\nin vec2 v_uv;\nstruct Light { vec3 position; };\n"
        "uniform Light lights[2];\nlayout(std140) uniform Block { vec4 tint; };\n"
        "void main() { vec3 position = lights[0].position; gl_Position = tint; }\n");
}

static void builtins_macros_and_comments_stay(void **state)
{
    (void)state;
    check_renamed("#define SQUARE(x) ((x) * (x))\nfloat f(float a) // of a\n"
                  "{ float length = SQUARE(a); return length + length(vec2(a)); }\n",
                  "#define SQUARE(x) ((x) * (x))\nfloat r_f(float r_a) // of a\n"
                  "{ float length = SQUARE(r_a); return length + length(vec2(r_a)); }\n");
}

static void names_in_macros_follow(void **state)
{
    (void)state;
    check_renamed(
        "#define CALL(x) weigh(x)\nfloat weigh(float k) { return k; }\n",
        "#define CALL(x) r_weigh(x)\nfloat r_weigh(float r_k) { return r_k; }\n");
}

static void a_text_that_pastes_names_stays(void **state)
{
    (void)state;
    check_renamed("#define F(a) light_##a\nfloat f(float x) { return x; }\n",
                  "#define F(a) light_##a\nfloat f(float x) { return x; }\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions_parameters_and_locals_have_other_names),
        cmocka_unit_test(what_the_api_asks_for_keeps_its_name),
        cmocka_unit_test(builtins_macros_and_comments_stay),
        cmocka_unit_test(names_in_macros_follow),
        cmocka_unit_test(a_text_that_pastes_names_stays),
    };
    return run_tests(tests);
}
