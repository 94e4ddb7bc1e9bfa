// storage=arrays: a uniform array for each member, set by one call; a light is put together
// where it is read.
#include "generated/light_arrays.glsl"
#include "storage/filled.glsl"

uniform Material u_material;
