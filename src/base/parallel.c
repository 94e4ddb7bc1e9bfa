#include "base/parallel.h"

#include <pthread.h>
#include <unistd.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/mem.h"

struct pool {
    atomic_int next; // item that nobody has taken yet
    int count;
    void (*work)(void *context, int item);
    void *context;
};

static void *take_items(void *argument)
{
    struct pool *pool = argument;
    for (;;) {
        const int item = atomic_fetch_add(&pool->next, 1);
        if (item >= pool->count)
            return NULL;
        pool->work(pool->context, item);
    }
}

void sb_parallel_for(int threads, int count, void (*work)(void *context, int item),
                     void *context)
{
    struct pool pool = {.count = count, .work = work, .context = context};
    const int helpers = (threads < count ? threads : count) - 1;
    pthread_t *helper = sb_alloc((size_t)(helpers > 0 ? helpers : 1) * sizeof *helper);
    int started = 0;
    while (started < helpers &&
           pthread_create(&helper[started], NULL, take_items, &pool) == 0)
        started++;
    take_items(&pool);
    for (int i = 0; i < started; i++)
        pthread_join(helper[i], NULL);
    free(helper);
}

int sb_processors(void)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}
