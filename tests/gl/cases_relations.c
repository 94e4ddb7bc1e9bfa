// The relations between pictures hold; they have no naive form.
#include "case_world.h"

static void relations_hold(void **state)
{
    (void)state;
    check_robust(&sb_cases_relations);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(relations_hold),
    };
    return CASE_TESTS(tests);
}
