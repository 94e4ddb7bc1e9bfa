#include "cases/shadow_finding.h"

void sb_shadow_hold_to_truth(const struct sb_shadow_world *world,
                             const struct sb_shadow_pixel *at,
                             struct sb_shadow_finding *found)
{
    const enum sb_shadow_truth truth = sb_shadow_truth(world, at);
    found->lit += truth == SB_SHADOW_LIT;
    found->dark += truth == SB_SHADOW_DARK;
    found->wrong += (truth == SB_SHADOW_LIT && !(at->shown == 1)) ||
                    (truth == SB_SHADOW_DARK && !(at->shown == 0));
}

enum { LEAST = 200 }; // pixels or texels that prove anything

void sb_shadow_judge(struct sb_outcome *outcome, const struct sb_shadow_finding *found,
                     double bound, const char *unit)
{
    sb_outcome_measured(outcome, SB_FIGURE_OWN, found->measured, bound);
    sb_text_printf(&outcome->note, "%s", unit);
    if (found->judged < LEAST) {
        outcome->verdict = SB_VERDICT_FAIL;
        sb_text_printf(&outcome->note, "; no proof: of %d, fewer than %d", found->judged,
                       LEAST);
    }
}

enum { MOST_WRONG = 1 }; // percent
void sb_shadow_judge_shown(struct sb_outcome *outcome,
                           const struct sb_shadow_finding *found, double bound,
                           const char *unit)
{
    sb_shadow_judge(outcome, found, bound, unit);
    if (found->lit < LEAST || found->dark < LEAST) {
        outcome->verdict = SB_VERDICT_FAIL;
        sb_text_printf(
            &outcome->note,
            "; no proof: %d pixels surely lit and %d surely dark, of one fewer "
            "than %d",
            found->lit, found->dark, LEAST);
    }
    if (100.0 * found->wrong <= MOST_WRONG * (found->lit + found->dark))
        return;
    if (outcome->verdict == SB_VERDICT_PASS) {
        outcome->verdict = SB_VERDICT_FAIL;
        outcome->measured = 100.0 * found->wrong / (found->lit + found->dark);
        outcome->bound = MOST_WRONG;
    }
    sb_text_printf(&outcome->note,
                   "; %d of %d surely lit or dark pixels are shown otherwise",
                   found->wrong, found->lit + found->dark);
}

bool sb_shadow_measure(const struct sb_case_env *env, const struct sb_variant *variant,
                       const char *scene, sb_shadow_find_fn *find,
                       struct sb_shadow_finding *found, struct sb_error *err)
{
    struct sb_shadow_world world = {0};
    const bool good = sb_shadow_world_open(&world, env, variant, scene, err) &&
                      find(&world, found, err);
    sb_shadow_world_close(&world);
    return good;
}
