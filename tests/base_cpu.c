// What a processor says of itself, and what one lacks of another.
#include "test.h"

#include "base/cpu.h"

static void check_lacking(const char *all, const char *others, const char *expected)
{
    struct sb_text text = {0};
    sb_cpu_lacking(all, others, &text);
    assert_string_equal(sb_text_get(&text), expected);
    sb_text_free(&text);
}

static void what_one_lacks_of_another_is_told_word_by_word(void **state)
{
    (void)state;
    check_lacking("sse4.1 avx avx2", "sse4.1 avx avx2", "");
    check_lacking("sse4.1 avx avx2 avx512f", "avx2 sse4.1", "avx avx512f");
    // A word that begins another is not that word.
    check_lacking("avx", "avx2 avx512f", "avx");
    check_lacking("avx2", "avx", "avx2");
    check_lacking("", "avx", "");
    check_lacking("fma", "", "fma");
}

// The kernel's list of this processor's features, as independent of ours as there is one here.
static void the_features_are_those_that_the_kernel_lists(void **state)
{
    (void)state;
    static const char *const others[][2] = {
        {"sse4_1", "sse4.1"},     {"sse4_2", "sse4.2"},     {"avx", "avx"},
        {"f16c", "f16c"},         {"fma", "fma"},           {"avx2", "avx2"},
        {"avx512f", "avx512f"},   {"avx512dq", "avx512dq"}, {"avx512cd", "avx512cd"},
        {"avx512bw", "avx512bw"}, {"avx512vl", "avx512vl"}};
    char line[8192], ours[160], name[160];
    FILE *file = fopen("/proc/cpuinfo", "r");
    bool found = false;
    sb_cpu_features(ours, sizeof ours);
    sb_cpu_name(name, sizeof name);
    while (file && !found && fgets(line, sizeof line, file)) {
        if (strncmp(line, "model name", 10) == 0)
            assert_true(name[0] == '\0' || strstr(line, name) != NULL);
        found = strncmp(line, "flags", 5) == 0;
    }
    if (file)
        fclose(file);
    if (!found)
        skip(); // no x86, or no Linux
    line[strcspn(line, "\n")] = ' ';
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        struct sb_text text = {0};
        char word[32];
        snprintf(word, sizeof word, " %s ", others[i][0]);
        sb_cpu_lacking(others[i][1], ours, &text);
        assert_int_equal(text.length == 0, strstr(line, word) != NULL);
        sb_text_free(&text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_one_lacks_of_another_is_told_word_by_word),
        cmocka_unit_test(the_features_are_those_that_the_kernel_lists),
    };
    return run_tests(tests);
}
