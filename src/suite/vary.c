#include <string.h>

#include "suite/draft.h"
#include "suite/suite.h"

static bool is_there(const struct sb_suite *suite, const struct sb_plan_entry *entry)
{
    for (int i = 0; i < suite->entry_count; i++)
        if (strcmp(suite->entry[i].scene, entry->scene) == 0 &&
            sb_variant_equal(&suite->axes, &suite->entry[i].variant, &entry->variant))
            return true;
    return false;
}

// The entry with another value of the axis; false where there is no such variant.
static bool vary(struct sb_suite *suite, const struct sb_vary_params *params, int value,
                 struct sb_plan_entry *entry)
{
    const struct sb_variant whole = entry->variant;
    struct sb_text id = {0};
    sb_variant_put(&entry->variant, params->axis, value);
    if (!params->wanted(&suite->axes, &whole, &entry->variant) || is_there(suite, entry))
        return false;
    sb_entry_id(&suite->axes, entry->preset, &entry->variant, &id);
    entry->id = sb_arena_strdup(&suite->arena, sb_text_get(&id));
    sb_text_free(&id);
    return true;
}

void sb_suite_vary(struct sb_suite *suite, const struct sb_vary_params *params)
{
    const int values = suite->axes.row[params->axis].value_count;
    const size_t room = (size_t)suite->entry_count * (size_t)values;
    struct sb_plan_entry *varied = sb_arena_alloc(&suite->arena, room * sizeof *varied);
    int count = 0;
    for (int i = 0; i < suite->entry_count; i++) {
        varied[count++] = suite->entry[i];
        for (int v = 0; v < values; v++) {
            struct sb_plan_entry entry = suite->entry[i];
            if (v != (int)entry.variant.value[params->axis] &&
                vary(suite, params, v, &entry))
                varied[count++] = entry;
        }
    }
    suite->entry = varied;
    suite->entry_count = count;
}
