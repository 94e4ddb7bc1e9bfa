#include "analyse/alike.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

void sb_alike_make(struct sb_alike *alike, const struct sb_axes *axes,
                   const struct sb_row *row, int count, const bool *free_axes)
{
    *alike = (struct sb_alike){.axes = axes, .row = row, .count = count};
    alike->moot = sb_alloc(((size_t)count + 1) * SB_AXIS_MAX * sizeof *alike->moot);
    for (int a = 0; a < axes->count; a++)
        alike->free[a] =
            (free_axes && free_axes[a]) || sb_axis_is_shorthand(&axes->row[a]);
    for (int i = 0; i < count; i++)
        for (int a = 0; a < axes->count; a++)
            alike->moot[i * SB_AXIS_MAX + a] = sb_variant_moot(axes, row[i].axes, a);
}

void sb_alike_free(struct sb_alike *alike)
{
    free(alike->moot);
    *alike = (struct sb_alike){0};
}

bool sb_alike(const struct sb_alike *alike, int a, int b)
{
    const struct sb_row *x = &alike->row[a], *y = &alike->row[b];
    const bool *x_moot = &alike->moot[a * SB_AXIS_MAX];
    const bool *y_moot = &alike->moot[b * SB_AXIS_MAX];
    for (int i = 0; i < alike->axes->count; i++)
        if (x->axes->value[i] != y->axes->value[i] && !alike->free[i] && !x_moot[i] &&
            !y_moot[i])
            return false;
    return sb_text_same(x->scene, y->scene) && sb_text_same(x->renderer, y->renderer) &&
           sb_text_same(x->version, y->version) &&
           sb_text_same(x->timer_source, y->timer_source) &&
           sb_text_same(x->ci_kind, y->ci_kind);
}

bool sb_row_has_time(const struct sb_row *row)
{
    const enum sb_status status = row->status ? sb_status_find(row->status) : SB_INTERNAL;
    return status != SB_STATUS_COUNT && sb_status_rows[status].exit_code == 0 &&
           row->median_ms > 0;
}
