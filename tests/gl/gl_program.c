#include "gl/program.h"
#include "gl_test.h"
#include "test.h"

static struct gl_test test;

#define VERTEX                                                                           \
    "in vec3 a_position; in vec3 a_normal; in vec2 a_uv; in vec4 a_tangent;\n"           \
    "out vec4 v_sum;\n"                                                                  \
    "void main() {\n"                                                                    \
    "    v_sum = vec4(a_normal, 1.0) + a_uv.xyxy + a_tangent;\n"                         \
    "    gl_Position = vec4(a_position, 1.0);\n"                                         \
    "}\n"
#define FRAGMENT "in vec4 v_sum; out vec4 o_colour; void main() { o_colour = v_sum; }\n"

static const char *with_version(const char *body, char text[static 1024])
{
    const char *head =
        test.caps.gles ? "#version 300 es\nprecision highp float;\n" : "#version 330\n";
    snprintf(text, 1024, "%s%s", head, body);
    return text;
}

static bool make(const char *vertex, const char *fragment, struct sb_gl_program *program)
{
    char v[1024], f[1024];
    return sb_gl_program_make(&(struct sb_program){.vertex = with_version(vertex, v),
                                                   .fragment = with_version(fragment, f)},
                              program);
}

static void a_program_links_with_its_attributes_in_place(void **state)
{
    (void)state;
    static const char *const names[] = {"a_position", "a_normal", "a_uv", "a_tangent"};
    struct sb_gl_program program;
    assert_true(make(VERTEX, FRAGMENT, &program));
    assert_true(program.name != 0);
    assert_null(program.log);
    assert_true(program.compile_ms > 0);
    assert_true(program.link_ms > 0);
    for (int i = 0; i < 4; i++)
        assert_int_equal(glGetAttribLocation(program.name, names[i]), i);
    sb_gl_program_free(&program);
    assert_int_equal(program.name, 0);
    assert_null(sb_gl_error());
}

static void a_binary_has_a_hash_that_differs_with_the_code(void **state)
{
    (void)state;
    struct sb_gl_program a, b;
    assert_true(make(VERTEX, FRAGMENT, &a));
    assert_true(make(VERTEX,
                     "in vec4 v_sum; out vec4 o_colour;\n"
                     "void main() { o_colour = v_sum * v_sum; }\n",
                     &b));
    assert_int_equal(a.binary_hash != 0, test.caps.program_binary > 0);
    assert_int_equal(a.binary_hash != b.binary_hash, test.caps.program_binary > 0);
    sb_gl_program_free(&a);
    sb_gl_program_free(&b);
}

static void check_failure(const char *vertex, const char *fragment,
                          enum sb_failed_stage stage, const char *word)
{
    struct sb_gl_program program;
    assert_false(make(vertex, fragment, &program));
    assert_int_equal(program.name, 0);
    assert_int_equal(program.failed_stage, stage);
    assert_non_null(program.log);
    check_contains(program.log, word);
    sb_gl_program_free(&program);
    assert_null(program.log);
    assert_null(sb_gl_error());
}

static void a_compile_error_comes_with_its_stage_and_log(void **state)
{
    (void)state;
    check_failure("void main() { gl_Position = vec4(no_vertex); }\n", FRAGMENT,
                  SB_STAGE_VERT, "no_vertex");
    check_failure(VERTEX, "out vec4 o_colour; void main() { o_colour = no_fragment; }\n",
                  SB_STAGE_FRAG, "no_fragment");
}

static void a_link_error_comes_with_its_stage_and_log(void **state)
{
    (void)state;
    check_failure(
        VERTEX,
        "in vec2 v_sum; out vec4 o_colour; void main() { o_colour = v_sum.xyxy; }\n",
        SB_STAGE_LINK, "v_sum");
}

// A GLES context has them from 3.2, or by an extension that the text would have to name.
static bool has_geometry_shaders(void)
{
    return !test.caps.gles || test.caps.api_version >= 320;
}

static bool make_with_geometry(const char *body, struct sb_gl_program *program)
{
    const char *head = !test.caps.gles ? "#version 330\n"
                       : has_geometry_shaders()
                           ? "#version 320 es\nprecision highp float;\n"
                           : "#version 300 es\nprecision highp float;\n";
    char vertex[1024], geometry[1024], fragment[1024];
    snprintf(
        vertex, sizeof vertex, "%s%s", head,
        "in vec3 a_position; void main() { gl_Position = vec4(a_position, 1.0); }\n");
    snprintf(geometry, sizeof geometry, "%s%s", head, body);
    snprintf(fragment, sizeof fragment, "%s%s", head, FRAGMENT);
    return sb_gl_program_make(&(struct sb_program){"shadow", vertex, geometry, fragment},
                              program);
}

static void a_geometry_shader_stands_between_the_others(void **state)
{
    (void)state;
    struct sb_gl_program program;
    if (!has_geometry_shaders())
        skip();
    // v_sum comes from nowhere else.
    const bool ok = make_with_geometry("layout(triangles) in;\n"
                                       "layout(triangle_strip, max_vertices = 3) out;\n"
                                       "out vec4 v_sum;\n"
                                       "void main() {\n"
                                       "    for (int i = 0; i < 3; i++) {\n"
                                       "        gl_Position = gl_in[i].gl_Position;\n"
                                       "        v_sum = vec4(1.0);\n"
                                       "        EmitVertex();\n"
                                       "    }\n"
                                       "}\n",
                                       &program);
    if (!ok)
        fail_msg("%s", program.log);
    sb_gl_program_free(&program);
    assert_false(make_with_geometry("void main() { no_geometry; }\n", &program));
    assert_int_equal(program.failed_stage, SB_STAGE_GEOM);
    check_contains(program.log, "no_geometry");
    sb_gl_program_free(&program);
    assert_null(sb_gl_error());
}

static PFNGLCREATESHADERPROC real_create;

static GLuint GLAD_API_PTR create_without_geometry(GLenum kind)
{
    return real_create(kind == GL_GEOMETRY_SHADER ? 0 : kind);
}

static void a_driver_without_geometry_shaders_refuses_them_in_words(void **state)
{
    (void)state;
    struct sb_gl_program program;
    real_create = glad_glCreateShader;
    glad_glCreateShader = create_without_geometry;
    assert_false(make_with_geometry("", &program));
    glad_glCreateShader = real_create;
    assert_int_equal(program.failed_stage, SB_STAGE_GEOM);
    check_contains(program.log, "no shaders of this stage");
    sb_gl_program_free(&program);
    assert_null(sb_gl_error());
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_program_links_with_its_attributes_in_place),
        cmocka_unit_test(a_binary_has_a_hash_that_differs_with_the_code),
        cmocka_unit_test(a_compile_error_comes_with_its_stage_and_log),
        cmocka_unit_test(a_link_error_comes_with_its_stage_and_log),
        cmocka_unit_test(a_geometry_shader_stands_between_the_others),
        cmocka_unit_test(a_driver_without_geometry_shaders_refuses_them_in_words),
    };
    gl_test_open(&test);
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
