// Which variants share a picture of the reference, so that nothing is computed twice.
#pragma once

#include <stdint.h>

#include "axis/variant.h"
#include "scene/scene.h"

// Equal keys: the same ideal picture. Of two variants of scenes of one name.
uint64_t sb_ref_ideal_key(const struct sb_axes *axes, const struct sb_variant *variant,
                          const struct sb_scene *scene);
// Equal keys: the same picture of the variant's model on exact inputs.
uint64_t sb_ref_model_key(const struct sb_axes *axes, const struct sb_variant *variant,
                          const struct sb_scene *scene);

// Is the scene's number of triangles an error, and not a part of what is asked for?
bool sb_ref_stands_for_sphere(const struct sb_scene *scene);

// Does the lighting read the tangent frame?
bool sb_ref_needs_frame(const struct sb_variant *variant);

// Does the picture read this map; does it read any?
bool sb_ref_needs_map(const struct sb_variant *variant, enum sb_map map);
bool sb_ref_needs_maps(const struct sb_variant *variant);

// What a picture of the reference costs, in units of a pixel and light: shadows are rays.
double sb_ref_work(const struct sb_variant *variant);

// May only pixels that lie in one triangle be compared, since the others mix several?
bool sb_ref_mixes_edges(const struct sb_variant *variant);
