// storage=ubo_std140: a block of lights whose layout the specification fixes (OpenGL 4.6 core,
// 7.6.2.2). A block may not be empty.
#define LIGHT_ARRAY(type, name, size) type name[size];
#if MAX_LIGHTS > 0
layout(std140) uniform Lights {
#include "layout/$(LAYOUT)_arrays.glsl"
};
#endif
#include "storage/elements.glsl"
#include "storage/filled.glsl"

layout(std140) uniform MaterialBlock {
    Material u_material;
};
