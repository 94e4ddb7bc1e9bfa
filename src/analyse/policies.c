#include "analyse/policies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

double sb_row_setup_ms(const struct sb_row *row)
{
    return row->compile_ms + row->link_ms + fmax(row->first_draw_ms - row->median_ms, 0);
}

double sb_payback_frames(double longer_ms, double saved_ms)
{
    if (isnan(longer_ms) || isnan(saved_ms) || (longer_ms <= 0 && saved_ms < 0))
        return NAN;
    if (longer_ms <= 0)
        return 0;
    return saved_ms > 0 ? longer_ms / saved_ms : INFINITY;
}

const struct sb_row *sb_row_against(const struct sb_row *rows, int count,
                                    const struct sb_row *row)
{
    for (int i = 0; row->against && i < count; i++)
        if (strcmp(rows[i].scene, row->scene) == 0 &&
            strcmp(rows[i].variant, row->against) == 0)
            return &rows[i];
    return NULL;
}

static bool same_policy(const struct sb_axes *axes, const struct sb_row *a,
                        const struct sb_row *b)
{
    for (int i = 0; i < axes->count; i++)
        if (axes->row[i].kind == SB_IMPLEMENTATION &&
            a->axes->value[i] != b->axes->value[i])
            return false;
    return true;
}

struct member { // of a policy: a row, and the one that it is held against
    const struct sb_row *own, *uber;
};

// Of the programs that the rows of one policy are held against. Equal ones are made once: the time
// of the row that took longest, since it may have made shadow maps or lamps besides.
static double uber_setup(const struct member *member, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        double longest = 0;
        bool first = true;
        for (int j = 0; j < count; j++)
            if (member[i].uber->lit_hash && // NULL: not known which
                sb_text_same(member[i].uber->lit_hash, member[j].uber->lit_hash)) {
                first &= j >= i;
                longest = fmax(longest, sb_row_setup_ms(member[j].uber));
            }
        if (first)
            sum += longest;
    }
    return sum;
}

static void add_up(const struct member *member, int count, struct sb_policy_total *total)
{
    double log_ratio = 0;
    bool itself = true;
    *total = (struct sb_policy_total){.first = member->own, .rows = count};
    for (int i = 0; i < count; i++) {
        const struct sb_row *own = member[i].own, *uber = member[i].uber;
        if (own->programs != SB_NO_COUNT)
            total->programs += (int)own->programs;
        total->setup_ms += sb_row_setup_ms(own);
        total->saved_ms += uber->median_ms * (1 - own->against_ratio) / count;
        log_ratio += log(own->against_ratio) / count;
        itself &= own == uber;
    }
    total->uber_setup_ms = uber_setup(member, count);
    total->ratio = exp(log_ratio);
    total->payback_frames =
        itself
            ? (double)NAN
            : sb_payback_frames(total->setup_ms - total->uber_setup_ms, total->saved_ms);
}

int sb_policy_totals(const struct sb_axes *axes, const struct sb_row *row, int count,
                     bool (*is_policy)(const struct sb_variant *variant),
                     struct sb_policy_total *total)
{
    const size_t room = (size_t)count + 1;
    struct member *member = sb_alloc(room * sizeof *member);
    bool *taken = sb_alloc(room * sizeof *taken);
    int totals = 0;
    for (int i = 0; i < count; i++) {
        int members = 0;
        for (int j = i; j < count; j++) {
            const struct sb_row *other = sb_row_against(row, count, &row[j]);
            if (taken[j] || !other || isnan(row[j].against_ratio) ||
                !is_policy(row[j].axes) || !same_policy(axes, &row[i], &row[j]))
                continue;
            taken[j] = true;
            member[members++] = (struct member){&row[j], other};
        }
        if (members > 0)
            add_up(member, members, &total[totals++]);
    }
    free(taken);
    free(member);
    return totals;
}
