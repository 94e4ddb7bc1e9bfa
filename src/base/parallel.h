// Independent pieces of work on several threads.
#pragma once

// Calls work(context, item) once for every item from 0 to count - 1, in any order, on up to
// `threads` threads (at least 1), the caller's among them; returns when all are done. `work`
// must bear being called by several threads at a time. Where a thread cannot be had, those
// that are there do its share.
void sb_parallel_for(int threads, int count, void (*work)(void *context, int item),
                     void *context);

// Processors of this machine that are online.
int sb_processors(void);
