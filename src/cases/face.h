// Which face of a shadow map the shaders say that a direction meets (shaders/shadow_map/face.glsl).
#pragma once

#include "cases/case.h"

// Channels 4, 5 and 6 of each of the `count` pixels of *told: where on the face, in [0, 1], and the
// face's number; below 0: none.
bool sb_faces_tell(const struct sb_case_env *env, const struct sb_variant *variant,
                   const float (*direction)[3], int count, struct sb_image *told,
                   struct sb_error *err);
