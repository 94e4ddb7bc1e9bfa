// Several processes that ask the cells of one matrix: most of the time goes into compiling, which a
// driver does in one thread, and a process has one context. Each takes the next cell that nobody
// has, so that all end together; a driver that takes its process down costs that cell alone.
#pragma once

#include "cases/case.h"

struct sb_crew; // opaque; NULL: this process is alone

// Starts `hands` processes more, before this one has a driver: each calls work(user, crew) and
// ends. 0 hands, or a system that lets none be started: NULL.
struct sb_crew *sb_crew_start(int hands, void (*work)(void *user, struct sb_crew *crew),
                              void *user);

// The next cell that nobody has taken, `count` or more: none is left.
int sb_crew_take(struct sb_crew *crew);
// Hands over what came of a cell.
void sb_crew_put(struct sb_crew *crew, int cell, const struct sb_outcome *outcome);

// Has somebody put this cell since it was last asked for? *outcome is its owner's then.
bool sb_crew_get(struct sb_crew *crew, int cell, struct sb_outcome *outcome);

// Are hands still at work? Of one that died its cell is put as failed, with the reason.
bool sb_crew_works(struct sb_crew *crew);

// Takes hands that are still at work for dead: a driver may hang.
void sb_crew_stop(struct sb_crew *crew);

// Ends hands that are still at work, and frees. *crew becomes NULL.
void sb_crew_end(struct sb_crew **crew);
