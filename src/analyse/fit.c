// Groups, their types, and the mixes that are predicted.
#include "analyse/fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/alike.h"

struct fitting {
    const struct sb_fit_params *params;
    struct sb_alike alike;
    struct sb_fit *fit;
    int **member; // numbers of rows, of each group
    int *members, groups;
};

static double count_of(const struct fitting *f, const struct sb_row *row, int type)
{
    return row->axes->value[f->params->count_axis[type]];
}

// --- groups -------------------------------------------------------------------------------

static bool belongs(const struct fitting *f, int group, int row)
{
    for (int i = 0; i < f->members[group]; i++)
        if (f->member[group][i] == row || !sb_alike(&f->alike, f->member[group][i], row))
            return false;
    return true;
}

static void add_member(struct fitting *f, int group, int row)
{
    f->member[group][f->members[group]++] = row;
}

// First every row goes into the first group that takes it; then those for which an axis is moot
// go into all others that take them, too: one frame without lights serves every cone.
static void make_groups(struct fitting *f)
{
    const int count = f->params->count;
    struct sb_arena *arena = &f->fit->arena;
    f->member = sb_arena_alloc(arena, ((size_t)count + 1) * sizeof *f->member);
    f->members = sb_arena_alloc(arena, ((size_t)count + 1) * sizeof *f->members);
    for (int i = 0; i < count; i++) {
        int group = 0;
        if (!sb_row_has_time(&f->params->row[i])) {
            f->fit->without_time++;
            continue;
        }
        while (group < f->groups && !belongs(f, group, i))
            group++;
        if (group == f->groups) {
            f->member[f->groups++] =
                sb_arena_alloc(arena, (size_t)count * sizeof **f->member);
        }
        add_member(f, group, i);
    }
    for (int i = 0; i < count; i++)
        for (int group = 0; group < f->groups; group++)
            if (sb_row_has_time(&f->params->row[i]) && belongs(f, group, i))
                add_member(f, group, i);
}

// How many types of a row are above the lowest count; *type is the last of them.
static int types_above(const struct fitting *f, const struct sb_fit_group *group,
                       const struct sb_row *row, int *type)
{
    int above = 0;
    for (int t = 0; t < f->params->count_axes; t++)
        if (count_of(f, row, t) > group->lowest[t]) {
            above++;
            *type = t;
        }
    return above;
}

static void find_base(const struct fitting *f, struct sb_fit_group *group)
{
    int ignored;
    group->unlit = true;
    for (int t = 0; t < f->params->count_axes; t++) {
        group->lowest[t] = INFINITY;
        for (int i = 0; i < group->rows; i++)
            group->lowest[t] = fmin(group->lowest[t], count_of(f, group->row[i], t));
        group->unlit &= group->lowest[t] <= 0;
    }
    for (int i = 0; i < group->rows && !group->base; i++)
        if (types_above(f, group, group->row[i], &ignored) == 0)
            group->base = group->row[i];
}

// --- types --------------------------------------------------------------------------------

static int by_count(const void *a, const void *b)
{
    const double x = ((const struct sb_fit_count *)a)->n;
    const double y = ((const struct sb_fit_count *)b)->n;
    return (x > y) - (x < y);
}

// Of rows with the same count the first counts. A row with none of the type is no point of its
// line: a shader that lights nothing leaves out what all lights share.
static void gather_counts(const struct fitting *f, const struct sb_fit_group *group,
                          int number, struct sb_fit_type *type)
{
    for (int i = 0; i < group->rows; i++) {
        int above = number;
        const double n = count_of(f, group->row[i], number);
        if (types_above(f, group, group->row[i], &above) > 1 || above != number || n <= 0)
            continue;
        bool known = false;
        for (int c = 0; c < type->counts; c++)
            known |= type->count[c].n == n;
        if (!known)
            type->count[type->counts++] = (struct sb_fit_count){n, group->row[i]};
    }
    qsort(type->count, (size_t)type->counts, sizeof *type->count, by_count);
}

static double first_of(const struct sb_fit_group *group, const struct sb_fit_type *type)
{
    const struct sb_fit_count *one = &type->count[0], *next = &type->count[1];
    if (!group->unlit || !group->base || one->n != 1)
        return NAN;
    const double slope =
        (next->row->median_ms - one->row->median_ms) / (next->n - one->n);
    return one->row->median_ms - slope - group->base->median_ms;
}

static void fit_types(const struct fitting *f, struct sb_fit_group *group)
{
    struct sb_arena *arena = &f->fit->arena;
    group->type =
        sb_arena_alloc(arena, (size_t)f->params->count_axes * sizeof *group->type);
    for (int t = 0; t < f->params->count_axes; t++) {
        struct sb_fit_type type = {.axis = f->params->count_axis[t]};
        type.count = sb_arena_alloc(arena, (size_t)group->rows * sizeof *type.count);
        gather_counts(f, group, t, &type);
        if (type.counts < SB_FIT_COUNTS_MIN || type.counts > SB_LINE_POINTS_MAX)
            continue;
        sb_fit_shape_type(&type);
        type.first_ms = first_of(group, &type);
        group->type[group->types++] = type;
    }
}

static double median_of(double *value, int n)
{
    sb_sort_doubles(value, n);
    return sb_median(value, n);
}

// With the frame without lights in the run, `lit` is that and what the first light brings: every
// type has an estimate of it, they share most of it, and the median is little moved by the noise
// of one. Without that frame it is where the lines begin. Where lights of other types are on in
// all rows, the first one is paid already.
static void find_lit(struct sb_fit_group *group)
{
    double *value = sb_alloc(((size_t)group->types + 1) * sizeof *value);
    int n = 0;
    for (int t = 0; t < group->types; t++)
        if (!isnan(group->type[t].first_ms))
            value[n++] = group->type[t].first_ms;
    group->first_ms = n ? fmax(median_of(value, n), 0) : 0;
    group->lit_ms = NAN;
    if (group->base)
        group->lit_ms = group->base->median_ms + group->first_ms;
    for (int t = 0; t < group->types; t++)
        value[t] = group->type[t].curve.level;
    if (!group->base && group->unlit)
        group->lit_ms = median_of(value, group->types);
    free(value);
}

// --- mixes --------------------------------------------------------------------------------

static const struct sb_fit_type *type_of(const struct sb_fit_group *group, int axis)
{
    for (int t = 0; t < group->types; t++)
        if (group->type[t].axis == axis)
            return &group->type[t];
    return NULL;
}

static void predict(const struct fitting *f, const struct sb_fit_group *group,
                    struct sb_fit_mix *mix)
{
    const struct sb_row *row = mix->row;
    struct sb_interval sum = {group->lit_ms, group->lit_ms, group->lit_ms, 0};
    for (int t = 0; t < f->params->count_axes; t++) {
        const double n = count_of(f, row, t);
        if (!(n > group->lowest[t]))
            continue;
        const struct sb_fit_type *type = type_of(group, f->params->count_axis[t]);
        const struct sb_interval at =
            type ? sb_fit_at(type, n) : (struct sb_interval){NAN, NAN, NAN, 0};
        sum.point += at.point - group->lit_ms;
        sum.lo += at.lo - group->lit_ms;
        sum.hi += at.hi - group->lit_ms;
        sum.n++;
        mix->in_jump |= type && n > type->jump_from && n < type->jump_to;
    }
    mix->predicted = sum;
    mix->off = row->median_ms / sum.point - 1;
    mix->outside = row->ci_hi_ms < sum.lo || row->ci_lo_ms > sum.hi;
}

static void predict_mixes(const struct fitting *f, struct sb_fit_group *group)
{
    double *off = sb_alloc(((size_t)group->rows + 1) * sizeof *off);
    group->mix = sb_arena_alloc(&f->fit->arena, (size_t)group->rows * sizeof *group->mix);
    group->worst = NAN;
    for (int i = 0; i < group->rows; i++) {
        int ignored;
        if (types_above(f, group, group->row[i], &ignored) < 2)
            continue;
        struct sb_fit_mix *mix = &group->mix[group->mixes++];
        mix->row = group->row[i];
        predict(f, group, mix);
        if (isnan(mix->off))
            continue;
        off[group->predicted++] = mix->off;
        if (!(fabs(mix->off) <= fabs(group->worst)))
            group->worst = mix->off;
    }
    group->interaction = median_of(off, group->predicted);
    free(off);
}

// --- all ----------------------------------------------------------------------------------

static bool fit_group(const struct fitting *f, int number, struct sb_fit_group *group)
{
    struct sb_arena *arena = &f->fit->arena;
    *group = (struct sb_fit_group){.rows = f->members[number]};
    group->row = sb_arena_alloc(arena, (size_t)group->rows * sizeof(void *));
    group->lowest =
        sb_arena_alloc(arena, (size_t)f->params->count_axes * sizeof *group->lowest);
    for (int i = 0; i < group->rows; i++)
        group->row[i] = &f->params->row[f->member[number][i]];
    find_base(f, group);
    fit_types(f, group);
    if (group->types == 0)
        return false;
    find_lit(group);
    predict_mixes(f, group);
    return true;
}

void sb_fit_make(const struct sb_fit_params *params, struct sb_fit *fit)
{
    struct fitting f = {.params = params, .fit = fit};
    bool free_axes[SB_AXIS_MAX] = {false};
    for (int t = 0; t < params->count_axes; t++)
        free_axes[params->count_axis[t]] = true;
    sb_alike_make(&f.alike, params->axes, params->row, params->count, free_axes);
    make_groups(&f);
    bool *used = sb_alloc((size_t)params->count + 1);
    fit->group = sb_alloc(((size_t)f.groups + 1) * sizeof *fit->group);
    for (int g = 0; g < f.groups; g++) {
        if (!fit_group(&f, g, &fit->group[fit->count]))
            continue;
        fit->count++;
        for (int i = 0; i < f.members[g]; i++)
            used[f.member[g][i]] = true;
    }
    for (int i = 0; i < params->count; i++)
        fit->left_over += !used[i] && sb_row_has_time(&params->row[i]);
    free(used);
    sb_alike_free(&f.alike);
}

void sb_fit_free(struct sb_fit *fit)
{
    free(fit->group);
    sb_arena_free(&fit->arena);
    *fit = (struct sb_fit){0};
}
