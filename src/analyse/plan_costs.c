#include "analyse/plan_costs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/alike.h"

struct point { // a row, reduced to what the model knows
    enum sb_plan_kind kind;
    int lights[SB_PLAN_TYPES], room[SB_PLAN_TYPES];
    double ms;
};

struct sb_plan_costs {
    struct point *point;
    int count;
    const struct sb_row *first;
    struct sb_plan_line line[SB_PLAN_KINDS];
    bool padded[SB_PLAN_TYPES];
};

// --- rows ------------------------------------------------------------------------------------

static bool point_of(const struct sb_plan_costs_params *params, const struct sb_row *row,
                     struct point *point)
{
    const double *value = row->axes->value;
    const int capacity = (int)value[params->capacity_axis];
    int kind = 0;
    while (kind < SB_PLAN_KINDS &&
           params->loop_value[kind] != (int)value[params->loop_axis])
        kind++;
    *point = (struct point){.kind = (enum sb_plan_kind)kind, .ms = row->median_ms};
    for (int t = 0; t < SB_PLAN_TYPES; t++) {
        const int lights = (int)value[params->count_axis[t]];
        point->lights[t] = lights;
        const bool roomy = kind == SB_PLAN_PADDED && params->padded[t];
        point->room[t] = roomy && lights > 0 && capacity > lights ? capacity : lights;
    }
    return kind < SB_PLAN_KINDS;
}

// The largest group of rows that differ in nothing else.
static int choose_group(const struct sb_plan_costs_params *params, bool *chosen)
{
    bool free[SB_AXIS_MAX] = {0};
    struct sb_alike alike;
    int most = 0, best = -1;
    for (int t = 0; t < SB_PLAN_TYPES; t++)
        free[params->count_axis[t]] = true;
    free[params->loop_axis] = free[params->capacity_axis] = true;
    sb_alike_make(&alike, params->axes, params->row, params->count, free);
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < params->count; i++) {
            int members = 0;
            for (int j = 0; j < params->count; j++) {
                const bool in =
                    sb_row_has_time(&params->row[j]) && sb_alike(&alike, i, j);
                members += in;
                if (pass == 1 && i == best)
                    chosen[j] = in;
            }
            if (pass == 0 && sb_row_has_time(&params->row[i]) && members > most) {
                most = members;
                best = i;
            }
        }
    sb_alike_free(&alike);
    return best;
}

// --- lines -----------------------------------------------------------------------------------

enum { TERMS = 2 + SB_PLAN_TYPES };

static void terms_of(const struct point *point, double term[TERMS])
{
    term[0] = 1;
    term[1] = 0;
    for (int t = 0; t < SB_PLAN_TYPES; t++) {
        term[1] += point->room[t] - point->lights[t];
        term[2 + t] = point->lights[t];
    }
}

// Gauss with pivots, of the terms that are in use; what has no pivot is 0.
static void solve(double a[TERMS][TERMS + 1], const bool used[TERMS], double x[TERMS])
{
    int row_of[TERMS];
    bool taken[TERMS] = {0};
    double size[TERMS]; // of a term: a pivot that is nothing beside it is rounding
    for (int c = 0; c < TERMS; c++)
        size[c] = a[c][c];
    for (int c = 0; c < TERMS; c++) {
        int pivot = -1;
        row_of[c] = -1;
        for (int r = 0; used[c] && r < TERMS; r++)
            if (used[r] && !taken[r] && (pivot < 0 || fabs(a[r][c]) > fabs(a[pivot][c])))
                pivot = r;
        if (pivot < 0 || fabs(a[pivot][c]) <= 1e-9 * size[c])
            continue;
        taken[pivot] = true;
        row_of[c] = pivot;
        for (int r = 0; r < TERMS; r++) {
            const double factor = r == pivot ? 0 : a[r][c] / a[pivot][c];
            for (int k = 0; k <= TERMS; k++)
                a[r][k] -= factor * a[pivot][k];
        }
    }
    for (int c = 0; c < TERMS; c++)
        x[c] = row_of[c] < 0 ? 0 : a[row_of[c]][TERMS] / a[row_of[c]][c];
}

// Least squares of relative errors, so that a frame of 30 ms does not outweigh those of 1 ms.
static void fit(const struct sb_plan_costs *costs, enum sb_plan_kind kind,
                const bool used[TERMS], double x[TERMS])
{
    double a[TERMS][TERMS + 1] = {{0}};
    for (int i = 0; i < costs->count; i++) {
        const struct point *point = &costs->point[i];
        double term[TERMS];
        if (point->kind != kind)
            continue;
        terms_of(point, term);
        for (int r = 0; r < TERMS; r++) {
            for (int c = 0; c < TERMS; c++)
                a[r][c] += term[r] * term[c] / (point->ms * point->ms);
            a[r][TERMS] += term[r] / point->ms;
        }
    }
    solve(a, used, x);
}

static double line_ms(const struct sb_plan_line *line, const struct point *point)
{
    double ms = line->floor;
    for (int t = 0; t < SB_PLAN_TYPES; t++)
        ms += line->price[t] * point->lights[t] +
              line->idle * (point->room[t] - point->lights[t]);
    return ms;
}

static void measure_line(struct sb_plan_costs *costs, enum sb_plan_kind kind)
{
    struct sb_plan_line *line = &costs->line[kind];
    for (int i = 0; i < costs->count; i++) {
        const struct point *point = &costs->point[i];
        if (point->kind != kind)
            continue;
        for (int t = 0; t < SB_PLAN_TYPES; t++)
            if (line->rows == 0 || point->lights[t] < line->least[t])
                line->least[t] = point->lights[t];
        line->rows++;
        line->worst = fmax(line->worst, fabs(point->ms / line_ms(line, point) - 1));
        for (int t = 0; t < SB_PLAN_TYPES; t++)
            if (point->room[t] > line->most[t])
                line->most[t] = point->room[t];
    }
}

// Without the terms that come out below 0, one after another.
static void make_line(struct sb_plan_costs *costs, enum sb_plan_kind kind)
{
    struct sb_plan_line *line = &costs->line[kind];
    bool used[TERMS];
    double x[TERMS];
    for (int i = 0; i < TERMS; i++)
        used[i] = true;
    for (int lowest = 0; lowest >= 0;) {
        lowest = -1;
        fit(costs, kind, used, x);
        for (int i = 0; i < TERMS; i++)
            if (x[i] < 0 && (lowest < 0 || x[i] < x[lowest]))
                lowest = i;
        if (lowest >= 0)
            used[lowest] = false;
    }
    line->floor = x[0];
    line->idle = x[1];
    memcpy(line->price, x + 2, sizeof line->price);
    measure_line(costs, kind);
}

struct sb_plan_costs *sb_plan_costs_new(const struct sb_plan_costs_params *params,
                                        struct sb_error *err)
{
    struct sb_plan_costs *costs = sb_alloc(sizeof *costs);
    bool *chosen = sb_alloc((size_t)params->count + 1);
    const int best = choose_group(params, chosen);
    int rows = 0;
    costs->point = sb_alloc(((size_t)params->count + 1) * sizeof *costs->point);
    costs->first = best < 0 ? NULL : &params->row[best];
    memcpy(costs->padded, params->padded, sizeof costs->padded);
    for (int i = 0; i < params->count; i++)
        if (chosen[i] && point_of(params, &params->row[i], &costs->point[costs->count]))
            costs->count++;
    free(chosen);
    for (int k = 0; k < SB_PLAN_KINDS; k++) {
        make_line(costs, (enum sb_plan_kind)k);
        rows = costs->line[k].rows > rows ? costs->line[k].rows : rows;
    }
    if (rows >= 2)
        return costs;
    sb_plan_costs_free(&costs);
    sb_fail(err, SB_BAD_INPUT,
            "no two rows with a time differ in light counts alone; shadebench run plan "
            "measures such");
    return NULL;
}

void sb_plan_costs_free(struct sb_plan_costs **costs)
{
    if (*costs)
        free((*costs)->point);
    free(*costs);
    *costs = NULL;
}

const struct sb_plan_line *sb_plan_costs_line(const struct sb_plan_costs *costs,
                                              enum sb_plan_kind kind)
{
    return &costs->line[kind];
}

const struct sb_row *sb_plan_costs_first(const struct sb_plan_costs *costs)
{
    return costs->first;
}

// --- asking ----------------------------------------------------------------------------------

// What the program does for the demand: an exact one draws all that it holds.
static struct point asked(const struct sb_plan_costs *costs,
                          const struct sb_plan_program *program,
                          const struct sb_demand *demand)
{
    struct point point = {.kind = program->kind};
    for (int t = 0; t < SB_PLAN_TYPES; t++) {
        const bool all = program->kind == SB_PLAN_EXACT;
        const bool padded = program->kind == SB_PLAN_PADDED && costs->padded[t];
        point.lights[t] = all ? program->capacity[t] : demand->count[t];
        point.room[t] = padded ? program->capacity[t] : point.lights[t];
    }
    return point;
}

double sb_plan_cost(const struct sb_plan_costs *costs,
                    const struct sb_plan_program *program, const struct sb_demand *demand,
                    bool *measured)
{
    const struct point point = asked(costs, program, demand);
    const struct sb_plan_line *line = &costs->line[program->kind];
    for (int i = 0; i < costs->count; i++) {
        const struct point *row = &costs->point[i];
        if (row->kind == point.kind &&
            memcmp(row->lights, point.lights, sizeof point.lights) == 0 &&
            memcmp(row->room, point.room, sizeof point.room) == 0) {
            if (measured)
                *measured = true;
            return row->ms;
        }
    }
    if (measured)
        *measured = false;
    if (line->rows < 2)
        return INFINITY;
    for (int t = 0; t < SB_PLAN_TYPES; t++)
        if (point.lights[t] < line->least[t] || point.room[t] > line->most[t])
            return INFINITY;
    return line_ms(line, &point);
}
