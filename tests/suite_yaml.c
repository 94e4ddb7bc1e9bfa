// Where YAML itself is at fault, each message says at which file:line:column.
#include "test.h"

#include "suite/yaml.h"
#include "suite_text.h"

static void a_document_that_is_none_is_refused(void **state)
{
    (void)state;
    must_fail("", ":1:1", "empty");
    must_fail("# only a comment\n", ":1:1", "empty");
    must_fail("- a\n- b\n", ":1:1", "the file must be a map (key: value), not a list");
    must_fail("just words\n", ":1:1", "must be a map");
    must_fail("suite: x\n---\nsuite: y\n", ":3:1",
              "a second document; one file holds one");
    must_fail("suite: x\nbase: {point: 1\n", ":3:1", "");
    must_fail("suite: x\n\tabout: y\n", ":2:1", "");
    must_fail("suite: [1, 2\nabout: }\n", ":2:6", "");
    must_fail("suite: \"\\0\"\n", ":1:8", "a NUL character");
    must_fail("suite: \xff\n", "", "byte 7");
}

static void keys_stand_once_and_are_texts(void **state)
{
    (void)state;
    must_fail("suite: x\nabout: y\nsuite: z\n", ":3:1",
              "key \"suite\" is there already, with a value on line 1");
    must_fail("suite: x\nbase:\n  point: 1\n  spot: 1\n  point: 2\n", ":5:3",
              "key \"point\" is there already, with a value on line 3");
    must_fail("suite: x\n[a]: y\n", ":2:1", "a key must be one word, not a list");
}

static void aliases_are_followed_but_never_in_circles(void **state)
{
    (void)state;
    must_load("suite: x\nsweep:\n  dir: &counts [1, 2]\n  point: *counts\n");
    must_be("dir=1", "dir=2", "point=1", "point=2");
    must_fail("suite: &a [*a]\n", ":1:8", "an alias stands inside what it stands for");
    must_fail("suite: x\nbase: &a\n  point: {b: *a}\n", ":2:7", "an alias stands inside");
    must_fail("suite: *nothing\n", ":1:8", "undefined alias");
}

static void eight_levels_are_read_and_nine_refused(void **state)
{
    (void)state;
    must_fail("suite: [[[[[[1]]]]]]\n", ":1:8", "suite must be one word, not a list");
    must_fail("suite: [[[[[[[1]]]]]]]\n", ":1:15", "more than 8 levels");
}

// Eight lists of nine aliases, each to the list before: 9^7 words from 300 bytes.
static void aliases_cannot_blow_a_small_file_up(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_text_add(&text, "suite: x\na0: &a0 1\n");
    for (int i = 1; i < 8; i++) {
        sb_text_printf(&text, "a%d: &a%d [", i, i);
        for (int k = 0; k < 9; k++)
            sb_text_printf(&text, "*a%d%s", i - 1, k < 8 ? "," : "]\n");
    }
    assert_false(load_text(sb_text_get(&text)));
    check_contains(err.text, "more than 20000 values and keys");
    sb_text_free(&text);
}

static void a_file_over_one_megabyte_is_refused(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_text_add(&text, "suite: x\n# ");
    for (int i = 0; i < 1000; i++)
        sb_text_printf(&text, "%01000d", 0);
    assert_false(load_text(sb_text_get(&text)));
    check_contains(err.text, "at most 1000000 are read");
    sb_text_free(&text);
}

static void nodes_know_where_they_stand(void **state)
{
    (void)state;
    const char text[] = "a: 1\nlist:\n  - x\n  - {key: value}\nnull_one:\n";
    struct sb_arena arena = {0};
    assert_true(sb_file_replace(file, text, strlen(text), &err));
    const struct sb_yaml *root = sb_yaml_load(&arena, file, &err);
    assert_non_null(root);
    const struct sb_yaml *list = sb_yaml_get(root, "list");
    assert_int_equal(list->kind, SB_YAML_LIST);
    assert_int_equal(list->count, 2);
    const struct sb_yaml *map = &list->child[1];
    assert_int_equal(map->line, 4);
    assert_int_equal(map->column, 5);
    assert_string_equal(map->key[0].text, "key");
    assert_int_equal(map->key[0].column, 6);
    assert_string_equal(map->child[0].text, "value");
    assert_int_equal(map->child[0].column, 11);
    assert_string_equal(sb_yaml_get(root, "null_one")->text, "");
    assert_null(sb_yaml_get(root, "b"));
    sb_arena_free(&arena);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_suite)
    const struct CMUnitTest tests[] = {
        TEST(a_document_that_is_none_is_refused),
        TEST(keys_stand_once_and_are_texts),
        TEST(aliases_are_followed_but_never_in_circles),
        TEST(eight_levels_are_read_and_nine_refused),
        TEST(aliases_cannot_blow_a_small_file_up),
        TEST(a_file_over_one_megabyte_is_refused),
        TEST(nodes_know_where_they_stand),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
