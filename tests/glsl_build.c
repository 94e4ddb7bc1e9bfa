#include "shader_folder.h"

#include "glsl/glsl.h"

static const struct sb_glsl_define defines[] = {
    {"LAW", "linear"},
    {"COUNT", "4"},
    {"UP", ".."},
};

static const struct sb_glsl_text given[] = {
    {"made/lights.glsl", "p\n#include \"unit.glsl\"\nq\n"},
    {"made/empty.glsl", ""},
    {"made/wrong.glsl", "\n#include \"none.glsl\"\n"},
    {"made/round.glsl", "#include \"made/round.glsl\"\n"},
};

static bool build(const struct shader_folder *folder, struct sb_glsl_source *source,
                  struct sb_error *err)
{
    const struct sb_glsl_params params = {
        .root = folder->root,
        .file = "main.vert",
        .version = "300 es",
        .define = defines,
        .define_count = 3,
        .given = given,
        .given_count = sizeof given / sizeof *given,
    };
    return sb_glsl_build(&params, source, err);
}

static const char head[] = "#version 300 es\n"
                           "#define LAW linear\n"
                           "#define COUNT 4\n"
                           "#define UP ..\n";

// What main.vert, with one line of text in it, comes to.
static void check_error(const char *main_text, const char *message)
{
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert", main_text);
    struct sb_glsl_source source = {0};
    struct sb_error err = {0};
    assert_false(build(&folder, &source, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, message);
    sb_glsl_free(&source);
    folder_free(&folder);
}

static void version_and_defines_come_first(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert", "void main() {}");
    struct sb_glsl_source source = {0};
    assert_true(build(&folder, &source, NULL));
    assert_memory_equal(source.text, head, strlen(head));
    assert_string_equal(source.text + strlen(head), "void main() {}\n");
    assert_int_equal(source.line_count, 5);
    assert_int_equal(source.line[3].file, -1);
    assert_int_equal(source.line[4].file, 0);
    assert_int_equal(source.line[4].line, 1);
    sb_glsl_free(&source);
    folder_free(&folder);
}

struct from { // where a line is from
    const char *file;
    int line;
};

// The lines behind the head.
static void check_lines(const struct sb_glsl_source *source, const struct from *expected,
                        int count)
{
    assert_int_equal(source->line_count, 4 + count);
    for (int i = 0; i < count; i++) {
        const struct sb_glsl_line from = source->line[4 + i];
        assert_string_equal(source->file_name[from.file], expected[i].file);
        assert_int_equal(from.line, expected[i].line);
    }
}

static void includes_are_replaced_once_and_lines_are_mapped(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert",
                 "a\n"
                 "#include \"law/$(LAW).glsl\"\n"
                 "b\r\n"
                 "  #  include \"unit.glsl\" // again\n"
                 "c\n");
    folder_write(&folder, "law/linear.glsl", "#include \"unit.glsl\"\nl\n");
    folder_write(&folder, "unit.glsl", "u\nv\n");
    struct sb_glsl_source source = {0};
    assert_true(build(&folder, &source, NULL));
    assert_string_equal(source.text + strlen(head), "a\nu\nv\nl\nb\nc\n");

    static const struct from expected[] = {{"main.vert", 1}, {"unit.glsl", 1},
                                           {"unit.glsl", 2}, {"law/linear.glsl", 2},
                                           {"main.vert", 3}, {"main.vert", 5}};
    check_lines(&source, expected, 6);
    sb_glsl_free(&source);
    folder_free(&folder);
}

static void a_given_text_stands_in_for_a_file(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert",
                 "a\n"
                 "#include \"made/lights.glsl\"\n"
                 "#include \"made/empty.glsl\"\n"
                 "#include \"made/lights.glsl\"\n"
                 "b\n");
    folder_write(&folder, "unit.glsl", "u\n");
    folder_write(&folder, "made/lights.glsl", "not this one\n");
    struct sb_glsl_source source = {0};
    assert_true(build(&folder, &source, NULL));
    assert_string_equal(source.text + strlen(head), "a\np\nu\nq\nb\n");
    static const struct from expected[] = {{"main.vert", 1},
                                           {"made/lights.glsl", 1},
                                           {"unit.glsl", 1},
                                           {"made/lights.glsl", 3},
                                           {"main.vert", 5}};
    check_lines(&source, expected, 5);
    sb_glsl_free(&source);
    folder_free(&folder);
}

static void an_error_in_a_given_text_names_it(void **state)
{
    (void)state;
    check_error("#include \"made/wrong.glsl\"\n", "made/wrong.glsl:2: ");
    check_error("#include \"made/round.glsl\"\n",
                "made/round.glsl:1: files include each other: made/round.glsl -> "
                "made/round.glsl");
    check_error("#include \"made/none.glsl\"\n", "made/none.glsl: No such file");
}

static void equal_texts_have_equal_hashes_and_others_not(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert", "a\n");
    struct sb_glsl_source first = {0}, second = {0}, third = {0};
    assert_true(build(&folder, &first, NULL));
    assert_true(build(&folder, &second, NULL));
    folder_write(&folder, "main.vert", "b\n");
    assert_true(build(&folder, &third, NULL));
    assert_true(first.hash == second.hash);
    assert_true(first.hash != third.hash);
    sb_glsl_free(&first);
    sb_glsl_free(&second);
    sb_glsl_free(&third);
    folder_free(&folder);
}

static void an_include_that_is_none_is_left_alone(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert", "// #include \"x\"\n#if 0\n#endif\n");
    struct sb_glsl_source source = {0};
    assert_true(build(&folder, &source, NULL));
    assert_string_equal(source.text + strlen(head), "// #include \"x\"\n#if 0\n#endif\n");
    sb_glsl_free(&source);
    folder_free(&folder);
}

static void values_stand_in_directives_and_nowhere_else(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert",
                 "#define law law_$(LAW)\n"
                 "  # define $(LAW)_$(COUNT) $(COUNT)$(COUNT) // $(UP)\n"
                 "#define plain (1.0)\n"
                 "law(); // $(LAW) $(\n");
    struct sb_glsl_source source = {0};
    assert_true(build(&folder, &source, NULL));
    assert_string_equal(source.text + strlen(head), "#define law law_linear\n"
                                                    "  # define linear_4 44 // ..\n"
                                                    "#define plain (1.0)\n"
                                                    "law(); // $(LAW) $(\n");
    static const struct from expected[] = {
        {"main.vert", 1}, {"main.vert", 2}, {"main.vert", 3}, {"main.vert", 4}};
    check_lines(&source, expected, 4);
    sb_glsl_free(&source);
    folder_free(&folder);
    check_error("\n#define law law_$(LAV)\n", "main.vert:2: no define \"LAV\"");
    check_error("#define law law_$(LAW\n", "\"$(\" without \")\"");
}

static void a_wrong_include_is_refused_where_it_stands(void **state)
{
    (void)state;
    check_error("\n\n#include \"none.glsl\"\n", "main.vert:3: ");
    check_error("#include \"none.glsl\"\n", "No such file");
    check_error("#include <a.glsl>\n", "main.vert:1: #include wants a name in quotes");
    check_error("#include \"a.glsl\" b\n", "#include wants a name in quotes");
    check_error("#include \"a.glsl\n", "#include wants a name in quotes");
    check_error("#include \"$(LAV).glsl\"\n", "no define \"LAV\"; did you mean \"LAW\"?");
    check_error("#include \"$(XYZZY)\"\n", "no define \"XYZZY\"; valid: LAW COUNT UP");
    check_error("#include \"$(LAW.glsl\"\n", "\"$(\" without \")\"");
}

static void no_include_leads_out_of_the_folder(void **state)
{
    (void)state;
    static const char *const names[] = {"/etc/passwd", "../a", "a/../../b", "./a", "a//b",
                                        "$(UP)/a",     "a\\b", "",          "a/"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[64];
        snprintf(text, sizeof text, "#include \"%s\"\n", names[i]);
        check_error(text, "names are relative to the shader folder");
    }
}

static void a_cycle_is_refused_with_its_files(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert", "#include \"a.glsl\"\n");
    folder_write(&folder, "a.glsl", "\n#include \"b.glsl\"\n");
    folder_write(&folder, "b.glsl", "\n\n#include \"a.glsl\"\n");
    struct sb_glsl_source source = {0};
    struct sb_error err = {0};
    assert_false(build(&folder, &source, &err));
    check_contains(err.text,
                   "b.glsl:3: files include each other: a.glsl -> b.glsl -> a.glsl");
    sb_glsl_free(&source);
    folder_free(&folder);
}

// A chain of `count` files, each including the next.
static bool build_chain(int count, struct sb_error *err)
{
    struct shader_folder folder;
    folder_make(&folder);
    folder_write(&folder, "main.vert", "#include \"1.glsl\"\n");
    for (int i = 1; i < count; i++) {
        char name[32], text[64];
        snprintf(name, sizeof name, "%d.glsl", i);
        snprintf(text, sizeof text, "#include \"%d.glsl\"\n", i + 1);
        folder_write(&folder, name, i + 1 < count ? text : "x\n");
    }
    struct sb_glsl_source source = {0};
    const bool good = build(&folder, &source, err);
    sb_glsl_free(&source);
    folder_free(&folder);
    return good;
}

static void includes_nest_sixteen_files_deep_and_no_deeper(void **state)
{
    (void)state;
    struct sb_error err = {0};
    assert_true(build_chain(16, &err));
    assert_false(build_chain(17, &err));
    check_contains(err.text, "15.glsl:1: includes are nested deeper than 16 files");
}

static void a_file_with_a_nul_byte_is_refused(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    folder_write_n(&folder, "main.vert", "a\0b", 3);
    struct sb_glsl_source source = {0};
    struct sb_error err = {0};
    assert_false(build(&folder, &source, &err));
    check_contains(err.text, "main.vert: holds a NUL byte");
    sb_glsl_free(&source);
    folder_free(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(version_and_defines_come_first),
        cmocka_unit_test(includes_are_replaced_once_and_lines_are_mapped),
        cmocka_unit_test(a_given_text_stands_in_for_a_file),
        cmocka_unit_test(an_error_in_a_given_text_names_it),
        cmocka_unit_test(equal_texts_have_equal_hashes_and_others_not),
        cmocka_unit_test(an_include_that_is_none_is_left_alone),
        cmocka_unit_test(values_stand_in_directives_and_nowhere_else),
        cmocka_unit_test(a_wrong_include_is_refused_where_it_stands),
        cmocka_unit_test(no_include_leads_out_of_the_folder),
        cmocka_unit_test(a_cycle_is_refused_with_its_files),
        cmocka_unit_test(includes_nest_sixteen_files_deep_and_no_deeper),
        cmocka_unit_test(a_file_with_a_nul_byte_is_refused),
    };
    return run_tests(tests);
}
