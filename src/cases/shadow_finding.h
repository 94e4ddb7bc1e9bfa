// What a picture or a map has shown, and whether it proves what a case of shadows asks.
#pragma once

#include <math.h>

#include "cases/own.h"
#include "cases/shadow_world.h"

struct sb_shadow_finding {
    double measured; // the case's figure; INFINITY where a value is not finite
    int judged;      // pixels or texels that it is of
    // Of pixels, by the exact geometry; and how many of these are shown otherwise.
    int lit, dark, wrong;
};
typedef bool sb_shadow_find_fn(const struct sb_shadow_world *, struct sb_shadow_finding *,
                               struct sb_error *);

// The larger; what is not finite is larger than all.
static inline double sb_worse(double worst, double error)
{
    return !isfinite(error) ? INFINITY : error > worst ? error : worst;
}

// Counts a pixel that is surely lit or surely dark, and whether it is shown so.
void sb_shadow_hold_to_truth(const struct sb_shadow_world *world,
                             const struct sb_shadow_pixel *at,
                             struct sb_shadow_finding *found);

// Sets the outcome: `measured` has to be at most `bound`. A figure of next to nothing holds of itself,
// and is no proof: it fails.
void sb_shadow_judge(struct sb_outcome *outcome, const struct sb_shadow_finding *found,
                     double bound, const char *unit);

// The same of a figure about shadows, of which there must be some, and light, and shown where they
// are. A constant bias leaves some acne at grazing angles (0.5 % of the room): a hundredth may be wrong.
void sb_shadow_judge_shown(struct sb_outcome *outcome,
                           const struct sb_shadow_finding *found, double bound,
                           const char *unit);

// A picture of a scene, and what it shows; *found is added to.
bool sb_shadow_measure(const struct sb_case_env *env, const struct sb_variant *variant,
                       const char *scene, sb_shadow_find_fn *find,
                       struct sb_shadow_finding *found, struct sb_error *err);
