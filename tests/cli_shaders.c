// Shader folders that are wrong, as far as they can be told without a driver; and the
// installed program, which has its shaders elsewhere.
#include "cli_fixture.h"

static void copy_shaders(const char *name)
{
    char line[256];
    snprintf(line, sizeof line, "cp -r '%s/shaders' @/%s", SB_SOURCE_DIR, name);
    check_shell(line, 0, "");
}

static void a_missing_include_is_named_where_it_is_asked_for(void **state)
{
    (void)state;
    struct sb_csv csv;
    copy_shaders("missing");
    check_shell("rm @/missing/cone/linear.glsl", 0, "");
    check_answer("show cone=linear,spot=1 --shaders @/missing", 2, "lighting.glsl:");
    check_answer("show cone=linear,spot=1 --shaders @/missing", 2,
                 "missing/cone/linear.glsl: No such file");
    // The other variants do not need it.
    check_answer(
        "run --context null -q --sweep cone=hard,linear --set spot=1 --rounds 20 "
        "--first-look 20 --shaders @/missing -o @/run",
        2, "bad_input");
    read_csv("run/summary.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "status"), "ok");
    assert_string_equal(csv_cell(&csv, 2, "status"), "bad_input");
    check_contains(csv_cell(&csv, 2, "note"), "lighting.glsl:");
    assert_string_equal(csv_cell(&csv, 2, "median_ms"), "");
    assert_string_equal(csv_cell(&csv, 2, "rounds"), "");
    sb_csv_free(&csv);
}

static void a_folder_that_is_none_is_refused(void **state)
{
    (void)state;
    check_answer("show --shaders @/none", 2, "none: there is no such folder");
    check_shell("touch @/file; exec $SB show --shaders @/file 2>&1", 2,
                "file: there is no such folder");
    check_shell("mkdir @/empty; exec $SB show --shaders @/empty 2>&1", 2,
                "empty/shade.vert: No such file");
    check_answer("show --data @/empty", 2, "no folder shaders/ in");
    check_shell("SHADEBENCH_DATA=@/empty exec $SB list 2>&1", 2, "$SHADEBENCH_DATA");
}

static void validation_names_the_file_and_line_that_is_wrong(void **state)
{
    (void)state;
    static struct answer answer;
    run_shell(&answer, "glslangValidator --version 2>&1");
    if (answer.code != 0)
        skip();
    copy_shaders("wrong");
    check_shell("sed -i '/Shade shade = shade_surface/s/^/    nowhere = 1.0;\\n/' "
                "@/wrong/stage/vertex.vert; grep -n nowhere @/wrong/stage/vertex.vert",
                0, "11:");
    check_answer("show stage=vertex,point=1 --validate --shaders @/wrong", 3,
                 "stage/vertex.vert:11");
    check_answer("show stage=fragment,point=1 --validate --shaders @/wrong", 0,
                 "void main");
    check_answer("show stage=vertex,point=1 --validate", 0, "void main");
}

static void the_installed_program_runs_from_anywhere(void **state)
{
    (void)state;
    // SB_PROGRAM is BUILD/bin/shadebench.
    check_shell(
        "cmake --install \"$(dirname \"$(dirname '$SB')\")\" --prefix '@/usr' 2>&1", 0,
        "bin/shadebench");
    check_shell("cd / && exec @/usr/bin/shadebench list 2>&1", 0, "lights");
    check_shell("cd / && exec @/usr/bin/shadebench run ci -q --context null --rounds 20 "
                "--first-look 20 -o @/installed 2>&1",
                0, "results: ");
    // Found by way of a link, too.
    check_shell("ln -s usr/bin/shadebench @/link; cd / && exec @/link show 2>&1", 0,
                "void main");
    check_shell(
        "rm -r @/usr/share/shadebench/shaders; exec @/usr/bin/shadebench list 2>&1", 2,
        "from the installation");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_missing_include_is_named_where_it_is_asked_for),
        cmocka_unit_test(a_folder_that_is_none_is_refused),
        cmocka_unit_test(validation_names_the_file_and_line_that_is_wrong),
        cmocka_unit_test(the_installed_program_runs_from_anywhere),
    };
    return end_tests(run_tests(tests));
}
