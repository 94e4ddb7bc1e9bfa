#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/alike.h"
#include "analyse/terms.h"

const char *const sb_term_verdict_words[SB_TERM_VERDICT_COUNT] = {
    [SB_TERM_UNKNOWN] = "unknown",
    [SB_TERM_FREE] = "free",
    [SB_TERM_COSTS] = "costs",
    [SB_TERM_BREAKS] = "breaks",
};

const char sb_term_rules[] =
    "free: lowered alone, the largest error is below 0.5/255 or within 1.1 times that of "
    "all "
    "high,\nand the interval of its time ends at 1.05 at most and is not wholly above 1\n"
    "breaks: that error is neither, and above 4/255; or the picture holds NaN or "
    "infinity\n"
    "costs: the error is between, or all of the interval is above 1; unknown: no error, "
    "or no\n"
    "interval that tells\n";

// The word that `sets` ("p_sum=highp p_color=lowp") gives the axis called `name`, or NULL.
static const char *word_set(const char *sets, const char *name, size_t *length)
{
    const size_t name_length = strlen(name);
    for (sets += strspn(sets, " "); *sets; sets += strspn(sets, " ")) {
        const size_t word = strcspn(sets, " ");
        if (word > name_length && sets[name_length] == '=' &&
            strncmp(sets, name, name_length) == 0) {
            *length = word - name_length - 1;
            return sets + name_length + 1;
        }
        sets += word;
    }
    return NULL;
}

// The first axis that has values which set others, or -1.
static int find_shorthand(const struct sb_axes *axes)
{
    for (int a = 0; a < axes->count; a++)
        for (int v = 0; v < axes->row[a].value_count; v++)
            if (*axes->row[a].values[v].sets)
                return a;
    return -1;
}

int sb_terms_find(const struct sb_axes *axes, int *axis)
{
    const int shorthand = find_shorthand(axes);
    size_t length;
    int count = 0;
    for (int a = 0; shorthand >= 0 && a < axes->count; a++)
        for (int v = 0; v < axes->row[shorthand].value_count; v++)
            if (word_set(axes->row[shorthand].values[v].sets, axes->row[a].name,
                         &length)) {
                axis[count++] = a;
                break;
            }
    return count;
}

struct pricing {
    const struct sb_axes *axes;
    const struct sb_row *row;
    int row_count;
    int shorthand, term[SB_AXIS_MAX], term_count;
    const char *high_word, *low_word;
    double high[SB_AXIS_MAX], low[SB_AXIS_MAX]; // of each term
    bool *taken;                                // rows that are in a group
    struct sb_terms *terms;
    int capacity;
};

// A value of the shorthand that gives all terms one word is a level; fills their values.
static bool read_level(const struct pricing *p, int value, double *level)
{
    const char *sets = p->axes->row[p->shorthand].values[value].sets;
    const char *first = NULL;
    size_t first_length = 0;
    for (int t = 0; t < p->term_count; t++) {
        const struct sb_axis *axis = &p->axes->row[p->term[t]];
        size_t length;
        const char *word = word_set(sets, axis->name, &length);
        if (!word || length > SB_NAME_MAX)
            return false;
        if (!first) {
            first = word;
            first_length = length;
        }
        char name[SB_NAME_MAX + 1] = "";
        memcpy(name, word, length);
        level[t] = sb_axis_value_find(axis, name);
        if (level[t] < 0 || length != first_length || strncmp(word, first, length) != 0)
            return false;
    }
    return first != NULL;
}

enum place { OTHER, ALL_HIGH, ALL_LOW, LOWERED, RAISED };

// Where the row stands in its group; *term is the one changed.
static enum place place_of(const struct pricing *p, const struct sb_row *row, int *term)
{
    int high = 0, low = 0, last_high = 0, last_low = 0;
    for (int t = 0; t < p->term_count; t++) {
        const double value = row->axes->value[p->term[t]];
        if (value == p->high[t]) {
            high++;
            last_high = t;
        } else if (value == p->low[t]) {
            low++;
            last_low = t;
        }
    }
    *term = low == 1 ? last_low : last_high;
    if (high + low != p->term_count)
        return OTHER;
    return low == 0    ? ALL_HIGH
           : high == 0 ? ALL_LOW
           : low == 1  ? LOWERED
           : high == 1 ? RAISED
                       : OTHER;
}

static bool same_but_terms(const struct pricing *p, const struct sb_row *a,
                           const struct sb_row *b)
{
    if (!sb_text_same(a->scene, b->scene) || !sb_text_same(a->renderer, b->renderer) ||
        !sb_text_same(a->version, b->version) ||
        !sb_text_same(a->timer_source, b->timer_source))
        return false;
    for (int i = 0, t = 0; i < p->axes->count; i++) {
        if (t < p->term_count && p->term[t] == i)
            t++;
        else if (i != p->shorthand && a->axes->value[i] != b->axes->value[i])
            return false;
    }
    return true;
}

static bool is_first_of_scene(const struct pricing *p, const struct sb_row *row)
{
    for (const struct sb_row *other = p->row; other < row; other++)
        if (sb_text_same(other->scene, row->scene))
            return false;
    return true;
}

static struct sb_term_change change_of(const struct pricing *p, const struct sb_row *from,
                                       const struct sb_row *row)
{
    struct sb_term_change change = {row, NAN, NAN, NAN, false, NAN, NAN};
    if (!row)
        return change;
    change.max_err = row->max_err;
    change.flip_mean = row->flip_mean;
    if (!from || !sb_row_has_time(from) || !sb_row_has_time(row))
        return change;
    change.paired = is_first_of_scene(p, from) && !isnan(row->ratio);
    if (change.paired) {
        change.time = row->ratio;
        change.time_lo = row->ratio_lo;
        change.time_hi = row->ratio_hi;
    } else {
        change.time = row->median_ms / from->median_ms;
        change.time_lo = row->ci_lo_ms / from->ci_hi_ms;
        change.time_hi = row->ci_hi_ms / from->ci_lo_ms;
    }
    return change;
}

static enum sb_term_verdict verdict_of(const struct sb_row *high,
                                       const struct sb_term_change *lowered)
{
    const double error = lowered->max_err;
    if (!lowered->row)
        return SB_TERM_UNKNOWN;
    if (lowered->row->nonfinite > 0) // SB_NO_COUNT is not
        return SB_TERM_BREAKS;
    if (isnan(error))
        return SB_TERM_UNKNOWN;
    if (!(error < SB_TERM_SMALL_ERROR)) {
        if (!high || isnan(high->max_err))
            return SB_TERM_UNKNOWN;
        if (!(error <= SB_TERM_SAME_ERROR * high->max_err))
            return error > SB_TERM_LARGE_ERROR ? SB_TERM_BREAKS : SB_TERM_COSTS;
    }
    if (lowered->time_lo > 1)
        return SB_TERM_COSTS;
    return lowered->time_hi <= SB_TERM_SAME_TIME ? SB_TERM_FREE : SB_TERM_UNKNOWN;
}

static void keep_group(struct pricing *p, struct sb_term_prices *group)
{
    const struct sb_row *high = group->high, *low = group->low;
    bool priced = false;
    for (int t = 0; t < group->count; t++) {
        struct sb_term_price *price = &group->price[t];
        priced |= (high && price->lowered.row) || (low && price->raised.row);
        price->axis = p->term[t];
        price->lowered = change_of(p, high, price->lowered.row);
        price->raised = change_of(p, low, price->raised.row);
        price->verdict = verdict_of(high, &price->lowered);
    }
    if (!priced)
        return;
    struct sb_terms *terms = p->terms;
    terms->group =
        sb_grow(terms->group, terms->count, &p->capacity, sizeof *terms->group);
    terms->group[terms->count++] = *group;
}

// The group of row `first`: what differs from it in terms only. Of equal rows the first counts.
static void gather(struct pricing *p, int first)
{
    struct sb_term_prices group = {
        .high_word = p->high_word, .low_word = p->low_word, .count = p->term_count};
    group.price =
        sb_arena_alloc(&p->terms->arena, (size_t)p->term_count * sizeof *group.price);
    for (int i = first; i < p->row_count; i++) {
        const struct sb_row *row = &p->row[i];
        int t;
        const enum place place = place_of(p, row, &t);
        if (p->taken[i] || !same_but_terms(p, &p->row[first], row))
            continue;
        p->taken[i] = true;
        const struct sb_row **slot = place == ALL_HIGH  ? &group.high
                                     : place == ALL_LOW ? &group.low
                                     : place == LOWERED ? &group.price[t].lowered.row
                                     : place == RAISED  ? &group.price[t].raised.row
                                                        : NULL;
        if (slot && !*slot)
            *slot = row;
    }
    keep_group(p, &group);
}

void sb_terms_price(const struct sb_axes *axes, const struct sb_row *row, int count,
                    struct sb_terms *terms)
{
    struct pricing p = {.axes = axes, .row = row, .row_count = count, .terms = terms};
    p.shorthand = find_shorthand(axes);
    p.term_count = sb_terms_find(axes, p.term);
    if (p.shorthand < 0 || p.term_count == 0)
        return;
    const struct sb_axis *shorthand = &axes->row[p.shorthand];
    p.high_word = shorthand->values[(int)shorthand->init].name;
    if (!read_level(&p, (int)shorthand->init, p.high))
        return;
    p.taken = sb_alloc((size_t)count + 1);
    for (int v = 0; v < shorthand->value_count; v++) {
        if (v == (int)shorthand->init || !read_level(&p, v, p.low))
            continue;
        p.low_word = shorthand->values[v].name;
        memset(p.taken, 0, (size_t)count);
        for (int i = 0; i < count; i++)
            if (!p.taken[i])
                gather(&p, i);
    }
    free(p.taken);
}

void sb_terms_free(struct sb_terms *terms)
{
    free(terms->group);
    sb_arena_free(&terms->arena);
    *terms = (struct sb_terms){0};
}
