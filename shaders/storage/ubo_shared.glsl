// storage=ubo_shared: a block of lights whose layout the driver chooses and is asked for.
#define LIGHT_ARRAY(type, name, size) type name[size];
#if MAX_LIGHTS > 0
layout(shared) uniform Lights {
#include "layout/$(LAYOUT)_arrays.glsl"
};
#endif
#include "storage/elements.glsl"
#include "storage/filled.glsl"

layout(shared) uniform MaterialBlock {
    Material u_material;
};
