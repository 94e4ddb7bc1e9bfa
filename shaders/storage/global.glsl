// storage=global: the lights, and a material that all objects share, are global variables that
// fill_lights() sets: what GLSL ES 1.00, which has no constant arrays, leaves.
#include "generated/lights.glsl"
#include "storage/elements.glsl"
