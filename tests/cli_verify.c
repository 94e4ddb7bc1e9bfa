// shadebench verify --classes, and presets side by side, on the null runner.
#include "cli_fixture.h"

static void the_shipped_suite_is_verified_without_a_word(void **state)
{
    (void)state;
    check_answer("verify --classes --context null -q", 0,
                 "0 failed, 0 not to be had here");
    check_answer("verify --classes --context null -q", 0, "tunnel ");
    check_answer("verify --classes classes --context null -q --scene plane", 0, "plane ");
}

static void a_suite_may_be_named_and_varied(void **state)
{
    (void)state;
    const char *file = write_file("two.yaml", "suite: two\nbase: {point: 2}\n"
                                              "sweep: {loop: [constant, dynamic]}\n"
                                              "cross: {model: [lambert, blinn]}\n");
    char line[256];
    snprintf(line, sizeof line, "verify --classes %s --context null -q", file);
    check_answer(line, 0,
                 "4 variants in 2 classes, 2 pairs of pictures compared: 0 failed");
    check_answer(line, 0, "model=lambert        2      2                   0  ok");
    snprintf(line, sizeof line, "verify --classes %s --context null -q --set model=phong",
             file);
    check_answer(line, 0, "2 variants in 1 classes, 1 pairs");
}

static void json_has_every_class_and_variant(void **state)
{
    (void)state;
    write_file("json.yaml", "suite: json\nbase: {point: 2}\n"
                            "sweep: {loop: [constant, dynamic]}\n");
    json_t *json = run_json("verify --classes @/json.yaml --context null --json", 0);
    assert_int_equal(json_integer_value(json_object_get(json, "compared")), 1);
    const json_t *class = json_array_get(json_object_get(json, "classes"), 0);
    assert_string_equal(json_string_value(json_object_get(class, "scene")), "containers");
    assert_string_equal(json_string_value(json_object_get(class, "status")), "ok");
    assert_true(json_is_true(json_object_get(class, "exact")));
    check_close(json_real_value(json_object_get(class, "largest_difference")), 0, 0);
    const json_t *variants = json_object_get(class, "variants");
    assert_int_equal(json_array_size(variants), 2);
    const json_t *second = json_array_get(variants, 1);
    assert_string_equal(json_string_value(json_object_get(second, "variant")),
                        "context=null,point=2,loop=dynamic");
    assert_true(json_is_null(json_object_get(second, "note")));
    assert_true(json_is_null(json_object_get(second, "same_code_as")));
    json_decref(json);
}

static void what_cannot_be_verified_says_why(void **state)
{
    (void)state;
    check_answer("verify --classes --context null nosuch", 2, "unknown suite \"nosuch\"");
    check_answer("verify --classes lights mix", 2, "\"mix\" is one too many");
    check_answer("verify --classes --images", 2, "unknown option \"--images\"");
    check_answer("run --classes", 2, "unknown option \"--classes\"");
    check_answer("verify --classes --point 4", 2, "--set point=4");
    write_file("alone.yaml", "suite: alone\nsweep: {model: [lambert, blinn]}\n");
    check_answer("verify --classes @/alone.yaml --context null -q", 2,
                 "alone: no two variants of a class were drawn, so nothing was compared");
    check_answer("verify --help", 0, "--classes");
}

// A data folder of our own: two presets, and the shaders of this one.
static void make_data(void)
{
    struct sb_error err;
    char path[128];
    snprintf(path, sizeof path, "%s/data/bench/presets", test_dir);
    assert_true(sb_dir_make(path, &err));
    check_shell("ln -s '" SB_SOURCE_DIR "/shaders' @/data/shaders", 0, "");
    write_file("data/bench/presets/elm.yaml",
               "suite: elm\nscene: sphere\nbase: {point: 2, model: phong}\n");
    write_file("data/bench/presets/oak.yaml",
               "suite: oak\nbase: {dir: 1, layout: unified}\n");
}

static void presets_run_side_by_side_and_the_table_tells_them_apart(void **state)
{
    (void)state;
    make_data();
    static const char run[] = "run --data @/data --preset elm,oak --sweep "
                              "loop=constant,dynamic --context null -q "
                              "--rounds 10 --first-look 10 --span 0 -o @/side";
    check_answer(run, 0, "\nsphere      elm,loop=constant  ");
    struct sb_csv csv;
    read_csv("side/summary.csv", &csv);
    assert_int_equal(csv.row_count, 5);
    assert_string_equal(csv_cell(&csv, 1, "variant"), "elm,context=null,loop=constant");
    assert_string_equal(csv_cell(&csv, 1, "model"), "phong");
    assert_string_equal(csv_cell(&csv, 4, "variant"), "oak,context=null,loop=dynamic");
    assert_string_equal(csv_cell(&csv, 4, "layout"), "unified");
    sb_csv_free(&csv);
    check_answer("run --resume @/side -q", 0, "containers  oak,loop=dynamic ");
    check_answer("run --data @/data --preset elm,ork", 2, "unknown preset \"ork\"");
    // An id can be shown as it stands.
    check_answer("show --data @/data elm,loop=dynamic", 0,
                 "// elm,loop=dynamic: program shade, vertex shader");
    check_answer("show --data @/data elm,loop=dynamic", 0, "#define NR_POINT_LIGHTS 2\n");
    check_answer("show --data @/data loop=dynamic,elm", 2, "AXIS=VALUE,… is wanted");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shipped_suite_is_verified_without_a_word),
        cmocka_unit_test(a_suite_may_be_named_and_varied),
        cmocka_unit_test(json_has_every_class_and_variant),
        cmocka_unit_test(what_cannot_be_verified_says_why),
        cmocka_unit_test(presets_run_side_by_side_and_the_table_tells_them_apart),
    };
    return end_tests(run_tests(tests));
}
