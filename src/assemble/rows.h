// The GLSL of the program "rows" that is generated: how its inputs and lights are read from a
// point's row (scene/point.h).
#pragma once

#include "base/text.h"
#include "scene/point.h"

#define SB_ROW_FILE        "generated/row.glsl"
#define SB_ROW_LIGHTS_FILE "generated/row_lights.glsl"

// take_row(): sets the inputs.
void sb_row_text(const struct sb_variant *variant, struct sb_text *text);
// POINT_LIGHT(i) and its like: the light, put together.
void sb_row_lights_text(const struct sb_variant *variant, struct sb_text *text);

// Can the variant's points be told by a table? SB_BAD_INPUT where it reads what no row has: shadow
// maps, or matrices of the camera. Call after the version.
bool sb_decide_rows(const struct sb_axes *axes, const struct sb_variant *variant,
                    struct sb_error *err);
