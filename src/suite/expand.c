// From a draft to plan entries: scenes, times sweep values, times every combination of
// cross values, the last of them fastest.
#include <stdlib.h>
#include <string.h>

#include "suite/draft.h"

enum { ENTRIES_MAX = 10000 };

struct expansion {
    const struct sb_draft *draft;
    struct sb_suite *suite;
    uint64_t *hash; // of each entry, so that finding an equal one is cheap
};

// As doubles, for counts that no integer holds are to be refused, too.
static double combinations(const struct sb_draft *draft)
{
    double count = 0;
    for (int i = 0; i < draft->sweep.count; i++)
        count += draft->sweep.row[i].count;
    if (draft->sweep.count == 0)
        count = 1;
    for (int i = 0; i < draft->cross.count; i++)
        count *= draft->cross.row[i].count;
    return count * draft->scene_count;
}

static bool is_excluded(const struct expansion *ex, const struct sb_variant *v)
{
    for (int i = 0; i < ex->draft->exclude_count; i++)
        if (sb_condition_holds(&ex->suite->axes, ex->draft->exclude[i], v))
            return true;
    return false;
}

static bool is_duplicate(const struct expansion *ex, const char *scene,
                         const struct sb_variant *v, uint64_t hash)
{
    for (int i = 0; i < ex->suite->entry_count; i++)
        if (ex->hash[i] == hash && strcmp(ex->suite->entry[i].scene, scene) == 0 &&
            sb_variant_equal(&ex->suite->axes, &ex->suite->entry[i].variant, v))
            return true;
    return false;
}

static bool add_entry(struct expansion *ex, const char *scene, struct sb_variant v,
                      struct sb_error *err)
{
    struct sb_suite *suite = ex->suite;
    struct sb_text id = {0};
    const bool good = sb_variant_resolve(&suite->axes, &v, err);
    // Before the failure counts: `exclude` is how a suite keeps out what cannot be made.
    if (is_excluded(ex, &v)) {
        suite->excluded++;
        return true;
    }
    sb_variant_id(&suite->axes, &v, &id);
    if (!good) {
        sb_fail(err, err->status, "%s: variant %s: %s", ex->draft->origin,
                sb_text_get(&id), err->text);
        sb_text_free(&id);
        return false;
    }
    const uint64_t hash = sb_variant_hash(&suite->axes, &v);
    if (is_duplicate(ex, scene, &v, hash)) {
        suite->duplicates++;
    } else {
        ex->hash[suite->entry_count] = hash;
        suite->entry[suite->entry_count++] = (struct sb_plan_entry){
            .scene = scene,
            .variant = v,
            .id = sb_arena_strdup(&suite->arena, sb_text_get(&id))};
    }
    sb_text_free(&id);
    return true;
}

static bool add_crossed(struct expansion *ex, const char *scene, struct sb_variant v,
                        int depth, struct sb_error *err)
{
    const struct sb_dimensions *cross = &ex->draft->cross;
    if (depth == cross->count)
        return add_entry(ex, scene, v, err);
    for (int i = 0; i < cross->row[depth].count; i++) {
        sb_variant_put(&v, cross->row[depth].axis, cross->row[depth].value[i]);
        if (!add_crossed(ex, scene, v, depth + 1, err))
            return false;
    }
    return true;
}

static bool add_scene(struct expansion *ex, const char *scene, struct sb_error *err)
{
    const struct sb_draft *draft = ex->draft;
    if (draft->sweep.count == 0)
        return add_crossed(ex, scene, draft->base, 0, err);
    for (int i = 0; i < draft->sweep.count; i++)
        for (int k = 0; k < draft->sweep.row[i].count; k++) {
            struct sb_variant v = draft->base;
            sb_variant_put(&v, draft->sweep.row[i].axis, draft->sweep.row[i].value[k]);
            if (!add_crossed(ex, scene, v, 0, err))
                return false;
        }
    return true;
}

bool sb_draft_expand(const struct sb_draft *draft, struct sb_suite *suite,
                     struct sb_error *err)
{
    const double count = combinations(draft);
    if (count > ENTRIES_MAX)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: sweep, cross and scene make %.0f variants, before any is "
                       "excluded; valid: at most %d",
                       draft->origin, count, ENTRIES_MAX);
    struct expansion ex = {draft, suite, sb_alloc((size_t)count * sizeof *ex.hash)};
    suite->entry = sb_arena_alloc(&suite->arena, (size_t)count * sizeof *suite->entry);
    bool good = true;
    for (int i = 0; good && i < draft->scene_count; i++)
        good = add_scene(&ex, draft->scene[i], err);
    if (good && suite->entry_count == 0)
        good = sb_fail(err, SB_BAD_INPUT, "%s: no variant is left: all %d are excluded",
                       draft->origin, suite->excluded);
    free(ex.hash);
    return good;
}
