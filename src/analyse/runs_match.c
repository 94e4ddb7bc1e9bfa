#include "analyse/runs_match.h"

#include <stdlib.h>
#include <string.h>

// --- words ----------------------------------------------------------------------------------

const char *sb_run_word(const struct sb_run_words *words, int i, int axis)
{
    const int own = words->axis[axis];
    return own < 0 ? "" : words->word[(size_t)i * SB_AXIS_MAX + (size_t)own];
}

static void add_axes(struct sb_run_match *match, const struct sb_axes *axes)
{
    for (int i = 0; i < axes->count; i++) {
        int k = 0;
        while (k < match->axis_count &&
               strcmp(match->axis[k]->name, axes->row[i].name) != 0)
            k++;
        if (k == match->axis_count && !sb_axis_is_shorthand(&axes->row[i]))
            match->axis[match->axis_count++] = &axes->row[i];
    }
}

static void make_words(struct sb_run_words *words, const struct sb_run_side *side,
                       struct sb_run_match *match)
{
    struct sb_text text = {0};
    words->side = side;
    for (int k = 0; k < match->axis_count; k++)
        words->axis[k] = sb_axes_find(side->axes, match->axis[k]->name);
    words->word = sb_alloc(((size_t)side->count + 1) * SB_AXIS_MAX * sizeof *words->word);
    for (int i = 0; i < side->count; i++)
        for (int a = 0; a < side->axes->count; a++) {
            const struct sb_axis *axis = &side->axes->row[a];
            const char **word = &words->word[(size_t)i * SB_AXIS_MAX + (size_t)a];
            sb_text_clear(&text);
            sb_variant_value_text(side->axes, side->row[i].axes, a, &text);
            if (!text.length)
                *word = "";
            else if (axis->values)
                *word = axis->values[(int)side->row[i].axes->value[a]].name;
            else
                *word = sb_arena_strdup(&match->arena, text.data);
        }
    sb_text_free(&text);
}

// --- by name --------------------------------------------------------------------------------

struct name {
    const struct sb_row *row;
    int place;
};

static int by_name(const void *a, const void *b)
{
    const struct sb_row *x = ((const struct name *)a)->row,
                        *y = ((const struct name *)b)->row;
    const int order = strcmp(x->scene, y->scene);
    return order ? order : strcmp(x->variant, y->variant);
}

static void match_names(struct sb_run_match *match, bool *taken)
{
    const struct sb_run_side *a = match->a.side, *b = match->b.side;
    struct name *name = sb_alloc(((size_t)b->count + 1) * sizeof *name);
    for (int j = 0; j < b->count; j++)
        name[j] = (struct name){&b->row[j], j};
    qsort(name, (size_t)b->count, sizeof *name, by_name);
    for (int i = 0; i < a->count; i++) {
        const struct name wanted = {&a->row[i], i};
        const struct name *found =
            bsearch(&wanted, name, (size_t)b->count, sizeof *name, by_name);
        match->partner[i] = found && !taken[found->place] ? found->place : -1;
        if (match->partner[i] >= 0)
            taken[match->partner[i]] = true;
    }
    free(name);
}

// --- by value -------------------------------------------------------------------------------

// The word that all rows of a run have on an axis, moot ones apart; NULL: there are several, or none.
static const char *only_word(const struct sb_run_words *words, int axis)
{
    const char *only = NULL;
    for (int i = 0; i < words->side->count; i++) {
        const char *word = sb_run_word(words, i, axis);
        if (*word && only && strcmp(word, only) != 0)
            return NULL;
        if (*word)
            only = word;
    }
    return only;
}

static const char *only_scene(const struct sb_run_side *side)
{
    for (int i = 1; i < side->count; i++)
        if (strcmp(side->row[i].scene, side->row[0].scene) != 0)
            return NULL;
    return side->count ? side->row[0].scene : NULL;
}

static bool both_and_unequal(const char *a, const char *b)
{
    return a && b && strcmp(a, b) != 0;
}

// What all of one run have one way and all of the other another way.
struct apart {
    bool scene, axis[2 * SB_AXIS_MAX];
};

static bool same_values(const struct sb_run_match *match, int i, int j,
                        const struct apart *apart)
{
    const struct sb_row *x = &match->a.side->row[i], *y = &match->b.side->row[j];
    if (!apart->scene && strcmp(x->scene, y->scene) != 0)
        return false;
    for (int k = 0; k < match->axis_count; k++) {
        const char *a = sb_run_word(&match->a, i, k), *b = sb_run_word(&match->b, j, k);
        if (!apart->axis[k] && *a && *b && strcmp(a, b) != 0)
            return false;
    }
    return true;
}

static void match_values(struct sb_run_match *match, bool *taken)
{
    struct apart apart = {
        .scene = both_and_unequal(only_scene(match->a.side), only_scene(match->b.side))};
    for (int k = 0; k < match->axis_count; k++)
        apart.axis[k] =
            both_and_unequal(only_word(&match->a, k), only_word(&match->b, k));
    for (int i = 0; i < match->a.side->count; i++)
        for (int j = 0; match->partner[i] < 0 && j < match->b.side->count; j++)
            if (!taken[j] && same_values(match, i, j, &apart)) {
                match->partner[i] = j;
                taken[j] = true;
            }
}

void sb_run_match_make(struct sb_run_match *match, const struct sb_run_side *a,
                       const struct sb_run_side *b)
{
    *match = (struct sb_run_match){0};
    add_axes(match, a->axes);
    add_axes(match, b->axes);
    make_words(&match->a, a, match);
    make_words(&match->b, b, match);
    match->partner = sb_alloc(((size_t)a->count + 1) * sizeof *match->partner);
    bool *taken = sb_alloc((size_t)b->count + 1);
    match_names(match, taken);
    match_values(match, taken);
    free(taken);
}

void sb_run_match_free(struct sb_run_match *match)
{
    free(match->a.word);
    free(match->b.word);
    free(match->partner);
    sb_arena_free(&match->arena);
    *match = (struct sb_run_match){0};
}
