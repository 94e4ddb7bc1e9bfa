// storage=constant: the lights, and a material that all objects share, are constants.
#include "generated/lights.glsl"
#include "storage/elements.glsl"
#include "storage/filled.glsl"
