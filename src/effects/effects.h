// Effects: what a draw calls for, and so what its program must hold.
#pragma once

#include "axis/variant.h"

enum sb_effect {
#define EFFECT(id, name, stem, when, switched, help) SB_EFFECT_##id,
#include "effects/effects.def"
#undef EFFECT
    SB_EFFECT_COUNT
};

struct sb_effect_row {
    const char *name, *stem, *when, *help; // see effects.def
    bool switched;
};
extern const struct sb_effect_row sb_effect_rows[SB_EFFECT_COUNT];

// The effects that can change a pixel of this variant: bit i is effect i.
uint32_t sb_effects_of(const struct sb_axes *axes, const struct sb_variant *variant);
