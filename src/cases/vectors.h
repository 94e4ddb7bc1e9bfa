// What the cases about vectors are asked; the table is vectors.c.
#pragma once

#include "cases/case.h"
#include "cases/directions.h"
#include "math/random.h"
#include "math/vec.h"

// --- points -------------------------------------------------------------------------------

// A point at the origin that light number 0 and the eye are seen from along these vectors.
struct sb_vectors_point {
    struct sb_vec3 normal, light, eye;
};
struct sb_point *sb_vectors_add(struct sb_points *points,
                                const struct sb_vectors_point *vectors);

// A unit vector at right angles to a unit vector.
struct sb_vec3 sb_vectors_across(struct sb_vec3 v);

// vectors_frames.c: maps=normal.
void sb_vectors_flat_frames(struct sb_points *points,
                            const struct sb_case_setting *setting);
void sb_vectors_long_bumps(struct sb_points *points,
                           const struct sb_case_setting *setting);
void sb_vectors_flat_bumps(struct sb_points *points,
                           const struct sb_case_setting *setting);

// --- what is no table of points -----------------------------------------------------------

// Sets verdict, figure, bound and value by a criterion that the case measured by itself.
void sb_vectors_judge(const struct sb_criterion *criterion,
                      const struct sb_case_setting *setting, double measured,
                      struct sb_outcome *outcome);

#define SB_VECTORS_RUN(name)                                                             \
    bool name(const struct sb_case_env *env, const struct sb_case *it,                   \
              const struct sb_case_setting *setting, struct sb_outcome *outcome,         \
              struct sb_error *err)
SB_VECTORS_RUN(sb_vectors_nonuniform); // vectors_matrices.c
SB_VECTORS_RUN(sb_vectors_singular);
SB_VECTORS_RUN(sb_vectors_far_world); // vectors_places.c
SB_VECTORS_RUN(sb_vectors_lookups);
