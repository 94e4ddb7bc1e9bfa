// Work on several threads.
#include "test.h"

#include <stdatomic.h>

#include "base/parallel.h"

enum { ITEMS = 1000 };

static void count_item(void *context, int item)
{
    atomic_int *count = context;
    atomic_fetch_add(&count[item], 1);
}

static void every_item_is_done_once_on_any_number_of_threads(void **state)
{
    (void)state;
    for (int threads = 1; threads < 40; threads = 2 * threads + 1) {
        for (int items = 0; items <= ITEMS; items = 7 * items + 1) {
            atomic_int count[ITEMS + 1];
            for (int i = 0; i <= ITEMS; i++)
                atomic_init(&count[i], 0);
            sb_parallel_for(threads, items, count_item, count);
            for (int i = 0; i <= ITEMS; i++)
                assert_int_equal(atomic_load(&count[i]), i < items);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_is_done_once_on_any_number_of_threads),
    };
    return run_tests(tests);
}
