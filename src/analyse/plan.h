// Which few programs serve many demands best: the k-median problem over programs.
//
// A demand is a number of lights of each type, with a weight: how often it is drawn. A program
// serves those that it has room for, at a cost. Of the candidates those K are looked for that make
// the weighted mean of the cheapest cost least: greedy addition (Cornuejols, Fisher and Nemhauser,
// Management Science 23(8), 1977), then exchange of one for another until no exchange helps (Teitz and
// Bart, Operations Research 16(5), 1968), starting from many a program.
#pragma once

#include <stdbool.h>

#include "base/mem.h"

enum { SB_PLAN_TYPES = 4 };

struct sb_demand {
    int count[SB_PLAN_TYPES]; // lights of each type
    double weight;            // above 0
};

enum sb_plan_kind {
    SB_PLAN_EXACT,   // a constant bound: all its lights are paid for, whatever is drawn
    SB_PLAN_DYNAMIC, // a bound that is uploaded
    SB_PLAN_PADDED,  // to its capacity, passing over lights that are off
    SB_PLAN_KINDS
};
extern const char *const sb_plan_kind_words[SB_PLAN_KINDS];

struct sb_plan_program {
    enum sb_plan_kind kind;
    int capacity[SB_PLAN_TYPES];
};

// Has the program room for the demand?
bool sb_plan_serves(const struct sb_plan_program *program,
                    const struct sb_demand *demand);

// Time of a frame of this demand in a program that serves it, ms; INFINITY: not known.
typedef double sb_plan_cost_fn(void *user, const struct sb_plan_program *program,
                               const struct sb_demand *demand);

struct sb_plan_params {
    const struct sb_demand *demand; // borrowed
    int demand_count;
    bool kind[SB_PLAN_KINDS]; // that may be chosen
    sb_plan_cost_fn *cost;
    void *user;
};

struct sb_plan; // opaque

// The candidates: every demand, every demand with its counts rounded up to powers of two and to
// {0, 1, most}, the largest of every two demands, and the largest of all; of each kind. At most
// SB_PLAN_CANDIDATES, the largest of all first.
enum { SB_PLAN_CANDIDATES = 4000 };
struct sb_plan *sb_plan_new(const struct sb_plan_params *params);
void sb_plan_free(struct sb_plan **plan);
int sb_plan_candidates(const struct sb_plan *plan);
const struct sb_plan_program *sb_plan_candidate(const struct sb_plan *plan, int number);

// Weighted mean of the cheapest costs among the chosen candidates, ms; INFINITY: one of the demands
// is served by none.
double sb_plan_ms(const struct sb_plan *plan, const int *chosen, int count);

// The chosen one that serves a demand cheapest, or -1.
int sb_plan_server(const struct sb_plan *plan, const int *chosen, int count, int demand);

// Fills chosen[0 .. programs - 1], ascending; returns the mean. `programs` is at most the number of
// candidates.
double sb_plan_choose(const struct sb_plan *plan, int programs, int *chosen);

// The least of all choices, by trying them. False where there are more than SB_PLAN_TRIES of them.
#define SB_PLAN_TRIES 3e6
bool sb_plan_exhaust(const struct sb_plan *plan, int programs, int *chosen, double *ms);
