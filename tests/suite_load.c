// From the keys of a suite, its preset and the command line to plan entries.
#include "test.h"

#include "suite_text.h"

static void without_anything_the_plan_is_the_default_variant(void **state)
{
    (void)state;
    assert_true(sb_suite_load(&(struct sb_suite_params){0}, &suite, &err));
    must_be("default");
    assert_string_equal(suite.entry[0].scene, "containers");
    check_close(suite.measure.rounds, 2000, 0);
}

static void the_base_alone_is_one_entry(void **state)
{
    (void)state;
    must_load("suite: one\nabout: why\nbase: {point: 4, stage: vertex}\n");
    must_be("point=4,stage=vertex");
    assert_string_equal(suite.name, "one");
    assert_string_equal(suite.about, "why");
    check_close(suite.entry[0].variant.value[SB_AXIS_POINT], 4, 0);
}

static void sweep_is_a_union_in_the_order_written(void **state)
{
    (void)state;
    must_load("suite: x\nbase: {dir: 1}\nsweep:\n  spot: [2, 1]\n  point: 1..4 x2\n");
    must_be("dir=1,spot=2", "dir=1,spot=1", "dir=1,point=1", "dir=1,point=2",
            "dir=1,point=4");
}

static void a_swept_axis_is_at_base_while_another_is_swept(void **state)
{
    (void)state;
    must_load("suite: x\nbase: {point: 8}\nsweep: {point: [1, 2], spot: 3}\n");
    must_be("point=1", "point=2", "point=8,spot=3");
}

static void cross_multiplies_the_sweep_the_last_axis_fastest(void **state)
{
    (void)state;
    must_load("suite: x\nsweep: {point: 1..2}\n"
              "cross: {stage: [fragment, vertex], width: [64, 128]}\n");
    must_be("point=1,width=64,stage=fragment", "point=1,width=128,stage=fragment",
            "point=1,width=64,stage=vertex", "point=1,width=128,stage=vertex",
            "point=2,width=64,stage=fragment", "point=2,width=128,stage=fragment",
            "point=2,width=64,stage=vertex", "point=2,width=128,stage=vertex");
}

static void cross_without_sweep_multiplies_the_base(void **state)
{
    (void)state;
    must_load("suite: x\nbase: {dir: 1}\ncross: {stage: \"vertex, fragment\"}\n");
    must_be("dir=1,stage=vertex", "dir=1,stage=fragment");
}

static void scenes_multiply_everything(void **state)
{
    (void)state;
    must_load("suite: x\nscene: [sphere, containers]\nsweep: {point: 1..2}\n");
    must_be("sphere:point=1", "sphere:point=2", "point=1", "point=2");
    must_load("suite: x\nscene: sphere\n");
    must_be("sphere:default");
}

static void target_sets_three_axes_and_base_has_the_last_word(void **state)
{
    (void)state;
    must_load("suite: x\ntarget: 320x200\n");
    must_be("width=320,height=200");
    must_load("suite: x\nbase: {height: 100}\ntarget: 320x200 rgba16f\n");
    must_be("width=320,height=100,target=rgba16f");
    must_fail("suite: x\ntarget: 256\n", ":2:9", "is not of the form WIDTHxHEIGHT");
    must_fail("suite: x\ntarget: \"\"\n", ":2:9", "is not of the form WIDTHxHEIGHT");
    must_fail("suite: x\ntarget: 2x\n", ":2:9", "is not of the form WIDTHxHEIGHT");
    must_fail("suite: x\ntarget: x2x2\n", ":2:9", "width: \"\" is not a number");
    must_fail("suite: x\ntarget: 2x3 rgba8 4\n", ":2:9", "is not of the form");
    must_fail("suite: x\ntarget: 0x256\n", ":2:9", "width: 0 is out of range");
    must_fail("suite: x\ntarget: 2x2 rgb8\n", ":2:9", "did you mean \"rgba8\"?");
}

static void equal_variants_are_dropped_and_counted(void **state)
{
    (void)state;
    // point=0 and spot=0 are the same as dir=0; cone is moot without spots.
    must_load("suite: x\nsweep: {dir: [0, 1], point: [0, 1], spot: [0], cone: [hard]}\n");
    must_be("dir=0", "dir=1", "point=1");
    assert_int_equal(suite.duplicates, 3);
    // Shorthand does not tell variants apart; scenes do.
    must_load("suite: x\nscene: [sphere, containers]\n"
              "sweep: {precision: [highp, mediump], p_sum: highp}\n");
    must_be("sphere:precision=highp", "sphere:precision=mediump", "precision=highp",
            "precision=mediump");
    assert_int_equal(suite.duplicates, 2);
    must_load("suite: x\nscene: [sphere, sphere]\n");
    assert_int_equal(suite.duplicates, 1);
}

static void excluded_variants_are_dropped_and_counted(void **state)
{
    (void)state;
    must_load(
        "suite: x\nsweep: {point: 1..3, spot: 1}\ncross: {stage: [fragment, vertex]}\n"
        "exclude: [\"stage=vertex,point>1\", spot=1]\n");
    must_be("point=1,stage=fragment", "point=1,stage=vertex", "point=2,stage=fragment",
            "point=3,stage=fragment");
    assert_int_equal(suite.excluded, 4);
}

static void exclude_sees_shorthand_expanded_and_moot_axes_at_init(void **state)
{
    (void)state;
    must_load("suite: x\nsweep: {precision: [highp, mediump]}\nexclude: p_sum=mediump\n");
    must_be("precision=highp");
    must_load(
        "suite: x\nbase: {cone: hard}\nsweep: {spot: [0, 1]}\nexclude: cone=hard\n");
    must_be("spot=0");
}

static void a_plan_without_entries_is_an_error(void **state)
{
    (void)state;
    must_fail("suite: x\nsweep: {point: 0..3}\nexclude: point>=0\n", "",
              "no variant is left: all 4 are excluded");
}

static void ten_thousand_variants_are_planned_and_one_more_refused(void **state)
{
    (void)state;
    must_load("suite: x\ncross: {point: 0..99, spot: 0..99}\n");
    assert_int_equal(suite.entry_count, 10000);
    must_fail("suite: x\nsweep: {width: 1..3334}\ncross: {point: 1..3}\n", "",
              "make 10002 variants, before any is excluded; valid: at most 10000");
    must_fail(
        "suite: x\ncross: {width: 1..4096, height: 1..4096, layers: 1..256, dir: 0..256,"
        "point: 0..256, spot: 0..256}\n",
        "", "at most 10000");
}

// Two entries with one id would be one row written twice.
static void no_two_entries_of_a_scene_share_an_id(void **state)
{
    (void)state;
    must_load("suite: x\nbase: {cone: linear, p_sum: mediump}\n"
              "sweep: {point: 0..3, spot: 0..3, precision: [highp, mediump, mixed]}\n"
              "cross: {stage: [fragment, vertex], normalise: [on, off], cone: [hard, "
              "smooth]}\n");
    for (int i = 0; i < suite.entry_count; i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(suite.entry[i].id, suite.entry[k].id);
}

static void wrong_keys_and_shapes_are_refused_where_they_stand(void **state)
{
    (void)state;
    must_fail("about: y\n", ":1:1", "no name; wanted: suite: NAME");
    must_fail("suite: x/y\n", ":1:8", "valid: letters, digits, - and _");
    must_fail("suite: x\nsweeep: {}\n", ":2:1",
              "unknown key \"sweeep\"; did you mean \"sweep\"?");
    must_fail("suite: x\nbase: [point]\n", ":2:7", "base must be a map");
    must_fail("suite: x\nsweep: point\n", ":2:8", "sweep must be a map");
    must_fail("suite: x\nscene: {a: b}\n", ":2:8", "scene must be one word");
    must_fail("suite: x\nscene: []\n", ":2:8", "an empty list");
    must_fail("suite: x\nscene: [\"\"]\n", ":2:9", "an empty word");
    must_fail("suite: x\nabout: [y]\n", ":2:8", "about must be one word");
    must_fail("suite: x\nmeasure: 3\n", ":2:10", "measure must be a map");
}

static void wrong_axes_and_values_are_refused_where_they_stand(void **state)
{
    (void)state;
    must_fail("suite: x\nbase:\n  stgae: vertex\n", ":3:3", "did you mean \"stage\"?");
    must_fail("suite: x\nbase:\n  stage: vretex\n", ":3:10",
              "stage: unknown value \"vretex\"; did you mean \"vertex\"? valid: fragment "
              "vertex");
    must_fail("suite: x\nbase:\n  point: [1, 2]\n", ":3:10", "in base must be one word");
    must_fail("suite: x\nbase: {point: }\n", ":2:15", "\"\" is not a number");
    must_fail("suite: x\nsweep:\n  point: [1, 1000]\n", ":3:14", "1000 is out of range");
    must_fail("suite: x\nsweep:\n  point: []\n", ":3:3", "point: no values");
    must_fail("suite: x\nsweep:\n  point: [[1]]\n", ":3:11", "a value must be one word");
    must_fail("suite: x\nsweep: {pooint: 1}\n", ":2:9", "did you mean \"point\"?");
    must_fail("suite: x\nsweep: {point: 1}\ncross: {point: 2}\n", ":3:9",
              "point: is there already; an axis stands once, in sweep or in cross");
    must_fail("suite: x\nexclude:\n  - point>1\n  - point=>1\n", ":4:5",
              "is not a number");
}

static void measure_sets_rows_of_its_table(void **state)
{
    (void)state;
    must_load("suite: x\nmeasure: {budget: 20, first_look: 8}\n");
    check_close(suite.measure.budget, 20, 0);
    check_close(suite.measure.first_look, 8, 0);
    check_close(suite.measure.half_width, 0.01, 0);
    must_fail("suite: x\nmeasure:\n  budgt: 20\n", ":3:3",
              "unknown setting \"budgt\"; did you mean \"budget\"? valid: half_width "
              "first_look");
    must_fail("suite: x\nmeasure:\n  rounds: 2.5\n", ":3:3", "not a whole number");
}

static bool load_with(const char *text, struct sb_suite_params params)
{
    return load_bytes(text, strlen(text), params);
}

#define ASSIGN(axis, values)                                                             \
    &(const struct sb_assignment)                                                        \
    {                                                                                    \
#axis, values, "--option " #axis "=" values                                      \
    }
static const char counted[] = "suite: x\nbase: {stage: vertex}\n"
                              "sweep: {point: [1, 2], spot: [1, 2]}\n"
                              "cross: {width: [64, 128]}\n";

static void set_goes_over_base_and_ends_a_sweep_of_its_axis(void **state)
{
    (void)state;
    assert_true(
        load_with(counted, (struct sb_suite_params){.set = ASSIGN(stage, "fragment"),
                                                    .set_count = 1}));
    assert_int_equal(suite.entry_count, 8);
    assert_string_equal(suite.entry[0].id, "point=1,width=64,stage=fragment");
    assert_true(load_with(
        counted, (struct sb_suite_params){.set = ASSIGN(width, "256"), .set_count = 1}));
    must_be("point=1,width=256,stage=vertex", "point=2,width=256,stage=vertex",
            "spot=1,width=256,stage=vertex", "spot=2,width=256,stage=vertex");
}

static void sweep_and_cross_add_and_replace(void **state)
{
    (void)state;
    assert_true(
        load_with(counted, (struct sb_suite_params){.sweep = ASSIGN(point, "4..6"),
                                                    .sweep_count = 1,
                                                    .set = ASSIGN(width, "64"),
                                                    .set_count = 1}));
    must_be("spot=1,width=64,stage=vertex", "spot=2,width=64,stage=vertex",
            "point=4,width=64,stage=vertex", "point=5,width=64,stage=vertex",
            "point=6,width=64,stage=vertex");
    // From sweep to cross.
    assert_true(load_with(counted, (struct sb_suite_params){.cross = ASSIGN(spot, "3"),
                                                            .cross_count = 1,
                                                            .sweep = ASSIGN(width, "8,9"),
                                                            .sweep_count = 1}));
    must_be("point=1,spot=3,stage=vertex", "point=2,spot=3,stage=vertex",
            "spot=3,width=8,stage=vertex", "spot=3,width=9,stage=vertex");
}

static void what_the_command_line_gets_wrong_is_told_by_its_own_words(void **state)
{
    (void)state;
    static const char origin[] = "--set stage=vretex";
    const struct sb_assignment bad_value = {"stage", "vretex", origin};
    const struct sb_assignment bad_axis = {"stgae", "vertex", "--sweep stgae=vertex"};
    const struct sb_assignment twice[] = {{"dir", "1", "--cross dir=1"},
                                          {"dir", "2", "--cross dir=2"}};
    assert_false(
        load_with(counted, (struct sb_suite_params){.set = &bad_value, .set_count = 1}));
    check_contains(err.text, "--set stage=vretex: stage: unknown value \"vretex\"");
    assert_false(load_with(
        counted, (struct sb_suite_params){.sweep = &bad_value, .sweep_count = 1}));
    check_contains(err.text, "--set stage=vretex: stage: unknown value \"vretex\"");
    assert_false(load_with(
        counted, (struct sb_suite_params){.sweep = &bad_axis, .sweep_count = 1}));
    check_contains(err.text, "--sweep stgae=vertex: unknown axis \"stgae\"");
    assert_false(
        load_with(counted, (struct sb_suite_params){.cross = twice, .cross_count = 2}));
    check_contains(err.text, "--cross dir=2: dir: is there already");
}

static void scene_of_the_command_line_stands_for_the_suites(void **state)
{
    (void)state;
    assert_true(load_with("suite: x\nscene: [a, b]\n",
                          (struct sb_suite_params){.scene = "sphere"}));
    must_be("sphere:default");
}

static void write_preset(const char *name, const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/bench/presets", folder);
    assert_true(sb_dir_make(path, &err));
    snprintf(path, sizeof path, "%s/bench/presets/%s.yaml", folder, name);
    assert_true(sb_file_replace(path, text, strlen(text), &err));
}

static int remove_presets(void **state)
{
    char path[128];
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/bench/presets/%s.yaml", folder,
                 i ? "oak" : "elm");
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/bench/presets", folder);
    rmdir(path);
    snprintf(path, sizeof path, "%s/bench", folder);
    rmdir(path);
    return free_suite(state);
}

static const char elm[] =
    "suite: elm\nscene: sphere\nbase: {point: 3, stage: vertex}\n"
    "target: 64x32\nmeasure: {rounds: 7, budget: 9}\n"
    "exclude: dir=2\n"
    "axes: [{name: leaf, kind: quality, define: LEAF, values: [a, b]}]\n";

static void a_suites_keys_go_over_those_of_its_preset(void **state)
{
    (void)state;
    write_preset("elm", elm);
    assert_true(load_with("suite: x\npreset: elm\nbase: {stage: fragment, leaf: b}\n"
                          "target: 128x128\nmeasure: {budget: 5}\nsweep: {dir: 0..3}\n"
                          "exclude: dir=1\n",
                          (struct sb_suite_params){.data_dir = folder}));
    must_be("sphere:elm,dir=0,width=128,height=128,stage=fragment,leaf=b",
            "sphere:elm,dir=3,width=128,height=128,stage=fragment,leaf=b");
    check_close(suite.entry[0].variant.value[SB_AXIS_POINT], 3, 0);
    assert_string_equal(suite.name, "x");
    check_close(suite.measure.rounds, 7, 0);
    check_close(suite.measure.budget, 5, 0);
    assert_true(load_with("suite: x\npreset: elm\nscene: plane\n",
                          (struct sb_suite_params){.data_dir = folder}));
    must_be("plane:elm");
    check_close(suite.entry[0].variant.value[SB_AXIS_HEIGHT], 32, 0);
}

static void a_preset_runs_alone_and_the_command_line_names_it_last(void **state)
{
    (void)state;
    write_preset("elm", elm);
    write_preset("oak", "suite: oak\nbase: {spot: 1}\n");
    sb_suite_free(&suite);
    assert_true(sb_suite_load(
        &(struct sb_suite_params){.preset = "oak", .data_dir = folder}, &suite, &err));
    must_be("oak");
    check_close(suite.entry[0].variant.value[SB_AXIS_SPOT], 1, 0);
    assert_string_equal(suite.name, "oak");
    assert_true(load_with("suite: x\npreset: elm\n",
                          (struct sb_suite_params){.preset = "oak", .data_dir = folder}));
    must_be("oak");
}

static void an_unknown_preset_is_answered_with_the_known(void **state)
{
    (void)state;
    const struct sb_suite_params params = {.data_dir = folder};
    write_preset("elm", elm);
    assert_false(load_with("suite: x\npreset: elf\n", params));
    check_contains(err.text, ":2:9: ");
    check_contains(err.text, "unknown preset \"elf\"; did you mean \"elm\"? valid: elm");
    assert_false(load_with("suite: x\npreset: ../../suite\n", params));
    check_contains(err.text, "unknown preset \"../../suite\"; valid: elm");
    assert_false(load_with("suite: x\npreset: elm\n", (struct sb_suite_params){0}));
    check_contains(err.text, "no data folder");
}

static void a_preset_has_no_sweep_cross_parts_or_preset(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "suite: oak\nsweep: {dir: 1}\n", "suite: oak\ncross: {dir: 1}\n",
        "suite: oak\npreset: elm\n", "suite: oak\npreset: [elm]\n",
        "suite: oak\nparts: [{base: {dir: 1}}]\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        write_preset("oak", texts[i]);
        assert_false(load_with("suite: x\npreset: oak\n",
                               (struct sb_suite_params){.data_dir = folder}));
        check_contains(err.text, "oak.yaml:2:1: unknown key");
    }
}

static void a_failure_may_go_unread(void **state)
{
    (void)state;
    const struct sb_suite_params params = {.path = "/no/such/file.yaml"};
    assert_false(sb_suite_load(&params, &suite, NULL));
}

int main(void)
{
#define TEST(name)        cmocka_unit_test_teardown(name, free_suite)
#define PRESET_TEST(name) cmocka_unit_test_teardown(name, remove_presets)
    const struct CMUnitTest tests[] = {
        TEST(without_anything_the_plan_is_the_default_variant),
        TEST(the_base_alone_is_one_entry),
        TEST(sweep_is_a_union_in_the_order_written),
        TEST(a_swept_axis_is_at_base_while_another_is_swept),
        TEST(cross_multiplies_the_sweep_the_last_axis_fastest),
        TEST(cross_without_sweep_multiplies_the_base),
        TEST(scenes_multiply_everything),
        TEST(target_sets_three_axes_and_base_has_the_last_word),
        TEST(equal_variants_are_dropped_and_counted),
        TEST(excluded_variants_are_dropped_and_counted),
        TEST(exclude_sees_shorthand_expanded_and_moot_axes_at_init),
        TEST(a_plan_without_entries_is_an_error),
        TEST(ten_thousand_variants_are_planned_and_one_more_refused),
        TEST(no_two_entries_of_a_scene_share_an_id),
        TEST(wrong_keys_and_shapes_are_refused_where_they_stand),
        TEST(wrong_axes_and_values_are_refused_where_they_stand),
        TEST(measure_sets_rows_of_its_table),
        TEST(set_goes_over_base_and_ends_a_sweep_of_its_axis),
        TEST(sweep_and_cross_add_and_replace),
        TEST(what_the_command_line_gets_wrong_is_told_by_its_own_words),
        TEST(scene_of_the_command_line_stands_for_the_suites),
        PRESET_TEST(a_suites_keys_go_over_those_of_its_preset),
        PRESET_TEST(a_preset_runs_alone_and_the_command_line_names_it_last),
        PRESET_TEST(an_unknown_preset_is_answered_with_the_known),
        PRESET_TEST(a_preset_has_no_sweep_cross_parts_or_preset),
        TEST(a_failure_may_go_unread),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
