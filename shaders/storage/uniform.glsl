// storage=uniform: arrays of structs as plain uniforms, set one member at a time.
#define LIGHT_ARRAY(type, name, size) uniform type name[size];
#include "layout/$(LAYOUT)_arrays.glsl"
#include "storage/elements.glsl"
#include "storage/filled.glsl"

uniform Material u_material;
