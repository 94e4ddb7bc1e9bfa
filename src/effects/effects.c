#include "effects/effects.h"

const struct sb_effect_row sb_effect_rows[SB_EFFECT_COUNT] = {
#define EFFECT(id, name, stem, when, switched, help) {name, stem, when, help, switched},
#include "effects/effects.def"
#undef EFFECT
};

uint32_t sb_effects_of(const struct sb_axes *axes, const struct sb_variant *variant)
{
    uint32_t effects = 0;
    for (int i = 0; i < SB_EFFECT_COUNT; i++)
        if (sb_condition_holds(axes, sb_effect_rows[i].when, variant))
            effects |= UINT32_C(1) << i;
    return effects;
}
