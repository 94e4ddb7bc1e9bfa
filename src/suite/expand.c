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

void sb_entry_id(const struct sb_axes *axes, const char *preset,
                 const struct sb_variant *v, struct sb_text *id)
{
    if (!preset) {
        sb_variant_id(axes, v, id);
        return;
    }
    struct sb_text more = {0};
    sb_variant_id(axes, v, &more);
    sb_text_add(id, preset);
    if (strchr(more.data, '=')) // not "default"
        sb_text_printf(id, ",%s", more.data);
    sb_text_free(&more);
}

static bool resolve(const struct expansion *ex, struct sb_variant *v,
                    struct sb_error *err)
{
    // To shorthand what the preset gives is given, to the id it is not.
    const struct sb_variant shown = *v;
    for (int i = 0; i < 2; i++)
        v->given[i] |= ex->draft->preset_given[i];
    const bool good = sb_variant_resolve(&ex->suite->axes, v, err);
    memcpy(v->given, shown.given, sizeof v->given);
    return good;
}

static bool add_entry(struct expansion *ex, const char *scene, struct sb_variant v,
                      struct sb_error *err)
{
    struct sb_suite *suite = ex->suite;
    struct sb_text id = {0};
    const bool good = resolve(ex, &v, err);
    // Before the failure counts: `exclude` is how a suite keeps out what cannot be made.
    if (is_excluded(ex, &v)) {
        suite->excluded++;
        return true;
    }
    sb_entry_id(&suite->axes, ex->draft->preset, &v, &id);
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
            .preset = ex->draft->preset,
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
    const int before = suite->entry_count;
    const double all = combinations(draft) + before;
    if (all > ENTRIES_MAX)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: sweep, cross and scene make %.0f variants, before any is "
                       "excluded; valid: at most %d",
                       draft->origin, all, ENTRIES_MAX);
    struct expansion ex = {draft, suite, sb_alloc((size_t)all * sizeof *ex.hash)};
    struct sb_plan_entry *entry =
        sb_arena_alloc(&suite->arena, (size_t)all * sizeof *entry);
    for (int i = 0; i < before; i++) {
        entry[i] = suite->entry[i];
        ex.hash[i] = sb_variant_hash(&suite->axes, &entry[i].variant);
    }
    suite->entry = entry;
    bool good = true;
    for (int i = 0; good && i < draft->scene_count; i++)
        good = add_scene(&ex, draft->scene[i], err);
    free(ex.hash);
    return good;
}
