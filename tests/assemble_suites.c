// Every variant of every shipped suite assembles, and glslangValidator takes each of its
// programs. Skipped where that is not installed.
#include "assemble_words.h"

#include "base/file.h"
#include "suite/suite.h"

struct seen { // programs that were validated
    uint64_t *hash;
    int count, capacity;
};

static bool see(struct seen *seen, uint64_t hash)
{
    for (int i = 0; i < seen->count; i++)
        if (seen->hash[i] == hash)
            return false;
    seen->hash = sb_grow(seen->hash, seen->count, &seen->capacity, sizeof *seen->hash);
    seen->hash[seen->count++] = hash;
    return true;
}

static void check_entry(const struct sb_suite *suite, const struct sb_plan_entry *entry,
                        struct seen *seen)
{
    struct sb_caps caps;
    sb_caps_ideal(entry->variant.value[SB_AXIS_API] == SB_API_GLES, &caps);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .axes = &suite->axes,
        .scene = entry->scene,
        .variant = &entry->variant,
        .caps = &caps,
    };
    struct sb_assembly assembly = {0};
    struct sb_error err = {0};
    if (!sb_assemble(&params, &assembly, &err) ||
        (see(seen, assembly.source_hash) && !validate_in_sweep(&assembly, &err)))
        fail_msg("%s: %s: %s", suite->name, entry->id, err.text);
    sb_assembly_free(&assembly);
}

static void check_folder(const char *folder, struct seen *seen)
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    int count;
    char **file = sb_dir_list(&arena, sb_path_join(&arena, SB_SOURCE_DIR, folder),
                              ".yaml", &count, &err);
    assert_non_null(file);
    for (int i = 0; i < count; i++) {
        const char *inside = sb_path_join(&arena, folder, file[i]);
        const struct sb_suite_params params = {
            .path = sb_path_join(&arena, SB_SOURCE_DIR, inside),
            .data_dir = SB_SOURCE_DIR,
        };
        struct sb_suite suite = {0};
        if (!sb_suite_load(&params, &suite, &err))
            fail_msg("%s", err.text);
        for (int e = 0; e < suite.entry_count; e++)
            check_entry(&suite, &suite.entry[e], seen);
        sb_suite_free(&suite);
    }
    sb_arena_free(&arena);
}

static void every_variant_of_every_suite_is_a_valid_program(void **state)
{
    (void)state;
    struct seen seen = {0};
    check_folder("bench", &seen);
    check_folder("bench/presets", &seen);
    print_message("%d programs\n", seen.count);
    assert_true(seen.count > 0);
    free(seen.hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_variant_of_every_suite_is_a_valid_program),
    };
    if (validator_is_missing())
        return 77;
    return run_tests(tests);
}
