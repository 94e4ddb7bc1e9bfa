// Texts reduced to what main() reaches.
#include "test.h"

#include "glsl/reduce.h"

// The source has line i of file 0 at line i.
static void reduce(const char *plain, struct sb_glsl_source *source)
{
    static const char *const name[] = {"a.frag"};
    *source = (struct sb_glsl_source){.file_name = (const char **)name, .file_count = 1};
    for (const char *p = plain; *p; p++)
        source->line_count += *p == '\n';
    source->line = sb_arena_alloc(&source->arena, ((size_t)source->line_count + 1) *
                                                      sizeof *source->line);
    for (int i = 0; i < source->line_count; i++)
        source->line[i] = (struct sb_glsl_line){0, i + 1};
    sb_glsl_reduce(source, plain);
}

static void check(const char *plain, const char *wanted)
{
    struct sb_glsl_source source;
    reduce(plain, &source);
    assert_string_equal(source.text, wanted);
    sb_arena_free(&source.arena);
}

static void what_main_does_not_reach_is_gone(void **state)
{
    (void)state;
    check("#version 330 core\n"
          "struct Used { float x; };\nstruct Spare { float y; };\n"
          "uniform Used u_used;\nuniform Spare u_spare;\nuniform float u_a, u_b[2];\n"
          "float f(float x)\n{\n    return x + u_b[1];\n}\n"
          "float g(float x) { return f(x); }\n"
          "void main() { gl_FragDepth = f(u_used.x); }\n",
          "#version 330 core\n\nstruct Used { float x; };\n\nuniform Used u_used;\n"
          "uniform float u_a, u_b[2];\n\n"
          "float f(float x)\n{\n    return x + u_b[1];\n}\n\n"
          "void main() { gl_FragDepth = f(u_used.x); }\n");
}

static void prototypes_overloads_and_blocks_stay_with_what_names_them(void **state)
{
    (void)state;
    check("float f(float x);\nfloat g(float x);\n"
          "layout(std140) uniform Block {\n    vec4 inside;\n};\n"
          "uniform Other { vec4 outside; };\n"
          "const float table[2] = float[2](1.0, 2.0);\n"
          "float f(float x) { return inside.x; }\nfloat f(vec2 x) { return table[0]; }\n"
          "precision highp float;\nvoid main() { f(1.0); }\n",
          "float f(float x);\n\nlayout(std140) uniform Block {\n    vec4 inside;\n};\n\n"
          "const float table[2] = float[2](1.0, 2.0);\n\n"
          "float f(float x) { return inside.x; }\n\n"
          "float f(vec2 x) { return table[0]; }\n\nprecision highp float;\n\n"
          "void main() { f(1.0); }\n");
}

static void calls_of_functions_that_do_nothing_go_with_them(void **state)
{
    (void)state;
    check("void nothing(int i)\n{\n}\nvoid some() { discard; }\n"
          "void main()\n{\n    nothing(1);\n    some();\n}\n",
          "void some() { discard; }\n\nvoid main()\n{\n    some();\n}\n");
}

static void two_texts_that_do_the_same_are_the_same(void **state)
{
    (void)state;
    struct sb_glsl_source a, b;
    reduce("\n\n   float f() { return 1.0; }\nvoid main() { f(); }\n", &a);
    reduce(
        "float g() { return 2.0; }\nfloat f() { return 1.0; }\n\nvoid main() { f(); }\n",
        &b);
    assert_string_equal(a.text, b.text);
    assert_true(a.hash == b.hash);
    sb_arena_free(&a.arena);
    sb_arena_free(&b.arena);
}

static void lines_keep_their_origin(void **state)
{
    (void)state;
    struct sb_glsl_source source;
    reduce("#version 330\n\nfloat unused;\n\nvoid main()\n{\n\n    x();\n}\n", &source);
    assert_string_equal(source.text, "#version 330\n\nvoid main()\n{\n    x();\n}\n");
    static const int lines[] = {1, 1, 5, 6, 8, 9}; // the blank one is nobody's
    assert_int_equal(source.line_count, 6);
    for (int i = 0; i < 6; i++)
        if (i != 1) {
            assert_int_equal(source.line[i].file, 0);
            assert_int_equal(source.line[i].line, lines[i]);
        }
    sb_arena_free(&source.arena);
}

static void a_text_that_is_not_understood_stays_whole(void **state)
{
    (void)state;
    check("float f( { return 1.0;\nvoid main() {}\n",
          "float f( { return 1.0;\n        void main() {}\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_main_does_not_reach_is_gone),
        cmocka_unit_test(prototypes_overloads_and_blocks_stay_with_what_names_them),
        cmocka_unit_test(calls_of_functions_that_do_nothing_go_with_them),
        cmocka_unit_test(two_texts_that_do_the_same_are_the_same),
        cmocka_unit_test(lines_keep_their_origin),
        cmocka_unit_test(a_text_that_is_not_understood_stays_whole),
    };
    return run_tests(tests);
}
