#include "analyse/crossing.h"

#include <math.h>
#include <stdlib.h>

#include "analyse/alike.h"

struct finding {
    const struct sb_row *row;
    int count;
    struct sb_alike same_mesh,
        any_mesh; // equal but for the axis; and but for the mesh, too
    int *first_a; // numbers of the rows of each series' first pair
    int *first_b;
    struct sb_crossings *crossings;
    int capacity;
};

static double density_of(const struct sb_row *row)
{
    if (row->vertices <= 0 || row->fragments <= 0)
        return NAN;
    return (double)row->vertices / 3 / (double)row->fragments;
}

static struct sb_crossing_pair pair_of(const struct sb_row *a, const struct sb_row *b)
{
    // The fragments of the two may differ by a pixel at an edge.
    return (struct sb_crossing_pair){
        .density = sqrt(density_of(a) * density_of(b)),
        .a = a,
        .b = b,
        .ratio = a->median_ms / b->median_ms,
        .lo = a->ci_lo_ms / b->ci_hi_ms,
        .hi = a->ci_hi_ms / b->ci_lo_ms,
    };
}

static void add_pair(struct finding *f, struct sb_crossing_series *series,
                     const struct sb_crossing_pair *pair)
{
    if (!series->pair)
        series->pair =
            sb_arena_alloc(&f->crossings->arena, (size_t)f->count * sizeof *series->pair);
    int at = series->pairs;
    for (int i = 0; i < series->pairs; i++)
        if (series->pair[i].density == pair->density)
            return; // measured twice: the first counts
    while (at > 0 && series->pair[at - 1].density > pair->density) {
        series->pair[at] = series->pair[at - 1];
        at--;
    }
    series->pair[at] = *pair;
    series->pairs++;
}

// Puts the pair into the first series whose first pair is like it, from number `from` on.
static void place_pair(struct finding *f, int from, int axis, int a, int b)
{
    struct sb_crossings *all = f->crossings;
    const struct sb_crossing_pair pair = pair_of(&f->row[a], &f->row[b]);
    int s = from;
    if (!(pair.density > 0))
        return;
    while (s < all->count &&
           !(all->series[s].value_a == (int)f->row[a].axes->value[axis] &&
             all->series[s].value_b == (int)f->row[b].axes->value[axis] &&
             sb_alike(&f->any_mesh, f->first_a[s], a) &&
             sb_alike(&f->any_mesh, f->first_b[s], b)))
        s++;
    if (s == all->count) {
        all->series = sb_grow(all->series, all->count, &f->capacity, sizeof *all->series);
        f->first_a = sb_realloc(f->first_a, (size_t)f->capacity * sizeof *f->first_a);
        f->first_b = sb_realloc(f->first_b, (size_t)f->capacity * sizeof *f->first_b);
        f->first_a[s] = a;
        f->first_b[s] = b;
        all->series[all->count++] = (struct sb_crossing_series){
            .axis = axis,
            .value_a = (int)f->row[a].axes->value[axis],
            .value_b = (int)f->row[b].axes->value[axis],
        };
    }
    add_pair(f, &all->series[s], &pair);
}

static bool is_paired(const struct sb_axis *axis)
{
    if (axis->kind != SB_QUALITY || !axis->values)
        return false;
    for (int v = 0; v < axis->value_count; v++)
        if (*axis->values[v].sets)
            return false;
    return true;
}

// --- where the ratio is 1 -----------------------------------------------------------------

// The density between two pairs at which the ratio, that of its interval's lower (-1) or upper
// (1) end, is 1. The two lie on different sides of it.
static double meets(const struct sb_crossing_pair *a, const struct sb_crossing_pair *b,
                    int side)
{
    const double ya = log(side < 0 ? a->lo : side > 0 ? a->hi : a->ratio);
    const double yb = log(side < 0 ? b->lo : side > 0 ? b->hi : b->ratio);
    const double xa = log(a->density), xb = log(b->density);
    return exp(xa + (xb - xa) * ya / (ya - yb));
}

// 1: a slower by its whole interval, -1: b, 0: not decided.
static int verdict_of(const struct sb_crossing_pair *pair)
{
    return pair->lo > 1 ? 1 : pair->hi < 1 ? -1 : 0;
}

// From between pairs i and i + 1, on to where the intervals decide.
static void find_ends(const struct sb_crossing_series *series, int i,
                      struct sb_crossing *crossing)
{
    const struct sb_crossing_pair *pair = series->pair;
    const int last = series->pairs - 1;
    int down = i, up = i + 1;
    while (down > 0 && verdict_of(&pair[down]) == 0)
        down--;
    while (up < last && verdict_of(&pair[up]) == 0)
        up++;
    crossing->open_lo = verdict_of(&pair[down]) == 0;
    crossing->open_hi = verdict_of(&pair[up]) == 0;
    // Where a is slower, it is the lower end of the ratio that comes to 1 first.
    crossing->lo = crossing->open_lo
                       ? pair[0].density
                       : meets(&pair[down], &pair[down + 1], -verdict_of(&pair[down]));
    crossing->hi = crossing->open_hi
                       ? pair[last].density
                       : meets(&pair[up - 1], &pair[up], -verdict_of(&pair[up]));
}

static void find_crossings(struct finding *f, struct sb_crossing_series *series)
{
    series->crossing = sb_arena_alloc(&f->crossings->arena,
                                      (size_t)series->pairs * sizeof *series->crossing);
    for (int i = 0; i + 1 < series->pairs; i++) {
        const struct sb_crossing_pair *a = &series->pair[i], *b = a + 1;
        if ((a->ratio > 1) == (b->ratio > 1))
            continue;
        struct sb_crossing crossing = {
            .density = meets(a, b, 0),
            .b_first = a->ratio > 1,
        };
        find_ends(series, i, &crossing);
        series->crossing[series->crossings++] = crossing;
    }
}

// --- all ----------------------------------------------------------------------------------

static void find_on_axis(struct finding *f, const struct sb_axes *axes, int axis)
{
    const int from = f->crossings->count;
    bool free_axes[SB_AXIS_MAX] = {false};
    free_axes[axis] = true;
    sb_alike_make(&f->same_mesh, axes, f->row, f->count, free_axes);
    for (int a = 0; a < axes->count; a++)
        free_axes[a] = (axes->row[a].flags & SB_TRUTH) != 0;
    free_axes[axis] = false;
    sb_alike_make(&f->any_mesh, axes, f->row, f->count, free_axes);
    for (int a = 0; a < f->count; a++)
        for (int b = 0; b < f->count; b++)
            if (f->row[a].axes->value[axis] < f->row[b].axes->value[axis] &&
                sb_row_has_time(&f->row[a]) && sb_row_has_time(&f->row[b]) &&
                sb_alike(&f->same_mesh, a, b))
                place_pair(f, from, axis, a, b);
    sb_alike_free(&f->same_mesh);
    sb_alike_free(&f->any_mesh);
}

static bool varies(const struct sb_row *row, int count, int axis)
{
    for (int i = 1; i < count; i++)
        if (row[i].axes->value[axis] != row[0].axes->value[axis])
            return true;
    return false;
}

void sb_crossings_find(const struct sb_axes *axes, const struct sb_row *row, int count,
                       struct sb_crossings *crossings)
{
    struct finding f = {.row = row, .count = count, .crossings = crossings};
    for (int axis = 0; axis < axes->count; axis++)
        if (is_paired(&axes->row[axis]) && varies(row, count, axis))
            find_on_axis(&f, axes, axis);
    int kept = 0;
    for (int s = 0; s < crossings->count; s++)
        if (crossings->series[s].pairs >= 2)
            crossings->series[kept++] = crossings->series[s];
    crossings->count = kept;
    for (int s = 0; s < kept; s++)
        find_crossings(&f, &crossings->series[s]);
    free(f.first_a);
    free(f.first_b);
}

void sb_crossings_free(struct sb_crossings *crossings)
{
    free(crossings->series);
    sb_arena_free(&crossings->arena);
    *crossings = (struct sb_crossings){0};
}
