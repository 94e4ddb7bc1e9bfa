#include "assemble/ablate.h"

#include "effects/calls.h"

static bool changes(const struct sb_axes *axes, const struct sb_variant *entry,
                    const struct sb_variant *varied)
{
    struct sb_calls whole, rest;
    sb_calls_asked(axes, entry, &whole);
    sb_calls_asked(axes, varied, &rest);
    rest.variant.value[SB_AXIS_WITHOUT] = whole.variant.value[SB_AXIS_WITHOUT];
    return entry->value[SB_AXIS_WITHOUT] == SB_WITHOUT_NOTHING &&
           (whole.effects != rest.effects ||
            !sb_variant_equal(axes, &whole.variant, &rest.variant));
}

void sb_ablate(struct sb_suite *suite)
{
    sb_suite_vary(suite, &(struct sb_vary_params){SB_AXIS_WITHOUT, changes});
}
