// Where exports go: files, what is no file, and the page of a job.
#include "cli_fixture.h"
#include "export_rows.h"

#include <fcntl.h>
#include <sys/stat.h>

static const char *path_of(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", test_dir, name);
    return path;
}

static void a_file_is_replaced_by_all_of_it(void **state)
{
    (void)state;
    struct sb_error err = {0};
    char *wanted = written("bencher", &run_export);
    write_file("out", "something longer than nothing");
    assert_true(sb_export_write(&run_export, format_of("bencher"), path_of("out"), &err));
    char *text = read_file("out");
    check_text(text, wanted);
    free(text);
    free(wanted);
}

static void what_is_no_file_is_written_into_and_stays(void **state)
{
    (void)state;
    struct sb_error err = {0};
    struct stat info;
    char got[256] = "";
    assert_int_equal(mkfifo(path_of("pipe"), 0600), 0);
    const int reader = open(path_of("pipe"), O_RDONLY | O_NONBLOCK);
    assert_true(
        sb_export_write(&pair_export, format_of("markdown"), path_of("pipe"), &err));
    assert_true(read(reader, got, sizeof got - 1) > 0);
    check_contains(got, "### shadebench gate\n");
    close(reader);
    assert_int_equal(stat(path_of("pipe"), &info), 0);
    assert_true(S_ISFIFO(info.st_mode));
}

static void what_cannot_be_written_is_write_failed(void **state)
{
    (void)state;
    struct sb_error err = {0};
    assert_false(
        sb_export_write(&run_export, format_of("go"), path_of("no/where"), &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    check_contains(err.text, "no/where: No such file");
    assert_false(sb_export_write(&run_export, format_of("go"), test_dir, &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    check_contains(err.text, ": Is a directory");
}

static void an_unknown_format_is_answered_with_the_nearest(void **state)
{
    (void)state;
    struct sb_error err = {0};
    assert_null(sb_export_format_find("--write", "gbench-jsn", &err));
    assert_int_equal(err.status, SB_USAGE);
    check_contains(err.text, "--write: unknown format \"gbench-jsn\"; did you mean "
                             "\"gbench-json\"? valid: gbench-json ");
    for (int i = 0; i < sb_export_format_count; i++)
        assert_ptr_equal(
            sb_export_format_find("--write", sb_export_formats[i].name, &err),
            &sb_export_formats[i]);
}

// No format may fail where there is nothing to say.
static void every_format_takes_a_run_of_no_rows(void **state)
{
    (void)state;
    for (int i = 0; i < sb_export_format_count; i++) {
        char *text =
            written(sb_export_formats[i].name, &(struct sb_export){.name = "nothing"});
        assert_non_null(text);
        assert_null(strstr(text, "nan"));
        free(text);
    }
}

// Numbers that are none appear in no format.
static void no_format_writes_what_is_no_number(void **state)
{
    (void)state;
    for (int i = 0; i < sb_export_format_count; i++) {
        char *text = written(sb_export_formats[i].name, &run_export);
        for (char *p = text; *p; p++)
            *p = (char)(*p >= 'A' && *p <= 'Z' ? *p + 32 : *p);
        static const char *const none[] = {":nan", " nan", ",nan", "\tnan",
                                           " inf", "-nan", ",inf", "\tinf"};
        for (size_t n = 0; n < sizeof none / sizeof *none; n++)
            if (strstr(text, none[n]))
                fail_msg("%s: \"%s\" in %s", sb_export_formats[i].name, none[n], text);
        free(text);
    }
}

static void the_page_of_a_job_is_appended_to(void **state)
{
    (void)state;
    struct sb_error err = {0};
    char *markdown = written("markdown", &pair_export);
    struct sb_text wanted = {0};
    sb_text_printf(&wanted, "# Before\n%s\n%s\n", markdown, markdown);
    write_file("summary.md", "# Before\n");
    setenv("GITHUB_STEP_SUMMARY", path_of("summary.md"), 1);
    assert_true(sb_export_step_summary(&pair_export, &err));
    assert_true(sb_export_step_summary(&pair_export, &err));
    char *text = read_file("summary.md");
    check_text(text, wanted.data);
    free(text);

    setenv("GITHUB_STEP_SUMMARY", path_of("no/where"), 1);
    assert_false(sb_export_step_summary(&pair_export, &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    check_contains(err.text, "$GITHUB_STEP_SUMMARY: ");

    setenv("GITHUB_STEP_SUMMARY", "", 1);
    assert_true(sb_export_step_summary(&pair_export, &err));
    unsetenv("GITHUB_STEP_SUMMARY");
    assert_true(sb_export_step_summary(&pair_export, &err));
    text = read_file("summary.md");
    check_text(text, wanted.data);
    free(text);
    free(markdown);
    sb_text_free(&wanted);
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_replaced_by_all_of_it),
        cmocka_unit_test(what_is_no_file_is_written_into_and_stays),
        cmocka_unit_test(what_cannot_be_written_is_write_failed),
        cmocka_unit_test(an_unknown_format_is_answered_with_the_nearest),
        cmocka_unit_test(every_format_takes_a_run_of_no_rows),
        cmocka_unit_test(no_format_writes_what_is_no_number),
        cmocka_unit_test(the_page_of_a_job_is_appended_to),
    };
    return end_tests(run_tests(tests));
}
