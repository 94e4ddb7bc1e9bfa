// The cases of shadow maps, and the robust forms with other maps and sizes than theirs.
#include "case_world.h"

static void test_robust_forms_hold(void **state)
{
    (void)state;
    check_robust(&sb_cases_shadows);
}

static void test_naive_forms_fail(void **state)
{
    (void)state;
    for (int i = 0; i < sb_cases_shadows.count; i++)
        check_naive(sb_cases_shadows.row[i].id, SB_IN_HIGHP);
}

static void test_other_maps(void **state)
{
    (void)state;
    // In highp, or emulated, both APIs run the same shaders: the one without half floats asks.
    if (case_half == SB_CASE_HALF)
        return;
    static const struct {
        const char *id, *more;
    } other[] = {
        {"store-precision", " shadow_map=six2d shadow_size=50 scale=3"},
        {"dist-interpolated", " shadow_map=array2d scale=0.125 tessellation=1000"},
        {"shadow-flip", " shadow_map=array2d shadow_size=200"},
    };
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        struct sb_case it = *case_of(other[i].id);
        char given[400];
        snprintf(given, sizeof given, "%s%s", it.given, other[i].more);
        it.given = given;
        check_cell(&(struct cell){&it, SB_CASE_ROBUST, SB_CASE_HIGHP, false});
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_robust_forms_hold),
        cmocka_unit_test(test_naive_forms_fail),
        cmocka_unit_test(test_other_maps),
    };
    return CASE_TESTS(tests);
}
