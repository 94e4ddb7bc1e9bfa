// The light structs of a variant as GLSL, from the table of their members.
#pragma once

#include "base/text.h"
#include "scene/lights.h"

// What shaders include under these names.
#define SB_LIGHT_STRUCTS_FILE "generated/light_structs.glsl"
#define SB_LIGHT_ARRAYS_FILE  "generated/light_arrays.glsl"

// struct PointLight and its like with the members that the variant can read, and
// POINT_LIGHT_OF(light), the PointLight that a struct with all its members holds.
void sb_light_structs_text(const struct sb_variant *variant, struct sb_text *text);

// storage=arrays: a uniform array for each member, and POINT_LIGHT(i), which makes a struct of
// their elements; of the types that the variant's layout has.
void sb_light_arrays_text(const struct sb_variant *variant, struct sb_text *text);
