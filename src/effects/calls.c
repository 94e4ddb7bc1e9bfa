#include "effects/calls.h"
void sb_analyse(const struct sb_analysis_params *p, struct sb_analysis *a)
{
    a->draw_count = p->scene->draw_count;
    a->draw = sb_arena_alloc(&a->arena, sizeof *a->draw * (size_t)a->draw_count + 1);
    int n = 0;
    for (int t = 0; t < 4; t++)
        n += p->scene->lights.count[t];
    int *l = sb_arena_alloc(&a->arena, sizeof *l * (size_t)(n + 1));
    for (int i = 0; i < n; i++)
        l[i] = i;
    struct sb_calls c = {.variant = *p->variant,
                         .effects = sb_effects_of(p->axes, p->variant),
                         .light = l};
    for (int t = 0; t < 4; t++)
        c.light_count[t] = p->scene->lights.count[t];
    a->scene = c;
    for (int i = 0; i < a->draw_count; i++)
        a->draw[i] = c;
}
void sb_analysis_free(struct sb_analysis *a)
{
    sb_arena_free(&a->arena);
}
void sb_calls_asked(const struct sb_axes *x, const struct sb_variant *v,
                    struct sb_calls *c)
{
    c->variant = *v;
    c->effects = sb_effects_of(x, v);
}
