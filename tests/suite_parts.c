// Plans side by side: the parts of a suite, and several presets.
#include "test.h"

#include "suite_text.h"

static const char *const preset_names[] = {"elm", "oak", "yew"};

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
    for (size_t i = 0; i < sizeof preset_names / sizeof *preset_names; i++) {
        snprintf(path, sizeof path, "%s/bench/presets/%s.yaml", folder, preset_names[i]);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/bench/presets", folder);
    rmdir(path);
    snprintf(path, sizeof path, "%s/bench", folder);
    rmdir(path);
    return free_suite(state);
}

static int write_presets(void **state)
{
    (void)state;
    write_preset("elm", "suite: elm\nabout: a tree\nscene: sphere\n"
                        "base: {point: 3, stage: vertex, p_sum: lowp}\n"
                        "measure: {rounds: 7, budget: 9}\n");
    write_preset("oak", "suite: oak\nbase: {spot: 1, point: 2}\ntarget: 64x64\n"
                        "measure: {budget: 3}\nexclude: dir=2\n");
    write_preset("yew", "suite: yew\nbase: {spot: 1, point: 2, dir: 1}\n");
    return 0;
}

static bool load_with_presets(const char *text, const char *preset)
{
    return load_bytes(text, strlen(text),
                      (struct sb_suite_params){.preset = preset, .data_dir = folder});
}

static void must_load_with(const char *text, const char *preset)
{
    if (!load_with_presets(text, preset))
        fail_msg("%s", err.text);
}

static double value(int entry, int axis)
{
    return suite.entry[entry].variant.value[axis];
}

// --- parts -----------------------------------------------------------------------------

static void parts_stand_side_by_side_each_with_its_own_sweep(void **state)
{
    (void)state;
    must_load("suite: x\n"
              "base: {dir: 1}\n"
              "parts:\n"
              "  - {base: {point: 4}, sweep: {layout: [split, unified]}}\n"
              "  - {scene: plane, target: 32x16, cross: {spot: [1, 2]}}\n");
    must_be("dir=1,point=4,layout=split", "dir=1,point=4,layout=unified",
            "plane:dir=1,spot=1,width=32,height=16",
            "plane:dir=1,spot=2,width=32,height=16");
}

static void what_stands_before_the_parts_holds_for_all_of_them(void **state)
{
    (void)state;
    must_load("suite: x\nscene: sphere\nbase: {dir: 1, point: 2}\n"
              "cross: {stage: [fragment, vertex]}\n"
              "exclude: spot=1,stage=vertex\n"
              "parts:\n"
              "  - {base: {point: 4}}\n"
              "  - {sweep: {spot: 1..2}, exclude: spot=2}\n");
    must_be("sphere:dir=1,point=4,stage=fragment", "sphere:dir=1,point=4,stage=vertex",
            "sphere:dir=1,point=2,spot=1,stage=fragment");
    assert_int_equal(suite.excluded, 3);
}

static void a_part_may_repeat_another_by_its_anchor(void **state)
{
    (void)state;
    must_load("suite: x\nparts:\n"
              "  - base: {point: 1}\n    sweep: &each {layout: [split, unified]}\n"
              "  - base: {point: 2}\n    sweep: *each\n");
    must_be("point=1,layout=split", "point=1,layout=unified", "point=2,layout=split",
            "point=2,layout=unified");
}

static void equal_variants_of_two_parts_are_dropped_and_counted(void **state)
{
    (void)state;
    must_load("suite: x\nparts:\n  - sweep: {point: 1..3}\n  - sweep: {point: [3, 4]}\n");
    must_be("point=1", "point=2", "point=3", "point=4");
    assert_int_equal(suite.duplicates, 1);
}

static void the_command_line_reaches_every_part(void **state)
{
    (void)state;
    static const char text[] = "suite: x\nparts:\n"
                               "  - {base: {dir: 1}, sweep: {point: 1..3}}\n"
                               "  - {base: {dir: 2}, scene: plane}\n";
    const struct sb_assignment point = {"point", "7", "--set point=7"};
    assert_true(load_bytes(
        text, strlen(text),
        (struct sb_suite_params){.scene = "sphere", .set = &point, .set_count = 1}));
    must_be("sphere:dir=1,point=7", "sphere:dir=2,point=7");
}

static void wrong_parts_are_refused_where_they_stand(void **state)
{
    (void)state;
    must_fail("suite: x\nparts: 4\n", ":2:8", "parts must be a list");
    must_fail("suite: x\nparts: []\n", ":2:8", "parts: an empty list");
    must_fail("suite: x\nparts: [4]\n", ":2:9", "a part must be a map");
    must_fail("suite: x\nparts:\n  - {bsae: {dir: 1}}\n", ":3:6",
              "unknown key \"bsae\"; did you mean \"base\"?");
    must_fail("suite: x\nparts:\n  - {measure: {budget: 1}}\n", ":3:6", "unknown key");
    must_fail("suite: x\nsweep: {dir: 1}\nparts:\n  - {cross: {dir: 2}}\n", ":4:14",
              "dir: is there already");
    must_fail("suite: x\nparts:\n  - {sweep: {dir: 1..6000}}\n  - {sweep: {dir: 1}}\n",
              ":3:19", "6000 is out of range");
    assert_false(load_text("suite: x\nbase: {dir: 1}\nexclude: dir=1\n"
                           "parts: [{base: {point: 1}}, {base: {point: 2}}]\n"));
    check_contains(err.text, "no variant is left: all 2 are excluded");
}

static void all_parts_together_may_have_ten_thousand_variants(void **state)
{
    (void)state;
    static const char text[] = "suite: x\nparts:\n"
                               "  - {sweep: {width: 1..4000}}\n"
                               "  - {sweep: {height: 1..4000}}\n"
                               "  - {base: {dir: 1}, sweep: {height: \"%s\"}}\n";
    char filled[256];
    snprintf(filled, sizeof filled, text, "1..2001");
    must_load(filled); // 10 001, but width=256 is height=256
    assert_int_equal(suite.entry_count, 10000);
    snprintf(filled, sizeof filled, text, "1..2002");
    assert_false(load_text(filled));
    check_contains(err.text, "make 10001 variants");
}

// --- presets ---------------------------------------------------------------------------

static void presets_stand_side_by_side_each_with_its_scene_and_base(void **state)
{
    (void)state;
    must_load_with("suite: x\npreset: [elm, oak]\n", NULL);
    must_be("sphere:elm", "oak");
    assert_string_equal(suite.entry[0].preset, "elm");
    assert_string_equal(suite.entry[1].preset, "oak");
    check_close(value(0, SB_AXIS_POINT), 3, 0);
    check_close(value(0, SB_AXIS_SPOT), 0, 0);
    check_close(value(0, SB_AXIS_WIDTH), 256, 0);
    check_close(value(1, SB_AXIS_POINT), 2, 0);
    check_close(value(1, SB_AXIS_STAGE), SB_STAGE_FRAGMENT, 0);
    check_close(value(1, SB_AXIS_WIDTH), 64, 0);
    // Of the settings the later preset has the last word, and the suite after it.
    check_close(suite.measure.rounds, 7, 0);
    check_close(suite.measure.budget, 3, 0);
    assert_string_equal(suite.name, "x");
    assert_string_equal(suite.about, "");
}

static void an_id_names_the_preset_and_what_was_given_besides(void **state)
{
    (void)state;
    must_load_with("suite: x\npreset: [elm, oak]\nbase: {point: 9}\n"
                   "sweep: {dir: 1..2}\ncross: {stage: [fragment, vertex]}\n",
                   NULL);
    must_be("sphere:elm,dir=1,point=9,stage=fragment",
            "sphere:elm,dir=1,point=9,stage=vertex",
            "sphere:elm,dir=2,point=9,stage=fragment",
            "sphere:elm,dir=2,point=9,stage=vertex", "oak,dir=1,point=9,stage=fragment",
            "oak,dir=1,point=9,stage=vertex");
    assert_int_equal(suite.excluded, 2); // by oak, of its own
    // The value that the preset has, too, if it is swept.
    must_load_with("suite: x\npreset: elm\nsweep: {point: 2..3}\n", NULL);
    must_be("sphere:elm,point=2", "sphere:elm,point=3");
}

static void what_a_preset_gives_is_given_to_shorthand(void **state)
{
    (void)state;
    must_load_with("suite: x\npreset: elm\nbase: {precision: mediump}\n", NULL);
    must_be("sphere:elm,precision=mediump");
    check_close(value(0, SB_AXIS_P_SUM), SB_P_SUM_LOWP, 0);
    check_close(value(0, SB_AXIS_P_COLOR), SB_P_COLOR_MEDIUMP, 0);
}

static void ids_of_all_presets_are_distinct(void **state)
{
    (void)state;
    // yew with dir=0 is oak in everything but its name.
    must_load_with(
        "suite: x\npreset: [elm, oak, yew]\nscene: plane\n"
        "sweep: {point: [2, 3], spot: [0, 1]}\ncross: {layout: [split, unified]}\n",
        NULL);
    for (int i = 0; i < suite.entry_count; i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(suite.entry[i].id, suite.entry[k].id);
}

static void the_command_line_names_presets_with_commas(void **state)
{
    (void)state;
    const struct sb_assignment layout = {"layout", "split,unified", "--sweep"};
    sb_suite_free(&suite);
    if (!sb_suite_load(&(struct sb_suite_params){.preset = "oak,elm",
                                                 .data_dir = folder,
                                                 .sweep = &layout,
                                                 .sweep_count = 1},
                       &suite, &err))
        fail_msg("%s", err.text);
    must_be("oak,layout=split", "oak,layout=unified", "sphere:elm,layout=split",
            "sphere:elm,layout=unified");
    assert_string_equal(suite.name, "presets");
    must_load_with("suite: x\npreset: [elm, oak]\n", "yew"); // over the suite's
    must_be("yew");
    assert_false(load_with_presets("suite: x\n", "elm,,oak"));
    check_contains(err.text, "unknown preset \"\"");
    assert_false(load_with_presets("suite: x\n", "elm,aok"));
    check_contains(err.text, "unknown preset \"aok\"");
}

static void presets_times_parts_are_all_there(void **state)
{
    (void)state;
    must_load_with(
        "suite: x\npreset: [elm, oak]\nparts: [{base: {dir: 1}}, {base: {dir: 3}}]\n",
        NULL);
    must_be("sphere:elm,dir=1", "sphere:elm,dir=3", "oak,dir=1", "oak,dir=3");
}

static void wrong_lists_of_presets_are_refused_where_they_stand(void **state)
{
    (void)state;
    assert_false(load_with_presets("suite: x\npreset: []\n", NULL));
    check_contains(err.text, ":2:9: preset: an empty list");
    assert_false(load_with_presets("suite: x\npreset: [elm, aok]\n", NULL));
    check_contains(err.text, ":2:15: ");
    check_contains(err.text, "unknown preset \"aok\"; did you mean \"oak\"?");
    assert_false(load_with_presets("suite: x\npreset: [[elm]]\n", NULL));
    check_contains(err.text, ":2:10: preset must be one word");
    assert_false(load_with_presets("suite: x\npreset: {elm: oak}\n", NULL));
    check_contains(err.text, ":2:9: preset must be one word");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_suite)
#define PRESET_TEST(name)                                                                \
    cmocka_unit_test_setup_teardown(name, write_presets, remove_presets)
    const struct CMUnitTest tests[] = {
        TEST(parts_stand_side_by_side_each_with_its_own_sweep),
        TEST(what_stands_before_the_parts_holds_for_all_of_them),
        TEST(a_part_may_repeat_another_by_its_anchor),
        TEST(equal_variants_of_two_parts_are_dropped_and_counted),
        TEST(the_command_line_reaches_every_part),
        TEST(wrong_parts_are_refused_where_they_stand),
        TEST(all_parts_together_may_have_ten_thousand_variants),
        PRESET_TEST(presets_stand_side_by_side_each_with_its_scene_and_base),
        PRESET_TEST(an_id_names_the_preset_and_what_was_given_besides),
        PRESET_TEST(what_a_preset_gives_is_given_to_shorthand),
        PRESET_TEST(ids_of_all_presets_are_distinct),
        PRESET_TEST(the_command_line_names_presets_with_commas),
        PRESET_TEST(presets_times_parts_are_all_there),
        PRESET_TEST(wrong_lists_of_presets_are_refused_where_they_stand),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
