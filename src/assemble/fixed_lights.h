// The lights of a scene as GLSL, for the storages that write them into the shader.
#pragma once

#include "axis/variant.h"
#include "base/text.h"

// What shaders include under this name, behind the structs.
#define SB_FIXED_LIGHTS_FILE "generated/lights.glsl"

// Are the lights part of the text (storage=constant, storage=global)?
bool sb_lights_are_fixed(const struct sb_variant *variant);

// The light arrays and u_material with the floats that other storages are given.
// constant: const, with their values. global: plain globals, and fill_lights(), which assigns
// every element. Elements behind the last light are 0 throughout, and so off. Where lit draws
// differ in material, u_material is a uniform. The variant must have no `auto` left.
bool sb_fixed_lights(const char *scene, const struct sb_variant *variant,
                     struct sb_text *text, struct sb_error *err);
