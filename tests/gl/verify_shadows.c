// A run with shadows on a real context: the split of its time, and the pictures of its maps.
#include "cli_gl.h"

static double number(const struct sb_csv *csv, int line, const char *column)
{
    return strtod(csv_cell(csv, line, column), NULL);
}

static void shadow_maps_that_are_drawn_each_frame_have_a_time_and_all_have_pictures(
    void **state)
{
    (void)state;
    static struct answer answer;
    char line[512];
    struct sb_csv csv;
    write_file("shadows.yaml",
               "suite: shadows\nscene: room\ntarget: 64x64\n"
               "base: {point: 3, shadows: 2, shadow_size: 64}\n"
               "cross: {update: [static, lights, lights+shadows],\n"
               "        shadow_map: [cube, six2d]}\n"
               "measure: {rounds: 10, first_look: 10, budget: 5, batch: 1, span: 0}\n");
    snprintf(line, sizeof line, "run @/shadows.yaml -q --images -o @/shadows %s",
             platform);
    run_timed(&answer, line);
    if (answer.code != 0)
        fail_msg("%s\nexit code %d: %s", line, answer.code, answer.text);
    read_csv("shadows/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 6);
    for (int i = 1; i <= 6; i++) {
        char path[512];
        const bool drawn = strcmp(csv_cell(&csv, i, "update"), "lights+shadows") == 0;
        assert_int_equal(*csv_cell(&csv, i, "shadow_ms") != '\0', drawn);
        assert_int_equal(*csv_cell(&csv, i, "shading_ms") != '\0', drawn);
        if (drawn) {
            // What another process does to a batch of a millisecond may make a part of it
            // longer than the whole; only that the two make up the frame is certain.
            assert_true(number(&csv, i, "shadow_ms") > 0);
            check_close(number(&csv, i, "shadow_ms") + number(&csv, i, "shading_ms"),
                        number(&csv, i, "median_ms"), 1e-9);
        }
        for (int caster = 0; caster < 3; caster++) {
            snprintf(path, sizeof path, "%s/shadows/images/room-%s-shadow%d.png",
                     test_dir, csv_cell(&csv, i, "variant"), caster);
            assert_int_equal(sb_file_exists(path), caster < 2);
        }
    }
    sb_csv_free(&csv);
    // The casters stand elsewhere, so their maps differ; the kind of map does not matter.
    check_shell("cd @/shadows/images && cksum room-*update=static*-shadow?.png | "
                "cut -d' ' -f1 | sort | uniq -c | awk '{ printf \"%s \", $1 }'",
                0, "2 2 ");
}

int main(void)
{
    begin_gl_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            shadow_maps_that_are_drawn_each_frame_have_a_time_and_all_have_pictures),
    };
    return end_tests(run_tests(tests));
}
