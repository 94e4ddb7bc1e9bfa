// GLSL ES 3.00 and newer.
#if __VERSION__ >= 310 && NR_SHADOWS > 0
#if defined(GL_EXT_texture_cube_map_array)
#extension GL_EXT_texture_cube_map_array : enable
#elif defined(GL_OES_texture_cube_map_array)
#extension GL_OES_texture_cube_map_array : enable
#endif
#if defined(GL_EXT_geometry_shader)
#extension GL_EXT_geometry_shader : enable
#elif defined(GL_OES_geometry_shader)
#extension GL_OES_geometry_shader : enable
#endif
#endif
#define ATTRIBUTE in
#define VARYING_OUT out
#define VARYING_IN in
#define SAMPLER2D P_SAMPLER sampler2D
#define SAMPLER(precision, type) precision type
#define TEXTURE texture
#define DECLARE_O_COLOR layout(location = 0) out P_OUTPUT vec4 o_color;
