#include "analyse/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const sb_plan_kind_words[SB_PLAN_KINDS] = {"exact", "dynamic", "padded"};

struct sb_plan {
    const struct sb_demand *demand;
    int demand_count;
    double weight; // of all
    struct sb_plan_program *program;
    int program_count, program_capacity;
    double *cost;    // [program][demand]
    double unserved; // of a demand that none serves, while programs are looked for
    double *others;  // room: of each demand the cheapest of the programs but one
};

bool sb_plan_serves(const struct sb_plan_program *program, const struct sb_demand *demand)
{
    for (int t = 0; t < SB_PLAN_TYPES; t++)
        if (demand->count[t] > program->capacity[t])
            return false;
    return true;
}

// --- candidates ------------------------------------------------------------------------------

static bool is_there(const struct sb_plan *plan, const struct sb_plan_program *program)
{
    for (int i = 0; i < plan->program_count; i++) {
        const struct sb_plan_program *other = &plan->program[i];
        if (other->kind == program->kind &&
            memcmp(other->capacity, program->capacity, sizeof program->capacity) == 0)
            return true;
    }
    return false;
}

// What a dynamic loop costs goes by what is drawn, so one with room for all serves all as well.
static void add(struct sb_plan *plan, const struct sb_plan_params *params,
                const int capacity[SB_PLAN_TYPES], bool largest)
{
    for (int k = 0; k < SB_PLAN_KINDS; k++) {
        struct sb_plan_program program = {.kind = (enum sb_plan_kind)k};
        memcpy(program.capacity, capacity, sizeof program.capacity);
        if (!params->kind[k] || (k == SB_PLAN_DYNAMIC && !largest) ||
            plan->program_count >= SB_PLAN_CANDIDATES || is_there(plan, &program))
            continue;
        plan->program = sb_grow(plan->program, plan->program_count,
                                &plan->program_capacity, sizeof *plan->program);
        plan->program[plan->program_count++] = program;
    }
}

static void largest_of(const int a[SB_PLAN_TYPES], const int b[SB_PLAN_TYPES],
                       int largest[SB_PLAN_TYPES])
{
    for (int t = 0; t < SB_PLAN_TYPES; t++)
        largest[t] = a[t] > b[t] ? a[t] : b[t];
}

static int power_of_two(int count)
{
    int power = 1;
    while (power < count)
        power *= 2;
    return count > 0 ? power : 0;
}

// What serves most first: where there are too many, it is pairs that are left out.
static void add_candidates(struct sb_plan *plan, const struct sb_plan_params *params)
{
    int most[SB_PLAN_TYPES] = {0}, bucket[SB_PLAN_TYPES];
    for (int i = 0; i < params->demand_count; i++)
        largest_of(most, params->demand[i].count, most);
    add(plan, params, most, true);
    for (int i = 0; i < params->demand_count; i++)
        add(plan, params, params->demand[i].count, false);
    for (int i = 0; i < params->demand_count; i++) {
        const int *count = params->demand[i].count;
        // Beyond the largest count of all nothing is drawn.
        for (int t = 0; t < SB_PLAN_TYPES; t++) {
            const int power = power_of_two(count[t]);
            bucket[t] = power < most[t] ? power : most[t];
        }
        add(plan, params, bucket, false);
        for (int t = 0; t < SB_PLAN_TYPES; t++)
            bucket[t] = count[t] > 1 ? most[t] : count[t];
        add(plan, params, bucket, false);
    }
    for (int i = 0; i < params->demand_count; i++)
        for (int j = 0; j < i; j++) {
            largest_of(params->demand[i].count, params->demand[j].count, bucket);
            add(plan, params, bucket, false);
        }
}

// More than any choice of programs that serve all can cost in sum: so leaving one demand unserved,
// however light, is dearer than serving every one.
static double unserved_cost(const struct sb_plan *plan)
{
    double dearest = 1, lightest = plan->weight;
    for (int i = 0; i < plan->program_count * plan->demand_count; i++)
        if (isfinite(plan->cost[i]))
            dearest = fmax(dearest, plan->cost[i]);
    for (int d = 0; d < plan->demand_count; d++)
        lightest = fmin(lightest, plan->demand[d].weight);
    return 2 * dearest * plan->weight / lightest;
}

struct sb_plan *sb_plan_new(const struct sb_plan_params *params)
{
    struct sb_plan *plan = sb_alloc(sizeof *plan);
    plan->demand = params->demand;
    plan->demand_count = params->demand_count;
    for (int d = 0; d < plan->demand_count; d++)
        plan->weight += plan->demand[d].weight;
    add_candidates(plan, params);
    plan->others = sb_alloc(((size_t)plan->demand_count + 1) * sizeof *plan->others);
    plan->cost = sb_alloc((size_t)plan->program_count * (size_t)plan->demand_count *
                              sizeof *plan->cost +
                          1);
    for (int p = 0; p < plan->program_count; p++)
        for (int d = 0; d < plan->demand_count; d++)
            plan->cost[p * plan->demand_count + d] =
                sb_plan_serves(&plan->program[p], &plan->demand[d])
                    ? params->cost(params->user, &plan->program[p], &plan->demand[d])
                    : INFINITY;
    plan->unserved = unserved_cost(plan);
    return plan;
}

void sb_plan_free(struct sb_plan **plan)
{
    if (*plan) {
        free((*plan)->program);
        free((*plan)->cost);
        free((*plan)->others);
    }
    free(*plan);
    *plan = NULL;
}

int sb_plan_candidates(const struct sb_plan *plan)
{
    return plan->program_count;
}

const struct sb_plan_program *sb_plan_candidate(const struct sb_plan *plan, int number)
{
    return &plan->program[number];
}

// --- costs -----------------------------------------------------------------------------------

static double cost_of(const struct sb_plan *plan, int program, int demand)
{
    return plan->cost[program * plan->demand_count + demand];
}

int sb_plan_server(const struct sb_plan *plan, const int *chosen, int count, int demand)
{
    int server = -1;
    double least = INFINITY;
    for (int i = 0; i < count; i++)
        if (cost_of(plan, chosen[i], demand) < least) {
            least = cost_of(plan, chosen[i], demand);
            server = chosen[i];
        }
    return server;
}

// A demand that none serves costs `unserved`.
static double mean_ms(const struct sb_plan *plan, const int *chosen, int count,
                      double unserved)
{
    double sum = 0;
    for (int d = 0; d < plan->demand_count; d++) {
        const int server = sb_plan_server(plan, chosen, count, d);
        sum +=
            plan->demand[d].weight * (server < 0 ? unserved : cost_of(plan, server, d));
    }
    return sum / plan->weight;
}

double sb_plan_ms(const struct sb_plan *plan, const int *chosen, int count)
{
    return mean_ms(plan, chosen, count, INFINITY);
}

// --- greedy, then exchange -------------------------------------------------------------------

static bool is_chosen(const int *chosen, int count, int program)
{
    for (int i = 0; i < count; i++)
        if (chosen[i] == program)
            return true;
    return false;
}

// While programs are looked for, a demand that none serves yet is dear, not impossible: so each one
// that comes to be served counts.
static double so_far(const struct sb_plan *plan, const int *chosen, int count)
{
    return mean_ms(plan, chosen, count, plan->unserved);
}

// Of each demand what it costs without the program at `place`.
static void look_at_others(const struct sb_plan *plan, const int *chosen, int count,
                           int place)
{
    for (int d = 0; d < plan->demand_count; d++) {
        plan->others[d] = plan->unserved;
        for (int i = 0; i < count; i++)
            if (i != place)
                plan->others[d] = fmin(plan->others[d], cost_of(plan, chosen[i], d));
    }
}

static double mean_beside_others(const struct sb_plan *plan, int program)
{
    double sum = 0;
    for (int d = 0; d < plan->demand_count; d++)
        sum += plan->demand[d].weight * fmin(plan->others[d], cost_of(plan, program, d));
    return sum / plan->weight;
}

// Puts the best candidate in chosen[place]; returns whether the mean falls below *ms.
static bool improve_place(const struct sb_plan *plan, int *chosen, int count, int place,
                          double *ms)
{
    const int before = chosen[place];
    int best = before;
    look_at_others(plan, chosen, count, place);
    for (int p = 0; p < plan->program_count; p++) {
        const double with = mean_beside_others(plan, p);
        // Better by more than rounding, or it would go round in circles.
        if (with < *ms * (1 - 1e-12) && !is_chosen(chosen, count, p)) {
            *ms = with;
            best = p;
        }
    }
    chosen[place] = best;
    return best != before;
}

// One after another, each the best beside those before it; the first is given.
static double add_greedily(const struct sb_plan *plan, int programs, int *chosen)
{
    double ms = so_far(plan, chosen, 1);
    for (int k = 1; k < programs; k++) {
        // Any that is not chosen yet, then the best in its place.
        int any = 0;
        while (is_chosen(chosen, k, any))
            any++;
        chosen[k] = any;
        ms = so_far(plan, chosen, k + 1);
        improve_place(plan, chosen, k + 1, k, &ms);
    }
    return ms;
}

static double exchange(const struct sb_plan *plan, int programs, int *chosen, double ms)
{
    for (bool better = true; better;) {
        better = false;
        for (int i = 0; i < programs; i++)
            better |= improve_place(plan, chosen, programs, i, &ms);
    }
    return ms;
}

static int ascending(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

// Where exchange ends depends on where it starts: from every candidate, or of many from some.
double sb_plan_choose(const struct sb_plan *plan, int programs, int *chosen)
{
    const double work = (double)plan->program_count * plan->demand_count;
    const double starts = fmin(fmax(2e7 / work, 4), 100);
    const int step = 1 + (int)((plan->program_count - 1) / starts);
    int *tried = sb_alloc((size_t)programs * sizeof *tried);
    double least = INFINITY;
    for (int first = 0; first < plan->program_count; first += step) {
        tried[0] = first;
        const double ms =
            exchange(plan, programs, tried, add_greedily(plan, programs, tried));
        if (ms < least * (1 - 1e-12)) {
            least = ms;
            memcpy(chosen, tried, (size_t)programs * sizeof *chosen);
        }
    }
    free(tried);
    qsort(chosen, (size_t)programs, sizeof *chosen, ascending);
    return sb_plan_ms(plan, chosen, programs);
}

// --- all choices -----------------------------------------------------------------------------

static double choices(int n, int k)
{
    double all = 1;
    for (int i = 0; i < k; i++)
        all *= (double)(n - i) / (i + 1);
    return all;
}

// The next choice in lexicographic order; false behind the last.
static bool next_choice(int *choice, int k, int n)
{
    int i = k - 1;
    while (i >= 0 && choice[i] == n - k + i)
        i--;
    if (i < 0)
        return false;
    choice[i]++;
    for (int j = i + 1; j < k; j++)
        choice[j] = choice[j - 1] + 1;
    return true;
}

bool sb_plan_exhaust(const struct sb_plan *plan, int programs, int *chosen, double *ms)
{
    if (choices(plan->program_count, programs) > SB_PLAN_TRIES)
        return false;
    int *choice = sb_alloc((size_t)programs * sizeof *choice);
    for (int i = 0; i < programs; i++)
        choice[i] = i;
    *ms = INFINITY;
    do {
        const double mean = sb_plan_ms(plan, choice, programs);
        if (mean < *ms) {
            *ms = mean;
            memcpy(chosen, choice, (size_t)programs * sizeof *chosen);
        }
    } while (next_choice(choice, programs, plan->program_count));
    free(choice);
    return true;
}
